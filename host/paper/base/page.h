/* page.h - the fields of a sheet in the machine.
 *
 * A sheet is one VP set; each fiber is a virtual processor whose memory is laid out so (w and h
 * are the bits that hold the sheet's width and height):
 *
 *     bits     field
 *     24       image            what is shown: red, green, blue at 0, 8, 16
 *     23+8+1   absorbency
 *     23+8+1   water
 *     23+8+1   cyan, magenta, yellow: three fields
 *     24       fiber_color      of the dry fiber: red, green, blue at 0, 8, 16
 *     w, h     x_coord, y_coord
 *     1, 1     context, inner_context
 *     23+8+1   inflow, inward, outward, scratch: four temporaries
 *
 * NEWS axis 0 is y and axis 1 is x, so the front end's arrays are rows from the top.
 */
#ifndef LUTETIA_PAPER_PAGE_H
#define LUTETIA_PAPER_PAGE_H

#include "base/base.h"

#include <kit_float.h>
#include <kit_grid.h>

enum { PAPER_CHANNEL_BITS = 8, PAPER_IMAGE_BITS = 24 };

struct paper {
    struct kit_grid grid;
    CM_field_id_t image;
    CM_field_id_t absorbency;
    CM_field_id_t water;
    CM_field_id_t pigment[3]; /* cyan, magenta, yellow */
    CM_field_id_t fiber_color;
    CM_field_id_t inner_context; /* saved while the context is narrowed to a rectangle of the
                                  * grid */
    CM_field_id_t inflow, inward, outward, scratch;
};

/* Attaches the machine if it is not attached yet, and handles its errors from then on. */
enum paper_status paper_attach(void);

/* Makes the sheet's VP set current and clears earlier failures of the machine. */
void paper_enter(struct paper *p);
/* The first failure of the machine since paper_enter(), as a status, with its message in
 * paper_error(). */
enum paper_status paper_leave(struct paper *p);

enum paper_status paper_weather_check(const struct paper_weather *weather);
/* One cycle on any number of pigments, with a molecular weight for each; every processor is
 * active before and after. */
void paper_cycle(struct paper *p, const struct paper_weather *weather,
                 const CM_field_id_t *pigments, const double *weights, int count);

/* Fills absorbency and fiber_color according to the configuration. */
void paper_fibers_make(struct paper *p, const struct paper_config *config);

#endif
