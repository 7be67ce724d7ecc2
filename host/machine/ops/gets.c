/* gets.c - see gets.h. */
#include "ops/gets.h"

#include "ops/index.h"
#include "values/graph.h"
#include "values/places.h"

struct machine_value *gets_node(struct machine *m, struct machine_value *address,
                                struct machine_value *source, int set)
{
    const struct vpset *from = &m->values->sets[set];
    struct machine_value *place = index_place(m, from, index_of_address(m, set, address));
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

bool gets_cross(struct machine *m, struct machine_value *address, int set, uint32_t *bits)
{
    const struct vpset *s = &m->values->sets[set];
    const int length = machine_address_bits(m, set);
    uint64_t differ = 0;
    if (set != m->values->set_current || !m->device->is_pocl || m->settings.interpret == 3)
        return false;
    struct machine_value *v = index_address_bare(address, length);
    while (!v->buffer && v->op == MACHINE_XOR && v->type.width >= length) {
        const int k = v->in[1]->op == NODE_CONSTANT;
        if (v->in[k]->op != NODE_CONSTANT)
            return false;
        differ ^= v->in[k]->imm.lo;
        v = index_address_bare(v->in[1 - k], length);
    }
    if (v->set != set || v->type.width < length)
        return false;
    differ &= (UINT64_C(1) << length) - 1;
    if (index_is_address(s)) {
        *bits = (uint32_t)differ;
        return is_own_index(v, s) && places_cross_can(s, *bits);
    }
    if (!s->layout.blocks || !v->own_address)
        return false;
    *bits = (uint32_t)machine_layout_index(&s->layout, differ);
    return places_cross_can(s, *bits);
}

bool gets_can(const struct machine *m, const struct machine_value *source, int set)
{
    const struct vpset *from = &m->values->sets[set];
    return !m->settings.eager && m->settings.gather && source->type.width <= 64 &&
           from->rows * from->pitch <= INT32_MAX;
}
