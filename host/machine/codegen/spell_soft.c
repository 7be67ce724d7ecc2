/* spell_soft.c - operations on floats of other formats than single and double.
 *
 * Sums, products, quotients and roots are the double's, rounded again, where that can do no harm: see type_is_short().
 * Elsewhere they are whole-number arithmetic. */
#include <stdio.h>
#include <string.h>

#include "base/errors.h"
#include "base/node_ops.h"
#include "codegen/spell.h"

/* Whole numbers that a double need not hold. */
static bool spell_whole(char *out, size_t size, const struct plan_node *n,
                        struct machine_type from, const char *a)
{
    char inner[200];
    int s = n->type.s, e = n->type.e;
    if (from.width <= 32)
        return false;
    if (from.width > 64 && n->op == NODE_U_TO_F) {
        snprintf(out, size, "as_double(soft_whole(0, %s.lo, %s.hi, %d, %d))", a, a, s, e);
    } else if (from.width > 64) {
        snprintf(inner, sizeof inner, "q_magnitude(%s, %d)", a, from.width);
        snprintf(out, size, "as_double(soft_whole(q_sign(%s, %d), %s.lo, %s.hi, %d, %d))", a,
                 from.width, inner, inner, s, e);
    } else if (n->op == NODE_U_TO_F) {
        snprintf(out, size, "SOFT_FROM_U(%s, %d, %d)", a, s, e);
    } else {
        snprintf(out, size, "SOFT_FROM_S((AS_M(%s << %dUL) >> %dL), %d, %d)", a,
                 64 - from.width, 64 - from.width, s, e);
    }
    return true;
}

bool spell_soft(char *out, size_t size, const struct plan_node *n, struct machine_type from,
                const char *a, const char *b)
{
    const struct node_words *words = &node_words[n->op];
    struct machine_type t = n->type.s ? n->type : from;
    int s = t.s, e = t.e;
    if (!s)
        return false;
    bool vectors = type_is_short(t);
    switch (n->op) {
    case MACHINE_FADD:
    case MACHINE_FSUB:
    case MACHINE_FMUL:
    case MACHINE_FDIV:
        if (vectors)
            return false;
        snprintf(out, size, "%s(%s, %s, %d, %d)", words->second, a, b, s, e);
        return true;
    case MACHINE_FSQRT:
        if (vectors)
            return false;
        snprintf(out, size, "%s(%s, %d, %d)", words->second, a, s, e);
        return true;
    case NODE_OVERFLOW_FADD:
    case NODE_OVERFLOW_FSUB:
    case NODE_OVERFLOW_FMUL:
    case NODE_OVERFLOW_FDIV:
        if (vectors)
            snprintf(out, size,
                     "INFINITE_D(short_fit(%s %s %s, %d, %d)) & FINITE_D(%s) & FINITE_D(%s)", a,
                     words->word, b, s, e, a, b);
        else
            snprintf(out, size, "INFINITE_D(%s(%s, %s, %d, %d)) & FINITE_D(%s) & FINITE_D(%s)",
                     words->second, a, b, s, e, a, b);
        return true;
    case NODE_PACK:
        if (n->type.width <= 32)
            snprintf(out, size, "CONVERT(uint, %s(%s, %d, %d))",
                     vectors ? "short_pack" : "SOFT_PACK", a, s, e);
        else
            snprintf(out, size, "%s(%s, %d, %d)", vectors ? "short_pack" : "SOFT_PACK", a, s,
                     e);
        return true;
    case NODE_UNPACK:
        snprintf(out, size, "%s(CONVERT(ulong, %s), %d, %d)",
                 vectors ? "short_unpack" : "SOFT_UNPACK", a, s, e);
        return true;
    case NODE_U_TO_F:
    case NODE_S_TO_F:
        return spell_whole(out, size, n, from, a);
    default:
        return false;
    }
}

void spell_soft_rounding(char *text, size_t size, struct machine_type t)
{
    const char *begin = type_is_short(t) ? "short_fit(" : "SOFT_FIT(";
    char end[24];
    snprintf(end, sizeof end, ", %d, %d)", t.s, t.e);
    size_t length = strlen(text), before = strlen(begin);
    INVARIANT(length + before + sizeof end < size);
    memmove(text + before, text, length + 1);
    memcpy(text, begin, before);
    strcat(text, end);
}
