/* narrow.h - kernels in narrow lanes: see narrow.c. */
#ifndef LUTETIA_MACHINE_NARROW_H
#define LUTETIA_MACHINE_NARROW_H

#include "internal.h"

enum { LANE_WIDE = 32 }; /* bits */

/* Bits of the lanes that a node's number fits, if it can be computed there, or loaded. */
int narrow_lane_of(const struct plan_graph *g, int node, bool loaded);
/* Bits of the lanes that a kernel can have which stores these. stage: what earlier ones store is
 * loaded; -1: all stages are in it. */
int narrow_lane(const struct plan_graph *g, const int *stores, int count, int stage);
/* An operation of such a kernel, of variables. */
void narrow_spell(char *out, size_t size, const struct plan_graph *g, const struct plan_node *n,
                  int lane, const char *a, const char *b, const char *c);

#endif
