/* narrow_spell.h - operations in lanes of 8 or 16 bits. */
#ifndef LUTETIA_MACHINE_NARROW_SPELL_H
#define LUTETIA_MACHINE_NARROW_SPELL_H

#include "plan/plan.h"

/* An operation of such a kernel, of variables. */
void narrow_spell(char *out, size_t size, const struct plan_graph *g, const struct plan_node *n,
                  int lane, const char *a, const char *b, const char *c);

#endif
