/* felt.c - a sheet as a mould makes it: fibers that settle out of water, pressed between felts,
 * and sized.
 *
 *     clouds     pulp flocks together: noise of sizes 256, 128, ... 8
 *     fibers     thrown on by chance, more where a cloud is: each goes 0.7 on, turns by its
 *                bend, and leaves mass where it passes. Bends wander, so fibers curl; lengths
 *                go from a fifth to three times the usual one; no direction is dearer than
 *                another, but by stock.fiber_length: a sheet from a machine has a grain
 *     pores      in a sheet that is not sized: bundles of fibers side by side, some 3 fibers
 *                wide, between which water runs
 *     tooth      the felts' marks, as large as stock.grain_px
 *     grit       short hairs and filler: noise of sizes 6 to 1.5. Pigments that granulate
 *                gather in it; with fibers alone they drew a net
 *     laid       on a mould of wires, which are ridges in the sheet: lines close together, and
 *                chains across them far apart, both wavering, and fainter in some clouds than
 *                in others
 *     sizing     glue goes into some places more than into others: noise of sizes 256 to 16
 *
 * All lengths are in the stock's own scale: at another resolution of the same sheet the same
 * fibers are drawn finer. */
#include "model/felt.h"

#include "base/base.h"
#include "model/clouds.h"
#include "model/deckle.h"
#include "model/felt_making.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* cold press: a mould-made watercolour paper of cotton, 300 g/m2, with the marks of woollen
 * felts. hot press: the same, pressed between hot rollers. rough: handmade, dried without
 * pressing. blotting: cotton linters, unsized and loose. glass: no fibers. laid: Ingres paper,
 * with its wires' lines. xuan: the bark of the wingceltis and rice straw, long fine fibers,
 * unsized, on a screen of bamboo. */
static const struct recipe recipes[] = {
    {"cold press", 60, 2.6, .006, .75, .55, .20, .5, 0, 0, 0, 0},
    {"hot press", 60, 2.6, .006, .40, .85, .30, .3, 0, 0, 0, 0},
    {"rough", 70, 2.6, .006, .66, .62, .15, .5, 0, 0, 0, 0},
    {"blotting", 30, 3.4, .014, .30, .85, .40, .3, 0, 0, 0, .30},
    {"glass", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {"laid", 60, 2.6, .006, .35, .70, .30, .2, .40, 5, 96, 0},
    {"xuan", 110, 2.0, .004, .20, .95, .35, 0, .15, 6, 120, .5},
};

enum {
    SEED_CLOUDS = 1,
    SEED_FIBERS,
    SEED_TOOTH,
    SEED_SIZING,
    SEED_WAVER,
    SEED_FAINT,
    SEED_GRIT,
    SEED_PORES
};
/* Bundles of fibers, in fibers of the stock's own scale. Two to four is what the branches of
 * ink are wide, and they are as long as water comes in a bundle. */
#define PORES_LENGTH 60
#define PORES_WIDTH 2.4
#define FIBERS_FOR_GRIT 1.0
#define LAID 0.7 /* of a recipe's lines: they stand out beside washes as smooth as ours */

static const struct recipe *recipe_of(const struct paper_stock *stock)
{
    for (size_t i = 0; i < sizeof recipes / sizeof *recipes; i++)
        if (strncmp(recipes[i].stock, stock->name, sizeof stock->name) == 0)
            return &recipes[i];
    return &recipes[0];
}

static size_t count_of(const struct making *m)
{
    return (size_t)m->width * (size_t)m->height;
}

/* Mean 0 and the deviation given; a flat one stays. */
static void level_out(float *values, size_t count, double deviation)
{
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++)
        sum += (double)values[i];
    double mean = sum / (double)count;
    for (size_t i = 0; i < count; i++)
        squares += ((double)values[i] - mean) * ((double)values[i] - mean);
    double had = sqrt(squares / (double)count);
    float times = (float)(had > 1e-9 ? deviation / had : 0), less = (float)mean;
    for (size_t i = 0; i < count; i++)
        values[i] = (values[i] - less) * times;
}

