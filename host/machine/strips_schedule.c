/* strips_schedule.c - kernels in strips: which stages are one pass, which rows and columns each of them handles, and
 * what is kept in rings. See strips.h. */
#include <stdlib.h>
#include <string.h>

#include "strips.h"

enum {
    PASS_COST = 600
}; /* of stages in one loop: with many more than there are registers for nothing is won */

/* ---- what stages look at ---- */

/* The values first, a stage alone: which passes there are, and which rings, follows from what all of them
 * look at. */
static void stage_values(struct strips *s, int k)
{
    struct stage *stage = &s->stages[k];
    emitter_init(&stage->e, s->g, s->set, k);
    stage->e.lane = s->lane;
    stage->e.bare = true;
    for (int i = 0; i < s->stores_count && !stage->e.failed; i++)
        if (s->g->nodes[s->stores[i]].stage == k)
            emit_value(&stage->e, s->stores[i], 0, 0, true);
    s->failed = s->failed || stage->e.failed;
}

/* Whose NaNs are looked at bit by bit when they have been kept for a later stage. In arrays all are canonical. */
static void find_bits(struct strips *s)
{
    const struct plan_graph *g = s->g;
    for (int i = g->count - 1; i >= 0; i--) {
        const struct plan_node *n = &g->nodes[i];
        bool bits =
            n->op == NODE_REINTERPRET ||
            ((n->op == NODE_SELECT || n->op == NODE_SHIFT) && (n->target || s->bits_matter[i]));
        for (int k = 0; bits && !n->leaf && k < node_ops[n->op].inputs; k++) {
            s->bits_matter[n->in[k]] = true;
            if (n->instead[k] >= 0)
                s->bits_matter[n->instead[k]] = true;
        }
    }
}

/* ---- which stages are one pass ---- */

/* Where stages are turns of a loop: of how many stages, and which stage the first of those begins with that are all
 * alike. The first and the last turns are not quite, since there is nothing before and after them. */
struct turns {
    int stages, begin; /* stages: 0: there are none */
};

static struct turns find_turns(const struct strips *s)
{
    struct turns best = {0, 0};
    int best_length = s->stages_count / 3;
    for (int turn = 1; 2 * turn < s->stages_count; turn++)
        for (int k = turn, length = 0; k < s->stages_count; k++) {
            bool same = text_same(&s->stages[k].e.body, &s->stages[k - turn].e.body);
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
        cost += s->stages[k].e.cost;
        if (k == 0 || turn || (cost > PASS_COST && k > begun)) {
            s->passes[s->passes_count++].first = begun = k;
            cost = s->stages[k].e.cost;
        }
        s->stages[k].pass = s->passes_count - 1;
        s->passes[s->passes_count - 1].last = k;
    }
}

/* ---- which rows and columns ---- */

/* Row offsets are modulo the height: the short way round. */
static int short_way(const struct strips *s, int offset)
{
    int height = s->set->dimensions[0];
    offset %= height;
    return offset > height / 2      ? offset - height
           : offset < -(height / 2) ? offset + height
                                    : offset;
}

int strips_rows_down(const struct strips *s, const struct emitter *e, const struct pointer *p)
{
    return short_way(s, e->row_offsets[p->row].d[0]);
}

static int up_to_vectors(const struct strips *s, int columns)
{
    return columns > 0 ? (columns + s->vector - 1) / s->vector * s->vector : 0;
}

