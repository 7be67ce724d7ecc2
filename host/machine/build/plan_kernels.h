/* plan_kernels.h - plans kept: see run.c, which looks for them. */
#ifndef LUTETIA_MACHINE_PLAN_KERNELS_H
#define LUTETIA_MACHINE_PLAN_KERNELS_H

#include "internal.h"

/* The nodes that are reached from the targets, inputs before users; and a number for each and what it is made of: what
 * two evaluations that have the same plan have in common. */
struct reach {
    struct machine_value **nodes; /* inputs before users */
    uint32_t *signature;
    int count, capacity;
    uint32_t length;
    int signature_capacity;
};

struct targets {
    struct machine_value **values;
    int count, capacity;
};

/* The plan for them: a new one, or one seen before, with better kernels where those are due. NULL: error set. */
struct plan *plan_get(struct machine *m, const struct reach *r, const struct targets *t);

#endif
