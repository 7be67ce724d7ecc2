/* tune_work.h - the kernels that `lutetia tune` measures: small programs of the machine, one
 * machine each.
 *
 *     struct tune_work *w = tune_work_create(TUNE_STENCIL, 0, &tuning);
 *     double seconds = tune_work_run(w);       // < 0: tune_work_error()
 *     tune_work_destroy(w);
 *
 * The results do not depend on the tuning.
 */
#ifndef LUTETIA_LUTETIA_TUNE_WORK_H
#define LUTETIA_LUTETIA_TUNE_WORK_H

#include <machine.h>

enum tune_kind {
    TUNE_ARITHMETIC, /* many operations on few numbers */
    TUNE_TRAFFIC,    /* few on arrays that no cache holds */
    TUNE_STENCIL,    /* water that spreads along both axes, many turns without a look */
    TUNE_KINDS
};

struct tune_work;

const char *tune_kind_name(enum tune_kind kind);
/* height: rows; 0: the size for measuring. NULL: tune_work_error() says why. */
struct tune_work *tune_work_create(enum tune_kind kind, int height,
                                   const struct machine_tuning *tuning);
void tune_work_destroy(struct tune_work *w); /* takes NULL */
/* Runs some turns to the end. Returns nanoseconds for each turn and processor; negative:
 * tune_work_error(). */
double tune_work_run(struct tune_work *w);
/* The result (of STENCIL, the pigment), which after equally many runs is the same for every
 * tuning. False: tune_work_error(). */
size_t tune_work_count(const struct tune_work *w);
bool tune_work_read(struct tune_work *w, float *out);
/* The initial numbers of the first field (seed 1) and the others (seeds 2, 3):
 * pseudo-random, between 0 and 1. */
void tune_work_start(float *numbers, size_t count, uint32_t seed);
const char *tune_work_error(void);

#endif
