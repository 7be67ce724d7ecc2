/* gather.h - numbers of single processors, stored in what is not computed yet: nothing is
 * evaluated for them. */
#ifndef LUTETIA_MACHINE_GATHER_H
#define LUTETIA_MACHINE_GATHER_H

#include "memory/memory.h"

/* Puts the number into one processor of v, which is what the field holds from there on and
 * waits to be computed: select (mask, numbers, v), with mask and numbers in memory that is the
 * front end's too. The next number goes into these. False: that cannot be, and nothing has been
 * done. *status: of the store. */
bool gather_write(struct machine *m, struct field *f, uint32_t offset, struct machine_value *v,
                  uint64_t index, struct machine_scalar number, enum machine_status *status);

/* Whether v is in memory of the front end's, and nobody but that field from there on looks at
 * it: its array may be written over. */
bool gather_is_own(const struct machine *m, const struct field *f, uint32_t offset,
                   const struct machine_value *v);

#endif
