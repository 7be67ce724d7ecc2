/* node_ops.c - the rows of machine_op.tab. */
#include "base/node_ops.h"

#include "base/errors.h"
#include "base/op_families.h"

#define NODE OPERATION
#define WORD(word) #word
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
#undef WORD

static enum op_soft soft_kind(struct machine_type t)
{
    return !t.s ? OP_SOFT_NOT : type_is_short(t) ? OP_SOFT_VECTORS : OP_SOFT_LANES;
}

static enum op_soft conversion_soft(int op, struct machine_type type, struct machine_type from)
{
    switch ((enum op_conversion)op) {
    case OF_NODE_REINTERPRET:
        return OP_SOFT_NOT;
    case OF_NODE_U_TO_F: /* a double need not hold them */
    case OF_NODE_S_TO_F:
        return type.s && from.width > 32 ? OP_SOFT_LANES : soft_kind(type);
    case OF_NODE_PACK:
        return soft_kind(from);
    case OF_NODE_ZERO_EXTEND:
    case OF_NODE_SIGN_EXTEND:
    case OF_NODE_EXTRACT:
    case OF_NODE_F_TO_U:
    case OF_NODE_F_TO_S:
    case OF_NODE_F_TO_F:
    case OF_NODE_UNPACK:
        return soft_kind(type);
    }
    INVARIANT(false);
}

enum op_soft op_soft(int op, struct machine_type type, struct machine_type from)
{
    switch ((enum op_spell)node_ops[op].spell) {
    case SPELL_FLOAT_CHOICE: /* one of its operands */
    case SPELL_SELECT:
        return OP_SOFT_NOT;
    case SPELL_FLOAT_FUNCTION: /* these two are exact */
        return op == MACHINE_FNEG || op == MACHINE_FABS ? OP_SOFT_NOT : soft_kind(type);
    case SPELL_OVERFLOW: /* of the result that the second word rounds, of operands otherwise */
        return soft_kind(node_words[op].second ? from : type);
    case SPELL_CONVERSION:
        return conversion_soft(op, type, from);
    case SPELL_PLACE:
    case SPELL_BITS_ONE:
    case SPELL_BITS:
    case SPELL_INTEGER:
    case SPELL_FLOAT_OPERATOR:
    case SPELL_FLOAT_COMPARISON:
    case SPELL_MATH:
    case SPELL_CONCAT:
        return soft_kind(type);
    }
    INVARIANT(false);
}

bool machine_op_is_function(int op)
{
    return op >= 0 && op < MACHINE_OP_COUNT_PUBLIC && node_ops[op].fold == FOLD_MATH;
}
