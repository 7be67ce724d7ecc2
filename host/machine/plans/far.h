/* far.h - a division's portion in blocks, on ranks: rank 0 sends its drafts once, and then what
 * differs from run to run.
 *
 *     PLAN 3     drafts, targets
 *     RUN 3      by draft: a leaf's array, or a number's bits; by target: the new array
 *     RUN 3      ...
 *
 * A rank makes the same portion of it, whose plan it finds, runs and makes better as rank 0
 * does with its own: by the time that it takes there. */
#ifndef LUTETIA_MACHINE_PLANS_FAR_H
#define LUTETIA_MACHINE_PLANS_FAR_H

#include "device/far.h"
#include "plans/division.h"

/* ---- division_far.c: rank 0 ---- */

void division_far_plan(struct division *d);
void division_far_prepare(const struct division *d, enum plan_use use);
void division_far_forget(struct division *d);
/* One block's run. local: by draft, the leaves' arrays; out: by target, arrays without memory,
 * which the rank gets. */
void division_far_run(const struct division *d, int block, struct device_buffer *const *local,
                      struct device_buffer *const *out);

/* ---- portion_far.c: other ranks ---- */

struct far_portion {
    struct portion portion;
    struct device_buffer stand_in;
    struct device_buffer **local; /* by draft */
    bool *kept;
};

/* NULL: the bytes are no portion. */
struct far_portion *portion_far_make(struct machine *m, const void *bytes, size_t count);
void portion_far_free(struct far_portion *p);
void portion_far_prepare(struct far_portion *p, enum plan_use use);
/* Performs a run's words, with the arrays that the table has, which gets the results. False:
 * they are no run of it; or an error is set. */
bool portion_far_run(struct machine *m, struct far_portion *p, struct far_table *arrays,
                     const uint64_t *words, size_t count);

/* ---- both ---- */

struct far_draft {
    uint8_t op, is, axis, maybe_nan;
    struct machine_type type;
    int32_t set, detail, in[3]; /* in: drafts; -1: none */
    uint64_t low, high;
};
struct far_head {
    uint32_t drafts, targets;
};

#endif
