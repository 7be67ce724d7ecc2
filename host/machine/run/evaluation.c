/* evaluation.c - an evaluation, in two halves. The first finds the targets, the nodes that they
 * reach, and a plan. The second runs the plan's kernels. record.c records the evaluation
 * between the halves and after them.
 *
 * An evaluation has targets: the values asked for, and the content of every live field and flag
 * that is not
 *  - in memory already, a number, or a cheap function of coordinates;
 *  - an address that is a processor's own but for some bits, and all new
 *  - a temporary: a slot that was overwritten before it was read since the last
 * evaluation, whose present value is shallow and all new. It stays an expression; most
 * temporaries are overwritten again and never computed. If a temporary, or a value made of it,
 * is still there at the next evaluation it is computed then.
 *
 * Plans are kept by signature: a number for each node reached, in the order in which the
 * nodes are reached. The values of constants are not part of it. A step seen before costs a
 * walk over its nodes, a look-up, and its launches.
 */
#include "run/evaluation.h"

#include <stdlib.h>

#include "base/errors.h"
#include "memory/memory.h"
#include "plans/division.h"
#include "plans/explained.h"
#include "plans/reach.h"
#include "run/pending.h"
#include "run/replay.h"
#include "run/room.h"
#include "run/slices.h"
#include "values/graph.h"
#include "watch/watch.h"

struct evaluation {
    struct targets targets;
    struct reach reach;
    struct plan *plan; /* NULL: nothing to run */
    struct device_buffer *
        *buffers; /* by node, of those in memory; after the second half also of those stored */
    double start;
    bool *kept;  /* by node: its array is needed after the plan, if it is stored */
    bool stored; /* the second half is done: the stored buffers are referenced */
};

/* ---- the nodes that are reached ---- */

/* Depth first; HEIGHT_MOST limits the recursion. No value is part of itself, and none that was
 * let go of is reached. */
static bool reach_from(struct machine *m, struct reach *r, struct machine_value *v)
{
    INVARIANT(v->refs);
    if (v->mark == m->values->mark) {
        INVARIANT(v->local != NODE_UNDER_WAY);
        return true;
    }
    v->mark = m->values->mark;
    v->local = NODE_UNDER_WAY;
    if (v->op == NODE_SLICE && !v->buffer && !slice_unpack(m, v))
        return false;
    const int inputs = v->buffer ? 0 : node_ops[v->op].inputs;
    for (int i = 0; i < inputs; i++)
        if (!reach_from(m, r, v->in[i]))
            return false;
    return reach_add(m, r, v, inputs);
}

/* ---- targets ---- */

/* Whether it is left an expression. */
static bool slot_waits(const struct machine *m, const struct slot *slot)
{
    const struct machine_value *v = slot->value;
    /* addresses made for one get or two are never computed: gets know them by what they are */
    return (slot->overwritten_first || v->own_address) && v->birth == m->values->epoch &&
           v->height <= HEIGHT_DEFERRED;
}

static bool is_computed(const struct machine_value *v)
{
    return node_is_leaf(v) || node_is_cheap(v) || v->op == NODE_SLICE;
}

bool evaluation_wants(struct machine *m, const struct slot *slot)
{
    return !is_computed(slot->value) && !slot_waits(m, slot);
}

static bool slot_wants(struct machine *m, const struct slot *slot, bool all)
{
    if (is_computed(slot->value))
        return false;
    const bool waits = !all && slot_waits(m, slot);
    m->values->vanished.expressions += waits;
    return !waits;
}

static bool targets_collect(struct machine *m, struct targets *t, bool all)
{
    for (int i = 1; i < m->values->sets_count; i++)
        for (int flag = 0; m->values->sets[i].used && flag < 3; flag++)
            if (slot_wants(m, &m->memory->flags[i].of[flag], all) &&
                !targets_add(t, m->memory->flags[i].of[flag].value))
                return false;
    for (int i = 0; i < m->memory->fields_count; i++)
        for (int k = 0; k < m->memory->fields[i]->slots_count; k++)
            if (slot_wants(m, &m->memory->fields[i]->slots[k], all) &&
                !targets_add(t, m->memory->fields[i]->slots[k].value))
                return false;
    return true;
}

