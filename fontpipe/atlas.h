/* atlas.h - gray glyphs packed into a few textures, for programs that draw with a GPU.
 *
 *     struct font_atlas *atlas;
 *     struct font_atlas_def def = font_atlas_def_default();
 *     font_atlas_create(&def, &atlas);
 *     for (;;) {                                             // a frame
 *         font_atlas_begin(atlas);
 *         font_atlas_layout(atlas, &layout, NULL, x, y, quads, QUADS_MAX, &count);
 *         for (int page = 0; page < font_atlas_pages(atlas); page++)
 *             while (font_atlas_dirty(atlas, page, &box))
 *                 glTexSubImage2D(..., box.x, box.y, box.width, box.height, GL_RED, ...);
 *         draw(quads, count);
 *     }
 *
 * Pages are one size, bytes of coverage. A page is cut into shelves, and glyphs stand on them
 * side by side, a blank pixel between any two, so that a texture may be looked up between its
 * pixels:
 *
 *     +--------------------------+
 *     | A | b | c |  free        |  shelf: as high as its first glyph, in steps of 4
 *     | d | e | f | g | h |      |  shelf
 *     | not yet cut              |
 *     +--------------------------+
 *
 * Memory is bounded by the pages. Where they are full, the shelf that was not used for longest
 * is emptied, or several above each other that together are high enough; never one that holds a
 * glyph asked for since font_atlas_begin(). When all of it is in use the status is FULL: draw
 * what you have, begin again, and ask again.
 *
 * A glyph's place between pixels is rounded to one of `places` in each direction.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: faces are borrowed, and must outlive the atlas; what else is passed is copied.
 *
 * Threads: an atlas belongs to one thread at a time. */
#ifndef LUTETIA_FONT_ATLAS_H
#define LUTETIA_FONT_ATLAS_H

#include "paint.h"

struct font_atlas_def {
    const char *filter;        /* "gaussian-fast" */
    int width_px, height_px;   /* of a page, 64..16384 */
    int pages_max;             /* 1..64 */
    int places_x, places_y;    /* 1..256: a pixel's places along x and y */
    double darken_px;          /* as font_painter_def has it */
    size_t edges_budget_bytes; /* of edges that are kept besides */
};
/* Four pages of 1024 x 1024, "gaussian-fast". */
struct font_atlas_def font_atlas_def_default(void);

struct font_atlas;
/* Errors: BAD_ARGUMENT (a number out of its range, no such filter), NO_MEMORY. Owns: the caller
 * destroys *out. */
enum font_status font_atlas_create(const struct font_atlas_def *def, struct font_atlas **out);
void font_atlas_destroy(struct font_atlas *atlas); /* NULL is fine */

/* A new frame: what was asked for before may go. */
void font_atlas_begin(struct font_atlas *atlas);

/* Where a glyph is. Valid until the next font_atlas_begin(). */
struct font_atlas_slot {
    int page, x, y, width_px, height_px; /* width 0: there is no ink */
    int left_px,
        top_px; /* of its first pixel in the picture, whose origin is the origin asked for */
};

/* The glyph at a size, through an affine map's linear part (NULL: upright), its origin at
 * (x_px, y_px) of a picture; or through a distortion, which has the place in it: x_px and y_px
 * are then 0, and places between pixels are not rounded. Errors: FULL, TOO_LARGE (for a page),
 * BAD_ARGUMENT, those of outlines and edges. Nothing asked for before changes. */
enum font_status font_atlas_get(struct font_atlas *atlas, struct font_face *face,
                                uint32_t glyph, double size_px, const struct font_map *map,
                                double x_px, double y_px, struct font_atlas_slot *out);

/* A rectangle of a picture, in pixels, and where it is in a page, 0..1. */
struct font_quad {
    float x0, y0, x1, y1, u0, v0, u1, v1;
    int page;
    int ink; /* of the layout's, from 1; 0: whoever draws says */
};

/* Quads for a layout with its origin at (x_px, y_px), through any map (NULL: as it is), each
 * glyph first through its own; glyphs without ink have none. *count: how many were made, at
 * most quads_max, and *first (0 to begin with) becomes the first glyph that is not done, so
 * that after FULL, or where quads_max was too few, it goes on from there. Errors: as
 * font_atlas_get(); quads made before stay. */
enum font_status font_atlas_layout(struct font_atlas *atlas, const struct font_layout *layout,
                                   const struct font_map *map, double x_px, double y_px,
                                   struct font_quad *quads, int quads_max, int *first,
                                   int *count);

int font_atlas_pages(const struct font_atlas *atlas); /* that there are so far */
/* Shape: height_px rows of width_px bytes; valid as long as the atlas, which writes into it.
 * NULL: there is no such page. */
const uint8_t *font_atlas_pixels(const struct font_atlas *atlas, int page);

/* What of a page was written since it was last asked; false: nothing. */
struct font_atlas_box {
    int x, y, width, height;
};
bool font_atlas_dirty(struct font_atlas *atlas, int page, struct font_atlas_box *box);

struct font_atlas_stats {
    long hits, drawn, shelves_emptied;
    int glyphs_count, shelves_count;
    size_t bytes; /* of pages */
};
/* Since it was created. */
void font_atlas_stats_get(const struct font_atlas *atlas, struct font_atlas_stats *out);

#endif
