/* simplify.c - the rules that keep the graph small.
 *
 * Rules are exact: they hold for every bit, NaNs included. Float arithmetic is never
 * rearranged. No rule looks at the value of a number other than a bit's 0 or 1, and whether a
 * float is 0, or a factor 1 or more (widths of 128 at most, and transcendental functions, fold
 * where all operands are numbers), so that a program with other constants has the same graph
 * and the same kernels.
 *
 * The rules that matter: a store under context c is select(c, new, old), and
 *     select(c, new, select(c, x, old))       = select(c, new, old)
 *     select(c & t, new, select(c, x, old))   = select(c, select(t, new, x), old)
 *     x, read only where c holds              = x with each select(c, a, b) in it replaced by a
 *     select(c, new, select(d, y, select(c, x, old)))
 *                                             = select(c, new, select(d, y, old))
 * So values overwritten under the same context disappear, and a test that was stored under c
 * and is and-ed into c loses its select.
 */
#include "values/simplify.h"

#include "base/parts.h"
#include "base/types.h"
#include "values/graph.h"
#include "values/make.h"

/* Whether a holds only where b holds: b is a, or is and-ed into it. */
static bool implies(const struct machine_value *a, const struct machine_value *b, int depth)
{
    if (a == b)
        return true;
    if (depth > 0 && a->op == MACHINE_AND && a->type.width == 1)
        return implies(a->in[0], b, depth - 1) || implies(a->in[1], b, depth - 1);
    return false;
}

enum { DEPTH = 12 };

struct machine_value *simplify_and(struct machine *m, struct machine_value *a,
                                   struct machine_value *b)
{
    if (value_is_zero_bit(a) || value_is_one_bit(b))
        return a;
    if (value_is_zero_bit(b) || value_is_one_bit(a))
        return b;
    if (implies(a, b, DEPTH))
        return a;
    if (implies(b, a, DEPTH))
        return b;
    if ((a->op == MACHINE_NOT && a->in[0] == b) || (b->op == MACHINE_NOT && b->in[0] == a))
        return make_bit(m, 0);
    b = simplify_under(m, b, a, DEPTH);
    if (value_is_one_bit(b))
        return a;
    if (value_is_zero_bit(b))
        return b;
    return make_node(m, MACHINE_AND, MAKE_BIT_TYPE, 0, a, b, NULL);
}

struct machine_value *simplify_or(struct machine *m, struct machine_value *a,
                                  struct machine_value *b)
{
    if (value_is_one_bit(a) || value_is_zero_bit(b))
        return a;
    if (value_is_one_bit(b) || value_is_zero_bit(a) || a == b)
        return b;
    if (implies(a, b, DEPTH))
        return b;
    if (implies(b, a, DEPTH))
        return a;
    return make_node(m, MACHINE_OR, MAKE_BIT_TYPE, 0, a, b, NULL);
}

struct machine_value *simplify_not(struct machine *m, struct machine_value *a)
{
    if (value_is_number(a))
        return make_bit(m, !a->imm.lo);
    if (a->op == MACHINE_NOT)
        return a->in[0];
    return make_node(m, MACHINE_NOT, MAKE_BIT_TYPE, 0, a, NULL, NULL);
}

/* The rest of c where `known` holds; NULL: always true. */
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
        return !p ? q : !q ? p : simplify_and(m, p, q);
    }
    return c;
}

static bool is_float_zero(const struct machine_value *v)
{
    return value_is_number(v) && v->type.kind == MACHINE_FLOAT &&
           (v->imm.lo & (v->type.width == 32 ? 0x7fffffffu : INT64_MAX)) == 0;
}

/* 1 for factors from 1 on, -1 for factors above 0 and below 1, else (also infinite or NaN)
 * 0. */
static int factor_class(const struct machine_value *v)
{
    uint64_t one = v->type.width == 32 ? 0x3f800000u : 0x3ff0000000000000u,
             infinite = v->type.width == 32 ? 0x7f800000u : 0x7ff0000000000000u;
    if (!value_is_number(v) || v->type.s || !v->imm.lo || v->imm.lo >= infinite)
        return 0;
    return v->imm.lo >= one ? 1 : -1;
}

/* Where t is above 0 it is multiplied by g, where below it is divided by g: for g of 1 or more
 * that is the larger of both, for less the smaller, since rounding keeps the order; and both
 * can be computed at the same time.
 *
 *     select(u < 0, u / g, u) with u = select(t > 0, t * g, t)
 *
 * Zeros of either sign come out as they are, and NaNs of an operation are stored as one and the
 * same. */
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
        product->in[1] != g || node_ops[t->op].spell != SPELL_FLOAT_OPERATOR)
        return NULL;
    struct machine_value *quotient = make_node(m, MACHINE_FDIV, t->type, 0, t, g, NULL);
    struct machine_value *chosen = quotient
                                       ? make_node(m, class > 0 ? MACHINE_FGT : MACHINE_FLT,
                                                   MAKE_BIT_TYPE, 0, product, quotient, NULL)
                                       : NULL;
    return chosen ? make_node(m, NODE_SELECT, t->type, 0, chosen, product, quotient) : NULL;
}

