/* simplify.c - makes values, and keeps the graph small while it does.
 *
 * Rules are exact: they hold for every bit, NaNs included. Float arithmetic is never rearranged. No rule looks at the
 * value of a number other than a bit's 0 or 1, and whether a float is 0, or a factor 1 or more (widths of 128 at most, and
 * transcendental functions, fold where all operands are numbers), so that a program with other constants has the same
 * graph and the same kernels.
 *
 * The rules that matter: a store under context c is select(c, new, old), and
 *     select(c, new, select(c, x, old))       = select(c, new, old)
 *     select(c & t, new, select(c, x, old))   = select(c, select(t, new, x), old)
 *     x, asked for where c holds only         = x with each select(c, a, b) in it replaced by a
 * so what is overwritten under the same context is gone, and a test that was stored under c and
 * is and-ed into c forgets that it was. */
#include "base/scalar.h"
#include "internal.h"

#include <math.h>
#include <string.h>

static const struct machine_type bit_type = {.kind = MACHINE_BITS, .width = 1};

static struct machine_value *bad(struct machine *m, const char *what)
{
    machine_fail(m, MACHINE_BAD_ARGUMENT, "%s", what);
    return NULL;
}

static bool bits_type_ok(int width)
{
    return width >= 1 && width <= 128;
}

bool machine_value_is_zero(const struct machine_value *v)
{
    return v->op == NODE_CONSTANT && !v->imm.lo && !v->imm.hi;
}

struct machine_type machine_value_type(const struct machine_value *v)
{
    return v->type;
}

/* ---- numbers ---- */

static unsigned __int128 wide(struct machine_scalar x)
{
    return (unsigned __int128)x.hi << 64 | x.lo;
}

static struct machine_scalar narrow(unsigned __int128 x)
{
    return (struct machine_scalar){(uint64_t)x, (uint64_t)(x >> 64)};
}

/* What is handed out stays until the next instruction, also where it is a part of an operand. */
static struct machine_value *handed(struct machine *m, struct machine_value *v)
{
    bool just_made = m->values->borrowed_count > 0 &&
                     m->values->borrowed[m->values->borrowed_count - 1] == v;
    return !v || just_made ? v : graph_borrow(m, v);
}

static struct machine_value *number(struct machine *m, struct machine_type type,
                                    struct machine_scalar x)
{
    struct machine_value key = {
        .op = NODE_CONSTANT, .type = type, .imm = scalar_cut(x, type.width)};
    return graph_node(m, &key);
}

static struct machine_value *bit_number(struct machine *m, int x)
{
    return number(m, bit_type, (struct machine_scalar){(uint64_t)x, 0});
}

static bool is_number(const struct machine_value *v)
{
    return v->op == NODE_CONSTANT;
}

static bool is_zero_bit(const struct machine_value *v)
{
    return is_number(v) && v->type.width == 1 && v->imm.lo == 0;
}

static bool is_one_bit(const struct machine_value *v)
{
    return is_number(v) && v->type.width == 1 && v->imm.lo == 1;
}

struct machine_value *machine_constant(struct machine *m, struct machine_type type,
                                       struct machine_scalar bits)
{
    if (!bits_type_ok(type.width) || !soft_type_good(type) ||
        (type.kind == MACHINE_FLOAT && type.width != 32 && type.width != 64))
        return bad(m, "a value's width must be 1..128 bits, a float's 32 or 64");
    return number(m, type, bits);
}

struct machine_scalar machine_float_bits(struct machine_type type, double x)
{
    struct machine_scalar bits = {0, 0};
    if (type.width == 32) {
        float f = (float)x;
        uint32_t u;
        memcpy(&u, &f, sizeof u);
        bits.lo = isnan(x) ? NAN_32 : u;
    } else {
        memcpy(&bits.lo, &x, sizeof x);
        bits.lo = isnan(x) ? NAN_64 : bits.lo;
    }
    return bits;
}

