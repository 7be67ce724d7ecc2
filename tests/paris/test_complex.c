/* Complex numbers against C's own in long double: every instruction, over ranges, axes, branch
 * cuts and the ends of the range. All results of a format are recorded before the first is
 * looked at, so that there are few kernels. */
#include <complex.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"

typedef long double complex number_c;
typedef void (*unary_call)(CM_field_id_t, CM_field_id_t, unsigned int, unsigned int);
typedef void (*binary_call)(CM_field_id_t, CM_field_id_t, CM_field_id_t, unsigned int,
                            unsigned int);

enum { SIDE = 48, MANY = SIDE * SIDE, RESULTS_MAX = 48 };

struct format {
    unsigned int s, e;
};

/* ---- samples: pairs of doubles that the format has ---- */

static double samples[3][2 * MANY]; /* z, w, what dest held */

static double part_of(struct format f, bool other)
{
    static const double plain[] = {0, 1, 0.5, 2, 1.5, 3, 0.75, 1.0009765625, 0.9990234375, 4};
    uint64_t r = device_random();
    int span = f.e >= 11 ? 1000 : f.e >= 8 ? 100 : 10;
    double x = (double)(device_random() % 1024 + 1) / 1024;
    switch (r % 8) {
    case 0:
    case 1:
        x = plain[(r >> 8) % (sizeof plain / sizeof *plain)];
        break;
    case 2:
        x = ldexp(x, (int)(r >> 8) % span);
        break;
    case 3:
        x = ldexp(x, -((int)(r >> 8 & 0xffff) % span));
        break;
    default:
        x = ldexp(x, (int)(r >> 8 & 7) - 3);
        break;
    }
    if (other && fabs(x) > 1e3)
        x = 2;
    return r >> 40 & 1 ? -x : x;
}

static void samples_make(struct format f)
{
    device_seed(11 + f.s);
    for (int i = 0; i < 2 * MANY; i++) {
        samples[0][i] = part_of(f, false);
        samples[1][i] = part_of(f, true);
        samples[2][i] = part_of(f, false);
    }
}

static number_c of_parts(const double *p, int n)
{
    return CMPLXL(p[2 * n], p[2 * n + 1]);
}

/* ---- fields ---- */

static CM_field_id_t field_of(struct format f, const double *parts)
{
    int zero[2] = {0, 0}, side[2] = {SIDE, SIDE}, axes[2] = {0, 1};
    CM_field_id_t field = CM_allocate_stack_field(2 * (f.s + f.e + 1));
    CM_vector_t none = {.ints = zero}, all = {.ints = side}, both = {.ints = axes};
    CM_c_write_to_news_array_1L(parts, none, none, all, both, field, f.s, f.e, 2, all,
                                CM_complex_double);
    return field;
}

static void parts_of(struct format f, CM_field_id_t field, double *parts)
{
    int zero[2] = {0, 0}, side[2] = {SIDE, SIDE}, axes[2] = {0, 1};
    CM_vector_t none = {.ints = zero}, all = {.ints = side}, both = {.ints = axes};
    CM_c_read_from_news_array_1L(parts, none, none, all, both, field, f.s, f.e, 2, all,
                                 CM_complex_double);
}

static void start(void)
{
    device_start(0);
    int side[2] = {SIDE, SIDE};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry((CM_vector_t){.ints = side}, 2)));
    CM_set_error_handler(device_error_catch);
    device_message[0] = 0;
}

/* ---- comparing ---- */

struct tolerance {
    double part;  /* units in the last place of each part */
    double whole; /* or of the number's magnitude, where a part nearly cancels; 0: never */
};

struct worst {
    double part, whole;
};

static double unit_of(struct format f, long double x)
{
    int exponent, least = 2 - (1 << (f.e - 1));
    frexpl(x, &exponent);
    exponent--;
    return ldexp(1, (exponent < least ? least : exponent) - (int)f.s);
}

static long double greatest_of(struct format f)
{
    return ldexpl(2 - ldexpl(1, -(int)f.s), (1 << (f.e - 1)) - 1);
}

/* The error in units, at most 1e9; 0 where the reference is a NaN. */
static double error_of(struct format f, double got, long double wanted, long double scale)
{
    long double most = greatest_of(f);
    if (isnan(wanted))
        return 0;
    if (fabsl(wanted) > most * 1.000001L)
        return isinf(got) && (got > 0) == (wanted > 0) ? 0 : 1e9;
    if (isinf(got) && fabsl(wanted) > most * 0.999999L)
        return 0;
    if (isnan(got) || isinf(got))
        return 1e9;
    long double by = unit_of(f, scale);
    return (double)(fabsl(got - wanted) / by);
}

