/* oracle_number.h - the result of one instruction in one processor: 128-bit integers and IEEE
 * floats. */
#ifndef LUTETIA_TESTS_RANDOM_ORACLE_NUMBER_H
#define LUTETIA_TESTS_RANDOM_ORACLE_NUMBER_H

#include <stdbool.h>

#include "program.h"

__extension__ typedef unsigned __int128 wide;
__extension__ typedef __int128 signed_wide;

wide wide_mask(int bits);
/* The low `bits` bits of x, sign-extended. */
signed_wide wide_signed(wide x, int bits);

/* Returns a op b. The operands are already zero- or sign-extended. *overflows tells whether the
 * exact result does not fit in `bits` bits; operations that record no overflow leave it
 * alone. */
wide number_integer(enum op op, bool is_signed, wide a, wide b, int bits, bool *overflows);
/* Floats are bits, 32 or 64 of them. */
uint64_t number_float(enum op op, int bits, uint64_t a, uint64_t b, bool *overflows);

bool number_compare_integer(enum op op, bool is_signed, wide a, wide b);
bool number_compare_float(enum op op, int bits, uint64_t a, uint64_t b);

uint64_t number_from_integer(bool is_signed, wide a, int float_bits);
wide number_to_integer(enum op op, bool is_signed, uint64_t a, int float_bits, int bits,
                       bool *overflows);
/* Converts a float to another length. */
uint64_t number_resize_float(uint64_t a, int from_bits, int to_bits);
/* Rounds a front-end number. */
uint64_t number_real(double x, int float_bits);
double number_value(uint64_t a, int float_bits);

/* The one NaN that arithmetic gives. */
uint64_t number_nan(int float_bits);

/* ADD, MIN or MAX over the active elements among count, in the order of rows along the last
 * axis. */
uint64_t number_float_reduce(enum op op, const uint64_t *values, const bool *active,
                             uint64_t count, int last_axis, int bits);

#endif
