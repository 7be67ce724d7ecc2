/* soft.h - floats of other formats than single and double, on their way between values and
 * fields. */
#ifndef LUTETIA_MACHINE_SOFT_H
#define LUTETIA_MACHINE_SOFT_H

#include "values/values.h"

/* The bits of a field for a value of such a type, and back. */
struct machine_value *soft_packed(struct machine *m, struct machine_value *v);
struct machine_value *soft_unpacked(struct machine *m, struct machine_value *bits,
                                    struct machine_type type);

#endif
