/* midi_encoder.h - messages to bytes: the parser's inverse.
 *
 *     struct midi_encoder encoder = {.running_status = true};
 *     uint8_t bytes[MIDI_ENCODED_MAX];
 *     size_t count = midi_encoder_put(&encoder, &message, bytes);
 *     write(port, bytes, count);
 *
 * With running status a channel message whose status is that of the last one goes without it:
 * two bytes instead of three, 640 us instead of 960 on a MIDI cable. Real-time messages do not
 * change the running status.
 *
 * A message other than a real-time one ends an open system exclusive: f7 is written before
 * it. A continuing piece is refused if no system exclusive is open. So a parser always reads
 * exactly the encoded messages from the bytes.
 *
 * Errors: by the number of bytes. Ownership: the encoder is the caller's, and points to
 * nothing. Threads: an encoder belongs to one thread at a time.
 */
#ifndef LUTETIA_MIDI_ENCODER_H
#define LUTETIA_MIDI_ENCODER_H

#include "midi_message.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { MIDI_ENCODED_MAX = MIDI_BYTES_MAX + 1 };

struct midi_encoder { /* zeros, but for the choice */
    bool running_status;
    /* private */
    uint8_t running;
    bool in_sysex;
};

/* Returns the number of bytes written; 0: the message is invalid, or continues a system
 * exclusive that is not open. */
size_t midi_encoder_put(struct midi_encoder *e, const struct midi_message *m,
                        uint8_t bytes[MIDI_ENCODED_MAX]);

#ifdef __cplusplus
}
#endif

#endif
