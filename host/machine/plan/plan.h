/* plan.h - what a plan decides: see choose.c. */
#ifndef LUTETIA_MACHINE_PLAN_H
#define LUTETIA_MACHINE_PLAN_H

#include <stdatomic.h>

#include "machine_explained.h"
#include "values/geometry.h"

struct plan_node {
    uint8_t op;
    struct machine_type type;
    uint8_t axis;
    uint8_t generator;
    bool maybe_nan;
    bool leaf;     /* a buffer */
    bool constant; /* an argument */
    bool target;
    uint16_t set;
    int32_t detail;
    int32_t in[3];
    int32_t instead[3]; /* another node that may replace in[k] here, if it is in memory; else
                         * -1 */
    /* decided */
    int stage;
    bool stored;
    double kernel_ns; /* of a stored one, but in strips: what its kernel takes, by the model */
};

struct plan_graph {
    struct plan_node *nodes; /* inputs before users */
    int count;
    bool boxes;     /* write kernels that distinguish inside and outside of boxes: see
                     * codegen/body.c */
    bool strips;    /* decided: all stages in one kernel, see strips.h and tiles.h */
    bool no_strips; /* but not so */
    int turns_most; /* turns of a loop in one kernel; 1: more are impossible, or do not pay */
    double cost_ns; /* of one run, by the model */
    struct machine_explained_plan considered;
    const atomic_bool
        *stop; /* NULL, or: once this is true the choice does not matter any more */
};

void plan_choose(struct plan_graph *g, const struct vpset *sets,
                 const struct device_shape *shape);

/* Whether a kernel of that stage finds the node in memory: a leaf, or stored by an earlier
 * stage. */
static inline bool plan_loads(const struct plan_node *n, int stage)
{
    return n->leaf || (n->stored && n->stage < stage);
}

/* The node that a kernel of that stage uses as operand k of node n. */
static inline int plan_input(const struct plan_graph *g, const struct plan_node *n, int k,
                             int stage)
{
    int instead = n->instead[k];
    return instead >= 0 && plan_loads(&g->nodes[instead], stage) &&
                   !plan_loads(&g->nodes[n->in[k]], stage)
               ? instead
               : n->in[k];
}

static inline void widen(int *have, int wanted)
{
    *have = wanted > *have ? wanted : *have;
}

#endif
