/* stock.c - what a dry sheet is like: heights, absorbency, capacity and colour from the seed.
 *
 * Sheets are felted: model/felt.c. The thesis's page has two noises, both a torus's.  Hills:
 * random numbers smoothed along both axes with their neighbours at 1, 1, 2, 2, 4, ..., sums of
 * boxes and so nearly round bells, in three octaves, the coarsest as wide as the paper's grain:
 *
 *     hills = (coarse + fine / 2 + finest / 4), mean 0, deviation about 1;  height = 1/2 +
 *                                                                           roughness * hills
 *
 * Fibers: as thesis/fiber.c makes them, laid along x and along y, each as long as the stock
 * says. Absorbency comes from fibers and a little from hills, so paper bleeds as it looks;
 * capacity from height. */
#include "model/felt.h"
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RANDOM_BITS = 16 };
#define FACE_LEAST 1e-6 /* an open face's; see OPEN_SCALE */
/* Of a sheet with a deckle: what is left of the height, and of how fast it drinks, where it is
 * thinnest. */
#define THIN_HEIGHT 0.4
#define THIN_DRINKS 0.3
/* In the stock's variation. */
#define FIBERS_DRINK 1.1f
#define CLOUDS_DRINK 0.1f
#define SIZE_DRINKS_NOT 0.2f
/* Of a sheet with pores: how much faster these drink than what lies between them, and what part
 * of a fiber is a pore that drinks as the stock says. All else counts little beside them: with
 * single fibers ink ran out in teeth one fiber wide, with clouds it had a smooth front where
 * the sheet as a whole drinks fast. */
#define PORES_DRINK 0.40f
#define PORES_EVEN 0.75f
#define PORES_REST 0.08f

/* Deviation 1, mean 0, another at each call. */
static void white(CM_field_id_t d, CM_field_id_t bits)
{
    CM_u_random_1L(bits, RANDOM_BITS, 1ul << RANDOM_BITS);
    CM_f_u_float_2_2L(d, bits, RANDOM_BITS, KIT_F);
    kit_f_times(d, d, sqrt(12.0) / (1 << RANDOM_BITS));
    kit_f_plus(d, d, -0.5 * sqrt(12.0));
}

/* d += what is `distance` up the axis. */
static void join(CM_field_id_t d, CM_field_id_t far, unsigned axis, int distance)
{
    kit_f_next(far, d, axis);
    for (int step = 1; step < distance; step++)
        kit_f_next(far, far, axis);
    kit_f_add(d, d, far);
}

/* Averages of `length` (to the next power of two) neighbours, deviation kept. */
static void smear(CM_field_id_t d, CM_field_id_t far, unsigned axis, int length)
{
    for (int distance = 1; distance < length; distance *= 2) {
        join(d, far, axis, distance);
        kit_f_times(d, d, sqrt(0.5));
    }
}

/* The deviation of `boxes` boxes after each other along one axis: the root of the sum of
 * squares of the weights. */
static double bell_gain(int length, int boxes)
{
    double weights[512] = {1}, sum = 0;
    int count = 1;
    for (int box = 0; box < boxes; box++)
        for (int distance = 1; distance < length; distance *= 2) {
            for (int i = count - 1; i >= 0; i--)
                weights[i + distance] += weights[i];
            count += distance;
        }
    for (int i = 0; i < count; i++)
        sum += weights[i] * weights[i];
    return sqrt(sum);
}

enum { BELL_BOXES = 3, BELL_LONGEST = 64 };

/* Noise smoothed by a bell about `length` wide on both axes. */
static void bell(struct paper_sheet *p, CM_field_id_t d, double length)
{
    int box = 1;
    while (box < length / 2 && box < BELL_LONGEST)
        box *= 2;
    white(d, p->t[7]);
    for (int i = 0; i < BELL_BOXES; i++)
        for (int distance = 1; distance < box; distance *= 2)
            for (unsigned axis = 0; axis < 2; axis++)
                join(d, p->t[6], axis, distance);
    double gain = bell_gain(box, BELL_BOXES);
    kit_f_times(d, d, 1 / (gain * gain));
}

static void hills_make(struct paper_sheet *p, CM_field_id_t hills)
{
    double length = p->config.stock.grain_px, part = 1, squares = 0;
    kit_f_set(hills, 0.0);
    for (int octave = 0; octave < 3; octave++) {
        bell(p, p->t[5], length);
        kit_f_times(p->t[5], p->t[5], part);
        kit_f_add(hills, hills, p->t[5]);
        squares += part * part;
        length /= 2;
        part /= 2;
    }
    kit_f_times(hills, hills, 1 / sqrt(squares));
}

