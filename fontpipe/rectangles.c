/* rectangles.c - see master.h. A master is cut along its rows or along its columns, whichever
 * gives fewer rectangles: at 860 pixels to the em 354 a letter where the fewest that there can
 * be are 350, which takes a matching between cuts along both and ten times as long. */
#include "edges_internal.h"
#include "internal.h"
#include "master.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void font_rectangles_finish(struct font_rectangles *r)
{
    free(r->items);
    *r = (struct font_rectangles){0};
}

/* ---- rows ---- */

/* The next run of a row that begins at *at or later: false if there is none. */
static bool run_next(const uint64_t *row, int words, int *at, int *begin, int *end)
{
    int i = *at / 64;
    if (i >= words)
        return false;
    uint64_t w = row[i] & ~0ull << (*at % 64);
    while (!w) {
        if (++i == words)
            return false;
        w = row[i];
    }
    *begin = 64 * i + __builtin_ctzll(w);
    w = ~row[i] & ~0ull << (*begin % 64);
    while (!w) {
        if (++i == words) {
            *end = *at = 64 * words;
            return true;
        }
        w = ~row[i];
    }
    *end = *at = 64 * i + __builtin_ctzll(w);
    return true;
}

static enum font_status rectangle_add(struct font_rectangles *r, int x0, int y0, int x1, int y1)
{
    if (!array_reserve(&r->items, &r->capacity, r->count + 1, sizeof *r->items))
        return font_fail(FONT_NO_MEMORY, "no memory for rectangles");
    r->items[r->count++] = (struct font_rectangle){x0, y0, x1, y1};
    return FONT_OK;
}

/* Runs of black that are the same in rows that follow each other. */
static enum font_status rows_join(struct font_rectangles *r, const struct font_master *m)
{
    r->count = 0;
    /* The rectangles that still grow, from left to right, as indices into items: of the row
     * above, and of this row. */
    size_t most = (size_t)m->width_px / 2 + 2;
    int *open = calloc(2 * most, sizeof *open), *next = open ? open + most : NULL;
    if (!open)
        return font_fail(FONT_NO_MEMORY, "no memory for rectangles");
    int open_count = 0;
    for (int y = 0; y < m->height_px; y++) {
        const uint64_t *row = m->bits + (size_t)y * (size_t)m->row_words;
        int next_count = 0, at = 0, x0, x1, k = 0, top = m->top_px + y;
        while (run_next(row, m->row_words, &at, &x0, &x1)) {
            x0 += m->left_px;
            x1 += m->left_px;
            while (k < open_count && r->items[open[k]].x0 < x0)
                k++;
            if (k < open_count && r->items[open[k]].x0 == x0 && r->items[open[k]].x1 == x1) {
                r->items[open[k]].y1 = top + 1;
                next[next_count++] = open[k];
                continue;
            }
            enum font_status status = rectangle_add(r, x0, top, x1, top + 1);
            if (status != FONT_OK) {
                free(open < next ? open : next);
                return status;
            }
            next[next_count++] = r->count - 1;
        }
        int *swap = open;
        open = next;
        next = swap;
        open_count = next_count;
    }
    free(open < next ? open : next);
    return FONT_OK;
}

/* ---- columns ---- */

/* The first run of bits that are set, which is taken away. */
static void bits_take(uint64_t *bits, int *begin, int *end)
{
    *begin = __builtin_ctzll(*bits);
    uint64_t filled = *bits + (1ull << *begin);
    *end = filled ? __builtin_ctzll(filled) : 64;
    *bits &= *end < 64 ? ~0ull << *end : 0;
}

/* The columns x0..x1 - 1 of black end above row y. Neighbouring columns that also began at the
 * same row form a rectangle. */
static enum font_status columns_end(struct font_rectangles *r, const int *began, int x0, int x1,
                                    int y)
{
    while (x0 < x1) {
        struct font_rectangle *last = r->count ? &r->items[r->count - 1] : NULL;
        int from = x0, top = began[x0];
        while (x0 < x1 && began[x0] == top)
            x0++;
        if (last && last->x1 == from && last->y0 == top && last->y1 == y) {
            last->x1 = x0; /* begun in the word before */
            continue;
        }
        enum font_status status = rectangle_add(r, from, top, x0, y);
        if (status != FONT_OK)
            return status;
    }
    return FONT_OK;
}

/* Runs of columns that begin and end with those beside them. */
static enum font_status columns_join(struct font_rectangles *r, const struct font_master *m)
{
    size_t words = (size_t)m->row_words;
    uint64_t *white = calloc(words + 1, sizeof *white);
    int *began = calloc(64 * words + 1, sizeof *began), x0, x1;
    enum font_status status =
        white && began ? FONT_OK : font_fail(FONT_NO_MEMORY, "no memory for rectangles");
    for (int y = 0; status == FONT_OK && y <= m->height_px; y++) {
        const uint64_t *above = y ? m->bits + (size_t)(y - 1) * words : white;
        const uint64_t *below = y < m->height_px ? m->bits + (size_t)y * words : white;
        for (size_t i = 0; i < words; i++) {
            int x = 64 * (int)i;
            if (above[i] == below[i])
                continue;
            for (uint64_t ends = above[i] & ~below[i]; ends && status == FONT_OK;) {
                bits_take(&ends, &x0, &x1);
                status = columns_end(r, began, x + x0, x + x1, y);
            }
            for (uint64_t begins = below[i] & ~above[i]; begins;) {
                bits_take(&begins, &x0, &x1);
                for (; x0 < x1; x0++)
                    began[x + x0] = y;
            }
        }
    }
    free(white);
    free(began);
    for (int i = 0; i < r->count; i++) {
        struct font_rectangle *q = &r->items[i];
        *q = (struct font_rectangle){q->x0 + m->left_px, q->y0 + m->top_px, q->x1 + m->left_px,
                                     q->y1 + m->top_px};
    }
    return status;
}

