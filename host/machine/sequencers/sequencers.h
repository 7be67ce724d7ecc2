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

enum { BLOCKS_MOST = 64, SEQUENCERS_ARRAYS = 6 };

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
    /* Their VP sets are blocks, with the ids of the front end's. They have plans, and neither
     * fields nor a graph. One for each block, with a share of the device's compute units, where
     * these are enough; else one for all, with the front end's device. */
    struct machine *machines[BLOCKS_MOST];
    int machines_count;
    /* Block i is in the memory of rank i, which computes it. Here are the front end and block
     * 0, with one machine. far_near: all see their blocks' arrays, and compute with them
     * themselves, as byte code does. */
    bool far, far_near;
    struct cut *cuts; /* by set */
    int cuts_count;
    /* Plans, and whole instructions, run in blocks, each by all; arrays put into blocks, and
     * together again; arrays whose ghosts were fetched. */
    uint64_t run, divided, gathered, exchanged;
};

/* The sets are the same in all. */
static inline const struct vpset *sequencers_set(const struct machine *m, int set)
{
    return &m->sequencers->machines[0]->values->sets[set];
}

/* ---- cuts.c ---- */

/* How the set is cut; NULL: it is not. */
const struct cut *sequencers_cut(struct machine *m, int set);
/* The plane of the whole set that is the first of a block's array: a ghost. */
uint64_t cut_first(const struct cut *c, int block);
/* The block, of so many, that has that plane, and where in its arrays. */
int cut_owner(const struct cut *c, int count, uint64_t plane, uint64_t *at);

/* ---- arrays.c ---- */

/* A block's memory, with any numbers. NULL: error set. */
struct device_buffer *sequencers_block_get(struct machine *m, int set, int block,
                                           struct machine_type type);
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

/* ---- bands.c: arrays in blocks, looked at and written without being put together ---- */

/* A block's own part of the set: a set of its own planes, and where it is. */
struct band {
    struct vpset set;
    size_t at;            /* of its first processor in the block's array, in elements */
    uint64_t row, column; /* of its first processor in the whole set, */
    uint64_t index;       /* and its index there */
};
struct band sequencers_band(struct machine *m, int set, int block);

/* An array in blocks with all ghosts: of dense numbers in row-major order; the same number
 * everywhere; a copy of an array in blocks only. refs 1; NULL: error set. */
struct device_buffer *sequencers_upload(struct machine *m, int set, struct machine_type type,
                                        const void *in);
struct device_buffer *sequencers_fill(struct machine *m, int set, struct machine_type type,
                                      const void *pattern);
struct device_buffer *sequencers_copy(struct machine *m, const struct device_buffer *b);
/* The same with any numbers. */
struct device_buffer *sequencers_array_full(struct machine *m, int set,
                                            struct machine_type type);
/* Of an array in blocks only: whose block the processor is in, in which plane of it, and where,
 * in elements. */
struct owned {
    struct device_buffer *b;
    uint64_t plane;
    size_t place;
};
struct owned sequencers_owner(struct machine *m, const struct device_buffer *b, uint64_t index);
/* One processor's number, of an array in blocks only; written, it is that of ghosts, too. */
enum machine_status sequencers_read(struct machine *m, const struct device_buffer *b,
                                    uint64_t index, void *out);
enum machine_status sequencers_write(struct machine *m, const struct device_buffer *b,
                                     uint64_t index, const void *number);

/* ---- each.c, across.c: the same work for each block; for some columns of all ---- */

/* An array that follows from others of the same set, one of them for each value (NULL: that one
 * is left out). `of` says what work it is; NULL from it: error set. */
typedef struct device_buffer *sequencers_work(struct machine *m, const struct vpset *s,
                                              struct device_buffer *const *in, const void *of);
/* Makes the values' arrays (NULL: there is none) ones in blocks, too. How many ghosts are valid
 * of each; -1: error set. */
int sequencers_divide_all(struct machine *m, int set, struct machine_value *const *values,
                          int count);
/* Whether the front end sees all blocks' arrays, and may compute with them itself. */
static inline bool sequencers_are_near(const struct machine *m)
{
    return !m->sequencers->far;
}
/* Whether some of the values' arrays are in blocks only: then all are asked for in blocks. */
bool sequencers_have_some(struct machine_value *const *values, int count);
static inline bool sequencers_have(const struct machine *m, struct machine_value *const *values,
                                   int count)
{
    return m->sequencers && sequencers_have_some(values, count);
}
static inline bool sequencers_has(const struct machine *m, const struct machine_value *v)
{
    return m->sequencers && !v->buffer->memory;
}
/* What ranks are told of the work: its kind, and what `of` has, where it has no addresses of
 * this process. */
struct sequencers_told {
    int kind;
    uint32_t bytes;
    const void *of;
};
/* Makes an array of that type in blocks, each by `work` of the block's arrays. The work looks
 * at no other plane. told: where ranks have blocks. NULL: error set. */
struct device_buffer *sequencers_each(struct machine *m, int set, struct machine_type type,
                                      struct machine_value *const *values, int count,
                                      sequencers_work *work, const void *of,
                                      const struct sequencers_told *told);
/* Of what a rank was told: its arrays' numbers, of which some are 0, and the work. */
struct each_head {
    uint64_t in[SEQUENCERS_ARRAYS];
};
/* The same of work that looks along the first axis, and at no other column: columns of all
 * blocks together are its set. Only where sequencers_can_across(). */
bool sequencers_can_across(const struct machine *m, int set);
struct device_buffer *sequencers_across(struct machine *m, int set, struct machine_type type,
                                        struct machine_value *const *values, int count,
                                        sequencers_work *work, const void *of);

#endif
