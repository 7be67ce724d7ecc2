/* test_active.c - scans of lines whose first and last processors are not active: what the loops
 * leave out changes no active processor's number. Random contexts, in which the active ones lie
 * between two places, with gaps; all of them; and none. */
#include "sample.h"
#include "support.h"

enum { MOST = 3000 };

static const struct {
    int rows, columns;
} shapes[] = {{1, MOST}, {7, 300}, {40, 21}};

static const enum machine_scan_op ops[] = {MACHINE_SCAN_ADD, MACHINE_SCAN_UMIN, MACHINE_SCAN_OR,
                                           MACHINE_SCAN_XOR, MACHINE_SCAN_COPY};
static const int widths[] = {32, 17, 40, 100};

static uint64_t chance;

static int below(int n)
{
    return (int)(sample_word(&chance) % (uint64_t)n);
}

static wide joined(enum machine_scan_op op, int width, wide a, wide b)
{
    return op == MACHINE_SCAN_ADD    ? (a + b) & (~(wide)0 >> (128 - width))
           : op == MACHINE_SCAN_UMIN ? (b < a ? b : a)
           : op == MACHINE_SCAN_OR   ? a | b
                                     : a ^ b;
}

/* One line, forwards or backwards. */
static void line_expect(const struct machine_scan *how, int width, const wide *in,
                        const uint8_t *active, int step, int n, wide *out)
{
    const wide none = how->op == MACHINE_SCAN_UMIN ? ~(wide)0 >> (128 - width) : 0;
    wide before = none;
    bool has = false;
    for (int k = 0, i = how->downward ? (n - 1) * step : 0; k < n;
         k++, i += how->downward ? -step : step) {
        if (!active[i])
            continue;
        const wide after = how->op == MACHINE_SCAN_COPY ? (has ? before : in[i])
                                                        : joined(how->op, width, before, in[i]);
        out[i] = how->exclusive ? before : after;
        before = after;
        has = true;
    }
}

static void context_make(uint8_t *active, int rows, int columns)
{
    const int kind = below(6);
    for (int row = 0; row < rows; row++) {
        const int from = below(columns), end = from + below(columns - from + 1);
        for (int c = 0; c < columns; c++)
            active[row * columns + c] =
                kind == 0 || (kind > 1 && c >= from && c < end && (kind == 2 || below(4)));
    }
}

static void scan_try(struct machine *m, int shape)
{
    static wide in[MOST], expected[MOST];
    static uint8_t active[MOST], raw[16 * MOST];
    const int rows = shapes[shape].rows, columns = shapes[shape].columns,
              count = rows * columns, width = widths[below(4)];
    const struct machine_type type = MACHINE_UINT(width);
    const struct machine_scan how = {
        .op = ops[below(5)], .axis = below(2), .downward = below(2), .exclusive = below(2)};
    const int set = support_set(m, 2, rows, columns);
    const uint32_t from = support_field(m, type, (uint64_t)below(1000)),
                   to = support_field(m, type, 7),
                   context = machine_field_allocate(m, set, 1, MACHINE_HEAP);
    context_make(active, rows, columns);
    assert_ok(machine_field_upload(m, context, MACHINE_BIT, active), m);
    assert_ok(machine_field_download(m, to, type, raw), m);
    for (int i = 0; i < count; i++)
        expected[i] = support_element(raw, type, (uint64_t)i);
    assert_ok(machine_field_download(m, from, type, raw), m);
    for (int i = 0; i < count; i++)
        in[i] = support_element(raw, type, (uint64_t)i);
    for (int k = 0; k < (how.axis ? rows : columns); k++)
        line_expect(&how, width, in + (how.axis ? k * columns : k),
                    active + (how.axis ? k * columns : k), how.axis ? 1 : columns,
                    how.axis ? columns : rows, expected + (how.axis ? k * columns : k));
    machine_begin(m);
    assert_ok(machine_flag_store(m, MACHINE_CONTEXT, support_value(m, context, MACHINE_BIT),
                                 MACHINE_EVERYWHERE),
              m);
    machine_begin(m);
    struct machine_value *v = machine_field_value(m, from, type, MACHINE_WHERE_ACTIVE);
    assert_ok(machine_field_store(m, to, machine_scan(m, &how, v), MACHINE_WHERE_ACTIVE), m);
    machine_begin(m);
    assert_ok(machine_field_download(m, to, type, raw), m);
    for (int i = 0; i < count; i++)
        if (support_element(raw, type, (uint64_t)i) != expected[i])
            fail_msg("%dx%d, op %d of %d bits along axis %d%s%s: processor %d", rows, columns,
                     (int)how.op, width, how.axis, how.downward ? ", downward" : "",
                     how.exclusive ? ", exclusive" : "", i);
    assert_ok(machine_vpset_destroy(m, set), m);
}

static int scans = 400;

static void scans_between_idle_ends_come_to_the_same(void **state)
{
    (void)state;
    setenv("LUTETIA_INTERPRET", "2", 1);
    for (int near = 1; near < 3; near++) { /* 2: each line by several threads */
        setenv("LUTETIA_NEAR", near == 1 ? "1" : "2", 1);
        struct machine *m = support_machine(0);
        chance = (uint64_t)near;
        for (int i = 0; i < scans; i++)
            scan_try(m, below(3));
        machine_destroy(m);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scans_between_idle_ends_come_to_the_same)};
    if (argc > 1) /* so many for each */
        scans = atoi(argv[1]);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
