/* oracle.h - the results of C/Paris instructions in one processor, in plain C. Knows nothing of
 * the machine.
 *
 * A number is 128 bits; a float's bits are in the low 32 or 64. Operations are named as in
 * instructions.tab. */
#ifndef PARIS_TESTS_ORACLE_H
#define PARIS_TESTS_ORACLE_H

#include <stdbool.h>

typedef unsigned __int128 number;

number oracle_mask(int width);
/* Extends the low width bits, signed or unsigned, to 128 bits. */
number oracle_extend(number bits, int width, bool is_signed);

struct oracle_result {
    number bits;
    bool overflow;
};

/* add subtract multiply subfrom min max; negate abs (b is ignored). alen, blen, dlen: widths of
 * a, b, dest. */
struct oracle_result oracle_integer(const char *op, bool is_signed, number a, int alen,
                                    number b, int blen, int dlen);
/* eq ne lt le gt ge */
bool oracle_integer_compare(const char *op, bool is_signed, number a, int alen, number b,
                            int blen);

/* width 32 or 64. add subtract multiply divide subfrom divinto min max; negate abs sqrt f_floor
 * f_ceiling f_truncate f_round. */
struct oracle_result oracle_float(const char *op, int width, number a, number b);
bool oracle_float_compare(const char *op, int width, number a, number b);

number oracle_float_bits(int width, double x); /* rounded */
double oracle_float_value(int width, number bits);
number oracle_float_move(int to_width, number bits, int from_width);
/* Rounded to nearest, halves to even. */
number oracle_to_float(int width, number integer, int len, bool is_signed);
/* op: ..._floor, ..._ceiling, ..._truncate, ..._round */
struct oracle_result oracle_to_integer(const char *op, int width, number bits, int len,
                                       bool is_signed);

/* logand ... logorc2, lognot */
number oracle_logical(const char *op, number a, number b);

#endif