enum font_status font_rectangles_make_rows(struct font_rectangles *r,
                                           const struct font_master *m)
{
    r->em_px = m->em_px;
    r->advance_px = m->advance_px;
    r->columns = false;
    return rows_join(r, m);
}

enum font_status font_rectangles_make(struct font_rectangles *r, const struct font_master *m)
{
    struct font_rectangles columns = {
        .em_px = m->em_px, .advance_px = m->advance_px, .columns = true};
    enum font_status status = font_rectangles_make_rows(r, m);
    if (status == FONT_OK)
        status = columns_join(&columns, m);
    if (status == FONT_OK && columns.count < r->count) {
        struct font_rectangles rows = *r;
        *r = columns;
        columns = rows;
    }
    font_rectangles_finish(&columns);
    return status;
}

/* ---- what is done with them ---- */

static void all_turn(struct font_rectangles *r)
{
    for (int i = 0; i < r->count; i++) {
        struct font_rectangle q = r->items[i];
        r->items[i] = (struct font_rectangle){q.y0, q.x0, q.y1, q.x1};
    }
}

static int tops_compare(const void *a, const void *b)
{
    const struct font_rectangle *p = a, *q = b;
    return p->y0 != q->y0 ? (p->y0 > q->y0) - (p->y0 < q->y0)
                          : (p->x0 > q->x0) - (p->x0 < q->x0);
}

int font_rectangles_merge(struct font_rectangles *r, int slack)
{
    int before = r->count;
    if (r->columns)
        all_turn(r);
    if (r->count)
        qsort(r->items, (size_t)r->count, sizeof *r->items, tops_compare);
    /* What follows directly lies among the next ones. */
    for (int i = 0; i < r->count; i++)
        for (int k = i + 1; k < r->count && r->items[k].y0 <= r->items[i].y1; k++) {
            struct font_rectangle *a = &r->items[i], *b = &r->items[k];
            if (b->y0 != a->y1 || abs(a->x0 - b->x0) > slack || abs(a->x1 - b->x1) > slack)
                continue;
            int ha = a->y1 - a->y0, hb = b->y1 - b->y0, h = ha + hb;
            a->x0 = (int)lrint(((double)a->x0 * ha + (double)b->x0 * hb) / h);
            a->x1 = (int)lrint(((double)a->x1 * ha + (double)b->x1 * hb) / h);
            a->y1 = b->y1;
            memmove(b, b + 1, (size_t)(r->count - k - 1) * sizeof *b);
            r->count--;
            k = i; /* it has grown: those after it may follow now */
        }
    if (r->columns)
        all_turn(r);
    return before - r->count;
}

struct font_rectangle font_rectangles_box(const struct font_rectangles *r)
{
    struct font_rectangle box = r->count ? r->items[0] : (struct font_rectangle){0};
    for (int i = 1; i < r->count; i++) {
        const struct font_rectangle *q = &r->items[i];
        box.x0 = q->x0 < box.x0 ? q->x0 : box.x0;
        box.y0 = q->y0 < box.y0 ? q->y0 : box.y0;
        box.x1 = q->x1 > box.x1 ? q->x1 : box.x1;
        box.y1 = q->y1 > box.y1 ? q->y1 : box.y1;
    }
    return box;
}

enum font_status font_rectangles_edges(const struct font_rectangles *r, double size_px,
                                       struct font_edges *e)
{
    e->nodes_count = e->lines_count = e->arcs_count = 0;
    e->x0 = e->y0 = 1;
    e->x1 = e->y1 = -1;
    if (!(size_px > 0 && size_px <= FONT_SIDE_MAX) || (r->count && r->em_px < 1))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a size must be above 0 and at most %d pixels (got %g)", FONT_SIDE_MAX,
                         size_px);
    double scale = r->count ? size_px / r->em_px : 0;
    e->advance_px = r->advance_px * scale;
    const struct font_rectangle box = font_rectangles_box(r);
    if (!(fabs(box.x0 * scale) <= FONT_SIDE_MAX && fabs(box.x1 * scale) <= FONT_SIDE_MAX &&
          fabs(box.y0 * scale) <= FONT_SIDE_MAX && fabs(box.y1 * scale) <= FONT_SIDE_MAX))
        return font_fail(FONT_TOO_LARGE, "a glyph would reach more than %d pixels",
                         FONT_SIDE_MAX);
    if (!r->count)
        return FONT_OK;
    if (r->count > FONT_EDGES_MAX / 2)
        return font_fail(FONT_TOO_LARGE, "a glyph has too many rectangles");
    enum font_status status = font_lines_reserve(e, 2 * r->count);
    if (status != FONT_OK)
        return status;
    for (int i = 0; i < r->count; i++) {
        const struct font_rectangle *q = &r->items[i];
        for (int k = 0; k < 2; k++) {
            e->line_x0[2 * i + k] = (float)((k ? q->x1 : q->x0) * scale);
            e->line_x1[2 * i + k] = (float)((k ? q->x0 : q->x1) * scale);
            e->line_y[2 * i + k] = (float)((k ? q->y1 : q->y0) * scale);
        }
    }
    e->lines_count = 2 * r->count;
    e->x0 = (float)(box.x0 * scale);
    e->y0 = (float)(box.y0 * scale);
    e->x1 = (float)(box.x1 * scale);
    e->y1 = (float)(box.y1 * scale);
    return FONT_OK;
}
