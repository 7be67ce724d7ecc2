/* outline.c - see outline.h. */
#include "outline.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double coordinate_max = 1e7;

void font_outline_finish(struct font_outline *o)
{
    free(o->segments);
    free(o->polynomials);
    *o = (struct font_outline){0};
}

enum font_status font_outline_polynomials(struct font_outline *o)
{
    int stride = (o->segments_count + 15) / 16 * 16 + 16;
    float *at = aligned_alloc(64, sizeof(float) * 8 * (size_t)stride);
    free(o->polynomials);
    o->polynomials = at;
    o->polynomials_stride = stride;
    if (!at)
        return font_fail(FONT_NO_MEMORY, "no memory for an outline");
    memset(at, 0, sizeof(float) * 8 * (size_t)stride);
    for (int i = 0; i < o->segments_count; i++) {
        const struct font_segment *s = &o->segments[i];
        const struct font_point *p = s->p;
        double d = s->degree,
               c[8] = {p[0].x, p[0].y, d * (p[1].x - p[0].x), d * (p[1].y - p[0].y)};
        if (s->degree > 1) {
            double pairs = d == 2 ? 1 : 3;
            c[4] = pairs * (p[0].x - 2 * p[1].x + p[2].x);
            c[5] = pairs * (p[0].y - 2 * p[1].y + p[2].y);
        }
        if (s->degree == 3) {
            c[6] = p[3].x - p[0].x + 3 * (p[1].x - p[2].x);
            c[7] = p[3].y - p[0].y + 3 * (p[1].y - p[2].y);
        }
        for (int k = 0; k < 8; k++)
            at[k * stride + i] = (float)c[k];
    }
    return FONT_OK;
}

enum font_status font_outline_copy(const struct font_outline *from, struct font_outline *to)
{
    *to = *from;
    to->segments = NULL;
    to->polynomials = NULL;
    to->segments_capacity = 0;
    to->segments_count = 0;
    if (!array_reserve(&to->segments, &to->segments_capacity, from->segments_count,
                       sizeof *to->segments))
        return font_fail(FONT_NO_MEMORY, "no memory for an outline");
    if (from->segments_count)
        memcpy(to->segments, from->segments,
               (size_t)from->segments_count * sizeof *to->segments);
    to->segments_count = from->segments_count;
    return to->prepared ? font_outline_polynomials(to) : FONT_OK;
}

static bool point_fits(double x, double y)
{
    return fabs(x) <= coordinate_max && fabs(y) <= coordinate_max; /* false for NaN */
}

static enum font_status segment_add(struct font_outline *o, int degree,
                                    const struct font_point *points)
{
    if (!o->open)
        return font_fail(FONT_BAD_ARGUMENT, "an outline's contour begins with a move");
    for (int i = 0; i < degree; i++)
        if (!point_fits(points[i].x, points[i].y))
            return font_fail(FONT_BAD_ARGUMENT, "an outline's point (%g, %g) is beyond 1e7",
                             points[i].x, points[i].y);
    if (o->segments_count == FONT_SEGMENTS_MAX)
        return font_fail(FONT_TOO_LARGE, "an outline has more than %d segments",
                         FONT_SEGMENTS_MAX);
    if (!array_reserve(&o->segments, &o->segments_capacity, o->segments_count + 1,
                       sizeof *o->segments))
        return font_fail(FONT_NO_MEMORY, "no memory for an outline");
    struct font_segment *s = &o->segments[o->segments_count++];
    *s = (struct font_segment){.degree = degree, .contour = o->contours_count};
    s->p[0] = o->last;
    memcpy(s->p + 1, points, (size_t)degree * sizeof *points);
    o->last = points[degree - 1];
    o->prepared = false;
    return FONT_OK;
}

enum font_status font_outline_close(struct font_outline *o)
{
    if (!o->open)
        return FONT_OK;
    enum font_status status = FONT_OK;
    if (o->last.x != o->first.x || o->last.y != o->first.y)
        status = segment_add(o, 1, &o->first);
    o->open = false;
    o->contours_count++;
    return status;
}

