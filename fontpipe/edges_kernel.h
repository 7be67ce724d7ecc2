/* edges_kernel.h - outlines to nodes through an affine map, included by edges_plain.c, edges_avx2.c and edges_avx512.c with
 *     LANES    floats in a vector
 *     KERNEL   the function's name
 *
 * Segments are polynomials, x0 + t (c + t (b + t a)), kept as eight arrays; LANES of them are mapped and measured at
 * once: how long, how far across, how flat. Then each takes as many of Gauss's nodes as its row of the filter's table of
 * errors says, eight evaluated together. */
#include "edges_internal.h"
#include "outline.h"

#include <string.h>

typedef float vector __attribute__((vector_size(LANES * 4)));
typedef float vector_loose __attribute__((vector_size(LANES * 4), aligned(4), may_alias));
typedef int ints __attribute__((vector_size(LANES * 4)));

#define INLINE static inline __attribute__((always_inline))

INLINE vector load(const float *at)
{
    return *(const vector_loose *)at;
}

INLINE vector absolute(vector v)
{
    return (vector)((ints)v & 0x7fffffff);
}

INLINE vector larger(vector a, vector b)
{
    ints mask = a > b;
    return (vector)(((ints)a & mask) | ((ints)b & ~mask));
}

INLINE vector root(vector v)
{
    vector out;
    for (int k = 0; k < LANES; k++)
        out[k] = sqrtf(v[k]);
    return out;
}

struct measured {
    float x[LANES], y[LANES], cx[LANES], cy[LANES], bx[LANES], by[LANES], ax[LANES], ay[LANES];
    float across[LANES], down[LANES], length[LANES], flat[LANES], bend[LANES];
    int row[LANES];   /* of the table of errors */
    int slant[LANES]; /* where it is flattest */
};

INLINE void put(float *to, vector v)
{
    *(vector_loose *)to = v;
}

INLINE void measure(struct measured *out, const struct font_edges_job *job, int first)
{
    const float *p = job->outline->polynomials + first, *m = job->m;
    int stride = job->outline->polynomials_stride;
    vector x = load(p), y = load(p + stride);
    vector cx = load(p + 2 * stride), cy = load(p + 3 * stride);
    vector bx = load(p + 4 * stride), by = load(p + 5 * stride);
    vector ax = load(p + 6 * stride), ay = load(p + 7 * stride);
    put(out->x, x * m[0] + y * m[1] + m[2]);
    put(out->y, x * m[3] + y * m[4] + m[5]);
    vector Cx = cx * m[0] + cy * m[1], Cy = cx * m[3] + cy * m[4];
    vector Bx = bx * m[0] + by * m[1], By = bx * m[3] + by * m[4];
    vector Ax = ax * m[0] + ay * m[1], Ay = ax * m[3] + ay * m[4];
    put(out->cx, Cx);
    put(out->cy, Cy);
    put(out->bx, Bx);
    put(out->by, By);
    put(out->ax, Ax);
    put(out->ay, Ay);
    /* How fast it is at its beginning, between, and at its end: all the same for a line. Nodes lie as far apart as
     * where it is fastest, and must suffice for where it is flattest. */
    vector sx = Cx + Bx, sy = Cy + By, ex = sx + Bx + Ax * 3, ey = sy + By + Ay * 3;
    vector square = larger(larger(Cx * Cx + Cy * Cy, sx * sx + sy * sy), ex * ex + ey * ey);
    vector length = root(square);
    vector dx0 = absolute(Cx), dx1 = absolute(sx), dx2 = absolute(ex);
    vector dy0 = absolute(Cy), dy1 = absolute(sy), dy2 = absolute(ey);
    vector across = (dx0 + dx1 + dx2) * (1 / 3.0f), down = (dy0 + dy1 + dy2) * (1 / 3.0f);
    vector tiny = across * 0 + 1e-9f;
    vector flat = down / (across + tiny), f0 = dy0 / (dx0 + tiny), f1 = dy1 / (dx1 + tiny);
    vector f2 = dy2 / (dx2 + tiny);
    vector flattest = -larger(larger(-f0, -f1), -f2);
    /* Short quadratics bend little. */
    ints bends = ((Ax * Ax + Ay * Ay) > across * 0) | (length > 3.0f);
    flat = (vector)(((ints)flattest & bends) | ((ints)flat & ~bends));
    vector quarters = length * 4, power = quarters * quarters * quarters * quarters;
    ints l = ((ints)power >> 23) - 126, above = l > 0;
    l &= above;
    above = l < FONT_LENGTHS - 1;
    l = (l & above) | ((FONT_LENGTHS - 1) & ~above);
    ints s = -((flat > 0.2f) + (flat > 0.5f) + (flat > 1.0f) + (flat > 2.0f) + (flat > 5.0f));
    *(ints *)out->slant = -((flattest > 0.2f) + (flattest > 0.5f) + (flattest > 1.0f) +
                            (flattest > 2.0f) + (flattest > 5.0f));
    put(out->across, across);
    put(out->down, down);
    put(out->length, length);
    put(out->flat, flat);
    put(out->bend, Bx * Bx + By * By);
    *(ints *)out->row = (s * FONT_LENGTHS + l) * FONT_NODES_MAX;
}

