/* paper_wet.h - what wet paper costs: a word on a dry sheet, a poster, the memory of a large
 * sheet. */
#ifndef LUTETIA_BENCH_PAPER_WET_H
#define LUTETIA_BENCH_PAPER_WET_H

#include "harness.h"
#include "options.h"

/* A dry sheet with a wet word, the same on every sheet: steps in boxes, and everywhere if that
 * is asked for. */
bool paper_word_measure(struct bench_report *r, const struct bench_options *o, int width,
                        int height, bool everywhere);
/* 600 steps of a poster of 3000x2000 with type on it. */
bool paper_poster_measure(struct bench_report *r);
/* Of the process: a sheet of 4096x4096 with three pigments, wet everywhere, after some steps
 * and a picture. */
bool paper_memory_measure(struct bench_report *r);

#endif
