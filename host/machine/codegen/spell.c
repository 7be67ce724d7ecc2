/* spell.c - each family of operations in the prelude's words: expressions of operands that are
 * variables' names. A new row of machine_op.tab with a family that there is needs no change
 * here.
 *
 * Bits are held in the container that their width asks for, unused high bits 0:
 *     VI one bit, as 0 or -1     VU 2..32     VL 33..64     VQ 65..128       VF, VD  float,
 * double */
#include "codegen/spell.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/errors.h"
#include "base/op_families.h"
#include "codegen/numbers.h"

const char *spell_container(struct machine_type t)
{
    if (t.kind == MACHINE_FLOAT)
        return t.width == 32 ? "VF" : "VD";
    return t.width == 1 ? "VI" : t.width <= 32 ? "VU" : t.width <= 64 ? "VL" : "VQ";
}

char spell_letter(struct machine_type t)
{
    return spell_container(t)[1];
}

/* An expression of container U, L or Q (want) from bits in another container; zero-extends. */
void spell_widened(char *out, size_t size, const char *from, struct machine_type type,
                   char want)
{
    char have = spell_letter(type);
    if (have == 'I') {
        snprintf(out, size, "AS_U(%s & 1)", from);
        have = 'U';
    } else {
        snprintf(out, size, "%s", from);
    }
    if (have == want)
        return;
    char inner[600];
    snprintf(inner, sizeof inner, "%.590s", out);
    if (have == 'U' && want == 'L')
        snprintf(out, size, "CONVERT(ulong, %s)", inner);
    else if (have == 'U' && want == 'Q')
        snprintf(out, size, "q_of(CONVERT(ulong, %s), (VL)(0))", inner);
    else if (have == 'L' && want == 'Q')
        snprintf(out, size, "q_of(%s, (VL)(0))", inner);
    else if (have == 'L' && want == 'U')
        snprintf(out, size, "CONVERT(uint, %s)", inner);
    else if (have == 'Q' && want == 'L')
        snprintf(out, size, "(%s).lo", inner);
    else if (have == 'Q' && want == 'U')
        snprintf(out, size, "CONVERT(uint, (%s).lo)", inner);
}

/* All but the low width bits cleared. */
void spell_cut(char *out, size_t size, const char *from, int width)
{
    if (width == 32 || width == 64 || width == 128)
        snprintf(out, size, "%s", from);
    else if (width < 32)
        snprintf(out, size, "((%s) & " NUMBER_UINT ")", from, (1u << width) - 1);
    else if (width < 64)
        snprintf(out, size, "((%s) & " NUMBER_ULONG ")", from, (UINT64_C(1) << width) - 1);
    else
        snprintf(out, size, "q_cut(%s, " NUMBER_INT ")", from, width);
}

void spell_shifted(char *out, size_t size, const char *a, const char *which, int by,
                   char letter)
{
    if (letter == 'L')
        snprintf(out, size, "(%s %s " NUMBER_ULONG ")", a, which, (uint64_t)by);
    else
        snprintf(out, size, "(%s %s " NUMBER_INT ")", a, which, by);
}

/* A signed number in its whole container, as a signed vector (U, L) or VQ. */
static void extended(char *out, size_t size, const char *a, struct machine_type t)
{
    switch (spell_letter(t)) {
    case 'I':
        snprintf(out, size, "%s", a);
        break;
    case 'U':
        snprintf(out, size, "(AS_S(%s << " NUMBER_INT ") >> " NUMBER_INT ")", a, 32 - t.width,
                 32 - t.width);
        break;
    case 'L':
        snprintf(out, size, "(AS_M(%s << %dUL) >> %dL)", a, 64 - t.width, 64 - t.width);
        break;
    default:
        snprintf(out, size, "q_extended(%s, " NUMBER_INT ")", a, t.width);
        break;
    }
}