struct machine_value *machine_constant_float(struct machine *m, struct machine_type type,
                                             double x)
{
    if (type.kind != MACHINE_FLOAT || (type.width != 32 && type.width != 64) ||
        !soft_type_good(type))
        return bad(m, "a float is 32 or 64 bits");
    struct machine_scalar bits = machine_float_bits(type, x);
    if (type.s)
        bits.lo = soft_rounded(bits.lo, type);
    return number(m, type, bits);
}

/* ---- building ---- */

/* The VP set of a result; -1 if the operands' differ. */
static int joint_set(struct machine *m, struct machine_value *const *in, int count)
{
    int set = 0;
    for (int i = 0; i < count; i++) {
        if (in[i]->set && set && in[i]->set != set)
            return -1;
        if (in[i]->set)
            set = in[i]->set;
    }
    return set ? set : m->values->set_current;
}

static struct machine_value *build(struct machine *m, int op, struct machine_type type,
                                   int detail, struct machine_value *a, struct machine_value *b,
                                   struct machine_value *c)
{
    struct machine_value key = {
        .op = (uint8_t)op, .type = type, .detail = detail, .in = {a, b, c}};
    int set = joint_set(m, key.in, node_ops[op].inputs);
    if (set < 0)
        return bad(m, "operands belong to different VP sets");
    if (set == 0)
        return bad(m, "there is no current VP set");
    key.set = (uint16_t)set;
    return graph_node(m, &key);
}

/* a holds only where b holds: b is a, or is and-ed into it. */
static bool implies(const struct machine_value *a, const struct machine_value *b, int depth)
{
    if (a == b)
        return true;
    if (depth > 0 && a->op == MACHINE_AND && a->type.width == 1)
        return implies(a->in[0], b, depth - 1) || implies(a->in[1], b, depth - 1);
    return false;
}

enum { DEPTH = 12 };

static struct machine_value *bit_not(struct machine *m, struct machine_value *a);

static struct machine_value *bit_and(struct machine *m, struct machine_value *a,
                                     struct machine_value *b)
{
    if (is_zero_bit(a) || is_one_bit(b))
        return a;
    if (is_zero_bit(b) || is_one_bit(a))
        return b;
    if (implies(a, b, DEPTH))
        return a;
    if (implies(b, a, DEPTH))
        return b;
    if ((a->op == MACHINE_NOT && a->in[0] == b) || (b->op == MACHINE_NOT && b->in[0] == a))
        return bit_number(m, 0);
    b = simplify_under(m, b, a, DEPTH);
    if (is_one_bit(b))
        return a;
    if (is_zero_bit(b))
        return b;
    return build(m, MACHINE_AND, bit_type, 0, a, b, NULL);
}

static struct machine_value *bit_or(struct machine *m, struct machine_value *a,
                                    struct machine_value *b)
{
    if (is_one_bit(a) || is_zero_bit(b))
        return a;
    if (is_one_bit(b) || is_zero_bit(a) || a == b)
        return b;
    if (implies(a, b, DEPTH))
        return b;
    if (implies(b, a, DEPTH))
        return a;
    return build(m, MACHINE_OR, bit_type, 0, a, b, NULL);
}

static struct machine_value *bit_not(struct machine *m, struct machine_value *a)
{
    if (is_number(a))
        return bit_number(m, !a->imm.lo);
    if (a->op == MACHINE_NOT)
        return a->in[0];
    return build(m, MACHINE_NOT, bit_type, 0, a, NULL, NULL);
}

/* c, knowing that known holds; NULL: nothing is left to ask. */
static struct machine_value *residual(struct machine *m, struct machine_value *c,
                                      struct machine_value *known, int depth)
{
    if (c == known || implies(known, c, DEPTH))
        return NULL;
    if (depth > 0 && c->op == MACHINE_AND) {
        struct machine_value *p = residual(m, c->in[0], known, depth - 1);
        struct machine_value *q = residual(m, c->in[1], known, depth - 1);
        if (p == c->in[0] && q == c->in[1])
            return c;
        return !p ? q : !q ? p : bit_and(m, p, q);
    }
    return c;
}

static bool is_float_zero(const struct machine_value *v)
{
    return is_number(v) && v->type.kind == MACHINE_FLOAT &&
           (v->imm.lo & (v->type.width == 32 ? 0x7fffffffu : INT64_MAX)) == 0;
}

