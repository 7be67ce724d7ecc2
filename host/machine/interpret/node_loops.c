/* node_loops.c - see node_loops.h. */
#include "interpret/node_loops.h"

#include "base/types.h"

/* Floats of other formats: what is not as with doubles, but for being rounded again. */
static bool is_soft(const struct plan_node *n, struct machine_type from)
{
    struct machine_type t = n->type.s ? n->type : from;
    if (!t.s)
        return false;
    switch (n->op) {
    case MACHINE_FADD:
    case MACHINE_FSUB:
    case MACHINE_FMUL:
    case MACHINE_FDIV:
    case MACHINE_FSQRT:
        return !type_is_short(t);
    case NODE_OVERFLOW_FADD:
    case NODE_OVERFLOW_FSUB:
    case NODE_OVERFLOW_FMUL:
    case NODE_OVERFLOW_FDIV:
    case NODE_PACK:
    case NODE_UNPACK:
        return true;
    case NODE_U_TO_F:
    case NODE_S_TO_F:
        return from.width > 32;
    default:
        return false;
    }
}

/* What moves numbers of the format has no need to, and keeps NaNs' bits. */
bool node_rounds(const struct plan_node *n)
{
    const bool moves = n->op == NODE_SELECT || n->op == NODE_UNPACK;
    return n->type.s && n->op != MACHINE_FNEG && n->op != MACHINE_FABS &&
           n->op != MACHINE_FMIN && n->op != MACHINE_FMAX && !moves;
}

lanes_function *node_loop(const struct plan_node *n, struct machine_type from)
{
    enum lanes_class a = lanes_class_of(from), to = lanes_class_of(n->type);
    if (is_soft(n, from))
        return NULL;
    if (n->op == NODE_SELECT)
        return lanes_find(n->op, lanes_bits_of(to));
    lanes_function *loop = lanes_find_conversion(n->op, a, to);
    return loop ? loop : lanes_find(n->op, a);
}