static void add(float *to, const float *from, size_t count, double part)
{
    for (size_t i = 0; i < count; i++)
        to[i] += (float)part * from[i];
}

static bool cloud_make(const struct making *m, float *out, double finest, double coarsest,
                       double step, uint64_t which)
{
    const struct clouds of = {.finest = finest,
                              .coarsest = coarsest,
                              .step = step,
                              .seed = clouds_word(m->seed, which)};
    return clouds_make(out, m->width, m->height, m->config->torus, &of);
}

/* ---- lines of the mould ---- */

/* 1 at whole numbers, -1 in the middle between two, round in both: two parabolas. */
static double wave(double at)
{
    double t = at - floor(at), u = fabs(t - 0.5); /* u: 1/2 on a line, 0 between two */
    return u < 0.25 ? 16 * u * u - 1 : 1 - 16 * (0.5 - u) * (0.5 - u);
}

/* The wires' ridges: wires along x, chains along y. `waver` and `faint` are noises. */
static void laid_add(const struct making *m, float *relief, const float *waver,
                     const float *faint)
{
    const struct recipe *of = m->recipe;
    for (int y = 0; y < m->height; y++)
        for (int x = 0; x < m->width; x++) {
            size_t at = (size_t)y * (size_t)m->width + (size_t)x;
            double off = 0.35 * (double)waver[at],
                   strength = 1 + 0.35 * fmax(-2, fmin(2, (double)faint[at]));
            double line = wave(((y + 0.5) / m->scale + off) / of->laid_step);
            double from = (x + 0.5) / m->scale + 1.2 * off,
                   chain = from - of->chain_step * floor(from / of->chain_step) -
                           of->chain_step / 2;
            double ridge = fmax(0, 1 - chain * chain / 9);
            relief[at] += (float)(LAID * of->laid * strength * (line + 1.2 * ridge));
        }
}

/* ---- the felts' marks ---- */

enum { MARKS = 3 }; /* in a square as wide as a mark's radius, up or down */

/* Places along one axis that a mark covers. */
struct marked {
    int count;
    size_t *at;      /* in the sheet */
    double *squared; /* of the distance from the mark's middle, in its radius */
};

static bool marked_make(struct marked *of, double radius_most)
{
    size_t most = (size_t)(2 * radius_most) + 2;
    of->at = malloc(most * sizeof *of->at);
    of->squared = malloc(most * sizeof *of->squared);
    return of->at && of->squared;
}

static void marked_free(struct marked *of)
{
    free(of->at);
    free(of->squared);
}

/* Those of an axis of that length around `middle`; `step`: from one place to the next in the
 * sheet. */
static void marked_find(struct marked *of, const struct making *m, int length, size_t step,
                        double middle, double radius)
{
    int from = (int)ceil(middle - radius - 0.5), to = (int)floor(middle + radius - 0.5);
    bool torus = m->config->torus;
    of->count = 0;
    for (int i = torus || from > 0 ? from : 0; i <= to && (torus || i < length); i++) {
        double d = (i + 0.5 - middle) / radius;
        of->at[of->count] = (size_t)(torus ? felt_around(i, length) : i) * step;
        of->squared[of->count++] = d * d;
    }
}

/* What a mark of that height adds where `inside` is 1 in its middle, 0 at its edge and less
 * beyond. */
static float pressed(double height, double inside)
{
    inside = inside > 0 ? inside : 0;
    return (float)(height * inside * inside);
}

/* One round mark, highest in its middle. Its places are side by side unless the mark goes
 * around the sheet. */
