/* fill_quick.c - the same as fill.c's strips find, from where the curves themselves cross
 * (fill_arcs.c).
 *
 * A contour is cut into links where it crosses others and itself. Along a link the winding
 * number beside it stays the same, and from one to the next it changes by 1 or -1, by the
 * direction of what is crossed. So one ray from one point of each contour gives it everywhere;
 * both arcs of a crossing must find the same there.
 *
 * What touches or runs along another curve is not seen so. Then each point is moved by some
 * 10^-8 of the outline: what touched is then apart, or crosses, and the ink is the same for any
 * picture. What is not seen even then is left to the strips: fill_quick() says no. */
#include "fill_internal.h"

#include <array.h>
#include <stdlib.h>

/* Of the outline's extent. */
#define SHAKE 6e-8

/* x of an arc (or y, as `across` says) where its other coordinate is `at`. */
static double arc_across(const struct fill_arc *a, double at, bool across)
{
    double low = 0, high = 1, t = 0.5;
    double from = across ? a->p[0].x : a->p[0].y;
    double to = across ? a->p[a->degree].x : a->p[a->degree].y;
    struct font_point p = a->p[0], speed;
    t = (at - from) / (to - from);
    for (int n = 0; n < 60; n++) {
        p = fill_arc_at(a, t, &speed);
        double off = (across ? p.x : p.y) - at, slope = across ? speed.x : speed.y;
        if (off == 0 || high - low < 1e-15)
            break;
        if ((off < 0) == (to > from))
            low = t;
        else
            high = t;
        double next = t - off / slope;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        bool close = fabs(next - t) < 1e-14;
        t = next;
        if (close)
            break;
    }
    return across ? p.y : p.x;
}

/* The winding number beside a point of an arc: to the left of it, or with `across`, for arcs
 * that are level, below it. */
static bool winding_beside(const struct fill_work *w, int own, struct font_point at,
                           bool across, double close, int *winding)
{
    double along = across ? at.x : at.y, beside = across ? at.y : at.x;
    *winding = 0;
    for (int i = 0; i < w->arcs_count; i++) {
        const struct fill_arc *a = &w->arcs[i];
        double from = across ? a->p[0].x : a->p[0].y;
        double to = across ? a->p[a->degree].x : a->p[a->degree].y;
        if (i == own || (from <= along) == (to <= along))
            continue;
        double low = across ? w->boxes[i].y0 : w->boxes[i].x0,
               high = across ? w->boxes[i].y1 : w->boxes[i].x1;
        if (low > beside + close)
            continue;
        if (high >= beside - close) {
            double there = a->degree == 1 ? (across ? a->p[0].y : a->p[0].x) +
                                                ((across ? a->p[1].y : a->p[1].x) -
                                                 (across ? a->p[0].y : a->p[0].x)) *
                                                    ((along - from) / (to - from))
                                          : arc_across(a, along, across);
            if (fabs(there - beside) < close)
                return false;
            if (there > beside)
                continue;
        }
        *winding += (to > from) != across ? 1 : -1;
    }
    return true;
}

static bool link_add(struct fill_work *w, int arc, double t0, double t1, int from,
                     const struct fill_meet *to)
{
    if (!array_reserve(&w->links, &w->links_capacity, w->links_count + 1, sizeof *w->links))
        return false;
    w->links[w->links_count++] =
        (struct fill_link){arc, from, to ? to->joint : -1, to ? to->turn : 0, 0, t0, t1};
    return true;
}

static int meets_compare(const void *a, const void *b)
{
    const struct fill_meet *p = a, *q = b;
    return p->arc != q->arc ? (p->arc > q->arc) - (p->arc < q->arc)
                            : (p->t > q->t) - (p->t < q->t);
}

/* Cuts all arcs where they cross others. */
static bool links_make(struct fill_work *w)
{
    int next = 0;
    if (!array_reserve(&w->links, &w->links_capacity, w->arcs_count + w->meets_count,
                       sizeof *w->links))
        return false;
    if (w->meets_count)
        qsort(w->meets, (size_t)w->meets_count, sizeof *w->meets, meets_compare);
    for (int i = 0; i < w->arcs_count; i++) {
        double t = 0;
        int from = -1;
        for (; next < w->meets_count && w->meets[next].arc == i; next++) {
            const struct fill_meet *m = &w->meets[next];
            if (!(m->t > t) || !link_add(w, i, t, m->t, from, m))
                return false;
            t = m->t;
            from = m->joint;
        }
        if (!link_add(w, i, t, 1, from, NULL))
            return false;
    }
    return true;
}

static struct font_point link_end(const struct fill_work *w, const struct fill_link *l,
                                  bool last)
{
    const struct fill_arc *a = &w->arcs[l->arc];
    int joint = last ? l->to : l->from;
    if (joint >= 0)
        return w->joints[joint].at;
    return last ? a->p[a->degree] : a->p[0];
}

