/* places.h - see places.c. */
#ifndef LUTETIA_MACHINE_PLACES_H
#define LUTETIA_MACHINE_PLACES_H

#include "values/geometry.h"

/* Whether a cross by these bits of the index stays in a row of the set, and lies in whole
 * runs. */
bool places_cross_can(const struct vpset *s, uint32_t bits);
/* A cross: the value that the processor has whose index differs in these bits. a: in memory, if
 * bits are not all below CROSS_NEAR. NULL: error set. */
struct machine_value *places_cross(struct machine *m, struct machine_value *a, uint32_t bits);

/* machine_random(), for those who know that it makes the call depend on more than its words. */
struct machine_value *places_random(struct machine *m, int width, uint64_t limit);

#endif
