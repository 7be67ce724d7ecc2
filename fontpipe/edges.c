/* edges.c - takes outlines apart: see edges.h and docs/fonts.md.
 *
 * A pixel is the integral over the ink of f(X - x, Y - y). By Green's theorem that is an integral along the outline of
 * F(X - x, Y - y) dx, where F is f's integral over y: each bit of edge counts by the dx it covers, ink below it
 * positive. So an edge is, in order of cost:
 *
 *     vertical     nothing: dx is 0
 *     horizontal   its two ends: along x too the filter's integral is in the table
 *     slanted      Gauss's nodes for dx: points on the edge with weights
 *     curved       the same: the curve itself is never made of lines */
#include "edges.h"
#include "filter_internal.h"
#include "internal.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A line whose ends differ less in y is horizontal: it is then wrong by less than a tenth of a 255th. */
static const double flat_px = 4e-4;
static const float lengths_last = 6.727f; /* the longest that was measured */

enum { PAD = 16 };

void font_edges_finish(struct font_edges *e)
{
    free(e->memory);
    free(e->line_x0);
    *e = (struct font_edges){.x0 = 1, .x1 = -1, .y0 = 1, .y1 = -1};
}

/* Three arrays in one block, each `capacity` long and a little. */
static bool three_grow(float **a, float **b, float **c, int count, int *capacity, int wanted)
{
    int grown = *capacity ? *capacity : 64;
    while (grown < wanted)
        grown = grown > FONT_EDGES_MAX ? wanted : 2 * grown;
    size_t stride = (size_t)grown + PAD;
    float *block = aligned_alloc(64, (3 * stride * sizeof(float) + 63) / 64 * 64);
    if (!block)
        return false;
    if (count) {
        memcpy(block, *a, (size_t)count * sizeof(float));
        memcpy(block + stride, *b, (size_t)count * sizeof(float));
        memcpy(block + 2 * stride, *c, (size_t)count * sizeof(float));
    }
    free(*a);
    *a = block;
    *b = block + stride;
    *c = block + 2 * stride;
    *capacity = grown;
    return true;
}

static enum font_status nodes_reserve(struct font_edges *e, int more)
{
    if (e->nodes_count + more <= e->nodes_capacity)
        return FONT_OK;
    if (e->nodes_count + more > FONT_EDGES_MAX)
        return font_fail(FONT_TOO_LARGE, "an outline has too many edges at this size");
    bool grown = three_grow(&e->node_x, &e->node_y, &e->node_weight, e->nodes_count,
                            &e->nodes_capacity, e->nodes_count + more);
    e->memory = e->node_x;
    return grown ? FONT_OK : font_fail(FONT_NO_MEMORY, "no memory for edges");
}

static enum font_status lines_reserve(struct font_edges *e, int more)
{
    if (e->lines_count + more <= e->lines_capacity)
        return FONT_OK;
    if (e->lines_count + more > FONT_EDGES_MAX)
        return font_fail(FONT_TOO_LARGE, "an outline has too many edges at this size");
    return three_grow(&e->line_x0, &e->line_x1, &e->line_y, e->lines_count, &e->lines_capacity,
                      e->lines_count + more)
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for edges");
}

static void node_put(struct font_edges *e, double x, double y, double weight)
{
    int i = e->nodes_count++;
    e->node_x[i] = (float)x;
    e->node_y[i] = (float)y;
    e->node_weight[i] = (float)weight;
}

static void line_put(struct font_edges *e, double x0, double x1, double y)
{
    int i = e->lines_count++;
    e->line_x0[i] = (float)x0;
    e->line_x1[i] = (float)x1;
    e->line_y[i] = (float)y;
}

enum font_status font_edges_line_add(struct font_edges *e, double x0, double x1, double y)
{
    enum font_status status = lines_reserve(e, 1);
    if (status != FONT_OK)
        return status;
    bool first = e->x0 > e->x1 || (e->nodes_count == 0 && e->lines_count == 0);
    line_put(e, x0, x1, y);
    float left = (float)fmin(x0, x1), right = (float)fmax(x0, x1), at = (float)y;
    e->x0 = first ? left : fminf(e->x0, left);
    e->x1 = first ? right : fmaxf(e->x1, right);
    e->y0 = first ? at : fminf(e->y0, at);
    e->y1 = first ? at : fmaxf(e->y1, at);
    return FONT_OK;
}

