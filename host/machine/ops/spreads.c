/* spreads.c - see spreads.h.
 *
 * A spread of an array is a get (NODE_GATHER) whose place follows from the processor's
 * coordinates, but for those along which it is spread: they are numbers. So the row that a
 * program takes is an argument of a plan, and another row is the same plan. Byte code sees that
 * a place goes up by one along a row, or is the same there (interpret/along.c).
 *
 *     spread (a * b)    where that is little to compute, the spread of a times the spread of b,
 *                       so nothing is stored before it is spread
 *     spread (x)        a coordinate is a number along these axes, and itself along others; the
 *                       spread of a spread is a get, too
 *     spread (array)    get (place)
 *
 * Everything else is put into memory first. A set that is cut into blocks (sequencers/) has no
 * such gets of its own arrays: scan.c fills each block's. */
#include "ops/spreads.h"

#include "ops/gets.h"
#include "ops/index.h"
#include "ops/scan.h"
#include "run/materialise.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"
#include "values/make.h"

/* Which processor of its line each one reads. */
struct spread_from {
    int set;
    uint32_t axes; /* those along which it reads another one; all others are its own */
    int at[32];    /* the coordinate there */
};

/* What is computed anew by each processor that reads it, at most: nodes; and their cost, unless
 * all of a row read the same, which is computed once for many of them. */
enum { SPREAD_NODES = 32, SPREAD_COST = 12, SPREAD_COST_ROW = 200 };

struct pushing {
    const struct spread_from *from;
    bool is_cut; /* the set is, so arrays are not got from */
    int nodes, cost;
};

static bool is_along(const struct spread_from *from, int axis)
{
    return from->axes >> axis & 1;
}

/* Where in an array of the set it is. */
static struct machine_value *place_of(struct machine *m, const struct spread_from *from)
{
    const struct vpset *s = &m->values->sets[from->set];
    const struct machine_type type = MACHINE_UINT(INDEX_BITS);
    uint64_t number = (uint64_t)s->halo, stride = s->pitch;
    struct machine_value *place = NULL, *terms[32];
    int count = 0;
    for (int a = s->rank - 1; a >= 0; a--) {
        const uint64_t step = a == s->rank - 1 ? 1 : stride;
        if (a < s->rank - 1)
            stride *= (uint64_t)s->dimensions[a];
        if (is_along(from, a)) {
            number += (uint64_t)from->at[a] * step;
            continue;
        }
        struct machine_value *x = machine_coordinate(m, a, INDEX_BITS);
        if (x && step > 1)
            x = make_operation(m, MACHINE_MUL, type, x, index_number(m, step));
        if (!x)
            return NULL;
        terms[count++] = x;
    }
    place = index_number(m, number);
    while (count && place) /* what is the same along a row first, its columns last */
        place = make_operation(m, MACHINE_ADD, type, place, terms[--count]);
    return place;
}

static struct machine_value *get(struct machine *m, struct machine_value *place,
                                 struct machine_value *source, struct machine_value *places)
{
    struct machine_value key = {.op = NODE_GATHER,
                                .type = source->type,
                                .set = (uint16_t)m->values->set_current,
                                .in = {place, source, places}};
    return place && places ? graph_node(m, &key) : NULL;
}

static struct machine_value *of_array(struct machine *m, const struct spread_from *from,
                                      struct machine_value *v)
{
    const struct vpset *s = &m->values->sets[from->set];
    const uint64_t places = (uint64_t)s->halo + (s->rows == 1 ? s->count : s->rows * s->pitch);
    return get(m, place_of(m, from), v, index_number(m, places));
}

