/* search_cost.c - the cost of a choice of barriers: see choose.c. */
#include "plan/search_cost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/node_ops.h"
#include "base/types.h"
#include "plan/lanes.h"

static int offset_moved(struct search *s, int from, int axis, int distance)
{
    int wanted[MACHINE_AXES_MAX];
    memcpy(wanted, s->offsets[from], sizeof wanted);
    wanted[axis] += distance;
    for (int i = 0; i < s->offsets_count; i++)
        if (!memcmp(s->offsets[i], wanted, sizeof wanted))
            return i;
    if (s->offsets_count == OFFSETS_MAX) {
        s->too_much = true;
        return 0;
    }
    memcpy(s->offsets[s->offsets_count], wanted, sizeof wanted);
    return s->offsets_count++;
}

static bool visited(struct search *s, int node, int offset)
{
    uint32_t mask = s->visits_size - 1;
    uint32_t h = ((uint32_t)node * 0x9e3779b1u ^ (uint32_t)offset * 0x85ebca6bu) & mask;
    while (s->visits[h].stamp == s->stamp) {
        if (s->visits[h].node == node && s->visits[h].offset == offset)
            return true;
        h = (h + 1) & mask;
    }
    if (s->visits_count * 2 > s->visits_size) {
        s->too_much = true;
        return true;
    }
    s->visits[h] = (struct visit){s->stamp, node, offset};
    s->visits_count++;
    return false;
}

/* Arrays come from global memory once; of later stages, from a cache near. Those of earlier stages are in local memory. */
static void tile_loads(struct search *s, int index, int offset, int stage)
{
    const struct plan_node *n = &s->g->nodes[index];
    const int *at = s->offsets[offset];
    double bytes = (double)type_bytes(n->type);
    tiling_look(&s->tiling, (struct tile_look){.to = stage,
                                               .from = n->leaf ? -1 : n->stage,
                                               .left = -at[1],
                                               .right = at[1],
                                               .above = -at[0],
                                               .below = at[0]});
    if (!n->leaf) {
        s->near_bytes += bytes;
        widen(&s->tiling.arrays[s->array[index]].last, stage);
    } else if (s->loaded[index] <= s->cost_began) {
        s->bytes += bytes;
    } else if (s->loaded[index] < s->loads_stamp) {
        s->near_bytes += bytes;
    }
    s->loaded[index] = s->loads_stamp;
}

static void expand(struct search *s, int index, int offset, int stage)
{
    const struct plan_node *n = &s->g->nodes[index];
    if (n->constant || s->too_much || visited(s, index, offset))
        return;
    bool loads = plan_loads(n, stage);
    int lane = lanes_of_node(s->g, index, loads);
    s->lane = lane > s->lane ? lane : s->lane;
    if (loads) {
        s->operations += 1;
        if (s->tiles) {
            tile_loads(s, index, offset, stage);
        } else if (s->strips && !n->leaf) { /* in another row, from a ring: else in variables */
            bool first = s->loaded[index] != s->loads_stamp;
            if (s->offsets[offset][0]) {
                s->near_bytes += (first ? 2 : 1) * (double)type_bytes(n->type);
                s->loaded[index] = s->loads_stamp;
            }
        } else if (s->loaded[index] != s->loads_stamp) {
            s->loaded[index] = s->loads_stamp;
            s->bytes += (double)type_bytes(n->type);
        }
        return;
    }
    s->operations += node_cost(n->op, n->type);
    if (n->op == NODE_SHIFT) {
        const struct vpset *set = &s->sets[n->set];
        int moved = offset_moved(s, offset, n->axis, n->detail);
        if (n->axis == set->rank - 1 && set->halo &&
            abs(s->offsets[moved][n->axis]) > set->halo)
            s->too_much = true;
        expand(s, n->in[0], moved, stage);
        return;
    }
    for (int i = 0; i < node_ops[n->op].inputs; i++)
        expand(s, plan_input(s->g, n, i, stage), offset, stage);
}

int cost_assign(struct search *s)
{
    struct plan_graph *g = s->g;
    int last = 0;
    for (int i = 0; i < g->count; i++) {
        struct plan_node *n = &g->nodes[i];
        int earliest = 0;
        if (!n->leaf && !n->constant)
            for (int k = 0; k < node_ops[n->op].inputs; k++) {
                int in = s->earliest[n->in[k]] + (s->barrier[i] ? 1 : 0);
                earliest = in > earliest ? in : earliest;
            }
        s->earliest[i] = earliest;
        last = earliest > last ? earliest : last;
        n->stage = n->target ? earliest : last + 1; /* others: when first needed, see below */
        n->stored = n->target;
    }
    for (int i = g->count - 1; i >= 0; i--) {
        struct plan_node *n = &g->nodes[i];
        if (n->leaf || n->constant)
            continue;
        if (n->stage > last)
            n->stage = s->earliest[i];
        for (int k = 0; k < node_ops[n->op].inputs; k++) {
            struct plan_node *in = &g->nodes[n->in[k]];
            int needed = n->stage - (s->barrier[i] ? 1 : 0);
            if (!in->target && !in->leaf && !in->constant && needed < in->stage)
                in->stage = needed;
        }
    }
    /* Now all stages are known. Values that later kernels need are stored: first those that
     * neighbours load; then the others, unless another stored value can replace them. */
    for (int pass = 0; pass < 2; pass++)
        for (int i = g->count - 1; i >= 0; i--) {
            const struct plan_node *n = &g->nodes[i];
            if (n->leaf || n->constant || (pass == 0) != s->barrier[i])
                continue;
            for (int k = 0; k < node_ops[n->op].inputs; k++) {
                struct plan_node *in = &g->nodes[n->in[k]];
                bool computed_anywhere =
                    in->leaf || in->constant || s->light[n->in[k]] || s->barrier[n->in[k]];
                const struct plan_node *other =
                    n->instead[k] >= 0 ? &g->nodes[n->instead[k]] : NULL;
                bool replaced = other && other->stored && other->stage < n->stage;
                if (!computed_anywhere && n->stage > in->stage && !replaced)
                    in->stored = true;
            }
        }
    return last;
}