void spell_bits_binary(char *out, size_t size, int op, struct machine_type t, const char *a,
                       const char *b)
{
    const char *word = node_words[op].word, *function = node_words[op].second;
    char c = spell_letter(t), raw[192], x[96], y[96];
    switch ((enum op_bits)op) {
    case OF_MACHINE_AND:
    case OF_MACHINE_OR:
    case OF_MACHINE_XOR:
    case OF_MACHINE_ADD:
    case OF_MACHINE_SUB:
    case OF_MACHINE_MUL:
        if (c == 'Q')
            snprintf(raw, sizeof raw, "%s(%s, %s)", function, a, b);
        else
            snprintf(raw, sizeof raw, "%s %s %s", a, word, b);
        if (op_has(op, OP_CUTS) && c != 'I')
            spell_cut(out, size, raw, t.width);
        else
            snprintf(out, size, "%s", raw);
        break;
    case OF_MACHINE_EQ:
    case OF_MACHINE_NE:
    case OF_MACHINE_ULT:
    case OF_MACHINE_ULE:
        if (c != 'Q')
            snprintf(out, size, "CMP_%c(%s %s %s)", c, a, word, b);
        else if (op == MACHINE_ULE)
            snprintf(out, size, "~q_ult(%s, %s)", b, a);
        else
            snprintf(out, size, "%s(%s, %s)",
                     op == MACHINE_EQ   ? "q_eq"
                     : op == MACHINE_NE ? "~q_eq"
                                        : "q_ult",
                     a, b);
        break;
    case OF_MACHINE_SLT:
    case OF_MACHINE_SLE:
        if (c == 'Q' && op == MACHINE_SLT)
            snprintf(out, size, "q_slt(%s, %s, %d)", a, b, t.width);
        else if (c == 'Q')
            snprintf(out, size, "~q_slt(%s, %s, %d)", b, a, t.width);
        else {
            extended(x, sizeof x, a, t);
            extended(y, sizeof y, b, t);
            snprintf(out, size, "CMP_%c(%s %s %s)", c, x, word, y);
        }
        break;
    case OF_MACHINE_UMIN:
    case OF_MACHINE_UMAX:
        if (c == 'Q')
            snprintf(out, size, "q_select(q_ult(%s, %s), %s, %s)", a, b,
                     op == MACHINE_UMIN ? a : b, op == MACHINE_UMIN ? b : a);
        else
            snprintf(out, size, "%s(%s, %s)", word, a, b);
        break;
    case OF_MACHINE_SMIN:
    case OF_MACHINE_SMAX:
        spell_bits_binary(raw, sizeof raw, MACHINE_SLT, t, a, b);
        snprintf(out, size, "SEL_%c(%s, %s, %s)", c, raw, op == MACHINE_SMIN ? a : b,
                 op == MACHINE_SMIN ? b : a);
        break;
    case OF_MACHINE_NOT: /* body.c spells these */
    case OF_MACHINE_NEG:
        INVARIANT(node_ops[op].inputs == 2);
    }
}

void spell_integer_call(char *out, size_t size, int op, char letter, const char *a,
                        const char *b, const char *width)
{
    const struct node_words *words = &node_words[op];
    const bool two = node_ops[op].inputs == 2, wants_width = op_has(op, OP_WIDTH);
    snprintf(out, size, "%s_%c(%s%s%s%s%s%s%s)", words->word, letter, a, two ? ", " : "",
             two ? b : "", wants_width ? ", " : "", wants_width ? width : "",
             words->second ? ", " : "", words->second ? words->second : "");
}

void spell_integer(char *out, size_t size, int op, struct machine_type t, const char *a,
                   const char *b)
{
    char raw[300], width[16];
    snprintf(width, sizeof width, "%d", t.width);
    spell_integer_call(raw, sizeof raw, op, spell_letter(t), a, b, width);
    if (op_has(op, OP_CUTS))
        spell_cut(out, size, raw, t.width);
    else
        snprintf(out, size, "%s", raw);
}

void spell_float(char *out, size_t size, int op, struct machine_type t, const char *a,
                 const char *b)
{
    const char *word = node_words[op].word, *compare = t.width == 32 ? "CMP_U" : "CMP_L";
    const int how = node_ops[op].spell;
    if (how == SPELL_FLOAT_FUNCTION) {
        snprintf(out, size, "%s(%s)", word, a);
    } else if (how == SPELL_FLOAT_OPERATOR) {
        snprintf(out, size, "%s %s %s", a, word, b);
    } else if (how == SPELL_FLOAT_CHOICE) {
        snprintf(out, size, "SEL_%c(%s(%s %s %s), %s, %s)", spell_letter(t), compare, a, word,
                 b, a, b);
    } else {
        INVARIANT(how == SPELL_FLOAT_COMPARISON);
        snprintf(out, size, "%s(%s %s %s)", compare, a, word, b);
    }
}

void spell_math(char *out, size_t size, int op, struct machine_type t, const char *a,
                const char *b)
{
    bool single = t.width == 32, two = node_ops[op].inputs == 2;
    snprintf(out, size,
             single ? two ? "CONVERT(float, math_%s_lanes(CONVERT(double, %s), "
                            "CONVERT(double, %s)))"
                          : "CONVERT(float, math_%s_lanes(CONVERT(double, %s)))"
             : two  ? "math_%s_lanes(%s, %s)"
                    : "math_%s_lanes(%s)",
             node_words[op].word, a, b);
}

