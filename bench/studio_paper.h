/* studio_paper.h - of `lutetia bench studio`: the paper without its window, by the calls that
 * the studio's thread makes.
 *
 *     if (!studio_paper_measure(&report, &options))
 *         ... bench_error()
 */
#ifndef LUTETIA_BENCH_STUDIO_PAPER_H
#define LUTETIA_BENCH_STUDIO_PAPER_H

#include "options.h"

/* Adds rows: steps a second of four sheets; the pieces of strokes with their pictures; undo.
 * Errors: false. */
bool studio_paper_measure(struct bench_report *r, const struct bench_options *o);

#endif
