/* edges_tangled.c - edges of outlines that cross themselves too often for their boundary to be
 * made (outline.h): what is filled is found here, for the picture itself, by strips.
 *
 *      level ----+-----------+------ y       A strand is a part of the outline along which y
 *                                            only grows. Levels are the ends of
 *                |\         /                strands, and as many others as keep strips low. In a strip strands are sorted by x in
 *                | \  ink  /                 its middle, and the winding number is the sum of the directions of those to the left.
 *      level ----+--+-----+--------- y       Strands across which the filling changes are the
 *                                            strip's boundary.
 *
 * A strand counts as boundary from where it becomes one to where it ceases to be one, point for
 * point; what the boundaries of two strips lack at the level between them are horizontal lines.
 * So the boundary is closed, and right but for strands that cross within a strip: beyond their
 * crossing they are taken in the wrong order. The work is bounded: where there would be too
 * much of it, strips are higher.
 */
#include "edges_internal.h"
#include "internal.h"

#include <stdlib.h>
#include <string.h>

enum {
    SAMPLES = 8,
    PIECES_MAX = 512, /* of a segment */
    POINTS_MAX = 1500000,
    VISITS_MAX = 50000000, /* of strands, all strips together */
    LINES_MAX = 12000000,
    LEVELS_MAX = 1 << 22
};

/* Strips are so high, where strands are crowded less; where that takes too long twice that, and
 * so on. */
static const double strip_least_px = 1.0 / 512, strip_most_px = 1.0 / 96;
static const double level_px = 1.0 / 512; /* ends of strands that are closer are at one level */
static const double chord_px = 1.0 / 1000;
static const double side_px = 1.0 / 64; /* a boundary that is so long counts as level */

struct strand {
    int first, last; /* points */
    int level, end;  /* where it begins and ends */
    int direction;   /* of the outline: 1 downwards */
};

/* A strand in the strip that is looked at. */
struct runner {
    double middle, head, foot; /* its x there */
    struct font_point
        at; /* the point before the strip's foot, and how it goes on to the next */
    double slope, next_y;
    struct font_point kept; /* up to where the boundary has been put into edges */
    int strand, point;
    /* in the strip above: 1 ink begins at it, -1 ink ends there, 0 it is no boundary */
    int sense;
    int direction;
};

struct end {
    double x;
    int change;
};

struct sweep {
    struct font_edges *edges;
    enum font_fill rule;
    double step_px;
    struct font_point *points; /* of strands, one after the other, y growing */
    struct strand *strands;    /* in order of their first levels */
    double *levels;
    struct runner *runners;
    struct end *ends;
    int points_count, points_capacity, strands_count, strands_capacity, levels_count,
        levels_capacity, ends_count, ends_capacity;
    enum font_status status;
};

static void no_memory(struct sweep *w)
{
    w->status = font_fail(FONT_NO_MEMORY, "no memory for a tangled outline");
}

/* ---- strands ---- */

static void point_add(struct sweep *w, struct font_point p)
{
    if (!array_reserve(&w->points, &w->points_capacity, w->points_count + 1, sizeof *w->points))
        no_memory(w);
    else
        w->points[w->points_count++] = p;
}

/* Goes on from a to b; `open`: the last strand ends at a. */
static bool strand_extend(struct sweep *w, struct font_point a, struct font_point b, bool open)
{
    int direction = b.y > a.y ? 1 : b.y < a.y ? -1 : 0;
    if (!direction)
        return false;
    if (!(open && w->strands[w->strands_count - 1].direction == direction)) {
        if (!array_reserve(&w->strands, &w->strands_capacity, w->strands_count + 1,
                           sizeof *w->strands)) {
            no_memory(w);
            return false;
        }
        w->strands[w->strands_count++] =
            (struct strand){.first = w->points_count, .direction = direction};
        point_add(w, a);
    }
    point_add(w, b);
    w->strands[w->strands_count - 1].last = w->points_count - 1;
    return w->status == FONT_OK;
}

static bool picture_of(struct sweep *w, const struct font_map *map,
                       const struct font_segment *s, double t, struct font_point *out)
{
    double jacobian[4];
    if (font_map_point(map, font_segment_at(s, t, NULL), out, jacobian) && isfinite(out->x) &&
        isfinite(out->y))
        return true;
    w->status = font_fail(FONT_BAD_ARGUMENT, "the distortion sends a glyph beyond the horizon");
    return false;
}

