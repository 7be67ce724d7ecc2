/* spell.h - operations in the words of kernels/prelude.cl and wide.cl. */
#ifndef LUTETIA_MACHINE_SPELL_H
#define LUTETIA_MACHINE_SPELL_H

#include "plan/plan.h"

/* The vector type that holds values of a type: "VI", "VU", "VL", "VQ", "VF", "VD"; and its
 * letter. */
const char *spell_container(struct machine_type t);
char spell_letter(struct machine_type t);
/* Each writes an expression to out. Operands are names or expressions in parentheses. */

/* Bits of type, zero-extended or cut to the container with the letter want (U, L, Q). */
void spell_widened(char *out, size_t size, const char *from, struct machine_type type,
                   char want);
/* All but the low width bits cleared. */
void spell_cut(char *out, size_t size, const char *from, int width);
/* Shifted by a number, "<<" or ">>": a word (letter U) or a long one (L). */
void spell_shifted(char *out, size_t size, const char *a, const char *which, int by,
                   char letter);
/* MACHINE_AND .. MACHINE_SLE on two operands of type t. */
void spell_bits_binary(char *out, size_t size, int op, struct machine_type t, const char *a,
                       const char *b);
/* The call of an integers' operation's function of kernels/integers.cl, for words of the
 * letter's size; width: of the operands, as a text. */
void spell_integer_call(char *out, size_t size, int op, char letter, const char *a,
                        const char *b, const char *width);
/* Integers' operations on operands of 2 bits or more, in the words of kernels/integers.cl. */
void spell_integer(char *out, size_t size, int op, struct machine_type t, const char *a,
                   const char *b);
/* MACHINE_FNEG .. MACHINE_FGE. */
void spell_float(char *out, size_t size, int op, struct machine_type t, const char *a,
                 const char *b);
/* MACHINE_FEXP .. MACHINE_FSCALE: kernels/math.cl. */
void spell_math(char *out, size_t size, int op, struct machine_type t, const char *a,
                const char *b);
/* NODE_OVERFLOW_*. */
void spell_overflow(char *out, size_t size, int op, struct machine_type t, const char *a,
                    const char *b);
/* Extensions, extraction, conversions, reinterpretation: node n of an operand of type from. */
void spell_conversion(char *out, size_t size, const struct plan_node *n,
                      struct machine_type from, const char *a);

/* ---- spell_soft.c ---- */

/* Operations on floats of other formats. False: as for doubles. */
bool spell_soft(char *out, size_t size, const struct plan_node *n, struct machine_type from,
                const char *a, const char *b);
/* Rounds the double that is spelt in text to the type. */
void spell_soft_rounding(char *text, size_t size, struct machine_type t);

#endif
