/* midi_parser.h - parses bytes to messages.
 *
 *     struct midi_parser parser;
 *     midi_parser_init(&parser);
 *     while ((count = read(port, bytes, sizeof bytes)) > 0)
 *         midi_parser_take(&parser, midi_now_ns(), bytes, count, message_taken, context);
 *
 * The messages depend only on the bytes, not on how they are divided into reads:
 *   - a status byte stands for the channel messages after it, too (running status), until a
 *     system message other than a real-time one;
 *   - real-time bytes are messages at once, also inside others, which they leave as they were;
 *   - system exclusive comes in pieces of MIDI_BYTES_MAX bytes, the last one shorter; it is
 *     ended by any status byte that is no real-time one, and then gets the f7 that it did not
 *     have;
 *   - what is undefined (f4, f5, f9, fd), data without a status, an f7 without a beginning, and
 *     a message broken off by another are dropped and counted.
 *
 * A message's time is that of the read which brought its last byte.
 *
 * Errors: none; what cannot be parsed is counted. Ownership: the parser is the caller's, and
 * allocates no memory. Threads: a parser belongs to one thread at a time, in which messages are
 * taken.
 */
#ifndef LUTETIA_MIDI_PARSER_H
#define LUTETIA_MIDI_PARSER_H

#include "midi_message.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct midi_parser_counts {
    uint64_t messages;
    uint64_t stray;     /* data bytes without a status; f7 without a beginning */
    uint64_t broken;    /* messages that another status byte broke off */
    uint64_t undefined; /* bytes f4, f5, f9, fd */
};

struct midi_parser {
    struct midi_parser_counts counts;
    /* private */
    uint8_t running; /* the status of the message being read, or of a running one; 0: none */
    bool in_sysex;
    struct midi_message partial;
};

typedef void midi_take(void *context, const struct midi_message *message);

/* As before the first byte. */
void midi_parser_init(struct midi_parser *p);
/* Calls `take` for each message that these bytes complete, in order. */
void midi_parser_take(struct midi_parser *p, uint64_t time_ns, const uint8_t *bytes,
                      size_t count, midi_take *take, void *context);
/* The source is gone: ends an open system exclusive, drops an incomplete message, and
 * forgets the running status. */
void midi_parser_end(struct midi_parser *p, uint64_t time_ns, midi_take *take, void *context);

#ifdef __cplusplus
}
#endif

#endif
