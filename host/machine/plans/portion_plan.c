/* portion_plan.c - the plan of a portion: see division.h. */
#include "plans/division.h"

/* A portion's nodes are not numbered as the program's are: its kernels are described without
 * the fields that they store to. */
struct plan *portion_plan(struct portion *g, enum plan_use use)
{
    explained_nodes(g->machine, NULL, NULL, 0, NULL);
    const struct plan_request q = {.reach = &g->reach, .targets = &g->targets, .use = use};
    g->plan = plan_get(g->machine, &q);
    return g->plan;
}
