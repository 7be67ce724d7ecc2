/* test_nans.c - the NaN of a float operation always has the same bits, whatever NaNs its
 * operands are and whether they were computed or written. A move keeps a NaN's bits. Tested for
 * devices whose operations keep NaNs (x86) and as if they did not. */
#include "support.h"

#include <math.h>

enum { ROWS = 8, COLUMNS = 50, COUNT = ROWS * COLUMNS, TURNS = 40, WRITTEN = 77, ROOTS = 8 };

static struct machine *machine;

/* The n-th sample: numbers, infinities, the operations' NaN, and NaNs that a program writes
 * (signalling, positive, with payloads). */
static uint64_t bits_at(int width, uint64_t n)
{
    static const uint32_t single[] = {0x3f800000, 0x7f800000, 0xff800000, 0x00000000,
                                      0xbf000000, 0xffc00000, 0x7fc00000, 0x7f800001,
                                      0xff923456, 0x7fffffff};
    const uint32_t x = single[n * 7 % 10];

    if (width == 32)
        return x;
    const uint64_t fraction = x & 0x7fffffu, exponent = x >> 23 & 255;
    return (uint64_t)(x >> 31) << 63 | fraction << 29 |
           (exponent == 0     ? 0
            : exponent == 255 ? UINT64_C(0x7ff) << 52
                              : (exponent + 896) << 52);
}

static bool is_nan(int width, uint64_t x)
{
    return width == 32 ? (x & INT32_MAX) > 0x7f800000u
                       : (x & INT64_MAX) > UINT64_C(0x7ff0000000000000);
}

static uint64_t the_nan(int width)
{
    return width == 32 ? 0xffc00000u : UINT64_C(0xfff8000000000000);
}

static double number(int width, uint64_t x)
{
    float single;
    double result;
    const uint32_t low = (uint32_t)x;

    if (width == 64) {
        memcpy(&result, &x, sizeof result);
        return result;
    }
    memcpy(&single, &low, sizeof single);
    return single;
}

/* The NaN of an operation. */
static uint64_t result(int width, double x)
{
    float single = (float)x;
    uint32_t low;
    uint64_t bits;

    if (isnan(x))
        return the_nan(width);
    if (width == 64) {
        memcpy(&bits, &x, sizeof bits);
        return bits;
    }
    memcpy(&low, &single, sizeof low);
    return low;
}

static struct machine_type float_of(int width)
{
    return width == 32 ? MACHINE_F32 : MACHINE_F64;
}

static struct machine_value *constant(struct machine_type type, double x)
{
    return machine_constant_float(machine, type, x);
}

/* 1 where the column is a multiple of columns. */
static struct machine_value *every(uint64_t columns)
{
    return machine_binary(
        machine, MACHINE_EQ,
        machine_binary(
            machine, MACHINE_UREM, machine_coordinate(machine, 1, 16),
            machine_constant(machine, MACHINE_UINT(16), (struct machine_scalar){columns, 0})),
        machine_constant(machine, MACHINE_UINT(16), (struct machine_scalar){0, 0}));
}

static uint32_t upload(struct machine_type type)
{
    char array[COUNT * 8];
    const uint32_t field = machine_field_allocate(machine, machine_vpset_current(machine),
                                                  (uint32_t)type.width, MACHINE_HEAP);

    for (uint64_t n = 0; n < COUNT; n++)
        support_element_set(array, type, n, bits_at(type.width, n));
    assert_ok(machine_field_upload(machine, field, type, array), machine);
    return field;
}

static uint32_t store(struct machine_value *v)
{
    const uint32_t field =
        machine_field_allocate(machine, machine_vpset_current(machine),
                               (uint32_t)machine_value_type(v).width, MACHINE_HEAP);

    assert_ok(machine_field_store(machine, field, v, MACHINE_EVERYWHERE), machine);
    return field;
}

typedef uint64_t (*expected)(int width, uint64_t n);

static void expect(uint32_t field, struct machine_type type, expected wanted, const char *what)
{
    char array[COUNT * 8];

    assert_ok(machine_field_download(machine, field, type, array), machine);
    for (uint64_t n = 0; n < COUNT; n++) {
        const uint64_t is = (uint64_t)support_element(array, type, n),
                       w = wanted(type.width, n);
        if (is != w)
            fail_msg("%s of %d bits, element %d: %llx, expected %llx", what, type.width, (int)n,
                     (unsigned long long)is, (unsigned long long)w);
    }
}

