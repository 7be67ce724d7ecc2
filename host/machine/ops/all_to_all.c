/* all_to_all.c - see all_to_all.h. */
#include "ops/all_to_all.h"

#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/types.h"
#include "ops/all_to_all_far.h"
#include "ops/exchange.h"
#include "ops/near.h"
#include "run/run.h"
#include "sequencers/sequencers.h"

enum { READ = 4 }; /* arrays that messages read */

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
                                       bool far_too, bool *in_blocks)
{
    struct machine_value *of[READ];
    arrays_read(g, gets, of);
    *in_blocks = false;
    if (!sequencers_have(m, of, READ))
        return MACHINE_OK;
    *in_blocks = (sequencers_are_near(m) || (far_too && m->sequencers->far_near)) &&
                 is_near(m, g->from) && is_near(m, g->to);
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

/* ---- exchanges ---- */

static void senders_make(struct machine *m, struct exchange *e)
{
    const struct message *g = e->g;
    e->route = message_route(m, g, false);
    e->route.crew = NULL; /* it does this work, and takes no other meanwhile */
    e->route.parts = 1;
    for (int i = 0; i < e->senders_count; i++) {
        struct sender *s = &e->senders[i];
        s->share = share_of(m, g->from_set, i);
        s->address.host =
            exchange_host(g->address->buffer, &s->share, i, type_bytes(g->address->type));
        s->context.host = g->all ? NULL : exchange_host(g->context->buffer, &s->share, i, 1);
        s->source = e->gets || e->same || !g->source
                        ? NULL
                        : exchange_host(g->source->buffer, &s->share, i, e->bytes);
        s->route = e->route;
        s->route.from = &s->share.set;
        s->route.address = &s->address;
        s->route.context = g->all ? NULL : &s->context;
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
    exchange_free(e);
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
        if (m->sequencers->far)
            all_to_all_far(&e);
        else
            crew_run(e.crew, e.senders_count, exchange_sort, &e);
        if (!m->sequencers->far && !e.failed)
            crew_run(e.crew, e.takers_count, exchange_deliver, &e);
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
    if (good && m->sequencers->far)
        all_to_all_far(&e);
    else if (good) {
        crew_run(e.crew, e.senders_count, exchange_sort, &e);
        if (!e.failed)
            crew_run(e.crew, e.takers_count, exchange_answer, &e);
        if (!e.failed)
            crew_run(e.crew, e.senders_count, exchange_take, &e);
    }
    if (good) {
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
