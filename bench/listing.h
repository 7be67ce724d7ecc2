/* listing.h - the diffusion step as a C/Paris program.
 *
 *     struct listing sheet = {.width = 1024, .height = 1024, ...};
 *     listing_allocate(&sheet);
 *     ...fill sheet.water, sheet.absorbency, sheet.pigment...
 *     listing_step(&sheet);
 *
 * The program uses only <cm/paris.h>.
 */
#ifndef LUTETIA_BENCH_LISTING_H
#define LUTETIA_BENCH_LISTING_H

#include <cm/paris.h>

struct listing {
    int width, height;  /* fibers */
    int x0, y0, x1, y1; /* the rectangle that takes part: x0 <= x < x1, y0 <= y < y1 */
    unsigned int significand, exponent; /* lengths of the float fields: 23 and 8 */
    unsigned int axis_x, axis_y;
    double gravity, molecular_weight[3];

    CM_field_id_t water, absorbency, pigment[3];
    CM_field_id_t inflow, inward, outward; /* of the present axis and substance */
    CM_field_id_t x, y;                    /* coordinates */
    unsigned int coordinate_bits;
    CM_field_id_t caller_context, kept_context; /* one bit each */
};

/* Makes a VP set of height by width and selects it; allocates all fields on the heap (zero).
 * Rectangle: all but two fibers at each edge. Sets all but gravity and the weights from width
 * and height. */
void listing_allocate(struct listing *l);
void listing_step(const struct listing *l);

#endif
