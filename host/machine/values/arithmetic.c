/* arithmetic.c - operations on one value and on two: folded, simplified, or made. */
#include "base/parts.h"
#include "base/types.h"
#include "values/integers.h"
#include "values/make.h"
#include "values/math_ops.h"
#include "values/rules.h"

static bool fold_bits(enum machine_op op, unsigned __int128 a, unsigned __int128 b,
                      unsigned __int128 *out)
{
    switch ((int)op) {
    case MACHINE_NOT:
        *out = ~a;
        return true;
    case MACHINE_NEG:
        *out = -a;
        return true;
    case MACHINE_AND:
        *out = a & b;
        return true;
    case MACHINE_OR:
        *out = a | b;
        return true;
    case MACHINE_XOR:
        *out = a ^ b;
        return true;
    case MACHINE_ADD:
        *out = a + b;
        return true;
    case MACHINE_SUB:
        *out = a - b;
        return true;
    default:
        return false;
    }
}

static struct machine_value *unary(struct machine *m, enum machine_op op,
                                   struct machine_value *a)
{
    if (!a)
        return NULL;
    bool is_float = (op >= MACHINE_FNEG && op <= MACHINE_FROUND) ||
                    (op >= MACHINE_FEXP && op <= MACHINE_FATANH);
    if ((unsigned)op >= MACHINE_OP_COUNT_PUBLIC || node_ops[op].inputs != 1 ||
        is_float != (a->type.kind == MACHINE_FLOAT))
        return make_bad(m, "this operation does not take one operand of this type");
    struct machine_scalar math;
    if (value_is_number(a) && op_is_math((int)op) &&
        math_fold((int)op, a->type, a->imm, a->imm, &math))
        return make_number(m, a->type, type_rounded_scalar(math, a->type));
    if (op_is_integer((int)op))
        return integer_value(m, op, a, NULL);
    unsigned __int128 folded;
    if (value_is_number(a) && !is_float && fold_bits(op, scalar_wide(a->imm), 0, &folded))
        return make_number(m, a->type, scalar_narrow(folded));
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
    bool is_float = (op >= MACHINE_FADD && op <= MACHINE_FGE) ||
                    (op >= MACHINE_FATAN2 && op <= MACHINE_FSCALE);
    if ((unsigned)op >= MACHINE_OP_COUNT_PUBLIC || node_ops[op].inputs != 2 ||
        !type_equal(a->type, b->type) || is_float != (a->type.kind == MACHINE_FLOAT))
        return make_bad(m,
                        "this operation takes two operands of one type, which these are not");
    bool compares =
        (op >= MACHINE_EQ && op <= MACHINE_SLE) || (op >= MACHINE_FEQ && op <= MACHINE_FGE);
    struct machine_scalar math;
    if (value_is_number(a) && value_is_number(b) && op_is_math((int)op) &&
        math_fold((int)op, a->type, a->imm, b->imm, &math))
        return make_number(m, a->type, type_rounded_scalar(math, a->type));
    if (op_is_integer((int)op))
        return op >= MACHINE_USHIFT && op <= MACHINE_ROTATE ? machine_bits_shift(m, op, a, b)
                                                            : integer_value(m, op, a, b);
    unsigned __int128 folded;
    if (value_is_number(a) && value_is_number(b) && !is_float && !compares &&
        fold_bits(op, scalar_wide(a->imm), scalar_wide(b->imm), &folded))
        return make_number(m, a->type, scalar_narrow(folded));
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
    return make_node(m, (int)op, compares ? MAKE_BIT_TYPE : a->type, 0, a, b, NULL);
}

struct machine_value *machine_binary(struct machine *m, enum machine_op op,
                                     struct machine_value *a, struct machine_value *b)
{
    struct machine_value *v = binary(m, op, a, b);
    m->values->vanished.numbers += v && value_is_number(v);
    return make_handed(m, v);
}
