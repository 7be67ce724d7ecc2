/* perform.c - performs noted calls: an edge run once, or its calls one by one. */
#include <stdlib.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "memory/memory.h"
#include "plans/division.h"
#include "run/replay.h"
#include "run/room.h"
#include "values/graph.h"

bool perform_deed(struct machine *m, const struct deed *d, int to)
{
    struct replay *p = m->run->replay;
    struct state *s = &p->states[p->active], *t = &p->states[to];
    plans_see_to(m);
    if (!d->plan || !plan_may_run(m, d->plan, d->version) ||
        !room_has(m, plan_stores_bytes(d->plan)))
        return false;
    graph_give_back(m);
    if (d->nodes_count + t->buffers_count + d->spare_count > p->scratch_capacity) {
        p->scratch_capacity = d->nodes_count + t->buffers_count + d->spare_count;
        free(p->scratch);
        p->scratch = array_zeroed((size_t)p->scratch_capacity, sizeof *p->scratch);
    }
    struct device_buffer **buffers = p->scratch, **next = p->scratch + d->nodes_count,
                         **spare = next + t->buffers_count;
    for (int i = 0; i < d->nodes_count; i++)
        buffers[i] = d->from[i] >= 0 ? s->buffers[d->from[i]]
                     : d->values[i]  ? d->values[i]->buffer
                                     : NULL;
    for (int i = 0; i < d->spare_count; i++)
        spare[i] = s->buffers[d->spare[i]];
    const struct fates fates = {d->dies, d->kept, spare, d->spare_count};
    m->run->evaluating = true;
    enum machine_status status = m->sequencers
                                     ? division_run(m, d->plan, buffers, d->values, &fates)
                                     : plan_run(m, d->plan, buffers, d->values, &fates);
    m->run->evaluating = false;
    if (status)
        return false; /* the attempt will be repeated, and report the error then */
    for (int k = 0; k < t->buffers_count; k++) {
        next[k] = d->next[k] >= 0 ? s->buffers[d->next[k]] : buffers[~d->next[k]];
        device_buffer_ref(next[k]);
    }
    int count;
    const int *stored = plan_stored(d->plan, &count);
    for (int i = 0; i < count; i++)
        if (d->kept[stored[i]])
            device_buffer_unref(m, buffers[stored[i]]);
    p->since = 0;
    p->looked = !p->edge->alone;
    m->run->stores += d->stores;
    m->run->stores_evaluated = m->run->stores;
    m->run->flushes++;
    p->log_count = 0;
    if (s != t)
        state_activate(m, to, next);
    state_buffers_put(m, s, s == t ? next : NULL);
    for (int k = 0; k < t->buffers_count; k++)
        device_buffer_unref(m, next[k]);
    return true;
}

void perform_calls(struct machine *m, enum run_mode mode)
{
    INVARIANT(m->run->mode == RUN_FREE && run_mode_catches_up(mode));
    struct replay *p = m->run->replay;
    int count = m->run->calls_noted, set = m->values->set_current;
    struct machine_call *calls = array_zeroed((size_t)count, sizeof *calls);
    for (int i = 0; i < count; i++)
        calls[i] = p->edge->calls[i % p->edge->calls_count];
    m->run->calls_noted = p->at = 0;
    p->edge = NULL;
    m->run->mode = mode;
    for (int i = 0; i < count; i++) {
        m->values->set_current = calls[i].vpset;
        calls[i].again(&calls[i]);
    }
    m->values->set_current = set;
    m->run->mode = RUN_FREE;
    free(calls);
    if (p->active >= 0 && p->states[p->active].edges_count) {
        struct state *s = &p->states[p->active];
        p->edge = &s->edges[s->edge_last];
    }
}
