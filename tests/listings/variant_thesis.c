/* variant_thesis.c - one step by the thesis's listing. */
#include "variant.h"

/* As listing_dispersion.c defines it, in gnu89. */
int disperse_pigment_and_water(struct FiberStruct *page);

void variant_step(struct FiberStruct *page)
{
    disperse_pigment_and_water(page);
}
