/* prefix.h - the peers of scans and ranks: straightforward C on one thread. */
#ifndef LUTETIA_BENCH_PREFIX_H
#define LUTETIA_BENCH_PREFIX_H

#include <stddef.h>
#include <stdint.h>

void prefix_sum(const uint32_t *in, uint32_t *out, size_t count);
void prefix_sum_floats(const float *in, float *out, size_t count);
/* Begins a new sum where `begins` is not 0. */
void prefix_sum_segments(const uint32_t *in, const uint8_t *begins, uint32_t *out,
                         size_t count);
/* ranks[i]: where in[i] goes when sorted, equal ones in order. Radix sort in three passes of 11
 * bits, all digits counted at once. scratch: 4 * count numbers. */
void radix_ranks(const uint32_t *in, uint32_t *ranks, uint32_t *scratch, size_t count);

#endif
