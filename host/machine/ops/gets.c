/* gets.c - see gets.h. */
#include "ops/gets.h"

#include "memory/memory.h"
#include "ops/index.h"
#include "run/materialise.h"
#include "run/replay.h"
#include "values/graph.h"
#include "values/make.h"
#include "values/places.h"

/* Whether where an address's element is should be in memory: it is more than a sum. */
static bool is_worth_keeping(const struct machine *m, const struct machine_value *address,
                             int set)
{
    const struct vpset *from = &m->values->sets[set];
    const struct device_buffer *b = address->buffer;
    return b && (b->host || (b->blocks && m->device->is_pocl)) && m->run->mode == RUN_FREE &&
           !(index_is_address(from) && from->rows == 1);
}

/* Where each address's element is in an array of the set. Of addresses by which many gets have
 * gone it is kept. */
static struct machine_value *place_of(struct machine *m, struct machine_value *address, int set)
{
    struct machine_value *bare = index_address_bare(address, machine_address_bits(m, set));
    const bool keeps = is_worth_keeping(m, bare, set);
    struct machine_value *place = keeps ? known_places_get(m, bare, set) : NULL;
    if (place)
        return graph_borrow(m, place);
    place = index_place(m, &m->values->sets[set], index_of_address(m, set, address));
    if (!place || !keeps || !known_places_wanted(m, bare, set))
        return place;
    graph_borrow(m, bare);
    record_impure(m); /* what a state holds says nothing of these addresses */
    place = materialise(m, m->values->set_current, place);
    record_impure(m);
    if (place && place->buffer && bare->buffer)
        known_places_keep(m, bare, set, place);
    return place;
}

struct machine_value *gets_node(struct machine *m, struct machine_value *address,
                                struct machine_value *source, int set)
{
    const struct vpset *from = &m->values->sets[set];
    struct machine_value *place = place_of(m, address, set);
    uint64_t places =
        (uint64_t)from->halo + (from->rows == 1 ? from->count : from->rows * from->pitch);
    if (!place)
        return NULL;
    struct machine_value key = {.op = NODE_GATHER,
                                .type = source->type,
                                .set = (uint16_t)m->values->set_current,
                                .in = {place, source, index_number(m, places)}};
    return graph_node(m, &key);
}

static bool is_own_index(const struct machine_value *v, const struct vpset *s)
{
    return v->op == NODE_INDEX || (v->op == NODE_COORDINATE && s->rank == 1);
}

static bool has_functions(const struct machine *m, struct machine_value *v, int *budget)
{
    if (node_is_leaf(v) || v->mark == m->values->mark)
        return false;
    v->mark = m->values->mark;
    bool has = op_is_math(v->op) || --*budget < 0;
    for (int i = 0; i < node_ops[v->op].inputs && !has; i++)
        has = has_functions(m, v->in[i], budget);
    return has;
}

bool gets_has_functions(struct machine *m, struct machine_value *v)
{
    int budget = 2048;
    m->values->mark++;
    return has_functions(m, v, &budget);
}

/* Whether each processor's address is its own but for some bits. *differ: which, of the
 * address. */
static bool is_own_but(struct machine_value *address, const struct vpset *s, int set,
                       int length, uint64_t *differ)
{
    struct machine_value *v = index_address_bare(address, length);
    *differ = 0;
    if (v->own_address && s->layout.blocks) {
        *differ = v->turned;
        return v->set == set && v->type.width >= length;
    }
    while (!v->buffer && v->op == MACHINE_XOR && v->type.width >= length) {
        const int k = v->in[1]->op == NODE_CONSTANT;
        if (v->in[k]->op != NODE_CONSTANT)
            return false;
        *differ ^= v->in[k]->imm.lo;
        v = index_address_bare(v->in[1 - k], length);
    }
    *differ &= (UINT64_C(1) << length) - 1;
    return v->set == set && v->type.width >= length && index_is_address(s) &&
           is_own_index(v, s);
}

bool gets_turned(struct machine *m, struct machine_value *address, int set, uint32_t *bits)
{
    const struct vpset *s = &m->values->sets[set];
    uint64_t differ;
    if (set != m->values->set_current ||
        !is_own_but(address, s, set, machine_address_bits(m, set), &differ))
        return false;
    differ = index_is_address(s) ? differ : machine_layout_index(&s->layout, differ);
    *bits = (uint32_t)differ;
    return differ <= INT32_MAX;
}

/* Which axis these bits of the index turn one bit of: *distance is that of the coordinates. -1:
 * none, or a coordinate would get out of its axis. */
static int turned_axis(const struct vpset *s, uint32_t bits, int *distance)
{
    uint64_t stride = 1;
    int axis = s->rank;
    while (--axis >= 0 && bits >= stride * (uint64_t)s->dimensions[axis])
        stride *= (uint64_t)s->dimensions[axis];
    *distance = (int)(bits / stride);
    const bool one_bit = (bits & (bits - 1)) == 0 && (stride & (stride - 1)) == 0;
    return axis >= 0 && one_bit && s->dimensions[axis] % (2 * *distance) == 0 ? axis : -1;
}

