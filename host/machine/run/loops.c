/* loops.c - calls that repeat, and many turns of them at once.
 *
 * Until the calls of a loop are known as an edge they are performed one by one. Where the last few were met
 * before, by hash, tells a period; a whole period more tells that it is one. From then on evaluations come
 * after whole turns, always at the same call, so that they lead from a state to itself. Where a turn begins
 * is told by whoever looks. If nobody does, it is where least has to be kept: in the program's own order, as
 * a rule, for there its temporaries are overwritten before they are read.
 *
 * Short turns are evaluated several at a time, unless that has been seen to take no fewer kernels.
 *
 * A loop that has turned often, and that its plan says is cheaper many turns at a time, is noted for so many
 * turns and evaluated once for all of them. For that all turns must begin alike: evaluations are thorough
 * (they leave nothing to compute) while such loops run. */
#include "build/background.h"
#include "run/replay.h"

/* A loop that has turned so often is tried with many turns at once; after one that was not worth it, so many
 * evaluations later again. Who has looked so often after as many turns as before is expected to do so again. */
enum { TURNS_SEEN = 6, TRY_AGAIN = 8192, LOOKS_SURE = 8 };

/* ---- found by the calls made ---- */

/* A window's hash is a polynomial in it; what leaves the window has been multiplied WINDOW times. */
#define WINDOW_FACTOR UINT64_C(0x9e3779b97f4a7c15)
#define SQUARE(x) ((x) * (x))
#define WINDOW_LEAVES SQUARE(SQUARE(SQUARE(WINDOW_FACTOR)))
_Static_assert(WINDOW == 8, "WINDOW_LEAVES is the factor to that power");

static void loop_forget(struct history *h)
{
    h->period = h->match = h->turn_at = h->looked_at = 0;
    h->one_by_one = h->one_by_one_known = false;
}

void loops_call(struct machine *m, const struct machine_call *call)
{
    struct history *h = &m->run->replay->history;
    uint64_t hash = (uint64_t)(uintptr_t)call->again ^ (uint64_t)call->vpset << 48;
    for (uint32_t i = 0; i < call->words_count; i++)
        hash = (hash ^ hash >> 29 ^ call->words[i]) * 0xbf58476d1ce4e5b9u;
    hash ^= hash >> 32;
    uint32_t at = h->count++;
    if (h->period && h->hashes[(at - h->period) % HISTORY] == hash)
        h->match++;
    else
        loop_forget(h);
    h->dead[h->count % HISTORY] = 0;
    uint64_t old = at >= WINDOW ? h->hashes[(at - WINDOW) % HISTORY] : 0;
    h->window = h->window * WINDOW_FACTOR + hash - old * WINDOW_LEAVES;
    h->hashes[at % HISTORY] = hash;
    uint32_t slot = (uint32_t)(h->window >> 40) % WINDOWS;
    if (!h->period && h->met[slot].window == h->window &&
        at - h->met[slot].at < HISTORY - WINDOW)
        h->period = at - h->met[slot].at;
    h->met[slot].window = h->window;
    h->met[slot].at = at;
}

bool replay_in_loop(const struct machine *m)
{
    const struct history *h = m->run->replay ? &m->run->replay->history : NULL;
    return h && h->period && h->match >= (h->period < LOOP_SURE ? h->period : LOOP_SURE);
}

void loops_slot_accessed(struct machine *m, struct slot *slot, bool overwrites)
{
    struct history *h = m->run->replay ? &m->run->replay->history : NULL;
    if (!h)
        return;
    if (overwrites && slot->call_accessed && h->count - slot->call_accessed < HISTORY) {
        int32_t bytes = (int32_t)(slot->bits + 7) / 8;
        h->dead[slot->call_accessed % HISTORY] += bytes;
        h->dead[h->count % HISTORY] -= bytes;
    }
    slot->call_accessed = h->count;
}

/* Of the turn before the last one, for what is going to be overwritten is known there: after which call most is dead;
 * where it makes no difference, where whole turns have gone since the last evaluation. */
static uint32_t turn_at(const struct history *h, uint32_t since)
{
    uint32_t from = h->count - 2 * h->period + 1, usual = h->count - since % h->period,
             best = usual;
    int64_t dead = 0, most = INT64_MIN, here = 0;
    for (uint32_t at = from; at != from + h->period; at++) {
        dead += h->dead[at % HISTORY];
        if ((usual - at) % h->period == 0)
            here = dead;
        if (dead > most) {
            most = dead;
            best = at;
        }
    }
    return here == most ? usual : best;
}

/* Turns end after calls that are whole turns away from there. Whoever has looked once in the loop is expected to do so
 * again, after the same call. */
