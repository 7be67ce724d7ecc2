/* describe.h - what a kernel is, for those who watch. */
#ifndef LUTETIA_MACHINE_DESCRIBE_H
#define LUTETIA_MACHINE_DESCRIBE_H

#include "codegen/codegen.h"
#include "values/values.h"
#include "watch/sums.h"

/* Writes to out which field or flag holds the value; "" if none does. */
typedef void describe_where(const struct machine *m, const struct machine_value *v, char *out,
                            size_t size);

/* What the plan that is made now is for. */
struct describing {
    struct machine_value *const *nodes, *const *wanted;
    int wanted_count;
    int parts; /* of a kernel that was split, still to come */
    describe_where *where;
};

/* Plans: the values that the next one is for (kept until the next evaluation's); a kernel of it. */
void describe_nodes(struct machine *m, struct machine_value *const *nodes,
                    struct machine_value *const *wanted, int wanted_count,
                    describe_where *where);
struct kernel_note *describe_kernel(struct machine *m, cl_kernel kernel,
                                    const struct plan_graph *g, const int *stores,
                                    int stores_count, const struct kernel_text *k,
                                    const char *made);
/* That kernel was not there yet (NULL): now it is; NULL: it will not be. */
struct kernel_note *describe_built(struct machine *m, struct kernel_note *note,
                                   cl_kernel kernel);
void describe_split(struct machine *m);
void describe_improved(struct machine *m);

#endif
