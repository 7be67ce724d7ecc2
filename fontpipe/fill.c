/* fill.c - finds what an outline covers more than once, and the boundary of what is filled.
 *
 * Curves are cut into pieces that are all but straight and that rise (y0 < y1). All ends and
 * crossings of pieces are levels; between two levels nothing begins, ends or crosses:
 *
 *      level 3  ------+----+--------      In a strip the pieces that pass through it, sorted by x in its middle,
 *                     |   /|              are the boundaries of spans; the winding number left of each is the sum
 *      level 2  ------+--/-+---+----      of the directions (up 1, down -1) before it. A piece across which the
 *                     | /  |  /           filling changes is boundary, one across which it does not is inside.
 *      level 1  ------+----+-+------
 *
 * Spans come in pairs in every strip, whatever the outline: damaged ones cannot spill. If the
 * winding number is never but 0 or 1 (or never but 0 or -1) the outline covers nothing twice
 * and stays as it is. Otherwise the parts of pieces that are boundary are put together to parts
 * of the curves they came from, and what differs between the spans below a level and those
 * above becomes a horizontal line. What is put together so is first cut where its curves, not
 * their pieces, cross (fill_cut.c): its corners are right at any size. */
#include "fill_internal.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static int pieces_of(const struct font_segment *s, double tolerance)
{
    double bend = 0;
    for (int k = 0; k + 2 <= s->degree; k++)
        bend = fmax(bend, hypot(s->p[k].x - 2 * s->p[k + 1].x + s->p[k + 2].x,
                                s->p[k].y - 2 * s->p[k + 1].y + s->p[k + 2].y));
    /* A curve leaves the chord by at most |second derivative| / 8 over n squared. */
    double second = s->degree == 3 ? 6 : 2;
    double n = ceil(sqrt(second * bend / 8 / tolerance));
    return (int)fmax(1, fmin(n, FILL_PIECES_OF_SEGMENT_MAX));
}

/* fineness: curves leave their pieces by at most the outline's extent over that. */
static enum font_status pieces_make(struct fill_work *w, const struct font_outline *o,
                                    double fineness)
{
    struct font_box box = font_outline_box(o);
    double extent = fmax(box.x1 - box.x0, box.y1 - box.y0), tolerance = extent / fineness;
    int exponent;
    frexp(fmax(extent, fmax(fabs(box.y0), fabs(box.y1))), &exponent);
    w->grid = ldexp(1, exponent - 40);
    for (int i = 0; i < o->segments_count; i++) {
        const struct font_segment *s = &o->segments[i];
        int n = s->degree == 1 ? 1 : pieces_of(s, tolerance);
        if (w->pieces_count + n > FILL_PIECES_MAX)
            return font_fail(FONT_TOO_LARGE, "an outline has too many curves to fill");
        if (!array_reserve(&w->pieces, &w->pieces_capacity, w->pieces_count + n,
                           sizeof *w->pieces) ||
            !array_reserve(&w->levels, &w->levels_capacity, w->levels_count + 2 * n,
                           sizeof *w->levels))
            return fill_no_memory();
        struct font_point a = {s->p[0].x, fill_height(w, s->p[0].y)};
        for (int k = 1; k <= n; k++) {
            double ta = (double)(k - 1) / n, tb = (double)k / n;
            struct font_point b = k == n ? s->p[s->degree] : font_segment_at(s, tb, NULL);
            b.y = fill_height(w, b.y);
            if (a.y != b.y) {
                bool up = b.y > a.y;
                w->pieces[w->pieces_count++] =
                    up ? (struct fill_piece){a.x, a.y, b.x, b.y, ta, tb, i, 1}
                       : (struct fill_piece){b.x, b.y, a.x, a.y, tb, ta, i, -1};
                w->levels[w->levels_count++] = a.y;
                w->levels[w->levels_count++] = b.y;
            }
            a = b;
        }
    }
    return FONT_OK;
}

