/* search_cost.c - the cost of a choice of barriers: see choose.c. */
#include "plan/search_cost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
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

/* Arrays come from global memory once; of later stages, from a cache near. Those of earlier
 * stages are in local memory. */
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
    const struct search_node *f = &s->facts[index];
    if (n->constant || s->too_much || visited(s, index, offset))
        return;
    bool loads = plan_loads(n, stage);
    widen(&s->lane, loads ? f->lane_loaded : f->lane_computed);
    if (loads) {
        s->operations += 1;
        if (s->tiles) {
            tile_loads(s, index, offset, stage);
        } else if (s->strips && !n->leaf) { /* in another row, from a ring: else in variables */
            bool first = s->loaded[index] != s->loads_stamp;
            if (s->offsets[offset][0]) {
                s->near_bytes += (first ? 2 : 1) * (double)f->bytes;
                s->loaded[index] = s->loads_stamp;
            }
        } else if (s->loaded[index] != s->loads_stamp) {
            s->loaded[index] = s->loads_stamp;
            s->bytes += (double)f->bytes;
        }
        return;
    }
    s->operations += f->operations;
    if (n->op == NODE_SHIFT) {
        const struct vpset *set = &s->sets[n->set];
        int moved = offset_moved(s, offset, n->axis, n->detail);
        if (n->axis == set->rank - 1 && set->halo &&
            abs(s->offsets[moved][n->axis]) > set->halo)
            s->too_much = true;
        expand(s, n->in[0], moved, stage);
        return;
    }
    for (int i = 0; i < f->inputs; i++)
        expand(s, plan_input(s->g, n, i, stage), offset, stage);
}

/* ---- stages ---- */

/* The stage before which a node's operands must be known. */
static int stage_before(const struct search *s, int node, int stage)
{
    return stage - (s->barrier[node] ? 1 : 0);
}

/* Values that a later kernel needs of this node's operands are stored, unless another stored
 * value can replace them. */
static void operands_store(struct search *s, int node)
{
    struct plan_graph *g = s->g;
    const struct plan_node *n = &g->nodes[node];
    for (int k = 0; k < s->facts[node].inputs; k++) {
        struct plan_node *in = &g->nodes[n->in[k]];
        if (n->stage <= in->stage || s->light[n->in[k]] || s->barrier[n->in[k]] || in->stored)
            continue; /* light: leaves and numbers, too */
        const struct plan_node *other = n->instead[k] >= 0 ? &g->nodes[n->instead[k]] : NULL;
        in->stored = !(other && other->stored && other->stage < n->stage);
    }
}

int cost_assign(struct search *s)
{
    struct plan_graph *g = s->g;
    int last = 0;
    for (int c = 0; c < s->computed_count; c++) {
        const int i = s->computed[c];
        struct plan_node *n = &g->nodes[i];
        int earliest = 0;
        for (int k = 0; k < s->facts[i].inputs; k++)
            widen(&earliest, s->earliest[n->in[k]]);
        earliest += s->barrier[i];
        s->earliest[i] = earliest;
        widen(&last, earliest);
        n->stage = n->target ? earliest : last + 1; /* others: when first needed, see below */
        n->stored = n->target;
    }
    for (int c = s->computed_count - 1; c >= 0; c--) {
        const int i = s->computed[c];
        struct plan_node *n = &g->nodes[i];
        if (n->stage > last)
            n->stage = s->earliest[i];
        const int needed = stage_before(s, i, n->stage);
        for (int k = 0; k < s->facts[i].inputs; k++) {
            struct plan_node *in = &g->nodes[n->in[k]];
            if (!in->target && needed < in->stage)
                in->stage = needed;
        }
    }
    for (int c = 0; c < s->crossed_count; c++)
        g->nodes[s->crossed[c]].stored = true;
    /* Now all stages are known. What neighbours load comes first, for it may replace others. */
    for (int c = s->shifts_count - 1; c >= 0; c--)
        if (s->barrier[s->shifts[c]])
            operands_store(s, s->shifts[c]);
    for (int c = s->computed_count - 1; c >= 0; c--)
        if (!s->barrier[s->computed[c]])
            operands_store(s, s->computed[c]);
    return last;
}

