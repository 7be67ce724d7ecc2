/* integer_fold.c - values of integers' quotients, powers, shifts and counts:
 * kernels/integers.cl computes them; results of constants are computed here.
 *
 * A single bit is represented differently from wider numbers (spell.c). An operation on one
 * operand of one bit is computed here, for 0 and for 1. For operations on two, the bits are
 * extended to two bits: value and sign stay the same, and the low bit of the result is the
 * result.
 */
#include "values/integers.h"

#include "base/errors.h"
#include "base/op_families.h"
#include "base/parts.h"
#include "base/scalar.h"
#include "values/make.h"
#include "values/simplify.h"

typedef unsigned __int128 number;

static number mask_of(int width)
{
    return width >= 128 ? ~(number)0 : ((number)1 << width) - 1;
}

static struct machine_scalar scalar(number x)
{
    return (struct machine_scalar){(uint64_t)x, (uint64_t)(x >> 64)};
}

/* ---- numbers ---- */

static bool is_negative(number a, int width)
{
    return a >> (width - 1) & 1;
}

static number negated(number a, int width)
{
    return -a & mask_of(width);
}

static number fold_divided(int op, int width, number a, number b)
{
    bool is_signed = op_has(op, OP_SIGNED), sa = is_signed && is_negative(a, width),
         sb = is_signed && is_negative(b, width), negative = sa != sb;
    number x = sa ? negated(a, width) : a, y = sb ? negated(b, width) : b;
    number q = y ? x / y : 0, r = y ? x % y : x;
    bool inexact = y && r, up = false;
    switch ((enum op_quotient)op) {
    case OF_MACHINE_UREM:
    case OF_MACHINE_SREM:
        return sa ? negated(r, width) : r;
    case OF_MACHINE_SMOD:
        r = negative && r ? y - r : r;
        return (sb ? -r : r) & mask_of(width);
    case OF_MACHINE_UDIV:
    case OF_MACHINE_SDIV:
        break;
    case OF_MACHINE_SFLOOR:
        up = inexact && negative;
        break;
    case OF_MACHINE_UCEIL:
    case OF_MACHINE_SCEIL:
        up = inexact && !negative;
        break;
    case OF_MACHINE_UROUND:
    case OF_MACHINE_SROUND:
        up = inexact && (r > y - r || (r == y - r && (q & 1)));
        break;
    }
    q += up;
    return (negative ? -q : q) & mask_of(width);
}

static bool product_beyond(number a, number b, int width)
{
    number p;
    return __builtin_mul_overflow(a, b, &p) || p > mask_of(width);
}

/* a to the power b, modulo 2^128; and whether it is 2^width or more. */
static number raised(number a, number b, int width, bool *beyond)
{
    number r = 1;
    bool square = false;
    *beyond = false;
    for (; b; b >>= 1) {
        if (b & 1) {
            *beyond = *beyond || square || product_beyond(r, a, width);
            r *= a;
        }
        square = square || product_beyond(a, a, width);
        a *= a;
    }
    return r;
}

static number fold_power(int op, int width, number a, number b)
{
    const number limit = (number)1 << (width - 1);
    bool beyond, negative = op == MACHINE_SPOW_BEYOND && is_negative(a, width);
    number p = raised(negative ? negated(a, width) : a, b, width, &beyond) & mask_of(width);
    switch ((enum op_power)op) {
    case OF_MACHINE_POW:
        return p;
    case OF_MACHINE_UPOW_BEYOND:
        return beyond;
    case OF_MACHINE_SPOW_BEYOND:
        return beyond || !(p < limit || (p == limit && negative && (b & 1)));
    }
    INVARIANT(false);
}

static number shifted(number a, int n)
{
    if (n >= 128 || n <= -128)
        return 0;
    return n >= 0 ? a << n : a >> -n;
}

