/* all_to_all_far.c - see all_to_all_far.h.
 *
 *     all       sort what they send          rank 1: mail for 0, 1, 2
 *     then      counts, from each to each
 *     then      indices and elements
 *     send      each puts what it has got into its block, rank 0's first
 *     get       each answers with elements, and puts what it has got where it wanted it
 *
 * All know who sends to whom, so nobody asks. Memory that there is not ends the run. */
#include "ops/all_to_all_far.h"

#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/types.h"
#include "ranks/posts.h"
#include "ranks/ranks.h"

/* What a rank is told, before the shares of all senders and takers. Arrays by their numbers; 0:
 * there is none. */
struct told {
    struct vpset from, to; /* whole sets */
    struct machine_type address_type, type;
    struct machine_scalar same;
    uint64_t bytes;
    uint32_t address, context, source, out, arrived;
    uint32_t mask, combiner;
    int32_t senders, takers;
    bool gets, all, is_same, looks_beyond;
};

/* What comes before mail. beyond: some message of that sender went to nobody. */
struct mail_head {
    uint64_t count, beyond;
};

/* ---- mail ---- */

static struct mail *mail_of(const struct exchange *e, int from, int to)
{
    return &e->mail[from * e->takers_count + to];
}

static void room_make(const struct exchange *e, struct mail *q, size_t count)
{
    q->count = count;
    q->index = malloc(count * sizeof *q->index + 1);
    q->elements = e->gets || e->same ? NULL : malloc(count * e->bytes + 1);
    NEEDS_MEMORY(q->index && (e->gets || e->same || q->elements));
}

static void counts_exchange(struct exchange *e, int mine)
{
    struct posts posts = {.count = 0};
    struct mail_head out[RANKS_MOST], in[RANKS_MOST];
    const bool sends = mine < e->senders_count, takes = mine < e->takers_count;
    for (int k = 0; sends && k < e->takers_count; k++) {
        out[k] = (struct mail_head){mail_of(e, mine, k)->count, atomic_load(&e->beyond)};
        if (k != mine)
            posts_send(&posts, k, &out[k], sizeof out[k]);
    }
    for (int i = 0; takes && i < e->senders_count; i++)
        if (i != mine)
            posts_take(&posts, i, &in[i], sizeof in[i]);
    posts_end(&posts);
    for (int i = 0; takes && i < e->senders_count; i++) {
        if (i == mine)
            continue;
        room_make(e, mail_of(e, i, mine), in[i].count);
        if (in[i].beyond)
            atomic_store(&e->beyond, true);
    }
}

/* Indices, and of a send elements. */
static void mail_exchange(const struct exchange *e, int mine)
{
    struct posts posts = {.count = 0};
    for (int k = 0; mine < e->senders_count && k < e->takers_count; k++) {
        const struct mail *q = mail_of(e, mine, k);
        if (k == mine)
            continue;
        posts_send(&posts, k, q->index, q->count * sizeof *q->index);
        if (q->elements)
            posts_send(&posts, k, q->elements, q->count * e->bytes);
    }
    for (int i = 0; mine < e->takers_count && i < e->senders_count; i++) {
        const struct mail *q = mail_of(e, i, mine);
        if (i == mine)
            continue;
        posts_take(&posts, i, q->index, q->count * sizeof *q->index);
        if (q->elements)
            posts_take(&posts, i, q->elements, q->count * e->bytes);
    }
    posts_end(&posts);
}

/* Of a get the elements, back. */
static void answers_exchange(const struct exchange *e, int mine)
{
    struct posts posts = {.count = 0};
    for (int i = 0; mine < e->takers_count && i < e->senders_count; i++) {
        const struct mail *q = mail_of(e, i, mine);
        if (i != mine && q->count)
            posts_send(&posts, i, q->elements, q->count * e->bytes);
    }
    for (int k = 0; mine < e->senders_count && k < e->takers_count; k++) {
        struct mail *q = mail_of(e, mine, k);
        if (k == mine || !q->count)
            continue;
        q->elements = malloc(q->count * e->bytes);
        NEEDS_MEMORY(q->elements);
        posts_take(&posts, k, q->elements, q->count * e->bytes);
    }
    posts_end(&posts);
}

static void part_do(struct exchange *e, int mine)
{
    const bool sends = mine < e->senders_count, takes = mine < e->takers_count;
    if (sends)
        exchange_sort(e, mine, 0);
    NEEDS_MEMORY(!atomic_load(&e->failed));
    counts_exchange(e, mine);
    mail_exchange(e, mine);
    if (takes && !e->gets)
        exchange_deliver(e, mine, 0);
    if (takes && e->gets)
        exchange_answer(e, mine, 0);
    NEEDS_MEMORY(!atomic_load(&e->failed));
    if (e->gets)
        answers_exchange(e, mine);
    if (sends && e->gets)
        exchange_take(e, mine, 0);
}

/* ---- rank 0 ---- */

static uint32_t number_of(const struct device_buffer *b, int rank)
{
    return b && b->blocks ? b->blocks->of[rank]->far : 0;
}

