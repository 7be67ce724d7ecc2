/* evaluate.c - decides when values are evaluated.
 *
 * While nothing is observed the graph grows. Past PENDING_MANY values it is evaluated, and
 * from then on whenever the trace of stores matches that of the first time: once in each
 * turn of a loop, always at the same point.
 */
#include "run/evaluate.h"

#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "interpret/at_once.h"
#include "memory/memory.h"
#include "run/pending.h"
#include "run/replay.h"
#include "run/roll.h"
#include "run/room.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"
#include "watch/watch.h"

#define TRACE_FACTOR                                                                           \
    0x9e3779b97f4a7c15u /* its TRACE_LENGTH-th power is run.trace_power   \
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

/* Evaluates after rolling up loops over slices. */
static enum machine_status evaluate_rolled(struct machine *m, const struct wish *wish,
                                           enum run_why why)
{
    bool partial;
    double start = watch_clock(m);
    if (!roll_waiting(m, why, &partial))
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to evaluate");
    if (m->watch && m->run->sliced)
        watch_span(m, WATCH_ROLL, start, NULL);
    return evaluation_run(m, wish, why);
}

static enum machine_status evaluate_now(struct machine *m, struct machine_value **wanted,
                                        int count, bool all, enum run_why why)
{
    enum wish_what what = all ? WISH_ALL : WISH_LIVE;
    bool held = true;
    for (int i = 0; i < count; i++) {
        graph_borrow(m, wanted[i]); /* a value that contains it may release it */
        held = held && (node_is_leaf(wanted[i]) || is_held(m, wanted[i]));
    }
    /* while there is room for some arrays: what is computed only later holds others */
    if (!m->settings.eager && room_is_short(m))
        room_make(m);
    /* Values that only the observer holds, such as a count, are evaluated apart. Then the
     * calls before lead from state to state, and are foreseen. */
    if (!held && record_follows(m)) {
        const struct wish others = {.what = what};
        enum machine_status status = evaluate_rolled(m, &others, why);
        if (status)
            return status;
    }
    const struct wish wish = {wanted, count, what};
    return evaluate_rolled(m, &wish, why);
}

/* Where operations are computed at once, so is what stayed a node when somebody looks at it.
 * What else waits need not be evaluated with it. */
static bool are_computed(struct machine *m, struct machine_value **wanted, int count)
{
    bool all = true;
    for (int i = 0; i < count && all; i++)
        all = node_is_leaf(wanted[i]) || at_once_looked(m, wanted[i]);
    return all;
}

enum machine_status evaluate_in_blocks(struct machine *m, struct machine_value **wanted,
                                       int count, bool all)
{
    if (m->values->at_once && count && are_computed(m, wanted, count))
        return MACHINE_OK;
    return evaluate_now(m, wanted, count, all, RUN_LOOKED);
}

enum machine_status evaluate_values(struct machine *m, struct machine_value **wanted, int count,
                                    bool all)
{
    enum machine_status status = evaluate_in_blocks(m, wanted, count, all);
    for (int i = 0; m->sequencers && i < count && !status; i++)
        status = sequencers_whole(m, wanted[i]->buffer);
    return status;
}

/* ---- when ---- */

void evaluate_init(struct machine *m)
{
    if (m->settings.flush_after == SETTING_FREE)
        m->settings.flush_after = PENDING_MANY;
    room_init(m);
    m->run->trace_power = 1;
    for (int i = 0; i < TRACE_LENGTH; i++)
        m->run->trace_power *= TRACE_FACTOR;
}

enum machine_status evaluate_after_store(struct machine *m, struct machine_value *v)
{
    m->run->stores++;
    if (m->values->at_once && !m->run->flush_status && at_once_stored(m, v))
        return MACHINE_OK; /* nothing waits because of it */
    if (m->settings.eager)
        return evaluate_values(m, NULL, 0, true);
    if (run_mode_holds(m->run->mode) && v->height < HEIGHT_MOST)
        return MACHINE_OK;
    if (m->run->flush_status) {
        enum machine_status status = m->run->flush_status;
        m->run->flush_status = MACHINE_OK;
        return status;
    }
    /* A hash of the last TRACE_LENGTH stores. It includes the operations, but not the
     * destinations, nor whether operands have been computed. The operand of a shift is left
     * out, because a shift of a shift is simplified to one shift. */
    uint64_t what = ((uint64_t)v->origin << 16 | (uint64_t)v->type.width << 8 | v->axis) + 1;
    const struct machine_value *in = v->in[1] ? v->in[1] : v->in[0];
    what = (what * 128 + (in && v->op != NODE_SHIFT ? in->origin : 0)) * 0x9e3779b97f4a7c15u;
    uint64_t *oldest = &m->run->trace[m->run->trace_count++ % TRACE_LENGTH];
    m->run->trace_hash =
        m->run->trace_hash * TRACE_FACTOR + what - *oldest * m->run->trace_power;
    *oldest = what;
    if (room_is_short(m) && room_make(m))
        return MACHINE_OK;
    const bool exceeded = room_is_exceeded(m);
    if (history_in_loop(m) && v->height < HEIGHT_MOST && m->values->pending < PENDING_MOST &&
        !exceeded)
        return MACHINE_OK;
    bool again = m->run->flush_hash && m->run->trace_hash == m->run->flush_hash &&
                 m->values->pending >= pending_least(m);
    bool many = m->values->pending >= (m->run->flush_hash ? 5 * m->settings.flush_after
                                                          : m->settings.flush_after) ||
                exceeded || room_is_wanted(m);
    if (!again && !many && v->height < HEIGHT_MOST)
        return MACHINE_OK;
    if (m->run->sliced &&
        v->height < HEIGHT_MOST) { /* loops over slices first; those under way may be about
                                    * to end */
        bool partial;
        if (m->values->pending < m->run->roll_after)
            return MACHINE_OK;
        if (!roll_waiting(m, RUN_LOOKED, &partial))
            return m->status;
        m->run->roll_after = 0;
        if (partial && m->values->pending < PENDING_LOOP)
            m->run->roll_after = 2 * m->values->pending + PENDING_MANY;
        if (m->run->roll_after || m->values->pending < pending_least(m))
            return MACHINE_OK;
    }
    m->run->flush_place = m->run->trace_hash;
    m->run->flush_due = true;
    if (m->run->sliced || v->height >= HEIGHT_MOST || m->values->pending >= PENDING_MOST)
        evaluate_due(m);
    enum machine_status status = m->run->flush_status;
    m->run->flush_status = MACHINE_OK;
    return status;
}

void evaluate_due(struct machine *m)
{
    if (!m->run->flush_due)
        return;
    m->run->flush_due = false;
    m->run->flush_status = evaluate_now(m, NULL, 0, false, RUN_DUE);
    m->run->flush_hash = m->run->flush_place;
}