static void stages_list(struct search *s, int last)
{
    const struct plan_graph *g = s->g;
    int *begins = s->stages.begins;
    memset(begins, 0, ((size_t)last + 2) * sizeof *begins);
    for (int i = 0; i < g->count; i++)
        if (g->nodes[i].stored)
            begins[g->nodes[i].stage + 1]++;
    for (int stage = 0; stage <= last; stage++)
        begins[stage + 1] += begins[stage];
    const int all = begins[last + 1];
    for (int i = g->count - 1; i >= 0; i--)
        if (g->nodes[i].stored)
            s->stages.nodes[--begins[g->nodes[i].stage + 1]] = i;
    /* By now a stage begins where the one before it did. */
    memmove(begins, begins + 1, ((size_t)last + 1) * sizeof *begins);
    begins[last + 1] = all;
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

/* What a stage of tiles stores: in global memory, and in local memory if a later one is going
 * to look at it, which is known when all are done. */
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

/* ---- kernels ---- */

/* One kernel, or in strips and tiles a part of one: what is stored in that stage and VP set,
 * the first of it at `at` of the stage's list. False: too much for a kernel. */
static bool stage_of_set(struct search *s, int stage, int at)
{
    const struct plan_graph *g = s->g;
    const uint16_t set = g->nodes[s->stages.nodes[at]].set;
    s->stamp++;
    s->visits_count = 0;
    s->offsets_count = 1;
    if (!s->strips) {
        s->operations = s->bytes = 0;
        s->lane = 0;
        s->loads_stamp++;
    }
    for (int end = s->stages.begins[stage + 1]; at < end; at++) {
        const int k = s->stages.nodes[at];
        if (g->nodes[k].set != set)
            continue;
        const bool counts = g->nodes[k].target || !s->strips;
        if (s->tiles)
            tile_stores(s, k, s->facts[k].bytes);
        else if (counts)
            s->bytes += s->facts[k].bytes;
        s->operations += counts;
        expand(s, k, 0, stage);
    }
    return !s->too_much && s->visits_count <= EVALUATIONS_MAX;
}

/* Whether an earlier node of the stage's list has the set, and it is done. */
static bool set_is_done(const struct search *s, int stage, int at)
{
    const struct plan_graph *g = s->g;
    for (int k = s->stages.begins[stage]; k < at; k++)
        if (g->nodes[s->stages.nodes[k]].set == g->nodes[s->stages.nodes[at]].set)
            return true;
    return false;
}

double cost_of(struct search *s)
{
    const struct plan_graph *g = s->g;
    const int last = cost_assign(s);
    double total = 0;
    stages_list(s, last);
    if (s->tiles)
        tiling_begin(&s->tiling, last + 1);
    s->cost_began = s->loads_stamp;
    s->too_much = false;
    s->operations = s->bytes = s->near_bytes = 0;
    s->lane = 0;
    s->loads_stamp++;
    const struct vpset *only = NULL;
    for (int stage = 0; stage <= last; stage++)
        for (int at = s->stages.begins[stage]; at < s->stages.begins[stage + 1]; at++) {
            if (set_is_done(s, stage, at))
                continue;
            const uint16_t set = g->nodes[s->stages.nodes[at]].set;
            only = &s->sets[set];
            if (!stage_of_set(s, stage, at))
                return s->first ? IMPOSSIBLE : HUGE_VAL;
            if (s->tiles)
                tile_stage_ends(s, stage);
            else if (!s->strips)
                total += kernel_time(s, only, stage, set);
        }
    if (s->tiles && only)
        return tiles_time(s, only);
    return s->strips && only ? time_of(s, only) : total;
}

/* ---- the search ---- */

static void find_light(struct search *s)
{
    double *weight = calloc((size_t)s->g->count, sizeof *weight);
    NEEDS_MEMORY(weight);
    for (int i = 0; i < s->g->count; i++) {
        const struct plan_node *n = &s->g->nodes[i];
        weight[i] = n->constant ? 0 : n->leaf ? 1 : s->facts[i].operations;
        s->light[i] = n->constant || n->leaf;
        if (s->light[i])
            continue;
        bool light = true;
        for (int k = 0; k < s->facts[i].inputs; k++) {
            weight[i] += weight[n->in[k]];
            light = light && s->light[n->in[k]];
        }
        s->light[i] = (light && weight[i] <= LIGHT) || n->generator <= GENERATOR_CHEAP;
    }
    for (int c = 0; c < s->crossed_count; c++)
        s->light[s->crossed[c]] = false;
    free(weight);
}

static void find_facts(struct search *s)
{
    for (int i = 0; i < s->g->count; i++) {
        struct plan_node *n = &s->g->nodes[i];
        const bool given = n->leaf || n->constant;
        s->facts[i] =
            (struct search_node){.inputs = (uint8_t)(given ? 0 : node_ops[n->op].inputs),
                                 .bytes = (uint8_t)type_bytes(n->type),
                                 .lane_computed = (uint8_t)lanes_of_node(s->g, i, given),
                                 .lane_loaded = (uint8_t)lanes_of_node(s->g, i, true),
                                 .operations = node_cost(n->op, n->type)};
        n->stored = n->target;
        n->stage = 0;
        if (given)
            continue;
        s->computed[s->computed_count++] = i;
        if (n->op == NODE_SHIFT)
            s->shifts[s->shifts_count++] = i;
        s->barrier[i] = n->op == NODE_CROSS && !s->g->nodes[n->in[0]].leaf;
        if (s->barrier[i])
            s->crossed[s->crossed_count++] = n->in[0];
    }
}

void search_begin(struct search *s)
{
    const size_t count = (size_t)s->g->count;
    s->visits_size = 1024;
    while (s->visits_size < 4 * count + 4 * EVALUATIONS_MAX)
        s->visits_size *= 2;
    s->barrier = calloc(count, sizeof *s->barrier);
    s->light = calloc(count, sizeof *s->light);
    s->earliest = calloc(count, sizeof *s->earliest);
    s->facts = calloc(count, sizeof *s->facts);
    s->computed = calloc(count, sizeof *s->computed);
    s->shifts = calloc(count, sizeof *s->shifts);
    s->crossed = calloc(count, sizeof *s->crossed);
    s->stages.nodes = calloc(count, sizeof *s->stages.nodes);
    s->stages.begins = calloc(count + 2, sizeof *s->stages.begins);
    s->loaded = calloc(count, sizeof *s->loaded);
    s->visits = calloc(s->visits_size, sizeof *s->visits);
    s->offsets = calloc(OFFSETS_MAX, sizeof *s->offsets);
    s->array = calloc(count, sizeof *s->array);
    NEEDS_MEMORY(s->barrier && s->light && s->earliest && s->facts && s->computed &&
                 s->shifts && s->crossed && s->stages.nodes && s->stages.begins && s->loaded &&
                 s->visits && s->offsets && s->array);
    s->offsets_count = 1;
    find_facts(s);
    find_light(s);
}

void search_finish(struct search *s)
{
    free(s->barrier);
    free(s->light);
    free(s->earliest);
    free(s->facts);
    free(s->computed);
    free(s->shifts);
    free(s->crossed);
    free(s->stages.nodes);
    free(s->stages.begins);
    free(s->loaded);
    free(s->visits);
    free(s->offsets);
    free(s->array);
    tiling_finish(&s->tiling);
}
