/* studio_mask.h - where a hand has swept: the discs along its way as a screen, with soft edges
 * a fiber wide.
 *
 *     struct paper_screen screen;
 *     int x, y;
 *     if (studio_mask_sweep(places, count, width, height, &screen, &x, &y) == PAPER_OK && screen.gray)
 *         paper_sheet_blot(sheet, &screen, x, y, 0.8, 0);
 *     paper_screen_destroy(&screen); */
#ifndef LUTETIA_STUDIO_MASK_H
#define LUTETIA_STUDIO_MASK_H

#include <sheet.h>

struct studio_disc {
    double x, y, radius; /* fibers */
};

/* Between two discs lies what a disc covers that goes from one to the other and grows evenly.
 * It is clipped to 0, 0, width, height; if nothing is left, the screen is empty (gray NULL).
 * Errors: NO_MEMORY. Owns: the caller destroys *screen. */
enum paper_status studio_mask_sweep(const struct studio_disc *discs, int count, int width,
                                    int height, struct paper_screen *screen, int *x, int *y);

#endif
