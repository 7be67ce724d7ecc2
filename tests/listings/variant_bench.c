/* variant_bench.c - one step by the benchmark's code with the listing's instructions. It is
 * compared with the listing's oracle bit for bit, so both variants give the same bits. */
#include "listing.h"
#include "page.h"
#include "variant.h"

void variant_step(struct FiberStruct *page)
{
    struct listing sheet = {
        .width = page->width,
        .height = page->height,
        .x0 = 2,
        .y0 = 2,
        .x1 = page->width - 1, /* the thesis's rectangle includes its far edges */
        .y1 = page->height - 1,
        .significand = (unsigned int)page->s,
        .exponent = (unsigned int)page->e,
        .axis_x = (unsigned int)X,
        .axis_y = (unsigned int)Y,
        .gravity = (double)gravity,
        .molecular_weight = {(double)molecular_weight[0], (double)molecular_weight[1],
                             (double)molecular_weight[2]},
        .water = page->water,
        .absorbency = page->absorbency,
        .pigment = {page->cyan, page->magenta, page->yellow},
        .inflow = page->inflow,
        .inward = page->inward,
        .outward = page->outward,
        .x = page->x_coordinate,
        .y = page->y_coordinate,
        .coordinate_bits = 16,
        .caller_context = page->context,
        .kept_context = page->old_context_store,
    };

    listing_step(&sheet);
}