/* Collects the targets: the values asked for, and what else there is to compute. */
static bool find_targets(struct machine *m, struct targets *t, const struct wish *w)
{
    bool good = true;
    for (int i = 0; i < w->count && good; i++)
        if (w->values[i]->op == NODE_SLICE && !w->values[i]->buffer)
            good = slice_unpack(m, w->values[i]);
        else if (!node_is_leaf(w->values[i]))
            good = targets_add(t, w->values[i]);
    /* Several reads in a row count as one look: values have not become older in between. */
    if (w->what == WISH_ALL ||
        (w->what == WISH_LIVE && m->run->stores != m->run->stores_evaluated))
        good = good && targets_collect(m, t, w->what == WISH_ALL);
    return good;
}

static bool find_reach(struct machine *m, struct reach *r, const struct targets *t)
{
    bool good = true;
    m->values->mark++;
    for (int i = 0; i < t->count && good; i++)
        good = reach_from(m, r, t->values[i]);
    return good && reach_ends(r, t);
}

/* ---- the two halves ---- */

/* Changes nothing. release() is called in any case. */
static enum machine_status first_half(struct machine *m, struct evaluation *e,
                                      const struct wish *wish, enum plan_use use)
{
    *e = (struct evaluation){.start = watch_clock(m)};
    double from = e->start;
    bool good = find_targets(m, &e->targets, wish);
    if (good && e->targets.count == 0)
        return MACHINE_OK;
    if (m->watch)
        watch_span(m, WATCH_TARGETS, from, "\"targets\":%d", e->targets.count);
    from = watch_clock(m);
    good = good && find_reach(m, &e->reach, &e->targets);
    if (m->watch) {
        watch_span(m, WATCH_SIGNATURE, from, "\"nodes\":%d", e->reach.count);
        explained_nodes(m, e->reach.nodes, wish->values, wish->count, memory_where);
    }
    if (!good)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to evaluate");
    from = watch_clock(m);
    uint64_t built = m->plans->built;
    const struct plan_request request = {
        .reach = &e->reach, .targets = &e->targets, .use = use};
    e->plan = m->sequencers ? division_get(m, &request) : plan_get(m, &request);
    if (m->watch)
        watch_span(m, WATCH_LOOKUP, from, "\"found\":%s",
                   m->plans->built == built ? "true" : "false");
    if (!e->plan)
        return plan_use_runs(use) ? m->status : MACHINE_OK;
    e->buffers = calloc((size_t)e->reach.count, sizeof(struct device_buffer *));
    e->kept = malloc((size_t)e->reach.count * sizeof *e->kept);
    if (!e->buffers || !e->kept)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to run a plan");
    for (int i = 0; i < e->reach.count; i++)
        e->buffers[i] = e->reach.nodes[i]->buffer;
    return MACHINE_OK;
}

/* Tells observers what became of values. */
static void tell_computed(struct machine *m, const struct evaluation *e)
{
    int computed = 0, stored;
    for (int i = 0; i < e->reach.count; i++) {
        struct machine_value *v = e->reach.nodes[i];
        computed += !v->told && !node_is_leaf(v);
        v->told = v->told || !node_is_leaf(v);
    }
    plan_stored(e->plan, &stored);
    watch_computed(m, computed, stored);
}

/* Byte code stores a cheap function of coordinates where it needs its neighbours. Only the
 * value's definition tells later kernels which rows a test of coordinates concerns. So such an
 * array is given back, unless somebody asked for the value. */
static bool is_kept(const struct evaluation *e, const struct machine_value *v)
{
    if (!node_is_cheap(v))
        return true;
    for (int i = 0; i < e->targets.count; i++)
        if (e->targets.values[i] == v)
            return true;
    return false;
}

/* Finds whose arrays outlive the plan. A value that is in memory lets go of its operands, and
 * so does one that nobody holds any more. An array of which only such values are made is given
 * back as soon as the plan's last kernel that reads it has been started: a plan of several
 * kernels stores much for its own kernels only. */
