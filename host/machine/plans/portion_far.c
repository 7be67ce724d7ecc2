/* portion_far.c - portions that rank 0 has sent: see far.h. */
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "plans/far.h"

/* ---- making ---- */

/* What was sent refers only to what came before, and to sets that there are. */
static bool draft_good(const struct machine *m, const struct far_draft *d, uint32_t at)
{
    const bool leaf = d->is == DRAFT_LEAF;
    const bool known = (leaf || d->op < NODE_OP_COUNT) && d->is <= DRAFT_FIRST && d->set >= 0 &&
                       d->set < m->values->sets_count;
    for (int k = 0; known && !leaf && k < node_ops[d->op].inputs; k++)
        if (d->in[k] < 0 || (uint32_t)d->in[k] >= at)
            return false;
    return known;
}

static void draft_take(struct far_portion *p, const struct far_draft *d)
{
    struct portion *g = &p->portion;
    struct machine_value key = {.op = d->op,
                                .axis = d->axis,
                                .maybe_nan = d->maybe_nan,
                                .type = d->type,
                                .set = (uint16_t)d->set,
                                .detail = d->detail,
                                .imm = {d->low, d->high}};
    const bool leaf = d->is == DRAFT_LEAF;
    key.buffer = leaf ? &p->stand_in : NULL;
    for (int k = 0; !leaf && k < node_ops[d->op].inputs; k++)
        key.in[k] = g->reach.nodes[d->in[k]];
    portion_draft(g, key, (struct draft_from){d->is, 0, 0});
}

struct far_portion *portion_far_make(struct machine *m, const void *bytes, size_t count)
{
    const unsigned char *at = bytes;
    struct far_head head;
    if (count < sizeof head)
        return NULL;
    memcpy(&head, at, sizeof head);
    at += sizeof head;
    if (count - sizeof head != (uint64_t)head.drafts * sizeof(struct far_draft) +
                                   (uint64_t)head.targets * sizeof(uint32_t))
        return NULL;
    struct far_portion *p = calloc(1, sizeof *p);
    NEEDS_MEMORY(p);
    p->portion.machine = m;
    p->stand_in.host = m->device->is_pocl ? &p->stand_in : NULL;
    p->local = calloc((size_t)head.drafts + 1, sizeof(struct device_buffer *));
    p->kept = calloc((size_t)head.drafts + 1, sizeof *p->kept);
    NEEDS_MEMORY(p->local && p->kept);
    bool good = true;
    for (uint32_t i = 0; i < head.drafts && good; i++, at += sizeof(struct far_draft)) {
        struct far_draft d;
        memcpy(&d, at, sizeof d);
        good = draft_good(m, &d, i);
        if (good)
            draft_take(p, &d);
    }
    for (uint32_t i = 0; i < head.targets && good; i++, at += sizeof(uint32_t)) {
        uint32_t node;
        memcpy(&node, at, sizeof node);
        good = node < head.drafts;
        if (good) {
            NEEDS_MEMORY(targets_add(&p->portion.targets, p->portion.reach.nodes[node]));
            p->kept[node] = true;
        }
    }
    if (good) {
        NEEDS_MEMORY(reach_ends(&p->portion.reach, &p->portion.targets));
        return p;
    }
    portion_far_free(p);
    return NULL;
}

void portion_far_free(struct far_portion *p)
{
    if (!p)
        return;
    portion_free(&p->portion);
    free(p->local);
    free(p->kept);
    free(p);
}

/* ---- running ---- */

/* It is a hint: what cannot be is none. */
void portion_far_prepare(struct far_portion *p, enum plan_use use)
{
    if (!portion_plan(&p->portion, use))
        machine_error_clear(p->portion.machine);
}

/* Sets the drafts by the words; the first word of the results. NULL: they are others. */
static const uint64_t *words_take(struct far_portion *p, const struct far_table *arrays,
                                  const uint64_t *words, const uint64_t *end)
{
    struct portion *g = &p->portion;
    for (int i = 0; i < g->reach.count; i++) {
        struct machine_value *v = g->reach.nodes[i];
        const int is = g->from[i].is, wanted = is == DRAFT_LEAF ? 1 : is == DRAFT_MADE ? 0 : 2;
        p->local[i] = NULL;
        if (end - words < wanted)
            return NULL;
        if (is == DRAFT_LEAF) {
            v->buffer = p->local[i] = far_table_of(arrays, words[0]);
            if (!v->buffer)
                return NULL;
        } else if (wanted) {
            v->imm.lo = words[0];
            v->imm.hi = words[1];
        }
        words += wanted;
    }
    return end - words == g->targets.count ? words : NULL;
}

bool portion_far_run(struct machine *m, struct far_portion *p, struct far_table *arrays,
                     const uint64_t *words, size_t count)
{
    struct portion *g = &p->portion;
    const struct fates fates = {.kept = p->kept};
    const uint64_t *const out = words_take(p, arrays, words, words + count);
    const bool good = out && portion_plan(g, PLAN_TO_RUN) &&
                      !plan_run(m, g->plan, p->local, g->reach.nodes, &fates);
    for (int i = 0; i < g->targets.count && good; i++)
        far_table_put(arrays, out[i], p->local[g->targets.values[i]->local]);
    for (int i = 0; i < g->reach.count; i++)
        if (g->from[i].is == DRAFT_LEAF)
            g->reach.nodes[i]->buffer = &p->stand_in;
    return good;
}
