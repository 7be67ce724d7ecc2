/* test_explain.c - machine_explain() on programs whose kernels, bytes and values that are never
 * stored are known by hand. */
#include "../skip.h"
#include "machine_explained.h"
#include "machine_rows.h"
#include "support.h"

enum { ROWS = 24, COLUMNS = 160, COUNT = ROWS * COLUMNS };

static struct machine *machine;
static int set;

static int begin(const char *strips)
{
    struct machine_config config = machine_config_default();

    setenv("LUTETIA_STRIPS", strips, 1);
    config.eager = 0;
    config.explain = 1;
    assert_ok(machine_create(&config, &machine), machine);
    set = support_set(machine, 2, ROWS, COLUMNS);
    return 0;
}

static int setup(void **state)
{
    (void)state;
    return begin("0");
}

static int setup_strips(void **state)
{
    (void)state;
    return begin("1");
}

static int setup_tiles(void **state)
{
    (void)state;
    setenv("LUTETIA_VECTOR", "1", 1);
    int status = begin("1");
    unsetenv("LUTETIA_VECTOR");
    return status;
}

static int teardown(void **state)
{
    (void)state;
    machine_destroy(machine);
    return 0;
}

static const struct machine_explained *explained(void)
{
    const struct machine_explained *x = machine_explain(machine, false);

    assert_non_null(x);
    return x;
}

/* Makes a field of floats first .. first + 1, none of them a NaN. */
static uint32_t field_of(float first)
{
    uint32_t field = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    float *all = malloc(COUNT * sizeof *all);

    assert_non_null(all);
    for (int i = 0; i < COUNT; i++)
        all[i] = first + (float)i / COUNT;
    assert_ok(machine_field_upload(machine, field, MACHINE_F32, all), machine);
    free(all);
    return field;
}

static struct machine_value *value(uint32_t field)
{
    return support_value(machine, field, MACHINE_F32);
}

static void store(uint32_t field, struct machine_value *v)
{
    assert_ok(machine_field_store(machine, field, v, MACHINE_EVERYWHERE), machine);
    machine_begin(machine);
}

static uint64_t count_of(const struct machine_explained_row *rows, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (strcmp(rows[i].name, name) == 0)
            return rows[i].count;
    return 0;
}

static const struct machine_explained_row *row_of(const struct machine_explained_row *rows,
                                                  int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
    fail_msg("there is no row \"%s\"", name);
    return NULL;
}

/* Two results and a number, which has no array. */
static void fields_looked_at_together_are_computed_by_one_kernel(void **state)
{
    const uint32_t a = field_of(1), b = field_of(2);
    uint32_t looked[3];
    struct machine_rows rows[3];
    float out[2][COUNT];

    (void)state;
    for (int i = 0; i < 3; i++)
        looked[i] = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    store(looked[0], machine_binary(machine, MACHINE_FADD, value(a), value(b)));
    store(looked[1], machine_constant(machine, MACHINE_F32, (struct machine_scalar){0, 0}));
    store(looked[2], machine_binary(machine, MACHINE_FMUL, value(a), value(b)));
    assert_ok(machine_fields_look(machine, looked, 3, MACHINE_F32, rows), machine);
    assert_int_equal(explained()->kernels_count, 1);
    assert_int_equal(explained()->kernels[0].runs, 1);
    assert_null(rows[1].at);
    for (int i = 0; i < 2; i++) {
        assert_ok(machine_field_download(machine, looked[2 * i], MACHINE_F32, out[i]), machine);
        assert_ok(machine_fields_look(machine, looked, 3, MACHINE_F32, rows), machine);
        for (int row = 0; rows[2 * i].at && row < ROWS; row++)
            assert_memory_equal(rows[2 * i].at + (size_t)row * rows[2 * i].pitch,
                                out[i] + (size_t)row * COLUMNS, COLUMNS * sizeof **out);
    }
}

