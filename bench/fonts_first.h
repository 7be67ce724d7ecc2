/* fonts_first.h - how long a glyph takes when it is first asked for: it is read from the font's
 * file, and it is seen whether its contours overlap. */
#ifndef LUTETIA_BENCH_FONTS_FIRST_H
#define LUTETIA_BENCH_FONTS_FIRST_H

#include "harness.h"

/* Adds a row for a font: of 94 glyphs the mean and the slowest, each in a face opened anew, the
 * least of several. */
bool fonts_first_run(const char *font, struct bench_report *report);

#endif