static void compare(struct format f, const char *what, struct tolerance t, int n, double got,
                    long double wanted, long double whole, struct worst *w)
{
    double part = error_of(f, got, wanted, wanted);
    if (part <= t.part || part == 0) {
        w->part = fmax(w->part, part);
        return;
    }
    double relative = error_of(f, got, wanted, whole);
    w->whole = fmax(w->whole, relative);
    if (!(relative <= t.whole))
        fail_msg("%u, %u: %s of %.17g %+.17g i, %.17g %+.17g i: a part is %.17g, not %.17Lg "
                 "(off by %g, %g units)",
                 f.s, f.e, what, samples[0][2 * n], samples[0][2 * n + 1], samples[1][2 * n],
                 samples[1][2 * n + 1], got, wanted, part, relative);
}

/* ---- the instructions ---- */

static number_c minus(number_c z)
{
    return -z;
}
static number_c reciprocal(number_c z)
{
    return z == 0 ? CMPLXL(NAN, NAN) : 1 / z;
}
static number_c direction(number_c z)
{
    return z == 0 ? z : CMPLXL(creall(z) / cabsl(z), cimagl(z) / cabsl(z));
}
static number_c itself(number_c z)
{
    return z;
}
static const struct {
    const char *name;
    unary_call call;
    number_c (*wanted)(number_c);
    struct tolerance t;
} unaries[] = {
    {"move", CM_c_move_1L, itself, {0, 0}},
    {"negate", CM_c_negate_2_1L, minus, {0, 0}},
    {"conjugate", CM_c_conjugate_2_1L, conjl, {0, 0}},
    {"reciprocal", CM_c_reciprocal_2_1L, reciprocal, {4, 0}},
    {"signum", CM_c_c_signum_2_1L, direction, {4, 0}},
    {"sqrt", CM_c_sqrt_2_1L, csqrtl, {4, 0}},
    {"exp", CM_c_exp_2_1L, cexpl, {4, 0}},
    {"ln", CM_c_ln_2_1L, clogl, {4, 2}},
    {"sin", CM_c_sin_2_1L, csinl, {4, 0}},
    {"cos", CM_c_cos_2_1L, ccosl, {4, 0}},
    {"tan", CM_c_tan_2_1L, ctanl, {8, 0}},
    {"asin", CM_c_asin_2_1L, casinl, {8, 0}},
    {"acos", CM_c_acos_2_1L, cacosl, {8, 0}},
    {"atan", CM_c_atan_2_1L, catanl, {8, 0}},
    {"sinh", CM_c_sinh_2_1L, csinhl, {4, 0}},
    {"cosh", CM_c_cosh_2_1L, ccoshl, {4, 0}},
    {"tanh", CM_c_tanh_2_1L, ctanhl, {8, 0}},
    {"asinh", CM_c_asinh_2_1L, casinhl, {8, 0}},
    {"acosh", CM_c_acosh_2_1L, cacoshl, {8, 0}},
    {"atanh", CM_c_atanh_2_1L, catanhl, {8, 0}},
};
enum { UNARIES = sizeof unaries / sizeof *unaries };

static void unaries_agree(struct format f)
{
    static double out[2 * MANY];
    CM_field_id_t z = field_of(f, samples[0]), results[UNARIES];
    for (int k = 0; k < UNARIES; k++) {
        results[k] = CM_allocate_stack_field(2 * (f.s + f.e + 1));
        unaries[k].call(results[k], z, f.s, f.e);
    }
    for (int k = 0; k < UNARIES; k++) {
        struct worst w = {0, 0};
        parts_of(f, results[k], out);
        for (int n = 0; n < MANY; n++) {
            number_c r = unaries[k].wanted(of_parts(samples[0], n));
            long double whole = cabsl(r);
            compare(f, unaries[k].name, unaries[k].t, n, out[2 * n], creall(r), whole, &w);
            compare(f, unaries[k].name, unaries[k].t, n, out[2 * n + 1], cimagl(r), whole, &w);
        }
        if (getenv("PARIS_TEST_ERRORS"))
            printf("%u, %u: %-12s %6.2f %6.2f\n", f.s, f.e, unaries[k].name, w.part, w.whole);
    }
    CM_deallocate_stack_through(z);
}

static void double_functions_agree(void **unused)
{
    (void)unused;
    struct format f = {52, 11};
    start();
    samples_make(f);
    unaries_agree(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(double_functions_agree),
    };
    return cmocka_run_group_tests_name("paris: complex numbers", tests, NULL, NULL);
}
