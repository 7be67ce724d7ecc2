/* all_to_all.c - see all_to_all.h. */
#include "ops/all_to_all.h"

#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/types.h"
#include "ops/near.h"
#include "run/run.h"
#include "sequencers/sequencers.h"

enum { READ = 4 }; /* arrays that messages read */

typedef unsigned __int128 u128;

/* A block's own part of a set, or a set that is not cut. */
struct share {
    struct vpset set;
    size_t skip;    /* elements of its arrays before its first row */
    uint64_t first; /* the index in the whole set of its first processor */
};

/* From one share to another, in the order of the senders. */
struct mail {
    size_t count, room;
    uint32_t *index; /* in the share that it goes to */
    uint32_t *place; /* of a get: where the element is wanted, in the getter's array */
    char *elements;
};

/* What messages of a share are sorted by. */
struct sender {
    struct share share;
    struct device_buffer address, context; /* only where these are for the front end */
    struct near_route route;               /* to the whole set */
    const char *source;
};

struct exchange {
    const struct message *g;
    enum machine_combiner combiner;
    bool gets;
    const struct machine_value *same; /* the number that all send; NULL: elements travel */
    size_t bytes;                     /* of an element */
    struct device_buffer *out, *arrived;
    struct crew *crew; /* NULL: there is too little work to be shared out */
    int senders_count, takers_count;
    struct sender *senders;
    struct share *takers;
    struct mail *mail; /* from sender i to taker k: [i * takers_count + k] */
    atomic_bool beyond, failed;
};

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

/* ---- shares ---- */

static int shares_of(struct machine *m, int set)
{
    return sequencers_cut(m, set) ? m->sequencers->count : 1;
}

/* What is beside the only row of a set with one axis are its neighbours' processors, and not
 * its other end: so it has no halo. */
static struct share share_of(struct machine *m, int set, int block)
{
    if (!sequencers_cut(m, set))
        return (struct share){.set = m->values->sets[set]};
    const struct band band = sequencers_band(m, set, block);
    struct share s = {
        .set = band.set, .skip = band.at - (size_t)band.set.halo, .first = band.index};
    if (band.set.rank == 1) {
        s.skip = band.at;
        s.set.halo = 0;
    }
    return s;
}

/* Where its first row is in an array of its set. */
static char *share_host(const struct device_buffer *b, const struct share *s, int i,
                        size_t element)
{
    return (char *)(b->blocks ? b->blocks->of[i] : b)->host + s->skip * element;
}

/* ---- what messages read ---- */

/* The arrays of the senders' set, and then that of the others'; NULL: there is none. */
static void arrays_read(const struct message *g, bool gets, struct machine_value *of[READ])
{
    of[0] = g->address;
    of[1] = g->all ? NULL : g->context;
    of[2] = !gets && g->source && g->source->buffer ? g->source : NULL;
    of[3] = gets ? g->source : g->fills ? NULL : g->old;
}

/* Places are numbers of 32 bits. */
static bool is_near(const struct machine *m, const struct vpset *s)
{
    return m->settings.near && m->device->is_pocl && s->rows * s->pitch < UINT32_MAX;
}

