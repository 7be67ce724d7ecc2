/* fast_integers.h - quotients, powers, shifts and counts as loops: a part of fast_loops.h,
 * whose macros it uses. What they come to is said in machine_op.tab; the slow twin is
 * integer_fold().
 *
 * An operand's bits above its width are 0. Signed numbers are divided as magnitudes. */

/* Quotients of up to 32 bits are taken of floats with room for all their bits: such a quotient
 * is further from the next whole number than it can be rounded. So there are vectors of
 * them. */
#define QUOTIENT(T, F)                                                                         \
    static inline T quotient_##T(T a, T b)                                                     \
    {                                                                                          \
        const F by = b ? (F)b : 1;                                                             \
        const T q = (T)((F)a / by);                                                            \
        return b ? q : 0;                                                                      \
    }
#define QUOTIENT_WHOLE(T)                                                                      \
    static inline T quotient_##T(T a, T b)                                                     \
    {                                                                                          \
        return b ? a / b : 0;                                                                  \
    }
QUOTIENT(u8, f32)
QUOTIENT(u16, f32)
QUOTIENT(u32, f64)
QUOTIENT_WHOLE(u64)
QUOTIENT_WHOLE(u128)

/* As op_has(op, OP_SIGNED). The compiler knows the answer, for op is a number of the text. */
static inline bool divides_signed(const enum op_quotient op)
{
    switch ((int)op) {
#define OPERATION(op, name, inputs, takes, gives, cost, nan, fold, spell, word, second, flags) \
    case op:                                                                                   \
        return (flags)&OP_SIGNED;
#define NODE(op, ...)
#include "machine_op.tab"
#undef OPERATION
#undef NODE
    default:
        return false;
    }
}

#define DIVIDE(T)                                                                              \
    static inline __attribute__((always_inline))                                               \
    T divided_##T(const enum op_quotient op, T a, T b, const int width)                        \
    {                                                                                          \
        const T ones = (T)((T) ~(T)0 >> ((int)(8 * sizeof(T)) - width));                       \
        const bool sa = divides_signed(op) && (a >> (width - 1) & 1),                          \
                   sb = divides_signed(op) && (b >> (width - 1) & 1), negative = sa != sb;     \
        const T x = (T)(sa ? (0u - a) & ones : a), y = (T)(sb ? (0u - b) & ones : b);          \
        const T q = quotient_##T(x, y), r = (T)(x - 1u * q * y),                               \
                up = (T)(negative && r ? y - r : r);                                           \
        const bool inexact = y && r;                                                           \
        bool more = false;                                                                     \
        switch (op) {                                                                          \
        case OF_MACHINE_UREM:                                                                  \
        case OF_MACHINE_SREM:                                                                  \
            return (T)(sa ? 0u - r : r);                                                       \
        case OF_MACHINE_SMOD:                                                                  \
            return (T)(sb ? 0u - up : up);                                                     \
        case OF_MACHINE_UDIV:                                                                  \
        case OF_MACHINE_SDIV:                                                                  \
            break;                                                                             \
        case OF_MACHINE_SFLOOR:                                                                \
            more = inexact && negative;                                                        \
            break;                                                                             \
        case OF_MACHINE_UCEIL:                                                                 \
        case OF_MACHINE_SCEIL:                                                                 \
            more = inexact && !negative;                                                       \
            break;                                                                             \
        case OF_MACHINE_UROUND:                                                                \
        case OF_MACHINE_SROUND:                                                                \
            more = inexact && (r > (T)(y - r) || (r == (T)(y - r) && (q & 1)));                \
            break;                                                                             \
        }                                                                                      \
        const T rounded = (T)(q + more);                                                       \
        return (T)(negative ? 0u - rounded : rounded);                                         \
    }
#define DIVIDES(NAME, T, OP)                                                                   \
    LOOP(NAME, T)                                                                              \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        IN(T, 1, b);                                                                           \
        const T mask = (T)s->mask;                                                             \
        const int width = s->from.width;                                                       \
        EACH d[i] = (T)(divided_##T(OP, a[i], b[i], width) & mask);                            \
    }

