/* computer_keys.h - the computer's keyboard as a musical one: two rows of keys are two octaves.
 *
 *      2 3   5 6 7   9 0        the octave above, and three keys more
 *     Q W E R T Y U I O P
 *      S D   G H J              the lowest octave
 *     Z X C V B N M
 *
 * A key has no velocity: it is the usual one, and with Shift the most. */
#ifndef LUTETIA_COMPUTER_KEYS_H
#define LUTETIA_COMPUTER_KEYS_H

#include <input.h>
#include <midi_message.h>

struct computer_keys {
    int lowest; /* the note of Z */
    bool down[MIDI_NOTES];
};

/* What a key going down or up plays, as a message of channel 1. False: nothing. */
bool computer_keys_take(struct computer_keys *keys, const struct input_event *event,
                        struct midi_message *m);
/* The note-off of a key that is down: where the window has lost the keyboard. False: none
 * is. */
bool computer_keys_release(struct computer_keys *keys, struct midi_message *m);

#endif
