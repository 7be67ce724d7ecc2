/* fast_loops.h - the loops of lanes.h, included by lanes_plain.c, lanes_avx2.c and
 * lanes_avx512.c with
 *     TABLE    the table's name
 *
 * The result of a loop is in no place of its operands. */
#include "interpret/lanes.h"

#ifdef __SSE2__
#include <immintrin.h>
#endif
#include <math.h>
#include <string.h>

#include "base/errors.h"
#include "base/fill.h"
#include "base/op_families.h"
#include "base/scalar.h"
#include "device/shape.h"

typedef uint8_t u8;
typedef uint16_t u16;
typedef uint32_t u32;
typedef uint64_t u64;
typedef lanes_wide u128;
typedef int8_t i8;
typedef int16_t i16;
typedef int32_t i32;
typedef int64_t i64;
typedef __int128 i128;
typedef float f32;
typedef double f64;

#define LOOP(NAME, T) static void NAME##_##T(const struct lanes_step *s, void *const *at, int n)
#define EACH for (int i = 0; i < n; i++)
#define TO(T) T *restrict d = at[s->to]
#define IN(T, k, name) const T *name = at[s->in[k]]

#include "interpret/lanes_masks.h"
/* ---- bits ---- */
#define ONE(NAME, T, EXPRESSION)                                                               \
    LOOP(NAME, T)                                                                              \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        const T mask = (T)s->mask;                                                             \
        EACH d[i] = (T)((EXPRESSION)&mask);                                                    \
    }
#define TWO(NAME, T, EXPRESSION)                                                               \
    LOOP(NAME, T)                                                                              \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        IN(T, 1, b);                                                                           \
        const T mask = (T)s->mask;                                                             \
        EACH d[i] = (T)((EXPRESSION)&mask);                                                    \
    }
/* A bit, of operands of width w; by shifting up by `up` a signed number's sign is the highest
 * bit. */
#define BIT(NAME, T, EXPRESSION)                                                               \
    LOOP(NAME, T)                                                                              \
    {                                                                                          \
        TO(u8);                                                                                \
        IN(T, 0, a);                                                                           \
        IN(T, 1, b);                                                                           \
        EACH d[i] = (EXPRESSION);                                                              \
    }
#define SIGNED_BIT(NAME, T, S, EXPRESSION)                                                     \
    LOOP(NAME, T)                                                                              \
    {                                                                                          \
        TO(u8);                                                                                \
        IN(T, 0, a);                                                                           \
        IN(T, 1, b);                                                                           \
        const int up = (int)(8 * sizeof(T)) - s->from.width;                                   \
        EACH                                                                                   \
        {                                                                                      \
            const S x = (S)(T)(1u * a[i] << up), y = (S)(T)(1u * b[i] << up);                  \
            d[i] = (EXPRESSION);                                                               \
        }                                                                                      \
    }
#define SIGNED_PICK(NAME, T, S, LESS)                                                          \
    LOOP(NAME, T)                                                                              \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        IN(T, 1, b);                                                                           \
        const int up = (int)(8 * sizeof(T)) - s->from.width;                                   \
        EACH                                                                                   \
        {                                                                                      \
            const S x = (S)(T)(1u * a[i] << up), y = (S)(T)(1u * b[i] << up);                  \
            d[i] = LESS ? a[i] : b[i];                                                         \
        }                                                                                      \
    }
/* All bits of an operand. */
#define ONES(T) (T)((T) ~(T)0 >> ((int)(8 * sizeof(T)) - s->from.width))
#define SIGN_OF(EXPRESSION) (((EXPRESSION) >> (s->from.width - 1)) & 1)

