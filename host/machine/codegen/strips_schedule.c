/* strips_schedule.c - kernels in strips: which stages are one pass, which rows and columns each
 * of them handles, and what is kept in rings. See strips.h. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/node_ops.h"
#include "base/parts.h"
#include "base/types.h"
#include "codegen/strips.h"
#include "plan/lanes.h"

void strips_init(struct strips *s, const struct plan_graph *g, const int *stores, int count,
                 const struct vpset *set, const struct device_shape *shape, int vector)
{
    size_t nodes = (size_t)g->count;
    *s = (struct strips){.g = g,
                         .set = set,
                         .shape = shape,
                         .stores = stores,
                         .stores_count = count,
                         .vector = vector,
                         .lane = LANE_WIDE};
    for (int i = 0; i < count; i++)
        widen(&s->stages_count, g->nodes[stores[i]].stage + 1);
    s->stages = calloc((size_t)s->stages_count, sizeof *s->stages);
    s->passes = calloc((size_t)s->stages_count, sizeof *s->passes);
    s->units = calloc((size_t)count, sizeof *s->units);
    s->unit = calloc(nodes, sizeof *s->unit);
    s->down = calloc(nodes, sizeof *s->down);
    s->ahead = calloc(nodes, sizeof *s->ahead);
    s->bits_matter = calloc(nodes, sizeof *s->bits_matter);
    s->ring_rows = calloc(nodes, sizeof *s->ring_rows);
    s->wraps = calloc(nodes, sizeof *s->wraps);
    s->ring_at = calloc(nodes, sizeof *s->ring_at);
    s->rings_of = calloc(nodes, sizeof *s->rings_of);
    s->number = calloc(nodes, sizeof *s->number);
    s->failed = !s->stages || !s->units || !s->unit || !s->passes || !s->down || !s->ahead ||
                !s->bits_matter || !s->ring_rows || !s->wraps || !s->ring_at || !s->rings_of ||
                !s->number;
}

void strips_finish(struct strips *s)
{
    for (int k = 0; s->stages && k < s->stages_count; k++)
        accesses_finish(&s->stages[k].looks);
    for (int k = 0; s->units && k < s->units_count; k++)
        accesses_finish(&s->units[k].looks);
    for (int k = 0; s->passes && k < s->passes_count; k++) {
        emitter_finish(&s->passes[k].e);
        free(s->passes[k].e.arguments.list);
        free(s->passes[k].together.carried);
        free(s->passes[k].text.data);
        free(s->passes[k].span.data);
        free(s->passes[k].outputs);
        free(s->passes[k].inside);
        free(s->passes[k].ring_rows);
    }
    free(s->stages);
    free(s->units);
    free(s->unit);
    free(s->passes);
    free(s->down);
    free(s->ahead);
    free(s->bits_matter);
    free(s->ring_rows);
    free(s->wraps);
    free(s->ring_at);
    free(s->rings_of);
    free(s->rings);
    free(s->number);
}

/* ---- what stages look at ---- */

/* A stage alone: whether it is one again that came before, and what it costs, tells which
 * passes there are. */
static void stage_accesses(struct strips *s, int k)
{
    struct accesses *looks = &s->stages[k].looks;
    accesses_begin(looks, s->g, s->set, k);
    for (int i = 0; i < s->stores_count && !looks->failed; i++)
        if (s->g->nodes[s->stores[i]].stage == k)
            accesses_add(looks, s->stores[i], true);
    accesses_end(looks);
    s->failed = s->failed || looks->failed;
}

/* Finds nodes that are almost free to compute twice: they depend only on a processor's
 * place. */
static void find_places(const struct strips *s, bool *only_place)
{
    for (int i = 0; i < s->g->count; i++) {
        const struct plan_node *n = &s->g->nodes[i];
        only_place[i] = n->constant || (!n->leaf && !n->stored && n->op != NODE_RANDOM);
        for (int k = 0; !n->constant && only_place[i] && k < node_ops[n->op].inputs; k++)
            only_place[i] = only_place[n->in[k]];
    }
}

struct marks {
    const bool *only_place;
    int *owner; /* of a node: the store that it was first wanted for, + 1 */
    int *with;  /* of a store: one before it that it is computed together with, or itself */
};

static int root_of(const struct marks *m, int store)
{
    while (m->with[store] != store)
        store = m->with[store];
    return store;
}

/* Marks the nodes of a store in its stage. If another store needs them, too, both become one
 * unit. */