/* How many nodes an edge needs and, where the most are not enough, on how many pieces of it. across, down: all the way it
 * goes along x and y, at its flattest. */
static inline int nodes_needed(const struct font_filter *f, float length, float across,
                               float down, int *pieces)
{
    int s = (down > 0.2f * across) + (down > 0.5f * across) + (down > across) +
            (down > 2 * across) + (down > 5 * across);
    int n = length > lengths_last ? (int)ceilf(length / lengths_last) : 1;
    for (;; n += 1 + n / 4) {
        /* The bin of length / n, a quarter of a pixel times the fourth root of 2 each, from the number's exponent. */
        float quarter = 4 * length / (float)n, power = quarter * quarter * quarter * quarter;
        union {
            float number;
            uint32_t bits;
        } u = {.number = power};
        int l = (int)(u.bits >> 23) - 126;
        l = l < 0 ? 0 : l > FONT_LENGTHS - 1 ? FONT_LENGTHS - 1 : l;
        const float *error = f->node_error[s][l] + 1;
        /* The pieces' errors add up where they lie above each other, but not all with one sign. */
        float allowed = (float)FONT_PIECE_TOLERANCE * (n > 1 ? sqrtf((float)n) : 1);
        int m = 1;
        for (int k = 0; k < FONT_NODES_MAX;
             k++) /* errors fall: as many as are too large, and one */
            m += error[k] * across > allowed;
        if (m <= FONT_NODES_MAX ||
            (float)n > 8 * length) { /* or an eighth of a pixel: as fine as it gets */
            *pieces = n;
            return m <= FONT_NODES_MAX ? m : FONT_NODES_MAX;
        }
    }
}

/* ---- nodes, eight at a time ---- */

typedef float eight __attribute__((vector_size(32)));
typedef float eight_loose __attribute__((vector_size(32), aligned(4), may_alias));

static float gauss_at[FONT_NODES_MAX + 1][8] __attribute__((aligned(32)));
static float gauss_weight[FONT_NODES_MAX + 1][8] __attribute__((aligned(32)));

__attribute__((constructor)) static void gauss_begin(void)
{
    for (int m = 1; m <= FONT_NODES_MAX; m++)
        for (int k = 0; k < m; k++) {
            gauss_at[m][k] = (float)font_gauss_at[m][k];
            gauss_weight[m][k] = (float)font_gauss_weight[m][k];
        }
}

/* A curve as polynomials in t: x = x0 + t (c + t (b + t a)). */
struct cubic {
    float x, cx, bx, ax, y, cy, by, ay;
};

/* m nodes on each of the pieces. There is room for eight more than are kept. */
static inline void nodes_put(struct font_edges *e, const struct cubic *c, int m, int pieces,
                             float side)
{
    float part = 1 / (float)pieces;
    eight at = *(const eight *)gauss_at[m] * part;
    eight weight = *(const eight *)gauss_weight[m] * (part * side);
    int count = e->nodes_count;
    for (int k = 0; k < pieces; k++, count += m) {
        eight t = at + (float)k * part;
        *(eight_loose *)(e->node_x + count) = c->x + t * (c->cx + t * (c->bx + t * c->ax));
        *(eight_loose *)(e->node_y + count) = c->y + t * (c->cy + t * (c->by + t * c->ay));
        *(eight_loose *)(e->node_weight + count) =
            weight * (c->cx + t * (2 * c->bx + t * (3 * c->ax)));
    }
    e->nodes_count = count;
}

/* ---- affine maps ---- */

