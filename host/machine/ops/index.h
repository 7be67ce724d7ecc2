/* index.h - indices of send addresses, as operations: computed for each lane in the kernel of
 * what needs them. */
#ifndef LUTETIA_MACHINE_INDEX_H
#define LUTETIA_MACHINE_INDEX_H

#include "values/values.h"

enum { INDEX_BITS = 32 };

struct machine_value *index_number(struct machine *m, uint64_t x);
/* Only so many low bits of an address count: the value that has them. */
struct machine_value *index_address_bare(struct machine_value *address, int bits);
/* Whether a send address is the row-major index. */
bool index_is_address(const struct vpset *s);
/* The row-major index of the processor at an address; of none, what is no index. */
struct machine_value *index_of_address(struct machine *m, int set,
                                       struct machine_value *address);
/* Where the array of a set has that processor's element. The set's halo is in it, so that the
 * set may be another one, or none, when the value is computed. */
struct machine_value *index_place(struct machine *m, const struct vpset *s,
                                  struct machine_value *x);

#endif
