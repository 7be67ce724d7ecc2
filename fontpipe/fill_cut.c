/* fill_cut.c - crossings as exact as the curves are: see fill.c. */
#include "fill_internal.h"

#include <array.h>
#include <stdlib.h>

enum font_status fill_no_memory(void)
{
    return font_fail(FONT_NO_MEMORY, "no memory to fill an outline");
}

static bool levels_add(struct fill_work *w, double a, double b)
{
    if (!array_reserve(&w->levels, &w->levels_capacity, w->levels_count + 2, sizeof *w->levels))
        return false;
    w->levels[w->levels_count++] = a;
    w->levels[w->levels_count++] = b;
    return true;
}

int fill_pieces_compare(const void *a, const void *b)
{
    const struct fill_piece *p = a, *q = b;
    return (p->y0 > q->y0) - (p->y0 < q->y0);
}

static enum font_status cut_add(struct fill_work *w, const struct fill_piece *p, double t,
                                struct font_point at)
{
    double y = fill_height(w, at.y);
    if (!(y > p->y0 && y < p->y1))
        return FONT_OK; /* at an end, or beside it: there is nothing to cut */
    if (!array_reserve(&w->cuts, &w->cuts_capacity, w->cuts_count + 1, sizeof *w->cuts))
        return fill_no_memory();
    w->cuts[w->cuts_count++] = (struct fill_cut){(int)(p - w->pieces), t, at.x, y};
    return FONT_OK;
}

static bool piece_has(const struct fill_piece *p, double t)
{
    return t >= fmin(p->t0, p->t1) && t <= fmax(p->t0, p->t1);
}

/* Where the curves of two pieces cross: Newton's steps from where the pieces do. False if that
 * is beyond the pieces. */
static bool curves_cross(const struct font_outline *o, const struct fill_piece *p,
                         const struct fill_piece *q, double *t, double *u,
                         struct font_point *at)
{
    for (int n = 0; n < 12; n++) {
        struct font_point dp, dq, a = font_segment_at(&o->segments[p->segment], *t, &dp);
        struct font_point b = font_segment_at(&o->segments[q->segment], *u, &dq);
        double x = b.x - a.x, y = b.y - a.y, det = dq.x * dp.y - dp.x * dq.y;
        double speeds = hypot(dp.x, dp.y) * hypot(dq.x, dq.y);
        *at = (struct font_point){a.x + 0.5 * x, a.y + 0.5 * y};
        if (!(fabs(det) > 1e-9 * speeds))
            return false; /* side by side */
        double step_t = (dq.x * y - dq.y * x) / det, step_u = (dp.x * y - dp.y * x) / det;
        *t += step_t;
        *u += step_u;
        if (!(piece_has(p, *t) && piece_has(q, *u)))
            return false;
        if (fabs(step_t) + fabs(step_u) < 1e-13)
            return true;
    }
    return true;
}

enum font_status fill_crossing_cut(struct fill_work *w, const struct font_outline *o,
                                   const struct fill_piece *p, const struct fill_piece *q,
                                   double y)
{
    double t = fill_piece_t(p, y), u = fill_piece_t(q, y);
    struct font_point at_p, at_q;
    if (curves_cross(o, p, q, &t, &u, &at_p)) {
        at_q = at_p;
    } else {
        t = 0.5 * (p->t0 + p->t1);
        u = 0.5 * (q->t0 + q->t1);
        at_p = font_segment_at(&o->segments[p->segment], t, NULL);
        at_q = font_segment_at(&o->segments[q->segment], u, NULL);
    }
    enum font_status status = cut_add(w, p, t, at_p);
    return status == FONT_OK ? cut_add(w, q, u, at_q) : status;
}

static int cuts_compare(const void *a, const void *b)
{
    const struct fill_cut *p = a, *q = b;
    return p->piece != q->piece ? (p->piece > q->piece) - (p->piece < q->piece)
                                : (p->y > q->y) - (p->y < q->y);
}

enum font_status fill_pieces_cut(struct fill_work *w)
{
    int first = w->pieces_count;
    qsort(w->cuts, (size_t)w->cuts_count, sizeof *w->cuts, cuts_compare);
    if (w->pieces_count + w->cuts_count > FILL_PIECES_MAX)
        return font_fail(FONT_TOO_LARGE, "an outline is too tangled to fill");
    if (!array_reserve(&w->pieces, &w->pieces_capacity, first + w->cuts_count,
                       sizeof *w->pieces))
        return fill_no_memory();
    for (int i = 0; i < w->cuts_count; i++) {
        const struct fill_cut *c = &w->cuts[i];
        struct fill_piece *low =
            &w->pieces[c->piece]; /* what is left of it, from the last cut up */
        if (!(c->y > low->y0 && c->y < low->y1))
            continue;
        struct fill_piece below = *low;
        below.x1 = c->x;
        below.y1 = c->y;
        below.t1 = c->t;
        low->x0 = c->x;
        low->y0 = c->y;
        low->t0 = c->t;
        w->pieces[w->pieces_count++] = below;
    }
    w->levels_count = 0;
    for (int i = 0; i < w->pieces_count; i++)
        if (!levels_add(w, w->pieces[i].y0, w->pieces[i].y1))
            return fill_no_memory();
    qsort(w->pieces, (size_t)w->pieces_count, sizeof *w->pieces, fill_pieces_compare);
    return FONT_OK;
}
