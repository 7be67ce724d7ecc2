/* router.c - messages to other processors: see kernels/router.cl.
 *
 * With a combiner, or on a device of few compute units, the destinations are shared out among
 * as many work-items as the device has units (on a GPU some thousands). Each work-item passes
 * over all senders in order. So there are no atomics, any type is possible, and float sums have
 * a fixed order.
 *
 * Otherwise a send is three passes: each sender writes its index to its destination; senders
 * that find a lower index there correct it with an atomic maximum; each destination fetches
 * its owner's message. So collisions have the same result on every device.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "kernels.h"
#include "machine_told.h"
#include "memory/call_set.h"
#include "memory/memory.h"
#include "ops/all_to_all.h"
#include "ops/gets.h"
#include "ops/index.h"
#include "ops/message.h"
#include "ops/near.h"
#include "run/evaluate.h"
#include "run/materialise.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"
#include "values/make.h"

enum { NO_PROCESSOR = -2 };

/* element NULL: no elements are moved. Kernels that also move elements are specialised for
 * flat sets. */
static void address_options(char *out, size_t size, const struct message *g,
                            const struct machine_value *element)
{
    size_t bytes = type_bytes(g->address->type);
    int n = snprintf(out, size, "-DFLAT=%d -DADDRESS=%s -DLOW=%s", g->flat && element,
                     call_element(bytes), bytes == 16 ? ".x" : "");
    if (element && n > 0)
        snprintf(out + n, size - (size_t)n, " -DELEMENT=%s",
                 call_element(type_bytes(element->type)));
}

static enum machine_status zero_fill(struct machine *m, const struct device_buffer *b)
{
    cl_uint zero = 0;
    return device_fill(m, b, &zero, sizeof zero, "sending");
}

/* Runs "claim" or "route", which give a number for each destination, or for each sender. */
static struct device_buffer *addresses_pass(struct machine *m, const struct message *g,
                                            const char *name)
{
    char options[96];
    bool claims = name[0] == 'c';
    size_t bytes = (claims ? g->to : g->from)->count * sizeof(cl_uint);
    struct device_buffer *b = device_buffer_get(m, bytes);
    if (!b)
        return NULL;
    address_options(options, sizeof options, g, NULL);
    enum machine_status status = claims ? zero_fill(m, b) : MACHINE_OK;
    for (uint64_t pass = claims && !m->device->is_cpu; pass < (claims ? 2 : 1) && !status;
         pass++) {
        struct kernel_call c = call_begin(m, kernel_router_cl, options, name);
        call_layout(&c, g->from);
        call_uint(&c, call_run(m));
        call_uint(&c, g->mask);
        call_uint(&c, g->to->count);
        call_uint(&c, g->all);
        if (claims)
            call_uint(&c, pass);
        call_buffer(&c, g->address->buffer);
        call_buffer(&c, g->context->buffer);
        call_buffer(&c, b);
        status = call_over(&c, m, g->from, "sending");
    }
    if (status) {
        device_buffer_unref(m, b);
        return NULL;
    }
    return b;
}

/* Writes the halos, the columns that repeat the other end. */
static enum machine_status edges(struct machine *m, const struct vpset *s,
                                 struct machine_type type, const struct device_buffer *out)
{
    char options[64];
    if (!s->halo)
        return MACHINE_OK;
    snprintf(options, sizeof options, "-DFLAT=0 -DELEMENT=%s", call_element(type_bytes(type)));
    struct kernel_call c = call_begin(m, kernel_router_cl, options, "edges");
    call_layout(&c, s);
    call_buffer(&c, out);
    return call_start(&c, m, 1, (size_t)s->rows, "sending");
}

static enum machine_status deliver(struct machine *m, const struct message *g,
                                   const struct device_buffer *owner,
                                   const struct device_buffer *out)
{
    char options[64];
    snprintf(options, sizeof options, "-DFLAT=0 -DELEMENT=%s",
             call_element(type_bytes(g->source->type)));
    struct kernel_call c = call_begin(m, kernel_router_cl, options, "deliver");
    call_layout(&c, g->to);
    call_uint(&c, call_run(m));
    call_layout(&c, g->from);
    call_buffer(&c, owner);
    call_buffer(&c, g->source->buffer);
    call_buffer(&c, g->old->buffer);
    call_buffer(&c, out);
    enum machine_status status = call_over(&c, m, g->to, "sending");
    return status ? status : edges(m, g->to, g->source->type, out);
}

