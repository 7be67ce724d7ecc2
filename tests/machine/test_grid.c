/* test_grid.c - shifts, coordinates, addresses, random numbers and reductions, over grids of
 * odd shapes. */
#include "oracle_random.h"
#include "support.h"

struct grid {
    int rank, lengths[4];
};
static const struct grid grids[] = {{1, {1}},           {1, {97}},    {2, {5, 3}},
                                    {2, {3, 43}},       {2, {1, 2}},  {3, {4, 2, 17}},
                                    {4, {3, 1, 2, 41}}, {2, {9, 64}}, {2, {2, 5000}}};
enum { GRIDS = sizeof grids / sizeof grids[0] };

static struct machine *machine;

static int group_setup(void **state)
{
    (void)state;
    machine = support_machine(0);
    return 0;
}

static int group_teardown(void **state)
{
    (void)state;
    machine_destroy(machine);
    return 0;
}

static int select_grid(const struct grid *g)
{
    int set = machine_vpset_create(machine, g->lengths, g->rank);

    assert_true(set > 0);
    assert_ok(machine_vpset_select(machine, set), machine);
    return set;
}

struct shift_case {
    const struct grid *g;
    struct machine_type type;
    int axis, distance;
};

static uint64_t stride_of(const struct grid *g, int axis)
{
    uint64_t stride = 1;

    for (int k = axis + 1; k < g->rank; k++)
        stride *= (uint64_t)g->lengths[k];
    return stride;
}

static wide expected_shift(const void *data, uint64_t n)
{
    const struct shift_case *c = data;
    uint64_t stride = stride_of(c->g, c->axis), length = (uint64_t)c->g->lengths[c->axis];
    uint64_t coordinate = n / stride % length;
    int64_t moved = ((int64_t)coordinate + c->distance) % (int64_t)length;

    if (moved < 0)
        moved += (int64_t)length;
    return support_word(c->type, 1, n - coordinate * stride + (uint64_t)moved * stride);
}

static void shift_takes_the_neighbour_and_wraps(void **state)
{
    static const int distances[] = {1, -1, 2, -3, 17, 100, -1000};
    static const int widths[] = {1, 8, 32, 64, 100};

    (void)state;
    for (int k = 0; k < GRIDS - 1; k++) {
        int set = select_grid(&grids[k]);
        struct machine_type type = MACHINE_UINT(widths[k % 5]);
        uint32_t f = support_field(machine, type, 1);

        for (int axis = 0; axis < grids[k].rank; axis++)
            for (size_t d = 0; d < sizeof distances / sizeof distances[0]; d++) {
                struct shift_case c = {&grids[k], type, axis, distances[d]};
                char what[64];

                snprintf(what, sizeof what, "grid %d, shift by %d on axis %d", k, c.distance,
                         axis);
                machine_begin(machine);
                support_later(
                    machine,
                    machine_shift(machine, support_value(machine, f, type), axis, c.distance),
                    expected_shift, &c, sizeof c, what);
            }
        support_check(machine);
        assert_ok(machine_vpset_destroy(machine, set), machine);
    }
}

/* Shifts of a computed value, of a shift, and of a shift under a context: their sum. */
static wide expected_laplacian(const void *data, uint64_t n)
{
    const struct grid *g = data;
    wide sum = 0;

    for (int axis = 0; axis < 2; axis++)
        for (int distance = -1; distance <= 1; distance += 2) {
            struct shift_case c = {g, MACHINE_UINT(32), axis, distance};

            sum += expected_shift(&c, n) * 3;
        }
    return sum & wide_mask(32);
}

static void shift_of_what_is_computed_agrees(void **state)
{
    (void)state;
    for (int k = 2; k <= 4; k++) {
        int set = select_grid(&grids[k]);
        uint32_t f = support_field(machine, MACHINE_UINT(32), 1);
        struct machine_value *x, *sum;

        machine_begin(machine);
        x = support_value(machine, f, MACHINE_UINT(32));
        x = machine_binary(
            machine, MACHINE_MUL, x,
            machine_constant(machine, MACHINE_UINT(32), (struct machine_scalar){3, 0}));
        sum =
            machine_binary(machine, MACHINE_ADD,
                           machine_binary(machine, MACHINE_ADD, machine_shift(machine, x, 0, 1),
                                          machine_shift(machine, x, 0, -1)),
                           machine_binary(machine, MACHINE_ADD, machine_shift(machine, x, 1, 1),
                                          machine_shift(machine, x, 1, -1)));
        support_expect(machine, sum, expected_laplacian, &grids[k], "sum of four neighbours");
        assert_ok(machine_vpset_destroy(machine, set), machine);
    }
}

