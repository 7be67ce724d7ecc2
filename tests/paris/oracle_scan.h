/* oracle_scan.h - scans, spreads and ranks in plain C by their definitions: each processor
 * loops over the others of its line. Knows nothing of the machine. */
#ifndef PARIS_TESTS_ORACLE_SCAN_H
#define PARIS_TESTS_ORACLE_SCAN_H

#include <stdint.h>

#include "oracle.h"

enum { SCAN_AXES_MAX = 5 };

struct scan_grid {
    int rank, dimensions[SCAN_AXES_MAX];
    int count;
};

struct scan_case {
    char letter;    /* u s f b */
    const char *op; /* add multiply min max logand logior logxor copy */
    int width;      /* of f 32 or 64 */
    int axis;
    int direction, inclusion, smode; /* as in <cm/paris.h> */
    const number *source, *context, *sbit;
};

/* dest holds the old contents at the call, and the result after it. */
void oracle_scan(const struct scan_grid *grid, const struct scan_case *c, number *dest);
/* Combines over the axes of the mask. `to` other than -1: only processors with that coordinate
 * on c->axis get the result. op copy: the result is the value of the processor with the
 * coordinate `from` on c->axis. */
void oracle_spread(const struct scan_grid *grid, const struct scan_case *c, unsigned int mask,
                   int to, int from, number *dest);
void oracle_rank(const struct scan_grid *grid, const struct scan_case *c, number *dest);

#endif
