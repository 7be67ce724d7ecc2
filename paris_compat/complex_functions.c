/* Functions of complex numbers, composed of the machine's operations on doubles, so that they
 * fuse with the operations around them.
 *
 * Accuracy. Each part is within a few units in the last place of a double, if it is not much
 * smaller than what it is the difference of (a part that nearly cancels is right within a few
 * units of the number's magnitude). Floats of other formats go by way of double, and round at
 * the end. Powers lose as many units more as |exponent ln z|.
 *
 * Branch cuts are those of C's Annex G, and a zero's sign says on which side of a cut it is:
 * sqrt, ln and powers along the negative real axis; asin, acos and atanh on the real axis
 * beyond -1 and 1; acosh on it below 1; asinh and atan on the imaginary axis beyond -i and i.
 * Not all of Annex G's results for infinite parts and NaNs are kept: if one part of the operand
 * is a NaN, both parts of the result may be.
 *
 * The inverse functions are W. Kahan's ("Branch Cuts for Complex Elementary Functions",
 * 1987): of sqrt(1 + z) and sqrt(1 - z), whose parts are multiplied and added without
 * cancelling.
 */
#include <math.h>
#include <stdlib.h>

#include "paris_state.h"

typedef struct machine_value *real;
typedef struct paris_cvalue complex_value;

/* ---- words ---- */

static real one_op(enum machine_op op, real a)
{
    return machine_unary(paris_the.machine, op, a);
}
static real two_op(enum machine_op op, real a, real b)
{
    return machine_binary(paris_the.machine, op, a, b);
}
static real add(real a, real b)
{
    return two_op(MACHINE_FADD, a, b);
}
static real sub(real a, real b)
{
    return two_op(MACHINE_FSUB, a, b);
}
static real mul(real a, real b)
{
    return two_op(MACHINE_FMUL, a, b);
}
static real quotient(real a, real b)
{
    return two_op(MACHINE_FDIV, a, b);
}
static real less(real a, real b)
{
    return two_op(MACHINE_FLT, a, b);
}
static real equal(real a, real b)
{
    return two_op(MACHINE_FEQ, a, b);
}
static real negated(real a)
{
    return one_op(MACHINE_FNEG, a);
}
static real magnitude(real a)
{
    return one_op(MACHINE_FABS, a);
}
static real root(real a)
{
    return one_op(MACHINE_FSQRT, a);
}
static real pick(real condition, real a, real b)
{
    return machine_select(paris_the.machine, condition, a, b);
}
static real double_of(double x)
{
    return machine_constant_float(paris_the.machine, MACHINE_F64, x);
}
static complex_value pair(real re, real im)
{
    return (complex_value){re, im};
}
static complex_value swapped(complex_value z)
{
    return (complex_value){z.im, z.re};
}

/* The sign of a double as a bit, also for zeros. */
static real sign_of(real x)
{
    struct machine *m = paris_the.machine;
    return machine_extract(m, machine_reinterpret(m, x, MACHINE_UINT(64)), 63, 1);
}

/* a, which is not negative, with the sign of x. */
static real signed_as(real a, real x)
{
    return pick(sign_of(x), negated(a), a);
}

static real infinite(real x)
{
    return equal(magnitude(x), double_of(INFINITY));
}

/* ln(1 + u) for u from -0.8 to 30 */
static real ln_one_more(real u)
{
    real two = double_of(2);
    return mul(two, one_op(MACHINE_FATANH, quotient(u, add(two, u))));
}

/* ---- magnitude and direction ---- */

/* The greater and the lesser of |x| and |y|; if one is a NaN, so is a result. */
static void by_size(complex_value z, real *great, real *small)
{
    real x = magnitude(z.re), y = magnitude(z.im), second = less(x, y);
    *great = pick(second, y, x);
    *small = pick(second, x, y);
}

static real size_of(complex_value z, bool narrow)
{
    if (narrow)
        return pick(two_op(MACHINE_OR, infinite(z.re), infinite(z.im)), double_of(INFINITY),
                    root(add(mul(z.re, z.re), mul(z.im, z.im))));
    real great, small;
    by_size(z, &great, &small);
    real ratio = quotient(small, great);
    real r = mul(great, root(add(double_of(1), mul(ratio, ratio))));
    r = pick(equal(great, double_of(0)), great, r);
    return pick(two_op(MACHINE_OR, infinite(z.re), infinite(z.im)), double_of(INFINITY), r);
}

static real angle_of(complex_value z)
{
    return two_op(MACHINE_FATAN2, z.im, z.re);
}

