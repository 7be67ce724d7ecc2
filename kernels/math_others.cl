/* math_others.cl - the functions that are made of those in math.cl, which comes before:
 * hyperbolic ones, powers, remainders, scaling; and all of them lane by lane. */

/* ---- hyperbolic ---- */

/* |x| <= 1/2 */
MATH_FUNCTION struct math_dd sinh_small(double x)
{
    double s = x * x, q = SINH_6;
    q = fma(q, s, SINH_5);
    q = fma(q, s, SINH_4);
    q = fma(q, s, SINH_3);
    q = fma(q, s, SINH_2);
    q = fma(q, s, SINH_1);
    q = fma(q, s, SINH_0);
    return dd_fast_sum(x, x * s * q);
}

MATH_FUNCTION struct math_dd cosh_small(double x)
{
    struct math_dd s = dd_product(x, x), t = dd_fast_sum(1.0, 0.5 * s.hi);
    double q = COSH_6;
    q = fma(q, s.hi, COSH_5);
    q = fma(q, s.hi, COSH_4);
    q = fma(q, s.hi, COSH_3);
    q = fma(q, s.hi, COSH_2);
    q = fma(q, s.hi, COSH_1);
    q = fma(q, s.hi, COSH_0);
    return dd_fast_sum(t.hi, t.lo + 0.5 * s.lo + s.hi * s.hi * q);
}

/* e^x / 2 2^-k and e^-x / 2 2^-k, 0 <= x < 750 */
MATH_FUNCTION void exp_both(double x, struct math_dd *plus, struct math_dd *minus, int *k)
{
    *plus = exp_pair(dd_of(x, 0.0), k);
    plus->hi *= 0.5;
    plus->lo *= 0.5;
    *minus = dd_of(0.0, 0.0);
    if (*k < 60) { /* e^-x = 1 / (m 2^k), so the other is 2^-2k / 4 over this one */
        double unit = math_power_of_two(-2 * *k - 2);
        *minus = dd_divide(dd_of(unit, 0.0), *plus);
    }
}

MATH_FUNCTION double math_sinh(double x)
{
    double a = fabs(x);
    struct math_dd p, q;
    int k;
    if (math_is_nan(x) || a < 0x1p-27)
        return x;
    if (a <= 0.5) {
        p = sinh_small(x);
        return p.hi + p.lo;
    }
    if (a > 720.0)
        return math_with_sign(math_infinity(), x);
    exp_both(a, &p, &q, &k);
    p = dd_add(p, dd_negative(q));
    return math_with_sign(math_scale(p.hi + p.lo, k), x);
}

MATH_FUNCTION double math_cosh(double x)
{
    double a = fabs(x);
    struct math_dd p, q;
    int k;
    if (math_is_nan(x))
        return x;
    if (a <= 0.5) {
        p = cosh_small(x);
        return p.hi + p.lo;
    }
    if (a > 720.0)
        return math_infinity();
    exp_both(a, &p, &q, &k);
    p = dd_add(p, q);
    return math_scale(p.hi + p.lo, k);
}

MATH_FUNCTION double math_tanh(double x)
{
    double a = fabs(x);
    struct math_dd p, q;
    int k;
    if (math_is_nan(x) || a < 0x1p-27)
        return x;
    if (a > 24.0)
        return math_with_sign(1.0, x);
    if (a <= 0.5) {
        p = dd_divide(sinh_small(x), cosh_small(x));
        return p.hi + p.lo;
    }
    exp_both(a, &p, &q, &k);
    p = dd_divide(dd_add(p, dd_negative(q)), dd_add(p, q));
    return math_with_sign(p.hi + p.lo, x);
}

MATH_FUNCTION double math_asinh(double x)
{
    double a = fabs(x);
    struct math_dd r;
    if (math_is_nan(x) || a < 0x1p-27 || a == math_infinity())
        return x;
    if (a > 0x1p30) {
        r = dd_add(log_pair(dd_of(a, 0.0)), dd_fast_sum(LN2_0, LN2_1));
    } else { /* ln(1 + x + x^2 / (1 + sqrt(1 + x^2))) */
        struct math_dd s = dd_product(a, a), one = dd_of(1.0, 0.0);
        struct math_dd root = dd_sqrt(dd_add(one, s));
        s = dd_divide(s, dd_add(one, root));
        r = log1p_pair(dd_add(dd_of(a, 0.0), s));
    }
    return math_with_sign(r.hi + r.lo, x);
}

MATH_FUNCTION double math_acosh(double x)
{
    struct math_dd r;
    if (!(x >= 1.0))
        return math_nan();
    if (x == math_infinity())
        return x;
    if (x > 0x1p30) {
        r = dd_add(log_pair(dd_of(x, 0.0)), dd_fast_sum(LN2_0, LN2_1));
    } else { /* with t = x - 1: ln(1 + t + sqrt(2t + t^2)) */
        struct math_dd t = dd_sum(x, -1.0);
        struct math_dd s = dd_multiply(t, dd_add(t, dd_of(2.0, 0.0)));
        r = log1p_pair(dd_add(t, dd_sqrt(s)));
    }
    return r.hi + r.lo;
}

MATH_FUNCTION double math_atanh(double x)
{
    double a = fabs(x);
    if (!(a <= 1.0))
        return math_nan();
    if (a < 0x1p-27)
        return x;
    if (a == 1.0)
        return math_with_sign(math_infinity(), x);
    struct math_dd z = dd_divide(dd_of(2.0 * a, 0.0), dd_sum(1.0, -a));
    struct math_dd r = log1p_pair(z);
    return math_with_sign(0.5 * (r.hi + r.lo), x);
}

/* ---- power ---- */

