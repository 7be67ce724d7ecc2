/* strips.c - the text of one kernel for several stages: a strip of columns, line by line.
 *
 * What one stage stores for the neighbours of the next need not exist as a whole: each work-item goes down
 * a strip, and each stage handles a row as soon as the rows that it looks at have been made.
 *
 *     i = row that the strip has come to
 *
 *     stage 0  at row i          reads arrays            keeps a
 *     stage 1  at row i - 1      reads arrays, a         keeps b, and writes an array
 *     stage 2  at row i - 3      reads a, b              writes an array
 *
 *     delay   how many rows a stage is behind: enough for the lowest row that it looks at
 *     above   how many rows above its strip a stage begins, since later ones look at those; below,
 *             left, right: likewise
 *
 * Stages that follow each other are *passes*: each pass is one loop over the columns of a row, VECTOR at a time.
 * What a stage of a pass has just computed others of the pass find in variables. Along the row a stage may be some
 * vectors ahead of those that look further on than it; what they want of earlier vectors stays in variables, too:
 *
 *     x                x + VECTOR
 *     [ c0_1        ][ v7        ]      v7: computed now, c0_1: v7 of the turn before
 *         [ wanted      ]               lanes of both, put together
 *
 * Other rows, and what other passes have made, are kept in *rings* of a few rows as wide as the strip, which stay
 * in the caches. So a value that several look at is computed once, and many steps of a stencil can go through the
 * caches at once; see Hegarty et al., "Darkroom" (SIGGRAPH 2014), for the same among image filters.
 *
 * What lies beyond a strip is computed twice, by both neighbours, and kept in rings only. The sheet is a torus:
 * rows beyond its ends are rows of it, and columns are in the halos of arrays, which must be wide enough for all
 * stages together. Vectors begin where x is a multiple of VECTOR; lanes that are beyond a row's halos hold
 * anything, and nobody looks at them.
 *
 * Stages of which the same text comes again and again are turns of a loop, and each turn is a pass: a function,
 * which all turns with the same text share. */
#include <stdlib.h>
#include <string.h>

#include "body.h"
#include "kernels.h"
#include "spell.h"

enum {
    PASS_COST = 600
}; /* of stages in one loop: with many more than there are registers for nothing is won */

struct stage {
    struct emitter e; /* of it alone: what it looks at */
    int pass;
    int delay, above, below, left, right;
    int ahead; /* vectors */
};

struct output {
    int node;
    bool array; /* else its ring */
};

struct pass {
    struct emitter e;
    struct together together;
    struct text text, span; /* of its functions, but for their names */
    int same;               /* the first pass with that text */
    int first, last;        /* stages */
    int delay;              /* of the first of its rows */
    int above, below;       /* rows */
    int before, after;      /* columns, whole vectors */
    struct output *outputs;
    int outputs_count;
};

struct strips {
    const struct plan_graph *g;
    const struct vpset *set;
    const int *stores;
    int stores_count, vector;
    struct stage *stages;
    int stages_count;
    struct pass *passes;
    int passes_count;
    int *down, *ahead; /* of stages: see struct together */
    bool *bits_matter;
    int *ring_rows; /* of a node: how many; 0: no ring */
    int *ring_at;   /* of a node: where in the strip's memory, in bytes for each column */
    int *number;    /* of a node that is a number, + 1; of an array that is read */
    int memory;     /* of a strip, bytes for each column */
    int margin;     /* columns of a ring on both sides of the strip's */
    struct kernel_argument *arguments;
    int arguments_count, arguments_capacity, constants_count;
    bool failed;
};

