/* evaluate.h - see evaluate.c. */
#ifndef LUTETIA_MACHINE_EVALUATE_H
#define LUTETIA_MACHINE_EVALUATE_H

#include "machine.h"
#include "run/evaluation.h"

/* Why there is an evaluation. */
enum run_why {
    RUN_LOOKED, /* requested, or needed by an observation */
    RUN_DUE     /* due by itself: many values were pending */
};
enum machine_status evaluate(struct machine *m, const struct wish *wish, enum run_why why);

#endif