/* What is in memory is taken from there at any distance along the other axes; along a row
 * kernels reach as far as its halo. */
static bool is_near(const struct vpset *s, int axis, int distance)
{
    return axis >= 0 && (axis < s->rank - 1 || distance <= s->halo);
}

/* From one side where the bit of the coordinate is 1, from the other where it is 0. */
static struct machine_value *from_sides(struct machine *m, struct machine_value *source,
                                        int axis, int distance)
{
    const bool halves =
        2 * distance == m->values->sets[m->values->set_current].dimensions[axis];
    struct machine_value *after = machine_shift(m, source, axis, distance),
                         *before = machine_shift(m, source, axis, -distance),
                         *at = machine_coordinate(m, axis, INDEX_BITS);
    if (!after || !before || !at || halves)
        return after;
    return machine_select(m, machine_extract(m, at, __builtin_ctz((unsigned)distance), 1),
                          before, after);
}

/* Whether byte code of the front end performs a cross by these bits. */
static bool crosses(const struct machine *m, const struct vpset *s, uint32_t bits)
{
    return m->device->is_pocl && m->settings.interpret != 3 && places_cross_can(s, bits);
}

struct machine_value *gets_made(struct machine *m, struct machine_value *address,
                                struct machine_value *source, int set)
{
    const struct vpset *s = &m->values->sets[set];
    uint32_t bits = 0;
    int distance = 0;
    const bool turned = gets_turned(m, address, set, &bits),
               cross = turned && crosses(m, s, bits) && !gets_has_functions(m, source);
    const int axis = turned && !cross && bits ? turned_axis(s, bits, &distance) : -1;
    if (turned && !bits)
        return source;
    if (!cross ||
        (source->op != NODE_CONSTANT && (bits >= CROSS_NEAR || node_is_cheap(source))))
        source = materialise_in_blocks(m, set, source);
    if (!source)
        return NULL;
    if (cross)
        return places_cross(m, source, bits);
    if (is_near(s, axis, distance))
        return from_sides(m, source, axis, distance);
    return gets_node(m, address, source, set);
}

/* A coordinate of the current set along that axis but for some bits, none of which is beyond
 * its length of so many bits. */
static bool is_coordinate_but(const struct machine *m, struct machine_value *v, int axis,
                              int length, uint64_t *differ)
{
    v = graph_low_bits(v, length);
    *differ = 0;
    while (!v->buffer && v->op == MACHINE_XOR && v->type.width >= length) {
        const int k = v->in[1]->op == NODE_CONSTANT;
        if (v->in[k]->op != NODE_CONSTANT || v->in[k]->imm.lo >> length || v->in[k]->imm.hi)
            return false;
        *differ ^= v->in[k]->imm.lo;
        v = graph_low_bits(v->in[1 - k], length);
    }
    return !v->buffer && v->op == NODE_COORDINATE && v->axis == axis &&
           v->set == m->values->set_current && v->type.width >= length;
}

/* Whether that is how the set's own processors live. */
static bool is_own_layout(const struct vpset *s, const struct machine_layout *l)
{
    for (int a = 0; a < MACHINE_AXES_MAX; a++)
        if (l->subgrid[a] + l->node[a] !=
            (a < s->rank ? __builtin_ctz((unsigned)s->dimensions[a]) : 0))
            return false;
    return machine_layouts_equal(&s->layout, l);
}

struct machine_value *machine_address_turned(struct machine *m, const struct machine_layout *l,
                                             struct machine_value *address, int axis,
                                             struct machine_value *coordinate)
{
    const int set = m->values->set_current, bits = machine_address_bits(m, set);
    const struct vpset *s = set ? &m->values->sets[set] : NULL;
    uint64_t differ, along;
    if (!s || !address || !coordinate || axis >= s->rank || !l->powers ||
        !is_own_layout(s, l) || !is_own_but(address, s, set, bits, &differ) ||
        !is_coordinate_but(m, coordinate, axis, l->subgrid[axis] + l->node[axis], &along))
        return NULL;
    uint64_t index = l->blocks ? machine_layout_index(l, differ) : differ, stride = 1;
    if (index >= s->count)
        return NULL;
    for (int a = s->rank - 1; a > axis; a--)
        stride *= (uint64_t)s->dimensions[a];
    index &= ~(((uint64_t)s->dimensions[axis] - 1) * stride);
    index |= along * stride;
    struct machine_value *own = machine_self_address(m, bits),
                         *other = make_number(
                             m, MACHINE_UINT(bits),
                             (struct machine_scalar){machine_layout_address(l, index), 0});
    return own && other && index ? machine_binary(m, MACHINE_XOR, own, other) : own;
}

bool gets_can(const struct machine *m, const struct machine_value *source, int set)
{
    const struct vpset *from = &m->values->sets[set];
    return !m->settings.eager && m->settings.gather && source->type.width <= 64 &&
           from->rows * from->pitch <= INT32_MAX;
}
