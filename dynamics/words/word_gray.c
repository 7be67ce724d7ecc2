/* word_gray.c - see word_gray.h. */
#include "word_gray.h"

#include <math.h>

#define LETTER_PX_LEAST 1.0 /* sizes at which a letter is asked for */
#define LETTER_PX_MOST 2000.0

void dyn_word_corners(const struct dyn_word *word, const struct dyn_network *n, int index,
                      const struct dyn_view *view, struct font_point to[4])
{
    static const int from[4] = {3, 2, 1, 0}; /* a quad begins at the lower left */
    double corners[4][2];
    dyn_word_quad(word, n, index, corners);
    for (int i = 0; i < 4; i++) {
        to[i].x = view->x + view->scale * corners[from[i]][0];
        to[i].y = view->y - view->scale * corners[from[i]][1];
    }
}

enum font_status dyn_word_gray(const struct dyn_word *word, int index,
                               const struct dyn_view *view, const struct font_point to[4],
                               struct font_painter *painter, const struct font_gray **gray)
{
    const struct dyn_letter *l = dyn_word_letter(word, index);
    const double px = fmin(fmax(view->scale * l->size, LETTER_PX_LEAST), LETTER_PX_MOST),
                 unit = px / l->size;
    struct font_map map;
    const enum font_status status = font_map_corners(FONT_SMOOTH, l->x0 * unit, -l->y1 * unit,
                                                     l->x1 * unit, -l->y0 * unit, to, &map);
    return status == FONT_OK
               ? font_painter_glyph(painter, l->face, l->glyph, px, &map, 0, 0, gray)
               : status;
}

void dyn_gray_over(const struct font_gray *gray, uint8_t *pixels, int x, int y, int width,
                   int height)
{
    const int left = gray->left_px - x, top = gray->top_px - y;
    const int x0 = left < 0 ? -left : 0,
              x1 = gray->width_px < width - left ? gray->width_px : width - left;
    for (int row = top < 0 ? -top : 0; row < gray->height_px && top + row < height; row++) {
        const uint8_t *from = gray->pixels + (size_t)row * (size_t)gray->pitch;
        uint8_t *to = pixels + (size_t)(top + row) * (size_t)width;
        for (int i = x0; i < x1; i++)
            to[left + i] = (uint8_t)(to[left + i] + (255 - to[left + i]) * from[i] / 255);
    }
}
