/* integers.cl - quotients, powers, shifts and counts of integers; part of kernels that use
 * them.
 *
 * Names end in the container: U for 2..32 bits, L for 33..64, Q for 65..128 (after wide.cl,
 * one lane). The unused high bits of operands are 0, and so are those of results of
 * functions with a width w; other results are cut by the caller. Division by zero is
 * defined: the quotient is 0, the remainder is the dividend. Signed numbers are divided as
 * magnitudes, so the least number divided by -1 needs no special case.
 */

/* Not inline: kernels with many copies would compile for seconds. */
#define HEAVY static __attribute__((noinline))

#define QUOTIENT_TRUNCATE 0
#define QUOTIENT_FLOOR 1
#define QUOTIENT_CEILING 2
#define QUOTIENT_ROUND 3

/* ---- quotients of numbers without a sign ---- */

HEAVY VU quotient_U(VU a, VU b)
{
    VI none = CMP_U(b == (VU)(0));
    VU d = SEL_U(none, (VU)(1), b);
#if VECTOR == 1
    VU q = a / d;
#else /* exact: a fraction is further from the next whole number than a double's rounding
       * error */
    VU q = CONVERT(uint, CONVERT(double, a) / CONVERT(double, d));
#endif
    return SEL_U(none, (VU)(0), q);
}

HEAVY VL quotient_L(VL a, VL b)
{
    VI none = CMP_L(b == (VL)(0));
    VL d = SEL_L(none, (VL)(1), b);
    return SEL_L(none, (VL)(0), a / d);
}

HEAVY VU square_root_U(VU a) /* a double's root is exact enough, as above */
{
    return CONVERT(uint, sqrt(CONVERT(double, a)));
}

HEAVY VL square_root_L(VL a)
{
    VL r = CONVERT(ulong, sqrt(CONVERT(double, a)));
    r = min(r, (VL)(0xffffffffUL));
    for (int i = 0; i < 2; i++) {
        VL up = min(r + (VL)(1), (VL)(0xffffffffUL));
        r = SEL_L(CMP_L(r * r > a), r - (VL)(1), SEL_L(CMP_L(up * up <= a), up, r));
    }
    return r;
}

#define population_U popcount
#define population_L popcount

/* ---- the same text for both containers ---- */

