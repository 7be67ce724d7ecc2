/* integers.h - integers' quotients, powers, shifts, counts. */
#ifndef LUTETIA_MACHINE_INTEGERS_H
#define LUTETIA_MACHINE_INTEGERS_H

#include "values/values.h"

struct machine_value *integer_value(struct machine *m, enum machine_op op,
                                    struct machine_value *a, struct machine_value *b);

#endif
