/* math_ops.h - transcendental operations on the front end. */
#ifndef LUTETIA_MACHINE_MATH_OPS_H
#define LUTETIA_MACHINE_MATH_OPS_H

#include "machine.h"

/* The transcendental operations on the front end, with the device's bits; b is ignored
 * where there is one operand. false: op is none of them. */
bool math_evaluate(int op, double a, double b, double *out);
/* The same of singles, for a result that is rounded to single: the single is the same. */
bool math_evaluate_single(int op, double a, double b, double *out);
bool math_fold(int op, struct machine_type type, struct machine_scalar a,
               struct machine_scalar b, struct machine_scalar *out);

#endif
