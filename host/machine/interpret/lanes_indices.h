/* lanes_indices.h - loops over indices: a part of fast_loops.h, whose macros it uses. */

LOOP(place, u32)
{
    TO(u32);
    IN(u32, 0, a);
    const int by = s->detail;
    const u32 low = (1u << by) - 1, ratio = (u32)s->mask;
    EACH d[i] = (a[i] & low) * ratio + (a[i] >> by);
}

static inline u64 mixed(u64 z)
{
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* in[1]: the key and the limit. detail 0: the high bits; 1: below a limit of 32 bits; 2: below
 * any. */
LOOP(draw, u32)
{
    TO(u64);
    IN(u32, 0, a);
    IN(u64, 1, number);
    const u64 key = number[0], limit = number[1];
    const int down = 64 - s->type.width;
    if (s->detail == 0)
        EACH d[i] = mixed(a[i] * UINT64_C(0x9e3779b97f4a7c15) + key) >> down;
    else if (s->detail == 1)
        EACH d[i] = ((mixed(a[i] * UINT64_C(0x9e3779b97f4a7c15) + key) >> 32) * limit) >> 32;
    else
        EACH d[i] =
            (u64)(((u128)mixed(a[i] * UINT64_C(0x9e3779b97f4a7c15) + key) * limit) >> 64);
}

#include "interpret/lanes_cross.h"
#include "interpret/lanes_lines.h"
#include "interpret/lanes_picks.h"
#include "interpret/lanes_products.h"
#include "interpret/lanes_sums.h"
