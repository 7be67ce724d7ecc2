/* fluid.c - see fluid.h. */
#include "fluid.h"

#include <library.h>
#include <midi_internal.h>

#include <dlfcn.h>
#include <stddef.h>
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
    FUNCTION(new_fluid_file_renderer),
    FUNCTION(fluid_file_renderer_process_block),
    FUNCTION(delete_fluid_file_renderer),
    FUNCTION(fluid_set_log_function),
};

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
