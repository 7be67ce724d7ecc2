/* ground.c - a sheet with a deckle as it lies on something: the ground around it, and the
 * sheet's shadow there.
 *
 *     light  \                        alpha   = 1 - (1 - thickness / OPAQUE)^2: the edge is so thin that the ground shows through
 *             \   ______sheet         shadow  = 1 - (1 - near) (1 - far): alpha, blurred and moved away from the light
 *      ________\_/      ~~~~ shadow   picture = alpha * sheet + (1 - alpha) * (1 - shadow) * ground, in linear light
 *
 * Both are made with one number a fiber and drawn finer as colours are (finer.c). The sheet's
 * colours go on where there is no paper, by the means of their neighbours: a paint's edge at
 * the sheet's edge does not get lighter when it is drawn finer. */
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHADES = 65535, BLURS = 3, SPREADS = 3 };
#define OPAQUE 0.55
/* Of the shadows: how dark, how far from the sheet, over how many fibers they fade. */
static const struct {
    double dark, away;
    int blur;
} shadows[] = {{0.34, 1.5, 1}, {0.30, 5, 4}};

static float opaque_of(float thickness)
{
    const float left = 1 - fminf(1, thickness / (float)OPAQUE);
    return 1 - left * left;
}

/* Means of 2 radius + 1 numbers that are `step` apart; beyond the ends there is nothing. `line`
 * has room for `count`. */
static void means_make(float *values, int count, size_t step, int radius, float *line)
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        line[i] = values[(size_t)i * step];
    for (int i = 0; i < radius && i < count; i++)
        sum += (double)line[i];
    for (int i = 0; i < count; i++) {
        if (i + radius < count)
            sum += (double)line[i + radius];
        if (i - radius - 1 >= 0)
            sum -= (double)line[i - radius - 1];
        values[(size_t)i * step] = (float)(sum / (2 * radius + 1));
    }
}

static void blur(float *values, int width, int height, int radius, float *line)
{
    for (int i = 0; i < BLURS; i++) {
        for (int y = 0; y < height; y++)
            means_make(values + (size_t)y * (size_t)width, width, 1, radius, line);
        for (int x = 0; x < width; x++)
            means_make(values + x, height, (size_t)width, radius, line);
    }
}

/* What is at x, y of an array, between its numbers; 0 beyond. */
static double between(const float *values, int width, int height, double x, double y)
{
    const int left = (int)floor(x), top = (int)floor(y);
    const double u = x - left, v = y - top;
    double sum = 0;
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            const int column = left + i, row = top + j;
            if (column >= 0 && row >= 0 && column < width && row < height)
                sum += (double)values[(size_t)row * (size_t)width + (size_t)column] *
                       (i ? u : 1 - u) * (j ? v : 1 - v);
        }
    return sum;
}

/* The thickness of each fiber. Owns: the caller frees it. */
static enum paper_status thickness_read(struct paper_sheet *p, float **out)
{
    *out = malloc((size_t)p->page.grid.width * (size_t)p->page.grid.height * sizeof **out);
    return *out ? sheet_layer_read(p, PAPER_LAYER_THICKNESS, 0, *out)
                : paper_fail(PAPER_NO_MEMORY, "no memory for a picture of %dx%d",
                             p->page.grid.width, p->page.grid.height);
}

/* covers: alpha, shadow and 0 of each fiber, as a picture. `opaque` becomes 1 - the light that
 * the ground gets. */
static bool covers_make(const struct paper_sheet *p, double light, float *opaque,
                        uint16_t *covers)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    const size_t count = (size_t)width * (size_t)height;
    float *blurred = malloc(count * sizeof *blurred), *lit = malloc(count * sizeof *lit),
          *line = malloc((size_t)(width > height ? width : height) * sizeof *line);
    const bool made = blurred && lit && line;
    for (size_t i = 0; made && i < count; i++) {
        lit[i] = 1;
        covers[3 * i] = (uint16_t)lroundf(SHADES * opaque[i]);
        covers[3 * i + 2] = 0;
    }
    for (size_t s = 0; made && s < sizeof shadows / sizeof *shadows; s++) {
        const double away = shadows[s].away * p->finer, dark = fmin(1, shadows[s].dark * light);
        memcpy(blurred, opaque, count * sizeof *blurred);
        blur(blurred, width, height, (int)lround(shadows[s].blur * p->finer), line);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                lit[(size_t)y * (size_t)width + (size_t)x] *=
                    (float)(1 - dark * between(blurred, width, height, x - away, y - away));
    }
    for (size_t i = 0; made && i < count; i++)
        covers[3 * i + 1] = (uint16_t)lroundf(SHADES * (1 - lit[i]));
    free(blurred);
    free(lit);
    free(line);
    return made;
}

static uint16_t shade_of(double linear)
{
    return (uint16_t)lround(SHADES * paper_light_display(fmin(1, fmax(0, linear))));
}

