/* notes.c - notes foreseen calls, and performs them before anything is observed. */
#include "run/notes.h"

#include "run/replay.h"

/* Finds another edge with the calls noted so far, and this one next (NULL: the noted calls
 * only, because something is about to be observed). */
static struct edge *other_edge(struct machine *m, const struct machine_call *call)
{
    struct replay *p = m->run->replay;
    struct state *s = &p->states[p->active];
    for (int i = 0; i < s->edges_count; i++) {
        struct edge *e = &s->edges[i];
        if (e != p->edge && record_begins_alike(e, p->edge, m->run->calls_noted) &&
            (call ? e->calls_count > m->run->calls_noted &&
                        record_same_call(&e->calls[m->run->calls_noted], call)
                  : e->calls_count == m->run->calls_noted && !e->alone))
            return e;
    }
    return NULL;
}

void notes_perform(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (m->run->calls_noted > p->edge->calls_count && !turns_do(m)) {
        perform_calls(m, RUN_CATCHING_UP);
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
    perform_calls(m, RUN_CATCHING_UP);
}

bool notes_take(struct machine *m, const struct machine_call *call)
{
    struct replay *p = m->run->replay;
    struct edge *e = p->edge;
    if (!e || p->at >= e->calls_count || !record_same_call(call, &e->calls[p->at]))
        return false;
    m->run->calls_noted++;
    if (++p->at == e->calls_count && e->alone) {
        p->at = 0;
        if (m->run->calls_noted >= turns_noted(m, e) * e->calls_count && !turns_do(m))
            perform_calls(m, RUN_CATCHING_UP);
    }
    return true;
}

/* A program that looked after each turn of a loop, and has not for so many, is expected to look
 * no more. */
enum { TURNS_UNSEEN = 8 };

static bool looks_no_more(const struct machine *m, const struct machine_call *call)
{
    const struct replay *p = m->run->replay;
    const struct edge *e = p->edge;
    return e && !e->alone && e->to == p->active && m->run->calls_noted == e->calls_count &&
           m->run->turns_in_row >= TURNS_UNSEEN && record_same_call(&e->calls[0], call);
}

bool notes_take_elsewhere(struct machine *m, const struct machine_call *call)
{
    struct replay *p = m->run->replay;
    if (p->edge && m->run->calls_noted > p->edge->calls_count && !turns_do(m))
        return false;
    struct edge *other = p->edge ? other_edge(m, call) : NULL;
    if (!other && looks_no_more(m, call)) /* turns will end by themselves, several at once */
        notes_forget(m);
    if (!other)
        return false;
    p->edge = other;
    p->at = m->run->calls_noted;
    return notes_take(m, call);
}

void notes_forget(struct machine *m)
{
    if (!m->run->replay || !m->run->replay->states_count)
        return;
    if (m->run->calls_noted)
        notes_perform(m);
    states_forget(m);
}
