/* places.h - see places.c. */
#ifndef LUTETIA_MACHINE_PLACES_H
#define LUTETIA_MACHINE_PLACES_H

#include "machine.h"

/* machine_random(), for those who know that it makes the call depend on more than its words. */
struct machine_value *places_random(struct machine *m, int width, uint64_t limit);

#endif
