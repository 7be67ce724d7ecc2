/* midi_encoder.h - messages to bytes: the parser's inverse.
 *
 *     struct midi_encoder encoder = {.running_status = true};
 *     uint8_t bytes[MIDI_ENCODED_MAX];
 *     size_t count = midi_encoder_put(&encoder, &message, bytes);
 *     write(port, bytes, count);
 *
 * With running status a channel message whose status is that of the last one goes without it: two bytes instead of three,
 * 640 us instead of 960 on a MIDI cable. Real-time messages leave that as it is.
 *
 * A message that is no real-time one ends a system exclusive that is still open: the f7 is written before it. A piece that
 * goes on where nothing is open is refused. So a parser reads from the bytes the messages that went in, and never others. */
#ifndef LUTETIA_MIDI_ENCODER_H
#define LUTETIA_MIDI_ENCODER_H

#include "midi_message.h"

#include <stddef.h>

enum { MIDI_ENCODED_MAX = MIDI_BYTES_MAX + 1 };

struct midi_encoder { /* zeros, but for the choice */
    bool running_status;
    /* private */
    uint8_t running;
    bool in_sysex;
};

/* How many bytes were written; 0: the message is none, or goes on where nothing is open. */
size_t midi_encoder_put(struct midi_encoder *e, const struct midi_message *m,
                        uint8_t bytes[static MIDI_ENCODED_MAX]);

#endif
