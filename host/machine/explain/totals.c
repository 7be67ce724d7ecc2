/* totals.c - machine_explain(): the facts of a whole run, from the sums of watch/sums.c. The
 * facts of a kernel are plans/explained_kernels.c's.
 *
 * The fate of each value is counted once: it was computed, in the first evaluation that reached
 * it, or released before any evaluation did. Foreseen calls make no values; the kernels that
 * they run are counted like all others.
 *
 * A kernel's bound is the time in which the device copies as many bytes as it reads and
 * writes, measured by the same clock on arrays of that size (copies.c), or the cost model's
 * time for its operations, whichever is longer.
 */
#include <stdlib.h>
#include <string.h>

#include "measure/copies.h"
#include "plans/plans.h"
#include "run/run.h"

/* ---- the whole ---- */

static int by_time(const void *a, const void *b)
{
    const struct machine_explained_kernel *x = a, *y = b;
    if (x->time_s > y->time_s || x->time_s < y->time_s)
        return x->time_s > y->time_s ? -1 : 1;
    if (x->runs != y->runs)
        return x->runs > y->runs ? -1 : 1;
    return strcmp(x->name, y->name);
}

static int by_count(const void *a, const void *b)
{
    const struct machine_explained_row *x = a, *y = b;
    return x->count > y->count ? -1 : x->count < y->count ? 1 : strcmp(x->name, y->name);
}

static void add(struct machine_explained_row *rows, int *count, const char *name,
                uint64_t number)
{
    rows[(*count)++] = (struct machine_explained_row){.name = name, .count = number};
}

static bool gather_kernels(struct watch_sums *e)
{
    int count = 0;
    for (struct kernel_note *n = e->notes; n; n = n->next)
        count += n->facts.runs > 0;
    free(e->kernels);
    e->kernels = calloc((size_t)count + 1, sizeof *e->kernels);
    if (!e->kernels)
        return false;
    count = 0;
    for (struct kernel_note *n = e->notes; n; n = n->next)
        if (n->facts.runs > 0)
            e->kernels[count++] = n->facts;
    qsort(e->kernels, (size_t)count, sizeof *e->kernels, by_time);
    e->facts.kernels = e->kernels;
    e->facts.kernels_count = count;
    return true;
}

static void gather_rows(const struct machine *m, struct watch_sums *e)
{
    struct machine_explained *f = &e->facts;
    f->vanished_count = f->reasons_count = f->evaluations_count = f->phases_count = 0;
    for (int i = 0; i < NODE_OP_COUNT; i++)
        if (e->vanished[i])
            add(f->vanished, &f->vanished_count, node_ops[i].name, e->vanished[i]);
    qsort(f->vanished, (size_t)f->vanished_count, sizeof *f->vanished, by_count);
    const struct vanished *v = &m->values->vanished;
    add(f->reasons, &f->reasons_count, "field or flag overwritten before it was in memory",
        e->overwritten);
    add(f->reasons, &f->reasons_count, "overwritten where the same context holds",
        v->overwritten);
    add(f->reasons, &f->reasons_count, "stored in a context within the one before", v->nested);
    add(f->reasons, &f->reasons_count, "looked at only where the context holds",
        v->under_context);
    add(f->reasons, &f->reasons_count, "known as a number", v->numbers);
    add(f->reasons, &f->reasons_count, "made before, of the same operands", v->known);
    add(f->reasons, &f->reasons_count, "overflow that nobody looked at", v->overflows);
    add(f->reasons, &f->reasons_count, "temporary left an expression at an evaluation",
        v->expressions);
    add(f->evaluations, &f->evaluations_count, "somebody looked",
        e->evaluations[WATCH_LOOKED_AT]);
    add(f->evaluations, &f->evaluations_count, "much was waiting",
        e->evaluations[WATCH_MUCH_WAITED]);
    add(f->evaluations, &f->evaluations_count, "asked to, by a flush",
        e->evaluations[WATCH_ASKED_TO]);
    add(f->evaluations, &f->evaluations_count, "each store at once",
        e->evaluations[WATCH_AT_ONCE]);
    for (int i = 0; i < WATCH_PHASES_COUNT; i++)
        if (e->phases[i].count) {
            f->phases[f->phases_count] = e->phases[i];
            f->phases[f->phases_count++].name = watch_phase_names[i];
        }
}

const struct machine_explained *machine_explain(struct machine *m, bool wish_measured)
{
    struct watch_sums *e = watch_explain(m);
    if (!e || !m->device->queue || m->inside || !pthread_equal(m->owner, pthread_self()))
        return NULL;
    watch_settle(m);
    struct machine_explained *f = &e->facts;
    if (!gather_kernels(e))
        return NULL;
    f->device = m->device->name;
    f->costs_from = m->device->shape.from;
    f->processors_count = m->values->processors_count;
    f->calls = e->calls;
    f->stores = m->run->stores;
    f->kernels_gone = m->device->kernels_gone;
    f->plans_built = m->plans->built;
    free(e->families);
    f->families = e->families = families_said(m, &f->families_count);
    gather_rows(m, e);
    if (wish_measured)
        copies_measure(m, e);
    return f;
}
