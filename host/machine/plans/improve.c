/* improve.c - makes better kernels for a plan that has run often, now or in the background. */
#include "plans/background.h"
#include "plans/division.h"
#include "plans/explained.h"
#include "plans/known.h"
#include "plans/plans.h"

/* How many times as often a plan runs before it gets kernels with its numbers in their text as
 * before it gets boxes. */
enum { WRITTEN_AFTER_BOXES = 64 };

/* Gives up the better plan. */
static void better_give_up(struct machine *m, struct plan *p)
{
    if (p->better)
        plan_notes_settle(m, p->better);
    plan_free(m, p->better);
    p->better = NULL;
}

enum quality plan_quality_after(const struct machine *m, uint64_t worked)
{
    return worked >= m->settings.box_after        ? BOXED
           : worked >= m->settings.optimise_after ? OPTIMISED
                                                  : QUICK;
}

/* Text with numbers in it is some percent faster at most, and a compiler takes as long as a
 * second. */
bool plan_is_due_written(const struct machine *m, const struct plan *p)
{
    return p->lifted && m->settings.numbers == SETTING_FREE &&
           p->worked / WRITTEN_AFTER_BOXES >= m->settings.box_after;
}

bool plan_is_due(struct machine *m, const struct plan *p)
{
    enum quality quality = plan_quality_after(m, p->worked);
    if (choice_is_awaited(m) || !device_takes_kernels(m))
        return false;
    if (p->quality == INTERPRETED)
        return (interpreted_is_due(m, p) || interpreted_seeks(m, p)) && !background_busy(m);
    if (plan_is_due_written(m, p) && !background_busy(m))
        return true;
    return quality > p->quality && (quality != OPTIMISED || p->could_be_optimised) &&
           (quality != BOXED || p->could_be_optimised || p->could_be_boxed ||
            p->could_be_strips) &&
           !background_busy(m);
}

void plan_becomes(struct machine *m, struct plan *p, struct plan *better)
{
    struct plan old = *p;
    *p = *better;
    p->signature = old.signature;
    p->signature_length = old.signature_length;
    p->hash = old.hash;
    p->used = old.used;
    p->worked = old.worked;
    p->version = old.version + 1;
    p->next = old.next;
    p->family = old.family;
    if (m->watch && !old.empty && !old.gone)
        explained_improved(m);
    better->launches = old.launches;
    better->launches_count = old.launches_count;
    better->stored = old.stored;
    better->arrays = old.arrays;
    better->choice = old.choice;
    better->signature = NULL;
    plan_free(m, better);
}

void plan_improve(struct machine *m, struct plan *p, const struct plan_request *q,
                  enum quality quality)
{
    struct plan *better = plan_make(m, q, quality, false);
    p->quality = BOXED; /* not again, unless the plan becomes due in another way */
    if (better)
        plan_becomes(m, p, better);
    else
        machine_error_clear(m);
    p->lifted = p->lifted && !q->written;
}

void improve_give_up(struct machine *m)
{
    better_give_up(m, m->plans->improving);
    background_drop(m);
    m->plans->improving = NULL;
}

void plans_see_to(struct machine *m)
{
    for (int i = 0; m->sequencers && i < m->sequencers->machines_count; i++)
        plans_see_to(m->sequencers->machines[i]);
    struct plan *p = m->plans->improving;
    enum background_state state = p ? background_take(m) : BACKGROUND_WAITS;
    if (state == BACKGROUND_WAITS)
        return;
    if (state == BACKGROUND_LOADED) {
        struct plan *better = p->better;
        for (int i = 0; i < better->launches_count; i++)
            launch_takes(&better->launches[i],
                         background_kernel(m, better->launches[i].number));
        plan_notes_settle(m, better);
        better->later = false;
        if (better->lifted && better->family)
            better->family->lifted++;
        known_keep(m, p, better);
        p->better = NULL;
        plan_becomes(m, p, better);
    } else {
        machine_error_clear(m);
    }
    improve_give_up(m);
}

bool improve_begin(struct machine *m, struct plan *p, const struct plan_request *q,
                   enum quality quality)
{
    if (!background_on(m) || background_busy(m))
        return false;
    known_prepare(m, p, q);
    p->better = plan_make(m, q, quality, true);
    if (p->better && q->form && !background_has_all(m))
        background_drop(m);
    else if (p->better && background_begin(m)) {
        m->plans->improving = p;
        return true;
    }
    machine_error_clear(m);
    better_give_up(m, p);
    return false;
}

void plan_promote(struct machine *m, struct plan *p, const struct plan_request *q)
{
    enum quality quality = plan_quality_after(m, p->worked);
    quality = quality < OPTIMISED ? OPTIMISED : quality;
    if (interpreted_asks(p)) {
        struct plan *better = interpreted_at_hand(m, q);
        p->asked = true;
        p->asked_of = q->family ? q->family->lifted : 0;
        if (better)
            plan_becomes(m, p, better);
    } else if (!improve_begin(m, p, q, quality)) {
        plan_improve(m, p, q, quality);
    }
}

void plan_recall(struct machine *m, struct plan *p, const struct plan_request *q)
{
    p->sought = true;
    improve_begin(m, p, q, q->form->quality);
}

bool plan_is_of_parent(const struct machine *m, const struct plan *p)
{
    bool kernels = p->empty;
    for (int i = 0; i < p->launches_count && !kernels; i++)
        kernels = p->launches[i].kernel || p->launches[i].code;
    return kernels && !device_is_ours(m->device);
}

bool plan_may_run(struct machine *m, const struct plan *p, uint32_t version)
{
    if (p->division) /* whether better kernels are due is asked where they run */
        return true;
    return p->version == version && !plan_is_due(m, p) && !plan_is_of_parent(m, p);
}

bool plan_waits(const struct machine *m, const struct plan *p)
{
    if (p->division) {
        const struct plan *in_blocks = division_in_blocks(p);
        return in_blocks && plan_waits(m->sequencers->machines[0], in_blocks);
    }
    return p == m->plans->improving || p->undecided;
}

bool plan_wants_rehearsal(struct machine *m, const struct plan *p)
{
    if (p->division) {
        const struct plan *in_blocks = division_in_blocks(p);
        return in_blocks && plan_wants_rehearsal(m->sequencers->machines[0], in_blocks);
    }
    return p->undecided && !choice_is_awaited(m);
}