void sheet_ground_pixels(const struct paper_sheet_view *view, const uint16_t *covers,
                         size_t count, uint16_t *rgb)
{
    static const double usual[3] = PAPER_GROUND_USUAL;
    const double *ground = view->ground ? view->ground : usual;
    double linear[3];
    for (int i = 0; i < 3; i++)
        linear[i] = paper_light_linear(ground[i]);
    for (size_t i = 0; i < count; i++) {
        const double alpha = covers[3 * i] / (double)SHADES,
                     shadow = covers[3 * i + 1] / (double)SHADES,
                     hidden = alpha + (1 - alpha) * shadow;
        if (view->alpha)
            view->alpha[i] = (uint16_t)lround(SHADES * hidden);
        if (covers[3 * i] == SHADES)
            continue;
        for (size_t c = 3 * i; c < 3 * i + 3; c++) {
            const double sheet = alpha * paper_light_linear(rgb[c] / (double)SHADES);
            if (view->alpha) /* black is the shadow's colour */
                rgb[c] = shade_of(hidden > 0 ? sheet / hidden : 0);
            else
                rgb[c] = shade_of(sheet + (1 - hidden) * linear[c - 3 * i]);
        }
    }
}

static enum paper_status no_memory(int width, int height)
{
    return paper_fail(PAPER_NO_MEMORY, "no memory for a picture of %dx%d", width, height);
}

enum paper_status sheet_ground_covers(struct paper_sheet *p, double light,
                                      const uint16_t **covers)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    const size_t count = (size_t)width * (size_t)height;
    *covers = p->covers;
    if (p->covers && p->covers_light == light)
        return PAPER_OK;
    float *opaque;
    enum paper_status status = thickness_read(p, &opaque);
    if (!p->covers)
        p->covers = malloc(3 * count * sizeof *p->covers);
    for (size_t i = 0; status == PAPER_OK && i < count; i++)
        opaque[i] = opaque_of(opaque[i]);
    if (status == PAPER_OK &&
        !(p->covers && covers_make(p, light / PAPER_LIGHT_USUAL, opaque, p->covers)))
        status = no_memory(width, height);
    free(opaque);
    if (status != PAPER_OK) {
        free(p->covers);
        p->covers = NULL;
    }
    p->covers_light = light;
    *covers = p->covers;
    return status;
}

enum paper_status sheet_ground_lay(struct paper_sheet *p, const struct paper_sheet_view *view,
                                   uint16_t *rgb)
{
    const int width = p->page.grid.width, height = p->page.grid.height,
              scale = view->scale > 1 ? view->scale : 1;
    const size_t pixels = (size_t)width * (size_t)height * (size_t)scale * (size_t)scale;
    const uint16_t *covers;
    uint16_t *fine = NULL;
    enum paper_status status = sheet_ground_covers(p, view->light, &covers);
    if (status == PAPER_OK && scale > 1) {
        fine = malloc(3 * pixels * sizeof *fine);
        status = fine ? sheet_finer(covers, width, height, false, scale, fine)
                      : no_memory(width * scale, height * scale);
    }
    if (status == PAPER_OK)
        sheet_ground_pixels(view, scale > 1 ? fine : covers, pixels, rgb);
    free(fine);
    return status;
}

/* known[i] of fiber i: it has a colour. Those beside them get the mean of their four
 * neighbours', in pairs. */
static void spread_once(int width, int height, uint8_t *known, uint16_t *rgb)
{
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const size_t at = (size_t)y * (size_t)width + (size_t)x;
            const size_t beside[4] = {at - 1, at + 1, at - (size_t)width, at + (size_t)width};
            const bool there[4] = {x > 0, x + 1 < width, y > 0, y + 1 < height};
            unsigned sum[3] = {0}, count = 0;
            for (int i = 0; known[at] == 0 && i < 4; i++)
                if (there[i] && known[beside[i]] == 1) {
                    count++;
                    for (size_t c = 0; c < 3; c++)
                        sum[c] += rgb[3 * beside[i] + c];
                }
            for (size_t c = 0; count > 0 && c < 3; c++)
                rgb[3 * at + c] = (uint16_t)(sum[c] / count);
            if (count > 0)
                known[at] = 2; /* from the next turn on */
        }
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++)
        known[i] = known[i] != 0;
}

enum paper_status sheet_color_spread(struct paper_sheet *p, uint16_t *rgb)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    const size_t count = (size_t)width * (size_t)height;
    float *thickness;
    enum paper_status status = thickness_read(p, &thickness);
    uint8_t *known = malloc(count);
    if (status == PAPER_OK && !known)
        status = paper_fail(PAPER_NO_MEMORY, "no memory for a picture of %dx%d", width, height);
    for (size_t i = 0; status == PAPER_OK && i < count; i++)
        known[i] = thickness[i] > 0;
    for (int i = 0; status == PAPER_OK && i < SPREADS; i++)
        spread_once(width, height, known, rgb);
    free(thickness);
    free(known);
    return status;
}
