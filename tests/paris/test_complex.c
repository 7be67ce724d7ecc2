/* Compares complex instructions with C's complex long double: every instruction, on ordinary
 * numbers, on axes and branch cuts, and at the ends of the range. All results of a format are
 * recorded before the first is read, so that there are few kernels. */
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

#include "complex_samples.h"
#include "device.h"
#include "oracle_soft.h"

/* ---- the instructions ---- */

static number_c minus(number_c z)
{
    return -z;
}
static number_c reciprocal(number_c z)
{
    return z == 0 ? complex_of(NAN, NAN) : 1 / z;
}
static number_c direction(number_c z)
{
    return z == 0 ? z : complex_of(creall(z) / cabsl(z), cimagl(z) / cabsl(z));
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
    {"move", CM_c_move_1L, itself, {0, 0, true}},
    {"negate", CM_c_negate_2_1L, minus, {0, 0, true}},
    {"conjugate", CM_c_conjugate_2_1L, conjl, {0, 0, true}},
    {"reciprocal", CM_c_reciprocal_2_1L, reciprocal, {4, 0, false}},
    {"signum", CM_c_c_signum_2_1L, direction, {4, 0, false}},
    {"sqrt", CM_c_sqrt_2_1L, csqrtl, {4, 0, true}},
    {"exp", CM_c_exp_2_1L, cexpl, {4, 0, false}},
    {"ln", CM_c_ln_2_1L, clogl, {4, 2, true}},
    {"sin", CM_c_sin_2_1L, csinl, {4, 0, false}},
    {"cos", CM_c_cos_2_1L, ccosl, {4, 0, false}},
    {"tan", CM_c_tan_2_1L, ctanl, {8, 0, false}},
    {"asin", CM_c_asin_2_1L, casinl, {8, 0, false}},
    {"acos", CM_c_acos_2_1L, cacosl, {8, 0, false}},
    {"atan", CM_c_atan_2_1L, catanl, {8, 0, false}},
    {"sinh", CM_c_sinh_2_1L, csinhl, {4, 0, false}},
    {"cosh", CM_c_cosh_2_1L, ccoshl, {4, 0, false}},
    {"tanh", CM_c_tanh_2_1L, ctanhl, {8, 0, false}},
    {"asinh", CM_c_asinh_2_1L, casinhl, {8, 0, false}},
    {"acosh", CM_c_acosh_2_1L, cacoshl, {8, 0, false}},
    {"atanh", CM_c_atanh_2_1L, catanhl, {8, 0, false}},
};
enum { UNARIES = sizeof unaries / sizeof *unaries };

/* The single format tests only in_single: its other functions are those of double, rounded. */
static bool is_wanted(struct format f, int k)
{
    static const char *const in_single[] = {"move", "sqrt"};
    for (int i = 0; i < 2; i++)
        if (strcmp(unaries[k].name, in_single[i]) == 0)
            return true;
    return f.e == 11;
}