#define INTEGERS(T, S)                                                                         \
    ONE(not, T, ~a[i])                                                                         \
    ONE(neg, T, 0u - a[i])                                                                     \
    TWO(and, T, a[i] & b[i])                                                                   \
    TWO(or, T, a[i] | b[i])                                                                    \
    TWO(xor, T, a[i] ^ b[i])                                                                   \
    TWO(add, T, 1u * a[i] + b[i])                                                              \
    TWO(sub, T, 1u * a[i] - b[i])                                                              \
    TWO(mul, T, 1u * a[i] * b[i])                                                              \
    TWO(umin, T, a[i] < b[i] ? a[i] : b[i])                                                    \
    TWO(umax, T, a[i] > b[i] ? a[i] : b[i])                                                    \
    SIGNED_PICK(smin, T, S, x < y)                                                             \
    SIGNED_PICK(smax, T, S, x > y)                                                             \
    BIT(eq, T, a[i] == b[i])                                                                   \
    BIT(ne, T, a[i] != b[i])                                                                   \
    BIT(ult, T, a[i] < b[i])                                                                   \
    BIT(ule, T, a[i] <= b[i])                                                                  \
    SIGNED_BIT(slt, T, S, x < y)                                                               \
    SIGNED_BIT(sle, T, S, x <= y)                                                              \
    BIT(over_uadd, T, (T)((1u * a[i] + b[i]) & ONES(T)) < a[i])                                \
    BIT(over_usub, T, a[i] < b[i])                                                             \
    BIT(over_sadd, T,                                                                          \
        (u8)SIGN_OF((T)((a[i] ^ (T)(1u * a[i] + b[i])) & (b[i] ^ (T)(1u * a[i] + b[i])))))     \
    BIT(over_ssub, T, (u8)SIGN_OF((T)((a[i] ^ (T)(1u * a[i] - b[i])) & (a[i] ^ b[i]))))        \
    LOOP(over_sneg, T)                                                                         \
    {                                                                                          \
        TO(u8);                                                                                \
        IN(T, 0, a);                                                                           \
        const T least = (T)((lanes_wide)1 << (s->from.width - 1));                             \
        EACH d[i] = a[i] == least;                                                             \
    }                                                                                          \
    LOOP(join, T)                                                                              \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        IN(T, 1, b);                                                                           \
        const int by = s->detail;                                                              \
        EACH d[i] = (T)(a[i] | 1u * b[i] << by);                                               \
    }                                                                                          \
    LOOP(select, T)                                                                            \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(u8, 0, c);                                                                          \
        IN(T, 1, a);                                                                           \
        IN(T, 2, b);                                                                           \
        const int same = mask_same(c, n), next = same + MASK_RUN;                              \
        if (same < n && same < MASK_PAYS(T)) {                                                 \
            EACH d[i] = CHOSEN(T);                                                             \
            return;                                                                            \
        }                                                                                      \
        memcpy(d, c[0] ? a : b, (size_t)same * sizeof *d);                                     \
        const int end = same + mask_end(c + same, n - same);                                   \
        memcpy(d + end, b + end, (size_t)(n - end) * sizeof *d);                               \
        const bool even = next < end && mask_same(c + next, end - next) == end - next;         \
        for (int i = same; i < (even ? next : end); i++)                                       \
            d[i] = CHOSEN(T);                                                                  \
        if (even)                                                                              \
            memcpy(d + next, c[next] ? a + next : b + next, (size_t)(end - next) * sizeof *d); \
    }                                                                                          \
    LOOP(repeat, T)                                                                            \
    {                                                                                          \
        TO(T);                                                                                 \
        const T first = d[0];                                                                  \
        const T up = (T)s->detail;                                                             \
        EACH d[i] = (T)(first + (T)i * up);                                                    \
    }                                                                                          \
    LOOP(fetch, T)                                                                             \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(u32, 0, place);                                                                     \
        IN(T, 1, array);                                                                       \
        const u32 count = *(const u32 *)at[s->in[2]];                                          \
        if (s->in_a_row) {                                                                     \
            const u32 from = place[0];                                                         \
            const bool all = from < count && count - from >= (u32)n;                           \
            if (all)                                                                           \
                memcpy(d, array + from, (size_t)n * sizeof *d);                                \
            for (u32 k = 0; k < (u32)n && !all; k++)                                           \
                d[k] = from + k < count ? array[from + k] : 0;                                 \
            return;                                                                            \
        }                                                                                      \
        EACH                                                                                   \
        {                                                                                      \
            const bool there = place[i] < count;                                               \
            const T v = array[there ? place[i] : 0];                                           \
            d[i] = there ? v : 0;                                                              \
        }                                                                                      \
    }                                                                                          \
    LOOP(copy, T)                                                                              \
    {                                                                                          \
        memcpy(at[s->to], at[s->in[0]], (size_t)n * sizeof(T));                                \
    }                                                                                          \
    LOOP(stream, T)                                                                            \
    {                                                                                          \
        stream(at[s->to], at[s->in[0]], (size_t)n * sizeof(T));                                \
    }

