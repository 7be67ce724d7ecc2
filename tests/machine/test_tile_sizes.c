/* Tests the choice of the tile's size, of its arrays' places and of the number of turns in one
 * kernel: on random tilings, and on one that is known by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "plan/tiles.h"

enum { TRIES = 300, STAGES_MOST = 9, ARRAYS_MOST = 24 };

static uint32_t chance;

static int below(int n)
{
    chance = chance * 1664525u + 1013904223u;
    return (int)((chance >> 8) % (uint32_t)n);
}

static struct device_shape shape_with(int local_bytes)
{
    struct device_shape shape = shape_by_driver(false, "");
    shape.group = 64;
    shape.units = 4;
    shape.local_bytes = local_bytes;
    return shape;
}

static struct vpset sheet_of(int height, int width)
{
    return (struct vpset){.rank = 2,
                          .dimensions = {height, width},
                          .count = (uint64_t)height * (uint64_t)width,
                          .rows = (uint64_t)height,
                          .width = width};
}

/* Each access is by a later stage. */
static void tiling_by_chance(struct tiling *t)
{
    int stages = 2 + below(STAGES_MOST - 2), arrays = 1 + below(ARRAYS_MOST);
    tiling_begin(t, stages);
    for (int k = 0; k < stages; k++)
        t->stages[k].ns = 1e-3 * (1 + below(50));
    for (int i = 0; i < arrays; i++) {
        int stage = below(stages), last = stage + below(stages - stage);
        tiling_array(t, (struct tile_array){1 << below(4), stage, last, false, 0});
        if (last > stage)
            tiling_look(
                t, (struct tile_look){last, stage, below(4), below(4), below(4), below(4)});
    }
    tiling_extents(t);
}

static int elements(const struct tiling *t, int stage)
{
    const struct tile_stage *s = &t->stages[stage];
    return (t->width + s->left + s->right) * (t->height + s->above + s->below);
}

static void arrays_that_live_together_are_apart(void **state)
{
    struct tiling t = {0};
    struct device_shape shape = shape_with(32 << 10);
    struct vpset set = sheet_of(300, 500);
    int shared = 0, none = 0;
    (void)state;
    chance = 1;
    for (int n = 0; n < TRIES; n++) {
        tiling_by_chance(&t);
        if (!tiles_choose(&t, &set, &shape, true)) {
            none++;
            continue;
        }
        int all = 0;
        for (int i = 0; i < t.arrays_count; i++) {
            const struct tile_array *a = &t.arrays[i];
            int end = a->at + elements(&t, a->stage) * a->bytes;
            if (a->last == a->stage)
                continue;
            all += end - a->at;
            assert_true(a->at % 8 == 0 && end <= t.bytes && t.bytes <= shape.local_bytes);
            for (int k = 0; k < i; k++) {
                const struct tile_array *b = &t.arrays[k];
                if (b->last > b->stage && a->stage <= b->last && b->stage <= a->last)
                    assert_true(a->at >= b->at + elements(&t, b->stage) * b->bytes ||
                                b->at >= end);
            }
        }
        shared += all > t.bytes;
    }
    assert_true(shared > TRIES / 4 && none < TRIES / 4);
    tiling_finish(&t);
}

/* Each stage computes at least the cells that the stages after it read. */
static void extents_are_enough(void **state)
{
    struct tiling t = {0};
    (void)state;
    chance = 2;
    for (int n = 0; n < TRIES; n++) {
        tiling_by_chance(&t);
        for (int i = 0; i < t.looks_count; i++) {
            const struct tile_look *l = &t.looks[i];
            const struct tile_stage *to = &t.stages[l->to], *from = &t.stages[l->from];
            assert_true(from->left >= to->left + l->left &&
                        from->right >= to->right + l->right);
            assert_true(from->above >= to->above + l->above &&
                        from->below >= to->below + l->below);
        }
    }
    tiling_finish(&t);
}

/* Two stages: the first reads an array's four neighbours, the second reads the four neighbours
 * of what the first stores. */
