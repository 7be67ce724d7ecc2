/* spell_integers.c - integers' operations in the words of kernels/integers.cl. */
#include <stdio.h>

#include "base/node_ops.h"
#include "codegen/spell.h"

void spell_integer(char *out, size_t size, int op, struct machine_type t, const char *a,
                   const char *b)
{
    const struct node_words *words = &node_words[op];
    char raw[300], second[64] = "", width[16] = "", how[40] = "";
    char c = spell_letter(t);
    if (node_ops[op].inputs == 2)
        snprintf(second, sizeof second, ", %s", b);
    if (op_has(op, OP_WIDTH))
        snprintf(width, sizeof width, ", %d", t.width);
    if (words->second)
        snprintf(how, sizeof how, ", %s", words->second);
    if (op == MACHINE_POPCOUNT && c != 'Q')
        snprintf(raw, sizeof raw, "popcount(%s)", a);
    else
        snprintf(raw, sizeof raw, "%s_%c(%s%s%s%s)", words->word, c, a, second, width, how);
    if (op_has(op, OP_CUTS))
        spell_cut(out, size, raw, t.width);
    else
        snprintf(out, size, "%s", raw);
}
