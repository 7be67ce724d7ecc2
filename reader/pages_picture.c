/* pages_picture.c - pictures in documents: a full block (U+2588) of the font of code, as large
 * as the picture, whose ink is the picture's pixels at the page's size. So whatever draws pages
 * draws them. See pages_internal.h. */
#include "pages_internal.h"

#include <edges.h>
#include <outline.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FULL_BLOCK = 0x2588 };

/* What a picture's row or column i of `to` covers of `from` ones: from *begin on, at least
 * one. */
static void covered(int i, int to, int from, int *begin, int *end)
{
    *begin = (int)((long)i * from / to);
    *end = (int)((long)(i + 1) * from / to);
    *end = *end > *begin ? *end : *begin + 1;
}

/* As many pixels as it has on the page: the mean light of those that each covers. Owns: the
 * caller frees it; NULL: no memory. */
static uint8_t *pixels_shrink(const struct reader_picture *from, int width, int height)
{
    double light[256];
    uint8_t *to = malloc((size_t)width * (size_t)height * 3);
    for (int i = 0; i < 256; i++)
        light[i] = font_light(i / 255.0, 0);
    for (int y = 0; y < height && to; y++)
        for (int x = 0; x < width; x++) {
            int x0, x1, y0, y1;
            double sums[3] = {0};
            covered(x, width, from->width_px, &x0, &x1);
            covered(y, height, from->height_px, &y0, &y1);
            for (int v = y0; v < y1; v++)
                for (int u = x0; u < x1; u++)
                    for (int c = 0; c < 3; c++)
                        sums[c] += light[from->rgb[3 * ((size_t)v * (size_t)from->width_px +
                                                        (size_t)u) +
                                                   (size_t)c]];
            for (int c = 0; c < 3; c++)
                to[3 * ((size_t)y * (size_t)width + (size_t)x) + (size_t)c] = (uint8_t)lrint(
                    255 * font_number(sums[c] / ((double)(x1 - x0) * (y1 - y0)), 0));
        }
    return to;
}

/* The font's full block: its glyph, and its box in ems. */
struct block {
    uint32_t glyph;
    double x0, y0, width, height;
};

/* False: the font has none. */
static bool block_find(struct font_face *face, struct block *block)
{
    struct font_outline outline;
    struct font_face_info info;
    font_face_describe(face, &info);
    *block = (struct block){.glyph = font_face_glyph(face, FULL_BLOCK)};
    if (!block->glyph || font_face_outline(face, block->glyph, &outline) != FONT_OK)
        return false;
    struct font_box box = font_outline_box(&outline);
    font_outline_finish(&outline);
    block->x0 = box.x0 / info.units_per_em;
    block->y0 = box.y0 / info.units_per_em;
    block->width = (box.x1 - box.x0) / info.units_per_em;
    block->height = (box.y1 - box.y0) / info.units_per_em;
    return block->width > 0 && block->height > 0;
}

/* Places the block so that it is width x height over the baseline. */
static enum reader_status picture_style(struct reader_pages *p, const struct block *block,
                                        const uint8_t *rgb, int width, int height, int *style)
{
    const double side = 100; /* a size at which nothing is made darker */
    const double sx = width / (block->width * side), sy = height / (block->height * side);
    struct font_map map = {FONT_AFFINE, {sx, 0, 0, 0, sy, 0}};
    struct font_ink ink = {.kind = FONT_INK_PICTURE,
                           .rgba = {0, 0, 0, 1},
                           .y0 = -height,
                           .rgb = rgb,
                           .width_px = width,
                           .height_px = height,
                           .pitch = 3 * width};
    struct font_placed placed = {.face = p->faces[READER_CODE],
                                 .glyph = block->glyph,
                                 .x_px = -block->x0 * side * sx,
                                 .y_px = block->y0 * side * sy,
                                 .size_px = (float)side,
                                 .ink = 1,
                                 .map = 1};
    struct font_layout shown = {.glyphs = &placed,
                                .glyphs_count = 1,
                                .inks = &ink,
                                .inks_count = 1,
                                .maps = &map,
                                .maps_count = 1,
                                .size_px = side,
                                .width_px = width,
                                .ascent_px = height};
    struct page_style look = page_style_default();
    look.font = p->fonts[0];
    look.size_px = pages_size(p, CONTEXT_TABLE);
    return page_inset_add(p->text, &look, &shown, style) == FONT_OK ? READER_OK
                                                                    : pages_failed();
}

