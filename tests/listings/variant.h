/* variant.h - one step of diffusion, in two variants: the thesis's listing (variant_thesis.c),
 * and the benchmark's code with the same instructions (variant_bench.c). */
#ifndef LUTETIA_TESTS_LISTINGS_VARIANT_H
#define LUTETIA_TESTS_LISTINGS_VARIANT_H

struct FiberStruct;
void variant_step(struct FiberStruct *page);

#endif
