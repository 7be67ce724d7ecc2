/* arcs.c - see arcs.h. */
#include "arcs.h"
#include "edges_internal.h"
#include "internal.h"

#include <array.h>
#include <math.h>
#include <stdlib.h>

#define INLINE static inline __attribute__((always_inline))

/* A turning point closer to an arc's end than this part of it is left alone: it is then off by
 * a millionth of the bend. */
#define TURN_PART 1e-3f

struct maker {
    struct font_edges *e;
    float side;
    float per_span, per_bend; /* one over the filter's limits; four times the bend */
    bool discs;               /* arcs may turn around in y */
    float x0, y0, x1, y1;
    enum font_status status;
};

/* Room for one more. */
INLINE bool room(struct maker *m)
{
    struct font_edges *e = m->e;
    if (m->status != FONT_OK)
        return false;
    if (e->arcs_count < e->arcs_capacity)
        return true;
    if (e->arcs_count >= FONT_EDGES_MAX)
        m->status = font_fail(FONT_TOO_LARGE, "an outline has too many edges at this size");
    else if (!array_reserve(&e->arcs, &e->arcs_capacity, e->arcs_count + 1, sizeof *e->arcs))
        m->status = font_fail(FONT_NO_MEMORY, "no memory for edges");
    return m->status == FONT_OK;
}

INLINE float larger(float a, float b)
{
    return a > b ? a : b;
}

INLINE void range_add(struct maker *m, float x, float y)
{
    m->x0 = x < m->x0 ? x : m->x0;
    m->x1 = x > m->x1 ? x : m->x1;
    m->y0 = y < m->y0 ? y : m->y0;
    m->y1 = y > m->y1 ? y : m->y1;
}

INLINE struct font_arc part(const struct font_arc *a, float t0, float t1)
{
    float h = t1 - t0;
    return (struct font_arc){a->x + t0 * (a->cx + t0 * a->bx),
                             a->y + t0 * (a->cy + t0 * a->by),
                             (a->cx + 2 * t0 * a->bx) * h,
                             (a->cy + 2 * t0 * a->by) * h,
                             a->bx * h * h,
                             a->by * h * h};
}

INLINE void put(struct maker *m, const struct font_arc *a)
{
    struct font_edges *e = m->e;
    float x = a->x + a->cx + a->bx, y = a->y + a->cy + a->by;
    if (!room(m))
        return;
    range_add(m, a->x, a->y);
    range_add(m, x, y);
    e->arcs[e->arcs_count++] =
        m->side > 0
            ? *a
            : (struct font_arc){x, y, -(a->cx + 2 * a->bx), -(a->cy + 2 * a->by), a->bx, a->by};
}

/* In so many parts, alike in t. */
static void parts_put(struct maker *m, const struct font_arc *a, int count)
{
    float h = 1 / (float)count;
    for (int k = 0; k < count && m->status == FONT_OK; k++) {
        struct font_arc one = part(a, (float)k * h, k + 1 == count ? 1 : (float)(k + 1) * h);
        put(m, &one);
    }
}

/* The least whole number that is not below; of numbers from 0 on. */
static int up(float number)
{
    int floor = (int)number;
    return floor + (number > (float)floor);
}

/* For discs: x does not turn around in it. An arc goes at most as far as its ends are apart
 * and, where y turns around, a quarter of b further; of parts alike in t none is faster than
 * the arc is at its faster end. */
static void disc_put(struct maker *m, const struct font_arc *a)
{
    float across = fabsf(a->cx + a->bx), down = fabsf(a->cy + a->by) + 0.25f * fabsf(a->by);
    float bend = (fabsf(a->bx) + fabsf(a->by)) * m->per_bend;
    if (larger(across, down) * m->per_span <= 1 && bend <= 1) {
        put(m, a);
        return;
    }
    across = larger(fabsf(a->cx), fabsf(a->cx + 2 * a->bx));
    down = larger(fabsf(a->cy), fabsf(a->cy + 2 * a->by));
    parts_put(m, a, up(larger(larger(across, down) * m->per_span, sqrtf(bend))));
}

/* Neither x nor y turns around in it. */
INLINE void straight_put(struct maker *m, const struct font_arc *a)
{
    /* However a curve is cut, x and y change by at most |c| + 2 |b| over t, and the curve is at
     * most b / 4 away from its chord. */
    float across = fabsf(a->cx) + 2 * fabsf(a->bx), down = fabsf(a->cy) + 2 * fabsf(a->by);
    float far = (across > down ? across : down) * m->per_span;
    float bend = (fabsf(a->bx) + fabsf(a->by)) * m->per_bend;
    if (far <= 1 && bend <= 1)
        put(m, a);
    else
        parts_put(m, a, up(far > sqrtf(bend) ? far : sqrtf(bend)));
}

