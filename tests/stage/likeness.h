/* likeness.h - the similarity of two pictures, and the amount of ink on one. */
#ifndef LUTETIA_TEST_LIKENESS_H
#define LUTETIA_TEST_LIKENESS_H

#include <display.h>

/* Mean structural similarity of gray, over squares of 8x8 pixels that begin at every fourth
 * pixel. 1: the pictures are the same. Their sizes must be the same. Source: Wang, Bovik,
 * Sheikh and Simoncelli, Image quality assessment, 2004. */
double likeness(const struct display_image *a, const struct display_image *b);

/* The sum, over all pixels and channels, of the differences to the background. */
double ink_weight(const struct display_image *image, const uint8_t background[3]);

#endif
