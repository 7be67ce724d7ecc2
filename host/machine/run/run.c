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

#include "memory/memory.h"
#include "run/replay.h"
#include "run/slices.h"
#include "values/graph.h"

#define TRACE_FACTOR                                                                           \
    0x9e3779b97f4a7c15u /* its TRACE_LENGTH-th power is machine.trace_power   \
                                          */

/* ---- evaluation ---- */

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
    if (!held && record_follows(m)) {
        enum machine_status status = evaluate(m, NULL, 0, all);
        if (status)
            return status;
    }
    return evaluate(m, wanted, count, all);
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
    if (history_in_loop(m) && v->height < HEIGHT_MOST && m->values->pending < PENDING_MOST)
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
        if (!roll_waiting(m, &partial))
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

bool run_in_call(const struct machine *m)
{
    return m->run->replay && m->run->replay->depth;
}

bool run_thorough(const struct machine *m)
{
    return m->run->replay && m->run->replay->thorough;
}

void run_resolve(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (!run_thorough(m))
        return;
    p->depth++; /* it belongs to the calls before */
    for (int i = 1; i < m->values->sets_count; i++)
        if (m->values->sets[i].used)
            flag_resolved(m, &m->values->sets[i], MACHINE_OVERFLOW);
    p->depth--;
}
