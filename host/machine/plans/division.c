/* division.c - plans in two portions are made and run: see division.h. */
#include "plans/division.h"

#include <stdlib.h>

#include "base/errors.h"
#include "device/far.h"
#include "plans/background.h"
#include "plans/far.h"
#include "ranks/ranks.h"

/* ---- plans ---- */

/* What went wrong there has gone wrong here. */
static enum machine_status failed_there(struct machine *m, struct machine *there)
{
    if (there == m || !there->status)
        return m->status;
    machine_fail(m, there->status, "%s", there->error);
    machine_error_clear(there);
    return m->status;
}

static bool portions_plan(struct machine *m, struct plan *p, enum plan_use use)
{
    struct division *d = p->division;
    const bool mixed = d->whole.targets.count > 0;
    p->hopeless = use == PLAN_TO_REHEARSE_TURNS && mixed;
    if (p->hopeless)
        return true;
    if (d->far && (!plan_use_runs(use) || use == PLAN_TO_RUN_OFTEN))
        division_far_prepare(d, use);
    for (int i = 0; i < d->blocks_count; i++) {
        const struct plan *in_blocks = portion_plan(&d->blocks[i], use);
        if (!in_blocks) {
            failed_there(m, d->blocks[i].machine);
            return false;
        }
        p->hopeless |= in_blocks->hopeless;
        p->quality = in_blocks->quality;
    }
    return !mixed || portion_plan(&d->whole, use);
}

static void stores_add(const struct machine *m, struct plan *p, const struct portion *g)
{
    for (int i = 0; i < g->targets.count; i++) {
        const struct machine_value *v = g->targets.values[i];
        p->arrays[p->stored_count] =
            (struct array){.rows = geometry_rows(&m->values->sets[v->set], v->type)};
        p->stored[p->stored_count++] = g->target_nodes[i];
    }
}

/* Inputs before users, as in any plan. */
static void stores_sort(struct plan *p)
{
    for (int i = 1; i < p->stored_count; i++)
        for (int k = i; k > 0 && p->stored[k] < p->stored[k - 1]; k--) {
            const int node = p->stored[k];
            const struct array array = p->arrays[k];
            p->stored[k] = p->stored[k - 1];
            p->arrays[k] = p->arrays[k - 1];
            p->stored[k - 1] = node;
            p->arrays[k - 1] = array;
        }
}

static struct plan *plan_of(const struct machine *m, struct division *d)
{
    const size_t count = (size_t)(d->blocks[0].targets.count + d->whole.targets.count);
    struct plan *p = calloc(1, sizeof *p);
    NEEDS_MEMORY(p);
    p->division = d;
    p->turns_most = 1;
    p->stored = calloc(count, sizeof *p->stored);
    p->arrays = calloc(count, sizeof *p->arrays);
    NEEDS_MEMORY(p->stored && p->arrays);
    stores_add(m, p, &d->blocks[0]);
    stores_add(m, p, &d->whole);
    stores_sort(p);
    return p;
}

/* Kernels of the front end look at arrays in one piece. False: error set. */
static bool leaves_gather(struct machine *m, const struct reach *r)
{
    for (int i = 0; i < r->count; i++)
        if (r->nodes[i]->buffer && sequencers_whole(m, r->nodes[i]->buffer))
            return false;
    return true;
}

struct plan *division_get(struct machine *m, const struct plan_request *q)
{
    struct plan *p = plans_find(m, q->reach);
    struct division *d = p ? p->division : division_make(m, q);
    if (!p && d && !(p = plans_keep(m, plan_of(m, d), q)))
        return NULL;
    if (d)
        return portions_plan(m, p, q->use) ? p : NULL;
    return plan_use_runs(q->use) && !leaves_gather(m, q->reach) ? NULL : plan_get(m, q);
}

/* ---- a run ---- */

struct division_run {
    struct machine *m;
    struct division *d;
    struct device_buffer **buffers;     /* by node of the request */
    struct machine_value *const *nodes; /* its constants */
    int drafts;                         /* of a portion, at most */
    struct device_buffer **out;         /* by target */
    struct device_buffer **far;         /* ... of a block in blocks */
    struct device_buffer **local; /* by draft, of each portion; the whole one's is the first */
    bool *kept;                   /* by draft */
    bool failed[BLOCKS_MOST];     /* by block */
};

static struct device_buffer **local_of(const struct division_run *r, const struct portion *g)
{
    const ptrdiff_t which = g == &r->d->whole ? 0 : g - r->d->blocks;
    return r->local + which * r->drafts;
}

