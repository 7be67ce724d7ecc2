/* Compares the transcendental functions of kernels/math.cl, compiled as C, with MPFR. They are
 * within 1 ulp in single and 2 ulp in double of the correctly rounded result. Special cases are
 * compared with Annex F of C, which is written down here. LUTETIA_MATH_POINTS=n takes n points
 * of each kind. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <mpfr.h>

#include "sample.h"
#include "values/math_ops.h"

struct function {
    const char *name;
    int op, operands;
    int (*one)(mpfr_t, const mpfr_t, mpfr_rnd_t);
    int (*two)(mpfr_t, const mpfr_t, const mpfr_t, mpfr_rnd_t);
    double low, high; /* the range where it is finite and varies */
};

static int power(mpfr_t r, const mpfr_t a, const mpfr_t b, mpfr_rnd_t round)
{
    return mpfr_pow(r, a, b, round);
}

static int remainder_truncated(mpfr_t r, const mpfr_t a, const mpfr_t b, mpfr_rnd_t round)
{
    return mpfr_fmod(r, a, b, round);
}

static int remainder_floored(mpfr_t r, const mpfr_t a, const mpfr_t b, mpfr_rnd_t round)
{
    mpfr_t exact;
    mpfr_init2(exact, 2300);
    int inexact = mpfr_fmod(exact, a, b, MPFR_RNDN);
    if (mpfr_zero_p(exact))
        mpfr_setsign(exact, exact, mpfr_signbit(b), MPFR_RNDN);
    else if (mpfr_signbit(exact) != mpfr_signbit(b))
        mpfr_add(exact, exact, b, MPFR_RNDN);
    inexact = mpfr_set(r, exact, round);
    mpfr_clear(exact);
    return inexact;
}

#define ONE(op, f, low, high)                                                                  \
    {                                                                                          \
#f, MACHINE_##op, 1, mpfr_##f, NULL, low, high                                         \
    }
static const struct function functions[] = {
    ONE(FEXP, exp, -746, 710),
    ONE(FLN, log, 0, INFINITY),
    ONE(FLOG2, log2, 0, INFINITY),
    ONE(FLOG10, log10, 0, INFINITY),
    ONE(FSIN, sin, -INFINITY, INFINITY),
    ONE(FCOS, cos, -INFINITY, INFINITY),
    ONE(FTAN, tan, -INFINITY, INFINITY),
    ONE(FASIN, asin, -1, 1),
    ONE(FACOS, acos, -1, 1),
    ONE(FATAN, atan, -INFINITY, INFINITY),
    ONE(FSINH, sinh, -711, 711),
    ONE(FCOSH, cosh, -711, 711),
    ONE(FTANH, tanh, -25, 25),
    ONE(FASINH, asinh, -INFINITY, INFINITY),
    ONE(FACOSH, acosh, 1, INFINITY),
    ONE(FATANH, atanh, -1, 1),
    {"atan2", MACHINE_FATAN2, 2, NULL, mpfr_atan2, 0, 0},
    {"pow", MACHINE_FPOW, 2, NULL, power, 0, 0},
    {"rem", MACHINE_FREM, 2, NULL, remainder_truncated, 0, 0},
    {"mod", MACHINE_FMOD, 2, NULL, remainder_floored, 0, 0},
};
enum { FUNCTIONS_COUNT = sizeof functions / sizeof functions[0] };

/* ---- numbers ---- */

static uint64_t state = SAMPLE_SHIFTED_BEGIN;

static uint64_t any(void)
{
    return sample_shifted(&state);
}

