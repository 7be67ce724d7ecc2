/* oclgrind_sample.c - runs a few instructions of each kind on small grids, under a checker of memory accesses, and
 * compares their values. Run by oclgrind.sh. */
#include "support.h"

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

static void sample_runs_clean(void **state)
{
    struct machine *m = support_machine(0);
    uint32_t f;

    (void)state;
    sum_with_neighbour(m, 3, 41, 32);
    sum_with_neighbour(m, 1, 1, 8);
    sum_with_neighbour(m, 2, 16, 64);
    sum_with_neighbour(m, 5, 33, 1);
    sum_with_neighbour(m, 2, 7, 100);
    support_set(m, 3, 2, 3, 19);
    f = support_field(m, MACHINE_UINT(100), 7);
    support_expect_field(m, f + 13, MACHINE_UINT(50), expected_part, NULL, "a part of a field");
    machine_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sample_runs_clean)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
