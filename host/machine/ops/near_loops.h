/* near_loops.h - the loops of near_lines.h: scans of one line, of some neighbouring ones, of a
 * chunk of one.
 *
 *     along a row      one line at a time, an element after the other
 *     across rows      LOOPS_LANES neighbouring lines at a time, a row after the other
 *     a long line      in chunks: what each comes to, then what goes before each, then each
 *                      from there on */
#ifndef LUTETIA_MACHINE_NEAR_LOOPS_H
#define LUTETIA_MACHINE_NEAR_LOOPS_H

#include "ops/scan.h"

/* Neighbouring lines at a time; runs of floats of one line at a time, since an addition takes
 * as long as some of them beside one another. */
enum { LOOPS_LANES = 16, LOOPS_RUNS = 8 };

/* The lines that are scanned together, and how far: elements begin to end of each. Of
 * LOOPS_RUNS runs, the first, and the next ones of as many elements. */
struct stretch {
    const struct line_scan *j;
    size_t at; /* of element begin */
    ptrdiff_t step;
    int begin, end;
};

/* A chunk of a line: what goes before it, and what it comes to. */
union number {
    uint32_t as_u32;
    uint64_t as_u64;
    unsigned __int128 as_u128;
    float as_f32;
    double as_f64;
};
struct chunk {
    union number carry, total;
    bool carry_has, total_has; /* of copies: there is an element */
    int first;                 /* where a segment first begins; INT32_MAX: nowhere */
};

/* line: of the sums, if they are wanted; the elements themselves are not written then. Of
 * floats, run: as in near_lines.h. */
typedef void loops_lines(const struct stretch *s, int run, size_t line);
typedef void loops_chunk(const struct stretch *s, struct chunk *c);
typedef void loops_join(const struct line_scan *j, struct chunk *c, int count);

/* Of chunks: `sum` what each comes to (a chunk of floats, which is a run, is written, too),
 * `join` what goes before each, `scan` the elements; `sums` does what `sum` does of LOOPS_RUNS
 * of them that are as long as the first. */
struct loops {
    loops_lines *one, *many; /* many NULL: only one at a time */
    loops_chunk *sum, *scan;
    loops_join *join;
    loops_chunk *sums; /* NULL: only one at a time */
};
const struct loops *near_loops_of(const struct element *e);
/* Whether a line that goes on by so much is scanned by vectors. */
bool near_loops_by_vectors(const struct line_scan *j, ptrdiff_t step);

#endif
