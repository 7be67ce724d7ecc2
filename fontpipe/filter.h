/* filter.h - filters as tables: what a point of ink adds to the pixels around it.
 *
 *     struct font_filter *filter;
 *     if (font_filter_create_named("gaussian-fast", &filter) != FONT_OK)
 *         die(font_error());
 *     ...
 *     font_filter_destroy(filter);
 *
 * A filter is a function f(u, v) of the distance from a pixel's centre, 0 beyond its radius in
 * u and in v, whose integral is 1. A pixel is the integral of f over the ink. Box, Gaussians,
 * Mitchell and Lanczos are products h(u) h(v). Pillbox, cone and round samples are not; they
 * are stored as the sum of a few products, the leading eigenvectors of f, as many as it takes
 * for the rest to be invisible (font_filter_info.residual says how much it is).
 *
 * Tables. From h and its integral H come, for 32 positions of a point between two pixels, what
 * it adds to each pixel in its row (taps), and what a horizontal edge of the ink adds to each
 * row, as differences between rows. Between the positions they are interpolated. Source: Naiman
 * and Fournier, Rectangular convolution for fast filtering of characters, SIGGRAPH 1987, for
 * the tables; docs/fonts.md for what is done with them.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: what is passed is copied; a filter's texts are valid as long as the filter.
 *
 * Threads: a filter is read only once it is made; any number of threads may use it. */
#ifndef LUTETIA_FONT_FILTER_H
#define LUTETIA_FONT_FILTER_H

#include "status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct font_filter;

enum { FONT_FILTER_RADIUS_MAX = 4, FONT_FILTER_SAMPLES_MAX = 256 };

/* One of font_filter_names(), with `:RADIUS` (0.25..4 pixels) if wanted; gaussian:SIGMA,RADIUS;
 * samples:RADIUS,S0,S1,... (of h: a product) and round:RADIUS,S0,S1,... (of f along a radius),
 * 2..256 samples from the centre outwards. Errors: BAD_ARGUMENT, NO_MEMORY. A filter whose
 * integral is not positive is refused. Owns: the caller destroys *out. */
enum font_status font_filter_create_named(const char *name, struct font_filter **out);
/* The words of a filter that stand in a file, as one name: with commas for what parts them,
 * without lines' rests from # on. Shape: out has count + 1 bytes. */
void font_filter_words(const char *text, size_t count, char *out);
/* The simple ones; NULL ends them; constants, valid for ever. */
const char *const *font_filter_names(void);
void font_filter_destroy(struct font_filter *filter); /* NULL is fine */

/* What is known of a filter once its table is made. */
struct font_filter_info {
    const char *name;
    double radius_px;
    int terms, taps;
    double residual;      /* of 1: what the stored products leave out at an edge, at most */
    double raw_integral;  /* before it was normalised */
    double peak;          /* f in the centre */
    double half_width_px; /* h is above half its peak over this width */
    double ripple;     /* how much a thin line's weight changes with its place between pixels */
    double undershoot; /* how far beyond 0 and 1 the picture of an edge goes */
    double response_nyquist; /* of a wave of two pixels; 1 is all of it */
    double response_pixel;   /* of a wave of one pixel: what turns into moire */
    const char *drawn;       /* how edges are integrated, in words */
    double step_px;          /* in steps; else 0 */
    size_t bytes;            /* of the tables */
};
void font_filter_describe(const struct font_filter *filter, struct font_filter_info *out);

/* f itself, in double precision, without table: for gold and for plots. */
double font_filter_at(const struct font_filter *filter, double u, double v);
/* The integral of f(s, v) over s from below up to u. */
double font_filter_row_integral(const struct font_filter *filter, double u, double v);
/* The same over v too: what a corner of ink adds. For round filters by numbers, slowly. */
double font_filter_edge(const struct font_filter *filter, double u);

/* Displays that a filter is chosen for. */
enum font_display { FONT_DISPLAY_LCD, FONT_DISPLAY_CRT, FONT_DISPLAY_PRINT };
/* How a filter shows lines of a width on a display: what is lost of their contrast in the mean,
 * how unevenly it shows as they move between pixels (the root of the mean square), how far an
 * edge goes beyond 0 and 1; of 1 each. cost: the first's square, nine times the second's and
 * four times the third's: what is least suits best. */
struct font_filter_fit {
    double lost, uneven, rings, cost;
};
struct font_filter_fit font_filter_fit(const struct font_filter *filter, double detail_px,
                                       enum font_display display);
/* Names the filter that shows lines of this width best: of the usual ones the one with the
 * least sum of squares of the contrast that a line loses, through the display's own spot, and
 * of how unevenly it shows as it moves between pixels. detail_px: the smallest detail, a stem
 * or a hairline. Never NULL; a constant, valid for ever. */
const char *font_filter_choose(double detail_px, enum font_display display);

#endif