/* side: +1 or -1, which makes ink below an edge positive. */
static enum font_status line_build(struct font_edges *e, const struct font_filter *f,
                                   struct font_point a, struct font_point b, double side)
{
    double dx = b.x - a.x, dy = b.y - a.y;
    enum font_status status;
    if (dx == 0)
        return FONT_OK;
    if (fabs(dy) <= flat_px) {
        status = lines_reserve(e, 1);
        if (status == FONT_OK)
            line_put(e, side > 0 ? a.x : b.x, side > 0 ? b.x : a.x, 0.5 * (a.y + b.y));
        return status;
    }
    if (!f->use_nodes) {
        double steps = ceil(fmax(fabs(dx), fabs(dy)) / f->step_px);
        if (fabs(dx) < 1e-3 && fabs(dx) * fabs(dy) < 1e-3)
            steps = ceil(fabs(dy) / 0.5); /* all but vertical: it weighs nothing */
        status = lines_reserve(e, (int)fmin(steps, FONT_EDGES_MAX));
        if (status != FONT_OK)
            return status;
        int n = (int)steps;
        for (int k = 0; k < n; k++) {
            double x0 = a.x + dx * k / n, x1 = a.x + dx * (k + 1) / n;
            line_put(e, side > 0 ? x0 : x1, side > 0 ? x1 : x0, a.y + dy * (k + 0.5) / n);
        }
        return FONT_OK;
    }
    float across = fabsf((float)dx), down = fabsf((float)dy);
    int pieces,
        m = nodes_needed(f, sqrtf(across * across + down * down), across, down, &pieces);
    status = nodes_reserve(e, m * pieces);
    if (status != FONT_OK)
        return status;
    struct cubic c = {(float)a.x, (float)dx, 0, 0, (float)a.y, (float)dy, 0, 0};
    nodes_put(e, &c, m, pieces, (float)side);
    return FONT_OK;
}

static enum font_status curve_build(struct font_edges *e, const struct font_filter *f,
                                    const struct font_segment *s, double side)
{
    const struct font_point *p = s->p;
    /* Nodes are even in t: they lie apart as far as where the curve is fastest. They must suffice for where it is
     * flattest. */
    float fastest = 0, across = 0, down = 0, flattest = 1e9f;
    for (int k = 0; k < s->degree; k++) {
        float dx = fabsf((float)(p[k + 1].x - p[k].x)),
              dy = fabsf((float)(p[k + 1].y - p[k].y));
        float square = dx * dx + dy * dy, slant = dy / (dx + 1e-9f);
        fastest = square > fastest ? square : fastest;
        flattest = slant < flattest ? slant : flattest;
        across += dx;
        down += dy;
    }
    if (across == 0)
        return FONT_OK;
    enum font_status status;
    if (!f->use_nodes) {
        double steps = ceil(fmax(across, down) / f->step_px);
        status = lines_reserve(e, (int)fmin(steps, FONT_EDGES_MAX));
        if (status != FONT_OK)
            return status;
        int n = (int)steps;
        double before = p[0].x;
        for (int k = 1; k <= n; k++) {
            double x = k == n ? p[s->degree].x : font_segment_at(s, (double)k / n, NULL).x;
            double y = font_segment_at(s, (k - 0.5) / n, NULL).y;
            line_put(e, side > 0 ? before : x, side > 0 ? x : before, y);
            before = x;
        }
        return FONT_OK;
    }
    float length = (float)s->degree * sqrtf(fastest);
    if (s->degree == 2)
        flattest = down / across; /* they bend little */
    int pieces, m = nodes_needed(f, length, across, flattest * across, &pieces);
    /* So many nodes that the area under the curve is exact; specks can do with less. */
    int least = length > 0.4f ? s->degree : length > 0.02f ? 2 : 1;
    m = m < least ? least : m;
    status = nodes_reserve(e, m * pieces);
    if (status != FONT_OK)
        return status;
    struct cubic c = {.x = (float)p[0].x, .y = (float)p[0].y};
    if (s->degree == 2) {
        c.bx = (float)(p[0].x - 2 * p[1].x + p[2].x);
        c.by = (float)(p[0].y - 2 * p[1].y + p[2].y);
        c.cx = (float)(2 * (p[1].x - p[0].x));
        c.cy = (float)(2 * (p[1].y - p[0].y));
    } else {
        c.ax = (float)(p[3].x - p[0].x + 3 * (p[1].x - p[2].x));
        c.ay = (float)(p[3].y - p[0].y + 3 * (p[1].y - p[2].y));
        c.bx = (float)(3 * (p[0].x - 2 * p[1].x + p[2].x));
        c.by = (float)(3 * (p[0].y - 2 * p[1].y + p[2].y));
        c.cx = (float)(3 * (p[1].x - p[0].x));
        c.cy = (float)(3 * (p[1].y - p[0].y));
    }
    nodes_put(e, &c, m, pieces, (float)side);
    return FONT_OK;
}

/* ---- other maps ---- */

static enum font_status outside(void)
{
    return font_fail(FONT_BAD_ARGUMENT,
                     "the distortion folds a glyph over or sends it beyond the horizon");
}

