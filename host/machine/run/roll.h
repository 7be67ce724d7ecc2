/* roll.h - loops over slices rolled up again: see alias/reshape.h. What has been rolled up is computed at once. */
#ifndef LUTETIA_MACHINE_ROLL_H
#define LUTETIA_MACHINE_ROLL_H

#include "machine.h"
#include "run/evaluate.h"

/* The one value of the finer set whose k slices these are, computed; NULL: there is none to be had for
 * nothing. False: error set. */
bool roll_lift(struct machine *m, struct machine_value *const *y, uint32_t k, int set,
               enum run_why why, struct machine_value **whole);
/* Finds loops over the elements of a processor among what waits in fields, and computes each as one value.
 * *partial: there are some that have only begun. */
bool roll_waiting(struct machine *m, enum run_why why, bool *partial);

#endif