/* What that block's drafts are: arrays of one in pieces, and numbers. */
static void drafts_set(const struct division_run *r, const struct portion *g, int block)
{
    struct device_buffer **local = local_of(r, g);
    for (int i = 0; i < g->reach.count; i++) {
        const struct draft_from *f = &g->from[i];
        struct machine_value *v = g->reach.nodes[i];
        local[i] = NULL;
        if (f->is == DRAFT_LEAF) {
            struct device_buffer *b = r->buffers[f->node];
            v->buffer = local[i] = block < 0 ? b : b->blocks->of[block];
        } else if (f->is == DRAFT_NUMBER) {
            v->imm = r->nodes[f->node]->imm;
        } else if (f->is == DRAFT_LOW) {
            v->imm.lo = r->nodes[f->node]->imm.lo;
        } else if (f->is == DRAFT_HIGH) {
            v->imm.lo = r->nodes[f->node]->imm.hi;
        } else if (f->is == DRAFT_FIRST) { /* its place is the draft before it */
            const struct cut *c = sequencers_cut(r->m, g->reach.nodes[i - 1]->set);
            v->imm.lo = cut_first(c, block) * f->times;
        }
    }
}

/* A leaf's array may be gone before the next run. */
static void drafts_reset(struct division *d, struct portion *g)
{
    for (int i = 0; i < g->reach.count; i++)
        if (g->from[i].is == DRAFT_LEAF)
            g->reach.nodes[i]->buffer = &d->stand_in;
}

static void kept_find(const struct division_run *r, const struct portion *g)
{
    for (int i = 0; i < g->reach.count; i++)
        r->kept[i] = false;
    for (int i = 0; i < g->targets.count; i++)
        r->kept[g->targets.values[i]->local] = true;
}

static enum machine_status portion_run(const struct division_run *r, struct portion *g)
{
    const struct fates fates = {.kept = r->kept};
    return plan_run(g->machine, g->plan, local_of(r, g), g->reach.nodes, &fates);
}

/* Arrays that the sequencers look at are in blocks, with ghosts enough. */
static enum machine_status leaves_divide(const struct division_run *r)
{
    const struct portion *g = &r->d->blocks[0];
    enum machine_status status = MACHINE_OK;
    for (int i = 0; i < g->reach.count && !status; i++) {
        const struct machine_value *v = g->reach.nodes[i];
        if (g->from[i].is == DRAFT_LEAF)
            status = sequencers_divide(r->m, r->buffers[g->from[i].node], v->set, v->type,
                                       r->d->needs[v->set]);
    }
    return status;
}

/* Ghosts of what is computed from arrays of that set. */
static int ghosts_of(const struct division_run *r, int set)
{
    const struct portion *g = &r->d->blocks[0];
    int least = sequencers_cut(r->m, set)->ghosts;
    for (int i = 0; i < g->reach.count; i++)
        if (g->from[i].is == DRAFT_LEAF && g->reach.nodes[i]->set == set) {
            const int valid = r->buffers[g->from[i].node]->blocks->valid;
            least = valid < least ? valid : least;
        }
    return least;
}

/* A block's results, by its sequencer. */
static bool block_compute(const struct division_run *r, struct portion *g, int block)
{
    drafts_set(r, g, block);
    if ((block == 0 || r->d->blocks_count > 1) && !portion_plan(g, PLAN_TO_RUN))
        return false;
    if (portion_run(r, g))
        return false;
    for (int i = 0; i < g->targets.count; i++)
        sequencers_array_gets(r->out[i], block, local_of(r, g)[g->targets.values[i]->local]);
    return true;
}

static void part_compute(void *of, int block, int worker)
{
    struct division_run *r = of;
    (void)worker;
    r->failed[block] = !block_compute(r, &r->d->blocks[block], block);
}

/* Kernels are only started, and run side by side whoever starts them; byte code, and what makes
 * plans, run where they are called. */
static bool threads_wanted(const struct division *d)
{
    bool wanted = false;
    for (int i = 0; i < d->blocks_count && !wanted; i++) {
        const struct plan *p = d->blocks[i].plan;
        wanted = !p;
        for (int k = 0; p && k < p->launches_count && !wanted; k++)
            wanted = p->launches[k].program != NULL;
    }
    return wanted;
}

/* Each sequencer's work on a thread of its own. */
static enum machine_status blocks_compute_apart(struct division_run *r)
{
    struct machine *m = r->m;
    if (device_subs_begin(m))
        return m->status;
    crew_run(threads_wanted(r->d) ? m->device->crew : NULL, r->d->blocks_count, part_compute,
             r);
    device_subs_queued(m);
    enum machine_status status = MACHINE_OK;
    for (int i = 0; i < r->d->blocks_count; i++)
        if (r->failed[i])
            status = failed_there(m, r->d->blocks[i].machine);
    return status;
}

static enum machine_status blocks_compute_in_turn(struct division_run *r)
{
    struct portion *g = &r->d->blocks[0];
    for (int block = 0; block < r->m->sequencers->count; block++)
        if (!block_compute(r, g, block))
            return failed_there(r->m, g->machine);
    return MACHINE_OK;
}

