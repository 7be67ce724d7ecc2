/* edges.c - takes outlines apart: see edges.h and docs/fonts.md.
 *
 * A pixel is the integral over the ink of f(X - x, Y - y). By Green's theorem that is an
 * integral along the outline of F(X - x, Y - y) dx, where F is f's integral over y: each bit of
 * edge counts by the dx it covers, ink below it positive. So an edge is, in order of cost:
 *
 *     vertical     nothing: dx is 0
 *     horizontal   its two ends: along x too the filter's integral is in the table
 *     slanted      Gauss's nodes for dx: points on the edge with weights
 *     curved       the same: the curve itself is never made of lines */
#include "edges_internal.h"
#include "internal.h"
#define LANES 4
#include "lanes.h"

#include <stdlib.h>
#include <string.h>

void font_edges_finish(struct font_edges *e)
{
    free(e->memory);
    free(e->line_x0);
    free(e->arcs);
    *e = (struct font_edges){.x0 = 1, .x1 = -1, .y0 = 1, .y1 = -1};
}

static void node_put(struct font_edges *e, double x, double y, double weight)
{
    int i = e->nodes_count++;
    e->node_x[i] = (float)x;
    e->node_y[i] = (float)y;
    e->node_weight[i] = (float)weight;
}

float font_rule_places[FONT_RULES * 8], font_rule_weights[FONT_RULES * 8];
float font_even_ends[18];

__attribute__((constructor)) static void rules_begin(void)
{
    for (int k = 0; k < 8; k++) {
        font_rule_places[k] = (float)k + 0.5f;
        font_rule_weights[k] = k < 3 ? font_even_weight[k] : 1;
        font_rule_weights[FONT_RULE_EVEN_LATER * 8 + k] = 1;
    }
    for (int m = 1; m <= FONT_NODES_MAX; m++)
        for (int k = 0; k < m; k++) {
            font_rule_places[m * 8 + k] = (float)font_gauss_at[m][k];
            font_rule_weights[m * 8 + k] = (float)font_gauss_weight[m][k];
        }
    for (int k = 0; k < 18; k++)
        font_even_ends[k] = k >= 8 && k < 11 ? font_even_weight[10 - k] : 1;
}

