/* turns.c - many turns of a loop at once.
 *
 * If a loop has turned often, and its plan is cheaper with many turns at a time, that many
 * turns are noted and evaluated together. For this all turns must begin alike, so
 * evaluations are thorough (they leave nothing to compute) while such loops run.
 */
#include "plans/background.h"
#include "run/evaluate.h"
#include "run/replay.h"
#include "values/graph.h"

/* TURNS_SEEN: after so many turns a loop is tried with many turns at once. TRY_AGAIN: after
 * a failed trial, evaluations until the next. LOOKS_SURE: a program that has looked so
 * often, always after the same number of turns, is expected to do so again. */
enum { TURNS_SEEN = 6, TRY_AGAIN = 8192, LOOKS_SURE = 8 };

static bool loop_is(const struct machine *m, const struct edge *e)
{
    return e->alone && e->to == m->run->replay->active;
}

/* The number of evaluations for that many turns; remaining turns are evaluated one by one. */
static int evaluations(int turns, int at_once)
{
    return turns / at_once + turns % at_once;
}

/* How many turns of such a plan are evaluated at once. Unless the number is forced, it is up to
 * a quarter more or fewer than usual, if that takes fewer evaluations for a program that always
 * looks after the same number of turns; up to a half where the usual number fits between two
 * looks only once. */
static int turns_at_once(const struct machine *m, const struct edge *e)
{
    int most = plan_turns(m, e->deed.plan), usual = m->device->shape.turns,
        looks = m->run->turns_between_looks;
    most = e->turns_most && e->turns_most < most ? e->turns_most : most;
    int turns = most < usual ? most : usual;
    if (m->settings.knob[MACHINE_TURNS] != SETTING_FREE || m->run->looks_alike < LOOKS_SURE ||
        looks <= usual || turns < usual)
        return turns;
    const int furthest = looks < 2 * usual ? usual / 2 : usual / 4;
    for (int away = 1; away <= furthest; away++)
        for (int side = 1; side >= -1; side -= 2) {
            int other = usual + side * away;
            if (other <= most && evaluations(looks, other) < evaluations(looks, turns))
                turns = other;
        }
    return turns;
}

/* If the best number changes, the old number and its kernel are given up between turns. */
int turns_noted(struct machine *m, struct edge *e)
{
    const struct replay *p = m->run->replay;
    if (!loop_is(m, e) || !p->thorough || e->runs < TURNS_SEEN)
        return 1;
    if (m->run->calls_noted <= e->calls_count || !e->turns_count) {
        int turns = turns_at_once(m, e);
        if (turns != e->turns_count && (m->run->looks_alike >= LOOKS_SURE || !e->turns.plan)) {
            deed_finish(m, &e->turns);
            e->turns_count = turns;
            e->rehearsed = NULL;
        }
    }
    return e->turns_count * e->calls_count <= CALLS_MOST ? e->turns_count : 1;
}

/* Makes evaluations thorough, for a loop that pays with many turns at once. All turns must
 * then begin alike; the edges known so far do not. */
static bool become_thorough(struct machine *m, struct edge *e)
{
    struct replay *p = m->run->replay;
    if (p->thorough || m->device->shape.turns < 2 || m->run->flushes < p->not_before ||
        e->runs < TURNS_SEEN || !e->alone)
        return false;
    int turns = turns_at_once(m, e);
    if (turns < 2 || m->run->turns_in_row < 2 * turns) /* the program looks too often for it
                                                        * to pay */
        return false;
    const struct plan *thorough = e->rehearsed_thorough;
    if (thorough ? plan_wants_rehearsal(m, thorough) : background_on(m)) {
        e->wants_thorough = true;
        return false;
    }
    if (thorough && plan_waits(m, thorough))
        return false;
    p->thorough = true;
    p->built_at = m->run->flushes;
    states_forget(m);
    return true;
}

/* If many turns have not run for long, temporaries are left as expressions again. */
static void stay_thorough(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (background_busy(m)) /* better kernels will be there soon */
        p->built_at = m->run->flushes;
    if (!p->thorough || m->run->flushes - p->built_at <= 64)
        return;
    p->thorough = false;
    states_forget(m);
}

void turns_turned(struct machine *m, struct edge *e, bool many)
{
    if (many)
        m->run->replay->built_at = m->run->flushes;
    else if (!become_thorough(m, e))
        stay_thorough(m);
}

static void turns_in_vain(struct machine *m)
{
    struct replay *p = m->run->replay;
    p->thorough = false;
    p->not_before = m->run->flushes + TRY_AGAIN;
    states_forget(m);
}

/* Performs everything noted, and evaluates it without running the plan; then enters the
 * state again, as if nothing had happened. False: the state cannot be entered; everything
 * was performed. */
