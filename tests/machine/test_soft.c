/* Compares floats of other formats with MPFR, on edge cases and random bits: the arithmetic,
 * compiled as C, in many formats; every operation on the device in a few formats, one kernel
 * each. */
#include "support.h"

#include "oracle_soft.h"
#include "sample.h"

#include <math.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include "soft.cl"
#pragma GCC diagnostic pop

enum { SIDE = 56, CASES = SIDE * SIDE, RESULTS_MAX = 40 };

static const struct soft_format many[] = {{10, 5}, {7, 8},  {3, 4},   {1, 2},   {2, 3},
                                          {23, 8}, {24, 9}, {25, 8},  {20, 11}, {52, 8},
                                          {1, 11}, {52, 2}, {40, 10}, {51, 11}, {52, 11}};
/* the first is computed in double and rounded, the second in integers */
static const struct soft_format few[] = {{10, 5}, {51, 11}};

struct operands {
    struct soft_format f;
    uint64_t a, b;
    unsigned __int128 whole;
};

struct result {
    const char *name;
    uint32_t field;
    int bits;
    uint64_t (*expected)(const struct operands *o);
};

static struct result results[RESULTS_MAX];
static int results_count;

static void record(struct machine *m, const char *name, struct machine_value *v,
                   uint64_t (*expected)(const struct operands *o))
{
    if (!v)
        fail_msg("%s: %s", name, machine_error(m));
    int bits = machine_type_bits(machine_value_type(v));
    uint32_t field =
        machine_field_allocate(m, machine_vpset_current(m), (uint32_t)bits, MACHINE_HEAP);
    assert_true(field && results_count < RESULTS_MAX);
    assert_ok(machine_field_store(m, field, v, MACHINE_EVERYWHERE), m);
    results[results_count++] = (struct result){name, field, bits, expected};
}

/* ---- what is expected ---- */

#define ARITHMETIC(name, symbol)                                                               \
    static uint64_t expected_##name(const struct operands *o)                                  \
    {                                                                                          \
        return oracle_soft_arithmetic(o->f, symbol, o->a, o->b);                               \
    }
ARITHMETIC(add, '+')
ARITHMETIC(subtract, '-')
ARITHMETIC(multiply, '*')
ARITHMETIC(divide, '/')
ARITHMETIC(root, 'r')

#define FUNCTION(name, expression)                                                             \
    static uint64_t expected_##name(const struct operands *o)                                  \
    {                                                                                          \
        double x = oracle_soft_value(o->f, o->a), y = oracle_soft_value(o->f, o->b);           \
        (void)x;                                                                               \
        (void)y;                                                                               \
        return expression;                                                                     \
    }
FUNCTION(floor, oracle_soft_of(o->f, floor(x)))
FUNCTION(ceil, oracle_soft_of(o->f, ceil(x)))
FUNCTION(trunc, oracle_soft_of(o->f, trunc(x)))
FUNCTION(round, oracle_soft_of(o->f, rint(x)))
FUNCTION(negative, oracle_soft_of(o->f, -x))
FUNCTION(absolute, oracle_soft_of(o->f, fabs(x)))
FUNCTION(least, oracle_soft_of(o->f, x < y ? x : y))
FUNCTION(greatest, oracle_soft_of(o->f, x > y ? x : y))
FUNCTION(less, x < y)
FUNCTION(equal, x == y)
FUNCTION(moved, o->a)
FUNCTION(tenth, oracle_soft_of(o->f, 0.1))
/* a conversion to the same format moves the bits, those of NaNs too */
FUNCTION(half, o->f.s == 10 ? o->a : oracle_soft_of((struct soft_format){10, 5}, x))
FUNCTION(single, oracle_soft_of((struct soft_format){23, 8}, x))
FUNCTION(other, oracle_soft_of((struct soft_format){30, 6}, x))
FUNCTION(of_double, oracle_soft_of(o->f, nextafter(y, 0)))

