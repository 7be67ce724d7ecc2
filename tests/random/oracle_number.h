/* oracle_number.h - what one instruction computes in one processor: 128-bit integers and IEEE floats. */
#ifndef LUTETIA_TESTS_RANDOM_ORACLE_NUMBER_H
#define LUTETIA_TESTS_RANDOM_ORACLE_NUMBER_H

#include <stdbool.h>

#include "program.h"

__extension__ typedef unsigned __int128 wide;
__extension__ typedef __int128 signed_wide;

wide wide_mask(int bits);
/* The low bits of x, with their sign. */
signed_wide wide_signed(wide x, int bits);

/* dest = a op b. Operands are widened already (zeros or sign); *overflows says whether the exact result fits in
 * `bits`, and is left alone by operations that do not record it. */
wide number_integer(enum op op, bool is_signed, wide a, wide b, int bits, bool *overflows);
/* Floats as bits; 32 or 64 of them. */
uint64_t number_float(enum op op, int bits, uint64_t a, uint64_t b, bool *overflows);

bool number_compare_integer(enum op op, bool is_signed, wide a, wide b);
bool number_compare_float(enum op op, int bits, uint64_t a, uint64_t b);

uint64_t number_from_integer(bool is_signed, wide a, int float_bits);
wide number_to_integer(enum op op, bool is_signed, uint64_t a, int float_bits, int bits,
                       bool *overflows);
/* Float to float of another length. */
uint64_t number_resize_float(uint64_t a, int from_bits, int to_bits);
/* A front-end number, rounded. */
uint64_t number_real(double x, int float_bits);
double number_value(uint64_t a, int float_bits);

/* The one NaN that arithmetic gives. */
uint64_t number_nan(int float_bits);

/* ADD, MIN or MAX over the active ones of count elements, a row of the last axis after another. */
uint64_t number_float_reduce(enum op op, const uint64_t *values, const bool *active,
                             uint64_t count, int last_axis, int bits);

#endif
