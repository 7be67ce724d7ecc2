/* Compares C/Paris instructions on floats of other lengths than 23, 8 and 52, 11 with MPFR. The
 * machine's own test has more formats and numbers; this one has all instructions. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"
#include "oracle_soft.h"

enum { SIDE = 40, MANY = SIDE * SIDE, RESULTS_MAX = 40 };

static struct soft_format f;
static uint64_t a_bits[MANY], b_bits[MANY], d_bits[MANY];
static uint64_t wholes[MANY];
static bool active[MANY];

static uint64_t op(char symbol, uint64_t x, uint64_t y)
{
    return oracle_soft_arithmetic(f, symbol, x, y);
}
static double value(uint64_t bits)
{
    return oracle_soft_value(f, bits);
}
static uint64_t bits_of(double x)
{
    return oracle_soft_of(f, x);
}

/* ---- fields, by their bits ---- */

static size_t element(unsigned int bits)
{
    return machine_element_bytes(MACHINE_UINT(bits));
}

static CM_field_id_t field_of(unsigned int bits, const uint64_t *numbers)
{
    static unsigned char dense[MANY * 8];
    CM_field_id_t field = CM_allocate_stack_field(bits);
    for (size_t n = 0; n < MANY; n++)
        memcpy(dense + n * element(bits), &numbers[n], element(bits));
    assert_int_equal(machine_field_upload(paris_machine(), field, MACHINE_UINT(bits), dense),
                     0);
    return field;
}

static void numbers_of(CM_field_id_t field, unsigned int bits, uint64_t *numbers)
{
    static unsigned char dense[MANY * 8];
    assert_int_equal(machine_field_download(paris_machine(), field, MACHINE_UINT(bits), dense),
                     0);
    for (size_t n = 0; n < MANY; n++) {
        numbers[n] = 0;
        memcpy(&numbers[n], dense + n * element(bits), element(bits));
    }
}

/* ---- expected results, for processor n ---- */

struct result {
    const char *name;
    CM_field_id_t field;
    unsigned int bits;
    uint64_t (*wanted)(int n);
    bool always;
};
static struct result results[RESULTS_MAX];
static int results_count;

static CM_field_id_t result(const char *name, unsigned int bits, uint64_t (*wanted)(int n),
                            bool always)
{
    CM_field_id_t field = field_of(bits, d_bits);
    assert_true(results_count < RESULTS_MAX);
    results[results_count++] = (struct result){name, field, bits, wanted, always};
    return field;
}

#define WANTED(name, expression)                                                               \
    static uint64_t want_##name(int n)                                                         \
    {                                                                                          \
        uint64_t a = a_bits[n], b = b_bits[n], d = d_bits[n], u = wholes[n];                   \
        double x = value(a), y = value(b);                                                     \
        (void)a, (void)b, (void)d, (void)u, (void)x, (void)y;                                  \
        return expression;                                                                     \
    }
WANTED(add, op('+', a, b))
WANTED(less_tenth, op('-', a, bits_of(0.1)))
WANTED(times, op('*', d, a))
WANTED(ratio, op('/', a, b))
WANTED(subfrom, op('-', a, d))
WANTED(divinto, op('/', bits_of(3), d))
WANTED(min, x < y ? (isnan(x) ? oracle_soft_nan(f) : a) : isnan(y) ? oracle_soft_nan(f) : b)
WANTED(max, x > y ? a : isnan(y) ? oracle_soft_nan(f) : b)
WANTED(negate, bits_of(-value(d)))
WANTED(absolute, bits_of(fabs(x)))
WANTED(root, op('r', a, 0))
WANTED(floor, bits_of(floor(x)))
WANTED(round, bits_of(rint(value(d))))
WANTED(move, a)
WANTED(tenth, bits_of(0.1))
WANTED(zero, 0)
WANTED(to_single, oracle_soft_of((struct soft_format){23, 8}, x))
WANTED(to_double, oracle_soft_of((struct soft_format){52, 11}, x))
WANTED(to_brain, oracle_soft_of((struct soft_format){7, 8}, x))
WANTED(of_unsigned, oracle_soft_of_whole(f, u, false))
WANTED(of_signed, oracle_soft_of_whole(f, (int64_t)u < 0 ? 0 - u : u, (int64_t)u < 0))
WANTED(of_short, oracle_soft_of_whole(f, u & 0x1fff, false))
WANTED(equal, x == y)
WANTED(below, x < 0.5)
WANTED(too_much, oracle_soft_is_finite(f, a) && oracle_soft_is_finite(f, b) &&
                     !oracle_soft_is_finite(f, op('*', a, b)))

