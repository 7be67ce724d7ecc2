/* lane_by_folding.c - any operation, lane by lane: the slow twin of the loops in fast_loops.h,
 * and the only way for what is rare there.
 *
 * A lane is its bits, zero-extended to 128. Numbers' operations are those that fold constants
 * (values/integer_fold.c, math_ops.c) and kernels/soft.cl. */
#include <math.h>
#include <string.h>

#include "base/errors.h"
#include "base/op_families.h"
#include "base/scalar.h"
#include "base/types.h"
#include "interpret/lanes.h"
#include "values/integers.h"
#include "values/math_ops.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include "soft.cl"
#pragma GCC diagnostic pop

typedef lanes_wide wide;

/* ---- numbers as lanes hold them ---- */

static double double_of(wide x, struct machine_type t)
{
    uint64_t bits = (uint64_t)x;
    uint32_t low = (uint32_t)x;
    double d;
    float f;
    memcpy(&d, &bits, sizeof d);
    memcpy(&f, &low, sizeof f);
    return t.width == 32 ? (double)f : d;
}

static wide bits_of(double x, struct machine_type t)
{
    float f = (float)x;
    uint32_t low;
    uint64_t bits;
    memcpy(&low, &f, sizeof low);
    memcpy(&bits, &x, sizeof bits);
    return t.width == 32 ? low : bits;
}

static wide ones(int width)
{
    return width >= 128 ? ~(wide)0 : ((wide)1 << width) - 1;
}

static bool is_negative(wide a, int width)
{
    return a >> (width - 1) & 1;
}

/* All 128 bits of a signed number of that width. */
static wide extended(wide a, int width)
{
    return is_negative(a, width) ? a | ~ones(width) : a;
}

/* ---- bits ---- */

static bool product_overflows(wide a, wide b, int width, bool is_signed)
{
    wide product;
    bool sa = is_signed && is_negative(a, width), sb = is_signed && is_negative(b, width);
    a = sa ? -a & ones(width) : a;
    b = sb ? -b & ones(width) : b;
    if (__builtin_mul_overflow(a, b, &product))
        return true;
    wide most = is_signed ? ones(width - 1) + (sa != sb) : ones(width);
    return product > most;
}

/* ---- floats ---- */

/* A sum, difference, product or quotient, rounded once to the format. */
static double float_binary(enum machine_op op, struct machine_type t, double a, double b)
{
    uint64_t x = (uint64_t)bits_of(a, MACHINE_F64), y = (uint64_t)bits_of(b, MACHINE_F64);
    float f = (float)a, g = (float)b;
    switch ((enum op_float_operator)op) {
    case OF_MACHINE_FADD:
        return t.s             ? double_of(soft_add(x, y, t.s, t.e), t)
               : t.width == 32 ? (double)(f + g)
                               : a + b;
    case OF_MACHINE_FSUB:
        return t.s             ? double_of(soft_add(x, y ^ SOFT_SIGN, t.s, t.e), t)
               : t.width == 32 ? (double)(f - g)
                               : a - b;
    case OF_MACHINE_FMUL:
        return t.s             ? double_of(soft_multiply(x, y, t.s, t.e), t)
               : t.width == 32 ? (double)(f * g)
                               : a * b;
    case OF_MACHINE_FDIV:
        return t.s             ? double_of(soft_divide(x, y, t.s, t.e), t)
               : t.width == 32 ? (double)(f / g)
                               : a / b;
    }
    INVARIANT(false);
}

/* A change of the sign moves the bits, a NaN's too. */
static wide float_function(int op, struct machine_type t, wide bits)
{
    const wide sign = (wide)1 << (t.width - 1);
    const double a = double_of(bits, t);
    switch ((enum op_float_function)op) {
    case OF_MACHINE_FNEG:
        return bits ^ sign;
    case OF_MACHINE_FABS:
        return bits & ~sign;
    case OF_MACHINE_FSQRT:
        return t.s             ? soft_root((uint64_t)bits, t.s, t.e)
               : t.width == 32 ? bits_of((double)sqrtf((float)a), t)
                               : bits_of(sqrt(a), t);
    case OF_MACHINE_FFLOOR:
        return bits_of(floor(a), t);
    case OF_MACHINE_FCEIL:
        return bits_of(ceil(a), t);
    case OF_MACHINE_FTRUNC:
        return bits_of(trunc(a), t);
    case OF_MACHINE_FROUND:
        return bits_of(rint(a), t);
    }
    INVARIANT(false);
}

