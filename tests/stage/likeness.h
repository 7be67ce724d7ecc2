/* likeness.h - how alike two pictures are, and how much ink is on one. */
#ifndef LUTETIA_TEST_LIKENESS_H
#define LUTETIA_TEST_LIKENESS_H

#include <display.h>

/* Mean structural similarity of gray, over squares of 8x8 pixels at each fourth: 1 is the same. Source: Wang, Bovik, Sheikh and
 * Simoncelli, Image quality assessment, 2004. Sizes must be the same. */
double likeness(const struct display_image *a, const struct display_image *b);

/* The light that is missing from a picture's background, over all pixels and channels. */
double ink_weight(const struct display_image *image, const uint8_t background[3]);

#endif