/* From 1 on: 1, above 0 and up to 1: -1. Else, or infinite, or NaN: 0. */
static int factor_class(const struct machine_value *v)
{
    uint64_t one = v->type.width == 32 ? 0x3f800000u : 0x3ff0000000000000u,
             infinite = v->type.width == 32 ? 0x7f800000u : 0x7ff0000000000000u;
    if (!is_number(v) || v->type.s || !v->imm.lo || v->imm.lo >= infinite)
        return 0;
    return v->imm.lo >= one ? 1 : -1;
}

/* Where t is above 0 it is multiplied by g, where below it is divided by g: for g of 1 or more that is the larger of
 * both, for less the smaller, since rounding keeps the order; and both can be computed at the same time.
 *
 *     select(u < 0, u / g, u) with u = select(t > 0, t * g, t)
 *
 * Zeros of either sign come out as they are, and NaNs of an operation are stored as one and the same. */
static struct machine_value *scaled_by_sign(struct machine *m, struct machine_value *c,
                                            struct machine_value *a, struct machine_value *u)
{
    if (c->op != MACHINE_FLT || c->in[0] != u || !is_float_zero(c->in[1]) ||
        a->op != MACHINE_FDIV || a->in[0] != u || u->op != NODE_SELECT)
        return NULL;
    struct machine_value *positive = u->in[0], *product = u->in[1], *t = u->in[2],
                         *g = a->in[1];
    int class = factor_class(g);
    if (!class || positive->op != MACHINE_FGT || positive->in[0] != t ||
        !is_float_zero(positive->in[1]) || product->op != MACHINE_FMUL || product->in[0] != t ||
        product->in[1] != g || t->op < MACHINE_FADD || t->op > MACHINE_FDIV)
        return NULL;
    struct machine_value *quotient = build(m, MACHINE_FDIV, t->type, 0, t, g, NULL);
    struct machine_value *chosen = quotient ? build(m, class > 0 ? MACHINE_FGT : MACHINE_FLT,
                                                    bit_type, 0, product, quotient, NULL)
                                            : NULL;
    return chosen ? build(m, NODE_SELECT, t->type, 0, chosen, product, quotient) : NULL;
}

static struct machine_value *select_of(struct machine *m, struct machine_value *c,
                                       struct machine_value *a, struct machine_value *b)
{
    struct machine_value *scaled = scaled_by_sign(m, c, a, b);
    if (scaled)
        return scaled;
    for (;;) {
        if (a == b || is_one_bit(c))
            return a;
        if (is_zero_bit(c))
            return b;
        if (a->op == NODE_SELECT && implies(c, a->in[0], DEPTH)) {
            m->values->vanished.under_context++;
            a = a->in[1];
        } else if (b->op == NODE_SELECT && implies(b->in[0], c, DEPTH)) {
            m->values->vanished.overwritten++;
            b = b->in[2]; /* where c does not hold, neither does what implies it */
        } else
            break;
    }
    if (b->op == NODE_SELECT && implies(c, b->in[0], DEPTH)) {
        struct machine_value *outer = b->in[0], *rest = residual(m, c, outer, DEPTH);
        m->values->vanished.nested++;
        struct machine_value *inner = rest ? select_of(m, rest, a, b->in[1]) : a;
        return inner ? select_of(m, outer, inner, b->in[2]) : NULL;
    }
    if (a->type.width == 1 && a->type.kind == MACHINE_BITS) {
        if (is_number(a) && is_number(b))
            return a->imm.lo ? c : bit_not(m, c);
        if (is_number(a))
            return a->imm.lo ? bit_or(m, c, b) : bit_and(m, bit_not(m, c), b);
        if (is_number(b))
            return b->imm.lo ? bit_or(m, bit_not(m, c), a) : bit_and(m, c, a);
    }
    return build(m, NODE_SELECT, a->type, 0, c, a, b);
}

