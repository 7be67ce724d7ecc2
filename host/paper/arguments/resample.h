/* resample.h - resamples a grid of numbers, by a tent two sources wide, or two new places
 * wide where there are fewer new places. */
#ifndef LUTETIA_PAPER_RESAMPLE_H
#define LUTETIA_PAPER_RESAMPLE_H

#include <stdbool.h>

/* Computes new[x, y], a grid whose 0, 0 is at x0, y0 of the new sheet, from an old one whose
 * 0, 0 is at old_x, old_y of the old sheet. Beyond the old grid's edges numbers are 0, or
 * those at the edge. */
struct paper_resampling {
    double scale;
    int x0, y0, width, height;
    int old_x, old_y, old_width, old_height;
    bool edge_goes_on;
};

/* Shape: `old` holds old_height rows of old_width, `new` height rows of width. False: no
 * memory. */
bool paper_resample(const struct paper_resampling *r, const float *old, float *new);
/* Replaces *values, an allocated array, by one of the new size. */
bool paper_array_resample(const struct paper_resampling *r, const float **values);

#endif