/* Whole lines of the caches, at places where lines begin; the rest as ever. */
static void stream(void *to, const void *from, size_t bytes)
{
    size_t i = 0;
#ifdef __SSE2__
#if defined __AVX512F__
    typedef __m512i vector;
#define STREAM_VECTOR(d, s) _mm512_stream_si512(d, _mm512_loadu_si512(s))
#elif defined __AVX2__
    typedef __m256i vector;
#define STREAM_VECTOR(d, s) _mm256_stream_si256(d, _mm256_loadu_si256(s))
#else
    typedef __m128i vector;
#define STREAM_VECTOR(d, s) _mm_stream_si128(d, _mm_loadu_si128(s))
#endif
    vector *d = to;
    const vector *s = from;
    const size_t lines = (uintptr_t)to % 64 ? 0 : bytes / 64,
                 count = lines * 64 / sizeof(vector);
    for (size_t k = 0; k < count; k++)
        STREAM_VECTOR(d + k, s + k);
    i = lines * 64;
#undef STREAM_VECTOR
#endif
    memcpy((char *)to + i, (const char *)from + i, bytes - i);
}

static void settle(void)
{
#ifdef __SSE2__
    _mm_sfence();
#endif
}

#include "interpret/fast_integers.h"

/* clang-format off */
INTEGERS(u8, i8) INTEGERS(u16, i16) INTEGERS(u32, i32) INTEGERS(u64, i64) INTEGERS(u128, i128)

/* Products that do not fit, where another type has room for all of them. */
#define PRODUCTS(T, W, V)                                                                      \
    BIT(over_umul, T, ((W)a[i] * (W)b[i]) >> s->from.width != 0)                               \
    LOOP(over_smul, T)                                                                         \
    {                                                                                          \
        TO(u8);                                                                                \
        IN(T, 0, a);                                                                           \
        IN(T, 1, b);                                                                           \
        const int up = (int)(8 * sizeof(V)) - s->from.width;                                   \
        const V most = (V)(((V)1 << (s->from.width - 1)) - 1);                                 \
        EACH                                                                                   \
        {                                                                                      \
            const V x = (V)((V)((W)a[i] << up) >> up), y = (V)((V)((W)b[i] << up) >> up);      \
            const V product = (V)(x * y);                                                      \
            d[i] = (product > most) | (product < -most - 1);                                   \
        }                                                                                      \
    }
PRODUCTS(u8, u32, i32) PRODUCTS(u16, u64, i64) PRODUCTS(u32, u64, i64) PRODUCTS(u64, u128, i128)

/* ---- from bits to bits ---- */

#define CONVERT(NAME, FROM, T)                                                                 \
    static void NAME##_##FROM##_##T(const struct lanes_step *s, void *const *at, int n)

#define RESIZE(FROM, SIGNED_, T)                                                               \
    CONVERT(cut, FROM, T)                                                                      \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(FROM, 0, a);                                                                        \
        const T mask = (T)s->mask;                                                             \
        const int by = s->detail;                                                              \
        EACH d[i] = (T)((T)(a[i] >> by) & mask);                                               \
    }                                                                                          \
    CONVERT(extend, FROM, T)                                                                   \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(FROM, 0, a);                                                                        \
        const T mask = (T)s->mask;                                                             \
        const int up = (int)(8 * sizeof(FROM)) - s->from.width;                                \
        EACH d[i] = (T)((T)((SIGNED_)(FROM)(1u * a[i] << up) >> up) & mask);                   \
    }
#define RESIZES(FROM, SIGNED_)                                                                 \
    RESIZE(FROM, SIGNED_, u8) RESIZE(FROM, SIGNED_, u16) RESIZE(FROM, SIGNED_, u32)            \
    RESIZE(FROM, SIGNED_, u64) RESIZE(FROM, SIGNED_, u128)
RESIZES(u8, i8) RESIZES(u16, i16) RESIZES(u32, i32) RESIZES(u64, i64) RESIZES(u128, i128)

/* ---- bits and floats ---- */

