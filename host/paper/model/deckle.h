/* deckle.h - where a handmade sheet ends, on the front end. */
#ifndef LUTETIA_PAPER_DECKLE_H
#define LUTETIA_PAPER_DECKLE_H

#include "sheet.h"

/* `inside` = how far each fiber lies inside the edge, in fibers; below 0 beyond it. `scale` as
 * of felt_scale(). By sums, products, quotients and square roots alone. Shape: height * width
 * numbers, rows from the top; `spare` as many. False: no memory. */
bool deckle_make(const struct paper_sheet_config *config, double scale, float *inside,
                 float *spare);

/* From that depth on a fiber of the pulp lies in the sheet; 0 <= chance < 1: by chance. */
double deckle_reach(const struct paper_deckle *deckle, double chance);

/* `mass` of the fibers that lie in the sheet, `cover` where it is as usual, becomes the sheet's
 * thickness, 0..1; `spare` is as large. */
void deckle_thickness_make(const struct paper_sheet_config *config, double scale,
                           const float *inside, double cover, float *mass, float *spare);

#endif
