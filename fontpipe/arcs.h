/* arcs.h - an outline taken apart for filters whose pictures are areas: the box and the
 * pillbox.
 *
 * An arc is a line or a quadratic curve, at t from 0 to 1 at (x + t (cx + t bx), y + t (cy + t
 * by)), in pixels, y downwards, in the direction that counts ink below it positive (see
 * edges.c). Vertical lines are left out. Outlines' quadratic curves are arcs exactly; cubic and
 * distorted ones are cut into arcs that follow them to FONT_ARC_TOLERANCE_PX. What else an arc
 * must be the filter says that it is drawn for: x does not turn around in it, nor y but in an
 * arc for discs; it goes at most arc_span_px along either, and is at most arc_bend_px beside
 * its chord. gray_area.h and gray_disc.h draw arcs. */
#ifndef LUTETIA_FONT_ARCS_H
#define LUTETIA_FONT_ARCS_H

#include "status.h"

#include <stdbool.h>

enum { FONT_ARC_SPAN_PX = 14 };
#define FONT_ARC_TOLERANCE_PX 1e-3f
#define FONT_DISC_BEND                                                                         \
    0.075f /* how far an arc is beside its chord at most, of a disc's radius */

struct font_arc {
    float x, y, cx, cy, bx, by;
};

struct font_edges;
struct font_filter;
struct font_map;
struct font_outline;

/* Adds the outline's arcs to the edges, and what they span to its x0, y0, x1, y1. side: 1 where
 * ink is below segments that go to the right, else -1. orientation: which way the map turns
 * things, 1 or -1. Errors: TOO_LARGE, NO_MEMORY; BAD_ARGUMENT of a distortion that folds the
 * glyph over. */
enum font_status font_arcs_build(struct font_edges *e, const struct font_outline *outline,
                                 const struct font_map *map, const struct font_filter *filter,
                                 int orientation, float side);

#endif
