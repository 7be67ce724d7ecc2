/* types.h - the types of values: their bytes in memory, and the floats of other formats than
 * single and double. */
#ifndef LUTETIA_MACHINE_TYPES_H
#define LUTETIA_MACHINE_TYPES_H

#include "machine.h"

static inline bool type_equal(struct machine_type a, struct machine_type b)
{
    return a.kind == b.kind && a.width == b.width && a.s == b.s && a.e == b.e;
}

/* A format whose sums, products, quotients and roots a double holds well enough to be rounded
 * again: with s <= 24 it has 2 (s + 1) + 2 bits, so that a second rounding never sees a tie
 * that the first one made; with e <= 9 no result has been rounded as a subnormal double. */
static inline bool type_is_short(struct machine_type t)
{
    return t.s <= 24 && t.e <= 9;
}

static inline size_t type_bytes(struct machine_type type) /* in a buffer */
{
    return type.width <= 8    ? 1
           : type.width <= 16 ? 2
           : type.width <= 32 ? 4
           : type.width <= 64 ? 8
                              : 16;
}

bool type_format_good(struct machine_type type);       /* s and e are within their ranges */
static inline bool type_good(struct machine_type type) /* ... or 0 */
{
    return (!type.s && !type.e) || type_format_good(type);
}
/* As machine_type_bits(). */
static inline int type_field_bits(struct machine_type type)
{
    return type.s ? type.s + type.e + 1 : type.width;
}

uint64_t type_rounded(uint64_t x, struct machine_type type); /* a double's bits */

uint64_t type_packed_bits(uint64_t x, struct machine_type type); /* ... as in a field */

static inline struct machine_scalar type_rounded_scalar(struct machine_scalar x,
                                                        struct machine_type type)
{
    if (type.s)
        x.lo = type_rounded(x.lo, type);
    return x;
}

uint64_t type_unpacked_bits(uint64_t x, struct machine_type type); /* ... and back */

#endif