static void mark(const struct strips *s, const struct marks *m, int node, int stage, int store)
{
    const struct plan_node *n = &s->g->nodes[node];
    if (m->only_place[node] || plan_loads(n, stage))
        return;
    if (m->owner[node]) {
        int a = root_of(m, m->owner[node] - 1), b = root_of(m, store);
        m->with[a > b ? a : b] = a > b ? b : a;
        return;
    }
    m->owner[node] = store + 1;
    for (int k = 0; k < node_ops[n->op].inputs; k++)
        mark(s, m, plan_input(s->g, n, k, stage), stage, store);
}

static void units_of_stage(struct strips *s, const struct marks *m, int stage)
{
    memset(m->owner, 0, (size_t)s->g->count * sizeof *m->owner);
    for (int i = 0; i < s->stores_count; i++) {
        m->with[i] = i;
        if (s->g->nodes[s->stores[i]].stage == stage)
            mark(s, m, s->stores[i], stage, i);
    }
    for (int i = 0; i < s->stores_count && !s->failed; i++) {
        int node = s->stores[i], root = root_of(m, i);
        if (s->g->nodes[node].stage != stage)
            continue;
        if (root == i) {
            s->unit[node] = s->units_count;
            accesses_begin(&s->units[s->units_count].looks, s->g, s->set, stage);
            s->units[s->units_count++].stage = stage;
        }
        struct unit *unit = &s->units[s->unit[s->stores[root]]];
        s->unit[node] = s->unit[s->stores[root]];
        accesses_add(&unit->looks, node, true);
        s->failed = s->failed || unit->looks.failed;
    }
}

static void make_units(struct strips *s)
{
    bool *only_place = calloc((size_t)s->g->count, sizeof *only_place);
    struct marks m = {only_place, calloc((size_t)s->g->count, sizeof *m.owner),
                      calloc((size_t)s->stores_count, sizeof *m.with)};
    s->failed = s->failed || !m.only_place || !m.owner || !m.with;
    if (!s->failed)
        find_places(s, only_place);
    for (int k = 0; k < s->stages_count && !s->failed; k++)
        units_of_stage(s, &m, k);
    for (int k = 0; k < s->units_count; k++)
        accesses_end(&s->units[k].looks);
    free(only_place);
    free(m.owner);
    free(m.with);
}

/* ---- which stages are one pass ---- */

/* Where stages are turns of a loop: the stages of a turn, and the stage with which the equal
 * turns begin. The first and the last turns differ slightly, since nothing precedes or
 * follows them. */
struct turns {
    int stages, begin; /* stages: 0: there are none */
};

static struct turns find_turns(const struct strips *s)
{
    struct turns best = {0, 0};
    int best_length = s->stages_count / 3;
    for (int turn = 1; 2 * turn < s->stages_count; turn++)
        for (int k = turn, length = 0; k < s->stages_count; k++) {
            bool same = accesses_same(&s->stages[k].looks, &s->stages[k - turn].looks);
            length = same ? length + 1 : 0;
            if (length > best_length && length >= turn) {
                best_length = length;
                best = (struct turns){turn, (k - length + 1) % turn};
            }
        }
    return best;
}

static void make_passes(struct strips *s)
{
    struct turns turns = find_turns(s);
    for (int k = 0, cost = 0, begun = 0; k < s->stages_count; k++) {
        bool turn = turns.stages && k % turns.stages == turns.begin;
        cost += s->stages[k].looks.cost;
        if (k == 0 || turn || (cost > s->shape->pass_cost && k > begun)) {
            s->passes[s->passes_count++].first = begun = k;
            cost = s->stages[k].looks.cost;
        }
        s->stages[k].pass = s->passes_count - 1;
        s->passes[s->passes_count - 1].last = k;
    }
}

/* ---- which rows and columns ---- */

static int up_to_vectors(const struct strips *s, int columns)
{
    return columns > 0 ? (columns + s->vector - 1) / s->vector * s->vector : 0;
}

/* How units are scheduled: 1 or -1 for the directions of rows and columns; aligned: all of a
 * stage in the same row. */
struct way {
    int downward, rightward;
    bool aligned;
};

static void find_delays(struct strips *s, bool aligned)
{
    for (int k = 0, stage = 0; k < s->units_count; k = stage) {
        int most = 0;
        for (; stage < s->units_count && s->units[stage].stage == s->units[k].stage; stage++) {
            struct unit *to = &s->units[stage];
            for (int i = 0; i < to->looks.count; i++) {
                const struct access *p = &to->looks.list[i];
                if (!s->g->nodes[p->node].leaf)
                    widen(&to->delay, s->units[s->unit[p->node]].delay +
                                          accesses_down(&to->looks, p) * s->downward);
            }
            widen(&most, to->delay);
        }
        for (int i = k; i < stage && aligned; i++)
            s->units[i].delay = most;
    }
}

