/* op_families.h - the operations of each family of machine_op.tab as an enum of its own.
 *
 * A function that must know every operation of a family switches over that family's enum,
 * without a default: when a row joins the family, the compiler names each switch that lacks it
 * (-Wswitch-enum). An enumerator is the operation's name behind OF_.
 *
 *     switch ((enum op_float_choice)op) {
 *     case OF_MACHINE_FMIN:
 *         return x < y ? a : b;
 *     case OF_MACHINE_FMAX:
 *         return x > y ? a : b;
 *     }
 *     INVARIANT(false); // op is of another family
 *
 * Operations on bits, integers and functions go by their column "folding", all others by their
 * column "spelling". */
#ifndef LUTETIA_MACHINE_OP_FAMILIES_H
#define LUTETIA_MACHINE_OP_FAMILIES_H

#include "base/node_ops.h"

#define OPERATION(op, name, inputs, takes, gives, cost, nan, fold, spell, ...)                 \
    IN_##fold(op) IN_##spell(op)
#define NODE OPERATION

/* A row's columns name no family, but for the one whose enum is being made. */
#define IN_FOLD_NEVER(op)
#define IN_FOLD_MAKER(op)
#define IN_FOLD_BITS(op)
#define IN_FOLD_QUOTIENT(op)
#define IN_FOLD_POWER(op)
#define IN_FOLD_SHIFT(op)
#define IN_FOLD_COUNT(op)
#define IN_FOLD_MATH(op)
#define IN_SPELL_PLACE(op)
#define IN_SPELL_BITS_ONE(op)
#define IN_SPELL_BITS(op)
#define IN_SPELL_INTEGER(op)
#define IN_SPELL_FLOAT_FUNCTION(op)
#define IN_SPELL_FLOAT_OPERATOR(op)
#define IN_SPELL_FLOAT_CHOICE(op)
#define IN_SPELL_FLOAT_COMPARISON(op)
#define IN_SPELL_MATH(op)
#define IN_SPELL_SELECT(op)
#define IN_SPELL_CONCAT(op)
#define IN_SPELL_CONVERSION(op)
#define IN_SPELL_OVERFLOW(op)

#undef IN_FOLD_BITS
#define IN_FOLD_BITS(op) OF_##op = op,
enum op_bits {
#include "machine_op.tab"
};
#undef IN_FOLD_BITS
#define IN_FOLD_BITS(op)

#undef IN_FOLD_QUOTIENT
#define IN_FOLD_QUOTIENT(op) OF_##op = op,
enum op_quotient {
#include "machine_op.tab"
};
#undef IN_FOLD_QUOTIENT
#define IN_FOLD_QUOTIENT(op)

#undef IN_FOLD_POWER
#define IN_FOLD_POWER(op) OF_##op = op,
enum op_power {
#include "machine_op.tab"
};
#undef IN_FOLD_POWER
#define IN_FOLD_POWER(op)

#undef IN_FOLD_SHIFT
#define IN_FOLD_SHIFT(op) OF_##op = op,
enum op_shift {
#include "machine_op.tab"
};
#undef IN_FOLD_SHIFT
#define IN_FOLD_SHIFT(op)

#undef IN_FOLD_COUNT
#define IN_FOLD_COUNT(op) OF_##op = op,
enum op_count {
#include "machine_op.tab"
};
#undef IN_FOLD_COUNT
#define IN_FOLD_COUNT(op)

#undef IN_FOLD_MATH
#define IN_FOLD_MATH(op) OF_##op = op,
enum op_math {
#include "machine_op.tab"
};
#undef IN_FOLD_MATH
#define IN_FOLD_MATH(op)

#undef IN_SPELL_FLOAT_FUNCTION
#define IN_SPELL_FLOAT_FUNCTION(op) OF_##op = op,
enum op_float_function {
#include "machine_op.tab"
};
#undef IN_SPELL_FLOAT_FUNCTION
#define IN_SPELL_FLOAT_FUNCTION(op)

#undef IN_SPELL_FLOAT_OPERATOR
#define IN_SPELL_FLOAT_OPERATOR(op) OF_##op = op,
enum op_float_operator {
#include "machine_op.tab"
};
#undef IN_SPELL_FLOAT_OPERATOR
#define IN_SPELL_FLOAT_OPERATOR(op)

#undef IN_SPELL_FLOAT_CHOICE
#define IN_SPELL_FLOAT_CHOICE(op) OF_##op = op,
enum op_float_choice {
#include "machine_op.tab"
};
#undef IN_SPELL_FLOAT_CHOICE
#define IN_SPELL_FLOAT_CHOICE(op)

#undef IN_SPELL_FLOAT_COMPARISON
#define IN_SPELL_FLOAT_COMPARISON(op) OF_##op = op,
enum op_float_comparison {
#include "machine_op.tab"
};
#undef IN_SPELL_FLOAT_COMPARISON
#define IN_SPELL_FLOAT_COMPARISON(op)

#undef IN_SPELL_CONVERSION
#define IN_SPELL_CONVERSION(op) OF_##op = op,
enum op_conversion {
#include "machine_op.tab"
};
#undef IN_SPELL_CONVERSION
#define IN_SPELL_CONVERSION(op)

#undef IN_SPELL_OVERFLOW
#define IN_SPELL_OVERFLOW(op) OF_##op = op,
enum op_overflow {
#include "machine_op.tab"
};
#undef IN_SPELL_OVERFLOW
#define IN_SPELL_OVERFLOW(op)

#undef OPERATION
#undef NODE

#endif
