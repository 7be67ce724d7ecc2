/* fill_arcs.c - an outline as arcs, and where they cross: for fill_quick.c.
 *
 * Segments are cut into arcs along which neither x nor y turns around, so an arc is within the
 * box of its ends. Of each two arcs whose boxes meet it is shown that they do not cross (a line
 * is between them, or, where one follows the other, a line through the point that they share),
 * or that they cross once; arcs for which neither is seen are halved:
 *
 *         \ |            a and b cross once: a's ends are on both sides of the band that b stays within, b's of
 *      ----\|----- b     a's, and no direction of a is one of b's.
 *           \ a
 */
#include "fill_internal.h"

#include <array.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    ARCS_MAX = 60000,
    PAIRS_MAX = 1000000, /* of arcs whose boxes meet; as many take some tenths of a second */
    DEPTH_MAX = 24,
    /* how often pairs are looked at, for each arc; for each pair; and beside that for all */
    LOOKS_OF_ARC = 24,
    LOOKS_OF_PAIR = 8,
    LOOKS = 400,
    GROUP = 8,
    AT_END = 1,  /* a ends where b begins */
    AT_BEGIN = 2 /* a begins where b ends */
};

/* A curve, or a part of an arc, with where that is. */
struct curve {
    struct font_point p[4];
    int degree;
    double t0, t1;
};

/* What a curve stays within: to the left of its chord, times the chord's length. */
struct band {
    double low, high;
};

/* Of numbers that are none but numbers: compilers call libraries for fmin(). */
static double least_of(double a, double b)
{
    return a < b ? a : b;
}

static double most_of(double a, double b)
{
    return a > b ? a : b;
}

static double within(double number, double low, double high)
{
    return most_of(low, least_of(high, number));
}

static double cross(struct font_point a, struct font_point b)
{
    return a.x * b.y - a.y * b.x;
}

static double dot(struct font_point a, struct font_point b)
{
    return a.x * b.x + a.y * b.y;
}

