/* sizing.c - how hard a dry fiber is to wet, and the eddies of the water above it: noises of many sizes, from the seed.
 *
 * A noise is made from the coarse to the fine: random numbers on a grid, halved as cubic B-splines are, and at each size more random
 * numbers added:
 *
 *     size 64     .       .       .        a row is halved by   (1 6 1)/8 at its points and (1 1)/2 between them,
 *     size 32     .   .   .   .   .        then the columns; what is left of a grid of random numbers is smooth and nearly round
 *     ...
 *     size 1      .................
 *
 * Everything is sums and products of floats in one order: the bits are the same wherever it runs. A side that is a multiple of
 * the coarsest size has no seam on a torus. */
#include "model/clouds.h"
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of a cubic B-spline through uniform numbers in -1..1: its deviation. */
#define SPLINE_DEVIATION 0.277
#define NOISE_MOST 3.0f
#define EDDY_MOST 1.3
#define CALM_EDGE 16       /* fibers */
#define HARD 0.22f         /* version 3; see spread_out() */
#define DEVIATION_MOST 0.7 /* of the logarithm of sizing */

struct octaves {
    int finest, coarsest; /* fibers between the random numbers, powers of two */
    double roughness;     /* amplitude goes with size to this power */
    double step;          /* and from a size to half of it by this */
    uint32_t seed;
};

static uint32_t noise_word(uint32_t x, uint32_t y, uint32_t seed)
{
    uint32_t word = x * 0x9e3779b1u + y * 0x85ebca77u + seed * 0xc2b2ae3du;
    word = (word ^ word >> 15) * 0x2c1b3c6du;
    word = (word ^ word >> 12) * 0x297a2d39u;
    return word ^ word >> 15;
}

static void random_add(float *grid, int columns, int rows, float amplitude, uint32_t seed)
{
    for (int y = 0; y < rows; y++)
        for (int x = 0; x < columns; x++) {
            uint32_t word = noise_word((uint32_t)x, (uint32_t)y, seed);
            grid[(size_t)y * (size_t)columns + (size_t)x] +=
                amplitude * ((float)(word >> 8) * 0x1p-23f - 1);
        }
}

/* A row of twice as many numbers. */
static void row_halve(const float *from, int columns, float *to)
{
    for (int x = 0; x < columns; x++) {
        float left = from[x > 0 ? x - 1 : columns - 1], here = from[x],
              right = from[x + 1 < columns ? x + 1 : 0];
        to[2 * x] = (left + right) * 0.125f + here * 0.75f;
        to[2 * x + 1] = (here + right) * 0.5f;
    }
}

/* Rows of `columns`: twice as many of them. */
static void columns_halve(const float *from, int columns, int rows, float *to)
{
    for (int y = 0; y < rows; y++) {
        size_t pitch = (size_t)columns;
        const float *above = from + (size_t)(y > 0 ? y - 1 : rows - 1) * pitch,
                    *here = from + (size_t)y * pitch,
                    *below = from + (size_t)(y + 1 < rows ? y + 1 : 0) * pitch;
        float *even = to + 2 * (size_t)y * pitch, *odd = even + pitch;
        for (int x = 0; x < columns; x++) {
            even[x] = (above[x] + below[x]) * 0.125f + here[x] * 0.75f;
            odd[x] = (here[x] + below[x]) * 0.5f;
        }
    }
}

/* Deviation about 1, mean about 0. False: no memory. */
static bool noise_make(float *out, int width, int height, const struct octaves *of)
{
    double squares = 0;
    for (int size = of->finest; size <= of->coarsest; size *= 2)
        squares += pow(size, 2 * of->roughness);
    const double norm = 1 / (SPLINE_DEVIATION * sqrt(squares));
    int columns = (width + of->coarsest - 1) / of->coarsest,
        rows = (height + of->coarsest - 1) / of->coarsest;
    size_t most = (size_t)columns * (size_t)of->coarsest * (size_t)rows * (size_t)of->coarsest;
    float *grid = calloc(most, sizeof *grid), *wide = malloc(most * sizeof *wide);
    bool made = grid && wide;
    for (int size = of->coarsest; made; size /= 2) {
        if (size >= of->finest)
            random_add(grid, columns, rows, (float)(pow(size, of->roughness) * norm),
                       of->seed + (uint32_t)size);
        if (size == 1)
            break;
        for (int y = 0; y < rows; y++)
            row_halve(grid + (size_t)y * (size_t)columns, columns,
                      wide + 2 * (size_t)y * (size_t)columns);
        columns *= 2;
        columns_halve(wide, columns, rows, grid);
        rows *= 2;
    }
    for (int y = 0; made && y < height; y++)
        memcpy(out + (size_t)y * (size_t)width, grid + (size_t)y * (size_t)columns,
               (size_t)width * sizeof *out);
    free(grid);
    free(wide);
    return made;
}

