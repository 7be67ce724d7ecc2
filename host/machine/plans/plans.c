/* plans.c - plans kept: found by signature, made when a graph is first seen, and made better
 * when it has been seen often.
 *
 * The values of constants are not part of a signature.
 */
#include "plans/plans.h"

#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "plans/background.h"
#include "plans/division.h"
#include "plans/known.h"

/* Of a program that does not repeat, in units of some 4 kilobytes: a plan of few values is one,
 * of many values several. */
enum { PLANS_MOST = 8192, BUCKETS = 4096, UNIT_WORDS = 512 };

static uint64_t units_of(const struct plan *p)
{
    return 1 + p->signature_length / UNIT_WORDS;
}

static bool too_many(const struct plans *p)
{
    return p->units > PLANS_MOST && p->age - p->begun > PLANS_MOST / 2;
}

bool plans_are_many(const struct machine *m)
{
    bool many = too_many(m->plans) || device_kernels_are_many(m);
    for (int i = 0; m->sequencers && i < m->sequencers->machines_count && !many; i++)
        many = plans_are_many(m->sequencers->machines[i]);
    return many;
}

/* All that were used last before that. */
static void forget_before(struct machine *m, uint64_t used)
{
    for (int i = 0; i < m->plans->table_size; i++)
        for (struct plan **at = &m->plans->table[i], *p; (p = *at);) {
            if (p->used >= used || p == m->plans->improving || p == m->plans->choosing.plan) {
                at = &p->next;
                continue;
            }
            *at = p->next;
            m->plans->count--;
            m->plans->units -= units_of(p);
            if (p->family)
                p->family->kept--;
            plan_free(m, p);
        }
}

/* Plans whose kernels go are kept: these are on disk when the plan comes back. */
static void forget_kernels(struct machine *m)
{
    const uint64_t before = device_kernels_old(m);
    for (int i = 0; i < m->plans->table_size; i++)
        for (struct plan *p = m->plans->table[i]; p; p = p->next)
            if (p != m->plans->improving && p != m->plans->choosing.plan)
                plan_let_go_of_old(m, p, before);
    device_kernels_forget(m, before);
}

static void forget_plans(struct machine *m)
{
    m->plans->begun = m->plans->age;
    forget_before(m, m->plans->age - PLANS_MOST / 2);
    if (m->plans->units > PLANS_MOST) /* all are in use */
        forget_before(m, m->plans->age);
    families_sweep(m);
}

/* What divisions know of the sequencers' plans. */
static void forget_in_blocks(struct machine *m)
{
    for (int i = 0; i < m->plans->table_size; i++)
        for (struct plan *p = m->plans->table[i]; p; p = p->next)
            if (p->division)
                division_forget_plans(p->division);
}

void plans_forget_oldest(struct machine *m)
{
    if (m->sequencers) {
        forget_in_blocks(m);
        for (int i = 0; i < m->sequencers->machines_count; i++)
            plans_forget_oldest(m->sequencers->machines[i]);
    }
    if (too_many(m->plans))
        forget_plans(m);
    if (device_kernels_are_many(m))
        forget_kernels(m);
}

void plans_finish(struct machine *m)
{
    choosing_stop(m);
    for (int i = 0; i < m->plans->table_size; i++)
        for (struct plan *p = m->plans->table[i], *next; p; p = next) {
            next = p->next;
            plan_free(m, p);
        }
    free(m->plans->table);
    families_finish(m);
    blocks_room_free(&m->plans->room);
}

/* With many arrays, many turns do not pay: each turn must leave nothing to compute, which
 * stores more than they save. */
int plan_turns(const struct machine *m, const struct plan *p)
{
    if (p->division) {
        const struct plan *in_blocks = division_in_blocks(p);
        const int most = in_blocks ? plan_turns(p->division->blocks[0].machine, in_blocks) : 1;
        return most < p->division->turns_most ? most : p->division->turns_most;
    }
    return p->quality == BOXED && p->stored_count <= m->device->shape.arrays_foreseen
               ? p->turns_most
               : 1;
}

