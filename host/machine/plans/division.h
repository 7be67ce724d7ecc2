/* division.h - a plan in two portions: what the sequencers compute, each for its block, and
 * what is computed in one piece.
 *
 *     a request's targets      a  b  c  d                   b: its set is not cut; d: it looks further than there are ghosts
 *     in blocks                a  c        a plan of the sequencers' machine, which each sequencer runs with its arrays
 *     in one piece             b  d        a plan of the front end's machine; arrays that are in blocks are gathered
 *
 * Each portion has a graph of its own, whose nodes are drafts: copies of the request's nodes.
 * In blocks a processor's place is another one than in the whole set, so what is made of it
 * there is another expression, of the place in the block and of a number, which is where the
 * block begins:
 *
 *     coordinate (0)         wrapped (coordinate (0) + first)            wrapped (x): x -
 *                            length, unless that is below 0
 *     index, send_address    likewise, of index + first x processors of a plane
 *     random                 of that index, in integer operations: the same bits
 *
 * A portion's plan is found by its signature, like any. So whether it is interpreted or has
 * which kernels is decided where it runs. */
#ifndef LUTETIA_MACHINE_DIVISION_H
#define LUTETIA_MACHINE_DIVISION_H

#include "plans/plans.h"
#include "sequencers/sequencers.h"

/* What a draft's array or number is. */
enum draft_is {
    DRAFT_MADE,   /* an operation, or a number that is always the same */
    DRAFT_LEAF,   /* the request's array */
    DRAFT_NUMBER, /* the request's number */
    DRAFT_LOW,    /* the low word of it, and the high one */
    DRAFT_HIGH,
    DRAFT_FIRST /* where the block begins, times a number */
};

struct draft_from {
    uint8_t is;
    int node; /* of the request */
    uint64_t times;
};

struct portion {
    struct machine *machine; /* whose plans it has */
    struct reach reach;      /* its drafts */
    struct draft_from *from; /* of each */
    int from_capacity;
    struct targets targets;
    int *target_nodes; /* of the request, of each target */
    struct plan *plan; /* as it was last found; NULL: not known */
};

struct division {
    uint32_t far; /* what ranks call the portion in blocks; 0: there are none */
    /* without targets: there is nothing of that kind. Of blocks there is one for each
     * sequencer's machine. */
    struct portion *blocks, whole;
    int blocks_count;
    int *reaches; /* of a target in blocks: how many planes far it looks */
    int *needs;   /* of a VP set: ghosts that arrays must have */
    int needs_count;
    /* of the same, one after the other, which look no further than there are ghosts */
    int turns_most;
    struct device_buffer stand_in; /* a leaf's array while nothing runs */
};

/* ---- portions.c ---- */

/* One more draft, whose operands are there. */
struct machine_value *portion_draft(struct portion *g, struct machine_value key,
                                    struct draft_from from);
void portion_free(struct portion *g); /* what it has */

/* ---- portion_plan.c ---- */

/* NULL: as plan_get(). */
struct plan *portion_plan(struct portion *g, enum plan_use use);

/* ---- division_graph.c ---- */

/* How a request is divided. NULL: nothing of it can be computed in blocks, or there is no
 * memory (and an error). */
struct division *division_make(struct machine *m, const struct plan_request *q);
void division_free(struct division *d);
/* The portions' plans are gone, perhaps. */
void division_forget_plans(struct division *d);
/* What sequencers run. NULL: nothing, or it is not known; or something is computed in one
 * piece, too. */
const struct plan *division_in_blocks(const struct plan *p);

/* ---- division.c ---- */

/* As plan_get() and plan_run(), where there are sequencers. */
struct plan *division_get(struct machine *m, const struct plan_request *q);
enum machine_status division_run(struct machine *m, struct plan *p,
                                 struct device_buffer **buffers,
                                 struct machine_value *const *nodes, const struct fates *fates);

#endif
