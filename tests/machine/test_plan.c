/* Tests the planner on hand-made graphs: a plan that is carried out stage by stage gives the
 * values that the graph defines. Needs no device. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/node_ops.h"
#include "hand_graph.h"
#include "plan/search_cost.h"
#include "plan/substitutes.h"

enum { GRAPHS = 300, HEIGHT = 5, WIDTH = 7, CELLS = HEIGHT * WIDTH, STAGES_MOST = 64 };

/* ---- what a graph says ---- */

/* Evaluates a graph on a small torus of processors; each has a number of at most 8 bits for
 * each node. */
struct evaluation {
    const struct plan_graph *g;
    uint8_t memory[HAND_NODES_MOST][CELLS]; /* leaves, numbers, and stored nodes */
    bool stored[HAND_NODES_MOST];
    /* of the stage at hand */
    uint8_t computed[HAND_NODES_MOST][CELLS];
    bool known[HAND_NODES_MOST][CELLS];
    int stage; /* -1: no node is in memory, and no node stands for another */
};

static int moved(int cell, int axis, int distance)
{
    int y = cell / WIDTH, x = cell % WIDTH;
    y = axis == 0 ? (y + distance + 2 * HEIGHT) % HEIGHT : y;
    x = axis == 1 ? (x + distance + 2 * WIDTH) % WIDTH : x;
    return y * WIDTH + x;
}

static int number_of(int op, int a, int b, int c)
{
    switch (op) {
    case MACHINE_NOT:
        return ~a;
    case MACHINE_AND:
        return a & b;
    case MACHINE_OR:
        return a | b;
    case MACHINE_XOR:
        return a ^ b;
    case MACHINE_ADD:
        return a + b;
    case MACHINE_SUB:
        return a - b;
    case MACHINE_ULT:
        return a < b;
    default:
        assert_int_equal(op, NODE_SELECT);
        return a ? b : c;
    }
}

static int value(struct evaluation *v, int node, int cell)
{
    const struct plan_node *n = &v->g->nodes[node];
    bool planned = v->stage >= 0, loads = planned && plan_loads(n, v->stage);
    if (n->leaf || n->constant || loads) {
        if (!v->stored[node])
            fail_msg("node %d is loaded in stage %d before it is stored", node, v->stage);
        return v->memory[node][cell];
    }
    if (v->known[node][cell])
        return v->computed[node][cell];
    int in[3] = {0}, r;
    if (n->op == NODE_SHIFT) {
        r = value(v, n->in[0], moved(cell, n->axis, n->detail));
    } else if (n->op == NODE_COORDINATE) {
        r = n->axis ? cell % WIDTH : cell / WIDTH;
    } else {
        for (int k = 0; k < node_ops[n->op].inputs; k++)
            in[k] = value(v, planned ? plan_input(v->g, n, k, v->stage) : n->in[k], cell);
        r = number_of(n->op, in[0], in[1], in[2]);
    }
    v->known[node][cell] = true;
    v->computed[node][cell] = (uint8_t)(r & ((1 << n->type.width) - 1));
    return v->computed[node][cell];
}

static void stage_begin(struct evaluation *v, int stage)
{
    v->stage = stage;
    memset(v->known, 0, sizeof v->known);
}

static void begin(struct evaluation *v, const struct plan_graph *g, struct hand_graph *h)
{
    memset(v, 0, sizeof *v);
    v->g = g;
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        int number = hand_below(h, 1 << n->type.width);
        v->stored[i] = n->leaf || n->constant;
        for (int cell = 0; cell < CELLS; cell++)
            v->memory[i][cell] =
                (uint8_t)(n->constant ? number : hand_below(h, 1 << n->type.width));
    }
    stage_begin(v, -1);
}

/* ---- graphs ---- */

