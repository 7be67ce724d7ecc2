/* exact.c - see exact.h. The picture is linear light, a float for each channel, until
 * everything is drawn. With alpha, which is the fourth, light is multiplied by it: what covers
 * a pixel then changes all channels in the same way, alpha as a light that is 1 in all ink. */
#include "exact.h"
#include "font_axes.h"

#include <gray.h>
#include <paint.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TO_NUMBER = 4096, TO_LIGHT = 16 * 255 };

struct stage_exact {
    struct font_painter *painter;
    struct font_edges edges;
    struct font_gray gray;
    float *light;
    size_t light_count;
    uint8_t to_number[TO_NUMBER +
                      1]; /* indexed by the root of light, so that dark numbers have as many
                           * entries as light ones */
    float to_light[TO_LIGHT + 1]; /* of an image's numbers */
    int left_out;
};

enum stage_status stage_exact_create(const char *filter, struct stage_exact **out)
{
    *out = NULL;
    struct stage_exact *e = calloc(1, sizeof *e);
    if (!e)
        return stage_fail(STAGE_NO_MEMORY, "no memory to draw exactly");
    struct font_painter_def def = font_painter_def_default();
    def.filter = filter;
    if (font_painter_create(&def, &e->painter) != FONT_OK) {
        free(e);
        return stage_fail(STAGE_BAD_ARGUMENT, "%s", font_error());
    }
    for (int i = 0; i <= TO_NUMBER; i++) {
        double root = (double)i / TO_NUMBER;
        e->to_number[i] = (uint8_t)lrint(255 * font_number(root * root, 0));
    }
    for (int i = 0; i <= TO_LIGHT; i++)
        e->to_light[i] = (float)font_light((double)i / TO_LIGHT, 0);
    *out = e;
    return STAGE_OK;
}

void stage_exact_destroy(struct stage_exact *e)
{
    if (!e)
        return;
    font_painter_destroy(e->painter);
    font_edges_finish(&e->edges);
    font_gray_finish(&e->gray);
    free(e->light);
    free(e);
}

int stage_exact_left_out(const struct stage_exact *e)
{
    return e->left_out;
}

/* ---- light ---- */

static void light_of(struct stage_color color, float light[4])
{
    light[0] = (float)font_light((double)color.r, 0);
    light[1] = (float)font_light((double)color.g, 0);
    light[2] = (float)font_light((double)color.b, 0);
    light[3] = 1;
}

static void gray_blend(struct stage_exact *e, const struct font_gray *gray, int x, int y,
                       struct stage_color color, const struct display_image *image)
{
    const int channels = image->channels;
    float ink[4];
    int left = x + gray->left_px, top = y + gray->top_px;
    int column = left < 0 ? -left : 0, row = top < 0 ? -top : 0;
    int columns =
        gray->width_px < image->width_px - left ? gray->width_px : image->width_px - left;
    int rows =
        gray->height_px < image->height_px - top ? gray->height_px : image->height_px - top;
    light_of(color, ink);
    for (int r = row; gray->pixels && r < rows; r++) {
        const uint8_t *from = gray->pixels + (size_t)r * (size_t)gray->pitch;
        float *to = e->light + channels * ((ptrdiff_t)(top + r) * image->width_px + left);
        for (int c = column; c < columns; c++) {
            float cover = (float)from[c] * (1 / 255.0f) * color.a;
            for (int i = 0; from[c] && i < channels; i++)
                to[channels * c + i] += (ink[i] - to[channels * c + i]) * cover;
        }
    }
}

/* ---- bars as outlines ---- */

