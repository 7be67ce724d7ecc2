/* node_loops.h - which loop performs a node of a plan, and whether its result is rounded
 * again. */
#ifndef LUTETIA_MACHINE_NODE_LOOPS_H
#define LUTETIA_MACHINE_NODE_LOOPS_H

#include "interpret/lanes.h"
#include "plan/plan.h"

/* from: the type of its first operand. NULL: none, it is done lane by lane. */
lanes_function *node_loop(const struct plan_node *n, struct machine_type from);
/* Whether the result of its loop, in doubles, is yet to be rounded to its format. */
bool node_rounds(const struct plan_node *n, struct machine_type from);

#endif