static void mark_press(float *relief, const struct marked *across, const struct marked *down,
                       double height)
{
    const int count = across->count;
    const size_t *at = across->at;
    const double *squared = across->squared;
    for (int row = 0; count > 0 && row < down->count; row++) {
        float *line = relief + down->at[row], *to = line + at[0];
        double less = down->squared[row];
        if (at[count - 1] == at[0] + (size_t)count - 1)
            for (int i = 0; i < count; i++)
                to[i] += pressed(height, 1 - squared[i] - less);
        else
            for (int i = 0; i < count; i++)
                line[at[i]] += pressed(height, 1 - squared[i] - less);
    }
}

/* Round marks of about that radius everywhere: no direction is before another. False: no
 * memory. */
static bool marks_add(const struct making *m, float *relief, double radius, double height,
                      uint64_t which)
{
    struct marked across = {0}, down = {0};
    int columns = (int)ceil(m->width / radius), rows = (int)ceil(m->height / radius);
    int beyond = m->config->torus ? 0 : 2;
    uint64_t seed = clouds_word(m->seed, which);
    bool made = marked_make(&across, 1.5 * radius);
    made = marked_make(&down, 1.5 * radius) && made;
    for (int row = -beyond; made && row < rows + beyond; row++)
        for (int column = -beyond; column < columns + beyond; column++) {
            struct chances c = {
                clouds_word(seed, (uint64_t)(row + 65536) << 32 | (uint64_t)(column + 65536)),
                0};
            for (int i = 0; i < MARKS; i++) {
                double x = (column + chance(&c)) * radius, y = (row + chance(&c)) * radius,
                       size = radius * (0.7 + 0.8 * chance(&c));
                marked_find(&across, m, m->width, 1, x, size);
                marked_find(&down, m, m->height, (size_t)m->width, y, size);
                mark_press(relief, &across, &down, height * (2 * chance(&c) - 1));
            }
        }
    marked_free(&across);
    marked_free(&down);
    return made;
}

/* ---- the sheet ---- */

/* Fibers, and where a sheet has them bundles. */
static void fibers_make(const struct making *m, struct felt *felt, const float *clouds)
{
    const struct recipe *of = m->recipe;
    const struct felt_thrown fibers = {SEED_FIBERS, of->length, of->cover, of->curl, 1},
                             bundles = {SEED_PORES, PORES_LENGTH, of->pores, of->curl,
                                        PORES_WIDTH};
    felt_throw(m, &fibers, felt->mass, clouds);
    if (!felt->pores)
        return;
    felt_throw(m, &bundles, felt->pores, clouds);
    for (size_t i = 0; i < count_of(m); i++)
        felt->pores[i] = fminf(1, felt->pores[i]);
}

static bool parts_make(const struct making *m, struct felt *felt, float *clouds, float *spare)
{
    const struct recipe *of = m->recipe;
    const struct paper_stock *stock = &m->config->stock;
    size_t count = count_of(m);
    double scale = m->scale, grain = fmax(1, stock->grain_px);
    if (of->length == 0) { /* smears and dust */
        bool smeared = cloud_make(m, felt->relief, 1 * scale, 16 * scale, 0.8, SEED_TOOTH);
        level_out(felt->relief, count, 1);
        felt->smeared = true;
        return smeared;
    }
    bool made = cloud_make(m, clouds, 8 * scale, 256 * scale, 0.75, SEED_CLOUDS);
    if (made)
        fibers_make(m, felt, clouds);
    level_out(felt->mass, count, 1);
    memcpy(felt->fibers, felt->mass, count * sizeof *felt->mass);
    made = made && marks_add(m, felt->relief, 1.2 * grain, 1, SEED_TOOTH) &&
           marks_add(m, felt->relief, fmax(1, 0.6 * grain), 0.5, SEED_TOOTH + 100);
    level_out(felt->relief, count, 1);
    for (size_t i = 0; i < count; i++)
        felt->relief[i] *= (float)of->tooth;
    add(felt->relief, felt->mass, count, of->fibers * (1 - FIBERS_FOR_GRIT * of->grit));
    add(felt->relief, clouds, count, of->clouds);
    if (of->grit > 0 && made) {
        made = cloud_make(m, spare, 1.5 * scale, 6 * scale, 0.9, SEED_GRIT);
        level_out(spare, count, 1);
        add(felt->relief, spare, count, of->grit);
    }
    add(felt->mass, clouds, count, 0.7);
    made = made && cloud_make(m, felt->sizing, 16 * scale, 256 * scale, 0.8, SEED_SIZING);
    if (made && of->laid > 0) {
        made = cloud_make(m, clouds, 32 * scale, 128 * scale, 0.7, SEED_WAVER) &&
               cloud_make(m, spare, 32 * scale, 256 * scale, 0.8, SEED_FAINT);
        if (made)
            laid_add(m, felt->relief, clouds, spare);
    }
    level_out(felt->mass, count, 1);
    level_out(felt->relief, count, 1);
    return made;
}

