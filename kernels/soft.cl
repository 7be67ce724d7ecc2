/* soft.cl - floats of other formats than single and double, by integer arithmetic.
 *
 * A format has a significand of s bits and an exponent of e bits (1 <= s <= 52, 2 <= e <= 11),
 * as IEEE's have: bias 2^(e - 1) - 1, subnormals, infinities, NaNs. All its numbers are
 * doubles, so that a value of it is held as the double; x and y here are doubles' bits. Results
 * are rounded once, to nearest even, to the format; a NaN is the double's canonical one.
 *
 * In kernels of one lane, and as C on the host: see host/machine/base/types.c. Between
 * unpacking and rounding a number is sign, exponent and magnitude: m * 2^(exponent - 63),
 * 2^63 <= m < 2^64.
 */
#ifdef __OPENCL_VERSION__
#define SOFT_CLZ(x) ((int)clz(x))
#define SOFT_HIGH(x, y) mul_hi(x, y)
#define SOFT_FUNCTION __attribute__((noinline)) static
#define SOFT_INLINE static inline
#else
#include <stdint.h>
typedef uint64_t ulong;
#define SOFT_CLZ(x) __builtin_clzll(x)
#define SOFT_HIGH(x, y) ((ulong)((unsigned __int128)(x) * (y) >> 64))
#define SOFT_FUNCTION static __attribute__((unused))
#define SOFT_INLINE static inline
#endif
#define SOFT_SIGN ((ulong)1 << 63)
#define SOFT_INFINITE ((ulong)0x7ff << 52)
#define SOFT_NAN ((ulong)0x1fff << 51)

typedef struct {
    ulong sign, m;
    int exponent;
} soft_number;

/* x neither 0 nor infinite nor NaN */
SOFT_INLINE soft_number soft_number_of(ulong x)
{
    soft_number r;
    ulong fraction = x << 12;
    int field = (int)(x >> 52) & 0x7ff;
    r.sign = x & SOFT_SIGN;
    if (field != 0) {
        r.m = SOFT_SIGN | fraction >> 1;
        r.exponent = field - 1023;
    } else {
        int n = SOFT_CLZ(fraction);
        r.m = fraction << n;
        r.exponent = -1023 - n;
    }
    return r;
}

/* Rounds; more: the exact number is slightly further from 0 than m. */
SOFT_INLINE ulong soft_round(ulong sign, int exponent, ulong m, int more, int s, int e)
{
    int most = (1 << (e - 1)) - 1, least = 1 - most;
    int kept_bits = exponent >= least ? s + 1 : s + 1 - (least - exponent);
    int drop = 64 - kept_bits;
    if (exponent > most)
        return sign | SOFT_INFINITE;
    if (drop > 64)
        return sign;
    ulong kept = drop == 64 ? 0 : m >> drop;
    ulong rest = drop == 64 ? m : m & (((ulong)1 << drop) - 1);
    ulong middle = (ulong)1 << (drop - 1);
    kept += rest > middle || (rest == middle && (more || (kept & 1)));
    if (kept == 0)
        return sign;
    /* kept * 2^(exponent - kept_bits + 1), with 53 bits at most, or 2^53 */
    int top = 63 - SOFT_CLZ(kept), unit = exponent - kept_bits + 1;
    if (unit + top > most)
        return sign | SOFT_INFINITE;
    if (unit + top < -1022)
        return sign | kept << (unit + 1074);
    ulong fraction = top > 52 ? 0 : kept << (52 - top);
    return sign | (ulong)(unit + top + 1023) << 52 | (fraction & (((ulong)1 << 52) - 1));
}

SOFT_INLINE int soft_is_nan(ulong x)
{
    return (x & ~SOFT_SIGN) > SOFT_INFINITE;
}

SOFT_FUNCTION ulong soft_fit(ulong x, int s, int e)
{
    ulong magnitude = x & ~SOFT_SIGN;
    if (magnitude > SOFT_INFINITE)
        return SOFT_NAN;
    if (magnitude == SOFT_INFINITE || magnitude == 0)
        return x;
    soft_number a = soft_number_of(x);
    return soft_round(a.sign, a.exponent, a.m, 0, s, e);
}

