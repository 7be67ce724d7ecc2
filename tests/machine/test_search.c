/* Tests the cost of a choice of barriers against a slow twin, which follows the definitions
 * stage by stage, over generated graphs and barriers: the same stages, the same stored values,
 * and the same cost to the bit. Needs no device. */
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
#include "plan/lanes.h"
#include "plan/search_cost.h"
#include "plan/substitutes.h"

enum { GRAPHS = 400, BARRIERS_EACH = 6, PAIRS_MOST = EVALUATIONS_MAX + 1, SETS = 3 };

/* A node where it is looked at, at an offset along each axis. */
struct pair {
    int node, offset[MACHINE_AXES_MAX];
};

struct twin {
    struct plan_graph g; /* nodes of its own */
    const struct search *s;
    int *earliest, last;
    /* of the kernel at hand */
    struct pair pairs[PAIRS_MOST];
    int pairs_count, lane;
    bool too_much;
    bool *loaded; /* in strips: of all stages */
    double operations, bytes, near_bytes;
};

static int inputs_of(const struct plan_node *n)
{
    return n->leaf || n->constant ? 0 : node_ops[n->op].inputs;
}

/* ---- stages, and what is stored ---- */

static void twin_stages(struct twin *t)
{
    struct plan_node *nodes = t->g.nodes;
    int so_far[HAND_NODES_MOST];
    t->last = 0;
    for (int i = 0; i < t->g.count; i++) {
        t->earliest[i] = 0;
        for (int k = 0; k < inputs_of(&nodes[i]); k++)
            widen(&t->earliest[i], t->earliest[nodes[i].in[k]] + t->s->barrier[i]);
        widen(&t->last, t->earliest[i]);
        so_far[i] = t->last + 1;
    }
    /* As late as the first that needs it, and as early as it must. */
    for (int i = t->g.count - 1; i >= 0; i--) {
        struct plan_node *n = &nodes[i];
        n->stage = n->target ? t->earliest[i] : so_far[i];
        for (int user = i + 1; user < t->g.count && !n->target; user++)
            for (int k = 0; k < inputs_of(&nodes[user]); k++)
                if (nodes[user].in[k] == i &&
                    nodes[user].stage - t->s->barrier[user] < n->stage)
                    n->stage = nodes[user].stage - t->s->barrier[user];
        if (n->stage > t->last)
            n->stage = t->earliest[i];
        n->stored = n->target;
    }
}

static void twin_stores(struct twin *t)
{
    struct plan_node *nodes = t->g.nodes;
    for (int pass = 0; pass < 2; pass++)
        for (int i = t->g.count - 1; i >= 0; i--)
            for (int k = 0; k < inputs_of(&nodes[i]); k++) {
                struct plan_node *in = &nodes[nodes[i].in[k]];
                const int instead = nodes[i].instead[k];
                bool replaced = instead >= 0 && nodes[instead].stored &&
                                nodes[instead].stage < nodes[i].stage;
                if ((pass == 0) == t->s->barrier[i] && !in->leaf && !in->constant &&
                    !t->s->light[nodes[i].in[k]] && !t->s->barrier[nodes[i].in[k]] &&
                    nodes[i].stage > in->stage && !replaced)
                    in->stored = true;
            }
}

/* ---- cost ---- */

static void twin_walk(struct twin *t, struct pair at, int stage)
{
    const struct plan_node *n = &t->g.nodes[at.node];
    const struct vpset *set = &t->s->sets[n->set];
    if (n->constant || t->too_much)
        return;
    for (int i = 0; i < t->pairs_count; i++)
        if (!memcmp(&t->pairs[i], &at, sizeof at))
            return;
    t->pairs[t->pairs_count++] = at;
    t->too_much = t->pairs_count > EVALUATIONS_MAX;
    const bool loads = plan_loads(n, stage);
    widen(&t->lane, lanes_of_node(&t->g, at.node, loads));
    if (loads) {
        const double bytes = (double)type_bytes(n->type);
        t->operations += 1;
        if (t->s->strips && !n->leaf) {
            t->near_bytes += at.offset[0] ? (t->loaded[at.node] ? 1 : 2) * bytes : 0;
            t->loaded[at.node] = t->loaded[at.node] || at.offset[0];
        } else {
            t->bytes += t->loaded[at.node] ? 0 : bytes;
            t->loaded[at.node] = true;
        }
        return;
    }
    t->operations += node_cost(n->op, n->type);
    if (n->op == NODE_SHIFT) {
        at.offset[n->axis] += n->detail;
        t->too_much |=
            (n->axis == set->rank - 1 && set->halo && abs(at.offset[n->axis]) > set->halo);
    }
    for (int k = 0; k < node_ops[n->op].inputs; k++) {
        at.node = n->op == NODE_SHIFT ? n->in[0] : plan_input(&t->g, n, k, stage);
        twin_walk(t, at, stage);
    }
}

static double twin_time(const struct twin *t, const struct vpset *set)
{
    const struct device_shape *shape = t->s->shape;
    double op_ns = shape->op_ns * (shape->narrow ? (double)t->lane / LANE_WIDE : 1),
           c = t->operations * op_ns + t->near_bytes * shape->near_byte_ns,
           b = t->bytes * shape->byte_ns;
    return (double)set->count * (fmax(c, b) + fmin(c, b) / 4) + shape->launch_ns;
}

static void twin_kernel_begins(struct twin *t)
{
    t->operations = t->bytes = t->near_bytes = 0;
    t->lane = 0;
    memset(t->loaded, 0, (size_t)t->g.count * sizeof *t->loaded);
}

