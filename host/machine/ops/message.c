/* message.c - see message.h. */
#include "ops/message.h"

#include <string.h>

#include "base/types.h"
#include "ops/gather.h"
#include "ops/index.h"
#include "ops/near.h"
#include "ops/near_pack.h"
#include "run/evaluate.h"
#include "run/materialise.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"
#include "values/make.h"

/* Whether the front end sends to that set by itself, if its arrays are its own. */
static bool is_near(const struct machine *m, const struct vpset *to)
{
    return m->settings.near && (uint64_t)to->rows * to->pitch < UINT32_MAX;
}

/* Where an address is an index, what has its low bits serves as well. */
static struct machine_value *address_whole(struct machine *m, int to_set,
                                           struct machine_value *address)
{
    return index_is_address(&m->values->sets[to_set])
               ? index_address_bare(address, machine_address_bits(m, to_set))
               : address;
}

bool message_fills(struct machine *m, struct machine_value *address, int to_set)
{
    const int from_set = m->values->set_current;
    const struct vpset *to = &m->values->sets[to_set];
    const struct known_addresses *k =
        known_addresses_find(m, address_whole(m, to_set, address), to_set);
    return k && k->there && k->distinct && m->device->is_pocl && is_near(m, to) &&
           m->values->sets[from_set].count == to->count &&
           value_is_one_bit(m->memory->flags[from_set].of[MACHINE_CONTEXT].value);
}

bool message_make(struct machine *m, struct message *g, struct machine_value *address,
                  struct machine_value *source, int source_set, struct machine_value *other,
                  int to_set, bool under_context, bool combines)
{
    /* A reinterpreted value has the same bits in memory, so its source serves as well. */
    if (source && !combines)
        source = graph_same_bits(m, source);
    if (other && !combines)
        other = graph_same_bits(m, other);
    g->from_set = m->values->set_current;
    g->to_set = to_set;
    const bool is_index = !index_is_address(&m->values->sets[to_set]);
    struct machine_value *const given = address = address_whole(m, to_set, address);
    g->fills = other && !combines && message_fills(m, address, to_set);
    if ((g->known = known_addresses_find(m, address, to_set)))
        address = g->known->index;
    else if (is_index)
        address = index_of_address(m, to_set, address);
    if (!address)
        return false;
    graph_borrow(m, address); /* it may be a part of what was given, or be known */
    graph_borrow(m, given);
    g->context = under_context ? flag_held(m, m->values->set_current, MACHINE_CONTEXT) : NULL;
    struct machine_value *wanted[4];
    int count = 0;
    struct machine_value *const all[4] = {address, source, g->fills ? NULL : other, g->context};
    for (int i = 0; i < 4; i++)
        if (all[i] && !node_is_leaf(all[i]))
            wanted[count++] = all[i];
    if (count && evaluate_in_blocks(m, wanted, count, false))
        return false;
    g->all = !g->context || value_is_one_bit(g->context);
    g->address = materialise_in_blocks(m, g->from_set, address);
    if (g->address && source) /* a number that is sent may do as it is */
        g->source = other && source->op == NODE_CONSTANT
                        ? source
                        : materialise_in_blocks(m, source_set, source);
    if (g->address && other)
        g->old = g->fills ? other : materialise_in_blocks(m, to_set, other);
    if (!g->address || (source && !g->source) || (other && !g->old))
        return false;
    if (g->all)
        g->context = g->address; /* a dummy for the unused argument */
    else
        g->context = materialise_in_blocks(m, g->from_set, g->context);
    g->from = &m->values->sets[g->from_set];
    g->to = &m->values->sets[to_set];
    g->flat = g->from->rows == 1 && g->to->rows == 1;
    int bits = is_index ? INDEX_BITS : machine_address_bits(m, to_set),
        width = address->type.width;
    bits = bits < width ? bits : width;
    g->mask = bits >= 32 ? UINT32_MAX : (UINT32_C(1) << bits) - 1;
    if (g->context && other && !g->known && known_addresses_note(m, given, to_set, g->address))
        g->known = &m->memory->known;
    return g->context != NULL;
}

struct device_buffer *message_array(struct machine *m, const struct vpset *s,
                                    struct machine_type type)
{
    return device_rows_get(m, geometry_rows(s, type));
}

bool message_over(const struct machine *m, const struct message *g, const struct field *f,
                  uint32_t offset)
{
    const struct machine_value *v = g->old;
    const struct device_buffer *b = v->buffer;
    return gather_is_own(m, f, offset, v) && m->settings.near &&
           type_equal(v->type, g->source->type) && b != g->address->buffer &&
           b != g->source->buffer && b != g->context->buffer;
}

