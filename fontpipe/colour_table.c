/* colour_table.c - a font's tables, their numbers, and the pixels that a picture takes: what
 * all kinds of coloured glyphs need. */
#include "colour_internal.h"

#include <math.h>

hb_blob_t *font_colour_table(struct font_face *face, const char tag[5])
{
    return hb_face_reference_table(font_face_harfbuzz(face),
                                   HB_TAG(tag[0], tag[1], tag[2], tag[3]));
}

struct font_colr font_colour_colr(hb_blob_t *table)
{
    unsigned count;
    const char *bytes = hb_blob_get_data(table, &count);
    return (struct font_colr){.bytes = (const uint8_t *)bytes, .count = count};
}

uint32_t font_colr_u(const struct font_colr *c, uint64_t at, int bytes)
{
    uint32_t value = 0;
    if (at > c->count || c->count - at < (unsigned)bytes)
        return 0;
    for (int i = 0; i < bytes; i++)
        value = value << 8 | c->bytes[at + (unsigned)i];
    return value;
}

int32_t font_colr_s(const struct font_colr *c, uint64_t at, int bytes)
{
    int unused = 32 - 8 * bytes;
    return (int32_t)(font_colr_u(c, at, bytes) << unused) >> unused;
}

bool font_colour_pixels_set(const struct font_box *box, int em_px,
                            struct font_colour_picture *out)
{
    enum { PIXELS_MAX = 2048 * 2048 };
    *out = (struct font_colour_picture){.em_px = em_px};
    if (!(box->x1 > box->x0 && box->y1 > box->y0))
        return true;
    double x0 = floor(box->x0), y0 = floor(box->y0), x1 = ceil(box->x1), y1 = ceil(box->y1);
    if (!(x1 - x0 <= FONT_COLOUR_SIDE_MAX && y1 - y0 <= FONT_COLOUR_SIDE_MAX &&
          (x1 - x0) * (y1 - y0) <= PIXELS_MAX && fabs(x0) < 1e6 && fabs(y0) < 1e6))
        return false;
    out->left_px = (int)x0;
    out->top_px = -(int)y0;
    out->width_px = (int)(x1 - x0);
    out->height_px = (int)(y1 - y0);
    return true;
}
