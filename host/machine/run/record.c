/* record.c - records what an evaluation made of the calls before it: see replay.h. */
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "memory/memory.h"
#include "run/replay.h"
#include "values/graph.h"

/* A program that does not repeat, of short plans, pays more for states that nobody finds again
 * than for its work. After so many evaluations in vain states are looked for after some of them
 * only. */
enum { IN_VAIN_MOST = 256, IN_VAIN_RESTS = 192, IN_VAIN_TRIES = 64 };

static bool rests(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (m->run->calls_foreseen != p->foreseen)
        p->in_vain = 0;
    p->foreseen = m->run->calls_foreseen;
    if (p->in_vain == IN_VAIN_MOST + IN_VAIN_RESTS)
        p->in_vain = IN_VAIN_MOST - IN_VAIN_TRIES;
    return p->is_short && ++p->in_vain > IN_VAIN_MOST;
}

bool record_init(struct machine *m)
{
    if (m->settings.eager || !m->settings.replay)
        return true;
    m->run->replay = calloc(1, sizeof *m->run->replay);
    if (!m->run->replay)
        return false;
    m->run->replay->active = m->run->replay->from = -1;
    m->memory->lifetimes.noted = true;
    m->values->before_change = states_before_change;
    return true;
}

void record_finish(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (!p)
        return;
    m->run->calls_noted = 0; /* nothing observes the noted calls any more */
    states_forget(m);
    free(p->log);
    free(p->scratch);
    free(p);
    m->run->replay = NULL;
    m->memory->lifetimes.noted = false;
    m->values->before_change = NULL;
}

void record_impure(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (!p)
        return;
    if (p->active >= 0)
        state_leave(m);
    states_from_forget(m);
}

bool record_same_call(const struct machine_call *a, const struct machine_call *b)
{
    if (a->again != b->again || a->vpset != b->vpset || a->words_count != b->words_count)
        return false;
    for (uint32_t i = 0; i < a->words_count; i++)
        if (a->words[i] != b->words[i])
            return false;
    return true;
}

bool record_begins_alike(const struct edge *a, const struct edge *b, int count)
{
    if (a->calls_count < count || b->calls_count < count)
        return false;
    for (int i = 0; i < count; i++)
        if (!record_same_call(&a->calls[i], &b->calls[i]))
            return false;
    return true;
}

/* Finds, by mark, which buffer of the previous state each one is. */
static void number_buffers(struct machine *m, struct device_buffer *const *buffers, int count)
{
    m->values->mark++;
    for (int i = 0; i < count; i++)
        if (buffers[i]) {
            buffers[i]->mark = m->values->mark;
            buffers[i]->number = (uint32_t)i;
        }
}

/* Lets go of arrays of the state before that nobody else holds: the plan does not read them,
 * and they are in no later state. */
static void spare_let_go(struct machine *m)
{
    struct replay *p = m->run->replay;
    for (int i = 0; i < p->from_buffers_count; i++)
        if (p->from_buffers[i] && p->from_buffers[i]->refs == 1) {
            device_buffer_unref(m, p->from_buffers[i]);
            p->from_buffers[i] = NULL;
        }
}

static bool sources_find(struct machine *m, struct deed *d, struct machine_value *const *nodes,
                         struct device_buffer *const *buffers)
{
    const struct replay *p = m->run->replay;
    number_buffers(m, p->from_buffers, p->from_buffers_count);
    for (int i = 0; i < d->nodes_count; i++) {
        struct machine_value *v = nodes[i];
        d->from[i] = -1;
        if (v->op == NODE_CONSTANT || (buffers[i] && v->op != NODE_BUFFER)) {
            d->values[i] = v;
            graph_ref(v);
        } else if (buffers[i]) {
            if (buffers[i]->mark != m->values->mark)
                return false;
            d->from[i] = (int32_t)buffers[i]->number;
        }
    }
    return true;
}

bool record_follows(const struct machine *m)
{
    const struct replay *p = m->run->replay;
    return p && p->from >= 0 && p->active < 0 && !p->depth;
}

void record_evaluates(struct machine *m, struct plan *plan, struct machine_value *const *nodes,
                      int count, struct device_buffer *const *buffers, bool due)
{
    struct replay *p = m->run->replay;
    if (!p)
        return;
    p->forgets = history_evaluates(m, plan, due) ||
                 (plans_are_many(m) && !run_mode_builds(m->run->mode));
    p->is_short = plan_is_short(m, plan);
    if (p->depth || p->forgets)
        states_from_forget(m);
    if (p->from < 0)
        return;
    struct edge e = {
        .calls_count = p->log_count,
        .alone = due,
        .deed = {.plan = plan,
                 .version = plan->version,
                 .stores = m->run->stores - p->from_stores,
                 .nodes_count = count,
                 .from = array_zeroed((size_t)count, sizeof *e.deed.from),
                 .values = array_zeroed((size_t)count, sizeof(struct machine_value *))}};
    p->making = sources_find(m, &e.deed, nodes, buffers);
    spare_let_go(m);
    if (p->making)
        p->made = e;
    else
        edge_finish(m, &e);
}

static void find_spare(struct deed *d, int from_count, int to_count)
{
    d->spare = array_zeroed((size_t)from_count, sizeof *d->spare);
    for (int k = 0; k < from_count; k++) {
        bool spare = true;
        for (int i = 0; i < d->nodes_count; i++)
            spare = spare && d->from[i] != k;
        for (int i = 0; i < to_count; i++)
            spare = spare && d->next[i] != k;
        if (spare)
            d->spare[d->spare_count++] = k;
    }
}

