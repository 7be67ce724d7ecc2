/* exchange.c - what a sender and a taker do: see exchange.h. */
#include "ops/exchange.h"

#include <stdlib.h>
#include <string.h>

typedef unsigned __int128 u128;

char *exchange_host(const struct device_buffer *b, const struct share *s, int i, size_t element)
{
    char *host = (b->blocks ? b->blocks->of[i] : b)->host;
    return host ? host + s->skip * element : NULL;
}

void exchange_free(struct exchange *e)
{
    for (int i = 0; e->mail && i < e->senders_count * e->takers_count; i++) {
        free(e->mail[i].index);
        free(e->mail[i].place);
        free(e->mail[i].elements);
    }
    free(e->mail);
    free(e->takers);
    free(e->senders);
}

/* ---- elements ---- */

#define BY_BYTES(bytes, LOOP)                                                                  \
    switch (bytes) {                                                                           \
    case 1:                                                                                    \
        LOOP(uint8_t)                                                                          \
        break;                                                                                 \
    case 2:                                                                                    \
        LOOP(uint16_t)                                                                         \
        break;                                                                                 \
    case 4:                                                                                    \
        LOOP(uint32_t)                                                                         \
        break;                                                                                 \
    case 8:                                                                                    \
        LOOP(uint64_t)                                                                         \
        break;                                                                                 \
    default:                                                                                   \
        LOOP(u128)                                                                             \
    }

#define PICK(T)                                                                                \
    for (size_t i = 0; i < count; i++)                                                         \
        ((T *)(void *)to)[i] = ((const T *)(const void *)from)[at[i]];

#define PUT(T)                                                                                 \
    for (size_t i = 0; i < count; i++)                                                         \
        ((T *)(void *)to)[at[i]] = ((const T *)(const void *)from)[i];

static void lanes_pick(size_t bytes, char *to, const char *from, const uint16_t *at,
                       size_t count)
{
    BY_BYTES(bytes, PICK)
}

static void places_pick(size_t bytes, char *to, const char *from, const uint32_t *at,
                        size_t count)
{
    BY_BYTES(bytes, PICK)
}

static void places_put(size_t bytes, char *to, const char *from, const uint32_t *at,
                       size_t count)
{
    BY_BYTES(bytes, PUT)
}

/* ---- sorting ---- */

static bool mail_grows(const struct exchange *e, struct mail *q, size_t more)
{
    if (q->count + more <= q->room)
        return true;
    const size_t room = 2 * q->room + more + ROUTE_BLOCK;
    uint32_t *index = realloc(q->index, room * sizeof *index);
    q->index = index ? index : q->index;
    uint32_t *place = e->gets && index ? realloc(q->place, room * sizeof *place) : NULL;
    q->place = place ? place : q->place;
    const bool carries = !e->gets && !e->same;
    char *elements = carries && index ? realloc(q->elements, room * e->bytes) : NULL;
    q->elements = elements ? elements : q->elements;
    if (!index || (e->gets && !place) || (carries && !elements))
        return false;
    q->room = room;
    return true;
}

/* Those of n senders, from that element on, whose messages go to a share. */
static bool mail_add(const struct exchange *e, const struct sender *from,
                     const struct share *to, const uint32_t *index, size_t at, int n,
                     struct mail *q)
{
    const struct near_route *r = &from->route;
    const uint8_t *context = r->context ? (const uint8_t *)r->context->host + at : NULL;
    const struct lanes_filter by = {index, (uint32_t)to->first, (uint32_t)to->set.count,
                                    (uint32_t)(0 - to->first)};
    uint32_t there[ROUTE_BLOCK + 16];
    uint16_t lane[ROUTE_BLOCK + 16];
    const size_t count = r->lanes->filter(&by, context, n, there, lane);
    if (!count)
        return true;
    if (!mail_grows(e, q, count))
        return false;
    memcpy(q->index + q->count, there, count * sizeof *there);
    for (size_t i = 0; e->gets && i < count; i++)
        q->place[q->count + i] = (uint32_t)at + lane[i];
    if (from->source)
        lanes_pick(e->bytes, q->elements + q->count * e->bytes, from->source + at * e->bytes,
                   lane, count);
    q->count += count;
    return true;
}

