/* fonts_filters.h - every filter beside FreeType and stb_truetype, for `lutetia bench fonts`:
 * the same letters of five faces at four sizes, on one thread.
 *
 * Rows. A filter's name: prepared outlines are taken apart and drawn, each glyph at a place of
 * its own between pixels; `NAME, kept edges`: drawn alone; `freetype`: loaded from the font in
 * memory and rendered, unhinted; `stb_truetype`. Glyphs a second over all faces together.
 * `NAME, slowest face`: times as many as FreeType draws, of the face where that is least.
 * `NAME, max error`: from gold by the same filter, of 255. Cases are the sizes. */
#ifndef LUTETIA_BENCH_FONTS_FILTERS_H
#define LUTETIA_BENCH_FONTS_FILTERS_H

#include "harness.h"

/* Begins the report, fills and prints it. font, filter: that one alone; NULL: five faces, every
 * filter that has a name. quick: 12.25 px alone. Errors: false, see bench_error(). */
bool fonts_filters_run(const char *font, const char *filter, bool quick,
                       struct bench_report *report);

#endif
