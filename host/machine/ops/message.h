/* message.h - what a send, a get or a check of addresses reads, and how the front end performs
 * it by itself. */
#ifndef LUTETIA_MACHINE_MESSAGE_H
#define LUTETIA_MACHINE_MESSAGE_H

#include "memory/memory.h"
#include "ops/near_router.h"

struct message {
    const struct vpset *from, *to;
    int from_set, to_set;
    struct machine_value *address, *source, *old, *context;
    bool flat; /* see -DFLAT */
    bool over; /* old's array may be written over */
    bool all;  /* the context is 1 everywhere */
    bool
        fills; /* each processor gets a message: old is not needed, and need not be in memory */
    uint32_t mask;
    struct known_addresses *known; /* of the addresses; NULL: nothing is */
};

/* Puts everything that a router operation reads into memory, by one evaluation; arrays may be
 * in blocks only: see all_to_all_arrange(). source and other may be NULL, the context need not
 * be wanted. */
bool message_make(struct machine *m, struct message *g, struct machine_value *address,
                  struct machine_value *source, int source_set, struct machine_value *other,
                  int to_set, bool under_context, bool combines);
/* Whether it is known that a send by these addresses of the current set's, under its present
 * context, leaves nothing of what was there: there is a message for each processor. */
bool message_fills(struct machine *m, struct machine_value *address, int to_set);
/* A new array for a value of that set. */
struct device_buffer *message_array(struct machine *m, const struct vpset *s,
                                    struct machine_type type);
/* Whether nobody but that field looks at the old content, and no message is read from its
 * array. */
bool message_over(const struct machine *m, const struct message *g, const struct field *f,
                  uint32_t offset);
/* Whether the front end does it by itself. Places in arrays of the set are numbers of 32 bits
 * then. */
bool message_near(struct machine *m, const struct vpset *to, const struct device_buffer *b,
                  double *start);
/* shares: each part passes all senders. */
struct near_route message_route(const struct machine *m, const struct message *g, bool shares);
/* A send by ranks to the same set (known_ranks_are()): the messages go one after the other.
 * source and old are contents of fields, not yet computed perhaps. NULL: it cannot be done so,
 * or there is an error. */
struct machine_value *message_pack(struct machine *m, struct machine_value *source,
                                   struct machine_value *old);
/* On the front end's own thread. out: old's array, or another. */
enum machine_status message_send_near(struct machine *m, const struct message *g,
                                      enum machine_combiner combiner, struct device_buffer *out,
                                      size_t bytes, double start,
                                      struct machine_value **notification);

#endif
