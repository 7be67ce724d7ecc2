/* evaluation.h - an evaluation: what is wanted becomes kernels that run.
 *
 *     const struct wish wish = {.values = &v, .count = 1, .what = WISH_LIVE};
 *     status = evaluation_run(m, &wish, RUN_LOOKED);
 */
#ifndef LUTETIA_MACHINE_EVALUATION_H
#define LUTETIA_MACHINE_EVALUATION_H

#include "machine.h"
#include "plans/plans.h"
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

/* Why there is an evaluation. */
enum run_why {
    RUN_LOOKED, /* requested, or needed by an observation */
    RUN_DUE     /* due by itself: many values were pending */
};

enum machine_status evaluation_run(struct machine *m, const struct wish *wish,
                                   enum run_why why);

struct slot;
/* Whether the next evaluation of live values computes what the slot holds, whoever looks. */
bool evaluation_wants(struct machine *m, const struct slot *slot);

#endif