struct mapped {
    struct font_point at;
    double dx, dy; /* per t */
};

static bool mapped_at(const struct font_map *map, const struct font_segment *s, double t,
                      int orientation, struct mapped *out)
{
    struct font_point speed, from = font_segment_at(s, t, &speed);
    double j[4];
    if (!font_map_point(map, from, &out->at, j) ||
        !((j[0] * j[3] - j[1] * j[2]) * orientation > 0))
        return false;
    out->dx = j[0] * speed.x + j[1] * speed.y;
    out->dy = j[2] * speed.x + j[3] * speed.y;
    return true;
}

static enum font_status mapped_build(struct font_edges *e, const struct font_filter *f,
                                     const struct font_segment *s, const struct font_map *map,
                                     int orientation, double side)
{
    enum { SAMPLES = 8 };
    double across = 0, down = 0, longest = 0;
    struct mapped before, here;
    if (!mapped_at(map, s, 0, orientation, &before))
        return outside();
    for (int k = 1; k <= SAMPLES; k++) {
        if (!mapped_at(map, s, (double)k / SAMPLES, orientation, &here))
            return outside();
        double d = hypot(here.at.x - before.at.x, here.at.y - before.at.y);
        longest = fmax(longest, d);
        across += fabs(here.at.x - before.at.x);
        down += fabs(here.at.y - before.at.y);
        before = here;
    }
    /* Where the map stretches, pieces are as short as the most stretched needs. */
    double all = longest * SAMPLES;
    if (!(all < 4e6))
        return font_fail(FONT_TOO_LARGE, "a distorted glyph is too large");
    enum font_status status;
    if (!f->use_nodes) {
        int n = (int)ceil(1.1 * all / f->step_px) + 1;
        status = lines_reserve(e, n);
        if (status != FONT_OK || !mapped_at(map, s, 0, orientation, &before))
            return status != FONT_OK ? status : outside();
        for (int k = 1; k <= n; k++) {
            struct mapped middle;
            if (!mapped_at(map, s, (double)k / n, orientation, &here) ||
                !mapped_at(map, s, (k - 0.5) / n, orientation, &middle))
                return outside();
            line_put(e, side > 0 ? before.at.x : here.at.x, side > 0 ? here.at.x : before.at.x,
                     middle.at.y);
            before = here;
        }
        return FONT_OK;
    }
    int halves = (int)ceil(all / 2) + (s->degree > 1), pieces;
    int m = nodes_needed(f, (float)(1.1 * all / halves),
                         (float)(fmin(1.1 * all, 1.5 * across + 1e-3) / halves),
                         (float)(down / halves), &pieces) +
            1;
    pieces *= halves;
    double part = 1.0 / pieces;
    if (m < s->degree)
        m = s->degree;
    if (m > FONT_NODES_MAX)
        m = FONT_NODES_MAX;
    status = nodes_reserve(e, m * pieces);
    for (int k = 0; k < pieces && status == FONT_OK; k++)
        for (int i = 0; i < m; i++) {
            if (!mapped_at(map, s, (k + font_gauss_at[m][i]) * part, orientation, &here))
                return outside();
            node_put(e, here.at.x, here.at.y, side * here.dx * part * font_gauss_weight[m][i]);
        }
    return status;
}

/* ---- all of an outline ---- */

typedef int eight_ints __attribute__((vector_size(32)));

/* a where the mask is set, b elsewhere. */
#define chosen(a, b, mask) ((eight)(((eight_ints)(a) & (mask)) | ((eight_ints)(b) & ~(mask))))

/* The least and the most of an array that has room for eight more. */
static void range_find(float *at, int count, float *least, float *most)
{
    if (!count)
        return;
    for (int k = count; k < count + 8; k++)
        at[k] = at[0];
    eight low = *(const eight_loose *)at, high = low;
    for (int k = 8; k < count; k += 8) {
        eight here = *(const eight_loose *)(at + k);
        low = chosen(here, low, here < low);
        high = chosen(here, high, here > high);
    }
    for (int k = 0; k < 8; k++) {
        *least = low[k] < *least ? low[k] : *least;
        *most = high[k] > *most ? high[k] : *most;
    }
}

