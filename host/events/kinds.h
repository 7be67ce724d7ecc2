/* kinds.h - kinds of events: a row of a module's table names a kind and describes its
 * arguments.
 *
 * The module's row begins with a struct event_kind and goes on with what the event does, which
 * is the module's alone:
 *
 *     static const struct {
 *         struct event_kind kind;
 *         enum my_status (*perform)(struct my_thing *, const void *arguments);
 *     } rows[] = {[MY_PUSH] = {{"push", "a push's ", sizeof(struct my_push), &push_members}, thing_push},
 * ...}; */
#ifndef LUTETIA_EVENTS_KINDS_H
#define LUTETIA_EVENTS_KINDS_H

#include "bytes.h"
#include "members.h"

struct event_kind {
    const char *name;  /* the kind's name in files: never changed */
    const char *whose; /* prefix of the members' names in messages: "a push's ", or "" */
    size_t size;       /* size of the arguments; 0: there are none */
    const struct members *members;
};

/* Allocates arguments that are all 0. NULL: no memory. */
void *event_blank(const struct event_kind *kind);
/* NULL is fine. */
void event_free(const struct event_kind *kind, void *arguments);

/* Appends the arguments. `context` is for the module's forms. */
void event_encode(struct event_bytes *b, const struct event_kind *kind, const void *arguments,
                  const void *context);

enum event_decoded { EVENT_DECODED, EVENT_DAMAGED, EVENT_NO_MEMORY };
/* Decodes the arguments; all bytes must be used. *arguments is NULL for kinds without
 * arguments, and on failure. Owns: the caller frees *arguments by event_free(). */
enum event_decoded event_decode(const uint8_t *bytes, size_t count,
                                const struct event_kind *kind, const void *context,
                                void **arguments);
/* Length of the encoded arguments, for kinds with only numbers, flags and text. */
size_t event_size(const struct event_kind *kind);

#endif
