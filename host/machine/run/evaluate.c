/* evaluate.c - an evaluation: targets, the nodes that are reached, a plan, its kernels. */
#include <stdlib.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "build/describe.h"
#include "memory/memory.h"
#include "run/replay.h"
#include "run/slices.h"
#include "values/graph.h"

static bool reach_room(struct reach *r)
{
    bool failed = false;
    if (r->count == r->capacity)
        r->nodes = array_more(r->nodes, &r->capacity, sizeof *r->nodes, &failed);
    if (!failed && r->length + 9 > (uint32_t)r->signature_capacity)
        r->signature =
            array_more(r->signature, &r->signature_capacity, sizeof *r->signature, &failed);
    return !failed;
}

/* Depth first; HEIGHT_MOST bounds the recursion. */
static bool reach_from(struct machine *m, struct reach *r, struct machine_value *v)
{
    if (v->mark == m->values->mark)
        return true;
    v->mark = m->values->mark;
    if (v->op == NODE_SLICE && !v->buffer && !slice_unpack(m, v))
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

static bool targets_add(struct targets *t, struct machine_value *v)
{
    bool failed = false;
    if (t->count == t->capacity)
        t->values = array_more(t->values, &t->capacity, sizeof *t->values, &failed);
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

static enum machine_status execute(struct machine *m, struct plan *p, const struct reach *r,
                                   struct machine_value *const *wanted, int wanted_count)
{
    int count;
    struct device_buffer **buffers = calloc((size_t)r->count, sizeof *buffers);
    if (!buffers)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to run a plan");
    for (int i = 0; i < r->count; i++)
        buffers[i] = r->nodes[i]->buffer;
    record_evaluates(m, p, r->nodes, r->count, buffers);
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
        record_failed(m);
    } else {
        m->values->epoch++;
        record_evaluated(m, buffers, wanted, wanted_count);
    }
    for (int i = count - 1; i >= 0 && !status; i--)
        device_buffer_unref(m, buffers[stored[i]]);
    free(buffers);
    return status;
}

enum machine_status evaluate(struct machine *m, struct machine_value **wanted, int count,
                             bool all)
{
    struct targets t = {0};
    struct reach r = {0};
    enum machine_status status = MACHINE_OK;
    double start = watch_clock(m);
    bool partial, good = roll_waiting(m, &partial);
    if (m->watch && m->run->sliced)
        watch_span(m, WATCH_ROLL, start, NULL);
    double from = watch_clock(m);
    for (int i = 0; i < count && good; i++)
        if (wanted[i]->op == NODE_SLICE && !wanted[i]->buffer)
            good = slice_unpack(m, wanted[i]);
        else if (!node_is_leaf(wanted[i]))
            good = targets_add(&t, wanted[i]);
    all = all || run_thorough(m);
    run_resolve(m);
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
        describe_nodes(m, r.nodes, wanted, count);
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