/* Draws a box with round corners around (x, y), turned. */
static enum font_status contour_add(struct font_outline *o, const struct stage_bar *b, double x,
                                    double y, double grow)
{
    /* This cubic is a quarter of a circle, to 3e-4 of its radius. */
    const double arc = 0.5522847498;
    static const int quarter[4][4] = {/* corner, and the direction in which it is traversed */
                                      {1, -1, 0, 1},
                                      {1, 1, -1, 0},
                                      {-1, 1, 0, -1},
                                      {-1, -1, 1, 0}};
    double l = b->half_length_px + grow, w = b->half_width_px + grow;
    double r = fmax(0, fmin(b->radius_px + grow, fmin(l, w)));
    enum font_status status = FONT_OK;
    for (int k = 0; k < 4 && status == FONT_OK; k++) {
        double cx = quarter[k][0] * (l - r), cy = quarter[k][1] * (w - r);
        double ax = quarter[k][3] ? 0 : quarter[k][0], ay = quarter[k][3] ? quarter[k][1] : 0;
        double bx = ax != 0 ? 0 : quarter[k][0], by = ay != 0 ? 0 : quarter[k][1];
        double p[4][2] = {{cx + r * ax, cy + r * ay},
                          {cx + r * (ax + arc * bx), cy + r * (ay + arc * by)},
                          {cx + r * (bx + arc * ax), cy + r * (by + arc * ay)},
                          {cx + r * bx, cy + r * by}};
        double q[4][2];
        for (int i = 0; i < 4; i++) {
            q[i][0] = x + p[i][0] * b->ux - p[i][1] * b->uy;
            q[i][1] = y + p[i][0] * b->uy + p[i][1] * b->ux;
        }
        status =
            k ? font_outline_line(o, q[0][0], q[0][1]) : font_outline_move(o, q[0][0], q[0][1]);
        if (status == FONT_OK && r > 0)
            status =
                font_outline_cubic(o, q[1][0], q[1][1], q[2][0], q[2][1], q[3][0], q[3][1]);
    }
    return status == FONT_OK ? font_outline_close(o) : status;
}

/* Clips the bar's length to the picture: its middle line against the picture with a margin.
 * False: it is not visible. */
static bool bar_clip(struct stage_bar *b, const struct display_image *image)
{
    double margin = b->half_width_px + b->radius_px + b->ring_px + 16;
    double least = -b->half_length_px, most = b->half_length_px;
    const double at[2] = {b->x_px, b->y_px}, along[2] = {b->ux, b->uy};
    const double size[2] = {image->width_px, image->height_px};
    for (int i = 0; i < 2; i++) {
        double low = -margin - at[i], high = size[i] + margin - at[i];
        if (fabs(along[i]) < 1e-12) {
            if (low > 0 || high < 0)
                return false;
            continue;
        }
        double t0 = low / along[i], t1 = high / along[i];
        least = fmax(least, fmin(t0, t1));
        most = fmin(most, fmax(t0, t1));
    }
    if (!(most >= least))
        return false;
    b->x_px += b->ux * (least + most) / 2;
    b->y_px += b->uy * (least + most) / 2;
    b->half_length_px = (most - least) / 2;
    return true;
}

static enum font_status bar_draw(struct stage_exact *e, struct stage_bar bar,
                                 struct stage_color color, struct display_image *image)
{
    static const struct font_map same = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}};
    struct font_outline o = {0};
    if (!bar_clip(&bar, image))
        return FONT_OK;
    double whole_x = floor(bar.x_px), whole_y = floor(bar.y_px);
    double x = bar.x_px - whole_x, y = bar.y_px - whole_y;
    enum font_status status = contour_add(&o, &bar, x, y, bar.ring_px / 2);
    if (status == FONT_OK && bar.ring_px > 0 &&
        fmin(bar.half_length_px, bar.half_width_px) > bar.ring_px / 2)
        status = contour_add(&o, &bar, x, y, -bar.ring_px / 2);
    o.units_per_em = 1;
    if (status == FONT_OK)
        status = font_outline_prepare(&o, FONT_EVEN_ODD);
    if (status == FONT_OK)
        status = font_edges_build(&e->edges, &o, &same, font_painter_filter(e->painter));
    if (status == FONT_OK)
        status = font_gray_draw(&e->gray, &e->edges, font_painter_filter(e->painter), 0, 0);
    if (status == FONT_OK)
        gray_blend(e, &e->gray, (int)whole_x, (int)whole_y, color, image);
    font_outline_finish(&o);
    return status;
}

/* ---- the picture ---- */

static enum font_status glyph_draw(struct stage_exact *e, const struct stage_glyph *g,
                                   struct stage_color color, struct display_image *image)
{
    const struct font_gray *gray;
    struct stage_letter_axes before;
    double x = floor(g->x_px), y = floor(g->y_px);
    stage_letter_axes_put(g->face, &g->axes, &before);
    enum font_status status = font_painter_glyph(e->painter, g->face, g->glyph, g->size_px,
                                                 &g->map, g->x_px - x, g->y_px - y, &gray);
    stage_letter_axes_put(g->face, &before, NULL);
    if (status == FONT_OK)
        gray_blend(e, gray, (int)x, (int)y, color, image);
    return status;
}

/* Between the middles of its pixels an image is linear in sRGB's numbers, as OpenGL's textures
 * are; at its edges it goes on. */