/* The number of rows of a ring from the one being computed to the one that the unit reads. */
static int rows_between(const struct strips *s, const struct unit *to, const struct access *p)
{
    const struct unit *from = &s->units[s->unit[p->node]];
    return to->delay - from->delay - accesses_down(&to->looks, p) * s->downward + 1;
}

static bool same_pass(const struct strips *s, const struct unit *a, const struct unit *b)
{
    return s->stages[a->stage].pass == s->stages[b->stage].pass;
}

/* A row that is read where another is computed, vector for vector, is overwritten by it: see
 * overwritten_loads(). */
static void find_ring_rows(struct strips *s)
{
    for (int k = 0; k < s->units_count; k++) {
        const struct unit *to = &s->units[k];
        for (int i = 0; i < to->looks.count; i++) {
            const struct access *p = &to->looks.list[i];
            if (s->g->nodes[p->node].leaf)
                continue;
            const struct unit *from = &s->units[s->unit[p->node]];
            int rows = rows_between(s, to, p);
            bool same = same_pass(s, from, to),
                 in_step = same && !p->low && !p->high && to->ahead == from->ahead;
            if (!same || rows > 1)
                widen(&s->ring_rows[p->node], rows - in_step);
        }
    }
}

/* Schedules in that way; returns what strips then keep: bytes for each column, in rings and
 * in vectors of earlier iterations. */
static int schedule(struct strips *s, struct way way)
{
    s->downward = way.downward;
    s->rightward = way.rightward;
    memset(s->ring_rows, 0, (size_t)s->g->count * sizeof *s->ring_rows);
    memset(s->wraps, 0, (size_t)s->g->count * sizeof *s->wraps);
    for (int k = 0; k < s->units_count; k++) {
        struct unit *to = &s->units[k];
        to->delay = to->above = to->below = to->left = to->right = to->ahead = 0;
    }
    find_delays(s, way.aligned);
    for (int k = s->units_count - 1; k >= 0; k--) {
        struct unit *to = &s->units[k];
        for (int i = 0; i < to->looks.count; i++) {
            const struct access *p = &to->looks.list[i];
            if (s->g->nodes[p->node].leaf)
                continue;
            struct unit *from = &s->units[s->unit[p->node]];
            int down = accesses_down(&to->looks, p);
            bool variable = same_pass(s, from, to) && rows_between(s, to, p) == 1;
            widen(&from->above, to->above - down);
            widen(&from->below, to->below + down);
            if (variable || !s->whole) {
                widen(&from->left, to->left - p->low);
                widen(&from->right, to->right + p->high);
            } else {
                s->wraps[p->node] |= (to->left - p->low > 0 ? WRAPS_LEFT : 0) |
                                     (to->right + p->high > 0 ? WRAPS_RIGHT : 0);
            }
            if (variable)
                widen(&from->ahead,
                      to->ahead +
                          up_to_vectors(s, s->rightward > 0 ? p->high : -p->low) / s->vector);
        }
    }
    find_ring_rows(s);
    for (int i = 0; i < s->passes_count; i++) {
        struct pass *pass = &s->passes[i];
        pass->above = pass->below = pass->before = pass->after = 0;
        pass->delay = INT_MAX;
        for (int k = 0; k < s->units_count; k++)
            if (s->stages[s->units[k].stage].pass == i && s->units[k].delay < pass->delay)
                pass->delay = s->units[k].delay;
    }
    int kept = 0;
    for (int i = 0; i < s->stores_count; i++) {
        int node = s->stores[i];
        const struct unit *unit = &s->units[s->unit[node]];
        struct pass *pass = &s->passes[s->stages[unit->stage].pass];
        s->down[node] = (pass->delay - unit->delay) * s->downward;
        s->ahead[node] = unit->ahead * s->rightward;
        int columns = s->ahead[node] * s->vector;
        widen(&pass->above, unit->above + s->down[node]);
        widen(&pass->below, unit->below - s->down[node]);
        widen(&pass->before, up_to_vectors(s, unit->left + columns));
        widen(&pass->after, up_to_vectors(s, unit->right - columns));
        kept += (s->ring_rows[node] + unit->ahead) * (int)type_bytes(s->g->nodes[node].type);
    }
    return kept;
}