/* Other ranks' blocks first, which take as long as this one, beside it. */
static enum machine_status blocks_compute_far(const struct division_run *r)
{
    struct portion *g = &r->d->blocks[0];
    struct machine *m = r->m;
    for (int block = 1; block < m->sequencers->count; block++) {
        drafts_set(r, g, block);
        for (int i = 0; i < g->targets.count; i++) {
            const struct machine_value *v = g->targets.values[i];
            struct device_buffer *b = device_far_new(
                m, block, geometry_rows(sequencers_set(m, v->set), v->type).bytes);
            if (!b)
                return m->status;
            sequencers_array_gets(r->out[i], block, b);
            r->far[i] = b;
        }
        division_far_run(r->d, block, local_of(r, g), r->far);
    }
    ranks_flush();
    return block_compute(r, g, 0) ? MACHINE_OK : failed_there(m, g->machine);
}

static enum machine_status blocks_compute(struct division_run *r)
{
    struct portion *g = &r->d->blocks[0];
    enum machine_status status = leaves_divide(r);
    kept_find(r, g);
    for (int i = 0; i < g->targets.count && !status; i++) {
        const struct machine_value *v = g->targets.values[i];
        r->out[i] = sequencers_array(r->m, v->set, v->type);
        if (!r->out[i])
            return r->m->status;
        r->out[i]->blocks->valid = ghosts_of(r, v->set) - r->d->reaches[i];
    }
    if (!status)
        status = r->d->far                ? blocks_compute_far(r)
                 : r->d->blocks_count > 1 ? blocks_compute_apart(r)
                                          : blocks_compute_in_turn(r);
    for (int i = 0; i < r->d->blocks_count; i++)
        drafts_reset(r->d, &r->d->blocks[i]);
    r->m->sequencers->run++;
    return status;
}

static enum machine_status whole_compute(struct division_run *r)
{
    struct portion *g = &r->d->whole;
    enum machine_status status = MACHINE_OK;
    for (int i = 0; i < g->reach.count && !status; i++)
        if (g->from[i].is == DRAFT_LEAF)
            status = sequencers_whole(r->m, r->buffers[g->from[i].node]);
    if (status || !g->targets.count)
        return status;
    kept_find(r, g);
    drafts_set(r, g, -1);
    status = portion_plan(g, PLAN_TO_RUN) ? portion_run(r, g) : r->m->status;
    for (int i = 0; i < g->targets.count && !status; i++)
        r->out[r->d->blocks[0].targets.count + i] = local_of(r, g)[g->targets.values[i]->local];
    drafts_reset(r->d, g);
    return status;
}

/* The results become the caller's, but for those that it does not keep; after a failure none
 * does. */
static void results_give(const struct division_run *r, const struct fates *fates,
                         enum machine_status status)
{
    const struct portion *const g[2] = {&r->d->blocks[0], &r->d->whole};
    struct device_buffer **out = r->out;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < g[k]->targets.count; i++, out++) {
            const int node = g[k]->target_nodes[i];
            r->buffers[node] = NULL;
            if (*out && (status || (fates && !fates->kept[node])))
                device_buffer_unref(r->m, *out);
            else
                r->buffers[node] = *out;
        }
}

/* Of a plan that is not divided: arrays in one piece. */
static enum machine_status arrays_gather(struct machine *m, const struct plan *p,
                                         struct device_buffer *const *buffers)
{
    for (int i = 0; i < p->launches_count; i++)
        for (int k = 0; k < p->launches[i].arguments_count; k++) {
            const struct kernel_argument *a = &p->launches[i].arguments[k];
            if (a->kind == ARGUMENT_INPUT && sequencers_whole(m, buffers[a->node]))
                return m->status;
        }
    return MACHINE_OK;
}

enum machine_status division_run(struct machine *m, struct plan *p,
                                 struct device_buffer **buffers,
                                 struct machine_value *const *nodes, const struct fates *fates)
{
    if (!p->division)
        return arrays_gather(m, p, buffers) ? m->status : plan_run(m, p, buffers, nodes, fates);
    struct division *d = p->division;
    const int in_blocks = d->blocks[0].reach.count, in_whole = d->whole.reach.count,
              most = in_blocks > in_whole ? in_blocks : in_whole;
    struct division_run r = {
        .m = m, .d = d, .buffers = buffers, .nodes = nodes, .drafts = most};
    r.local = calloc((size_t)(most * d->blocks_count), sizeof(struct device_buffer *));
    r.out = calloc((size_t)p->stored_count, sizeof(struct device_buffer *));
    r.far = calloc((size_t)p->stored_count, sizeof(struct device_buffer *));
    r.kept = calloc((size_t)most, sizeof *r.kept);
    enum machine_status status =
        r.local && r.out && r.far && r.kept
            ? MACHINE_OK
            : machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to run a plan");
    status = status ? status : blocks_compute(&r);
    status = status ? status : whole_compute(&r);
    if (r.out)
        results_give(&r, fates, status);
    free(r.local);
    free(r.out);
    free(r.far);
    free(r.kept);
    p->runs++;
    return status;
}