static uint32_t turns_end(struct replay *p)
{
    struct history *h = &p->history;
    uint32_t in_loop = h->period + h->match;
    if (p->since <= in_loop && p->looked)
        return h->count - p->since;
    if (h->looked_at && h->count - h->looked_at <= in_loop)
        return h->looked_at;
    if (h->match < h->period || 2 * h->period > HISTORY) /* what is kept where is not known */
        return h->count - p->since;
    if (!h->turn_at)
        h->turn_at = turn_at(h, p->since);
    return h->turn_at;
}

/* The same wherever a turn begins. */
static uint64_t loop_sum(const struct history *h)
{
    uint64_t sum = h->period;
    for (uint32_t i = 1; i <= h->period; i++)
        sum += h->hashes[(h->count - i) % HISTORY];
    return sum;
}

static bool is_one_by_one(struct history *h)
{
    if (h->one_by_one_known || !h->sums_count)
        return h->one_by_one;
    uint64_t sum = loop_sum(h);
    for (uint32_t i = 0; i < h->sums_count && i < LOOPS_ONE_BY_ONE; i++)
        h->one_by_one = h->one_by_one || h->sums[i] == sum;
    h->one_by_one_known = true;
    return h->one_by_one;
}

bool loop_turn_ends(const struct machine *m)
{
    if (!replay_in_loop(m) || !m->values->pending)
        return false;
    struct history *h = &m->run->replay->history;
    if (m->values->pending < m->settings.flush_after / 8 && !is_one_by_one(h))
        return false;
    return (h->count - turns_end(m->run->replay)) % h->period == 0;
}

bool loops_evaluate(struct machine *m, const struct plan *plan)
{
    struct history *h = &m->run->replay->history;
    if (!m->run->flushing || m->run->building || !replay_in_loop(m) || h->one_by_one)
        return false;
    uint32_t turns = m->run->replay->since / h->period;
    h->one_by_one = turns > 1 && plan_saves_nothing(plan, (int)turns);
    if (h->one_by_one)
        h->sums[h->sums_count++ % LOOPS_ONE_BY_ONE] = loop_sum(h);
    return h->one_by_one;
}

/* ---- many turns at once ---- */

static bool loop_is(const struct machine *m, const struct edge *e)
{
    return e->alone && e->to == m->run->replay->active;
}

/* Evaluations for so many turns: those that are left over are evaluated one by one. */
static int evaluations(int turns, int at_once)
{
    return turns / at_once + turns % at_once;
}

/* How many turns of such a plan are evaluated at once: where nobody has said how many, up to a quarter more or fewer than
 * usual if that makes fewer evaluations for one who always looks after as many turns. */
static int turns_at_once(const struct machine *m, const struct edge *e)
{
    int most = plan_turns(e->deed.plan), usual = m->device->shape.turns,
        looks = m->run->turns_between_looks;
    most = e->turns_most && e->turns_most < most ? e->turns_most : most;
    int turns = most < usual ? most : usual;
    if (m->settings.knob[MACHINE_TURNS] != SETTING_FREE || m->run->looks_alike < LOOKS_SURE ||
        looks < 2 * usual || turns < usual)
        return turns;
    for (int away = 1; away <= usual / 4; away++)
        for (int side = 1; side >= -1; side -= 2) {
            int other = usual + side * away;
            if (other <= most && evaluations(looks, other) < evaluations(looks, turns))
                turns = other;
        }
    return turns;
}

/* A number that is not the best any more is given up between turns, and the kernel for it with it. */
int loop_turns_noted(struct machine *m, struct edge *e)
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

/* Loops that are worth it are to be evaluated many turns at a time. For that all turns must begin alike, and those
 * that are known do not. */
static bool become_thorough(struct machine *m, struct edge *e)
{
    struct replay *p = m->run->replay;
    if (p->thorough || m->device->shape.turns < 2 || m->run->flushes < p->not_before ||
        e->runs < TURNS_SEEN || !e->alone)
        return false;
    int turns = turns_at_once(m, e);
    if (turns < 2 || m->run->turns_in_row < 2 * turns) /* who looks more often gains nothing */
        return false;
    if (!e->rehearsed_thorough && background_on(m)) {
        e->wants_thorough = true;
        return false;
    }
    if (e->rehearsed_thorough && plan_waits(m, e->rehearsed_thorough))
        return false;
    p->thorough = true;
    p->built_at = m->run->flushes;
    states_forget(m);
    return true;
}

/* Where many turns have not run for long, temporaries are left alone again. */
static void stay_thorough(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (background_busy(m)) /* there will be better kernels soon */
        p->built_at = m->run->flushes;
    if (!p->thorough || m->run->flushes - p->built_at <= 64)
        return;
    p->thorough = false;
    states_forget(m);
}

void loops_turned(struct machine *m, struct edge *e, bool many)
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

/* All that is noted is performed, and evaluated but for running the plan; then the state is entered again, and it is as if
 * nothing had been. False: it cannot be entered, and all has been performed. */