enum font_status font_outline_move(struct font_outline *o, double x, double y)
{
    enum font_status status = font_outline_close(o);
    if (status != FONT_OK)
        return status;
    if (!point_fits(x, y))
        return font_fail(FONT_BAD_ARGUMENT, "an outline's point (%g, %g) is beyond 1e7", x, y);
    o->first = o->last = (struct font_point){x, y};
    o->open = true;
    return FONT_OK;
}

enum font_status font_outline_line(struct font_outline *o, double x, double y)
{
    struct font_point points[] = {{x, y}};
    return x == o->last.x && y == o->last.y && o->open ? FONT_OK : segment_add(o, 1, points);
}

enum font_status font_outline_quad(struct font_outline *o, double cx, double cy, double x,
                                   double y)
{
    struct font_point points[] = {{cx, cy}, {x, y}};
    return segment_add(o, 2, points);
}

enum font_status font_outline_cubic(struct font_outline *o, double c0x, double c0y, double c1x,
                                    double c1y, double x, double y)
{
    struct font_point points[] = {{c0x, c0y}, {c1x, c1y}, {x, y}};
    return segment_add(o, 3, points);
}

struct font_point font_segment_at(const struct font_segment *s, double t,
                                  struct font_point *speed)
{
    const struct font_point *p = s->p;
    double u = 1 - t;
    struct font_point at, d;
    switch (s->degree) {
    case 1:
        at = (struct font_point){u * p[0].x + t * p[1].x, u * p[0].y + t * p[1].y};
        d = (struct font_point){p[1].x - p[0].x, p[1].y - p[0].y};
        break;
    case 2:
        at = (struct font_point){u * u * p[0].x + 2 * u * t * p[1].x + t * t * p[2].x,
                                 u * u * p[0].y + 2 * u * t * p[1].y + t * t * p[2].y};
        d = (struct font_point){2 * (u * (p[1].x - p[0].x) + t * (p[2].x - p[1].x)),
                                2 * (u * (p[1].y - p[0].y) + t * (p[2].y - p[1].y))};
        break;
    default: {
        double a = u * u * u, b = 3 * u * u * t, c = 3 * u * t * t, e = t * t * t;
        at = (struct font_point){a * p[0].x + b * p[1].x + c * p[2].x + e * p[3].x,
                                 a * p[0].y + b * p[1].y + c * p[2].y + e * p[3].y};
        double f = 3 * u * u, g = 6 * u * t, h = 3 * t * t;
        d = (struct font_point){
            f * (p[1].x - p[0].x) + g * (p[2].x - p[1].x) + h * (p[3].x - p[2].x),
            f * (p[1].y - p[0].y) + g * (p[2].y - p[1].y) + h * (p[3].y - p[2].y)};
    }
    }
    if (speed)
        *speed = d;
    return at;
}