uint64_t plan_stores_bytes(const struct plan *p)
{
    uint64_t bytes = 0;
    for (int i = 0; i < p->stored_count; i++)
        bytes += p->arrays[i].rows.bytes;
    return bytes;
}

const int *plan_stored(const struct plan *p, int *count)
{
    *count = p->stored_count;
    return p->stored;
}

bool plan_saves_nothing(const struct plan *p, int turns)
{
    if (p->division) {
        const struct plan *in_blocks = division_in_blocks(p);
        return in_blocks && plan_saves_nothing(in_blocks, turns);
    }
    int sets = 0;
    for (int i = 0; i < p->launches_count; i++) {
        bool first = true;
        for (int k = 0; k < i; k++)
            first = first && p->launches[k].set != p->launches[i].set;
        sets += first;
    }
    return p->quality == BOXED && p->launches_count >= turns * sets;
}

bool plan_is_short(const struct machine *m, const struct plan *p)
{
    return !p->division && p->quality == INTERPRETED &&
           1e9 * p->predicted_s < m->device->shape.short_ns;
}

bool plan_is_hopeless(const struct plan *p)
{
    return p->hopeless;
}

static struct plan *plan_find(const struct machine *m, const struct reach *r, uint64_t hash)
{
    struct plan *p = m->plans->table[hash & (uint64_t)(m->plans->table_size - 1)];
    while (p && !(p->hash == hash && p->signature_length == r->length &&
                  !memcmp(p->signature, r->signature, r->length * sizeof *r->signature)))
        p = p->next;
    if (p)
        p->used = m->plans->age;
    return p;
}

/* Adds the plan to the table. False: no memory; the plan has been freed. */
static bool plan_keep(struct machine *m, struct plan *p, const struct plan_request *q,
                      uint64_t hash)
{
    struct plan **bucket = &m->plans->table[hash & (uint64_t)(m->plans->table_size - 1)];
    const struct reach *r = q->reach;
    size_t bytes = r->length * sizeof *r->signature;
    m->plans->built++;
    p->signature = malloc(bytes);
    if (!p->signature) {
        plan_free(m, p);
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for a plan");
        return false;
    }
    memcpy(p->signature, r->signature, bytes);
    p->signature_length = r->length;
    p->hash = hash;
    m->plans->age += units_of(p);
    m->plans->units += units_of(p);
    p->used = m->plans->age;
    p->next = *bucket;
    p->family = q->family;
    if (p->family)
        p->family->kept++;
    *bucket = p;
    m->plans->count++;
    return true;
}

/* Completes a rehearsed plan so that it can run. False: error set. */
static bool plan_fill(struct machine *m, struct plan *p, const struct plan_request *q)
{
    if (m->plans->improving == p)
        improve_give_up(m);
    struct plan *made = plan_make(m, q, BOXED, false);
    if (made)
        plan_becomes(m, p, made);
    return made != NULL;
}

/* Prepares a plan's kernels without running it. What a large one stores is chosen in a thread;
 * then it has to be rehearsed again. NULL: impossible; an error may be set. */
static struct plan *plan_rehearse(struct machine *m, struct plan *p, struct plan_request *q,
                                  uint64_t hash)
{
    if (p && !p->undecided)
        return p;
    if (!p) {
        if (!(p = calloc(1, sizeof *p)))
            return NULL;
        p->empty = true;
        p->quality = BOXED;
        if (!plan_keep(m, p, q, hash))
            return NULL;
    }
    p->undecided = !choice_is_at_hand(m, p, q, true);
    if (p->undecided)
        return p;
    q->choice = p->choice;
    bool made = background_on(m) ? improve_begin(m, p, q, BOXED) : plan_fill(m, p, q);
    p->hopeless = !made && q->use == PLAN_TO_REHEARSE_TURNS;
    return p;
}

/* Its kernels had gone, or are the parent's. A large plan is interpreted until it is known
 * again what it stores. False: error set. */