static uint64_t expected_overflow(const struct operands *o)
{
    uint64_t r = oracle_soft_arithmetic(o->f, '*', o->a, o->b);
    return oracle_soft_is_finite(o->f, o->a) && oracle_soft_is_finite(o->f, o->b) &&
           !oracle_soft_is_finite(o->f, r);
}

static uint64_t of_whole(const struct operands *o, int width, bool is_signed)
{
    unsigned __int128 x = o->whole & wide_mask(width);
    bool negative = is_signed && x >> (width - 1);
    return oracle_soft_of_whole(o->f, negative ? -x & wide_mask(width) : x, negative);
}
#define WHOLE(width)                                                                           \
    static uint64_t expected_u##width(const struct operands *o)                                \
    {                                                                                          \
        return of_whole(o, width, false);                                                      \
    }                                                                                          \
    static uint64_t expected_s##width(const struct operands *o)                                \
    {                                                                                          \
        return of_whole(o, width, true);                                                       \
    }
WHOLE(7)
WHOLE(64)
WHOLE(57)
WHOLE(128)

/* ---- the machine's results ---- */

static void record_float(struct machine *m, struct machine_value *a, struct machine_value *b,
                         struct machine_type type)
{
    record(m, "add", machine_binary(m, MACHINE_FADD, a, b), expected_add);
    record(m, "subtract", machine_binary(m, MACHINE_FSUB, a, b), expected_subtract);
    record(m, "multiply", machine_binary(m, MACHINE_FMUL, a, b), expected_multiply);
    record(m, "divide", machine_binary(m, MACHINE_FDIV, a, b), expected_divide);
    record(m, "root", machine_unary(m, MACHINE_FSQRT, a), expected_root);
    record(m, "floor", machine_unary(m, MACHINE_FFLOOR, a), expected_floor);
    record(m, "ceil", machine_unary(m, MACHINE_FCEIL, a), expected_ceil);
    record(m, "trunc", machine_unary(m, MACHINE_FTRUNC, a), expected_trunc);
    record(m, "round", machine_unary(m, MACHINE_FROUND, a), expected_round);
    record(m, "negative", machine_unary(m, MACHINE_FNEG, a), expected_negative);
    record(m, "absolute", machine_unary(m, MACHINE_FABS, a), expected_absolute);
    record(m, "least", machine_binary(m, MACHINE_FMIN, a, b), expected_least);
    record(m, "greatest", machine_binary(m, MACHINE_FMAX, a, b), expected_greatest);
    record(m, "less", machine_binary(m, MACHINE_FLT, a, b), expected_less);
    record(m, "equal", machine_binary(m, MACHINE_FEQ, a, b), expected_equal);
    record(m, "move", a, expected_moved);
    record(m, "constant", machine_constant_float(m, type, 0.1), expected_tenth);
    record(m, "to 10, 5", machine_to_float(m, a, MACHINE_SOFT(10, 5), false), expected_half);
    record(m, "to single", machine_to_float(m, a, MACHINE_F32, false), expected_single);
    machine_overflow_record(m, MACHINE_FMUL, false, a, b);
    record(m, "overflow", machine_flag_value(m, MACHINE_OVERFLOW, MACHINE_EVERYWHERE),
           expected_overflow);
}

