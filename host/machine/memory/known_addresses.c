/* known_addresses.c - see known_addresses.h. */
#include "memory/known_addresses.h"

#include "memory/memory.h"
#include "values/graph.h"

/* A state makes nodes of its own for the same array. */
static bool same_array(const struct machine_value *a, const struct machine_value *b)
{
    return a == b || (a->buffer && a->buffer == b->buffer && a->set == b->set &&
                      a->type.kind == b->type.kind && a->type.width == b->type.width);
}

struct known_addresses *known_addresses_find(struct machine *m,
                                             const struct machine_value *address, int set)
{
    struct known_addresses *k = &m->memory->known;
    return k->address && k->set == set && same_array(k->address, address) ? k : NULL;
}

bool known_addresses_note(struct machine *m, struct machine_value *address, int set,
                          struct machine_value *index)
{
    struct known_addresses *k = &m->memory->known;
    const bool again = k->seen && k->seen == address->buffer && k->seen_set == set;
    k->seen = address->buffer;
    k->seen_set = set;
    if (!again || !address->buffer || !index->buffer || !index->buffer->host)
        return false;
    known_addresses_forget(m);
    graph_ref(address);
    graph_ref(index);
    *k = (struct known_addresses){.seen = address->buffer,
                                  .seen_set = set,
                                  .address = address,
                                  .index = index,
                                  .set = set};
    return true;
}

void known_addresses_forget(struct machine *m)
{
    struct known_addresses *k = &m->memory->known;
    struct machine_value *address = k->address, *index = k->index;
    *k = (struct known_addresses){0};
    if (!address)
        return;
    graph_unref(m, address);
    graph_unref(m, index);
}

/* ---- places ---- */

static void place_forget(struct machine *m, struct known_place *k)
{
    const struct known_place was = *k;
    *k = (struct known_place){0};
    if (!was.address)
        return;
    graph_unref(m, was.address);
    graph_unref(m, was.place);
}

static struct known_place *place_find(const struct machine *m,
                                      const struct machine_value *address, int set)
{
    struct known_place *of = m->memory->places.of;
    for (int i = 0; i < KNOWN_PLACES && address->buffer; i++)
        if (of[i].seen == address->buffer && of[i].set == set &&
            (!of[i].address ||
             (of[i].address->buffer == of[i].seen && same_array(of[i].address, address))))
            return &of[i];
    return NULL;
}

struct machine_value *known_places_get(struct machine *m, const struct machine_value *address,
                                       int set)
{
    struct known_places *all = &m->memory->places;
    struct known_place *k = place_find(m, address, set);
    if (!address->buffer)
        return NULL;
    if (!k) { /* in place of the one that was not used for longest */
        k = &all->of[0];
        for (int i = 1; i < KNOWN_PLACES; i++)
            k = all->of[i].used < k->used ? &all->of[i] : k;
        place_forget(m, k);
        *k = (struct known_place){.seen = address->buffer, .set = set};
    }
    k->gets++;
    k->used = ++all->gets;
    return k->place;
}

bool known_places_wanted(const struct machine *m, const struct machine_value *address, int set)
{
    const struct known_place *k = place_find(m, address, set);
    return k && !k->place && k->gets >= KNOWN_PLACES_FROM;
}

void known_places_keep(struct machine *m, struct machine_value *address, int set,
                       struct machine_value *place)
{
    struct known_place *k = place_find(m, address, set);
    if (!k || k->place)
        return;
    INVARIANT(!address->kept && !place->kept); /* a state puts other arrays into its own */
    graph_ref(address);
    graph_ref(place);
    place->buffer->follows = true;
    k->address = address;
    k->place = place;
}

void known_places_forget(struct machine *m)
{
    for (int i = 0; i < KNOWN_PLACES; i++)
        place_forget(m, &m->memory->places.of[i]);
}

/* ---- ranks ---- */

void known_ranks_note(struct machine *m, struct machine_value *rank,
                      struct machine_value *context)
{
    struct known_ranks *k = &m->memory->ranks;
    known_ranks_forget(m);
    graph_ref(rank);
    graph_ref(context);
    k->rank = rank;
    k->context = context;
}

/* The same numbers of fewer or more bits, which have room for all ranks. */
static const struct machine_value *same_ranks(const struct machine *m, struct machine_value *v)
{
    const uint64_t last = m->values->sets[m->memory->ranks.rank->set].count - 1;
    int bits = 0;
    while (last >> bits)
        bits++;
    return graph_low_bits(v, bits);
}

void machine_layout_note(struct machine *m, const struct machine_layout *layout,
                         struct machine_value *index, struct machine_value *address)
{
    struct known_ranks *k = &m->memory->ranks;
    if (!k->rank || !index || !address || same_ranks(m, index) != k->rank)
        return;
    graph_ref(address);
    if (k->address)
        graph_unref(m, k->address);
    k->address = address;
    k->layout = *layout;
}

bool known_ranks_are(const struct machine *m, const struct machine_value *address, int set)
{
    const struct known_ranks *k = &m->memory->ranks;
    const struct machine_value *context = m->memory->flags[set].of[MACHINE_CONTEXT].value;
    return k->address && k->address == address && k->rank->set == m->values->set_current &&
           set == m->values->set_current &&
           (context == k->context ||
            (context->buffer && context->buffer == k->context->buffer)) &&
           machine_layouts_equal(&m->values->sets[set].layout, &k->layout);
}

void known_ranks_forget(struct machine *m)
{
    const struct known_ranks k = m->memory->ranks;
    m->memory->ranks = (struct known_ranks){0};
    if (!k.rank)
        return;
    graph_unref(m, k.rank);
    graph_unref(m, k.context);
    if (k.address)
        graph_unref(m, k.address);
}

static bool is_in(const struct device_buffer *b, const struct machine_value *v)
{
    return v && v->buffer == b;
}

void known_addresses_changed(struct machine *m, const struct device_buffer *b)
{
    const struct known_addresses *k = &m->memory->known;
    const struct known_ranks *r = &m->memory->ranks;
    for (int i = 0; i < KNOWN_PLACES; i++) {
        struct known_place *p = &m->memory->places.of[i];
        if (p->seen == b || is_in(b, p->place))
            place_forget(m, p);
    }
    if (is_in(b, k->address) || is_in(b, k->index))
        known_addresses_forget(m);
    if (is_in(b, r->rank) || is_in(b, r->context) || is_in(b, r->address))
        known_ranks_forget(m);
}