/* The integer hi:lo, which is negative where `negative` is set. */
SOFT_FUNCTION ulong soft_whole(int negative, ulong lo, ulong hi, int s, int e)
{
    ulong sign = negative ? SOFT_SIGN : 0;
    if (hi == 0) {
        int n = lo ? SOFT_CLZ(lo) : 0;
        return lo ? soft_round(sign, 63 - n, lo << n, 0, s, e) : 0;
    }
    int n = SOFT_CLZ(hi);
    ulong m = n ? hi << n | lo >> (64 - n) : hi;
    return soft_round(sign, 127 - n, m, (lo << n) != 0, s, e);
}

SOFT_FUNCTION ulong soft_add(ulong x, ulong y, int s, int e)
{
    ulong u = x & ~SOFT_SIGN, v = y & ~SOFT_SIGN;
    if (u < v) {
        ulong t = x;
        x = y;
        y = t;
        t = u;
        u = v;
        v = t;
    }
    if (u >= SOFT_INFINITE)
        return u > SOFT_INFINITE || (v == SOFT_INFINITE && x != y) ? SOFT_NAN : x;
    if (u == 0)
        return x & y;
    if (v == 0)
        return soft_fit(x, s, e);
    soft_number a = soft_number_of(x), b = soft_number_of(y);
    int distance = a.exponent - b.exponent;
    /* 53 of the 64 bits are used: one above for a carry, ten below, the last of which collects
     * what is shifted out */
    ulong m = a.m >> 1, small = b.m >> 1;
    if (distance > 62)
        small = 1;
    else if (distance > 0)
        small = small >> distance | ((small << (64 - distance)) != 0);
    m = a.sign == b.sign ? m + small : m - small;
    if (m == 0)
        return 0;
    int n = SOFT_CLZ(m);
    return soft_round(a.sign, a.exponent + 1 - n, m << n, 0, s, e);
}

SOFT_FUNCTION ulong soft_multiply(ulong x, ulong y, int s, int e)
{
    ulong u = x & ~SOFT_SIGN, v = y & ~SOFT_SIGN, sign = (x ^ y) & SOFT_SIGN;
    if (u > SOFT_INFINITE || v > SOFT_INFINITE)
        return SOFT_NAN;
    if (u == SOFT_INFINITE || v == SOFT_INFINITE)
        return u == 0 || v == 0 ? SOFT_NAN : sign | SOFT_INFINITE;
    if (u == 0 || v == 0)
        return sign;
    soft_number a = soft_number_of(x), b = soft_number_of(y);
    ulong high = SOFT_HIGH(a.m, b.m), low = a.m * b.m;
    int exponent = a.exponent + b.exponent + 1;
    if (!(high >> 63)) {
        high = high << 1 | low >> 63;
        low <<= 1;
        exponent--;
    }
    return soft_round(sign, exponent, high, low != 0, s, e);
}

SOFT_FUNCTION ulong soft_divide(ulong x, ulong y, int s, int e)
{
    ulong u = x & ~SOFT_SIGN, v = y & ~SOFT_SIGN, sign = (x ^ y) & SOFT_SIGN;
    if (u > SOFT_INFINITE || v > SOFT_INFINITE)
        return SOFT_NAN;
    if (u == SOFT_INFINITE || v == 0)
        return u == v ? SOFT_NAN : sign | SOFT_INFINITE;
    if (u == 0 || v == SOFT_INFINITE)
        return sign;
    soft_number a = soft_number_of(x), b = soft_number_of(y);
    int exponent = a.exponent - b.exponent;
    ulong rest = a.m >> 11, by = b.m >> 11;
    if (rest < by) {
        rest <<= 1;
        exponent--;
    }
    /* one bit of the quotient, and five digits of eleven bits: the rest is below 2^53 */
    ulong quotient = 1;
    rest -= by;
    for (int i = 0; i < 5; i++) {
        rest <<= 11;
        ulong digit = rest / by;
        rest -= digit * by;
        quotient = quotient << 11 | digit;
    }
    return soft_round(sign, exponent, quotient << 8, rest != 0, s, e);
}

