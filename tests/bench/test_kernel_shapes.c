/* test_kernel_shapes.c - compares the listing in strips, and in tiles that are forced on a CPU,
 * with the plain double loop: one turn and many in a kernel, on sheets whose sides are no
 * multiples of a vector's or tile's. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <cm/paris.h>

#include "diffusion_oracle.h"
#include "harness.h"
#include "listing.h"
#include "machine.h"
#include "of_machine.h"
#include "paris_internal.h"

struct sheet {
    int width, height, rim[4];
    int steps;
    const char *turns, *tile, *columns, *in_place; /* NULL: the engine's choice */
};

static void force(const char *name, const char *value)
{
    setenv(name, value ? value : "", 1);
}

static void step(const void *listing)
{
    listing_step(listing);
}

static void listing_begin(struct listing *l, const struct diffusion_scene *s)
{
    struct machine *m = paris_machine();
    *l =
        (struct listing){.width = s->width, .height = s->height, .gravity = (double)s->gravity};
    for (int i = 0; i < 3; i++)
        l->molecular_weight[i] = (double)s->molecular_weight[i];
    listing_allocate(l);
    l->x0 = s->x0;
    l->y0 = s->y0;
    l->x1 = s->x1;
    l->y1 = s->y1;
    assert_int_equal(machine_field_upload(m, l->absorbency, MACHINE_F32, s->absorbency), 0);
    assert_int_equal(machine_field_upload(m, l->water, MACHINE_F32, s->field[DIFFUSION_WATER]),
                     0);
    for (int i = 0; i < 3; i++)
        assert_int_equal(machine_field_upload(m, l->pigment[i], MACHINE_F32,
                                              s->field[DIFFUSION_PIGMENT + i]),
                         0);
}

static struct machine_stats agrees(const struct sheet *t)
{
    struct diffusion_scene s;
    struct oracle o;
    struct listing l;
    struct machine_config config = machine_config_default();
    struct machine_stats stats;

    force("LUTETIA_TURNS", t->turns);
    force("LUTETIA_TILE", t->tile);
    force("LUTETIA_COLUMNS", t->columns);
    force("LUTETIA_IN_PLACE", t->in_place);
    assert_true(paris_reset(&config));
    oracle_scene_init(&s, t->width, t->height, t->rim);
    oracle_init(&o, &s);
    oracle_steps(&o, t->steps);
    listing_begin(&l, &s);
    float *mine = malloc((size_t)s.width * (size_t)s.height * sizeof *mine);
    assert_non_null(mine);
    if (!bench_machine_steps(step, &l, t->steps, t->steps))
        fail_msg("%s", bench_error());
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
        CM_field_id_t id = i == DIFFUSION_WATER ? l.water : l.pigment[i - DIFFUSION_PIGMENT];
        machine_begin(paris_machine());
        assert_int_equal(machine_field_download(paris_machine(), id, MACHINE_F32, mine), 0);
        oracle_compare(&o, "listing", i, mine);
    }
    machine_stats_get(paris_machine(), &stats);
    free(mine);
    oracle_finish(&o);
    diffusion_scene_finish(&s);
    return stats;
}

/* Sheets larger and smaller than a tile, of odd sizes, and with rectangles that leave out some
 * edges. */
static void one_turn_in_tiles(void **state)
{
    static const struct sheet sheets[] = {
        {300, 20, {20, 0, 1, 4}, 2, "1", NULL, NULL, NULL},
        {37, 29, {2, 2, 2, 2}, 2, "1", "8x8", NULL, NULL},
        {5, 4, {0, 0, 0, 0}, 2, "1", "8x8", NULL, NULL},
        {33, 17, {0, 0, 0, 0}, 2, "1", "8x8", NULL, NULL},
        {4, 70, {0, 1, 0, 1}, 2, "1", "8x8", NULL, NULL},
    };
    (void)state;
    force("LUTETIA_VECTOR", "1");
    for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++)
        assert_true(agrees(&sheets[i]).kernels_in_tiles > 0);
}

static void many_turns_in_tiles(void **state)
{
    const struct sheet sheet = {37, 29, {0, 0, 0, 0}, 40, "2", "16x8", NULL, NULL};
    (void)state;
    force("LUTETIA_VECTOR", "1");
    force("LUTETIA_BOX_AFTER", "0"); /* many turns need optimised kernels */
    struct machine_stats stats = agrees(&sheet);
    assert_true(stats.kernels_in_tiles > 0 && stats.kernels_run < 35);
}

/* Strips as wide as the rows, of whole vectors and not, and narrower ones beside each other.
 * Rectangles end inside a vector, or there is none. Some strips write in place. */
static void in_strips(void **state)
{
    static const struct sheet sheets[] = {
        {48, 21, {0, 0, 0, 0}, 3, "1", NULL, NULL, "1"},
        {47, 20, {1, 2, 1, 3}, 3, "1", NULL, NULL, "1"},
        {33, 24, {0, 0, 0, 0}, 30, "3", NULL, NULL, NULL},
        {116, 30, {17, 0, 2, 5}, 30, "3", NULL, "48", NULL},
    };
    (void)state;
    force("LUTETIA_VECTOR", NULL);
    force("LUTETIA_BOX_AFTER", "0");
    for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++)
        assert_true(agrees(&sheets[i]).kernels_in_strips > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_turn_in_tiles),
                                       cmocka_unit_test(many_turns_in_tiles),
                                       cmocka_unit_test(in_strips)};
    setenv("LUTETIA_STRIPS", "1", 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
