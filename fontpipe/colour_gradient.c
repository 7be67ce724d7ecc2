/* colour_gradient.c - see colour_gradient.h; places as OpenType's COLR table defines them. */
#include "colour_gradient.h"

#include <math.h>
#include <string.h>

/* The line's end that is as far along the way straight across p[0] p[2]. */
static bool line_straighten(struct font_gradient *g)
{
    struct font_point *p = g->p;
    double ax = p[1].x - p[0].x, ay = p[1].y - p[0].y;
    double bx = p[2].x - p[0].x, by = p[2].y - p[0].y, bb = bx * bx + by * by;
    if (!(bb > 0))
        return false;
    double part = (ax * bx + ay * by) / bb; /* of it that lies along p[0] p[2] */
    p[1].x -= part * bx;
    p[1].y -= part * by;
    ax -= part * bx;
    ay -= part * by;
    return ax * ax + ay * ay > 1e-9;
}

bool font_gradient_prepare(struct font_gradient *g)
{
    for (int i = 1; i < g->count; i++)
        for (int k = i; k > 0 && g->at[k] < g->at[k - 1]; k--) {
            float at = g->at[k], rgba[4];
            memcpy(rgba, g->rgba[k], sizeof rgba);
            g->at[k] = g->at[k - 1];
            memcpy(g->rgba[k], g->rgba[k - 1], sizeof rgba);
            g->at[k - 1] = at;
            memcpy(g->rgba[k - 1], rgba, sizeof rgba);
        }
    if (g->count < 1)
        return false;
    if (g->kind == FONT_GRADIENT_LINEAR)
        return line_straighten(g);
    if (g->kind == FONT_GRADIENT_SWEEP)
        return g->r[0] != g->r[1] || g->extend == FONT_EXTEND_PAD;
    return g->r[0] != g->r[1] || g->p[0].x != g->p[1].x || g->p[0].y != g->p[1].y;
}

/* Of the circles between and beyond the two that go through the place, the last whose radius is
 * not below 0. */
static bool radial_way(const struct font_gradient *g, double x, double y, double *way)
{
    double dx = g->p[1].x - g->p[0].x, dy = g->p[1].y - g->p[0].y, dr = g->r[1] - g->r[0];
    double px = x - g->p[0].x, py = y - g->p[0].y, r0 = g->r[0];
    double a = dx * dx + dy * dy - dr * dr, b = px * dx + py * dy + r0 * dr,
           c = px * px + py * py - r0 * r0;
    if (fabs(a) < 1e-9 * (dr * dr)) {
        *way = c / (2 * b);
        return b != 0 && r0 + *way * dr >= 0;
    }
    double under = b * b - a * c;
    if (!(under >= 0))
        return false;
    double root = sqrt(under), first = (b + root) / a, second = (b - root) / a;
    *way = fmax(first, second);
    if (r0 + *way * dr >= 0)
        return true;
    *way = fmin(first, second);
    return r0 + *way * dr >= 0;
}

static bool way_of(const struct font_gradient *g, double x, double y, double *way)
{
    if (g->kind == FONT_GRADIENT_RADIAL)
        return radial_way(g, x, y, way);
    x -= g->p[0].x;
    y -= g->p[0].y;
    if (g->kind == FONT_GRADIENT_LINEAR) {
        double dx = g->p[1].x - g->p[0].x, dy = g->p[1].y - g->p[0].y;
        *way = (x * dx + y * dy) / (dx * dx + dy * dy);
        return true;
    }
    double turns = atan2(y, x) / (2 * M_PI);
    turns += turns < 0 ? 1 : 0;
    double span = g->r[1] - g->r[0];
    *way = span != 0 ? (turns - g->r[0]) / span : turns < g->r[0] ? -1e9 : 1e9;
    return true;
}

/* Into the line's own part, from its first colour to its last. */
static double extended(enum font_extend extend, double part)
{
    if (extend == FONT_EXTEND_REPEAT)
        return part - floor(part);
    if (extend == FONT_EXTEND_REFLECT)
        return 1 - fabs(1 - (part - 2 * floor(part / 2)));
    return part;
}

bool font_gradient_at(const struct font_gradient *g, double x, double y, float rgba[4])
{
    double way;
    if (!way_of(g, x, y, &way) || !isfinite(way))
        return false;
    double from = g->at[0], span = g->at[g->count - 1] - from;
    if (span > 0)
        way = from + span * extended(g->extend, (way - from) / span);
    int i = 0;
    while (i < g->count && g->at[i] <= way)
        i++;
    int last = g->count - 1;
    const float *a = g->rgba[i > 0 ? i - 1 : 0], *b = g->rgba[i > last ? last : i];
    double gap = i > 0 && i <= last ? g->at[i] - g->at[i - 1] : 0;
    float part = gap > 0 ? (float)((way - g->at[i - 1]) / gap) : 0;
    for (int c = 0; c < 4; c++)
        rgba[c] = a[c] + (b[c] - a[c]) * part;
    return true;
}