/* ---- coordinates and addresses ---- */

static wide expected_coordinate(const void *data, uint64_t n)
{
    const struct shift_case *c = data;

    return n / stride_of(c->g, c->axis) % (uint64_t)c->g->lengths[c->axis] &
           wide_mask(c->type.width);
}

static wide expected_index(const void *data, uint64_t n)
{
    return n & wide_mask(*(const int *)data);
}

static wide expected_address(const void *data, uint64_t n)
{
    return machine_send_address(machine, *(const int *)data, n);
}

static void coordinates_index_and_address_agree(void **state)
{
    (void)state;
    for (int k = 0; k < GRIDS; k++) {
        int set = select_grid(&grids[k]), width = 5;

        for (int axis = 0; axis < grids[k].rank; axis++) {
            struct shift_case c = {&grids[k], MACHINE_UINT(axis % 2 ? 3 : 32), axis, 0};

            machine_begin(machine);
            support_later(machine, machine_coordinate(machine, axis, c.type.width),
                          expected_coordinate, &c, sizeof c, "coordinate");
        }
        machine_begin(machine);
        support_later(machine, machine_self_index(machine, width), expected_index, &width,
                      sizeof width, "index");
        machine_begin(machine);
        support_later(machine, machine_self_address(machine, 32), expected_address, &set,
                      sizeof set, "send address");
        support_check(machine);
        assert_ok(machine_vpset_destroy(machine, set), machine);
    }
}

/* ---- random ---- */

struct draw_case {
    uint64_t draw, limit;
    int width;
};

static wide expected_draw(const void *data, uint64_t n)
{
    const struct draw_case *c = data;

    return oracle_random(42, c->draw, n, c->width, c->limit);
}

static void random_is_a_function_of_seed_draw_and_index(void **state)
{
    static const struct draw_case cases[] = {{0, 0, 32}, {1, 10, 32},
                                             {2, 0, 1},  {3, 1000000007, 40},
                                             {4, 0, 64}, {5, (uint64_t)1 << 40, 64},
                                             {6, 3, 2}};
    int set = select_grid(&grids[3]);

    (void)state;
    machine_random_seed(machine, 42);
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        machine_begin(machine);
        support_later(machine, machine_random(machine, cases[k].width, cases[k].limit),
                      expected_draw, &cases[k], sizeof cases[k], "random");
    }
    support_check(machine);
    assert_ok(machine_vpset_destroy(machine, set), machine);
}

/* ---- reductions ---- */

static bool active_at(uint64_t n)
{
    return n % 7 != 2 && n % 11 != 3;
}

static void set_context(bool none)
{
    uint64_t count = machine_vpset_count(machine, machine_vpset_current(machine));
    uint8_t *on = calloc(count, 1);
    uint32_t f =
        machine_field_allocate(machine, machine_vpset_current(machine), 1, MACHINE_HEAP);

    assert_non_null(on);
    for (uint64_t n = 0; n < count; n++)
        on[n] = !none && active_at(n);
    assert_ok(machine_field_upload(machine, f, MACHINE_BIT, on), machine);
    machine_begin(machine);
    assert_ok(machine_flag_store(machine, MACHINE_CONTEXT,
                                 support_value(machine, f, MACHINE_BIT), MACHINE_EVERYWHERE),
              machine);
    free(on);
}

static wide reduced(enum machine_reduction op, int width, uint64_t count, bool none)
{
    struct machine_type type = MACHINE_UINT(width);
    wide top = (wide)1 << (width - 1), total;

    total = op == MACHINE_REDUCE_AND || op == MACHINE_REDUCE_UMIN ? wide_mask(width)
            : op == MACHINE_REDUCE_SMIN                           ? top - 1
            : op == MACHINE_REDUCE_SMAX                           ? top
                                                                  : 0;
    for (uint64_t n = 0; n < count && !none; n++) {
        wide x = support_word(type, 1, n);

        if (!active_at(n))
            continue;
        switch ((int)op) {
        case MACHINE_REDUCE_AND:
            total &= x;
            break;
        case MACHINE_REDUCE_OR:
            total |= x;
            break;
        case MACHINE_REDUCE_XOR:
            total ^= x;
            break;
        case MACHINE_REDUCE_ADD:
            total = (total + x) & wide_mask(width);
            break;
        case MACHINE_REDUCE_UMIN:
            total = x < total ? x : total;
            break;
        case MACHINE_REDUCE_UMAX:
            total = x > total ? x : total;
            break;
        case MACHINE_REDUCE_SMIN:
            total = wide_signed(x, width) < wide_signed(total, width) ? x : total;
            break;
        default:
            total = wide_signed(x, width) > wide_signed(total, width) ? x : total;
            break;
        }
    }
    return total;
}

