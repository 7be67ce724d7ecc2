/* history.c - finds calls that repeat.
 *
 * Calls are performed one by one until the calls of a loop are known as an edge. If the hash of
 * the last few calls was met before, the distance is a candidate for the period; if a whole
 * further period repeats, it is one. From then on evaluations come after whole turns, always at
 * the same call, so that they lead from a state to itself. If the program looks in the loop,
 * turns end there. Otherwise they end where the least memory is live: as a rule at the end of
 * the program's own loop, because its temporaries are overwritten before they are read.
 *
 * Short turns are evaluated several at a time, unless that is known to take no fewer
 * kernels.
 */
#include "memory/memory.h"
#include "run/pending.h"
#include "run/replay.h"
#include "run/room.h"

/* A window's hash is a polynomial in it; a call that leaves the window has been multiplied
 * WINDOW times. */
#define WINDOW_FACTOR UINT64_C(0x9e3779b97f4a7c15)

#define SQUARE(x) ((x) * (x))
#define WINDOW_LEAVES SQUARE(SQUARE(SQUARE(WINDOW_FACTOR)))

_Static_assert(WINDOW == 8, "WINDOW_LEAVES is the factor to that power");

static void loop_forget(struct history *h)
{
    h->period = h->match = h->turn_at = h->looked_at = 0;
    h->one_by_one = h->one_by_one_known = false;
}

void history_call(struct machine *m, const struct machine_call *call)
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
    lifetimes_call(m);
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

bool history_in_loop(const struct machine *m)
{
    const struct history *h = m->run->replay ? &m->run->replay->history : NULL;
    return h && h->period && h->match >= (h->period < LOOP_SURE ? h->period : LOOP_SURE);
}

/* Returns the call after which most bytes are dead, in the turn before the last one, because
 * only there it is known which slots were overwritten later. On a tie, prefers whole turns
 * since the last evaluation. */
static uint32_t turn_at(const struct history *h, const int32_t *dead_then, uint32_t since)
{
    uint32_t from = h->count - 2 * h->period + 1, usual = h->count - since % h->period,
             best = usual;
    int64_t dead = 0, most = INT64_MIN, here = 0;
    for (uint32_t at = from; at != from + h->period; at++) {
        dead += dead_then[at % LIFETIMES];
        if ((usual - at) % h->period == 0)
            here = dead;
        if (dead > most) {
            most = dead;
            best = at;
        }
    }
    return here == most ? usual : best;
}

/* Turns end a whole number of turns after that call. A program that has looked once in the
 * loop is expected to look again, after the same call. */
static uint32_t turns_end(const struct machine *m)
{
    struct replay *p = m->run->replay;
    struct history *h = &p->history;
    uint32_t in_loop = h->period + h->match;
    if (p->since <= in_loop && p->looked)
        return h->count - p->since;
    if (h->looked_at && h->count - h->looked_at <= in_loop)
        return h->looked_at;
    if (h->match < h->period || 2 * h->period > HISTORY) /* it is not known where memory is
                                                          * live */
        return h->count - p->since;
    if (!h->turn_at)
        h->turn_at = turn_at(h, m->memory->lifetimes.dead, p->since);
    return h->turn_at;
}

/* A sum over the loop's calls that does not depend on where a turn begins. */
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

bool history_turn_ends(const struct machine *m)
{
    if (!history_in_loop(m) || !m->values->pending)
        return false;
    struct history *h = &m->run->replay->history;
    if (m->values->pending < pending_least(m) && !room_is_wanted(m) && !is_one_by_one(h))
        return false;
    return (h->count - turns_end(m)) % h->period == 0;
}

bool history_evaluates(struct machine *m, const struct plan *plan, bool due)
{
    struct history *h = &m->run->replay->history;
    if (!due || run_mode_builds(m->run->mode) || !history_in_loop(m) || h->one_by_one)
        return false;
    uint32_t turns = m->run->replay->since / h->period;
    h->one_by_one = turns > 1 && plan_saves_nothing(plan, (int)turns);
    if (h->one_by_one)
        h->sums[h->sums_count++ % LOOPS_ONE_BY_ONE] = loop_sum(h);
    return h->one_by_one;
}

void history_looked(struct machine *m)
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
