/* colour.h - glyphs that have colours of their own: layers of outlines (COLR 0), graphs of
 * paints (COLR 1) and pictures (CBDT, sbix), as FreeType reads them, and SVG, as librsvg draws
 * it. What has none is drawn as its outline.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: what is passed stays the caller's. Threads: a face belongs to one thread at a
 * time. */
#ifndef LUTETIA_FONT_COLOUR_H
#define LUTETIA_FONT_COLOUR_H

#include "face.h"

struct font_filter;

enum font_colour {
    FONT_COLOUR_NONE,
    FONT_COLOUR_LAYERS,
    FONT_COLOUR_PICTURE,
    FONT_COLOUR_PAINTS,
    FONT_COLOUR_SVG /* only where there is librsvg */
};
/* The kind of colours that the glyph has. */
enum font_colour font_colour_of(struct font_face *face, uint32_t glyph);
/* Whether nothing is seen of a glyph that the font has in colours alone: because they are not
 * drawn (not `coloured`), or there is no library for them. */
bool font_colour_lost(struct font_face *face, uint32_t glyph, bool coloured);

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

struct font_layout;
/* The layout with its glyphs of layers as those, each in an ink of its own where it has one; no
 * lines. For whoever draws outlines alone. Owns: the caller finishes *out. Errors:
 * NO_MEMORY. */
enum font_status font_colour_spread(const struct font_layout *from, struct font_layout *out);

/* A glyph's picture: its upper left is at (left_px, -top_px) from the glyph's origin where an
 * em is em_px. */
struct font_colour_picture {
    /* sRGB numbers times what they cover; four bytes a pixel, rows without gaps; NULL:
     * nothing */
    uint8_t *bgra;
    int width_px, height_px, left_px, top_px, em_px;
};
/* The font's largest picture, or what is drawn where an em is em_px or less (a drawing has a
 * few million pixels at most). ink: sRGB numbers, of what has the text's ink. area: the box.
 * Owns: the caller frees out->bgra. Errors: NO_GLYPH, BAD_FILE, NO_MEMORY; *out is then
 * empty. */
enum font_status font_colour_picture_draw(struct font_face *face, uint32_t glyph, int em_px,
                                          const double ink[3], const struct font_filter *area,
                                          struct font_colour_picture *out);

#endif