static struct font_point mix(struct font_point a, struct font_point b, double t)
{
    return (struct font_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/* The curve's polar form at the given parameters: one for each degree. */
static struct font_point polar(const struct font_segment *s, const double *t)
{
    struct font_point q[4];
    memcpy(q, s->p, sizeof q);
    for (int level = 0; level < s->degree; level++)
        for (int i = 0; i < s->degree - level; i++)
            q[i] = mix(q[i], q[i + 1], t[level]);
    return q[0];
}

struct font_segment font_segment_part(const struct font_segment *s, double t0, double t1)
{
    struct font_segment part = *s;
    for (int i = 0; i <= s->degree; i++) {
        double t[3];
        for (int k = 0; k < s->degree; k++)
            t[k] = k < i ? t1 : t0;
        part.p[i] = polar(s, t);
    }
    return part;
}

struct font_box font_outline_box(const struct font_outline *o)
{
    if (!o->segments_count)
        return (struct font_box){0};
    struct font_point p = o->segments[0].p[0];
    struct font_box box = {p.x, p.y, p.x, p.y};
    for (int i = 0; i < o->segments_count; i++)
        for (int k = 0; k <= o->segments[i].degree; k++) {
            p = o->segments[i].p[k];
            box.x0 = p.x < box.x0 ? p.x : box.x0;
            box.y0 = p.y < box.y0 ? p.y : box.y0;
            box.x1 = p.x > box.x1 ? p.x : box.x1;
            box.y1 = p.y > box.y1 ? p.y : box.y1;
        }
    return box;
}

/* ---- emboldening ---- */

/* The direction in which the segment leaves its first point, or with `end` arrives at its last:
 * control points that coincide are passed over. */
static struct font_point direction(const struct font_segment *s, bool end)
{
    for (int k = 1; k <= s->degree; k++) {
        struct font_point a = end ? s->p[s->degree - k] : s->p[0];
        struct font_point b = end ? s->p[s->degree] : s->p[k];
        double length = hypot(b.x - a.x, b.y - a.y);
        if (length > 0)
            return (struct font_point){(b.x - a.x) / length, (b.y - a.y) / length};
    }
    return (struct font_point){0, 0};
}

/* How far a corner between two directions moves so that both sides move by 1 to the left; no
 * further than 2. */
static struct font_point miter(struct font_point in, struct font_point out)
{
    struct font_point sum = {-in.y - out.y, in.x + out.x};
    double square = (sum.x * sum.x + sum.y * sum.y) / 2; /* 1 + cos */
    if (square < 0.25)
        return (struct font_point){-in.y, in.x};
    return (struct font_point){sum.x / square, sum.y / square};
}

enum font_status font_outline_embolden(struct font_outline *o, double x, double y)
{
    if (o->rebuilt)
        return font_fail(FONT_BAD_ARGUMENT,
                         "an outline is emboldened before it is prepared, not after");
    enum font_status status = font_outline_close(o);
    if (status != FONT_OK)
        return status;
    /* Outwards is to the left where contours turn clockwise (their area is negative, y
     * upwards). */
    double area = 0;
    for (int i = 0; i < o->segments_count; i++) {
        const struct font_segment *s = &o->segments[i];
        for (int k = 0; k < s->degree; k++)
            area += s->p[k].x * s->p[k + 1].y - s->p[k + 1].x * s->p[k].y;
    }
    double side = area < 0 ? 0.5 : -0.5;
    struct font_segment *moved = malloc(((size_t)o->segments_count + 1) * sizeof *moved);
    if (!moved)
        return font_fail(FONT_NO_MEMORY, "no memory for an outline");
    for (int begin = 0, end; begin < o->segments_count; begin = end) {
        for (end = begin + 1;
             end < o->segments_count && o->segments[end].contour == o->segments[begin].contour;)
            end++;
        for (int i = begin; i < end; i++) {
            const struct font_segment *s = &o->segments[i];
            const struct font_segment *before = &o->segments[i == begin ? end - 1 : i - 1];
            const struct font_segment *after = &o->segments[i + 1 == end ? begin : i + 1];
            struct font_point in = direction(s, false), out = direction(s, true), shift[4];
            shift[0] = miter(direction(before, true), in);
            shift[s->degree] = miter(out, direction(after, false));
            if (s->degree == 2)
                shift[1] = miter(in, out);
            if (s->degree == 3) {
                struct font_segment handle = {.degree = 1, .p = {s->p[1], s->p[2]}};
                struct font_point middle = direction(&handle, false);
                shift[1] = miter(in, middle);
                shift[2] = miter(middle, out);
            }
            moved[i] = *s;
            for (int k = 0; k <= s->degree; k++) {
                moved[i].p[k].x += side * x * shift[k].x;
                moved[i].p[k].y += side * y * shift[k].y;
            }
        }
    }
    if (o->segments_count)
        memcpy(o->segments, moved, (size_t)o->segments_count * sizeof *moved);
    free(moved);
    o->prepared = false;
    return FONT_OK;
}