static void add_argument(struct strips *s, int kind, int node, int size)
{
    if (s->arguments_count == s->arguments_capacity) {
        int capacity = s->arguments_capacity ? 2 * s->arguments_capacity : 64;
        void *new = realloc(s->arguments, (size_t)capacity * sizeof *s->arguments);
        if (!new) {
            s->failed = true;
            return;
        }
        s->arguments = new;
        s->arguments_capacity = capacity;
    }
    s->arguments[s->arguments_count++] =
        (struct kernel_argument){.kind = (uint8_t)kind, .size = (uint8_t)size, .node = node};
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

static bool text_same(const struct text *a, const struct text *b)
{
    return a->length == b->length && (!a->length || !memcmp(a->data, b->data, a->length));
}

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

static int rows_down(const struct strips *s, const struct emitter *e, const struct pointer *p)
{
    return short_way(s, e->row_offsets[p->row].d[0]);
}

static int up_to_vectors(const struct strips *s, int columns)
{
    return columns > 0 ? (columns + s->vector - 1) / s->vector * s->vector : 0;
}

static void widen(int *have, int wanted)
{
    *have = wanted > *have ? wanted : *have;
}

static void schedule(struct strips *s)
{
    for (int k = 0; k < s->stages_count; k++) {
        struct stage *to = &s->stages[k];
        for (int i = 0; i < to->e.pointers_count; i++) {
            const struct pointer *p = &to->e.seen_pointers[i];
            const struct plan_node *n = &s->g->nodes[p->node];
            if (!n->leaf)
                widen(&to->delay, s->stages[n->stage].delay + rows_down(s, &to->e, p));
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
            int down = rows_down(s, &to->e, p), rows = to->delay - from->delay - down + 1;
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
            widen(&rows, abs(rows_down(s, &stage->e, p)) - s->down[k]);
        }
    }
    return s->set->halo >= s->vector && s->set->width >= 2 * s->vector &&
           s->set->dimensions[0] >= 2 * rows;
}

/* ---- a pass's functions ---- */

/* The values first, a stage alone: which passes there are, and which rings, follows from what all of them
 * look at. */
static void stage_values(struct strips *s, int k)
{
    struct stage *stage = &s->stages[k];
    emitter_init(&stage->e, s->g, s->set, k);
    stage->e.bare = true;
    for (int i = 0; i < s->stores_count && !stage->e.failed; i++)
        if (s->g->nodes[s->stores[i]].stage == k)
            emit_value(&stage->e, s->stores[i], 0, 0, true);
    s->failed = s->failed || stage->e.failed;
}

static void pass_output(struct strips *s, struct pass *pass, int node, bool array)
{
    struct emitter *e = &pass->e;
    const struct plan_node *n = &s->g->nodes[node];
    int columns = s->ahead[n->stage] * s->vector;
    struct operand v = emit_value(e, node, emit_row(e, 0, s->down[n->stage]), columns,
                                  array || s->bits_matter[node]);
    if (array)
        text_put(&e->body,
                 "        if (own%d && x + %d >= first && x + %d < last)\n"
                 "            ROW_STORE(%s, q%d, x + %d, %s);\n",
                 n->stage - pass->first, columns, columns, memory_kind(n->type),
                 pass->outputs_count, columns, v.text);
    else
        text_put(&e->body, "        OUT_%s(q%d, x + %d, %s);\n", memory_kind(n->type),
                 pass->outputs_count, columns, v.text);
    pass->outputs[pass->outputs_count++] = (struct output){node, array};
}

static void pass_values(struct strips *s, struct pass *pass)
{
    struct emitter *e = &pass->e;
    emitter_init(e, s->g, s->set, pass->first);
    pass->outputs = calloc(2 * (size_t)s->stores_count, sizeof *pass->outputs);
    if (!pass->outputs || e->failed) {
        s->failed = true;
        return;
    }
    pass->together = (struct together){.first = pass->first,
                                       .down = s->down,
                                       .ahead = s->ahead,
                                       .vector = s->vector,
                                       .bits_matter = s->bits_matter};
    e->bare = true;
    e->together = &pass->together;
    for (e->stage = pass->first; e->stage <= pass->last && !e->failed; e->stage++)
        for (int i = 0; i < s->stores_count && !e->failed; i++) {
            int node = s->stores[i];
            const struct plan_node *n = &s->g->nodes[node];
            if (n->stage != e->stage)
                continue;
            if (s->ring_rows[node])
                pass_output(s, pass, node, false);
            if (n->target)
                pass_output(s, pass, node, true);
            if (!s->ring_rows[node] && !n->target) /* for variables only */
                emit_value(e, node, emit_row(e, 0, s->down[e->stage]),
                           s->ahead[e->stage] * s->vector, s->bits_matter[node]);
        }
    s->failed = s->failed || e->failed || e->body.failed;
}

static bool has_boxes(const struct strips *s, const struct emitter *e)
{
    return s->g->boxes && (e->row_tests.data || e->column_tests.data);
}

/* Of which columns on, and up to which, whole vectors are inside all boxes, and stored whole. */
static void span_text(struct strips *s, struct pass *pass)
{
    const struct emitter *e = &pass->e;
    struct text *t = &pass->span;
    int furthest = 0;
    for (int i = 0; i < pass->outputs_count; i++)
        if (pass->outputs[i].array)
            widen(&furthest, s->ahead[s->g->nodes[pass->outputs[i].node].stage] * s->vector);
    text_put(t, "(const int W, const int first, const int last");
    int number = 0;
    for (int i = 0; i < e->arguments_count; i++)
        if (e->arguments[i].kind == ARGUMENT_CONSTANT)
            emit_number(t, s->g, e->arguments[i].node, number++);
        else
            text_put(t, ", ulong h%d", number - 1);
    text_put(t,
             ")\n{\n    int from = last + %d, to = from;\n"
             "    for (int x = first - %d; x < last + %d; x += VECTOR)\n"
             "        if (x + %d + VECTOR <= WHOLE%s) {\n"
             "            from = min(from, x);\n            to = x + VECTOR;\n"
             "        }\n    return (int2)(from, to);\n}\n",
             pass->after, pass->before, pass->after, furthest,
             e->column_tests.data ? e->column_tests.data : "");
    s->failed = s->failed || t->failed;
}

static void carried_text(const struct strips *s, const struct pass *pass, struct text *t,
                         bool declare)
{
    for (int i = 0; i < pass->together.carried_count; i++) {
        const struct carried *c = &pass->together.carried[i];
        const struct plan_node *n = &s->g->nodes[c->node];
        for (int back = c->back; back >= 1; back--)
            if (declare)
                text_put(t, "    %s c%d_%d = (%s)(0);\n", spell_container(n->type), i, back,
                         spell_container(n->type));
            else if (back > 1)
                text_put(t, "        c%d_%d = c%d_%d;\n", i, back, i, back - 1);
    }
}

/* At the end of a turn. */
static void carry(struct strips *s, struct pass *pass)
{
    struct emitter *e = &pass->e;
    carried_text(s, pass, &e->body, false);
    for (int i = 0; i < pass->together.carried_count; i++) {
        int node = pass->together.carried[i].node, k = s->g->nodes[node].stage;
        e->stage = k;
        struct operand v = emit_value(e, node, emit_row(e, 0, s->down[k]),
                                      s->ahead[k] * s->vector, s->bits_matter[node]);
        text_put(&e->body, "        c%d_1 = %s;\n", i, v.text);
    }
}

/* The next row of arrays, on its way to the caches while this one is computed: rows are shorter than what
 * hardware needs to find out that they follow each other. */
static void prefetch_text(const struct strips *s, struct pass *pass, struct text *t)
{
    const struct emitter *e = &pass->e;
    for (int i = 0; i < e->pointers_count; i++) {
        const struct pointer *p = &e->seen_pointers[i];
        bool newest = s->g->nodes[p->node].leaf;
        for (int k = 0; k < e->pointers_count; k++)
            newest = newest && (e->seen_pointers[k].node != p->node ||
                                rows_down(s, e, &e->seen_pointers[k]) <= rows_down(s, e, p));
        if (newest)
            text_put(t, "        PREFETCH(p%d + PITCH + x + %d, 0);\n", i, p->high);
    }
    for (int i = 0; i < pass->outputs_count; i++)
        if (pass->outputs[i].array)
            text_put(t, "        PREFETCH(q%d + PITCH + x + %d, 1);\n", i,
                     s->ahead[s->g->nodes[pass->outputs[i].node].stage] * s->vector);
}

static void pass_text(struct strips *s, struct pass *pass)
{
    struct emitter *e = &pass->e;
    struct text *t = &pass->text;
    bool boxes = has_boxes(s, e);
    carry(s, pass);
    text_put(t, "(const int W, const int PITCH, const int PLOG2, const int RATIO, const int "
                "D0, const int y,\n    const int top, const int bottom, const int first, "
                "const int last, const int2 inside");
    for (int i = 0; i < e->pointers_count; i++)
        text_put(t, ",\n    const __global %s *%s p%d",
                 memory_type(s->g->nodes[e->seen_pointers[i].node].type),
                 s->g->nodes[e->seen_pointers[i].node].leaf ? "restrict" : "", i);
    for (int i = 0; i < pass->outputs_count; i++)
        text_put(t, ",\n    __global %s *%s q%d",
                 memory_type(s->g->nodes[pass->outputs[i].node].type),
                 pass->outputs[i].array ? "restrict" : "", i);
    int number = 0;
    for (int i = 0; i < e->arguments_count; i++)
        if (e->arguments[i].kind == ARGUMENT_CONSTANT)
            emit_number(t, s->g, e->arguments[i].node, number++);
        else
            text_put(t, ", ulong h%d", number - 1);
    text_put(t, ")\n{\n    const int row = wrap(y, D0), r0 = row;\n");
    emit_axes(e, t);
    text_put(t, "%s%s", e->rows.data ? e->rows.data : "",
             e->constants.data ? e->constants.data : "");
    for (int k = pass->first; k <= pass->last; k++)
        text_put(t, "    const bool own%d = y + (%d) >= top && y + (%d) < bottom;\n",
                 k - pass->first, s->down[k], s->down[k]);
    carried_text(s, pass, t, true);
    text_put(t,
             "    const int row_inside = 1%s;\n    for (int x = first - %d; x < last + %d; x "
             "+= VECTOR) {\n",
             boxes && e->row_tests.data ? e->row_tests.data : "", pass->before, pass->after);
    prefetch_text(s, pass, t);
    if (boxes)
        text_put(t,
                 "        if (row_inside && x >= inside.x && x < inside.y) {\n"
                 "#define BOX(e) ((VI)(-1))\n#define ROW_STORE STORE_INSIDE\n"
                 "%s#undef BOX\n#undef ROW_STORE\n        continue;\n        }\n",
                 e->body.data);
    text_put(t,
             "#define BOX(e) (e)\n#define ROW_STORE STORE_AT_EDGE\n"
             "%s#undef BOX\n#undef ROW_STORE\n    }\n}\n",
             e->body.data);
    s->failed = s->failed || t->failed || e->failed || e->body.failed || e->rows.failed ||
                e->constants.failed || e->row_tests.failed || e->column_tests.failed;
}

static void make_pass(struct strips *s, int number)
{
    struct pass *pass = &s->passes[number];
    pass_values(s, pass);
    if (!s->failed)
        pass_text(s, pass);
    if (!s->failed)
        span_text(s, pass);
    pass->same = number;
    for (int i = number - 1; i >= 0 && !s->failed; i--)
        if (text_same(&s->passes[i].text, &pass->text) &&
            text_same(&s->passes[i].span, &pass->span))
            pass->same = i;
}

/* ---- the kernel ---- */

static void collect_arguments(struct strips *s)
{
    for (int k = 0; k < s->passes_count; k++) {
        const struct emitter *e = &s->passes[k].e;
        for (int i = 0; i < e->pointers_count; i++) {
            int node = e->seen_pointers[i].node;
            if (s->g->nodes[node].leaf && !s->number[node]) {
                add_argument(s, ARGUMENT_INPUT, node, 0);
                s->number[node] = node + 1;
            }
        }
        bool fresh = false;
        for (int i = 0; i < e->arguments_count; i++) {
            const struct kernel_argument *a = &e->arguments[i];
            if (a->kind == ARGUMENT_CONSTANT) {
                fresh = !s->number[a->node];
                s->number[a->node] = fresh ? ++s->constants_count : s->number[a->node];
            }
            if (fresh)
                add_argument(s, a->kind, a->node, a->size);
        }
    }
    for (int i = 0; i < s->stores_count; i++)
        if (s->g->nodes[s->stores[i]].target)
            add_argument(s, ARGUMENT_OUTPUT, s->stores[i], 0);
    add_argument(s, ARGUMENT_SCRATCH, 0, 0);
}

static void pass_numbers(const struct strips *s, struct text *t, const struct emitter *e)
{
    for (int i = 0; i < e->arguments_count; i++)
        text_put(t, ", %c%d", e->arguments[i].kind == ARGUMENT_CONSTANT ? 'a' : 'h',
                 s->number[e->arguments[i].node] - 1);
}

static void kernel_head(struct strips *s, struct text *t)
{
    text_put(t, "__kernel WHOLE_VECTORS void k(int W, int PITCH, int RUN, int PLOG2, int "
                "RATIO, int D0, int "
                "COLUMNS, int NEAR");
    int constant = 0;
    for (int i = 0; i < s->arguments_count; i++) {
        const struct kernel_argument *a = &s->arguments[i];
        struct machine_type type = s->g->nodes[a->node].type;
        if (a->kind == ARGUMENT_INPUT)
            text_put(t, ",\n    const __global %s *restrict b%d", memory_type(type), a->node);
        else if (a->kind == ARGUMENT_OUTPUT)
            text_put(t, ",\n    __global %s *restrict o%d", memory_type(type), a->node);
        else if (a->kind == ARGUMENT_CONSTANT)
            emit_number(t, s->g, a->node, constant++);
        else if (a->kind == ARGUMENT_SECOND)
            text_put(t, ", ulong h%d", constant - 1);
        else
            text_put(t, ",\n    __global uchar *scratch");
    }
    text_put(
        t,
        ")\n{\n"
        "    const int top = get_global_id(1) * RUN, bottom = min(top + RUN, D0);\n"
        "    const int first = get_global_id(0) * COLUMNS;\n"
        "    const int last = get_global_id(0) + 1 == get_global_size(0) ? W : first + "
        "COLUMNS;\n"
        "    __global uchar *const near = scratch + (get_global_id(1) * get_global_size(0) +\n"
        "        get_global_id(0)) * (size_t)(NEAR * %d);\n",
        s->memory + 8);
    for (int i = 0; i < s->g->count; i++)
        if (s->ring_rows[i])
            text_put(t, "    __global %s *const n%d = (__global %s *)(near + NEAR * %d);\n",
                     memory_type(s->g->nodes[i].type), i, memory_type(s->g->nodes[i].type),
                     s->ring_at[i]);
    for (int k = 0; k < s->passes_count; k++) {
        text_put(t, "    const int2 inside%d = ", k);
        if (has_boxes(s, &s->passes[k].e)) {
            text_put(t, "s%d_inside(W, first, last", s->passes[k].same);
            pass_numbers(s, t, &s->passes[k].e);
            text_put(t, ");\n");
        } else {
            text_put(t, "(int2)(0, 0);\n");
        }
    }
}

static void ring_row(struct strips *s, struct text *t, int node, int down)
{
    text_put(t, ",\n                n%d + (ring(y + (%d), %d) * NEAR + %d) - first", node, down,
             s->ring_rows[node], s->margin);
}

static void array_row(struct text *t, char letter, int node, int down)
{
    text_put(t, ",\n                %c%d + ((size_t)wrap(y + (%d), D0) * PITCH + HALO)", letter,
             node, down);
}

static void pass_call(struct strips *s, struct text *t, int k)
{
    const struct pass *pass = &s->passes[k];
    const struct emitter *e = &pass->e;
    text_put(t,
             "        {\n            const int y = i - %d;\n"
             "            if (y >= top - %d && y < bottom + %d)\n"
             "                s%d(W, PITCH, PLOG2, RATIO, D0, y, top, bottom, first, last, "
             "inside%d",
             pass->delay, pass->above, pass->below, pass->same, k);
    for (int i = 0; i < e->pointers_count; i++) {
        const struct pointer *p = &e->seen_pointers[i];
        int down = rows_down(s, e, p);
        if (s->g->nodes[p->node].leaf)
            array_row(t, 'b', p->node, down);
        else
            ring_row(s, t, p->node, down);
    }
    for (int i = 0; i < pass->outputs_count; i++) {
        int node = pass->outputs[i].node, down = s->down[s->g->nodes[node].stage];
        if (pass->outputs[i].array)
            array_row(t, 'o', node, down);
        else
            ring_row(s, t, node, down);
    }
    pass_numbers(s, t, e);
    text_put(t, ");\n        }\n");
}

/* What has lanes beyond a row's ends: each kind that arrays are of. */
static void edges_text(const struct strips *s, struct text *t)
{
    static const char *const kinds[][2] = {
        {"bit", "uchar"}, {"u8", "uchar"},  {"u16", "ushort"}, {"u32", "uint"},
        {"u64", "ulong"}, {"f32", "float"}, {"f64", "double"}};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        bool used = false;
        for (int k = 0; k < s->arguments_count && !used; k++) {
            int kind = s->arguments[k].kind;
            used = (kind == ARGUMENT_INPUT || kind == ARGUMENT_OUTPUT) &&
                   !strcmp(memory_kind(s->g->nodes[s->arguments[k].node].type), kinds[i][0]);
        }
        if (used)
            text_put(t, "EDGES(%s, %s)\n", kinds[i][0], kinds[i][1]);
    }
}