static void tell(const struct exchange *e, int rank)
{
    const struct message *g = e->g;
    const size_t senders = (size_t)e->senders_count, takers = (size_t)e->takers_count,
                 bytes = sizeof(struct told) + (senders + takers) * sizeof(struct share);
    unsigned char *all = calloc(1, bytes), *at = all + sizeof(struct told);
    struct told *t = (struct told *)(void *)all;
    const bool sends = rank < e->senders_count, takes = rank < e->takers_count;
    NEEDS_MEMORY(all);
    t->from = *g->from;
    t->to = *g->to;
    t->address_type = g->address->type;
    t->type = g->source->type;
    t->same = e->same ? e->same->imm : t->same;
    t->is_same = e->same != NULL;
    t->bytes = e->bytes;
    t->address = sends ? number_of(g->address->buffer, rank) : 0;
    t->context = sends && !g->all ? number_of(g->context->buffer, rank) : 0;
    t->source = (e->gets ? takes : sends) && !e->same ? number_of(g->source->buffer, rank) : 0;
    t->out = (e->gets ? sends : takes) ? number_of(e->out, rank) : 0;
    t->arrived = takes && e->arrived ? number_of(e->arrived, rank) : 0;
    t->mask = g->mask;
    t->combiner = (uint32_t)e->combiner;
    t->senders = e->senders_count;
    t->takers = e->takers_count;
    t->gets = e->gets;
    t->all = g->all;
    t->looks_beyond = e->senders[0].route.beyond != NULL;
    for (size_t i = 0; i < senders; i++, at += sizeof(struct share))
        memcpy(at, &e->senders[i].share, sizeof(struct share));
    memcpy(at, e->takers, takers * sizeof(struct share));
    ranks_command(rank, (struct ranks_command){RANKS_ROUTE, (uint32_t)bytes, {0}}, all);
    free(all);
}

void all_to_all_far(struct exchange *e)
{
    const int most = e->senders_count > e->takers_count ? e->senders_count : e->takers_count;
    for (int i = 1; i < most; i++)
        tell(e, i);
    ranks_flush();
    part_do(e, 0);
}

/* ---- other ranks ---- */

/* What an exchange refers to there. */
struct there {
    struct told told;
    struct message g;
    struct machine_value address, context, source;
    struct exchange e;
};

static void values_set(struct there *t, const struct far_table *arrays)
{
    const struct told *of = &t->told;
    t->address = (struct machine_value){.op = NODE_BUFFER,
                                        .type = of->address_type,
                                        .buffer = far_table_of(arrays, of->address)};
    t->context = (struct machine_value){
        .op = NODE_BUFFER, .type = MACHINE_BIT, .buffer = far_table_of(arrays, of->context)};
    t->source = (struct machine_value){.op = of->is_same ? NODE_CONSTANT : NODE_BUFFER,
                                       .type = of->type,
                                       .imm = of->same,
                                       .buffer = far_table_of(arrays, of->source)};
    t->g = (struct message){.from = &of->from,
                            .to = &of->to,
                            .address = &t->address,
                            .context = &t->context,
                            .source = &t->source,
                            .all = of->all,
                            .mask = of->mask};
    t->e = (struct exchange){.g = &t->g,
                             .combiner = (enum machine_combiner)of->combiner,
                             .gets = of->gets,
                             .same = of->is_same ? &t->source : NULL,
                             .bytes = of->bytes,
                             .out = far_table_of(arrays, of->out),
                             .arrived = far_table_of(arrays, of->arrived),
                             .senders_count = of->senders,
                             .takers_count = of->takers};
}

/* Whether the rank has what its part needs. */
static bool part_good(const struct there *t, int mine)
{
    const struct exchange *e = &t->e;
    const bool sends = mine < e->senders_count, takes = mine < e->takers_count,
               reads = !e->same && (e->gets ? takes : sends), writes = e->gets ? sends : takes;
    return (!sends || (t->address.buffer && (t->g.all || t->context.buffer))) &&
           (!reads || t->source.buffer) && (!writes || e->out);
}

static void sender_set(struct machine *m, struct there *t, int mine)
{
    struct exchange *e = &t->e;
    struct sender *s = &e->senders[mine];
    e->route = message_route(m, &t->g, false);
    e->route.crew = NULL;
    e->route.parts = 1;
    if (mine >= e->senders_count)
        return;
    s->address.host =
        exchange_host(t->address.buffer, &s->share, mine, type_bytes(t->address.type));
    s->context.host = t->g.all ? NULL : exchange_host(t->context.buffer, &s->share, mine, 1);
    s->source =
        e->gets || e->same ? NULL : exchange_host(t->source.buffer, &s->share, mine, e->bytes);
    s->route = e->route;
    s->route.from = &s->share.set;
    s->route.address = &s->address;
    s->route.context = t->g.all ? NULL : &s->context;
    s->route.beyond = t->told.looks_beyond ? &e->beyond : NULL;
}

bool all_to_all_told(struct machine *m, const struct far_table *arrays, const void *told,
                     size_t bytes)
{
    static struct there t;
    const unsigned char *at = (const unsigned char *)told + sizeof t.told;
    const int mine = ranks_mine();
    if (bytes < sizeof t.told)
        return false;
    memcpy(&t.told, told, sizeof t.told);
    values_set(&t, arrays);
    struct exchange *e = &t.e;
    if (e->senders_count < 1 || e->senders_count > RANKS_MOST || e->takers_count < 1 ||
        e->takers_count > RANKS_MOST || !part_good(&t, mine) ||
        bytes !=
            sizeof t.told + (size_t)(e->senders_count + e->takers_count) * sizeof(struct share))
        return false;
    e->senders = calloc((size_t)e->senders_count, sizeof *e->senders);
    e->takers = calloc((size_t)e->takers_count, sizeof *e->takers);
    e->mail = calloc((size_t)(e->senders_count * e->takers_count), sizeof *e->mail);
    NEEDS_MEMORY(e->senders && e->takers && e->mail);
    for (int i = 0; i < e->senders_count; i++, at += sizeof(struct share))
        memcpy(&e->senders[i].share, at, sizeof(struct share));
    memcpy(e->takers, at, (size_t)e->takers_count * sizeof(struct share));
    const bool good = !device_settle(m);
    if (good) {
        sender_set(m, &t, mine);
        part_do(e, mine);
    }
    exchange_free(e);
    return good;
}
