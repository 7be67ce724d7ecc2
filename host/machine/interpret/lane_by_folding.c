/* lane_by_folding.c - any operation, lane by lane: the slow twin of the loops in fast_loops.h, and the only way for what is rare there.
 *
 * A lane is its bits, zero-extended to 128. Numbers' operations are those that fold constants (values/integer_fold.c, math_ops.c)
 * and kernels/soft.cl. */
#include <math.h>
#include <string.h>

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

static bool bits_overflow(int op, int width, wide a, wide b)
{
    wide sum = (a + b) & ones(width), difference = (a - b) & ones(width);
    switch (op) {
    case NODE_OVERFLOW_UADD:
        return sum < a;
    case NODE_OVERFLOW_USUB:
        return a < b;
    case NODE_OVERFLOW_UMUL:
        return product_overflows(a, b, width, false);
    case NODE_OVERFLOW_SADD:
        return is_negative((a ^ sum) & (b ^ sum), width);
    case NODE_OVERFLOW_SSUB:
        return is_negative((a ^ difference) & (a ^ b), width);
    case NODE_OVERFLOW_SMUL:
        return product_overflows(a, b, width, true);
    default: /* SNEG */
        return a == (wide)1 << (width - 1);
    }
}

/* ---- floats ---- */

/* A sum, difference, product or quotient, rounded once to the format. */
static double float_binary(int op, struct machine_type t, double a, double b)
{
    uint64_t x = (uint64_t)bits_of(a, MACHINE_F64), y = (uint64_t)bits_of(b, MACHINE_F64);
    float f = (float)a, g = (float)b;
    switch (op) {
    case MACHINE_FADD:
    case NODE_OVERFLOW_FADD:
        return t.s             ? double_of(soft_add(x, y, t.s, t.e), t)
               : t.width == 32 ? (double)(f + g)
                               : a + b;
    case MACHINE_FSUB:
    case NODE_OVERFLOW_FSUB:
        return t.s             ? double_of(soft_add(x, y ^ SOFT_SIGN, t.s, t.e), t)
               : t.width == 32 ? (double)(f - g)
                               : a - b;
    case MACHINE_FMUL:
    case NODE_OVERFLOW_FMUL:
        return t.s             ? double_of(soft_multiply(x, y, t.s, t.e), t)
               : t.width == 32 ? (double)(f * g)
                               : a * b;
    default:
        return t.s             ? double_of(soft_divide(x, y, t.s, t.e), t)
               : t.width == 32 ? (double)(f / g)
                               : a / b;
    }
}

static double float_unary(int op, struct machine_type t, double a)
{
    switch (op) {
    case MACHINE_FSQRT:
        return t.s ? double_of(soft_root((uint64_t)bits_of(a, MACHINE_F64), t.s, t.e), t)
               : t.width == 32 ? (double)sqrtf((float)a)
                               : sqrt(a);
    case MACHINE_FFLOOR:
        return floor(a);
    case MACHINE_FCEIL:
        return ceil(a);
    case MACHINE_FTRUNC:
        return trunc(a);
    default: /* FROUND */
        return rint(a);
    }
}

static bool float_compare(int op, double a, double b)
{
    switch (op) {
    case MACHINE_FEQ:
        return a == b;
    case MACHINE_FNE:
        return a != b;
    case MACHINE_FLT:
        return a < b;
    case MACHINE_FLE:
        return a <= b;
    case MACHINE_FGT:
        return a > b;
    default: /* FGE */
        return a >= b;
    }
}

/* What moves bits moves them, NaNs too. */
static wide float_operation(int op, struct machine_type t, wide a, wide b)
{
    double x = double_of(a, t), y = double_of(b, t), r = 0;
    const wide sign = (wide)1 << (t.width - 1);
    switch (node_ops[op].spell) {
    case SPELL_FLOAT_CHOICE:
        return (op == MACHINE_FMIN ? x < y : x > y) ? a : b;
    case SPELL_FLOAT_COMPARISON:
        return float_compare(op, x, y);
    case SPELL_OVERFLOW:
        if (op != NODE_OVERFLOW_RESULT)
            return isinf(float_binary(op, t, x, y)) && isfinite(x) && isfinite(y);
        return isinf(x) && isfinite(y);
    case SPELL_FLOAT_OPERATOR:
        return bits_of(float_binary(op, t, x, y), t);
    case SPELL_MATH:
        if (t.width == 32 && !t.s)
            return math_evaluate_single(op, x, y, &r) ? bits_of(r, t) : 0;
        return math_evaluate(op, x, y, &r) ? bits_of(r, t) : 0;
    default:
        if (op == MACHINE_FNEG)
            return a ^ sign;
        return op == MACHINE_FABS ? a & ~sign : bits_of(float_unary(op, t, x), t);
    }
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

static wide converted(const struct lanes_step *s, wide a, wide b)
{
    switch (s->op) {
    case NODE_ZERO_EXTEND:
    case NODE_EXTRACT:
        return a >> s->detail;
    case NODE_SIGN_EXTEND:
        return extended(a, s->from.width);
    case NODE_U_TO_F:
    case NODE_S_TO_F:
        return bits_to_float(s, a);
    case NODE_F_TO_U:
    case NODE_F_TO_S:
        return float_to_bits(double_of(a, s->from), s->type.width, s->op == NODE_F_TO_S);
    case NODE_F_TO_F:
        return bits_of(double_of(a, s->from), s->type);
    case NODE_PACK:
        return soft_pack((uint64_t)a, s->from.s, s->from.e);
    case NODE_UNPACK:
        return soft_unpack((uint64_t)a, s->type.s, s->type.e);
    case LANES_JOIN:
        return a | b << s->detail;
    case LANES_FIT:
        return soft_fit((uint64_t)a, s->type.s, s->type.e);
    default: /* COPY */
        return a;
    }
}

/* ---- any ---- */

static wide evaluated(const struct lanes_step *s, wide a, wide b, wide c)
{
    int op = s->op;
    if (op >= NODE_OP_COUNT)
        return converted(s, a, b);
    switch (node_ops[op].spell) {
    case SPELL_SELECT:
        return a ? b : c;
    case SPELL_INTEGER:
        return integer_fold((enum machine_op)op, s->from.width, a, b);
    case SPELL_BITS_ONE:
    case SPELL_BITS:
        return bits_fold((enum machine_op)op, s->from.width, a, b);
    case SPELL_OVERFLOW:
        return s->from.kind == MACHINE_FLOAT ? float_operation(op, s->from, a, b)
                                             : bits_overflow(op, s->from.width, a, b);
    case SPELL_FLOAT_FUNCTION:
    case SPELL_FLOAT_OPERATOR:
    case SPELL_FLOAT_CHOICE:
    case SPELL_FLOAT_COMPARISON:
    case SPELL_MATH:
        return float_operation(op, s->from, a, b);
    default:
        return converted(s, a, b);
    }
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
