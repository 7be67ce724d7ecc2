/* node_ops.c - the rows of machine_op.tab. */
#include "base/node_ops.h"

#define NODE OPERATION
const struct node_op_info node_ops[NODE_OP_COUNT] = {
#define OPERATION(op, name, inputs, takes, gives, cost, nan, fold, spell, word, second, flags) \
    [op] = {name, inputs, cost, nan, takes, gives, fold, spell, flags},
#include "machine_op.tab"
#undef OPERATION
};

const struct node_words node_words[NODE_OP_COUNT] = {
#define OPERATION(op, name, inputs, takes, gives, cost, nan, fold, spell, word, second, flags) \
    [op] = {word, second},
#include "machine_op.tab"
#undef OPERATION
};
#undef NODE

static enum op_soft soft_kind(struct machine_type t)
{
    return !t.s ? OP_SOFT_NOT : type_is_short(t) ? OP_SOFT_VECTORS : OP_SOFT_LANES;
}

enum op_soft op_soft(int op, struct machine_type type, struct machine_type from)
{
    switch (op) {
    case MACHINE_FNEG: /* exact, or one of its operands */
    case MACHINE_FABS:
    case MACHINE_FMIN:
    case MACHINE_FMAX:
    case NODE_SELECT:
    case NODE_REINTERPRET:
        return OP_SOFT_NOT;
    case NODE_U_TO_F: /* a double need not hold them */
    case NODE_S_TO_F:
        return type.s && from.width > 32 ? OP_SOFT_LANES : soft_kind(type);
    case NODE_PACK:
    case NODE_OVERFLOW_FADD:
    case NODE_OVERFLOW_FSUB:
    case NODE_OVERFLOW_FMUL:
    case NODE_OVERFLOW_FDIV:
        return soft_kind(from);
    default:
        return soft_kind(type);
    }
}

bool machine_op_is_function(int op)
{
    return op >= 0 && op < MACHINE_OP_COUNT_PUBLIC && node_ops[op].fold == FOLD_MATH;
}
