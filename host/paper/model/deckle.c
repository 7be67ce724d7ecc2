/* deckle.c - the edge of a sheet that was made in a mould by hand.
 *
 * A mould is a screen; the deckle is a loose frame upon it that holds the pulp. Some pulp seeps
 * under the frame before it is taken off, so the sheet does not end at once: it gets thinner
 * over some millimetres, its edge wanders by one or two, and single fibers reach over it. All
 * four sides are like that; where sheets are torn from each other the edge is thicker and frays
 * by whole tufts, and that is not what is made here.
 *
 *          picture's border
 *          |   margin    :  thin                       d, from the mean edge, a rectangle with round corners, plus
 *          |             : __________ thickness 1          waves * clouds of sizes 128 to 4: long waves and short ones
 *          |         _ _/:                                 tears: bays where clouds of sizes 24 to 6 are deep
 *          |________/  fringe: single fibers
 *
 *     a fiber of the pulp lies where d is above its own reach: one in four beyond the edge, fewer the farther
 *     thickness = what has no form (fines, short hairs) where d > 0, growing with d, and the fibers that lie there
 *
 * So the same fibers make the sheet and its edge, and a sheet with a deckle is in its middle
 * the sheet without one, to the bit. */
#include "model/deckle.h"

#include "model/clouds.h"

#include <math.h>
#include <string.h>

enum { SEED_WAVES = 21, SEED_TEARS };
#define WAVES_COARSEST 128
#define WAVES_FINEST 4
#define WAVES_STEP 0.84
#define TEARS_COARSEST 24
#define TEARS_FINEST 6
#define TEARS_STEP 0.7
#define TEARS_FROM 0.9 /* deviations */
#define TEARS 0.9      /* of waves, for one deviation more */
#define WAVES_MOST 3.5
#define TEARS_MOST 2.5
#define WHOLE_FROM                                                                             \
    (WAVES_MOST + TEARS * TEARS_MOST) /* waves beyond which the sheet is whole everywhere */
#define BEYOND 0.24                   /* of the fibers */
#define AT_EDGE 0.2                   /* of the thickness */
#define FLOC 3.0 /* fibers that the edge is farther out where twice as many lie */
#define LIE_EVEN 0.75
#define LIE_MOST 2.5
#define OF_HAIRS 0.12 /* of the thickness, fibers beyond the edge as many as usual within */
enum { SOFTENED_MOST = 16 };

struct paper_deckle paper_deckle_default(void)
{
    return (struct paper_deckle){.margin = 22, .waves = 2.5, .thin = 14, .fringe = 5};
}

double paper_sheet_margin(const struct paper_sheet_config *config)
{
    const struct paper_deckle *d = &config->deckle;
    return config->deckled ? d->margin + 2 * d->waves + 0.6 * d->thin : 0;
}

/* How far a place at x of a side of that length lies inside its two ends, less `corner`. */
static double inside_of(double x, double length, double margin, double corner)
{
    return fmin(x, length - x) - margin - corner;
}

bool deckle_make(const struct paper_sheet_config *config, double scale, float *inside,
                 float *spare)
{
    const struct paper_deckle *d = &config->deckle;
    const int width = config->width, height = config->height;
    const double corner = d->thin, whole = d->margin + d->thin + WHOLE_FROM * d->waves;
    const int border = (int)fmin(PAPER_SIDE_MAX, ceil(whole + 2 * scale));
    const struct clouds waves = {fmax(1, WAVES_FINEST * scale),
                                 fmax(1, WAVES_COARSEST * scale),
                                 WAVES_STEP,
                                 clouds_word(config->seed, SEED_WAVES),
                                 true,
                                 border},
                        tears = {fmax(1, TEARS_FINEST * scale),
                                 fmax(1, TEARS_COARSEST * scale),
                                 TEARS_STEP,
                                 clouds_word(config->seed, SEED_TEARS),
                                 true,
                                 border};
    if (!clouds_make(inside, width, height, false, &waves) ||
        !clouds_make(spare, width, height, false, &tears))
        return false;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const size_t at = (size_t)y * (size_t)width + (size_t)x;
            const double across = inside_of(x + 0.5, width, d->margin, corner),
                         down = inside_of(y + 0.5, height, d->margin, corner),
                         u = fmin(across, 0), v = fmin(down, 0),
                         mean = corner + fmax(fmin(across, down), 0) - sqrt(u * u + v * v);
            const double wave = fmax(-WAVES_MOST, fmin(WAVES_MOST, (double)inside[at])),
                         tear = fmax(0, fmin(TEARS_MOST, (double)spare[at] - TEARS_FROM));
            inside[at] = (float)(mean + d->waves * (wave - TEARS * tear));
        }
    return true;
}

double deckle_reach(const struct paper_deckle *d, double chance)
{
    if (chance < BEYOND) {
        const double far = 1 - chance / BEYOND;
        return -d->fringe * far * far;
    }
    return 0.5 * d->thin * (chance - BEYOND) / (1 - BEYOND);
}

/* Sums by weights of 1, 2, 1 along an axis, over 4; beyond the ends there is nothing. */
static void soften(float *values, int count, size_t step)
{
    float before = 0;
    for (int i = 0; i < count; i++, values += step) {
        const float own = *values, behind = i + 1 < count ? values[step] : 0;
        *values = 0.25f * (before + behind) + 0.5f * own;
        before = own;
    }
}

/* lie: how many fibers lie around, even: 1; one: how many just there. */
static float thickness_of(const struct paper_deckle *d, double scale, double inside, double lie,
                          double one)
{
    if (inside >= d->thin)
        return 1;
    lie = fmin(LIE_MOST, lie);
    const double whole = fmin(1, fmax(0, inside / d->thin)),
                 at = inside + (1 - whole) * FLOC * scale * (lie - LIE_EVEN),
                 here = fmin(1, fmax(0, at + 0.5)), in = fmin(1, fmax(0, at / d->thin)),
                 body = here * (AT_EDGE + (1 - AT_EDGE) * in * (2 - in)),
                 beyond = d->fringe > 0 ? fmin(1, fmax(0, 1 + inside / d->fringe)) : 0;
    return (float)fmin(1, fmax(body, OF_HAIRS * one * beyond * (1 - here)));
}

void deckle_thickness_make(const struct paper_sheet_config *config, double scale,
                           const float *inside, double cover, float *mass, float *spare)
{
    const int width = config->width, height = config->height;
    const size_t count = (size_t)width * (size_t)height;
    memcpy(spare, mass, count * sizeof *mass);
    for (int i = 0; i < (int)fmax(1, fmin(SOFTENED_MOST, scale * scale)); i++) {
        for (int y = 0; y < height; y++)
            soften(spare + (size_t)y * (size_t)width, width, 1);
        for (int x = 0; x < width; x++)
            soften(spare + x, height, (size_t)width);
    }
    for (size_t i = 0; i < count; i++)
        mass[i] = thickness_of(&config->deckle, scale, (double)inside[i],
                               (double)spare[i] / cover, (double)mass[i] / cover);
}