static void kernel_has_the_bytes_and_operations_of_its_formula(void **state)
{
    uint32_t a = field_of(1), b = field_of(2), c;
    float out[COUNT];
    char where[40];

    (void)state;
    c = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    store(c,
          machine_binary(machine, MACHINE_FADD,
                         machine_binary(machine, MACHINE_FMUL, value(a), value(b)), value(a)));
    assert_ok(machine_finish(machine), machine);
    assert_ok(machine_field_download(machine, c, MACHINE_F32, out), machine);

    const struct machine_explained *x = explained();
    assert_int_equal(x->kernels_count, 1);
    const struct machine_explained_kernel *k = &x->kernels[0];
    assert_true(k->generated);
    assert_false(k->split);
    assert_int_equal(k->vpset, set);
    assert_int_equal(k->processors, COUNT);
    assert_int_equal(k->runs, 1);
    assert_int_equal(k->operations, 2);
    assert_int_equal(k->operations_cost, 2);
    assert_int_equal(k->arrays_read, 2);
    assert_int_equal(k->arrays_written, 1);
    assert_int_equal(k->bytes_read, 8);
    assert_int_equal(k->bytes_written, 4);
    assert_int_equal(k->bytes, 12 * COUNT);
    assert_int_equal(k->shifts_computed, 0);
    assert_int_equal(k->stores_count, 1);
    assert_int_equal(k->stores[0].why, MACHINE_CUT_LIVE);
    assert_string_equal(k->stores[0].operation, "FADD");
    snprintf(where, sizeof where, "field %u", c);
    assert_string_equal(k->stores[0].where, where);
    if (k->runs_timed)
        assert_true(k->time_s > 0);

    assert_int_equal(x->values_computed, 2);
    assert_int_equal(x->values_stored, 1);
    assert_int_equal(x->values_vanished, 0);
    assert_int_equal(x->plans_built, 1);
    assert_int_equal(count_of(x->evaluations, x->evaluations_count, "asked to, by a flush"), 1);
    assert_int_equal(count_of(x->evaluations, x->evaluations_count, "somebody looked"), 0);
    const struct machine_explained_row *r =
        row_of(x->transfers, x->transfers_count, "reading a field");
    assert_int_equal(r->count, 1);
    assert_int_equal(r->bytes, 4 * COUNT);
    assert_int_equal(row_of(x->transfers, x->transfers_count, "writing a field")->count, 2);
}

static void overwritten_value_has_vanished(void **state)
{
    uint32_t a = field_of(1), b = field_of(2), c = field_of(3);
    float out[COUNT];

    (void)state;
    store(c, machine_binary(machine, MACHINE_FMUL, value(a), value(b)));
    store(c, machine_unary(machine, MACHINE_FSQRT, value(a)));
    store(c, machine_binary(machine, MACHINE_FSUB, value(a), value(b)));
    assert_ok(machine_field_download(machine, c, MACHINE_F32, out), machine);
    const struct machine_explained *x = explained();
    assert_int_equal(x->values_vanished, 2);
    assert_int_equal(x->vanished_count, 2);
    assert_int_equal(count_of(x->vanished, x->vanished_count, "FMUL"), 1);
    assert_int_equal(count_of(x->vanished, x->vanished_count, "FSQRT"), 1);
    assert_int_equal(count_of(x->reasons, x->reasons_count,
                              "field or flag overwritten before it was in memory"),
                     2);
    assert_int_equal(x->values_computed, 1);
    assert_int_equal(x->kernels_count, 1);
    assert_int_equal(x->kernels[0].stores[0].why, MACHINE_CUT_LOOKED_AT);
    assert_int_equal(count_of(x->evaluations, x->evaluations_count, "somebody looked"), 1);
}

/* Three transcendental functions cost more to compute again for each neighbour than to store
 * once. */
static void dear_value_is_stored_for_its_neighbours(void **state)
{
    uint32_t a = field_of(1), c = field_of(3);
    struct machine_value *v;
    const struct machine_explained *x;
    float out[COUNT];

    (void)state;
    v = machine_unary(machine, MACHINE_FLN, value(a));
    v = machine_unary(machine, MACHINE_FEXP, v);
    v = machine_unary(machine, MACHINE_FLN, v);
    store(c, machine_binary(machine, MACHINE_FADD, machine_shift(machine, v, 0, 1),
                            machine_shift(machine, v, 0, -1)));
    assert_ok(machine_field_download(machine, c, MACHINE_F32, out), machine);
    x = explained();
    assert_int_equal(x->kernels_count, 2);
    const struct machine_explained_kernel *first = &x->kernels[0], *then = &x->kernels[1];
    if (first->operations == 1) { /* kernels are sorted by time */
        first = &x->kernels[1];
        then = &x->kernels[0];
    }
    assert_int_equal(first->operations, 3);
    assert_int_equal(first->stores[0].why, MACHINE_CUT_NEIGHBOURS);
    assert_string_equal(first->stores[0].operation, "FLN");
    assert_string_equal(first->stores[0].where, "");
    assert_string_equal(first->name, "FLN for neighbours");
    assert_int_equal(then->operations, 1);
    assert_int_equal(then->arrays_read, 1);
    assert_int_equal(then->shifts_computed, 0);
    assert_int_equal(first->plan.chosen, MACHINE_PLAN_ROWS);
    double plan_s = first->plan.cost_s[MACHINE_PLAN_ROWS];
    assert_true(first->predicted_s > 0 && then->predicted_s > 0);
    assert_true(first->predicted_s + then->predicted_s < plan_s * 1.001 &&
                first->predicted_s + then->predicted_s > plan_s * 0.999);
    assert_true(first->plan.cost_s[MACHINE_PLAN_STORED] >= plan_s);
    assert_true(first->plan.cost_s[MACHINE_PLAN_STRIPS] == 0); /* strips are turned off here */

    store(c, machine_binary(
                 machine, MACHINE_FADD,
                 machine_shift(machine,
                               machine_binary(machine, MACHINE_FSUB, value(a), value(c)), 0, 1),
                 value(a)));
    assert_ok(machine_field_download(machine, c, MACHINE_F32, out), machine);
    x = explained();
    assert_int_equal(x->kernels_count, 3);
    int found = 0;
    for (int i = 0; i < 3; i++)
        if (strcmp(x->kernels[i].stores[0].operation, "FADD") == 0 &&
            x->kernels[i].arrays_read == 2) {
            assert_int_equal(x->kernels[i].shifts_computed, 1);
            assert_int_equal(x->kernels[i].bytes_read, 8);
            found++;
        }
    assert_int_equal(found, 1);
}

