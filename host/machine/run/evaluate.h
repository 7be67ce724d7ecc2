/* evaluate.h - see evaluate.c. */
#ifndef LUTETIA_MACHINE_EVALUATE_H
#define LUTETIA_MACHINE_EVALUATE_H

#include "machine.h"
#include "run/evaluation.h"

/* Why there is an evaluation. */
enum run_why {
    RUN_LOOKED, /* for a wish, or because somebody asked for it */
    RUN_DUE     /* it became due by itself */
};
enum machine_status evaluate(struct machine *m, const struct wish *wish, enum run_why why);

#endif