static int levels_compare(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* Where two pieces cross, as functions x(y). o: cuts are wanted; else levels. */
static enum font_status crossing_find(struct fill_work *w, const struct font_outline *o,
                                      const struct fill_piece *p, const struct fill_piece *q)
{
    double low = fmax(p->y0, q->y0), high = fmin(p->y1, q->y1);
    if (high <= low)
        return FONT_OK;
    double before = fill_piece_x(p, low) - fill_piece_x(q, low);
    double after = fill_piece_x(p, high) - fill_piece_x(q, high);
    if (!(before * after < 0))
        return FONT_OK;
    w->crossings++;
    double y = low + (high - low) * (before / (before - after));
    if (o)
        return fill_crossing_cut(w, o, p, q, y);
    if (!array_reserve(&w->levels, &w->levels_capacity, w->levels_count + 1, sizeof *w->levels))
        return fill_no_memory();
    w->levels[w->levels_count++] = fill_height(w, fmin(fmax(y, low), high));
    return FONT_OK;
}

/* Pieces are sorted by y0. active holds those that reach beyond the present one's y0. */
static enum font_status crossings_find(struct fill_work *w, const struct font_outline *o)
{
    int active_count = 0;
    int64_t pairs = 0;
    if (!array_reserve(&w->active, &w->active_capacity, w->pieces_count + 1,
                       sizeof *w->active) ||
        !array_reserve(&w->middles, &w->middles_capacity, w->pieces_count + 1,
                       sizeof *w->middles) ||
        !array_reserve(&w->bounds, &w->bounds_capacity, w->pieces_count + 1, sizeof *w->bounds))
        return fill_no_memory();
    for (int i = 0; i < w->pieces_count; i++) {
        const struct fill_piece *p = &w->pieces[i];
        double left = fmin(p->x0, p->x1), right = fmax(p->x0, p->x1);
        int kept = 0;
        for (int k = 0; k < active_count; k++) {
            const struct fill_piece *q = &w->pieces[w->active[k]];
            if (q->y1 <= p->y0)
                continue;
            w->active[kept++] = w->active[k];
            if (fmax(q->x0, q->x1) < left || fmin(q->x0, q->x1) > right)
                continue;
            enum font_status status = crossing_find(w, o, p, q);
            if (status != FONT_OK)
                return status;
        }
        pairs += kept;
        if (pairs > FILL_PAIRS_MAX)
            return font_fail(FONT_TOO_LARGE, "an outline is too tangled to fill");
        w->active[kept] = i;
        active_count = kept + 1;
    }
    return FONT_OK;
}

static enum font_status portion_add(struct fill_work *w, const struct fill_piece *p, double low,
                                    double high, bool entering)
{
    if (!array_reserve(&w->portions, &w->portions_capacity, w->portions_count + 1,
                       sizeof *w->portions))
        return fill_no_memory();
    /* The inside is on the right: up where it is entered, down where it is left. */
    double from = entering ? low : high, to = entering ? high : low;
    w->portions[w->portions_count++] = (struct fill_portion){fill_piece_t(p, from),
                                                             fill_piece_t(p, to),
                                                             {fill_piece_x(p, from), from},
                                                             {fill_piece_x(p, to), to},
                                                             p->segment};
    return FONT_OK;
}

static enum font_status end_add(struct fill_work *w, double x, int change)
{
    if (!array_reserve(&w->ends, &w->ends_capacity, w->ends_count + 1, sizeof *w->ends))
        return fill_no_memory();
    int at = w->ends_count++; /* nearly sorted as it comes */
    while (at > 0 && w->ends[at - 1].x > x) {
        w->ends[at] = w->ends[at - 1];
        at--;
    }
    w->moves += w->ends_count - at;
    w->ends[at] = (struct fill_end){x, change};
    return FONT_OK;
}

/* The ends at a level are +1 and -1 for spans below it, the reverse for those above: where they
 * do not cancel there is a horizontal boundary. */
static enum font_status level_close(struct fill_work *w, double y)
{
    int inside = 0;
    for (int i = 0; i + 1 < w->ends_count; i++) {
        inside += w->ends[i].change;
        double from = w->ends[i].x, to = w->ends[i + 1].x;
        /* More than one where a strip of no height has its pieces out of order: the boundary is
         * closed all the same. */
        int times = to > from ? abs(inside) : 0;
        if (!array_reserve(&w->flat, &w->flat_capacity, w->flat_count + times, sizeof *w->flat))
            return fill_no_memory();
        struct font_segment line = {.degree = 1, .p = {{from, y}, {to, y}}};
        if (inside < 0) {
            line.p[0].x = to;
            line.p[1].x = from;
        }
        for (int k = 0; k < times; k++)
            w->flat[w->flat_count++] = line;
    }
    w->ends_count = 0;
    return FONT_OK;
}

/* Sorts the active pieces by their middles. */
static void strip_sort(struct fill_work *w, int active_count, double low, double high)
{
    double middle = low + (high - low) / 2;
    for (int i = 0; i < active_count; i++) {
        int piece = w->active[i];
        double x = fill_piece_x(&w->pieces[piece], middle);
        int at = i;
        while (at > 0 && w->middles[at - 1] > x) {
            w->middles[at] = w->middles[at - 1];
            w->active[at] = w->active[at - 1];
            at--;
        }
        w->moves += i - at;
        w->middles[at] = x;
        w->active[at] = piece;
    }
}

/* Closes the level at the strip's foot, and keeps what bounds it: portions, and the spans' ends
 * at its head. */
static enum font_status strip_bound(struct fill_work *w, int active_count, double low,
                                    double high, enum font_fill rule)
{
    int winding = 0, bounds_count = 0;
    enum font_status status = FONT_OK;
    for (int i = 0; i < active_count && status == FONT_OK; i++) {
        const struct fill_piece *p = &w->pieces[w->active[i]];
        bool before = font_fill_has(winding, rule), after;
        winding += p->direction;
        after = font_fill_has(winding, rule);
        if (before == after)
            continue;
        w->bounds[bounds_count++] = (struct fill_bound){p, after};
        status = end_add(w, fill_piece_x(p, low), after ? -1 : 1);
    }
    if (status == FONT_OK)
        status = level_close(w, low);
    for (int i = 0; i < bounds_count && status == FONT_OK; i++) {
        const struct fill_bound *b = &w->bounds[i];
        status = portion_add(w, b->piece, low, high, b->entering);
        if (status == FONT_OK)
            status = end_add(w, fill_piece_x(b->piece, high), b->entering ? 1 : -1);
    }
    return status;
}

/* Goes through the strips: the windings met, and with `boundary` portions and horizontal
 * lines. */
static enum font_status strips_pass(struct fill_work *w, enum font_fill rule, bool boundary,
                                    int *least, int *most)
{
    int active_count = 0, next = 0;
    int64_t visits = 0;
    enum font_status status = FONT_OK;
    for (int k = 0; k < w->levels_count && status == FONT_OK; k++) {
        double low = w->levels[k];
        /* What the strip below has said of this level is in ends already. */
        int kept = 0;
        for (int i = 0; i < active_count; i++)
            if (w->pieces[w->active[i]].y1 > low)
                w->active[kept++] = w->active[i];
        active_count = kept;
        while (next < w->pieces_count && w->pieces[next].y0 <= low)
            w->active[active_count++] = next++;
        if (k + 1 == w->levels_count)
            return boundary ? level_close(w, low) : FONT_OK;
        double high = w->levels[k + 1];
        visits += active_count;
        if (visits > FILL_PAIRS_MAX || w->moves > FILL_MOVES_MAX)
            return font_fail(FONT_TOO_LARGE, "an outline is too tangled to fill");
        strip_sort(w, active_count, low, high);
        if (boundary) {
            status = strip_bound(w, active_count, low, high, rule);
        } else {
            int winding = 0;
            for (int i = 0; i < active_count; i++) {
                winding += w->pieces[w->active[i]].direction;
                *least = winding < *least ? winding : *least;
                *most = winding > *most ? winding : *most;
            }
        }
    }
    return status;
}

static int portions_compare(const void *a, const void *b)
{
    const struct fill_portion *p = a, *q = b;
    if (p->segment != q->segment)
        return p->segment < q->segment ? -1 : 1;
    bool p_back = p->tb < p->ta, q_back = q->tb < q->ta;
    if (p_back != q_back)
        return p_back ? 1 : -1;
    return p_back ? (p->ta < q->ta) - (p->ta > q->ta) : (p->ta > q->ta) - (p->ta < q->ta);
}

/* Puts portions that follow each other on one curve together, and turns them into curves. */
static enum font_status result_make(struct fill_work *w, const struct font_outline *o,
                                    struct font_outline *out)
{
    if (w->portions_count)
        qsort(w->portions, (size_t)w->portions_count, sizeof *w->portions, portions_compare);
    int joined = 0;
    for (int i = 0; i < w->portions_count; i++) {
        struct fill_portion *p = &w->portions[i],
                            *last = joined ? &w->portions[joined - 1] : NULL;
        if (last && last->segment == p->segment && last->tb == p->ta &&
            (last->tb > last->ta) == (p->tb > p->ta) && last->ta != last->tb) {
            last->tb = p->tb;
            last->b = p->b;
        } else {
            w->portions[joined++] = *p;
        }
    }
    int count = joined + w->flat_count;
    if (count > FONT_SEGMENTS_MAX)
        return font_fail(FONT_TOO_LARGE, "an outline is too tangled to fill");
    if (!array_reserve(&out->segments, &out->segments_capacity, count, sizeof *out->segments))
        return fill_no_memory();
    for (int i = 0; i < joined; i++) {
        const struct fill_portion *p = &w->portions[i];
        struct font_segment part = font_segment_part(&o->segments[p->segment], p->ta, p->tb);
        part.p[0] = p->a; /* where the pieces met: so that the boundary is closed */
        part.p[part.degree] = p->b;
        part.contour = 0;
        out->segments[out->segments_count++] = part;
    }
    if (w->flat_count)
        memcpy(out->segments + out->segments_count, w->flat,
               (size_t)w->flat_count * sizeof *w->flat);
    out->segments_count = count;
    return FONT_OK;
}

static void levels_unique(struct fill_work *w)
{
    qsort(w->levels, (size_t)w->levels_count, sizeof *w->levels, levels_compare);
    int kept = 0;
    for (int i = 0; i < w->levels_count; i++)
        if (!kept || w->levels[i] != w->levels[kept - 1])
            w->levels[kept++] = w->levels[i];
    w->levels_count = kept;
}

/* The winding numbers met, and where there is more than one cover the boundary, by strips. */
static enum font_status strips_find(struct fill_work *w, const struct font_outline *o,
                                    enum font_fill rule, int *least, int *most)
{
    enum font_status status = FONT_OK;
    *least = *most = 0;
    /* Looked at roughly first: what is then covered twice by less than a 12000th of the outline
     * is not seen, here or in pictures. What is to be rebuilt is cut finely. */
    static const double fineness[] = {12000, 32768};
    for (int pass = 0; pass < 2 && status == FONT_OK; pass++) {
        if (pass == 1 && !fill_twice(*least, *most))
            break;
        w->pieces_count = w->levels_count = w->crossings = *least = *most = 0;
        status = pieces_make(w, o, fineness[pass]);
        if (status != FONT_OK || !w->pieces_count)
            break;
        qsort(w->pieces, (size_t)w->pieces_count, sizeof *w->pieces, fill_pieces_compare);
        /* What is rebuilt is cut where its curves cross; the cuts' own pieces may cross
         * again. */
        for (int n = 0; pass == 1 && n < FILL_CUTS_TIMES && status == FONT_OK; n++) {
            w->cuts_count = 0;
            status = crossings_find(w, o);
            if (status != FONT_OK || !w->cuts_count)
                break;
            status = fill_pieces_cut(w);
        }
        w->crossings = 0;
        if (status == FONT_OK)
            status = crossings_find(w, NULL);
        if (status != FONT_OK)
            break;
        levels_unique(w);
        status = strips_pass(w, rule, false, least, most);
    }
    if (status == FONT_OK && fill_twice(*least, *most))
        status = strips_pass(w, rule, true, NULL, NULL);
    return status;
}

static void work_finish(struct fill_work *w)
{
    free(w->pieces);
    free(w->levels);
    free(w->portions);
    free(w->flat);
    free(w->ends);
    free(w->active);
    free(w->middles);
    free(w->bounds);
    free(w->cuts);
    free(w->arcs);
    free(w->boxes);
    free(w->joints);
    free(w->meets);
    free(w->links);
}

/* From the curves themselves, else by strips. TOO_LARGE: it is too tangled. */
static enum font_status fill_find(struct fill_work *w, const struct font_outline *o,
                                  enum font_fill rule, bool quickly, int *least, int *most)
{
    for (int shaken = 0; quickly && shaken < 2; shaken++) {
        if (fill_quick(w, o, rule, shaken, least, most))
            return FONT_OK;
        if (w->spent)
            return font_fail(FONT_TOO_LARGE, "an outline is too tangled to fill");
    }
    w->portions_count = 0;
    return strips_find(w, o, rule, least, most);
}

static enum font_status prepare(struct font_outline *o, enum font_fill rule, bool quickly)
{
    if (o->prepared)
        return FONT_OK;
    o->tangled = false;
    enum font_status status = font_outline_close(o);
    struct fill_work w = {0};
    struct font_outline out = {0};
    int least = 0, most = 0;
    o->box = font_outline_box(o);
    if (status == FONT_OK)
        status = fill_find(&w, o, rule, quickly, &least, &most);
    if (status == FONT_OK && fill_twice(least, most))
        status = result_make(&w, o, &out);
    if (status == FONT_TOO_LARGE && quickly) {
        /* It stays as it is, and is filled where it is drawn: see edges_tangled.c. */
        status = FONT_OK;
        o->tangled = true;
        o->rule = rule;
        o->turn = 1;
    } else if (status == FONT_OK && fill_twice(least, most)) {
        free(o->segments);
        o->segments = out.segments;
        o->segments_count = out.segments_count;
        o->segments_capacity = out.segments_capacity;
        out.segments = NULL;
        o->contours_count = 1;
        o->rebuilt = true;
        o->turn = 1;
    } else if (status == FONT_OK) {
        o->turn = least < 0 ? -1 : 1;
    }
    if (status == FONT_OK) {
        o->crossings = w.crossings;
        if (o->rebuilt)
            o->box = font_outline_box(o);
        status = font_outline_polynomials(o);
        o->prepared = status == FONT_OK;
    }
    free(out.segments);
    work_finish(&w);
    return status;
}

enum font_status font_outline_prepare(struct font_outline *o, enum font_fill rule)
{
    return prepare(o, rule, true);
}

enum font_status font_outline_prepare_by_strips(struct font_outline *o, enum font_fill rule)
{
    return prepare(o, rule, false);
}
