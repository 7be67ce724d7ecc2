/* sound_keeper.h - a synthesizer that goes on when its sound server has been gone.
 *
 *     struct sound_keeper *keeper;
 *     sound_listen_any(sound);
 *     sound_keeper_begin(sound, &keeper);                                // NULL for files
 *     const char *said = sound_keeper_said(keeper);                      // now and then
 *     sound_keeper_end(keeper);                                          // before:
 *     sound_destroy(sound);
 *
 * A thread looks twice a second whether somebody takes the sound. Where nobody has for six
 * looks it listens again, until it is heard. Who plays meanwhile waits for nothing, and is not
 * heard; the notes of before have ended.
 */
#ifndef LUTETIA_MIDI_SOUND_KEEPER_H
#define LUTETIA_MIDI_SOUND_KEEPER_H

#include "sound.h"

struct sound_keeper;
/* *out becomes NULL, and that is fine, where the sound goes into a file. Borrows the sound,
 * which nobody else lets listen again. Errors: NO_MEMORY. Owns: the caller ends *out. */
enum midi_status sound_keeper_begin(struct sound *sound, struct sound_keeper **out);
/* The same of a sound whose server was not there when it was to listen: it is looked for, and
 * that is known, so it is not said. */
enum midi_status sound_keeper_wait(struct sound *sound, struct sound_keeper **out);
/* NULL is fine. May wait for a sound server that hangs. */
void sound_keeper_end(struct sound_keeper *keeper);

/* What has become of the server since the last call: it is gone, or it is back; NULL: nothing.
 * Threads: one at a time. */
const char *sound_keeper_said(struct sound_keeper *keeper);

#endif
