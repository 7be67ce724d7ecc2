/* math.cl - transcendental functions of doubles, in what OpenCL C and C have in common.
 *
 * Only operations that round correctly everywhere are used (+ - * / sqrt fma rint and
 * integers), so a function gives the same bits on every device and on the host, which compiles
 * this text too (host/machine/values/math_ops.c). Singles are computed as doubles and rounded.
 *
 * A number is carried as the sum of two doubles (struct math_dd) through the reductions, and a
 * function ends with one addition: results are within 0.6 ulp or so of the exact ones, in
 * subnormals within 1.2. Special cases are those of C, Annex F. The numbers are in
 * math_tables.cl.
 *
 *     reduction to ...                          then
 *     exp   |r| <= ln2 / 2, by r = x - k ln2    1 + r + r^2 P(r), times 2^k
 *     log   |r| <= 1/175, m = c (1 + r)         k ln2 + ln c + r - r^2/2 + r^3 P(r)
 *     sin   |r| <= pi/4, three doubles of pi    r + r^3 P(r^2), 1 - r^2/2 + r^4 P(r^2)
 *           up to 2^26, beyond that the bits
 *           of 2/pi that matter
 *     atan  |r| <= 1/32, from atan(i/16)        r + r^3 P(r^2)
 * and the others, in math_others.cl, from these. */

#ifdef VECTOR
#define MATH_FUNCTION static
#define MATH_BITS(x) as_ulong(x)
#define MATH_DOUBLE(x) as_double(x)
#define MATH_MUL_HI(a, b) mul_hi(a, b)
#define MATH_CLZ(x) ((int)clz(x))
typedef ulong math_u64;
typedef long math_i64;
#endif

struct math_dd {
    double hi, lo;
};

/* ---- pairs ---- */

MATH_FUNCTION struct math_dd dd_of(double hi, double lo)
{
    struct math_dd r;
    r.hi = hi;
    r.lo = lo;
    return r;
}
/* |a| >= |b|, or a is 0 */
MATH_FUNCTION struct math_dd dd_fast_sum(double a, double b)
{
    double s = a + b;
    return dd_of(s, b - (s - a));
}
MATH_FUNCTION struct math_dd dd_sum(double a, double b)
{
    double s = a + b, t = s - a;
    return dd_of(s, (a - (s - t)) + (b - t));
}
MATH_FUNCTION struct math_dd dd_product(double a, double b)
{
    double p = a * b;
    return dd_of(p, fma(a, b, -p));
}
MATH_FUNCTION struct math_dd dd_add(struct math_dd a, struct math_dd b)
{
    struct math_dd s = dd_sum(a.hi, b.hi), t = dd_sum(a.lo, b.lo);
    s = dd_fast_sum(s.hi, s.lo + t.hi);
    return dd_fast_sum(s.hi, s.lo + t.lo);
}
MATH_FUNCTION struct math_dd dd_negative(struct math_dd a)
{
    return dd_of(-a.hi, -a.lo);
}
MATH_FUNCTION struct math_dd dd_multiply(struct math_dd a, struct math_dd b)
{
    struct math_dd p = dd_product(a.hi, b.hi);
    return dd_fast_sum(p.hi, p.lo + fma(a.hi, b.lo, a.lo * b.hi));
}
MATH_FUNCTION struct math_dd dd_divide(struct math_dd a, struct math_dd b)
{
    double q = a.hi / b.hi;
    double r = fma(-q, b.hi, a.hi) + fma(-q, b.lo, a.lo);
    return dd_fast_sum(q, r / b.hi);
}
MATH_FUNCTION struct math_dd dd_sqrt(struct math_dd a)
{
    double s = sqrt(a.hi);
    if (s == 0.0)
        return dd_of(0.0, 0.0);
    return dd_fast_sum(s, (fma(-s, s, a.hi) + a.lo) / (2.0 * s));
}

/* ---- doubles as bits ---- */

