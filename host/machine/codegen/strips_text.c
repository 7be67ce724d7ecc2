/* strips_text.c - the text of kernels in strips. See strips.h. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "codegen/narrow.h"
#include "codegen/spell.h"
#include "codegen/strips.h"
#include "kernels.h"

/* -1: it has none. */
static int border_of(const struct strips *s, int node)
{
    for (int i = 0; i < s->in_place.leaves_count; i++)
        if (s->in_place.leaves[i] == node)
            return i;
    return -1;
}

static bool in_places(const struct strips *s, int output)
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

/* That, and those that are stored together with it: what asks whether a row and a vector of it are the strip's own asks
 * for all of them. */
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

/* In strips as wide as a row: whether all that a pass stores is of the same columns. Those are then all of the loop's
 * but for the first ones, where it only gets ready. */
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
        for (int i = 0; i < to->e.pointers_count; i++) {
            const struct pointer *p = &to->e.seen_pointers[i];
            int down = (pass->delay - to->delay) * s->downward + emit_rows_down(&to->e, p),
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

/* Of the rows of an array that a pass reads, the one that it comes to first. */
static bool comes_first(const struct strips *s, const struct pass *pass,
                        const struct pointer *p)
{
    const struct emitter *e = &pass->e;
    bool newest = s->g->nodes[p->node].leaf;
    for (int k = 0; k < e->pointers_count; k++)
        newest = newest && (e->seen_pointers[k].node != p->node ||
                            (emit_rows_down(e, &e->seen_pointers[k]) - emit_rows_down(e, p)) *
                                    s->downward <=
                                0);
    return newest;
}

static bool is_fetched(const struct strips *s, const struct pass *pass, const struct pointer *p)
{
    return pass->inside[p->node] && comes_first(s, pass, p);
}

static char next_row(const struct strips *s)
{
    return s->downward > 0 ? '+' : '-';
}

/* What the next turn of the loop over columns is going to want of the next row. */
static void prefetch_columns(const struct strips *s, struct pass *pass, struct text *t)
{
    const struct emitter *e = &pass->e;
    for (int i = 0; i < e->pointers_count; i++)
        if (is_fetched(s, pass, &e->seen_pointers[i]))
            text_put(t, "        PREFETCH(p%d %c PITCH + x + %d, 0);\n", i, next_row(s),
                     e->seen_pointers[i].high);
    for (int i = 0; i < pass->outputs_count; i++)
        if (pass->outputs[i].array)
            text_put(t, "        PREFETCH_STORE(q%d %c PITCH + x + %d);\n", i, next_row(s),
                     s->ahead[pass->outputs[i].node] * s->vector);
}

/* What is looked at outside of boxes only: a vector or two of a row, each of which would be waited for. */
static void prefetch_outside(const struct strips *s, struct pass *pass, struct text *t)
{
    const struct emitter *e = &pass->e;
    for (int i = 0; i < e->pointers_count; i++)
        if (!pass->inside[e->seen_pointers[i].node] &&
            comes_first(s, pass, &e->seen_pointers[i]))
            text_put(t, "        PREFETCH(p%d %c PITCH + x, 0);\n", i, next_row(s));
}

/* What is looked at beyond the columns that a loop goes over. */
static void prefetch_beyond(const struct strips *s, struct pass *pass, struct text *t)
{
    const struct emitter *e = &pass->e;
    for (int i = 0; i < e->pointers_count; i++) {
        const struct pointer *p = &e->seen_pointers[i];
        if (comes_first(s, pass, p) && p->low < 0)
            text_put(t, "    PREFETCH(p%d %c PITCH + first - %d, 0);\n", i, next_row(s),
                     pass->before + 1);
        if (comes_first(s, pass, p) && p->high > 0)
            text_put(t, "    PREFETCH(p%d %c PITCH + last + %d, 0);\n", i, next_row(s),
                     pass->after);
    }
}

/* Rows one after the other: which rows there are, and what a turn fetches of them. */
static void prefetch_rows(const struct strips *s, struct pass *pass, struct text *before,
                          struct text *turn)
{
    const struct emitter *e = &pass->e;
    char next = next_row(s);
    text_put(before, "    const struct row_ahead ahead[] = {\n");
    for (int i = 0; i < e->pointers_count; i++)
        if (is_fetched(s, pass, &e->seen_pointers[i]))
            text_put(before, "        ROW_AHEAD(p%d %c PITCH)\n", i, next);
    for (int i = 0; i < pass->outputs_count; i++)
        if (pass->outputs[i].array)
            text_put(before, "        STORED_ROW_AHEAD(q%d %c PITCH)\n", i, next);
    text_put(before,
             "        {0, 0}};\n    int row_ahead = 0, done_ahead = 0;\n"
             "    const int each = pieces_each(ahead, (last - first + %d) / VECTOR);\n",
             pass->before + pass->after);
    text_put(turn, "        FETCH_AHEAD\n");
}

static int arrays_of(const struct strips *s, const struct pass *pass)
{
    int count = 0;
    for (int i = 0; i < pass->e.pointers_count; i++)
        count += is_fetched(s, pass, &pass->e.seen_pointers[i]);
    for (int i = 0; i < pass->outputs_count; i++)
        count += pass->outputs[i].array;
    return count;
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
    if (has_boxes(s, &pass->e))
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
        pass->ring_rows = machine_more(pass->ring_rows, &pass->ring_rows_capacity,
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

static void pass_text(struct strips *s, struct pass *pass)
{
    struct emitter *e = &pass->e;
    struct text *t = &pass->text, rows = {0};
    bool boxes = has_boxes(s, e);
    carry(s, pass);
    text_put(t, "(const int W, const int PITCH, const int PLOG2, const int RATIO, const int "
                "D0, const int y,\n    const int top, const int bottom, const int first, "
                "const int last, const int2 inside");
    for (int i = 0; i < e->pointers_count; i++) {
        int node = e->seen_pointers[i].node;
        if (s->g->nodes[node].leaf)
            text_put(t, ",\n    const __global %s *%s p%d", memory_type(s->g->nodes[node].type),
                     border_of(s, node) < 0 ? "restrict" : "", i);
        else
            near_row(s, pass, &rows, "const ", 'p', i, node,
                     emit_rows_down(e, &e->seen_pointers[i]));
    }
    for (int i = 0; i < pass->outputs_count; i++) {
        int node = pass->outputs[i].node;
        if (pass->outputs[i].array)
            text_put(t, ",\n    __global %s *%s q%d", memory_type(s->g->nodes[node].type),
                     !in_places(s, node) ? "restrict" : "", i);
        else
            near_row(s, pass, &rows, "", 'q', i, node, s->down[node]);
    }
    for (int i = 0; i < pass->ring_rows_count; i++)
        text_put(t, ",\n    __global uchar *n%d", i);
    emit_numbers(t, e);
    text_put(t, ")\n{\n%s    const int row = wrap(y, D0), r0 = row;\n",
             rows.data ? rows.data : "");
    s->failed = s->failed || rows.failed;
    free(rows.data);
    emit_axes(e, t);
    text_put(t, "%s%s", e->rows.data ? e->rows.data : "",
             e->constants.data ? e->constants.data : "");
    for (int i = 0; i < pass->outputs_count; i++) {
        int down = s->down[pass->outputs[i].node];
        if (pass->outputs[i].asks && pass->above <= down && pass->below <= -down)
            text_put(t, "    const bool own%d = true;\n", i);
        else if (pass->outputs[i].asks)
            text_put(t, "    const bool own%d = y + (%d) >= top && y + (%d) < bottom;\n", i,
                     down, down);
    }
    carried_text(s, pass, t, true);
    text_put(t, "    const int row_inside = 1%s;\n",
             boxes && e->row_tests.data ? e->row_tests.data : "");
    /* The next row of arrays is on its way to the caches while this one is computed: rows are shorter than what hardware
     * needs to find out that they follow each other. */
    struct text inside = {0}, fetch = {0};
    if (arrays_of(s, pass) > ARRAYS_MANY)
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
    for (int i = 0; i < pass->outputs_count; i++) {
        const struct output *o = &pass->outputs[i];
        const char *kind = memory_kind(s->g->nodes[o->node].type);
        if (!o->array && s->wraps[o->node] & WRAPS_RIGHT)
            text_put(t, "    WRAP_RIGHT(%s, q%d);\n", kind, i);
        if (!o->array && s->wraps[o->node] & WRAPS_LEFT)
            text_put(t, "    WRAP_LEFT(%s, q%d);\n", kind, i);
    }
    text_put(t, "}\n");
    s->failed = s->failed || t->failed || e->failed || e->body.failed || e->rows.failed ||
                e->constants.failed || e->row_tests.failed || e->column_tests.failed;
}

static void make_pass(struct strips *s, int number)
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

/* ---- the kernel ---- */

static void collect_arguments(struct strips *s)
{
    for (int k = 0; k < s->passes_count; k++)
        emit_collect(&s->arguments, &s->passes[k].e, s->number, &s->constants_count,
                     &s->failed);
    for (int i = 0; i < s->stores_count; i++)
        if (s->g->nodes[s->stores[i]].target)
            emit_argument(&s->arguments, ARGUMENT_OUTPUT, s->stores[i], 0, &s->failed);
    if (s->in_place.pairs_count)
        emit_argument(&s->arguments, ARGUMENT_BORDERS, 0, 4, &s->failed);
    emit_argument(&s->arguments, ARGUMENT_SCRATCH, 0, 0, &s->failed);
}

static void kernel_head(struct strips *s, struct text *t)
{
    text_put(t, "__kernel WHOLE_VECTORS void k(int W, int PITCH, int RUN, int PLOG2, int "
                "RATIO, int D0, int "
                "COLUMNS");
    int constant = 0;
    for (int i = 0; i < s->arguments.count; i++) {
        const struct kernel_argument *a = &s->arguments.list[i];
        struct machine_type type = s->g->nodes[a->node].type;
        if (a->kind == ARGUMENT_INPUT)
            text_put(t, ",\n    const __global %s *%s b%d", memory_type(type),
                     border_of(s, a->node) < 0 ? "restrict" : "", a->node);
        else if (a->kind == ARGUMENT_OUTPUT)
            text_put(t, ",\n    __global %s *%s o%d", memory_type(type),
                     in_places(s, a->node) ? "" : "restrict", a->node);
        else if (a->kind == ARGUMENT_BORDERS)
            text_put(t, ",\n    uint borders");
        else if (a->kind == ARGUMENT_SCRATCH)
            text_put(t, ",\n    __global uchar *scratch");
        else
            emit_number(t, s->g, a, &constant);
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
    if (s->in_place.pairs_count)
        text_put(t,
                 "    const __global uchar *const around = scratch + get_global_size(1) * "
                 "get_global_size(0) *\n        (size_t)(NEAR * %d);\n",
                 s->memory + 8);
    for (int k = 0; k < s->passes_count; k++) {
        text_put(t, "    const int2 inside%d = ", k);
        if (has_boxes(s, &s->passes[k].e)) {
            text_put(t, "s%d_inside(W, first, last", s->passes[k].same);
            emit_numbers_passed(t, &s->passes[k].e, s->number);
            text_put(t, ");\n");
        } else {
            text_put(t, "(int2)(0, 0);\n");
        }
    }
}

static void ring_row(const struct strips *s, struct text *t, const struct ring_row *row)
{
    const struct rings *rings = &s->rings[row->rings];
    text_put(t, ",\n                near + NEAR * %d + ring(y + (%d), %d) * (NEAR * %d)",
             rings->at + row->first, row->down, rings->rows, rings->bytes);
}

/* The lowest row of arrays from `from` on, so far below its own, that the pass looks at or stores; INT_MAX: there is none. */
static int row_from(const struct strips *s, const struct pass *pass, int from)
{
    const struct emitter *e = &pass->e;
    int lowest = INT_MAX;
    for (int i = 0; i < e->pointers_count + pass->outputs_count; i++) {
        bool reads = i < e->pointers_count;
        const struct output *o = reads ? NULL : &pass->outputs[i - e->pointers_count];
        if (reads ? !s->g->nodes[e->seen_pointers[i].node].leaf : !o->array)
            continue;
        int down = reads ? emit_rows_down(e, &e->seen_pointers[i]) : s->down[o->node];
        lowest = down >= from && down < lowest ? down : lowest;
    }
    return lowest;
}

/* Where a pass's rows are in arrays, and in what has been copied of such as are written in place: once for all arrays, for in
 * each one's own address compilers would make questions of it again. Returns the lowest of them. */
static int row_places(const struct strips *s, const struct pass *pass, struct text *t)
{
    int lowest = row_from(s, pass, INT_MIN);
    for (int down = lowest; down < INT_MAX; down = row_from(s, pass, down + 1)) {
        int row = down - lowest;
        text_put(t,
                 "                const size_t row%d = (size_t)wrap(y + (%d), D0) * PITCH;\n",
                 row, down);
        if (s->in_place.pairs_count)
            text_put(
                t,
                "                const bool out%d = y + (%d) < top || y + (%d) >= bottom;\n"
                "                const size_t copy%d = border_row(y + (%d), top, bottom) * "
                "PITCH;\n",
                row, down, down, row, down);
    }
    return lowest;
}

static void array_row(struct text *t, char letter, int node, int row)
{
    text_put(t, ",\n                    %c%d + row%d + HALO", letter, node, row);
}

/* One that may be written in place. */
static void bordered_row(const struct strips *s, struct text *t, int border, int row)
{
    const struct in_place *in = &s->in_place;
    int node = in->leaves[border], before = 0;
    for (int i = 0; i < border; i++)
        before += (int)type_bytes(s->g->nodes[in->leaves[i]].type);
    text_put(t,
             ",\n                    (out%d && borders >> %d & 1\n"
             "                        ? (const __global %s *)(around + (size_t)PITCH * %d * "
             "BORDERS) + copy%d\n                        : b%d + row%d) + HALO",
             row, border, memory_type(s->g->nodes[node].type), before, row, node, row);
}

static void pass_call(struct strips *s, struct text *t, int k)
{
    const struct pass *pass = &s->passes[k];
    const struct emitter *e = &pass->e;
    text_put(t,
             "        {\n            const int y = i %c %d;\n"
             "            if (y >= top - %d && y < bottom + %d) {\n",
             s->downward > 0 ? '-' : '+', pass->delay, pass->above, pass->below);
    int lowest = row_places(s, pass, t);
    text_put(t,
             "                s%d(W, PITCH, PLOG2, RATIO, D0, y, top, bottom, first, last, "
             "inside%d",
             pass->same, k);
    for (int i = 0; i < e->pointers_count; i++) {
        const struct pointer *p = &e->seen_pointers[i];
        int row = emit_rows_down(e, p) - lowest, border = border_of(s, p->node);
        if (border >= 0)
            bordered_row(s, t, border, row);
        else if (s->g->nodes[p->node].leaf)
            array_row(t, 'b', p->node, row);
    }
    for (int i = 0; i < pass->outputs_count; i++) {
        int node = pass->outputs[i].node;
        if (pass->outputs[i].array)
            array_row(t, 'o', node, s->down[node] - lowest);
    }
    for (int i = 0; i < pass->ring_rows_count; i++)
        ring_row(s, t, &pass->ring_rows[i]);
    emit_numbers_passed(t, e, s->number);
    text_put(t, ");\n            }\n        }\n");
}

/* What has lanes beyond a row's ends: each kind that is stored. */
static void edges_text(const struct strips *s, struct text *t)
{
    static const char *const kinds[] = {"bit", "u8", "u16", "u32", "u64", "f32", "f64"};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        bool used = false;
        for (int k = 0; k < s->arguments.count && !used; k++)
            used = s->arguments.list[k].kind == ARGUMENT_OUTPUT &&
                   !strcmp(memory_kind(s->g->nodes[s->arguments.list[k].node].type), kinds[i]);
        if (used)
            text_put(t, "EDGES(%s)\n", kinds[i]);
    }
}

static void kernel_text(struct strips *s, const struct device_shape *shape, struct text *t)
{
    bool integers = false;
    int above = 0, below = 0; /* rows, of i */
    for (int k = 0; k < s->passes_count; k++) {
        const struct pass *pass = &s->passes[k];
        integers = integers || pass->e.integers;
        widen(&above, pass->above - pass->delay * s->downward);
        widen(&below, pass->below + pass->delay * s->downward);
    }
    if (integers)
        text_put(t, "%s", kernel_integers_cl);
    if (s->in_place.pairs_count)
        text_put(t, "#define ABOVE %d\n#define BELOW %d\n", s->in_place.above,
                 s->in_place.below);
    text_put(t, "%s", kernel_strips_cl);
    text_put(t, "enum { NEAR = %d, MARGIN = %d }; /* columns of a ring's row, and beyond */\n",
             strips_near_columns(s, strips_columns(s, shape)), s->margin);
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
    text_put(t,
             s->downward > 0 ? "    for (int i = top - %d; i < bottom + %d; i++) {\n"
                             : "    for (int i = bottom + %2$d - 1; i >= top - %1$d; i--) {\n",
             above, below);
    for (int k = 0; k < s->passes_count; k++)
        pass_call(s, t, k);
    text_put(t, "    }\n}\n");
}

/* Smaller arrays are near, and a launch more costs more than it saves. */
enum { IN_PLACE_BYTES = 12 << 20 };

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
    for (int i = 0; i < s->arguments.count; i++)
        if (s->arguments.list[i].kind == ARGUMENT_INPUT ||
            s->arguments.list[i].kind == ARGUMENT_OUTPUT)
            bytes += (double)(s->set->pitch * s->set->rows) *
                     (double)type_bytes(s->g->nodes[s->arguments.list[i].node].type);
    out->vector = s->vector;
    out->strip_columns = strips_columns(s, shape);
    out->in_place = s->in_place;
    out->in_place.pays = bytes > IN_PLACE_BYTES;
    out->strip_bytes =
        (size_t)(s->memory + 8) * (size_t)strips_near_columns(s, out->strip_columns);
    emit_options(out, s->set->halo, false, emit_streams(shape, s->set, out->vector, bytes),
                 s->lane);
}

static void strips_finish(struct strips *s)
{
    for (int k = 0; s->stages && k < s->stages_count; k++) {
        emitter_finish(&s->stages[k].e);
        free(s->stages[k].e.arguments.list);
    }
    for (int k = 0; s->units && k < s->units_count; k++) {
        emitter_finish(&s->units[k].e);
        free(s->units[k].e.arguments.list);
    }
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

static bool strips_kernel(const struct plan_graph *g, const int *stores, int count,
                          const struct vpset *set, const struct device_shape *shape, int lane,
                          struct kernel_text *out)
{
    struct strips s = {.g = g,
                       .set = set,
                       .stores = stores,
                       .stores_count = count,
                       .vector = shape->vector * LANE_WIDE / lane,
                       .lane = lane};
    struct text t = {0};
    memset(out, 0, sizeof *out);
    for (int i = 0; i < count; i++)
        widen(&s.stages_count, g->nodes[stores[i]].stage + 1);
    s.stages = calloc((size_t)s.stages_count, sizeof *s.stages);
    s.passes = calloc((size_t)s.stages_count, sizeof *s.passes);
    s.units = calloc((size_t)count, sizeof *s.units);
    s.unit = calloc((size_t)g->count, sizeof *s.unit);
    s.down = calloc((size_t)g->count, sizeof *s.down);
    s.ahead = calloc((size_t)g->count, sizeof *s.ahead);
    s.bits_matter = calloc((size_t)g->count, sizeof *s.bits_matter);
    s.ring_rows = calloc((size_t)g->count, sizeof *s.ring_rows);
    s.wraps = calloc((size_t)g->count, sizeof *s.wraps);
    s.ring_at = calloc((size_t)g->count, sizeof *s.ring_at);
    s.rings_of = calloc((size_t)g->count, sizeof *s.rings_of);
    s.number = calloc((size_t)g->count, sizeof *s.number);
    s.failed = !s.stages || !s.units || !s.unit || !s.passes || !s.down || !s.ahead ||
               !s.bits_matter || !s.ring_rows || !s.wraps || !s.ring_at || !s.rings_of ||
               !s.number;
    bool good = !s.failed && strips_schedule(&s, shape);
    for (int k = 0; k < s.passes_count && good; k++) {
        make_pass(&s, k);
        good = !s.failed;
    }
    good = good && strips_find_margin(&s);
    if (good) {
        collect_arguments(&s);
        kernel_text(&s, shape, &t);
        describe(&s, shape, out);
        good = !s.failed && !t.failed;
    }
    emit_hand_over(good, &t, &s.arguments, out);
    if (!good) {
        free(s.in_place.pairs);
        out->in_place.pairs = NULL;
    }
    strips_finish(&s);
    return good;
}

bool emit_strips(const struct plan_graph *g, const int *stores, int count,
                 const struct vpset *set, const struct device_shape *shape,
                 struct kernel_text *out)
{
    int lane = shape->narrow ? narrow_lane(g, stores, count, -1) : LANE_WIDE;
    return (lane < LANE_WIDE && strips_kernel(g, stores, count, set, shape, lane, out)) ||
           strips_kernel(g, stores, count, set, shape, LANE_WIDE, out);
}
