/* numbers.h - numbers by which ranks know what they have: small ones, which are used again.
 *
 * Ranks perform commands in order, so a number that was left may be given at once. */
#ifndef LUTETIA_MACHINE_RANKS_NUMBERS_H
#define LUTETIA_MACHINE_RANKS_NUMBERS_H

#include <stdint.h>

/* All 0 at first. */
struct numbers {
    uint32_t *left, made;
    int count, capacity;
};

uint32_t numbers_get(struct numbers *n); /* 1 or more */
void numbers_leave(struct numbers *n, uint32_t number);

#endif