MATH_FUNCTION double math_nan(void)
{
    return MATH_DOUBLE(0xfff8000000000000UL);
}
MATH_FUNCTION double math_infinity(void)
{
    return MATH_DOUBLE(0x7ff0000000000000UL);
}
MATH_FUNCTION int math_is_nan(double x)
{
    return !(x == x);
}
MATH_FUNCTION double math_with_sign(double x, double sign) /* x is positive */
{
    return MATH_DOUBLE(MATH_BITS(x) | (MATH_BITS(sign) & 0x8000000000000000UL));
}
MATH_FUNCTION int math_is_negative(double x)
{
    return (int)(MATH_BITS(x) >> 63);
}
/* 2^k, k -1022..1023 */
MATH_FUNCTION double math_power_of_two(int k)
{
    return MATH_DOUBLE((math_u64)(math_i64)(k + 1023) << 52);
}
/* x 2^k, rounded where it is subnormal; k -1100..1100. Two steps: 2^k alone may be none. */
MATH_FUNCTION double math_scale(double x, int k)
{
    if (k > 1000)
        return x * math_power_of_two(1000) * math_power_of_two(k - 1000);
    if (k < -1000)
        return x * math_power_of_two(-500) * math_power_of_two(k + 500);
    return x * math_power_of_two(k);
}
/* The exponent of a number that is not 0: x = m 2^e with 1 <= m < 2. */
MATH_FUNCTION int math_exponent(double x)
{
    int e = (int)(MATH_BITS(x) >> 52) & 2047;
    if (e == 0)
        return ((int)(MATH_BITS(x * 0x1p54) >> 52) & 2047) - 1077;
    return e - 1023;
}

/* ---- exponential ---- */

/* e^a = m 2^k with m about 0.7 to 1.42; a within +-750. */
MATH_FUNCTION struct math_dd exp_pair(struct math_dd a, int *k)
{
    double n = rint(a.hi * INVERSE_LN2_0);
    struct math_dd p = dd_product(n, LN2_1);
    struct math_dd r =
        dd_sum(a.hi - n * LN2_0, -p.hi); /* n LN2_0 is exact, so is what is left */
    r = dd_fast_sum(r.hi, r.lo + (a.lo - p.lo - n * LN2_2));
    double x = r.hi;
    double q = EXP_11;
    q = fma(q, x, EXP_10);
    q = fma(q, x, EXP_9);
    q = fma(q, x, EXP_8);
    q = fma(q, x, EXP_7);
    q = fma(q, x, EXP_6);
    q = fma(q, x, EXP_5);
    q = fma(q, x, EXP_4);
    q = fma(q, x, EXP_3);
    q = fma(q, x, EXP_2);
    q = fma(q, x, EXP_1);
    /* 1 + r + r^2/2 in pairs, what follows in a double */
    struct math_dd halved = dd_product(x, 0.5 * x), s = dd_fast_sum(1.0, x);
    struct math_dd t = dd_sum(s.hi, halved.hi);
    double low = x * x * fma(q, x, EXP_0 - 0.5);
    low += t.lo + s.lo + halved.lo + fma(r.lo, x, r.lo);
    *k = (int)n;
    return dd_fast_sum(t.hi, low);
}

/* e^a, rounded. */
MATH_FUNCTION double exp_rounded(struct math_dd a)
{
    int k;
    if (a.hi > 710.0)
        return math_infinity();
    if (a.hi < -746.0)
        return 0.0;
    struct math_dd m = exp_pair(a, &k);
    if (k <= -1022) { /* subnormal: rounded once, where its last bit is */
        double big = 1.5 * math_power_of_two(-1022 - k);
        struct math_dd s = dd_sum(big, m.hi);
        return math_scale(s.hi + (s.lo + m.lo) - big, k);
    }
    return math_scale(m.hi + m.lo, k);
}

MATH_FUNCTION double math_exp(double x)
{
    if (math_is_nan(x))
        return x;
    return exp_rounded(dd_of(x, 0.0));
}

/* ---- logarithms ---- */

/* ln(1 + r), |r| <= 1/175. */
MATH_FUNCTION struct math_dd log1p_small(struct math_dd r)
{
    double x = r.hi, q = LOG_7;
    q = fma(q, x, LOG_6);
    q = fma(q, x, LOG_5);
    q = fma(q, x, LOG_4);
    q = fma(q, x, LOG_3);
    q = fma(q, x, LOG_2);
    q = fma(q, x, LOG_1);
    q = fma(q, x, LOG_0);
    struct math_dd halved = dd_product(x, -0.5 * x), s = dd_fast_sum(x, halved.hi);
    double low = x * x * x * q;
    low += s.lo + halved.lo + fma(-x, r.lo, r.lo);
    return dd_fast_sum(s.hi, low);
}