static void kernel_text(struct strips *s, struct text *t)
{
    bool integers = false;
    int begin = 0, end = 0;
    for (int k = 0; k < s->passes_count; k++) {
        const struct pass *pass = &s->passes[k];
        integers = integers || pass->e.integers;
        begin = pass->delay - pass->above < begin ? pass->delay - pass->above : begin;
        widen(&end, pass->delay + pass->below);
    }
    if (integers)
        text_put(t, "%s", kernel_integers_cl);
    text_put(t, "%s", kernel_strips_cl);
    edges_text(s, t);
    for (int k = 0; k < s->passes_count; k++) {
        if (s->passes[k].same == k && has_boxes(s, &s->passes[k].e))
            text_put(t, "__attribute__((noinline)) int2 s%d_inside%s\n", k,
                     s->passes[k].span.data);
        if (s->passes[k].same == k)
            text_put(t, "__attribute__((noinline)) WHOLE_VECTORS void s%d%s\n", k,
                     s->passes[k].text.data);
    }
    kernel_head(s, t);
    text_put(t, "    for (int i = top + (%d); i < bottom + (%d); i++) {\n", begin, end);
    for (int k = 0; k < s->passes_count; k++)
        pass_call(s, t, k);
    text_put(t, "    }\n}\n");
}