/* (1 + d n / 8)^8, nearly exp (d n), n cut off at 3 either way: no function of a library, whose last bits may differ. What is above 1 is
 * drawn in to `hard` of it: in version 3 the hardest paper lets a hanging bead through in the end, or a band's lower edge would stay as it was
 * put, straight, between few drips. */
static void spread_out(float *values, size_t count, float deviation, float hard)
{
    for (size_t i = 0; i < count; i++) {
        float n = fminf(fmaxf(values[i], -NOISE_MOST), NOISE_MOST);
        float root = 1 + deviation * n * 0.125f;
        root *= root;
        root *= root;
        root *= root;
        values[i] = root > 1 ? 1 + (root - 1) * hard : root;
    }
}

/* Eddies fade towards the edges of a sheet: water that they moved there would have nowhere to
 * go. */
static void edges_calm(float *values, const struct paper_sheet_config *config, double finer)
{
    const int wide = (int)(CALM_EDGE * finer);
    for (int y = 0; y < config->height; y++)
        for (int x = 0; x < config->width; x++) {
            int across = x < config->width - 1 - x ? x : config->width - 1 - x,
                down = y < config->height - 1 - y ? y : config->height - 1 - y,
                least = across < down ? across : down;
            if (least < wide)
                values[(size_t)y * (size_t)config->width + (size_t)x] *=
                    (float)least / (float)wide;
        }
}

/* Only the slope of the stream function moves anything; but what its value is times how much the depth differs from fiber to fiber
 * moves pigments too, hither and thither, and into single fibers that cannot give as much as they get. So it is folded, like a
 * ruler, into -EDDY_MOST..EDDY_MOST (version 3). */
static void eddies_fold(float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double n = (double)values[i] + EDDY_MOST;
        n -= 4 * EDDY_MOST * floor(n / (4 * EDDY_MOST));
        values[i] = (float)(fabs(n - 2 * EDDY_MOST) - EDDY_MOST);
    }
}

/* Version 3: of clouds, which are the same ones, finer, on a sheet that is drawn anew. */
static bool clouded_make(const struct paper_sheet *p, float *out, const struct octaves *of)
{
    const double step = of->step;
    const struct clouds clouds = {.finest = of->finest * p->finer,
                                  .coarsest = of->coarsest * p->finer,
                                  .step = step,
                                  .seed = clouds_word(p->config.seed, of->seed & 3),
                                  .turned = true};
    return clouds_make(out, p->config.width, p->config.height, p->config.torus, &clouds);
}

static bool octaves_make(const struct paper_sheet *p, float *out, const struct octaves *of)
{
    return sheet_of_version_3(p) ? clouded_make(p, out, of)
                                 : noise_make(out, p->config.width, p->config.height, of);
}

enum paper_status sheet_sizing_make(struct paper_sheet *p)
{
    const struct paper_sheet_config *config = &p->config;
    const struct octaves sizes = {4, 64, 0.4, 0.75786, (uint32_t)config->seed * 77 + 1},
                         eddies = {sheet_of_version_3(p) ? 12 : 8,
                                   sheet_of_version_3(p) ? 48 : 16, 1,
                                   sheet_of_version_3(p) ? 0.65 : 0.5,
                                   (uint32_t)config->seed * 77 + 3};
    size_t count = (size_t)config->width * (size_t)config->height;
    float *values = malloc(count * sizeof *values);
    bool made = values && octaves_make(p, values, &sizes);
    if (made) {
        spread_out(values, count,
                   (float)(DEVIATION_MOST * fmin(1, 2 * config->stock.absorbency_variation)),
                   sheet_of_version_3(p) ? HARD : 1);
        kit_grid_f_write(&p->page.grid, p->sizing, values);
        made = octaves_make(p, values, &eddies);
    }
    if (made && sheet_of_version_3(p))
        eddies_fold(values, count);
    if (made && !config->torus)
        edges_calm(values, config, p->finer);
    if (made)
        kit_grid_f_write(&p->page.grid, p->current, values);
    free(values);
    return made ? PAPER_OK
                : paper_fail(PAPER_NO_MEMORY, "no memory for a sheet of %dx%d", config->width,
                             config->height);
}
