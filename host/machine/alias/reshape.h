/* reshape.h - aliases: the same memory seen from another VP set. What alias.c, slices.c and reshape.c share.
 *
 * A field of L bits in a set of VP ratio R is R * L bits of each physical processor, one VP's after
 * the other. An alias is a field of its own, with slots of its own, that says which of these bits are
 * its VPs' (struct view). The field that owns the memory is its root. Of a root and its aliases the one
 * stored into last is right; whoever else is touched next takes the content over, as a whole:
 *
 *     newest alias -> root -> the one touched
 *
 * The usual alias is finer or coarser by a whole factor k, and what goes over are whole values:
 *
 *     coarse (p, j)    | slice 0 | slice 1 | ... | slice k-1 |      p: physical processor
 *     fine         (p, j*k) (p, j*k+1)   ...    (p, j*k+k-1)
 *
 * From fine to coarse a value becomes k slices of it, which are nodes without a buffer: moved about
 * they cost nothing, and one that is looked at is unpacked together with those beside it (kernel
 * `slices`, 16 at a time: one cache line of the fine array). From coarse to fine k values are woven
 * into one (`weave`); but k slices of one value in their order are that value again, and k equal
 * expressions of slices are that expression of the whole values (lift): a program that goes through
 * its elements in a loop has its loop rolled up here. Bits stored as words of many elements are taken
 * apart in the kernel.
 *
 * All other shapes go through an image of the memory, bit by bit (`put`, `get`).
 *
 * Virtual processors that do not exist (of a set whose size is no multiple of P) have no memory: the
 * bits where they would be read as 0, and storing through another alias does not keep them. */
#ifndef LUTETIA_MACHINE_RESHAPE_H
#define LUTETIA_MACHINE_RESHAPE_H

#include "memory/memory.h"

/* Element i of the k has bits [origin + i * stride, + length) of the coarse field, and all the fine
 * one's. */
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
/* newest (or NULL) is laid over the root's memory; to then takes its content from there. */
bool reshape_through_image(struct machine *m, struct field *root, struct field *newest,
                           struct field *to);

#endif
