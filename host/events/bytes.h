/* bytes.h - bytes that grow, and bytes that are read with care: numbers with their low byte first, doubles as the 64 bits of IEEE 754.
 *
 * Neither fails at once: after many calls one looks at `short_of_memory` or `bad`. */
#ifndef LUTETIA_EVENTS_BYTES_H
#define LUTETIA_EVENTS_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct event_bytes { /* {0}: none yet. Owns: the caller frees `at` */
    uint8_t *at;
    size_t count, room;
    bool short_of_memory; /* something was not put */
};

struct event_reader {
    const uint8_t *at, *end;
    bool bad; /* it did not hold what was asked for; what was gotten since is zeros */
};

void event_put_bytes(struct event_bytes *b, const void *bytes, size_t count);
void event_put_number(struct event_bytes *b, uint64_t number, int bytes); /* 1..8 */
void event_put_double(struct event_bytes *b, double number);
/* The next `count` bytes, in place; NULL: bad. */
const uint8_t *event_get_bytes(struct event_reader *r, size_t count);
uint64_t event_get_number(struct event_reader *r, int bytes);
double event_get_double(struct event_reader *r);

/* A number that tells bytes apart; no protection against who wants two alike. */
uint64_t event_digest(const uint8_t *bytes, size_t count);

#endif
