/* near_pack.h - elements one after the other, on the front end's own threads: what a send to ranks comes to. */
#ifndef LUTETIA_MACHINE_NEAR_PACK_H
#define LUTETIA_MACHINE_NEAR_PACK_H

#include "base/crew.h"
#include "values/values.h"

/* The elements of so many bytes of a set of one row where the context holds, then what `old` has from there on: an array, or a
 * number. In so many parts. */
void near_pack(struct crew *crew, int parts, const struct vpset *s, size_t bytes,
               const struct device_buffer *context, const struct device_buffer *from,
               const struct machine_value *old, struct device_buffer *out);

#endif
