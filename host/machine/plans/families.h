/* families.h - plans that are alike but for numbers: bit positions, widths, distances, VP sets.
 *
 * Plans of a family can share kernels, if those take the numbers as arguments
 * (codegen/numbers.h), and what the compiler costs pays for all of them together. */
#ifndef LUTETIA_MACHINE_FAMILIES_H
#define LUTETIA_MACHINE_FAMILIES_H

#include "machine_explained.h"
#include "values/values.h"

struct reach;
struct targets;

struct plan_family {
    uint64_t hash;    /* of all but the numbers */
    uint64_t kept;    /* plans that are kept */
    uint64_t made;    /* plans so far */
    uint64_t differ;  /* ... whose numbers are not the first one's */
    uint64_t lifted;  /* kernels at hand that take the numbers as arguments */
    uint64_t started; /* byte code programs run */
    double spent_s;   /* ... by these */
    int32_t *numbers; /* of the first plan */
    int numbers_count;
    struct machine_explained_family said;
    struct plan_family *next;
};

enum { FAMILY_BUCKETS = 1024 };

/* From this many plans with other numbers than the first one's, kernels of a family take them
 * as arguments. */
enum { FAMILY_FROM = 2 };

/* The family of a plan that is about to be made. NULL: no memory, which is no error. */
struct plan_family *family_join(struct machine *m, const struct reach *r,
                                const struct targets *t);
/* A hash of what a plan computes, the same in all programs: which VP sets there are is no part
 * of it, but which of its values are of the same set is. */
uint64_t plan_alike(const struct machine *m, const struct reach *r, const struct targets *t);
/* Those without a plan go. */
void families_sweep(struct machine *m);
void families_finish(struct machine *m);

/* ---- explained_families.c ---- */

/* What is known of each, those that ran most first; the caller frees it. NULL: no memory. */
struct machine_explained_family *families_said(struct machine *m, int *count);

#endif