int font_nodes_needed(const struct font_filter *f, float length, float across, int slant,
                      int *pieces)
{
    int n = length > FONT_LENGTH_LAST ? (int)ceilf(length / FONT_LENGTH_LAST) : 1;
    for (;; n += 1 + n / 4) {
        /* The bin of length / n, a quarter of a pixel times the fourth root of 2 each, from the
         * number's exponent. */
        float quarter = 4 * length / (float)n, power = quarter * quarter * quarter * quarter;
        union {
            float number;
            uint32_t bits;
        } u = {.number = power};
        int l = (int)(u.bits >> 23) - 126;
        l = l < 0 ? 0 : l > FONT_LENGTHS - 1 ? FONT_LENGTHS - 1 : l;
        const float *error = f->node_error[slant][l];
        /* The pieces' errors add up where they lie above each other, but not all with one
         * sign. */
        float allowed = f->piece_tolerance * (n > 1 ? sqrtf((float)n) : 1);
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

/* ---- affine maps ---- */

/* For filters that are not smooth: an outline's segment, mapped, in steps that are exact along
 * x. side: +1 or -1, which makes ink below an edge positive. */
static enum font_status steps_build(struct font_edges *e, const struct font_filter *f,
                                    const struct font_segment *s, double side)
{
    const struct font_point *p = s->p;
    double across = 0, down = 0;
    for (int k = 0; k < s->degree; k++) {
        across += fabs(p[k + 1].x - p[k].x);
        down += fabs(p[k + 1].y - p[k].y);
    }
    if (across == 0)
        return FONT_OK;
    double steps = ceil(fmax(across, down) / f->step_px);
    if (s->degree == 1 && down <= (double)FONT_FLAT_PX)
        steps = 1;
    else if (across < 1e-3 && across * down < 1e-3)
        steps = ceil(down / 0.5) + 1; /* all but vertical: it weighs nothing */
    enum font_status status = font_lines_reserve(e, (int)fmin(steps, FONT_EDGES_MAX));
    if (status != FONT_OK)
        return status;
    int n = (int)steps;
    double before = p[0].x;
    for (int k = 1; k <= n; k++) {
        double x = k == n ? p[s->degree].x : font_segment_at(s, (double)k / n, NULL).x;
        double y = font_segment_at(s, (k - 0.5) / n, NULL).y;
        font_edges_line(e, side > 0 ? before : x, side > 0 ? x : before, y);
        before = x;
    }
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
                                     int orientation, double side, bool nodes)
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
    if (!nodes) {
        int n = (int)ceil(1.1 * all / f->step_px) + 1;
        status = font_lines_reserve(e, n);
        if (status != FONT_OK || !mapped_at(map, s, 0, orientation, &before))
            return status != FONT_OK ? status : outside();
        for (int k = 1; k <= n; k++) {
            struct mapped middle;
            if (!mapped_at(map, s, (double)k / n, orientation, &here) ||
                !mapped_at(map, s, (k - 0.5) / n, orientation, &middle))
                return outside();
            font_edges_line(e, side > 0 ? before.at.x : here.at.x,
                            side > 0 ? here.at.x : before.at.x, middle.at.y);
            before = here;
        }
        return FONT_OK;
    }
    int halves = (int)ceil(all / 2) + (s->degree > 1), pieces;
    double flat_across = fmin(1.1 * all, 1.5 * across + 1e-3);
    int m = font_nodes_needed(f, (float)(1.1 * all / halves), (float)(flat_across / halves),
                              font_slant(flat_across, down), &pieces) +
            1;
    pieces *= halves;
    double part = 1.0 / pieces;
    if (m < s->degree)
        m = s->degree;
    if (m > FONT_NODES_MAX)
        m = FONT_NODES_MAX;
    status = font_nodes_reserve(e, m * pieces);
    for (int k = 0; k < pieces && status == FONT_OK; k++)
        for (int i = 0; i < m; i++) {
            if (!mapped_at(map, s, (k + font_gauss_at[m][i]) * part, orientation, &here))
                return outside();
            node_put(e, here.at.x, here.at.y, side * here.dx * part * font_gauss_weight[m][i]);
        }
    return status;
}

/* ---- all of an outline ---- */

/* The least and the most of an array that has room for LANES more. */
static void range_find(float *at, int count, float *least, float *most)
{
    if (!count)
        return;
    for (int k = count; k < count + LANES; k++)
        at[k] = at[0];
    vector low = load(at), high = low;
    for (int k = LANES; k < count; k += LANES) {
        low = vector_min(low, load(at + k));
        high = vector_max(high, load(at + k));
    }
    for (int k = 0; k < LANES; k++) {
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

/* The most an affine map makes of the outline, to refuse what is too large before it is taken
 * apart. */
static bool fits(const double *m, const struct font_box *box)
{
    double x = fmax(fabs(box->x0), fabs(box->x1)), y = fmax(fabs(box->y0), fabs(box->y1));
    return fabs(m[0]) * x + fabs(m[1]) * y + fabs(m[2]) <= 2 * FONT_SIDE_MAX &&
           fabs(m[3]) * x + fabs(m[4]) * y + fabs(m[5]) <= 2 * FONT_SIDE_MAX;
}

/* All segments, in the form that the filter is drawn from. */
static enum font_status segments_build(struct font_edges *e, const struct font_outline *outline,
                                       const struct font_map *map, const struct font_filter *f,
                                       bool tabled, int orientation)
{
    const double *m = map->m;
    double side = outline->turn * -orientation;
    enum font_status status = FONT_OK;
    if (outline->tangled) {
        status = font_edges_tangled(e, outline, map, f);
        if (status == FONT_OK)
            bounds_find(e);
        return status;
    }
    bool nodes = f->use_nodes || (f->way == FONT_BY_PATCHES && !tabled);
    if ((f->way == FONT_BY_AREAS || f->way == FONT_BY_DISCS) && !tabled)
        return font_arcs_build(e, outline, map, f, orientation, (float)side);
    if (map->kind == FONT_AFFINE && nodes) {
        struct font_edges_job job = {e, outline, f, {0}, (float)side};
        for (int i = 0; i < 6; i++)
            job.m[i] = (float)m[i];
        return font_edges_kernel(&job);
    }
    for (int i = 0; i < outline->segments_count && status == FONT_OK; i++) {
        const struct font_segment *from = &outline->segments[i];
        if (map->kind != FONT_AFFINE) {
            status = mapped_build(e, f, from, map, orientation, side, nodes);
            continue;
        }
        struct font_segment to = {.degree = from->degree};
        for (int k = 0; k <= from->degree; k++)
            to.p[k] = (struct font_point){m[0] * from->p[k].x + m[1] * from->p[k].y + m[2],
                                          m[3] * from->p[k].x + m[4] * from->p[k].y + m[5]};
        status = steps_build(e, f, &to, side);
    }
    if (status == FONT_OK)
        bounds_find(e);
    return status;
}

static void clear(struct font_edges *e)
{
    e->nodes_count = e->lines_count = e->arcs_count = 0;
    e->x0 = e->y0 = 1;
    e->x1 = e->y1 = -1;
}

static enum font_status build(struct font_edges *e, const struct font_outline *outline,
                              const struct font_map *map, const struct font_filter *filter,
                              bool tabled)
{
    clear(e);
    if (!outline->prepared)
        return font_fail(FONT_BAD_ARGUMENT, "an outline is prepared before it is drawn");
    for (int i = 0; i < FONT_MAP_NUMBERS; i++)
        if (!isfinite(map->m[i]))
            return font_fail(FONT_BAD_ARGUMENT, "a size or a map cannot hold %g", map->m[i]);
    const double *m = map->m;
    e->advance_px =
        map->kind == FONT_AFFINE ? outline->advance * hypot(m[0], m[3]) : outline->advance;
    if (!outline->segments_count)
        return FONT_OK;
    double det = m[0] * m[4] - m[1] * m[3];
    int orientation = map->kind != FONT_AFFINE ? map_orientation(map, outline)
                      : det > 0                ? 1
                      : det < 0                ? -1
                                               : 0;
    if (orientation == 0) {
        if (map->kind == FONT_AFFINE)
            return FONT_OK; /* squashed flat: no ink */
        return outside();
    }
    bool far = map->kind == FONT_AFFINE && !fits(m, &outline->box);
    enum font_status status =
        far ? FONT_OK : segments_build(e, outline, map, filter, tabled, orientation);
    if (far || (status == FONT_OK && e->x0 <= e->x1 &&
                !(e->x0 >= -FONT_SIDE_MAX && e->x1 <= FONT_SIDE_MAX &&
                  e->y0 >= -FONT_SIDE_MAX && e->y1 <= FONT_SIDE_MAX)))
        status =
            font_fail(FONT_TOO_LARGE, "a glyph would reach more than %d pixels from its origin",
                      FONT_SIDE_MAX);
    if (status != FONT_OK)
        clear(e);
    if (e->nodes_count) { /* drawing reads whole vectors */
        memset(e->node_x + e->nodes_count, 0, FONT_EDGES_PAD * sizeof(float));
        memset(e->node_y + e->nodes_count, 0, FONT_EDGES_PAD * sizeof(float));
    }
    return status;
}

enum font_status font_edges_build(struct font_edges *e, const struct font_outline *outline,
                                  const struct font_map *map, const struct font_filter *filter)
{
    return build(e, outline, map, filter, false);
}

enum font_status font_edges_build_tabled(struct font_edges *e,
                                         const struct font_outline *outline,
                                         const struct font_map *map,
                                         const struct font_filter *filter)
{
    return build(e, outline, map, filter, true);
}