static void bounds_find(struct font_edges *e)
{
    bool none = e->nodes_count + e->lines_count == 0;
    e->x0 = e->y0 = none ? 1 : INFINITY;
    e->x1 = e->y1 = none ? -1 : -INFINITY;
    range_find(e->node_x, e->nodes_count, &e->x0, &e->x1);
    range_find(e->node_y, e->nodes_count, &e->y0, &e->y1);
    range_find(e->line_x0, e->lines_count, &e->x0, &e->x1);
    range_find(e->line_x1, e->lines_count, &e->x0, &e->x1);
    range_find(e->line_y, e->lines_count, &e->y0, &e->y1);
}

/* Which way the map turns things, from its middle. */
static int map_orientation(const struct font_map *map, const struct font_outline *outline)
{
    struct font_box box = outline->box;
    struct font_point middle = {(box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2}, to;
    double j[4] = {0};
    if (!font_map_point(map, middle, &to, j))
        return 0;
    double det = j[0] * j[3] - j[1] * j[2];
    return det > 0 ? 1 : det < 0 ? -1 : 0;
}

/* The most an affine map makes of the outline, to refuse what is too large before it is taken apart. */
static bool fits(const struct font_map *map, const struct font_outline *outline)
{
    struct font_box box = outline->box;
    for (int i = 0; i < 4; i++) {
        struct font_point p = {i & 1 ? box.x1 : box.x0, i & 2 ? box.y1 : box.y0}, to;
        double j[4];
        if (!font_map_point(map, p, &to, j) ||
            !(fabs(to.x) <= FONT_SIDE_MAX && fabs(to.y) <= FONT_SIDE_MAX))
            return false;
    }
    return true;
}

enum font_status font_edges_build(struct font_edges *e, const struct font_outline *outline,
                                  const struct font_map *map, const struct font_filter *filter)
{
    e->nodes_count = e->lines_count = 0;
    e->x0 = e->y0 = 1;
    e->x1 = e->y1 = -1;
    if (!outline->prepared)
        return font_fail(FONT_BAD_ARGUMENT, "an outline is prepared before it is drawn");
    for (int i = 0; i < 9; i++)
        if (!isfinite(map->m[i]))
            return font_fail(FONT_BAD_ARGUMENT, "a size or a map cannot hold %g", map->m[i]);
    const double *m = map->m;
    e->advance_px =
        map->kind == FONT_AFFINE ? outline->advance * hypot(m[0], m[3]) : outline->advance;
    if (!outline->segments_count)
        return FONT_OK;
    int orientation = map_orientation(map, outline);
    if (orientation == 0) {
        if (map->kind == FONT_AFFINE)
            return FONT_OK; /* squashed flat: no ink */
        return outside();
    }
    if (map->kind == FONT_AFFINE && !fits(map, outline))
        return font_fail(FONT_TOO_LARGE,
                         "a glyph would reach more than %d pixels from its origin",
                         FONT_SIDE_MAX);
    double side = outline->turn * -orientation;
    enum font_status status = FONT_OK;
    for (int i = 0; i < outline->segments_count && status == FONT_OK; i++) {
        const struct font_segment *from = &outline->segments[i];
        if (map->kind != FONT_AFFINE) {
            status = mapped_build(e, filter, from, map, orientation, side);
            continue;
        }
        struct font_segment to = {.degree = from->degree};
        for (int k = 0; k <= from->degree; k++)
            to.p[k] = (struct font_point){m[0] * from->p[k].x + m[1] * from->p[k].y + m[2],
                                          m[3] * from->p[k].x + m[4] * from->p[k].y + m[5]};
        status = to.degree == 1 ? line_build(e, filter, to.p[0], to.p[1], side)
                                : curve_build(e, filter, &to, side);
    }
    if (status == FONT_OK) {
        bounds_find(e);
        if (e->x0 <= e->x1 && !(e->x0 >= -FONT_SIDE_MAX && e->x1 <= FONT_SIDE_MAX &&
                                e->y0 >= -FONT_SIDE_MAX && e->y1 <= FONT_SIDE_MAX))
            status = font_fail(FONT_TOO_LARGE,
                               "a glyph would reach more than %d pixels from its origin",
                               FONT_SIDE_MAX);
    }
    if (status != FONT_OK) {
        e->nodes_count = e->lines_count = 0;
        e->x0 = e->y0 = 1;
        e->x1 = e->y1 = -1;
    }
    return status;
}
