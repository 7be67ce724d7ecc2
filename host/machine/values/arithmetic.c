/* arithmetic.c - operations on one value and on two: folded, simplified, or made. */
#include "base/errors.h"
#include "base/op_families.h"
#include "base/parts.h"
#include "base/types.h"
#include "values/integers.h"
#include "values/make.h"
#include "values/math_ops.h"
#include "values/simplify.h"

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
                           scalar_narrow(bits_fold(op, a->type.width, scalar_wide(a->imm), 0)));
    if (op == MACHINE_NOT && a->type.width == 1)
        return simplify_not(m, a);
    if (op == MACHINE_NOT && simplify_chooses_number(a, 4))
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

static struct machine_value *exclusive_or(struct machine *m, struct machine_value *a,
                                          struct machine_value *b)
{
    if (value_is_number(b))
        return b->imm.lo ? simplify_not(m, a) : a;
    if (value_is_number(a))
        return a->imm.lo ? simplify_not(m, b) : b;
    if (a == b)
        return make_bit(m, 0);
    return make_node(m, MACHINE_XOR, MAKE_BIT_TYPE, 0, a, b, NULL);
}

static struct machine_value *equal_bits(struct machine *m, struct machine_value *a,
                                        struct machine_value *b)
{
    if (value_is_number(b))
        return b->imm.lo ? a : simplify_not(m, a);
    if (value_is_number(a))
        return a->imm.lo ? b : simplify_not(m, b);
    return exclusive_or(m, a, simplify_not(m, b));
}

/* Two single bits: each operation is an and, an or, or an exclusive or. As a signed number the
 * bit 1 is -1. */
static struct machine_value *of_bits(struct machine *m, enum machine_op op,
                                     struct machine_value *a, struct machine_value *b)
{
    switch ((enum op_bits)op) {
    case OF_MACHINE_AND:
    case OF_MACHINE_MUL:
    case OF_MACHINE_UMIN:
    case OF_MACHINE_SMAX:
        return simplify_and(m, a, b);
    case OF_MACHINE_OR:
    case OF_MACHINE_UMAX:
    case OF_MACHINE_SMIN:
        return simplify_or(m, a, b);
    case OF_MACHINE_ULT:
        return simplify_and(m, simplify_not(m, a), b);
    case OF_MACHINE_ULE:
        return simplify_or(m, simplify_not(m, a), b);
    case OF_MACHINE_SLT:
        return simplify_and(m, a, simplify_not(m, b));
    case OF_MACHINE_SLE:
        return simplify_or(m, a, simplify_not(m, b));
    case OF_MACHINE_EQ:
        return equal_bits(m, a, b);
    case OF_MACHINE_XOR:
    case OF_MACHINE_ADD:
    case OF_MACHINE_SUB:
    case OF_MACHINE_NE:
        return exclusive_or(m, a, b);
    case OF_MACHINE_NOT: /* these have one operand */
    case OF_MACHINE_NEG:
        break;
    }
    INVARIANT(false);
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
                           scalar_narrow(bits_fold(op, a->type.width, scalar_wide(a->imm),
                                                   scalar_wide(b->imm))));
    if (a->type.width == 1)
        return of_bits(m, op, a, b);
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