/* The one kernel that computes the sum of v's neighbours, where v is costly. */
static const struct machine_explained_kernel *neighbours_of(struct machine_value *v)
{
    uint32_t c = field_of(3);
    float out[COUNT];

    store(c, machine_binary(machine, MACHINE_FADD, machine_shift(machine, v, 0, 1),
                            machine_shift(machine, v, 0, -1)));
    assert_ok(machine_field_download(machine, c, MACHINE_F32, out), machine);
    const struct machine_explained *x = explained();
    assert_int_equal(x->kernels_count, 1);
    return &x->kernels[0];
}

/* The kernel keeps v, of 3 operations, in a ring and stores it in no array. */
static void assert_is_kept_near(const struct machine_explained_kernel *k)
{
    assert_int_equal(k->stages, 2);
    assert_int_equal(k->rings, 1);
    assert_int_equal(k->stores_count, 2);
    assert_int_equal(k->stores[0].in_ring + k->stores[1].in_ring, 1);
    assert_int_equal(k->operations, 4);
    assert_int_equal(k->bytes_read, 4);
    assert_int_equal(k->bytes_written, 4);
}

/* In strips a row of the costly value is used while it is still in the cache. */
static void strips_keep_rows_in_no_array(void **state)
{
    struct machine_value *v = value(field_of(1));

    (void)state;
    v = machine_unary(machine, MACHINE_FEXP, machine_unary(machine, MACHINE_FLN, v));
    v = machine_unary(machine, MACHINE_FLN, v);
    const struct machine_explained_kernel *k = neighbours_of(v);
    if (k->stages == 1)
        skip_because("this device has no vectors, so no strips");
    assert_is_kept_near(k);
    assert_int_equal(k->plan.chosen, MACHINE_PLAN_STRIPS);
    assert_true(k->predicted_s > 0 && k->plan.cost_s[MACHINE_PLAN_ROWS] > 0);
    assert_true(k->predicted_s < 1.001 * k->plan.cost_s[MACHINE_PLAN_STRIPS] &&
                k->predicted_s > 0.999 * k->plan.cost_s[MACHINE_PLAN_STRIPS]);
    assert_int_equal(k->plan.forced,
                     k->plan.cost_s[MACHINE_PLAN_STRIPS] >= k->plan.cost_s[MACHINE_PLAN_ROWS]);
    assert_int_equal(k->stores[k->stores[0].in_ring ? 0 : 1].why, MACHINE_CUT_NEIGHBOURS);
    assert_null(strstr(k->name, "FLN"));
    assert_non_null(strstr(k->name, "FADD"));
}

/* In tiles, whose kernels compile faster, the costly value is kept in local memory and stored
 * in no array. */
static void tiles_are_kept_in_no_array(void **state)
{
    struct machine_value *v = value(field_of(1));

    (void)state;
    for (int i = 0; i < 3; i++)
        v = machine_unary(machine, MACHINE_FSQRT, v);
    const struct machine_explained_kernel *k = neighbours_of(v);
    assert_is_kept_near(k);
    assert_true(k->tile_width > 0 && k->tile_height > 0);
    assert_int_equal(k->plan.chosen, MACHINE_PLAN_TILES);
    assert_true(k->predicted_s > 0);
}

/* ---- calls ---- */

static uint32_t water;

static void add_perform(float x)
{
    struct machine_value *more;

    machine_begin(machine);
    more = machine_constant_float(machine, MACHINE_F32, x);
    assert_ok(machine_field_store(machine, water,
                                  machine_binary(machine, MACHINE_FADD, value(water), more),
                                  MACHINE_WHERE_ACTIVE),
              machine);
}

static void add(float x);
static void add_again(const struct machine_call *call)
{
    add((float)call->words[0]);
}

static void add(float x)
{
    struct machine_call call = {
        .again = add_again, .name = "add", .words_count = 1, .words = {(uint64_t)x}};

    if (machine_call_foreseen(machine, &call))
        return;
    add_perform(x);
    machine_call_performed(machine);
}

