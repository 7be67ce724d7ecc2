/* soft.c - floats of other formats than single and double: conversion between values and
 * fields.
 *
 * Their values are doubles (see machine_float_type()), so operations that are exact in
 * double need no rounding: comparisons, min, max, negation, whole parts that fit.
 */
#include "values/soft.h"

#include "base/parts.h"
#include "base/types.h"
#include "values/graph.h"

static struct machine_value *node(struct machine *m, int op, struct machine_type type,
                                  struct machine_value *a)
{
    struct machine_value key = {.op = (uint8_t)op,
                                .type = type,
                                .set = a->set ? a->set : (uint16_t)m->values->set_current,
                                .in = {a, NULL, NULL}};
    return graph_node(m, &key);
}

struct machine_value *soft_packed(struct machine *m, struct machine_value *v)
{
    struct machine_type bits = MACHINE_UINT(machine_type_bits(v->type));
    if (v->op == NODE_CONSTANT)
        return machine_constant(
            m, bits, (struct machine_scalar){type_packed_bits(v->imm.lo, v->type), 0});
    if (v->op == NODE_UNPACK && !v->buffer)
        return v->in[0]; /* a move: NaNs keep their bits */
    return node(m, NODE_PACK, bits, v);
}

struct machine_value *soft_unpacked(struct machine *m, struct machine_value *bits,
                                    struct machine_type type)
{
    if (!bits)
        return NULL;
    if (bits->op == NODE_CONSTANT)
        return machine_constant(
            m, type, (struct machine_scalar){type_unpacked_bits(bits->imm.lo, type), 0});
    /* What is in a buffer may have been brought there by something that does not round, such as
     * an upload. */
    if (bits->op == NODE_PACK && !bits->buffer && type_equal(bits->in[0]->type, type) &&
        bits->in[0]->op != NODE_BUFFER)
        return bits->in[0];
    return node(m, NODE_UNPACK, type, bits);
}
