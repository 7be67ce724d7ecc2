/* near_rank.h - ranks on the front end's own threads: what kernels/sort.cl does, the same
 * numbers. */
#ifndef LUTETIA_MACHINE_NEAR_RANK_H
#define LUTETIA_MACHINE_NEAR_RANK_H

#include "ops/scan.h"

/* A word of the keys, of which so many bits count; the first is the lowest. */
struct near_word {
    const uint32_t *word;
    int bits;
};

/* Each line's processors in order, the last word counting most, and equal ones as they are in
 * the line: to out, where in that order each is. In so many parts, shared out among the
 * device's crew. False: no memory. */
bool near_rank(const struct device *d, int parts, const struct lines *l,
               const struct near_word *words, int count, struct device_buffer *out);

/* The same, each line shared out by itself: of few and long ones. pairs: memory of a line's
 * length twice, 8 bytes each. */
bool near_rank_shared(const struct device *d, int parts, const struct lines *l,
                      const struct near_word *words, int count, struct device_buffer *pairs,
                      struct device_buffer *out);

#endif
