/* division_far.c - what rank 0 sends of a division: see far.h. */
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "plans/far.h"
#include "ranks/numbers.h"
#include "ranks/ranks.h"

static struct numbers numbers;

static struct far_draft draft_as_sent(const struct portion *g, int i)
{
    const struct machine_value *v = g->reach.nodes[i];
    struct far_draft d;
    memset(&d, 0, sizeof d); /* its gaps, too, are sent */
    d.op = v->op;
    d.is = g->from[i].is;
    d.axis = v->axis;
    d.maybe_nan = v->maybe_nan;
    d.type = v->type;
    d.set = v->set;
    d.detail = v->detail;
    d.low = v->imm.lo;
    d.high = v->imm.hi;
    const int inputs = v->buffer ? 0 : node_ops[v->op].inputs;
    for (int k = 0; k < 3; k++)
        d.in[k] = k < inputs ? (int32_t)v->in[k]->local : -1;
    return d;
}

void division_far_plan(struct division *d)
{
    struct portion *g = &d->blocks[0];
    const size_t drafts = (size_t)g->reach.count, targets = (size_t)g->targets.count,
                 bytes = sizeof(struct far_head) + drafts * sizeof(struct far_draft) +
                         targets * sizeof(uint32_t);
    const struct far_head head = {(uint32_t)drafts, (uint32_t)targets};
    unsigned char *all = malloc(bytes), *at = all + sizeof head;
    NEEDS_MEMORY(all);
    memcpy(all, &head, sizeof head);
    for (int i = 0; i < g->reach.count; i++, at += sizeof(struct far_draft)) {
        const struct far_draft draft = draft_as_sent(g, i);
        memcpy(at, &draft, sizeof draft);
    }
    for (int i = 0; i < g->targets.count; i++, at += sizeof(uint32_t))
        memcpy(at, &g->targets.values[i]->local, sizeof(uint32_t));
    d->far = numbers_get(&numbers);
    ranks_command_all((struct ranks_command){RANKS_PLAN, (uint32_t)bytes, {d->far}}, all);
    free(all);
}

void division_far_prepare(const struct division *d, enum plan_use use)
{
    ranks_command_all((struct ranks_command){RANKS_PREPARE, 0, {d->far, (uint64_t)use}}, NULL);
}

void division_far_forget(struct division *d)
{
    ranks_command_all((struct ranks_command){RANKS_FORGET, 0, {d->far}}, NULL);
    numbers_leave(&numbers, d->far);
}

void division_far_run(const struct division *d, int block, struct device_buffer *const *local,
                      struct device_buffer *const *out)
{
    const struct portion *g = &d->blocks[0];
    const size_t most = 2 * (size_t)g->reach.count + (size_t)g->targets.count;
    uint64_t few[64], *words = most <= 64 ? few : malloc(most * sizeof *words), *at = words;
    NEEDS_MEMORY(words);
    for (int i = 0; i < g->reach.count; i++) {
        if (g->from[i].is == DRAFT_LEAF) {
            *at++ = local[i]->far;
        } else if (g->from[i].is != DRAFT_MADE) {
            *at++ = g->reach.nodes[i]->imm.lo;
            *at++ = g->reach.nodes[i]->imm.hi;
        }
    }
    for (int i = 0; i < g->targets.count; i++)
        *at++ = out[i]->far;
    const uint32_t bytes = (uint32_t)((size_t)(at - words) * sizeof *words);
    ranks_command(block, (struct ranks_command){RANKS_RUN, bytes, {d->far}}, words);
    if (words != few)
        free(words);
}