/* Into how many chords a segment is cut that they leave it by at most `chord`. */
static int pieces_of(struct sweep *w, const struct font_map *map, const struct font_segment *s,
                     double chord)
{
    struct font_point p[SAMPLES + 1];
    double bend = 0;
    if (s->degree == 1 && map->kind == FONT_AFFINE)
        return 1;
    for (int k = 0; k <= SAMPLES; k++)
        if (!picture_of(w, map, s, (double)k / SAMPLES, &p[k]))
            return 1;
    for (int k = 1; k < SAMPLES; k++)
        bend = fmax(bend, hypot(p[k - 1].x - 2 * p[k].x + p[k + 1].x,
                                p[k - 1].y - 2 * p[k].y + p[k + 1].y));
    return (int)fmin(PIECES_MAX, 1 + SAMPLES * sqrt(bend / (8 * chord)));
}

/* False: there are more points than may be, or it failed. */
static bool strands_make(struct sweep *w, const struct font_outline *o,
                         const struct font_map *map, double chord)
{
    bool open = false;
    w->points_count = w->strands_count = 0;
    for (int i = 0; i < o->segments_count; i++) {
        const struct font_segment *s = &o->segments[i];
        struct font_point a, b;
        int n = pieces_of(w, map, s, chord);
        if (w->points_count + n > POINTS_MAX || !picture_of(w, map, s, 0, &a))
            return false;
        open = open && i > 0 && s->contour == o->segments[i - 1].contour;
        for (int k = 1; k <= n; k++, a = b) {
            if (!picture_of(w, map, s, (double)k / n, &b))
                return false;
            open = strand_extend(w, a, b, open);
            if (w->status != FONT_OK)
                return false;
        }
    }
    for (int i = 0; i < w->strands_count; i++) /* y grows along all of them */
        for (int a = w->strands[i].first, b = w->strands[i].last;
             w->strands[i].direction < 0 && a < b; a++, b--) {
            struct font_point swap = w->points[a];
            w->points[a] = w->points[b];
            w->points[b] = swap;
        }
    return true;
}

/* ---- levels ---- */