/* The number of work-items that share out the destinations. */
static size_t shares(const struct machine *m, const struct vpset *to)
{
    size_t count = (size_t)(m->device->shape.send_shares ? m->device->shape.send_shares
                                                         : m->device->units);
    return count < to->count ? count : (size_t)to->count;
}

static bool scatters(const struct machine *m)
{
    if (m->settings.scatter != SETTING_FREE)
        return m->settings.scatter;
    return m->device->units <= m->device->shape.scatter_units;
}

/* out already contains the old dest. */
static enum machine_status scatter(struct machine *m, const struct message *g,
                                   const struct device_buffer *out,
                                   const struct device_buffer *owner, bool notifies)
{
    char options[128];
    struct machine_type type = g->source->type;
    size_t count = shares(m, g->to), share = ((size_t)g->to->count + count - 1) / count;
    address_options(options, sizeof options, g, g->source);
    struct kernel_call c = call_begin(m, kernel_router_cl, options, "scatter");
    call_layout(&c, g->from);
    call_uint(&c, g->from->rows);
    call_uint(&c, g->mask);
    call_uint(&c, g->to->count);
    call_layout(&c, g->to);
    call_uint(&c, g->all);
    call_uint(&c, share);
    call_uint(&c, notifies);
    call_uint(&c, geometry_bytes(g->to, type) / type_bytes(type));
    call_buffer(&c, g->address->buffer);
    call_buffer(&c, g->context->buffer);
    call_buffer(&c, g->source->buffer);
    call_buffer(&c, out);
    call_buffer(&c, owner);
    enum machine_status status = call_start(&c, m, count, 1, "sending");
    return status ? status : edges(m, g->to, type, out);
}

static void combine_options(char *out, size_t size, const struct message *g)
{
    struct machine_type type = g->source->type;
    size_t bytes = type_bytes(type);
    if (type.kind == MACHINE_FLOAT)
        snprintf(out, size, "-DFLAT=0 -DELEMENT=%s -DKIND=1 -DCANONICAL=%s",
                 type.width == 32 ? "float" : "double",
                 type.width == 32 ? "as_float(0xffc00000u)"
                                  : "as_double(0xfff8000000000000UL)");
    else
        snprintf(out, size, "-DFLAT=0 -DELEMENT=%s -DKIND=%d", call_element(bytes),
                 bytes == 16 ? 2 : 0);
}

/* out already contains the old dest. */
static enum machine_status combine(struct machine *m, const struct message *g, int op,
                                   const struct device_buffer *to, struct machine_type type,
                                   const struct device_buffer *out,
                                   const struct device_buffer *owner, bool notifies)
{
    char options[160];
    combine_options(options, sizeof options, g);
    struct kernel_call c = call_begin(m, kernel_router_cl, options, "combine");
    size_t count = shares(m, g->to), share = ((size_t)g->to->count + count - 1) / count;
    call_layout(&c, g->to);
    call_layout(&c, g->from);
    call_uint(&c, (uint64_t)op);
    call_uint(&c, g->from->count);
    call_uint(&c, share);
    call_uint(&c, notifies);
    call_uint(&c, m->device->is_cpu ? geometry_bytes(g->to, type) / type_bytes(type) : 0);
    call_scalar(&c, scalar_sign(type.width));
    call_scalar(&c, scalar_ones(type.width));
    call_buffer(&c, to);
    call_buffer(&c, g->source->buffer);
    call_buffer(&c, out);
    call_buffer(&c, owner);
    enum machine_status status = call_start(&c, m, count, 1, "sending");
    return status ? status : edges(m, g->to, type, out);
}

/* The notification bits; NULL: error set. */
static struct machine_value *arrivals(struct machine *m, const struct message *g,
                                      const struct device_buffer *owner)
{
    struct device_buffer *b = message_array(m, g->to, MACHINE_BIT);
    if (!b)
        return NULL;
    struct kernel_call c = call_begin(m, kernel_router_cl, "-DFLAT=0", "arrived");
    call_layout(&c, g->to);
    call_uint(&c, call_run(m));
    call_buffer(&c, owner);
    call_buffer(&c, b);
    if (call_over(&c, m, g->to, "sending") || edges(m, g->to, MACHINE_BIT, b)) {
        device_buffer_unref(m, b);
        return NULL;
    }
    return graph_buffer_node(m, MACHINE_BIT, g->to_set, b);
}