/* A choice moves the bits of one operand, a NaN's too. */
static wide float_choice(int op, struct machine_type t, wide a, wide b)
{
    const double x = double_of(a, t), y = double_of(b, t);
    switch ((enum op_float_choice)op) {
    case OF_MACHINE_FMIN:
        return x < y ? a : b;
    case OF_MACHINE_FMAX:
        return x > y ? a : b;
    }
    INVARIANT(false);
}

static bool float_compare(int op, double a, double b)
{
    switch ((enum op_float_comparison)op) {
    case OF_MACHINE_FEQ:
        return a == b;
    case OF_MACHINE_FNE:
        return a != b;
    case OF_MACHINE_FLT:
        return a < b;
    case OF_MACHINE_FLE:
        return a <= b;
    case OF_MACHINE_FGT:
        return a > b;
    case OF_MACHINE_FGE:
        return a >= b;
    }
    INVARIANT(false);
}

static wide float_math(int op, struct machine_type t, wide a, wide b)
{
    const double x = double_of(a, t), y = double_of(b, t);
    double r = 0;
    if (t.width == 32 && !t.s)
        return math_evaluate_single(op, x, y, &r) ? bits_of(r, t) : 0;
    return math_evaluate(op, x, y, &r) ? bits_of(r, t) : 0;
}

/* ---- results that do not fit ---- */

static bool float_overflows(enum machine_op op, struct machine_type t, wide a, wide b)
{
    const double x = double_of(a, t), y = double_of(b, t);
    return isinf(float_binary(op, t, x, y)) && isfinite(x) && isfinite(y);
}

static bool overflows(int op, struct machine_type t, wide a, wide b)
{
    const int width = t.width;
    const wide sum = (a + b) & ones(width), difference = (a - b) & ones(width);
    switch ((enum op_overflow)op) {
    case OF_NODE_OVERFLOW_UADD:
        return sum < a;
    case OF_NODE_OVERFLOW_USUB:
        return a < b;
    case OF_NODE_OVERFLOW_UMUL:
        return product_overflows(a, b, width, false);
    case OF_NODE_OVERFLOW_SADD:
        return is_negative((a ^ sum) & (b ^ sum), width);
    case OF_NODE_OVERFLOW_SSUB:
        return is_negative((a ^ difference) & (a ^ b), width);
    case OF_NODE_OVERFLOW_SMUL:
        return product_overflows(a, b, width, true);
    case OF_NODE_OVERFLOW_SNEG:
        return a == (wide)1 << (width - 1);
    case OF_NODE_OVERFLOW_FADD:
        return float_overflows(MACHINE_FADD, t, a, b);
    case OF_NODE_OVERFLOW_FSUB:
        return float_overflows(MACHINE_FSUB, t, a, b);
    case OF_NODE_OVERFLOW_FMUL:
        return float_overflows(MACHINE_FMUL, t, a, b);
    case OF_NODE_OVERFLOW_FDIV:
        return float_overflows(MACHINE_FDIV, t, a, b);
    case OF_NODE_OVERFLOW_RESULT: /* a is the result, b the operand */
        return isinf(double_of(a, t)) && isfinite(double_of(b, t));
    }
    INVARIANT(false);
}

/* ---- between bits and floats ---- */

static wide float_to_bits(double v, int width, bool is_signed)
{
    double limit = ldexp(1, is_signed ? width - 1 : width);
    if (v != v || (!is_signed && v <= 0))
        return 0;
    if (v >= limit)
        return is_signed ? ones(width - 1) : ones(width);
    if (is_signed && v <= -limit)
        return (wide)1 << (width - 1);
    return v < 0 ? -(wide)-v : (wide)v;
}

static wide bits_to_float(const struct lanes_step *s, wide a)
{
    bool negative = s->op == NODE_S_TO_F && is_negative(a, s->from.width);
    wide magnitude = negative ? -a & ones(s->from.width) : a;
    if (s->type.s)
        return soft_whole(negative, (uint64_t)magnitude, (uint64_t)(magnitude >> 64), s->type.s,
                          s->type.e);
    if (s->type.width == 32)
        return bits_of(negative ? -(double)(float)magnitude : (double)(float)magnitude,
                       s->type);
    return bits_of(negative ? -(double)magnitude : (double)magnitude, s->type);
}