static number fold_shifted(int op, int width, number a, int n)
{
    switch ((enum op_shift)op) {
    case OF_MACHINE_ROTATE:
        return n ? a << n | a >> (width - n) : a;
    case OF_MACHINE_SSHIFT:
        if (is_negative(a, width) && n < 0) /* the complement's, complemented */
            return ~shifted(~a & mask_of(width), n) & mask_of(width);
        return shifted(a, n);
    case OF_MACHINE_USHIFT:
        return shifted(a, n);
    }
    INVARIANT(false);
}

static number fold_counted(int op, int width, number a)
{
    number r = 0;
    switch ((enum op_count)op) {
    case OF_MACHINE_POPCOUNT:
        for (; a; a &= a - 1)
            r++;
        return r;
    case OF_MACHINE_LENGTH:
        for (; a; a >>= 1)
            r++;
        return r;
    case OF_MACHINE_REVERSE:
        for (int i = 0; i < width; i++)
            r |= (a >> i & 1) << (width - 1 - i);
        return r;
    case OF_MACHINE_UNGRAY:
        for (; a; a >>= 1)
            r ^= a;
        return r;
    case OF_MACHINE_ISQRT:
        for (int bit = 63; bit >= 0; bit--) {
            number t = r | (number)1 << bit;
            if (t * t <= a)
                r = t;
        }
        return r;
    }
    INVARIANT(false);
}

number integer_fold(enum machine_op op, int width, number a, number b)
{
    switch ((enum op_fold)node_ops[op].fold) {
    case FOLD_QUOTIENT:
        return fold_divided((int)op, width, a, b);
    case FOLD_POWER:
        return fold_power((int)op, width, a, b);
    case FOLD_SHIFT:
        return fold_shifted((int)op, width, a, (int)(int32_t)(uint32_t)b);
    case FOLD_COUNT:
        return fold_counted((int)op, width, a);
    case FOLD_NEVER: /* no whole number's operation folds so */
    case FOLD_MAKER:
    case FOLD_BITS:
    case FOLD_MATH:
        break;
    }
    INVARIANT(false);
}

/* ---- bits ---- */

/* Signed numbers of that width are in the order of what this makes of them. */
static unsigned __int128 ordered(unsigned __int128 a, int width)
{
    return a ^ (unsigned __int128)1 << (width - 1);
}

unsigned __int128 bits_fold(enum machine_op op, int width, unsigned __int128 a,
                            unsigned __int128 b)
{
    const bool less = a < b, signed_less = ordered(a, width) < ordered(b, width);
    switch ((enum op_bits)op) {
    case OF_MACHINE_NOT:
        return ~a;
    case OF_MACHINE_NEG:
        return -a;
    case OF_MACHINE_AND:
        return a & b;
    case OF_MACHINE_OR:
        return a | b;
    case OF_MACHINE_XOR:
        return a ^ b;
    case OF_MACHINE_ADD:
        return a + b;
    case OF_MACHINE_SUB:
        return a - b;
    case OF_MACHINE_MUL:
        return a * b;
    case OF_MACHINE_UMIN:
        return less ? a : b;
    case OF_MACHINE_UMAX:
        return less ? b : a;
    case OF_MACHINE_SMIN:
        return signed_less ? a : b;
    case OF_MACHINE_SMAX:
        return signed_less ? b : a;
    case OF_MACHINE_EQ:
        return a == b;
    case OF_MACHINE_NE:
        return a != b;
    case OF_MACHINE_ULT:
        return less;
    case OF_MACHINE_ULE:
        return less || a == b;
    case OF_MACHINE_SLT:
        return signed_less;
    case OF_MACHINE_SLE:
        return signed_less || a == b;
    }
    INVARIANT(false);
}

/* ---- values ---- */

static number number_of(const struct machine_value *v)
{
    return (number)v->imm.hi << 64 | v->imm.lo;
}

