/* sizing.c - how hard a dry fiber is to wet, and the eddies of the water above it: noises of
 * many sizes, from the seed. */
#include "model/clouds.h"
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NOISE_MOST 3.0f
#define EDDY_MOST 1.3
#define CALM_EDGE 16       /* fibers */
#define HARD 0.22f         /* see spread_out() */
#define DEVIATION_MOST 0.7 /* of the logarithm of sizing */

struct octaves {
    int finest, coarsest; /* fibers between the random numbers, powers of two */
    double step;          /* amplitude from a size to half of it */
    uint32_t seed;
};

/* (1 + d n / 8)^8, nearly exp (d n), n cut off at 3 either way: no function of a library, whose
 * last bits may differ. What is above 1 is drawn in to HARD of it: the hardest paper lets a
 * hanging bead through in the end, or a band's lower edge would stay as it was put, straight,
 * between few drips. */
static void spread_out(float *values, size_t count, float deviation)
{
    for (size_t i = 0; i < count; i++) {
        float n = fminf(fmaxf(values[i], -NOISE_MOST), NOISE_MOST);
        float root = 1 + deviation * n * 0.125f;
        root *= root;
        root *= root;
        root *= root;
        values[i] = root > 1 ? 1 + (root - 1) * HARD : root;
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

/* Only the slope of the stream function moves anything; but what its value is times how much
 * the depth differs from fiber to fiber moves pigments too, hither and thither, and into single
 * fibers that cannot give as much as they get. So it is folded, like a ruler, into
 * -EDDY_MOST..EDDY_MOST. */
static void eddies_fold(float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double n = (double)values[i] + EDDY_MOST;
        n -= 4 * EDDY_MOST * floor(n / (4 * EDDY_MOST));
        values[i] = (float)(fabs(n - 2 * EDDY_MOST) - EDDY_MOST);
    }
}

/* Of clouds, which are the same ones, finer, on a sheet that is drawn anew. */
static bool octaves_make(const struct paper_sheet *p, float *out, const struct octaves *of)
{
    const double step = of->step;
    const struct clouds clouds = {.finest = of->finest * p->finer,
                                  .coarsest = of->coarsest * p->finer,
                                  .step = step,
                                  .seed = clouds_word(p->config.seed, of->seed & 3),
                                  .turned = true};
    return clouds_make(out, p->config.width, p->config.height, p->config.torus, &clouds);
}

double sheet_sizing_strength(const struct paper_sheet *p)
{
    return fmin(1, 2 * p->config.stock.absorbency_variation);
}

double sheet_unsized(const struct paper_sheet *p)
{
    const double sized = (SHEET_UNSIZED_LEAST - p->config.stock.absorbency) /
                         (SHEET_UNSIZED_LEAST - SHEET_SIZED_MOST);
    return 1 - fmin(1, fmax(0, sized));
}

enum paper_status sheet_sizing_make(struct paper_sheet *p)
{
    const struct paper_sheet_config *config = &p->config;
    const struct octaves sizes = {4, 64, 0.75786, (uint32_t)config->seed * 77 + 1},
                         eddies = {12, 48, 0.65, (uint32_t)config->seed * 77 + 3};
    size_t count = (size_t)config->width * (size_t)config->height;
    float *values = malloc(count * sizeof *values);
    bool made = values && octaves_make(p, values, &sizes);
    if (made) {
        spread_out(values, count, (float)(DEVIATION_MOST * sheet_sizing_strength(p)));
        kit_grid_f_write(&p->page.grid, p->sizing, values);
        made = octaves_make(p, values, &eddies);
    }
    if (made)
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