bool felt_has_fibers(const struct paper_stock *stock)
{
    return recipe_of(stock)->length > 0;
}

double felt_scale(const struct paper_sheet_config *config)
{
    const struct paper_stock *usual = paper_stock_find(config->stock.name);
    const int *length = config->stock.fiber_length;
    if (!usual)
        usual = paper_stock_number(0);
    return (double)(length[0] > length[1] ? length[0] : length[1]) /
           (usual->fiber_length[0] > usual->fiber_length[1] ? usual->fiber_length[0]
                                                            : usual->fiber_length[1]);
}

static enum paper_status felt_of(const struct paper_sheet_config *config, bool slowly,
                                 struct felt *out)
{
    const int *length = config->stock.fiber_length;
    struct making m = {.config = config,
                       .recipe = recipe_of(&config->stock),
                       .width = config->width,
                       .height = config->height,
                       .lean = {1, 1},
                       .seed = config->seed,
                       .slowly = slowly};
    int longer = length[0] > length[1] ? length[0] : length[1];
    for (int axis = 0; axis < 2; axis++)
        m.lean[axis] = (double)length[axis] / longer;
    m.scale = felt_scale(config);
    size_t count = count_of(&m);
    *out = (struct felt){.relief = calloc(count, sizeof(float)),
                         .mass = calloc(count, sizeof(float)),
                         .fibers = calloc(count, sizeof(float)),
                         .sizing = calloc(count, sizeof(float))};
    if (m.recipe->pores > 0)
        out->pores = calloc(count, sizeof *out->pores);
    float *clouds = calloc(count, sizeof *clouds), *spare = calloc(count, sizeof *spare),
          *inside = NULL;
    bool made = out->relief && out->mass && out->fibers && out->sizing &&
                (out->pores || m.recipe->pores == 0) && clouds && spare;
    if (made && config->deckled) {
        m.stayed = out->thickness = calloc(count, sizeof *out->thickness);
        m.inside = inside = malloc(count * sizeof *inside);
        made = m.stayed && inside && deckle_make(config, m.scale, inside, spare);
    }
    made = made && parts_make(&m, out, clouds, spare);
    if (made && config->deckled) /* after all other parts: it needs the spare room */
        deckle_thickness_make(config, m.scale, inside, m.recipe->cover, out->thickness, spare);
    free(inside);
    free(clouds);
    free(spare);
    if (made)
        return PAPER_OK;
    felt_free(out);
    return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet of %dx%d", config->width,
                      config->height);
}

enum paper_status felt_make(const struct paper_sheet_config *config, struct felt *out)
{
    return felt_of(config, false, out);
}

enum paper_status felt_make_slowly(const struct paper_sheet_config *config, struct felt *out)
{
    return felt_of(config, true, out);
}

void felt_free(struct felt *felt)
{
    free(felt->relief);
    free(felt->mass);
    free(felt->fibers);
    free(felt->sizing);
    free(felt->pores);
    free(felt->thickness);
    *felt = (struct felt){0};
}
