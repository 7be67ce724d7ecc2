/* plans_compared.c - see plans_compared.h. */
#include "plan/plans_compared.h"

#include "plan/search_cost.h"

void plan_compared(struct plan_graph *g, enum machine_plan_way way, double ns)
{
    if (ns < IMPOSSIBLE)
        g->considered.cost_s[way] = 1e-9 * ns;
    if (way == MACHINE_PLAN_ROWS)
        g->considered.chosen = way;
}
