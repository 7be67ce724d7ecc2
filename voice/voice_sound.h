/* voice_sound.h - sound from a file, as one channel of numbers: WAV, FLAC, AIFF, Ogg and what
 * else libsndfile reads.
 *
 *     struct voice_sound sound;
 *     char why[200];
 *     if (!voice_sound_read("cry.wav", &sound, why, sizeof why))
 *         die(why);
 *     voice_sound_finish(&sound);
 *
 * Channels are averaged. Samples are -1..1; NaNs become 0.
 */
#ifndef LUTETIA_VOICE_SOUND_H
#define LUTETIA_VOICE_SOUND_H

#include <stdbool.h>
#include <stddef.h>

/* The longest sound, and the rates that sounds may have. */
enum { VOICE_SECONDS_MAX = 5400, VOICE_RATE_MIN = 4000, VOICE_RATE_MAX = 384000 };

struct voice_sound {
    float *samples;
    size_t count;
    int rate_hz;
};

/* False: `why` gets the reason in one line (no such file, not a regular file, not a sound,
 * too long, empty, no memory); *out is then empty. Owns: the caller finishes *out. */
bool voice_sound_read(const char *path, struct voice_sound *out, char *why, size_t room);
void voice_sound_finish(struct voice_sound *sound); /* an empty one is fine */

/* Writes a WAV file of 16 bits and one channel to an open descriptor, which stays open.
 * False: a write failed (errno). */
bool voice_sound_write(int descriptor, const struct voice_sound *sound);

#endif
