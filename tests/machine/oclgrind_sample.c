/* oclgrind_sample.c - runs a few instructions of each kind on small grids, under a checker of
 * memory accesses, and compares their values. Run by oclgrind.sh. */
#include "support.h"

#include <stdlib.h>

struct sample {
    struct machine_type type;
    int last_axis;
};

static wide expected_sum(const void *data, uint64_t n)
{
    const struct sample *s = data;
    uint64_t last = (uint64_t)s->last_axis, column = n % last;
    wide left = support_word(s->type, 1, n - column + (column + last - 1) % last);
    wide sum = (support_word(s->type, 1, n) + left) & wide_mask(s->type.width);

    return column < 5 ? sum : support_word(s->type, 1, n);
}

/* A shift, an addition, a context, an odd width: at each edge of a row and of the array. */
static void sum_with_neighbour(struct machine *m, int rows, int columns, int width)
{
    struct sample s = {MACHINE_UINT(width), columns};
    int set = support_set(m, 2, rows, columns);
    uint32_t f = support_field(m, s.type, 1);
    struct machine_value *x, *inside;
    struct machine_scalar total;

    machine_begin(m);
    inside =
        machine_binary(m, MACHINE_ULT, machine_coordinate(m, 1, 16),
                       machine_constant(m, MACHINE_UINT(16), (struct machine_scalar){5, 0}));
    assert_ok(machine_flag_store(m, MACHINE_CONTEXT, inside, MACHINE_EVERYWHERE), m);
    machine_begin(m);
    x = support_value(m, f, s.type);
    assert_ok(machine_field_store(m, f,
                                  machine_binary(m, MACHINE_ADD, x, machine_shift(m, x, 1, -1)),
                                  MACHINE_WHERE_ACTIVE),
              m);
    support_expect_field(m, f, s.type, expected_sum, &s, "sum with the neighbour");
    machine_begin(m);
    assert_ok(machine_reduce(m, MACHINE_REDUCE_XOR, support_value(m, f, s.type), &total), m);
    assert_ok(machine_vpset_destroy(m, set), m);
}

static wide expected_part(const void *data, uint64_t n)
{
    (void)data;
    return support_word(MACHINE_UINT(100), 7, n) >> 13 & wide_mask(50);
}

/* "0": generated kernels; "3": the device's interpreter. */
static struct machine *machine_that(const char *interprets)
{
    setenv("LUTETIA_INTERPRET", interprets, 1);
    struct machine *m = support_machine(0);
    unsetenv("LUTETIA_INTERPRET");
    return m;
}

static void assert_done(struct machine *m, const char *interprets)
{
    struct machine_stats now;
    machine_stats_get(m, &now);
    assert_true(*interprets == '3' ? now.interpreted > 0 : now.interpreted == 0);
}

static wide expected_got(const void *data, uint64_t n)
{
    const struct sample *s = data;
    uint64_t from = (n + 5) & (s->last_axis > 64 ? 127 : 63); /* an address has no more bits */
    return from < (uint64_t)s->last_axis ? support_word(s->type, 7, from) : 0;
}

/* Gets of whole vectors, up to the last processor and beyond: 5 further on in a set that is
 * `longer` by so many. */
static void gets_along_a_row(struct machine *m, int longer)
{
    enum { LENGTH = 70 };
    int length = LENGTH, source = LENGTH + longer;
    struct sample s = {MACHINE_UINT(64), source};
    int from = machine_vpset_create_ordered(m, &source, 1, MACHINE_SEND_ORDER);
    assert_ok(machine_vpset_select(m, from), m);
    uint32_t f = support_field(m, s.type, 7);
    int set = machine_vpset_create_ordered(m, &length, 1, MACHINE_SEND_ORDER);
    assert_ok(machine_vpset_select(m, set), m);
    uint32_t d = machine_field_allocate(m, set, 64, MACHINE_HEAP);
    machine_begin(m);
    struct machine_value *further =
        machine_binary(m, MACHINE_ADD, machine_coordinate(m, 0, 16),
                       machine_constant(m, MACHINE_UINT(16), (struct machine_scalar){5, 0}));
    assert_ok(machine_field_store(m, d, machine_get(m, further, f, s.type), MACHINE_EVERYWHERE),
              m);
    support_expect_field(m, d, s.type, expected_got, &s, "got along a row");
    machine_begin(m);
    assert_ok(machine_vpset_destroy(m, set), m);
    assert_ok(machine_vpset_destroy(m, from), m);
}

