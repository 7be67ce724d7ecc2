/* salt_strew.c - grains of salt strewn on wet paint; salt_spread.c has what they do there. */
#include "model/model.h"
#include "techniques.h"

#include "model/brush_internal.h"
#include "model/clouds.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define THICK_MOST 4.0 /* as a layer of salt has it */

/* A grain that falls on the sheet: where, how large, and by what chance it breaks. */
struct grain {
    double x, y, radius;
    uint64_t seed;
    const struct paper_place *place;
    float *salt; /* on the sheet, width x height */
    int width, height;
    double finer; /* the sheet, than its stock */
};

static double place_gray(const struct paper_place *place, double x, double y)
{
    const struct paper_screen *screen = place->screen;
    if (!screen)
        return 1;
    double column = floor(x) - place->x, row = floor(y) - place->y;
    if (!(column >= 0 && row >= 0 && column < screen->width_px && row < screen->height_px))
        return 0;
    return screen->gray[(size_t)row * (size_t)screen->width_px + (size_t)column] / 255.0;
}

/* A crystal as it lies: a block, turned by chance. */
struct crystal {
    double x, y, half[2], turn[2]; /* half its sides; cosine and sine */
};

/* As thick as it is wide, in the stock's fibers: it slopes to its sides, and dissolves from
 * them. */
static void crystal_add(const struct grain *g, const struct crystal *of)
{
    const double far = hypot(of->half[0], of->half[1]) + g->finer;
    int x1 = (int)fmax(0, floor(of->x - far)), x2 = (int)fmin(g->width, ceil(of->x + far));
    int y1 = (int)fmax(0, floor(of->y - far)), y2 = (int)fmin(g->height, ceil(of->y + far));
    for (int row = y1; row < y2; row++)
        for (int column = x1; column < x2; column++) {
            const double x = column + 0.5 - of->x, y = row + 0.5 - of->y,
                         u = fabs(x * of->turn[0] + y * of->turn[1]),
                         v = fabs(y * of->turn[0] - x * of->turn[1]);
            const double inside = fmin(of->half[0] - u, of->half[1] - v) / g->finer + 0.5;
            float *at = &g->salt[(size_t)row * (size_t)g->width + (size_t)column];
            *at = fmaxf(*at, (float)fmin(THICK_MOST, fmax(0, inside)));
        }
}

/* With the area of a disc of that radius. */
static struct crystal crystal_of(uint64_t seed, double x, double y, double radius)
{
    const double half = sqrt(PI) / 2 * radius, longer = 1 + 0.3 * sheet_chance(seed, 0, 1),
                 angle = PI / 2 * sheet_chance(seed, 0, 2);
    return (struct crystal){x, y, {half * longer, half / longer}, {cos(angle), sin(angle)}};
}

/* A crystal breaks when it falls: crumbs lie beside it, and the brine of all of them has no
 * round rim. */
static void grain_add(const struct grain *g)
{
    const struct crystal whole = crystal_of(g->seed, g->x, g->y, g->radius);
    const int crumbs = 3 + (int)(4 * sheet_chance(g->seed, 1, 0));
    crystal_add(g, &whole);
    for (int i = 0; i < crumbs; i++) {
        const uint64_t number = (uint64_t)i;
        const double angle = 2 * PI * sheet_chance(g->seed, 2, number),
                     away = g->radius * (1.5 + 5.5 * sheet_chance(g->seed, 3, number)),
                     x = g->x + away * cos(angle), y = g->y + away * sin(angle),
                     radius = g->radius * (0.2 + 0.25 * sheet_chance(g->seed, 4, number));
        const struct crystal crumb = crystal_of(g->seed + number + 1, x, y, radius);
        if (place_gray(g->place, x, y) > 0.5)
            crystal_add(g, &crumb);
    }
}

enum paper_status sheet_salt_check(const struct paper_sheet *p, const void *arguments)
{
    const struct paper_salt *s = arguments;
    if (!(s->size[1] >= s->size[0]))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "salt's most size must be %g or more, its least (got %g)", s->size[0],
                          s->size[1]);
    if (p->config.parts == 0)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "the thesis's paper takes no salt; choose a paper with parts");
    return sheet_place_check(&s->place);
}

enum paper_status sheet_salt(struct paper_sheet *p, const void *arguments)
{
    const struct paper_salt *s = arguments;
    int width = p->page.grid.width, height = p->page.grid.height;
    size_t count = (size_t)width * (size_t)height;
    float *salt = malloc(count * sizeof *salt);
    if (!salt)
        return paper_fail(PAPER_NO_MEMORY, "no memory for salt");
    enum paper_status status = sheet_layer_read(p, PAPER_LAYER_SALT, 0, salt);
    for (int i = 0; i < s->grains && status == PAPER_OK; i++) {
        uint64_t number = (uint64_t)i;
        const double away = s->radius * sqrt(sheet_chance(s->seed, number, 1)),
                     angle = 2 * PI * sheet_chance(s->seed, number, 2),
                     large = sheet_chance(s->seed, number, 3);
        const struct grain grain = {.x = s->x + away * cos(angle),
                                    .y = s->y + away * sin(angle),
                                    .radius =
                                        s->size[0] + (s->size[1] - s->size[0]) * large * large,
                                    .seed = clouds_word(s->seed, number),
                                    .place = &s->place,
                                    .salt = salt,
                                    .width = width,
                                    .height = height,
                                    .finer = p->finer};
        if (place_gray(&s->place, grain.x, grain.y) > 0.5)
            grain_add(&grain);
    }
    if (status == PAPER_OK)
        status = sheet_layer(p, &(struct event_layer){PAPER_LAYER_SALT, 0, salt});
    free(salt);
    if (status == PAPER_OK) {
        p->salt_reach = s->reach;
        p->salt_strength = s->strength;
    }
    return status;
}