static double clipped(double x, double low, double high)
{
    return isnan(x) ? 0 : fmin(fmax(x, low), high);
}
WANTED(to_signed, (uint64_t)(int64_t)clipped(rint(x), -4096, 4095) & 0x1fff)
WANTED(to_unsigned, (uint64_t)clipped(trunc(x), 0, 255))
WANTED(not_signed, !(rint(x) >= -4096 && rint(x) < 4096))
WANTED(next, a_bits[n / SIDE * SIDE + (n % SIDE + 1) % SIDE])

/* ---- the functions ---- */

WANTED(sine, oracle_soft_function(f, 's', a))
WANTED(exponential, oracle_soft_function(f, 'e', a))
WANTED(mult_add, op('+', op('*', a, b), d))
WANTED(scaled, bits_of(ldexp(x, (int8_t)u)))
WANTED(significand, x == 0 || !isfinite(x) ? bits_of(x) : bits_of(x / ldexp(1, ilogb(x))))
WANTED(exponent, x == 0 ? 0x8000 : isfinite(x) ? (uint64_t)ilogb(x) & 0xffff : 0)
WANTED(exponent_field, a >> f.s & ((UINT64_C(1) << f.e) - 1))
WANTED(normal, isfinite(x) && fabs(x) >= ldexp(1, 2 - (1 << (f.e - 1))))
WANTED(not_number, (uint64_t)(x != x))

/* ---- the instructions ---- */

static void record_arithmetic(CM_field_id_t a, CM_field_id_t b)
{
    unsigned int s = (unsigned int)f.s, e = (unsigned int)f.e, bits = s + e + 1;
    CM_f_add_3_1L(result("add_3", bits, want_add, false), a, b, s, e);
    CM_f_subtract_constant_3_1L(result("subtract_constant_3", bits, want_less_tenth, false), a,
                                0.1, s, e);
    CM_f_multiply_2_1L(result("multiply_2", bits, want_times, false), a, s, e);
    CM_f_divide_always_3_1L(result("divide_always_3", bits, want_ratio, true), a, b, s, e);
    CM_f_subfrom_2_1L(result("subfrom_2", bits, want_subfrom, false), a, s, e);
    CM_f_divinto_const_2_1L(result("divinto_const_2", bits, want_divinto, false), 3, s, e);
    CM_f_min_3_1L(result("min_3", bits, want_min, false), a, b, s, e);
    CM_f_max_3_1L(result("max_3", bits, want_max, false), a, b, s, e);
    CM_f_negate_1_1L(result("negate_1", bits, want_negate, false), s, e);
    CM_f_abs_always_2_1L(result("abs_always_2", bits, want_absolute, true), a, s, e);
    CM_f_sqrt_2_1L(result("sqrt_2", bits, want_root, false), a, s, e);
    CM_f_f_floor_2_1L(result("f_floor_2", bits, want_floor, false), a, s, e);
    CM_f_f_round_1_1L(result("f_round_1", bits, want_round, false), s, e);
}

static void record_moves(CM_field_id_t a, CM_field_id_t u)
{
    unsigned int s = (unsigned int)f.s, e = (unsigned int)f.e, bits = s + e + 1;
    CM_f_move_1L(result("move", bits, want_move, false), a, s, e);
    CM_f_move_constant_1L(result("move_constant", bits, want_tenth, false), 0.1, s, e);
    CM_f_move_zero_always_1L(result("move_zero_always", bits, want_zero, true), s, e);
    CM_f_move_2L(result("move to single", 32, want_to_single, false), a, 23, 8, s, e);
    CM_f_move_2L(result("move to double", 64, want_to_double, false), a, 52, 11, s, e);
    CM_f_move_2L(result("move to 7, 8", 16, want_to_brain, false), a, 7, 8, s, e);
    CM_f_u_float_2_2L(result("f_u_float", bits, want_of_unsigned, false), u, 64, s, e);
    CM_f_s_float_2_2L(result("f_s_float", bits, want_of_signed, false), u, 64, s, e);
    CM_f_u_float_2_2L(result("f_u_float of 13", bits, want_of_short, false), u, 13, s, e);
    CM_u_f_truncate_2_2L(result("u_f_truncate", 8, want_to_unsigned, false), a, 8, s, e);
    CM_get_from_news_1L(result("get_from_news", bits, want_next, false), a, 1, CM_upward, bits);
}