/* Where a polynomial c + 2 t b is zero, if that is well within 0..1; else 1. */
INLINE float turn_at(float c, float b)
{
    if (!(c * (c + 2 * b) < 0))
        return 1;
    float t = -c / (2 * b);
    return t > TURN_PART && t < 1 - TURN_PART ? t : 1;
}

INLINE void curve_put(struct maker *m, const struct font_arc *a)
{
    float tx = turn_at(a->cx, a->bx), ty = turn_at(a->cy, a->by);
    if (m->discs) {
        if (ty < 1)
            range_add(m, a->x, a->y + ty * (a->cy + ty * a->by));
        struct font_arc one = part(a, 0, tx), two = part(a, tx, 1);
        disc_put(m, tx < 1 ? &one : a);
        if (tx < 1)
            disc_put(m, &two);
        return;
    }
    float first = tx < ty ? tx : ty, second = tx < ty ? ty : tx;
    float from = 0, to[3] = {first, second, 1};
    if (first == 1) {
        straight_put(m, a);
        return;
    }
    for (int k = 0; k < 3; k++)
        if (to[k] > from) {
            struct font_arc one = part(a, from, to[k]);
            straight_put(m, &one);
            from = to[k];
        }
}

INLINE void arc_put(struct maker *m, const struct font_arc *a)
{
    bool line = a->bx == 0 && a->by == 0;
    if (a->cx == 0 && a->bx == 0) {
        range_add(m, a->x, a->y);
        range_add(m, a->x, a->y + a->cy + a->by);
    } else if (line && m->discs) {
        disc_put(m, a);
    } else if (line) {
        straight_put(m, a);
    } else {
        curve_put(m, a);
    }
}

/* ---- affine maps ---- */

/* The square of how far the vector a reaches to the side of a direction. */
static float beside_of(const float a[2], float dx, float dy)
{
    float cross = a[0] * dy - a[1] * dx;
    return cross * cross / (dx * dx + dy * dy + 1e-20f);
}

/* The number of quadratic curves that a cubic is cut into. In t^3 = (3/2 t^2 - 1/2 t) + rest,
 * the rest is at most 0.0481 a, half of it to either side. The part of the rest along the curve
 * does not matter. A pixel is wrong by at most the rest over half of the pixel's ink; of parts
 * shorter than two pixels the error may be larger. */
static int cubic_parts(const float c[2], const float b[2], const float a[2])
{
    float size = fabsf(a[0]) + fabsf(a[1]);
    if (0.0481f * size <= FONT_ARC_TOLERANCE_PX)
        return 1;
    float most = 0, fastest = 0;
    for (int k = 0; k < 3; k++) {
        float t = 0.5f * (float)k;
        float dx = c[0] + t * (2 * b[0] + 3 * t * a[0]),
              dy = c[1] + t * (2 * b[1] + 3 * t * a[1]);
        most = larger(most, beside_of(a, dx, dy));
        fastest = larger(fastest, fabsf(dx) + fabsf(dy));
    }
    /* Where it turns in between there may be more. */
    float off = 0.0481f * larger(sqrtf(most), 0.1f * size);
    for (int n = 1;; n++) {
        float cube = (float)(n * n * n), shorter = 2 * (float)n / (fastest + 1e-6f);
        shorter = shorter < 1 ? 1 : shorter > 4 ? 4 : shorter;
        if (off <= FONT_ARC_TOLERANCE_PX * cube * shorter || n == 64)
            return n;
    }
}

static void affine_build(struct maker *m, const struct font_outline *o, const double *map)
{
    float f[6];
    for (int i = 0; i < 6; i++)
        f[i] = (float)map[i];
    int stride = o->polynomials_stride;
    for (int i = 0; i < o->segments_count && m->status == FONT_OK; i++) {
        const float *p = o->polynomials + i;
        float x = p[0] * f[0] + p[stride] * f[1] + f[2];
        float y = p[0] * f[3] + p[stride] * f[4] + f[5];
        float q[3][2]; /* c, b, a */
        int degree = o->segments[i].degree;
        for (int k = 0; k < 3; k++) {
            float u = p[(2 + 2 * k) * stride], v = p[(3 + 2 * k) * stride];
            q[k][0] = u * f[0] + v * f[1];
            q[k][1] = u * f[3] + v * f[4];
        }
        struct font_arc a = {x, y, q[0][0], q[0][1], q[1][0], q[1][1]};
        int parts = degree == 3 ? cubic_parts(q[0], q[1], q[2]) : 0;
        if (!parts)
            arc_put(m, &a);
        for (int k = 0; k < parts; k++) {
            float h = 1 / (float)parts, t = (float)k * h, c[2], b[2], at[2];
            for (int j = 0; j < 2; j++) {
                float third = q[2][j] * h * h * h;
                at[j] = t * (q[0][j] + t * (q[1][j] + t * q[2][j]));
                c[j] = (q[0][j] + t * (2 * q[1][j] + 3 * t * q[2][j])) * h - 0.5f * third;
                b[j] = (q[1][j] + 3 * t * q[2][j]) * h * h + 1.5f * third;
            }
            arc_put(m, &(struct font_arc){x + at[0], y + at[1], c[0], c[1], b[0], b[1]});
        }
    }
}

