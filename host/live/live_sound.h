/* live_sound.h - what a stage's actor lets hear, heard at once: by a synthesizer, and by a
 * device of the MIDI server.
 *
 *     struct live_sound_def def = {.synth = true};
 *     struct live_sound *sound;
 *     if (live_sound_open(&def, &sound) != MIDI_OK)
 *         say(midi_error());                                  // silent, then
 *     stage_frame(stage, now_s, NULL);
 *     live_sound_take(sound, stage);                          // after each frame
 *     live_sound_close(sound);
 *
 * A song that plays the stage is heard with it, on a synthesizer of its own, each message a
 * picture's time (LIVE_SONG_LATE_MS) after it was due: so rhythms are as they were written.
 *
 * A thread of its own plays, so neither a slow device nor a sound server that hangs holds up
 * the stage. What it cannot take in time is dropped, and counted.
 *
 * Threads: whose thread the stage is.
 */
#ifndef LUTETIA_LIVE_SOUND_H
#define LUTETIA_LIVE_SOUND_H

#include <midi_status.h>
#include <sound_events.h>
#include <stage.h>

enum { LIVE_SONG_LATE_MS = 20 };

struct live_sound_def {
    bool song;  /* there is one, for live_sound_song() */
    bool synth; /* with neither a synthesizer nor a device nothing is heard but in recordings */
    /* A driver of FluidSynth, or a name that ends with .wav; NULL: JACK, PulseAudio or ALSA,
     * the first that works. */
    const char *driver;
    const char *song_driver;     /* the song's; NULL: the same */
    const char *server, *device; /* a device of the MIDI server; device NULL: none */
    bool waits; /* where no sound server runs yet, that is no error: it is looked for */
    /* Whoever else takes what is let hear; NULL: nobody. */
    void (*heard)(void *context, const struct stage_sound *sound);
    void *context;
};

struct live_sound;
/* Errors: NO_DEVICE (no sound, FluidSynth or such a device), NO_SERVER, NO_MEMORY, IO_FAILED.
 * Owns: the caller closes *out. */
enum midi_status live_sound_open(const struct live_sound_def *def, struct live_sound **out);
void live_sound_close(struct live_sound *sound); /* ends all notes; NULL is fine */

/* Why nothing is heard yet, where def.waits; NULL: a sound server was there. Valid as long as
 * the sound. */
const char *live_sound_silent(const struct live_sound *sound);

/* Plays what the stage's actor has let hear since the last call. NULL is fine. */
void live_sound_take(struct live_sound *sound, struct stage *stage);
/* A message of the song, which was due late_s ago. */
void live_sound_song(struct live_sound *sound, const struct midi_message *m, double late_s);
/* What has become of the sound server since the last call (sound_keeper.h); NULL: nothing. */
const char *live_sound_said(struct live_sound *sound);
long live_sound_played(const struct live_sound *sound); /* events so far */
long live_sound_dropped(const struct live_sound *sound);

/* ---- for recordings ---- */

/* From now on what is played is kept, too. */
void live_sound_record(struct live_sound *sound);
/* Ends that, and makes a WAV file of it, as long as it took: for a film. song: was played
 * meanwhile, and was at song_s when it began; NULL: none. *file: -1 where nothing was heard.
 * Errors: those of sound_render_open(); *file is then -1. Owns: the caller closes *file. */
enum midi_status live_sound_recorded(struct live_sound *sound, struct midi_song *song,
                                     double song_s, int *file);

/* A sound of the stage's actor as an event of sound_events.h: a clank's velocity is its speed,
 * as MIDI has it (20 for each unit a second), high and low, left and right are where it
 * happens. `extent`: of the actor. False: it is no sound of those. */
bool live_sound_event(const struct stage_sound *heard, const struct font_box *extent,
                      struct sound_event *out);

#endif
