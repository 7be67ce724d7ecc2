/* point.c - carets, what a point hits, selections as boxes: see page.h.
 *
 * A line's clusters are known in the order in which they are seen, each with its level. A
 * cluster of several letters that a caret may stand between (a ligature) is divided evenly
 * among them. */
#include "page_internal.h"

#include <math.h>
#include <stdlib.h>

/* The letter that a byte begins; the number of letters behind the last. */
static int letter_of(const struct paragraph *p, int byte)
{
    int low = 0, high = p->count;
    while (low < high) {
        int half = (low + high) / 2;
        if (p->letters[half].byte < byte)
            low = half + 1;
        else
            high = half;
    }
    return low;
}

static int byte_of(const struct paragraph *p, int letter)
{
    return letter < p->count ? p->letters[letter].byte : p->bytes;
}

/* The caret's places within a cluster: how many letters begin one, of begin..end. */
static int parts_of(const struct paragraph *p, int begin, int end)
{
    int n = 0;
    for (int i = begin; i < end; i++)
        n += p->letters[i].grapheme;
    return n;
}

/* Along the line, of the place before `letter` (or behind all) of a cluster. */
static double cluster_at(const struct paragraph *p, const struct set_cluster *c, int letter)
{
    int all = parts_of(p, c->begin, c->end), passed = parts_of(p, c->begin, letter);
    double part = letter >= c->end || !all ? (letter > c->begin ? 1 : 0) : (double)passed / all;
    double width = (double)c->u1 - (double)c->u0;
    /* A letter that a caret cannot stand before is at the place before the one that it goes
     * with. */
    return c->level & 1 ? (double)c->u1 - part * width : (double)c->u0 + part * width;
}

static const struct set_cluster *cluster_with(const struct set_line *l, int letter)
{
    for (int i = 0; i < l->clusters_count; i++)
        if (letter >= l->clusters[i].begin && letter < l->clusters[i].end)
            return &l->clusters[i];
    return NULL;
}

/* Where a caret stands that is before `letter`, at the edge of the letter before it or of that
 * one. */
static double caret_along(const struct paragraph *p, const struct line *line,
                          const struct set_line *l, int letter, bool before)
{
    const struct set_cluster *c = NULL;
    /* White space at a line's end is not seen: a caret in it stands behind the last letter that
     * is. */
    if (letter > line->ink_end)
        letter = line->ink_end;
    if ((before || letter >= line->ink_end) && letter > line->begin &&
        (c = cluster_with(l, letter - 1)))
        return cluster_at(p, c, letter);
    c = cluster_with(l, letter);
    return c ? cluster_at(p, c, letter) : l->u0;
}

enum font_status page_caret_get(struct page_text *t, struct page_place place, bool before,
                                struct page_caret *out)
{
    struct slot slot;
    struct set_line l = {0};
    int number;
    *out = (struct page_caret){.page = -1};
    enum font_status status = layout_find(t, place, before, &out->page, &number, &slot);
    if (status != FONT_OK)
        return status;
    const struct paragraph *p = story_paragraph(t, place.paragraph);
    const struct line *line = &p->lines[number];
    status = line_set(t, p, line, slot.u1 - slot.u0, &l);
    if (status == FONT_OK) {
        const struct page_template *template = flow_template(t, out->page);
        int letter = letter_of(p, place.byte);
        double u = slot.u0 + caret_along(p, line, &l, letter, before && letter > line->begin);
        slot_point(template, &slot, u, slot.v, &out->x0, &out->y0);
        slot_point(template, &slot, u, slot.v + p->leading_px, &out->x1, &out->y1);
    }
    set_line_finish(&l);
    return status;
}

/* A point of the page, along and across a frame's lines. */
static void point_slot(const struct page_frame *f, double x, double y, double *u, double *v)
{
    *u = f->vertical ? y - f->y : x - f->x;
    *v = f->vertical ? f->x + f->width - x : y - f->y;
}

struct nearest {
    const struct paragraph *paragraph;
    const struct slot *slot;
    int line;
    double u; /* of the point */
};

/* How far a number is from an interval. */
static double outside(double at, double from, double to)
{
    return fmax(0, fmax(from - at, at - to));
}

/* How far a point is from a line: from its frame, then across the lines, then along them. So a
 * point far beside a frame is on the line at its height, however far lines are moved in. */
struct distance {
    double frame, across, along;
};

static bool is_nearer(const struct distance *a, const struct distance *b)
{
    if (a->frame != b->frame)
        return a->frame < b->frame;
    return a->across != b->across ? a->across < b->across : a->along < b->along;
}

/* The line that the point is on, or nearest to. */
static bool line_nearest(const struct page *page, const struct page_template *template,
                         double x, double y, struct nearest *out)
{
    struct distance best = {INFINITY, INFINITY, INFINITY};
    for (int i = 0; i < page->pieces_count; i++) {
        const struct piece *piece = &page->pieces[i];
        for (int k = piece->begin; k < piece->end; k++) {
            const struct slot *s = &page->slots[piece->slots_begin + k - piece->begin];
            const struct page_frame *f = &template->frames[s->frame];
            double u, v;
            point_slot(f, x, y, &u, &v);
            const struct distance far = {
                hypot(outside(x, f->x, f->x + f->width), outside(y, f->y, f->y + f->height)),
                outside(v, s->v, s->v + piece->paragraph->leading_px),
                outside(u, s->u0, s->u1)};
            if (is_nearer(&far, &best)) {
                best = far;
                *out = (struct nearest){piece->paragraph, s, k, u - s->u0};
            }
        }
    }
    return isfinite(best.frame);
}

struct hit {
    double far;
    int letter;
    bool before;
};