void spell_overflow(char *out, size_t size, int op, struct machine_type t, const char *a,
                    const char *b)
{
    char c = spell_letter(t), raw[256], r[300], x[100], y[100];
    int w = t.width;
    switch ((enum op_overflow)op) {
    case OF_NODE_OVERFLOW_UADD:
        spell_bits_binary(raw, sizeof raw, MACHINE_ADD, t, a, b);
        if (c == 'I')
            snprintf(out, size, "%s & %s", a, b);
        else if (c == 'Q')
            snprintf(out, size, "q_ult(%s, %s)", raw, a);
        else
            snprintf(out, size, "CMP_%c((%s) < %s)", c, raw, a);
        return;
    case OF_NODE_OVERFLOW_USUB:
        if (c == 'I')
            snprintf(out, size, "~%s & %s", a, b);
        else
            spell_bits_binary(out, size, MACHINE_ULT, t, a, b);
        return;
    case OF_NODE_OVERFLOW_UMUL:
        if (c == 'I')
            snprintf(out, size, "(VI)(0)");
        else if (c == 'U')
            snprintf(out, size,
                     "CMP_L((CONVERT(ulong, %s) * CONVERT(ulong, %s)) >> %dUL != (VL)(0))", a,
                     b, w);
        else if (c == 'Q')
            snprintf(out, size, "q_umul_overflows(%s, %s, %d)", a, b, w);
        else if (w == 64)
            snprintf(out, size, "CMP_L(high_product(%s, %s) != (VL)(0))", a, b);
        else
            snprintf(
                out, size,
                "CMP_L(high_product(%s, %s) != (VL)(0)) | CMP_L((%s * %s) >> %dUL != (VL)(0))",
                a, b, a, b, w);
        return;
    case OF_NODE_OVERFLOW_SADD:
    case OF_NODE_OVERFLOW_SSUB:
        if (c == 'I') { /* a bit is 0 or -1: -1 + -1 and 0 - -1 do not fit */
            snprintf(out, size, op == NODE_OVERFLOW_SADD ? "%s & %s" : "~%s & %s", a, b);
            return;
        }
        spell_bits_binary(r, sizeof r, op == NODE_OVERFLOW_SADD ? MACHINE_ADD : MACHINE_SUB, t,
                          a, b);
        if (c == 'Q')
            snprintf(out, size,
                     "(q_sign(%s, %d) ^ q_sign(%s, %d)) & (q_sign(%s, %d) ^ q_sign(%s, %d))", a,
                     w, r, w, op == NODE_OVERFLOW_SADD ? r : a, w, b, w);
        else
            snprintf(out, size, "CMP_%c((((%s ^ (%s)) & (%s ^ %s)) >> %d%s & 1) != 0)", c, a, r,
                     b, op == NODE_OVERFLOW_SADD ? r : a, w - 1, c == 'L' ? "UL" : "");
        return;
    case OF_NODE_OVERFLOW_SNEG:
        if (c == 'I')
            snprintf(out, size, "%s", a);
        else if (c == 'Q')
            snprintf(out, size, "q_eq(%s, q_shl(q_of((VL)(1), (VL)(0)), %d))", a, w - 1);
        else
            snprintf(out, size, "CMP_%c(%s == (V%c)(1) << %d%s)", c, a, c, w - 1,
                     c == 'L' ? "UL" : "");
        return;
    case OF_NODE_OVERFLOW_SMUL:
        extended(x, sizeof x, a, t);
        extended(y, sizeof y, b, t);
        if (c == 'I')
            snprintf(out, size, "%s & %s", a, b);
        else if (c == 'U')
            snprintf(out, size,
                     "s_product_overflows(CONVERT(long, %s) * CONVERT(long, %s), %d)", x, y, w);
        else if (c == 'L')
            snprintf(out, size, "l_smul_overflows(%s, %s, %d)", x, y, w);
        else
            snprintf(out, size, "q_smul_overflows(%s, %s, %d)", a, b, w);
        return;
    case OF_NODE_OVERFLOW_RESULT:
        snprintf(out, size, "INFINITE_%c(%s) & FINITE_%c(%s)", c, a, c, b);
        return;
    case OF_NODE_OVERFLOW_FADD:
    case OF_NODE_OVERFLOW_FSUB:
    case OF_NODE_OVERFLOW_FMUL:
    case OF_NODE_OVERFLOW_FDIV:
        snprintf(out, size, "INFINITE_%c(%s %s %s) & FINITE_%c(%s) & FINITE_%c(%s)", c, a,
                 node_words[op].word, b, c, a, c, b);
        return;
    }
    INVARIANT(false);
}

