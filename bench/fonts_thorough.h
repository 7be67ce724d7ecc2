/* fonts_thorough.h - `lutetia bench fonts --thorough`: how exact gray is over 16x16 places
 * between pixels, 12 angles, 4 filters and 3 faces, each with each; and sheared, projective and
 * bilinear. No times.
 *
 *     // false: it failed, or something was less exact than it must be
 *     ok = fonts_thorough_run(&report); */
#ifndef LUTETIA_BENCH_FONTS_THOROUGH_H
#define LUTETIA_BENCH_FONTS_THOROUGH_H

#include "harness.h"

/* Adds rows for each filter, and those of the worst. */
bool fonts_thorough_run(struct bench_report *report);

#endif
