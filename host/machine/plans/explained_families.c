/* explained_families.c - what is said of plans that differ only in numbers: struct
 * machine_explained_family. */
#include <stdlib.h>
#include <string.h>

#include "plans/plans.h"

/* Why the plan runs as it does. */
static enum machine_plan_why why_of(const struct machine *m, const struct plan *p)
{
    if (p->quality == INTERPRETED)
        return p == m->plans->improving ? MACHINE_PLAN_COMPILING
               : plan_is_short(m, p)    ? MACHINE_PLAN_SHORT
                                        : MACHINE_PLAN_NOT_WORTH;
    return p->lifted ? MACHINE_PLAN_SHARED : MACHINE_PLAN_OWN;
}

static int by_runs(const void *a, const void *b)
{
    const struct machine_explained_family *x = a, *y = b;
    uint64_t runs[2] = {0};
    for (int i = 0; i < MACHINE_TIERS; i++) {
        runs[0] += x->runs[i];
        runs[1] += y->runs[i];
    }
    return runs[0] != runs[1] ? runs[0] > runs[1] ? -1 : 1 : strcmp(x->name, y->name);
}

struct machine_explained_family *families_said(struct machine *m, int *count)
{
    struct plans *p = m->plans;
    struct machine_explained_family *said = calloc((size_t)p->families_count + 1, sizeof *said);
    *count = 0;
    for (int i = 0; p->families && i < FAMILY_BUCKETS; i++)
        for (struct plan_family *f = p->families[i]; f; f = f->next)
            memset(f->said.why, 0, sizeof f->said.why);
    for (int i = 0; i < p->table_size; i++)
        for (struct plan *q = p->table[i]; q; q = q->next)
            if (q->family)
                q->family->said.why[why_of(m, q)]++;
    for (int i = 0; said && p->families && i < FAMILY_BUCKETS; i++)
        for (struct plan_family *f = p->families[i]; f; f = f->next) {
            f->said.plans = f->made;
            said[(*count)++] = f->said;
        }
    if (said)
        qsort(said, (size_t)*count, sizeof *said, by_runs);
    return said;
}