/* What is known of the addresses grows with their use: to find out whether they are distinct
 * takes longer than a send. */
static void known_look(struct machine *m, const struct message *g)
{
    enum { THERE_AFTER = 2, DISTINCT_AFTER = 4 };
    struct known_addresses *k = g->known;
    if (!k || ++k->uses > DISTINCT_AFTER)
        return;
    const struct near_route r = message_route(m, g, true);
    if (k->uses == THERE_AFTER)
        k->there = near_all_there(&r);
    if (k->uses == DISTINCT_AFTER && k->there)
        k->distinct = near_are_distinct(&r);
}

struct near_route message_route(const struct machine *m, const struct message *g, bool shares)
{
    const bool distinct = g->known && g->known->distinct;
    int parts = device_parts(m, 1e-9 * m->device->shape.send_ns * (double)g->from->count),
        size = crew_size(m->device->crew);
    return (struct near_route){
        .from = g->from,
        .to = g->to,
        .address = g->address->buffer,
        .context = g->all ? NULL : g->context->buffer,
        .address_bytes = type_bytes(g->address->type),
        .mask = g->mask,
        .near_bytes = m->settings.near > 1 ? 0 : (size_t)m->device->shape.near_bytes,
        .lanes = lanes_table(),
        .crew = m->device->crew,
        .there = g->known && g->known->there,
        .distinct = distinct,
        .parts = shares && !distinct && parts > size ? size : parts};
}

bool message_near(struct machine *m, const struct vpset *to, const struct device_buffer *b,
                  double *start)
{
    return is_near(m, to) && near_begin(m, b, start);
}

enum machine_status message_send_near(struct machine *m, const struct message *g,
                                      enum machine_combiner combiner, struct device_buffer *out,
                                      size_t bytes, double start,
                                      struct machine_value **notification)
{
    known_look(m, g);
    atomic_bool beyond = false;
    struct near_route r = message_route(m, g, true);
    r.beyond = m->run->beyond_told ? NULL : &beyond;
    const bool fills = g->fills || (combiner == MACHINE_COMBINE_OVERWRITE && r.distinct &&
                                    g->all && g->from->count == g->to->count);
    struct device_buffer *arrived = notification ? message_array(m, g->to, MACHINE_BIT) : NULL;
    if (notification && !arrived)
        return m->status;
    if (out != g->old->buffer && !fills)
        device_move(m, out->host, g->old->buffer->host, bytes);
    if (arrived)
        memset(arrived->host, 0, arrived->bytes);
    near_send(&r, combiner, g->source->type, g->source, out, arrived);
    m->run->sent_beyond = m->run->sent_beyond || beyond;
    if (arrived)
        *notification = graph_buffer_node(m, MACHINE_BIT, g->to_set, arrived);
    near_end(m, "sending", start);
    return MACHINE_OK;
}

struct machine_value *message_pack(struct machine *m, struct machine_value *source,
                                   struct machine_value *old)
{
    const int set = m->values->set_current;
    const struct machine_type type = source->type;
    const struct machine_value *context = graph_borrow(m, m->memory->ranks.context);
    struct machine_value *wanted[2];
    int count = 0;
    source = graph_same_bits(m, source);
    old = graph_same_bits(m, old);
    if (!node_is_leaf(source))
        wanted[count++] = source;
    if (!node_is_leaf(old))
        wanted[count++] = old;
    if (!context->buffer || (count && evaluate_values(m, wanted, count, false)))
        return NULL;
    if (m->sequencers &&
        (sequencers_whole(m, context->buffer) || sequencers_whole(m, old->buffer)))
        return NULL;
    source = materialise(m, set, source);
    const struct vpset *s = &m->values->sets[set];
    struct device_buffer *out = source ? message_array(m, s, type) : NULL;
    double start;
    if (!out || s->rows > 1 || !near_begin(m, out, &start)) {
        if (out)
            device_buffer_unref(m, out);
        return NULL;
    }
    const int parts =
        device_parts(m, 1e-9 * m->device->shape.scan_vector_ns * (double)s->count);
    near_pack(m->device->crew, parts, s, type_bytes(type), context->buffer, source->buffer, old,
              out);
    near_end(m, "sending", start);
    struct machine_value *v = graph_buffer_node(m, type, set, out);
    v->strange_nan = source->strange_nan || old->strange_nan;
    return v;
}
