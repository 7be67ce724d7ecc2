/* alias.h - which of a field and its aliases holds the valid content: see reshape.h. */
#ifndef LUTETIA_MACHINE_ALIAS_H
#define LUTETIA_MACHINE_ALIAS_H

#include "memory/memory.h"

/* Called before slots of f are read or replaced (writes: replaced; whole: all of them, in
 * all processors). Brings over the content that was stored through another alias of the same
 * memory. */
bool alias_bring_over(struct machine *m, struct field *f, bool writes, bool whole);
static inline bool alias_bring(struct machine *m, struct field *f, bool writes, bool whole)
{
    return (!f->root && !f->aliases) || alias_bring_over(m, f, writes, whole);
}
/* Copies the newest alias's content to the root. */
bool alias_settle(struct machine *m, struct field *root);
/* Returns the same numbers for the same processors in rows of another geometry; v is laid
 * out as the set is now. */
struct machine_value *lay_out_value(struct machine *m, struct machine_value *v, int set,
                                    const struct vpset *to);

#endif
