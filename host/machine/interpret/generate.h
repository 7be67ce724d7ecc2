/* generate.h - what follows from a processor's place, as lanes of 32 bits. */
#ifndef LUTETIA_MACHINE_GENERATE_H
#define LUTETIA_MACHINE_GENERATE_H

#include "values/geometry.h"

/* c modulo length, which is 1 or more. */
static inline int generate_wrapped(int64_t c, int length)
{
    c %= length;
    return (int)(c < 0 ? c + length : c);
}

/* The coordinate along an axis, or the row-major index (axis -1), of `lanes` columns of a row
 * from column x on, which may lie beyond its ends. */
void generate_row(const struct vpset *s, int axis, uint64_t row, int x, uint32_t *to,
                  int lanes);
/* The same of a set's array: of `lanes` elements from that one on, halos and padding
 * included. */
void generate_lanes(const struct vpset *s, int axis, size_t first, uint32_t *to, int lanes);

#endif
