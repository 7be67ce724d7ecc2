/* master_outline.c - masters, and rectangles, as outlines again: see master.h.
 *
 * The boundary is walked along the sides of black pixels, ink at the right hand. Where a walk
 * comes to a corner of pixels it sees two of them ahead, and turns to the right where the right
 * one is white: so pixels that meet in a corner alone are apart, and no walk meets itself.
 *
 *        E             A pixel's sides are walked east above it, south at its right, west below
 *                      it,
 *      +---->          north at its left. Each walk goes east somewhere, so it is enough to
 *                      begin
 *    N |####| S        where a pixel has none above it.
 *      <----+
 *        W */
#include "internal.h"
#include "master.h"

#include <stdlib.h>

struct walk {
    const struct font_master *master;
    struct font_outline *outline;
    uint64_t *gone_east; /* of pixels: their upper sides */
    double unit;
    bool rough, begun;
    enum font_status status;
};

static const int step_x[4] = {1, 0, -1, 0}, step_y[4] = {0, 1, 0, -1};

static void point_put(struct walk *w, double x, double y)
{
    if (w->status != FONT_OK)
        return;
    w->status = w->begun ? font_outline_line(w->outline, x * w->unit, -y * w->unit)
                         : font_outline_move(w->outline, x * w->unit, -y * w->unit);
    w->begun = true;
}

/* The corner (x, y) that is come to in one direction and left in another. */
static void corner_put(struct walk *w, int x, int y, int from, int to)
{
    if (!w->rough) {
        point_put(w, x, y);
        return;
    }
    point_put(w, x - 0.5 * step_x[from], y - 0.5 * step_y[from]);
    point_put(w, x + 0.5 * step_x[to], y + 0.5 * step_y[to]);
}

/* The pixels ahead of the corner (x, y), at the right hand or the left of the way. */
static bool ahead(const struct walk *w, int x, int y, int way, bool right)
{
    static const int right_x[4] = {0, -1, -1, 0}, right_y[4] = {0, 0, -1, -1};
    static const int left_x[4] = {0, 0, -1, -1}, left_y[4] = {-1, 0, 0, -1};
    return right ? font_master_at(w->master, x + right_x[way], y + right_y[way])
                 : font_master_at(w->master, x + left_x[way], y + left_y[way]);
}

static uint64_t *bit_of(const struct walk *w, int x, int y, uint64_t *bit)
{
    const struct font_master *m = w->master;
    int c = x - m->left_px, r = y - m->top_px;
    *bit = 1ull << (c % 64);
    return &w->gone_east[(size_t)r * (size_t)m->row_words + (size_t)(c / 64)];
}

/* From the upper left corner of a pixel, until it is there again. */
static void contour_walk(struct walk *w, int x0, int y0)
{
    int x = x0, y = y0, way = 0;
    w->begun = false;
    do {
        uint64_t bit, *word = way == 0 ? bit_of(w, x, y, &bit) : NULL;
        if (word)
            *word |= bit;
        x += step_x[way];
        y += step_y[way];
        int next = !ahead(w, x, y, way, true)   ? (way + 1) % 4
                   : ahead(w, x, y, way, false) ? (way + 3) % 4
                                                : way;
        if (next != way)
            corner_put(w, x, y, way, next);
        way = next;
    } while (w->status == FONT_OK && (x != x0 || y != y0 || way != 0));
    if (w->status == FONT_OK)
        w->status = font_outline_close(w->outline);
}

enum font_status font_master_outline(const struct font_master *m, double units_per_em,
                                     bool rough, struct font_outline *out)
{
    *out = (struct font_outline){.units_per_em = units_per_em};
    struct walk w = {.master = m, .outline = out, .rough = rough};
    size_t words = (size_t)m->row_words * (size_t)m->height_px;
    if (m->em_px < 1)
        return font_fail(FONT_BAD_ARGUMENT, "a master needs pixels to the em");
    w.unit = units_per_em / m->em_px;
    w.gone_east = calloc(words + 1, sizeof *w.gone_east);
    if (!w.gone_east)
        w.status = font_fail(FONT_NO_MEMORY, "no memory for a master's outline");
    for (int y = m->top_px; y < m->top_px + m->height_px && w.status == FONT_OK; y++)
        for (int x = m->left_px; x < m->left_px + m->width_px && w.status == FONT_OK; x++) {
            uint64_t bit;
            if (font_master_at(m, x, y) && !font_master_at(m, x, y - 1) &&
                !(*bit_of(&w, x, y, &bit) & bit))
                contour_walk(&w, x, y);
        }
    free(w.gone_east);
    out->advance = m->advance_px * w.unit;
    if (w.status == FONT_OK && !rough) { /* nothing is covered twice */
        out->turn = 1;
        out->box = font_outline_box(out);
        w.status = font_outline_polynomials(out);
        out->prepared = w.status == FONT_OK;
    }
    if (w.status != FONT_OK)
        font_outline_finish(out);
    return w.status;
}

enum font_status font_rectangles_master(const struct font_rectangles *r, struct font_master *m)
{
    enum { WORDS_MAX = 1 << 22 };
    font_master_finish(m);
    if (r->em_px < 1 || r->em_px > FONT_MASTER_EM_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "rectangles need pixels to the em");
    const struct font_rectangle box = font_rectangles_box(r);
    *m = (struct font_master){.em_px = r->em_px, .advance_px = r->advance_px};
    double wide = (double)box.x1 - box.x0, high = (double)box.y1 - box.y0, work = 0;
    if (wide <= 0 || high <= 0)
        return FONT_OK;
    for (int i = 0; i < r->count; i++)
        work += ((double)r->items[i].x1 - r->items[i].x0) *
                ((double)r->items[i].y1 - r->items[i].y0);
    if ((wide + 63) / 64 * high > WORDS_MAX || work > 64.0 * WORDS_MAX)
        return font_fail(FONT_TOO_LARGE, "rectangles over %.0fx%.0f pixels are too many", wide,
                         high);
    m->left_px = box.x0;
    m->top_px = box.y0;
    m->width_px = (int)wide;
    m->height_px = (int)high;
    m->row_words = (m->width_px + 63) / 64;
    m->bits = calloc((size_t)m->row_words * (size_t)m->height_px, sizeof *m->bits);
    if (!m->bits) {
        font_master_finish(m);
        return font_fail(FONT_NO_MEMORY, "no memory for a master");
    }
    for (int i = 0; i < r->count; i++) {
        const struct font_rectangle *q = &r->items[i];
        font_master_fill(m, q->x0, q->y0, q->x1 - q->x0, q->y1 - q->y0, true);
    }
    return FONT_OK;
}
