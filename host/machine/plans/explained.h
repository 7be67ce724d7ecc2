/* explained.h - the facts of each kernel: struct machine_explained_kernel
 * (machine_explained.h). */
#ifndef LUTETIA_MACHINE_EXPLAINED_KERNELS_H
#define LUTETIA_MACHINE_EXPLAINED_KERNELS_H

#include "codegen/codegen.h"
#include "values/values.h"
#include "watch/sums.h"

/* Writes to out which field or flag holds the value; "" if none does. */
typedef void explained_where(const struct machine *m, const struct machine_value *v, char *out,
                             size_t size);

/* The evaluation for which a plan is being made. */
struct describing {
    struct machine_value *const *nodes, *const *wanted;
    int wanted_count;
    int parts; /* the remaining parts of a split kernel */
    explained_where *where;
};

/* The values that the next plan is for (kept until the next evaluation); NULL: they are no
 * values of the program. A kernel of that plan. */
void explained_nodes(struct machine *m, struct machine_value *const *nodes,
                     struct machine_value *const *wanted, int wanted_count,
                     explained_where *where);
struct kernel_note *explained_kernel(struct machine *m, const struct device_kernel *kernel,
                                     const struct plan_graph *g, const int *stores,
                                     int stores_count, const struct kernel_text *k,
                                     const char *made);
/* The kernel was NULL and has been built; NULL: it will not be. Returns its note. */
struct kernel_note *explained_built(struct machine *m, struct kernel_note *note,
                                    const struct device_kernel *kernel);
/* How a kernel was made. */
const char *explained_made(bool quick, bool boxed, bool lifted);
void explained_split(struct machine *m);
void explained_improved(struct machine *m);

#endif