/* ln a, a > 0 and finite. */
MATH_FUNCTION struct math_dd log_pair(struct math_dd a)
{
    int k = math_exponent(a.hi);
    struct math_dd m = dd_of(math_scale(a.hi, -k), math_scale(a.lo, -k));
    if (m.hi > 1.4142) {
        m = dd_of(0.5 * m.hi, 0.5 * m.lo);
        k++;
    }
    int i = (int)rint(m.hi * 128.0) - 90;
    double inverse = log_table[3 * i];
    struct math_dd p = dd_product(m.hi, inverse);
    struct math_dd r = dd_fast_sum(p.hi - 1.0, fma(m.lo, inverse, p.lo));
    struct math_dd s = log1p_small(r);
    if (i != 38)
        s = dd_add(dd_of(log_table[3 * i + 1], log_table[3 * i + 2]), s);
    if (k == 0)
        return s;
    double n = (double)k;
    return dd_add(dd_fast_sum(n * LN2_0, n * LN2_1), s);
}

/* ln(1 + z), z > -1/2. */
MATH_FUNCTION struct math_dd log1p_pair(struct math_dd z)
{
    if (fabs(z.hi) < 0.005)
        return log1p_small(z);
    struct math_dd s = dd_sum(1.0, z.hi);
    return log_pair(dd_fast_sum(s.hi, s.lo + z.lo));
}

/* The result of all logarithms where x is not a number above 0: *x, and 1. */
MATH_FUNCTION int log_special(double *x)
{
    if (math_is_nan(*x) || *x == math_infinity())
        return 1;
    if (*x == 0.0) {
        *x = -math_infinity();
        return 1;
    }
    if (*x < 0.0) {
        *x = math_nan();
        return 1;
    }
    return 0;
}

MATH_FUNCTION double math_ln(double x)
{
    if (log_special(&x))
        return x;
    struct math_dd r = log_pair(dd_of(x, 0.0));
    return r.hi + r.lo;
}

/* ln x times a number of two parts. */
MATH_FUNCTION double log_times(double x, double hi, double lo)
{
    if (log_special(&x))
        return x;
    struct math_dd r = dd_multiply(log_pair(dd_of(x, 0.0)), dd_of(hi, lo));
    return r.hi + r.lo;
}

MATH_FUNCTION double math_log2(double x)
{
    return log_times(x, INVERSE_LN2_0, INVERSE_LN2_1);
}

MATH_FUNCTION double math_log10(double x)
{
    return log_times(x, INVERSE_LN10_0, INVERSE_LN10_1);
}

/* ---- sine, cosine, tangent ---- */

/* x = n pi/2 + r, |r| <= pi/4, for a finite |x| >= 2^26; n modulo 4. x is m 2^e with a whole m
 * of 53 bits. Of x 2/pi, bits of weight 4 and up do not matter: what is left of 2/pi begins at
 * its bit e - 1, and 192 bits of that times m, modulo 2^192, are x 2/pi in units of 2^-190. */