/* What passes read and write of a ring's row. */
static void find_margin(struct strips *s)
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
}

/* As many columns as leave the rings near, but not so few that what strips compute twice counts; all strips about as
 * wide. */
static int strip_columns(const struct strips *s, const struct device_shape *shape)
{
    enum { LEAST = 128 };
    int columns = shape->strip_columns, width = s->set->width;
    while (columns > LEAST && columns * s->memory > shape->near_bytes)
        columns = columns / 2 / s->vector * s->vector;
    int strips = (width + columns - 1) / columns;
    columns = width / strips / s->vector * s->vector;
    return columns ? columns : s->vector;
}

/* A row of a ring: as wide as a strip, of which the last takes what is left, too, and both margins. */
static int near_columns(const struct strips *s, int columns)
{
    columns = 2 * columns < s->set->width ? 2 * columns : s->set->width;
    return (columns + 2 * s->margin + 15) / 16 * 16 + 16;
}

static void describe(const struct strips *s, const struct device_shape *shape,
                     struct kernel_text *out)
{
    double bytes = 0;
    for (int k = 0; k < s->passes_count; k++) {
        const struct emitter *e = &s->passes[k].e;
        out->formats = out->formats || e->formats;
        out->math = out->math || e->math;
        out->has_boxes = out->has_boxes || e->row_tests.data || e->column_tests.data;
        out->ops += e->ops;
        out->cost += e->cost;
        out->loads += e->loads;
        widen(&out->strip_margin, s->passes[k].above + s->passes[k].below);
    }
    for (int i = 0; i < s->arguments_count; i++)
        if (s->arguments[i].kind == ARGUMENT_INPUT || s->arguments[i].kind == ARGUMENT_OUTPUT)
            bytes += (double)(s->set->pitch * s->set->rows) *
                     (double)type_bytes(s->g->nodes[s->arguments[i].node].type);
    out->vector = shape->vector;
    out->strip_columns = strip_columns(s, shape);
    out->strip_near = near_columns(s, out->strip_columns);
    out->strip_bytes = (size_t)(s->memory + 8) * (size_t)out->strip_near;
    snprintf(out->options, sizeof out->options, "-DVECTOR=%d -DHALO=%d -DWRAPS=0 -DSTREAMS=%d",
             out->vector, s->set->halo,
             emit_streams(shape, s->set, out->vector, bytes) ? 1 : 0);
}

