/* kinds.h - what events there are: a row of a module's table names a kind and says of what its arguments consist.
 *
 * The module's row begins with a struct event_kind and goes on with what the event does, which is the module's alone:
 *
 *     static const struct {
 *         struct event_kind kind;
 *         enum my_status (*perform)(struct my_thing *, const void *arguments);
 *     } rows[] = {[MY_PUSH] = {{"push", "a push's ", sizeof(struct my_push), &push_members}, thing_push}, ...};
 */
#ifndef LUTETIA_EVENTS_KINDS_H
#define LUTETIA_EVENTS_KINDS_H

#include "bytes.h"
#include "members.h"

struct event_kind {
    const char *name;  /* in files: never changed */
    const char *whose; /* goes before its members' names in messages: "a push's ", or "" */
    size_t size;       /* of its arguments; 0: it has none */
    const struct members *members;
};

/* Arguments that are all 0, and so is what they will point to. NULL: no memory. */
void *event_blank(const struct event_kind *kind);
/* NULL is fine. */
void event_free(const struct event_kind *kind, void *arguments);

/* Appends the arguments. `context` is for the module's forms. */
void event_encode(struct event_bytes *b, const struct event_kind *kind, const void *arguments,
                  const void *context);

enum event_decoded { EVENT_DECODED, EVENT_DAMAGED, EVENT_NO_MEMORY };
/* All bytes must be the arguments'. *arguments is NULL for kinds without any, and where it fails. Owns: the caller frees *arguments
 * by event_free(). */
enum event_decoded event_decode(const uint8_t *bytes, size_t count,
                                const struct event_kind *kind, const void *context,
                                void **arguments);
/* Bytes of arguments that have only numbers, flags and text. */
size_t event_size(const struct event_kind *kind);

#endif
