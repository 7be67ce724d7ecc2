/* fonts_ways.h - the ways to one filter's glyphs, for `lutetia bench fonts --ways`: from kept
 * edges to a font's file, by each instruction set and by OpenCL, and the thesis's rectangles;
 * of one font. */
#ifndef LUTETIA_BENCH_FONTS_WAYS_H
#define LUTETIA_BENCH_FONTS_WAYS_H

#include "harness.h"

/* Begins the report and fills it; prints it. quick: 12.25 px alone. Errors: false, see
 * bench_error(). */
bool fonts_ways_run(const char *font, const char *filter, bool quick,
                    struct bench_report *report);

#endif
