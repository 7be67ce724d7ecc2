/* filter_patch.c - a filter's patches: what a node adds to the pixels around it, for each place
 * between four of them.
 *
 * A node of an edge adds F(X - x, Y - y) to a pixel, F being f's integral over y from below:
 * see edges.c. As differences between rows that is a patch of four rows, three columns wide.
 * Round filters have no shorter form. */
#include "filter_internal.h"
#include "internal.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = FONT_PATCH_PHASES + 1 };

/* F there, less a twelfth of its second differences: straight lines between such knots are
 * wrong by as much to either side. */
static double knot(const struct font_filter *f, double u, double v)
{
    const double d = 1.0 / FONT_PATCH_PHASES;
    double beside =
        font_filter_row_integral(f, v, u - d) + font_filter_row_integral(f, v, u + d) +
        font_filter_row_integral(f, v - d, u) + font_filter_row_integral(f, v + d, u);
    double here = font_filter_row_integral(f, v, u);
    return here - (beside - 4 * here) / 12;
}

enum font_status font_patches_make(struct font_filter *f)
{
    const size_t bytes = (size_t)SIDE * SIDE * FONT_PATCH_FLOATS * sizeof *f->patches;
    f->patches = aligned_alloc(64, bytes);
    if (!f->patches)
        return font_fail(FONT_NO_MEMORY, "no memory for a filter");
    memset(f->patches, 0, bytes);
    f->info.bytes += bytes;
    float *patch = f->patches;
    for (int py = 0; py < SIDE; py++)
        for (int px = 0; px < SIDE; px++, patch += FONT_PATCH_FLOATS)
            for (int c = 0; c < f->taps; c++) {
                double u = c + 1 - (double)px / FONT_PATCH_PHASES - f->radius, above = 0;
                for (int r = 0; r <= f->taps; r++) {
                    double v = r + 1 - (double)py / FONT_PATCH_PHASES - f->radius;
                    double here = knot(f, u, v);
                    patch[r * FONT_PATCH_ROW + c] = (float)(here - above);
                    above = here;
                }
            }
    return FONT_OK;
}
