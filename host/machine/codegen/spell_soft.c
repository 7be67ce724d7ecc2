/* spell_soft.c - operations on floats of other formats than single and double.
 *
 * Sums, products, quotients and roots are the double's, rounded again, where that can do no
 * harm: see type_is_short(). Elsewhere they are whole-number arithmetic. */
#include <stdio.h>
#include <string.h>

#include "base/errors.h"
#include "base/op_families.h"
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

/* A conversion to or from a format t. */
static bool spell_conversion_soft(char *out, size_t size, const struct plan_node *n,
                                  struct machine_type from, const char *a,
                                  struct machine_type t)
{
    const int s = t.s, e = t.e;
    const bool vectors = type_is_short(t);
    switch ((enum op_conversion)n->op) {
    case OF_NODE_PACK:
        if (n->type.width <= 32)
            snprintf(out, size, "CONVERT(uint, %s(%s, %d, %d))",
                     vectors ? "short_pack" : "SOFT_PACK", a, s, e);
        else
            snprintf(out, size, "%s(%s, %d, %d)", vectors ? "short_pack" : "SOFT_PACK", a, s,
                     e);
        return true;
    case OF_NODE_UNPACK:
        snprintf(out, size, "%s(CONVERT(ulong, %s), %d, %d)",
                 vectors ? "short_unpack" : "SOFT_UNPACK", a, s, e);
        return true;
    case OF_NODE_U_TO_F:
    case OF_NODE_S_TO_F:
        return spell_whole(out, size, n, from, a);
    case OF_NODE_ZERO_EXTEND: /* as doubles, whose result is rounded again */
    case OF_NODE_SIGN_EXTEND:
    case OF_NODE_EXTRACT:
    case OF_NODE_REINTERPRET:
    case OF_NODE_F_TO_U:
    case OF_NODE_F_TO_S:
    case OF_NODE_F_TO_F:
        return false;
    }
    INVARIANT(false);
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
    switch ((enum op_spell)node_ops[n->op].spell) {
    case SPELL_FLOAT_FUNCTION:
        if (vectors || !words->second)
            return false;
        snprintf(out, size, "%s(%s, %d, %d)", words->second, a, s, e);
        return true;
    case SPELL_FLOAT_OPERATOR:
        if (vectors || !words->second)
            return false;
        snprintf(out, size, "%s(%s, %s, %d, %d)", words->second, a, b, s, e);
        return true;
    case SPELL_OVERFLOW:
        if (!words->second)
            return false;
        if (vectors)
            snprintf(out, size,
                     "INFINITE_D(short_fit(%s %s %s, %d, %d)) & FINITE_D(%s) & FINITE_D(%s)", a,
                     words->word, b, s, e, a, b);
        else
            snprintf(out, size, "INFINITE_D(%s(%s, %s, %d, %d)) & FINITE_D(%s) & FINITE_D(%s)",
                     words->second, a, b, s, e, a, b);
        return true;
    case SPELL_CONVERSION:
        return spell_conversion_soft(out, size, n, from, a, t);
    case SPELL_PLACE: /* as doubles, whose result is rounded again */
    case SPELL_BITS_ONE:
    case SPELL_BITS:
    case SPELL_INTEGER:
    case SPELL_FLOAT_CHOICE:
    case SPELL_FLOAT_COMPARISON:
    case SPELL_MATH:
    case SPELL_SELECT:
    case SPELL_CONCAT:
        return false;
    }
    INVARIANT(false);
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
