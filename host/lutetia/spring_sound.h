/* spring_sound.h - what a stage's actor lets hear while a film is made, as a WAV file of the film's length.
 *
 *     struct spring_sound *sound;
 *     if (spring_sound_create("film.wav", &sound) != MIDI_OK)          // says at once if there can be none
 *         return fail("spring", "%s", midi_error());
 *     ... after each picture: spring_sound_take(sound, stage);
 *     status = spring_sound_finish(sound, seconds);                    // frees it, too
 *
 * Sounds keep the actor's own times, not those of pictures: a clank is heard within 1.5 ms of its bounce. Its loudness is its
 * speed, as MIDI has it (20 for each unit a second); left and right are where it happens, and so is how high it is. */
#ifndef LUTETIA_SPRING_SOUND_H
#define LUTETIA_SPRING_SOUND_H

#include <stage.h>

#include <midi_status.h>

struct spring_sound;

/* path: borrowed. Errors: NO_DEVICE (FluidSynth or a SoundFont is missing), NO_MEMORY. */
enum midi_status spring_sound_create(const char *path, struct spring_sound **out);
/* Takes what waits to be heard. Times are the actor's, whose beginning is the film's. */
void spring_sound_take(struct spring_sound *sound, struct stage *stage);
/* Writes and frees. *count: how many were heard. Errors: IO_FAILED, NO_MEMORY. */
enum midi_status spring_sound_finish(struct spring_sound *sound, double seconds, int *count);
void spring_sound_abandon(struct spring_sound *sound); /* takes NULL */

#endif