void spell_conversion(char *out, size_t size, const struct plan_node *n,
                      struct machine_type from, const char *a)
{
    char raw[460], inner[200];
    char have = spell_letter(from), want = spell_letter(n->type);
    int w = n->type.width;
    switch ((enum op_conversion)n->op) {
    case OF_NODE_ZERO_EXTEND:
        spell_widened(out, size, a, from, want);
        return;
    case OF_NODE_SIGN_EXTEND:
        extended(inner, sizeof inner, a, from);
        if (have == 'I' || have == 'U') {
            if (want == 'U')
                snprintf(raw, sizeof raw, "AS_U(%s)", inner);
            else if (want == 'L')
                snprintf(raw, sizeof raw, "AS_L(CONVERT(long, %s))", inner);
            else
                snprintf(raw, sizeof raw, "q_signed(CONVERT(long, %s))", inner);
        } else if (have == 'L') {
            snprintf(raw, sizeof raw, want == 'L' ? "AS_L(%s)" : "q_signed(%s)", inner);
        } else {
            snprintf(raw, sizeof raw, "%s", inner);
        }
        spell_cut(out, size, raw, w);
        return;
    case OF_NODE_EXTRACT:
        if (have == 'I')
            snprintf(raw, sizeof raw, "AS_U(%s & 1)", a);
        else if (have == 'Q')
            snprintf(raw, sizeof raw, "q_shr(%s, " NUMBER_INT ")", a, n->detail);
        else
            spell_shifted(raw, sizeof raw, a, ">>", n->detail, have);
        if (want == 'I') {
            spell_widened(inner, sizeof inner, raw, MACHINE_UINT(from.width),
                          have == 'U' || have == 'I' ? 'U' : 'L');
            snprintf(out, size, "CMP_%c((%s & 1) != 0)", have == 'U' || have == 'I' ? 'U' : 'L',
                     have == 'I' ? raw : inner);
            return;
        }
        spell_widened(inner, sizeof inner, raw, MACHINE_UINT(from.width), want);
        spell_cut(out, size, inner, w);
        return;
    case OF_NODE_U_TO_F:
        if (have == 'Q')
            snprintf(out, size, "q_to_%c(%s)", want == 'F' ? 'f' : 'd', a);
        else {
            spell_widened(inner, sizeof inner, a, from, have == 'L' ? 'L' : 'U');
            snprintf(out, size, "CONVERT(%s, %s)", want == 'F' ? "float" : "double", inner);
        }
        return;
    case OF_NODE_S_TO_F:
        if (have == 'Q')
            snprintf(out, size,
                     "SEL_%c(q_sign(%s, %d), -q_to_%c(q_magnitude(%s, %d)), q_to_%c(%s))", want,
                     a, from.width, want == 'F' ? 'f' : 'd', a, from.width,
                     want == 'F' ? 'f' : 'd', a);
        else {
            extended(inner, sizeof inner, a, from);
            snprintf(out, size, "CONVERT(%s, %s)", want == 'F' ? "float" : "double", inner);
        }
        return;
    case OF_NODE_F_TO_U:
    case OF_NODE_F_TO_S: {
        bool is_signed = n->op == NODE_F_TO_S;
        int e = is_signed ? w - 1 : w;
        if (have == 'F' && w <= (is_signed ? 32 : 31)) {
            snprintf(raw, sizeof raw, "f_to_%c_small(%s, 0x1p%df, 0x%x)", is_signed ? 's' : 'u',
                     a, e, (unsigned)((UINT64_C(1) << e) - 1));
        } else {
            snprintf(inner, sizeof inner, have == 'F' ? "CONVERT(double, %.100s)" : "%.100s",
                     a);
            if (want == 'Q')
                snprintf(raw, sizeof raw, "d_to_%cq(%s, 0x1p%d, %d)", is_signed ? 's' : 'u',
                         inner, e, w);
            else
                snprintf(raw, sizeof raw, "d_to_%c(%s, 0x1p%d, 0x%" PRIx64 "%s)",
                         is_signed ? 's' : 'u', inner, e,
                         e == 64 ? UINT64_MAX : (UINT64_C(1) << e) - 1, is_signed ? "L" : "UL");
            if (want == 'U' || want == 'I') {
                snprintf(inner, sizeof inner, "%.190s", raw);
                snprintf(raw, sizeof raw, "CONVERT(uint, %s)", inner);
            }
        }
        if (want == 'I')
            snprintf(out, size, "CMP_U((%s & 1) != 0)", raw);
        else
            spell_cut(out, size, raw, w);
        return;
    }
    case OF_NODE_F_TO_F:
        snprintf(out, size, "CONVERT(%s, %s)", want == 'F' ? "float" : "double", a);
        return;
    case OF_NODE_REINTERPRET:
        snprintf(out, size, "AS_%c(%s)", want, a);
        return;
    case OF_NODE_PACK: /* spell_soft() spells these */
    case OF_NODE_UNPACK:
        INVARIANT(n->op != NODE_PACK && n->op != NODE_UNPACK);
    }
}
