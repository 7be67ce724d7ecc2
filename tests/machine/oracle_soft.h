/* oracle_soft.h - computes with floats of s bits of significand and e bits of exponent by MPFR.
 * Results are bits as a field holds them. Knows nothing of the machine. */
#ifndef LUTETIA_TESTS_ORACLE_SOFT_H
#define LUTETIA_TESTS_ORACLE_SOFT_H

#include <stdbool.h>
#include <stdint.h>

struct soft_format {
    int s, e;
};

uint64_t oracle_soft_nan(struct soft_format f);
bool oracle_soft_is_nan(struct soft_format f, uint64_t bits);
bool oracle_soft_is_finite(struct soft_format f, uint64_t bits);
double oracle_soft_value(struct soft_format f, uint64_t bits);

/* Rounded once, to nearest even. */
uint64_t oracle_soft_of(struct soft_format f, double x);
uint64_t oracle_soft_of_whole(struct soft_format f, unsigned __int128 magnitude, bool negative);
/* op: + - * / and r, the root of a */
uint64_t oracle_soft_arithmetic(struct soft_format f, char op, uint64_t a, uint64_t b);
/* The sine, exponential or logarithm (s e l) of a. */
uint64_t oracle_soft_function(struct soft_format f, char op, uint64_t a);

/* Sample number `which` of the format: an edge case or random bits. */
uint64_t oracle_soft_sample(struct soft_format f, uint64_t which);

#endif
