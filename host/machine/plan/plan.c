/* plan.c - chooses what exists in memory, and what each neighbour computes again.
 *
 * Input: the values to evaluate and all they need, down to what is in memory. Between a value
 * and a shift of it there may be a *barrier*: the value is stored by one kernel and its
 * neighbours' are loaded by a later one. Without a barrier the neighbour's value is computed
 * again, at an offset, in the same kernel. A value's *stage* is the number of barriers before
 * it; the stored values of one stage and VP set are one kernel.
 *
 *     water --shift--> ... flux ==barrier?== shift --> new water        stage 0 | stage 1
 *
 * The cost of a choice is estimated as
 *
 *     for each kernel: N * (max(c, b) + min(c, b) / 4) + launch
 *     c = op_ns * operations, b = byte_ns * bytes
 *
 * with operations counted for each (node, offset) pair that the kernel evaluates (op_ns is less where lanes are narrow),
 * and bytes for each array that it reads or writes. The search begins with a barrier at every shift of a
 * computed value, and takes one after the other away if that is cheaper. Measured constants:
 * device.c. All stages may be one kernel of strips, or of tiles, whose time is that of tiles_size.c. */
#include "codegen/narrow.h"
#include "internal.h"
#include "plan/tiles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LIGHT = 8, EVALUATIONS_MAX = 1200, OFFSETS_MAX = 512 };
#define IMPOSSIBLE 1e300 /* cost of a plan that does until there is another */

struct visit {
    uint32_t stamp;
    int32_t node;
    int32_t offset;
};

struct search {
    struct plan_graph *g;
    const struct vpset *sets;
    const struct device_shape *shape;
    bool *barrier; /* of shift nodes */
    bool *light;   /* never stored: computed wherever it is needed */
    int *earliest;
    int *loaded, loads_stamp; /* stamp: counted in this kernel's bytes already */
    struct visit *visits;
    uint32_t visits_size, stamp, visits_count;
    /* offsets met: vectors of rank numbers */
    int (*offsets)[MACHINE_AXES_MAX];
    int offsets_count;
    bool strips; /* all stages in one kernel */
    bool tiles;  /* ... of tiles */
    struct tiling tiling;
    int *array;     /* of a node that is stored: in the tiling */
    int cost_began; /* loads_stamp then: what has a later one was loaded by some stage already */
    bool first;     /* the first plan must do, whatever it costs */
    double operations, bytes, near_bytes; /* near: of rings */
    int lane;                             /* the widest that the kernel needs; bits */
    bool too_much;
};

size_t type_bytes(struct machine_type type)
{
    return type.width <= 8    ? 1
           : type.width <= 16 ? 2
           : type.width <= 32 ? 4
           : type.width <= 64 ? 8
                              : 16;
}

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
    int lane = narrow_lane_of(s->g, index, loads);
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

/* Stages and what is stored, for the barriers as they are. Returns the last stage. */
static int assign(struct search *s)
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
    /* Now that all stages are known: who is needed by a later kernel is stored. First what
     * neighbours load; then the rest, unless something else that is stored will do instead. */
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

/* Computing and moving overlap in part. */
static double time_of(const struct search *s, const struct vpset *set)
{
    double op_ns = s->shape->op_ns * (s->shape->narrow ? (double)s->lane / LANE_WIDE : 1),
           c = s->operations * op_ns + s->near_bytes * s->shape->near_byte_ns,
           b = s->bytes * s->shape->byte_ns;
    return (double)set->count * (fmax(c, b) + fmin(c, b) / 4) + s->shape->launch_ns;
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

static double cost(struct search *s)
{
    struct plan_graph *g = s->g;
    int last = assign(s);
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
                total += time_of(s, only);
        }
    }
    if (s->tiles && only)
        return tiles_time(s, only);
    return s->strips && only ? time_of(s, only) : total;
}

static void find_light(struct search *s, double *weight)
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

/* Conditions that hold wherever a value is looked at, none of them an AND; of more than a few, some. */
enum { CONDITIONS = 8 };
struct conditions {
    int32_t of[CONDITIONS];
    int count; /* UNSEEN: nobody looks */
};

