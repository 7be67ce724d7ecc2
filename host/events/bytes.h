/* bytes.h - writing bytes to a growing array, and reading bytes with checks. Numbers have their
 * low byte first; doubles are the 64 bits of IEEE 754.
 *
 * The functions return no status: after any number of calls, check `short_of_memory` or
 * `bad`.
 */
#ifndef LUTETIA_EVENTS_BYTES_H
#define LUTETIA_EVENTS_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct event_bytes { /* {0}: none yet. Owns: the caller frees `at` */
    uint8_t *at;
    size_t count, room;
    bool short_of_memory; /* an allocation failed, and bytes are missing */
};

struct event_reader {
    const uint8_t *at, *end;
    bool bad; /* there were fewer bytes than were read; everything read since is zeros */
};

void event_put_bytes(struct event_bytes *b, const void *bytes, size_t count);
void event_put_number(struct event_bytes *b, uint64_t number, int bytes); /* 1..8 */
void event_put_double(struct event_bytes *b, double number);
/* Returns the next `count` bytes, in place; NULL if there are fewer. */
const uint8_t *event_get_bytes(struct event_reader *r, size_t count);
uint64_t event_get_number(struct event_reader *r, int bytes);
double event_get_double(struct event_reader *r);

/* A hash that distinguishes byte strings; it does not resist deliberate collisions. */
uint64_t event_digest(const uint8_t *bytes, size_t count);

#endif
