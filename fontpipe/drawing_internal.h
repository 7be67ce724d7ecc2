/* drawing_internal.h - what drawing.c, drawing_picture.c, drawing_svg.c and drawing_pdf.c share. */
#ifndef LUTETIA_FONT_DRAWING_INTERNAL_H
#define LUTETIA_FONT_DRAWING_INTERNAL_H

#include "drawing.h"
#include "internal.h"
#include "paint.h"

/* A glyph that is used, each once. */
struct drawn_glyph {
    struct font_face *face;
    uint32_t glyph;
    int first;      /* the layout's first that is it */
    int font, code; /* PDF: of which font which letter */
    bool picture;   /* it has no outline */
};

struct drawn {
    struct drawn_glyph *glyphs;
    int *of; /* of each of the layout's glyphs: which */
    int count, capacity;
    struct font_painter *painter; /* once there is a picture */
};

enum { DRAWN_FINER = 4 }; /* pixels of a picture to one of the drawing's, along each side */

/* Glyph i's picture, so much finer than the drawing. Owns: the caller frees out->rgba. */
enum font_status drawn_tile(struct drawn *drawn, const struct font_drawing *d,
                            const struct font_layout *layout, int i, const struct font_map *map,
                            double x_px, double y_px, struct font_tile *out);
/* The tile as PNG, in Base64. */
enum font_status drawn_png(const struct font_tile *tile, FILE *file);
/* The bytes as zlib packs them. Owns: the caller frees them; NULL: no memory. */
uint8_t *drawn_deflated(const uint8_t *bytes, size_t count, size_t *out_count);

/* Checks the inks, and draws the layout with the glyphs of colour fonts as their layers (font_colour_spread()). */
typedef enum font_status drawn_put(const struct font_drawing *d,
                                   const struct font_layout *layout, const struct font_map *map,
                                   double x, double y, FILE *file);
enum font_status drawn_spread(const struct font_drawing *d, const struct font_layout *layout,
                              const struct font_map *map, double x, double y, FILE *file,
                              drawn_put *put);
enum font_status drawn_find(const struct font_layout *layout, struct drawn *out);
void drawn_finish(struct drawn *drawn);

/* The outline as a path, its points through a map (NULL: as they are), curves cut finely where the map distorts. pdf: its operators,
 * else SVG's letters. */
enum font_status drawn_path(const struct font_outline *outline, const struct font_map *map,
                            bool pdf, FILE *file);
/* The map of a layout's glyph from its font's units to the picture's pixels, its place within. */
enum font_status drawn_map(const struct font_layout *layout, int i, const struct font_map *map,
                           double x_px, double y_px, struct font_map *out);
/* Whether an ink is the same colour everywhere: plain, or a gradient that goes nowhere. That is then in rgba. */
bool drawn_flat(const struct font_ink *ink, double rgba[4]);
/* An ink's picture, opaque. Owns: the caller frees out->rgba. */
enum font_status drawn_ink_tile(const struct font_ink *ink, struct font_tile *out);
/* drawing_pdf_ink.c: a gradient as a shading, its places as they are: its colours, or its cover as a gray. */
void drawn_pdf_shading(const struct font_ink *ink, bool cover, FILE *file);
/* A glyph's ink; own: room for the drawing's. */
const struct font_ink *drawn_ink(const struct font_drawing *d, const struct font_layout *layout,
                                 int i, struct font_ink *own);
enum font_status drawn_inks_check(const struct font_layout *layout);
/* The bytes of the text that the layout's glyph i shows: up to the next cluster's. Only the first glyph of a cluster has any. */
void drawn_text(const struct font_drawing *d, const struct font_layout *layout, int i,
                size_t *begin, size_t *end);

#endif
