/* roll.h - rolls up loops over slices: see alias/reshape.h. The rolled-up value is computed
 * at once. */
#ifndef LUTETIA_MACHINE_ROLL_H
#define LUTETIA_MACHINE_ROLL_H

#include "machine.h"
#include "run/evaluation.h"

/* The value of the finer set whose k slices these are, computed; NULL: none can be had
 * without a kernel. False: error set. */
bool roll_lift(struct machine *m, struct machine_value *const *y, uint32_t k, int set,
               enum run_why why, struct machine_value **whole);
/* Finds loops over the elements of a processor among the pending values of fields, and
 * computes each as one value. *partial: some loops have only begun. */
bool roll_waiting(struct machine *m, enum run_why why, bool *partial);

#endif