static void stencil(struct tiling *t, double ns, double far_ns)
{
    const struct tile_look look = {1, 0, 1, 1, 1, 1};
    tiling_begin(t, 2);
    tiling_look(t, look);
    tiling_look(t, (struct tile_look){0, -1, 1, 1, 1, 1});
    tiling_array(t, (struct tile_array){4, 0, 1, false, 0});
    tiling_array(t, (struct tile_array){4, 1, 1, true, 0});
    t->stored_ns = far_ns;
    t->stages[0].ns = t->stages[1].ns = ns;
    t->stages[0].far_ns = far_ns;
    tiling_extents(t);
}

static void tiles_leave_room_for_two(void **state)
{
    struct tiling t = {0};
    struct device_shape shape = shape_with(16 << 10);
    struct vpset set = sheet_of(2048, 2048);
    (void)state;
    stencil(&t, 1e-3, 1e-3);
    assert_true(tiles_choose(&t, &set, &shape, true));
    assert_int_equal(t.stages[0].left + t.stages[0].below, 2);
    assert_int_equal(t.reach.left + t.reach.above, 4);
    assert_int_equal(t.bytes, (4 * (t.width + 2) * (t.height + 2) + 7) / 8 * 8);
    assert_true(2 * t.bytes <= shape.local_bytes);
    double ns = t.ns;
    shape.local_bytes /= 16; /* small tiles compute more twice */
    assert_true(tiles_choose(&t, &set, &shape, true));
    assert_true(t.ns > 1.05 * ns && t.bytes <= shape.local_bytes);
    shape.local_bytes = 64;
    assert_false(tiles_choose(&t, &set, &shape, true));
    tiling_finish(&t);
}

static void what_is_far_away_has_no_room(void **state)
{
    struct tiling t = {0};
    struct device_shape shape = shape_with(48 << 10);
    struct vpset set = sheet_of(1 << 15, 1 << 15);
    (void)state;
    tiling_begin(&t, 3);
    for (int k = 1; k < 3; k++)
        tiling_look(&t, (struct tile_look){k, k - 1, 1 << 14, 1 << 14, 1 << 14, 1 << 14});
    for (int k = 0; k < 2; k++)
        tiling_array(&t, (struct tile_array){8, k, k + 1, false, 0});
    tiling_extents(&t);
    assert_int_equal(t.stages[0].right, 1 << 15);
    assert_false(tiles_choose(&t, &set, &shape, true));
    assert_false(tiles_choose(&t, &set, &shape, false));
    tiling_finish(&t);
}

/* Many turns in one kernel pay where memory takes the time, none where arithmetic does, and
 * never more than have room. */
static void turns_pay_where_memory_is_slow(void **state)
{
    struct tiling t = {0};
    struct device_shape shape = shape_with(48 << 10);
    struct vpset set = sheet_of(2048, 2048);
    (void)state;
    shape.launch_ns = 0;
    stencil(&t, 1e-4, 4e-3);
    assert_true(tiles_choose(&t, &set, &shape, false));
    int many = tiles_turns(&t, &set, &shape, t.ns);
    assert_true(many >= 4 && many <= 2 * shape.turns);
    assert_int_equal(tiles_turns(&t, &set, &shape, t.ns / 100), 1);
    shape.local_bytes = 3 << 10;
    int few = tiles_turns(&t, &set, &shape, t.ns);
    assert_true(few < many);
    shape.local_bytes = 48 << 10;
    stencil(&t, 4e-3, 1e-4);
    assert_true(tiles_choose(&t, &set, &shape, false));
    assert_int_equal(tiles_turns(&t, &set, &shape, t.ns), 1);
    tiling_finish(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_that_live_together_are_apart),
        cmocka_unit_test(extents_are_enough),
        cmocka_unit_test(tiles_leave_room_for_two),
        cmocka_unit_test(what_is_far_away_has_no_room),
        cmocka_unit_test(turns_pay_where_memory_is_slow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
