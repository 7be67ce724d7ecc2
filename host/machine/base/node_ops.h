/* node_ops.h - the operations of the graph: the rows of machine_op.tab as two arrays.
 *
 * What a row promises, to whoever makes kernels, byte code or numbers of the graph:
 *
 *     name, inputs   the operation has that many operands, in[0] first, and no more are looked
 *                    at
 *     takes, gives   the operands' kind where machine_unary() or machine_binary() make it; the
 *                    result's type: the first operand's (GIVES_SAME), one bit (GIVES_BIT), or
 *                    what the node's type says (GIVES_SAID)
 *     cost           vector instructions, about: for choosing among plans, never for what is
 *                    right
 *     nan            which NaNs the result may be: see enum op_nan
 *     fold           who computes it of numbers on the front end, with the device's bits
 *     spell          who writes it in OpenCL C: the function of codegen/ with that family's
 *                    name
 *     flags          facts that more than one place asks for: see enum op_flags
 *
 * and node_words[]: the operator or function by which kernels call it, and a second one, whose
 * use the family says. A row is all that decides: nothing follows from an operation's number.
 * The test `machine_operations` holds every row to this. */
#ifndef LUTETIA_MACHINE_NODE_OPS_H
#define LUTETIA_MACHINE_NODE_OPS_H

#include "base/types.h"

/* The operations that callers name have the numbers of enum machine_op; the graph's own
 * follow. */
enum node_op {
    NODE_BEFORE = MACHINE_OP_COUNT_PUBLIC - 1,
#define OPERATION(op, ...)
#define NODE(op, ...) op,
#include "machine_op.tab"
#undef OPERATION
#undef NODE
    NODE_OP_COUNT
};

/* A cross within an aligned run of so many processors: what it looks at may wait to be
 * computed. */
enum { CROSS_NEAR = 512 };
/* The bits of a cross: all below CROSS_NEAR; none; some. */
enum cross_kind { CROSS_LANES, CROSS_BLOCKS, CROSS_BOTH };

enum op_takes {
    TAKES_BITS,
    TAKES_FLOATS,
    TAKES_ANY /* the function that makes it checks */
};

enum op_gives { GIVES_SAME, GIVES_BIT, GIVES_SAID };

/* May the result be a NaN whose bits are not *the* NaN's (NAN_32, NAN_64)? */
enum op_nan {
    NAN_NEVER,
    NAN_ANY,     /* it may */
    NAN_KEPT,    /* devices that keep NaNs give *the* NaN, of operands with no other */
    NAN_SECOND,  /* likewise; b where either is a NaN, so a number for b never gives one */
    NAN_PASSED,  /* what its operands may be */
    NAN_NUMBER,  /* a number's bits are known */
    NAN_STRANGE, /* memory: the program's own NaNs, with any bits */
};

/* Whether it reads the bits of its operand, of a NaN's, too. */
static inline bool node_reads_bits(int op)
{
    return op == NODE_REINTERPRET || op == NODE_PACK;
}

/* The front end's folding, where all operands are numbers. */
enum op_fold {
    FOLD_NEVER,
    FOLD_MAKER,    /* by the function that makes it: values/shapes.c, simplify.c, make.c */
    FOLD_BITS,     /* values/arithmetic.c */
    FOLD_QUOTIENT, /* these four: values/integer_fold.c */
    FOLD_POWER,
    FOLD_SHIFT, /* b is a count of 32 bits, not of a's type */
    FOLD_COUNT,
    FOLD_MATH /* values/math_ops.c */
};

/* Words of kernels, by family; "second" is the second word. */
enum op_spell {
    SPELL_PLACE,          /* none: memory, numbers, what is made of a processor's place */
    SPELL_BITS_ONE,       /* word: an operator; second: the function of two words of 64 bits */
    SPELL_BITS,           /* word: an operator or function; second: likewise */
    SPELL_INTEGER,        /* word: a function of integers.cl; second: how it rounds */
    SPELL_FLOAT_FUNCTION, /* word: a function; second: soft.cl's, where it rounds there */
    SPELL_FLOAT_OPERATOR, /* word: an operator; second: soft.cl's function */
    SPELL_FLOAT_CHOICE,   /* word: a where a WORD b, else b */
    SPELL_FLOAT_COMPARISON, /* word: an operator */
    SPELL_MATH,             /* word: a function of math.cl */
    SPELL_SELECT,
    SPELL_CONCAT,
    SPELL_CONVERSION,
    /* word: the operator of floats that overflows; second: soft.cl's function */
    SPELL_OVERFLOW,
};

enum op_flags {
    OP_ALONE = 1,     /* each processor's result follows from its own operands alone */
    OP_SIGNED = 2,    /* integers: the operands' highest bit is a sign */
    OP_WIDTH = 4,     /* integers: the kernels' function wants the width */
    OP_CUTS = 8,      /* bits above the width are to be cleared */
    OP_ORDERS = 16,   /* compares with < or <=: against a coordinate it is one side of a line */
    OP_BIT_KEPT = 32, /* integers, two operands: where the first is one bit it gives that bit */
    OP_NARROW = 64,   /* can be done in lanes of 8 or 16 bits: codegen/narrow_spell.c */
    OP_NARROW_BITS = 128 /* ... of operands of one bit, too */
};

struct node_op_info {
    const char *name; /* in dumps, and of the prelude's function */
    uint8_t inputs;   /* operands */
    uint8_t cost;     /* vector instructions, about */
    uint8_t nan;      /* enum op_nan; and so on */
    uint8_t takes, gives, fold, spell, flags;
};
extern const struct node_op_info node_ops[NODE_OP_COUNT];

/* NULL: it has none. */
struct node_words {
    const char *word, *second;
};
extern const struct node_words node_words[NODE_OP_COUNT];

#define GENERATOR_NONE 255 /* reads memory, or is dear: stored like any value */
#define GENERATOR_CHEAP                                                                        \
    24 /* a function of coordinates and constants this cheap is never stored */

static inline int node_cost(int op, struct machine_type type)
{
    bool rounds = type.s && node_ops[op].inputs && op != NODE_SELECT;
    return node_ops[op].cost + (rounds ? type_is_short(type) ? 8 : 40 : 0);
}

static inline bool op_has(int op, enum op_flags flag)
{
    return node_ops[op].flags & flag;
}

/* Whether operand k is looked at where the operation's processor is; else anywhere. */
static inline bool op_reads_own(int op, int k)
{
    return op != NODE_SHIFT && !(op == NODE_CROSS && k == 0) && !(op == NODE_GATHER && k == 1);
}

static inline bool op_is_math(int op)
{
    return node_ops[op].fold == FOLD_MATH;
}

static inline bool op_is_integer(int op)
{
    return node_ops[op].spell == SPELL_INTEGER;
}

/* Floats of other formats than single and double: how a kernel comes to their rounding. */
enum op_soft {
    OP_SOFT_NOT,     /* there is nothing to round, or the type is single or double */
    OP_SOFT_LANES,   /* kernels/soft.cl, lane by lane */
    OP_SOFT_VECTORS, /* the double's result, rounded again by kernels/formats.cl */
};
/* Of an operation with that result, of an operand of type from. */
enum op_soft op_soft(int op, struct machine_type type, struct machine_type from);

/* A caller's operation on so many operands of that type? */
static inline bool op_suits(enum machine_op op, int inputs, struct machine_type type)
{
    return (unsigned)op < MACHINE_OP_COUNT_PUBLIC && node_ops[op].inputs == inputs &&
           (node_ops[op].takes == TAKES_FLOATS) == (type.kind == MACHINE_FLOAT);
}

#endif
