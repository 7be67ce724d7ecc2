/* spreads.h - spreads of a line as values: what every line reads is not made an array of the
 * whole set. */
#ifndef LUTETIA_MACHINE_SPREADS_H
#define LUTETIA_MACHINE_SPREADS_H

#include "values/values.h"

/* The value of the processor at that coordinate along an axis; of the one at that row-major
 * index; of the current set. NULL: it must become an array, and there is no error, or there is
 * one. */
struct machine_value *spreads_axis(struct machine *m, int axis, int coordinate,
                                   struct machine_value *v);
struct machine_value *spreads_index(struct machine *m, uint64_t index, struct machine_value *v);

#endif
