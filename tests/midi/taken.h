/* taken.h - keeps the messages that a parser or a filter gives, so that they can be
 * compared. */
#ifndef LUTETIA_TESTS_MIDI_TAKEN_H
#define LUTETIA_TESTS_MIDI_TAKEN_H

#include <midi_message.h>

#include <stdlib.h>

struct taken {
    struct midi_message *messages;
    size_t count, room;
};

static inline void taken_add(void *context, const struct midi_message *m)
{
    struct taken *t = context;
    if (t->count == t->room) {
        t->room = t->room ? 2 * t->room : 64;
        t->messages = realloc(t->messages, t->room * sizeof *t->messages);
        if (!t->messages)
            abort();
    }
    t->messages[t->count++] = *m;
}

static inline void taken_finish(struct taken *t)
{
    free(t->messages);
    *t = (struct taken){0};
}

static inline bool taken_equal(const struct taken *a, const struct taken *b)
{
    bool equal = a->count == b->count;
    for (size_t i = 0; equal && i < a->count; i++)
        equal = midi_message_equal(&a->messages[i], &b->messages[i]);
    return equal;
}

#endif