static void vectors_get_clean(void **state)
{
    (void)state;
    setenv("LUTETIA_VECTOR", "16", 1);
    setenv("LUTETIA_NEAR", "0", 1);
    struct machine *m = machine_that("0");
    unsetenv("LUTETIA_VECTOR");
    unsetenv("LUTETIA_NEAR");
    for (int longer = -8; longer < 8; longer++)
        gets_along_a_row(m, longer);
    machine_destroy(m);
}

static void sample_runs(const char *interprets)
{
    struct machine *m = machine_that(interprets);
    uint32_t f;

    sum_with_neighbour(m, 3, 41, 32);
    sum_with_neighbour(m, 1, 1, 8);
    sum_with_neighbour(m, 2, 16, 64);
    sum_with_neighbour(m, 5, 33, 1);
    sum_with_neighbour(m, 2, 7, 100);
    support_set(m, 3, 2, 3, 19);
    f = support_field(m, MACHINE_UINT(100), 7);
    support_expect_field(m, f + 13, MACHINE_UINT(50), expected_part, NULL, "a part of a field");
    assert_done(m, interprets);
    machine_destroy(m);
}

static void kernels_run_clean(void **state)
{
    (void)state;
    sample_runs("0");
}

static void the_interpreter_runs_clean(void **state)
{
    (void)state;
    sample_runs("3");
}

/* Chains of all kinds of operations. */
enum { CHAINED = 37 };
static void chain(const char *interprets, double *doubles, uint64_t *words)
{
    const struct machine_type whole = MACHINE_UINT(64), half = MACHINE_UINT(23);
    struct machine *m = machine_that(interprets);
    support_set(m, 1, CHAINED);
    uint32_t f = support_field(m, MACHINE_F64, 3), g = support_field(m, half, 4),
             h = support_field(m, whole, 5);
    machine_begin(m);
    struct machine_value *x = support_value(m, f, MACHINE_F64), *a = support_value(m, g, half),
                         *b = machine_random(m, 23, 1000);
    struct machine_value *y = machine_binary(m, MACHINE_FMUL, machine_unary(m, MACHINE_FEXP, x),
                                             machine_to_float(m, a, MACHINE_F64, false));
    y = machine_select(m, machine_binary(m, MACHINE_FLT, x, y), y,
                       machine_unary(m, MACHINE_FSQRT, machine_unary(m, MACHINE_FABS, x)));
    struct machine_value *z = machine_binary(
        m, MACHINE_UDIV, machine_binary(m, MACHINE_MUL, a, b),
        machine_binary(m, MACHINE_OR, b,
                       machine_constant(m, half, (struct machine_scalar){1, 0})));
    z = machine_shift(m, machine_unary(m, MACHINE_REVERSE, z), 0, 5);
    assert_ok(machine_field_store(m, f, y, MACHINE_EVERYWHERE), m);
    assert_ok(machine_field_store(m, h, machine_resize(m, z, 64, true), MACHINE_EVERYWHERE), m);
    machine_begin(m);
    assert_ok(machine_field_download(m, f, MACHINE_F64, doubles), m);
    assert_ok(machine_field_download(m, h, whole, words), m);
    assert_done(m, interprets);
    machine_destroy(m);
}

static void both_give_the_same(void **state)
{
    static double doubles[2][CHAINED];
    static uint64_t words[2][CHAINED];
    (void)state;
    chain("0", doubles[0], words[0]);
    chain("3", doubles[1], words[1]);
    assert_memory_equal(doubles[0], doubles[1], sizeof doubles[0]);
    assert_memory_equal(words[0], words[1], sizeof words[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_run_clean), cmocka_unit_test(vectors_get_clean),
        cmocka_unit_test(the_interpreter_runs_clean), cmocka_unit_test(both_give_the_same)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
