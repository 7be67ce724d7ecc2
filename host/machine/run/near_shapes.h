/* near_shapes.h - what kernels/reshape.cl does, as loops of the front end, where the device's
 * memory is its own: no kernel is compiled for aliases, and none is waited for. Physical
 * processors are shared out among the device's crew.
 *
 * Each returns false where the memory is the device's; then nothing has been done. */
#ifndef LUTETIA_MACHINE_NEAR_SHAPES_H
#define LUTETIA_MACHINE_NEAR_SHAPES_H

#include "device/device.h"
#include "run/slices.h"
#include "values/values.h"

/* Bits of a value in an image of the processors' memory: see reshape.cl. */
struct near_view {
    uint32_t words; /* of 32 bits, of a processor */
    uint32_t start, parts, outer, inner, width;
};

bool near_slices(struct machine *m, const struct vpset *fine, const struct vpset *coarse,
                 const struct slices_taken *t, const struct device_buffer *in,
                 struct device_buffer *const out[SLICES_BLOCK]);
/* The count words of the coarser set, each of so many parts of `width` bits, are elements
 * `first` and so on of the k of a finer value. */
bool near_weave(struct machine *m, const struct vpset *fine, const struct vpset *coarse,
                uint32_t k, uint32_t first, uint32_t count, uint32_t parts, uint32_t width,
                size_t whole, const struct device_buffer *const in[SLICES_BLOCK],
                size_t element, const struct device_buffer *out);
/* A value's bits go into the image, or come out of it. */
bool near_image(struct machine *m, const struct vpset *set, const struct near_view *view,
                bool put, size_t element, const struct device_buffer *value,
                const struct device_buffer *image);

#endif
