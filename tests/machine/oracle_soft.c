#include "oracle_soft.h"

#include <math.h>
#include <mpfr.h>

#include "sample.h"

static int bias(struct soft_format f)
{
    return (1 << (f.e - 1)) - 1;
}

uint64_t oracle_soft_nan(struct soft_format f)
{
    return ((UINT64_C(4) << f.e) - 1) << (f.s - 1);
}

static uint64_t exponent_field(struct soft_format f, uint64_t bits)
{
    return bits >> f.s & ((UINT64_C(1) << f.e) - 1);
}

static uint64_t fraction_field(struct soft_format f, uint64_t bits)
{
    return bits & ((UINT64_C(1) << f.s) - 1);
}

bool oracle_soft_is_finite(struct soft_format f, uint64_t bits)
{
    return exponent_field(f, bits) != (UINT64_C(1) << f.e) - 1;
}

bool oracle_soft_is_nan(struct soft_format f, uint64_t bits)
{
    return !oracle_soft_is_finite(f, bits) && fraction_field(f, bits) != 0;
}

double oracle_soft_value(struct soft_format f, uint64_t bits)
{
    uint64_t field = exponent_field(f, bits), fraction = fraction_field(f, bits);
    double magnitude;
    if (!oracle_soft_is_finite(f, bits))
        magnitude = fraction ? NAN : INFINITY;
    else if (field == 0)
        magnitude = ldexp((double)fraction, 1 - bias(f) - f.s);
    else
        magnitude = ldexp((double)(fraction | UINT64_C(1) << f.s), (int)field - bias(f) - f.s);
    return bits >> (f.s + f.e) & 1 ? -magnitude : magnitude;
}

/* x is a number of the format. */
static uint64_t encoded(struct soft_format f, double x)
{
    uint64_t sign = (uint64_t)(signbit(x) != 0) << (f.s + f.e);
    if (isnan(x))
        return oracle_soft_nan(f);
    if (isinf(x))
        return sign | ((UINT64_C(1) << f.e) - 1) << f.s;
    int exponent;
    double part = frexp(fabs(x), &exponent); /* 1/2 <= part < 1 */
    if (x == 0)
        return sign;
    if (exponent - 1 < 1 - bias(f)) /* in units of the least number */
        return sign | (uint64_t)ldexp(part, exponent - (1 - bias(f) - f.s));
    uint64_t significand = (uint64_t)ldexp(part, f.s + 1);
    return sign | (uint64_t)(exponent - 1 + bias(f)) << f.s | fraction_field(f, significand);
}

/* ---- MPFR with the format's precision and range ---- */

static void range_set(struct soft_format f)
{
    mpfr_set_emin(2 - bias(f) - f.s);
    mpfr_set_emax(bias(f) + 1);
}

static void range_reset(void)
{
    mpfr_set_emin(mpfr_get_emin_min());
    mpfr_set_emax(mpfr_get_emax_max());
}

static uint64_t finished(struct soft_format f, mpfr_t r, int inexact)
{
    mpfr_subnormalize(r, inexact, MPFR_RNDN);
    double x = mpfr_get_d(r, MPFR_RNDN);
    mpfr_clear(r);
    range_reset();
    return encoded(f, x);
}

/* Rounds exact, which was computed with the whole range of MPFR's exponents, to the format, and
 * clears it. */
static uint64_t rounded(struct soft_format f, mpfr_t exact)
{
    mpfr_t r;
    mpfr_init2(r, f.s + 1);
    range_set(f);
    int inexact = mpfr_set(r, exact, MPFR_RNDN);
    inexact = mpfr_check_range(r, inexact, MPFR_RNDN);
    mpfr_clear(exact);
    return finished(f, r, inexact);
}

uint64_t oracle_soft_of(struct soft_format f, double x)
{
    mpfr_t exact;
    range_reset();
    mpfr_init2(exact, 53);
    mpfr_set_d(exact, x, MPFR_RNDN);
    return rounded(f, exact);
}