/* v, for somebody who looks at it only where context holds. */
struct machine_value *simplify_under(struct machine *m, struct machine_value *v,
                                     struct machine_value *context, int depth)
{
    if (depth <= 0 || node_is_leaf(v) || is_number(context) ||
        m->values->simplify_budget-- <= 0)
        return v;
    if (v->op == NODE_SELECT) {
        struct machine_value *c = residual(m, v->in[0], context, DEPTH);
        struct machine_value *a = simplify_under(m, v->in[1], context, depth - 1);
        m->values->vanished.under_context += !c;
        if (!c)
            return a;
        if (c->op == MACHINE_NOT && implies(context, c->in[0], DEPTH))
            return simplify_under(m, v->in[2], context, depth - 1);
        struct machine_value *b = simplify_under(m, v->in[2], context, depth - 1);
        if (c == v->in[0] && a == v->in[1] && b == v->in[2])
            return v;
        return select_of(m, c, a, b);
    }
    if (v->type.width == 1 && v->op == MACHINE_AND) {
        struct machine_value *c = residual(m, v, context, DEPTH);
        m->values->vanished.under_context += c != v;
        return c ? c : bit_number(m, 1);
    }
    if (v->op == NODE_REINTERPRET) {
        struct machine_value *a = simplify_under(m, v->in[0], context, depth - 1);
        return a == v->in[0] ? v : machine_reinterpret(m, a, v->type);
    }
    return v;
}

static struct machine_value *selected(struct machine *m, struct machine_value *condition,
                                      struct machine_value *a, struct machine_value *b)
{
    if (!condition || !a || !b)
        return NULL;
    if (!type_equal(a->type, b->type) || !type_equal(condition->type, bit_type))
        return bad(m, "select takes a bit and two values of one type");
    return select_of(m, condition, a, b);
}

struct machine_value *machine_select(struct machine *m, struct machine_value *condition,
                                     struct machine_value *a, struct machine_value *b)
{
    return handed(m, selected(m, condition, a, b));
}

/* ---- arithmetic ---- */

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

/* One of some numbers: what is done to it is done to them. */
static bool chooses_number(const struct machine_value *v, int depth)
{
    return is_number(v) ||
           (depth > 0 && !v->buffer && v->op == NODE_SELECT &&
            chooses_number(v->in[1], depth - 1) && chooses_number(v->in[2], depth - 1));
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
        return bad(m, "this operation does not take one operand of this type");
    struct machine_scalar math;
    if (is_number(a) && op_is_math((int)op) &&
        math_fold((int)op, a->type, a->imm, a->imm, &math))
        return number(m, a->type, soft_rounded_scalar(math, a->type));
    if (op_is_integer((int)op))
        return integer_value(m, op, a, NULL);
    unsigned __int128 folded;
    if (is_number(a) && !is_float && fold_bits(op, wide(a->imm), 0, &folded))
        return number(m, a->type, narrow(folded));
    if (op == MACHINE_NOT && a->type.width == 1)
        return bit_not(m, a);
    if (op == MACHINE_NOT && chooses_number(a, 4))
        return machine_select(m, a->in[0], machine_unary(m, op, a->in[1]),
                              machine_unary(m, op, a->in[2]));
    if (op == MACHINE_NEG && a->type.width == 1)
        return a;
    return build(m, (int)op, a->type, 0, a, NULL, NULL);
}

