/* strips_pass.c - the text of a pass: see strips.h. */
#include <stdlib.h>

#include "base/arrays.h"
#include "base/node_ops.h"
#include "codegen/spell.h"
#include "codegen/strips.h"

int strips_border_of(const struct strips *s, int node)
{
    for (int i = 0; i < s->in_place.leaves_count; i++)
        if (s->in_place.leaves[i] == node)
            return i;
    return -1;
}

bool strips_in_places(const struct strips *s, int output)
{
    for (int i = 0; i < s->in_place.pairs_count; i++)
        if (s->in_place.pairs[i].output == output)
            return true;
    return false;
}

static void output_add(struct pass *pass, struct output output)
{
    pass->outputs[pass->outputs_count++] = output;
}

static struct operand output_value(struct strips *s, struct pass *pass, int node, bool array)
{
    struct emitter *e = &pass->e;
    return emit_value(e, node, emit_row(e, 0, s->down[node]), s->ahead[node] * s->vector,
                      array || s->bits_matter[node]);
}

static void ring_output(struct strips *s, struct pass *pass, int node)
{
    struct operand v = output_value(s, pass, node, false);
    text_put(&pass->e.body, "        RING_STORE(%s, q%d, x + %d, %s);\n",
             memory_kind(s->g->nodes[node].type), pass->outputs_count,
             s->ahead[node] * s->vector, v.text);
    output_add(pass, (struct output){.node = node});
}

/* Stores of one turn to arrays, at the same rows and columns. */
static bool stored_together(const struct strips *s, int store, int other)
{
    const struct plan_node *n = &s->g->nodes[store], *o = &s->g->nodes[other];
    return n->target && o->target && n->stage == o->stage && s->down[store] == s->down[other] &&
           s->ahead[store] == s->ahead[other];
}

static bool is_first_there(const struct strips *s, int store)
{
    for (int i = 0; i < s->stores_count; i++)
        if (stored_together(s, store, s->stores[i]))
            return s->stores[i] == store;
    return false;
}

/* That, and those that are stored together with it: what asks whether a row and a vector of it
 * are the strip's own asks for all of them. */
static void array_outputs(struct strips *s, struct pass *pass, int first)
{
    struct emitter *e = &pass->e;
    int columns = s->ahead[first] * s->vector;
    bool always = columns >= pass->before && columns <= -pass->after;
    text_put(&e->body, "        if (own%d", pass->outputs_count);
    if (!always && !pass->even)
        text_put(&e->body, " && x + %d >= first && x + %d < last", columns, columns);
    text_put(&e->body, ") {\n            const bool at_end = AT_END(x + %d);\n", columns);
    for (int i = 0; i < s->stores_count; i++) {
        int node = s->stores[i];
        if (!stored_together(s, first, node))
            continue;
        text_put(&e->body, "            ROW_STORE(%s, q%d, x + %d, %s);\n",
                 memory_kind(s->g->nodes[node].type), pass->outputs_count, columns,
                 output_value(s, pass, node, true).text);
        output_add(pass, (struct output){.node = node, .array = true, .asks = node == first});
    }
    text_put(&e->body, "        }\n");
}

/* In strips as wide as a row: whether all that a pass stores is of the same columns. Those are
 * then all of the loop's but for the first ones, where it only gets ready. */
static void find_even(const struct strips *s, struct pass *pass)
{
    int count = 0;
    pass->even = s->whole;
    for (int i = 0; i < s->stores_count; i++) {
        int node = s->stores[i], stage = s->g->nodes[node].stage;
        if (stage < pass->first || stage > pass->last ||
            (!s->g->nodes[node].target && !s->ring_rows[node]))
            continue;
        int columns = s->ahead[node] * s->vector;
        pass->even = pass->even && (count == 0 || columns == pass->columns);
        pass->columns = columns;
        count++;
    }
}

/* What the pass still wants of the row of a ring that it is about to store another row over. */
static void overwritten_loads(struct strips *s, struct pass *pass, int node)
{
    struct emitter *e = &pass->e;
    int stage = e->stage;
    for (int k = 0; k < s->units_count; k++) {
        const struct unit *to = &s->units[k];
        if (to->stage <= stage || to->stage > pass->last)
            continue;
        for (int i = 0; i < to->looks.count; i++) {
            const struct access *p = &to->looks.list[i];
            int down = (pass->delay - to->delay) * s->downward + accesses_down(&to->looks, p),
                apart = down - s->down[node];
            e->stage = to->stage;
            if (p->node == node && apart && apart % s->ring_rows[node] == 0)
                emit_value(e, node, emit_row(e, 0, down), s->ahead[node] * s->vector, false);
        }
    }
    e->stage = stage;
}

