/* fluid.h - loads FluidSynth on first use; without it everything else works. */
#ifndef LUTETIA_MIDI_FLUID_H
#define LUTETIA_MIDI_FLUID_H

#include <midi_status.h>

#include <stdbool.h>

/* The functions that we call, as FluidSynth 2 declares them: its settings, synthesizers
 * and drivers are opaque pointers. */
struct fluid {
    void *(*new_fluid_settings)(void);
    void (*delete_fluid_settings)(void *settings);
    int (*fluid_settings_setstr)(void *settings, const char *name, const char *value);
    int (*fluid_settings_setint)(void *settings, const char *name, int value);
    int (*fluid_settings_setnum)(void *settings, const char *name, double value);
    void *(*new_fluid_synth)(void *settings);
    void (*delete_fluid_synth)(void *synth);
    int (*fluid_synth_sfload)(void *synth, const char *path, int reset);
    int (*fluid_synth_noteon)(void *synth, int channel, int note, int velocity);
    int (*fluid_synth_noteoff)(void *synth, int channel, int note);
    int (*fluid_synth_cc)(void *synth, int channel, int control, int value);
    int (*fluid_synth_program_change)(void *synth, int channel, int program);
    int (*fluid_synth_channel_pressure)(void *synth, int channel, int value);
    int (*fluid_synth_key_pressure)(void *synth, int channel, int note, int value);
    int (*fluid_synth_pitch_bend)(void *synth, int channel, int value);
    int (*fluid_synth_system_reset)(void *synth);
    void *(*new_fluid_audio_driver)(void *settings, void *synth);
    void (*delete_fluid_audio_driver)(void *driver);
    void *(*new_fluid_sequencer2)(int by_clock);
    void (*delete_fluid_sequencer)(void *sequencer);
    short (*fluid_sequencer_register_fluidsynth)(void *sequencer, void *synth);
    unsigned (*fluid_sequencer_get_tick)(void *sequencer);
    int (*fluid_synth_write_s16)(void *synth, int count, void *left, int left_at, int left_step,
                                 void *right, int right_at, int right_step);
    int (*fluid_synth_get_active_voice_count)(void *synth);
    void *(*fluid_set_log_function)(int level, void (*function)(int, const char *, void *),
                                    void *data);
};

/* Errors: NO_DEVICE: it is not installed. Threads: the first call by one thread. */
enum midi_status fluid_load(const struct fluid **out);
/* ALSA and JACK, which FluidSynth's drivers use, print no complaints of their own from now on,
 * and JACK starts no server. Threads: before others use them. */
void fluid_hush_drivers(void);

/* Loads a SoundFont, and prints nothing, whatever is damaged in it. False: it cannot be
 * read. */
bool fluid_font_load(const struct fluid *fluid, void *synth, const char *path);

#endif