uint64_t oracle_soft_of_whole(struct soft_format f, unsigned __int128 magnitude, bool negative)
{
    mpfr_t exact;
    range_reset();
    mpfr_init2(exact, 200);
    mpfr_set_uj_2exp(exact, (uintmax_t)(magnitude >> 64), 64, MPFR_RNDN);
    mpfr_add_ui(exact, exact, (uint64_t)magnitude, MPFR_RNDN);
    if (negative && magnitude)
        mpfr_neg(exact, exact, MPFR_RNDN);
    return rounded(f, exact);
}

uint64_t oracle_soft_arithmetic(struct soft_format f, char op, uint64_t a, uint64_t b)
{
    mpfr_t x, y, r;
    int inexact = 0;
    range_reset();
    mpfr_inits2(f.s + 1, x, y, r, (mpfr_ptr)0);
    mpfr_set_d(x, oracle_soft_value(f, a), MPFR_RNDN);
    mpfr_set_d(y, oracle_soft_value(f, b), MPFR_RNDN);
    range_set(f);
    switch (op) {
    case '+':
        inexact = mpfr_add(r, x, y, MPFR_RNDN);
        break;
    case '-':
        inexact = mpfr_sub(r, x, y, MPFR_RNDN);
        break;
    case '*':
        inexact = mpfr_mul(r, x, y, MPFR_RNDN);
        break;
    case '/':
        inexact = mpfr_div(r, x, y, MPFR_RNDN);
        break;
    case 'r':
        inexact = mpfr_sqrt(r, x, MPFR_RNDN);
        break;
    default:
        mpfr_set_nan(r);
        break;
    }
    mpfr_clears(x, y, (mpfr_ptr)0);
    return finished(f, r, inexact);
}

uint64_t oracle_soft_function(struct soft_format f, char op, uint64_t a)
{
    mpfr_t x, r;
    range_reset();
    mpfr_inits2(f.s + 1, x, r, (mpfr_ptr)0);
    mpfr_set_d(x, oracle_soft_value(f, a), MPFR_RNDN);
    range_set(f);
    int inexact = op == 's'   ? mpfr_sin(r, x, MPFR_RNDN)
                  : op == 'e' ? mpfr_exp(r, x, MPFR_RNDN)
                              : mpfr_log(r, x, MPFR_RNDN);
    mpfr_clear(x);
    return finished(f, r, inexact);
}

/* ---- samples ---- */

uint64_t oracle_soft_sample(struct soft_format f, uint64_t which)
{
    uint64_t r = sample_of(which), sign = (r >> 62 & 1) << (f.s + f.e),
             mask = (UINT64_C(2) << (f.s + f.e)) - 1;
    uint64_t one = (uint64_t)bias(f) << f.s, infinite = ((UINT64_C(1) << f.e) - 1) << f.s,
             ones = (UINT64_C(1) << f.s) - 1;
    const uint64_t edges[] = {0,
                              1,
                              2,
                              ones,
                              ones + 1,
                              ones + 2,
                              one,
                              one + 1,
                              one - 1,
                              one | ones,
                              infinite - 1,
                              infinite - 2,
                              infinite,
                              infinite | 1,
                              oracle_soft_nan(f),
                              one + (UINT64_C(1) << f.s),
                              one ^ 3,
                              infinite - 1 - ones};
    switch (r % 4) {
    case 0:
        return (edges[(r >> 8) % (sizeof edges / sizeof *edges)] | sign) & mask;
    case 1: { /* numbers near 1 or near the range's ends: sums cancel, products are subnormal */
        uint64_t near = (r >> 3 & 3) == 0 ? ones : (r >> 3 & 3) == 1 ? infinite / 2 + 1 : one;
        near += (sample_of(r) & (3 * ones)) - ones;
        return ((near & (infinite | ones)) | sign) & mask;
    }
    default:
        return sample_of(r) & mask;
    }
}
