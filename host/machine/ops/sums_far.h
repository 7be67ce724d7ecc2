/* sums_far.h - the sums of runs of a block that another rank has. */
#ifndef LUTETIA_MACHINE_SUMS_FAR_H
#define LUTETIA_MACHINE_SUMS_FAR_H

#include "device/far.h"
#include "ops/near.h"

/* Rank 0: asks for near_sums() of that rank's arrays; takes the answer, of so many runs, after
 * a flush. */
void sums_far_ask(int rank, const struct vpset *s, const struct near_sum *what, size_t run,
                  size_t runs);
void sums_far_take(int rank, struct machine_scalar *sums, size_t runs);

/* Other ranks: answers. False: it was no such question, or an error is set. */
bool sums_far_answer(struct machine *m, const struct far_table *arrays, const void *question,
                     size_t bytes);

#endif