static void pass_values(struct strips *s, struct pass *pass)
{
    find_even(s, pass);
    struct emitter *e = &pass->e;
    emitter_init(e, s->g, s->set, pass->first);
    e->lane = s->lane;
    pass->outputs = calloc(2 * (size_t)s->stores_count, sizeof *pass->outputs);
    if (!pass->outputs || e->failed) {
        s->failed = true;
        return;
    }
    pass->together = (struct together){.first = pass->first,
                                       .down = s->down,
                                       .ahead = s->ahead,
                                       .direction = s->rightward,
                                       .vector = s->vector,
                                       .bits_matter = s->bits_matter};
    e->bare = true;
    e->together = &pass->together;
    for (e->stage = pass->first; e->stage <= pass->last && !e->failed; e->stage++) {
        for (int i = 0; i < s->stores_count && !e->failed; i++)
            if (s->g->nodes[s->stores[i]].stage == e->stage)
                output_value(s, pass, s->stores[i], s->g->nodes[s->stores[i]].target);
        /* all values before a store asks: what is computed in a branch is not known after it */
        for (int i = 0; i < s->stores_count && !e->failed; i++)
            if (s->g->nodes[s->stores[i]].stage == e->stage && s->ring_rows[s->stores[i]]) {
                overwritten_loads(s, pass, s->stores[i]);
                ring_output(s, pass, s->stores[i]);
            }
        for (int i = 0; i < s->stores_count && !e->failed; i++)
            if (s->g->nodes[s->stores[i]].stage == e->stage && is_first_there(s, s->stores[i]))
                array_outputs(s, pass, s->stores[i]);
    }
    s->failed = s->failed || e->failed || e->body.failed;
}

bool strips_has_boxes(const struct strips *s, const struct emitter *e)
{
    return s->g->boxes && (e->row_tests.data || e->column_tests.data);
}

/* Of which columns on, and up to which, whole vectors are inside all boxes, and stored
 * whole. */
static void span_text(struct strips *s, struct pass *pass)
{
    const struct emitter *e = &pass->e;
    struct text *t = &pass->span;
    int furthest = 0;
    for (int i = 0; i < pass->outputs_count; i++)
        if (pass->outputs[i].array)
            widen(&furthest, s->ahead[pass->outputs[i].node] * s->vector);
    text_put(t, "(const int W, const int first, const int last");
    emit_numbers(t, e);
    text_put(t,
             ")\n{\n    int from = last + %d, to = from;\n"
             "    for (int x = first - %d; x < last + %d; x += VECTOR)\n"
             "        if (x + %d + VECTOR <= %s%s) {\n"
             "            from = min(from, x);\n            to = x + VECTOR;\n"
             "        }\n    return (int2)(from, to);\n}\n",
             pass->after, pass->before, pass->after, furthest, pass->even ? "W" : "WHOLE",
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
        int node = pass->together.carried[i].node;
        e->stage = s->g->nodes[node].stage;
        text_put(&e->body, "        c%d_1 = %s;\n", i, output_value(s, pass, node, false).text);
    }
}

static bool holds_inside(const struct plan_graph *g, int node)
{
    const struct plan_node *n = &g->nodes[node];
    return emit_is_box(g, n) || (n->op == MACHINE_AND && !n->leaf &&
                                 holds_inside(g, n->in[0]) && holds_inside(g, n->in[1]));
}

static void mark_inside(const struct plan_graph *g, bool *inside, int node, int stage)
{
    const struct plan_node *n = &g->nodes[node];
    if (inside[node])
        return;
    inside[node] = true;
    if (n->constant || plan_loads(n, stage))
        return;
    bool selects = n->op == NODE_SELECT && holds_inside(g, n->in[0]);
    for (int k = selects; k < (selects ? 2 : node_ops[n->op].inputs); k++)
        mark_inside(g, inside, plan_input(g, n, k, stage), stage);
}

/* What is looked at nowhere but outside of boxes is little. */
static void find_inside(struct strips *s, struct pass *pass)
{
    pass->inside = calloc((size_t)s->g->count, sizeof *pass->inside);
    s->failed = s->failed || !pass->inside;
    for (int i = 0; i < s->stores_count && !s->failed; i++) {
        int stage = s->g->nodes[s->stores[i]].stage;
        if (stage >= pass->first && stage <= pass->last)
            mark_inside(s->g, pass->inside, s->stores[i], stage);
    }
}

