/* listing_dispersion.c - appendix 7.4 of the thesis, included unchanged and compiled as gnu89.
 * LISTING_DISPERSION is the quoted path of the listing. */
#include <stdio.h>
#include <stdlib.h>

#include "page.h"

#define INITIALIZE_VARIABLES                                                                   \
    inward_gradient = Page->inward;                                                            \
    outward_gradient = Page->outward;                                                          \
    inflow = Page->inflow;                                                                     \
    outflow = Page->outflow;                                                                   \
    pigment[0] = Page->cyan;                                                                   \
    pigment[1] = Page->magenta;                                                                \
    pigment[2] = Page->yellow;

#include LISTING_DISPERSION