/* By kernels. out has room for what is thrown away. */
static enum machine_status transmit_far(struct machine *m, const struct message *g,
                                        enum machine_combiner combiner,
                                        struct device_buffer *out, size_t bytes,
                                        struct machine_value **notification)
{
    struct machine_type type = g->source->type;
    struct device_buffer *owner = NULL, *to = NULL;
    bool notifies = notification, combines = combiner != MACHINE_COMBINE_OVERWRITE,
         in_order = combines || scatters(m);
    enum machine_status status = MACHINE_OK;
    if (in_order) {
        owner = device_buffer_get(m, notifies ? g->to->count * sizeof(cl_uint) : 4);
        status = owner ? device_copy(m, g->old->buffer, out, bytes, "sending") : m->status;
        if (!status && notifies)
            status = zero_fill(m, owner);
    }
    if (!status && combines) {
        to = addresses_pass(m, g, "route");
        status = to ? combine(m, g, (int)combiner, to, type, out, owner, notifies) : m->status;
    } else if (!status && in_order) {
        status = scatter(m, g, out, owner, notifies);
    } else if (!status) {
        owner = addresses_pass(m, g, "claim");
        status = owner ? deliver(m, g, owner, out) : m->status;
    }
    if (!status && notifies) {
        *notification = arrivals(m, g, owner);
        status = *notification ? MACHINE_OK : m->status;
    }
    if (to)
        device_buffer_unref(m, to);
    if (owner)
        device_buffer_unref(m, owner);
    return status;
}

/* How many active senders have the address of no processor, by a kernel; waits. */
static enum machine_status wrong_far(struct machine *m, const struct message *g,
                                     uint64_t *wrong)
{
    struct device_buffer *b = addresses_pass(m, g, "route");
    size_t count = (size_t)m->values->sets[m->values->set_current].count;
    cl_uint *to = b ? malloc(count * sizeof *to) : NULL;
    enum machine_status status = b ? MACHINE_OK : m->status;
    if (b && !to)
        status = machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to check addresses");
    if (!status) {
        double start = device_wait_begin(m);
        cl_int error = clEnqueueReadBuffer(m->device->queue, device_mem(b), CL_TRUE, 0,
                                           count * sizeof *to, to, 0, NULL, NULL);
        status = device_wait_end(m, error, start, "checking addresses");
    }
    for (size_t i = 0; !status && i < count; i++)
        *wrong += to[i] == (cl_uint)NO_PROCESSOR;
    if (b)
        device_buffer_unref(m, b);
    free(to);
    return status;
}

/* Looks whether messages go to no processor. That costs a wait, so it is done for the first
 * sends, and for ever fewer later ones. */
static enum machine_status beyond_look(struct machine *m, const struct message *g)
{
    enum { SENDS_LOOKED_AT = 8 };
    const uint64_t n = ++m->run->sends_far;
    uint64_t wrong = 0;
    if (m->run->beyond_told || (g->known && g->known->there) ||
        (n > SENDS_LOOKED_AT && (n & (n - 1))))
        return MACHINE_OK;
    enum machine_status status = wrong_far(m, g, &wrong);
    m->run->sent_beyond = m->run->sent_beyond || wrong;
    return status;
}

/* From block to block. */
static struct machine_value *transmit_in_blocks(struct machine *m, const struct message *g,
                                                enum machine_combiner combiner,
                                                struct machine_value **notification)
{
    struct device_buffer *arrived = NULL,
                         *out = all_to_all_send(m, g, combiner, notification ? &arrived : NULL);
    if (!out)
        return NULL;
    if (notification)
        *notification = graph_buffer_node(m, MACHINE_BIT, g->to_set, arrived);
    struct machine_value *v = graph_buffer_node(m, g->source->type, g->to_set, out);
    v->strange_nan = g->source->strange_nan || g->old->strange_nan;
    return v;
}

/* notification NULL: nobody wants it. */
static struct machine_value *transmit(struct machine *m, struct message *g,
                                      enum machine_combiner combiner,
                                      struct machine_value **notification)
{
    struct machine_type type = g->source->type;
    struct rows rows = geometry_rows(g->to, type);
    size_t bytes = rows.bytes;
    double start;
    bool in_blocks;
    if (all_to_all_arrange(m, g, false, true, &in_blocks))
        return NULL;
    if (in_blocks)
        return transmit_in_blocks(m, g, combiner, notification);
    struct device_buffer *out = g->over ? g->old->buffer : device_rows_get(m, rows);
    if (g->over)
        device_buffer_ref(out);
    bool near = out && message_near(m, g->to, out, &start);
    if (out && !near) {
        device_buffer_unref(m, out);
        rows.bytes += shares(m, g->to) * 64 * type_bytes(type); /* thrown away */
        out = device_rows_get(m, rows);
    }
    if (out && !near &&
        (!(g->source = materialise(m, g->from_set, g->source)) ||
         !(g->old = materialise(m, g->to_set, g->old)))) {
        device_buffer_unref(m, out);
        return NULL;
    }
    if (!out)
        return NULL;
    enum machine_status status =
        near ? message_send_near(m, g, combiner, out, bytes, start, notification)
             : transmit_far(m, g, combiner, out, bytes, notification);
    if (!near && !status)
        status = beyond_look(m, g);
    if (status) {
        device_buffer_unref(m, out);
        return NULL;
    }
    struct machine_value *v = g->old;
    if (out == v->buffer)
        device_buffer_unref(m, out);
    else
        v = graph_buffer_node(m, type, g->to_set, out);
    v->strange_nan = g->source->strange_nan || g->old->strange_nan;
    return v;
}