static int rings_with(struct strips *s, int rows)
{
    for (int i = 0; i < s->rings_count; i++)
        if (s->rings[i].rows == rows)
            return i;
    if (s->rings_count == s->rings_capacity)
        s->rings = array_more(s->rings, &s->rings_capacity, sizeof *s->rings, &s->failed);
    if (s->failed)
        return 0;
    s->rings[s->rings_count] = (struct rings){.rows = rows};
    return s->rings_count++;
}

/* Lays rings out pass by pass: turns of a loop have theirs in the same order, at equal
 * distances from turn to turn. */
static void lay_out(struct strips *s)
{
    s->rings_count = s->memory = 0;
    for (int pass = 0; pass < s->passes_count; pass++)
        for (int i = 0; i < s->stores_count && !s->failed; i++) {
            int node = s->stores[i];
            const struct plan_node *n = &s->g->nodes[node];
            if (s->stages[n->stage].pass != pass || !s->ring_rows[node])
                continue;
            s->rings_of[node] = rings_with(s, s->ring_rows[node]);
            if (s->failed)
                return;
            struct rings *rings = &s->rings[s->rings_of[node]];
            s->ring_at[node] = rings->bytes;
            rings->bytes += (int)type_bytes(n->type);
        }
    for (int i = 0; i < s->rings_count; i++) {
        s->rings[i].at = s->memory;
        s->memory += s->rings[i].rows * s->rings[i].bytes;
    }
}

/* Elements of up to 64 bits; what all stages together look at lies in the halos of arrays; and
 * there are so many rows that which one is meant is never in doubt. */
static bool suits(const struct strips *s)
{
    int rows = 0;
    for (int k = 0; k < s->stages_count; k++)
        if (s->stages[k].looks.wide || s->stages[k].looks.soft)
            return false;
    for (int k = 0; k < s->units_count; k++) {
        const struct unit *unit = &s->units[k];
        int behind = unit->delay - s->passes[s->stages[unit->stage].pass].delay;
        for (int i = 0; i < unit->looks.count; i++) {
            const struct access *p = &unit->looks.list[i];
            if (unit->left - p->low > s->set->halo || unit->right + p->high > s->set->halo)
                return false;
            widen(&rows, abs(accesses_down(&unit->looks, p)) + behind);
        }
    }
    return s->set->halo && s->set->width >= 2 * s->vector && s->set->dimensions[0] >= 2 * rows;
}

/* ---- what can be written in place ---- */

/* Whether an output may be written in place of a leaf: each row of the leaf must have been
 * read for the last time when the output's row is written, or be read in that row only by
 * the output's unit, each element where it is stored (a unit stores after computing
 * everything). */
static bool may_replace(const struct strips *s, int output, int leaf)
{
    const struct unit *out = &s->units[s->unit[output]];
    for (int k = 0; k < s->units_count; k++) {
        const struct unit *u = &s->units[k];
        for (int i = 0; i < u->looks.count; i++) {
            const struct access *p = &u->looks.list[i];
            if (p->node != leaf)
                continue;
            int late = u->delay - accesses_down(&u->looks, p) * s->downward - out->delay;
            bool there = u == out && !p->low && !p->high && !u->left && !u->right;
            if (late > 0 || (late == 0 && !there))
                return false;
        }
    }
    return true;
}

static int border_add(struct in_place *in, int leaf)
{
    for (int i = 0; i < in->leaves_count; i++)
        if (in->leaves[i] == leaf)
            return i;
    if (in->leaves_count == BORDERS_MOST)
        return -1;
    in->leaves[in->leaves_count] = leaf;
    return in->leaves_count++;
}

static void pair_add(struct strips *s, int output, int leaf)
{
    struct in_place *in = &s->in_place;
    int border = border_add(in, leaf);
    if (border < 0)
        return;
    if (in->pairs_count == in->pairs_capacity)
        in->pairs = array_more(in->pairs, &in->pairs_capacity, sizeof *in->pairs, &s->failed);
    if (s->failed)
        return;
    in->pairs[in->pairs_count].output = output;
    in->pairs[in->pairs_count].leaf = leaf;
    in->pairs[in->pairs_count++].border = border;
}

static bool is_read(const struct strips *s, int leaf)
{
    for (int k = 0; k < s->units_count; k++)
        for (int i = 0; i < s->units[k].looks.count; i++)
            if (s->units[k].looks.list[i].node == leaf)
                return true;
    return false;
}

