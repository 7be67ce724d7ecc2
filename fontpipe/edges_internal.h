/* edges_internal.h - what edges.c and the kernels that take outlines apart share. */
#ifndef LUTETIA_FONT_EDGES_INTERNAL_H
#define LUTETIA_FONT_EDGES_INTERNAL_H

#include "edges.h"
#include "filter_internal.h"

#include <math.h>
#include <stdint.h>

/* A line whose ends differ less in y is horizontal: it is then wrong by less than a tenth of a 255th. */
#define FONT_FLAT_PX 4e-4f
#define FONT_MOTE_PX 0.02f  /* a curve so short is its chord */
#define FONT_SPECK_PX 0.06f /* a cubic so short needs two nodes, not three */
#define FONT_BEND_PX2 0.03f /* the square of how far a quadratic's second difference reaches */
#define FONT_LENGTH_LAST 6.727f /* the longest piece that was measured */

/* Room for more; eight floats past what is asked for may be written. */
enum font_status font_nodes_reserve(struct font_edges *e, int more);
enum font_status font_lines_reserve(struct font_edges *e, int more);

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

/* The number of nodes that an edge needs. If that is more than there can be, *pieces is the
 * number of pieces to cut it into. across, down: the distances along x and y, where the edge is
 * flattest. */
static inline int font_nodes_needed(const struct font_filter *f, float length, float across,
                                    float down, int *pieces)
{
    int s = (down > 0.2f * across) + (down > 0.5f * across) + (down > across) +
            (down > 2 * across) + (down > 5 * across);
    int n = length > FONT_LENGTH_LAST ? (int)ceilf(length / FONT_LENGTH_LAST) : 1;
    for (;; n += 1 + n / 4) {
        /* The bin of length / n, a quarter of a pixel times the fourth root of 2 each, from the number's exponent. */
        float quarter = 4 * length / (float)n, power = quarter * quarter * quarter * quarter;
        union {
            float number;
            uint32_t bits;
        } u = {.number = power};
        int l = (int)(u.bits >> 23) - 126;
        l = l < 0 ? 0 : l > FONT_LENGTHS - 1 ? FONT_LENGTHS - 1 : l;
        const float *error = f->node_error[s][l];
        /* The pieces' errors add up where they lie above each other, but not all with one sign. */
        float allowed = f->piece_tolerance * (n > 1 ? sqrtf((float)n) : 1);
        int m = 1;
        for (int k = 0; k < FONT_NODES_MAX;
             k++) /* errors fall: as many as are too large, and one */
            m += error[k] * across > allowed;
        if (m <= FONT_NODES_MAX ||
            (float)n > 8 * length) { /* or an eighth of a pixel: as fine as it gets */
            *pieces = n;
            return m <= FONT_NODES_MAX ? m : FONT_NODES_MAX;
        }
    }
}

/* ---- nodes, eight at a time ---- */

typedef int eight_ints __attribute__((vector_size(32)));
typedef float eight __attribute__((vector_size(32)));
typedef float eight_loose __attribute__((vector_size(32), aligned(4), may_alias));

extern float font_gauss_at_single[FONT_NODES_MAX + 1][8];
extern float font_gauss_weight_single[FONT_NODES_MAX + 1][8];

/* A curve as polynomials in t: x = x0 + t (c + t (b + t a)). */
struct font_cubic {
    float x, cx, bx, ax, y, cy, by, ay;
};

/* The least and the most of what was put, in eight lanes. */
struct font_range {
    eight x0, x1, y0, y1;
};

#define FONT_CHOSEN(a, b, mask)                                                                \
    ((eight)(((eight_ints)(a) & (mask)) | ((eight_ints)(b) & ~(mask))))

/* By address: a vector as an argument would depend on the instruction set. */
static inline void font_range_add(struct font_range *r, const eight *px, const eight *py)
{
    eight x = *px, y = *py;
    r->x0 = FONT_CHOSEN(x, r->x0, x < r->x0);
    r->x1 = FONT_CHOSEN(x, r->x1, x > r->x1);
    r->y0 = FONT_CHOSEN(y, r->y0, y < r->y0);
    r->y1 = FONT_CHOSEN(y, r->y1, y > r->y1);
}

/* m nodes on each of the pieces. There is room for eight more than are kept; those are at t = 0. */
static inline void font_nodes_put(struct font_edges *e, const struct font_cubic *c, int m,
                                  int pieces, float side, struct font_range *range)
{
    float part = 1 / (float)pieces;
    eight at = *(const eight *)font_gauss_at_single[m] * part;
    eight weight = *(const eight *)font_gauss_weight_single[m] * (part * side);
    int count = e->nodes_count;
    for (int k = 0; k < pieces; k++, count += m) {
        eight t = at + (float)k * part;
        eight x = c->x + t * (c->cx + t * (c->bx + t * c->ax));
        eight y = c->y + t * (c->cy + t * (c->by + t * c->ay));
        *(eight_loose *)(e->node_x + count) = x;
        *(eight_loose *)(e->node_y + count) = y;
        *(eight_loose *)(e->node_weight + count) =
            weight * (c->cx + t * (2 * c->bx + t * (3 * c->ax)));
        font_range_add(range, &x, &y);
    }
    e->nodes_count = count;
}

/* count nodes, evenly spaced. There is room for eight more; those are at t = 1. */
static inline void font_nodes_even(struct font_edges *e, const struct font_cubic *c, int count,
                                   float side, struct font_range *range)
{
    const eight lanes = {0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f}, one = lanes * 0 + 1;
    float part = 1 / (float)count, *weights = e->node_weight + e->nodes_count;
    for (int k = 0; k < count; k += 8) {
        eight t = (lanes + (float)k) * part;
        t = FONT_CHOSEN(t, one, t < one);
        eight x = c->x + t * (c->cx + t * (c->bx + t * c->ax));
        eight y = c->y + t * (c->cy + t * (c->by + t * c->ay));
        *(eight_loose *)(e->node_x + e->nodes_count + k) = x;
        *(eight_loose *)(e->node_y + e->nodes_count + k) = y;
        *(eight_loose *)(weights + k) =
            (c->cx + t * (2 * c->bx + t * (3 * c->ax))) * (part * side);
        font_range_add(range, &x, &y);
    }
    for (int k = 0; k < 3; k++) {
        weights[k] *= font_even_weight[k];
        weights[count - 1 - k] *= font_even_weight[k];
    }
    e->nodes_count += count;
}

#endif
