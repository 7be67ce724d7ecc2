/* oracle_integers.h - the results of the rows of integers.c and bits.c in one processor, by
 * their definitions: bit by bit, or with the compiler's 128-bit numbers. */
#ifndef PARIS_TESTS_ORACLE_INTEGERS_H
#define PARIS_TESTS_ORACLE_INTEGERS_H

#include "oracle.h"

/* op is the name between CM_ and the form's suffix: s_truncate, u_s_shift, rotate ... is_signed
 * is the type of the first source and dest, b_signed that of the second source. */
struct oracle_result oracle_integer_row(const char *op, bool is_signed, bool b_signed, number a,
                                        int alen, number b, int blen, int dlen);
/* Whether the row sets the overflow flag. */
bool oracle_integer_overflows(const char *op);
/* The low len bits in reverse order. */
number oracle_reversed(number a, int len);

#endif
