/* gets.h - gets as operations of the graph: what they fetch is computed in the kernel of
 * whatever needs it, for each lane. */
#ifndef LUTETIA_MACHINE_GETS_H
#define LUTETIA_MACHINE_GETS_H

#include "values/values.h"

/* Whether a get of that value of a set is an operation. Where each instruction is executed by
 * itself it is not: kernels that fetch are at hand. */
bool gets_can(const struct machine *m, const struct machine_value *source, int set);
/* Whether each processor's address of the current set is its own but for some bits. *bits:
 * those of the index. */
bool gets_turned(struct machine *m, struct machine_value *address, int set, uint32_t *bits);
/* Whether functions such as sines have to be computed for a value, or so much that nobody
 * looks. Byte code has no loops for them, so they had better become kernels soon; gets at other
 * distances are the same plan, crosses are not. */
bool gets_has_functions(struct machine *m, struct machine_value *v);
/* What the processors of the current set get of those of a set, source in memory. NULL: error
 * set. */
struct machine_value *gets_node(struct machine *m, struct machine_value *address,
                                struct machine_value *source, int set);
/* Likewise, in the way that is cheapest for these addresses: a cross (values/places.h), a
 * choice of two neighbours, or gets_node(). */
struct machine_value *gets_made(struct machine *m, struct machine_value *address,
                                struct machine_value *source, int set);

#endif
