/* wide.cl - integers of 65..128 bits; part of kernels that use them. */
typedef struct {
    VL lo, hi;
} VQ;

static inline VQ q_of(VL lo, VL hi)
{
    VQ r;
    r.lo = lo;
    r.hi = hi;
    return r;
}

#if VECTOR == 1
static inline VQ load_q(const __global ulong *p, int i)
{
    return q_of(p[2 * i], p[2 * i + 1]);
}
static inline void store_q(__global ulong *p, int i, VQ v)
{
    p[2 * i] = v.lo;
    p[2 * i + 1] = v.hi;
}
#else
static inline VQ load_q(const __global ulong *p, int i)
{
    VL a = JOIN(vload, VECTOR)(0, p + 2 * i), b = JOIN(vload, VECTOR)(0, p + 2 * i + VECTOR);
    return q_of((VL)(a.even, b.even), (VL)(a.odd, b.odd));
}
static inline void store_q(__global ulong *p, int i, VQ v)
{
    VL a, b;
    a.even = v.lo.lo;
    a.odd = v.hi.lo;
    b.even = v.lo.hi;
    b.odd = v.hi.hi;
    JOIN(vstore, VECTOR)(a, 0, p + 2 * i);
    JOIN(vstore, VECTOR)(b, 0, p + 2 * i + VECTOR);
}
#endif
#define LOAD_u128(p, i) load_q(p, i)
#define OUT_u128(p, i, v) store_q(p, i, v)

static inline VQ q_signed(VM v) /* of 64 bits, made 128 */
{
    return q_of(AS_L(v), AS_L(v >> 63L));
}

#define SEL_Q(m, a, b) q_select(m, a, b)
static inline VQ q_select(VI m, VQ a, VQ b)
{
    return q_of(SEL_L(m, a.lo, b.lo), SEL_L(m, a.hi, b.hi));
}
static inline VQ q_and(VQ a, VQ b)
{
    return q_of(a.lo & b.lo, a.hi & b.hi);
}
static inline VQ q_or(VQ a, VQ b)
{
    return q_of(a.lo | b.lo, a.hi | b.hi);
}
static inline VQ q_xor(VQ a, VQ b)
{
    return q_of(a.lo ^ b.lo, a.hi ^ b.hi);
}
static inline VQ q_not(VQ a)
{
    return q_of(~a.lo, ~a.hi);
}
static inline VQ q_add(VQ a, VQ b)
{
    VL lo = a.lo + b.lo;
    return q_of(lo, a.hi + b.hi + SEL_L(CMP_L(lo < a.lo), (VL)(1), (VL)(0)));
}
static inline VQ q_sub(VQ a, VQ b)
{
    return q_of(a.lo - b.lo, a.hi - b.hi - SEL_L(CMP_L(a.lo < b.lo), (VL)(1), (VL)(0)));
}
static inline VQ q_neg(VQ a)
{
    return q_sub(q_of((VL)(0), (VL)(0)), a);
}
static inline VL high_product(VL a, VL b)
{
    VL al = a & 0xffffffffUL, ah = a >> 32, bl = b & 0xffffffffUL, bh = b >> 32;
    VL low = al * bl, m1 = ah * bl, m2 = al * bh;
    VL middle = (low >> 32) + (m1 & 0xffffffffUL) + (m2 & 0xffffffffUL);
    return ah * bh + (m1 >> 32) + (m2 >> 32) + (middle >> 32);
}
static inline VQ q_mul(VQ a, VQ b)
{
    return q_of(a.lo * b.lo, high_product(a.lo, b.lo) + a.lo * b.hi + a.hi * b.lo);
}
/* shifts by 0..127 */
static inline VQ q_shl(VQ a, int n)
{
    if (n == 0)
        return a;
    if (n >= 64)
        return q_of((VL)(0), a.lo << (ulong)(n - 64));
    return q_of(a.lo << (ulong)n, a.hi << (ulong)n | a.lo >> (ulong)(64 - n));
}
static inline VQ q_shr(VQ a, int n)
{
    if (n == 0)
        return a;
    if (n >= 64)
        return q_of(a.hi >> (ulong)(n - 64), (VL)(0));
    return q_of(a.lo >> (ulong)n | a.hi << (ulong)(64 - n), a.hi >> (ulong)n);
}
static inline VQ q_cut(VQ a, int width)
{
    return q_of(a.lo, width == 128 ? a.hi : a.hi & (((ulong)1 << (width - 64)) - 1));
}
/* the sign bit of a number of that width (65..128), as 0 or -1 */
static inline VI q_sign(VQ a, int width)
{
    return CMP_L(((a.hi >> (ulong)(width - 65)) & 1UL) != 0UL);
}
/* all 128 bits of a signed number of that width */
static inline VQ q_extended(VQ a, int width)
{
    ulong above = width == 128 ? 0UL : ~0UL << (width - 64);
    return q_of(a.lo, SEL_L(q_sign(a, width), a.hi | above, a.hi));
}
static inline VI q_eq(VQ a, VQ b)
{
    return CMP_L(a.lo == b.lo) & CMP_L(a.hi == b.hi);
}
static inline VI q_ult(VQ a, VQ b)
{
    return CMP_L(a.hi < b.hi) | (CMP_L(a.hi == b.hi) & CMP_L(a.lo < b.lo));
}
static inline VI q_slt(VQ a, VQ b, int width)
{
    VI sa = q_sign(a, width), sb = q_sign(b, width);
    return SEL_I(sa ^ sb, sa, q_ult(a, b));
}
static inline VQ q_magnitude(VQ a, int width)
{
    return q_select(q_sign(a, width), q_cut(q_neg(a), width), a);
}