static bool plan_comes_back(struct machine *m, struct plan *p, struct plan_request *q)
{
    const bool later = choice_takes_long(m, q) || !device_is_ours(m->device);
    if (m->plans->improving == p)
        improve_give_up(m);
    struct plan *made = later ? interpreted_make(m, q) : NULL;
    q->choice = p->choice;
    q->written = !p->lifted;
    for (int quality = (int)p->quality; !made && quality >= (int)QUICK; quality--) {
        machine_error_clear(m);
        made = plan_make(m, q, (enum quality)quality, false);
    }
    if (made)
        plan_becomes(m, p, made);
    return made != NULL;
}

/* What an earlier program had compiled, if it did. */
static void plan_seek(struct machine *m, struct plan *p, struct plan_request *q)
{
    struct plan_form form;
    if (!known_find(m, q, &form)) {
        p->sought = true;
        return;
    }
    if (!choice_is_at_hand(m, p, q, form.quality == BOXED || m->device->shape.always_strips))
        return;
    q->choice = p->choice;
    q->form = &form;
    plan_recall(m, p, q);
    q->form = NULL;
}

/* Better kernels for a plan that is due. */
static void plan_better(struct machine *m, struct plan *p, struct plan_request *q)
{
    if (interpreted_seeks(m, p)) {
        plan_seek(m, p, q);
        return;
    }
    enum quality quality = plan_quality_after(m, p->worked);
    const bool asks = p->quality == INTERPRETED && interpreted_asks(p);
    if (!choice_is_at_hand(m, p, q,
                           (quality == BOXED && !asks) || m->device->shape.always_strips))
        return;
    q->choice = p->choice;
    if (p->quality == INTERPRETED) {
        plan_promote(m, p, q);
        return;
    }
    q->written = plan_is_due_written(m, p);
    if (!improve_begin(m, p, q, quality))
        plan_improve(m, p, q, quality);
}

static bool table_make(struct machine *m)
{
    if (m->plans->table)
        return true;
    m->plans->table_size = BUCKETS;
    m->plans->table = calloc((size_t)m->plans->table_size, sizeof *m->plans->table);
    return m->plans->table != NULL;
}

struct plan *plans_find(struct machine *m, const struct reach *r)
{
    return m->plans->table ? plan_find(m, r, words_hash(r->signature, r->length)) : NULL;
}

struct plan *plans_keep(struct machine *m, struct plan *p, const struct plan_request *q)
{
    const uint64_t hash = words_hash(q->reach->signature, q->reach->length);
    if (table_make(m))
        return plan_keep(m, p, q, hash) ? p : NULL;
    plan_free(m, p);
    machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for plans");
    return NULL;
}

struct plan *plan_get(struct machine *m, const struct plan_request *wanted)
{
    struct plan_request request = *wanted, *q = &request;
    uint64_t hash = words_hash(q->reach->signature, q->reach->length);
    if (!table_make(m)) {
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for plans");
        return NULL;
    }
    if (plan_use_runs(q->use))
        plans_see_to(m);
    struct plan *p = plan_find(m, q->reach, hash);
    q->family = p ? p->family : family_join(m, q->reach, q->targets);
    if (!plan_use_runs(q->use))
        return plan_rehearse(m, p, q, hash);
    if (p && (p->gone || plan_is_of_parent(m, p)) && !plan_comes_back(m, p, q))
        return NULL;
    if (p && p->empty)
        return plan_fill(m, p, q) ? p : NULL;
    if (p && plan_is_due(m, p))
        plan_better(m, p, q);
    if (p)
        return p;
    p = interpreted_make(m, q);
    if (p)
        return plan_keep(m, p, q, hash) ? p : NULL;
    p = plan_make(m, q, q->use == PLAN_TO_RUN_OFTEN ? BOXED : plan_quality_after(m, 0), false);
    return p && plan_keep(m, p, q, hash) ? p : NULL;
}
