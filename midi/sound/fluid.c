/* fluid.c - see fluid.h. */
#include "fluid.h"

#include <library.h>
#include <midi_internal.h>

#include <dlfcn.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define FUNCTION(name) LIBRARY_FUNCTION(struct fluid, name)

static const struct library_function functions[] = {
    FUNCTION(new_fluid_settings),
    FUNCTION(delete_fluid_settings),
    FUNCTION(fluid_settings_setstr),
    FUNCTION(fluid_settings_setint),
    FUNCTION(fluid_settings_setnum),
    FUNCTION(new_fluid_synth),
    FUNCTION(delete_fluid_synth),
    FUNCTION(fluid_synth_sfload),
    FUNCTION(fluid_synth_noteon),
    FUNCTION(fluid_synth_noteoff),
    FUNCTION(fluid_synth_cc),
    FUNCTION(fluid_synth_program_change),
    FUNCTION(fluid_synth_channel_pressure),
    FUNCTION(fluid_synth_key_pressure),
    FUNCTION(fluid_synth_pitch_bend),
    FUNCTION(fluid_synth_system_reset),
    FUNCTION(new_fluid_audio_driver),
    FUNCTION(delete_fluid_audio_driver),
    FUNCTION(new_fluid_sequencer2),
    FUNCTION(delete_fluid_sequencer),
    FUNCTION(fluid_sequencer_register_fluidsynth),
    FUNCTION(fluid_sequencer_get_tick),
    FUNCTION(fluid_synth_write_s16),
    FUNCTION(fluid_synth_get_active_voice_count),
    FUNCTION(fluid_set_log_function),
};

static void alsa_told(const char *file, int line, const char *function, int error,
                      const char *format, ...)
{
    (void)file, (void)line, (void)function, (void)error, (void)format;
}

static void jack_told(const char *text)
{
    (void)text;
}

void fluid_hush_drivers(void)
{
    static struct {
        int (*snd_lib_error_set_handler)(void (*told)(const char *file, int line,
                                                      const char *function, int error,
                                                      const char *format, ...));
    } alsa;
    static struct {
        void (*jack_set_error_function)(void (*told)(const char *text));
        void (*jack_set_info_function)(void (*told)(const char *text));
    } jack;
    static const struct library_function of_alsa[] = {LIBRARY_FUNCTION(
        alsa, snd_lib_error_set_handler)},
                                         of_jack[] = {
                                             LIBRARY_FUNCTION(jack, jack_set_error_function),
                                             LIBRARY_FUNCTION(jack, jack_set_info_function)};
    const char *missing;
    if (library_load("libasound.so.2", of_alsa, 1, &alsa, &missing))
        alsa.snd_lib_error_set_handler(alsa_told);
    if (library_load("libjack.so.0", of_jack, 2, &jack, &missing)) {
        jack.jack_set_error_function(jack_told);
        jack.jack_set_info_function(jack_told);
    }
    setenv("JACK_NO_START_SERVER", "1", 0); /* one that runs is used */
}

/* GLib, by which FluidSynth's loaders complain of damaged SoundFonts, prints so itself. */
typedef void glib_told(const char *domain, int level, const char *message, void *context);

static void glib_quiet(const char *domain, int level, const char *message, void *context)
{
    (void)domain, (void)level, (void)message, (void)context;
}

bool fluid_font_load(const struct fluid *fluid, void *synth, const char *path)
{
    static struct {
        glib_told *(*g_log_set_default_handler)(glib_told *told, void *context);
    } glib;
    static const struct library_function of_glib[] = {
        LIBRARY_FUNCTION(glib, g_log_set_default_handler)};
    const char *missing;
    const bool quiet = library_load("libglib-2.0.so.0", of_glib, 1, &glib, &missing);
    glib_told *before = quiet ? glib.g_log_set_default_handler(glib_quiet, NULL) : NULL;
    const bool loaded = fluid->fluid_synth_sfload(synth, path, 1) >= 0;
    if (quiet)
        glib.g_log_set_default_handler(before, NULL);
    return loaded;
}

enum { LEVELS = 5 }; /* of its log: panic, error, warning, information, debug */

enum midi_status fluid_load(const struct fluid **out)
{
    static struct fluid loaded;
    static bool there;
    *out = &loaded;
    if (there)
        return MIDI_OK;
    const char *missing;
    if (!library_load("libfluidsynth.so.3", functions, sizeof functions / sizeof *functions,
                      &loaded, &missing))
        return missing ? midi_fail(MIDI_NO_DEVICE,
                                   "FluidSynth has no %s: install libfluidsynth3", missing)
                       : midi_fail(MIDI_NO_DEVICE,
                                   "sound needs FluidSynth: install libfluidsynth3 (%s)",
                                   dlerror());
    for (int level = 0; level < LEVELS; level++)
        loaded.fluid_set_log_function(level, NULL, NULL); /* we report failures ourselves */
    there = true;
    return MIDI_OK;
}