static void fibers_make(struct paper_sheet *p, CM_field_id_t fibers)
{
    const int *length = p->config.stock.fiber_length;
    white(fibers, p->t[7]);
    smear(fibers, p->t[6], KIT_AXIS_X, length[0]);
    white(p->t[5], p->t[7]);
    smear(p->t[5], p->t[6], KIT_AXIS_Y, length[1]);
    kit_f_add(fibers, fibers, p->t[5]);
    white(p->t[5], p->t[7]);
    kit_f_times(p->t[5], p->t[5], 0.5);
    kit_f_add(fibers, fibers, p->t[5]);
    kit_f_times(fibers, fibers, 1 / 1.5);
}

/* A field within low..high. */
static void keep(CM_field_id_t d, double low, double high)
{
    kit_f_least(d, d, low);
    kit_f_most(d, d, high);
}

/* What pigments lie on, from display values: in linear light for Kubelka-Munk. The square of
 * display values is near enough to it for variations of some percent about the colour
 * itself. */
static void color_make(struct paper_sheet *p, CM_field_id_t shade)
{
    const struct paper_stock *stock = &p->config.stock;
    bool linear = p->config.rule == PAPER_RULE_KUBELKA_MUNK;
    for (int i = 0; i < 3; i++) {
        double color = linear ? paper_light_linear(stock->color[i]) : stock->color[i];
        kit_f_times(p->substrate[i], shade, color * (linear ? 2 : 1));
        kit_f_plus(p->substrate[i], p->substrate[i], color);
        keep(p->substrate[i], 0, 1);
    }
}

/* All of a fiber is barred where there is no paper at all, and nothing of it where there is a
 * little. Uses t[0]. */
static void barred_make(struct paper_sheet *p)
{
    if (!p->config.deckled)
        return;
    kit_f_times(p->t[0], p->thickness, -SHEET_THIN_SCALE);
    kit_f_plus(p->t[0], p->t[0], 1.0);
    kit_f_least(p->t[0], p->t[0], 0.0);
    kit_f_max(p->barred, p->resist, p->t[0]);
}

void sheet_faces_make(struct paper_sheet *p)
{
    CM_field_id_t open = p->t[0], other = p->t[1];
    free(p->covers); /* of another thickness */
    p->covers = NULL;
    barred_make(p);
    kit_f_from(open, 1.0, p->barred);
    kit_f_least(open, open, 0.0);
    for (unsigned axis = 0; axis < 2; axis++) {
        bool x = axis == KIT_AXIS_X;
        kit_f_next(other, p->page.absorbency, axis);
        kit_f_add(other, other, p->page.absorbency);
        kit_f_times(other, other, p->config.stock.absorbency_along[x ? 0 : 1] / 2);
        kit_f_least(other, other, FACE_LEAST);
        kit_f_mul(p->face[axis], other, open);
        kit_f_next(other, open, axis);
        kit_f_mul(p->face[axis], p->face[axis], other);
        if (!p->config.torus) {
            CM_u_eq_constant_1L(x ? p->page.grid.x_coord : p->page.grid.y_coord,
                                (unsigned)(x ? p->page.grid.width : p->page.grid.height) - 1,
                                (unsigned)(x ? p->page.grid.x_bits : p->page.grid.y_bits));
            CM_logand_context_with_test();
            kit_f_set(p->face[axis], 0.0);
            CM_set_context();
        }
    }
    sheet_film_faces_make(p);
}

/* The thesis's page: two noises, of hills and of woven fibers. */
static void woven_make(struct paper_sheet *p, CM_field_id_t shade)
{
    const struct paper_stock *stock = &p->config.stock;
    CM_field_id_t hills = p->t[0], fibers = p->t[1];
    CM_initialize_random_generator((unsigned)(p->config.seed ^ p->config.seed >> 32));
    hills_make(p, hills);
    fibers_make(p, fibers);

    kit_f_times(p->height, hills, stock->roughness);
    kit_f_plus(p->height, p->height, 0.5);
    keep(p->height, 0, 1);
    kit_f_times(p->capacity, p->height, stock->capacity[1] - stock->capacity[0]);
    kit_f_plus(p->capacity, p->capacity, stock->capacity[0]);
    keep(p->capacity, 0.01, 1);

    kit_f_times(p->page.absorbency, fibers, stock->absorbency * stock->absorbency_variation);
    kit_f_plus(p->page.absorbency, p->page.absorbency, stock->absorbency);
    keep(p->page.absorbency, 0.15 * stock->absorbency, PAPER_ABSORBENCY_MAX);

    kit_f_times(shade, fibers, -0.03 * stock->color_variation);
    kit_f_times(p->t[3], hills, 0.08 * stock->color_variation * sqrt(stock->roughness));
    kit_f_add(shade, shade, p->t[3]);
}

