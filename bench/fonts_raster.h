/* fonts_raster.h - like beside like, for `lutetia bench fonts`: FreeType's rasteriser alone,
 * from a scaled outline in memory, beside ours from the same, by the box, the pillbox and a
 * Gaussian; and both from the font's bytes to the picture.
 *
 * Rows. `freetype raster`: of scaled outlines that are kept. `NAME`: of kept edges, which are
 * the scaled outline here. `NAME, scaled too`: of outlines in font units, which FreeType's
 * raster did not have to scale. `NAME, slowest face`: the least of the faces' ratios for kept
 * edges. Cases `from file, SIZE`: `freetype raster` loads and renders, and the filters read
 * the glyph. Glyphs a second over all faces together; cases are the sizes. */
#ifndef LUTETIA_BENCH_FONTS_RASTER_H
#define LUTETIA_BENCH_FONTS_RASTER_H

#include "harness.h"

/* Prints a table of its own and adds its rows to the report. font, filter: that one alone;
 * NULL: five faces, three filters. quick: 12.25 px alone. Errors: false, see bench_error(). */
bool fonts_raster_run(const char *font, const char *filter, bool quick,
                      struct bench_report *report);

#endif