static double double_of(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static double unit(void)
{
    return (double)(any() >> 11) * 0x1p-53;
}

static float single_of(uint64_t bits)
{
    uint32_t low = (uint32_t)bits;
    float x;
    memcpy(&x, &low, sizeof x);
    return x;
}

/* Draws a point. The kinds: numbers of all sizes, numbers near 1, numbers in the function's
 * range, and numbers near small multiples of pi/2 and other places where functions are 0 or
 * bend. */
static double point(const struct function *f, bool single, int kind)
{
    /* the double nearest to a multiple of pi/2, others near one, and the range's ends */
    static const double hard[] = {0x1.6ac5b262ca1ffp+849,
                                  0x1.921fb54442d18p+0,
                                  0x1.921fb54442d18p+1,
                                  0x1.2d97c7f3321d2p+2,
                                  0x1.f6a7a2955385ep+2,
                                  0x1.fffffffffffffp+1023,
                                  0x1p1023,
                                  0x1p26,
                                  0x1.921fb54442d18p+26,
                                  0x1.2p-1074,
                                  0x1p-1022,
                                  0x1.fffffep+127,
                                  0x1.1475ccp+95,
                                  0x1.62e42fefa39efp+9};
    double x;
    switch (kind) {
    case 0:
        if (any() % 16 == 0) {
            x = hard[any() % (sizeof hard / sizeof hard[0])];
            x = f->low < 0 && any() % 2 ? -x : x;
            return single ? (double)(float)x : x;
        }
        return single ? (double)single_of(any()) : double_of(any());
    case 1:
        x = ldexp(unit() * 2 - 1, (int)(any() % 60) - 50);
        break;
    case 2:
        x = (unit() * 2 - 1) * 4;
        break;
    case 3:
        x = isinf(f->high) ? (unit() * 2 - 1) * ldexp(1, (int)(any() % 40))
                           : f->low + unit() * (f->high - f->low);
        break;
    case 4: /* near whole numbers and near 1 */
        x = (double)(any() % 16) / 8 + ldexp(unit() - 0.5, -(int)(any() % 60));
        break;
    default:
        x = (double)(any() % 100000) * 1.5707963267948966 +
            ldexp(unit() - 0.5, -(int)(any() % 60));
        break;
    }
    if (f->low >= 0)
        x = fabs(x);
    return single ? (double)(float)x : x;
}

/* ---- comparing ---- */

/* The distance of a and b in numbers of the type. */
static uint64_t apart(double a, double b, bool single)
{
    int64_t i, j;
    if (single) {
        int32_t p, q;
        float x = (float)a, y = (float)b;
        memcpy(&p, &x, sizeof p);
        memcpy(&q, &y, sizeof q);
        i = p < 0 ? -(int64_t)(p & INT32_MAX) : p;
        j = q < 0 ? -(int64_t)(q & INT32_MAX) : q;
    } else {
        memcpy(&i, &a, sizeof i);
        memcpy(&j, &b, sizeof j);
        i = i < 0 ? -(i & INT64_MAX) : i;
        j = j < 0 ? -(j & INT64_MAX) : j;
    }
    return i < j ? (uint64_t)j - (uint64_t)i : (uint64_t)i - (uint64_t)j;
}

/* MPFR's result, rounded once to the type, also where it is subnormal. */
static double reference(const struct function *f, double a, double b, bool single)
{
    mpfr_t x, y, r;
    mpfr_init2(x, 53);
    mpfr_init2(y, 53);
    mpfr_init2(r, single ? 24 : 53);
    mpfr_set_emin(single ? -148 : -1073);
    mpfr_set_emax(single ? 128 : 1024);
    mpfr_set_d(x, a, MPFR_RNDN);
    mpfr_set_d(y, b, MPFR_RNDN);
    if (single) { /* single operands: exact in a wider range */
        mpfr_set_emin(-1073);
        mpfr_set_emax(1024);
        mpfr_set_d(x, a, MPFR_RNDN);
        mpfr_set_d(y, b, MPFR_RNDN);
        mpfr_set_emin(-148);
        mpfr_set_emax(128);
    }
    int inexact = f->one ? f->one(r, x, MPFR_RNDN) : f->two(r, x, y, MPFR_RNDN);
    inexact = mpfr_check_range(r, inexact, MPFR_RNDN);
    mpfr_subnormalize(r, inexact, MPFR_RNDN);
    double result = mpfr_get_d(r, MPFR_RNDN);
    mpfr_clear(x);
    mpfr_clear(y);
    mpfr_clear(r);
    return result;
}

static uint64_t bits_wanted(double x, bool single)
{
    uint64_t bits;
    uint32_t low;
    float y = (float)x;
    if (isnan(x))
        return single ? 0xffc00000u : 0xfff8000000000000u;
    memcpy(&bits, &x, sizeof bits);
    memcpy(&low, &y, sizeof low);
    return single ? low : bits;
}

static double evaluate(const struct function *f, double a, double b, bool single)
{
    struct machine_scalar r;
    struct machine_scalar x = {bits_wanted(a, single), 0}, y = {bits_wanted(b, single), 0};
    assert_true(math_fold(f->op, single ? MACHINE_F32 : MACHINE_F64, x, y, &r));
    return single ? (double)single_of(r.lo) : double_of(r.lo);
}

static long points_count(void)
{
    const char *asked = getenv("LUTETIA_MATH_POINTS");
    return asked ? atol(asked) : 2500;
}

static void run(bool single)
{
    uint64_t allowed = single ? 1 : 2;
    int failures = 0;
    for (int i = 0; i < FUNCTIONS_COUNT; i++) {
        const struct function *f = &functions[i];
        uint64_t worst = 0;
        long off = 0, all = 0;
        bool exact = f->op == MACHINE_FREM || f->op == MACHINE_FMOD;
        for (long n = 0; n < 6 * points_count(); n++) {
            double a = point(f, single, (int)(n % 6)), b = 0;
            if (f->operands == 2)
                b = point(f, single, (int)(n / 6 % 6));
            if (f->op == MACHINE_FPOW && n % 3)
                a = fabs(a);
            if (exact && fabs(a) > fabs(b) * 0x1p600)
                continue; /* right, but slow in the reference */
            double got = evaluate(f, a, b, single), wanted = reference(f, a, b, single);
            bool fine = isnan(got) == isnan(wanted) && signbit(got) == signbit(wanted);
            if (isnan(wanted))
                fine = isnan(got);
            uint64_t d = fine && !isnan(got) ? apart(got, wanted, single) : 0;
            all++;
            off += d != 0;
            worst = d > worst ? d : worst;
            if ((!fine || d > (exact ? 0 : allowed)) && failures++ < 20)
                fprintf(stderr, "%s %s(%a, %a): %a, wanted %a (%llu ulp)\n",
                        single ? "single" : "double", f->name, a, b, got, wanted,
                        (unsigned long long)d);
        }
        printf("%s %-6s worst %llu ulp, %.3f%% not correctly rounded\n",
               single ? "single" : "double", f->name, (unsigned long long)worst,
               100.0 * (double)off / (double)all);
    }
    assert_int_equal(failures, 0);
}

static void singles_are_within_one(void **unused)
{
    (void)unused;
    run(true);
}

static void doubles_are_within_two(void **unused)
{
    (void)unused;
    run(false);
}

/* Singles take a short way where it is certain; it must end where the long one does. */
static void singles_end_as_doubles_do(void **unused)
{
    (void)unused;
    for (int i = 0; i < FUNCTIONS_COUNT; i++)
        for (long n = 0; n < 24 * points_count(); n++) {
            const struct function *f = &functions[i];
            double a = point(f, true, (int)(n % 6)), b = point(f, true, (int)(n / 6 % 6)),
                   quick = 0, slow = 0;
            assert_true(math_evaluate_single(f->op, a, b, &quick) &&
                        math_evaluate(f->op, a, b, &slow));
            if (bits_wanted(quick, true) != bits_wanted(slow, true))
                fail_msg("%s(%a, %a): %a, in short %a", f->name, a, b, slow, quick);
        }
}

static void special_cases_are_annex_f(void **unused)
{
    (void)unused;
    static const double pi = 3.141592653589793, inf = INFINITY, nan = NAN;
    static const struct {
        const char *name;
        double a, b, wanted;
    } cases[] = {
        {"exp", -inf, 0, 0},
        {"exp", inf, 0, inf},
        {"exp", -0.0, 0, 1},
        {"exp", nan, 0, nan},
        {"exp", 710, 0, inf},
        {"exp", -746, 0, 0},
        {"log", 0, 0, -inf},
        {"log", -0.0, 0, -inf},
        {"log", 1, 0, 0},
        {"log", -1, 0, nan},
        {"log", inf, 0, inf},
        {"log", -inf, 0, nan},
        {"log2", 0, 0, -inf},
        {"log2", 1, 0, 0},
        {"log2", 0x1p-1074, 0, -1074},
        {"log2", 0x1p1023, 0, 1023},
        {"log10", 1, 0, 0},
        {"log10", 1e22, 0, 22},
        {"log10", -0.0, 0, -inf},
        {"log10", 1000, 0, 3},
        {"sin", -0.0, 0, -0.0},
        {"sin", inf, 0, nan},
        {"sin", 0x1p-1074, 0, 0x1p-1074},
        {"cos", 0, 0, 1},
        {"cos", -inf, 0, nan},
        {"tan", -0.0, 0, -0.0},
        {"tan", inf, 0, nan},
        {"asin", -0.0, 0, -0.0},
        {"asin", 1, 0, pi / 2},
        {"asin", 1.5, 0, nan},
        {"acos", 1, 0, 0},
        {"acos", -1, 0, pi},
        {"acos", -2, 0, nan},
        {"atan", -0.0, 0, -0.0},
        {"atan", inf, 0, pi / 2},
        {"atan", -inf, 0, -pi / 2},
        {"sinh", -0.0, 0, -0.0},
        {"sinh", -inf, 0, -inf},
        {"sinh", 1000, 0, inf},
        {"cosh", -inf, 0, inf},
        {"cosh", 0, 0, 1},
        {"tanh", -0.0, 0, -0.0},
        {"tanh", inf, 0, 1},
        {"tanh", -inf, 0, -1},
        {"asinh", -0.0, 0, -0.0},
        {"asinh", -inf, 0, -inf},
        {"acosh", 1, 0, 0},
        {"acosh", 0.5, 0, nan},
        {"acosh", inf, 0, inf},
        {"atanh", -0.0, 0, -0.0},
        {"atanh", 1, 0, inf},
        {"atanh", -1, 0, -inf},
        {"atanh", 2, 0, nan},
        {"atan2", 0, 0, 0},
        {"atan2", -0.0, 0, -0.0},
        {"atan2", 0, -0.0, pi},
        {"atan2", -0.0, -0.0, -pi},
        {"atan2", -0.0, -3, -pi},
        {"atan2", 0, 3, 0},
        {"atan2", -2, 0, -pi / 2},
        {"atan2", 2, -0.0, pi / 2},
        {"atan2", 1, -inf, pi},
        {"atan2", -1, inf, -0.0},
        {"atan2", inf, 5, pi / 2},
        {"atan2", -inf, -inf, -3 * pi / 4},
        {"atan2", inf, inf, pi / 4},
        {"atan2", nan, 1, nan},
        {"pow", 0, -3, inf},
        {"pow", -0.0, -3, -inf},
        {"pow", -0.0, -2, inf},
        {"pow", -0.0, -inf, inf},
        {"pow", -0.0, 3, -0.0},
        {"pow", -0.0, 2.5, 0},
        {"pow", -1, inf, 1},
        {"pow", -1, -inf, 1},
        {"pow", 1, nan, 1},
        {"pow", nan, 0, 1},
        {"pow", nan, -0.0, 1},
        {"pow", -2, 0.5, nan},
        {"pow", 0.5, -inf, inf},
        {"pow", 2, -inf, 0},
        {"pow", 0.5, inf, 0},
        {"pow", -2, inf, inf},
        {"pow", -inf, -3, -0.0},
        {"pow", -inf, -2, 0},
        {"pow", -inf, 3, -inf},
        {"pow", -inf, 2.5, inf},
        {"pow", inf, -1, 0},
        {"pow", inf, 0.5, inf},
        {"pow", -2, 3, -8},
        {"pow", -2, -1074, 0x1p-1074},
        {"pow", 10, 22, 1e22},
        {"rem", 5, 0, nan},
        {"rem", inf, 3, nan},
        {"rem", -5, inf, -5},
        {"rem", -6, 3, -0.0},
        {"rem", 0x1p1023, 0x3p-1074, 0x2p-1074},
        {"mod", -6, 3, 0},
        {"mod", 6, -3, -0.0},
        {"mod", -5, 3, 1},
        {"mod", 5, -3, -1},
        {"mod", 5, 0, nan},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int k = 0; k < FUNCTIONS_COUNT; k++) {
            const struct function *f = &functions[k];
            if (strcmp(f->name, cases[i].name))
                continue;
            for (int single = 0; single < 2; single++) {
                if (single && ((double)(float)cases[i].a != cases[i].a ||
                               (cases[i].wanted != 0 && fabs(cases[i].wanted) < 0x1p-149)))
                    continue;
                double got = evaluate(f, cases[i].a, cases[i].b, single != 0);
                double wanted = cases[i].wanted;
                if (single)
                    wanted = (double)(float)wanted;
                if (bits_wanted(got, single != 0) != bits_wanted(wanted, single != 0))
                    fail_msg("%s %s(%a, %a): %a, wanted %a", single ? "single" : "double",
                             f->name, cases[i].a, cases[i].b, got, wanted);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(special_cases_are_annex_f),
        cmocka_unit_test(singles_are_within_one),
        cmocka_unit_test(singles_end_as_doubles_do),
        cmocka_unit_test(doubles_are_within_two),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
