/* edges_internal.h - what edges.c and the kernels that take outlines apart share. */
#ifndef LUTETIA_FONT_EDGES_INTERNAL_H
#define LUTETIA_FONT_EDGES_INTERNAL_H

#include "edges.h"
#include "filter_internal.h"

#include <math.h>
#include <stdint.h>

/* A line whose ends differ less in y is horizontal: it is then wrong by less than a tenth of a
 * 255th. */
#define FONT_FLAT_PX 4e-4f
#define FONT_MOTE_PX 0.02f  /* a curve so short is its chord */
#define FONT_SPECK_PX 0.06f /* a cubic so short needs two nodes, not three */
#define FONT_BEND_PX2 0.03f /* the square of how far a quadratic's second difference reaches */

enum { FONT_EDGES_PAD = 16 }; /* floats behind an array's last, which drawing reads */
/* edges_reserve.c: room for more; eight floats past what is asked for may be written. */
enum font_status font_nodes_reserve(struct font_edges *e, int more);
enum font_status font_lines_reserve(struct font_edges *e, int more);
/* Where there is room: ink below the line is positive from x0 to an x1 to the right of it. */
static inline void font_edges_line(struct font_edges *e, double x0, double x1, double y)
{
    int i = e->lines_count++;
    e->line_x0[i] = (float)x0;
    e->line_x1[i] = (float)x1;
    e->line_y[i] = (float)y;
}
/* edges_tangled.c: of a tangled outline, as lines alone. Errors: BAD_ARGUMENT (a point has no
 * picture), NO_MEMORY. */
enum font_status font_edges_tangled(struct font_edges *e, const struct font_outline *o,
                                    const struct font_map *map, const struct font_filter *f);

/* An outline through an affine map whose inside is below its edges where side is 1. */
struct font_edges_job {
    struct font_edges *edges;
    const struct font_outline *outline;
    const struct font_filter *filter;
    float m[6];
    float side;
};
enum font_status font_edges_kernel_plain(const struct font_edges_job *job);
enum font_status font_edges_kernel_avx2(const struct font_edges_job *job);
enum font_status font_edges_kernel_avx512(const struct font_edges_job *job);
/* The one that font_simd_use() chose, or this thread. */
enum font_status font_edges_kernel(const struct font_edges_job *job);

/* Of the table of errors: the first slant that is as steep as down over across, or the last. */
static inline int font_slant(double across, double down)
{
    int s = 0;
    for (int k = 0; k < FONT_SLANTS - 1; k++)
        s += down > font_slants[k] * across;
    return s;
}

/* The number of nodes that an edge needs. If that is more than there can be, *pieces is the
 * number of pieces to cut it into. across: the distance along x; slant: where it is
 * flattest. */
int font_nodes_needed(const struct font_filter *f, float length, float across, int slant,
                      int *pieces);

/* Rules: how eight nodes lie, and their weights. The first: evenly spaced ones at the beginning
 * of an edge, with half of a spacing before them; then those of Gauss with 1, 2, .. nodes; the
 * last: evenly spaced ones from the ninth on. */
enum { FONT_RULE_EVEN_LATER = FONT_NODES_MAX + 1, FONT_RULES };
extern float font_rule_places[FONT_RULES * 8], font_rule_weights[FONT_RULES * 8];
/* What weights of evenly spaced nodes are multiplied with besides: eight in the middle, the
 * last three, and what is beyond. */
extern float font_even_ends[18];

#endif
