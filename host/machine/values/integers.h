/* integers.h - integers' quotients, powers, shifts, counts. */
#ifndef LUTETIA_MACHINE_INTEGERS_H
#define LUTETIA_MACHINE_INTEGERS_H

#include "values/values.h"

struct machine_value *integer_value(struct machine *m, enum machine_op op,
                                    struct machine_value *a, struct machine_value *b);

/* Of numbers of that width, unused high bits 0: what those operations give. Bits above the
 * result's width may be anything. */
unsigned __int128 integer_fold(enum machine_op op, int width, unsigned __int128 a,
                               unsigned __int128 b);

/* ... and of the rows with FOLD_BITS; one operand: b is not looked at. */
unsigned __int128 bits_fold(enum machine_op op, int width, unsigned __int128 a,
                            unsigned __int128 b);

#endif