static wide converted(const struct lanes_step *s, wide a)
{
    switch ((enum op_conversion)s->op) {
    case OF_NODE_ZERO_EXTEND:
    case OF_NODE_EXTRACT:
        return a >> s->detail;
    case OF_NODE_SIGN_EXTEND:
        return extended(a, s->from.width);
    case OF_NODE_REINTERPRET:
        return a;
    case OF_NODE_U_TO_F:
    case OF_NODE_S_TO_F:
        return bits_to_float(s, a);
    case OF_NODE_F_TO_U:
    case OF_NODE_F_TO_S:
        return float_to_bits(double_of(a, s->from), s->type.width, s->op == NODE_F_TO_S);
    case OF_NODE_F_TO_F:
        return bits_of(double_of(a, s->from), s->type);
    case OF_NODE_PACK:
        return soft_pack((uint64_t)a, s->from.s, s->from.e);
    case OF_NODE_UNPACK:
        return soft_unpack((uint64_t)a, s->type.s, s->type.e);
    }
    INVARIANT(false);
}

/* An operation beside the graph's; all others of enum lanes_op have loops for each type. */
static wide beside(const struct lanes_step *s, wide a, wide b)
{
    if (s->op == LANES_JOIN)
        return a | b << s->detail;
    if (s->op == LANES_FIT)
        return soft_fit((uint64_t)a, s->type.s, s->type.e);
    INVARIANT(s->op == LANES_COPY);
    return a;
}

/* ---- any ---- */

static wide evaluated(const struct lanes_step *s, wide a, wide b, wide c)
{
    int op = s->op;
    if (op >= NODE_OP_COUNT)
        return beside(s, a, b);
    switch ((enum op_spell)node_ops[op].spell) {
    case SPELL_SELECT:
        return a ? b : c;
    case SPELL_INTEGER:
        return integer_fold((enum machine_op)op, s->from.width, a, b);
    case SPELL_BITS_ONE:
    case SPELL_BITS:
        return bits_fold((enum machine_op)op, s->from.width, a, b);
    case SPELL_OVERFLOW:
        return overflows(op, s->from, a, b);
    case SPELL_FLOAT_FUNCTION:
        return float_function(op, s->from, a);
    case SPELL_FLOAT_OPERATOR:
        return bits_of(float_binary((enum machine_op)op, s->from, double_of(a, s->from),
                                    double_of(b, s->from)),
                       s->from);
    case SPELL_FLOAT_CHOICE:
        return float_choice(op, s->from, a, b);
    case SPELL_FLOAT_COMPARISON:
        return float_compare(op, double_of(a, s->from), double_of(b, s->from));
    case SPELL_MATH:
        return float_math(op, s->from, a, b);
    case SPELL_CONVERSION:
        return converted(s, a);
    case SPELL_PLACE:  /* generated or fetched */
    case SPELL_CONCAT: /* steps of LANES_JOIN */
        break;
    }
    INVARIANT(false);
}

static wide lane_get(const void *from, size_t bytes, int i)
{
    wide x = 0;
    memcpy(&x, (const char *)from + (size_t)i * bytes, bytes);
    return x;
}

/* The type of an operand: a select's first is a bit; a count is of 32 bits. */
static size_t operand_bytes(const struct lanes_step *s, int k)
{
    if (s->op == NODE_SELECT)
        return k ? lanes_bytes(lanes_class_of(s->type)) : 1;
    if (s->op < NODE_OP_COUNT && node_ops[s->op].fold == FOLD_SHIFT && k)
        return 4;
    return lanes_bytes(lanes_class_of(s->from));
}

void lane_each(const struct lanes_step *s, void *const *at, int n)
{
    size_t to_bytes = lanes_bytes(lanes_class_of(s->type)), bytes[3] = {0};
    int count = lanes_inputs(s->op);
    const void *in[3] = {NULL};
    for (int k = 0; k < count; k++) {
        in[k] = at[s->in[k]];
        bytes[k] = operand_bytes(s, k);
    }
    for (int i = 0; i < n; i++) {
        wide a = lane_get(in[0], bytes[0], i), b = count > 1 ? lane_get(in[1], bytes[1], i) : 0,
             c = count > 2 ? lane_get(in[2], bytes[2], i) : 0;
        wide r = evaluated(s, a, b, c) & s->mask;
        memcpy((char *)at[s->to] + (size_t)i * to_bytes, &r, to_bytes);
    }
}
