/* make.c - see make.h. */
#include "values/make.h"

#include <math.h>
#include <string.h>

#include "base/errors.h"
#include "base/parts.h"
#include "base/scalar.h"
#include "base/types.h"
#include "values/graph.h"

struct machine_value *make_bad(struct machine *m, const char *what)
{
    machine_fail(m, MACHINE_BAD_ARGUMENT, "%s", what);
    return NULL;
}

bool machine_value_is_zero(const struct machine_value *v)
{
    return v->op == NODE_CONSTANT && !v->imm.lo && !v->imm.hi;
}

struct machine_type machine_value_type(const struct machine_value *v)
{
    return v->type;
}

struct machine_value *make_handed(struct machine *m, struct machine_value *v)
{
    bool just_made = m->values->borrowed_count > 0 &&
                     m->values->borrowed[m->values->borrowed_count - 1] == v;
    return !v || just_made ? v : graph_borrow(m, v);
}

struct machine_value *make_number(struct machine *m, struct machine_type type,
                                  struct machine_scalar x)
{
    struct machine_value key = {
        .op = NODE_CONSTANT, .type = type, .imm = scalar_cut(x, type.width)};
    return graph_node(m, &key);
}

struct machine_value *make_bit(struct machine *m, int x)
{
    return make_number(m, MAKE_BIT_TYPE, (struct machine_scalar){(uint64_t)x, 0});
}

struct machine_value *machine_constant(struct machine *m, struct machine_type type,
                                       struct machine_scalar bits)
{
    if (!type_is_bits(type.width) || !type_good(type) ||
        (type.kind == MACHINE_FLOAT && type.width != 32 && type.width != 64))
        return make_bad(m, "a value's width must be 1..128 bits, a float's 32 or 64");
    return make_number(m, type, bits);
}

struct machine_scalar machine_float_bits(struct machine_type type, double x)
{
    struct machine_scalar bits = {0, 0};
    if (type.width == 32) {
        float f = (float)x;
        uint32_t u;
        memcpy(&u, &f, sizeof u);
        bits.lo = isnan(x) ? NAN_32 : u;
    } else {
        memcpy(&bits.lo, &x, sizeof x);
        bits.lo = isnan(x) ? NAN_64 : bits.lo;
    }
    return bits;
}

struct machine_value *machine_constant_float(struct machine *m, struct machine_type type,
                                             double x)
{
    if (type.kind != MACHINE_FLOAT || (type.width != 32 && type.width != 64) ||
        !type_good(type))
        return make_bad(m, "a float is 32 or 64 bits");
    struct machine_scalar bits = machine_float_bits(type, x);
    if (type.s)
        bits.lo = type_rounded(bits.lo, type);
    return make_number(m, type, bits);
}

/* The VP set of a result; -1 if the operands' differ. */
static int joint_set(struct machine *m, struct machine_value *const *in, int count)
{
    int set = 0;
    for (int i = 0; i < count; i++) {
        if (in[i]->set && set && in[i]->set != set)
            return -1;
        if (in[i]->set)
            set = in[i]->set;
    }
    return set ? set : m->values->set_current;
}

struct machine_value *make_node(struct machine *m, int op, struct machine_type type, int detail,
                                struct machine_value *a, struct machine_value *b,
                                struct machine_value *c)
{
    struct machine_value key = {
        .op = (uint8_t)op, .type = type, .detail = detail, .in = {a, b, c}};
    int set = joint_set(m, key.in, node_ops[op].inputs);
    if (set < 0)
        return make_bad(m, "operands belong to different VP sets");
    if (set == 0)
        return make_bad(m, "there is no current VP set");
    key.set = (uint16_t)set;
    struct machine_value *computed = m->values->at_once ? m->values->at_once(m, &key) : NULL;
    return computed ? computed : graph_node(m, &key);
}

struct machine_value *make_overflow(struct machine *m, enum node_op op, struct machine_value *a,
                                    struct machine_value *b)
{
    return make_node(m, (int)op, MAKE_BIT_TYPE, 0, a, b, NULL);
}

struct machine_value *make_operation(struct machine *m, enum machine_op op,
                                     struct machine_type type, struct machine_value *a,
                                     struct machine_value *b)
{
    return make_node(m, (int)op, type, 0, a, b, NULL);
}

struct machine_value *make_reinterpreted(struct machine *m, struct machine_value *a,
                                         struct machine_type type)
{
    if (!a)
        return NULL;
    if (a->type.width != type.width)
        return make_bad(m, "the same bits have the same width");
    if (a->op == NODE_REINTERPRET && !a->buffer)
        a = a->in[0];
    if (type_equal(a->type, type))
        return a;
    if (value_is_number(a))
        return make_number(m, type, a->imm);
    return make_node(m, NODE_REINTERPRET, type, 0, a, NULL, NULL);
}

struct machine_value *machine_reinterpret(struct machine *m, struct machine_value *a,
                                          struct machine_type type)
{
    return make_handed(m, make_reinterpreted(m, a, type));
}
