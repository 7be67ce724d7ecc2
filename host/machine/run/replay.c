/* replay.c - calls seen before: taken note of, and performed all at once.
 *
 * A program that repeats a step makes the same calls again, and they make the same graph again. So once
 * a step has been recorded and evaluated between two states of the machine that look alike, the next time
 * its calls are only compared with those expected; with the last one the plan that was made for them runs
 * again, on other buffers.
 *
 *     state   what all fields and flags hold, as a graph whose leaves are numbered buffers: which
 *             buffers they are is no part of it. Found again by its signature.
 *     edge    the calls that lead from a state to a state (often the same one), and what their
 *             evaluation ran: for each argument of its kernels, which buffer of the first state or which
 *             number, and for each buffer of the second, where it comes from.
 *
 *          calls 1..n      evaluation
 *     S ---------------- > ---------- > T        S, T: found by signature when the evaluation is over
 *
 * A state keeps a graph of its own. While the machine is in it, that graph is what fields and flags hold:
 * running an edge then only moves buffers from leaf to leaf (S = T), or puts T's graph in the place of
 * S's. As soon as anything else is done to the graph the state leaves it to the machine and makes itself a
 * copy (leave). Calls noted that turn out to lead elsewhere are performed after all (catch_up): they
 * change nothing that a program could have seen meanwhile, for whoever looks catches up first.
 *
 * What a call does follows from its words, the current VP set, the state, and which fields there are: when
 * those die or change their VP sets' geometry everything noted is forgotten. Where there are aliases,
 * nothing is noted. */
#include <stdlib.h>
#include <string.h>

#include "run/replay.h"

bool replay_init(struct machine *m)
{
    if (m->run->eager || !m->settings.replay)
        return true;
    m->run->replay = calloc(1, sizeof *m->run->replay);
    if (!m->run->replay)
        return false;
    m->run->replay->active = m->run->replay->from = -1;
    return true;
}

void replay_finish(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (!p)
        return;
    m->run->calls_noted = 0; /* nobody is going to look */
    states_forget(m);
    free(p->log);
    free(p->scratch);
    free(p);
    m->run->replay = NULL;
}

void deed_finish(struct machine *m, struct deed *d)
{
    for (int i = 0; d->values && i < d->nodes_count; i++)
        if (d->values[i])
            graph_unref(m, d->values[i]);
    free(d->from);
    free(d->values);
    free(d->next);
    free(d->dies);
    free(d->kept);
    free(d->spare);
    *d = (struct deed){.plan = NULL};
}

void edge_finish(struct machine *m, struct edge *e)
{
    deed_finish(m, &e->deed);
    deed_finish(m, &e->turns);
    free(e->calls);
}

void replay_from_forget(struct machine *m)
{
    struct replay *p = m->run->replay;
    for (int i = 0; i < p->from_buffers_count; i++)
        device_buffer_unref(m, p->from_buffers[i]);
    free(p->from_buffers);
    p->from_buffers = NULL;
    p->from_buffers_count = 0;
    p->from = -1;
}

void replay_from(struct machine *m, int index)
{
    struct replay *p = m->run->replay;
    const struct state *s = &p->states[index];
    p->from = index;
    p->from_stores = m->run->stores;
    p->from_buffers =
        machine_allocated((size_t)s->buffers_count, sizeof(struct device_buffer *));
    p->from_buffers_count = s->buffers_count;
    memcpy(p->from_buffers, s->buffers,
           (size_t)s->buffers_count * sizeof(struct device_buffer *));
    for (int i = 0; i < s->buffers_count; i++)
        device_buffer_ref(s->buffers[i]);
}

/* ---- performing what was noted ---- */