/* a * b of unsigned numbers is 2^128 or more */
static inline VI q_product_carries(VQ a, VQ b)
{
    VL none = (VL)(0);
    VL m1 = a.hi * b.lo, m2 = a.lo * b.hi;
    VL h1 = high_product(a.hi, b.lo), h2 = high_product(a.lo, b.hi),
       low = high_product(a.lo, b.lo);
    VL s = low + m1;
    VI carries = CMP_L(s < low);
    VL t = s + m2;
    carries |= CMP_L(t < s);
    carries |= CMP_L(h1 != none) | CMP_L(h2 != none);
    return carries | (CMP_L(a.hi != none) & CMP_L(b.hi != none));
}
static inline VI q_umul_overflows(VQ a, VQ b, int width)
{
    VQ p = q_mul(a, b);
    VQ above = width == 128 ? q_of((VL)(0), (VL)(0)) : q_shr(p, width);
    return q_product_carries(a, b) | CMP_L((above.lo | above.hi) != (VL)(0));
}
static inline VI q_smul_overflows(VQ a, VQ b, int width)
{
    VQ ma = q_magnitude(a, width), mb = q_magnitude(b, width), p = q_mul(ma, mb);
    VI negative = q_sign(a, width) ^ q_sign(b, width);
    VQ limit =
        q_shl(q_of((VL)(1), (VL)(0)), width - 1); /* what a negative product may just reach */
    VI beyond = SEL_I(negative, q_ult(limit, p), ~q_ult(p, limit));
    return q_product_carries(ma, mb) | beyond;
}

/* of numbers of 33..64 bits, extended to 64 */
static inline VI l_smul_overflows(VM a, VM b, int width)
{
    VQ product = q_mul(q_signed(a), q_signed(b)),
       top = q_of((VL)(((ulong)1 << (width - 1)) - 1), (VL)(0));
    return q_slt(top, product, 128) | q_slt(product, q_not(top), 128);
}

/* ---- and floats ---- */

/* Rounds once, to nearest even: shifted so that 64 bits hold it; lost bits become a sticky
 * lowest bit. */
static inline VL q_leading(VQ a, VL *shift)
{
    VL n = (VL)(64) - clz(a.hi); /* 0 where 64 bits suffice, else 1..64: how far right */
    VL back = ((VL)(64) - n) & 63UL, m = n & 63UL;
    VI none = CMP_L(n == (VL)(0)), all = CMP_L(n == (VL)(64));
    VL kept = (a.lo >> m) | (a.hi << back);
    VL lost = a.lo << back;
    kept = SEL_L(all, a.hi, SEL_L(none, a.lo, kept));
    lost = SEL_L(all, a.lo, SEL_L(none, (VL)(0), lost));
    *shift = n;
    return kept | SEL_L(CMP_L(lost != (VL)(0)), (VL)(1), (VL)(0));
}
static inline VF q_to_f(VQ a)
{
    VL n;
    VL kept = q_leading(a, &n);
    /* 2^n as a float, in two steps: 2^64 is one, and the product may be infinite */
    VF scale = AS_F(CONVERT(uint, (n + 127UL)) << 23);
    return CONVERT(float, kept) * scale;
}
static inline VD q_to_d(VQ a)
{
    VL n;
    VL kept = q_leading(a, &n);
    return CONVERT(double, kept) * AS_D((n + 1023UL) << 52UL);
}
static inline VQ q_from_magnitude(VD v) /* 0 <= v < 2^128 */
{
    VL hi = CONVERT(ulong, v * 0x1p-64);
    VL lo = CONVERT(ulong, v - CONVERT(double, hi) * 0x1p64);
    return q_of(lo, hi);
}
static inline VQ d_to_uq(VD v, double limit, int width)
{
    VI inside = CMP_L(v > 0.0) & CMP_L(v < limit);
    VQ r = q_from_magnitude(SEL_D(inside, v, (VD)(0.0)));
    return q_select(CMP_L(v >= limit), q_cut(q_of((VL)(~0UL), (VL)(~0UL)), width), r);
}
static inline VQ d_to_sq(VD v, double limit, int width)
{
    VI inside = CMP_L(v > -limit) & CMP_L(v < limit);
    VQ r = q_from_magnitude(fabs(SEL_D(inside, v, (VD)(0.0))));
    r = q_select(CMP_L(v < 0.0), q_cut(q_neg(r), width), r);
    VQ least = q_shl(q_of((VL)(1), (VL)(0)), width - 1);
    r = q_select(CMP_L(v >= limit), q_sub(least, q_of((VL)(1), (VL)(0))), r);
    return q_select(CMP_L(v <= -limit), least, r);
}