SOFT_FUNCTION ulong soft_root(ulong x, int s, int e)
{
    ulong u = x & ~SOFT_SIGN;
    if (u == 0)
        return x;
    if (u > SOFT_INFINITE || (x & SOFT_SIGN))
        return SOFT_NAN;
    if (u == SOFT_INFINITE)
        return x;
    soft_number a = soft_number_of(x);
    /* 54 bits, an even exponent; a bit of the root for every two, then for zeros after them */
    ulong square = a.m >> 11, root = 0, rest = 0;
    int odd = a.exponent & 1, exponent = (a.exponent - odd) / 2;
    square <<= 10 + odd;
    for (int i = 0; i < 56; i++) {
        rest = rest << 2 | square >> 62;
        square <<= 2;
        ulong next = root << 2 | 1;
        root <<= 1;
        if (rest >= next) {
            rest -= next;
            root |= 1;
        }
    }
    return soft_round(0, exponent, root << 8, rest != 0, s, e);
}

/* ---- as a field holds them: s + e + 1 bits ---- */

SOFT_FUNCTION ulong soft_pack(ulong x, int s, int e)
{
    ulong ones = ((ulong)1 << e) - 1, sign = (x >> 63) << (s + e);
    if (soft_is_nan(x)) { /* the upper bits of its fraction; where they are 0, the quiet one */
        ulong fraction = x << 12 >> (64 - s);
        return sign | ones << s | (fraction ? fraction : (ulong)1 << (s - 1));
    }
    x = soft_fit(x, s, e);
    if ((x & ~SOFT_SIGN) == SOFT_INFINITE)
        return sign | ones << s;
    if ((x & ~SOFT_SIGN) == 0)
        return sign;
    soft_number a = soft_number_of(x);
    int bias = (1 << (e - 1)) - 1, least = 1 - bias;
    if (a.exponent < least)
        return sign | a.m >> (63 - s + least - a.exponent);
    return sign | (ulong)(a.exponent + bias) << s | (a.m << 1) >> (64 - s);
}

SOFT_FUNCTION ulong soft_unpack(ulong bits, int s, int e)
{
    ulong ones = ((ulong)1 << e) - 1, sign = (bits >> (s + e)) << 63;
    ulong field = (bits >> s) & ones, fraction = bits & (((ulong)1 << s) - 1);
    int bias = (1 << (e - 1)) - 1;
    if (field == ones) /* infinite, or a NaN, whose bits are the upper ones */
        return sign | SOFT_INFINITE | fraction << (52 - s);
    if (field != 0)
        return soft_round(sign, (int)field - bias, SOFT_SIGN | fraction << (63 - s), 0, 52, 11);
    if (fraction == 0)
        return sign;
    int n = SOFT_CLZ(fraction);
    return soft_round(sign, 63 - n + 1 - bias - s, fraction << n, 0, 52, 11);
}

#ifdef __OPENCL_VERSION__
/* ---- of values ---- */

#define SOFT_FIT(x, s, e) as_double(soft_fit(as_ulong(x), s, e))
#define SOFT_ADD(x, y, s, e) as_double(soft_add(as_ulong(x), as_ulong(y), s, e))
#define SOFT_SUB(x, y, s, e) as_double(soft_add(as_ulong(x), as_ulong(y) ^ SOFT_SIGN, s, e))
#define SOFT_MUL(x, y, s, e) as_double(soft_multiply(as_ulong(x), as_ulong(y), s, e))
#define SOFT_DIV(x, y, s, e) as_double(soft_divide(as_ulong(x), as_ulong(y), s, e))
#define SOFT_ROOT(x, s, e) as_double(soft_root(as_ulong(x), s, e))
#define SOFT_PACK(x, s, e) soft_pack(as_ulong(x), s, e)
#define SOFT_UNPACK(bits, s, e) as_double(soft_unpack(bits, s, e))
/* a of 33..64 bits, extended; wider ones are pairs */
#define SOFT_FROM_U(a, s, e) as_double(soft_whole(0, a, 0, s, e))
#define SOFT_FROM_S(a, s, e)                                                                   \
    as_double(soft_whole((a) < 0, (a) < 0 ? -(ulong)(a) : (ulong)(a), 0, s, e))
#endif
