/* run.c - evaluation: what to compute, and when.
 *
 * An evaluation has targets: the values asked for, and the content of every live field and flag
 * that is not
 *  - in memory already, a number, or a cheap function of coordinates;
 *  - a temporary just now: a slot that was overwritten before it was read since the last
 * evaluation, whose present value is shallow and all new. It stays an expression; most are
 * overwritten again and never computed. If it, or something made of it, is still there at the
 * next evaluation it is computed then.
 *
 * Plans are kept by signature: a number for each node that is reached, in the order in which it
 * is reached; numbers' values are no part of it. A step seen before is a walk over its nodes, a
 * look-up, and its launches.
 *
 * When nothing is observed the graph grows; past PENDING_MANY values it is evaluated, and from
 * then on whenever the trace of stores comes to the same place as then: once for each turn of a
 * loop, always at the same point. */
#include <stdlib.h>
#include <string.h>

#include "build/plan_kernels.h"
#include "watch/watch.h"

enum { PENDING_MOST = 4096, PENDING_LOOP = 16384, HEIGHT_DEFERRED = 96, HEIGHT_MOST = 1500 };

#define TRACE_FACTOR                                                                           \
    0x9e3779b97f4a7c15u /* its TRACE_LENGTH-th power is machine.trace_power   \
                                          */

/* ---- the nodes that are reached ---- */

static bool reach_room(struct reach *r)
{
    bool failed = false;
    if (r->count == r->capacity)
        r->nodes = machine_more(r->nodes, &r->capacity, sizeof *r->nodes, &failed);
    if (!failed && r->length + 9 > (uint32_t)r->signature_capacity)
        r->signature =
            machine_more(r->signature, &r->signature_capacity, sizeof *r->signature, &failed);
    return !failed;
}

/* Depth first; HEIGHT_MOST bounds the recursion. */
static bool reach_from(struct machine *m, struct reach *r, struct machine_value *v)
{
    if (v->mark == m->values->mark)
        return true;
    v->mark = m->values->mark;
    if (v->op == NODE_SLICE && !v->buffer && !reshape_unpack(m, v))
        return false;
    int inputs = v->buffer ? 0 : node_ops[v->op].inputs;
    for (int i = 0; i < inputs; i++)
        if (!reach_from(m, r, v->in[i]))
            return false;
    if (!reach_room(r))
        return false;
    v->local = (uint32_t)r->count;
    r->nodes[r->count++] = v;
    uint32_t *s = r->signature;
    s[r->length++] = (uint32_t)(v->buffer ? NODE_BUFFER : v->op) | (uint32_t)v->type.kind << 8 |
                     (uint32_t)v->type.width << 16 | (uint32_t)v->axis << 24;
    if (v->type.s) {
        s[r->length - 1] |= 0x8000;
        s[r->length++] = v->type.s | (uint32_t)v->type.e << 8;
    }
    if (v->op != NODE_CONSTANT)
        s[r->length++] = v->set | (uint32_t)m->values->sets[v->set].generation << 16;
    if (!v->buffer) {
        s[r->length++] = (uint32_t)v->detail;
        for (int i = 0; i < inputs; i++)
            s[r->length++] = v->in[i]->local;
    }
    /* min and max with a number: whether that is a NaN is decided at recording */
    s[r->length++] = v->maybe_nan;
    return true;
}

/* ---- targets ---- */

static bool targets_add(struct targets *t, struct machine_value *v)
{
    bool failed = false;
    if (t->count == t->capacity)
        t->values = machine_more(t->values, &t->capacity, sizeof *t->values, &failed);
    if (!failed)
        t->values[t->count++] = v;
    return !failed;
}