/* Contexts that take turns, at most: colours of a grid, say. */
enum { COLOURS = 4 };

/* Whether others than this instruction hold the value: two and more, for one is the field or
 * the choice that is about to let go of it. */
static bool is_looked_at(const struct machine *m, const struct machine_value *v)
{
    return v->refs > graph_borrowed(m, v) + 1;
}

/* b, read only where c does not hold, without the last choice in it that takes another value
 * only where c holds. A choice that somebody else looks at stays as it is: it will be in
 * memory. */
static struct machine_value *rest_of(struct machine *m, const struct machine_value *c,
                                     struct machine_value *b)
{
    struct machine_value *chain[COLOURS], *v = b;
    int count = 0;
    for (; v->op == NODE_SELECT && (!count || !implies(v->in[0], c, DEPTH)); v = v->in[2]) {
        if (count == COLOURS)
            return b;
        chain[count++] = v;
    }
    if (v->op != NODE_SELECT)
        return b;
    for (int i = 0; i < count; i++)
        if (is_looked_at(m, chain[i]))
            return b;
    m->values->vanished.overwritten++;
    for (v = v->in[2]; count && v; count--)
        v = make_node(m, NODE_SELECT, b->type, 0, chain[count - 1]->in[0],
                      chain[count - 1]->in[1], v);
    return v;
}

struct machine_value *simplify_select(struct machine *m, struct machine_value *c,
                                      struct machine_value *a, struct machine_value *b)
{
    struct machine_value *scaled = scaled_by_sign(m, c, a, b);
    if (scaled)
        return scaled;
    for (;;) {
        if (a == b || value_is_one_bit(c))
            return a;
        if (value_is_zero_bit(c))
            return b;
        if (a->op == NODE_SELECT && implies(c, a->in[0], DEPTH)) {
            m->values->vanished.under_context++;
            a = a->in[1];
        } else if (b->op == NODE_SELECT && implies(b->in[0], c, DEPTH)) {
            m->values->vanished.overwritten++;
            b = b->in[2]; /* where c does not hold, a condition that implies c does not hold
                           * either */
        } else
            break;
    }
    if (b->op == NODE_SELECT && implies(c, b->in[0], DEPTH)) {
        struct machine_value *outer = b->in[0], *rest = residual(m, c, outer, DEPTH);
        m->values->vanished.nested++;
        struct machine_value *inner = rest ? simplify_select(m, rest, a, b->in[1]) : a;
        return inner ? simplify_select(m, outer, inner, b->in[2]) : NULL;
    }
    if (!(b = rest_of(m, c, b)))
        return NULL;
    if (a->type.width == 1 && a->type.kind == MACHINE_BITS) {
        if (value_is_number(a) && value_is_number(b))
            return a->imm.lo ? c : simplify_not(m, c);
        if (value_is_number(a))
            return a->imm.lo ? simplify_or(m, c, b) : simplify_and(m, simplify_not(m, c), b);
        if (value_is_number(b))
            return b->imm.lo ? simplify_or(m, simplify_not(m, c), a) : simplify_and(m, c, a);
    }
    return make_node(m, NODE_SELECT, a->type, 0, c, a, b);
}

/* v, for readers that read it only where context holds. */
struct machine_value *simplify_under(struct machine *m, struct machine_value *v,
                                     struct machine_value *context, int depth)
{
    if (depth <= 0 || node_is_leaf(v) || value_is_number(context) ||
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
        return simplify_select(m, c, a, b);
    }
    if (v->type.width == 1 && v->op == MACHINE_AND) {
        struct machine_value *c = residual(m, v, context, DEPTH);
        m->values->vanished.under_context += c != v;
        return c ? c : make_bit(m, 1);
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
    if (!type_equal(a->type, b->type) || !type_equal(condition->type, MAKE_BIT_TYPE))
        return make_bad(m, "select takes a bit and two values of one type");
    return simplify_select(m, condition, a, b);
}

struct machine_value *machine_select(struct machine *m, struct machine_value *condition,
                                     struct machine_value *a, struct machine_value *b)
{
    return make_handed(m, selected(m, condition, a, b));
}

bool simplify_chooses_number(const struct machine_value *v, int depth)
{
    return value_is_number(v) || (depth > 0 && !v->buffer && v->op == NODE_SELECT &&
                                  simplify_chooses_number(v->in[1], depth - 1) &&
                                  simplify_chooses_number(v->in[2], depth - 1));
}