enum font_status KERNEL(const struct font_edges_job *job)
{
    struct font_edges *e = job->edges;
    const struct font_filter *f = job->filter;
    const struct font_segment *segments = job->outline->segments;
    const float *errors = &f->node_error[0][0][0];
    struct measured q __attribute__((aligned(64)));
    eight none = (eight){0} + INFINITY;
    struct font_range range = {none, -none, none, -none};
    for (int first = 0; first < job->outline->segments_count; first += LANES) {
        int count = job->outline->segments_count - first;
        measure(&q, job, first);
        enum font_status status = font_nodes_reserve(e, LANES * FONT_NODES_MAX);
        if (status == FONT_OK)
            status = font_lines_reserve(e, LANES);
        if (status != FONT_OK)
            return status;
        for (int k = 0; k < LANES && k < count; k++) {
            float across = q.across[k], length = q.length[k];
            int degree = segments[first + k].degree, pieces = 1;
            if (across == 0)
                continue;
            if (degree == 1 && q.down[k] <= FONT_FLAT_PX) {
                int i = e->lines_count++;
                float x = q.x[k], end = x + q.cx[k];
                e->line_x0[i] = job->side > 0 ? x : end;
                e->line_x1[i] = job->side > 0 ? end : x;
                float y = e->line_y[i] = q.y[k] + 0.5f * q.cy[k];
                eight xs = {x, end, x, x, x, x, x, x}, ys = (eight){0} + y;
                font_range_add(&range, &xs, &ys);
                continue;
            }
            struct font_cubic c = {q.x[k], q.cx[k], q.bx[k], q.ax[k],
                                   q.y[k], q.cy[k], q.by[k], q.ay[k]};
            /* One node's weight must be all of the dx: a cubic's speed at its middle is not. */
            bool mote = length < FONT_MOTE_PX;
            if (mote)
                c = (struct font_cubic){
                    .x = c.x, .cx = c.cx + c.bx + c.ax, .y = c.y, .cy = c.cy + c.by + c.ay};
            const float *error = errors + q.row[k];
            eight_ints large =
                *(const eight_loose *)error * across > (eight){0} + f->piece_tolerance;
            int m = 1;
            for (int i = 0; i < 8; i++)
                m -= large[i];
            if (m > FONT_NODES_MAX || length > FONT_LENGTH_LAST)
                m = font_nodes_needed(f, length, across, q.flat[k] * across, &pieces);
            /* So many nodes that the area under the curve is exact, one more where a quadratic turns around; specks
             * can do with less. */
            int least = degree == 1              ? 1
                        : mote                   ? 1
                        : degree == 2            ? 2 + (q.bend[k] > FONT_BEND_PX2)
                        : length < FONT_SPECK_PX ? 2
                                                 : 3;
            m = m < least ? least : m;
            float spacing = f->spacing_px[q.slant[k]];
            if (length > FONT_EVEN_LEAST * spacing && length < (float)(m * pieces) * spacing) {
                int even = (int)(length / spacing) + 1;
                status = font_nodes_reserve(e, even + LANES * FONT_NODES_MAX);
                if (status != FONT_OK)
                    return status;
                font_nodes_even(e, &c, even, job->side, &range);
                continue;
            }
            if (pieces > 1) {
                status = font_nodes_reserve(e, m * pieces + LANES * FONT_NODES_MAX);
                if (status != FONT_OK)
                    return status;
            }
            font_nodes_put(e, &c, m, pieces, job->side, &range);
        }
    }
    e->x0 = e->y0 = INFINITY;
    e->x1 = e->y1 = -INFINITY;
    for (int k = 0; k < 8; k++) {
        e->x0 = range.x0[k] < e->x0 ? range.x0[k] : e->x0;
        e->x1 = range.x1[k] > e->x1 ? range.x1[k] : e->x1;
        e->y0 = range.y0[k] < e->y0 ? range.y0[k] : e->y0;
        e->y1 = range.y1[k] > e->y1 ? range.y1[k] : e->y1;
    }
    return FONT_OK;
}