static bool is_and(const struct plan_graph *g, int32_t condition)
{
    return g->nodes[condition].op == MACHINE_AND && !g->nodes[condition].leaf;
}

static bool conditions_say(const struct plan_graph *g, const struct conditions *c,
                           int32_t condition)
{
    if (is_and(g, condition))
        return conditions_say(g, c, g->nodes[condition].in[0]) &&
               conditions_say(g, c, g->nodes[condition].in[1]);
    for (int i = 0; i < c->count; i++)
        if (c->of[i] == condition)
            return true;
    return false;
}

static void conditions_add(const struct plan_graph *g, struct conditions *c, int32_t condition)
{
    if (is_and(g, condition)) {
        conditions_add(g, c, g->nodes[condition].in[0]);
        conditions_add(g, c, g->nodes[condition].in[1]);
    } else if (c->count < CONDITIONS && !conditions_say(g, c, condition)) {
        c->of[c->count++] = condition;
    }
}

/* Where select(c, x, old) is stored, x itself need not be for those who look at it only where c holds. Looked at
 * only where c holds is what is used only for the first branch of selects by c. */
static void find_substitutes(struct plan_graph *g)
{
    enum { UNSEEN = -1 };
    struct conditions *where = malloc((size_t)g->count * sizeof *where);
    int32_t *select = malloc((size_t)g->count * sizeof *select); /* of a node: its select */
    INVARIANT(where && select);
    for (int i = 0; i < g->count; i++) {
        where[i].count = g->nodes[i].target ? 0 : UNSEEN;
        select[i] = -1;
        for (int k = 0; k < 3; k++)
            g->nodes[i].instead[k] = -1;
    }
    for (int i = g->count - 1; i >= 0; i--) {
        const struct plan_node *n = &g->nodes[i];
        for (int k = 0; !n->leaf && k < node_ops[n->op].inputs; k++) {
            struct conditions here = where[i], *w = &where[n->in[k]];
            if (n->op == NODE_SHIFT || here.count == UNSEEN)
                here.count = 0;
            if (n->op == NODE_SELECT && k == 1)
                conditions_add(g, &here, n->in[0]);
            if (w->count == UNSEEN) {
                *w = here;
                continue;
            }
            int kept = 0;
            for (int c = 0; c < w->count; c++)
                if (conditions_say(g, &here, w->of[c]))
                    w->of[kept++] = w->of[c];
            w->count = kept;
        }
        if (n->op == NODE_SELECT && !n->leaf)
            select[n->in[1]] = i;
    }
    for (int i = 0; i < g->count; i++) {
        struct plan_node *n = &g->nodes[i];
        for (int k = 0; !n->leaf && n->op != NODE_SHIFT && k < node_ops[n->op].inputs; k++) {
            int32_t s = select[n->in[k]];
            if (s < 0 || s == i)
                continue;
            int32_t condition = g->nodes[s].in[0];
            struct conditions here = where[i];
            if (n->op == NODE_SELECT && k == 1)
                conditions_add(g, &here, n->in[0]);
            if (conditions_say(g, &here, condition))
                n->instead[k] = s;
        }
    }
    free(where);
    free(select);
}

struct gain {
    int node;
    double cost;
};

static int by_cost(const void *a, const void *b)
{
    const struct gain *x = a, *y = b;
    return x->cost < y->cost ? -1 : x->cost > y->cost ? 1 : x->node - y->node;
}

/* Twice: tries each barrier that is left, and takes them away in the order of what that seemed
 * to gain. */
static double descend(struct search *s, double best)
{
    struct gain *gains = malloc((size_t)s->g->count * sizeof *gains);
    INVARIANT(gains != NULL);
    s->first = false;
    for (int round = 0; round < 2; round++) {
        int count = 0;
        for (int i = 0; i < s->g->count; i++) {
            if (!s->barrier[i])
                continue;
            s->barrier[i] = false;
            gains[count++] = (struct gain){i, cost(s)};
            s->barrier[i] = true;
        }
        qsort(gains, (size_t)count, sizeof *gains, by_cost);
        for (int i = 0; i < count; i++) {
            s->barrier[gains[i].node] = false;
            double c = cost(s);
            if (c < best)
                best = c;
            else
                s->barrier[gains[i].node] = true;
        }
    }
    free(gains);
    return best;
}