static void record_conversions(struct machine *m, struct machine_value *a,
                               struct machine_value *whole, struct machine_value *near,
                               struct machine_type type)
{
    record(m, "to 30, 6", machine_to_float(m, a, MACHINE_SOFT(30, 6), false), expected_other);
    record(m, "from double", machine_to_float(m, near, type, false), expected_of_double);
#define FROM(width)                                                                            \
    record(m, "from u" #width,                                                                 \
           machine_to_float(m, machine_extract(m, whole, 0, width), type, false),              \
           expected_u##width);                                                                 \
    record(m, "from s" #width,                                                                 \
           machine_to_float(m, machine_extract(m, whole, 0, width), type, true),               \
           expected_s##width)
    FROM(7);
    FROM(57);
    FROM(64);
    FROM(128);
}

static uint32_t field_of(struct machine *m, int bits, const void *data)
{
    uint32_t field =
        machine_field_allocate(m, machine_vpset_current(m), (uint32_t)bits, MACHINE_HEAP);
    assert_ok(machine_field_upload(m, field, MACHINE_UINT(bits), data), m);
    return field;
}

static uint64_t bits_at(const unsigned char *data, int width, size_t n)
{
    uint64_t x = 0;
    size_t bytes = machine_element_bytes(MACHINE_UINT(width));
    memcpy(&x, data + n * bytes, bytes);
    return x;
}

static unsigned char image[2][CASES * 8];
static unsigned __int128 wholes[CASES];

static void check_results(struct machine *m, struct soft_format f)
{
    static unsigned char out[CASES * 8];
    int bits = f.s + f.e + 1;
    for (int k = 0; k < results_count; k++) {
        const struct result *r = &results[k];
        assert_ok(machine_field_download(m, r->field, MACHINE_UINT(r->bits), out), m);
        for (size_t n = 0; n < CASES; n++) {
            struct operands o = {f, bits_at(image[0], bits, n), bits_at(image[1], bits, n),
                                 wholes[n]};
            uint64_t got = bits_at(out, r->bits, n), wanted = r->expected(&o);
            if (got != wanted)
                fail_msg("%d, %d: %s of %llx, %llx (whole %llx %llx): %llx, not %llx", f.s, f.e,
                         r->name, (unsigned long long)o.a, (unsigned long long)o.b,
                         (unsigned long long)(o.whole >> 64), (unsigned long long)o.whole,
                         (unsigned long long)got, (unsigned long long)wanted);
        }
    }
    results_count = 0;
}

static void one_format(struct soft_format f)
{
    static double near[CASES];
    struct machine *m = support_machine(0);
    struct machine_type type = MACHINE_SOFT(f.s, f.e);
    int bits = f.s + f.e + 1;
    size_t bytes = machine_element_bytes(MACHINE_UINT(bits));

    support_set(m, 2, SIDE, SIDE);
    for (size_t n = 0; n < CASES; n++) {
        uint64_t a = oracle_soft_sample(f, n), b = oracle_soft_sample(f, n + CASES);
        memcpy(image[0] + n * bytes, &a, bytes);
        memcpy(image[1] + n * bytes, &b, bytes);
        wholes[n] = ((unsigned __int128)(oracle_soft_sample(f, n) * SAMPLE_GOLDEN) << 64 |
                     oracle_soft_sample((struct soft_format){52, 11}, n)) >>
                    n % 128;
        near[n] = nextafter(oracle_soft_value(f, b), 0);
    }
    uint32_t a = field_of(m, bits, image[0]), b = field_of(m, bits, image[1]),
             w = field_of(m, 128, wholes), d = field_of(m, 64, near);
    machine_begin(m);
    record_float(m, machine_field_value(m, a, type, MACHINE_EVERYWHERE),
                 machine_field_value(m, b, type, MACHINE_EVERYWHERE), type);
    check_results(m, f);
    machine_begin(m);
    record_conversions(m, machine_field_value(m, a, type, MACHINE_EVERYWHERE),
                       machine_field_value(m, w, MACHINE_UINT(128), MACHINE_EVERYWHERE),
                       machine_field_value(m, d, MACHINE_F64, MACHINE_EVERYWHERE), type);
    check_results(m, f);
    machine_destroy(m);
}

static void operations_agree_with_mpfr(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof few / sizeof *few; k++)
        one_format(few[k]);
}

static void arithmetic_one(struct soft_format f, uint64_t a, uint64_t b, char op)
{
    ulong x = soft_unpack(a, f.s, f.e), y = soft_unpack(b, f.s, f.e), r;
    double value = oracle_soft_value(f, a);
    if (!isnan(value) && memcmp(&value, &x, sizeof x) != 0)
        fail_msg("%d, %d: %llx is unpacked wrong", f.s, f.e, (unsigned long long)a);
    r = op == '+'   ? soft_add(x, y, f.s, f.e)
        : op == '-' ? soft_add(x, y ^ SOFT_SIGN, f.s, f.e)
        : op == '*' ? soft_multiply(x, y, f.s, f.e)
        : op == '/' ? soft_divide(x, y, f.s, f.e)
                    : soft_root(x, f.s, f.e);
    uint64_t wanted = oracle_soft_arithmetic(f, op, a, b), got = soft_pack(r, f.s, f.e);
    if (got != wanted || soft_fit(r, f.s, f.e) != r)
        fail_msg("%d, %d: %llx %c %llx: %llx, not %llx", f.s, f.e, (unsigned long long)a, op,
                 (unsigned long long)b, (unsigned long long)got, (unsigned long long)wanted);
}

static void arithmetic_agrees_with_mpfr(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof many / sizeof *many; k++)
        for (uint64_t n = 0; n < 20000; n++)
            arithmetic_one(many[k], oracle_soft_sample(many[k], 2 * n),
                           oracle_soft_sample(many[k], 2 * n + 1), "+-*/r"[n % 5]);
}

