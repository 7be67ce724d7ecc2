/* lanes_sums.h - reductions of whole numbers, in any order: a part of fast_loops.h. The slow
 * twin is the kernel of kernels/reduce.cl. */

#include "interpret/joins.h"

/* Numbers as they are, in lanes of their own length. */
#define SUM_PLAIN(type, wide, join)                                                            \
    {                                                                                          \
        const type *p = numbers, from = (type)s->flip;                                         \
        const wide least = (wide)s->none;                                                      \
        wide plain = least;                                                                    \
        if (!context)                                                                          \
            for (size_t i = 0; i < n; i++) {                                                   \
                const wide x = (wide)(p[i] ^ from);                                            \
                plain = (wide)join(plain, x);                                                  \
            }                                                                                  \
        else                                                                                   \
            for (size_t i = 0; i < n; i++) {                                                   \
                const wide x = context[i] ? (wide)(p[i] ^ from) : least;                       \
                plain = (wide)join(plain, x);                                                  \
            }                                                                                  \
        return plain;                                                                          \
    }

/* Numbers made longer, with their sign or without. */
#define SUM_LONGER(type, join)                                                                 \
    {                                                                                          \
        const type *p = numbers;                                                               \
        const u64 none = s->none, flip = s->flip, sign = s->sign;                              \
        u64 sum = none;                                                                        \
        for (size_t i = 0; i < n; i++) {                                                       \
            const u64 x = ((p[i] ^ sign) - sign) ^ flip,                                       \
                      y = !context || context[i] ? x : none;                                   \
            sum = join(sum, y);                                                                \
        }                                                                                      \
        return sum;                                                                            \
    }

#define SUM(type, wide, join)                                                                  \
    if (s->plain)                                                                              \
        SUM_PLAIN(type, wide, join)                                                            \
    else                                                                                       \
        SUM_LONGER(type, join)

#define SUM_BY(name, wide1, wide2, wide4, join)                                                \
    static u64 name(const struct lanes_sum *s, const void *numbers, const u8 *context,         \
                    size_t n)                                                                  \
    {                                                                                          \
        switch (s->element) {                                                                  \
        case 1:                                                                                \
            SUM(u8, wide1, join)                                                               \
        case 2:                                                                                \
            SUM(u16, wide2, join)                                                              \
        case 4:                                                                                \
            SUM(u32, wide4, join)                                                              \
        default:                                                                               \
            SUM(u64, u64, join)                                                                \
        }                                                                                      \
    }

SUM_BY(sum_and, u8, u16, u32, JOIN_AND)
SUM_BY(sum_or, u8, u16, u32, JOIN_OR)
SUM_BY(sum_xor, u8, u16, u32, JOIN_XOR)

/* So many numbers of 8 and 16 bits are added in lanes of twice their length. */
enum { SUM_RUN_U8 = 256, SUM_RUN_U16 = 65536, SUM_RUN_U32 = INT32_MAX };
/* Added as they are: some at a time, in lanes that have room for the sum of so many. */
#define SUM_ADDED(type, WIDE, RUN)                                                             \
    {                                                                                          \
        const type *p = numbers;                                                               \
        u64 all = 0;                                                                           \
        for (size_t i = 0, end; i < n; i = end) {                                              \
            WIDE sum = 0;                                                                      \
            end = n - i < (size_t)RUN ? n : i + (size_t)RUN;                                   \
            if (!context)                                                                      \
                for (; i < end; i++)                                                           \
                    sum = (WIDE)(sum + p[i]);                                                  \
            else                                                                               \
                for (; i < end; i++)                                                           \
                    sum = (WIDE)(sum +                                                         \
                                 (type)(p[i] & (type)((type)0 - (type)(context[i] != 0))));    \
            all += sum;                                                                        \
        }                                                                                      \
        return all;                                                                            \
    }

SUM_BY(sum_longer, u64, u64, u64, JOIN_ADD)

static u64 sum_add(const struct lanes_sum *s, const void *numbers, const u8 *context, size_t n)
{
    if (!s->plain || s->flip || s->none)
        return sum_longer(s, numbers, context, n);
    switch (s->element) {
    case 1:
        SUM_ADDED(u8, u16, SUM_RUN_U8)
    case 2:
        SUM_ADDED(u16, u32, SUM_RUN_U16)
    case 4:
        SUM_ADDED(u32, u64, SUM_RUN_U32)
    default:
        SUM_ADDED(u64, u64, SUM_RUN_U32)
    }
}

SUM_BY(sum_least, u8, u16, u32, JOIN_LEAST)
SUM_BY(sum_greatest, u8, u16, u32, JOIN_GREATEST)

static u64 sum(const struct lanes_sum *s, const void *numbers, const u8 *context, size_t n)
{
    static lanes_sum_function *const of[] = {
        [REDUCE_AND] = sum_and, [REDUCE_OR] = sum_or,       [REDUCE_XOR] = sum_xor,
        [REDUCE_ADD] = sum_add, [REDUCE_LEAST] = sum_least, [REDUCE_GREATEST] = sum_greatest};
    return of[s->op](s, numbers, context, n);
}