struct wound {
    enum font_fill rule;
    double close;
    int least, most;
};

/* The winding number to the left of one of the links first..end: of the longest, by a ray. -1:
 * there is none, or the ray meets a corner. */
static int longest_wind(const struct fill_work *w, double close, int first, int end, int *left)
{
    double longest = 0;
    bool across = false;
    int best = -1, before;
    for (int k = first; k < end; k++) {
        struct font_point d =
            fill_minus(link_end(w, &w->links[k], true), link_end(w, &w->links[k], false));
        double far = fmax(fabs(d.x), fabs(d.y));
        if (far > longest) {
            longest = far;
            best = k;
            across = fabs(d.x) > fabs(d.y);
        }
    }
    if (best < 0)
        return -1;
    const struct fill_link *link = &w->links[best];
    const struct fill_arc *arc = &w->arcs[link->arc];
    struct font_point at = fill_arc_at(arc, 0.5 * (link->t0 + link->t1), NULL);
    struct font_point along = fill_minus(arc->p[arc->degree], arc->p[0]);
    if (!winding_beside(w, link->arc, at, across, close, &before))
        return -1;
    /* What lies to the left of an arc that rises lies to the right of one that falls, where the
     * number is greater by one. */
    bool beside_left = across ? along.x < 0 : along.y > 0;
    *left = beside_left ? before : before - 1;
    return best;
}

/* The contour whose links are first..end: on which of their sides ink is. Where it crosses
 * another arc the winding number changes by the one that this adds, and all around the contour
 * it comes back to what it was. False: that it does not, or where it crosses another contour
 * they do not agree. */
static bool contour_wind(struct fill_work *w, struct wound *wound, int first, int end)
{
    int left, begin = longest_wind(w, wound->close, first, end, &left);
    if (begin < 0)
        return false;
    int number = left;
    for (int i = 0, k = begin; i < end - first; i++, k = k + 1 == end ? first : k + 1) {
        struct fill_link *l = &w->links[k];
        bool outside = font_fill_has(number, wound->rule);
        bool inside = font_fill_has(number + 1, wound->rule);
        l->runs = outside == inside ? 0 : inside ? 1 : -1;
        wound->least = number < wound->least ? number : wound->least;
        wound->most = number + 1 > wound->most ? number + 1 : wound->most;
        if (l->to < 0)
            continue;
        struct fill_joint *joint = &w->joints[l->to];
        if (joint->known && joint->twice != 2 * number + l->turn)
            return false;
        joint->known = true;
        joint->twice = 2 * number + l->turn;
        number += l->turn;
    }
    return number == left;
}

/* What is kept of the links, as portions. */
static bool portions_make(struct fill_work *w)
{
    for (int i = 0; i < w->links_count; i++) {
        const struct fill_link *l = &w->links[i];
        const struct fill_arc *a = &w->arcs[l->arc];
        if (!l->runs)
            continue;
        double range = a->t1 - a->t0, ta = a->t0 + l->t0 * range,
               tb = l->t1 == 1 ? a->t1 : a->t0 + l->t1 * range;
        struct font_point p = link_end(w, l, false), q = link_end(w, l, true);
        if (!array_reserve(&w->portions, &w->portions_capacity, w->portions_count + 1,
                           sizeof *w->portions))
            return false;
        w->portions[w->portions_count++] =
            l->runs > 0 ? (struct fill_portion){ta, tb, p, q, a->segment}
                        : (struct fill_portion){tb, ta, q, p, a->segment};
    }
    return true;
}

bool fill_quick(struct fill_work *w, const struct font_outline *o, enum font_fill rule,
                bool shaken_first, int *least, int *most)
{
    struct wound wound = {.rule = rule};
    const struct font_box box = o->box;
    double extent = fmax(box.x1 - box.x0, box.y1 - box.y0);
    wound.close = 1e-10 * extent;
    w->crossings = w->arcs_count = w->links_count = w->meets_count = w->portions_count = 0;
    if (!fill_arcs_make(w, o, shaken_first ? SHAKE * extent : 0))
        return false;
    if (!fill_arcs_cross(w) || !links_make(w))
        return false;
    for (int begin = 0, end; begin < w->links_count; begin = end) {
        int contour = w->arcs[w->links[begin].arc].contour;
        for (end = begin + 1;
             end < w->links_count && w->arcs[w->links[end].arc].contour == contour;)
            end++;
        if (!contour_wind(w, &wound, begin, end))
            return false;
    }
    *least = wound.least;
    *most = wound.most;
    return !fill_twice(*least, *most) || portions_make(w);
}