static void doubles_go_in_and_out(void **unused)
{
    (void)unused;
    static const double in[6] = {0.1, -1e9, 3.0000001, 1e-9, -0.0, 65504};
    struct soft_format f = {10, 5};
    struct machine_type type = MACHINE_SOFT(10, 5);
    struct machine *m = support_machine(0);
    int set = support_set(m, 1, 6);
    double out[6], sum = 0;
    struct machine_scalar x;

    machine_begin(m);
    uint32_t field = machine_field_allocate(m, set, 16, MACHINE_HEAP);
    assert_ok(machine_field_upload(m, field, type, in), m);
    assert_ok(machine_field_download(m, field, type, out), m);
    for (int i = 0; i < 6; i++) {
        double wanted = oracle_soft_value(f, oracle_soft_of(f, in[i]));
        assert_memory_equal(&out[i], &wanted, sizeof wanted);
    }
    assert_ok(
        machine_field_write(m, field, type, 1, (struct machine_scalar){0x4000000000000001, 0}),
        m); /* a little over 2 */
    assert_ok(machine_field_download(m, field, type, out), m);
    for (int i = 0; i < 6; i++) {
        double wanted = i == 1 ? 2 : oracle_soft_value(f, oracle_soft_of(f, in[i]));
        assert_memory_equal(&out[i], &wanted, sizeof wanted);
        assert_ok(machine_field_read(m, field, type, (uint64_t)i, &x), m);
        assert_memory_equal(&x.lo, &wanted, sizeof wanted);
        sum += wanted;
    }
    assert_ok(machine_reduce(m, MACHINE_REDUCE_FADD,
                             machine_field_value(m, field, type, MACHINE_WHERE_ACTIVE), &x),
              m);
    double rounded = oracle_soft_value(f, oracle_soft_of(f, sum));
    assert_memory_equal(&x.lo, &rounded, sizeof rounded);
    assert_null(machine_field_value(m, field, MACHINE_SOFT(9, 1), MACHINE_EVERYWHERE));
    assert_null(machine_field_value(m, field, MACHINE_SOFT(11, 5), MACHINE_EVERYWHERE));
    machine_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arithmetic_agrees_with_mpfr),
        cmocka_unit_test(operations_agree_with_mpfr),
        cmocka_unit_test(doubles_go_in_and_out),
    };
    return cmocka_run_group_tests_name("machine: floats of other formats", tests, NULL, NULL);
}