static bool slot_wants(struct machine *m, const struct slot *slot, bool all)
{
    const struct machine_value *v = slot->value;
    if (node_is_leaf(v) || node_is_cheap(v) || v->op == NODE_SLICE)
        return false;
    if (all || v->height > HEIGHT_DEFERRED)
        return true;
    bool waits = slot->overwritten_first && v->birth == m->values->epoch;
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

/* ---- evaluation ---- */

static enum machine_status execute(struct machine *m, struct plan *p, const struct reach *r,
                                   struct machine_value *const *wanted, int wanted_count)
{
    int count;
    struct device_buffer **buffers = calloc((size_t)r->count, sizeof *buffers);
    if (!buffers)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to run a plan");
    for (int i = 0; i < r->count; i++)
        buffers[i] = r->nodes[i]->buffer;
    replay_evaluates(m, p, r->nodes, r->count, buffers);
    enum machine_status status = plan_run(m, p, buffers, r->nodes, NULL);
    const int *stored = plan_stored(p, &count);
    /* Users first: a node whose inputs are let go may be the last to hold them. */
    for (int i = count - 1; i >= 0 && !status; i--) {
        graph_ref(r->nodes[stored[i]]);
        device_buffer_ref(buffers[stored[i]]);
    }
    for (int i = count - 1; i >= 0 && !status; i--)
        graph_materialised(m, r->nodes[stored[i]], buffers[stored[i]]);
    for (int i = count - 1; i >= 0 && !status; i--)
        graph_unref(m, r->nodes[stored[i]]);
    if (status) {
        replay_failed(m);
    } else {
        m->values->epoch++;
        replay_evaluated(m, buffers, wanted, wanted_count);
    }
    for (int i = count - 1; i >= 0 && !status; i--)
        device_buffer_unref(m, buffers[stored[i]]);
    free(buffers);
    return status;
}

static enum machine_status evaluate(struct machine *m, struct machine_value **wanted, int count,
                                    bool all)
{
    struct targets t = {0};
    struct reach r = {0};
    enum machine_status status = MACHINE_OK;
    double start = watch_clock(m);
    bool partial, good = reshape_roll(m, &partial);
    if (m->watch && m->run->sliced)
        watch_span(m, WATCH_ROLL, start, NULL);
    double from = watch_clock(m);
    for (int i = 0; i < count && good; i++)
        if (wanted[i]->op == NODE_SLICE && !wanted[i]->buffer)
            good = reshape_unpack(m, wanted[i]);
        else if (!node_is_leaf(wanted[i]))
            good = targets_add(&t, wanted[i]);
    all = all || replay_thorough(m);
    replay_resolve(m);
    /* Reading one thing after another is one look: nothing has become older in between. */
    if (all || m->run->stores != m->run->stores_evaluated)
        good = good && targets_collect(m, &t, all);
    m->run->stores_evaluated = m->run->stores;
    m->run->flush_hash = 0; /* who observes says when */
    if (good && t.count == 0) {
        free(t.values);
        return MACHINE_OK;
    }
    if (m->watch)
        watch_span(m, WATCH_TARGETS, from, "\"targets\":%d", t.count);
    from = watch_clock(m);
    m->values->mark++;
    for (int i = 0; i < t.count && good; i++)
        good = reach_from(m, &r, t.values[i]);
    for (int i = 0; i < t.count && good; i++) {
        good = reach_room(&r);
        if (good)
            r.signature[r.length++] = UINT32_C(0x80000000) | t.values[i]->local;
    }
    if (!good)
        status = machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to evaluate");
    if (m->watch) {
        watch_span(m, WATCH_SIGNATURE, from, "\"nodes\":%d", r.count);
        watch_nodes(m, r.nodes, wanted, count);
    }
    from = watch_clock(m);
    uint64_t built = m->plans->built;
    struct plan *p = status ? NULL : plan_get(m, &r, &t);
    if (m->watch)
        watch_span(m, WATCH_LOOKUP, from, "\"found\":%s",
                   m->plans->built == built ? "true" : "false");
    if (m->plans->rehearsing) {
        m->plans->rehearsed = p;
    } else if (p) {
        int stored;
        plan_stored(p, &stored);
        if (m->watch)
            watch_reached(m, r.nodes, r.count, stored);
        status = execute(m, p, &r, wanted, count);
        if (m->watch)
            watch_evaluated(m, start, count > 0, t.count);
        m->run->flushes++;
    } else if (!status) {
        status = m->status;
    }
    if (status)
        m->run->stores_evaluated = m->run->stores - 1; /* not yet */
    free(t.values);
    free(r.nodes);
    free(r.signature);
    return status;
}

static bool is_held(const struct machine *m, const struct machine_value *v)
{
    for (int i = 1; i < m->values->sets_count; i++)
        for (int flag = 0; m->values->sets[i].used && flag < 3; flag++)
            if (m->memory->flags[i].of[flag].value == v)
                return true;
    for (int i = 0; i < m->memory->fields_count; i++)
        for (int k = 0; k < m->memory->fields[i]->slots_count; k++)
            if (m->memory->fields[i]->slots[k].value == v)
                return true;
    return false;
}

enum machine_status run_evaluate(struct machine *m, struct machine_value **wanted, int count,
                                 bool all)
{
    bool held = true;
    for (int i = 0; i < count; i++) {
        graph_borrow(m, wanted[i]); /* what it is a part of may let go of it */
        held = held && (node_is_leaf(wanted[i]) || is_held(m, wanted[i]));
    }
    /* What only the one who looks has, say a count, is evaluated apart: the calls before lead from state to state then,
     * and are foreseen. */
    if (!held && replay_follows(m)) {
        enum machine_status status = evaluate(m, NULL, 0, all);
        if (status)
            return status;
    }
    return evaluate(m, wanted, count, all);
}

enum machine_status machine_settle(struct machine *m, struct machine_value **values, int count)
{
    return run_evaluate(m, values, count, false);
}

/* ---- when ---- */

void run_init(struct machine *m)
{
    m->run->trace_power = 1;
    for (int i = 0; i < TRACE_LENGTH; i++)
        m->run->trace_power *= TRACE_FACTOR;
}

enum machine_status run_after_store(struct machine *m, const struct machine_value *v)
{
    m->run->stores++;
    if (m->run->eager)
        return run_evaluate(m, NULL, 0, true);
    if (m->run->hold_flush && v->height < HEIGHT_MOST)
        return MACHINE_OK;
    if (m->run->flush_status) {
        enum machine_status status = m->run->flush_status;
        m->run->flush_status = MACHINE_OK;
        return status;
    }
    /* The last TRACE_LENGTH stores, as one number: which operations they were, not where they
     * went, nor whether their operands have been computed. A shift of a shift is one shift, of
     * whatever was there first: its operand says nothing. */
    uint64_t what = ((uint64_t)v->origin << 16 | (uint64_t)v->type.width << 8 | v->axis) + 1;
    const struct machine_value *in = v->in[1] ? v->in[1] : v->in[0];
    what = (what * 128 + (in && v->op != NODE_SHIFT ? in->origin : 0)) * 0x9e3779b97f4a7c15u;
    uint64_t *oldest = &m->run->trace[m->run->trace_count++ % TRACE_LENGTH];
    m->run->trace_hash =
        m->run->trace_hash * TRACE_FACTOR + what - *oldest * m->run->trace_power;
    *oldest = what;
    if (replay_in_loop(m) && v->height < HEIGHT_MOST && m->values->pending < PENDING_MOST)
        return MACHINE_OK;
    bool again = m->run->flush_hash && m->run->trace_hash == m->run->flush_hash &&
                 m->values->pending >= m->settings.flush_after / 8;
    bool many = m->values->pending >=
                (m->run->flush_hash ? 5 * m->settings.flush_after : m->settings.flush_after);
    if (!again && !many && v->height < HEIGHT_MOST)
        return MACHINE_OK;
    if (m->run->sliced &&
        v->height < HEIGHT_MOST) { /* loops first, and those under way may end */
        bool partial;
        if (m->values->pending < m->run->roll_after)
            return MACHINE_OK;
        if (!reshape_roll(m, &partial))
            return m->status;
        m->run->roll_after = 0;
        if (partial && m->values->pending < PENDING_LOOP)
            m->run->roll_after = 2 * m->values->pending + PENDING_MANY;
        if (m->run->roll_after || m->values->pending < m->settings.flush_after / 8)
            return MACHINE_OK;
    }
    m->run->flush_place = m->run->trace_hash;
    m->run->flush_due = true;
    if (m->run->sliced || v->height >= HEIGHT_MOST || m->values->pending >= PENDING_MOST)
        run_flush_due(m);
    enum machine_status status = m->run->flush_status;
    m->run->flush_status = MACHINE_OK;
    return status;
}

void run_flush_due(struct machine *m)
{
    if (!m->run->flush_due)
        return;
    m->run->flush_due = false;
    m->run->flushing = true;
    m->run->flush_status = run_evaluate(m, NULL, 0, false);
    m->run->flushing = false;
    m->run->flush_hash = m->run->flush_place;
}

enum machine_status machine_flush(struct machine *m)
{
    replay_settle(m);
    run_flush_due(m);
    replay_looked(m);
    return run_evaluate(m, NULL, 0, false);
}

enum machine_status machine_finish(struct machine *m)
{
    enum machine_status status = machine_flush(m);
    double start = device_wait_begin(m);
    cl_int error = clFinish(m->device->queue);
    enum machine_status waited = device_wait_end(m, error, start, "waiting for the device");
    return status ? status : waited;
}