static void find_pairs(struct strips *s)
{
    struct in_place *in = &s->in_place;
    in->leaves_count = in->pairs_count = in->above = in->below = in->bytes = 0;
    for (int leaf = 0; leaf < s->g->count && !s->failed; leaf++) {
        const struct plan_node *n = &s->g->nodes[leaf];
        for (int i = 0; n->leaf && is_read(s, leaf) && i < s->stores_count; i++) {
            const struct plan_node *to = &s->g->nodes[s->stores[i]];
            if (to->target && type_bytes(to->type) == type_bytes(n->type) &&
                may_replace(s, s->stores[i], leaf))
                pair_add(s, s->stores[i], leaf);
        }
    }
    for (int k = 0; k < s->units_count; k++) { /* all rows that its pass goes through */
        const struct unit *u = &s->units[k];
        const struct pass *pass = &s->passes[s->stages[u->stage].pass];
        int own = (pass->delay - u->delay) * s->downward;
        for (int i = 0; i < u->looks.count; i++) {
            int down = own + accesses_down(&u->looks, &u->looks.list[i]);
            widen(&in->above, pass->above - down);
            widen(&in->below, pass->below + down);
        }
    }
    for (int i = 0; i < in->leaves_count; i++)
        in->bytes += (int)type_bytes(s->g->nodes[in->leaves[i]].type);
}

/* ---- which way ---- */

/* Chooses the directions. Stages that read rows above and columns to the left keep least if
 * rows are taken from the lowest up and columns from right to left. Among equally good ways,
 * the one is chosen in which most can be written in place. */
static void choose_way(struct strips *s)
{
    struct way best = {0};
    int least = INT_MAX, most = 0;
    for (int i = 0; i < 8 && !s->failed; i++) {
        struct way way = {i & 4 ? -1 : 1, i & 2 ? -1 : 1, i & 1};
        int kept = schedule(s, way);
        find_pairs(s);
        if (kept < least || (kept == least && s->in_place.pairs_count > most)) {
            best = way;
            least = kept;
            most = s->in_place.pairs_count;
        }
    }
    schedule(s, best);
    find_pairs(s);
}

bool strips_schedule(struct strips *s)
{
    for (int k = 0; k < s->stages_count && !s->failed; k++)
        stage_accesses(s, k);
    make_units(s);
    if (s->failed)
        return false;
    accesses_find_bits(s->g, s->bits_matter);
    make_passes(s);
    /* the last vector may reach beyond the row, but not beyond its halo */
    int over = s->set->width % s->vector;
    s->whole = !over || s->vector - over <= s->set->halo;
    choose_way(s);
    lay_out(s);
    if (s->whole && s->set->width / strips_columns(s) > 1) {
        s->whole = false;
        choose_way(s);
        lay_out(s);
    }
    return !s->failed && suits(s);
}

/* ---- how wide ---- */

/* What passes read and write of a ring's row. */
bool strips_find_margin(struct strips *s)
{
    for (int k = 0; k < s->passes_count; k++) {
        const struct pass *pass = &s->passes[k];
        int low = 0, high = 0;
        for (int i = 0; i < pass->e.pointers_count; i++) {
            const struct access *p = &pass->e.seen_pointers[i];
            low = p->low < low ? p->low : low;
            widen(&high, p->high);
        }
        for (int i = 0; i < s->stores_count; i++)
            if (s->stages[s->g->nodes[s->stores[i]].stage].pass == k) {
                int columns = s->ahead[s->stores[i]] * s->vector;
                low = columns < low ? columns : low;
                widen(&high, columns);
            }
        widen(&s->margin, up_to_vectors(s, pass->before - low));
        widen(&s->margin, up_to_vectors(s, pass->after + high + s->vector));
    }
    return s->margin * 8 <= DEVICE_GUARD_BYTES;
}

int strips_columns(const struct strips *s)
{
    int columns = s->shape->strip_columns, width = s->set->width;
    while (columns > s->shape->strip_least && columns * s->memory > s->shape->near_bytes)
        columns = columns / 2 / s->vector * s->vector;
    int strips = (width + columns - 1) / columns;
    columns = width / strips / s->vector * s->vector;
    return columns ? columns : s->vector;
}

/* All rows begin a line of the caches; not all the same one. */
int strips_near_columns(const struct strips *s, int columns)
{
    enum { STEPS = 8 };
    int least = (2 * columns < s->set->width ? 2 * columns : s->set->width) + 2 * s->margin +
                s->vector,
        step = LINE_BYTES;
    while (step * STEPS < least)
        step *= 2;
    return (least + step - 1) / step * step + LINE_BYTES;
}