static struct font_point between(struct font_point a, struct font_point b, double t)
{
    return (struct font_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

static void curve_cut(const struct curve *c, double t, struct curve *low, struct curve *high)
{
    struct font_point q[4];
    memcpy(q, c->p, sizeof q);
    *low = *high = *c;
    for (int level = 0; level < c->degree; level++) {
        for (int i = 0; i < c->degree - level; i++)
            q[i] = between(q[i], q[i + 1], t);
        low->p[level + 1] = q[0];
        high->p[c->degree - level - 1] = q[c->degree - level - 1];
    }
    low->t1 = high->t0 = c->t0 + t * (c->t1 - c->t0);
}

/* ---- arcs ---- */

static int turns_add(double t, double *turns, int count)
{
    if (t > 1e-6 && t < 1 - 1e-6)
        turns[count++] = t;
    return count;
}

/* Where one coordinate, of control points v, turns around. */
static int turns_find(const double *v, int degree, double *turns, int count)
{
    double from = v[0], to = v[degree];
    bool even = true;
    for (int i = 0; i < degree; i++)
        even = even && (to > from ? v[i + 1] >= v[i] : v[i + 1] <= v[i]);
    if (even)
        return count;
    if (degree == 2)
        return turns_add((v[0] - v[1]) / (v[0] - 2 * v[1] + v[2]), turns, count);
    /* a t^2 - 2 b t + c, a third of the derivative. */
    double a = v[3] - v[0] + 3 * (v[1] - v[2]), b = 2 * v[1] - v[0] - v[2], c = v[1] - v[0];
    double square = b * b - a * c;
    if (!(square > 0))
        return count;
    double q = b + copysign(sqrt(square), b);
    if (a != 0)
        count = turns_add(q / a, turns, count);
    return q != 0 ? turns_add(c / q, turns, count) : count;
}

static bool arc_add(struct fill_work *w, const struct curve *c, int segment, int contour)
{
    struct font_point a = c->p[0], b = c->p[c->degree];
    if (a.x == b.x && a.y == b.y)
        return c->degree == 1; /* a curve that comes back is the strips' */
    w->spent = w->arcs_count == ARCS_MAX;
    if (w->spent ||
        !array_reserve(&w->arcs, &w->arcs_capacity, w->arcs_count + 1, sizeof *w->arcs) ||
        !array_reserve(&w->boxes, &w->boxes_capacity, w->arcs_count + 1, sizeof *w->boxes))
        return false;
    w->boxes[w->arcs_count] = (struct font_box){least_of(a.x, b.x), least_of(a.y, b.y),
                                                most_of(a.x, b.x), most_of(a.y, b.y)};
    struct fill_arc *arc = &w->arcs[w->arcs_count++];
    memcpy(arc->p, c->p, sizeof arc->p);
    arc->degree = c->degree;
    arc->segment = segment;
    arc->contour = contour;
    arc->t0 = c->t0;
    arc->t1 = c->t1;
    return true;
}

/* A point moved by at most `by` to each side: otherwise for each number. */
static struct font_point shaken(struct font_point p, uint32_t number, double by)
{
    uint32_t x = (number + 1) * 2654435761u, y;
    x = (x ^ x >> 15) * 2246822519u;
    x ^= x >> 13;
    y = (x ^ x >> 16) * 3266489917u;
    return (struct font_point){p.x + by * ((double)x / 2147483648.0 - 1),
                               p.y + by * ((double)y / 2147483648.0 - 1)};
}

/* next: the segment that follows in the contour, which begins where this one ends. */
static struct font_segment segment_shaken(const struct font_segment *s, int segment, int next,
                                          double by)
{
    struct font_segment out = *s;
    for (int i = 0; i <= s->degree; i++)
        out.p[i] = shaken(s->p[i], (uint32_t)(i < s->degree ? 4 * segment + i : 4 * next), by);
    return out;
}

static bool segment_arcs(struct fill_work *w, const struct font_segment *s, int segment)
{
    struct curve rest = {.degree = s->degree, .t0 = 0, .t1 = 1}, low;
    double turns[4], x[4], y[4];
    int count = 0;
    memcpy(rest.p, s->p, sizeof rest.p);
    if (s->degree > 1) {
        for (int i = 0; i <= s->degree; i++) {
            x[i] = s->p[i].x;
            y[i] = s->p[i].y;
        }
        count = turns_find(x, s->degree, turns, count);
        count = turns_find(y, s->degree, turns, count);
    }
    for (int i = 1; i < count; i++)
        for (int k = i; k > 0 && turns[k - 1] > turns[k]; k--) {
            double swap = turns[k];
            turns[k] = turns[k - 1];
            turns[k - 1] = swap;
        }
    for (int i = 0; i < count; i++) {
        double t = (turns[i] - rest.t0) / (1 - rest.t0);
        if (!(t > 1e-6 && t < 1 - 1e-6))
            continue;
        struct curve whole = rest;
        curve_cut(&whole, t, &low, &rest);
        if (!arc_add(w, &low, segment, s->contour))
            return false;
    }
    return arc_add(w, &rest, segment, s->contour);
}

/* ---- pairs ---- */

static struct band band_of(const struct curve *c, struct font_point chord)
{
    if (c->degree == 1)
        return (struct band){0, 0};
    double one = cross(chord, fill_minus(c->p[1], c->p[0]));
    if (c->degree == 2)
        return (struct band){least_of(0, one / 2), most_of(0, one / 2)};
    double two = cross(chord, fill_minus(c->p[2], c->p[0]));
    double part = one * two > 0 ? 0.75 : 4.0 / 9;
    return (struct band){least_of(0, part * least_of(one, two)),
                         most_of(0, part * most_of(one, two))};
}

/* +1, -1: all of c is on that side of a band; 2: its ends are on both sides of it; 0: none of
 * these. */
static int side_of(const struct curve *c, struct font_point from, struct font_point chord,
                   struct band band)
{
    double first = cross(chord, fill_minus(c->p[0], from)), low = first, high = first,
           last = first;
    for (int i = 1; i <= c->degree; i++) {
        last = cross(chord, fill_minus(c->p[i], from));
        low = least_of(low, last);
        high = most_of(high, last);
    }
    if (low > band.high)
        return 1;
    if (high < band.low)
        return -1;
    return (first > band.high && last < band.low) || (first < band.low && last > band.high) ? 2
                                                                                            : 0;
}

/* No direction of the one is one of the other's. */
static bool directions_differ(const struct curve *a, const struct curve *b)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < a->degree; i++)
        for (int k = 0; k < b->degree; k++) {
            double turn =
                cross(fill_minus(a->p[i + 1], a->p[i]), fill_minus(b->p[k + 1], b->p[k]));
            low = least_of(low, turn);
            high = most_of(high, turn);
        }
    return low > 0 || high < 0;
}

