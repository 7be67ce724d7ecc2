/* simplify.h - the rules that keep the graph small: see simplify.c. */
#ifndef LUTETIA_MACHINE_SIMPLIFY_H
#define LUTETIA_MACHINE_SIMPLIFY_H

#include "values/values.h"

struct machine_value *simplify_under(struct machine *m, struct machine_value *v,
                                     struct machine_value *context, int depth);
struct machine_value *simplify_and(struct machine *m, struct machine_value *a,
                                   struct machine_value *b);
struct machine_value *simplify_or(struct machine *m, struct machine_value *a,
                                  struct machine_value *b);
struct machine_value *simplify_not(struct machine *m, struct machine_value *a);
struct machine_value *simplify_select(struct machine *m, struct machine_value *c,
                                      struct machine_value *a, struct machine_value *b);
/* One of some numbers: what is done to it is done to them. */
bool simplify_chooses_number(const struct machine_value *v, int depth);

#endif
