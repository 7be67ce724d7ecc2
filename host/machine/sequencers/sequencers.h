/* sequencers.h - large VP sets are cut into blocks, one for each sequencer.
 *
 * A set is cut along its first axis into as many blocks as there are sequencers, each of whole
 * planes: what lies at one place of the first axis, which is a row of a sheet, and one
 * processor of a set with one axis. A sequencer's array has its block's planes, and ghost
 * planes on both sides, which repeat its neighbours':
 *
 *     an array in one piece        0 1 2 3 4 5 6 7 8 9
 *     in two blocks                8 9 0 1 2 3 4 5 6        3 4 5 6 7 8 9 0 1        two ghosts on both sides
 *                                  ghosts              ghosts
 *
 * To the machine of the sequencers such an array is one of an ordinary VP set of that height,
 * whose last plane is beside its first. So whatever runs there computes the ghosts, too, and
 * what it computes from planes that are not beside each other is wrong: after a plan that looks
 * n planes far, n ghosts more on each side. So each array knows how many of its ghosts are
 * valid, and a plan that looks further has them fetched first.
 *
 * Nothing else follows from how a plan is run: in byte code, in rows, strips or tiles, or many
 * turns at once. */
#ifndef LUTETIA_MACHINE_SEQUENCERS_H
#define LUTETIA_MACHINE_SEQUENCERS_H

#include "values/values.h"

enum { BLOCKS_MOST = 64 };

/* How a VP set is cut. */
struct cut {
    uint16_t generation; /* of the set that it is of; 0: not known yet */
    bool is;             /* it is cut; else it is whole everywhere */
    int ghosts;          /* planes on each side */
    uint64_t length;     /* planes of the set */
    uint64_t height;     /* of each block's arrays: of the largest block, with its ghosts */
    uint64_t first[BLOCKS_MOST +
                   1]; /* planes: where a block begins; its end is the next one's beginning */
};

struct sequencers {
    int count;
    /* Its VP sets are blocks, with the ids of the front end's. It has plans, and neither fields
     * nor a graph. */
    struct machine *machine;
    struct cut *cuts; /* by set */
    int cuts_count;
    /* Plans run in blocks, each by all; arrays put into blocks, and together again; arrays
     * whose ghosts were fetched. */
    uint64_t run, divided, gathered, exchanged;
};

/* ---- cuts.c ---- */

/* How the set is cut; NULL: it is not. */
const struct cut *sequencers_cut(struct machine *m, int set);
/* The plane of the whole set that is the first of a block's array: a ghost. */
uint64_t cut_first(const struct cut *c, int block);

/* ---- arrays.c ---- */

/* A new array in blocks, without memory yet: sequencers_array_gets() gives each block what it
 * has. refs 1; NULL: error set. */
struct device_buffer *sequencers_array(struct machine *m, int set, struct machine_type type);
void sequencers_array_gets(struct device_buffer *b, int block, struct device_buffer *memory);
/* Makes an array of that set one in blocks, too, with so many valid ghosts at least. */
enum machine_status sequencers_divide(struct machine *m, struct device_buffer *b, int set,
                                      struct machine_type type, int ghosts);
/* Puts an array together again, if it is in blocks only: whoever looks at it without knowing
 * about blocks can. */
enum machine_status sequencers_whole(struct machine *m, struct device_buffer *b);

#endif