struct machine_value *machine_unary(struct machine *m, enum machine_op op,
                                    struct machine_value *a)
{
    struct machine_value *v = unary(m, op, a);
    m->values->vanished.numbers += v && is_number(v);
    return handed(m, v);
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
        return bad(m, "this operation takes two operands of one type, which these are not");
    bool compares =
        (op >= MACHINE_EQ && op <= MACHINE_SLE) || (op >= MACHINE_FEQ && op <= MACHINE_FGE);
    struct machine_scalar math;
    if (is_number(a) && is_number(b) && op_is_math((int)op) &&
        math_fold((int)op, a->type, a->imm, b->imm, &math))
        return number(m, a->type, soft_rounded_scalar(math, a->type));
    if (op_is_integer((int)op))
        return op >= MACHINE_USHIFT && op <= MACHINE_ROTATE ? machine_bits_shift(m, op, a, b)
                                                            : integer_value(m, op, a, b);
    unsigned __int128 folded;
    if (is_number(a) && is_number(b) && !is_float && !compares &&
        fold_bits(op, wide(a->imm), wide(b->imm), &folded))
        return number(m, a->type, narrow(folded));
    if (a->type.width == 1) { /* bits have rules of their own */
        switch ((int)op) {
        case MACHINE_AND:
        case MACHINE_MUL:
        case MACHINE_UMIN:
        case MACHINE_SMAX: /* -1 is the bit 1 */
            return bit_and(m, a, b);
        case MACHINE_OR:
        case MACHINE_UMAX:
        case MACHINE_SMIN:
            return bit_or(m, a, b);
        case MACHINE_ULT:
            return bit_and(m, bit_not(m, a), b);
        case MACHINE_ULE:
            return bit_or(m, bit_not(m, a), b);
        case MACHINE_SLT:
            return bit_and(m, a, bit_not(m, b));
        case MACHINE_SLE:
            return bit_or(m, a, bit_not(m, b));
        case MACHINE_EQ:
            if (is_number(b))
                return b->imm.lo ? a : bit_not(m, a);
            if (is_number(a))
                return a->imm.lo ? b : bit_not(m, b);
            b = bit_not(m, b);
            op = MACHINE_XOR;
            break;
        default:
            op = MACHINE_XOR; /* XOR, ADD, SUB, NE */
            break;
        }
        if (is_number(b))
            return b->imm.lo ? bit_not(m, a) : a;
        if (is_number(a))
            return a->imm.lo ? bit_not(m, b) : b;
        if (a == b)
            return bit_number(m, 0);
        return build(m, MACHINE_XOR, bit_type, 0, a, b, NULL);
    }
    if (a == b && (op == MACHINE_AND || op == MACHINE_OR))
        return a;
    return build(m, (int)op, compares ? bit_type : a->type, 0, a, b, NULL);
}

struct machine_value *machine_binary(struct machine *m, enum machine_op op,
                                     struct machine_value *a, struct machine_value *b)
{
    struct machine_value *v = binary(m, op, a, b);
    m->values->vanished.numbers += v && is_number(v);
    return v;
}

struct machine_value *node_overflow(struct machine *m, enum node_op op, struct machine_value *a,
                                    struct machine_value *b)
{
    return build(m, (int)op, bit_type, 0, a, b, NULL);
}

struct machine_value *node_make(struct machine *m, enum machine_op op, struct machine_type type,
                                struct machine_value *a, struct machine_value *b)
{
    return build(m, (int)op, type, 0, a, b, NULL);
}

/* ---- other shapes of the same bits ---- */

static struct machine_value *reinterpreted(struct machine *m, struct machine_value *a,
                                           struct machine_type type)
{
    if (!a)
        return NULL;
    if (a->type.width != type.width)
        return bad(m, "the same bits have the same width");
    if (a->op == NODE_REINTERPRET && !a->buffer)
        a = a->in[0];
    if (type_equal(a->type, type))
        return a;
    if (is_number(a))
        return number(m, type, a->imm);
    return build(m, NODE_REINTERPRET, type, 0, a, NULL, NULL);
}

struct machine_value *machine_reinterpret(struct machine *m, struct machine_value *a,
                                          struct machine_type type)
{
    return handed(m, reinterpreted(m, a, type));
}

static struct machine_value *as_bits(struct machine *m, struct machine_value *a)
{
    return machine_reinterpret(m, a, MACHINE_UINT(a->type.width));
}

static struct machine_value *resized(struct machine *m, struct machine_value *a, int width,
                                     bool is_signed)
{
    if (!a)
        return NULL;
    if (!bits_type_ok(width) || a->type.kind != MACHINE_BITS)
        return bad(m, "only bits can be made wider or narrower, to 1..128 of them");
    if (width == a->type.width)
        return a;
    if (width < a->type.width)
        return machine_extract(m, a, 0, width);
    if (is_number(a)) {
        unsigned __int128 x = wide(a->imm);
        if (is_signed && (x >> (a->type.width - 1) & 1))
            x |= ~(unsigned __int128)0 << (a->type.width - 1);
        return number(m, MACHINE_UINT(width), narrow(x));
    }
    return build(m, is_signed ? NODE_SIGN_EXTEND : NODE_ZERO_EXTEND, MACHINE_UINT(width), 0, a,
                 NULL, NULL);
}

