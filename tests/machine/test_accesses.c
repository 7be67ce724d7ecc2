/* Compares the accesses that the walk of the graph finds for each stage with the accesses in
 * codegen's text, for random graphs in rows and in strips. Needs no device. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "codegen/body.h"
#include "hand_graph.h"

enum { GRAPHS = 400 };

/* ---- the walk and the text agree ---- */

static void written(struct emitter *e, const struct plan_graph *g, const struct vpset *set,
                    int stage)
{
    assert_true(emitter_init(e, g, set, stage));
    for (int i = 0; i < g->count; i++)
        if (g->nodes[i].stored && g->nodes[i].stage == stage)
            emit_value(e, i, 0, 0, true);
    assert_false(e->failed);
}

static void walked(struct accesses *a, const struct plan_graph *g, const struct vpset *set,
                   int stage)
{
    accesses_begin(a, g, set, stage);
    for (int i = 0; i < g->count; i++)
        if (g->nodes[i].stored && g->nodes[i].stage == stage)
            accesses_add(a, i, true);
    accesses_end(a);
    assert_false(a->failed);
}

static void agree(const struct accesses *a, const struct emitter *e)
{
    assert_int_equal(a->count, e->pointers_count);
    for (int i = 0; i < a->count; i++) {
        const struct access *x = &a->list[i], *y = &e->seen_pointers[i];
        assert_int_equal(x->node, y->node);
        assert_int_equal(x->low, y->low);
        assert_int_equal(x->high, y->high);
        assert_memory_equal(a->rows[x->row].d, e->row_offsets[y->row].d, sizeof a->rows->d);
    }
    assert_int_equal(a->rows_count, e->rows_count);
    assert_int_equal(a->loads, e->loads);
    assert_int_equal(a->ops, e->ops);
    assert_int_equal(a->cost, e->cost);
    assert_int_equal(a->wide, e->wide);
    assert_int_equal(a->soft, e->soft);
}

static int last_stage(const struct plan_graph *g)
{
    int last = 0;
    for (int i = 0; i < g->count; i++)
        if (g->nodes[i].stored)
            widen(&last, g->nodes[i].stage);
    return last;
}

static void compare(const struct plan_graph *g, const struct vpset *set, int *stages)
{
    for (int stage = 0; stage <= last_stage(g); stage++) {
        struct emitter e;
        struct accesses a;
        written(&e, g, set, stage);
        walked(&a, g, set, stage);
        agree(&a, &e);
        *stages += 1;
        accesses_finish(&a);
        free(e.arguments.list);
        emitter_finish(&e);
    }
}

static void planned(struct hand_graph *h, uint32_t seed, int rank, bool strips,
                    struct vpset sets[2])
{
    static const int dimensions[] = {40, 600, 960};
    struct device_shape shape = hand_shape();
    hand_begin(h, seed);
    hand_by_chance(h, 10 + hand_below(h, 120), rank);
    hand_prune(h);
    shape.always_strips = strips;
    shape.op_ns = seed % 3 ? 0.1 : 5; /* costly: more nodes are stored */
    h->g.no_strips = !strips;
    sets[1] = hand_set(rank, dimensions + 3 - rank, shape.halo);
    plan_choose(&h->g, sets, &shape);
}

static void what_is_walked_is_what_is_written(void **state)
{
    (void)state;
    struct hand_graph *h = malloc(sizeof *h);
    int stages = 0, strips = 0;
    assert_non_null(h);
    for (uint32_t seed = 1; seed <= GRAPHS; seed++) {
        struct vpset sets[2] = {{0}};
        planned(h, seed, 2 + (seed % 5 == 0), seed & 1, sets);
        compare(&h->g, &sets[1], &stages);
        strips += h->g.strips;
    }
    assert_true(stages > GRAPHS); /* some have several */
    print_message("%d stages, %d in strips\n", stages, strips);
    assert_true(strips > GRAPHS / 20);
    free(h);
}

/* ---- turns ---- */

/* One turn of a loop: the sum (or the difference) of two neighbours' values that the turn
 * before stored. */
static int turn(struct hand_graph *h, int before, bool other)
{
    int west = hand_shift(h, before, 1, -1), north = hand_shift(h, before, 0, 1);
    int sum = hand_node(h, other ? MACHINE_SUB : MACHINE_ADD, MACHINE_UINT(16), west, north, 0);
    h->nodes[sum].stored = true;
    return sum;
}

static void equal_turns_have_one_form(void **state)
{
    (void)state;
    static const int dimensions[] = {64, 64};
    struct vpset set = hand_set(2, dimensions, 32);
    struct hand_graph *h = malloc(sizeof *h);
    struct accesses a[4];
    struct emitter e[4];
    assert_non_null(h);
    hand_begin(h, 1);
    int x = hand_leaf(h, MACHINE_UINT(16));
    for (int k = 0; k < 4; k++) {
        x = turn(h, x, k == 2);
        h->nodes[x].stage = k;
    }
    h->nodes[x].target = true;
    for (int k = 0; k < 4; k++) {
        walked(&a[k], &h->g, &set, k);
        written(&e[k], &h->g, &set, k);
        agree(&a[k], &e[k]);
        assert_int_equal(a[k].count, 2);
        assert_int_equal(a[k].list[0].low, -1);
        assert_int_equal(a[k].list[0].high, 0);
        assert_int_equal(accesses_down(&a[k], &a[k].list[0]), 0);
        assert_int_equal(accesses_down(&a[k], &a[k].list[1]), 1);
    }
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            assert_int_equal(accesses_same(&a[i], &a[k]), (i == 2) == (k == 2));
            assert_int_equal(text_same(&e[i].body, &e[k].body), (i == 2) == (k == 2));
        }
    for (int k = 0; k < 4; k++) {
        accesses_finish(&a[k]);
        free(e[k].arguments.list);
        emitter_finish(&e[k]);
    }
    free(h);
}

/* The distance by the short way round the torus. */
static void rows_are_counted_the_short_way(void **state)
{
    (void)state;
    static const int dimensions[] = {10, 64};
    struct vpset set = hand_set(2, dimensions, 32);
    for (int d = -9; d <= 9; d++) {
        struct row_offset row = {{d}};
        int down = row_down(&set, &row);
        assert_in_range(down + 5, 0, 10);
        assert_int_equal((down - d) % 10, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_walked_is_what_is_written),
        cmocka_unit_test(equal_turns_have_one_form),
        cmocka_unit_test(rows_are_counted_the_short_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
