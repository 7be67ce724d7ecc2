/* exchange.h - what sends and gets between blocks have in common in one process and on ranks:
 * all_to_all.c, all_to_all_far.c. */
#ifndef LUTETIA_MACHINE_EXCHANGE_H
#define LUTETIA_MACHINE_EXCHANGE_H

#include "ops/message.h"

/* A block's own part of a set, or a set that is not cut. */
struct share {
    struct vpset set;
    size_t skip;    /* elements of its arrays before its first row */
    uint64_t first; /* the index in the whole set of its first processor */
};

/* From one share to another, in the order of the senders. */
struct mail {
    size_t count, room;
    uint32_t *index; /* in the share that it goes to */
    uint32_t *place; /* of a get: where the element is wanted, in the getter's array */
    char *elements;
};

/* What messages of a share are sorted by. */
struct sender {
    struct share share;
    struct device_buffer address, context; /* only where these are for the front end */
    struct near_route route;               /* to the whole set */
    const char *source;
};

struct exchange {
    const struct message *g;
    enum machine_combiner combiner;
    bool gets;
    const struct machine_value *same; /* the number that all send; NULL: elements travel */
    size_t bytes;                     /* of an element */
    struct device_buffer *out, *arrived;
    struct crew *crew;       /* NULL: there is too little work to be shared out */
    struct near_route route; /* that all have in common */
    int senders_count, takers_count;
    struct sender *senders;
    struct share *takers;
    struct mail *mail; /* from sender i to taker k: [i * takers_count + k] */
    atomic_bool beyond, failed;
};

/* Where a share's first row is in an array of its set, of which it is block i. NULL: another
 * rank has it. */
char *exchange_host(const struct device_buffer *b, const struct share *s, int i,
                    size_t element);
/* The work of a sender or a taker: for crew_run(). Mail is made of what a sender sends or
 * wants; a taker puts what is sent into `out`, or answers; a sender takes the answers. */
void exchange_sort(void *of, int part, int worker);
void exchange_deliver(void *of, int part, int worker);
void exchange_answer(void *of, int part, int worker);
void exchange_take(void *of, int part, int worker);
/* Its mail, senders and takers. */
void exchange_free(struct exchange *e);

#endif
