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

bool machine_op_is_function(int op)
{
    return op >= 0 && op < MACHINE_OP_COUNT_PUBLIC && node_ops[op].fold == FOLD_MATH;
}