static void image_draw(struct stage_exact *e, const struct stage_image *i,
                       const struct display_image *image)
{
    const double across = i->width / (i->x1_px - i->x0_px),
                 down = i->height / (i->y1_px - i->y0_px);
    if (!isfinite(across) || !isfinite(down))
        return;
    const int x0 = (int)fmax(0, ceil(i->x0_px - 0.5)), y0 = (int)fmax(0, ceil(i->y0_px - 0.5)),
              x1 = (int)fmin(image->width_px, ceil(i->x1_px - 0.5)),
              y1 = (int)fmin(image->height_px, ceil(i->y1_px - 0.5));
    for (int y = y0; y < y1; y++) {
        const double v = fmin(fmax((y + 0.5 - i->y0_px) * down - 0.5, 0), i->height - 1);
        const int row = (int)v, next_row = row + 1 < i->height ? row + 1 : row;
        for (int x = x0; x < x1; x++) {
            const double u = fmin(fmax((x + 0.5 - i->x0_px) * across - 0.5, 0), i->width - 1);
            const int column = (int)u, next = column + 1 < i->width ? column + 1 : column;
            const double a = u - column, b = v - row;
            float *to = e->light + (size_t)image->channels *
                                       ((size_t)y * (size_t)image->width_px + (size_t)x);
            for (int c = 0; c < 3; c++) {
#define AT(x_, y_) i->rgb[3 * ((size_t)(y_) * (size_t)i->width + (size_t)(x_)) + (size_t)c]
                const double number =
                    (1 - b) * ((1 - a) * AT(column, row) + a * AT(next, row)) +
                    b * ((1 - a) * AT(column, next_row) + a * AT(next, next_row));
#undef AT
                to[c] = e->to_light[(int)(number * (TO_LIGHT / 255) + 0.5)];
            }
            if (image->channels == 4)
                to[3] = 1;
        }
    }
}

static uint8_t number_of(const struct stage_exact *e, float light)
{
    return e->to_number[(int)(sqrtf(fminf(1, fmaxf(0, light))) * TO_NUMBER + 0.5f)];
}

static void numbers_put(const struct stage_exact *e, struct display_image *image)
{
    const size_t pixels = (size_t)image->width_px * (size_t)image->height_px;
    for (size_t i = 0; image->channels == 3 && i < 3 * pixels; i++)
        image->pixels[i] = number_of(e, e->light[i]);
    for (size_t i = 0; image->channels == 4 && i < pixels; i++) {
        const float *light = e->light + 4 * i, alpha = fminf(1, light[3]);
        for (size_t c = 0; c < 3; c++)
            image->pixels[4 * i + c] = alpha > 0 ? number_of(e, light[c] / alpha) : 0;
        image->pixels[4 * i + 3] = (uint8_t)lrintf(255 * fmaxf(0, alpha));
    }
}

enum stage_status stage_exact_draw(struct stage_exact *e, const struct stage_draw_list *list,
                                   struct stage_color background, struct display_image *image)
{
    const size_t channels = (size_t)image->channels,
                 count = (size_t)image->width_px * (size_t)image->height_px * channels;
    float behind[4];
    e->left_out = 0;
    if (list->incomplete)
        return stage_fail(STAGE_NO_MEMORY, "no memory for all that is to be drawn");
    if (count > e->light_count) {
        free(e->light);
        e->light = malloc(count * sizeof *e->light);
        e->light_count = e->light ? count : 0;
        if (!e->light)
            return stage_fail(STAGE_NO_MEMORY, "no memory for a picture of %dx%d pixels",
                              image->width_px, image->height_px);
    }
    light_of(background, behind);
    for (int c = 0; channels == 4 && c < 4; c++)
        behind[c] *= background.a;
    for (size_t i = 0; i < count; i++)
        e->light[i] = behind[i % channels];
    for (int i = 0; i < list->count; i++) {
        const struct stage_item *item = &list->items[i];
        enum font_status status = FONT_OK;
        if (item->kind == STAGE_DRAW_BAR)
            status = bar_draw(e, item->bar, item->color, image);
        else if (item->kind == STAGE_DRAW_GLYPH)
            status = glyph_draw(e, &item->glyph, item->color, image);
        else
            image_draw(e, &item->image, image);
        if (status == FONT_NO_MEMORY)
            return stage_fail(STAGE_NO_MEMORY, "%s", font_error());
        e->left_out += status != FONT_OK;
    }
    numbers_put(e, image);
    return STAGE_OK;
}
