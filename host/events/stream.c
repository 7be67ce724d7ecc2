/* stream.c - see stream.h. */
#include "stream.h"

#include <stdlib.h>
#include <string.h>

uint64_t event_pass_number(struct event_stream *s, uint64_t number, int bytes)
{
    if (s->in)
        return event_get_number(s->in, bytes);
    event_put_number(s->out, number, bytes);
    return number;
}

void event_stream_expect(struct event_stream *s, bool good)
{
    if (s->in && !good)
        s->in->bad = true;
}

bool event_stream_good(const struct event_stream *s)
{
    return !s->in || (!s->in->bad && !s->short_of_memory);
}

void event_pass_int(struct event_stream *s, int *at, int64_t least, int64_t most)
{
    int64_t number = (int64_t)event_pass_number(s, (uint64_t)(int64_t)*at, 8);
    event_stream_expect(s, number >= least && number <= most);
    if (s->in)
        *at = s->in->bad ? 0 : (int)number;
}

void event_pass_flag(struct event_stream *s, bool *at)
{
    bool flag = event_pass_number(s, *at, 1) != 0;
    if (s->in)
        *at = flag;
}

void event_pass_words(struct event_stream *s, void *words, int count)
{
    for (int i = 0; i < count; i++) {
        uint64_t word;
        char *at = (char *)words + (size_t)i * sizeof word;
        memcpy(&word, at, sizeof word);
        word = event_pass_number(s, word, 8);
        if (s->in)
            memcpy(at, &word, sizeof word);
    }
}

void event_pass_text(struct event_stream *s, char *text, size_t size)
{
    if (!s->in) {
        event_put_bytes(s->out, text, size);
        return;
    }
    const uint8_t *bytes = event_get_bytes(s->in, size);
    event_stream_expect(s, bytes && memchr(bytes, '\0', size));
    if (!s->in->bad)
        memcpy(text, bytes, size);
}

/* Arrays of floats are kept as they are: low byte first here and on every machine this runs
 * on. */
_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "low byte first");
void *event_pass_array(struct event_stream *s, const void *array, size_t size)
{
    if (!s->in) {
        event_put_bytes(s->out, array, size);
        return members_owned(array);
    }
    const uint8_t *bytes = event_get_bytes(s->in, size);
    void *made = bytes ? malloc(size ? size : 1) : NULL;
    if (made)
        memcpy(made, bytes, size);
    else if (bytes)
        s->short_of_memory = true;
    return made;
}

static void member_pass(struct event_stream *s, const struct member *m, void *of)
{
    void *start = (char *)of + m->offset;
    switch (m->kind) {
    case MEMBER_DOUBLE:
    case MEMBER_WORD:
        event_pass_words(s, start, m->count);
        break;
    case MEMBER_INT:
        for (int i = 0; i < m->count; i++)
            event_pass_int(s, (int *)start + i, INT32_MIN, INT32_MAX);
        break;
    case MEMBER_FLAG:
        for (int i = 0; i < m->count; i++)
            event_pass_flag(s, (bool *)start + i);
        break;
    case MEMBER_TEXT:
        event_pass_text(s, start, (size_t)m->count);
        break;
    case MEMBER_FORM:
        m->form->pass(s, start, of);
        break;
    }
}

void event_pass_members(struct event_stream *s, const struct members *members, void *of)
{
    for (size_t i = 0; i < members->count && event_stream_good(s); i++)
        member_pass(s, &members->first[i], of);
}