static void hit_try(struct hit *h, double far, int letter, bool before)
{
    if (far < h->far - 1e-9)
        *h = (struct hit){far, letter, before};
}

enum font_status page_hit(struct page_text *t, int number, double x, double y,
                          struct page_place *place, bool *before)
{
    struct nearest n = {0};
    struct set_line l = {0};
    *place = (struct page_place){-1, 0};
    *before = false;
    enum font_status status = flow_fill(t, number);
    if (status != FONT_OK)
        return status;
    if (!isfinite(x) || !isfinite(y) ||
        !line_nearest(&t->pages[number], flow_template(t, number), x, y, &n))
        return font_fail(FONT_BAD_ARGUMENT, "page %d has no text at (%g, %g)", number + 1, x,
                         y);
    const struct paragraph *p = n.paragraph;
    const struct line *line = &p->lines[n.line];
    status = line_set(t, p, line, n.slot->u1 - n.slot->u0, &l);
    struct hit hit = {INFINITY, line->begin, false};
    for (int i = 0; status == FONT_OK && i < l.clusters_count; i++) {
        const struct set_cluster *c = &l.clusters[i];
        for (int k = c->begin; k < c->end; k++)
            if (p->letters[k].grapheme)
                hit_try(&hit, fabs(cluster_at(p, c, k) - n.u), k, false);
        /* The end of a cluster is a place of its own: the next one may be elsewhere. */
        if (c->end >= p->count || p->letters[c->end].grapheme)
            hit_try(&hit, fabs(cluster_at(p, c, c->end) - n.u), c->end, true);
    }
    set_line_finish(&l);
    if (status != FONT_OK)
        return status;
    *place = (struct page_place){p->id, byte_of(p, hit.letter)};
    *before = hit.before;
    return FONT_OK;
}

/* ---- selections ---- */

struct boxes {
    struct page_box *items;
    int max, count;
};

static void box_add(struct boxes *b, const struct page_template *t, const struct slot *s,
                    double u0, double u1, double height)
{
    double x0, y0, x1, y1;
    slot_point(t, s, s->u0 + u0, s->v, &x0, &y0);
    slot_point(t, s, s->u0 + u1, s->v + height, &x1, &y1);
    if (b->count < b->max)
        b->items[b->count] =
            (struct page_box){fmin(x0, x1), fmin(y0, y1), fabs(x1 - x0), fabs(y1 - y0)};
    b->count++;
}

/* The boxes of letters from..to of a line: pieces that touch are one. */
static void line_select(const struct paragraph *p, const struct set_line *l, int from, int to,
                        const struct page_template *t, const struct slot *s, struct boxes *b)
{
    double u0 = 0, u1 = -1;
    bool open = false;
    for (int i = 0; i < l->clusters_count; i++) {
        const struct set_cluster *c = &l->clusters[i];
        int begin = c->begin > from ? c->begin : from, end = c->end < to ? c->end : to;
        if (begin >= end)
            continue;
        double a = cluster_at(p, c, begin), z = cluster_at(p, c, end);
        double least = fmin(a, z), most = fmax(a, z);
        if (open && least <= u1 + 1e-3) {
            u1 = fmax(u1, most);
            continue;
        }
        if (open)
            box_add(b, t, s, u0, u1, p->leading_px);
        u0 = least;
        u1 = most;
        open = true;
    }
    if (open)
        box_add(b, t, s, u0, u1, p->leading_px);
}

enum font_status page_select(struct page_text *t, struct page_place from, struct page_place to,
                             int number, struct page_box *items, int max, int *count)
{
    const struct paragraph *a = story_paragraph(t, from.paragraph),
                           *z = story_paragraph(t, to.paragraph);
    struct boxes boxes = {items, max, 0};
    struct set_line l = {0};
    *count = 0;
    if (!a || !z || a->flow != z->flow || (a->flow < 0 && a != z))
        return font_fail(FONT_BAD_ARGUMENT, "what is selected lies between places of one flow");
    if (a->at > z->at || (a == z && from.byte > to.byte)) {
        struct page_place swap = from;
        const struct paragraph *first = a;
        from = to;
        to = swap;
        a = z;
        z = first;
    }
    enum font_status status = flow_fill(t, number);
    for (int i = 0; status == FONT_OK && i < t->pages[number].pieces_count; i++) {
        const struct piece *piece = &t->pages[number].pieces[i];
        const struct paragraph *p = piece->paragraph;
        if (p->flow != a->flow || p->at < a->at || p->at > z->at || (a->flow < 0 && p != a))
            continue;
        int begin = p == a ? letter_of(p, from.byte) : 0;
        int end = p == z ? letter_of(p, to.byte) : p->count;
        for (int k = piece->begin; status == FONT_OK && k < piece->end; k++) {
            const struct slot *s =
                &t->pages[number].slots[piece->slots_begin + k - piece->begin];
            if (p->lines[k].end <= begin || p->lines[k].begin >= end)
                continue;
            status = line_set(t, p, &p->lines[k], s->u1 - s->u0, &l);
            if (status == FONT_OK)
                line_select(p, &l, begin, end, flow_template(t, number), s, &boxes);
        }
    }
    set_line_finish(&l);
    *count = boxes.count;
    return status;
}

bool page_place_step(struct page_text *t, struct page_place *place, bool forward)
{
    struct paragraph *p = story_paragraph(t, place->paragraph);
    if (!p || set_analyse(t, p) != FONT_OK)
        return false;
    int i = letter_of(p, place->byte);
    if (forward ? i >= p->count : i <= 0)
        return false;
    do
        i += forward ? 1 : -1;
    while (i > 0 && i < p->count && !p->letters[i].grapheme);
    place->byte = byte_of(p, i);
    return true;
}
