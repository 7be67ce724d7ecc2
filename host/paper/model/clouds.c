/* clouds.c - cubic B-splines through random numbers on grids of many sizes.
 *
 * A size's grid is interpolated in two turns, so that a fiber costs four products:
 *
 *     grid   .   .   .   .        a row of fibers lies between rows of the grid: these are
 *            summed with the spline's four weights
 *     row    -------------        and what comes out is interpolated along the row with four weights more
 */
#include "model/clouds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the spline through uniform numbers in -1..1: its deviation, a mean over places. */
#define SPLINE_DEVIATION 0.277

/* One size along one axis: which of the grid's numbers a fiber lies between, and the weights of
 * the four around it. */
struct places {
    int count; /* of the grid's numbers; more would be the same ones again */
    int *first;
    float (*weight)[4];
};

static void weights_make(float weight[4], double t)
{
    double s = 1 - t;
    weight[0] = (float)(s * s * s / 6);
    weight[1] = (float)((3 * t * t * t - 6 * t * t + 4) / 6);
    weight[2] = (float)((3 * s * s * s - 6 * s * s + 4) / 6);
    weight[3] = (float)(t * t * t / 6);
}

/* On a torus a whole number of sizes fits. */
static bool places_make(struct places *of, int length, double size, bool torus)
{
    int whole = (int)floor(length / size + 0.5);
    if (whole < 1)
        whole = 1;
    of->count = torus ? whole : (int)floor(length / size) + 5;
    double step = torus ? (double)length / whole : size;
    of->first = malloc((size_t)length * sizeof *of->first);
    of->weight = malloc((size_t)length * sizeof *of->weight);
    if (!of->first || !of->weight)
        return false;
    for (int i = 0; i < length; i++) {
        double at = (i + 0.5) / step;
        of->first[i] = (int)floor(at) % of->count;
        weights_make(of->weight[i], at - floor(at));
    }
    return true;
}

static void places_free(struct places *of)
{
    free(of->first);
    free(of->weight);
}

/* A row of the grid, and three of its numbers again behind its end. */
static void grid_row(float *row, int columns, uint64_t y, uint64_t seed)
{
    uint64_t own = clouds_word(seed, y);
    for (int x = 0; x < columns; x++)
        row[x] = (float)(clouds_word(own, (uint64_t)x) >> 40) * 0x1p-23f - 1;
}

/* Cosines and sines of angles that are as far as may be from the axes, from whole numbers: 53,
 * 23, 67, 37 and 44 degrees. */
static const double turns[][2] = {{3 / 5.0, 4 / 5.0},
                                  {12 / 13.0, 5 / 13.0},
                                  {5 / 13.0, 12 / 13.0},
                                  {4 / 5.0, 3 / 5.0},
                                  {21 / 29.0, 20 / 29.0}};
enum { TURNS = sizeof turns / sizeof *turns };

/* out += amplitude * the size's spline on a grid that is turned. */
static bool turned_add(float *out, int width, int height, double size, float amplitude,
                       uint64_t seed, const double turn[2], int border)
{
    /* the grid's places go from 0 along turn, and from -width sin / size across it */
    const double along = turn[0] / size, across = turn[1] / size;
    const double left = width * across;
    int columns = (int)(width * along + height * across) + 6,
        rows = (int)(width * across + height * along) + 6;
    float *grid = malloc((size_t)columns * (size_t)rows * sizeof *grid);
    if (!grid)
        return false;
    for (int y = 0; y < rows; y++)
        grid_row(grid + (size_t)y * (size_t)columns, columns, (uint64_t)y, seed);
    for (int y = 0; y < height; y++) {
        const bool middle = border > 0 && y >= border && y < height - border;
        for (int x = 0; x < width; x++) {
            if (middle && x == border && border < width - border)
                x = width - border;
            double u = (x + 0.5) * along + (y + 0.5) * across,
                   v = (y + 0.5) * along - (x + 0.5) * across + left;
            int column = (int)u, row = (int)v;
            float across_weight[4], down_weight[4], sum[4];
            weights_make(across_weight, u - column);
            weights_make(down_weight, v - row);
            const float *at = grid + (size_t)row * (size_t)columns + column;
            for (int i = 0; i < 4; i++, at += columns)
                sum[i] = (at[0] * across_weight[0] + at[3] * across_weight[3]) +
                         (at[1] * across_weight[1] + at[2] * across_weight[2]);
            out[(size_t)y * (size_t)width + (size_t)x] +=
                amplitude * ((sum[0] * down_weight[0] + sum[3] * down_weight[3]) +
                             (sum[1] * down_weight[1] + sum[2] * down_weight[2]));
        }
    }
    free(grid);
    return true;
}

/* out += amplitude * the size's spline. */
static bool size_add(float *out, int width, int height, bool torus, double size,
                     float amplitude, uint64_t seed)
{
    struct places across = {0}, down = {0};
    bool made = places_make(&across, width, size, torus);
    made = places_make(&down, height, size, torus) && made;
    size_t columns = made ? (size_t)across.count : 0;
    float *rows = calloc(4 * columns + 1, sizeof *rows),
          *mixed = malloc((columns + 3) * sizeof *mixed);
    made = made && rows && mixed;
    int kept[4] = {-1, -1, -1, -1}; /* which rows of the grid are in rows[], row y at y % 4 */
    for (int y = 0; made && y < height; y++) {
        const float *weight[4];
        for (int i = 0; i < 4; i++) {
            int row = (down.first[y] + i) % down.count, slot = (down.first[y] + i) % 4;
            float *at = rows + (size_t)slot * columns;
            if (kept[slot] != row)
                grid_row(at, across.count, (uint64_t)row, seed);
            kept[slot] = row;
            weight[i] = at;
        }
        const float *w = down.weight[y];
        for (size_t x = 0; x < columns; x++)
            mixed[x] = amplitude * ((weight[0][x] * w[0] + weight[3][x] * w[3]) +
                                    (weight[1][x] * w[1] + weight[2][x] * w[2]));
        for (size_t x = 0; x < 3; x++)
            mixed[columns + x] = mixed[x % columns];
        float *to = out + (size_t)y * (size_t)width;
        for (int x = 0; x < width; x++) {
            const float *four = mixed + across.first[x], *v = across.weight[x];
            to[x] += (four[0] * v[0] + four[3] * v[3]) + (four[1] * v[1] + four[2] * v[2]);
        }
    }
    places_free(&across);
    places_free(&down);
    free(rows);
    free(mixed);
    return made;
}

bool clouds_make(float *out, int width, int height, bool torus, const struct clouds *of)
{
    double squares = 0, amplitude = 1;
    for (double size = of->coarsest; size >= of->finest; size /= 2, amplitude *= of->step)
        squares += amplitude * amplitude;
    amplitude = 1 / (SPLINE_DEVIATION * sqrt(squares));
    memset(out, 0, (size_t)width * (size_t)height * sizeof *out);
    uint64_t octave = 0;
    for (double size = of->coarsest; size >= of->finest; size /= 2, amplitude *= of->step) {
        const double *turn = turns[octave % TURNS];
        const uint64_t seed = clouds_word(of->seed, octave++);
        if (!(of->turned && !torus
                  ? turned_add(out, width, height, size, (float)amplitude, seed, turn,
                               of->border)
                  : size_add(out, width, height, torus, size, (float)amplitude, seed)))
            return false;
    }
    return true;
}
