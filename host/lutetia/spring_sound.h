/* spring_sound.h - what a stage's actor lets hear, as sound as long as the film of it.
 *
 *     struct spring_sound *sound;
 *     // runs the stage from its beginning, draws nothing
 *     if (spring_sound_hear(stage, fps, seconds, &sound) != MIDI_OK)
 *         return fail("spring", "%s", midi_error());
 *     spring_sound_write(sound, "film.wav");
 *     spring_sound_open(sound, &file);                                  // for a film
 *     spring_sound_destroy(sound);
 *
 * Sounds keep the actor's own times, not those of pictures: a clank is heard within 1.5 ms of
 * its bounce. Its loudness is its speed, as MIDI has it (20 for each unit a second); left and
 * right are where it happens, and so is how high it is. */
#ifndef LUTETIA_SPRING_SOUND_H
#define LUTETIA_SPRING_SOUND_H

#include <stage.h>

#include <midi_song.h>

struct spring_sound;

/* The stage is one for this alone: it is at its end then. before: as in stage_film_def. beside:
 * a song that is heard, too, on its own instruments; NULL; borrowed while the sound lives.
 * Where no sound can be made, that is said before. Errors: NO_DEVICE (FluidSynth or a SoundFont
 * is missing), NO_MEMORY, BAD_ARGUMENT (the stage's own: stage_error() in midi_error()). */
enum midi_status
spring_sound_hear(struct stage *stage, int fps, double seconds,
                  enum stage_status (*before)(void *context, struct stage *stage, double now_s),
                  void *context, struct midi_song *beside, struct spring_sound **out);
void spring_sound_destroy(struct spring_sound *sound); /* takes NULL */

int spring_sound_count(const struct spring_sound *sound); /* of what is heard */
/* Errors: IO_FAILED. */
enum midi_status spring_sound_write(struct spring_sound *sound, const char *path);
/* A WAV file without a name. Owns: the caller closes *file. */
enum midi_status spring_sound_open(struct spring_sound *sound, int *file);

#endif
