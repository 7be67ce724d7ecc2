/* stream.h - writes members as bytes, and reads them. One description serves both: each
 * event_pass_...() writes or reads, depending on its stream.
 *
 * Members go in the order of their rows; whole numbers take 8 bytes (two's complement),
 * flags one, text the size of its array.
 */
#ifndef LUTETIA_EVENTS_STREAM_H
#define LUTETIA_EVENTS_STREAM_H

#include "bytes.h"
#include "members.h"

struct event_stream {
    struct event_bytes *out; /* exactly one of these two is set */
    struct event_reader *in;
    const void *context;  /* passed to the module's functions */
    bool short_of_memory; /* while reading */
};

/* When writing, the number passed is written and returned. When reading, returns the number
 * read. */
uint64_t event_pass_number(struct event_stream *s, uint64_t number, int bytes);
void event_pass_int(struct event_stream *s, int *at, int64_t least, int64_t most);
void event_pass_flag(struct event_stream *s, bool *at);
/* Words of 8 bytes: uint64_t or double. */
void event_pass_words(struct event_stream *s, void *words, int count);
void event_pass_text(struct event_stream *s, char *text, size_t size);
/* An array of `size` bytes. When writing, returns `array`; when reading, returns a new one
 * (NULL: bad, or no memory). */
void *event_pass_array(struct event_stream *s, const void *array, size_t size);
void event_pass_members(struct event_stream *s, const struct members *members, void *of);

/* When reading, marks the stream bad unless `good`. A bad stream reads nothing more. */
void event_stream_expect(struct event_stream *s, bool good);
/* False if the stream is bad or out of memory: the caller can stop. */
bool event_stream_good(const struct event_stream *s);

#endif
