/* oracle_floats.h - the results of the float families of instructions.tab (float_...) in one
 * processor, in plain C with long doubles. */
#ifndef PARIS_TESTS_ORACLE_FLOATS_H
#define PARIS_TESTS_ORACLE_FLOATS_H

#include "oracle.h"

struct oracle_float {
    number bits;
    int ulp; /* the largest error in units in the last place; 0: exactly these bits */
    bool overflow;
};

/* exp ... atanh, floor ... round; atan2, f_power, power, mod, rem (y) */
struct oracle_float oracle_function(const char *op, int width, number x, number y);
/* power, scale; n is an integer of len bits */
struct oracle_float oracle_by_integer(const char *op, int width, number x, number n, int len,
                                      bool is_signed);
/* mult_add ... subf_mult */
struct oracle_float oracle_pair(const char *op, int width, number x, number y, number z);
/* f_signum, signum, f_significand, ieee_to_vax, vax_to_ieee */
struct oracle_float oracle_made(const char *op, int width, number x);
/* signum, exponent, significand of dlen bits */
struct oracle_result oracle_part(const char *op, int width, number x, int dlen, bool is_signed);
/* is_... */
bool oracle_float_test(const char *op, int width, number x);
/* Whether got is at most ulp units in the last place away from wanted. */
bool oracle_float_near(int width, number got, number wanted, int ulp);

#endif
