/* choose.c - chooses which values are stored in memory, and which are computed again for
 * neighbours.
 *
 * Input: the values to evaluate and all they need, down to what is in memory. Between a value
 * and a shift of it there may be a *barrier*: the value is stored by one kernel and its
 * neighbours' are loaded by a later one. Without a barrier the neighbour's value is computed
 * again, at an offset, in the same kernel. A value's *stage* is the number of barriers before
 * it; the stored values of one stage and VP set are one kernel.
 *
 *     water --shift--> ... flux ==barrier?== shift --> new water        stage 0 | stage 1
 *
 * A cross loads what is in memory, so there is a barrier between it and a value that is
 * computed, always.
 *
 * The cost of a choice is estimated as
 *
 *     for each kernel: N * (max(c, b) + min(c, b) / 4) + launch
 *     c = op_ns * operations, b = byte_ns * bytes
 *
 * with operations counted for each (node, offset) pair that the kernel evaluates (op_ns is less
 * where lanes are narrow), and bytes for each array that it reads or writes. The search begins
 * with a barrier at every shift of a computed value, and removes one after the other if that is
 * cheaper. Measured constants: device/costs_by_driver.c. All stages may be one kernel of
 * strips, or of tiles, whose time is that of tiles.c.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/node_ops.h"
#include "plan/plans_compared.h"
#include "plan/search_cost.h"
#include "plan/substitutes.h"

struct gain {
    int node;
    double cost;
};

static int by_cost(const void *a, const void *b)
{
    const struct gain *x = a, *y = b;
    return x->cost < y->cost ? -1 : x->cost > y->cost ? 1 : x->node - y->node;
}

static bool is_stopped(const struct search *s)
{
    return s->g->stop && atomic_load_explicit(s->g->stop, memory_order_relaxed);
}

/* Twice, tries each remaining barrier, and removes them in the order of the expected gain. If
 * the first time removes none, the second would try the same again. */
static double descend(struct search *s, double best)
{
    struct gain *gains = malloc(((size_t)s->shifts_count + 1) * sizeof *gains);
    NEEDS_MEMORY(gains);
    bool changed = true;
    s->first = false;
    for (int round = 0; round < 2 && changed; round++) {
        int count = 0;
        changed = false;
        for (int k = 0; k < s->shifts_count; k++) {
            int i = s->shifts[k];
            if (!s->barrier[i] || is_stopped(s))
                continue;
            s->barrier[i] = false;
            gains[count++] = (struct gain){i, cost_of(s)};
            s->barrier[i] = true;
        }
        qsort(gains, (size_t)count, sizeof *gains, by_cost);
        for (int i = 0; i < count && !is_stopped(s); i++) {
            s->barrier[gains[i].node] = false;
            double c = cost_of(s);
            if (c < best) {
                best = c;
                changed = true;
            } else {
                s->barrier[gains[i].node] = true;
            }
        }
    }
    free(gains);
    return best;
}

/* Returns the VP set, if all nodes are of one set with two axes, in rows with halos (for
 * tiles without); or NULL. */
static const struct vpset *could_be_strips(const struct plan_graph *g, const struct vpset *sets,
                                           const struct device_shape *shape)
{
    uint16_t only = 0;
    if (shape->no_strips || (shape->vector < 2 && !shape->group))
        return NULL;
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        if ((n->op == NODE_GATHER || n->op == NODE_CROSS) && !n->leaf) /* it looks anywhere */
            return NULL;
        if (!n->set || (n->constant && !n->leaf))
            continue;
        if (only && n->set != only)
            return NULL;
        only = n->set;
    }
    if (!only || sets[only].rank != 2)
        return NULL;
    bool halos = sets[only].halo && sets[only].halo >= shape->vector;
    return halos == (shape->vector > 1) ? &sets[only] : NULL;
}

/* The number of turns of a loop with this graph that one kernel of strips can hold: all
 * together must read no further than the halos. Strips as wide as short rows have halos of
 * their own. */
static int turns_most(const struct plan_graph *g, const struct vpset *set,
                      const struct device_shape *shape)
{
    if (set->width <= shape->strip_least && set->width <= shape->strip_columns)
        return 2 * shape->turns;
    int(*reach)[2] = calloc((size_t)g->count, sizeof *reach),
    most = 1; /* to the left, to the right */
    NEEDS_MEMORY(reach);
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        for (int k = 0; !n->leaf && k < node_ops[n->op].inputs; k++)
            for (int side = 0; side < 2; side++) {
                int far = reach[n->in[k]][side];
                if (n->op == NODE_SHIFT && n->axis == 1)
                    far += side ? n->detail : -n->detail;
                reach[i][side] = far > reach[i][side] ? far : reach[i][side];
            }
        most = reach[i][0] > most ? reach[i][0] : most;
        most = reach[i][1] > most ? reach[i][1] : most;
    }
    free(reach);
    return shape->halo / most;
}

/* Puts a barrier at each shift of a value that must be computed. */
static double barriers_everywhere(struct search *s)
{
    for (int k = 0; k < s->shifts_count; k++)
        s->barrier[s->shifts[k]] = !s->light[s->g->nodes[s->shifts[k]].in[0]];
    s->first = true;
    return cost_of(s);
}

void plan_choose(struct plan_graph *g, const struct vpset *sets,
                 const struct device_shape *shape)
{
    size_t count = (size_t)g->count;
    struct search s = {.g = g, .sets = sets, .shape = shape};
    bool *barrier = calloc(count, sizeof *barrier);
    NEEDS_MEMORY(barrier);
    substitutes_find(g);
    search_begin(&s);
    double all = barriers_everywhere(&s), best = descend(&s, all);
    plan_compared(g, MACHINE_PLAN_STORED, all);
    plan_compared(g, MACHINE_PLAN_ROWS, best);
    const struct vpset *could = could_be_strips(g, sets, shape);
    bool tiles = could && shape->vector < 2;
    g->turns_most = !could ? 1 : tiles ? 2 * shape->turns : turns_most(g, could, shape);
    if (could && !g->no_strips) {
        memcpy(barrier, s.barrier, count * sizeof *barrier);
        s.strips = true;
        s.tiles = tiles;
        double strips = descend(&s, barriers_everywhere(&s));
        enum machine_plan_way way = tiles ? MACHINE_PLAN_TILES : MACHINE_PLAN_STRIPS;
        plan_compared(g, way, strips);
        if (tiles) {
            cost_of(&s); /* the last one tried may not have been the best */
            g->turns_most =
                strips < IMPOSSIBLE ? tiles_turns(&s.tiling, could, shape, best) : 1;
        }
        g->strips = cost_assign(&s) > 0 && (!tiles || strips < IMPOSSIBLE) &&
                    (strips < best || shape->always_strips);
        if (g->strips) {
            g->considered.chosen = way;
            g->considered.forced = strips >= best;
        } else {
            s.strips = s.tiles = false;
            memcpy(s.barrier, barrier, count * sizeof *barrier);
        }
    }
    s.decided = true;
    g->cost_ns = cost_of(&s);
    search_finish(&s);
    free(barrier);
}