/* By a signed number of 32 bits, -128 to 128; detail 1: all by the first. */
#define SHIFTED(T, LEFT, RIGHT)                                                                \
    const i32 all = b[0];                                                                      \
    if (s->detail && all >= 0)                                                                 \
        EACH                                                                                   \
        {                                                                                      \
            const i32 by = all;                                                                \
            d[i] = (T)(LEFT & mask);                                                           \
        }                                                                                      \
    else if (s->detail)                                                                        \
        EACH                                                                                   \
        {                                                                                      \
            const i32 by = all;                                                                \
            d[i] = (T)(RIGHT & mask);                                                          \
        }                                                                                      \
    else                                                                                       \
        EACH                                                                                   \
        {                                                                                      \
            const i32 by = b[i];                                                               \
            const T up = LEFT, down = RIGHT;                                                   \
            d[i] = (T)((by >= 0 ? up : down) & mask);                                          \
        }
#define SHIFTS(T, S)                                                                           \
    LOOP(ushift, T)                                                                            \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        IN(i32, 1, b);                                                                         \
        const T mask = (T)s->mask;                                                             \
        const int bits = (int)(8 * sizeof(T));                                                 \
        SHIFTED(T, (T)(by < bits ? 1u * a[i] << (by & (bits - 1)) : 0),                        \
                (T)(-by < bits ? a[i] >> (-by & (bits - 1)) : 0))                              \
    }                                                                                          \
    LOOP(sshift, T)                                                                            \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        IN(i32, 1, b);                                                                         \
        const T mask = (T)s->mask;                                                             \
        const int bits = (int)(8 * sizeof(T)), high = bits - s->from.width;                    \
        SHIFTED(T, (T)(by < bits ? 1u * a[i] << (by & (bits - 1)) : 0),                        \
                (T)((S)((S)(T)(1u * a[i] << high) >> high) >>                                  \
                    (-by < bits ? -by & (bits - 1) : bits - 1)))                               \
    }                                                                                          \
    LOOP(rotate, T) /* by 0 to width - 1 */                                                    \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        IN(i32, 1, b);                                                                         \
        const T mask = (T)s->mask;                                                             \
        const int last = s->from.width - 1;                                                    \
        EACH d[i] = (T)((T)((1u * a[i] << b[i]) | (T)(a[i] >> (last - b[i]) >> 1)) & mask);    \
    }

/* All bits, and every second one, pair, ... of those of T. */
#define EVERY(T, DIVISOR) (T)((T) ~(T)0 / (DIVISOR))
#define ONES_BEFORE(T, k) (T)((T) ~(T)0 / (T)(((T)1 << (k)) + 1))

#define COUNTS(T)                                                                              \
    static inline T counted_##T(T x)                                                           \
    {                                                                                          \
        x = (T)(x - ((x >> 1) & EVERY(T, 3)));                                                 \
        x = (T)((x & EVERY(T, 5)) + ((x >> 2) & EVERY(T, 5)));                                 \
        x = (T)((x + (x >> 4)) & EVERY(T, 17));                                                \
        return (T)((T)(1u * x * EVERY(T, 255)) >> (8 * sizeof(T) - 8));                        \
    }                                                                                          \
    LOOP(popcount, T)                                                                          \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        const T mask = (T)s->mask;                                                             \
        EACH d[i] = (T)(counted_##T(a[i]) & mask);                                             \
    }                                                                                          \
    LOOP(length, T)                                                                            \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        const T mask = (T)s->mask;                                                             \
        EACH                                                                                   \
        {                                                                                      \
            T x = a[i];                                                                        \
            x |= (T)(x >> 1);                                                                  \
            x |= (T)(x >> 2);                                                                  \
            x |= (T)(x >> 4);                                                                  \
            x |= (T)(sizeof(T) > 1 ? x >> 8 % (8 * sizeof(T)) : 0);                            \
            x |= (T)(sizeof(T) > 2 ? x >> 16 % (8 * sizeof(T)) : 0);                           \
            x |= (T)(sizeof(T) > 4 ? x >> 32 % (8 * sizeof(T)) : 0);                           \
            x |= (T)(sizeof(T) > 8 ? x >> 64 % (8 * sizeof(T)) : 0);                           \
            d[i] = (T)(counted_##T(x) & mask);                                                 \
        }                                                                                      \
    }                                                                                          \
    LOOP(ungray, T)                                                                            \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        EACH                                                                                   \
        {                                                                                      \
            T x = a[i];                                                                        \
            x ^= (T)(x >> 1);                                                                  \
            x ^= (T)(x >> 2);                                                                  \
            x ^= (T)(x >> 4);                                                                  \
            x ^= (T)(sizeof(T) > 1 ? x >> 8 % (8 * sizeof(T)) : 0);                            \
            x ^= (T)(sizeof(T) > 2 ? x >> 16 % (8 * sizeof(T)) : 0);                           \
            x ^= (T)(sizeof(T) > 4 ? x >> 32 % (8 * sizeof(T)) : 0);                           \
            x ^= (T)(sizeof(T) > 8 ? x >> 64 % (8 * sizeof(T)) : 0);                           \
            d[i] = x;                                                                          \
        }                                                                                      \
    }

