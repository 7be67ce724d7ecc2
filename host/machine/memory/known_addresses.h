/* known_addresses.h - what is known of addresses: of those that messages have gone by more than
 * once, and of those made of ranks.
 *
 * A value never changes, so what was found of it stays true. An index for each address is kept,
 * and what has been found of these; of one value, the last that two sends in a row went by. */
#ifndef LUTETIA_MACHINE_KNOWN_ADDRESSES_H
#define LUTETIA_MACHINE_KNOWN_ADDRESSES_H

#include "values/values.h"

struct known_addresses {
    const void *seen; /* the array of the last send's addresses; not held, only compared */
    int seen_set;
    struct machine_value *address, *index; /* held, in memory; NULL: none */
    int set;                               /* that they are addresses of */
    int uses;
    bool there;    /* each is the index of a processor, in all processors */
    bool distinct; /* no two are the same */
};

/* What is known of these addresses of that set; NULL: nothing. */
struct known_addresses *known_addresses_find(struct machine *m,
                                             const struct machine_value *address, int set);
/* A send goes by them, and the index of each is in memory. True: for the second time in a row,
 * so they are kept. */
bool known_addresses_note(struct machine *m, struct machine_value *address, int set,
                          struct machine_value *index);
void known_addresses_forget(struct machine *m);

/* Gets by addresses that are in memory: where each one's element is, which takes some thirty
 * operations for each processor, is kept in memory when so many have gone by them. Of some
 * addresses: a grid that is part of several has a field of them for each. */
enum { KNOWN_PLACES = 8, KNOWN_PLACES_FROM = 8 };

struct known_place {
    const void *seen; /* the addresses' array; not held, only compared */
    int set;          /* that they are addresses of */
    uint32_t gets;    /* by them, so far */
    uint64_t used;    /* when the last of them came by: a number that goes up with each get */
    struct machine_value *address, *place; /* held, in memory; NULL: none */
};
struct known_places {
    struct known_place of[KNOWN_PLACES];
    uint64_t gets;
};

/* A get goes by these addresses. Where the elements are; NULL: nobody has kept it. */
struct machine_value *known_places_get(struct machine *m, const struct machine_value *address,
                                       int set);
/* Whether so many gets have gone by them that it should be kept. */
bool known_places_wanted(const struct machine *m, const struct machine_value *address, int set);
void known_places_keep(struct machine *m, struct machine_value *address, int set,
                       struct machine_value *place);
void known_places_forget(struct machine *m);

/* The last enumeration of a context: each active processor's rank among these, from 0 on; and
 * the addresses that were made of the ranks. A send by these puts the messages of the active
 * processors one after the other. */
struct known_ranks {
    struct machine_value *rank, *context; /* held; NULL: none */
    struct machine_value *address;        /* held; NULL: none was made */
    struct machine_layout layout;         /* by which it was */
};

void known_ranks_note(struct machine *m, struct machine_value *rank,
                      struct machine_value *context);
/* Whether a send by these addresses, in the current set under its present context, and to that
 * set, is by ranks. */
bool known_ranks_are(const struct machine *m, const struct machine_value *address, int set);
void known_ranks_forget(struct machine *m);

/* This array is written over: what is known of it is forgotten. Two values may share an
 * array. */
void known_addresses_changed(struct machine *m, const struct device_buffer *b);

#endif
