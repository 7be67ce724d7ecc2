/* evaluate.h - decides when values are evaluated: see evaluate.c. */
#ifndef LUTETIA_MACHINE_EVALUATE_H
#define LUTETIA_MACHINE_EVALUATE_H

#include "run/run.h"

/* Evaluates the values (possibly none) and other targets; all: everything that is live. */
enum machine_status evaluate_values(struct machine *m, struct machine_value **targets,
                                    int count, bool all);
/* The same, but the values' arrays may be in blocks only: see sequencers/. */
enum machine_status evaluate_in_blocks(struct machine *m, struct machine_value **targets,
                                       int count, bool all);
enum machine_status evaluate_after_store(struct machine *m, struct machine_value *v);
/* Performs, between instructions, the evaluation that a store made due. */
void evaluate_due(struct machine *m);
void evaluate_init(struct machine *m);

#endif
