/* colour.c - see colour.h. */
#include "colour.h"
#include "internal.h"

#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_COLOR_H

enum { SIDE_MAX = 4096, TEXTS_INK = 0xffff };

enum font_colour font_colour_of(struct font_face *face, uint32_t glyph)
{
    FT_Face ft = font_face_freetype(face);
    FT_LayerIterator at = {.p = NULL};
    FT_UInt layer, colour;
    if (!FT_HAS_COLOR(ft))
        return FONT_COLOUR_NONE;
    if (!FT_IS_SCALABLE(ft))
        return FONT_COLOUR_PICTURE;
    return FT_Get_Color_Glyph_Layer(ft, glyph, &layer, &colour, &at) ? FONT_COLOUR_LAYERS
                                                                     : FONT_COLOUR_NONE;
}

int font_colour_layers(struct font_face *face, uint32_t glyph,
                       struct font_colour_layer out[FONT_COLOUR_LAYERS_MAX])
{
    FT_Face ft = font_face_freetype(face);
    FT_LayerIterator at = {.p = NULL};
    FT_Palette_Data palettes = {0};
    FT_Color *palette = NULL;
    FT_UInt layer, colour;
    int count = 0;
    if (FT_Palette_Data_Get(ft, &palettes) || FT_Palette_Select(ft, 0, &palette))
        palette = NULL;
    while (count < FONT_COLOUR_LAYERS_MAX &&
           FT_Get_Color_Glyph_Layer(ft, glyph, &layer, &colour, &at)) {
        struct font_colour_layer *l = &out[count++];
        *l = (struct font_colour_layer){.glyph = layer};
        if (colour == TEXTS_INK || !palette || colour >= palettes.num_palette_entries)
            continue;
        FT_Color c = palette[colour];
        l->own = true;
        l->rgba[0] = c.red / 255.0;
        l->rgba[1] = c.green / 255.0;
        l->rgba[2] = c.blue / 255.0;
        l->rgba[3] = c.alpha / 255.0;
    }
    return count;
}

static int largest_strike(FT_Face ft)
{
    int best = 0;
    for (int i = 1; i < ft->num_fixed_sizes; i++)
        if (ft->available_sizes[i].y_ppem > ft->available_sizes[best].y_ppem)
            best = i;
    return best;
}

enum font_status font_colour_picture_get(struct font_face *face, uint32_t glyph,
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
    if (b->pixel_mode != FT_PIXEL_MODE_BGRA || b->width > SIDE_MAX || b->rows > SIDE_MAX ||
        b->pitch < 0 || ft->size->metrics.y_ppem == 0)
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
