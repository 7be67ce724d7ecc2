/* evaluate.c - runs an evaluation, and records it between its halves and after them. */
#include "run/evaluate.h"

#include "memory/memory.h"
#include "run/replay.h"
#include "watch/watch.h"

/* For evaluations that leave nothing to compute: computes recorded overflows, too. */
static void resolve_overflows(struct machine *m)
{
    struct replay *p = m->run->replay;
    p->depth++; /* these belong to the calls before */
    for (int i = 1; i < m->values->sets_count; i++)
        if (m->values->sets[i].used)
            flag_resolved(m, &m->values->sets[i], MACHINE_OVERFLOW);
    p->depth--;
}

static enum plan_use use_of(enum run_mode mode)
{
    return mode == RUN_REHEARSING         ? PLAN_TO_REHEARSE
           : mode == RUN_REHEARSING_TURNS ? PLAN_TO_REHEARSE_TURNS
           : run_mode_builds(mode)        ? PLAN_TO_RUN_OFTEN
                                          : PLAN_TO_RUN;
}

static enum watch_why watch_why_of(const struct machine *m, const struct wish *w,
                                   enum run_why why)
{
    return w->count            ? WATCH_LOOKED_AT
           : why == RUN_DUE    ? WATCH_MUCH_WAITED
           : m->settings.eager ? WATCH_AT_ONCE
                               : WATCH_ASKED_TO;
}

static enum machine_status perform(struct machine *m, struct evaluation *e,
                                   const struct wish *w, enum run_why why)
{
    record_evaluates(m, e->plan, e->reach.nodes, e->reach.count, e->buffers, why == RUN_DUE);
    enum machine_status status = evaluation_perform(m, e);
    if (status)
        record_failed(m);
    else
        record_evaluated(m, e->buffers, w->values, w->count, why == RUN_DUE);
    if (m->watch)
        watch_evaluated(m, e->start, watch_why_of(m, w, why), e->targets.count);
    m->run->flushes++;
    return status;
}

enum machine_status evaluate(struct machine *m, const struct wish *wish, enum run_why why)
{
    struct wish w = *wish;
    struct evaluation e;
    if (m->run->replay && m->run->replay->thorough) {
        w.what = WISH_ALL;
        resolve_overflows(m);
    }
    enum plan_use use = use_of(m->run->mode);
    enum machine_status status = evaluation_prepare(m, &e, &w, use);
    if (w.what != WISH_VALUES)
        m->run->stores_evaluated = m->run->stores;
    m->run->flush_hash = 0; /* the observer now decides when to evaluate */
    if (!plan_use_runs(use))
        m->run->rehearsed = e.plan;
    else if (!status && e.plan)
        status = perform(m, &e, &w, why);
    if (status && w.what != WISH_VALUES)
        m->run->stores_evaluated = m->run->stores - 1; /* not yet */
    evaluation_finish(m, &e);
    return status;
}
