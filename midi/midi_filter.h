/* midi_filter.h - a chain of filters for messages.
 *
 *     struct midi_chain *chain;
 *     if (midi_chain_create("drop=aftertouch,clock channels=1-4 transpose=-12 thin=20", &chain) != MIDI_OK)
 *         die(midi_error());
 *     // calls message_taken for what passes
 *     midi_chain_take(chain, &message, message_taken, context);
 *     ... at midi_chain_due_ns(chain) at the latest:
 *     midi_chain_flush(chain, now_ns, message_taken, context);
 *     midi_chain_destroy(chain);
 *
 * The links are applied in the order in which they are written:
 *
 *     drop=NAMES          takes out messages by name (midi_message.h), or aftertouch,
 *                         real-time, controls
 *     keep=NAMES          takes out all others
 *     channels=1-4,10     channel messages of other channels are taken out
 *     notes=c2-c6         notes outside are taken out
 *     transpose=-12       notes move; those that leave 0..127 are taken out
 *     velocity=G          of note-ons: 127 (v / 127)^G; below 1 a light touch sounds louder. Or
 *                         fixed:N
 *     channel=N           channel messages go to that channel
 *     split=c4:2          notes below c4 go to channel 2
 *     thin=MS             continuous controllers, bend and pressures: at most one value in so
 *                         many milliseconds each
 *
 * Thinning holds the newest value back until its interval is over, or until the next message of
 * another kind on its channel, whichever is first. So the last value always arrives, and values
 * set before a note arrive before it. Switches (pedals), parameter numbers and banks are never
 * thinned. A value that was held back keeps its original time.
 *
 * Errors: functions that can fail return a status and leave one line in midi_error().
 *
 * Ownership: what is passed is copied; messages that pass are the chain's, valid during the
 * call.
 *
 * Threads: a chain belongs to one at a time.
 */
#ifndef LUTETIA_MIDI_FILTER_H
#define LUTETIA_MIDI_FILTER_H

#include "midi_parser.h"

struct midi_chain;

/* Parses the text's links; an empty text passes everything. Errors: BAD_ARGUMENT, with the
 * known names; NO_MEMORY. Owns: the caller destroys *out. */
enum midi_status midi_chain_create(const char *text, struct midi_chain **out);
void midi_chain_destroy(struct midi_chain *chain); /* takes NULL */

/* Calls `take` for what passes, none, one or several messages. */
void midi_chain_take(struct midi_chain *chain, const struct midi_message *m, midi_take *take,
                     void *context);
/* The time at which a value that is held back is due; UINT64_MAX: none. */
uint64_t midi_chain_due_ns(const struct midi_chain *chain);
/* Passes on the values that are due; with UINT64_MAX all values. */
void midi_chain_flush(struct midi_chain *chain, uint64_t now_ns, midi_take *take,
                      void *context);

#endif
