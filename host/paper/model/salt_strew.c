/* salt_strew.c - grains of salt strewn on wet paint; salt_spread.c has what they do there. */
#include "model/model.h"
#include "techniques.h"

#include "model/brush_internal.h"

#include <math.h>
#include <stdlib.h>

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

static void grain_add(float *salt, int width, int height, double x, double y, double radius)
{
    int x1 = (int)fmax(0, floor(x - radius - 1)), x2 = (int)fmin(width, ceil(x + radius + 1));
    int y1 = (int)fmax(0, floor(y - radius - 1)), y2 = (int)fmin(height, ceil(y + radius + 1));
    for (int row = y1; row < y2; row++)
        for (int column = x1; column < x2; column++) {
            double inside = radius + 0.5 - hypot(column + 0.5 - x, row + 0.5 - y);
            float *at = &salt[(size_t)row * (size_t)width + (size_t)column];
            *at = fmaxf(*at, (float)fmin(1, fmax(0, inside)));
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
        double away = s->radius * sqrt(sheet_chance(s->seed, number, 1));
        double angle = 2 * 3.141592653589793 * sheet_chance(s->seed, number, 2);
        double x = s->x + away * cos(angle), y = s->y + away * sin(angle);
        double large = sheet_chance(s->seed, number, 3);
        if (place_gray(&s->place, x, y) > 0.5)
            grain_add(salt, width, height, x, y,
                      s->size[0] + (s->size[1] - s->size[0]) * large * large);
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