static int like(struct hand_graph *h, int width, bool varies)
{
    for (int tries = 0; tries < 30; tries++) {
        int back = 1 + hand_below(h, h->g.count < 12 ? h->g.count : 12);
        const struct plan_node *n = &h->nodes[h->g.count - back];
        if (n->type.width == width && !(varies && n->constant))
            return h->g.count - back;
    }
    return hand_leaf(h, MACHINE_UINT(width));
}

static void node_by_chance(struct hand_graph *h)
{
    static const int two[] = {MACHINE_AND, MACHINE_OR, MACHINE_XOR, MACHINE_ADD, MACHINE_SUB};
    int width = hand_below(h, 3) ? 1 : 8, a = like(h, width, true), b = like(h, width, false);
    switch (hand_below(h, 10)) {
    case 0:
        hand_coordinate(h, hand_below(h, 2), 8);
        break;
    case 1:
        hand_number(h, MACHINE_UINT(width));
        break;
    case 2:
    case 3:
        hand_shift(h, a, hand_below(h, 2), hand_below(h, 2) ? 1 : -1 - hand_below(h, 2));
        break;
    case 4:
        hand_node(h, MACHINE_NOT, MACHINE_UINT(width), a, 0, 0);
        break;
    case 5:
        hand_node(h, MACHINE_ULT, MACHINE_BIT, like(h, 8, true), like(h, 8, false), 0);
        break;
    case 6:
    case 7:
        hand_node(h, NODE_SELECT, MACHINE_UINT(width), like(h, 1, true), a, b);
        break;
    default:
        hand_node(h, two[width == 1 ? hand_below(h, 3) : hand_below(h, 5)], MACHINE_UINT(width),
                  a, b, 0);
        break;
    }
}

/* Adds two stores under one context c: a is stored where c holds, and a value computed from a
 * is stored there, too. */
static void context_by_chance(struct hand_graph *h)
{
    const struct machine_type byte = MACHINE_UINT(8);
    int c = like(h, 1, true), old = like(h, 8, false);
    int a = hand_node(h, MACHINE_ADD, byte, like(h, 8, true), like(h, 8, false), 0);
    int kept = hand_node(h, NODE_SELECT, byte, c, a, old);
    int t = hand_node(h, MACHINE_XOR, byte, a, like(h, 8, false), 0);
    int under = hand_node(h, NODE_SELECT, byte, c, t, hand_below(h, 2) ? kept : old);
    h->nodes[kept].target = hand_below(h, 8) == 0;
    h->nodes[under].target = hand_below(h, 8) == 0;
}

/* Makes a random graph; dead: keeps nodes that no target needs. */
static void graph(struct hand_graph *h, uint32_t seed, bool dead)
{
    hand_begin(h, seed);
    for (int i = 0; i < 4; i++)
        hand_leaf(h, MACHINE_UINT(i & 1 ? 8 : 1));
    int last = 20 + hand_below(h, 160), targets = 1 + hand_below(h, 5);
    while (h->g.count < last)
        if (hand_below(h, 6))
            node_by_chance(h);
        else
            context_by_chance(h);
    for (int i = h->g.count - 1; i >= 0 && targets; i--)
        if (!h->nodes[i].leaf && !h->nodes[i].constant && hand_below(h, 3) == 0) {
            h->nodes[i].target = true;
            targets--;
        }
    if (!dead)
        hand_prune(h);
}

static struct device_shape shape_for(uint32_t seed, bool strips)
{
    struct device_shape shape = hand_shape();
    shape.op_ns = seed % 3 ? 0.1 : 5; /* costly: more nodes are stored */
    shape.launch_ns = seed % 2 ? 500 : 5000;
    shape.always_strips = strips;
    return shape;
}

/* ---- plans ---- */