/* False: that cannot be done now. */
static bool deed_do(struct machine *m, const struct deed *d, int to)
{
    struct replay *p = m->run->replay;
    struct state *s = &p->states[p->active], *t = &p->states[to];
    plans_see_to(m);
    if (!d->plan || plan_version(m, d->plan) != d->version)
        return false;
    graph_give_back(m);
    if (d->nodes_count + t->buffers_count + d->spare_count > p->scratch_capacity) {
        p->scratch_capacity = d->nodes_count + t->buffers_count + d->spare_count;
        free(p->scratch);
        p->scratch = machine_allocated((size_t)p->scratch_capacity, sizeof *p->scratch);
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
    if (plan_run(m, d->plan, buffers, d->values, &fates))
        return false; /* it is going to be tried, and said, once more */
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

void replay_catch_up(struct machine *m)
{
    struct replay *p = m->run->replay;
    int count = m->run->calls_noted, set = m->values->set_current;
    struct machine_call *calls = machine_allocated((size_t)count, sizeof *calls);
    for (int i = 0; i < count; i++)
        calls[i] = p->edge->calls[i % p->edge->calls_count];
    m->run->calls_noted = p->at = 0;
    p->edge = NULL;
    p->catching_up = true;
    for (int i = 0; i < count; i++) {
        m->values->set_current = calls[i].vpset;
        calls[i].again(&calls[i]);
    }
    m->values->set_current = set;
    p->catching_up = false;
    free(calls);
    if (p->active >= 0 && p->states[p->active].edges_count) {
        struct state *s = &p->states[p->active];
        p->edge = &s->edges[s->edge_last];
    }
}

/* All turns of the edge that have been noted, but for the last one that is not whole. False: it cannot be
 * done, and nothing of what is still noted has been. */
static bool turns_do(struct machine *m)
{
    struct replay *p = m->run->replay;
    struct edge *e = p->edge;
    int turns = loop_turns_noted(m, e), whole = m->run->calls_noted / e->calls_count;
    double start = watch_clock(m);
    if (turns > 1 && whole >= turns && !e->turns.plan) {
        enum loop_turns kernels = loop_turns_see_to(m);
        if (kernels == TURNS_AT_HAND)
            loop_build_turns(m);
        if (kernels != TURNS_WAIT)
            return true;
    } else if (turns > 1 && whole >= turns) {
        if (!deed_do(m, &e->turns, e->to))
            return false;
        m->run->calls_noted -= turns * e->calls_count;
        m->run->turns_in_row += turns;
        m->run->calls_foreseen += (uint64_t)turns * (uint64_t)e->calls_count;
        if (m->watch)
            watch_replayed(m, start, e->calls, e->calls_count, turns, e->alone);
        whole -= turns;
        loops_turned(m, e, true);
    }
    if (whole > 0 && !loop_thorough_see_to(m))
        return true;
    for (; whole > 0; whole--) {
        int left = m->run->calls_noted - e->calls_count;
        struct state *s = &p->states[p->active];
        start = watch_clock(m);
        if (!deed_do(m, &e->deed, e->to))
            return false;
        m->run->calls_foreseen += (uint64_t)e->calls_count;
        m->run->calls_noted = left;
        m->run->turns_in_row++;
        if (m->watch)
            watch_replayed(m, start, e->calls, e->calls_count, 1, e->alone);
        s->edge_last = (int)(e - s->edges);
        e->runs++;
    }
    if (m->run->calls_noted == 0) {
        p->at = 0;
        loops_turned(m, e, false);
    }
    return true;
}

static bool same_call(const struct machine_call *a, const struct machine_call *b)
{
    if (a->again != b->again || a->vpset != b->vpset || a->words_count != b->words_count)
        return false;
    for (uint32_t i = 0; i < a->words_count; i++)
        if (a->words[i] != b->words[i])
            return false;
    return true;
}

static bool begins_alike(const struct edge *a, const struct edge *b, int count)
{
    if (a->calls_count < count || b->calls_count < count)
        return false;
    for (int i = 0; i < count; i++)
        if (!same_call(&a->calls[i], &b->calls[i]))
            return false;
    return true;
}

/* Another edge with the calls noted so far, and this one next (NULL: no more than those, for somebody is
 * going to look). */
static struct edge *other_edge(struct machine *m, const struct machine_call *call)
{
    struct replay *p = m->run->replay;
    struct state *s = &p->states[p->active];
    for (int i = 0; i < s->edges_count; i++) {
        struct edge *e = &s->edges[i];
        if (e != p->edge && begins_alike(e, p->edge, m->run->calls_noted) &&
            (call ? e->calls_count > m->run->calls_noted &&
                        same_call(&e->calls[m->run->calls_noted], call)
                  : e->calls_count == m->run->calls_noted && !e->alone))
            return e;
    }
    return NULL;
}

void replay_perform(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (m->run->calls_noted > p->edge->calls_count && !turns_do(m)) {
        replay_catch_up(m);
        return;
    }
    if (!m->run->calls_noted)
        return;
    struct edge *e =
        p->edge->calls_count == m->run->calls_noted ? p->edge : other_edge(m, NULL);
    if (e) {
        p->edge = e;
        if (turns_do(m))
            return;
    }
    replay_catch_up(m);
}

/* ---- calls ---- */

static bool take_note(struct machine *m, const struct machine_call *call)
{
    struct replay *p = m->run->replay;
    struct edge *e = p->edge;
    if (!e || p->at >= e->calls_count || !same_call(call, &e->calls[p->at]))
        return false;
    m->run->calls_noted++;
    if (++p->at == e->calls_count && e->alone) {
        p->at = 0;
        if (m->run->calls_noted >= loop_turns_noted(m, e) * e->calls_count && !turns_do(m))
            replay_catch_up(m);
    }
    return true;
}

/* The call is not the next one of the edge: but perhaps that of another. */
static bool take_note_elsewhere(struct machine *m, const struct machine_call *call)
{
    struct replay *p = m->run->replay;
    if (p->edge && m->run->calls_noted > p->edge->calls_count && !turns_do(m))
        return false;
    struct edge *other = p->edge ? other_edge(m, call) : NULL;
    if (!other)
        return false;
    p->edge = other;
    p->at = m->run->calls_noted;
    return take_note(m, call);
}

static bool foreseen(struct machine *m, struct machine_call *call)
{
    struct replay *p = m->run->replay;
    if (!p)
        return false;
    if (p->depth) {
        p->depth++;
        return false;
    }
    call->vpset = m->values->set_current;
    if (take_note(m, call) || take_note_elsewhere(m, call))
        return true;
    replay_settle(m);
    if (m->run->flush_due)
        run_flush_due(m);
    if (!p->catching_up && take_note(m, call))
        return true;
    loops_call(m, call);
    p->since++;
    if (p->active >= 0 || p->from >= 0) {
        if (p->log_count == CALLS_MOST)
            replay_from_forget(m);
        else if (p->log_count == p->log_capacity)
            p->log = machine_grown(p->log, &p->log_capacity, sizeof *p->log);
        if (p->log_count < CALLS_MOST)
            p->log[p->log_count++] = *call;
    }
    p->depth = 1;
    return false;
}

bool machine_call_foreseen(struct machine *m, struct machine_call *call)
{
    bool known = foreseen(m, call);
    if (m->watch)
        watch_call(m, call->name, known);
    return known;
}

void machine_call_performed(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (m->watch)
        watch_performed(m);
    if (p && p->depth && --p->depth == 0 && !m->run->hold_flush && loop_turn_ends(m))
        m->run->flush_due = true;
}

void machine_call_failed(struct machine *m)
{
    if (m->watch)
        watch_call_failed(m);
    if (!m->run->replay)
        return;
    m->run->replay->depth = 0;
    replay_from_forget(m);
    m->run->replay->log_count = 0;
}

void machine_calls_forget(struct machine *m)
{
    replay_forget(m);
}

bool replay_in_call(const struct machine *m)
{
    return m->run->replay && m->run->replay->depth;
}

/* ---- what an evaluation made of them ---- */

void replay_impure(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (!p)
        return;
    if (p->active >= 0)
        state_leave(m);
    replay_from_forget(m);
}

/* Which of the buffers of the state before it is, by mark. */
static void number_buffers(struct machine *m, struct device_buffer *const *buffers, int count)
{
    m->values->mark++;
    for (int i = 0; i < count; i++) {
        buffers[i]->mark = m->values->mark;
        buffers[i]->number = (uint32_t)i;
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

bool replay_follows(const struct machine *m)
{
    const struct replay *p = m->run->replay;
    return p && p->from >= 0 && p->active < 0 && !p->depth;
}

void replay_evaluates(struct machine *m, struct plan *plan, struct machine_value *const *nodes,
                      int count, struct device_buffer *const *buffers)
{
    struct replay *p = m->run->replay;
    if (!p)
        return;
    p->forgets = loops_evaluate(m, plan);
    if (p->depth || p->forgets)
        replay_from_forget(m);
    if (p->from < 0)
        return;
    struct edge e = {
        .calls_count = p->log_count,
        .alone = m->run->flushing,
        .deed = {.plan = plan,
                 .version = plan_version(m, plan),
                 .stores = m->run->stores - p->from_stores,
                 .nodes_count = count,
                 .from = machine_allocated((size_t)count, sizeof *e.deed.from),
                 .values = machine_allocated((size_t)count, sizeof(struct machine_value *))}};
    p->making = sources_find(m, &e.deed, nodes, buffers);
    if (p->making)
        p->made = e;
    else
        edge_finish(m, &e);
}

static void find_spare(struct deed *d, int from_count, int to_count)
{
    d->spare = machine_allocated((size_t)from_count, sizeof *d->spare);
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

/* The edge that has been made leads to the state walked. */
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
         i++) /* what was computed for somebody must be in the state */
        for (int k = 0; k < count; k++)
            if (wanted[i]->buffer == buffers[stored[k]] &&
                wanted[i]->buffer->mark != m->values->mark)
                return false;
    number_buffers(m, p->from_buffers, p->from_buffers_count);
    for (int k = 0; k < count; k++) {
        buffers[stored[k]]->mark = m->values->mark;
        buffers[stored[k]]->number = ~(uint32_t)stored[k];
    }
    int32_t *next = machine_allocated((size_t)w->buffers_count, sizeof *next);
    bool *kept = machine_allocated((size_t)e->deed.nodes_count, sizeof *kept);
    e->deed.next = next;
    e->deed.kept = kept;
    for (int k = 0; k < w->buffers_count; k++) {
        if (w->buffers[k]->mark != m->values->mark)
            return false;
        next[k] = (int32_t)w->buffers[k]->number;
        if (next[k] < 0)
            kept[~next[k]] = true;
    }
    e->deed.dies = machine_allocated((size_t)e->deed.nodes_count, sizeof *e->deed.dies);
    for (int i = 0; i < e->deed.nodes_count; i++) {
        e->deed.dies[i] = e->deed.from[i] >= 0;
        for (int k = 0; k < w->buffers_count && e->deed.dies[i]; k++)
            e->deed.dies[i] = next[k] != e->deed.from[i];
    }
    find_spare(&e->deed, p->from_buffers_count, w->buffers_count);
    e->to = to;
    e->calls = machine_allocated((size_t)e->calls_count, sizeof *e->calls);
    memcpy(e->calls, p->log, (size_t)e->calls_count * sizeof *e->calls);
    return true;
}

/* Many turns of a loop of that state: they are no edge of their own. */
static bool turns_add(struct machine *m, struct state *s, int to)
{
    struct replay *p = m->run->replay;
    if (!m->run->building || s != &p->states[to])
        return false;
    for (int i = 0; i < s->edges_count; i++) {
        struct edge *e = &s->edges[i];
        bool same = e->alone && e->to == to && p->made.calls_count == p->building_calls;
        for (int k = 0; same && k < p->made.calls_count; k++)
            same = same_call(&e->calls[k % e->calls_count], &p->made.calls[k]);
        if (!same)
            continue;
        deed_finish(m, &e->turns);
        e->turns = p->made.deed;
        p->made.deed = (struct deed){.plan = NULL};
        return true;
    }
    return false;
}

/* In the place of one with the same calls, or of the oldest. */
static void edge_add(struct machine *m, struct state *s, const struct edge *e)
{
    int at = -1;
    for (int i = 0; i < s->edges_count && at < 0; i++)
        if (s->edges[i].calls_count == e->calls_count && s->edges[i].alone == e->alone &&
            begins_alike(&s->edges[i], e, e->calls_count))
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

void replay_evaluated(struct machine *m, struct device_buffer *const *buffers,
                      struct machine_value *const *wanted, int wanted_count)
{
    struct replay *p = m->run->replay;
    if (!p)
        return;
    if (!p->depth) {
        p->since = 0;
        p->looked = !m->run->flushing;
    }
    if (p->forgets)
        states_forget(m);
    p->forgets = false;
    if (p->active >= 0) /* it changed nothing that is kept */
        return;
    if (p->depth) { /* in the middle of a call: what follows is no state's beginning */
        replay_from_forget(m);
        return;
    }
    struct walk w;
    states_walk(m, &w);
    if (w.good && p->states_count == STATES_MOST) {
        replay_failed(m);
        states_forget(m);
    }
    int to = w.good ? state_find(m, &w) : -1;
    bool complete =
        to >= 0 && p->making && edge_complete(m, &w, to, buffers, wanted, wanted_count);
    if (complete && !turns_add(m, &p->states[p->from], to) && !m->run->building) {
        edge_add(m, &p->states[p->from], &p->made);
        p->making = false;
    }
    replay_from_forget(m);
    p->log_count = 0;
    if (to >= 0)
        state_activate(m, to, w.buffers);
    walk_finish(&w);
    replay_failed(m);
}

void replay_failed(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (p && p->making)
        edge_finish(m, &p->made);
    if (p)
        p->making = false;
}