/* A line along v through the point that both share, with a on its left and b on its right. */
static bool line_between(struct font_point v, const struct font_point *a, int a_count,
                         const struct font_point *b, int b_count)
{
    bool ahead[2] = {false, false}, behind[2] = {false, false};
    for (int i = 0; i < a_count + b_count; i++) {
        bool of_b = i >= a_count;
        struct font_point p = of_b ? b[i - a_count] : a[i];
        double side = cross(v, p), along = dot(v, p);
        if (of_b ? side > 0 : side < 0)
            return false;
        ahead[of_b] = ahead[of_b] || (side == 0 && along > 0);
        behind[of_b] = behind[of_b] || (side == 0 && along < 0);
    }
    return !(ahead[0] && ahead[1]) && !(behind[0] && behind[1]);
}

/* a's end is b's beginning, and nothing else of the two meets. */
static bool parted_at_joint(const struct curve *a, const struct curve *b)
{
    struct font_point joint = b->p[0], of_a[3], of_b[3];
    int n = 0, m = 0;
    for (int i = a->degree - 1; i >= 0; i--)
        if (a->p[i].x != joint.x || a->p[i].y != joint.y)
            of_a[n++] = fill_minus(a->p[i], joint);
    for (int i = 1; i <= b->degree; i++)
        if (b->p[i].x != joint.x || b->p[i].y != joint.y)
            of_b[m++] = fill_minus(b->p[i], joint);
    if (!n || !m)
        return false;
    struct font_point along = fill_minus(of_b[0], of_a[0]);
    bool parted = true;
    for (int i = 0; i < n && parted; i++)
        parted = dot(along, of_a[i]) < 0;
    for (int i = 0; i < m && parted; i++)
        parted = dot(along, of_b[i]) > 0;
    for (int i = 0; i < n + m && !parted; i++) {
        struct font_point v = i < n ? of_a[i] : of_b[i - n];
        struct font_point back = {-v.x, -v.y};
        parted = line_between(v, of_a, n, of_b, m) || line_between(back, of_a, n, of_b, m);
    }
    return parted;
}

static bool meet_add(struct fill_work *w, int arc, double t, int turn)
{
    if (!array_reserve(&w->meets, &w->meets_capacity, w->meets_count + 1, sizeof *w->meets))
        return false;
    w->meets[w->meets_count++] = (struct fill_meet){arc, w->crossings, turn, t};
    return true;
}

struct font_point fill_arc_at(const struct fill_arc *a, double t, struct font_point *speed)
{
    struct font_segment s = {.degree = a->degree};
    memcpy(s.p, a->p, sizeof s.p);
    return font_segment_at(&s, t, speed);
}

/* They cross once: Newton's steps from where their chords do. */
static bool crossing_add(struct fill_work *w, int a, const struct curve *ca, int b,
                         const struct curve *cb)
{
    struct font_point p = fill_minus(ca->p[ca->degree], ca->p[0]),
                      q = fill_minus(cb->p[cb->degree], cb->p[0]),
                      r = fill_minus(cb->p[0], ca->p[0]);
    double det = cross(p, q);
    int turn = det > 0 ? 1 : -1; /* b goes from a's right to its left, or back */
    double t = ca->t0 + (ca->t1 - ca->t0) * cross(r, q) / det;
    double u = cb->t0 + (cb->t1 - cb->t0) * cross(r, p) / det;
    struct font_point at = {0, 0};
    bool found = false;
    for (int n = 0; n < 12 && !found; n++) {
        struct font_point dp, dq, x = fill_arc_at(&w->arcs[a], t, &dp),
                                  y = fill_arc_at(&w->arcs[b], u, &dq);
        r = fill_minus(y, x);
        det = cross(dp, dq);
        at = between(x, y, 0.5);
        double step_t = cross(r, dq) / det, step_u = cross(r, dp) / det;
        found = fabs(r.x) + fabs(r.y) <=
                1e-13 * (fabs(dp.x) + fabs(dp.y) + fabs(dq.x) + fabs(dq.y));
        t = within(t + step_t, ca->t0, ca->t1);
        u = within(u + step_u, cb->t0, cb->t1);
    }
    /* At an end they touch, and where that is the end of an arc there is nothing to cut. */
    found = found && t > ca->t0 && t < ca->t1 && u > cb->t0 && u < cb->t1;
    if (!found ||
        !array_reserve(&w->joints, &w->joints_capacity, w->crossings + 1, sizeof *w->joints) ||
        !meet_add(w, a, t, turn) || !meet_add(w, b, u, -turn))
        return false;
    w->joints[w->crossings++] = (struct fill_joint){at, 0, false};
    return true;
}