static bool rehearse(struct machine *m, enum rehearsal what)
{
    struct replay *p = m->run->replay;
    int active = p->active, edge = (int)(p->edge - p->states[active].edges);
    int noted = m->run->calls_noted, at = p->at;
    uint64_t stores = m->run->stores, flush_hash = m->run->flush_hash,
             flushes = m->run->flushes;
    struct vanished vanished = m->values->vanished;
    m->plans->silent = m->run->hold_flush = true;
    replay_catch_up(m);
    m->run->hold_flush = false;
    bool back = p->from == active && m->run->flushes == flushes;
    if (back) {
        m->plans->rehearsing = what;
        m->plans->rehearsed = NULL;
        run_evaluate(m, NULL, 0, false);
        m->plans->rehearsing = REHEARSING_NOTHING;
        machine_error_clear(m); /* it will be said when it matters */
        graph_give_back(m);
        state_activate(m, active, p->from_buffers);
        replay_from_forget(m);
        m->run->stores = m->run->stores_evaluated = stores;
        m->run->flush_hash = flush_hash;
        m->values->vanished = vanished;
        p->log_count = 0;
        p->since = 0;
        p->edge = &p->states[active].edges[edge];
        p->at = at;
        m->run->calls_noted = noted;
    }
    m->plans->silent = false;
    return back;
}

/* False: all has been performed, and is in memory. *plan: whose kernels are seen to; NULL: there is nothing to compute. */
static bool rehearse_or_perform(struct machine *m, enum rehearsal what, struct plan **plan)
{
    bool back = rehearse(m, what);
    if (back) {
        *plan = m->plans->rehearsed;
    } else {
        m->run->flush_due = true;
        run_flush_due(m);
        turns_in_vain(m);
    }
    return back;
}

bool loop_thorough_see_to(struct machine *m)
{
    struct replay *p = m->run->replay;
    struct edge *e = p->edge;
    if (!e->wants_thorough || m->run->calls_noted != e->calls_count || p->thorough ||
        background_busy(m))
        return true;
    e->wants_thorough = false;
    p->thorough = true;
    bool back = rehearse_or_perform(m, REHEARSING_ONE, &e->rehearsed_thorough);
    p->thorough = false;
    if (back && !e->rehearsed_thorough)
        p->not_before = m->run->flushes + TRY_AGAIN;
    return back;
}

enum loop_turns loop_turns_see_to(struct machine *m)
{
    struct replay *p = m->run->replay;
    struct edge *e = p->edge;
    if (!e->rehearsed && !background_busy(m)) {
        if (!rehearse_or_perform(m, REHEARSING_TURNS, &e->rehearsed))
            return TURNS_PERFORMED;
        if (!e->rehearsed)
            return TURNS_AT_HAND;
    }
    if (e->rehearsed && plan_is_hopeless(e->rehearsed)) { /* but fewer may be one kernel */
        e->turns_most = e->turns_count / 2;
        e->turns_count = e->turns_most > 1 ? 0 : 1;
        e->rehearsed = NULL;
        if (e->turns_count)
            p->not_before = m->run->flushes + TRY_AGAIN;
        return TURNS_WAIT;
    }
    if (e->rehearsed && !plan_waits(m, e->rehearsed))
        return TURNS_AT_HAND;
    p->built_at = m->run->flushes; /* it is not in vain yet */
    return TURNS_WAIT;
}

void loop_build_turns(struct machine *m)
{
    struct replay *p = m->run->replay;
    int active = p->active, at = (int)(p->edge - p->states[active].edges);
    m->run->building = m->run->hold_flush = true;
    p->building_calls = m->run->calls_noted;
    replay_catch_up(m);
    m->run->hold_flush = false;
    m->run->flush_due = true;
    run_flush_due(m);
    m->run->building = false;
    bool back = p->active == active && p->states[active].edges_count > at;
    if (back && p->states[active].edges[at].turns.plan)
        return;
    turns_in_vain(m);
}

void replay_looked(struct machine *m)
{
    struct history *h = m->run->replay ? &m->run->replay->history : NULL;
    if (h && h->period && !h->looked_at)
        h->looked_at = h->count;
    if (!m->run->turns_in_row)
        return;
    m->run->looks_alike =
        m->run->turns_in_row == m->run->turns_between_looks ? m->run->looks_alike + 1 : 0;
    m->run->turns_between_looks = m->run->turns_in_row;
    m->run->turns_in_row = 0;
}

bool replay_thorough(const struct machine *m)
{
    return m->run->replay && m->run->replay->thorough;
}

void replay_resolve(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (!replay_thorough(m))
        return;
    p->depth++; /* it belongs to the calls before */
    for (int i = 1; i < m->values->sets_count; i++)
        if (m->values->sets[i].used)
            flag_resolved(m, &m->values->sets[i], MACHINE_OVERFLOW);
    p->depth--;
}
