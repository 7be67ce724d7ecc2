/* evaluation.h - an evaluation in two halves, so that what comes between them is its caller's.
 *
 *     const struct wish wish = {.values = &v, .count = 1, .what = WISH_LIVE};
 *     struct evaluation e;
 *     status = evaluation_prepare(m, &e, &wish, PLAN_TO_RUN);   // targets, the nodes reached, a plan
 *     if (!status && e.plan)
 *         status = evaluation_perform(m, &e);                   // kernels run, values have buffers
 *     evaluation_finish(m, &e); */
#ifndef LUTETIA_MACHINE_EVALUATION_H
#define LUTETIA_MACHINE_EVALUATION_H

#include "build/plans.h"
#include "machine.h"
#include "run/run.h"

/* What an evaluation is for. */
struct wish {
    struct machine_value **values; /* wanted, whatever else */
    int count;
    enum wish_what {
        WISH_VALUES, /* these alone */
        WISH_LIVE,   /* and what fields and flags hold, but for temporaries */
        WISH_ALL     /* and those: nothing is left to compute */
    } what;
};

struct evaluation {
    struct targets targets;
    struct reach reach;
    struct plan *plan; /* NULL: there is nothing to run */
    struct device_buffer *
        *buffers; /* of each node that is in memory; after the second half, of those stored */
    double start;
    bool stored; /* the second half is done: those that it stored are referenced */
};

/* The first half changes nothing. An error, or MACHINE_OK; finish it in either case. */
enum machine_status evaluation_prepare(struct machine *m, struct evaluation *e,
                                       const struct wish *wish, enum plan_use use);
enum machine_status evaluation_perform(struct machine *m, struct evaluation *e);
void evaluation_finish(struct machine *m, struct evaluation *e);

#endif
