/* stream.h - members as bytes and back. What is put and what is gotten is said once: each event_pass_...() does either, as its
 * stream is.
 *
 * Members go in the order of their rows; whole numbers take 8 bytes with two's complement, flags one, text as many as it has room. */
#ifndef LUTETIA_EVENTS_STREAM_H
#define LUTETIA_EVENTS_STREAM_H

#include "bytes.h"
#include "members.h"

struct event_stream {
    struct event_bytes *out; /* one of these two */
    struct event_reader *in;
    const void *context;  /* for the module's forms */
    bool short_of_memory; /* for what was gotten */
};

/* While bytes are put, what is passed is only read. Returns what was gotten, or the number itself. */
uint64_t event_pass_number(struct event_stream *s, uint64_t number, int bytes);
void event_pass_int(struct event_stream *s, int *at, int64_t least, int64_t most);
void event_pass_flag(struct event_stream *s, bool *at);
/* Words of 8 bytes: uint64_t or double. */
void event_pass_words(struct event_stream *s, void *words, int count);
void event_pass_text(struct event_stream *s, char *text, size_t size);
/* An array of `size` bytes, which is made when it is gotten (NULL: bad, or no memory); else returns the array. */
void *event_pass_array(struct event_stream *s, const void *array, size_t size);
void event_pass_members(struct event_stream *s, const struct members *members, void *of);

/* What was gotten is bad unless `good`. Nothing is gotten any more. */
void event_stream_expect(struct event_stream *s, bool good);
/* Whether there is a point in going on. */
bool event_stream_good(const struct event_stream *s);

#endif