/* The right neighbour's bits; the operations' NaN where the column is a multiple of three. */
static uint64_t moved(int width, uint64_t n)
{
    const uint64_t row = n / COLUMNS, column = n % COLUMNS;
    return column % 3 ? bits_at(width, row * COLUMNS + (column + 1) % COLUMNS) : the_nan(width);
}

static uint64_t plus(int width, uint64_t n)
{
    return result(width, number(width, moved(width, n)) + 1);
}

static uint64_t negative(int width, uint64_t n)
{
    return result(width, -number(width, moved(width, n)));
}

static uint64_t negative_twice(int width, uint64_t n)
{
    return result(width, -number(width, negative(width, n)) * 2);
}

static uint64_t minus_negative(int width, uint64_t n)
{
    return result(width, 0 - number(width, negative(width, n)));
}

static uint64_t least(int width, uint64_t n)
{
    const double a = number(width, bits_at(width, n)), b = number(width, moved(width, n));
    return result(width, a < b ? a : b);
}

static uint64_t other_width(int width, uint64_t n)
{
    return result(width, number(96 - width, moved(96 - width, n)));
}

static void check(int width)
{
    const struct machine_type type = float_of(width), other = float_of(96 - width);
    const uint32_t raw = upload(type);
    struct machine_value *mask, *a;

    machine_begin(machine);
    mask = every(3);
    a = support_value(machine, raw, type);
    const uint32_t b = store(
        machine_select(machine, mask, constant(type, NAN), machine_shift(machine, a, 1, 1)));
    expect(b, type, moved, "what was moved"); /* evaluates */
    machine_begin(machine);
    a = support_value(machine, raw, type);
    struct machine_value *v = support_value(machine, b, type);
    const uint32_t sum = store(machine_binary(machine, MACHINE_FADD, v, constant(type, 1)));
    struct machine_value *minus = machine_unary(machine, MACHINE_FNEG, v);
    const uint32_t turned = store(minus);
    const uint32_t twice = store(machine_binary(
        machine, MACHINE_FMUL, machine_unary(machine, MACHINE_FNEG, minus), constant(type, 2)));
    const uint32_t low = store(machine_binary(machine, MACHINE_FMIN, a, v));
    const uint32_t resized = store(machine_to_float(machine, v, other, false));
    expect(sum, type, plus, "a sum");
    expect(turned, type, negative, "what was negated");
    expect(twice, type, negative_twice, "what was negated twice, and doubled");
    expect(low, type, least, "a minimum");
    expect(resized, other, other_width, "what was resized");
    /* operations on values that are in memory now, and on values that were bits */
    machine_begin(machine);
    const uint32_t again = store(machine_binary(machine, MACHINE_FSUB, constant(type, 0),
                                                support_value(machine, turned, type)));
    const uint32_t bits = store(
        machine_reinterpret(machine, support_value(machine, b, type), MACHINE_UINT(width)));
    expect(again, type, minus_negative, "a difference with what was negated");
    expect(bits, MACHINE_UINT(width), moved, "the bits");
    machine_begin(machine);
    const uint32_t as_floats = store(machine_binary(
        machine, MACHINE_FADD,
        machine_reinterpret(machine, support_value(machine, bits, MACHINE_UINT(width)), type),
        constant(type, 1)));
    expect(as_floats, type, plus, "a sum with what was bits");
}

/* Writes a NaN with other bits into a field of a loop whose calls are foreseen. */
static void check_written(int width)
{
    const struct machine_type type = float_of(width);
    const uint32_t field = machine_field_allocate(machine, machine_vpset_current(machine),
                                                  (uint32_t)width, MACHINE_HEAP);
    const uint64_t strange = bits_at(width, 1); /* 7 * 1 % 10 */
    struct machine_scalar is;

    assert_true(is_nan(width, strange) && strange != the_nan(width));
    assert_ok(machine_field_store(machine, field, constant(type, 3), MACHINE_EVERYWHERE),
              machine);
    for (int turn = 0; turn < TURNS; turn++) {
        machine_begin(machine);
        if (turn == TURNS / 2)
            assert_ok(machine_field_write(machine, field, type, WRITTEN,
                                          (struct machine_scalar){strange, 0}),
                      machine);
        struct machine_value *v = support_value(machine, field, type);
        assert_ok(machine_field_store(machine, field,
                                      machine_binary(machine, MACHINE_FADD,
                                                     machine_binary(machine, MACHINE_FMUL, v,
                                                                    constant(type, 0.5)),
                                                     constant(type, 1)),
                                      MACHINE_EVERYWHERE),
                  machine);
        assert_ok(machine_flush(machine), machine);
        if (turn < TURNS / 2)
            continue;
        assert_ok(machine_field_read(machine, field, type, WRITTEN, &is), machine);
        assert_int_equal(is.lo, the_nan(width));
    }
}