/* The same operation on other operands. */
static struct machine_value *remade(struct machine *m, const struct machine_value *v,
                                    struct machine_value *const in[3])
{
    if (v->op == NODE_SELECT)
        return machine_select(m, in[0], in[1], in[2]);
    if (v->op < MACHINE_OP_COUNT_PUBLIC && node_ops[v->op].inputs == 2 &&
        value_is_number(in[0]) && value_is_number(in[1]) &&
        type_equal(in[0]->type, in[1]->type))
        return machine_binary(m, (enum machine_op)v->op, in[0], in[1]);
    struct machine_value key = {.op = v->op,
                                .type = v->type,
                                .axis = v->axis,
                                .set = v->set,
                                .detail = v->detail,
                                .imm = v->imm,
                                .in = {in[0], in[1], in[2]}};
    return graph_node(m, &key);
}

/* NULL: too much to compute, or it must be in memory. */
static struct machine_value *pushed(struct machine *m, struct pushing *p,
                                    struct machine_value *v)
{
    struct machine_value *in[3] = {NULL, NULL, NULL};
    if (v->op == NODE_CONSTANT)
        return v;
    if (--p->nodes < 0)
        return NULL;
    if (v->buffer && !node_is_cheap(v))
        return !p->is_cut && v->set == p->from->set && gets_can(m, v, v->set)
                   ? of_array(m, p->from, v)
                   : NULL;
    if (v->op == NODE_COORDINATE && is_along(p->from, v->axis))
        return machine_constant(m, v->type,
                                (struct machine_scalar){(uint64_t)p->from->at[v->axis], 0});
    if (v->op == NODE_COORDINATE)
        return v;
    if (v->op == NODE_GATHER && v->set == p->from->set) {
        struct machine_value *place = pushed(m, p, v->in[0]);
        return place ? get(m, place, v->in[1], v->in[2]) : NULL;
    }
    p->cost -= node_cost(v->op, v->type);
    if (!op_has(v->op, OP_ALONE) || op_is_math(v->op) || p->cost < 0)
        return NULL;
    for (int i = 0; i < node_ops[v->op].inputs; i++)
        if (!(in[i] = pushed(m, p, v->in[i])))
            return NULL;
    return remade(m, v, in);
}

static struct machine_value *spread_value(struct machine *m, const struct spread_from *from,
                                          struct machine_value *v)
{
    const struct vpset *s = &m->values->sets[from->set];
    if (v->op == NODE_CONSTANT && !v->buffer)
        return v;
    const bool at_once =
        m->values->at_once && s->rows * s->pitch <= m->device->shape.at_once_lanes;
    if (!gets_can(m, v, from->set) || at_once || from->set != m->values->set_current)
        return NULL;
    struct pushing p = {.from = from,
                        .is_cut = m->sequencers && sequencers_cut(m, from->set),
                        .nodes = SPREAD_NODES,
                        .cost = is_along(from, s->rank - 1) ? SPREAD_COST_ROW : SPREAD_COST};
    struct machine_value *spread = pushed(m, &p, v);
    if (spread || m->status || p.is_cut)
        return spread;
    const struct machine_type type = v->type;
    v = materialise(m, from->set, in_memory(m, v));
    return v ? machine_reinterpret(m, of_array(m, from, v), type) : NULL;
}

struct machine_value *spreads_axis(struct machine *m, int axis, int coordinate,
                                   struct machine_value *v)
{
    struct spread_from from = {.set = m->values->set_current, .axes = UINT32_C(1) << axis};
    from.at[axis] = coordinate;
    return spread_value(m, &from, v);
}

struct machine_value *spreads_index(struct machine *m, uint64_t index, struct machine_value *v)
{
    const struct vpset *s = &m->values->sets[m->values->set_current];
    struct spread_from from = {.set = m->values->set_current,
                               .axes = (uint32_t)((UINT64_C(1) << s->rank) - 1)};
    for (int a = s->rank - 1; a >= 0; a--) {
        from.at[a] = (int)(index % (uint64_t)s->dimensions[a]);
        index /= (uint64_t)s->dimensions[a];
    }
    return spread_value(m, &from, v);
}
