/* colour.c - see colour.h. */
#include "colour_internal.h"

#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_COLOR_H

static bool has_layers(struct font_face *face, uint32_t glyph)
{
    uint32_t layer, colour;
    hb_blob_t *table = font_colour_table(face, "COLR");
    struct font_colr colr = font_colour_colr(table);
    bool has = font_colr_plain_layer(&colr, glyph, 0, &layer, &colour);
    hb_blob_destroy(table);
    return has;
}

static int largest_strike(FT_Face ft)
{
    int best = 0;
    for (int i = 1; i < ft->num_fixed_sizes; i++)
        if (ft->available_sizes[i].y_ppem > ft->available_sizes[best].y_ppem)
            best = i;
    return best;
}

/* Whether a font that has outlines, too, has a picture of the glyph. */
static bool has_strike(FT_Face ft, uint32_t glyph)
{
    return ft->num_fixed_sizes > 0 && FT_Select_Size(ft, largest_strike(ft)) == 0 &&
           FT_Load_Glyph(ft, glyph, FT_LOAD_COLOR | FT_LOAD_BITMAP_METRICS_ONLY) == 0 &&
           ft->glyph->format == FT_GLYPH_FORMAT_BITMAP &&
           ft->glyph->bitmap.pixel_mode == FT_PIXEL_MODE_BGRA;
}

enum font_colour font_colour_of(struct font_face *face, uint32_t glyph)
{
    FT_Face ft = font_face_freetype(face);
    if (FT_HAS_COLOR(ft)) {
        if (!FT_IS_SCALABLE(ft))
            return FONT_COLOUR_PICTURE;
        if (font_colour_has_paints(face, glyph))
            return FONT_COLOUR_PAINTS;
        if (has_layers(face, glyph))
            return FONT_COLOUR_LAYERS;
        if (has_strike(ft, glyph))
            return FONT_COLOUR_PICTURE;
    }
    return FT_HAS_SVG(ft) && font_colour_has_svg(face, glyph) && font_colour_svg_drawn()
               ? FONT_COLOUR_SVG
               : FONT_COLOUR_NONE;
}

bool font_colour_lost(struct font_face *face, uint32_t glyph, bool coloured)
{
    FT_Face ft = font_face_freetype(face);
    if (!(FT_HAS_COLOR(ft) || FT_HAS_SVG(ft)) ||
        (coloured && font_colour_of(face, glyph) != FONT_COLOUR_NONE))
        return false;
    struct font_outline o;
    bool empty = font_face_outline_raw(face, glyph, &o) != FONT_OK || o.segments_count == 0;
    font_outline_finish(&o);
    return empty && (font_colour_of(face, glyph) != FONT_COLOUR_NONE ||
                     font_colour_has_svg(face, glyph));
}

int font_colour_layers(struct font_face *face, uint32_t glyph,
                       struct font_colour_layer out[FONT_COLOUR_LAYERS_MAX])
{
    FT_Face ft = font_face_freetype(face);
    FT_Palette_Data palettes = {0};
    FT_Color *palette = NULL;
    hb_blob_t *table = font_colour_table(face, "COLR");
    struct font_colr colr = font_colour_colr(table);
    uint32_t layer, colour;
    int count = 0;
    if (FT_Palette_Data_Get(ft, &palettes) || FT_Palette_Select(ft, 0, &palette))
        palette = NULL;
    while (count < FONT_COLOUR_LAYERS_MAX &&
           font_colr_plain_layer(&colr, glyph, (uint32_t)count, &layer, &colour)) {
        struct font_colour_layer *l = &out[count++];
        *l = (struct font_colour_layer){.glyph = layer};
        if (colour == FONT_COLR_INK || !palette || colour >= palettes.num_palette_entries)
            continue;
        FT_Color c = palette[colour];
        l->own = true;
        l->rgba[0] = c.red / 255.0;
        l->rgba[1] = c.green / 255.0;
        l->rgba[2] = c.blue / 255.0;
        l->rgba[3] = c.alpha / 255.0;
    }
    hb_blob_destroy(table);
    return count;
}

static enum font_status strike_get(struct font_face *face, uint32_t glyph,
                                   struct font_colour_picture *out)
{
    FT_Face ft = font_face_freetype(face);
    *out = (struct font_colour_picture){0};
    if (ft->num_fixed_sizes < 1 || FT_Select_Size(ft, largest_strike(ft)) ||
        FT_Load_Glyph(ft, glyph, FT_LOAD_COLOR))
        return font_fail(FONT_NO_GLYPH, "glyph %u has no picture that can be read",
                         (unsigned)glyph);
    const FT_Bitmap *b = &ft->glyph->bitmap;
    if (!b->width || !b->rows)
        return FONT_OK;
    if (b->pixel_mode != FT_PIXEL_MODE_BGRA || b->width > FONT_COLOUR_SIDE_MAX ||
        b->rows > FONT_COLOUR_SIDE_MAX || b->pitch < 0 || ft->size->metrics.y_ppem == 0)
        return font_fail(FONT_BAD_FILE, "glyph %u has a picture of a kind that is not drawn",
                         (unsigned)glyph);
    size_t row = 4 * (size_t)b->width;
    out->bgra = malloc(row * b->rows);
    if (!out->bgra)
        return font_fail(FONT_NO_MEMORY, "no memory for a glyph's picture");
    for (unsigned r = 0; r < b->rows; r++)
        memcpy(out->bgra + r * row, b->buffer + (size_t)r * (size_t)b->pitch, row);
    out->width_px = (int)b->width;
    out->height_px = (int)b->rows;
    out->left_px = ft->glyph->bitmap_left;
    out->top_px = ft->glyph->bitmap_top;
    out->em_px = ft->size->metrics.y_ppem;
    return FONT_OK;
}

enum font_status font_colour_picture_draw(struct font_face *face, uint32_t glyph, int em_px,
                                          const double ink[3], const struct font_filter *area,
                                          struct font_colour_picture *out)
{
    switch (font_colour_of(face, glyph)) {
    case FONT_COLOUR_PAINTS:
        return font_colour_paints(face, glyph, em_px, ink, area, out);
    case FONT_COLOUR_SVG:
        return font_colour_svg(face, glyph, em_px, ink, out);
    case FONT_COLOUR_PICTURE:
        return strike_get(face, glyph, out);
    case FONT_COLOUR_NONE:
    case FONT_COLOUR_LAYERS:
        break;
    }
    *out = (struct font_colour_picture){0};
    return font_fail(FONT_NO_GLYPH, "glyph %u has no picture", (unsigned)glyph);
}