static uint64_t without_sign(int width, uint64_t x)
{
    return result(width, fabs(number(width, x)));
}

/* The absolute value where the column is a multiple of three, else the sample's own bits. */
static uint64_t kept(int width, uint64_t n)
{
    const uint64_t x = bits_at(width, n);
    return n % COLUMNS % 3 ? x : without_sign(width, x);
}

/* A chain of so many square roots and divisions that no neighbour computes it again. */
static uint64_t root_of(int width, uint64_t n, int roots)
{
    uint64_t x = kept(width, n);
    for (int i = 0; i < roots; i++)
        x = result(width, sqrt(number(width, result(width, number(width, x) / 3))));
    return x;
}

static uint64_t root(int width, uint64_t n)
{
    return root_of(width, n, ROOTS);
}

/* In even columns the root of the row below. */
static uint64_t kept_or_moved(int width, uint64_t n)
{
    return n % COLUMNS % 2 ? kept(width, n)
                           : without_sign(width, root(width, (n + COLUMNS) % COUNT));
}

static uint64_t half_or_moved(int width, uint64_t n)
{
    return n % COLUMNS % 5 ? root_of(width, n, ROOTS / 2)
                           : without_sign(width, root(width, (n + COLUMNS) % COUNT));
}

/* In strips one stage uses a value with NaNs of any bits and keeps it, for the next stage, with
 * the operations' NaN. */
static void check_kept(void)
{
    const struct machine_type type = MACHINE_F32;
    const uint32_t raw = upload(type);

    machine_begin(machine);
    struct machine_value *a = support_value(machine, raw, type);
    struct machine_value *k =
        machine_select(machine, every(3), machine_unary(machine, MACHINE_FABS, a), a);
    struct machine_value *r = k, *half = k;
    for (int i = 0; i < ROOTS; i++) {
        r = machine_unary(machine, MACHINE_FSQRT,
                          machine_binary(machine, MACHINE_FDIV, r, constant(type, 3)));
        half = i == ROOTS / 2 - 1 ? r : half;
    }
    struct machine_value *below =
        machine_unary(machine, MACHINE_FABS, machine_shift(machine, r, 0, 1));
    const uint32_t moving = store(machine_select(machine, every(2), below, k)),
                   more = store(machine_select(machine, every(5), below, half)),
                   roots = store(r);
    expect(moving, type, kept_or_moved, "what a stage has kept");
    expect(more, type, half_or_moved, "what a stage has computed");
    expect(roots, type, root, "a root");
}

static void run(const char *keeps)
{
    setenv("LUTETIA_KEEPS_NAN", keeps, 1);
    for (int eager = 0; eager < 2; eager++) {
        machine = support_machine(eager);
        support_set(machine, 2, ROWS, COLUMNS);
        for (int width = 32; width <= 64; width += 32) {
            check(width);
            check_written(width);
        }
        support_machine_destroy(machine);
    }
    unsetenv("LUTETIA_KEEPS_NAN");
}

static void nans_that_devices_keep(void **state)
{
    (void)state;
    run("1");
}

static void nans_that_they_do_not(void **state)
{
    (void)state;
    run("0");
}

static void nans_that_stages_keep(void **state)
{
    struct machine_stats stats;

    (void)state;
    setenv("LUTETIA_STRIPS", "1", 1);
    setenv("LUTETIA_INTERPRET", "0", 1); /* of kernels */
    machine = support_machine(false);
    support_set(machine, 2, ROWS, COLUMNS);
    check_kept();
    machine_stats_get(machine, &stats);
    assert_true(stats.kernels_in_strips > 0);
    support_machine_destroy(machine);
    unsetenv("LUTETIA_STRIPS");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nans_that_devices_keep),
                                       cmocka_unit_test(nans_that_they_do_not),
                                       cmocka_unit_test(nans_that_stages_keep)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
