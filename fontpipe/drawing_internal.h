/* drawing_internal.h - what drawing.c, drawing_picture.c, drawing_svg.c and the PDF's files
 * share. */
#ifndef LUTETIA_FONT_DRAWING_INTERNAL_H
#define LUTETIA_FONT_DRAWING_INTERNAL_H

#include "drawing.h"
#include "internal.h"
#include "paint.h"

/* A glyph that is used, each once. */
struct drawn_glyph {
    struct font_face *face;
    uint32_t glyph;
    bool picture; /* it has no outline */
};

/* The bytes of the text that a glyph's cluster shows: up to the next cluster's, wherever that
 * stands. All glyphs of a cluster on one line have the same; a sign that is not in the text has
 * none. */
struct drawn_text {
    size_t begin, end;
    bool begins, ends; /* it is the first, and the last, of its cluster's glyphs there */
    bool line_ends;    /* it is the last of its line's */
    int at, of;        /* which of its cluster's glyphs there it is, of how many */
};

struct drawn {
    struct drawn_glyph *glyphs;
    int *of; /* of each of the layout's glyphs: which */
    int count, capacity;
    struct drawn_text *texts;     /* of each of the layout's glyphs */
    struct font_painter *painter; /* once there is a picture */
};

/* No number that a program could stumble over. */
static inline double drawn_near(double px)
{
    const double far = 1e5;
    return px > far ? far : px > -far ? px : -far;
}

/* Behind the points from i on that are drawn in one go: about as wide as each other. */
int drawn_run(const struct font_drawing_stroke *stroke, int i);

enum { DRAWN_FINER = 4 }; /* pixels of a picture to one of the drawing's, along each side */

/* Glyph i's picture, so much finer than the drawing. Owns: the caller frees out->rgba. */
enum font_status drawn_tile(struct drawn *drawn, const struct font_drawing *d,
                            const struct font_layout *layout, int i, const struct font_map *map,
                            double x_px, double y_px, struct font_tile *out);
/* The tile as PNG, in Base64. */
enum font_status drawn_png(const struct font_tile *tile, FILE *file);
/* The bytes as zlib packs them. Owns: the caller frees them; NULL: no memory. */
uint8_t *drawn_deflated(const uint8_t *bytes, size_t count, size_t *out_count);

/* Checks the inks, and draws the layout with the glyphs of colour fonts as their layers
 * (font_colour_spread()). */
typedef enum font_status drawn_put(const struct font_drawing *d,
                                   const struct font_layout *layout, const struct font_map *map,
                                   double x, double y, FILE *file);
enum font_status drawn_spread(const struct font_drawing *d, const struct font_layout *layout,
                              const struct font_map *map, double x, double y, FILE *file,
                              drawn_put *put);
enum font_status drawn_find(const struct font_drawing *d, const struct font_layout *layout,
                            struct drawn *out);
void drawn_finish(struct drawn *drawn);

/* The outline as a path, its points through a map (NULL: as they are), curves cut finely where
 * the map distorts. pdf: its operators, else SVG's letters. */
enum font_status drawn_path(const struct font_outline *outline, const struct font_map *map,
                            bool pdf, FILE *file);
/* The map of a layout's glyph from its font's units to the picture's pixels, its place
 * within. */
enum font_status drawn_map(const struct font_layout *layout, int i, const struct font_map *map,
                           double x_px, double y_px, struct font_map *out);
/* Whether an ink is the same colour everywhere: plain, or a gradient that goes nowhere. That is
 * then in rgba. */
bool drawn_flat(const struct font_ink *ink, double rgba[4]);
/* An ink's picture, opaque. Owns: the caller frees out->rgba. */
enum font_status drawn_ink_tile(const struct font_ink *ink, struct font_tile *out);
/* Whether it is a gradient that lets something through. */
bool drawn_translucent(const struct font_ink *ink);
/* A glyph's ink; own: room for the drawing's. */
const struct font_ink *drawn_ink(const struct font_drawing *d, const struct font_layout *layout,
                                 int i, struct font_ink *own);
enum font_status drawn_inks_check(const struct font_layout *layout);
#endif
