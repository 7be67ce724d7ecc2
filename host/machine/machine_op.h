/* machine_op.h - the operations on values: see machine_unary() and machine_binary(). Their
 * rows are in machine_op.tab. */
#ifndef LUTETIA_MACHINE_OP_H
#define LUTETIA_MACHINE_OP_H

enum machine_op {
#define OPERATION(op, ...) op,
#define NODE(op, ...)
#include "machine_op.tab"
#undef OPERATION
#undef NODE
    MACHINE_OP_COUNT_PUBLIC
};

#endif
