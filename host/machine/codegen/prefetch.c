/* prefetch.c - which rows a pass prefetches. */
#include "codegen/strips.h"

/* Whether this is the first of the rows of an array that a pass reaches. */
static bool comes_first(const struct strips *s, const struct pass *pass, const struct access *p)
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

static bool is_fetched(const struct strips *s, const struct pass *pass, const struct access *p)
{
    return pass->inside[p->node] && comes_first(s, pass, p);
}

static char next_row(const struct strips *s)
{
    return s->downward > 0 ? '+' : '-';
}

void prefetch_columns(const struct strips *s, struct pass *pass, struct text *t)
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

void prefetch_outside(const struct strips *s, struct pass *pass, struct text *t)
{
    const struct emitter *e = &pass->e;
    for (int i = 0; i < e->pointers_count; i++)
        if (!pass->inside[e->seen_pointers[i].node] &&
            comes_first(s, pass, &e->seen_pointers[i]))
            text_put(t, "        PREFETCH(p%d %c PITCH + x, 0);\n", i, next_row(s));
}

void prefetch_beyond(const struct strips *s, struct pass *pass, struct text *t)
{
    const struct emitter *e = &pass->e;
    for (int i = 0; i < e->pointers_count; i++) {
        const struct access *p = &e->seen_pointers[i];
        if (comes_first(s, pass, p) && p->low < 0)
            text_put(t, "    PREFETCH(p%d %c PITCH + first - %d, 0);\n", i, next_row(s),
                     pass->before + 1);
        if (comes_first(s, pass, p) && p->high > 0)
            text_put(t, "    PREFETCH(p%d %c PITCH + last + %d, 0);\n", i, next_row(s),
                     pass->after);
    }
}

void prefetch_rows(const struct strips *s, struct pass *pass, struct text *before,
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

int prefetch_arrays(const struct strips *s, const struct pass *pass)
{
    int count = 0;
    for (int i = 0; i < pass->e.pointers_count; i++)
        count += is_fetched(s, pass, &pass->e.seen_pointers[i]);
    for (int i = 0; i < pass->outputs_count; i++)
        count += pass->outputs[i].array;
    return count;
}