struct machine_value *machine_resize(struct machine *m, struct machine_value *a, int width,
                                     bool is_signed)
{
    return handed(m, resized(m, a, width, is_signed));
}

static struct machine_value *extracted(struct machine *m, struct machine_value *a, int offset,
                                       int width)
{
    if (!a)
        return NULL;
    if (offset < 0 || width < 1 || offset + width > a->type.width)
        return bad(m, "the bits to extract are not all there");
    a = as_bits(m, a);
    if (width == a->type.width)
        return a;
    if (is_number(a))
        return number(m, MACHINE_UINT(width), narrow(wide(a->imm) >> offset));
    if (chooses_number(a, 4))
        return machine_select(m, a->in[0], machine_extract(m, a->in[1], offset, width),
                              machine_extract(m, a->in[2], offset, width));
    if (!a->buffer && a->op == NODE_EXTRACT)
        return machine_extract(m, a->in[0], offset + a->detail, width);
    if (!a->buffer && a->op == NODE_CONCAT) {
        int low = a->in[0]->type.width;
        if (offset + width <= low)
            return machine_extract(m, a->in[0], offset, width);
        if (offset >= low)
            return machine_extract(m, a->in[1], offset - low, width);
    }
    if (!a->buffer && (a->op == NODE_ZERO_EXTEND || a->op == NODE_SIGN_EXTEND) &&
        offset + width <= a->in[0]->type.width)
        return machine_extract(m, a->in[0], offset, width);
    return build(m, NODE_EXTRACT, MACHINE_UINT(width), offset, a, NULL, NULL);
}

struct machine_value *machine_extract(struct machine *m, struct machine_value *a, int offset,
                                      int width)
{
    return handed(m, extracted(m, a, offset, width));
}

struct machine_value *machine_concat(struct machine *m, struct machine_value *low,
                                     struct machine_value *high)
{
    if (!low || !high)
        return NULL;
    int width = low->type.width + high->type.width;
    if (width > 128)
        return bad(m, "a value has at most 128 bits");
    low = as_bits(m, low);
    high = as_bits(m, high);
    if (is_number(low) && is_number(high))
        return number(m, MACHINE_UINT(width),
                      narrow(wide(high->imm) << low->type.width | wide(low->imm)));
    if (!low->buffer && !high->buffer && low->op == NODE_EXTRACT && high->op == NODE_EXTRACT &&
        low->in[0] == high->in[0] && low->detail + low->type.width == high->detail)
        return machine_extract(m, low->in[0], low->detail, width);
    return build(m, NODE_CONCAT, MACHINE_UINT(width), 0, low, high, NULL);
}

struct machine_value *machine_to_float(struct machine *m, struct machine_value *a,
                                       struct machine_type type, bool is_signed)
{
    if (!a)
        return NULL;
    if (type.kind != MACHINE_FLOAT || (type.width != 32 && type.width != 64) ||
        !soft_type_good(type))
        return bad(m, "a float is 32 or 64 bits");
    if (type_equal(a->type, type))
        return a;
    int op = a->type.kind == MACHINE_FLOAT ? NODE_F_TO_F
             : is_signed                   ? NODE_S_TO_F
                                           : NODE_U_TO_F;
    return build(m, op, type, 0, a, NULL, NULL);
}

struct machine_value *machine_to_bits(struct machine *m, struct machine_value *a, int width,
                                      bool is_signed)
{
    if (!a)
        return NULL;
    if (a->type.kind != MACHINE_FLOAT || !bits_type_ok(width))
        return bad(m, "a float becomes 1..128 bits");
    return build(m, is_signed ? NODE_F_TO_S : NODE_F_TO_U, MACHINE_UINT(width), 0, a, NULL,
                 NULL);
}
