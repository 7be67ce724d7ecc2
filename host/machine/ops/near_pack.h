/* near_pack.h - ranks of active processors, and elements one after the other: what a send to
 * ranks comes to. On the front end's own threads. */
#ifndef LUTETIA_MACHINE_NEAR_PACK_H
#define LUTETIA_MACHINE_NEAR_PACK_H

#include "base/crew.h"
#include "values/values.h"

/* The elements of so many bytes of a set of one row where the context holds, then what `old`
 * has from there on: an array, or a number. In so many parts. */
void near_pack(struct crew *crew, int parts, const struct vpset *s, size_t bytes,
               const struct device_buffer *context, const struct device_buffer *from,
               const struct machine_value *old, struct device_buffer *out);

/* What `old` has, an array or a number of 32 bits; but where the context holds, how many
 * processors before it do, and `first` more, as far as the bits of `mask`. out may be old's
 * array. */
void near_enumerate(struct crew *crew, int parts, const struct vpset *s,
                    const struct device_buffer *context, const struct machine_value *old,
                    uint32_t first, uint32_t mask, struct device_buffer *out);

#endif
