/* memory_programs.h - programs of `lutetia bench memory` that are not works of works.h: grids,
 * each begun anew on the machine as it is.
 *
 *     listing          the thesis's step of water and three pigments (listing.h), a look at the
 *                      end
 *     paper            steps of a sheet of six pigments with all parts
 *     a line's mean    two fields, of which one is the mean of itself and its neighbour, turn
 *                      after turn */
#ifndef LUTETIA_BENCH_MEMORY_PROGRAMS_H
#define LUTETIA_BENCH_MEMORY_PROGRAMS_H

#include <stdbool.h>
#include <stdint.h>

/* Errors: false. result: a sum over all bits of what it comes to. */
bool memory_listing_run(int side, uint32_t *result);
bool memory_paper_run(int side, uint32_t *result);
bool memory_mean_run(int side, uint32_t *result);

#endif