/* The time of computing and moving, which overlap in part. */
static double time_of(const struct search *s, const struct vpset *set)
{
    double op_ns = s->shape->op_ns * (s->shape->narrow ? (double)s->lane / LANE_WIDE : 1),
           c = s->operations * op_ns + s->near_bytes * s->shape->near_byte_ns,
           b = s->bytes * s->shape->byte_ns;
    return (double)set->count * (fmax(c, b) + fmin(c, b) / 4) + s->shape->launch_ns;
}

/* A kernel in rows. */
static double kernel_time(struct search *s, const struct vpset *on, int stage, uint16_t set)
{
    double ns = time_of(s, on);
    for (int i = 0; s->decided && i < s->g->count; i++) {
        struct plan_node *n = &s->g->nodes[i];
        if (n->stored && n->stage == stage && n->set == set)
            n->kernel_ns = ns;
    }
    return ns;
}

/* What a stage of tiles stores: in global memory, and in local memory if a later one is going to look at it, which is known
 * when all are done. */
static void tile_stores(struct search *s, int node, double bytes)
{
    const struct plan_node *n = &s->g->nodes[node];
    s->array[node] = tiling_array(&s->tiling, (struct tile_array){.bytes = (int)bytes,
                                                                  .stage = n->stage,
                                                                  .last = n->stage,
                                                                  .stays = n->target});
    s->tiling.stored_ns += n->target ? bytes * s->shape->byte_ns : 0;
}

static void tile_stage_ends(struct search *s, int stage)
{
    struct tile_stage *t = &s->tiling.stages[stage];
    t->ns = s->operations * s->shape->op_ns + s->near_bytes * s->shape->near_byte_ns;
    t->far_ns = s->bytes * s->shape->byte_ns;
    s->operations = s->bytes = s->near_bytes = 0;
    s->loads_stamp++;
}

static double tiles_time(struct search *s, const struct vpset *set)
{
    struct tiling *t = &s->tiling;
    for (int i = 0; i < t->arrays_count; i++)
        if (t->arrays[i].last > t->arrays[i].stage)
            t->stages[t->arrays[i].stage].ns += t->arrays[i].bytes * s->shape->near_byte_ns;
    tiling_extents(t);
    return tiles_choose(t, set, s->shape, false) ? t->ns : s->first ? IMPOSSIBLE : HUGE_VAL;
}

double cost_of(struct search *s)
{
    struct plan_graph *g = s->g;
    int last = cost_assign(s);
    double total = 0;
    if (s->tiles)
        tiling_begin(&s->tiling, last + 1);
    s->cost_began = s->loads_stamp;
    s->too_much = false;
    s->operations = s->bytes = s->near_bytes = 0;
    s->lane = 0;
    s->loads_stamp++;
    const struct vpset *only = NULL;
    for (int stage = 0; stage <= last; stage++) {
        uint16_t sets_done[64];
        int sets_count = 0;
        for (int i = 0; i < g->count; i++) {
            if (!g->nodes[i].stored || g->nodes[i].stage != stage)
                continue;
            bool done = false;
            for (int k = 0; k < sets_count; k++)
                done = done || sets_done[k] == g->nodes[i].set;
            if (done || sets_count == 64)
                continue;
            uint16_t set = g->nodes[i].set;
            sets_done[sets_count++] = set;
            only = &s->sets[set];
            s->stamp++;
            s->visits_count = 0;
            s->offsets_count = 1;
            if (!s->strips) {
                s->operations = s->bytes = 0;
                s->lane = 0;
                s->loads_stamp++;
            }
            for (int k = i; k < g->count; k++)
                if (g->nodes[k].stored && g->nodes[k].stage == stage &&
                    g->nodes[k].set == set) {
                    double bytes = (double)type_bytes(g->nodes[k].type);
                    if (s->tiles)
                        tile_stores(s, k, bytes);
                    else if (g->nodes[k].target || !s->strips)
                        s->bytes += bytes;
                    s->operations += g->nodes[k].target || !s->strips;
                    expand(s, k, 0, stage);
                }
            if (s->too_much || s->visits_count > EVALUATIONS_MAX)
                return s->first ? IMPOSSIBLE : HUGE_VAL;
            if (s->tiles)
                tile_stage_ends(s, stage);
            else if (!s->strips)
                total += kernel_time(s, only, stage, set);
        }
    }
    if (s->tiles && only)
        return tiles_time(s, only);
    return s->strips && only ? time_of(s, only) : total;
}

void cost_find_light(struct search *s, double *weight)
{
    for (int i = 0; i < s->g->count; i++) {
        const struct plan_node *n = &s->g->nodes[i];
        weight[i] = n->constant ? 0 : n->leaf ? 1 : node_cost(n->op, n->type);
        s->light[i] = n->constant || n->leaf;
        if (s->light[i])
            continue;
        bool light = true;
        for (int k = 0; k < node_ops[n->op].inputs; k++) {
            weight[i] += weight[n->in[k]];
            light = light && s->light[n->in[k]];
        }
        s->light[i] = (light && weight[i] <= LIGHT) || n->generator <= GENERATOR_CHEAP;
    }
}
