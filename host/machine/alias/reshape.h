/* reshape.h - aliases: the same memory seen from another VP set. Shared by alias.c, slices.c
 * and reshape.c.
 *
 * A field of L bits in a set of VP ratio R is R * L bits of each physical processor, one VP's
 * after the other. An alias is a field of its own, with slots of its own, that says which of
 * these bits are its VPs' (struct view). The field that owns the memory is its root. Of a root
 * and its aliases the one stored into last is valid. When another is read or stored into, the
 * whole content is copied over first:
 *
 *     newest alias -> root -> the one touched
 *
 * The usual alias is finer or coarser by a whole factor k; then whole values are converted:
 *
 *     coarse (p, j)    | slice 0 | slice 1 | ... | slice k-1 |      p: physical processor
 *     fine         (p, j*k) (p, j*k+1)   ...    (p, j*k+k-1)
 *
 * From fine to coarse, a value becomes k slices. A slice is a node without a buffer, so moving
 * it costs nothing. A slice that is observed is unpacked together with its neighbours (kernel
 * `slices`, 16 at a time: one cache line of the fine array). From coarse to fine, k values are
 * interleaved into one (kernel `weave`). There are two exceptions: k slices of one value in
 * their order are that value again, and k equal expressions of slices are that expression of
 * the whole values (lift). So a program's loop over its elements is rolled up. Bits stored as
 * words of many elements are taken apart in the kernel.
 *
 * All other shapes are converted bit by bit through an image of the memory (`put`, `get`).
 *
 * Virtual processors beyond the set's size (if it is no multiple of P) have no memory. Their
 * bits read as 0, and what another alias stores there is lost.
 */
#ifndef LUTETIA_MACHINE_RESHAPE_H
#define LUTETIA_MACHINE_RESHAPE_H

#include "memory/memory.h"

/* Element i of k is bits [origin + i * stride, + length) of the coarse field, and all bits
 * of the fine field. */
struct factor {
    struct field *fine, *coarse;
    uint32_t k, origin, stride, length;
};

static inline struct view reshape_view(const struct field *f)
{
    return f->root ? f->view : (struct view){0, 1, f->bits, 0};
}

/* reshape.c; false: error set */
bool reshape_fine_from_coarse(struct machine *m, const struct factor *f);
bool reshape_coarse_from_fine(struct machine *m, const struct factor *f);
/* Lays the newest alias (or NULL) over the root's memory; `to` then takes its content from
 * there. */
bool reshape_through_image(struct machine *m, struct field *root, struct field *newest,
                           struct field *to);

#endif
