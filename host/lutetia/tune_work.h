/* tune_work.h - the kernels that `lutetia tune` measures: small programs of the machine, one machine each.
 *
 *     struct tune_work *w = tune_work_create(TUNE_STENCIL, 0, &tuning);
 *     double seconds = tune_work_run(w);       // < 0: tune_work_error()
 *     tune_work_destroy(w);
 *
 * What they compute is always the same; only how it is computed is the tuning's. */
#ifndef LUTETIA_LUTETIA_TUNE_WORK_H
#define LUTETIA_LUTETIA_TUNE_WORK_H

#include <machine.h>

enum tune_kind {
    TUNE_ARITHMETIC, /* many operations on few numbers */
    TUNE_TRAFFIC,    /* few on arrays that no cache holds */
    TUNE_STENCIL, /* water that spreads along both axes, many turns of a loop without a look */
    TUNE_KINDS
};

struct tune_work;

const char *tune_kind_name(enum tune_kind kind);
/* height: rows; 0: as many as are measured. NULL: tune_work_error() says why. */
struct tune_work *tune_work_create(enum tune_kind kind, int height,
                                   const struct machine_tuning *tuning);
void tune_work_destroy(struct tune_work *w); /* takes NULL */
/* Some turns of it, to the end: nanoseconds for each turn and processor. Negative: tune_work_error(). */
double tune_work_run(struct tune_work *w);
/* What it has come to (of STENCIL, the pigment): numbers that are the same for every tuning after as many runs. False: tune_work_error(). */
size_t tune_work_count(const struct tune_work *w);
bool tune_work_read(struct tune_work *w, float *out);
/* What the first field (seed 1) and the others (seeds 2, 3) begin with: numbers between 0 and 1 without a pattern. */
void tune_work_start(float *numbers, size_t count, uint32_t seed);
const char *tune_work_error(void);

#endif