static void unaries_agree(struct format f)
{
    static double out[2 * MANY];
    CM_field_id_t z = field_of(f, samples[0]), results[UNARIES];
    for (int k = 0; k < UNARIES; k++) {
        results[k] = CM_allocate_stack_field(2 * (f.s + f.e + 1));
        if (is_wanted(f, k))
            unaries[k].call(results[k], z, f.s, f.e);
    }
    for (int k = 0; k < UNARIES; k++) {
        struct worst w = {0, 0};
        if (!is_wanted(f, k))
            continue;
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

/* ---- powers, and complex to float ---- */

static number_c whole_power(number_c z, int n)
{
    number_c r = 1;
    for (int i = 0; i < abs(n); i++)
        r *= z;
    return n < 0 ? reciprocal(r) : r;
}

static int exponent_of(int n)
{
    return (n * 7 + n / 50) % 25 - 12;
}

static void powers_agree(struct format f)
{
    static double out[2 * MANY];
    unsigned int bits = 2 * (f.s + f.e + 1);
    CM_field_id_t z = field_of(f, samples[0]), w = field_of(f, samples[1]),
                  n = CM_allocate_stack_field(8), wide = CM_allocate_stack_field(40), r[6];
    int zero[2] = {0, 0}, side[2] = {HIGH, ACROSS}, axes[2] = {0, 1};
    CM_vector_t none = {.ints = zero}, all = {.ints = side}, both = {.ints = axes};
    static signed char exponents[MANY];
    for (int i = 0; i < MANY; i++)
        exponents[i] = (signed char)exponent_of(i);
    CM_s_write_to_news_array_1L(exponents, none, none, all, both, n, 8, 2, all, CM_8_bit);
    CM_s_move_2L(wide, n, 40, 8);
    for (int k = 0; k < 6; k++)
        r[k] = CM_allocate_stack_field(bits);
    CM_c_c_power_3_1L(r[0], z, w, f.s, f.e);
    CM_c_s_power_3_2L(r[1], z, wide, 40, f.s, f.e);
    CM_c_move_1L(r[2], z, f.s, f.e);
    CM_c_s_power_const_2_1L(r[2], -2, f.s, f.e);
    CM_c_u_power_constant_3_1L(r[3], z, 3, f.s, f.e);
    CM_c_f_power_3_1L(r[4], z, w, f.s, f.e);
    CM_c_f_cis_2_1L(r[5], w, f.s, f.e);
    for (int k = 0; k < 6; k++) {
        struct worst worst = {0, 0};
        parts_of(f, r[k], out);
        for (int i = 0; i < MANY; i++) {
            number_c a = of_parts(samples[0], i), b = of_parts(samples[1], i);
            number_c c = k == 0   ? b
                         : k == 1 ? exponent_of(i)
                         : k == 2 ? -2
                         : k == 3 ? 3
                                  : creall(b);
            number_c wanted = k == 5 ? complex_of(cosl(creall(b)), sinl(creall(b)))
                              : k == 1 || k == 2 || k == 3 ? whole_power(a, (int)creall(c))
                                                           : cpowl(a, c);
            long double size = cabsl(wanted);
            if (k != 5 && (a == 0 || !(fabsl(logl(size)) < 600) ||
                           !(cabsl(c * clogl(a)) < (k == 0 || k == 4 ? 30 : 200))))
                continue;
            struct tolerance t = {k == 5 ? 2 : 0, k == 5 ? 0 : 60, false};
            compare(f, "a power", t, i, out[2 * i], creall(wanted), size, &worst);
            compare(f, "a power", t, i, out[2 * i + 1], cimagl(wanted), size, &worst);
        }
        if (getenv("PARIS_TEST_ERRORS"))
            printf("%u, %u: power %d      %6.2f %6.2f\n", f.s, f.e, k, worst.part, worst.whole);
    }
    /* powers of numbers with whole parts are exact: (2 + i)^3 = 2 + 11 i */
    CM_c_move_constant_1L(z, 2, 1, f.s, f.e);
    CM_c_s_power_constant_2_1L(z, 3, f.s, f.e);
    CM_complex_t cube = CM_c_read_from_processor_1L(5, z, f.s, f.e);
    assert_true(cube.real == 2 && cube.imag == 11);
    CM_deallocate_stack_through(z);
}

static void parts_agree(struct format f)
{
    static double out[MANY];
    CM_field_id_t z = field_of(f, samples[0]), r[4];
    int zero[2] = {0, 0}, side[2] = {HIGH, ACROSS}, axes[2] = {0, 1};
    CM_vector_t none = {.ints = zero}, all = {.ints = side}, both = {.ints = axes};
    for (int k = 0; k < 4; k++)
        r[k] = CM_allocate_stack_field(f.s + f.e + 1);
    CM_f_c_abs_2_1L(r[0], z, f.s, f.e);
    CM_f_c_phase_2_1L(r[1], z, f.s, f.e);
    CM_f_c_real_2_1L(r[2], z, f.s, f.e);
    CM_f_c_imag_2_1L(r[3], z, f.s, f.e);
    for (int k = 0; k < 4; k++) {
        struct worst worst = {0, 0};
        CM_f_read_from_news_array_1L(out, none, none, all, both, r[k], f.s, f.e, 2, all,
                                     CM_float_double);
        for (int i = 0; i < MANY; i++) {
            number_c a = of_parts(samples[0], i);
            long double wanted = k == 0   ? cabsl(a)
                                 : k == 1 ? cargl(a)
                                 : k == 2 ? creall(a)
                                          : cimagl(a);
            struct tolerance t = {k < 2 ? 2 : 0, 0, true};
            compare(f, "abs, phase, real or imag", t, i, out[i], wanted, wanted, &worst);
        }
    }
    CM_deallocate_stack_through(z);
}

/* ---- forms, in a format that is neither single nor double ---- */

static const struct format small = {10, 5};
static const struct soft_format soft_small = {10, 5};
static const double value_real = 1.25, value_imag = -3;

static double rounded(double x)
{
    return oracle_soft_value(soft_small, oracle_soft_of(soft_small, x));
}

struct form {
    const char *name;
    char op; /* + - * /; with exchanged sources: r for -, d for / */
    int operands;
    bool constant, always;
    void (*call)(CM_field_id_t, CM_field_id_t, CM_field_id_t);
};

#define CALL(name, ...)                                                                        \
    static __attribute__((unused)) void call_##name(CM_field_id_t dest, CM_field_id_t a,       \
                                                    CM_field_id_t b)                           \
    {                                                                                          \
        (void)a;                                                                               \
        (void)b;                                                                               \
        CM_c_##name(__VA_ARGS__, 10, 5);                                                       \
    }
#define CALLS(op)                                                                              \
    CALL(op##_2_1L, dest, a)                                                                   \
    CALL(op##_3_1L, dest, a, b)                                                                \
    CALL(op##_const_always_2_1L, dest, value_real, value_imag)
#define ROW(op, symbol, form, n, constant, always)                                             \
    {#op #form, symbol, n, constant, always, call_##op##form},
#define ROWS(op, symbol)                                                                       \
    ROW(op, symbol, _2_1L, 2, false, false)                                                    \
    ROW(op, symbol, _3_1L, 3, false, false)                                                    \
    ROW(op, symbol, _const_always_2_1L, 2, true, true)

CALLS(add)
CALLS(subtract)
CALLS(multiply)
CALLS(divide)
CALLS(subfrom)
CALLS(divinto)
CALL(add_constant_2_1L, dest, value_real, value_imag)
CALL(add_const_3_1L, dest, a, value_real, value_imag)
CALL(add_always_2_1L, dest, a)
CALL(add_always_3_1L, dest, a, b)
CALL(add_constant_always_3_1L, dest, a, value_real, value_imag)
/* multiply_3_1L comes first, because the test of the overflow flag uses it */
static const struct form forms[] = {
    ROW(multiply, '*', _3_1L, 3, false, false) ROW(multiply, '*', _2_1L, 2, false, false)
        ROWS(add, '+') ROW(add, '+', _constant_2_1L, 2, true, false) ROW(
            add, '+', _const_3_1L, 3, true, false) ROW(add, '+', _always_2_1L, 2, false, true)
            ROW(add, '+', _always_3_1L, 3, false, true)
                ROW(add, '+', _constant_always_3_1L, 3, true, true)
                    ROW(multiply, '*', _const_always_2_1L, 2, true, true) ROWS(subtract, '-')
                        ROW(divide, '/', _2_1L, 2, false, false)
                            ROW(divide, '/', _const_always_2_1L, 2, true, true)
                                ROWS(subfrom, 'r') ROW(divinto, 'd', _3_1L, 3, false, false)};
enum { FORMS = sizeof forms / sizeof *forms };

static void want_form(const struct form *t, int n, double *re, double *im)
{
    const double *d = samples[2] + 2 * n, *a = samples[0] + 2 * n, *b = samples[1] + 2 * n,
                 c[2] = {value_real, value_imag};
    const double *x = t->operands == 2 ? d : a, *y = t->constant ? c : t->operands == 2 ? a : b;
    if (t->op == 'r' || t->op == 'd') {
        const double *z = x;
        x = y;
        y = z;
    }
    switch (t->op) {
    case '+':
        *re = rounded(x[0] + y[0]);
        *im = rounded(x[1] + y[1]);
        break;
    case '-':
    case 'r':
        *re = rounded(x[0] - y[0]);
        *im = rounded(x[1] - y[1]);
        break;
    case '*':
        *re = rounded(rounded(x[0] * y[0]) - rounded(x[1] * y[1]));
        *im = rounded(rounded(x[0] * y[1]) + rounded(x[1] * y[0]));
        break;
    default: {
        long double size = (long double)y[0] * y[0] + (long double)y[1] * y[1];
        *re = size == 0 ? NAN : (double)((x[0] * (long double)y[0] + x[1] * y[1]) / size);
        *im = size == 0 ? NAN : (double)((x[1] * (long double)y[0] - x[0] * y[1]) / size);
        break;
    }
    }
}

static bool parts_close(const struct form *t, double got, double wanted)
{
    if (t->op != '/' && t->op != 'd')
        return got == wanted || (isnan(got) && isnan(wanted));
    return isnan(wanted) || error_of(small, got, wanted, wanted) <= 0.51;
}

static void forms_agree(void **unused)
{
    (void)unused;
    static double out[2 * MANY];
    static unsigned char active[MANY], flags[MANY];
    int zero[2] = {0, 0}, side[2] = {HIGH, ACROSS}, axes[2] = {0, 1};
    CM_vector_t none = {.ints = zero}, all = {.ints = side}, both = {.ints = axes};
    start();
    samples_make(small);
    CM_field_id_t a = field_of(small, samples[0]), b = field_of(small, samples[1]),
                  d = field_of(small, samples[2]), mask = CM_allocate_stack_field(1),
                  flag = CM_allocate_stack_field(1), r[FORMS];
    for (int n = 0; n < MANY; n++)
        active[n] = device_random() >> 20 & 1;
    CM_u_write_to_news_array_1L(active, none, none, all, both, mask, 1, 2, all, CM_8_bit);
    for (int k = 0; k < FORMS; k++) {
        r[k] = CM_allocate_stack_field(32);
        CM_c_move_1L(r[k], d, 10, 5);
    }
    CM_load_context(mask);
    for (int k = 0; k < FORMS; k++) {
        forms[k].call(r[k], a, b);
        if (k == 0)
            CM_store_overflow_always(flag);
    }
    for (int k = 0; k < FORMS; k++) {
        parts_of(small, r[k], out);
        for (int n = 0; n < MANY; n++) {
            double re = samples[2][2 * n], im = samples[2][2 * n + 1];
            if (active[n] || forms[k].always)
                want_form(&forms[k], n, &re, &im);
            if (!parts_close(&forms[k], out[2 * n], re) ||
                !parts_close(&forms[k], out[2 * n + 1], im))
                fail_msg("CM_c_%s at %d: %g %+g i, not %g %+g i", forms[k].name, n, out[2 * n],
                         out[2 * n + 1], re, im);
        }
    }
    CM_u_read_from_news_array_1L(flags, none, none, all, both, flag, 1, 2, all, CM_8_bit);
    for (int n = 0; n < MANY; n++) {
        double re = 0, im = 0;
        const double *x = samples[0] + 2 * n;
        if (!active[n])
            continue;
        want_form(&forms[0], n, &re, &im);
        assert_int_equal(flags[n],
                         isfinite(x[0]) && isfinite(x[1]) && !(isfinite(re) && isfinite(im)));
    }
    assert_string_equal(device_message, "");
}

/* Tests comparisons, moves between formats, neighbours, sums, one processor, zero and
 * operations on one operand. m holds thirds in single floats and is overwritten; c is a field
 * of the small format. */
static void front_end_agrees(CM_field_id_t m, CM_field_id_t c)
{
    CM_c_write_to_processor_1L(7, m, 0.1, -2, 23, 8);
    CM_complex_t z = CM_c_read_from_processor_1L(7, m, 23, 8),
                 w = CM_c_read_from_processor_1L(8, m, 23, 8);
    assert_true((float)z.real == 0.1f && z.imag == -2);
    assert_true((float)w.real == (float)(1.0 / 3) && (float)w.imag == (float)(2.0 / 3));
    CM_c_move_constant_1L(c, 0.5, -0.25, 10, 5);
    CM_complex_t sum = CM_global_c_add_1L(c, 10, 5);
    assert_true(sum.real == MANY / 2.0 && sum.imag == MANY / -4.0);
    CM_c_move_zero_1L(c, 10, 5);
    sum = CM_global_c_add_1L(c, 10, 5);
    assert_true(sum.real == 0 && sum.imag == 0);
}

static void the_rest_agrees(void **unused)
{
    (void)unused;
    static double out[2 * MANY];
    static unsigned char flags[4][MANY];
    int zero[2] = {0, 0}, side[2] = {HIGH, ACROSS}, axes[2] = {0, 1};
    CM_vector_t none = {.ints = zero}, all = {.ints = side}, both = {.ints = axes};
    start();
    samples_make(small);
    samples[1][40] = samples[0][40], samples[1][41] = samples[0][41];
    CM_field_id_t a = field_of(small, samples[0]), b = field_of(small, samples[1]),
                  t = CM_allocate_stack_field(4), wide = CM_allocate_stack_field(128),
                  next = CM_allocate_stack_field(32), c = CM_allocate_stack_field(32),
                  m = CM_allocate_stack_field(64);
    CM_c_eq_1L(a, b, 10, 5);
    CM_store_test(t);
    CM_c_ne_1L(a, b, 10, 5);
    CM_store_test(t + 1);
    CM_c_eq_constant_1L(a, 1, -0.5, 10, 5);
    CM_store_test(t + 2);
    CM_c_ne_zero_1L(a, 10, 5);
    CM_store_test(t + 3);
    CM_c_move_2L(wide, a, 52, 11, 10, 5);
    CM_c_get_from_news_1L(next, a, 1, CM_upward, 10, 5);
    CM_c_move_1L(c, a, 10, 5);
    CM_c_negate_1_1L(c, 10, 5);
    CM_c_conjugate_always_1_1L(c, 10, 5);
    CM_c_move_const_1L(m, 1.0 / 3, 2.0 / 3, 23, 8);
    for (unsigned int k = 0; k < 4; k++)
        CM_u_read_from_news_array_1L(flags[k], none, none, all, both, t + k, 1, 2, all,
                                     CM_8_bit);
    for (int n = 0; n < MANY; n++) {
        const double *x = samples[0] + 2 * n, *y = samples[1] + 2 * n;
        bool same = x[0] == y[0] && x[1] == y[1];
        assert_int_equal(flags[0][n], same);
        assert_int_equal(flags[1][n], !same);
        assert_int_equal(flags[2][n], x[0] == 1 && x[1] == -0.5);
        assert_int_equal(flags[3][n], !(x[0] == 0 && x[1] == 0));
    }
    parts_of((struct format){52, 11}, wide, out);
    for (int i = 0; i < 2 * MANY; i++)
        assert_true(out[i] == samples[0][i] || isnan(samples[0][i]));
    parts_of(small, next, out);
    for (int n = 0; n < MANY; n++)
        for (int p = 0; p < 2; p++) {
            double x = samples[0][2 * (n / ACROSS * ACROSS + (n % ACROSS + 1) % ACROSS) + p];
            assert_true(out[2 * n + p] == x || isnan(x));
        }
    parts_of(small, c, out);
    for (int n = 0; n < MANY; n++) {
        assert_true(out[2 * n] == -samples[0][2 * n] || isnan(out[2 * n]));
        assert_true(out[2 * n + 1] == samples[0][2 * n + 1] || isnan(out[2 * n + 1]));
    }
    front_end_agrees(m, c);
    assert_string_equal(device_message, "");
    CM_set_safety_mode(1);
    CM_c_add_2_1L(next, wide, 16, 11);
    device_said("CM_c_add_2_1L", "dest");
    paris_safety_usual();
    CM_c_move_zero_1L(wide + 16, 52, 11); /* no room for the second part: neither is stored */
    device_said("CM_c_move_zero_1L", "beyond its field");
    parts_of((struct format){52, 11}, wide, out);
    for (int i = 0; i < 2 * MANY; i++)
        assert_true(out[i] == samples[0][i] || isnan(samples[0][i]));
    CM_set_safety_mode(1);
    CM_c_sqrt_2_1L(c, wide, 10, 1);
    device_said("CM_c_sqrt_2_1L", "exponent 2..11");
    paris_safety_usual();
}

static void functions_agree(struct format f)
{
    start();
    samples_make(f);
    unaries_agree(f);
    if (f.e == 11)
        powers_agree(f);
    parts_agree(f);
    assert_string_equal(device_message, "");
}

static void double_functions_agree(void **unused)
{
    (void)unused;
    functions_agree((struct format){52, 11});
}

static void single_functions_agree(void **unused)
{
    (void)unused;
    functions_agree((struct format){23, 8});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(double_functions_agree),
        cmocka_unit_test(single_functions_agree),
        cmocka_unit_test(forms_agree),
        cmocka_unit_test(the_rest_agrees),
    };
    return cmocka_run_group_tests_name("paris: complex numbers", tests, NULL, NULL);
}
