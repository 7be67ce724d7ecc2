/* felt_fibers.c - fibers that are thrown on a sheet (felt.c), and bundles of them.
 *
 * Where fibers lie side by side in a bundle, water runs between them as in a pore some fibers
 * wide. On a sheet without size these are the ways that ink takes first. */
#include "model/felt_making.h"

#include "model/deckle.h"

#include <math.h>
#include <string.h>

enum {
    CHANCE_REACH = 1 << 20
}; /* the number of a fiber's chance that its shape does not use */
#define STRIDE 0.7
#define BEND_KEPT 0.985
#define BEND_FIRST 0.03

/* About a bell of deviation 1. */
static double bell(struct chances *c)
{
    uint64_t word = clouds_word(c->seed, c->number++);
    int64_t sum = 0;
    for (int i = 0; i < 4; i++)
        sum += (int64_t)(word >> 16 * i & 0xffff);
    return ((double)sum * 0x1p-16 - 2) * 1.7320508075688772;
}

/* Leaves `part` around x, y on the four nearest, of which some may be beyond the edge. */
static void mass_leave_at_edge(const struct making *m, float *mass, double x, double y,
                               double part)
{
    double left = floor(x - 0.5), top = floor(y - 0.5), u = x - 0.5 - left, v = y - 0.5 - top;
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            int column = (int)left + i, row = (int)top + j;
            if (m->config->torus) {
                column = felt_around(column, m->width);
                row = felt_around(row, m->height);
            } else if (column < 0 || row < 0 || column >= m->width || row >= m->height) {
                continue;
            }
            mass[(size_t)row * (size_t)m->width + (size_t)column] +=
                (float)(part * (i ? u : 1 - u) * (j ? v : 1 - v));
        }
}

/* The same anywhere. */
static void mass_leave(const struct making *m, float *mass, double x, double y, double part)
{
    double u = x - 0.5, v = y - 0.5;
    if (!(u >= 0 && v >= 0 && u < m->width - 1 && v < m->height - 1)) {
        mass_leave_at_edge(m, mass, x, y, part);
        return;
    }
    int left = (int)u, top = (int)v;
    u -= left;
    v -= top;
    double before = part * (1 - u), behind = part * u;
    float *above = mass + (size_t)top * (size_t)m->width + left, *below = above + m->width;
    above[0] += (float)(before * (1 - v));
    above[1] += (float)(behind * (1 - v));
    below[0] += (float)(before * v);
    below[1] += (float)(behind * v);
}

static void unit_make(double direction[2])
{
    double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1]);
    direction[0] /= length;
    direction[1] /= length;
}

/* A direction by chance, all alike but for the sheet's grain. */
static void direction_make(const struct making *m, struct chances *c, double direction[2])
{
    double squared = 0;
    do {
        for (int axis = 0; axis < 2; axis++)
            direction[axis] = 2 * chance(c) - 1;
        squared = direction[0] * direction[0] + direction[1] * direction[1];
    } while (squared > 1 || squared < 1e-4);
    for (int axis = 0; axis < 2; axis++)
        direction[axis] *= m->lean[axis];
    unit_make(direction);
}

/* Where the sheet is thin, a fiber lies only as far as it reaches. */
static bool stays(const struct making *m, double x, double y, double reach)
{
    const double column = x * m->scale, row = y * m->scale;
    if (!(column >= 0 && row >= 0 && column < m->width && row < m->height))
        return false;
    const double inside = (double)m->inside[(size_t)row * (size_t)m->width + (size_t)column];
    return inside > reach && inside < m->config->deckle.thin + 2 * m->scale;
}

/* No mass can come to the sheet from within `reach` of x, y, in fibers of the stock's own
 * scale. */
static bool beyond(const struct making *m, double x, double y, double reach)
{
    const double far = (reach + STRIDE + 1) * m->scale + 2;
    return !m->slowly && !m->config->torus &&
           (x * m->scale < -far || y * m->scale < -far || x * m->scale > m->width + far ||
            y * m->scale > m->height + far);
}