#define TO_FLOAT(FROM, SIGNED_, F)                                                             \
    CONVERT(u_to_f, FROM, F)                                                                   \
    {                                                                                          \
        TO(F);                                                                                 \
        IN(FROM, 0, a);                                                                        \
        EACH d[i] = (F)a[i];                                                                   \
    }                                                                                          \
    CONVERT(s_to_f, FROM, F)                                                                   \
    {                                                                                          \
        TO(F);                                                                                 \
        IN(FROM, 0, a);                                                                        \
        const int up = (int)(8 * sizeof(FROM)) - s->from.width;                                \
        EACH d[i] = (F)(SIGNED_)((SIGNED_)(FROM)(1u * a[i] << up) >> up);                      \
    }
#define TO_FLOATS(FROM, SIGNED_) TO_FLOAT(FROM, SIGNED_, f32) TO_FLOAT(FROM, SIGNED_, f64)
TO_FLOATS(u8, i8) TO_FLOATS(u16, i16) TO_FLOATS(u32, i32) TO_FLOATS(u64, i64)

/* Beyond the range its nearest end, NaN 0. */
#define TO_BITS(F, T, S)                                                                       \
    CONVERT(f_to_u, F, T)                                                                      \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(F, 0, a);                                                                           \
        const T mask = (T)s->mask;                                                             \
        const double limit = ldexp(1, s->type.width);                                          \
        EACH                                                                                   \
        {                                                                                      \
            const double v = a[i], x = v > 0 && v < limit ? v : 0;                             \
            const T r = (T)x;                                                                  \
            d[i] = (T)((v >= limit ? mask : r) & mask);                                        \
        }                                                                                      \
    }                                                                                          \
    CONVERT(f_to_s, F, T)                                                                      \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(F, 0, a);                                                                           \
        const T mask = (T)s->mask, most = (T)(mask >> 1), least = (T)(mask ^ most);            \
        const double limit = ldexp(1, s->type.width - 1);                                      \
        EACH                                                                                   \
        {                                                                                      \
            const double v = a[i], x = v > -limit && v < limit ? v : 0;                        \
            const T r = (T)(S)x;                                                               \
            d[i] = (T)((v >= limit ? most : v <= -limit ? least : r) & mask);                  \
        }                                                                                      \
    }
#define TO_BITS_OF(F) TO_BITS(F, u8, i8) TO_BITS(F, u16, i16) TO_BITS(F, u32, i32)             \
    TO_BITS(F, u64, i64) TO_BITS(F, u128, i128)
TO_BITS_OF(f32) TO_BITS_OF(f64)

#define FLOAT_TO_FLOAT(FROM, F)                                                                \
    CONVERT(f_to_f, FROM, F)                                                                   \
    {                                                                                          \
        TO(F);                                                                                 \
        IN(FROM, 0, a);                                                                        \
        EACH d[i] = (F)a[i];                                                                   \
    }
FLOAT_TO_FLOAT(f32, f32)
FLOAT_TO_FLOAT(f32, f64) FLOAT_TO_FLOAT(f64, f32) FLOAT_TO_FLOAT(f64, f64)

/* ---- floats ---- */

#define FLOAT_ONE(NAME, F, EXPRESSION)                                                         \
    LOOP(NAME, F)                                                                              \
    {                                                                                          \
        TO(F);                                                                                 \
        IN(F, 0, a);                                                                           \
        EACH d[i] = EXPRESSION;                                                                \
    }
#define FLOAT_TWO(NAME, F, T, EXPRESSION)                                                      \
    LOOP(NAME, F)                                                                              \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(F, 0, a);                                                                           \
        IN(F, 1, b);                                                                           \
        EACH d[i] = EXPRESSION;                                                                \
    }
#define OVER(F, ABS, RESULT)                                                                   \
    (ABS(RESULT) == (F)INFINITY) & (ABS(a[i]) < (F)INFINITY) & (ABS(b[i]) < (F)INFINITY)