static bool boxes_apart(const struct curve *a, const struct curve *b)
{
    struct font_point a0 = a->p[0], a1 = a->p[a->degree], b0 = b->p[0], b1 = b->p[b->degree];
    return most_of(a0.x, a1.x) < least_of(b0.x, b1.x) ||
           least_of(a0.x, a1.x) > most_of(b0.x, b1.x) ||
           most_of(a0.y, a1.y) < least_of(b0.y, b1.y) ||
           least_of(a0.y, a1.y) > most_of(b0.y, b1.y);
}

static double size_of(const struct curve *c)
{
    return c->degree == 1
               ? 0
               : fabs(c->p[c->degree].x - c->p[0].x) + fabs(c->p[c->degree].y - c->p[0].y);
}

/* Notes where parts of two arcs cross. False: it is not seen. */
static bool pair_look(struct fill_work *w, int a, const struct curve *ca, int b,
                      const struct curve *cb, int joined, int depth)
{
    if (boxes_apart(ca, cb))
        return true;
    if (w->looks-- <= 0 || depth > DEPTH_MAX)
        return false;
    if (joined == AT_END || joined == AT_BEGIN) {
        if (joined == AT_END ? parted_at_joint(ca, cb) : parted_at_joint(cb, ca))
            return true;
    } else if (!joined) {
        struct font_point chord_a = fill_minus(ca->p[ca->degree], ca->p[0]);
        struct font_point chord_b = fill_minus(cb->p[cb->degree], cb->p[0]);
        int a_side = side_of(ca, cb->p[0], chord_b, band_of(cb, chord_b));
        if (a_side == 1 || a_side == -1)
            return true;
        int b_side = side_of(cb, ca->p[0], chord_a, band_of(ca, chord_a));
        if (b_side == 1 || b_side == -1)
            return true;
        if (a_side == 2 && b_side == 2 && directions_differ(ca, cb))
            return crossing_add(w, a, ca, b, cb);
    }
    if (ca->degree == 1 && cb->degree == 1)
        return false;
    /* Not in the middle, where of symmetric letters much meets. */
    static const double where = 0.4871;
    struct curve low, high;
    if (size_of(ca) >= size_of(cb)) {
        curve_cut(ca, where, &low, &high);
        return pair_look(w, a, &low, b, cb, joined & AT_BEGIN, depth + 1) &&
               pair_look(w, a, &high, b, cb, joined & AT_END, depth + 1);
    }
    curve_cut(cb, where, &low, &high);
    return pair_look(w, a, ca, b, &low, joined & AT_END, depth + 1) &&
           pair_look(w, a, ca, b, &high, joined & AT_BEGIN, depth + 1);
}

/* The first arc of the contour that an arc is of, and behind its last: arcs of a contour follow
 * each other. */
static void contours_find(struct fill_work *w)
{
    for (int begin = 0, end; begin < w->arcs_count; begin = end) {
        for (end = begin + 1;
             end < w->arcs_count && w->arcs[end].contour == w->arcs[begin].contour;)
            end++;
        for (int i = begin; i < end; i++) {
            w->arcs[i].next = i + 1 == end ? begin : i + 1;
            struct font_point last = w->arcs[i].p[w->arcs[i].degree];
            struct font_point first = w->arcs[w->arcs[i].next].p[0];
            /* Where arcs of no length were left out the ends are the same points all the
             * same. */
            w->arcs[i].joined = last.x == first.x && last.y == first.y;
        }
    }
}

