/* plans_compared.h - what `lutetia explain` says of the plans that the planner compares (struct
 * machine_explained_plan). */
#ifndef LUTETIA_MACHINE_PLANS_COMPARED_H
#define LUTETIA_MACHINE_PLANS_COMPARED_H

#include "plan/plan.h"

/* Notes what a way would cost; of those in rows the last one noted is chosen, unless strips or
 * tiles are. */
void plan_compared(struct plan_graph *g, enum machine_plan_way way, double ns);

#endif