static enum machine_status find_kept(struct machine *m, struct evaluation *e)
{
    struct machine_value *const *nodes = e->reach.nodes;
    uint32_t *holders = malloc((size_t)e->reach.count * sizeof *holders);
    int count;
    const int *stored = plan_stored(e->plan, &count);
    if (!holders)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to run a plan");
    for (int i = 0; i < e->reach.count; i++) {
        holders[i] = nodes[i]->refs;
        e->kept[i] = false;
    }
    for (int i = 0; i < count; i++)
        e->kept[stored[i]] = is_kept(e, nodes[stored[i]]);
    for (int i = 0; i < e->targets.count; i++) /* whoever asks may only borrow it */
        holders[e->targets.values[i]->local]++;
    for (int i = e->reach.count - 1; i >= 0; i--) { /* users first */
        const struct machine_value *v = nodes[i];
        const int inputs = v->buffer ? 0 : node_ops[v->op].inputs;
        const bool lets_go = e->kept[i] || holders[i] == 0;
        for (int k = 0; lets_go && k < inputs; k++)
            holders[v->in[k]->local]--;
        e->kept[i] = e->kept[i] && holders[i] > 0;
    }
    free(holders);
    return MACHINE_OK;
}

static enum machine_status second_half(struct machine *m, struct evaluation *e)
{
    int count;
    struct machine_value *const *nodes = e->reach.nodes;
    struct device_buffer *const *buffers = e->buffers;
    if (m->watch)
        tell_computed(m, e);
    const struct fates fates = {.kept = e->kept};
    enum machine_status status = find_kept(m, e);
    if (!status)
        status = m->sequencers ? division_run(m, e->plan, e->buffers, nodes, &fates)
                               : plan_run(m, e->plan, e->buffers, nodes, &fates);
    const int *stored = plan_stored(e->plan, &count);
    if (status)
        return status;
    e->stored = true;
    /* Users first: a node whose inputs are released may hold their last references. */
    for (int i = count - 1; i >= 0; i--) {
        graph_ref(nodes[stored[i]]);
        if (e->kept[stored[i]])
            device_buffer_ref(buffers[stored[i]]);
    }
    for (int i = count - 1; i >= 0; i--)
        if (e->kept[stored[i]])
            graph_materialised(m, nodes[stored[i]], buffers[stored[i]]);
    for (int i = count - 1; i >= 0; i--)
        graph_unref(m, nodes[stored[i]]);
    m->values->epoch++;
    return MACHINE_OK;
}

static void release(struct machine *m, struct evaluation *e)
{
    int count = 0;
    const int *stored = e->stored ? plan_stored(e->plan, &count) : NULL;
    for (int i = count - 1; i >= 0; i--)
        if (e->buffers[stored[i]])
            device_buffer_unref(m, e->buffers[stored[i]]);
    free(e->buffers);
    free(e->kept);
    free(e->targets.values);
    reach_finish(&e->reach);
}

/* ---- both halves, recorded between them and after them ---- */

/* Computes recorded overflows, too: all of them; or those that will probably be needed, because
 * the context changes before they are overwritten. Later their operands would have to be kept,
 * and computed again. A turn whose first overflow is everybody's needs none of the turn
 * before. */
