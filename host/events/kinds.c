/* kinds.c - see kinds.h. */
#include "kinds.h"

#include "stream.h"

#include <stdlib.h>

void *event_blank(const struct event_kind *kind)
{
    return calloc(1, kind->size ? kind->size : 1);
}

void event_free(const struct event_kind *kind, void *arguments)
{
    if (arguments)
        members_free(kind->members, arguments);
    free(arguments);
}

void event_encode(struct event_bytes *b, const struct event_kind *kind, const void *arguments,
                  const void *context)
{
    struct event_stream s = {.out = b, .context = context};
    event_pass_members(&s, kind->members, members_owned(arguments));
}

enum event_decoded event_decode(const uint8_t *bytes, size_t count,
                                const struct event_kind *kind, const void *context,
                                void **arguments)
{
    struct event_reader r = {bytes, bytes + count, false};
    struct event_stream s = {.in = &r, .context = context};
    void *made = NULL;
    *arguments = NULL;
    if (kind->members->count > 0) {
        made = event_blank(kind);
        if (!made)
            return EVENT_NO_MEMORY;
        event_pass_members(&s, kind->members, made);
    }
    if (s.short_of_memory || r.bad || r.at != r.end) {
        event_free(kind, made);
        return s.short_of_memory ? EVENT_NO_MEMORY : EVENT_DAMAGED;
    }
    *arguments = made;
    return EVENT_DECODED;
}

size_t event_size(const struct event_kind *kind)
{
    size_t size = 0;
    for (size_t i = 0; i < kind->members->count; i++) {
        const struct member *m = &kind->members->first[i];
        bool byte = m->kind == MEMBER_FLAG || m->kind == MEMBER_TEXT;
        size += (size_t)m->count * (byte ? 1 : 8);
    }
    return size;
}