static void reduce_of_bits_agrees(void **state)
{
    static const int widths[] = {1, 8, 13, 32, 33, 64, 65, 128};

    (void)state;
    for (int k = 0; k < GRIDS; k++) {
        int set = select_grid(&grids[k]), width = widths[k % 8];
        uint32_t f = support_field(machine, MACHINE_UINT(width), 1);

        for (int none = 0; none < 2; none++) {
            set_context(none);
            for (int op = MACHINE_REDUCE_AND; op <= MACHINE_REDUCE_SMAX; op++) {
                struct machine_scalar got;
                wide expected = reduced((enum machine_reduction)op, width,
                                        machine_vpset_count(machine, set), none);

                machine_begin(machine);
                assert_ok(machine_reduce(machine, (enum machine_reduction)op,
                                         support_value(machine, f, MACHINE_UINT(width)), &got),
                          machine);
                if (got.lo != (uint64_t)expected || got.hi != (uint64_t)(expected >> 64))
                    fail_msg(
                        "reduction %d of %d bits on grid %d: %llx:%llx, expected %llx:%llx", op,
                        width, k, (unsigned long long)got.hi, (unsigned long long)got.lo,
                        (unsigned long long)(expected >> 64), (unsigned long long)expected);
            }
        }
        assert_ok(machine_vpset_destroy(machine, set), machine);
    }
}

static void reduce_of_floats_keeps_its_order(void **state)
{
    static const struct {
        enum machine_reduction op;
        enum op oracle;
    } ops[] = {{MACHINE_REDUCE_FADD, OP_ADD},
               {MACHINE_REDUCE_FMIN, OP_MIN},
               {MACHINE_REDUCE_FMAX, OP_MAX}};

    (void)state;
    for (int k = 0; k < GRIDS; k++)
        for (int is_double = 0; is_double < 2; is_double++)
            for (int none = 0; none < 2; none++) {
                struct machine_type type = is_double ? MACHINE_F64 : MACHINE_F32;
                int set = select_grid(&grids[k]), last = grids[k].lengths[grids[k].rank - 1];
                uint64_t count = machine_vpset_count(machine, set), *values = calloc(count, 8);
                uint32_t f = support_field(machine, type, 5);
                bool *active = calloc(count, 1);

                assert_true(values && active);
                for (uint64_t n = 0; n < count; n++) {
                    values[n] = (uint64_t)support_word(type, 5, n);
                    active[n] = !none && active_at(n);
                }
                set_context(none);
                for (int o = 0; o < 3; o++) {
                    struct machine_scalar got;
                    uint64_t expected = number_float_reduce(ops[o].oracle, values, active,
                                                            count, last, type.width);

                    machine_begin(machine);
                    assert_ok(machine_reduce(machine, ops[o].op,
                                             support_value(machine, f, type), &got),
                              machine);
                    if (got.lo != expected)
                        fail_msg("float reduction %d, %d bits, grid %d: %llx, expected %llx", o,
                                 type.width, k, (unsigned long long)got.lo,
                                 (unsigned long long)expected);
                }
                free(values);
                free(active);
                assert_ok(machine_vpset_destroy(machine, set), machine);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shift_takes_the_neighbour_and_wraps),
        cmocka_unit_test(shift_of_what_is_computed_agrees),
        cmocka_unit_test(coordinates_index_and_address_agree),
        cmocka_unit_test(random_is_a_function_of_seed_draw_and_index),
        cmocka_unit_test(reduce_of_bits_agrees),
        cmocka_unit_test(reduce_of_floats_keeps_its_order),
    };

    return cmocka_run_group_tests(tests, group_setup, group_teardown);
}