/* One VP set of two axes, in rows with halos (or without, for tiles): that; or NULL. */
static const struct vpset *could_be_strips(const struct plan_graph *g, const struct vpset *sets,
                                           const struct device_shape *shape)
{
    uint16_t only = 0;
    if (shape->no_strips || (shape->vector < 2 && !shape->group))
        return NULL;
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
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

/* How many turns of a loop with this graph can be one kernel of strips: what they look at, all together, must lie
 * in the halos. Strips as wide as short rows have halos of their own. */
static int turns_most(const struct plan_graph *g, const struct vpset *set,
                      const struct device_shape *shape)
{
    if (set->width <= STRIPS_LEAST_COLUMNS && set->width <= shape->strip_columns)
        return 2 * shape->turns;
    int(*reach)[2] = calloc((size_t)g->count, sizeof *reach),
    most = 1; /* to the left, to the right */
    INVARIANT(reach != NULL);
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

/* A barrier at each shift of something that must be computed. */
static double barriers_everywhere(struct search *s)
{
    for (int i = 0; i < s->g->count; i++)
        s->barrier[i] = s->g->nodes[i].op == NODE_SHIFT && !s->g->nodes[i].leaf &&
                        !s->light[s->g->nodes[i].in[0]];
    s->first = true;
    return cost(s);
}

void plan_choose(struct plan_graph *g, const struct vpset *sets,
                 const struct device_shape *shape)
{
    size_t count = (size_t)g->count;
    struct search s = {.g = g, .sets = sets, .shape = shape};
    s.visits_size = 1024;
    while (s.visits_size < 4 * count + 4 * EVALUATIONS_MAX)
        s.visits_size *= 2;
    s.barrier = calloc(count, sizeof *s.barrier);
    s.light = calloc(count, sizeof *s.light);
    s.earliest = calloc(count, sizeof *s.earliest);
    s.loaded = calloc(count, sizeof *s.loaded);
    s.visits = calloc(s.visits_size, sizeof *s.visits);
    s.offsets = calloc(OFFSETS_MAX, sizeof *s.offsets);
    s.array = calloc(count, sizeof *s.array);
    double *weight = calloc(count, sizeof *weight);
    bool *barrier = calloc(count, sizeof *barrier);
    INVARIANT(s.barrier && s.light && s.earliest && s.loaded && s.visits && s.offsets &&
              s.array && weight && barrier);
    s.offsets_count = 1;
    find_light(&s, weight);
    find_substitutes(g);
    double best = descend(&s, barriers_everywhere(&s));
    const struct vpset *could = could_be_strips(g, sets, shape);
    bool tiles = could && shape->vector < 2;
    g->turns_most = !could ? 1 : tiles ? 2 * shape->turns : turns_most(g, could, shape);
    if (could && !g->no_strips) {
        memcpy(barrier, s.barrier, count * sizeof *barrier);
        s.strips = true;
        s.tiles = tiles;
        double strips = descend(&s, barriers_everywhere(&s));
        if (tiles) {
            cost(&s); /* the last one tried may not have been the best */
            g->turns_most =
                strips < IMPOSSIBLE ? tiles_turns(&s.tiling, could, shape, best) : 1;
        }
        g->strips = assign(&s) > 0 && (!tiles || strips < IMPOSSIBLE) &&
                    (strips < best || shape->always_strips);
        if (!g->strips) {
            s.strips = s.tiles = false;
            memcpy(s.barrier, barrier, count * sizeof *barrier);
        }
    }
    g->cost_ns = cost(&s);
    free(s.barrier);
    free(s.light);
    free(s.earliest);
    free(s.loaded);
    free(s.visits);
    free(s.offsets);
    free(s.array);
    tiling_finish(&s.tiling);
    free(weight);
    free(barrier);
}
