/* evaluation.h - an evaluation in two halves, so that the caller can act between them.
 *
 *     const struct wish wish = {.values = &v, .count = 1, .what = WISH_LIVE};
 *     struct evaluation e;
 *     status = evaluation_prepare(m, &e, &wish, PLAN_TO_RUN);   // targets, the nodes reached, a plan
 *     if (!status && e.plan)
 *         status = evaluation_perform(m, &e);                   // kernels run, values have buffers
 *     evaluation_finish(m, &e);
 */
#ifndef LUTETIA_MACHINE_EVALUATION_H
#define LUTETIA_MACHINE_EVALUATION_H

#include "build/plans.h"
#include "machine.h"
#include "run/run.h"

/* What an evaluation must compute. */
struct wish {
    struct machine_value **values; /* these values in any case */
    int count;
    enum wish_what {
        WISH_VALUES, /* these alone */
        WISH_LIVE,   /* and the contents of fields and flags, except temporaries */
        WISH_ALL     /* and temporaries: nothing is left to compute */
    } what;
};

struct evaluation {
    struct targets targets;
    struct reach reach;
    struct plan *plan; /* NULL: nothing to run */
    struct device_buffer *
        *buffers; /* by node, of those in memory; after the second half also of those stored */
    double start;
    bool stored; /* the second half is done: the stored buffers are referenced */
};

/* The first half changes nothing. Returns an error, or MACHINE_OK; call evaluation_finish()
 * in either case. */
enum machine_status evaluation_prepare(struct machine *m, struct evaluation *e,
                                       const struct wish *wish, enum plan_use use);
enum machine_status evaluation_perform(struct machine *m, struct evaluation *e);
void evaluation_finish(struct machine *m, struct evaluation *e);

#endif
