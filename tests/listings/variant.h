/* variant.h - one step of diffusion: the thesis's listing (variant_thesis.c) or the benchmark's own text of the
 * same instructions (variant_bench.c). */
#ifndef LUTETIA_TESTS_LISTINGS_VARIANT_H
#define LUTETIA_TESTS_LISTINGS_VARIANT_H

struct FiberStruct;
void variant_step(struct FiberStruct *page);

#endif