MATH_FUNCTION struct math_dd angle_large(double x, int *n)
{
    math_u64 bits = MATH_BITS(x), m = (bits & 0xfffffffffffffUL) | 0x10000000000000UL;
    int e = ((int)(bits >> 52) & 2047) - 1075;
    int at = e + 62, word = at >> 6, up = at & 63;
    math_u64 w[3], p0, p1, p2, carry;
    for (int i = 0; i < 3; i++)
        w[i] = up ? two_over_pi[word + i] << up | two_over_pi[word + i + 1] >> (64 - up)
                  : two_over_pi[word + i];
    p2 = w[2] * m;
    carry = MATH_MUL_HI(w[2], m);
    p1 = w[1] * m + carry;
    p0 = w[0] * m + MATH_MUL_HI(w[1], m) + (p1 < carry ? 1UL : 0UL);
    *n = (int)(p0 >> 62);
    math_u64 high = p0 << 2 | p1 >> 62, low = p1 << 2 | p2 >> 62;
    int minus = (int)(high >> 63);
    if (minus) { /* nearer to the next */
        *n = (*n + 1) & 3;
        low = ~low + 1UL;
        high = ~high + (low == 0UL ? 1UL : 0UL);
    }
    int zeros = 0;
    if (high == 0UL) {
        high = low;
        low = 0UL;
        zeros = 64;
    }
    if (high == 0UL)
        return dd_of(0.0, 0.0); /* no double is that near */
    int shift = MATH_CLZ(high);
    if (shift) {
        high = high << shift | low >> (64 - shift);
        low <<= shift;
        zeros += shift;
    }
    double unit = math_power_of_two(-53 - zeros);
    struct math_dd f;
    f.hi = (double)(high >> 11) * unit;
    f.lo = (double)(high << 53 | low >> 11) * 0x1p-64 * unit;
    if (minus ^ (int)(bits >> 63))
        f = dd_negative(f);
    if (bits >> 63)
        *n = (4 - *n) & 3;
    return dd_multiply(f, dd_of(HALF_PI_0, HALF_PI_1));
}

MATH_FUNCTION struct math_dd angle_reduced(double x, int *n)
{
    *n = 0;
    if (fabs(x) <= 0.785)
        return dd_of(x, 0.0);
    if (fabs(x) >= 0x1p26)
        return angle_large(x, n);
    double k = rint(x * TWO_OVER_PI_0);
    struct math_dd p = dd_product(k, HALF_PI_0), q = dd_product(k, HALF_PI_1);
    struct math_dd r = dd_sum(x - p.hi, -p.lo), s = dd_sum(r.hi, -q.hi);
    *n = (int)k & 3;
    return dd_fast_sum(s.hi, s.lo + (r.lo - q.lo - k * HALF_PI_2));
}

MATH_FUNCTION struct math_dd sin_small(struct math_dd r)
{
    double x = r.hi, s = x * x, q = SIN_7;
    q = fma(q, s, SIN_6);
    q = fma(q, s, SIN_5);
    q = fma(q, s, SIN_4);
    q = fma(q, s, SIN_3);
    q = fma(q, s, SIN_2);
    q = fma(q, s, SIN_1);
    q = fma(q, s, SIN_0);
    return dd_fast_sum(x, fma(x * s, q, fma(-0.5 * s, r.lo, r.lo)));
}

MATH_FUNCTION struct math_dd cos_small(struct math_dd r)
{
    double x = r.hi, q = COS_7;
    struct math_dd s = dd_product(x, x), t = dd_fast_sum(1.0, -0.5 * s.hi);
    q = fma(q, s.hi, COS_6);
    q = fma(q, s.hi, COS_5);
    q = fma(q, s.hi, COS_4);
    q = fma(q, s.hi, COS_3);
    q = fma(q, s.hi, COS_2);
    q = fma(q, s.hi, COS_1);
    q = fma(q, s.hi, COS_0);
    return dd_fast_sum(t.hi, t.lo - 0.5 * s.lo - x * r.lo + s.hi * s.hi * q);
}

/* sin(x + quarters pi/2) */
MATH_FUNCTION double sin_from(double x, int quarters)
{
    int n;
    if (math_is_nan(x) || fabs(x) == math_infinity())
        return math_nan();
    struct math_dd r = angle_reduced(x, &n);
    n = (n + quarters) & 3;
    r = n & 1 ? cos_small(r) : sin_small(r);
    double y = r.hi + r.lo;
    return n & 2 ? -y : y;
}

MATH_FUNCTION double math_sin(double x)
{
    return fabs(x) < 0x1p-27 ? x : sin_from(x, 0);
}

MATH_FUNCTION double math_cos(double x)
{
    return sin_from(x, 1);
}

MATH_FUNCTION double math_tan(double x)
{
    int n;
    if (math_is_nan(x) || fabs(x) == math_infinity())
        return math_nan();
    if (fabs(x) < 0x1p-27)
        return x;
    struct math_dd r = angle_reduced(x, &n), s = sin_small(r), c = cos_small(r);
    r = n & 1 ? dd_divide(dd_negative(c), s) : dd_divide(s, c);
    return r.hi + r.lo;
}

