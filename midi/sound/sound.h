/* sound.h - plays messages by a synthesizer with a SoundFont, live or rendered to a file.
 *
 *     struct sound_def def = sound_def_default();
 *     if (sound_render(&def, song, 0, "song.wav") != MIDI_OK)            // all of a song
 *         die(midi_error());
 *
 *     struct sound *sound;                                               // or live
 *     if (sound_create(&def, &sound) == MIDI_OK && sound_listen(sound, NULL) == MIDI_OK)
 *         sound_message(sound, &message);
 *     sound_destroy(sound);
 *
 * FluidSynth is loaded by the first call; if it or a SoundFont is missing, NO_DEVICE's
 * message says what to install.
 */
#ifndef LUTETIA_MIDI_SOUND_H
#define LUTETIA_MIDI_SOUND_H

#include <midi_song.h>

#include <stdbool.h>

enum { SOUND_BLOCK = 64 }; /* samples: the timing error of a message is at most this, 1.5 ms */

struct sound_def {
    /* a SoundFont's path; NULL: LUTETIA_SOUNDFONT of the environment, else the
     * distribution's */
    const char *font;
    int rate_hz; /* 44100 */
    double gain; /* 0..10; 0.6 */
    /* what a song leaves sounding is rendered until it has died, for at most so long; 30 */
    double tail_s;
    bool room; /* reverberation and chorus */
    /* for files: another song that is heard with it, on instruments of its own; NULL */
    struct midi_song *beside;
};
struct sound_def sound_def_default(void);

/* ---- at once ---- */

struct sound;
/* Errors: NO_DEVICE, BAD_ARGUMENT, NO_MEMORY. */
enum midi_status sound_create(const struct sound_def *def, struct sound **out);
void sound_destroy(struct sound *sound); /* takes NULL */
/* Plays through a driver of FluidSynth (pulseaudio, alsa, jack, ...; NULL: its default), or,
 * if the name ends with .wav, into that file, in real time. Errors: NO_DEVICE, IO_FAILED. */
enum midi_status sound_listen(struct sound *sound, const char *driver);
/* The same through JACK, PulseAudio or ALSA, the first that works. Errors: NO_DEVICE. */
enum midi_status sound_listen_any(struct sound *sound);
/* Whether a driver that is no file listens. */
bool sound_is_live(const struct sound *sound);
/* Milliseconds of sound that a driver has taken: they stand still where its sound server is
 * gone. Of files 0. Threads: any. */
unsigned sound_taken_ms(const struct sound *sound);
/* Gives up a driver whose sound server is gone, ends all notes, and listens as before. May wait
 * for a server that hangs. Errors: as before; it may be tried again. */
enum midi_status sound_listen_again(struct sound *sound);
/* Ignores messages without sound. Threads: any. */
void sound_message(struct sound *sound, const struct midi_message *m);

/* ---- block by block, of a sound that nobody listens to ---- */

/* The next samples. Shape: left and right in turns. */
void sound_block(struct sound *sound, int16_t samples[2 * SOUND_BLOCK]);
/* Whether a note sounds or dies away. A room's echo may last longer. */
bool sound_voices(struct sound *sound);

/* ---- to a file ---- */

/* Renders a WAV file of 16 bits and two channels, `seconds` long; 0: the song, and on until the
 * last sound has died, the notes that the song leaves on being ended with it. The file appears
 * when it is complete. Errors: NO_DEVICE, IO_FAILED, BAD_ARGUMENT. */
enum midi_status sound_render(const struct sound_def *def, struct midi_song *song,
                              double seconds, const char *path);

/* The same to an unnamed file, open for reading from its beginning: for the sound of a film.
 * Owns: the caller closes *file. */
enum midi_status sound_render_open(const struct sound_def *def, struct midi_song *song,
                                   double seconds, int *file);

/* The SoundFont that is used: the given one, that of LUTETIA_SOUNDFONT, or the first that
 * exists. Errors: NO_DEVICE, if it is no regular file that can be read, or does not begin as a
 * SoundFont. */
enum midi_status sound_font_find(const char *font, const char **found);

#endif
