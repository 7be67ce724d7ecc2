/* windows.h - the lanes of a block where a guard's condition holds, and steps for these lanes
 * alone: see guards.c. */
#ifndef LUTETIA_MACHINE_WINDOWS_H
#define LUTETIA_MACHINE_WINDOWS_H

#include "interpret/byte_code.h"

/* Whole runs of 16 lanes, but for the last. from == end: none. */
struct window {
    int from, end;
};

/* From the first lane where the guard's condition holds to the last, at least. */
struct window window_of(const struct guard *g, void *const *at, int lanes);
/* A step for at least these lanes. Not of what run == NULL generates. */
void window_step(const struct byte_code *p, const struct lanes_step *s, void *const *at,
                 struct window w, int lanes);

#endif