/* The operation of one bit: it keeps the bit, inverts it, or gives the same for 0 and 1. */
static struct machine_value *of_one_bit(struct machine *m, enum machine_op op,
                                        struct machine_value *a)
{
    bool zero = integer_fold(op, 1, 0, 0) & 1, one = integer_fold(op, 1, 1, 0) & 1;
    if (zero == one)
        return machine_constant(m, MACHINE_BIT, scalar(zero));
    return one ? a : simplify_not(m, a);
}

/* Operands have one width but for shifts, whose b is a count of 32 bits. */
struct machine_value *integer_value(struct machine *m, enum machine_op op,
                                    struct machine_value *a, struct machine_value *b)
{
    if (!a || (node_ops[op].inputs == 2 && !b))
        return NULL;
    int width = a->type.width;
    bool gives_bit = node_ops[op].gives == GIVES_BIT, keeps_sign = op_has((int)op, OP_SIGNED);
    struct machine_type type = gives_bit ? MACHINE_BIT : a->type;
    if (a->op == NODE_CONSTANT && (!b || b->op == NODE_CONSTANT))
        return machine_constant(
            m, type, scalar(integer_fold(op, width, number_of(a), b ? number_of(b) : 0)));
    if (width == 1 && !b)
        return of_one_bit(m, op, a);
    if (width == 1 && op_has((int)op, OP_BIT_KEPT))
        return a;
    if (width > 1)
        return make_operation(m, op, type, a, b);
    if (gives_bit) { /* 0 and 1 to the power fit; -1 (a signed 1) does unless it becomes 1 */
        struct machine_value *even = simplify_not(m, b);
        return keeps_sign ? even : machine_constant(m, type, (struct machine_scalar){0, 0});
    }
    /* One bit is done as two, for operations whose low bit does not depend on the width. */
    a = machine_resize(m, a, 2, keeps_sign);
    if (node_ops[op].fold != FOLD_SHIFT)
        b = machine_resize(m, b, 2, keeps_sign);
    struct machine_value *v = a && b ? make_operation(m, op, MACHINE_UINT(2), a, b) : NULL;
    return v ? machine_extract(m, v, 0, 1) : NULL;
}

static struct machine_value *small(struct machine *m, int width, int64_t x)
{
    return machine_constant(m, MACHINE_UINT(width), scalar_signed(x));
}

/* A signed count, as one of 32 bits from -128 to 128. */
static struct machine_value *count_bounded(struct machine *m, struct machine_value *count)
{
    int width = count->type.width;
    if (count->op == NODE_CONSTANT) {
        number n = number_of(count), most = 128;
        bool negative = is_negative(n, width);
        n = negative ? negated(n, width) : n;
        n = n < most ? n : most;
        return small(m, 32, negative ? -(int64_t)n : (int64_t)n);
    }
    if (width > 8) {
        struct machine_type type = count->type;
        count = make_operation(m, MACHINE_SMIN, type, count, small(m, width, 128));
        count =
            count ? make_operation(m, MACHINE_SMAX, type, count, small(m, width, -128)) : NULL;
    }
    return machine_resize(m, count, 32, true);
}

/* The same modulo width, 0 and above. */
static struct machine_value *count_round(struct machine *m, struct machine_value *count,
                                         int width)
{
    if (count->type.width < 32)
        count = machine_resize(m, count, 32, true);
    struct machine_value *modulus = count ? small(m, count->type.width, width) : NULL;
    count = integer_value(m, MACHINE_SMOD, count, modulus);
    return machine_resize(m, count, 32, false);
}

struct machine_value *machine_bits_shift(struct machine *m, enum machine_op op,
                                         struct machine_value *a, struct machine_value *count)
{
    if (!a || !count)
        return NULL;
    if ((unsigned)op >= MACHINE_OP_COUNT_PUBLIC || node_ops[op].fold != FOLD_SHIFT ||
        a->type.kind != MACHINE_BITS || count->type.kind != MACHINE_BITS) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "bits are shifted, by a number");
        return NULL;
    }
    count =
        op == MACHINE_ROTATE ? count_round(m, count, a->type.width) : count_bounded(m, count);
    return integer_value(m, op, a, count);
}