/* ln |z|: from the greater part and the ratio; near |z| = 1, from |z|^2 - 1 */
static real ln_size(complex_value z)
{
    real great, small, one = double_of(1), none = double_of(0);
    by_size(z, &great, &small);
    real u = add(mul(sub(great, one), add(great, one)), mul(small, small));
    real near = two_op(MACHINE_AND, less(double_of(0.5), great), less(great, double_of(3)));
    real ratio = pick(two_op(MACHINE_OR, equal(great, none), infinite(great)), none,
                      quotient(small, great));
    real half = mul(double_of(0.5), ln_one_more(pick(near, u, mul(ratio, ratio))));
    return pick(near, half, add(one_op(MACHINE_FLN, great), half));
}

static complex_value natural_logarithm(complex_value z)
{
    return pair(ln_size(z), angle_of(z));
}

complex_value paris_complex_cis(real x)
{
    return pair(one_op(MACHINE_FCOS, x), one_op(MACHINE_FSIN, x));
}

/* ---- arithmetic ---- */

complex_value paris_complex_multiply(complex_value a, complex_value b)
{
    return pair(sub(mul(a.re, b.re), mul(a.im, b.im)), add(mul(a.re, b.im), mul(a.im, b.re)));
}

/* R. Smith's method (1962): by the ratio of the divisor's parts. Division by zero divides
 * each part by it. */
complex_value paris_complex_divide(complex_value a, complex_value b)
{
    real wide = less(magnitude(b.re), magnitude(b.im));
    real great = pick(wide, b.im, b.re), small = pick(wide, b.re, b.im);
    real ratio = quotient(small, great), by = add(great, mul(small, ratio));
    real first = pick(wide, a.im, a.re), second = pick(wide, a.re, a.im);
    real re = quotient(add(first, mul(second, ratio)), by);
    real im = quotient(sub(second, mul(first, ratio)), by);
    im = pick(wide, negated(im), im);
    real none = equal(great, double_of(0));
    return pair(pick(none, quotient(a.re, b.re), re), pick(none, quotient(a.im, b.re), im));
}

static complex_value signum(complex_value z, bool narrow)
{
    real size = size_of(z, narrow), none = equal(size, double_of(0));
    return pair(pick(none, z.re, quotient(z.re, size)), pick(none, z.im, quotient(z.im, size)));
}

static complex_value square_root(complex_value z, bool narrow)
{
    real x = z.re, y = z.im, back = NULL;
    if (!narrow) { /* sums near the ends of the range could overflow */
        real great, small, one = double_of(1);
        by_size(z, &great, &small);
        real large = less(double_of(0x1p1000), great), tiny = less(great, double_of(0x1p-900));
        real scale = pick(large, double_of(0x1p-100), pick(tiny, double_of(0x1p200), one));
        back = pick(large, double_of(0x1p50), pick(tiny, double_of(0x1p-100), one));
        x = mul(x, scale);
        y = mul(y, scale);
    }
    real size = size_of(pair(x, y), narrow);
    real great = root(mul(double_of(0.5), add(magnitude(x), size)));
    real small = quotient(magnitude(y), mul(double_of(2), great));
    if (back) {
        great = mul(great, back);
        small = mul(small, back);
    }
    real none = equal(size, double_of(0)), left = sign_of(z.re), endless = infinite(z.im);
    small = pick(none, double_of(0), small);
    real re = pick(left, small, great), im = pick(left, great, small);
    return pair(pick(endless, double_of(INFINITY), pick(none, double_of(0), re)),
                signed_as(pick(endless, double_of(INFINITY), im), z.im));
}

/* ---- exponentials ---- */

/* a * e^x, in two steps where e^x alone would overflow. */
static complex_value times_exp(complex_value a, real x)
{
    real large = less(double_of(700), x);
    real step = one_op(MACHINE_FEXP, pick(large, mul(x, double_of(0.5)), x));
    real again = pick(large, step, double_of(1));
    return pair(mul(mul(a.re, step), again), mul(mul(a.im, step), again));
}

static complex_value exponential(complex_value z)
{
    complex_value r = times_exp(paris_complex_cis(z.im), z.re);
    /* e^x sin y for y = 0, also where e^x is infinite */
    r.im = pick(equal(z.im, double_of(0)), z.im, r.im);
    return r;
}

/* (a cosh x, b sinh x) */
static complex_value times_hyperbolic(real a, real b, real x)
{
    real large = less(double_of(700), magnitude(x)), none = double_of(0);
    real inside = pick(large, none, x);
    complex_value small =
        pair(mul(a, one_op(MACHINE_FCOSH, inside)), mul(b, one_op(MACHINE_FSINH, inside)));
    real beyond = mul(double_of(0.5), magnitude(x)), half = double_of(0.5);
    real step = one_op(MACHINE_FEXP, beyond);
    complex_value great = pair(mul(mul(mul(a, half), step), step), signed_as(double_of(1), x));
    great.im = mul(great.im, mul(mul(mul(b, half), step), step));
    return pair(pick(large, great.re, small.re), pick(large, great.im, small.im));
}

