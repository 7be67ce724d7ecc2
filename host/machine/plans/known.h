/* known.h - plans whose kernels an earlier program had compiled.
 *
 * A plan is due when its runs have cost what a compiler takes (interpreted.c). Where an earlier
 * program has paid for that compiler, the kernels are on disk, and the plan could have them at
 * once. To look for the kernels takes their text, which takes milliseconds to write. So a plan
 * whose kernels come from the background leaves a mark (device/disk_cache.h) that is named by
 * what the plan computes and by how its kernels were made. The next program looks for that
 * mark, in some microseconds, when the plan's runs have cost a millisecond. */
#ifndef LUTETIA_MACHINE_KNOWN_H
#define LUTETIA_MACHINE_KNOWN_H

#include "plans/plans.h"

/* How a plan's kernels were made. */
struct plan_form {
    enum quality quality;
    bool lifted;
};

/* False: there is no mark, or kernels are not compiled in the background. */
bool known_find(struct machine *m, const struct plan_request *q, struct plan_form *form);
/* What improve_begin() calls so that known_keep() has a name. */
void known_prepare(const struct machine *m, struct plan *p, const struct plan_request *q);
/* The plan gets these better kernels, which the background has compiled. */
void known_keep(const struct machine *m, const struct plan *p, const struct plan *better);

#endif
