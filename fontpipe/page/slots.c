/* slots.c - where a frame has room for lines: all of it, but for obstacles, and within shapes.
 * See page_internal.h.
 *
 * A line takes a band of the frame. What of the band an obstacle covers is, seen along the
 * lines, what it covers at the band's two edges and what its own edges cover between them; a
 * shape that text stays inside leaves what it covers at one edge, less the same. */
#include "page_internal.h"

#include <math.h>

enum { INTERVALS_MAX = 48 };

struct interval {
    double a, b;
};
struct intervals {
    struct interval items[INTERVALS_MAX];
    int count;
};

double frame_measure(const struct page_frame *f)
{
    return f->vertical ? f->height : f->width;
}

double frame_depth(const struct page_frame *f)
{
    return f->vertical ? f->width : f->height;
}

void slot_point(const struct page_template *t, const struct slot *s, double u, double v,
                double *x, double *y)
{
    const struct page_frame *f = &t->frames[s->frame];
    *x = f->vertical ? f->x + f->width - v : f->x + u;
    *y = f->vertical ? f->y + u : f->y + v;
}

/* A shape's corner, along and across a frame's lines. */
static void corner(const struct page_frame *f, const struct page_shape *s, int i, double *u,
                   double *v)
{
    double x = s->points[2 * (i % s->points_count)],
           y = s->points[2 * (i % s->points_count) + 1];
    *u = f->vertical ? y - f->y : x - f->x;
    *v = f->vertical ? f->x + f->width - x : y - f->y;
}

static void interval_add(struct intervals *l, double a, double b)
{
    if (l->count < INTERVALS_MAX && b > a)
        l->items[l->count++] = (struct interval){a, b};
}

/* What of the line at v the shape covers. */
static void spans_at(const struct page_frame *f, const struct page_shape *s, double v,
                     struct intervals *out)
{
    double at[INTERVALS_MAX];
    int n = 0;
    for (int i = 0; i < s->points_count && n < INTERVALS_MAX; i++) {
        double u0, v0, u1, v1;
        corner(f, s, i, &u0, &v0);
        corner(f, s, i + 1, &u1, &v1);
        if ((v0 <= v) != (v1 <= v))
            at[n++] = u0 + (u1 - u0) * (v - v0) / (v1 - v0);
    }
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && at[k] < at[k - 1]; k--) {
            double swap = at[k];
            at[k] = at[k - 1];
            at[k - 1] = swap;
        }
    for (int i = 0; i + 1 < n; i += 2)
        interval_add(out, at[i], at[i + 1]);
}

/* What the shape's edges cover between v0 and v1. */
static void edges_between(const struct page_frame *f, const struct page_shape *s, double v0,
                          double v1, struct intervals *out)
{
    for (int i = 0; i < s->points_count; i++) {
        double a, av, b, bv;
        corner(f, s, i, &a, &av);
        corner(f, s, i + 1, &b, &bv);
        double t0 = 0, t1 = 1;
        if (bv != av) {
            double p = (v0 - av) / (bv - av), q = (v1 - av) / (bv - av);
            t0 = fmax(0, fmin(p, q));
            t1 = fmin(1, fmax(p, q));
        } else if (av < v0 || av > v1) {
            continue;
        }
        if (t0 > t1)
            continue;
        double e0 = a + (b - a) * t0, e1 = a + (b - a) * t1;
        interval_add(out, fmin(e0, e1), fmax(e0, e1) + 1e-9);
    }
}

/* Takes an interval out of what is free. */
static void take_out(struct intervals *l, double a, double b)
{
    for (int i = 0, count = l->count; i < count; i++) {
        struct interval *x = &l->items[i];
        double end = x->b;
        if (b <= x->a || a >= end)
            continue;
        x->b = fmax(x->a, fmin(end, a));
        interval_add(l, fmax(x->a, b), end);
    }
}

/* Takes out what stands beside lines of the frame. */
static void covers_take_out(const struct covers *covers, double blank, double v, double height,
                            struct intervals *l, double *least)
{
    for (int i = 0; covers && i < covers->count; i++) {
        const struct cover *c = &covers->items[i];
        double a, b;
        if (!cover_takes(c, v, height, &a, &b))
            continue;
        *least = fmax(*least, c->least + blank);
        take_out(l, a, b);
    }
}

static void free_find(const struct page_template *t, const struct page_frame *f, double v,
                      double height, struct intervals *l, double *least)
{
    l->count = 0;
    *least = 0;
    interval_add(l, 0, frame_measure(f));
    for (int i = 0; i < t->shapes_count; i++) {
        const struct page_shape *s = &t->shapes[i];
        struct intervals covered = {.count = 0};
        double d = s->distance_px, v0 = v - (s->inside ? 0 : d),
               v1 = v + height + (s->inside ? 0 : d);
        *least = fmax(*least, s->least_px > 0 ? s->least_px : 3 * height);
        edges_between(f, s, v0, v1, &covered);
        if (!s->inside) {
            spans_at(f, s, v0, &covered);
            spans_at(f, s, v1, &covered);
            for (int k = 0; k < covered.count; k++)
                take_out(l, covered.items[k].a - d, covered.items[k].b + d);
            continue;
        }
        struct intervals inner = {.count = 0};
        spans_at(f, s, (v0 + v1) / 2, &inner);
        double last = -1e9;
        for (int k = 0; k < inner.count; k++) { /* what lies between them is outside */
            take_out(l, last, inner.items[k].a + d);
            last = inner.items[k].b - d;
        }
        take_out(l, last, 1e9);
        for (int k = 0; k < covered.count; k++)
            take_out(l, covered.items[k].a - d, covered.items[k].b + d);
    }
}

static void intervals_sort(struct intervals *l)
{
    for (int i = 1; i < l->count; i++)
        for (int k = i; k > 0 && l->items[k].a < l->items[k - 1].a; k--) {
            struct interval swap = l->items[k];
            l->items[k] = l->items[k - 1];
            l->items[k - 1] = swap;
        }
}

bool slots_next(const struct page_template *t, int frame, const struct covers *covers,
                double blank_px, double *v, int *part, double v_end, double height_px,
                struct slot *out)
{
    const struct page_frame *f = &t->frames[frame];
    for (; *v + height_px <= v_end + 1e-6; *v += height_px, *part = 0) {
        struct intervals l;
        double least;
        int n = 0;
        free_find(t, f, *v, height_px, &l, &least);
        covers_take_out(covers, blank_px, *v, height_px, &l, &least);
        intervals_sort(&l);
        for (int i = 0; i < l.count; i++) {
            if (l.items[i].b - l.items[i].a < fmax(least, 1e-3) || n++ < *part)
                continue;
            *out = (struct slot){l.items[i].a, l.items[i].b, *v, frame};
            ++*part;
            return true;
        }
    }
    return false;
}
