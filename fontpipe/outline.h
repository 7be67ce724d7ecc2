/* outline.h - the pipeline's first level: a glyph's outline as curves.
 *
 *     struct font_outline outline = {0};
 *     font_outline_move(&outline, 0, 0);
 *     font_outline_line(&outline, 500, 1000);
 *     font_outline_line(&outline, 1000, 0);
 *     font_outline_close(&outline);
 *     outline.units_per_em = 1000;
 *     if (font_outline_prepare(&outline, FONT_NONZERO) != FONT_OK)
 *         die(font_error());
 *     ...
 *     font_outline_finish(&outline);
 *
 * Units. The font's own, y upwards, 0 on the baseline. Curves are straight lines and Bezier
 * curves of second and third degree; they are kept as curves until they meet pixels.
 *
 * Prepared. What is filled afterwards must be covered once: font_outline_prepare() looks for
 * parts that are covered twice (contours that overlap or cross themselves, as variable fonts
 * have them) and replaces such an outline by the boundary of what the rule fills. Most outlines
 * have none and stay as they are. A prepared outline is not written to: adding to it or
 * emboldening it makes it one that is not prepared.
 *
 * Tangled. An outline that crosses itself some hundred thousand times, and more, stays as it
 * is, and what its rule fills is found each time that its edges or its master are made
 * (edges_tangled.c). That takes at most about a second; docs/fonts.md says how exact it is.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: an outline's arrays are its own; font_outline_finish() frees them.
 *
 * Threads: an outline belongs to one thread at a time while it is changed; any number may read
 * a prepared one. */
#ifndef LUTETIA_FONT_OUTLINE_H
#define LUTETIA_FONT_OUTLINE_H

#include "status.h"

#include <stdbool.h>

struct font_point {
    double x, y;
};

struct font_box {
    double x0, y0, x1, y1;
};

/* Degree 1..3; p[0] is where it begins and p[degree] where it ends. */
struct font_segment {
    int degree;
    int contour;
    struct font_point p[4];
};

enum font_fill { FONT_NONZERO, FONT_EVEN_ODD };

/* All zeros is an empty outline. */
struct font_outline {
    struct font_segment *segments;
    int segments_count, segments_capacity;
    int contours_count;
    double units_per_em;
    double advance; /* to the next glyph's origin */
    /* Set by font_outline_prepare(). */
    bool prepared;
    /* parts were covered more than once: segments are pieces of a boundary, in no order */
    bool rebuilt;
    bool tangled; /* it may cover parts more than once: filled by `rule` where it is drawn */
    enum font_fill rule;
    int turn; /* +1 the inside is on the right of its segments (y upwards), -1 on the left */
    int crossings;       /* of segments that were found */
    struct font_box box; /* of all its points */
    /* Segments as polynomials, for edges: x0 + t (c + t (b + t a)); see edges_kernel.h. */
    float *polynomials;
    int polynomials_stride;
    /* The drawing's side of font_outline_move() and so on. */
    struct font_point first, last;
    bool open;
};

enum { FONT_SEGMENTS_MAX = 100000 };

/* Whether a rule fills what has this winding number. */
static inline bool font_fill_has(int winding, enum font_fill rule)
{
    return rule == FONT_EVEN_ODD ? (winding & 1) != 0 : winding != 0;
}

void font_outline_finish(struct font_outline *o); /* frees; zeros it */
/* Replaces what *to holds. Errors: NO_MEMORY. */
enum font_status font_outline_copy(const struct font_outline *from, struct font_outline *to);

/* Errors: TOO_LARGE past FONT_SEGMENTS_MAX, NO_MEMORY, BAD_ARGUMENT for numbers that are not
 * finite or beyond 1e7. A contour that is left open is closed by a line. */
enum font_status font_outline_move(struct font_outline *o, double x, double y);
enum font_status font_outline_line(struct font_outline *o, double x, double y);
enum font_status font_outline_quad(struct font_outline *o, double cx, double cy, double x,
                                   double y);
enum font_status font_outline_cubic(struct font_outline *o, double c0x, double c0y, double c1x,
                                    double c1y, double x, double y);
enum font_status font_outline_close(struct font_outline *o);

/* See above. Errors: NO_MEMORY; the outline is as it was. */
enum font_status font_outline_prepare(struct font_outline *o, enum font_fill rule);
/* The same by strips alone (fill.c), whatever the outline: slower, what font_outline_prepare()
 * is tested against. Errors: TOO_LARGE for outlines that cross too often, NO_MEMORY; the
 * outline is as it was. */
enum font_status font_outline_prepare_by_strips(struct font_outline *o, enum font_fill rule);

/* Moves the outline outwards by half of the amounts on each side: what stem darkening asks for,
 * and fake bold. Units: the font's. Before it is prepared. Errors: BAD_ARGUMENT, TOO_LARGE,
 * NO_MEMORY. */
enum font_status font_outline_embolden(struct font_outline *o, double x, double y);

/* Where the curve is at t, and how fast it goes there. */
struct font_point font_segment_at(const struct font_segment *s, double t,
                                  struct font_point *speed);
/* The part from t0 to t1 (t1 < t0: turned around). */
struct font_segment font_segment_part(const struct font_segment *s, double t0, double t1);

/* Of all the points, those that curves only lean to included; zeros if there is none. */
struct font_box font_outline_box(const struct font_outline *o);

#endif