/* Completes the edge that was made: it leads to the state walked. */
static bool edge_complete(struct machine *m, const struct walk *w, int to,
                          struct device_buffer *const *buffers,
                          struct machine_value *const *wanted, int wanted_count)
{
    struct replay *p = m->run->replay;
    struct edge *e = &p->made;
    int count;
    if (p->states[p->from].places != p->states[to].places)
        return false;
    const int *stored = plan_stored(e->deed.plan, &count);
    number_buffers(m, w->buffers, w->buffers_count);
    for (int i = 0; i < wanted_count;
         i++) /* every value computed on request must be in the state */
        for (int k = 0; k < count; k++)
            if (wanted[i]->buffer == buffers[stored[k]] &&
                wanted[i]->buffer->mark != m->values->mark)
                return false;
    number_buffers(m, p->from_buffers, p->from_buffers_count);
    for (int k = 0; k < count; k++)
        if (buffers[stored[k]]) { /* else only the plan's own kernels have looked at it */
            buffers[stored[k]]->mark = m->values->mark;
            buffers[stored[k]]->number = ~(uint32_t)stored[k];
        }
    int32_t *next = array_zeroed((size_t)w->buffers_count, sizeof *next);
    bool *kept = array_zeroed((size_t)e->deed.nodes_count, sizeof *kept);
    e->deed.next = next;
    e->deed.kept = kept;
    for (int k = 0; k < w->buffers_count; k++) {
        if (w->buffers[k]->mark != m->values->mark)
            return false;
        next[k] = (int32_t)w->buffers[k]->number;
        if (next[k] < 0)
            kept[~next[k]] = true;
    }
    e->deed.dies = array_zeroed((size_t)e->deed.nodes_count, sizeof *e->deed.dies);
    for (int i = 0; i < e->deed.nodes_count; i++) {
        e->deed.dies[i] = e->deed.from[i] >= 0;
        for (int k = 0; k < w->buffers_count && e->deed.dies[i]; k++)
            e->deed.dies[i] = next[k] != e->deed.from[i];
    }
    find_spare(&e->deed, p->from_buffers_count, w->buffers_count);
    e->to = to;
    e->calls = array_zeroed((size_t)e->calls_count, sizeof *e->calls);
    memcpy(e->calls, p->log, (size_t)e->calls_count * sizeof *e->calls);
    return true;
}

/* Adds many turns of a loop of that state, which are not an edge of their own. */
static bool turns_add(struct machine *m, struct state *s, int to)
{
    struct replay *p = m->run->replay;
    if (!run_mode_builds(m->run->mode) || s != &p->states[to])
        return false;
    for (int i = 0; i < s->edges_count; i++) {
        struct edge *e = &s->edges[i];
        bool same = e->alone && e->to == to && p->made.calls_count == p->building_calls;
        for (int k = 0; same && k < p->made.calls_count; k++)
            same = record_same_call(&e->calls[k % e->calls_count], &p->made.calls[k]);
        if (!same)
            continue;
        deed_finish(m, &e->turns);
        e->turns = p->made.deed;
        p->made.deed = (struct deed){.plan = NULL};
        return true;
    }
    return false;
}

/* Adds an edge in place of one with the same calls, or of the oldest. */
static void edge_add(struct machine *m, struct state *s, const struct edge *e)
{
    int at = -1;
    for (int i = 0; i < s->edges_count && at < 0; i++)
        if (s->edges[i].calls_count == e->calls_count && s->edges[i].alone == e->alone &&
            record_begins_alike(&s->edges[i], e, e->calls_count))
            at = i;
    if (at < 0 && s->edges_count < EDGES_MOST)
        s->edges[at = s->edges_count++] = (struct edge){0};
    if (at < 0) {
        edge_finish(m, &s->edges[0]);
        memmove(&s->edges[0], &s->edges[1], (EDGES_MOST - 1) * sizeof s->edges[0]);
        s->edges[at = EDGES_MOST - 1] = (struct edge){0};
    }
    edge_finish(m, &s->edges[at]);
    s->edges[at] = *e;
    s->edge_last = at;
}

void record_evaluated(struct machine *m, struct device_buffer *const *buffers,
                      struct machine_value *const *wanted, int wanted_count, bool due)
{
    struct replay *p = m->run->replay;
    if (p && !p->depth) {
        p->since = 0;
        p->looked = !due;
    }
    if (p && p->forgets)
        states_forget(m);
    if ((!p || p->forgets) && plans_are_many(m) && !run_mode_builds(m->run->mode))
        plans_forget_oldest(m);
    if (!p)
        return;
    p->forgets = false;
    if (p->active >= 0) /* the evaluation changed nothing that is kept */
        return;
    if (p->depth) { /* in the middle of a call: no state begins here */
        states_from_forget(m);
        return;
    }
    if (rests(m)) {
        states_from_forget(m);
        p->log_count = 0;
        record_failed(m);
        return;
    }
    struct walk w;
    states_walk(m, &w);
    if (w.good && p->states_count == STATES_MOST) {
        record_failed(m);
        states_forget(m);
    }
    int to = w.good ? state_find(m, &w) : -1;
    bool complete =
        to >= 0 && p->making && edge_complete(m, &w, to, buffers, wanted, wanted_count);
    if (complete && !turns_add(m, &p->states[p->from], to) && !run_mode_builds(m->run->mode)) {
        edge_add(m, &p->states[p->from], &p->made);
        p->making = false;
    }
    states_from_forget(m);
    p->log_count = 0;
    if (to >= 0)
        state_activate(m, to, w.buffers);
    walk_finish(&w);
    record_failed(m);
}

void record_failed(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (p && p->making)
        edge_finish(m, &p->made);
    if (p)
        p->making = false;
}
