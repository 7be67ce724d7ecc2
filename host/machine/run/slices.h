/* slices.h - slices of values: see reshape.h. */
#ifndef LUTETIA_MACHINE_SLICES_H
#define LUTETIA_MACHINE_SLICES_H

#include <stdio.h>

#include "base/types.h"
#include "device/call.h"
#include "kernels.h"
#include "values/values.h"

enum { SLICES_BLOCK = 16 }; /* arrays that a kernel interleaves, or takes apart, at a time */

/* Begins a call of a kernel of kernels/reshape.cl for values of that type. */
static inline struct kernel_call slices_call(struct machine *m, struct machine_type type,
                                             const char *name)
{
    char options[64];
    size_t bytes = type_bytes(type);
    snprintf(options, sizeof options, "-DELEMENT=%s%s", call_element(bytes),
             bytes == 16 ? " -DPAIR" : "");
    return call_begin(m, kernel_reshape_cl, options, name);
}

/* Slices first .. first + count - 1 of the k of a value of that type, those whose bit in
 * `wanted` is set: at least one. */
struct slices_taken {
    uint32_t k, first, count, wanted;
    struct machine_type type;
};
/* Writes them to `out`, each at its place: arrays of a set with a k-th of the VPs. */
enum machine_status slices_take(struct machine *m, const struct vpset *from,
                                const struct vpset *to, const struct slices_taken *t,
                                const struct device_buffer *in,
                                struct device_buffer *const out[SLICES_BLOCK]);
/* Makes slice i of the k that `fine` (in memory) is divided into, in the VP set. */
struct machine_value *slice_make(struct machine *m, struct machine_value *fine, int set,
                                 uint32_t k, uint32_t i);
/* Gives a slice its buffer, and other slices that are found on the way. */
bool slice_unpack(struct machine *m, struct machine_value *slice);
/* Afterwards there is no slice in the VP set or of a value of it, and no other value of the
 * set that has both a name and a buffer. */
bool slices_forget_set(struct machine *m, int set);

#endif
