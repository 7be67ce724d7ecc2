/* scalar.h - numbers of 1 to 128 bits on the front end.
 *
 *     struct machine_scalar least = scalar_sign(width), greatest = scalar_ones(width - 1);
 *     struct machine_scalar minus_one = scalar_cut(scalar_signed(-1), width); */
#ifndef LUTETIA_MACHINE_SCALAR_H
#define LUTETIA_MACHINE_SCALAR_H

#include "machine.h"

/* *The* NaN, which operations give: see docs/engine-reference.md. */
#define NAN_32 0xffc00000u
#define NAN_64 UINT64_C(0xfff8000000000000)

/* Whether a float of that type is a NaN. */
static inline bool scalar_is_nan(struct machine_type type, uint64_t bits)
{
    return type.width == 32 ? (bits & INT32_MAX) > 0x7f800000u
                            : (bits & INT64_MAX) > UINT64_C(0x7ff0000000000000);
}

/* Whether it is a NaN that no operation gives. */
static inline bool scalar_is_strange_nan(struct machine_type type, uint64_t bits)
{
    return scalar_is_nan(type, bits) && bits != (type.width == 32 ? NAN_32 : NAN_64);
}

/* So many ones. */
static inline struct machine_scalar scalar_ones(int width)
{
    if (width < 64)
        return (struct machine_scalar){(UINT64_C(1) << width) - 1, 0};
    return (struct machine_scalar){UINT64_MAX, width < 128 ? (UINT64_C(1) << (width - 64)) - 1
                                                           : UINT64_MAX};
}

/* The number with only the highest of `width` bits set. */
static inline struct machine_scalar scalar_sign(int width)
{
    return width <= 64 ? (struct machine_scalar){UINT64_C(1) << (width - 1), 0}
                       : (struct machine_scalar){0, UINT64_C(1) << (width - 65)};
}

/* The low `width` bits of a number. */
static inline struct machine_scalar scalar_cut(struct machine_scalar x, int width)
{
    struct machine_scalar ones = scalar_ones(width);
    return (struct machine_scalar){x.lo & ones.lo, x.hi & ones.hi};
}

/* 128 bits. */
static inline struct machine_scalar scalar_signed(int64_t x)
{
    return (struct machine_scalar){(uint64_t)x, x < 0 ? UINT64_MAX : 0};
}

#endif