static void schedule(struct strips *s)
{
    for (int k = 0; k < s->stages_count; k++) {
        struct stage *to = &s->stages[k];
        for (int i = 0; i < to->e.pointers_count; i++) {
            const struct pointer *p = &to->e.seen_pointers[i];
            const struct plan_node *n = &s->g->nodes[p->node];
            if (!n->leaf)
                widen(&to->delay, s->stages[n->stage].delay + strips_rows_down(s, &to->e, p));
        }
    }
    for (int k = s->stages_count - 1; k >= 0; k--) {
        struct stage *to = &s->stages[k];
        for (int i = 0; i < to->e.pointers_count; i++) {
            const struct pointer *p = &to->e.seen_pointers[i];
            const struct plan_node *n = &s->g->nodes[p->node];
            if (n->leaf)
                continue;
            struct stage *from = &s->stages[n->stage];
            int down = strips_rows_down(s, &to->e, p),
                rows = to->delay - from->delay - down + 1;
            widen(&from->above, to->above - down);
            widen(&from->below, to->below + down);
            widen(&from->left, to->left - p->low);
            widen(&from->right, to->right + p->high);
            if (from->pass == to->pass && rows == 1)
                widen(&from->ahead, to->ahead + up_to_vectors(s, p->high) / s->vector);
            else
                widen(&s->ring_rows[p->node], rows);
        }
    }
    for (int i = 0; i < s->passes_count; i++) {
        struct pass *pass = &s->passes[i];
        pass->delay = s->stages[pass->first].delay;
        for (int k = pass->first; k <= pass->last; k++)
            if (s->stages[k].delay < pass->delay)
                pass->delay = s->stages[k].delay;
        for (int k = pass->first; k <= pass->last; k++) {
            const struct stage *stage = &s->stages[k];
            int behind = stage->delay - pass->delay, columns = stage->ahead * s->vector;
            s->down[k] = -behind;
            s->ahead[k] = stage->ahead;
            widen(&pass->above, stage->above - behind);
            widen(&pass->below, stage->below + behind);
            widen(&pass->before, up_to_vectors(s, stage->left + columns));
            widen(&pass->after, up_to_vectors(s, stage->right - columns));
        }
    }
}

/* Rings of wide elements first, so that all are aligned. */
static void lay_out(struct strips *s)
{
    for (int bytes = 8; bytes >= 1; bytes /= 2)
        for (int i = 0; i < s->g->count; i++)
            if (s->ring_rows[i] && (int)type_bytes(s->g->nodes[i].type) == bytes) {
                s->ring_at[i] = s->memory;
                s->memory += bytes * s->ring_rows[i];
            }
}

/* Elements of up to 64 bits; what all stages together look at lies in the halos of arrays; and there are so many
 * rows that which one is meant is never in doubt. */
static bool suits(const struct strips *s)
{
    int rows = 0;
    for (int k = 0; k < s->stages_count; k++) {
        const struct stage *stage = &s->stages[k];
        if (stage->e.wide || stage->e.soft)
            return false;
        for (int i = 0; i < stage->e.pointers_count; i++) {
            const struct pointer *p = &stage->e.seen_pointers[i];
            if (stage->left - p->low > s->set->halo || stage->right + p->high > s->set->halo)
                return false;
            widen(&rows, abs(strips_rows_down(s, &stage->e, p)) - s->down[k]);
        }
    }
    return s->set->halo && s->set->width >= 2 * s->vector && s->set->dimensions[0] >= 2 * rows;
}

bool strips_schedule(struct strips *s)
{
    for (int k = 0; k < s->stages_count && !s->failed; k++)
        stage_values(s, k);
    if (s->failed)
        return false;
    find_bits(s);
    make_passes(s);
    schedule(s);
    lay_out(s);
    return suits(s);
}

/* ---- how wide ---- */

/* What passes read and write of a ring's row. */
bool strips_find_margin(struct strips *s)
{
    for (int k = 0; k < s->passes_count; k++) {
        const struct pass *pass = &s->passes[k];
        int low = 0, high = 0;
        for (int i = 0; i < pass->e.pointers_count; i++) {
            const struct pointer *p = &pass->e.seen_pointers[i];
            low = p->low < low ? p->low : low;
            widen(&high, p->high);
        }
        for (int i = pass->first; i <= pass->last; i++)
            widen(&high, s->ahead[i] * s->vector);
        widen(&s->margin, up_to_vectors(s, pass->before - low));
        widen(&s->margin, up_to_vectors(s, pass->after + high + s->vector));
    }
    return s->margin * 8 <= DEVICE_GUARD_BYTES;
}

int strips_columns(const struct strips *s, const struct device_shape *shape)
{
    enum { LEAST = 128 };
    int columns = shape->strip_columns, width = s->set->width;
    while (columns > LEAST && columns * s->memory > shape->near_bytes)
        columns = columns / 2 / s->vector * s->vector;
    int strips = (width + columns - 1) / columns;
    columns = width / strips / s->vector * s->vector;
    return columns ? columns : s->vector;
}

int strips_near_columns(const struct strips *s, int columns)
{
    columns = 2 * columns < s->set->width ? 2 * columns : s->set->width;
    int vector = s->vector > 16 ? s->vector : 16;
    return (columns + 2 * s->margin + vector - 1) / vector * vector + vector;
}
