/* search_cost.h - the search for a plan, and the cost of a choice: see choose.c. */
#ifndef LUTETIA_MACHINE_COST_H
#define LUTETIA_MACHINE_COST_H

#include "plan/plan.h"
#include "plan/tiles.h"

#define IMPOSSIBLE 1e300 /* an initial cost, above that of any plan */

enum { LIGHT = 8, EVALUATIONS_MAX = 1200, OFFSETS_MAX = 512 };

struct visit {
    uint32_t stamp;
    int32_t node;
    int32_t offset;
};

/* What the search asks of a node again and again; no choice changes it. */
struct search_node {
    uint8_t inputs; /* 0: of a leaf or a number, too */
    uint8_t bytes;  /* of an element in memory */
    uint8_t lane_computed, lane_loaded;
    int32_t operations; /* where it is computed */
};

/* Stored nodes, stage after stage; of a stage in the order of the graph. */
struct stage_lists {
    int *nodes;
    int *begins; /* of a stage, and of the one behind the last */
};

struct search {
    struct plan_graph *g;
    const struct vpset *sets;
    const struct device_shape *shape;
    bool *barrier; /* of shift nodes, and of crosses */
    bool *light;   /* never stored: computed wherever it is needed */
    int *earliest;
    struct search_node *facts;
    int *computed, computed_count; /* nodes that are neither leaves nor numbers */
    int *shifts, shifts_count;     /* ... and shifts */
    int *crossed, crossed_count;   /* ... and looked at by a cross */
    struct stage_lists stages;
    int *loaded, loads_stamp; /* stamp: counted in this kernel's bytes already */
    struct visit *visits;
    uint32_t visits_size, stamp, visits_count;
    /* offsets met: vectors of rank numbers */
    int (*offsets)[MACHINE_AXES_MAX];
    int offsets_count;
    bool strips; /* all stages in one kernel */
    bool tiles;  /* ... of tiles */
    struct tiling tiling;
    int *array; /* of a node that is stored: in the tiling */
    /* loads_stamp then: what has a later one was loaded by some stage already */
    int cost_began;
    bool first;                           /* the first plan is taken, whatever it costs */
    double operations, bytes, near_bytes; /* near: of rings */
    int lane;                             /* the widest that the kernel needs; bits */
    bool too_much;
    bool decided; /* this is the plan: what its kernels cost is kept */
};

/* Begins and ends a search over a graph whose substitutes are known. */
void search_begin(struct search *s);
void search_finish(struct search *s);
/* Assigns stages and stored values, for the present barriers. Returns the last stage. */
int cost_assign(struct search *s);
double cost_of(struct search *s);

#endif
