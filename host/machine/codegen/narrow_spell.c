/* narrow_spell.c - the text of operations in lanes of 8 or 16 bits. */
#include "codegen/narrow_spell.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/errors.h"
#include "base/node_ops.h"
#include "codegen/numbers.h"

/* ---- the text of one operation ---- */

/* An upper bound of an unsigned number, from the few operations before it. */
static uint32_t most(const struct plan_graph *g, int node, int operations)
{
    const struct plan_node *n = &g->nodes[node];
    uint32_t any = (1u << n->type.width) - 1, a, b;
    if (n->leaf || n->constant || !operations--)
        return any;
    switch (n->op) {
    case NODE_SHIFT:
    case NODE_ZERO_EXTEND:
        a = most(g, n->in[0], operations);
        return a < any ? a : any;
    case NODE_SELECT:
        a = most(g, n->in[1], operations);
        b = most(g, n->in[2], operations);
        return a > b ? a : b;
    case MACHINE_ADD:
        a = most(g, n->in[0], operations) + most(g, n->in[1], operations);
        return a < any ? a : any;
    default: /* any operation stays below its width's bound */
        return any;
    }
}

/* Whether the sum of unsigned numbers of that width fits without being cut. */
static bool sum_fits(const struct plan_graph *g, const struct plan_node *n, int width)
{
    enum { OPERATIONS = 6 };
    return most(g, n->in[0], OPERATIONS) + most(g, n->in[1], OPERATIONS) < 1u << width;
}

static void cut(char *out, size_t size, const char *from, int width, int lane)
{
    if (width == lane)
        snprintf(out, size, "(%s)", from);
    else
        snprintf(out, size, "((%s) & (VU)(" NUMBER_UINT "))", from, (1u << width) - 1);
}

/* A bit loaded from memory is 0 or 1, and negating it twice restores it. Of other bits the
 * lowest one is cut out. A negated comparison would not do: compilers turn it into a masked
 * load of a constant, and if the constant's page has never been touched and no lane is set,
 * each such load takes hundreds of cycles. */
static void widened(char *out, size_t size, const struct plan_graph *g, int node, const char *a)
{
    bool bit = g->nodes[node].type.width == 1;
    while (!g->nodes[node].leaf && g->nodes[node].op == NODE_SHIFT)
        node = g->nodes[node].in[0];
    snprintf(out, size,
             !bit                  ? "%s"
             : g->nodes[node].leaf ? "AS_U(-%s)"
                                   : "AS_U(%s & (VI)(1))",
             a);
}

static void extended(char *out, size_t size, const char *a, struct machine_type t, int lane)
{
    if (t.width == 1 || t.width == lane)
        snprintf(out, size, "AS_S(%s)", a);
    else
        snprintf(out, size, "(AS_S(%s << (VU)(" NUMBER_INT ")) >> (VI)(" NUMBER_INT "))", a,
                 lane - t.width, lane - t.width);
}

static void extremum(char *out, size_t size, const char *symbol, const char *x, const char *y,
                     const char *a, const char *b)
{
    snprintf(out, size, "SEL_U(%s %s %s, %s, %s)", x, symbol, y, a, b);
}

void narrow_spell(char *out, size_t size, const struct plan_graph *g, const struct plan_node *n,
                  int lane, const char *a, const char *b, const char *c)
{
    const char *word = node_words[n->op].word;
    struct machine_type from = g->nodes[n->in[0]].type;
    char raw[160], x[64], y[64];
    int width = n->type.width;
    switch (n->op) {
    case NODE_SELECT:
        snprintf(out, size, width == 1 ? "SEL_I(%s, %s, %s)" : "SEL_U(%s, %s, %s)", a, b, c);
        return;
    case NODE_ZERO_EXTEND:
        widened(x, sizeof x, g, n->in[0], a);
        cut(out, size, x, width < from.width ? width : lane, lane);
        return;
    case NODE_SIGN_EXTEND:
        extended(x, sizeof x, a, from, lane);
        if (width == 1)
            snprintf(out, size, "%s", x);
        else {
            snprintf(raw, sizeof raw, "AS_U(%s)", x);
            cut(out, size, raw, width, lane);
        }
        return;
    case NODE_CONCAT:
        widened(x, sizeof x, g, n->in[0], a);
        widened(y, sizeof y, g, n->in[1], b);
        snprintf(out, size, "(%s | (%s << (VU)(" NUMBER_INT ")))", x, y, from.width);
        return;
    case NODE_EXTRACT:
        snprintf(raw, sizeof raw, "%s >> (VU)(" NUMBER_INT ")", a, n->detail);
        if (width == 1)
            snprintf(out, size, "(((%s) & (VU)(1)) != (VU)(0))", raw);
        else
            cut(out, size, raw, width, lane);
        return;
    case MACHINE_NOT:
    case MACHINE_NEG:
        snprintf(raw, sizeof raw, "%s%s", word, a);
        cut(out, size, raw, width == 1 ? lane : width, lane);
        return;
    case MACHINE_SLT:
    case MACHINE_SLE:
    case MACHINE_SMIN:
    case MACHINE_SMAX:
        extended(x, sizeof x, a, from, lane);
        extended(y, sizeof y, b, from, lane);
        if (n->op == MACHINE_SMIN || n->op == MACHINE_SMAX)
            extremum(out, size, word, x, y, a, b);
        else
            snprintf(out, size, "(%s %s %s)", x, word, y);
        return;
    case MACHINE_UMIN:
    case MACHINE_UMAX:
        extremum(out, size, n->op == MACHINE_UMIN ? "<" : ">", a, b, a, b);
        return;
    case MACHINE_ADD:
    case MACHINE_SUB:
        snprintf(raw, sizeof raw, "%s %s %s", a, word, b);
        cut(out, size, raw, n->op == MACHINE_ADD && sum_fits(g, n, width) ? lane : width, lane);
        return;
    case NODE_OVERFLOW_UADD:
        if (sum_fits(g, n, from.width))
            snprintf(out, size, "(VI)(0)");
        else
            snprintf(out, size, "(((%s + %s) & (VU)(0x%x)) < %s)", a, b, (1u << from.width) - 1,
                     a);
        return;
    case NODE_OVERFLOW_USUB:
        snprintf(out, size, "(%s < %s)", a, b);
        return;
    case NODE_OVERFLOW_SADD:
    case NODE_OVERFLOW_SSUB: { /* the signs say so */
        bool sum = n->op == NODE_OVERFLOW_SADD;
        snprintf(raw, sizeof raw, "(%s %s %s)", a, sum ? "+" : "-", b);
        snprintf(out, size, "(((%s ^ %s) & (%s ^ %s) & (VU)(0x%x)) != (VU)(0))", a, raw, b,
                 sum ? raw : a, 1u << (from.width - 1));
        return;
    }
    case MACHINE_AND:
    case MACHINE_OR:
    case MACHINE_XOR:
    case MACHINE_EQ:
    case MACHINE_NE:
    case MACHINE_ULT:
    case MACHINE_ULE:
        snprintf(out, size, "(%s %s %s)", a, word, b);
        return;
    default: /* all rows with OP_NARROW are above: test machine_operations */
        INVARIANT(false);
    }
}