void exchange_sort(void *of, int part, int worker)
{
    struct exchange *e = of;
    const struct sender *from = &e->senders[part];
    const struct vpset *s = &from->share.set;
    struct mail *mail = &e->mail[part * e->takers_count];
    uint32_t index[ROUTE_BLOCK];
    bool good = true;
    (void)worker;
    for (uint64_t row = 0; row < s->rows && good; row++)
        for (int x = 0; x < s->width && good; x += ROUTE_BLOCK) {
            const int n = s->width - x < ROUTE_BLOCK ? s->width - x : ROUTE_BLOCK;
            const size_t at = (size_t)row * s->pitch + (size_t)s->halo + (size_t)x;
            near_addresses(&from->route, at, n, index);
            near_look_beyond(&from->route, at, n, index);
            for (int k = 0; k < e->takers_count && good; k++)
                good = mail_add(e, from, &e->takers[k], index, at, n, &mail[k]);
        }
    if (!good)
        atomic_store(&e->failed, true);
}

/* ---- delivery ---- */

/* What a share's mail comes to, sender by sender. */
void exchange_deliver(void *of, int part, int worker)
{
    struct exchange *e = of;
    const struct share *to = &e->takers[part];
    struct device_buffer out = {.host = exchange_host(e->out, to, part, e->bytes)},
                         arrived = {.host = e->arrived ? exchange_host(e->arrived, to, part, 1)
                                                       : NULL};
    (void)worker;
    for (int i = 0; i < e->senders_count; i++) {
        const struct mail *q = &e->mail[i * e->takers_count + part];
        const struct vpset from = {
            .rows = 1, .count = q->count, .width = (int)q->count, .pitch = q->count};
        struct device_buffer index = {.host = q->index}, elements = {.host = q->elements};
        const struct machine_value source = {.op = NODE_BUFFER, .buffer = &elements};
        struct near_route r = e->route;
        r.from = &from;
        r.to = &to->set;
        r.address = &index;
        r.context = NULL;
        r.address_bytes = sizeof *q->index;
        r.mask = UINT32_MAX;
        r.there = true;
        r.distinct = false;
        r.beyond = NULL;
        if (q->count)
            near_send(&r, e->combiner, e->g->source->type, e->same ? e->same : &source, &out,
                      e->arrived ? &arrived : NULL);
    }
}

/* What the others want of a share. */
void exchange_answer(void *of, int part, int worker)
{
    struct exchange *e = of;
    const struct share *to = &e->takers[part];
    const struct vpset *s = &to->set;
    const struct lanes_rows rows = {(uint32_t)s->width, (uint32_t)s->halo,
                                    (uint32_t)(s->pitch - (size_t)s->width)};
    const char *from = exchange_host(e->g->source->buffer, to, part, e->bytes);
    (void)worker;
    for (int i = 0; i < e->senders_count; i++) {
        struct mail *q = &e->mail[i * e->takers_count + part];
        if (!q->count)
            continue;
        q->elements = malloc(q->count * e->bytes);
        if (!q->elements) {
            atomic_store(&e->failed, true);
            return;
        }
        if (s->rows > 1)
            e->route.lanes->places(q->index, q->count, &rows);
        places_pick(e->bytes, q->elements,
                    from + (s->rows > 1 ? 0 : (size_t)s->halo * e->bytes), q->index, q->count);
    }
}

/* Nobody answers who does not exist: 0. */
void exchange_take(void *of, int part, int worker)
{
    struct exchange *e = of;
    const struct share *share = &e->senders[part].share;
    const struct vpset *s = &share->set;
    const struct mail *mail = &e->mail[part * e->takers_count];
    struct device_buffer out = {.host = exchange_host(e->out, share, part, e->bytes)};
    size_t answers = 0;
    (void)worker;
    for (int k = 0; k < e->takers_count; k++)
        answers += mail[k].count;
    for (uint64_t row = 0; row < s->rows && answers < s->count; row++)
        memset((char *)out.host + (row * s->pitch + (size_t)s->halo) * e->bytes, 0,
               (size_t)s->width * e->bytes);
    for (int k = 0; k < e->takers_count; k++)
        places_put(e->bytes, out.host, mail[k].elements, mail[k].place, mail[k].count);
    near_rows_repeat(s, e->bytes, &out);
}
