/* studio_swatch.h - the colour that paint has on a paper, for swatches, cursors and ghosts.
 *
 *     double rgb[3];
 *     studio_swatch(&config, amount, rgb);
 *
 * It is what a dry layer of these amounts looks like by the sheet's rule (docs/paper.md:
 * Kubelka and Munk), even and without relief. */
#ifndef LUTETIA_STUDIO_SWATCH_H
#define LUTETIA_STUDIO_SWATCH_H

#include <sheet.h>

/* rgb: display values, 0..1. amount: as in paper_sheet_put(). Threads: any. */
void studio_swatch(const struct paper_sheet_config *config, const double *amount,
                   double rgb[3]);

#endif