static complex_value hyperbolic_sine(complex_value z)
{
    complex_value turn = paris_complex_cis(z.im);
    complex_value r = swapped(times_hyperbolic(turn.im, turn.re, z.re));
    real none = double_of(0);
    r.re = pick(equal(z.re, none), z.re, r.re);
    r.im = pick(equal(z.im, none), z.im, r.im);
    return r;
}

static complex_value hyperbolic_cosine(complex_value z)
{
    complex_value turn = paris_complex_cis(z.im);
    complex_value r = times_hyperbolic(turn.re, turn.im, z.re);
    /* sinh x sin y is a zero with the product of their signs */
    real none = double_of(0), zero = two_op(MACHINE_OR, equal(z.re, none), equal(z.im, none));
    r.im = pick(zero, mul(signed_as(double_of(1), z.re), signed_as(none, turn.im)), r.im);
    return r;
}

static complex_value hyperbolic_tangent(complex_value z)
{
    real one = double_of(1), none = double_of(0);
    real large = less(double_of(22), magnitude(z.re)), x = pick(large, none, z.re);
    real t = one_op(MACHINE_FTAN, z.im), beta = add(one, mul(t, t));
    real s = one_op(MACHINE_FSINH, x), rho = root(add(one, mul(s, s)));
    real below = add(one, mul(mul(beta, s), s));
    complex_value turn = paris_complex_cis(z.im);
    real far = one_op(MACHINE_FEXP, mul(double_of(-2), magnitude(z.re)));
    far = mul(mul(mul(double_of(4), turn.re), far), turn.im);
    far = pick(infinite(z.re), signed_as(none, z.im), far);
    return pair(pick(large, signed_as(one, z.re), quotient(mul(mul(beta, rho), s), below)),
                pick(large, far, quotient(t, below)));
}

/* ---- their inverses ---- */

static complex_value root_of_one_less(complex_value z, bool narrow)
{
    return square_root(pair(sub(double_of(1), z.re), negated(z.im)), narrow);
}

static complex_value root_of_one_more(complex_value z, bool narrow)
{
    return square_root(pair(add(double_of(1), z.re), z.im), narrow);
}

static complex_value arc_sine(complex_value z, bool narrow)
{
    complex_value a = root_of_one_less(z, narrow), b = root_of_one_more(z, narrow);
    real along = sub(mul(a.re, b.re), mul(a.im, b.im));
    real across = sub(mul(a.re, b.im), mul(a.im, b.re));
    return pair(two_op(MACHINE_FATAN2, z.re, along), one_op(MACHINE_FASINH, across));
}

static complex_value arc_cosine(complex_value z, bool narrow)
{
    complex_value a = root_of_one_less(z, narrow), b = root_of_one_more(z, narrow);
    real across = sub(mul(b.re, a.im), mul(b.im, a.re));
    return pair(mul(double_of(2), two_op(MACHINE_FATAN2, a.re, b.re)),
                one_op(MACHINE_FASINH, across));
}

static complex_value arc_hyperbolic_cosine(complex_value z, bool narrow)
{
    complex_value a = square_root(pair(sub(z.re, double_of(1)), z.im), narrow);
    complex_value b = root_of_one_more(z, narrow);
    real along = add(mul(a.re, b.re), mul(a.im, b.im));
    return pair(one_op(MACHINE_FASINH, along),
                mul(double_of(2), two_op(MACHINE_FATAN2, a.im, b.re)));
}

/* For x < 0, negates the result for -z: the function is odd. */
static complex_value arc_hyperbolic_tangent(complex_value z)
{
    real one = double_of(1), turned = sign_of(z.re);
    real x = magnitude(z.re), y = pick(turned, negated(z.im), z.im);
    real rest = sub(one, x), more = add(one, x);
    real far = less(double_of(0x1p500), add(x, magnitude(y)));
    /* close to 1: from the logarithms of the distances */
    real distance = add(mul(rest, rest), mul(y, y));
    real close = less(distance, double_of(0.25));
    real by_logarithms =
        mul(double_of(0.5), sub(ln_size(pair(more, y)), ln_size(pair(rest, y))));
    real u = quotient(mul(double_of(4), x), pick(close, one, distance));
    real by_ratio = mul(double_of(0.25), ln_one_more(pick(close, one, u)));
    real reciprocal = paris_complex_divide(pair(one, double_of(0)), pair(x, y)).re;
    real re = pick(far, reciprocal, pick(close, by_logarithms, by_ratio));
    real angle = two_op(MACHINE_FATAN2, mul(double_of(2), y), sub(mul(rest, more), mul(y, y)));
    real im = mul(double_of(0.5), angle);
    im = pick(far, signed_as(double_of(0x1.921fb54442d18p0), y), im);
    return pair(pick(turned, negated(re), re), pick(turned, negated(im), im));
}

