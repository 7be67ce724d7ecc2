/* oracle_random.c - see machine_random() in machine.h. */
#include "oracle_random.h"

static uint64_t mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

wide oracle_random(uint64_t seed, uint64_t draw, uint64_t index, int bits, uint64_t limit)
{
    const uint64_t golden = 0x9e3779b97f4a7c15u;
    uint64_t z = mix(mix(mix(seed) + (draw + 1) * golden) + index * golden);

    if (limit == 0)
        return z >> (64 - bits);
    if (limit < (uint64_t)1 << 32)
        return (wide)((z >> 32) * limit >> 32) & wide_mask(bits);
    return ((wide)z * limit >> 64) & wide_mask(bits);
}