static void sensible(const struct plan_graph *g, int *stages)
{
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        if (n->leaf || n->constant) {
            assert_false(n->stored && !n->target);
            continue;
        }
        if (n->target)
            assert_true(n->stored);
        if (n->stored) {
            assert_in_range(n->stage, 0, STAGES_MOST);
            widen(stages, n->stage + 1);
        }
    }
    assert_true(g->cost_ns > 0 && g->cost_ns < IMPOSSIBLE);
    const struct machine_explained_plan *p = &g->considered;
    assert_true(fabs(p->cost_s[p->chosen] * 1e9 - g->cost_ns) <= 1e-6 * g->cost_ns);
    for (int way = 0; way < MACHINE_PLAN_WAYS; way++)
        assert_true(p->forced || p->cost_s[way] <= 0 ||
                    p->cost_s[way] >= p->cost_s[p->chosen] * (1 - 1e-9));
    assert_int_equal(g->strips, p->chosen == MACHINE_PLAN_STRIPS);
    double kernels_ns = 0; /* in rows a plan of one VP set has one kernel for each stage */
    for (int stage = 0; stage < *stages && !g->strips; stage++)
        for (int i = 0, found = 0; i < g->count && !found; i++)
            if (g->nodes[i].stored && g->nodes[i].stage == stage) {
                kernels_ns += g->nodes[i].kernel_ns;
                found = 1;
            }
    assert_true(g->strips || fabs(kernels_ns - g->cost_ns) <= 1e-6 * g->cost_ns);
    assert_true(g->turns_most >= 1);
}

static void carried_out(struct evaluation *v, const struct evaluation *said, int stages)
{
    for (int stage = 0; stage < stages; stage++) {
        stage_begin(v, stage);
        for (int i = 0; i < v->g->count; i++) {
            const struct plan_node *n = &v->g->nodes[i];
            if (!n->stored || n->leaf || n->constant || n->stage != stage)
                continue;
            for (int cell = 0; cell < CELLS; cell++)
                v->memory[i][cell] = (uint8_t)value(v, i, cell);
        }
        for (int i = 0; i < v->g->count; i++)
            v->stored[i] =
                v->stored[i] || (v->g->nodes[i].stored && v->g->nodes[i].stage == stage);
    }
    for (int i = 0; i < v->g->count; i++)
        if (v->g->nodes[i].target)
            assert_memory_equal(v->memory[i], said->memory[i], CELLS);
}

/* Evaluates the targets into said->memory. */
static void say(struct evaluation *said)
{
    for (int i = 0; i < said->g->count; i++)
        if (said->g->nodes[i].target)
            for (int cell = 0; cell < CELLS; cell++)
                said->memory[i][cell] = (uint8_t)value(said, i, cell);
}

static void plans_compute_what_the_graph_says(void **state)
{
    (void)state;
    static const int dimensions[] = {600, 960};
    struct hand_graph *h = malloc(sizeof *h);
    struct evaluation *v = malloc(sizeof *v), *said = malloc(sizeof *said);
    int several = 0, strips = 0, instead = 0;
    assert_true(h && v && said);
    for (uint32_t seed = 1; seed <= GRAPHS; seed++) {
        graph(h, seed, false);
        struct device_shape shape = shape_for(seed, seed & 4);
        struct vpset sets[2] = {{0}, hand_set(2, dimensions, shape.halo)};
        int stages = 0;
        h->g.no_strips = !(seed & 4);
        begin(v, &h->g, h);
        *said = *v;
        say(said);
        plan_choose(&h->g, sets, &shape);
        sensible(&h->g, &stages);
        carried_out(v, said, stages);
        several += stages > 1;
        strips += h->g.strips;
        for (int i = 0; i < h->g.count; i++)
            for (int k = 0; k < 3; k++)
                instead += h->nodes[i].instead[k] >= 0;
    }
    assert_true(several > GRAPHS / 5);
    assert_true(strips > GRAPHS / 20);
    assert_true(instead > GRAPHS);
    free(h);
    free(v);
    free(said);
}