/* One fiber from x, y, in fibers of the stock's own scale. At finer scales it is as wide as it
 * is there: it is drawn in strands. */
static void fiber_draw(const struct making *m, const struct felt_thrown *of, float *mass,
                       struct chances *c, double x, double y)
{
    double direction[2], bend = BEND_FIRST * bell(c), u = chance(c);
    direction_make(m, c, direction);
    double length = of->length * (0.2 + 2.8 * u * u);
    if (beyond(m, x, y, length))
        return;
    const int pieces = m->scale > 1 ? (int)ceil(m->scale) : 1,
              strands = (int)ceil(pieces * of->width);
    const double part = of->width * STRIDE * m->scale * m->scale / (strands * pieces);
    const double reach =
        m->inside ? deckle_reach(&m->config->deckle, clouds_chance(c->seed, CHANCE_REACH)) : 0;
    for (double gone = 0; gone < length; gone += STRIDE) {
        const bool lies = m->inside && stays(m, x, y, reach);
        for (int piece = 0; piece < pieces && !beyond(m, x, y, 0); piece++) {
            double ahead = (piece + 0.5) / pieces * STRIDE;
            for (int strand = 0; strand < strands; strand++) {
                double aside = ((strand + 0.5) / strands - 0.5) * of->width;
                const double to_x =
                                 (x + ahead * direction[0] - aside * direction[1]) * m->scale,
                             to_y =
                                 (y + ahead * direction[1] + aside * direction[0]) * m->scale;
                mass_leave(m, mass, to_x, to_y, part);
                if (lies)
                    mass_leave(m, m->stayed, to_x, to_y, part);
            }
        }
        x += STRIDE * direction[0];
        y += STRIDE * direction[1];
        double before[2] = {direction[0], direction[1]};
        direction[0] -= STRIDE * bend * before[1];
        direction[1] += STRIDE * bend * before[0];
        unit_make(direction);
        bend = (bend + of->curl * bell(c)) * BEND_KEPT;
    }
}

void felt_throw(const struct making *m, const struct felt_thrown *of, float *mass,
                const float *clouds)
{
    enum { SQUARE = 16 };
    double mean = of->length * (0.2 + 2.8 / 3);
    double each = SQUARE * SQUARE * of->cover / (mean * of->width); /* fibers in a square */
    /* Fibers from beyond the edge reach in. */
    int reach = m->config->torus ? 0 : (int)ceil(of->length / SQUARE);
    int columns = (int)ceil(m->width / (m->scale * SQUARE)),
        rows = (int)ceil(m->height / (m->scale * SQUARE));
    memset(mass, 0, (size_t)m->width * (size_t)m->height * sizeof *mass);
    for (int row = -reach; row < rows + reach; row++)
        for (int column = -reach; column < columns + reach; column++) {
            struct chances c = {
                clouds_word(clouds_word(m->seed, of->which),
                            (uint64_t)(row + 4096) << 32 | (uint64_t)(column + 4096)),
                0};
            int x = (int)((column + 0.5) * SQUARE * m->scale),
                y = (int)((row + 0.5) * SQUARE * m->scale);
            x = x < 0 ? 0 : x < m->width ? x : m->width - 1;
            y = y < 0 ? 0 : y < m->height ? y : m->height - 1;
            double cloud = (double)clouds[(size_t)y * (size_t)m->width + (size_t)x];
            double wanted = each * fmax(0.3, fmin(1.7, 1 + 0.25 * cloud));
            int count = (int)floor(wanted + chance(&c));
            for (int i = 0; i < count; i++) {
                struct chances own = {clouds_word(c.seed, (uint64_t)i + 7), 0};
                double from_x = (column + chance(&own)) * SQUARE,
                       from_y = (row + chance(&own)) * SQUARE;
                fiber_draw(m, of, mass, &own, from_x, from_y);
            }
        }
}
