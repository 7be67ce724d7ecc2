/* Tests tiles of local memory, forced on a CPU: elements of all sizes, on sheets whose sides
 * are no multiples of a tile's; and the plans that a GPU would get. oclgrind.sh also runs it,
 * to find data races between work-items. */
#include "base/parts.h"
#include "device/device.h"
#include "support.h"

/* ---- sheets whose sides are no multiples of a tile's ---- */

static uint64_t dear(uint64_t x)
{
    for (uint64_t i = 1; i <= 3; i++)
        x = (x * x) ^ (x + i);
    return x;
}

static struct machine_value *dear_value(struct machine *m, struct machine_value *x)
{
    for (uint64_t i = 1; i <= 3; i++)
        x = machine_binary(m, MACHINE_XOR, machine_binary(m, MACHINE_MUL, x, x),
                           machine_binary(m, MACHINE_ADD, x,
                                          machine_constant(m, MACHINE_UINT(64),
                                                           (struct machine_scalar){i, 0})));
    return x;
}

struct grid {
    int rows, columns;
    uint64_t first[2400]; /* of each processor */
};

static size_t at(const struct grid *g, uint64_t n, int down, int right)
{
    int row = (int)(n / (uint64_t)g->columns), column = (int)(n % (uint64_t)g->columns);
    row = (row + down % g->rows + g->rows) % g->rows;
    column = (column + right % g->columns + g->columns) % g->columns;
    return (size_t)(row * g->columns + column);
}

/* The stages one after the other: long words, bytes and bits that are read at neighbours
 * only. */
static uint64_t second(const struct grid *g, uint64_t n)
{
    return dear(dear(g->first[at(g, n, 1, 0)]) + dear(g->first[at(g, n, -1, -2)]));
}

static uint64_t third(const struct grid *g, uint64_t n)
{
    return dear(second(g, at(g, n, 0, 3)) - second(g, at(g, n, -2, 0)));
}

static wide result(const void *data, uint64_t n)
{
    const struct grid *g = data;
    uint64_t up = at(g, n, -1, 0), left = at(g, n, 0, -1);
    bool less = third(g, left) < second(g, left);
    return (wide)((third(g, up) & 0xff) + 1000 * less + (second(g, n) & 0xffff) * 10000);
}

static void sheet_agrees(struct machine *m, int rows, int columns)
{
    static struct grid g;
    struct machine_type word = MACHINE_UINT(64);
    g.rows = rows;
    g.columns = columns;
    int set = support_set(m, 2, rows, columns);
    uint32_t field = support_field(m, word, 5);
    for (int n = 0; n < rows * columns; n++)
        g.first[n] = (uint64_t)support_word(word, 5, (uint64_t)n);
    machine_begin(m);
    struct machine_value *x = dear_value(m, support_value(m, field, word));
    struct machine_value *y =
        dear_value(m, machine_binary(m, MACHINE_ADD, machine_shift(m, x, 0, 1),
                                     machine_shift(m, machine_shift(m, x, 0, -1), 1, -2)));
    struct machine_value *z =
        dear_value(m, machine_binary(m, MACHINE_SUB, machine_shift(m, y, 1, 3),
                                     machine_shift(m, y, 0, -2)));
    struct machine_value *less =
        machine_resize(m, machine_binary(m, MACHINE_ULT, z, y), 64, false);
    struct machine_value *byte = machine_resize(m, machine_resize(m, z, 8, false), 64, false);
    struct machine_value *low = machine_resize(m, machine_resize(m, y, 16, false), 64, false);
    struct machine_value *thousand =
                             machine_constant(m, word, (struct machine_scalar){1000, 0}),
                         *more = machine_constant(m, word, (struct machine_scalar){10000, 0});
    support_expect(
        m,
        machine_binary(m, MACHINE_ADD, machine_shift(m, byte, 0, -1),
                       machine_binary(m, MACHINE_ADD,
                                      machine_binary(m, MACHINE_MUL,
                                                     machine_shift(m, less, 1, -1), thousand),
                                      machine_binary(m, MACHINE_MUL, low, more))),
        result, &g, "through tiles");
    assert_ok(machine_vpset_destroy(m, set), m);
}

static void sheets_that_no_tile_fits(void **state)
{
    static const int sheets[][2] = {{20, 37}, {1, 50}, {3, 2}};
    (void)state;
    setenv("LUTETIA_TILE", "8x5", 1);
    for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++) {
        struct machine *m = support_machine(0);
        struct machine_stats stats;
        sheet_agrees(m, sheets[i][0], sheets[i][1]);
        machine_stats_get(m, &stats);
        assert_int_equal(stats.kernels_in_tiles, 1);
        support_machine_destroy(m);
    }
    unsetenv("LUTETIA_TILE");
}

/* With a GPU's device shape the planner chooses tiles where they save a launch and arrays, and
 * not where they save nothing. */
static void a_gpu_takes_tiles_by_itself(void **state)
{
    struct machine_stats stats;
    (void)state;
    setenv("LUTETIA_BOX_AFTER", "0", 1);
    struct machine *m = support_machine(0);
    unsetenv("LUTETIA_BOX_AFTER");
    struct device_shape forced = m->device->shape;
    m->device->shape = shape_by_driver(false, "");
    m->device->shape.group = forced.group;
    m->device->shape.local_bytes = forced.local_bytes;
    m->device->shape.units = 8;
    sheet_agrees(m, 60, 40);
    machine_stats_get(m, &stats);
    assert_int_equal(stats.kernels_in_tiles, 1);

    int set = support_set(m, 2, 60, 40);
    uint32_t field = support_field(m, MACHINE_UINT(64), 5);
    machine_begin(m);
    struct machine_value *x = support_value(m, field, MACHINE_UINT(64));
    assert_ok(machine_field_store(m, field,
                                  machine_binary(m, MACHINE_ADD, x, machine_shift(m, x, 0, 1)),
                                  MACHINE_EVERYWHERE),
              m);
    assert_ok(machine_finish(m), m);
    machine_stats_get(m, &stats);
    assert_int_equal(stats.kernels_in_tiles, 1);
    assert_ok(machine_vpset_destroy(m, set), m);
    support_machine_destroy(m);
}

/* A tile too large for local memory, or a work-group too large for the device: the plan has no
 * tiles. */
static void what_cannot_be_is_done_without(void **state)
{
    (void)state;
    for (int group = 0; group < 2; group++) {
        struct machine_stats stats;
        setenv("LUTETIA_TILE", group ? "8x5" : "1024x1024", 1);
        struct machine *m = support_machine(0);
        unsetenv("LUTETIA_TILE");
        if (group)
            m->device->shape.group = 1 << 16;
        sheet_agrees(m, 20, 37);
        machine_stats_get(m, &stats);
        assert_int_equal(stats.kernels_in_tiles, 0);
        support_machine_destroy(m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheets_that_no_tile_fits),
        cmocka_unit_test(a_gpu_takes_tiles_by_itself),
        cmocka_unit_test(what_cannot_be_is_done_without),
    };
    setenv("LUTETIA_VECTOR", "1", 1);
    setenv("LUTETIA_STRIPS", "1", 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