static bool rehearse(struct machine *m, enum run_mode what)
{
    struct replay *p = m->run->replay;
    int active = p->active, edge = (int)(p->edge - p->states[active].edges);
    int noted = m->run->calls_noted, at = p->at;
    uint64_t stores = m->run->stores, flush_hash = m->run->flush_hash,
             flushes = m->run->flushes;
    struct vanished vanished = m->values->vanished;
    if (m->watch)
        watch_silent(m, true);
    perform_calls(m, RUN_REHEARSING_CALLS);
    bool back = p->from == active && m->run->flushes == flushes;
    if (back) {
        m->run->mode = what;
        m->run->rehearsed = NULL;
        evaluate_values(m, NULL, 0, false);
        m->run->mode = RUN_FREE;
        machine_error_clear(m); /* the error is reported when it matters */
        graph_give_back(m);
        state_activate(m, active, p->from_buffers);
        states_from_forget(m);
        m->run->stores = m->run->stores_evaluated = stores;
        m->run->flush_hash = flush_hash;
        m->values->vanished = vanished;
        p->log_count = 0;
        p->since = 0;
        p->edge = &p->states[active].edges[edge];
        p->at = at;
        m->run->calls_noted = noted;
    }
    if (m->watch)
        watch_silent(m, false);
    return back;
}

/* False: everything was performed, and is in memory. *plan: the plan whose kernels are being
 * prepared; NULL: nothing to compute. */
static bool rehearse_or_perform(struct machine *m, enum run_mode what, struct plan **plan)
{
    bool back = rehearse(m, what);
    if (back) {
        *plan = m->run->rehearsed;
    } else {
        m->run->flush_due = true;
        evaluate_due(m);
        turns_in_vain(m);
    }
    return back;
}

bool turns_thorough_see_to(struct machine *m)
{
    struct replay *p = m->run->replay;
    struct edge *e = p->edge;
    if (!e->wants_thorough || m->run->calls_noted != e->calls_count || p->thorough ||
        background_busy(m))
        return true;
    e->wants_thorough = false;
    p->thorough = true;
    bool back = rehearse_or_perform(m, RUN_REHEARSING, &e->rehearsed_thorough);
    p->thorough = false;
    if (back && !e->rehearsed_thorough)
        p->not_before = m->run->flushes + TRY_AGAIN;
    return back;
}

enum loop_turns turns_see_to(struct machine *m)
{
    struct replay *p = m->run->replay;
    struct edge *e = p->edge;
    if ((!e->rehearsed || plan_wants_rehearsal(m, e->rehearsed)) && !background_busy(m)) {
        if (!rehearse_or_perform(m, RUN_REHEARSING_TURNS, &e->rehearsed))
            return TURNS_PERFORMED;
        if (!e->rehearsed)
            return TURNS_AT_HAND;
    }
    if (e->rehearsed && plan_is_hopeless(e->rehearsed)) { /* but fewer turns may fit one
                                                           * kernel */
        e->turns_most = e->turns_count / 2;
        e->turns_count = e->turns_most > 1 ? 0 : 1;
        e->rehearsed = NULL;
        if (e->turns_count)
            p->not_before = m->run->flushes + TRY_AGAIN;
        return TURNS_WAIT;
    }
    if (e->rehearsed && !plan_waits(m, e->rehearsed))
        return TURNS_AT_HAND;
    p->built_at = m->run->flushes; /* not a failed trial yet */
    return TURNS_WAIT;
}

void turns_build(struct machine *m)
{
    struct replay *p = m->run->replay;
    int active = p->active, at = (int)(p->edge - p->states[active].edges);
    p->building_calls = m->run->calls_noted;
    perform_calls(m, RUN_BUILDING_CALLS);
    m->run->mode = RUN_BUILDING;
    m->run->flush_due = true;
    evaluate_due(m);
    m->run->mode = RUN_FREE;
    bool back = p->active == active && p->states[active].edges_count > at;
    if (back && p->states[active].edges[at].turns.plan)
        return;
    turns_in_vain(m);
}

bool turns_do(struct machine *m)
{
    struct replay *p = m->run->replay;
    struct edge *e = p->edge;
    int turns = turns_noted(m, e), whole = m->run->calls_noted / e->calls_count;
    double start = watch_clock(m);
    if (turns > 1 && whole >= turns && !e->turns.plan) {
        enum loop_turns kernels = turns_see_to(m);
        if (kernels == TURNS_AT_HAND)
            turns_build(m);
        if (kernels != TURNS_WAIT)
            return true;
    } else if (turns > 1 && whole >= turns) {
        if (!perform_deed(m, &e->turns, e->to))
            return false;
        m->run->calls_noted -= turns * e->calls_count;
        m->run->turns_in_row += turns;
        m->run->calls_foreseen += (uint64_t)turns * (uint64_t)e->calls_count;
        if (m->watch)
            watch_replayed(m, start, e->calls, e->calls_count, turns, e->alone,
                           m->run->calls_noted > 0);
        whole -= turns;
        turns_turned(m, e, true);
    }
    if (whole > 0 && !turns_thorough_see_to(m))
        return true;
    for (; whole > 0; whole--) {
        int left = m->run->calls_noted - e->calls_count;
        struct state *s = &p->states[p->active];
        start = watch_clock(m);
        if (!perform_deed(m, &e->deed, e->to))
            return false;
        m->run->calls_foreseen += (uint64_t)e->calls_count;
        m->run->calls_noted = left;
        m->run->turns_in_row++;
        if (m->watch)
            watch_replayed(m, start, e->calls, e->calls_count, 1, e->alone,
                           m->run->calls_noted > 0);
        s->edge_last = (int)(e - s->edges);
        e->runs++;
    }
    if (m->run->calls_noted == 0) {
        p->at = 0;
        turns_turned(m, e, false);
    }
    return true;
}
