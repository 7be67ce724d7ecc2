/* gold.h - the same pictures by the definition, in double precision: what everything else is
 * measured against.
 *
 * Nothing is shared with the fast path but the outline, the map and the filter's formula:
 * curves are cut into steps of 1/96 pixel, the filter is evaluated there without a table, and
 * the integral runs along y where the fast path's runs along x. Slow: milliseconds a glyph. */
#ifndef LUTETIA_FONT_GOLD_H
#define LUTETIA_FONT_GOLD_H

#include "edges.h"
#include "gray.h"

/* Fills pixels[height * width], row by row, with the exact values (1 is full) of the pixels
 * that begin at (left, top), y downwards, for a glyph whose origin is at (x_px, y_px). The
 * outline is prepared. Errors: BAD_ARGUMENT as font_edges_build(), TOO_LARGE (a tangled
 * outline), NO_MEMORY. */
enum font_status font_gold_draw(const struct font_outline *outline, const struct font_map *map,
                                const struct font_filter *filter, double x_px, double y_px,
                                int left, int top, int width, int height, double *pixels);

/* How far a picture is from gold, over all of gold's pixels (those outside the picture are 0
 * there). */
struct font_difference {
    double max;           /* of 255 */
    double square_sum;    /* of 1; with pixels_count for the mean */
    double ink, ink_gold; /* sums */
    long pixels_count;
};
/* exact: compares gray->exact rather than the bytes. Adds to *sum. */
void font_gold_compare(const struct font_gray *gray, bool exact, int left, int top, int width,
                       int height, const double *gold, struct font_difference *sum);
/* How far gold's own bytes are from it: what no picture in bytes can do without. Adds to
 * *sum. */
void font_gold_bytes_compare(const double *gold, int count, struct font_difference *sum);
/* -10 log10 of the mean square over pixels_count; 1 is the peak. */
double font_difference_psnr(const struct font_difference *d); /* dB */

#endif