/* ---- inverse tangent, sine, cosine ---- */

/* The angle of the point (x, y), both at least 0, not both 0, neither so small or large that a
 * product of two leaves the range. */
MATH_FUNCTION struct math_dd angle_pair(struct math_dd y, struct math_dd x)
{
    int steep = y.hi > x.hi;
    struct math_dd a = steep ? x : y, b = steep ? y : x;
    double c = rint(16.0 * (a.hi / b.hi));
    int i = (int)c;
    struct math_dd t;
    if (i == 0) {
        t = dd_divide(a, b);
    } else {
        struct math_dd cc = dd_of(c * 0.0625, 0.0);
        t = dd_divide(dd_add(a, dd_negative(dd_multiply(cc, b))),
                      dd_add(b, dd_multiply(cc, a)));
    }
    double s = t.hi * t.hi, q = ATAN_5;
    q = fma(q, s, ATAN_4);
    q = fma(q, s, ATAN_3);
    q = fma(q, s, ATAN_2);
    q = fma(q, s, ATAN_1);
    q = fma(q, s, ATAN_0);
    t = dd_fast_sum(t.hi, fma(t.hi * s, q, t.lo));
    if (i)
        t = dd_add(dd_of(atan_table[2 * i], atan_table[2 * i + 1]), t);
    return steep ? dd_add(dd_of(HALF_PI_0, HALF_PI_1), dd_negative(t)) : t;
}

MATH_FUNCTION double math_atan(double x)
{
    if (math_is_nan(x) || fabs(x) < 0x1p-27)
        return x;
    if (fabs(x) >= 0x1p60)
        return math_with_sign(HALF_PI_0, x);
    struct math_dd r = angle_pair(dd_of(fabs(x), 0.0), dd_of(1.0, 0.0));
    return math_with_sign(r.hi + r.lo, x);
}

/* sqrt(1 - x^2) */
MATH_FUNCTION struct math_dd other_leg(double x)
{
    struct math_dd p = dd_product(x, x), s = dd_sum(1.0, -p.hi);
    return dd_sqrt(dd_fast_sum(s.hi, s.lo - p.lo));
}

MATH_FUNCTION double math_asin(double x)
{
    if (!(fabs(x) <= 1.0))
        return math_nan();
    if (fabs(x) < 0x1p-27)
        return x;
    struct math_dd r = angle_pair(dd_of(fabs(x), 0.0), other_leg(x));
    return math_with_sign(r.hi + r.lo, x);
}

MATH_FUNCTION double math_acos(double x)
{
    if (!(fabs(x) <= 1.0))
        return math_nan();
    struct math_dd r = angle_pair(other_leg(x), dd_of(fabs(x), 0.0));
    if (x < 0.0)
        r = dd_add(dd_of(PI_0, PI_1), dd_negative(r));
    return r.hi + r.lo;
}

MATH_FUNCTION double math_atan2(double y, double x)
{
    if (math_is_nan(x) || math_is_nan(y))
        return math_nan();
    double a = fabs(y), b = fabs(x);
    int left = math_is_negative(x);
    struct math_dd r;
    if (a == 0.0)
        return math_with_sign(left ? PI_0 : 0.0, y);
    if (b == 0.0)
        return math_with_sign(HALF_PI_0, y);
    if (a == math_infinity() || b == math_infinity()) {
        if (a == b)
            return math_with_sign(left ? 0x1.2d97c7f3321d2p+1 : 0.5 * HALF_PI_0,
                                  y); /* 3 pi/4 */
        if (a > b)
            return math_with_sign(HALF_PI_0, y);
        return math_with_sign(left ? PI_0 : 0.0, y);
    }
    int ea = math_exponent(a), eb = math_exponent(b);
    if (ea - eb > 64)
        return math_with_sign(HALF_PI_0, y);
    if (eb - ea > 64)
        return math_with_sign(left ? PI_0 : a / b, y);
    int e = ea > eb ? ea : eb;
    r = angle_pair(dd_of(math_scale(a, -e), 0.0), dd_of(math_scale(b, -e), 0.0));
    if (left)
        r = dd_add(dd_of(PI_0, PI_1), dd_negative(r));
    return math_with_sign(r.hi + r.lo, y);
}