static void resolve_overflows(struct machine *m, bool all)
{
    struct replay *p = m->run->replay;
    if (p)
        p->depth++; /* these belong to the calls before */
    for (int i = 1; i < m->values->sets_count; i++) {
        struct flags *f = &m->memory->flags[i];
        const bool needed = f->overflow.op && f->overflow_needed && !f->overflow_whole &&
                            f->overflow.context->op != NODE_CONSTANT;
        if (m->values->sets[i].used && (all || needed))
            flag_resolved(m, &m->values->sets[i], MACHINE_OVERFLOW);
        if (needed) /* and it is no temporary: a part of it is older */
            f->of[MACHINE_OVERFLOW].overwritten_first = false;
        f->overflow_begun = f->overflow_whole = f->overflow_needed = false;
    }
    if (p)
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

/* A turn of a loop whose plan waits for memory: several turns at once go through the caches
 * together. */
static void wait_longer(struct machine *m, const struct evaluation *e)
{
    const uint64_t most = PENDING_TRAFFIC * m->settings.flush_after;
    double times = plan_waits_for_memory(m, e->plan);
    if (times <= 0) {
        m->run->wait_for = 0;
    } else if (times > 1) {
        double wanted = times * e->reach.count;
        m->run->wait_for = wanted < (double)most ? (uint64_t)wanted : most;
    }
}

static enum machine_status perform(struct machine *m, struct evaluation *e,
                                   const struct wish *w, enum run_why why)
{
    const bool recorded = !m->run->in_pieces;
    if (recorded)
        record_evaluates(m, e->plan, e->reach.nodes, e->reach.count, e->buffers,
                         why == RUN_DUE);
    enum machine_status status = second_half(m, e);
    if (recorded && status)
        record_failed(m);
    else if (recorded)
        record_evaluated(m, e->buffers, w->values, w->count, why == RUN_DUE);
    if (!status && why == RUN_DUE)
        wait_longer(m, e);
    if (m->watch)
        watch_evaluated(m, e->start, watch_why_of(m, w, why), e->targets.count);
    m->run->flushes++;
    return status;
}

/* One value, and nothing else. */
static enum machine_status evaluate_piece(struct machine *m, struct machine_value *v)
{
    struct evaluation e;
    const struct wish wish = {&v, 1, WISH_VALUES};
    graph_ref(v);
    enum machine_status status = first_half(m, &e, &wish, PLAN_TO_RUN);
    if (!status && e.plan)
        status = perform(m, &e, &wish, RUN_LOOKED);
    release(m, &e);
    graph_unref(m, v);
    return status;
}

/* Memory is short: what was stored into a field or flag first is computed first, by itself.
 * Nothing is left to compute. */
static enum machine_status evaluate_in_pieces(struct machine *m, const struct wish *wish)
{
    enum machine_status status = MACHINE_OK;
    struct machine_value *v;
    record_impure(m);
    m->run->in_pieces = true;
    while (!status && (v = pieces_next(m, wish->values, wish->count))) {
        struct machine_value *before = pieces_before(m, v);
        status = evaluate_piece(m, before ? before : v);
    }
    for (int i = 0; i < wish->count && !status; i++) /* slices */
        if (!node_is_leaf(wish->values[i]))
            status = evaluate_piece(m, wish->values[i]);
    m->run->in_pieces = false;
    m->run->flush_hash = 0;
    if (!status)
        m->run->stores_evaluated = m->run->stores;
    room_measure(m);
    return status;
}

/* Whether there is room for all that a plan stores. */
static bool has_room(const struct machine *m, const struct plan *p)
{
    return m->settings.eager || room_has(m, plan_stores_bytes(p));
}

/* All at once. *short_of_memory: in pieces it may be possible, and nothing has been done. */
static enum machine_status evaluate_whole(struct machine *m, const struct wish *wish,
                                          enum run_why why, bool *short_of_memory)
{
    struct wish w = *wish;
    struct evaluation e;
    if (m->run->replay && m->run->replay->thorough) {
        w.what = WISH_ALL;
        resolve_overflows(m, true);
    } else if (w.what == WISH_LIVE && m->run->stores != m->run->stores_evaluated) {
        resolve_overflows(m, false);
    }
    enum plan_use use = use_of(m->run->mode);
    enum machine_status status = first_half(m, &e, &w, use);
    *short_of_memory = !status && e.plan && plan_use_runs(use) && !has_room(m, e.plan);
    if (w.what != WISH_VALUES)
        m->run->stores_evaluated = m->run->stores;
    m->run->flush_hash = 0; /* the observer now decides when to evaluate */
    if (!plan_use_runs(use))
        m->run->rehearsed = e.plan;
    else if (!status && e.plan && !*short_of_memory)
        status = perform(m, &e, &w, why);
    *short_of_memory =
        *short_of_memory || (status == MACHINE_NO_MEMORY && e.plan && !m->settings.eager);
    if (w.what != WISH_VALUES)
        room_measure(m);
    if ((status || *short_of_memory) && w.what != WISH_VALUES)
        m->run->stores_evaluated = m->run->stores - 1; /* not yet */
    release(m, &e);
    return status;
}

enum machine_status evaluation_run(struct machine *m, const struct wish *wish, enum run_why why)
{
    bool short_of_memory = true;
    enum machine_status status = MACHINE_OK;
    m->run->evaluating = true;
    if (!m->run->in_pieces)
        status = evaluate_whole(m, wish, why, &short_of_memory);
    if (short_of_memory) {
        if (status)
            machine_error_clear(m);
        status = evaluate_in_pieces(m, wish);
    }
    m->run->evaluating = false;
    return status;
}