#define FLOATS(F, SUFFIX, ABS, NAN_)                                                           \
    FLOAT_ONE(fneg, F, -a[i])                                                                  \
    FLOAT_ONE(fabs, F, ABS(a[i]))                                                              \
    FLOAT_ONE(fsqrt, F, __builtin_sqrt##SUFFIX(a[i]))                                          \
    FLOAT_ONE(ffloor, F, __builtin_floor##SUFFIX(a[i]))                                        \
    FLOAT_ONE(fceil, F, __builtin_ceil##SUFFIX(a[i]))                                          \
    FLOAT_ONE(ftrunc, F, __builtin_trunc##SUFFIX(a[i]))                                        \
    FLOAT_ONE(fround, F, __builtin_rint##SUFFIX(a[i]))                                         \
    FLOAT_TWO(fadd, F, F, a[i] + b[i])                                                         \
    FLOAT_TWO(fsub, F, F, a[i] - b[i])                                                         \
    FLOAT_TWO(fmul, F, F, a[i] * b[i])                                                         \
    FLOAT_TWO(fdiv, F, F, a[i] / b[i])                                                         \
    FLOAT_TWO(fmin, F, F, a[i] < b[i] ? a[i] : b[i])                                           \
    FLOAT_TWO(fmax, F, F, a[i] > b[i] ? a[i] : b[i])                                           \
    FLOAT_TWO(feq, F, u8, a[i] == b[i])                                                        \
    FLOAT_TWO(fne, F, u8, a[i] != b[i])                                                        \
    FLOAT_TWO(flt, F, u8, a[i] < b[i])                                                         \
    FLOAT_TWO(fle, F, u8, a[i] <= b[i])                                                        \
    FLOAT_TWO(fgt, F, u8, a[i] > b[i])                                                         \
    FLOAT_TWO(fge, F, u8, a[i] >= b[i])                                                        \
    FLOAT_TWO(over_fadd, F, u8, OVER(F, ABS, a[i] + b[i]))                                     \
    FLOAT_TWO(over_fsub, F, u8, OVER(F, ABS, a[i] - b[i]))                                     \
    FLOAT_TWO(over_fmul, F, u8, OVER(F, ABS, a[i] * b[i]))                                     \
    FLOAT_TWO(over_fdiv, F, u8, OVER(F, ABS, a[i] / b[i]))                                     \
    FLOAT_TWO(over_result, F, u8,                                                              \
              (ABS(a[i]) == (F)INFINITY) & (ABS(b[i]) < (F)INFINITY))                          \
    LOOP(canonical, F)                                                                         \
    {                                                                                          \
        F *d = at[s->to];                                                                      \
        EACH d[i] = d[i] == d[i] ? d[i] : NAN_;                                                \
    }
FLOATS(f32, f, __builtin_fabsf, -__builtin_nanf(""))
FLOATS(f64, , __builtin_fabs, -__builtin_nan(""))
    /* clang-format on */

    static inline u64 bits_of(f64 x)
{
    u64 bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline f64 double_of(u64 bits)
{
    f64 x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* x rounded to nearest even to a short format (s <= 24, e <= 9): by adding, and taking away
 * again, a number so great that the sum's last place is the result's. Longer ones:
 * lane_by_folding.c. */
LOOP(fit, f64)
{
    f64 *d = at[s->to];
    const u64 sign = UINT64_C(1) << 63, infinite = UINT64_C(0x7ff) << 52;
    const int most = (1 << (s->type.e - 1)) - 1, least = 1 - most;
    const u64 lowest = (u64)(1023 + least) << 52, limit = (u64)(1023 + most + 1) << 52;
    const u64 up = ((u64)(52 - s->type.s) << 52) + (UINT64_C(1) << 51);
    EACH
    {
        const f64 x = d[i];
        const u64 bits = bits_of(x);
        u64 power = bits & infinite;
        power = power < lowest ? lowest : power;
        power = power > limit ? limit : power;
        const f64 great = double_of(power + up);
        u64 r = bits_of((x + great) - great) & ~sign;
        r = (r >= limit ? infinite : r) | (bits & sign);
        d[i] = x == x ? double_of(r) : x;
    }
}

#include "interpret/lanes_indices.h"

/* ---- the table ---- */

#define OF_INTEGERS(NAME)                                                                      \
    {                                                                                          \
        NAME##_u8, NAME##_u16, NAME##_u32, NAME##_u64, NAME##_u128                             \
    }
#define OF_NARROW(NAME)                                                                        \
    {                                                                                          \
        NAME##_u8, NAME##_u16, NAME##_u32, NAME##_u64                                          \
    }
#define OF_FLOATS(NAME)                                                                        \
    {                                                                                          \
        [LANES_F32] = NAME##_f32, [LANES_F64] = NAME##_f64                                     \
    }
#define ROW(NAME, FROM)                                                                        \
    {                                                                                          \
        NAME##_##FROM##_u8, NAME##_##FROM##_u16, NAME##_##FROM##_u32, NAME##_##FROM##_u64,     \
            NAME##_##FROM##_u128                                                               \
    }
#define ROW_FLOATS(NAME, FROM)                                                                 \
    {                                                                                          \
        [LANES_F32] = NAME##_##FROM##_f32, [LANES_F64] = NAME##_##FROM##_f64                   \
    }
#define ROWS(NAME)                                                                             \
    {                                                                                          \
        ROW(NAME, u8), ROW(NAME, u16), ROW(NAME, u32), ROW(NAME, u64), ROW(NAME, u128)         \
    }
#define ROWS_TO_FLOATS(NAME)                                                                   \
    {                                                                                          \
        ROW_FLOATS(NAME, u8), ROW_FLOATS(NAME, u16), ROW_FLOATS(NAME, u32),                    \
            ROW_FLOATS(NAME, u64)                                                              \
    }
#define ROWS_OF_FLOATS(NAME)                                                                   \
    {                                                                                          \
        [LANES_F32] = ROW(NAME, f32), [LANES_F64] = ROW(NAME, f64)                             \
    }

const struct lanes_table TABLE =
    {.count = count,
     .fill = fill,
     .aim = aim,
     .filter = filter,
     .greatest = greatest,
     .pack = pack,
     .ranks = ranks,
     .sum = sum,
     .places = places,
     .scan = SCAN,
     .settle = settle,
     .of =
         {
             [MACHINE_NOT] = OF_INTEGERS(not ),
             [MACHINE_NEG] = OF_INTEGERS(neg),
             [MACHINE_AND] = OF_INTEGERS(and),
             [MACHINE_OR] = OF_INTEGERS(or),
             [MACHINE_XOR] = OF_INTEGERS(xor),
             [MACHINE_ADD] = OF_INTEGERS(add),
             [MACHINE_SUB] = OF_INTEGERS(sub),
             [MACHINE_MUL] = OF_INTEGERS(mul),
             [MACHINE_UMIN] = OF_INTEGERS(umin),
             [MACHINE_UMAX] = OF_INTEGERS(umax),
             [MACHINE_SMIN] = OF_INTEGERS(smin),
             [MACHINE_SMAX] = OF_INTEGERS(smax),
             [MACHINE_EQ] = OF_INTEGERS(eq),
             [MACHINE_NE] = OF_INTEGERS(ne),
             [MACHINE_ULT] = OF_INTEGERS(ult),
             [MACHINE_ULE] = OF_INTEGERS(ule),
             [MACHINE_SLT] = OF_INTEGERS(slt),
             [MACHINE_SLE] = OF_INTEGERS(sle),
             [MACHINE_UDIV] = OF_INTEGERS(udiv),
             [MACHINE_UCEIL] = OF_INTEGERS(uceil),
             [MACHINE_UROUND] = OF_INTEGERS(uround),
             [MACHINE_UREM] = OF_INTEGERS(urem),
             [MACHINE_SDIV] = OF_INTEGERS(sdiv),
             [MACHINE_SFLOOR] = OF_INTEGERS(sfloor),
             [MACHINE_SCEIL] = OF_INTEGERS(sceil),
             [MACHINE_SROUND] = OF_INTEGERS(sround),
             [MACHINE_SREM] = OF_INTEGERS(srem),
             [MACHINE_SMOD] = OF_INTEGERS(smod),
             [MACHINE_POW] = OF_INTEGERS(power),
             [MACHINE_USHIFT] = OF_INTEGERS(ushift),
             [MACHINE_SSHIFT] = OF_INTEGERS(sshift),
             [MACHINE_ROTATE] = OF_INTEGERS(rotate),
             [MACHINE_POPCOUNT] = OF_INTEGERS(popcount),
             [MACHINE_LENGTH] = OF_INTEGERS(length),
             [MACHINE_REVERSE] = OF_INTEGERS(reverse),
             [MACHINE_UNGRAY] = OF_INTEGERS(ungray),
             [MACHINE_ISQRT] = OF_NARROW(isqrt),
             [MACHINE_FNEG] = OF_FLOATS(fneg),
             [MACHINE_FABS] = OF_FLOATS(fabs),
             [MACHINE_FSQRT] = OF_FLOATS(fsqrt),
             [MACHINE_FFLOOR] = OF_FLOATS(ffloor),
             [MACHINE_FCEIL] = OF_FLOATS(fceil),
             [MACHINE_FTRUNC] = OF_FLOATS(ftrunc),
             [MACHINE_FROUND] = OF_FLOATS(fround),
             [MACHINE_FADD] = OF_FLOATS(fadd),
             [MACHINE_FSUB] = OF_FLOATS(fsub),
             [MACHINE_FMUL] = OF_FLOATS(fmul),
             [MACHINE_FDIV] = OF_FLOATS(fdiv),
             [MACHINE_FMIN] = OF_FLOATS(fmin),
             [MACHINE_FMAX] = OF_FLOATS(fmax),
             [MACHINE_FEQ] = OF_FLOATS(feq),
             [MACHINE_FNE] = OF_FLOATS(fne),
             [MACHINE_FLT] = OF_FLOATS(flt),
             [MACHINE_FLE] = OF_FLOATS(fle),
             [MACHINE_FGT] = OF_FLOATS(fgt),
             [MACHINE_FGE] = OF_FLOATS(fge),
             [NODE_SELECT] = OF_INTEGERS(select),
             [NODE_OVERFLOW_UADD] = OF_INTEGERS(over_uadd),
             [NODE_OVERFLOW_USUB] = OF_INTEGERS(over_usub),
             [NODE_OVERFLOW_UMUL] = OF_NARROW(over_umul),
             [NODE_OVERFLOW_SADD] = OF_INTEGERS(over_sadd),
             [NODE_OVERFLOW_SSUB] = OF_INTEGERS(over_ssub),
             [NODE_OVERFLOW_SMUL] = OF_NARROW(over_smul),
             [NODE_OVERFLOW_SNEG] = OF_INTEGERS(over_sneg),
             [NODE_OVERFLOW_FADD] = OF_FLOATS(over_fadd),
             [NODE_OVERFLOW_FSUB] = OF_FLOATS(over_fsub),
             [NODE_OVERFLOW_FMUL] = OF_FLOATS(over_fmul),
             [NODE_OVERFLOW_FDIV] = OF_FLOATS(over_fdiv),
             [NODE_OVERFLOW_RESULT] = OF_FLOATS(over_result),
             [LANES_COPY] = OF_INTEGERS(copy),
             [LANES_STREAM] = OF_INTEGERS(stream),
             [LANES_FETCH] = FETCHES,
             [LANES_REPEAT] = OF_INTEGERS(repeat),
             [LANES_PICK] = OF_INTEGERS(pick),
             [LANES_CROSS] = OF_INTEGERS(cross),
             [LANES_JOIN] = OF_INTEGERS(join),
             [LANES_CANONICAL] = OF_FLOATS(canonical),
             [LANES_PRODUCT_SUM] = OF_FLOATS(product_sum),
             [LANES_FIT] = {[LANES_F64] = fit_f64},
             [LANES_PLACE] = {[LANES_U32] = place_u32},
             [LANES_DRAW] = {[LANES_U32] = draw_u32},
         },
     .convert = {
         [NODE_ZERO_EXTEND] = ROWS(cut),
         [NODE_SIGN_EXTEND] = ROWS(extend),
         [NODE_U_TO_F] = ROWS_TO_FLOATS(u_to_f),
         [NODE_S_TO_F] = ROWS_TO_FLOATS(s_to_f),
         [NODE_F_TO_U] = ROWS_OF_FLOATS(f_to_u),
         [NODE_F_TO_S] = ROWS_OF_FLOATS(f_to_s),
         [NODE_F_TO_F] =
             {[LANES_F32] = {[LANES_F32] = f_to_f_f32_f32, [LANES_F64] = f_to_f_f32_f64},
              [LANES_F64] = {[LANES_F32] = f_to_f_f64_f32, [LANES_F64] = f_to_f_f64_f64}},
     }};