enum machine_status all_to_all_arrange(struct machine *m, const struct message *g, bool gets,
                                       bool *in_blocks)
{
    struct machine_value *of[READ];
    arrays_read(g, gets, of);
    *in_blocks = false;
    if (!sequencers_have(m, of, READ))
        return MACHINE_OK;
    *in_blocks = sequencers_are_near(m) && is_near(m, g->from) && is_near(m, g->to);
    for (int i = 0; i < READ; i++) {
        const int set = i < READ - 1 ? g->from_set : g->to_set;
        if (!of[i] || (*in_blocks && !sequencers_cut(m, set)))
            continue;
        if (*in_blocks ? sequencers_divide(m, of[i]->buffer, set, of[i]->type, 0)
                       : sequencers_whole(m, of[i]->buffer))
            return m->status;
    }
    return MACHINE_OK;
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

static void part_sort(void *of, int part, int worker)
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
static void part_deliver(void *of, int part, int worker)
{
    struct exchange *e = of;
    const struct share *to = &e->takers[part];
    struct device_buffer out = {.host = share_host(e->out, to, part, e->bytes)},
                         arrived = {.host = e->arrived ? share_host(e->arrived, to, part, 1)
                                                       : NULL};
    (void)worker;
    for (int i = 0; i < e->senders_count; i++) {
        const struct mail *q = &e->mail[i * e->takers_count + part];
        const struct vpset from = {
            .rows = 1, .count = q->count, .width = (int)q->count, .pitch = q->count};
        struct device_buffer index = {.host = q->index}, elements = {.host = q->elements};
        const struct machine_value source = {.op = NODE_BUFFER, .buffer = &elements};
        struct near_route r = e->senders[i].route;
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
static void part_answer(void *of, int part, int worker)
{
    struct exchange *e = of;
    const struct share *to = &e->takers[part];
    const struct vpset *s = &to->set;
    const struct lanes_rows rows = {(uint32_t)s->width, (uint32_t)s->halo,
                                    (uint32_t)(s->pitch - (size_t)s->width)};
    const char *from = share_host(e->g->source->buffer, to, part, e->bytes);
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
            e->senders[i].route.lanes->places(q->index, q->count, &rows);
        places_pick(e->bytes, q->elements,
                    from + (s->rows > 1 ? 0 : (size_t)s->halo * e->bytes), q->index, q->count);
    }
}

/* Nobody answers who does not exist: 0. */
static void part_take(void *of, int part, int worker)
{
    struct exchange *e = of;
    const struct share *share = &e->senders[part].share;
    const struct vpset *s = &share->set;
    const struct mail *mail = &e->mail[part * e->takers_count];
    struct device_buffer out = {.host = share_host(e->out, share, part, e->bytes)};
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

/* ---- exchanges ---- */

static void senders_make(struct machine *m, struct exchange *e)
{
    const struct message *g = e->g;
    for (int i = 0; i < e->senders_count; i++) {
        struct sender *s = &e->senders[i];
        s->share = share_of(m, g->from_set, i);
        s->address.host =
            share_host(g->address->buffer, &s->share, i, type_bytes(g->address->type));
        s->context.host = g->all ? NULL : share_host(g->context->buffer, &s->share, i, 1);
        s->source = e->gets || e->same || !g->source
                        ? NULL
                        : share_host(g->source->buffer, &s->share, i, e->bytes);
        s->route = message_route(m, g, false);
        s->route.from = &s->share.set;
        s->route.address = &s->address;
        s->route.context = g->all ? NULL : &s->context;
        s->route.crew = NULL;
        s->route.parts = 1;
        s->route.beyond = e->gets || m->run->beyond_told ? NULL : &e->beyond;
    }
    for (int k = 0; k < e->takers_count; k++)
        e->takers[k] = share_of(m, g->to_set, k);
}

/* False: error set. */
static bool exchange_begin(struct machine *m, struct exchange *e, const struct message *g,
                           bool gets)
{
    e->g = g;
    e->gets = gets;
    e->same = g->source && !g->source->buffer ? g->source : NULL;
    e->bytes = g->source ? type_bytes(g->source->type) : 0;
    e->senders_count = shares_of(m, g->from_set);
    e->takers_count = shares_of(m, g->to_set);
    e->crew = device_parts(m, 1e-9 * m->device->shape.send_ns * (double)g->from->count) > 1
                  ? m->device->crew
                  : NULL;
    e->senders = calloc((size_t)e->senders_count, sizeof *e->senders);
    e->takers = calloc((size_t)e->takers_count, sizeof *e->takers);
    e->mail = calloc((size_t)(e->senders_count * e->takers_count), sizeof *e->mail);
    if (e->senders && e->takers && e->mail) {
        senders_make(m, e);
        return true;
    }
    machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for messages");
    return false;
}

/* The result, unless something went wrong. */
static struct device_buffer *exchange_end(struct machine *m, struct exchange *e, bool good)
{
    for (int i = 0; e->mail && i < e->senders_count * e->takers_count; i++) {
        free(e->mail[i].index);
        free(e->mail[i].place);
        free(e->mail[i].elements);
    }
    free(e->mail);
    free(e->takers);
    free(e->senders);
    if (e->failed)
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for messages");
    if (good && !e->failed) {
        m->sequencers->run++;
        return e->out;
    }
    if (e->out)
        device_buffer_unref(m, e->out);
    return NULL;
}

/* Waits for what is in the queue. *start: see near_begin(). */
static bool array_is_near(struct machine *m, const struct device_buffer *b, double *start)
{
    return near_begin(m, b->blocks ? b->blocks->of[0] : b, start);
}

/* ---- arrays ---- */

/* With any numbers; NULL: error set. */
static struct device_buffer *array_new(struct machine *m, int set, struct machine_type type)
{
    struct device_buffer *b = sequencers_cut(m, set)
                                  ? sequencers_array_full(m, set, type)
                                  : message_array(m, &m->values->sets[set], type);
    if (b && b->blocks)
        b->blocks->valid = 0;
    return b;
}

static struct device_buffer *nothing_arrived(struct machine *m, int set)
{
    const unsigned char none = 0;
    struct device_buffer *b = array_new(m, set, MACHINE_BIT);
    const int count = b && b->blocks ? b->blocks->count : 1;
    for (int i = 0; b && i < count; i++)
        if (device_fill(m, b->blocks ? b->blocks->of[i] : b, &none, 1, "sending")) {
            device_buffer_unref(m, b);
            return NULL;
        }
    return b;
}

/* What messages are written over. */
static struct device_buffer *array_old(struct machine *m, const struct message *g)
{
    const struct device_buffer *old = g->old->buffer;
    if (!g->fills && old->blocks) {
        struct device_buffer *copy = sequencers_copy(m, old);
        if (copy)
            copy->blocks->valid = 0;
        return copy;
    }
    struct device_buffer *b = array_new(m, g->to_set, g->source->type);
    if (b && !g->fills &&
        device_copy(m, old, b, geometry_bytes(g->to, g->source->type), "sending")) {
        device_buffer_unref(m, b);
        return NULL;
    }
    return b;
}

struct device_buffer *all_to_all_send(struct machine *m, const struct message *g,
                                      enum machine_combiner combiner,
                                      struct device_buffer **arrived)
{
    struct exchange e = {.combiner = combiner};
    double start;
    const bool good = exchange_begin(m, &e, g, false) && (e.out = array_old(m, g)) &&
                      (!arrived || (e.arrived = nothing_arrived(m, g->to_set))) &&
                      array_is_near(m, e.out, &start);
    if (good) {
        crew_run(e.crew, e.senders_count, part_sort, &e);
        if (!e.failed)
            crew_run(e.crew, e.takers_count, part_deliver, &e);
        near_end(m, "sending", start);
        m->run->sent_beyond = m->run->sent_beyond || e.beyond;
    }
    struct device_buffer *out = exchange_end(m, &e, good);
    if (arrived)
        *arrived = e.arrived;
    if (!out && e.arrived)
        device_buffer_unref(m, e.arrived);
    return out;
}

struct device_buffer *all_to_all_get(struct machine *m, const struct message *g)
{
    struct exchange e = {0};
    double start;
    const bool good = exchange_begin(m, &e, g, true) &&
                      (e.out = array_new(m, g->from_set, g->source->type)) &&
                      array_is_near(m, e.out, &start);
    if (good) {
        crew_run(e.crew, e.senders_count, part_sort, &e);
        if (!e.failed)
            crew_run(e.crew, e.takers_count, part_answer, &e);
        if (!e.failed)
            crew_run(e.crew, e.senders_count, part_take, &e);
        near_end(m, "getting", start);
    }
    return exchange_end(m, &e, good);
}

enum machine_status all_to_all_wrong(struct machine *m, const struct message *g,
                                     uint64_t *wrong)
{
    struct exchange e = {0};
    double start;
    const bool good =
        exchange_begin(m, &e, g, false) && array_is_near(m, g->address->buffer, &start);
    if (good) {
        for (int i = 0; i < e.senders_count; i++)
            *wrong += near_wrong(&e.senders[i].route);
        near_end(m, "checking addresses", start);
    }
    exchange_end(m, &e, good);
    return good ? MACHINE_OK : m->status;
}
