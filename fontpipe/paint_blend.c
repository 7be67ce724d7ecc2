/* paint_blend.c - a gray glyph onto a picture: see paint.h. */
#include "paint_internal.h"

#include <math.h>
#include <string.h>

/* The light of a colour, over the light that there is. */
static inline uint8_t mixed(const struct font_painter *p, uint8_t below, float ink, float cover)
{
    float light = p->to_light[below];
    light += (ink - light) * cover;
    return p->to_number[(int)(sqrtf(light) * TO_NUMBER + 0.5f)];
}

/* The part of a glyph's rows and columns that is on a picture; and where on it (0, 0) of the
 * glyph lies. */
struct window {
    int left, top, column, columns_end, row, rows_end;
};

static struct window window_of(const struct font_gray *gray, int x, int y, int width,
                               int height)
{
    struct window w = {.left = x + gray->left_px, .top = y + gray->top_px};
    if (!gray->pixels)
        return w;
    w.column = w.left < 0 ? -w.left : 0;
    w.row = w.top < 0 ? -w.top : 0;
    w.columns_end = width - w.left < gray->width_px ? width - w.left : gray->width_px;
    w.rows_end = height - w.top < gray->height_px ? height - w.top : gray->height_px;
    return w;
}

/* One colour that hides what is below it. */
static void blend_plain(struct font_painter *p, const struct font_gray *gray,
                        const struct window *w, int channel, const struct font_ink *ink,
                        struct font_picture *to)
{
    if (memcmp(p->ink, ink->rgba, sizeof p->ink) != 0) {
        memcpy(p->ink, ink->rgba, sizeof p->ink);
        for (int i = 0; i < 3; i++)
            p->ink_light[i] = (float)font_light(ink->rgba[i], p->def.gamma);
    }
    const float *light = p->ink_light;
    int first = channel < 0 ? 0 : channel, last = channel < 0 ? 2 : channel;
    float part = (float)ink->rgba[3] * (1 / 255.0f);
    for (int r = w->row; r < w->rows_end; r++) {
        const uint8_t *from = gray->pixels + (size_t)r * (size_t)gray->pitch;
        uint8_t *row =
            to->rgb + (size_t)(w->top + r) * (size_t)to->pitch + 3 * (ptrdiff_t)w->left;
        for (int c = w->column; c < w->columns_end; c++) {
            if (!from[c])
                continue;
            float cover = (float)from[c] * part;
            for (int i = first; i <= last; i++)
                row[3 * c + i] = mixed(p, row[3 * c + i], light[i], cover);
        }
    }
}

/* The light of a number 0..1, between the table's. */
static inline float light_of(const struct font_painter *p, float number)
{
    float at = number * 255;
    int i = (int)at;
    i = i > TO_LIGHT - 2 ? TO_LIGHT - 2 : i;
    return p->to_light[i] + (p->to_light[i + 1] - p->to_light[i]) * (at - (float)i);
}

/* Any ink. */
static void blend_any(const struct font_painter *p, const struct font_gray *gray,
                      const struct window *w, int channel, const struct font_ink *ink,
                      double ink_x, double ink_y, struct font_picture *to)
{
    int first = channel < 0 ? 0 : channel, last = channel < 0 ? 2 : channel;
    for (int r = w->row; r < w->rows_end; r++) {
        const uint8_t *from = gray->pixels + (size_t)r * (size_t)gray->pitch;
        uint8_t *row =
            to->rgb + (size_t)(w->top + r) * (size_t)to->pitch + 3 * (ptrdiff_t)w->left;
        for (int c = w->column; c < w->columns_end; c++) {
            float rgba[4];
            if (!from[c])
                continue;
            font_ink_at(ink, w->left + c - ink_x, w->top + r - ink_y, rgba);
            float cover = (float)from[c] * (1 / 255.0f) * rgba[3];
            for (int i = first; i <= last; i++) {
                uint8_t *at = &row[3 * c + i];
                *at = ink->numbers
                          ? (uint8_t)lrintf((float)*at + (255 * rgba[i] - (float)*at) * cover)
                          : mixed(p, *at, light_of(p, rgba[i]), cover);
            }
        }
    }
}

void font_blend(struct font_painter *p, const struct font_gray *gray, int x, int y, int channel,
                const struct font_ink *ink, double ink_x, double ink_y, struct font_picture *to)
{
    const struct window w = window_of(gray, x, y, to->width_px, to->height_px);
    if (ink->kind == FONT_INK_PLAIN && !ink->numbers)
        blend_plain(p, gray, &w, channel, ink, to);
    else
        blend_any(p, gray, &w, channel, ink, ink_x, ink_y, to);
}

void font_blend_cover(const struct font_gray *gray, int x, int y, struct font_cover *to)
{
    const struct window w = window_of(gray, x, y, to->width_px, to->height_px);
    for (int r = w.row; r < w.rows_end; r++) {
        const uint8_t *from = gray->pixels + (size_t)r * (size_t)gray->pitch;
        uint8_t *row = to->gray + (size_t)(w.top + r) * (size_t)to->pitch + (ptrdiff_t)w.left;
        for (int c = w.column; c < w.columns_end; c++) {
            int rest = 255 - row[c];
            row[c] = (uint8_t)(row[c] + (rest * from[c] + 127) / 255);
        }
    }
}
