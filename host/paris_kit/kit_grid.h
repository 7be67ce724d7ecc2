/* kit_grid.h - a VP set of two axes whose front-end arrays are rows from the top.
 *
 *     struct kit_grid g;
 *     kit_grid_make(&g, 640, 480);                     in place of kit_enter(): kit_leave()
 *                                                      tells what failed
 *     kit_grid_f_write(&g, field, floats);             floats: 480 rows of 640
 *     kit_grid_narrow(&g, 1, 1, 639, 479);             not on the rim
 *     ...
 *     kit_grid_widen(&g);
 *     kit_grid_free(&g);
 *
 * NEWS axis 0 is y and axis 1 is x. Between kit_enter() and kit_leave(), but for
 * kit_grid_free(). */
#ifndef LUTETIA_PARIS_KIT_GRID_H
#define LUTETIA_PARIS_KIT_GRID_H

#include <cm/paris.h>

enum { KIT_AXIS_Y = 0, KIT_AXIS_X = 1 };

struct kit_grid {
    int width, height;
    int x_bits, y_bits; /* the length of a coordinate */
    CM_vp_set_id_t vp_set;
    CM_geometry_id_t geometry;
    CM_field_id_t x_coord, y_coord; /* unsigned, of x_bits and y_bits */
    CM_field_id_t context;          /* the context that kit_grid_narrow() saved; 1 bit */
};

/* The bits that hold the coordinates 0..length-1. */
int kit_coordinate_bits(int length);

/* Makes the VP set and its fields, and calls kit_enter(); every processor is active. */
void kit_grid_make(struct kit_grid *g, int width, int height);
/* Deallocates the VP set with all its fields. A grid of zeros is fine. */
void kit_grid_free(struct kit_grid *g);

/* Saves the context and narrows it to x1 <= x < x2, y1 <= y < y2, clipped to the grid. */
void kit_grid_narrow(const struct kit_grid *g, int x1, int y1, int x2, int y2);
void kit_grid_widen(const struct kit_grid *g);

/* Writes a whole field, whatever the context: single floats, or unsigned numbers of `bits`
 * bits whose type in the array is `type` (CM_32_bit...). */
void kit_grid_f_write(const struct kit_grid *g, CM_field_id_t d, const void *floats);
void kit_grid_f_read(const struct kit_grid *g, void *floats, CM_field_id_t a);
void kit_grid_u_write(const struct kit_grid *g, CM_field_id_t d, unsigned bits,
                      const void *numbers, unsigned type);
void kit_grid_u_read(const struct kit_grid *g, void *numbers, CM_field_id_t a, unsigned bits,
                     unsigned type);

/* A part of a field: processors x1 <= x < x1 + width and so on; they lie in the front end's
 * rows from column `column` and row `row` on. As above otherwise; bits = 0: single floats;
 * numbers of more than 32 bits are 64 bits long in the array, the others 32. */
struct kit_block {
    int x1, y1, width, height;
    int column, row, array_width, array_height;
};
void kit_grid_block_write(const struct kit_block *block, CM_field_id_t d, unsigned bits,
                          const void *array);
void kit_grid_block_read(const struct kit_block *block, void *array, CM_field_id_t a,
                         unsigned bits);

#endif
