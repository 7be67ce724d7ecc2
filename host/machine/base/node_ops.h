/* node_ops.h - the operations of the graph: each a row of one table. */
#ifndef LUTETIA_MACHINE_NODE_OPS_H
#define LUTETIA_MACHINE_NODE_OPS_H

#include "machine.h"

enum node_op {
    /* 0 .. MACHINE_OP_COUNT_PUBLIC - 1 are enum machine_op */
    NODE_CONSTANT = MACHINE_OP_COUNT_PUBLIC, /* imm */
    NODE_BUFFER,                             /* materialised: see buffer */
    NODE_COORDINATE,                         /* axis */
    NODE_INDEX,                              /* row-major */
    NODE_SEND_ADDRESS,
    NODE_RANDOM,      /* imm.lo key, imm.hi limit (0: all bits); detail 1: limit fits 32 bits */
    NODE_SELECT,      /* in: condition, a, b */
    NODE_SHIFT,       /* axis, detail = distance */
    NODE_ZERO_EXTEND, /* also truncates */
    NODE_SIGN_EXTEND,
    NODE_EXTRACT, /* detail = offset */
    NODE_CONCAT,  /* in: low, high */
    NODE_REINTERPRET,
    NODE_U_TO_F,
    NODE_S_TO_F,
    NODE_F_TO_U,
    NODE_F_TO_S,
    NODE_F_TO_F,
    NODE_PACK,          /* a float of another format -> its bits; values/soft.c */
    NODE_UNPACK,        /* and back */
    NODE_OVERFLOW_UADD, /* operands -> bit: the result does not fit */
    NODE_OVERFLOW_USUB,
    NODE_OVERFLOW_UMUL,
    NODE_OVERFLOW_SADD,
    NODE_OVERFLOW_SSUB,
    NODE_OVERFLOW_SMUL,
    NODE_OVERFLOW_SNEG,
    NODE_OVERFLOW_FADD,
    NODE_OVERFLOW_FSUB,
    NODE_OVERFLOW_FMUL,
    NODE_OVERFLOW_FDIV,
    NODE_OVERFLOW_RESULT, /* in: result, operand: infinite from finite */
    NODE_SLICE, /* in: a value of another VP set, in memory; imm.lo k, detail i: see reshape.h */
    NODE_OP_COUNT
};

struct node_op_info {
    const char *name; /* in dumps, and of the prelude's function */
    uint8_t inputs;   /* operands */
    uint8_t cost;     /* vector instructions, about */
    uint8_t nan;      /* enum nan */
};

/* May an operation's result be a NaN with bits that are not *the* NaN's (NAN_32, NAN_64)? Devices that keep NaNs give
 * that one for the last kind of operations, of operands with no other. */
enum nan { NAN_NEVER, NAN_ANY, NAN_KEPT };
extern const struct node_op_info node_ops[NODE_OP_COUNT];
#define GENERATOR_NONE 255 /* reads memory, or is dear: stored like any value */
#define GENERATOR_CHEAP                                                                        \
    24 /* a function of coordinates and constants this cheap is never stored */

static inline int node_cost(int op, struct machine_type type)
{
    bool rounds = type.s && node_ops[op].inputs && op != NODE_SELECT;
    return node_ops[op].cost + (rounds ? type.s <= 24 && type.e <= 9 ? 8 : 40 : 0);
}

static inline bool op_is_math(int op)
{
    return op >= MACHINE_FEXP && op <= MACHINE_FSCALE;
}

static inline bool op_is_integer(int op)
{
    return op >= MACHINE_UDIV && op <= MACHINE_ISQRT;
}

#endif
