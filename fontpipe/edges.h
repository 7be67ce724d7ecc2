/* edges.h - an outline taken apart for a size: what the gray level is made of, and what is
 * worth keeping.
 *
 *     struct font_map map = font_map_size(12.25, outline.units_per_em);
 *     struct font_edges edges = {0};
 *     if (font_edges_build(&edges, &outline, &map, filter) != FONT_OK)
 *         die(font_error());
 *     // at any place between pixels, any number of times
 *     font_gray_draw(&gray, &edges, filter, x_px, y_px);
 *     font_edges_finish(&edges);
 *
 * Edges are in pixels, y downwards, relative to the glyph's origin: a size, a rotation, a
 * distortion are in them, the place is not. Curves are points on the curve itself with weights
 * (Gauss's nodes), as many as keep what they are wrong by below a tenth of a 255th each;
 * horizontal lines are their two ends; vertical ones are nothing at all. For filters that are
 * areas they are arcs instead (arcs.h). See docs/fonts.md.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: edges' arrays are their own; font_edges_finish() frees them. What is passed stays
 * the caller's.
 *
 * Threads: building writes the edges alone; drawing reads them. */
#ifndef LUTETIA_FONT_EDGES_H
#define LUTETIA_FONT_EDGES_H

#include "arcs.h"
#include "filter.h"
#include "outline.h"

/* How an outline's plane becomes the picture's. */
enum font_map_kind { FONT_AFFINE, FONT_PROJECTIVE, FONT_BILINEAR, FONT_SMOOTH };
enum { FONT_MAP_NUMBERS = 15 };
struct font_map {
    enum font_map_kind kind;
    /* Affine: x' = m[0] x + m[1] y + m[2], y' = m[3] x + m[4] y + m[5]. Projective: both over
     * m[6] x + m[7] y + m[8]. Bilinear: x' = m[0] + m[1] x + m[2] y + m[3] x y, y' = m[4] +
     * m[5] x + m[6] y + m[7] x y. Smooth: both of these over m[8] + m[9] x + m[10] y + m[11] x
     * y. Of a bilinear or smooth one after another map x y stands for m[12] x^2 + (1 + m[13]) x
     * y + m[14] y^2. */
    double m[FONT_MAP_NUMBERS];
};

/* Upright at a size: an em is that many pixels, y turned downwards. */
struct font_map font_map_size(double size_px, double units_per_em);
/* First the one, then the other, an affine one: affine * map. */
struct font_map font_map_then(struct font_map map, struct font_map affine);
/* Counterclockwise as one sees it; and a slant to the right by x for each y upwards. */
struct font_map font_map_rotation(double degrees);
struct font_map font_map_shear(double x_per_y);
/* The rectangle (x0, y0)..(x1, y1), y downwards, onto four corners: of (x0, y0), (x1, y0), (x1,
 * y1), (x0, y1). SMOOTH: projective where the corners are well apart from a dent, bilinear
 * where they are not, and continuous between (dynamics/quad/quad.h); the kind of *out is what
 * it is. It exists for any corners, but where they make a dent, or sides cross, the glyph may
 * be folded over. Errors: BAD_ARGUMENT if the corners have no such map (three on a line, or a
 * side turned over). */
enum font_status font_map_corners(enum font_map_kind kind, double x0, double y0, double x1,
                                  double y1, const struct font_point corners[4],
                                  struct font_map *out);
/* `second` of any kind after an affine `first`. Errors: BAD_ARGUMENT (`first` is not
 * affine). */
enum font_status font_map_compose(const struct font_map *first, const struct font_map *second,
                                  struct font_map *out);
/* False if the point has no picture. jacobian: xx, xy, yx, yy. */
bool font_map_point(const struct font_map *map, struct font_point from, struct font_point *to,
                    double jacobian[4]);

/* The outline in the picture, its curves as short lines: for maps that fold it over, whose
 * edges cannot be built from the outline itself. Not prepared, in pixels: FONT_NONZERO fills
 * what is covered from either side. Owns: the caller finishes *out, which is empty on failure.
 * Errors: BAD_ARGUMENT (a point has no picture, or the outline was rebuilt when it was
 * prepared), NO_MEMORY. */
enum font_status font_outline_mapped(const struct font_outline *outline,
                                     const struct font_map *map, struct font_outline *out);

/* All zeros is no edges. */
struct font_edges {
    float *node_x, *node_y, *node_weight;
    float *line_x0, *line_x1, *line_y;
    int nodes_count, lines_count;
    struct font_arc *arcs; /* where there are some, there are no nodes and no lines */
    int arcs_count, arcs_capacity;
    float x0, y0, x1, y1; /* around all of them, if there are any */
    double advance_px;    /* of an affine map along the x-axis, else that many font units */
    void *memory;
    int nodes_capacity, lines_capacity;
};

/* Frees the arrays, and leaves no edges. */
void font_edges_finish(struct font_edges *e);

/* Replaces what the edges hold. The outline must be prepared. filter: whose smoothness says how
 * finely. Errors: BAD_ARGUMENT (numbers that are not finite, a map that folds the glyph over or
 * sends it beyond the horizon), TOO_LARGE (past FONT_SIDE_MAX pixels, or too many edges),
 * NO_MEMORY; the edges are then empty. */
enum font_status font_edges_build(struct font_edges *e, const struct font_outline *outline,
                                  const struct font_map *map, const struct font_filter *filter);
/* The same as nodes and lines, whatever the filter, never as arcs: what OpenCL draws, and what
 * arcs are tested against. Errors: as font_edges_build(). */
enum font_status font_edges_build_tabled(struct font_edges *e,
                                         const struct font_outline *outline,
                                         const struct font_map *map,
                                         const struct font_filter *filter);

/* Pixels that a picture's side may have, and how far from the origin it may be. */
enum { FONT_SIDE_MAX = 32768, FONT_EDGES_MAX = 40000000 };

#endif
