/* node_loops.c - see node_loops.h. */
#include "interpret/node_loops.h"

#include "base/errors.h"
#include "base/types.h"

/* Floats of other formats: what is not as with doubles, but for being rounded again. */
static bool is_soft(const struct plan_node *n, struct machine_type from)
{
    struct machine_type t = n->type.s ? n->type : from;
    if (!t.s)
        return false;
    const bool soft = node_words[n->op].second; /* soft.cl has a function for it */
    switch ((enum op_spell)node_ops[n->op].spell) {
    case SPELL_FLOAT_FUNCTION:
    case SPELL_FLOAT_OPERATOR:
        return soft && !type_is_short(t);
    case SPELL_OVERFLOW:
        return soft;
    case SPELL_CONVERSION:
        return n->op == NODE_PACK || n->op == NODE_UNPACK ||
               ((n->op == NODE_U_TO_F || n->op == NODE_S_TO_F) && from.width > 32);
    case SPELL_PLACE:
    case SPELL_BITS_ONE:
    case SPELL_BITS:
    case SPELL_INTEGER:
    case SPELL_FLOAT_CHOICE:
    case SPELL_FLOAT_COMPARISON:
    case SPELL_MATH:
    case SPELL_SELECT:
    case SPELL_CONCAT:
        return false;
    }
    INVARIANT(false);
}

bool node_rounds(const struct plan_node *n, struct machine_type from)
{
    return n->type.s && n->op != NODE_UNPACK && op_soft(n->op, n->type, from) != OP_SOFT_NOT;
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