/* ---- other maps ---- */

struct warp {
    const struct font_map *map;
    const struct font_segment *segment;
    int orientation;
};

static bool warped(const struct warp *w, double t, struct font_point *out)
{
    double j[4];
    return font_map_point(w->map, font_segment_at(w->segment, t, NULL), out, j) &&
           (j[0] * j[3] - j[1] * j[2]) * w->orientation > 0;
}

/* The part of a segment from t0 to t1 as arcs through its ends and its middle, halved until
 * they pass close by two more points of it. */
static void warped_put(struct maker *m, const struct warp *w, double t0, struct font_point p0,
                       double t1, struct font_point p1, int depth)
{
    struct font_point q[3];
    for (int k = 0; k < 3; k++)
        if (!warped(w, t0 + (k + 1) * 0.25 * (t1 - t0), &q[k])) {
            m->status =
                font_fail(FONT_BAD_ARGUMENT, "the distortion folds a glyph over or sends it "
                                             "beyond the horizon");
            return;
        }
    double bx = 2 * (p0.x + p1.x - 2 * q[1].x), by = 2 * (p0.y + p1.y - 2 * q[1].y);
    double cx = p1.x - p0.x - bx, cy = p1.y - p0.y - by, off = 0;
    for (int k = 0; k < 3; k += 2) {
        double t = 0.25 * (k + 1);
        double x = q[k].x - (p0.x + t * (cx + t * bx)), y = q[k].y - (p0.y + t * (cy + t * by));
        double tx = cx + 2 * t * bx, ty = cy + 2 * t * by, speed = hypot(tx, ty);
        /* An error along the curve matters little, and is larger where the curve turns. */
        off = fmax(off, speed > 1e-6 ? fabs(x * ty - y * tx) / speed : hypot(x, y));
        off = fmax(off, 0.1 * hypot(x, y));
    }
    double wide = fmax(fabs(p1.x - p0.x), fabs(p1.y - p0.y));
    if (!(wide < 4e6)) {
        m->status = font_fail(FONT_TOO_LARGE, "a distorted glyph is too large");
    } else if ((depth < 1 || off > (double)FONT_ARC_TOLERANCE_PX || wide > 1000) &&
               depth < 16) {
        double half = 0.5 * (t0 + t1);
        warped_put(m, w, t0, p0, half, q[1], depth + 1);
        if (m->status == FONT_OK)
            warped_put(m, w, half, q[1], t1, p1, depth + 1);
    } else {
        arc_put(m, &(struct font_arc){(float)p0.x, (float)p0.y, (float)cx, (float)cy, (float)bx,
                                      (float)by});
    }
}

static void warped_build(struct maker *m, const struct font_outline *o, struct warp *w)
{
    for (int i = 0; i < o->segments_count && m->status == FONT_OK; i++) {
        struct font_point p0, p1;
        w->segment = &o->segments[i];
        if (warped(w, 0, &p0) && warped(w, 1, &p1))
            warped_put(m, w, 0, p0, 1, p1, 0);
        else
            m->status = font_fail(FONT_BAD_ARGUMENT, "the distortion folds a glyph over or "
                                                     "sends it beyond the horizon");
    }
}

enum font_status font_arcs_build(struct font_edges *e, const struct font_outline *outline,
                                 const struct font_map *map, const struct font_filter *filter,
                                 int orientation, float side)
{
    struct maker m = {.e = e,
                      .side = side,
                      .per_span = 1 / filter->arc_span_px,
                      .per_bend = 1 / (4 * filter->arc_bend_px),
                      .discs = filter->way == FONT_BY_DISCS,
                      .x0 = INFINITY,
                      .y0 = INFINITY,
                      .x1 = -INFINITY,
                      .y1 = -INFINITY,
                      .status = FONT_OK};
    if (map->kind == FONT_AFFINE)
        affine_build(&m, outline, map->m);
    else
        warped_build(&m, outline, &(struct warp){.map = map, .orientation = orientation});
    e->x0 = m.x0;
    e->y0 = m.y0;
    e->x1 = m.x1;
    e->y1 = m.y1;
    return m.status;
}
