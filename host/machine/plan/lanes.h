/* lanes.h - kernels in lanes of 8 or 16 bits. */
#ifndef LUTETIA_MACHINE_LANES_H
#define LUTETIA_MACHINE_LANES_H

#include "plan/plan.h"

enum { LANE_WIDE = 32 }; /* bits */

/* Bits of the lanes that a node's number fits, if it can be computed there, or loaded. */
int lanes_of_node(const struct plan_graph *g, int node, bool loaded);
/* Bits of the lanes that a kernel can have which stores these. stage: what earlier ones store
 * is loaded; -1: all stages are in it. */
int lanes_of_kernel(const struct plan_graph *g, const int *stores, int count, int stage);

#endif