static void the_same_graph_has_the_same_plan(void **state)
{
    (void)state;
    static const int dimensions[] = {600, 960};
    struct hand_graph *h = malloc(sizeof *h), *again = malloc(sizeof *again);
    assert_true(h && again);
    for (uint32_t seed = 1; seed <= 40; seed++) {
        struct device_shape shape = shape_for(seed, false);
        struct vpset sets[2] = {{0}, hand_set(2, dimensions, shape.halo)};
        graph(h, seed, false);
        graph(again, seed, false);
        plan_choose(&h->g, sets, &shape);
        plan_choose(&again->g, sets, &shape);
        for (int i = 0; i < h->g.count; i++) {
            assert_int_equal(h->nodes[i].stored, again->nodes[i].stored);
            if (h->nodes[i].stored)
                assert_int_equal(h->nodes[i].stage, again->nodes[i].stage);
        }
    }
    free(h);
    free(again);
}

/* ---- nodes that stand for others ---- */

/* The targets' values do not change when every possible substitute is in memory, also beside
 * nodes that no target needs. */
static void substitutes_change_no_target(void **state)
{
    (void)state;
    struct hand_graph *h = malloc(sizeof *h);
    struct evaluation *v = malloc(sizeof *v), *said = malloc(sizeof *said);
    int stood = 0;
    assert_true(h && v && said);
    for (uint32_t seed = 1; seed <= GRAPHS; seed++) {
        graph(h, seed + 5000, true);
        begin(v, &h->g, h);
        *said = *v;
        substitutes_find(&h->g);
        say(said);
        /* Every node that may stand for another is put into memory. */
        for (int i = 0; i < h->g.count; i++)
            for (int k = 0; k < 3; k++) {
                int s = h->nodes[i].instead[k];
                if (s < 0)
                    continue;
                stood++;
                assert_int_equal(h->nodes[s].op, NODE_SELECT);
                assert_int_equal(h->nodes[s].in[1], h->nodes[i].in[k]);
                for (int cell = 0; cell < CELLS; cell++)
                    v->memory[s][cell] = (uint8_t)value(said, s, cell);
                v->stored[s] = h->nodes[s].stored = true;
            }
        stage_begin(v, 1);
        for (int i = 0; i < h->g.count; i++)
            if (h->nodes[i].target && !h->nodes[i].stored)
                for (int cell = 0; cell < CELLS; cell++)
                    assert_int_equal(value(v, i, cell), said->memory[i][cell]);
    }
    assert_true(stood > GRAPHS);
    free(h);
    free(v);
    free(said);
}

/* select(c, a, b), which is stored, may stand for a wherever a's value matters only under c. */
static void a_select_stands_for_what_it_chose(void **state)
{
    (void)state;
    struct hand_graph *h = malloc(sizeof *h);
    assert_non_null(h);
    hand_begin(h, 3);
    const struct machine_type byte = MACHINE_UINT(8);
    int c = hand_leaf(h, MACHINE_BIT), x = hand_leaf(h, byte), old = hand_leaf(h, byte);
    int a = hand_node(h, MACHINE_NOT, byte, x, 0, 0);
    int kept = hand_node(h, NODE_SELECT, byte, c, a, old);
    int twice = hand_node(h, MACHINE_ADD, byte, a, a, 0);
    int under = hand_node(h, NODE_SELECT, byte, c, twice, old);
    int sum = hand_node(h, MACHINE_ADD, byte, a, x, 0);
    int nobody = hand_node(h, NODE_SELECT, byte, c, a, x);
    h->nodes[kept].target = h->nodes[under].target = h->nodes[sum].target = true;
    h->nodes[nobody].target = false;
    hand_prune(h);
    substitutes_find(&h->g);
    assert_int_equal(h->nodes[twice].instead[0], kept);
    assert_int_equal(h->nodes[twice].instead[1], kept);
    assert_int_equal(h->nodes[sum].instead[0], -1);
    assert_int_equal(h->nodes[kept].instead[1], -1);
    free(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plans_compute_what_the_graph_says),
        cmocka_unit_test(the_same_graph_has_the_same_plan),
        cmocka_unit_test(substitutes_change_no_target),
        cmocka_unit_test(a_select_stands_for_what_it_chose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