static void strips_finish(struct strips *s)
{
    for (int k = 0; s->stages && k < s->stages_count; k++) {
        emitter_finish(&s->stages[k].e);
        free(s->stages[k].e.arguments);
    }
    for (int k = 0; s->passes && k < s->passes_count; k++) {
        emitter_finish(&s->passes[k].e);
        free(s->passes[k].e.arguments);
        free(s->passes[k].together.carried);
        free(s->passes[k].text.data);
        free(s->passes[k].span.data);
        free(s->passes[k].outputs);
    }
    free(s->stages);
    free(s->passes);
    free(s->down);
    free(s->ahead);
    free(s->bits_matter);
    free(s->ring_rows);
    free(s->ring_at);
    free(s->number);
}

bool emit_strips(const struct plan_graph *g, const int *stores, int count,
                 const struct vpset *set, const struct device_shape *shape,
                 struct kernel_text *out)
{
    struct strips s = {
        .g = g, .set = set, .stores = stores, .stores_count = count, .vector = shape->vector};
    struct text t = {0};
    memset(out, 0, sizeof *out);
    for (int i = 0; i < count; i++)
        widen(&s.stages_count, g->nodes[stores[i]].stage + 1);
    s.stages = calloc((size_t)s.stages_count, sizeof *s.stages);
    s.passes = calloc((size_t)s.stages_count, sizeof *s.passes);
    s.down = calloc((size_t)s.stages_count, sizeof *s.down);
    s.ahead = calloc((size_t)s.stages_count, sizeof *s.ahead);
    s.bits_matter = calloc((size_t)g->count, sizeof *s.bits_matter);
    s.ring_rows = calloc((size_t)g->count, sizeof *s.ring_rows);
    s.ring_at = calloc((size_t)g->count, sizeof *s.ring_at);
    s.number = calloc((size_t)g->count, sizeof *s.number);
    s.failed = !s.stages || !s.passes || !s.down || !s.ahead || !s.bits_matter ||
               !s.ring_rows || !s.ring_at || !s.number;
    for (int k = 0; k < s.stages_count && !s.failed; k++)
        stage_values(&s, k);
    bool good = !s.failed;
    if (good) {
        find_bits(&s);
        make_passes(&s);
        schedule(&s);
        lay_out(&s);
        good = suits(&s);
    }
    for (int k = 0; k < s.passes_count && good; k++) {
        make_pass(&s, k);
        good = !s.failed;
    }
    if (good) {
        find_margin(&s);
        good = s.margin * 8 <= DEVICE_GUARD_BYTES;
    }
    if (good) {
        collect_arguments(&s);
        kernel_text(&s, &t);
        describe(&s, shape, out);
        good = !s.failed && !t.failed;
    }
    if (good) {
        out->text = t.data;
        out->arguments = s.arguments;
        out->arguments_count = s.arguments_count;
    } else {
        free(t.data);
        free(s.arguments);
    }
    strips_finish(&s);
    return good;
}
