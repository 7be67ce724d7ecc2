/* spell_integers.c - integers' operations in the words of kernels/integers.cl. */
#include <stdio.h>

#include "base/node_ops.h"
#include "codegen/spell.h"

void spell_integer(char *out, size_t size, int op, struct machine_type t, const char *a,
                   const char *b)
{
    static const struct {
        const char *function;
        bool takes_width, cuts;
        const char *how;
    } words[] = {
        [MACHINE_UDIV] = {"u_divided", false, false, "QUOTIENT_TRUNCATE"},
        [MACHINE_UCEIL] = {"u_divided", false, false, "QUOTIENT_CEILING"},
        [MACHINE_UROUND] = {"u_divided", false, false, "QUOTIENT_ROUND"},
        [MACHINE_UREM] = {"u_remainder", false, false, NULL},
        [MACHINE_SDIV] = {"s_divided", true, true, "QUOTIENT_TRUNCATE"},
        [MACHINE_SFLOOR] = {"s_divided", true, true, "QUOTIENT_FLOOR"},
        [MACHINE_SCEIL] = {"s_divided", true, true, "QUOTIENT_CEILING"},
        [MACHINE_SROUND] = {"s_divided", true, true, "QUOTIENT_ROUND"},
        [MACHINE_SREM] = {"s_remainder", true, true, NULL},
        [MACHINE_SMOD] = {"s_modulus", true, true, NULL},
        [MACHINE_POW] = {"power", false, true, NULL},
        [MACHINE_UPOW_BEYOND] = {"u_power_beyond", true, false, NULL},
        [MACHINE_SPOW_BEYOND] = {"s_power_beyond", true, false, NULL},
        [MACHINE_USHIFT] = {"u_shifted", false, true, NULL},
        [MACHINE_SSHIFT] = {"s_shifted", true, true, NULL},
        [MACHINE_ROTATE] = {"rotated", true, true, NULL},
        [MACHINE_POPCOUNT] = {"population", false, false, NULL},
        [MACHINE_LENGTH] = {"bits_length", false, false, NULL},
        [MACHINE_REVERSE] = {"reversed", true, false, NULL},
        [MACHINE_UNGRAY] = {"from_gray", false, false, NULL},
        [MACHINE_ISQRT] = {"square_root", false, false, NULL},
    };
    char raw[300], second[64] = "", width[16] = "", how[40] = "";
    char c = spell_letter(t);
    if (node_ops[op].inputs == 2)
        snprintf(second, sizeof second, ", %s", b);
    if (words[op].takes_width)
        snprintf(width, sizeof width, ", %d", t.width);
    if (words[op].how)
        snprintf(how, sizeof how, ", %s", words[op].how);
    if (op == MACHINE_POPCOUNT && c != 'Q')
        snprintf(raw, sizeof raw, "popcount(%s)", a);
    else
        snprintf(raw, sizeof raw, "%s_%c(%s%s%s%s)", words[op].function, c, a, second, width,
                 how);
    if (words[op].cuts)
        spell_cut(out, size, raw, t.width);
    else
        snprintf(out, size, "%s", raw);
}
