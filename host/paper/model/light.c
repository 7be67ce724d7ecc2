/* light.c - light on a sheet: on the paper's relief, and on the water that stands on it.
 *
 * The relief's shade follows from the heights alone. It is made when a lit picture is first
 * asked for, on the front end, and kept as a field until the heights change:
 *
 *     two lights    the key light from the upper left, a weaker one from the lower left: a
 *                   slope that faces a light gets more of it, h(x+1) - h(x-1) along each axis
 *     occlusion     hollows see less of the sky than hills: the height, less its mean over
 *                   wider and wider neighbourhoods
 *
 *     h ---> [1 2 1] ---> [1 . 2 . 1] ---> [1 . . . 2 . . . 1]        along x, then along y
 *        |            |                |                    |
 *        +- h - a1 ---+--- a1 - a2 ----+----- a2 - a3 ------+---> times OCCLUSION[], summed
 *
 * Slopes alone have a direction: what lies along the light is not seen, and all papers look
 * combed across it. The weights of the occlusion grow with the frequency as slopes do, so that
 * in each band relief of every direction is seen, and the lights still say which side is up.
 * The gain is the same for all bare stocks: smooth paper looks smooth. All distances are in
 * fibers of the stock's own scale, so a sheet that is drawn anew finer is lit in the same way.
 *
 * Source: Burt and Adelson, IEEE Trans. Communications 31 (1983), differences of means over
 * wider and wider neighbourhoods. */
#include "model/felt.h"
#include "model/model.h"

#include <math.h>
#include <stdlib.h>

/* Light from the key light, of strength 1, on a slope of 1; from the second one; and what
 * occlusion takes or gives. */
#define KEY 0.20
#define SECOND 0.075
#define SCALES 3
static const double occlusion[SCALES] = {0.34, 0.28, 0.22};
/* Of a film without fibers the heights are smears and dust: what they count where it is
 * bare. */
#define SMEARS_BARE 0.12
/* Dried paint is rougher than smooth paper, and stands up along its fibers and smears: where it
 * lies heights count the more, the less the stock's roughness is below this. Units of paint
 * from which a fiber is painted. */
#define PAINT_ROUGHNESS 0.25
#define SMOOTHEST 0.04
#define PAINTED_FROM 0.2
/* Depth of water, units, that hides the relief below it. */
#define RELIEF_HIDDEN 0.3

/* One sheet's heights on the front end. Shape of the arrays: height x width. */
struct heights {
    int width, height;
    bool torus;
    float *level, *wider, *spare; /* the heights or a mean of them; a wider mean */
    float *shade;
};

/* to = means of three of `from` along x that are `distance` apart, the middle one counted
 * twice. */
static void means_along_x(const struct heights *of, const float *from, float *to, int distance)
{
    const int width = of->width, whole = width - 2 * distance;
    for (int y = 0; y < of->height; y++) {
        const float *row = from + (size_t)y * (size_t)width;
        float *means = to + (size_t)y * (size_t)width;
        for (int i = 0; i < whole; i++) {
            const float *at = row + i;
            means[i + distance] = 0.5f * at[distance] + 0.25f * (at[0] + at[2 * distance]);
        }
        for (int x = 0; x < width; x++) {
            if (x == distance && whole > 0)
                x += whole;
            means[x] = 0.5f * row[x] +
                       0.25f * (row[sheet_place_beside(x, -distance, width, of->torus)] +
                                row[sheet_place_beside(x, distance, width, of->torus)]);
        }
    }
}

/* The same along y. */
static void means_along_y(const struct heights *of, const float *from, float *to, int distance)
{
    const size_t width = (size_t)of->width;
    for (int y = 0; y < of->height; y++) {
        const float *row = from + (size_t)y * width,
                    *above =
                        from +
                        (size_t)sheet_place_beside(y, -distance, of->height, of->torus) * width,
                    *below =
                        from +
                        (size_t)sheet_place_beside(y, distance, of->height, of->torus) * width;
        float *means = to + (size_t)y * width;
        for (size_t x = 0; x < width; x++)
            means[x] = 0.5f * row[x] + 0.25f * (above[x] + below[x]);
    }
}

/* shade = what the two lights give to slopes, over `distance` fibers each way. */
static void lights_shade(const struct heights *of, int distance)
{
    const size_t width = (size_t)of->width;
    const float along_x = (float)(KEY + SECOND), along_y = (float)(KEY - SECOND);
    for (int y = 0; y < of->height; y++) {
        const float *row = of->level + (size_t)y * width,
                    *above =
                        of->level +
                        (size_t)sheet_place_beside(y, -distance, of->height, of->torus) * width,
                    *below =
                        of->level +
                        (size_t)sheet_place_beside(y, distance, of->height, of->torus) * width;
        float *shade = of->shade + (size_t)y * width;
        for (int x = 0; x < of->width; x++)
            shade[x] = along_x * (row[sheet_place_beside(x, distance, of->width, of->torus)] -
                                  row[sheet_place_beside(x, -distance, of->width, of->torus)]) +
                       along_y * (below[x] - above[x]);
    }
}

