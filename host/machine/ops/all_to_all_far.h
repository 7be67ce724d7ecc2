/* all_to_all_far.h - sends and gets between blocks that ranks have: each is a sender, a taker,
 * or both, as in one process. */
#ifndef LUTETIA_MACHINE_ALL_TO_ALL_FAR_H
#define LUTETIA_MACHINE_ALL_TO_ALL_FAR_H

#include "device/far.h"
#include "ops/exchange.h"

/* Rank 0: tells the others, and does its part. */
void all_to_all_far(struct exchange *e);
/* Other ranks: do theirs. False: what they were told makes no sense, or an error is set. */
bool all_to_all_told(struct machine *m, const struct far_table *arrays, const void *told,
                     size_t bytes);

#endif
