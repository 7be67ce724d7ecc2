/* font_drawn.c - boxes, lines and gray pixels, as pictures of glyphs and filters have them: see
 * font_verb.h. */
#include "font_verb.h"
#include "lutetia.h"
#include "type_common.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void font_box_fill(struct display_image *image, double x0, double y0, double x1, double y1,
                   const uint8_t rgb[3])
{
    int c0 = (int)fmax(0, floor(x0 + 0.5)), c1 = (int)fmin(image->width_px, floor(x1 + 0.5));
    int r0 = (int)fmax(0, floor(y0 + 0.5)), r1 = (int)fmin(image->height_px, floor(y1 + 0.5));
    for (int r = r0; r < r1; r++)
        for (int c = c0; c < c1; c++)
            memcpy(image->pixels + 3 * ((size_t)r * (size_t)image->width_px + (size_t)c), rgb,
                   3);
}

/* Draws a line of some width through points, as type is drawn: as the outlines of its
 * pieces. */
enum font_status font_stroke_draw(struct display_image *image, const struct font_point *p,
                                  int count, double width, const double ink[3])
{
    struct font_outline o = {.units_per_em = 1};
    struct font_filter *filter = NULL;
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    enum font_status status = font_filter_create_named("gaussian-fast", &filter);
    for (int i = 0; i + 1 < count && status == FONT_OK; i++) {
        double dx = p[i + 1].x - p[i].x, dy = p[i + 1].y - p[i].y, length = hypot(dx, dy);
        if (length == 0)
            continue;
        double u = dx / length * width / 2, v = dy / length * width / 2;
        double x0 = p[i].x - u / 2, y0 = p[i].y - v / 2, x1 = p[i + 1].x + u / 2,
               y1 = p[i + 1].y + v / 2;
        status = font_outline_move(&o, x0 - v, y0 + u);
        if (status == FONT_OK)
            status = font_outline_line(&o, x1 - v, y1 + u);
        if (status == FONT_OK)
            status = font_outline_line(&o, x1 + v, y1 - u);
        if (status == FONT_OK)
            status = font_outline_line(&o, x0 + v, y0 - u);
    }
    struct font_map map = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}};
    if (status == FONT_OK)
        status = font_outline_prepare(&o, FONT_NONZERO);
    if (status == FONT_OK)
        status = font_edges_build(&edges, &o, &map, filter);
    if (status == FONT_OK)
        status = font_gray_draw(&gray, &edges, filter, 0, 0);
    for (int r = 0; status == FONT_OK && r < gray.height_px; r++)
        for (int c = 0; c < gray.width_px; c++) {
            int x = gray.left_px + c, y = gray.top_px + r;
            if (x < 0 || y < 0 || x >= image->width_px || y >= image->height_px)
                continue;
            double cover = gray.pixels[r * gray.pitch + c] / 255.0;
            uint8_t *to = image->pixels + 3 * ((size_t)y * (size_t)image->width_px + (size_t)x);
            for (int i = 0; i < 3; i++) {
                double light = font_light(to[i] / 255.0, 0);
                light += (font_light(ink[i], 0) - light) * cover;
                to[i] = (uint8_t)lrint(255 * font_number(light, 0));
            }
        }
    font_gray_finish(&gray);
    font_edges_finish(&edges);
    font_filter_destroy(filter);
    font_outline_finish(&o);
    return status;
}

/* Draws gray pixels enlarged. */
void font_gray_show(struct display_image *image, const struct font_gray *g, double x, double y,
                    int zoom)
{
    for (int r = 0; r < g->height_px; r++)
        for (int c = 0; c < g->width_px; c++) {
            double light = 1 - g->pixels[r * g->pitch + c] / 255.0;
            uint8_t v = (uint8_t)lrint(255 * font_number(light, 0)), rgb[3] = {v, v, v};
            font_box_fill(image, x + c * zoom, y + r * zoom, x + (c + 1) * zoom,
                          y + (r + 1) * zoom, rgb);
        }
}