static bool address_good(struct machine *m, const struct machine_value *address)
{
    if (!vpset_get(m, m->values->set_current))
        return false;
    if (address->type.kind != MACHINE_BITS)
        machine_fail(m, MACHINE_BAD_ARGUMENT, "a send address is bits");
    else if (address->set && address->set != m->values->set_current)
        machine_fail(m, MACHINE_BAD_ARGUMENT, "the addresses belong to another VP set");
    else
        return true;
    return false;
}

static bool combiner_fits(enum machine_combiner c, struct machine_type type)
{
    switch (c) {
    case MACHINE_COMBINE_OVERWRITE:
        return true;
    case MACHINE_COMBINE_AND:
    case MACHINE_COMBINE_OR:
    case MACHINE_COMBINE_XOR:
    case MACHINE_COMBINE_ADD:
    case MACHINE_COMBINE_UMIN:
    case MACHINE_COMBINE_UMAX:
    case MACHINE_COMBINE_SMIN:
    case MACHINE_COMBINE_SMAX:
        return type.kind == MACHINE_BITS;
    case MACHINE_COMBINE_FADD:
    case MACHINE_COMBINE_FMIN:
    case MACHINE_COMBINE_FMAX:
        return type.kind == MACHINE_FLOAT;
    }
    return false;
}

enum machine_status machine_send(struct machine *m, uint32_t dest,
                                 struct machine_value *send_address,
                                 struct machine_value *source, enum machine_combiner combiner,
                                 uint32_t notify)
{
    struct machine_field_info to, told;
    if (!send_address || !source)
        return m->status;
    if (!address_good(m, send_address))
        return m->status;
    if (!combiner_fits(combiner, source->type))
        return machine_fail(m, MACHINE_BAD_ARGUMENT,
                            "this combination does not take values of this type");
    if (source->set && source->set != m->values->set_current)
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "the messages belong to another VP set");
    if (!machine_field_lookup(m, dest, &to))
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no field %u (any more)", dest);
    if (notify && (!machine_field_lookup(m, notify, &told) || told.vpset != to.vpset))
        return machine_fail(m, MACHINE_BAD_ARGUMENT,
                            "the notification bit is not a field of dest's VP set");
    uint32_t offset;
    const struct field *f = field_find(m, dest, &offset);
    struct message g = {0};
    struct machine_value *old = machine_field_value(m, dest, source->type, MACHINE_EVERYWHERE);
    struct machine_value *const before = old, *notification = NULL, *out = NULL;
    if (!old)
        return m->status;
    if (combiner == MACHINE_COMBINE_OVERWRITE && message_fills(m, send_address, to.vpset)) {
        /* nobody needs the content any more, so it is not computed */
        struct machine_value *none =
            machine_constant(m, source->type, (struct machine_scalar){0, 0});
        if (!none || machine_field_store(m, dest, none, MACHINE_EVERYWHERE))
            return m->status;
        old = none;
    }
    if (combiner == MACHINE_COMBINE_OVERWRITE && !notify &&
        !(m->sequencers && sequencers_cut(m, to.vpset)) &&
        known_ranks_are(m, send_address, to.vpset))
        out = message_pack(m, source, old);
    if (!out && m->status)
        return m->status;
    if (!out && message_make(m, &g, send_address, source, m->values->set_current, old, to.vpset,
                             true, combiner != MACHINE_COMBINE_OVERWRITE)) {
        g.over = message_over(m, &g, f, offset);
        out = transmit(m, &g, combiner, notify ? &notification : NULL);
    }
    enum machine_status status = m->status;
    if (!out) {
        if (old != before)
            machine_field_store(m, dest, before, MACHINE_EVERYWHERE);
        return status;
    }
    status = machine_field_store(m, dest, out, MACHINE_EVERYWHERE);
    if (!status && notify)
        status = machine_field_store(m, notify, notification, MACHINE_EVERYWHERE);
    return status;
}