/* ---- powers ---- */

/* Powers of zero: 1 if the exponent is 0, else 0 (if the exponent's real part is positive)
 * or NaN. */
static complex_value power_of_zero(complex_value r, complex_value z, real exponent,
                                   real is_zero)
{
    real none = double_of(0), zero = two_op(MACHINE_AND, equal(z.re, none), equal(z.im, none));
    real above = less(none, exponent);
    r.re = pick(zero, pick(above, none, double_of(NAN)), r.re);
    r.im = pick(zero, pick(above, none, double_of(NAN)), r.im);
    return pair(pick(is_zero, double_of(1), r.re), pick(is_zero, none, r.im));
}

complex_value paris_complex_power(complex_value z, complex_value w)
{
    complex_value r = exponential(paris_complex_multiply(w, natural_logarithm(z)));
    real none = double_of(0);
    return power_of_zero(r, z, w.re, two_op(MACHINE_AND, equal(w.re, none), equal(w.im, none)));
}

complex_value paris_complex_power_real(complex_value z, real y)
{
    complex_value l = natural_logarithm(z);
    complex_value r = exponential(pair(mul(y, l.re), mul(y, l.im)));
    return power_of_zero(r, z, y, equal(y, double_of(0)));
}

/* By repeated squaring if |n| is below 2^WHOLE_BITS: products of whole parts are exact. */
enum { WHOLE_BITS = 10 };

complex_value paris_complex_power_whole(complex_value z, real n, bool is_signed)
{
    struct machine *m = paris_the.machine;
    struct machine_type type = machine_value_type(n);
    int bits = type.width < WHOLE_BITS ? type.width : WHOLE_BITS;
    real size = n, below = NULL;
    if (is_signed) {
        below = machine_extract(m, n, type.width - 1, 1);
        size = pick(below, machine_unary(m, MACHINE_NEG, n), n);
    }
    complex_value r = pair(double_of(1), double_of(0)), square = z;
    for (int i = 0; i < bits; i++) {
        real bit = machine_extract(m, size, i, 1);
        complex_value product = paris_complex_multiply(r, square);
        r = pair(pick(bit, product.re, r.re), pick(bit, product.im, r.im));
        if (i + 1 < bits)
            square = paris_complex_multiply(square, square);
    }
    if (is_signed) {
        complex_value inverse = paris_complex_divide(pair(double_of(1), double_of(0)), r);
        r = pair(pick(below, inverse.re, r.re), pick(below, inverse.im, r.im));
    }
    if (type.width <= WHOLE_BITS)
        return r;
    real limit = machine_constant(m, type, (struct machine_scalar){1u << WHOLE_BITS, 0});
    real far = two_op(MACHINE_ULE, limit, size);
    complex_value general =
        paris_complex_power_real(z, machine_to_float(m, n, MACHINE_F64, is_signed));
    return pair(pick(far, general.re, r.re), pick(far, general.im, r.im));
}

/* ---- by name ---- */

complex_value paris_complex_function(enum paris_complex_function_op op, complex_value z,
                                     bool narrow)
{
    switch (op) {
    case PARIS_C_RECIPROCAL:
        return paris_complex_divide(pair(double_of(1), double_of(0)), z);
    case PARIS_C_SIGNUM:
        return signum(z, narrow);
    case PARIS_C_SQRT:
        return square_root(z, narrow);
    case PARIS_C_EXP:
        return exponential(z);
    case PARIS_C_LN:
        return natural_logarithm(z);
    case PARIS_C_SIN:
        return swapped(hyperbolic_sine(swapped(z)));
    case PARIS_C_COS: /* cosh (i z) */
        return hyperbolic_cosine(pair(negated(z.im), z.re));
    case PARIS_C_TAN:
        return swapped(hyperbolic_tangent(swapped(z)));
    case PARIS_C_ASIN:
        return arc_sine(z, narrow);
    case PARIS_C_ACOS:
        return arc_cosine(z, narrow);
    case PARIS_C_ATAN:
        return swapped(arc_hyperbolic_tangent(swapped(z)));
    case PARIS_C_SINH:
        return hyperbolic_sine(z);
    case PARIS_C_COSH:
        return hyperbolic_cosine(z);
    case PARIS_C_TANH:
        return hyperbolic_tangent(z);
    case PARIS_C_ASINH:
        return swapped(arc_sine(swapped(z), narrow));
    case PARIS_C_ACOSH:
        return arc_hyperbolic_cosine(z, narrow);
    case PARIS_C_ATANH:
        return arc_hyperbolic_tangent(z);
    }
    abort(); /* the table of instructions has no other */
}

real paris_complex_abs(complex_value z, bool narrow)
{
    return size_of(z, narrow);
}

real paris_complex_phase(complex_value z)
{
    return angle_of(z);
}