/* shade += what hollows do not get and hills do. The level is lost. */
static void occlusion_shade(struct heights *of, int distance)
{
    const size_t count = (size_t)of->width * (size_t)of->height;
    for (int scale = 0; scale < SCALES; scale++) {
        const float weight = (float)occlusion[scale];
        means_along_x(of, of->level, of->spare, distance << scale);
        means_along_y(of, of->spare, of->wider, distance << scale);
        for (size_t i = 0; i < count; i++)
            of->shade[i] += weight * (of->level[i] - of->wider[i]);
        float *const level = of->level;
        of->level = of->wider;
        of->wider = level;
    }
}

/* What the heights count where the stock is bare, and where it is painted. */
static double seen_bare(const struct paper_stock *stock)
{
    return felt_has_fibers(stock) ? 1
                                  : fmax(SMEARS_BARE, fmin(1, stock->roughness / SHEET_SMEARS));
}

static double seen_painted(const struct paper_stock *stock)
{
    return fmax(1, sqrt(PAINT_ROUGHNESS / fmax(SMOOTHEST, stock->roughness)));
}

enum paper_status sheet_relief_make(struct paper_sheet *p)
{
    if (p->relief_made)
        return PAPER_OK;
    struct heights of = {
        .width = p->page.grid.width, .height = p->page.grid.height, .torus = p->config.torus};
    const size_t count = (size_t)of.width * (size_t)of.height;
    float *all = malloc(4 * count * sizeof *all);
    if (!all)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a picture of %dx%d", of.width,
                          of.height);
    of.level = all;
    of.wider = all + count;
    of.spare = all + 2 * count;
    of.shade = all + 3 * count;
    const int distance = (int)fmax(1, round(p->finer));
    kit_grid_f_read(&p->page.grid, of.level, p->height);
    lights_shade(&of, distance);
    occlusion_shade(&of, distance);
    kit_grid_f_write(&p->page.grid, p->relief, of.shade);
    free(all);
    p->relief_made = true;
    return PAPER_OK;
}

/* light becomes what is seen of it on a smooth stock: more where it is painted. Uses t[1]. */
static void paint_heed(struct paper_sheet *p, CM_field_id_t light)
{
    CM_field_id_t seen = p->t[1];
    const double bare = seen_bare(&p->config.stock),
                 more = seen_painted(&p->config.stock) - bare;
    if (!p->config.parts || more <= 0)
        return;
    sheet_paint_sum(p, seen);
    kit_f_times(seen, seen, more / (PAINTED_FROM * p->unit));
    kit_f_most(seen, seen, more);
    kit_f_plus(seen, seen, bare);
    kit_f_mul(light, light, seen);
}

/* Uses t[0..1]. */
void sheet_relief_light(struct paper_sheet *p, const CM_field_id_t color[3], double strength)
{
    CM_field_id_t light = p->t[0], dry = p->t[1];
    kit_f_times(light, p->relief, strength);
    paint_heed(p, light);
    if (sheet_has(p, PAPER_PART_SURFACE)) {
        kit_f_times(dry, p->surface_water, -1 / (RELIEF_HIDDEN * p->unit));
        kit_f_plus(dry, dry, 1.0);
        kit_f_least(dry, dry, 0.0);
        kit_f_mul(light, light, dry);
    }
    kit_f_plus(light, light, 1.0);
    kit_f_least(light, light, 0.2);
    for (int i = 0; i < 3; i++)
        kit_f_mul(color[i], color[i], light);
}

/* d = the neighbour's level; at the edge of a sheet that is no torus one's own. */
static void level_beside(struct paper_sheet *p, CM_field_id_t d, CM_field_id_t level,
                         unsigned axis, bool next)
{
    if (next)
        kit_f_next(d, level, axis);
    else
        kit_f_previous(d, level, axis);
    if (p->config.torus)
        return;
    sheet_end_narrow(p, axis, next);
    kit_f_copy(d, level);
    CM_set_context();
}

/* Light on the water's surface: where it falls away to the upper left it shines, on the other
 * side it is darker; wet paper is a little darker too. Uses t[0..2]. */
void sheet_water_shine(struct paper_sheet *p, const CM_field_id_t color[3])
{
    CM_field_id_t slope = p->t[0], level = p->t[1], other = p->t[2];
    kit_f_times(level, p->surface_water, 1 / p->unit);
    kit_f_most(level, level, 2.0);
    kit_f_set(slope, 0.0);
    for (unsigned axis = 0; axis < 2; axis++) {
        level_beside(p, other, level, axis, true);
        kit_f_add(slope, slope, other);
        level_beside(p, other, level, axis, false);
        kit_f_sub(slope, slope, other);
    }
    kit_f_times(slope, slope, 0.8);
    kit_f_least(slope, slope, -0.25);
    kit_f_most(slope, slope, 0.6);
    kit_f_most(other, level, 0.5);
    kit_f_times(other, other, -0.25);
    kit_f_plus(other, other, 1.0);
    for (int i = 0; i < 3; i++) {
        kit_f_mul(color[i], color[i], other);
        kit_f_add(color[i], color[i], slope);
    }
}
