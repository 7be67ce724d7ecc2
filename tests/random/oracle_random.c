/* oracle_random.c - see machine_random() in machine.h. */
#include "oracle_random.h"

#include "sample.h"

wide oracle_random(uint64_t seed, uint64_t draw, uint64_t index, int bits, uint64_t limit)
{
    uint64_t key = sample_mixed(sample_mixed(seed) + (draw + 1) * SAMPLE_GOLDEN);
    uint64_t z = sample_mixed(key + index * SAMPLE_GOLDEN);

    if (limit == 0)
        return z >> (64 - bits);
    if (limit < (uint64_t)1 << 32)
        return (wide)((z >> 32) * limit >> 32) & wide_mask(bits);
    return ((wide)z * limit >> 64) & wide_mask(bits);
}