/* Neighbours of k bits change places; T has more. */
#define SWAPPED(T, x, k)                                                                       \
    (T)(((T)((x) >> (k)) & ONES_BEFORE(T, k)) | (T)(1u * ((x)&ONES_BEFORE(T, k)) << (k)))
#define REVERSES(T)                                                                            \
    LOOP(reverse, T)                                                                           \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        const int down = (int)(8 * sizeof(T)) - s->from.width, half = (int)(4 * sizeof(T));    \
        EACH                                                                                   \
        {                                                                                      \
            T x = a[i];                                                                        \
            x = SWAPPED(T, x, 1);                                                              \
            x = SWAPPED(T, x, 2);                                                              \
            x = SWAPPED(T, x, 4);                                                              \
            for (int k = 8; k <= half; k *= 2)                                                 \
                x = SWAPPED(T, x, k);                                                          \
            d[i] = (T)(x >> down);                                                             \
        }                                                                                      \
    }

/* The root of a double is near enough up to 32 bits; beyond, it is one off at most. */
#define ROOT(T)                                                                                \
    LOOP(isqrt, T)                                                                             \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        EACH d[i] = (T)__builtin_sqrt((f64)a[i]);                                              \
    }
ROOT(u8) ROOT(u16) ROOT(u32) LOOP(isqrt, u64)
{
    TO(u64);
    IN(u64, 0, a);
    EACH
    {
        const u64 near = (u64)__builtin_sqrt((f64)a[i]), most = UINT32_MAX,
                  r = near < most ? near : most, up = r < most ? r + 1 : most;
        d[i] = r * r > a[i] ? r - 1 : up * up <= a[i] ? up : r;
    }
}

#define POWERS(T)                                                                              \
    LOOP(power, T)                                                                             \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        IN(T, 1, b);                                                                           \
        const T mask = (T)s->mask;                                                             \
        EACH                                                                                   \
        {                                                                                      \
            T r = 1, x = a[i];                                                                 \
            for (T left = b[i]; left; left = (T)(left >> 1)) {                                 \
                r = (T)(left & 1 ? 1u * r * x : r);                                            \
                x = (T)(1u * x * x);                                                           \
            }                                                                                  \
            d[i] = (T)(r & mask);                                                              \
        }                                                                                      \
    }

#define BEYOND_SUMS(T, S)                                                                      \
    DIVIDE(T)                                                                                  \
    DIVIDES(udiv, T, OF_MACHINE_UDIV)                                                          \
    DIVIDES(uceil, T, OF_MACHINE_UCEIL)                                                        \
    DIVIDES(uround, T, OF_MACHINE_UROUND)                                                      \
    DIVIDES(urem, T, OF_MACHINE_UREM)                                                          \
    DIVIDES(sdiv, T, OF_MACHINE_SDIV)                                                          \
    DIVIDES(sfloor, T, OF_MACHINE_SFLOOR)                                                      \
    DIVIDES(sceil, T, OF_MACHINE_SCEIL)                                                        \
    DIVIDES(sround, T, OF_MACHINE_SROUND)                                                      \
    DIVIDES(srem, T, OF_MACHINE_SREM)                                                          \
    DIVIDES(smod, T, OF_MACHINE_SMOD)                                                          \
    SHIFTS(T, S)                                                                               \
    COUNTS(T)                                                                                  \
    REVERSES(T)                                                                                \
    POWERS(T)
BEYOND_SUMS(u8, i8)
BEYOND_SUMS(u16, i16)
BEYOND_SUMS(u32, i32)
BEYOND_SUMS(u64, i64)
BEYOND_SUMS(u128, i128)
