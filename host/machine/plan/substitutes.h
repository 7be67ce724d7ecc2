/* substitutes.h - see substitutes.c. */
#ifndef LUTETIA_MACHINE_SUBSTITUTES_H
#define LUTETIA_MACHINE_SUBSTITUTES_H

#include "plan/plan.h"

/* Where select(c, x, old) is stored, x itself need not be for those who look at it only where c
 * holds. Looked at only where c holds is what is used only for the first branch of selects by
 * c. */
void substitutes_find(struct plan_graph *g);

#endif