/* X, vector, signed vector, suffix of numbers, bits; conversions to these from VU */
#define INTEGERS(X, V, S, ONE, BITS, CMP, SEL, AS_V, AS_S_, FROM_U)                            \
    static inline V ones_##X(int w)                                                            \
    {                                                                                          \
        return (V)(~(ONE - ONE) >> (BITS - w));                                                \
    }                                                                                          \
    static inline VI sign_##X(V a, int w)                                                      \
    {                                                                                          \
        return CMP(((a >> (ONE * (w - 1))) & (V)(ONE)) != (V)(0));                             \
    }                                                                                          \
    static inline V negated_##X(V a, int w)                                                    \
    {                                                                                          \
        return ((V)(0) - a) & ones_##X(w);                                                     \
    }                                                                                          \
    static inline V magnitude_##X(V a, int w)                                                  \
    {                                                                                          \
        return SEL(sign_##X(a, w), negated_##X(a, w), a);                                      \
    }                                                                                          \
    /* a / b, to be negated where negative says so */                                          \
    HEAVY V rounded_##X(V a, V b, VI negative, int how)                                        \
    {                                                                                          \
        V q = quotient_##X(a, b), r = a - q * b;                                               \
        VI inexact = CMP(r != (V)(0)) & CMP(b != (V)(0)), up = (VI)(0);                        \
        if (how == QUOTIENT_FLOOR)                                                             \
            up = inexact & negative;                                                           \
        if (how == QUOTIENT_CEILING)                                                           \
            up = inexact & ~negative;                                                          \
        if (how == QUOTIENT_ROUND)                                                             \
            up = inexact &                                                                     \
                 (CMP(r > b - r) | (CMP(r == b - r) & CMP((q & (V)(ONE)) != (V)(0))));         \
        return SEL(up, q + (V)(ONE), q);                                                       \
    }                                                                                          \
    HEAVY V u_divided_##X(V a, V b, int how)                                                   \
    {                                                                                          \
        return rounded_##X(a, b, (VI)(0), how);                                                \
    }                                                                                          \
    HEAVY V s_divided_##X(V a, V b, int w, int how)                                            \
    {                                                                                          \
        VI negative = sign_##X(a, w) ^ sign_##X(b, w);                                         \
        V q = rounded_##X(magnitude_##X(a, w), magnitude_##X(b, w), negative, how);            \
        return SEL(negative, negated_##X(q, w), q);                                            \
    }                                                                                          \
    HEAVY V u_remainder_##X(V a, V b)                                                          \
    {                                                                                          \
        return a - quotient_##X(a, b) * b;                                                     \
    }                                                                                          \
    HEAVY V s_remainder_##X(V a, V b, int w)                                                   \
    {                                                                                          \
        V r = u_remainder_##X(magnitude_##X(a, w), magnitude_##X(b, w));                       \
        return SEL(sign_##X(a, w), negated_##X(r, w), r);                                      \
    }                                                                                          \
    HEAVY V s_modulus_##X(V a, V b, int w)                                                     \
    {                                                                                          \
        VI sa = sign_##X(a, w), sb = sign_##X(b, w);                                           \
        V mb = magnitude_##X(b, w), r = u_remainder_##X(magnitude_##X(a, w), mb);              \
        r = SEL((sa ^ sb) & CMP(r != (V)(0)), mb - r, r);                                      \
        return SEL(sb, negated_##X(r, w), r & ones_##X(w));                                    \
    }                                                                                          \
    HEAVY V power_##X(V a, V b)                                                                \
    {                                                                                          \
        V r = (V)(ONE);                                                                        \
        for (int i = 0; i < BITS && any(CMP(b != (V)(0))); i++) {                              \
            r = SEL(CMP((b & (V)(ONE)) != (V)(0)), r * a, r);                                  \
            a *= a;                                                                            \
            b >>= (V)(ONE);                                                                    \
        }                                                                                      \
        return r;                                                                              \
    }                                                                                          \
    static inline VI product_beyond_##X(V a, V b, int w)                                       \
    {                                                                                          \
        return CMP(mul_hi(a, b) != (V)(0)) | CMP((a * b & ~ones_##X(w)) != (V)(0));            \
    }                                                                                          \
    HEAVY VI u_power_beyond_##X(V a, V b, int w)                                               \
    {                                                                                          \
        V r = (V)(ONE);                                                                        \
        VI beyond = (VI)(0), square = (VI)(0);                                                 \
        for (int i = 0; i < BITS && any(CMP(b != (V)(0))); i++) {                              \
            VI takes = CMP((b & (V)(ONE)) != (V)(0));                                          \
            beyond |= takes & (square | product_beyond_##X(r, a, w));                          \
            r = SEL(takes, r * a, r);                                                          \
            square |= product_beyond_##X(a, a, w);                                             \
            a *= a;                                                                            \
            b >>= (V)(ONE);                                                                    \
        }                                                                                      \
        return beyond;                                                                         \
    }                                                                                          \
    HEAVY VI s_power_beyond_##X(V a, V b, int w)                                               \
    {                                                                                          \
        V m = magnitude_##X(a, w), p = power_##X(m, b) & ones_##X(w);                          \
        VI negative = sign_##X(a, w) & CMP((b & (V)(ONE)) != (V)(0));                          \
        V limit = (V)(ONE << (w - 1));                                                         \
        VI fits = CMP(p < limit) | (negative & CMP(p == limit));                               \
        return ~fits | u_power_beyond_##X(m, b, w);                                            \
    }                                                                                          \
    static inline V u_shifted_##X(V a, VU count)                                               \
    {                                                                                          \
        VI n = AS_S(count), left = CMP_U(n >= (VI)(0)), by = SEL_U(left, n, -n);               \
        V s = FROM_U(AS_U(by & (VI)(BITS - 1)));                                               \
        V r = SEL(left, a << s, a >> s);                                                       \
        return SEL(CMP_U(by >= (VI)(BITS)), (V)(0), r);                                        \
    }                                                                                          \
    static inline V s_shifted_##X(V a, VU count, int w)                                        \
    {                                                                                          \
        VI n = AS_S(count), left = CMP_U(n >= (VI)(0)), by = SEL_U(left, n, -n);               \
        V l = FROM_U(AS_U(by & (VI)(BITS - 1))), r = FROM_U(AS_U(min(by, (VI)(BITS - 1))));    \
        S x = AS_S_(SEL(sign_##X(a, w), a | ~ones_##X(w), a));                                 \
        V moved = SEL(left, a << l, AS_V(x >> AS_S_(r)));                                      \
        return SEL(left & CMP_U(by >= (VI)(BITS)), (V)(0), moved);                             \
    }                                                                                          \
    static inline V rotated_##X(V a, VU count, int w)                                          \
    {                                                                                          \
        V n = FROM_U(count);                                                                   \
        return (a << n) | (a >> (((V)(ONE * w) - n) & (V)(BITS - 1)));                         \
    }                                                                                          \
    static inline V bits_length_##X(V a)                                                       \
    {                                                                                          \
        return (V)(BITS)-clz(a);                                                               \
    }                                                                                          \
    static inline V from_gray_##X(V a)                                                         \
    {                                                                                          \
        for (int i = 1; i < BITS; i *= 2)                                                      \
            a ^= a >> (V)(ONE * i);                                                            \
        return a;                                                                              \
    }

#define SAME(v) (v)
#define TO_L(v) CONVERT(ulong, v)
INTEGERS(U, VU, VI, 1u, 32, CMP_U, SEL_U, AS_U, AS_S, SAME)
INTEGERS(L, VL, VM, 1UL, 64, CMP_L, SEL_L, AS_L, AS_M, TO_L)

HEAVY VU reversed_U(VU a, int w)
{
    a = ((a >> 1) & 0x55555555u) | ((a & 0x55555555u) << 1);
    a = ((a >> 2) & 0x33333333u) | ((a & 0x33333333u) << 2);
    a = ((a >> 4) & 0x0f0f0f0fu) | ((a & 0x0f0f0f0fu) << 4);
    a = ((a >> 8) & 0x00ff00ffu) | ((a & 0x00ff00ffu) << 8);
    a = (a >> 16) | (a << 16);
    return a >> (VU)(32 - w);
}

HEAVY VL reversed_L(VL a, int w)
{
    a = ((a >> 1UL) & 0x5555555555555555UL) | ((a & 0x5555555555555555UL) << 1UL);
    a = ((a >> 2UL) & 0x3333333333333333UL) | ((a & 0x3333333333333333UL) << 2UL);
    a = ((a >> 4UL) & 0x0f0f0f0f0f0f0f0fUL) | ((a & 0x0f0f0f0f0f0f0f0fUL) << 4UL);
    a = ((a >> 8UL) & 0x00ff00ff00ff00ffUL) | ((a & 0x00ff00ff00ff00ffUL) << 8UL);
    a = ((a >> 16UL) & 0x0000ffff0000ffffUL) | ((a & 0x0000ffff0000ffffUL) << 16UL);
    a = (a >> 32UL) | (a << 32UL);
    return a >> (VL)(64 - w);
}

/* ---- 65..128 bits: one lane, see rows.c ---- */

#if defined(LOAD_u128) && VECTOR == 1
static inline VQ q_small(ulong a)
{
    return q_of(a, 0);
}

static inline int q_bits_length(VQ a)
{
    return a.hi ? 128 - (int)clz(a.hi) : 64 - (int)clz(a.lo);
}

HEAVY VQ q_quotient(VQ a, VQ b)
{
    VQ q = q_small(0);
    if ((b.lo | b.hi) == 0)
        return q;
    if ((a.hi | b.hi) == 0)
        return q_small(a.lo / b.lo);
    int n = q_bits_length(a) - q_bits_length(b);
    if (n < 0)
        return q;
    for (b = q_shl(b, n); n >= 0; n--) {
        q = q_shl(q, 1);
        if (!q_ult(a, b)) {
            a = q_sub(a, b);
            q.lo |= 1;
        }
        b = q_shr(b, 1);
    }
    return q;
}

HEAVY VQ q_rounded(VQ a, VQ b, VI negative, int how)
{
    VQ q = q_quotient(a, b), r = q_sub(a, q_mul(q, b)), rest = q_sub(b, r);
    VI up = 0;
    if ((r.lo | r.hi) == 0 || (b.lo | b.hi) == 0)
        return q;
    if (how == QUOTIENT_FLOOR)
        up = negative;
    if (how == QUOTIENT_CEILING)
        up = ~negative;
    if (how == QUOTIENT_ROUND)
        up = q_ult(rest, r) | (q_eq(rest, r) & -(int)(q.lo & 1));
    return up ? q_add(q, q_small(1)) : q;
}

static inline VQ q_signed_as(VQ magnitude, VI negative, int w)
{
    return q_cut(negative ? q_neg(magnitude) : magnitude, w);
}

HEAVY VQ u_divided_Q(VQ a, VQ b, int how)
{
    return q_rounded(a, b, 0, how);
}

HEAVY VQ s_divided_Q(VQ a, VQ b, int w, int how)
{
    VI negative = q_sign(a, w) ^ q_sign(b, w);
    return q_signed_as(q_rounded(q_magnitude(a, w), q_magnitude(b, w), negative, how), negative,
                       w);
}

HEAVY VQ u_remainder_Q(VQ a, VQ b)
{
    return q_sub(a, q_mul(q_quotient(a, b), b));
}

HEAVY VQ s_remainder_Q(VQ a, VQ b, int w)
{
    return q_signed_as(u_remainder_Q(q_magnitude(a, w), q_magnitude(b, w)), q_sign(a, w), w);
}

HEAVY VQ s_modulus_Q(VQ a, VQ b, int w)
{
    VI sa = q_sign(a, w), sb = q_sign(b, w);
    VQ mb = q_magnitude(b, w), r = u_remainder_Q(q_magnitude(a, w), mb);
    if ((sa ^ sb) && (r.lo | r.hi))
        r = q_sub(mb, r);
    return q_signed_as(r, sb, w);
}

HEAVY VQ power_Q(VQ a, VQ b)
{
    VQ r = q_small(1);
    while (b.lo | b.hi) {
        if (b.lo & 1)
            r = q_mul(r, a);
        a = q_mul(a, a);
        b = q_shr(b, 1);
    }
    return r;
}

HEAVY VI u_power_beyond_Q(VQ a, VQ b, int w)
{
    VQ r = q_small(1);
    VI beyond = 0, square = 0;
    while (b.lo | b.hi) {
        if (b.lo & 1) {
            beyond |= square | q_umul_overflows(r, a, w);
            r = q_mul(r, a);
        }
        square |= q_umul_overflows(a, a, w);
        a = q_mul(a, a);
        b = q_shr(b, 1);
    }
    return beyond;
}

HEAVY VI s_power_beyond_Q(VQ a, VQ b, int w)
{
    VQ m = q_magnitude(a, w), p = q_cut(power_Q(m, b), w);
    VI negative = q_sign(a, w) & -(int)(b.lo & 1);
    VQ limit = q_shl(q_small(1), w - 1);
    VI fits = q_ult(p, limit) | (negative & q_eq(p, limit));
    return ~fits | u_power_beyond_Q(m, b, w);
}

HEAVY VQ u_shifted_Q(VQ a, VU count)
{
    int n = (int)count;
    if (n >= 128 || n <= -128)
        return q_small(0);
    return n >= 0 ? q_shl(a, n) : q_shr(a, -n);
}

HEAVY VQ s_shifted_Q(VQ a, VU count, int w)
{
    int n = (int)count;
    if (n >= 0)
        return u_shifted_Q(a, count);
    n = min(-n, 127);
    VQ x = q_extended(a, w), r = q_shr(x, n);
    return (long)x.hi < 0 ? q_or(r, q_shl(q_of(~0UL, ~0UL), 128 - n)) : r;
}

HEAVY VQ rotated_Q(VQ a, VU count, int w)
{
    int n = (int)count;
    return n ? q_or(q_shl(a, n), q_shr(a, w - n)) : a;
}

static inline VQ bits_length_Q(VQ a)
{
    return q_small((ulong)q_bits_length(a));
}

static inline VQ population_Q(VQ a)
{
    return q_small(popcount(a.lo) + popcount(a.hi));
}

HEAVY VQ from_gray_Q(VQ a)
{
    for (int i = 1; i < 128; i *= 2)
        a = q_xor(a, q_shr(a, i));
    return a;
}

HEAVY VQ reversed_Q(VQ a, int w)
{
    return q_shr(q_of(reversed_L(a.hi, 64), reversed_L(a.lo, 64)), 128 - w);
}

HEAVY VQ square_root_Q(VQ a)
{
    VQ r = q_small(0);
    for (int bit = 63; bit >= 0; bit--) {
        VQ t = q_small(r.lo | 1UL << bit);
        if (!q_ult(a, q_mul(t, t)))
            r = t;
    }
    return r;
}
#endif