static double twin_cost(struct twin *t)
{
    double total = 0;
    const struct vpset *only = NULL;
    t->too_much = false;
    twin_kernel_begins(t);
    for (int stage = 0; stage <= t->last; stage++) {
        bool done[SETS] = {false};
        for (int i = 0; i < t->g.count; i++) {
            const uint16_t set = t->g.nodes[i].set;
            if (!t->g.nodes[i].stored || t->g.nodes[i].stage != stage || done[set])
                continue;
            done[set] = true;
            only = &t->s->sets[set];
            t->pairs_count = 0;
            if (!t->s->strips)
                twin_kernel_begins(t);
            for (int k = i; k < t->g.count; k++) {
                const struct plan_node *n = &t->g.nodes[k];
                if (!n->stored || n->stage != stage || n->set != set)
                    continue;
                if (n->target || !t->s->strips) {
                    t->bytes += (double)type_bytes(n->type);
                    t->operations += 1;
                }
                twin_walk(t, (struct pair){.node = k}, stage);
            }
            if (t->too_much)
                return HUGE_VAL;
            total += t->s->strips ? 0 : twin_time(t, only);
        }
    }
    return t->s->strips && only ? twin_time(t, only) : total;
}

/* ---- both ---- */

static void compare(struct twin *t, struct search *s)
{
    const double cost = cost_of(s);
    twin_stages(t);
    twin_stores(t);
    for (int i = 0; i < t->g.count; i++) {
        const struct plan_node *n = &s->g->nodes[i], *other = &t->g.nodes[i];
        assert_int_equal(n->stored, other->stored);
        if (!n->leaf && !n->constant)
            assert_int_equal(n->stage, other->stage);
    }
    const double should = twin_cost(t);
    assert_memory_equal(&cost, &should, sizeof cost);
}

/* Fields that operations change one after the other, and neighbours read: many stages. */
static void steps_by_chance(struct hand_graph *h, int rank)
{
    enum { FIELDS = 5 };
    const struct machine_type byte = MACHINE_UINT(hand_below(h, 2) ? 8 : 32);
    int fields[FIELDS], steps = 20 + hand_below(h, 250), distance = 1 + hand_below(h, 3);
    for (int i = 0; i < FIELDS; i++)
        fields[i] = hand_leaf(h, byte);
    while (steps--) {
        int a = fields[hand_below(h, FIELDS)], b = fields[hand_below(h, FIELDS)], made;
        switch (hand_below(h, 4)) {
        case 0:
            made = hand_shift(h, a, hand_below(h, rank), hand_below(h, 2) ? distance : -1);
            break;
        case 1:
            made = hand_node(h, NODE_SELECT, byte,
                             hand_node(h, MACHINE_ULT, MACHINE_BIT, a, b, 0), a, b);
            break;
        default:
            made = hand_node(h, MACHINE_ADD, byte, a, b, 0);
        }
        fields[hand_below(h, FIELDS)] = made;
    }
    for (int i = 0; i < FIELDS; i++)
        h->nodes[fields[i]].target = !h->nodes[fields[i]].leaf;
}

static void shifts_cross(struct search *s, struct hand_graph *h, int of)
{
    for (int i = 0; i < s->g->count; i++)
        s->barrier[i] = s->g->nodes[i].op == NODE_SHIFT && !s->g->nodes[i].leaf &&
                        !s->light[s->g->nodes[i].in[0]] && hand_below(h, of) > 0;
}

static void costs_are_those_of_the_twin(void **state)
{
    (void)state;
    static const int wide[] = {60, 96}, deep[] = {10, 60, 96};
    struct hand_graph *h = malloc(sizeof *h);
    struct twin *t = calloc(1, sizeof *t);
    assert_true(h && t);
    int several = 0, fits = 0;
    for (uint32_t seed = 1; seed <= GRAPHS; seed++) {
        const bool flat = seed % 4 != 3;
        hand_begin(h, seed);
        if (seed % 3)
            steps_by_chance(h, flat ? 2 : 3);
        else
            hand_by_chance(h, 20 + hand_below(h, 340), flat ? 2 : 3);
        for (int i = 0; i < h->g.count; i++) /* most of it is wanted */
            h->nodes[i].target |= inputs_of(&h->nodes[i]) && hand_below(h, 12) == 0;
        hand_prune(h);
        struct device_shape shape = hand_shape();
        struct vpset sets[SETS] = {{0},
                                   hand_set(flat ? 2 : 3, flat ? wide : deep, shape.halo),
                                   hand_set(flat ? 2 : 3, flat ? wide : deep, shape.halo)};
        for (int i = 0; i < h->g.count && seed % 5 == 0;
             i++) /* which sets does not matter here */
            h->nodes[i].set = h->nodes[i].set && hand_below(h, 2) ? 2 : h->nodes[i].set;
        struct search s = {
            .g = &h->g, .sets = sets, .shape = &shape, .strips = flat && seed % 2};
        substitutes_find(&h->g);
        search_begin(&s);
        *t = (struct twin){.g = {.nodes = malloc(sizeof h->nodes), .count = h->g.count},
                           .s = &s,
                           .earliest = calloc(HAND_NODES_MOST, sizeof(int)),
                           .loaded = calloc(HAND_NODES_MOST, sizeof(bool))};
        memcpy(t->g.nodes, h->nodes, sizeof h->nodes);
        for (int i = 0; i < BARRIERS_EACH; i++) {
            shifts_cross(&s, h, i + 1);
            compare(t, &s);
            several += t->last > 2;
            fits += cost_of(&s) < HUGE_VAL;
        }
        search_finish(&s);
        free(t->g.nodes);
        free(t->earliest);
        free(t->loaded);
    }
    assert_true(several > GRAPHS);
    assert_true(fits > GRAPHS);
    free(h);
    free(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(costs_are_those_of_the_twin)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