static void calls_are_recorded_or_foreseen(void **state)
{
    enum { STEPS = 12 };
    float out[COUNT];

    (void)state;
    water = field_of(0);
    for (int i = 0; i < STEPS; i++) {
        add(1);
        add(2);
        add(4);
        machine_instruction(machine, "look");
        assert_ok(machine_field_download(machine, water, MACHINE_F32, out), machine);
    }
    assert_true(out[0] == 7.0f * STEPS);

    const struct machine_explained *x = explained();
    struct machine_stats stats;
    machine_stats_get(machine, &stats);
    assert_int_equal(x->calls_count, 2);
    const struct machine_explained_row *adds = row_of(x->calls, x->calls_count, "add");
    assert_int_equal(adds->count + adds->bytes, 3 * STEPS);
    assert_int_equal(adds->bytes, stats.calls_foreseen);
    assert_true(adds->bytes >= 3 * (STEPS - 4));
    assert_int_equal(row_of(x->calls, x->calls_count, "look")->count, STEPS);
    assert_int_equal(x->calls_recorded, adds->count + STEPS);
    assert_int_equal(x->calls_foreseen, adds->bytes);
    assert_int_equal(count_of(x->evaluations, x->evaluations_count, "somebody looked"), STEPS);
    uint64_t runs = 0;
    for (int i = 0; i < x->kernels_count; i++) {
        runs += x->kernels[i].runs;
        assert_int_equal(x->kernels[i].operations, 3);
        assert_int_equal(x->kernels[i].bytes, x->kernels[i].runs * 8 * COUNT);
    }
    assert_int_equal(runs, STEPS);
}

static void bound_is_measured_when_asked_for(void **state)
{
    uint32_t a = field_of(1), b = field_of(2);
    float out[COUNT];

    (void)state;
    store(b, machine_binary(machine, MACHINE_FADD, value(a), value(b)));
    assert_ok(machine_field_download(machine, b, MACHINE_F32, out), machine);
    const struct machine_explained *x = explained();
    assert_true(x->kernels[0].copy_s <= 0 && x->copy_bytes == 0);
    assert_true(x->kernels[0].operations_s > 0);
    x = machine_explain(machine, true);
    assert_non_null(x);
    assert_int_equal(x->kernels_count, 1); /* copies are not counted as its own */
    if (!x->kernels[0].runs_timed)
        skip_because("this device has no timestamps");
    assert_true(x->kernels[0].copy_s > 0);
    assert_int_equal(x->copy_bytes, 12 * COUNT);
    assert_true(x->copy_bytes_per_s > 1e6 && x->copy_bytes_per_s < 1e13);
}

/* Kernels with functions on many processors are optimised at once; others only after millions
 * of elements. */
static void functions_of_many_are_optimised_at_once(void **state)
{
    enum { SIDE = 192 }; /* 36864 processors */
    (void)state;
    set = support_set(machine, 2, SIDE, SIDE);
    uint32_t a = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    float *out = malloc(sizeof *out * SIDE * SIDE);
    assert_non_null(out);
    for (int i = 0; i < SIDE * SIDE; i++)
        out[i] = (float)i / (SIDE * SIDE);
    assert_ok(machine_field_upload(machine, a, MACHINE_F32, out), machine);
    store(a, machine_unary(machine, MACHINE_FEXP, value(a)));
    assert_ok(machine_finish(machine), machine);
    assert_ok(machine_field_download(machine, a, MACHINE_F32, out), machine);
    assert_true(out[0] == 1);
    free(out);
    const struct machine_explained *x = explained();
    assert_int_equal(x->kernels_count, 1);
    assert_string_equal(x->kernels[0].made, "optimised");
}

static void nobody_who_did_not_ask_is_told(void **state)
{
    struct machine *m = support_machine(0);

    (void)state;
    assert_null(machine_explain(m, true));
    machine_destroy(m);
}

int main(void)
{
#define CASE(test) cmocka_unit_test_setup_teardown(test, setup, teardown)
    const struct CMUnitTest tests[] = {
        CASE(kernel_has_the_bytes_and_operations_of_its_formula),
        CASE(fields_looked_at_together_are_computed_by_one_kernel),
        CASE(overwritten_value_has_vanished),
        CASE(dear_value_is_stored_for_its_neighbours),
        cmocka_unit_test_setup_teardown(strips_keep_rows_in_no_array, setup_strips, teardown),
        cmocka_unit_test_setup_teardown(tiles_are_kept_in_no_array, setup_tiles, teardown),
        CASE(calls_are_recorded_or_foreseen),
        CASE(bound_is_measured_when_asked_for),
        CASE(functions_of_many_are_optimised_at_once),
        cmocka_unit_test(nobody_who_did_not_ask_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