static struct machine_value *fetched(struct machine *m, const struct message *g,
                                     struct device_buffer *out)
{
    struct machine_value *v = graph_buffer_node(m, g->source->type, g->from_set, out);
    v->strange_nan = g->source->strange_nan;
    return v;
}

static struct machine_value *fetch(struct machine *m, const struct message *g)
{
    char options[128];
    struct machine_type type = g->source->type;
    double start;
    bool in_blocks;
    if (all_to_all_arrange(m, g, true, true, &in_blocks))
        return NULL;
    struct device_buffer *out =
        in_blocks ? all_to_all_get(m, g) : message_array(m, g->from, type);
    if (!out || in_blocks)
        return out ? fetched(m, g, out) : NULL;
    if (message_near(m, g->to, out, &start)) {
        const struct near_route r = message_route(m, g, false);
        near_get(&r, type_bytes(type), g->source->buffer, out);
        near_end(m, "getting", start);
        return fetched(m, g, out);
    }
    address_options(options, sizeof options, g, g->source);
    struct kernel_call c = call_begin(m, kernel_router_cl, options, "fetch");
    call_layout(&c, g->from);
    call_uint(&c, call_run(m));
    call_uint(&c, g->mask);
    call_uint(&c, g->to->count);
    call_layout(&c, g->to);
    call_buffer(&c, g->address->buffer);
    call_buffer(&c, g->source->buffer);
    call_buffer(&c, out);
    if (call_over(&c, m, g->from, "getting") || edges(m, g->from, type, out)) {
        device_buffer_unref(m, out);
        return NULL;
    }
    return fetched(m, g, out);
}

/* Whether a get is messages from block to block: the kernels of a block look into no other. */
static bool gets_from_blocks(struct machine *m, struct machine_value *address, int set)
{
    uint32_t bits;
    return m->sequencers && (sequencers_are_near(m) || m->sequencers->far_near) &&
           m->settings.near && m->device->is_pocl &&
           (sequencers_cut(m, set) || sequencers_cut(m, m->values->set_current)) &&
           !gets_turned(m, address, set, &bits);
}

struct machine_value *machine_get(struct machine *m, struct machine_value *send_address,
                                  uint32_t source, struct machine_type type)
{
    struct machine_field_info from;
    if (!send_address || !address_good(m, send_address))
        return NULL;
    if (!machine_field_lookup(m, source, &from)) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no field %u (any more)", source);
        return NULL;
    }
    struct machine_value *v = machine_field_value(m, source, type, MACHINE_EVERYWHERE);
    if (!v)
        return NULL;
    if (gets_can(m, v, from.vpset) && !gets_from_blocks(m, send_address, from.vpset)) {
        v = graph_same_bits(m, v); /* they are what is in memory */
        v = gets_made(m, send_address, v, from.vpset);
        return machine_reinterpret(m, v, type);
    }
    struct message g = {0};
    bool made =
        message_make(m, &g, send_address, v, from.vpset, NULL, from.vpset, false, false);
    v = made ? fetch(m, &g) : NULL;
    return machine_reinterpret(m, v, type);
}

enum machine_status machine_addresses_check(struct machine *m,
                                            struct machine_value *send_address, int vpset,
                                            uint64_t *wrong)
{
    *wrong = 0;
    if (!send_address || !vpset_get(m, vpset) || !address_good(m, send_address))
        return m->status;
    struct message g = {0};
    double begin;
    bool in_blocks;
    if (known_ranks_are(m, send_address, vpset))
        return MACHINE_OK;
    if (!message_make(m, &g, send_address, NULL, 0, NULL, vpset, true, false))
        return m->status;
    if (g.known && g.known->there)
        return MACHINE_OK;
    if (all_to_all_arrange(m, &g, false, false, &in_blocks))
        return m->status;
    if (in_blocks)
        return all_to_all_wrong(m, &g, wrong);
    if (message_near(m, g.to, g.address->buffer, &begin)) {
        const struct near_route r = message_route(m, &g, false);
        *wrong = near_wrong(&r);
        near_end(m, "checking addresses", begin);
        return MACHINE_OK;
    }
    return wrong_far(m, &g, wrong);
}

bool machine_sent_beyond(struct machine *m)
{
    if (!m->run->sent_beyond)
        return false;
    m->run->beyond_told = true;
    m->run->sent_beyond = false;
    return true;
}
