/* Schedules of strips, on hand-made graphs: each row is computed before it is read, and its
 * ring holds it until then. Needs no device. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "codegen/strips.h"
#include "hand_graph.h"

enum { GRAPHS = 300, STEPS = 40, RING_MOST = 64, FAR = 1 << 20 };

static int stores_of(const struct plan_graph *g, int *stores)
{
    int count = 0, last = 0;
    for (int i = 0; i < g->count; i++)
        if (g->nodes[i].stored)
            widen(&last, g->nodes[i].stage);
    for (int stage = 0; stage <= last; stage++)
        for (int i = 0; i < g->count; i++)
            if (g->nodes[i].stored && g->nodes[i].stage == stage)
                stores[count++] = i;
    return count;
}

/* ---- schedules carried out row by row ---- */

/* The row that each slot of each node's ring holds. */
struct rings_held {
    int of[HAND_NODES_MOST][RING_MOST];
};

static int slot_of(int row, int rows)
{
    return ((row % rows) + rows) % rows;
}

static int row_at(const struct strips *s, const struct unit *u, int time)
{
    return s->downward * (time - u->delay);
}

static void looks(const struct strips *s, const struct rings_held *held, const struct unit *to,
                  int time)
{
    for (int i = 0; i < to->looks.count; i++) {
        const struct access *p = &to->looks.list[i];
        if (s->g->nodes[p->node].leaf)
            continue;
        const struct unit *from = &s->units[s->unit[p->node]];
        int wanted = row_at(s, to, time) + accesses_down(&to->looks, p);
        int made = row_at(s, from, time), rows = s->ring_rows[p->node];
        bool same = s->stages[from->stage].pass == s->stages[to->stage].pass;
        if (wanted == made && same)
            continue; /* in a variable */
        /* a row that is overwritten at this time, vector by vector, is read before that */
        bool now = same && rows && slot_of(wanted, rows) == slot_of(made, rows) &&
                   wanted == made - s->downward * rows;
        if (now) {
            assert_int_equal(to->ahead, from->ahead);
            assert_true(!p->low && !p->high);
            continue;
        }
        if (rows < 1 || rows > RING_MOST)
            fail_msg("node %d: a ring of %d rows", p->node, rows);
        assert_int_equal(held->of[p->node][slot_of(wanted, rows)], wanted);
    }
}

static void carried_out(const struct strips *s)
{
    struct rings_held *held = malloc(sizeof *held);
    assert_non_null(held);
    for (int i = 0; i < HAND_NODES_MOST; i++)
        for (int k = 0; k < RING_MOST; k++)
            held->of[i][k] = FAR;
    int most = 0;
    for (int k = 0; k < s->units_count; k++)
        widen(&most, s->units[k].delay);
    for (int time = -2 * RING_MOST; time < most + STEPS; time++)
        for (int k = 0; k < s->units_count; k++) {
            if (time >= most)
                looks(s, held, &s->units[k], time);
            for (int i = 0; i < s->stores_count; i++) {
                int node = s->stores[i], row = row_at(s, &s->units[k], time);
                if (s->unit[node] == k && s->ring_rows[node])
                    held->of[node][slot_of(row, s->ring_rows[node])] = row;
            }
        }
    free(held);
}

static void passes_are_whole(const struct strips *s)
{
    assert_true(s->passes_count >= 1 && s->passes_count <= s->stages_count);
    for (int i = 0; i < s->passes_count; i++) {
        const struct pass *pass = &s->passes[i];
        assert_true(pass->first <= pass->last);
        assert_int_equal(pass->first, i ? s->passes[i - 1].last + 1 : 0);
    }
    assert_int_equal(s->passes[s->passes_count - 1].last, s->stages_count - 1);
}

static void rows_are_there_when_they_are_looked_at(void **state)
{
    (void)state;
    static const int dimensions[] = {600, 960};
    struct hand_graph *h = malloc(sizeof *h);
    int stores[HAND_NODES_MOST], scheduled = 0;
    assert_non_null(h);
    for (uint32_t seed = 1; seed <= GRAPHS; seed++) {
        struct device_shape shape = hand_shape();
        struct vpset sets[2] = {{0}, hand_set(2, dimensions, shape.halo)};
        struct strips s;
        hand_begin(h, seed);
        hand_by_chance(h, 30 + hand_below(h, 200), 2);
        hand_prune(h);
        shape.always_strips = true;
        shape.op_ns = 5;
        plan_choose(&h->g, sets, &shape);
        strips_init(&s, &h->g, stores, stores_of(&h->g, stores), &sets[1], &shape,
                    shape.vector);
        if (h->g.strips && strips_schedule(&s)) {
            passes_are_whole(&s);
            carried_out(&s);
            scheduled++;
        }
        assert_false(s.failed);
        free(s.in_place.pairs);
        strips_finish(&s);
    }
    assert_true(scheduled > GRAPHS / 20);
    free(h);
}

/* ---- a schedule that is known by hand ---- */

/* Each turn of a loop reads its own row and those above and below, so it runs one row behind
 * the turn before. */
static void a_turn_is_one_row_behind_the_turn_before(void **state)
{
    (void)state;
    enum { TURNS = 5 };
    static const int dimensions[] = {600, 960};
    struct device_shape shape = hand_shape();
    struct vpset set = hand_set(2, dimensions, shape.halo);
    struct hand_graph *h = malloc(sizeof *h);
    struct strips s;
    int stores[HAND_NODES_MOST], turns[TURNS];
    const struct machine_type type = {MACHINE_FLOAT, 32, 0, 0};
    assert_non_null(h);
    hand_begin(h, 1);
    int x = hand_leaf(h, type);
    for (int k = 0; k < TURNS; k++) {
        int north = hand_shift(h, x, 0, -1), south = hand_shift(h, x, 0, 1);
        int sum = hand_node(h, MACHINE_FADD, type, north, south, 0);
        x = turns[k] = hand_node(h, MACHINE_FADD, type, sum, x, 0);
        h->nodes[x].stored = true;
        h->nodes[x].stage = k;
    }
    h->nodes[x].target = true;
    strips_init(&s, &h->g, stores, stores_of(&h->g, stores), &set, &shape, shape.vector);
    assert_true(strips_schedule(&s));
    assert_int_equal(s.units_count, TURNS);
    assert_int_equal(s.passes_count, TURNS);
    for (int k = 0; k < TURNS; k++) {
        const struct unit *u = &s.units[s.unit[turns[k]]];
        assert_int_equal(u->delay, k);
        assert_int_equal(u->above, TURNS - 1 - k);
        assert_int_equal(u->below, TURNS - 1 - k);
        assert_int_equal(s.ring_rows[turns[k]], k < TURNS - 1 ? 3 : 0);
    }
    carried_out(&s);
    free(s.in_place.pairs);
    strips_finish(&s);
    free(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_there_when_they_are_looked_at),
        cmocka_unit_test(a_turn_is_one_row_behind_the_turn_before),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
