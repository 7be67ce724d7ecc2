/* materialise.h - puts values into memory. */
#ifndef LUTETIA_MACHINE_MATERIALISE_H
#define LUTETIA_MACHINE_MATERIALISE_H

#include "values/values.h"

/* The value in a buffer of the VP set, laid out for kernels (a constant: the same number
 * everywhere). Does not wait. NULL: error set. */
struct machine_value *materialise(struct machine *m, int set, struct machine_value *v);
/* Puts the values into buffers of the VP set, by one evaluation. False: error set. */
bool materialise_all(struct machine *m, int set, struct machine_value **values, int count);
/* The same, but the arrays may be in blocks only, where the set is cut: see sequencers/. */
struct machine_value *materialise_blocks(struct machine *m, int set, struct machine_value *v);
bool materialise_all_blocks(struct machine *m, int set, struct machine_value **values,
                            int count);
static inline struct machine_value *materialise_in_blocks(struct machine *m, int set,
                                                          struct machine_value *v)
{
    return m->sequencers ? materialise_blocks(m, set, v) : materialise(m, set, v);
}
static inline bool materialise_all_in_blocks(struct machine *m, int set,
                                             struct machine_value **values, int count)
{
    return m->sequencers ? materialise_all_blocks(m, set, values, count)
                         : materialise_all(m, set, values, count);
}
bool materialise_has_strange_nan(struct machine_type type, const void *in, uint64_t count);
struct machine_value *materialise_upload(struct machine *m, int set, struct machine_type type,
                                         const void *in);
void materialise_put(unsigned char *to, struct machine_scalar x, size_t element);

/* What a field of the current set holds that is v where the context holds, and that the next
 * evaluation computes anyway: then v need not be computed by itself. v: there is none, or it is
 * in memory. Of those who look at it only where the context holds. */
struct machine_value *materialise_instead(struct machine *m, struct machine_value *v,
                                          const struct machine_value *context);

#endif
