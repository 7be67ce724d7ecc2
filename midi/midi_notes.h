/* midi_notes.h - which notes sound, so that all can be ended when their player is gone.
 *
 *     struct midi_notes notes = {0};
 *     midi_notes_take(&notes, &message);                      // for each message that goes by
 *     ...
 *     midi_notes_release(&notes, now_ns, message_taken, context);   // ends all of them
 *
 * Errors: none. Ownership: the struct is the caller's, and points to nothing. Threads: it
 * belongs to one thread at a time.
 */
#ifndef LUTETIA_MIDI_NOTES_H
#define LUTETIA_MIDI_NOTES_H

#include "midi_parser.h"

#ifdef __cplusplus
extern "C" {
#endif

struct midi_notes { /* zeros: none */
    uint64_t on[MIDI_CHANNELS][2];
    uint16_t pedals; /* a bit for each channel whose sustain pedal is down */
};

/* Follows notes, sustain pedals, and the controllers and the reset that end all notes;
 * ignores other messages. */
void midi_notes_take(struct midi_notes *n, const struct midi_message *m);
int midi_notes_count(const struct midi_notes *n);
/* Sends a note-off for each note, and pedals up; afterwards no note sounds. At most
 * MIDI_CHANNELS * (MIDI_NOTES + 1) messages. */
void midi_notes_release(struct midi_notes *n, uint64_t time_ns, midi_take *take, void *context);
/* Without knowledge of earlier messages: sends pedal up and all notes off on each channel. */
void midi_notes_silence(uint64_t time_ns, midi_take *take, void *context);

#ifdef __cplusplus
}
#endif

#endif