/* d = line[0] + line[1] * values, within low..high. */
static void felt_write(struct paper_sheet *p, CM_field_id_t d, float *values,
                       const double line[2], double low, double high)
{
    size_t count = (size_t)p->page.grid.width * (size_t)p->page.grid.height;
    float base = (float)line[0], part = (float)line[1], least = (float)low, most = (float)high;
    for (size_t i = 0; i < count; i++) {
        float value = base + part * values[i];
        values[i] = value > least ? value < most ? value : most : least;
    }
    kit_grid_f_write(&p->page.grid, d, values);
}

/* d gets less where the sheet is thin, down to `least` of it. Uses t[3]. */
static void thinned(struct paper_sheet *p, CM_field_id_t d, double least)
{
    kit_f_times(p->t[3], p->thickness, 1 - least);
    kit_f_plus(p->t[3], p->t[3], least);
    kit_f_mul(d, d, p->t[3]);
}

/* A sheet with a deckle is lower, drinks slower and holds less where fewer fibers lie. */
static void thickness_heed(struct paper_sheet *p, float *thickness)
{
    kit_grid_f_write(&p->page.grid, p->thickness, thickness);
    thinned(p, p->height, THIN_HEIGHT);
    thinned(p, p->page.absorbency, THIN_DRINKS);
    thinned(p, p->capacity, 0);
    kit_f_least(p->capacity, p->capacity, 0.01);
}

/* How fast it drinks, in place of the size: of fibers, clouds and size; of pores, where the
 * sheet has them. */
static void drinks_make(struct felt *felt, size_t count)
{
    const float rest = felt->pores ? PORES_REST : 1;
    for (size_t i = 0; i < count; i++) {
        felt->sizing[i] =
            rest * (FIBERS_DRINK * felt->fibers[i] + CLOUDS_DRINK * felt->mass[i] -
                    SIZE_DRINKS_NOT * felt->sizing[i]);
        if (felt->pores)
            felt->sizing[i] += PORES_DRINK * (felt->pores[i] - PORES_EVEN);
    }
}

/* All comes from the same fibers. Where more of them lie, the sheet stands up, holds more and
 * drinks faster; where more size went in, slower. It is the fibers and the pores between them
 * that drink, more than their clouds: ink on unsized paper runs out in branches everywhere, and
 * not only where the sheet as a whole drinks little. */
static enum paper_status felted_make(struct paper_sheet *p, CM_field_id_t shade)
{
    const struct paper_stock *stock = &p->config.stock;
    struct felt felt;
    enum paper_status status = felt_make(&p->config, &felt);
    if (status != PAPER_OK)
        return status;
    size_t count = (size_t)p->page.grid.width * (size_t)p->page.grid.height;
    drinks_make(&felt, count);
    double mean = (stock->capacity[0] + stock->capacity[1]) / 2,
           span = (stock->capacity[1] - stock->capacity[0]) / 2;
    const double height[2] = {0.5, fmax(stock->roughness, felt.smeared ? SHEET_SMEARS : 0)},
                 drinks[2] = {stock->absorbency,
                              stock->absorbency * stock->absorbency_variation},
                 holds[2] = {mean, 0.4 * span}, looks[2] = {0, 0.01 * stock->color_variation};
    felt_write(p, p->height, felt.relief, height, 0, 1);
    felt_write(p, p->page.absorbency, felt.sizing, drinks, 0.15 * stock->absorbency,
               PAPER_ABSORBENCY_MAX);
    memcpy(felt.relief, felt.mass, count * sizeof *felt.mass);
    felt_write(p, p->capacity, felt.relief, holds, 0.01, 1);
    felt_write(p, shade, felt.mass, looks, -1, 1);
    if (felt.thickness)
        thickness_heed(p, felt.thickness);
    felt_free(&felt);
    return PAPER_OK;
}

enum paper_status sheet_stock_make(struct paper_sheet *p)
{
    CM_field_id_t shade = p->t[2];
    if (!p->config.parts) {
        woven_make(p, shade);
    } else {
        enum paper_status status = felted_make(p, shade);
        if (status != PAPER_OK)
            return status;
    }
    color_make(p, shade);
    sheet_faces_make(p);
    sheet_heights_changed(p);
    return PAPER_OK;
}
