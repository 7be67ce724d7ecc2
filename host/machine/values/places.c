/* places.c - values that depend on a processor's place: its neighbours' values (shifts), its
 * coordinates and addresses, and its random numbers. */
#include "values/places.h"

#include "base/errors.h"
#include "base/parts.h"
#include "values/graph.h"

static struct machine_value *bad(struct machine *m, const char *what)
{
    machine_fail(m, MACHINE_BAD_ARGUMENT, "%s", what);
    return NULL;
}

struct machine_value *machine_shift(struct machine *m, struct machine_value *a, int axis,
                                    int distance)
{
    if (!a)
        return NULL;
    int set = a->set ? a->set : m->values->set_current;
    const struct vpset *s = vpset_get(m, set);
    if (!s)
        return NULL;
    if (axis < 0 || axis >= s->rank)
        return bad(m, "there is no such axis");
    int length = s->dimensions[axis];
    distance %= length;
    if (!a->buffer && a->op == NODE_SHIFT && a->axis == axis) {
        distance = (distance + a->detail) % length;
        a = a->in[0];
    }
    if (distance > length / 2)
        distance -= length;
    if (distance < -(length / 2))
        distance += length;
    if (distance == 0 || a->op == NODE_CONSTANT)
        return a;
    if (!a->buffer && a->op == NODE_REINTERPRET) {
        struct machine_value *moved = machine_shift(m, a->in[0], axis, distance);
        return machine_reinterpret(m, moved, a->type);
    }
    /* What neighbours read of each other is stored as narrow as it is. */
    if (!a->buffer && (a->op == NODE_ZERO_EXTEND || a->op == NODE_SIGN_EXTEND)) {
        bool is_signed = a->op == NODE_SIGN_EXTEND;
        struct machine_value *moved = machine_shift(m, a->in[0], axis, distance);
        return moved ? machine_resize(m, moved, a->type.width, is_signed) : NULL;
    }
    struct machine_value key = {.op = NODE_SHIFT,
                                .type = a->type,
                                .axis = (uint8_t)axis,
                                .set = (uint16_t)set,
                                .detail = distance,
                                .in = {a, NULL, NULL}};
    return graph_node(m, &key);
}

bool places_cross_can(const struct vpset *s, uint32_t bits)
{
    const uint32_t width = (uint32_t)s->width, whole = bits | (CROSS_NEAR - 1);
    return bits <= INT32_MAX && width % (UINT32_C(2) << (31 - __builtin_clz(whole))) == 0;
}

struct machine_value *places_cross(struct machine *m, struct machine_value *a, uint32_t bits)
{
    if (!a || a->op == NODE_CONSTANT || !bits)
        return a;
    if (!a->buffer && a->op == NODE_CROSS && a->detail == CROSS_LANES && bits < CROSS_NEAR)
        return places_cross(m, a->in[0], bits ^ (uint32_t)a->in[1]->imm.lo);
    if (!a->buffer && a->op == NODE_REINTERPRET)
        return machine_reinterpret(m, places_cross(m, a->in[0], bits), a->type);
    struct machine_value *number =
        machine_constant(m, MACHINE_UINT(32), (struct machine_scalar){bits, 0});
    struct machine_value key = {.op = NODE_CROSS,
                                .type = a->type,
                                .set = a->set,
                                .detail = bits < CROSS_NEAR   ? CROSS_LANES
                                          : bits % CROSS_NEAR ? CROSS_BOTH
                                                              : CROSS_BLOCKS,
                                .in = {a, number, NULL}};
    return number ? graph_node(m, &key) : NULL;
}

static struct machine_value *generated(struct machine *m, int op, int axis, int detail,
                                       int width, struct machine_scalar imm)
{
    const struct vpset *s = vpset_get(m, m->values->set_current);
    if (!s)
        return NULL;
    if (width < 1 || width > 128)
        return bad(m, "a value's width must be 1..128 bits");
    if (axis < 0 || axis >= s->rank)
        return bad(m, "there is no such axis");
    struct machine_value key = {.op = (uint8_t)op,
                                .type = MACHINE_UINT(width),
                                .axis = (uint8_t)axis,
                                .set = (uint16_t)m->values->set_current,
                                .detail = detail,
                                .imm = imm};
    return graph_node(m, &key);
}

struct machine_value *machine_coordinate(struct machine *m, int axis, int width)
{
    return generated(m, NODE_COORDINATE, axis, 0, width, (struct machine_scalar){0, 0});
}

struct machine_value *machine_self_address(struct machine *m, int width)
{
    const struct vpset *s = vpset_get(m, m->values->set_current);
    if (s && s->layout.blocks) {
        /* no bit above an address: a field that is longer holds one value */
        const int bits = machine_address_bits(m, m->values->set_current);
        struct machine_value *whole = machine_layout_address_value(m, &s->layout,
                                                                   machine_self_index(m, 32)),
                             *low = machine_resize(m, whole, bits < 32 ? bits : 32, false),
                             *v = machine_resize(m, low, width, false);
        if (v)
            whole->own_address = low->own_address = v->own_address = true;
        return v;
    }
    if (s && (s->layout.order == MACHINE_SEND_ORDER || s->ratio == 1))
        return machine_self_index(m, width);
    return generated(m, NODE_SEND_ADDRESS, 0, 0, width, (struct machine_scalar){0, 0});
}

struct machine_value *machine_self_index(struct machine *m, int width)
{
    return generated(m, NODE_INDEX, 0, 0, width, (struct machine_scalar){0, 0});
}

static uint64_t mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

void machine_random_seed(struct machine *m, uint64_t seed)
{
    m->values->random_seed = seed;
    m->values->random_draws = 0;
}

struct machine_value *places_random(struct machine *m, int width, uint64_t limit)
{
    if (width > 64) {
        struct machine_value *low = places_random(m, 64, limit);
        struct machine_value *high =
            limit ? machine_constant(m, MACHINE_UINT(width - 64), (struct machine_scalar){0, 0})
                  : places_random(m, width - 64, 0);
        return machine_concat(m, low, high);
    }
    uint64_t key =
        mix(mix(m->values->random_seed) + ++m->values->random_draws * 0x9e3779b97f4a7c15u);
    int fits32 = limit != 0 && limit <= UINT32_MAX;
    return generated(m, NODE_RANDOM, 0,
                     limit == 0 ? 0
                     : fits32   ? 1
                                : 2,
                     width, (struct machine_scalar){key, limit});
}
