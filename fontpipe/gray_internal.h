/* gray_internal.h - what gray.c hands to the kernels, which are compiled once for each
 * instruction set. */
#ifndef LUTETIA_FONT_GRAY_INTERNAL_H
#define LUTETIA_FONT_GRAY_INTERNAL_H

#include "filter_internal.h"
#include "gray.h"

#include <stdint.h>

enum {
    FONT_MARGIN_ROWS =
        16, /* above and below a band: what is written there belongs to another */
    FONT_NARROW_STRIDE =
        32, /* of pictures of up to 16 columns and 5 taps, and where odd blocks begin there */
    FONT_NARROW_ODD = 8,
    FONT_SUMS_FLOATS = 1 << 16, /* of a band */
    FONT_NARROW_ROWS = FONT_SUMS_FLOATS / FONT_NARROW_STRIDE - 2 * FONT_MARGIN_ROWS
};

/* The sums are differences between rows: row r of the band is at sums + (FONT_MARGIN_ROWS +
 * r) * stride. */
struct font_gray_job {
    const struct font_filter *filter;
    const float *node_x, *node_y, *node_weight;
    const float *line_x0, *line_x1, *line_y;
    const struct font_arc *arcs;
    int nodes_count, lines_count, arcs_count;
    float ax, ay; /* a = x + ax: the column, and the place between two, where the taps begin */
    int width, stride, pitch;
    int odd;       /* where a row's odd blocks begin (see gray_kernel.h); 0: there are none */
    int row, rows; /* the band */
    int banded;    /* there is more than one */
    float *sums, *carry; /* carry: the row above the band, width rounded up to 16 */
    uint8_t *out;        /* of the band's first row */
    float *exact;        /* or NULL */
};

/* font_gray_place(), and the job's ax and ay. */
enum font_status font_gray_place_at(struct font_gray *gray, const struct font_edges *edges,
                                    const struct font_filter *filter, double x_px, double y_px,
                                    float *ax, float *ay);

void font_gray_kernel_plain(const struct font_gray_job *job);
void font_gray_kernel_avx2(const struct font_gray_job *job);
void font_gray_kernel_avx512(const struct font_gray_job *job);

#endif
