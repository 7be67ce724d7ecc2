/* paint.h - glyphs onto pictures: blending in linear light, RGB stripes, stem darkening, and
 * the glyphs kept.
 *
 *     struct font_painter *painter;
 *     struct font_painter_def def = font_painter_def_default();
 *     font_painter_create(&def, &painter);
 *     struct font_picture page = {640, 120, 640 * 3, pixels};
 *     font_painter_layout(painter, &layout, &map, 20, 80, &page);
 *     font_painter_destroy(painter);
 *
 * Blending. A pixel that the ink covers by a half shows half the light of paper and half that
 * of ink; sRGB numbers are not light, so both are turned into light, mixed, and turned back.
 * (What is mixed as it stands makes dark text too heavy and light text too thin.) With `gamma`
 * 1 numbers are mixed as they stand.
 *
 * Stripes. On a display whose pixels are three upright stripes each colour is drawn where its
 * stripe is: a third of a pixel to the left and to the right.
 *
 * Stem darkening. Small type on screens looks thin; stems get wider by up to `darken_px` at
 * small sizes: all of it up to 12 px, none from 36 px on.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: faces and pictures are borrowed; what else is passed is copied. Threads: a painter
 * belongs to one thread at a time. */
#ifndef LUTETIA_FONT_PAINT_H
#define LUTETIA_FONT_PAINT_H

#include "gray.h"
#include "text.h"

struct font_picture {
    int width_px, height_px, pitch; /* pitch: bytes from row to row */
    uint8_t *rgb;
};

/* As much as the face's stems ask for at a size: docs/fonts.md says how much, and why. */
#define FONT_DARKEN_BY_STEM (-1.0)

struct font_painter_def {
    const char *filter; /* "gaussian-fast" */
    double ink[3];      /* sRGB, 0..1 */
    double gamma;       /* 0: sRGB's own curve; else a power; 1: none */
    double darken_px;   /* 0..2, or FONT_DARKEN_BY_STEM */
    bool stripes;       /* RGB */
    /* a pixel is divided into so many for keeping glyphs; 0: glyphs are drawn where they are */
    int places;
    size_t budget_bytes; /* of what is kept */
    /* by its filter alone, whatever filters and gray faces have of their own (own.h) */
    bool without_own;
};
/* Black ink by "gaussian-fast", in linear light; 16 MiB of kept glyphs. */
struct font_painter_def font_painter_def_default(void);

struct font_painter;
/* Errors: BAD_ARGUMENT (a number out of its range, no such filter), NO_MEMORY. Owns: the caller
 * destroys *out. */
enum font_status font_painter_create(const struct font_painter_def *def,
                                     struct font_painter **out);
void font_painter_destroy(struct font_painter *painter); /* NULL is fine */
/* The painter's filter; never NULL, valid as long as the painter. */
const struct font_filter *font_painter_filter(const struct font_painter *painter);

/* Draws the layout with its origin at (x, y), through `map`, which takes pixels to pixels
 * (NULL: as it is); a glyph is distorted as a whole text would be. Errors: those of outlines
 * and edges; what was drawn before stays. */
enum font_status font_painter_layout(struct font_painter *painter,
                                     const struct font_layout *layout,
                                     const struct font_map *map, double x_px, double y_px,
                                     struct font_picture *picture);

/* The part of each pixel that the layout covers, of 255, added to what is covered already: a
 * letter takes its part of what is left. No ink, light or stripes. As font_painter_layout()
 * otherwise. Errors: as font_painter_layout(). */
struct font_cover {
    int width_px, height_px, pitch; /* pitch: bytes from row to row */
    uint8_t *gray;
};
enum font_status font_painter_cover(struct font_painter *painter,
                                    const struct font_layout *layout,
                                    const struct font_map *map, double x_px, double y_px,
                                    struct font_cover *cover);

/* One glyph at a size, through a map that takes pixels to pixels (NULL: as it is), its origin
 * at (x_px, y_px), 0..1; the edges are kept. *gray: the painter's, valid until it draws again.
 * Errors: as font_painter_layout(). */
enum font_status font_painter_glyph(struct font_painter *painter, struct font_face *face,
                                    uint32_t glyph, double size_px, const struct font_map *map,
                                    double x_px, double y_px, const struct font_gray **gray);

/* The box around all the ink of a layout drawn so, with the filter's reach: in pixels. Empty:
 * x1 < x0. Errors: as font_painter_layout(). */
enum font_status font_painter_measure(struct font_painter *painter,
                                      const struct font_layout *layout,
                                      const struct font_map *map, double x_px, double y_px,
                                      struct font_box *box);

/* A glyph that has a picture (drawn, or kept in the font), as pixels for whoever cannot draw
 * it: GPUs, drawings in files. */
struct font_tile {
    int left_px, top_px, width_px, height_px; /* width 0: there is nothing */
    /* sRGB numbers and cover, not multiplied; rows without gaps. Owns: the caller frees it */
    uint8_t *rgba;
};
/* Whether it is such a glyph. */
bool font_painter_is_picture(const struct font_placed *glyph);
/* Glyph i, placed as font_painter_layout() would in a picture of that size; only the tile's
 * part within it. ink: sRGB numbers, of glyphs that have none of the layout's. Errors: NO_GLYPH
 * for one without a picture; those of maps and of reading it. */
enum font_status font_painter_tile(struct font_painter *painter,
                                   const struct font_layout *layout, int i,
                                   const struct font_map *map, double x_px, double y_px,
                                   const double ink[3], int width_px, int height_px,
                                   struct font_tile *out);

struct font_painter_stats {
    long drawn, kept_hits, edges_hits, evicted;
    size_t kept_bytes;
    int kept_count;
};
/* Since it was created. */
void font_painter_stats_get(const struct font_painter *painter, struct font_painter_stats *out);

#endif