static void record_flags(CM_field_id_t a, CM_field_id_t b)
{
    unsigned int s = (unsigned int)f.s, e = (unsigned int)f.e;
    CM_field_id_t scratch = CM_allocate_stack_field(s + e + 1);
    CM_f_multiply_3_1L(scratch, a, b, s, e);
    CM_store_overflow(result("overflow of multiply", 1, want_too_much, false));
    CM_s_f_round_2_2L(result("s_f_round", 13, want_to_signed, false), a, 13, s, e);
    CM_store_overflow(result("overflow of s_f_round", 1, want_not_signed, false));
    CM_f_eq_1L(a, b, s, e);
    CM_store_test(result("eq", 1, want_equal, false));
    CM_f_lt_constant_1L(a, 0.5, s, e);
    CM_store_test(result("lt_constant", 1, want_below, false));
}

static void record_functions(CM_field_id_t a, CM_field_id_t b, CM_field_id_t d, CM_field_id_t u)
{
    unsigned int s = (unsigned int)f.s, e = (unsigned int)f.e, bits = s + e + 1;
    CM_f_sin_2_1L(result("sin", bits, want_sine, false), a, s, e);
    CM_f_exp_2_1L(result("exp", bits, want_exponential, false), a, s, e);
    CM_f_mult_add_1L(result("mult_add", bits, want_mult_add, false), a, b, d, s, e);
    CM_f_s_scale_3_2L(result("s_scale", bits, want_scaled, false), a, u, 8, s, e);
    CM_f_f_significand_2_1L(result("f_significand", bits, want_significand, false), a, s, e);
    CM_s_f_exponent_2_2L(result("s_f_exponent", 16, want_exponent, false), a, 16, s, e);
    CM_u_f_exponent_2_2L(result("u_f_exponent", e, want_exponent_field, false), a, e, s, e);
    CM_f_is_normal_1L(a, s, e);
    CM_store_test(result("is_normal", 1, want_normal, false));
    CM_f_is_nan_1L(a, s, e);
    CM_store_test(result("is_nan", 1, want_not_number, false));
}

static void start(struct soft_format format)
{
    f = format;
    device_start(0);
    int side[2] = {SIDE, SIDE};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry((CM_vector_t){.ints = side}, 2)));
    CM_set_error_handler(device_error_catch);
    device_message[0] = 0;
    device_seed(5);
    for (int n = 0; n < MANY; n++) {
        a_bits[n] = oracle_soft_sample(f, (uint64_t)n);
        b_bits[n] = oracle_soft_sample(f, (uint64_t)n + 9999);
        d_bits[n] = oracle_soft_sample(f, (uint64_t)n + 99999);
        wholes[n] = device_random() >> n % 64;
        active[n] = device_random() >> 20 & 1;
    }
    results_count = 0;
}

static void instructions_agree(struct soft_format format)
{
    static uint64_t out[MANY], context[MANY];
    start(format);
    unsigned int bits = (unsigned int)(f.s + f.e + 1);
    CM_field_id_t a = field_of(bits, a_bits), b = field_of(bits, b_bits),
                  u = field_of(64, wholes), d = field_of(bits, d_bits);
    for (int n = 0; n < MANY; n++)
        context[n] = active[n];
    CM_field_id_t mask = field_of(1, context);
    CM_load_context(mask);
    record_arithmetic(a, b);
    record_moves(a, u);
    record_flags(a, b);
    if (f.s == 40) /* they would double the kernels */
        record_functions(a, b, d, u);
    for (int k = 0; k < results_count; k++) {
        const struct result *r = &results[k];
        uint64_t mask_bits = r->bits == 64 ? UINT64_MAX : (UINT64_C(1) << r->bits) - 1;
        numbers_of(r->field, r->bits, out);
        for (int n = 0; n < MANY; n++) {
            uint64_t wanted = active[n] || r->always ? r->wanted(n) : d_bits[n] & mask_bits;
            if (out[n] != wanted)
                fail_msg("%d, %d: %s of %llx, %llx, %llx: %llx, not %llx", f.s, f.e, r->name,
                         (unsigned long long)a_bits[n], (unsigned long long)b_bits[n],
                         (unsigned long long)d_bits[n], (unsigned long long)out[n],
                         (unsigned long long)wanted);
        }
    }
    assert_string_equal(device_message, "");
}

static void half_precision_agrees(void **unused)
{
    (void)unused;
    instructions_agree((struct soft_format){10, 5});
}

static void long_format_agrees(void **unused)
{
    (void)unused;
    instructions_agree((struct soft_format){40, 10});
}

