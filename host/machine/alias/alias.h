/* alias.h - who of a field and its aliases has the content: see reshape.h. */
#ifndef LUTETIA_MACHINE_ALIAS_H
#define LUTETIA_MACHINE_ALIAS_H

#include "memory/memory.h"

/* Called before slots of f are looked at, or replaced (writes; whole: all of them, everywhere): brings
 * what was stored through another alias of its memory. */
bool alias_bring(struct machine *m, struct field *f, bool writes, bool whole);
/* The root takes over what its newest alias holds. */
bool alias_settle(struct machine *m, struct field *root);
/* The same numbers for the same processors in rows of another geometry; v is of the set as it is. */
struct machine_value *lay_out_value(struct machine *m, struct machine_value *v, int set,
                                    const struct vpset *to);

#endif