bool fill_arcs_make(struct fill_work *w, const struct font_outline *o, double shake)
{
    int few = o->segments_count < ARCS_MAX ? o->segments_count + o->segments_count / 2 : 0;
    if (!array_reserve(&w->arcs, &w->arcs_capacity, few, sizeof *w->arcs) ||
        !array_reserve(&w->boxes, &w->boxes_capacity, few, sizeof *w->boxes))
        return false;
    for (int begin = 0, end; begin < o->segments_count; begin = end) {
        for (end = begin + 1;
             end < o->segments_count && o->segments[end].contour == o->segments[begin].contour;)
            end++;
        for (int i = begin; i < end; i++) {
            struct font_segment s = o->segments[i];
            if (shake > 0)
                s = segment_shaken(&s, i, i + 1 == end ? begin : i + 1, shake);
            if (!segment_arcs(w, &s, i))
                return false;
        }
    }
    contours_find(w);
    return true;
}

static void arc_curve(const struct fill_arc *a, struct curve *out)
{
    memcpy(out->p, a->p, sizeof out->p);
    out->degree = a->degree;
    out->t0 = 0;
    out->t1 = 1;
}

/* A box's corners, each a vector. */
typedef double corner __attribute__((vector_size(16), aligned(8), may_alias));

static inline bool boxes_meet(const struct font_box *a, const struct font_box *b)
{
    const corner *p = (const void *)a, *q = (const void *)b;
    const __typeof__(p[0] > q[0]) apart = (p[0] > q[1]) | (q[0] > p[1]);
    return !(apart[0] | apart[1]);
}

/* A box around each few arcs that follow each other: behind the arcs' own. */
static bool groups_make(struct fill_work *w)
{
    int n = w->arcs_count, groups = (n + GROUP - 1) / GROUP;
    if (!array_reserve(&w->boxes, &w->boxes_capacity, n + groups, sizeof *w->boxes))
        return false;
    for (int g = 0; g < groups; g++) {
        struct font_box box = w->boxes[g * GROUP];
        for (int i = g * GROUP + 1; i < n && i < (g + 1) * GROUP; i++) {
            const struct font_box *one = &w->boxes[i];
            box.x0 = least_of(box.x0, one->x0);
            box.y0 = least_of(box.y0, one->y0);
            box.x1 = most_of(box.x1, one->x1);
            box.y1 = most_of(box.y1, one->y1);
        }
        w->boxes[n + g] = box;
    }
    return true;
}

/* One arc and those from `begin` to before `end`. */
static bool arcs_look(struct fill_work *w, int i, const struct curve *ca, int begin, int end)
{
    const struct font_box box = w->boxes[i];
    for (int k = begin; k < end; k++) {
        if (!boxes_meet(&box, &w->boxes[k]))
            continue;
        w->looks += LOOKS_OF_PAIR;
        w->spent = ++w->pairs > PAIRS_MAX;
        if (w->spent)
            return false;
        const struct fill_arc *b = &w->arcs[k];
        int joined = (w->arcs[i].next == k ? AT_END : 0) | (b->next == i ? AT_BEGIN : 0);
        struct curve cb;
        arc_curve(b, &cb);
        if (!pair_look(w, i, ca, k, &cb, joined, 0))
            return false;
    }
    return true;
}

bool fill_arcs_cross(struct fill_work *w)
{
    int n = w->arcs_count;
    w->looks = LOOKS + LOOKS_OF_ARC * n;
    w->pairs = 0;
    if (!groups_make(w))
        return false;
    for (int i = 0; i < n; i++) {
        struct curve ca;
        if (!w->arcs[i].joined)
            return false;
        arc_curve(&w->arcs[i], &ca);
        for (int g = i / GROUP; g * GROUP < n; g++) {
            int begin = g * GROUP, end = begin + GROUP < n ? begin + GROUP : n;
            if (begin <= i)
                begin = i + 1;
            if (boxes_meet(&w->boxes[i], &w->boxes[n + g]) && !arcs_look(w, i, &ca, begin, end))
                return false;
        }
    }
    return true;
}
