/* Scans, spreads and ranks as cuts of the graph: no call waits for them, their results are used
 * like any value, and wrong calls get a message. ../paris/test_scans.c checks their numbers. */
#include "support.h"

enum { ROWS = 6, COLUMNS = 40, COUNT = ROWS * COLUMNS };

static struct machine *m;

static int start(void **unused)
{
    (void)unused;
    setenv("LUTETIA_NEAR", "0", 0); /* kernels, for which nothing waits */
    m = support_machine(0);
    return 0;
}

static int machine_end(void **unused)
{
    (void)unused;
    machine_destroy(m);
    return 0;
}

static struct machine_value *number(uint64_t x)
{
    return machine_constant(m, MACHINE_UINT(32), (struct machine_scalar){x, 0});
}

static void results_go_on_like_any_value_and_nothing_waits(void **unused)
{
    (void)unused;
    support_set(m, 2, ROWS, COLUMNS);
    uint32_t f = support_field(m, MACHINE_UINT(32), 5), in[COUNT], out[COUNT];
    uint32_t g = machine_field_allocate(m, machine_vpset_current(m), 32, MACHINE_HEAP);
    assert_ok(machine_field_download(m, f, MACHINE_UINT(32), in), m);
    struct machine_stats before, after;
    machine_stats_get(m, &before);
    for (int turn = 0; turn < 3; turn++) {
        machine_begin(m);
        struct machine_value *x =
            machine_field_value(m, turn ? g : f, MACHINE_UINT(32), MACHINE_WHERE_ACTIVE);
        struct machine_scan how = {.op = MACHINE_SCAN_ADD, .axis = 1};
        struct machine_value *sum = machine_scan(m, &how, x);
        struct machine_value *greatest = machine_spread(m, MACHINE_SCAN_UMAX, 3, sum);
        struct machine_value *here = machine_binary(m, MACHINE_XOR, sum, greatest);
        assert_ok(machine_field_store(m, g, here, MACHINE_WHERE_ACTIVE), m);
    }
    machine_stats_get(m, &after);
    /* Interpreted plans run on the host, which waits for the scan before them. */
    assert_true(after.interpreted > before.interpreted || after.busy_s == before.busy_s);
    assert_ok(machine_field_download(m, g, MACHINE_UINT(32), out), m);
    for (int turn = 0; turn < 3; turn++) {
        uint32_t greatest = 0;
        for (int row = 0; row < ROWS; row++)
            for (int c = 1; c < COLUMNS; c++)
                in[row * COLUMNS + c] += in[row * COLUMNS + c - 1];
        for (int i = 0; i < COUNT; i++)
            greatest = in[i] > greatest ? in[i] : greatest;
        for (int i = 0; i < COUNT; i++)
            in[i] ^= greatest;
    }
    assert_memory_equal(in, out, sizeof in);
}

/* The result of each cut is shifted at once: a shift reads the repeated columns at the ends of
 * rows. */
static void repeated_columns_are_written(void **unused)
{
    (void)unused;
    support_set(m, 2, ROWS, COLUMNS);
    uint32_t f = support_field(m, MACHINE_UINT(32), 6), in[COUNT], out[COUNT];
    uint32_t g = machine_field_allocate(m, machine_vpset_current(m), 32, MACHINE_HEAP);
    assert_ok(machine_field_download(m, f, MACHINE_UINT(32), in), m);
    for (int form = 0; form < 5; form++) {
        machine_begin(m);
        struct machine_value *x =
            machine_field_value(m, f, MACHINE_UINT(32), MACHINE_EVERYWHERE);
        struct machine_scan how = {
            .op = MACHINE_SCAN_XOR, .axis = form % 2, .downward = form >= 2};
        struct machine_value *v =
            form < 4 ? machine_scan(m, &how, x)
                     : machine_rank(m, 1, false, false, MACHINE_UNSEGMENTED, NULL, x);
        assert_ok(machine_field_store(m, g, v, MACHINE_EVERYWHERE), m);
        uint32_t plain[COUNT];
        assert_ok(machine_field_download(m, g, MACHINE_UINT(32), plain), m);
        for (int way = -1; way <= 1; way += 2) {
            machine_begin(m);
            v = machine_field_value(m, g, MACHINE_UINT(32), MACHINE_EVERYWHERE);
            uint32_t h = machine_field_allocate(m, machine_vpset_current(m), 32, MACHINE_HEAP);
            assert_ok(
                machine_field_store(m, h, machine_shift(m, v, 1, way), MACHINE_EVERYWHERE), m);
            assert_ok(machine_field_download(m, h, MACHINE_UINT(32), out), m);
            for (int i = 0; i < COUNT; i++)
                assert_int_equal(
                    out[i],
                    plain[i / COLUMNS * COLUMNS + (i % COLUMNS + COLUMNS + way) % COLUMNS]);
            assert_ok(machine_field_deallocate(m, h), m);
        }
    }
}

static void said(const void *result, const char *what)
{
    assert_null(result);
    support_failed(m, MACHINE_BAD_ARGUMENT, what);
}

static void what_is_wrong_is_said(void **unused)
{
    (void)unused;
    int other = support_set(m, 1, 5);
    uint32_t foreign = support_field(m, MACHINE_UINT(32), 7);
    struct machine_value *of_other =
        machine_field_value(m, foreign, MACHINE_UINT(32), MACHINE_EVERYWHERE);
    support_set(m, 2, ROWS, COLUMNS);
    struct machine_scan how = {.op = MACHINE_SCAN_ADD, .axis = 2};
    said(machine_scan(m, &how, number(1)), "no such axis");
    how.axis = -1;
    said(machine_scan(m, &how, number(1)), "no such axis");
    how.axis = 0;
    said(machine_scan(m, &how, of_other), "another VP set");
    how.op = MACHINE_SCAN_FADD;
    said(machine_scan(m, &how, number(1)), "values of this type");
    how = (struct machine_scan){
        .op = MACHINE_SCAN_OR, .segments = MACHINE_SEGMENT_BIT, .bits = number(1)};
    said(machine_scan(m, &how, number(1)), "segments begin at bits");
    said(machine_spread(m, MACHINE_SCAN_ADD, 4, number(1)), "no such axis");
    said(machine_spread(m, MACHINE_SCAN_COPY, 1, number(1)), "values of this type");
    said(machine_spread_coordinate(m, 1, COLUMNS, number(1)), "no such coordinate");
    said(machine_spread_index(m, COUNT, number(1)), "no such processor");
    said(machine_rank(m, 2, false, false, MACHINE_UNSEGMENTED, NULL, number(1)),
         "no such axis");
    assert_null(machine_scan(m, &how, NULL)); /* goes through */
    assert_int_equal(machine_status_last(m), MACHINE_OK);
    assert_ok(machine_vpset_destroy(m, other), m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_go_on_like_any_value_and_nothing_waits),
        cmocka_unit_test(repeated_columns_are_written),
        cmocka_unit_test(what_is_wrong_is_said),
    };
    return cmocka_run_group_tests(tests, start, machine_end);
}