/* Random numbers, reductions, single processors, arrays. */
static void front_end_agrees(void **unused)
{
    (void)unused;
    static float singles[MANY];
    int zero[2] = {0, 0}, side[2] = {SIDE, SIDE}, axes[2] = {0, 1};
    CM_vector_t none = {.ints = zero}, all = {.ints = side}, both = {.ints = axes};
    start((struct soft_format){10, 5});
    CM_field_id_t r = CM_allocate_stack_field(16);
    double sum = 0, least = 2, greatest = -1;
    CM_f_random_1L(r, 10, 5);
    CM_f_read_from_news_array_1L(singles, none, none, all, both, r, 10, 5, 2, all,
                                 CM_float_single);
    for (int n = 0; n < MANY; n++) {
        double x = singles[n];
        assert_true(x >= 0 && x < 1 && x * 2048 == floor(x * 2048));
        sum += x;
        least = fmin(least, x);
        greatest = fmax(greatest, x);
    }
    assert_true(sum > MANY * 0.4 && sum < MANY * 0.6);
    assert_true(CM_global_f_add_1L(r, 10, 5) == value(bits_of(sum)));
    assert_true(CM_global_f_min_1L(r, 10, 5) == least);
    assert_true(CM_global_f_max_1L(r, 10, 5) == greatest);
    CM_f_write_to_processor_1L(3, r, 0.1, 10, 5);
    assert_true(CM_f_read_from_processor_1L(3, r, 10, 5) == value(bits_of(0.1)));
    for (int n = 0; n < MANY; n++)
        singles[n] = (float)n / 7;
    CM_f_write_to_news_array_1L(singles, none, none, all, both, r, 10, 5, 2, all,
                                CM_float_single);
    assert_true(CM_global_f_max_1L(r, 10, 5) == value(bits_of(singles[MANY - 1])));
    CM_f_ieee_to_vax_1_1L(r, 10, 5);
    assert_non_null(strstr(device_message, "VAX's floats are"));
    CM_f_add_2_1L(r, r, 53, 5);
    assert_non_null(strstr(device_message, "significand must be 1..52"));
}

/* Moves keep a NaN's bits, whether all processors have the same one or not, also under a
 * context and where no message arrives; what an operation gives is *the* NaN. */
static void nans_keep_their_bits(void **unused)
{
    static const struct soft_format formats[] = {{10, 5}, {3, 4}, {30, 10}, {51, 11}};
    static uint64_t nans[MANY], got[MANY];
    (void)unused;
    for (size_t k = 0; k < sizeof formats / sizeof *formats; k++) {
        const unsigned int s = (unsigned int)formats[k].s, e = (unsigned int)formats[k].e;
        const uint64_t ones = (UINT64_C(1) << e) - 1,
                       the = (ones << 1 | 1) << (s - 1) | UINT64_C(1) << (s + e);
        for (int alike = 0; alike < 2; alike++) {
            start(formats[k]);
            for (int n = 0; n < MANY; n++) {
                uint64_t any = alike ? 5 : (uint64_t)n * UINT64_C(0x9e3779b97f4a7c15);
                uint64_t fraction = (any >> 7) & ((UINT64_C(1) << s) - 1);
                nans[n] = (any & 1) << (s + e) | ones << s | (fraction ? fraction : 1);
            }
            const CM_field_id_t from = field_of(s + e + 1, nans),
                                to = CM_allocate_stack_field(s + e + 1),
                                address = CM_allocate_stack_field(32),
                                one = CM_allocate_stack_field(s + e + 1);
            if (alike) /* a number for the machine */
                CM_u_move_constant_1L(from, nans[0], s + e + 1);
            CM_f_move_1L(to, from, s, e);
            CM_u_move_zero_1L(address, 32);
            CM_f_move_constant_1L(one, 1.0, s, e);
            CM_send_with_f_add_1L(to, address, one, s, e, CM_no_field); /* all to one */
            CM_clear_context();
            CM_f_add_2_1L(to, one, s, e);
            CM_set_context();
            numbers_of(to, s + e + 1, got);
            for (int n = 1; n < MANY; n++)
                if (got[n] != nans[n])
                    fail_msg("%u, %u: a NaN %llx became %llx", s, e,
                             (unsigned long long)nans[n], (unsigned long long)got[n]);
            assert_true(got[0] == the);
            CM_f_add_2_1L(to, one, s, e);
            numbers_of(to, s + e + 1, got);
            for (int n = 0; n < MANY; n++)
                assert_true(got[n] == the);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_precision_agrees),
        cmocka_unit_test(long_format_agrees),
        cmocka_unit_test(front_end_agrees),
        cmocka_unit_test(nans_keep_their_bits),
    };
    return cmocka_run_group_tests_name("paris: floats of other lengths", tests, NULL, NULL);
}
