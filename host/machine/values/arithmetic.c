/* arithmetic.c - operations on one value and on two: folded, simplified, or made. */
#include "base/errors.h"
#include "base/parts.h"
#include "base/types.h"
#include "values/integers.h"
#include "values/make.h"
#include "values/math_ops.h"
#include "values/rules.h"

/* Signed numbers of that width are in the order of what this makes of them. */
static unsigned __int128 ordered(unsigned __int128 a, int width)
{
    return a ^ (unsigned __int128)1 << (width - 1);
}

/* The rows with FOLD_BITS, of operands of that width. */
static unsigned __int128 fold_bits(enum machine_op op, int width, unsigned __int128 a,
                                   unsigned __int128 b)
{
    const bool less = a < b, signed_less = ordered(a, width) < ordered(b, width);
    switch ((int)op) {
    case MACHINE_NOT:
        return ~a;
    case MACHINE_NEG:
        return -a;
    case MACHINE_AND:
        return a & b;
    case MACHINE_OR:
        return a | b;
    case MACHINE_XOR:
        return a ^ b;
    case MACHINE_ADD:
        return a + b;
    case MACHINE_SUB:
        return a - b;
    case MACHINE_MUL:
        return a * b;
    case MACHINE_UMIN:
        return less ? a : b;
    case MACHINE_UMAX:
        return less ? b : a;
    case MACHINE_SMIN:
        return signed_less ? a : b;
    case MACHINE_SMAX:
        return signed_less ? b : a;
    case MACHINE_EQ:
        return a == b;
    case MACHINE_NE:
        return a != b;
    case MACHINE_ULT:
        return less;
    case MACHINE_ULE:
        return less || a == b;
    case MACHINE_SLT:
        return signed_less;
    case MACHINE_SLE:
        return signed_less || a == b;
    default:
        INVARIANT(node_ops[op].fold != FOLD_BITS); /* all such rows are above */
        return 0;
    }
}

static struct machine_value *unary(struct machine *m, enum machine_op op,
                                   struct machine_value *a)
{
    if (!a)
        return NULL;
    if (!op_suits(op, 1, a->type))
        return make_bad(m, "this operation does not take one operand of this type");
    struct machine_scalar math;
    if (value_is_number(a) && op_is_math((int)op) &&
        math_fold((int)op, a->type, a->imm, a->imm, &math))
        return make_number(m, a->type, type_rounded_scalar(math, a->type));
    if (op_is_integer((int)op))
        return integer_value(m, op, a, NULL);
    if (value_is_number(a) && node_ops[op].fold == FOLD_BITS)
        return make_number(m, a->type,
                           scalar_narrow(fold_bits(op, a->type.width, scalar_wide(a->imm), 0)));
    if (op == MACHINE_NOT && a->type.width == 1)
        return rules_not(m, a);
    if (op == MACHINE_NOT && rules_chooses_number(a, 4))
        return machine_select(m, a->in[0], machine_unary(m, op, a->in[1]),
                              machine_unary(m, op, a->in[2]));
    if (op == MACHINE_NEG && a->type.width == 1)
        return a;
    return make_node(m, (int)op, a->type, 0, a, NULL, NULL);
}

struct machine_value *machine_unary(struct machine *m, enum machine_op op,
                                    struct machine_value *a)
{
    struct machine_value *v = unary(m, op, a);
    m->values->vanished.numbers += v && value_is_number(v);
    return make_handed(m, v);
}

static struct machine_value *binary(struct machine *m, enum machine_op op,
                                    struct machine_value *a, struct machine_value *b)
{
    if (!a || !b)
        return NULL;
    if (!op_suits(op, 2, a->type) || !type_equal(a->type, b->type))
        return make_bad(m,
                        "this operation takes two operands of one type, which these are not");
    const struct node_op_info *row = &node_ops[op];
    struct machine_scalar math;
    if (value_is_number(a) && value_is_number(b) && op_is_math((int)op) &&
        math_fold((int)op, a->type, a->imm, b->imm, &math))
        return make_number(m, a->type, type_rounded_scalar(math, a->type));
    if (op_is_integer((int)op))
        return row->fold == FOLD_SHIFT ? machine_bits_shift(m, op, a, b)
                                       : integer_value(m, op, a, b);
    if (value_is_number(a) && value_is_number(b) && row->fold == FOLD_BITS)
        return make_number(m, row->gives == GIVES_BIT ? MAKE_BIT_TYPE : a->type,
                           scalar_narrow(fold_bits(op, a->type.width, scalar_wide(a->imm),
                                                   scalar_wide(b->imm))));
    if (a->type.width == 1) { /* bits have rules of their own */
        switch ((int)op) {
        case MACHINE_AND:
        case MACHINE_MUL:
        case MACHINE_UMIN:
        case MACHINE_SMAX: /* -1 is the bit 1 */
            return rules_and(m, a, b);
        case MACHINE_OR:
        case MACHINE_UMAX:
        case MACHINE_SMIN:
            return rules_or(m, a, b);
        case MACHINE_ULT:
            return rules_and(m, rules_not(m, a), b);
        case MACHINE_ULE:
            return rules_or(m, rules_not(m, a), b);
        case MACHINE_SLT:
            return rules_and(m, a, rules_not(m, b));
        case MACHINE_SLE:
            return rules_or(m, a, rules_not(m, b));
        case MACHINE_EQ:
            if (value_is_number(b))
                return b->imm.lo ? a : rules_not(m, a);
            if (value_is_number(a))
                return a->imm.lo ? b : rules_not(m, b);
            b = rules_not(m, b);
            op = MACHINE_XOR;
            break;
        default:
            op = MACHINE_XOR; /* XOR, ADD, SUB, NE */
            break;
        }
        if (value_is_number(b))
            return b->imm.lo ? rules_not(m, a) : a;
        if (value_is_number(a))
            return a->imm.lo ? rules_not(m, b) : b;
        if (a == b)
            return make_bit(m, 0);
        return make_node(m, MACHINE_XOR, MAKE_BIT_TYPE, 0, a, b, NULL);
    }
    if (a == b && (op == MACHINE_AND || op == MACHINE_OR))
        return a;
    return make_node(m, (int)op, row->gives == GIVES_BIT ? MAKE_BIT_TYPE : a->type, 0, a, b,
                     NULL);
}

struct machine_value *machine_binary(struct machine *m, enum machine_op op,
                                     struct machine_value *a, struct machine_value *b)
{
    struct machine_value *v = binary(m, op, a, b);
    m->values->vanished.numbers += v && value_is_number(v);
    return make_handed(m, v);
}