MATH_FUNCTION double math_pow(double x, double y)
{
    double a = fabs(x), b = fabs(y), inf = math_infinity();
    if (y == 0.0 || x == 1.0)
        return 1.0;
    if (math_is_nan(x) || math_is_nan(y))
        return math_nan();
    int is_whole = b >= 0x1p52 || rint(b) == b;
    int is_odd = is_whole && b < 0x1p53 && rint(0.5 * b) != 0.5 * b;
    double r;
    if (a == 0.0) {
        r = y < 0.0 ? inf : 0.0;
    } else if (b == inf) {
        if (a == 1.0)
            return 1.0;
        return (a > 1.0) == (y > 0.0) ? inf : 0.0;
    } else if (a == inf) {
        r = y < 0.0 ? 0.0 : inf;
    } else if (x < 0.0 && !is_whole) {
        return math_nan();
    } else if (a == 1.0) {
        r = 1.0;
    } else {
        struct math_dd s = log_pair(dd_of(a, 0.0));
        if (fabs(s.hi) * b > 800.0) /* b < 2^1000 or it is so too: no product overflows */
            r = (s.hi > 0.0) == (y > 0.0) ? inf : 0.0;
        else
            r = exp_rounded(dd_multiply(s, dd_of(y, 0.0)));
    }
    return is_odd && math_is_negative(x) ? -r : r;
}

/* ---- remainders ---- */

/* a - b trunc(a / b), exact: long division, eleven bits at a time. */
MATH_FUNCTION double math_rem(double a, double b)
{
    double x = fabs(a), y = fabs(b);
    if (math_is_nan(a) || math_is_nan(b) || x == math_infinity() || y == 0.0)
        return math_nan();
    if (x < y)
        return a;
    int ex = math_exponent(x), ey = math_exponent(y);
    ex = ex < -1022 ? -1022 : ex;
    ey = ey < -1022 ? -1022 : ey;
    /* x = mx 2^(ex - 52), whole mx; the same for y */
    math_u64 mx = MATH_BITS(x) & 0xfffffffffffffUL, my = MATH_BITS(y) & 0xfffffffffffffUL;
    if (MATH_BITS(x) >> 52)
        mx |= 0x10000000000000UL;
    if (MATH_BITS(y) >> 52)
        my |= 0x10000000000000UL;
    mx %= my;
    for (int d = ex - ey; d > 0 && mx; d -= 11)
        mx = (mx << (d < 11 ? d : 11)) % my;
    /* mx 2^(ey - 52), which is a double */
    double r = (double)mx;
    if (mx)
        r = math_scale(r, ey - 52);
    return math_with_sign(r, a);
}

/* a - b floor(a / b): one rounding where the signs differ; 0 has the sign of b. */
MATH_FUNCTION double math_mod(double a, double b)
{
    double r = math_rem(a, b);
    if (r == 0.0)
        return math_with_sign(0.0, b);
    if (math_is_negative(r) != math_is_negative(b))
        r += b;
    return r;
}

/* ---- scaling ---- */

/* x 2^n for a whole n, rounded once. */
MATH_FUNCTION double math_ldexp(double x, double n)
{
    if (math_is_nan(n))
        return math_nan();
    if (math_is_nan(x) || fabs(x) == math_infinity() || x == 0.0)
        return x;
    n = n > 2200.0 ? 2200.0 : n < -2200.0 ? -2200.0 : n;
    int e = math_exponent(x), k = e + (int)n;
    if (k > 1023)
        return math_with_sign(math_infinity(), x);
    if (k < -1080)
        return math_with_sign(0.0, x);
    return math_scale(math_scale(x, -e), k);
}

/* ---- for vectors, lane by lane ---- */

#ifdef VECTOR
#if VECTOR == 1
#define MATH_1(f)                                                                              \
    static double f##_lanes(double a)                                                          \
    {                                                                                          \
        return f(a);                                                                           \
    }
#define MATH_2(f)                                                                              \
    static double f##_lanes(double a, double b)                                                \
    {                                                                                          \
        return f(a, b);                                                                        \
    }
#else
#define MATH_1(f)                                                                              \
    static VD f##_lanes(VD a)                                                                  \
    {                                                                                          \
        double x[VECTOR];                                                                      \
        JOIN(vstore, VECTOR)(a, 0, x);                                                         \
        for (int i = 0; i < VECTOR; i++)                                                       \
            x[i] = f(x[i]);                                                                    \
        return JOIN(vload, VECTOR)(0, x);                                                      \
    }
#define MATH_2(f)                                                                              \
    static VD f##_lanes(VD a, VD b)                                                            \
    {                                                                                          \
        double x[VECTOR], y[VECTOR];                                                           \
        JOIN(vstore, VECTOR)(a, 0, x);                                                         \
        JOIN(vstore, VECTOR)(b, 0, y);                                                         \
        for (int i = 0; i < VECTOR; i++)                                                       \
            x[i] = f(x[i], y[i]);                                                              \
        return JOIN(vload, VECTOR)(0, x);                                                      \
    }
#endif
MATH_1(math_exp)
MATH_1(math_ln)
MATH_1(math_log2)
MATH_1(math_log10)
MATH_1(math_sin)
MATH_1(math_cos)
MATH_1(math_tan)
MATH_1(math_asin)
MATH_1(math_acos)
MATH_1(math_atan)
MATH_1(math_sinh)
MATH_1(math_cosh)
MATH_1(math_tanh)
MATH_1(math_asinh)
MATH_1(math_acosh)
MATH_1(math_atanh)
MATH_2(math_atan2)
MATH_2(math_pow)
MATH_2(math_mod)
MATH_2(math_rem)
MATH_2(math_ldexp)
#endif
