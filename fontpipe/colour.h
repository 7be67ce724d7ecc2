/* colour.h - glyphs that have colours of their own: layers of outlines (COLR 0) and pictures (CBDT, sbix), as FreeType reads
 * them. What has neither is drawn as its outline. */
#ifndef LUTETIA_FONT_COLOUR_H
#define LUTETIA_FONT_COLOUR_H

#include "face.h"

enum font_colour { FONT_COLOUR_NONE, FONT_COLOUR_LAYERS, FONT_COLOUR_PICTURE };
enum font_colour font_colour_of(struct font_face *face, uint32_t glyph);

/* One above the other, the first below all. */
struct font_colour_layer {
    uint32_t glyph;
    double rgba[4]; /* sRGB numbers 0..1 */
    bool own;       /* else it has the text's ink */
};
enum { FONT_COLOUR_LAYERS_MAX = 64 };
/* Of a glyph with layers: how many. */
int font_colour_layers(struct font_face *face, uint32_t glyph,
                       struct font_colour_layer out[FONT_COLOUR_LAYERS_MAX]);

/* A glyph's largest picture: its upper left is at (left_px, -top_px) from the glyph's origin where an em is em_px. */
struct font_colour_picture {
    uint8_t
        *bgra; /* sRGB numbers times what they cover; four bytes a pixel, rows without gaps */
    int width_px, height_px, left_px, top_px, em_px;
};
/* Owns: the caller frees out->bgra. Errors: NO_GLYPH, BAD_FILE, NO_MEMORY; *out is then empty. */
enum font_status font_colour_picture_get(struct font_face *face, uint32_t glyph,
                                         struct font_colour_picture *out);

#endif