/* From that column on, before the other: a vector at a time, the way that x goes. */
static void columns_loop(const struct strips *s, struct text *t, const char *from, int from_at,
                         const char *to, int to_at)
{
    if (s->rightward > 0)
        text_put(t, "    for (int x = %s + (%d); x < %s + (%d); x += VECTOR) {\n", from,
                 from_at, to, to_at);
    else
        text_put(t,
                 "    for (int x = (%s + (%d) - 1) & -VECTOR; x >= %s + (%d); x -= VECTOR) {\n",
                 to, to_at, from, from_at);
}

/* The loops over columns; what a turn fetches: inside all boxes, and elsewhere. */
static void loops_text(struct strips *s, struct pass *pass, const char *fetch_inside,
                       const char *fetch)
{
    struct text *t = &pass->text;
    const char *body = pass->e.body.data, *store = pass->even ? "STORE_EVEN" : "STORE_INSIDE";
    int lead = s->rightward > 0 ? pass->before + pass->columns : pass->after - pass->columns;
    if (pass->even && lead > 0) {
        if (s->rightward > 0)
            columns_loop(s, t, "first", -pass->before, "first", -pass->columns);
        else
            columns_loop(s, t, "last", -pass->columns, "last", pass->after);
        text_put(t,
                 "#define BOX(e) (e)\n#define RING_STORE NOT_STORED\n"
                 "#define ROW_STORE NOT_STORED\n%s%s"
                 "#undef BOX\n#undef RING_STORE\n#undef ROW_STORE\n    }\n",
                 fetch, body);
    }
    text_put(t, "#define RING_STORE(kind, q, i, v) OUT_##kind(q, i, v)\n");
    if (pass->even)
        columns_loop(s, t, "first", -pass->columns, "last", -pass->columns);
    else
        columns_loop(s, t, "first", -pass->before, "last", pass->after);
    if (strips_has_boxes(s, &pass->e))
        text_put(t,
                 "        for (; row_inside && x >= inside.x && x < inside.y; x %c= VECTOR) {\n"
                 "%s#define BOX(e) ((VI)(-1))\n#define ROW_STORE %s\n"
                 "%s#undef BOX\n#undef ROW_STORE\n        }\n"
                 "        if (%s + (%d))\n            break;\n",
                 s->rightward > 0 ? '+' : '-', fetch_inside, store, body,
                 s->rightward > 0 ? "x >= last" : "x < first",
                 pass->even         ? -pass->columns
                 : s->rightward > 0 ? pass->after
                                    : -pass->before);
    text_put(t,
             "%s#define BOX(e) (e)\n#define ROW_STORE %s\n"
             "%s#undef BOX\n#undef ROW_STORE\n    }\n#undef RING_STORE\n",
             fetch, pass->even ? store : "STORE_AT_EDGE", body);
    int own = 0;
    for (int i = 0; i < pass->outputs_count && pass->even; i++) {
        own = pass->outputs[i].asks ? i : own;
        if (pass->outputs[i].array)
            text_put(t, "    ROW_ENDS(%s, q%d, own%d);\n",
                     memory_kind(s->g->nodes[pass->outputs[i].node].type), i, own);
    }
}

/* Which of the pass's rows of rings the node's is, so far below the pass's row. */
static int ring_row_of(struct strips *s, struct pass *pass, int node, int down)
{
    int first = s->ring_at[node];
    for (int i = 0; i < pass->ring_rows_count; i++) {
        const struct ring_row *row = &pass->ring_rows[i];
        if (row->rings != s->rings_of[node])
            continue;
        if ((row->down - down) % s->ring_rows[node] == 0)
            return i;
        first = row->first;
    }
    if (pass->ring_rows_count == pass->ring_rows_capacity)
        pass->ring_rows = array_more(pass->ring_rows, &pass->ring_rows_capacity,
                                     sizeof *pass->ring_rows, &s->failed);
    if (s->failed)
        return 0;
    pass->ring_rows[pass->ring_rows_count] =
        (struct ring_row){.rings = s->rings_of[node], .down = down, .first = first};
    return pass->ring_rows_count++;
}

/* A pointer of the pass's to a row of a ring. */
static void near_row(struct strips *s, struct pass *pass, struct text *t, const char *constant,
                     char letter, int number, int node, int down)
{
    int row = ring_row_of(s, pass, node, down);
    const char *type = memory_type(s->g->nodes[node].type);
    if (!s->failed)
        text_put(t,
                 "    %s__global %s *const %c%d = (__global %s *)(n%d + NEAR * (%d)) + (MARGIN "
                 "- first);\n",
                 constant, type, letter, number, type, row,
                 s->ring_at[node] - pass->ring_rows[row].first);
}

/* Its arguments: arrays' rows, rows of rings, numbers. rows: what the rings' rows are called in
 * it. */