static int numbers_compare(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static int strands_compare(const void *a, const void *b)
{
    const struct strand *p = a, *q = b;
    return p->level != q->level ? (p->level > q->level) - (p->level < q->level)
                                : (p->first > q->first) - (p->first < q->first);
}

/* The last level that is not below y. */
static int level_of(const struct sweep *w, double y)
{
    int low = 0, high = w->levels_count;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (w->levels[middle] <= y)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The levels for strips of at most that height, of which those closer than `apart` are one.
 * False: there would be too many of them, or too many strands in them. */
static bool levels_make(struct sweep *w, double high, double apart)
{
    int n = 0, ends = 2 * w->strands_count;
    double *all = malloc(((size_t)ends + 1) * sizeof *all);
    if (!all) {
        no_memory(w);
        return false;
    }
    for (int i = 0; i < w->strands_count; i++) {
        all[n++] = w->points[w->strands[i].first].y;
        all[n++] = w->points[w->strands[i].last].y;
    }
    qsort(all, (size_t)n, sizeof *all, numbers_compare);
    w->levels_count = 0;
    for (int i = 0; i < n && w->status == FONT_OK; i++) {
        double from = w->levels_count ? w->levels[w->levels_count - 1] : all[i];
        if (w->levels_count && all[i] - from < apart)
            continue;
        double parts = fmax(1, ceil((all[i] - from) / high));
        if (w->levels_count + parts > LEVELS_MAX)
            break;
        int more = w->levels_count ? (int)parts : 1;
        if (!array_reserve(&w->levels, &w->levels_capacity, w->levels_count + more,
                           sizeof *w->levels))
            no_memory(w);
        else
            for (int k = 1; k <= more; k++)
                w->levels[w->levels_count++] =
                    k == more ? all[i] : from + (all[i] - from) * k / more;
    }
    bool whole = n == 0 || all[n - 1] - w->levels[w->levels_count - 1] < apart;
    free(all);
    double visits = 0;
    for (int i = 0; i < w->strands_count && w->status == FONT_OK; i++) {
        struct strand *s = &w->strands[i];
        s->level = level_of(w, w->points[s->first].y);
        s->end = level_of(w, w->points[s->last].y);
        visits += s->end - s->level;
    }
    return whole && visits <= VISITS_MAX && w->status == FONT_OK;
}

/* ---- the boundary ---- */

/* A part of the boundary as horizontal lines; sense: 1 ink begins to the right of it, -1 it
 * ends there. */
static void side_put(struct sweep *w, struct font_point a, struct font_point b, int sense)
{
    double dx = b.x - a.x, dy = b.y - a.y;
    if (dx == 0)
        return;
    int n = (int)fmin(4096, ceil(fmax(fabs(dx), dy) / w->step_px));
    n = n < 1 ? 1 : n;
    w->status = font_lines_reserve(w->edges, n);
    for (int k = 0; k < n && w->status == FONT_OK; k++) {
        double x0 = a.x + dx * k / n, x1 = k + 1 == n ? b.x : a.x + dx * (k + 1) / n;
        font_edges_line(w->edges, sense < 0 ? x0 : x1, sense < 0 ? x1 : x0,
                        a.y + dy * (k + 0.5) / n);
    }
}

/* What a boundary has passed, once that is as long as a step. */
static void side_reach(struct sweep *w, struct runner *s, struct font_point to, bool all)
{
    if (!all && fabs(to.x - s->kept.x) < w->step_px && to.y - s->kept.y < w->step_px)
        return;
    side_put(w, s->kept, to, s->sense);
    s->kept = to;
}

static void end_add(struct sweep *w, double x, int change)
{
    if (!array_reserve(&w->ends, &w->ends_capacity, w->ends_count + 1, sizeof *w->ends))
        no_memory(w);
    else
        w->ends[w->ends_count++] = (struct end){x, change};
}

static int ends_compare(const void *a, const void *b)
{
    const struct end *p = a, *q = b;
    return (p->x > q->x) - (p->x < q->x);
}

/* The lines at a level between what the strip below it covers and what the one above it
 * does. */
static void level_close(struct sweep *w, double y)
{
    int inside = 0;
    if (w->ends_count > 1)
        qsort(w->ends, (size_t)w->ends_count, sizeof *w->ends, ends_compare);
    for (int i = 0; i + 1 < w->ends_count && w->status == FONT_OK; i++) {
        inside += w->ends[i].change;
        double from = w->ends[i].x, to = w->ends[i + 1].x;
        int times = to > from ? abs(inside) : 0;
        w->status = font_lines_reserve(w->edges, times);
        for (int k = 0; k < times && w->status == FONT_OK; k++)
            font_edges_line(w->edges, inside > 0 ? from : to, inside > 0 ? to : from, y);
    }
    w->ends_count = 0;
}

/* To the point that is the last one above y. */
static void runner_walk(const struct sweep *w, struct runner *r, double y)
{
    const struct strand *s = &w->strands[r->strand];
    while (r->point < s->last && w->points[r->point + 1].y <= y)
        r->point++;
    r->at = w->points[r->point];
    r->slope = 0;
    r->next_y = HUGE_VAL;
    if (r->point < s->last) {
        struct font_point next = w->points[r->point + 1];
        r->slope = (next.x - r->at.x) / (next.y - r->at.y);
        r->next_y = next.y;
    }
}

/* A strand's end may lie a little beside its level: it goes down from there. */
static double runner_x(const struct runner *r, double y)
{
    return y > r->at.y ? r->at.x + r->slope * (y - r->at.y) : r->at.x;
}

/* What a boundary passes from its head to its foot. Points are looked at from `from` on. */
static void runner_reach(struct sweep *w, struct runner *r, int from, double foot_y)
{
    const struct strand *s = &w->strands[r->strand];
    for (int k = from + 1; k <= s->last && w->points[k].y <= foot_y; k++)
        if (w->points[k].y > r->kept.y)
            side_reach(w, r, w->points[k], false);
    side_reach(w, r, (struct font_point){r->foot, foot_y}, false);
}

/* Where strands are in a strip, sorted by its middle. Those that bend in it have been told
 * their point before it. */
static void strip_sort(struct sweep *w, int count, double y, double foot_y)
{
    double middle = 0.5 * (y + foot_y);
    for (int i = 0; i < count; i++) {
        struct runner *r = &w->runners[i];
        if (foot_y <= r->next_y) {
            r->foot = runner_x(r, foot_y);
            r->middle = runner_x(r, middle);
        } else {
            struct runner ahead = *r;
            runner_walk(w, &ahead, middle);
            r->middle = runner_x(&ahead, middle);
            runner_walk(w, &ahead, foot_y);
            r->foot = runner_x(&ahead, foot_y);
        }
        if (i == 0 || r[-1].middle <= r->middle)
            continue;
        struct runner moved = *r;
        int at = i;
        for (; at > 0 && w->runners[at - 1].middle > moved.middle; at--)
            w->runners[at] = w->runners[at - 1];
        w->runners[at] = moved;
    }
}

/* Which strands are the strip's boundary, from what is left of each; and on to the strip's
 * foot. */
static void strip_wind(struct sweep *w, int count, double y, double foot_y)
{
    int winding = 0;
    bool inside = false;
    for (int i = 0; i < count && w->status == FONT_OK; i++) {
        struct runner *r = &w->runners[i];
        bool before = inside;
        winding += r->direction;
        inside = font_fill_has(winding, w->rule);
        int sense = inside - before;
        if (sense != r->sense) {
            struct font_point here = {r->head, y};
            if (r->sense)
                side_reach(w, r, here, true);
            end_add(w, r->head, sense - r->sense);
            r->sense = sense;
            r->kept = here;
        }
        int from = r->point;
        if (foot_y > r->next_y)
            runner_walk(w, r, foot_y);
        if (sense && w->status == FONT_OK)
            runner_reach(w, r, from, foot_y);
        r->head = r->foot;
    }
}

/* The strands that end at a level go, and those that begin there come. Returns how many there
 * are. */
static int level_change(struct sweep *w, int count, int level, int *next)
{
    double y = w->levels[level];
    int kept = 0;
    for (int i = 0; i < count && w->status == FONT_OK; i++) {
        struct runner *r = &w->runners[i];
        if (w->strands[r->strand].end > level) {
            if (kept < i)
                w->runners[kept] = *r;
            kept++;
        } else if (r->sense) {
            side_reach(w, r, (struct font_point){r->head, y}, true);
            end_add(w, r->head, -r->sense);
        }
    }
    for (; *next < w->strands_count && w->strands[*next].level <= level; ++*next) {
        const struct strand *s = &w->strands[*next];
        if (s->end <= level)
            continue;
        struct runner r = {.strand = *next, .point = s->first, .direction = s->direction};
        runner_walk(w, &r, y);
        r.head = runner_x(&r, y);
        w->runners[kept++] = r;
    }
    return kept;
}

/* Fills edges. Where lines become too many it ends before it is through. */
static void sweep_go(struct sweep *w)
{
    int count = 0, next = 0;
    w->ends_count = 0;
    w->edges->lines_count = 0;
    for (int k = 0; k < w->levels_count && w->status == FONT_OK; k++) {
        double y = w->levels[k];
        count = level_change(w, count, k, &next);
        if (k + 1 < w->levels_count) {
            strip_sort(w, count, y, w->levels[k + 1]);
            strip_wind(w, count, y, w->levels[k + 1]);
        }
        level_close(w, y);
        if (w->edges->lines_count > LINES_MAX)
            return;
    }
}

/* How high strips may be. Of d strands on a pixel's side some d^2 cross in a pixel, and a
 * crossing is wrong by the square of a strip's height; half of the errors are of one sign, so
 * that a pixel's grows as d. Measured: 0.03 over the root of d keeps it below one byte. */
static double strip_height(const struct sweep *w)
{
    double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL, length = 0;
    for (int i = 0; i < w->points_count; i++) {
        struct font_point p = w->points[i];
        x0 = fmin(x0, p.x);
        x1 = fmax(x1, p.x);
        y0 = fmin(y0, p.y);
        y1 = fmax(y1, p.y);
    }
    for (int i = 0; i < w->strands_count; i++)
        length += w->points[w->strands[i].last].y - w->points[w->strands[i].first].y;
    double crowd = length / (fmax(1, x1 - x0) * fmax(1, y1 - y0));
    return fmin(strip_most_px, fmax(strip_least_px, 0.03 / sqrt(fmax(crowd, 1e-9))));
}

enum font_status font_edges_tangled(struct font_edges *e, const struct font_outline *o,
                                    const struct font_map *map, const struct font_filter *f)
{
    struct sweep w = {.edges = e, .rule = o->rule};
    double chord = chord_px, apart = level_px, coarse = 1;
    while (!strands_make(&w, o, map, chord) && w.status == FONT_OK)
        chord *= 4;
    w.runners = malloc(((size_t)w.strands_count + 1) * sizeof *w.runners);
    if (!w.runners && w.status == FONT_OK)
        no_memory(&w);
    bool made = false;
    for (double high = strip_height(&w); !made && w.status == FONT_OK; high *= 2, apart *= 2) {
        if (!levels_make(&w, high, apart))
            continue;
        qsort(w.strands, (size_t)w.strands_count, sizeof *w.strands, strands_compare);
        /* High strips are less exact than that, and have many lines. */
        w.step_px = coarse * fmin(fmax(side_px, high / 2), fmax(f->step_px, side_px));
        sweep_go(&w);
        made = e->lines_count <= LINES_MAX;
        coarse *= 2;
    }
    free(w.points);
    free(w.strands);
    free(w.levels);
    free(w.runners);
    free(w.ends);
    return w.status;
}
