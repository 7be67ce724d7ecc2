/* fill_internal.h - what fill.c and fill_cut.c, fill_quick.c and fill_arcs.c share. */
#ifndef LUTETIA_FONT_FILL_INTERNAL_H
#define LUTETIA_FONT_FILL_INTERNAL_H

#include "internal.h"
#include "outline.h"

#include <math.h>
#include <stdint.h>

enum {
    FILL_CUTS_TIMES = 6,
    FILL_PIECES_MAX = 400000,
    FILL_PAIRS_MAX = 20000000,
    FILL_MOVES_MAX = 200000000, /* of what is sorted, all strips together */
    FILL_PIECES_OF_SEGMENT_MAX = 64
};

struct fill_piece {
    double x0, y0, x1, y1; /* y0 < y1 */
    double t0, t1;         /* of the segment, at y0 and y1 */
    int segment;
    int direction; /* +1: the outline rises along it */
};

/* Part of a piece that is boundary, as the result runs through it. */
struct fill_portion {
    double ta, tb;
    struct font_point a, b;
    int segment;
};

struct fill_end {
    double x;
    int change;
};

/* Where a piece is to be cut: a point of its curve. */
struct fill_cut {
    int piece;
    double t, x, y;
};

/* A piece of a strip across which the filling changes. */
struct fill_bound {
    const struct fill_piece *piece;
    bool entering;
};

/* A part of a segment along which neither coordinate turns around. */
struct fill_arc {
    struct font_point p[4];
    double t0, t1; /* of the segment */
    int degree, segment, contour;
    int next;    /* of its contour */
    bool joined; /* which begins where this one ends */
};

/* Where two arcs cross. twice: of the winding number there, the mean of those around, which
 * both arcs must find; once one is known. */
struct fill_joint {
    struct font_point at;
    int twice;
    bool known;
};

/* turn: by how much the winding number to the left of the arc changes there. */
struct fill_meet {
    int arc, joint, turn;
    double t;
};

/* An arc from one crossing to the next. */
struct fill_link {
    int arc, from, to; /* joints; -1: the arc's end */
    int turn;          /* where it ends: see fill_meet */
    int runs;          /* 1 it is kept, -1 turned around, 0 it is inside */
    double t0, t1;
};

struct fill_work {
    struct fill_piece *pieces;
    double *levels;
    struct fill_portion *portions;
    struct font_segment *flat; /* horizontal lines */
    struct fill_end *ends;
    int *active;
    double *middles; /* of the active ones */
    struct fill_bound *bounds;
    struct fill_cut *cuts;
    struct fill_arc *arcs;
    struct font_box *boxes; /* of the arcs */
    struct fill_joint *joints;
    struct fill_meet *meets;
    struct fill_link *links;
    int arcs_count, arcs_capacity, boxes_capacity, joints_capacity, meets_count, meets_capacity;
    int links_count, links_capacity, looks, pairs;
    bool spent; /* arcs or pairs were too many to be looked at one by one */
    int cuts_count, cuts_capacity;
    int pieces_count, pieces_capacity, levels_count, levels_capacity;
    int portions_count, portions_capacity, flat_count, flat_capacity;
    int ends_count, ends_capacity, active_capacity, middles_capacity, bounds_capacity;
    int crossings;
    int64_t moves;
    double grid; /* heights are multiples of it, so that what is all but equal is equal */
};

static inline double fill_height(const struct fill_work *w, double y)
{
    return rint(y / w->grid) * w->grid;
}

/* What changes evenly along a piece, `low` at y0 and `high` at y1. */
static inline double fill_piece_between(const struct fill_piece *p, double y, double low,
                                        double high)
{
    if (y <= p->y0)
        return low;
    if (y >= p->y1)
        return high;
    return low + (high - low) * ((y - p->y0) / (p->y1 - p->y0));
}

static inline double fill_piece_x(const struct fill_piece *p, double y)
{
    return fill_piece_between(p, y, p->x0, p->x1);
}

static inline double fill_piece_t(const struct fill_piece *p, double y)
{
    return fill_piece_between(p, y, p->t0, p->t1);
}

/* By the winding numbers met: more than none and one, or none and minus one. */
static inline bool fill_twice(int least, int most)
{
    return least < 0 ? most > 0 || least < -1 : most > 1;
}

static inline struct font_point fill_minus(struct font_point a, struct font_point b)
{
    return (struct font_point){a.x - b.x, a.y - b.y};
}

enum font_status fill_no_memory(void);
/* The outline as arcs, its points moved by at most `shake`. False: a curve comes back to its
 * beginning, there are too many, or there is no memory. */
bool fill_arcs_make(struct fill_work *w, const struct font_outline *o, double shake);
/* Notes where arcs cross, in joints and meets. False: it is not seen of all of them. */
bool fill_arcs_cross(struct fill_work *w);
struct font_point fill_arc_at(const struct fill_arc *a, double t, struct font_point *speed);
/* Finds the winding numbers from the curves, and where some of them are covered twice the
 * boundary, as portions. False: it cannot be seen so (contours touch, or there is no memory),
 * and nothing in w is of use. shaken_first: where they touch they are moved apart by what no
 * picture shows. */
bool fill_quick(struct fill_work *w, const struct font_outline *o, enum font_fill rule,
                bool shaken_first, int *least, int *most);
/* For qsort: by y0. */
int fill_pieces_compare(const void *a, const void *b);

/* Notes that both pieces are cut where their curves cross, so that they meet there in one
 * point; where that is on another piece, that both are halved, to be looked at again. y: where
 * the pieces cross. Errors: NO_MEMORY. */
enum font_status fill_crossing_cut(struct fill_work *w, const struct font_outline *o,
                                   const struct fill_piece *p, const struct fill_piece *q,
                                   double y);
/* Cuts the pieces as noted, and begins the levels anew. Errors: TOO_LARGE, NO_MEMORY. */
enum font_status fill_pieces_cut(struct fill_work *w);

#endif