/* How large it is on the page: as it is, or as the column and six tenths of the page have
 * room. */
static double picture_high(const struct reader_pages *p)
{
    return p->made ? p->setup.height_px : p->setup.height_px - 2 * p->setup.margin_px;
}

static void picture_size(const struct reader_picture *picture, const struct pictured *own,
                         int *width, int *height)
{
    const struct reader_asked *asked = &own->asked;
    double most = own->most_px, high = 0.6 * fmax(1, own->high_px);
    if (asked->percent)
        most *= asked->percent / 100.0;
    if (asked->width_px)
        most = fmin(most, asked->width_px);
    if (asked->height_px)
        high = fmin(high, asked->height_px);
    const double scale = fmin(1, fmin(most / picture->width_px, high / picture->height_px));
    *width = (int)fmax(1, floor(picture->width_px * scale));
    *height = (int)fmax(1, floor(picture->height_px * scale));
}

/* How opaque pixels are at that size: as the most opaque of those that each covers. NULL: all
 * are, or no memory. */
static uint8_t *alpha_shrink(const struct reader_picture *from, int width, int height)
{
    uint8_t *to = from->alpha ? calloc((size_t)width, (size_t)height) : NULL;
    for (int y = 0; y < height && to; y++)
        for (int x = 0; x < width; x++) {
            int x0, x1, y0, y1;
            uint8_t *own = &to[(size_t)y * (size_t)width + (size_t)x];
            covered(x, width, from->width_px, &x0, &x1);
            covered(y, height, from->height_px, &y0, &y1);
            for (int v = y0; v < y1; v++)
                for (int u = x0; u < x1; u++) {
                    const uint8_t a =
                        from->alpha[(size_t)v * (size_t)from->width_px + (size_t)u];
                    *own = a > *own ? a : *own;
                }
        }
    return to;
}

static enum reader_status pictured_make(struct reader_pages *p, const struct block *full,
                                        const struct reader_picture *picture,
                                        struct pictured *own)
{
    picture_size(picture, own, &own->width, &own->height);
    own->pixels = pixels_shrink(picture, own->width, own->height);
    own->alpha = alpha_shrink(picture, own->width, own->height);
    return own->pixels
               ? picture_style(p, full, own->pixels, own->width, own->height, &own->style)
               : pages_no_memory();
}

static void pictured_free(struct pictured *own)
{
    free(own->target);
    free(own->pixels);
    free(own->alpha);
}

void pages_pictures_free(struct reader_pages *p)
{
    for (int i = 0; i < p->pictures_count; i++)
        pictured_free(&p->pictures[i]);
    free(p->pictures);
}

/* One that was set in so much room before. */
static const struct pictured *pictured_known(const struct reader_pages *p, int source,
                                             const char *target, struct reader_asked asked,
                                             double most_px, double high_px)
{
    for (int i = 0; i < p->pictures_count; i++) {
        const struct pictured *own = &p->pictures[i];
        if (own->source == source && own->most_px == most_px && own->high_px == high_px &&
            reader_asked_same(&own->asked, &asked) && strcmp(own->target, target) == 0)
            return own;
    }
    return NULL;
}

enum reader_status pages_pictured(struct reader_pages *p, int source, const char *target,
                                  struct reader_asked asked, double most_px,
                                  const struct pictured **out)
{
    struct reader_picture picture = {0};
    const double high = picture_high(p);
    struct block full;
    *out = target ? pictured_known(p, source, target, asked, most_px, high) : NULL;
    if (*out || !p->setup.picture || !target || !*target ||
        !block_find(p->faces[READER_CODE], &full) ||
        !p->setup.picture(p->setup.picture_user, source, target, &picture))
        return READER_OK;
    struct pictured own = {.source = source,
                           .target = strdup(target),
                           .most_px = most_px,
                           .high_px = high,
                           .asked = asked};
    enum reader_status status =
        own.target && array_reserve(&p->pictures, &p->pictures_capacity, p->pictures_count + 1,
                                    sizeof *p->pictures)
            ? pictured_make(p, &full, &picture, &own)
            : pages_no_memory();
    free(picture.rgb);
    free(picture.alpha);
    if (status != READER_OK) {
        pictured_free(&own);
        return status;
    }
    p->pictures[p->pictures_count++] = own;
    *out = &p->pictures[p->pictures_count - 1];
    return READER_OK;
}