static void pass_head(struct strips *s, struct pass *pass, struct text *rows)
{
    struct emitter *e = &pass->e;
    struct text *t = &pass->text;
    text_put(t, "(const int W, const int PITCH, const int PLOG2, const int RATIO, const int "
                "D0, const int y,\n    const int top, const int bottom, const int first, "
                "const int last, const int2 inside");
    for (int i = 0; i < e->pointers_count; i++) {
        int node = e->seen_pointers[i].node;
        if (s->g->nodes[node].leaf)
            text_put(t, ",\n    const __global %s *%s p%d", memory_type(s->g->nodes[node].type),
                     strips_border_of(s, node) < 0 ? "restrict" : "", i);
        else
            near_row(s, pass, rows, "const ", 'p', i, node,
                     emit_rows_down(e, &e->seen_pointers[i]));
    }
    for (int i = 0; i < pass->outputs_count; i++) {
        int node = pass->outputs[i].node;
        if (pass->outputs[i].array)
            text_put(t, ",\n    __global %s *%s q%d", memory_type(s->g->nodes[node].type),
                     !strips_in_places(s, node) ? "restrict" : "", i);
        else
            near_row(s, pass, rows, "", 'q', i, node, s->down[node]);
    }
    for (int i = 0; i < pass->ring_rows_count; i++)
        text_put(t, ",\n    __global uchar *n%d", i);
    emit_numbers(t, e);
}

/* Which of its outputs' rows are the strip's own. */
static void own_rows_text(const struct strips *s, struct pass *pass)
{
    struct text *t = &pass->text;
    for (int i = 0; i < pass->outputs_count; i++) {
        int down = s->down[pass->outputs[i].node];
        if (pass->outputs[i].asks && pass->above <= down && pass->below <= -down)
            text_put(t, "    const bool own%d = true;\n", i);
        else if (pass->outputs[i].asks)
            text_put(t, "    const bool own%d = y + (%d) >= top && y + (%d) < bottom;\n", i,
                     down, down);
    }
}

/* The next row of arrays is on its way to the caches while this one is computed: rows are
 * shorter than what hardware needs to find out that they follow each other. */
static void pass_loops(struct strips *s, struct pass *pass)
{
    struct text *t = &pass->text, inside = {0}, fetch = {0};
    if (prefetch_arrays(s, pass) > s->shape->arrays_foreseen)
        prefetch_rows(s, pass, t, &inside);
    else
        prefetch_columns(s, pass, &inside);
    prefetch_beyond(s, pass, t);
    text_put(&fetch, "%s", inside.data ? inside.data : "");
    prefetch_outside(s, pass, &fetch);
    s->failed = s->failed || inside.failed || fetch.failed;
    if (!s->failed)
        loops_text(s, pass, inside.data ? inside.data : "", fetch.data);
    free(inside.data);
    free(fetch.data);
}

static void wraps_text(const struct strips *s, struct pass *pass)
{
    for (int i = 0; i < pass->outputs_count; i++) {
        const struct output *o = &pass->outputs[i];
        const char *kind = memory_kind(s->g->nodes[o->node].type);
        if (!o->array && s->wraps[o->node] & WRAPS_RIGHT)
            text_put(&pass->text, "    WRAP_RIGHT(%s, q%d);\n", kind, i);
        if (!o->array && s->wraps[o->node] & WRAPS_LEFT)
            text_put(&pass->text, "    WRAP_LEFT(%s, q%d);\n", kind, i);
    }
}

static void pass_text(struct strips *s, struct pass *pass)
{
    struct emitter *e = &pass->e;
    struct text *t = &pass->text, rows = {0};
    bool boxes = strips_has_boxes(s, e);
    carry(s, pass);
    pass_head(s, pass, &rows);
    text_put(t, ")\n{\n%s    const int row = wrap(y, D0), r0 = row;\n",
             rows.data ? rows.data : "");
    s->failed = s->failed || rows.failed;
    free(rows.data);
    emit_axes(e, t);
    text_put(t, "%s%s", e->rows.data ? e->rows.data : "",
             e->constants.data ? e->constants.data : "");
    own_rows_text(s, pass);
    carried_text(s, pass, t, true);
    text_put(t, "    const int row_inside = 1%s;\n",
             boxes && e->row_tests.data ? e->row_tests.data : "");
    pass_loops(s, pass);
    wraps_text(s, pass);
    text_put(t, "}\n");
    s->failed = s->failed || t->failed || e->failed || e->body.failed || e->rows.failed ||
                e->constants.failed || e->row_tests.failed || e->column_tests.failed;
}

void strips_pass_make(struct strips *s, int number)
{
    struct pass *pass = &s->passes[number];
    pass_values(s, pass);
    if (!s->failed)
        find_inside(s, pass);
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
