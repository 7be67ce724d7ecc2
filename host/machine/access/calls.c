/* calls.c - calls: foreseen, or recorded. */
#include "access/settle.h"
#include "base/arrays.h"
#include "memory/memory.h"
#include "run/at_once_when.h"
#include "run/evaluate.h"
#include "run/notes.h"
#include "run/replay.h"
#include "watch/watch.h"

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
    if (notes_take(m, call) || notes_take_elsewhere(m, call))
        return true;
    settle(m);
    if (m->run->flush_due)
        evaluate_due(m);
    if (!run_mode_catches_up(m->run->mode) && notes_take(m, call))
        return true;
    history_call(m, call);
    p->since++;
    if (p->active >= 0 || p->from >= 0) {
        if (p->log_count == CALLS_MOST)
            states_from_forget(m);
        else if (p->log_count == p->log_capacity)
            p->log = array_grown(p->log, &p->log_capacity, sizeof *p->log);
        if (p->log_count < CALLS_MOST)
            p->log[p->log_count++] = *call;
    }
    at_once_decide(m);
    p->depth = 1;
    return false;
}

bool machine_call_foreseen(struct machine *m, struct machine_call *call)
{
    bool known = foreseen(m, call);
    if (m->watch && known)
        watch_noted(m, m->run->calls_noted == 1);
    else if (m->watch)
        watch_call(m, call->name);
    return known;
}

void machine_call_performed(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (m->watch)
        watch_performed(m);
    if (p && p->depth && --p->depth == 0 && !run_mode_holds(m->run->mode) &&
        history_turn_ends(m))
        m->run->flush_due = true;
}

void machine_call_failed(struct machine *m)
{
    if (m->watch)
        watch_call_failed(m);
    if (!m->run->replay)
        return;
    m->run->replay->depth = 0;
    states_from_forget(m);
    m->run->replay->log_count = 0;
}

void machine_calls_forget(struct machine *m)
{
    notes_forget(m);
}
