/* sample.h - random numbers that are the same on every machine. The caller holds the state; its
 * first value is part of the test.
 *
 *     static uint64_t state = 1;
 *     uint64_t die = 1 + sample_word(&state) % 6;
 */
#ifndef LUTETIA_TESTS_SAMPLE_H
#define LUTETIA_TESTS_SAMPLE_H

#include <stdint.h>

#define SAMPLE_GOLDEN UINT64_C(0x9e3779b97f4a7c15)

/* The finaliser of splitmix64: gives unrelated numbers for 0, 1, 2, ... times GOLDEN. */
static inline uint64_t sample_mixed(uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Splitmix64, 64 bits; any state. */
static inline uint64_t sample_word(uint64_t *state)
{
    return sample_mixed(*state += SAMPLE_GOLDEN);
}

/* A faster hash of a number, of lower quality. */
static inline uint64_t sample_of(uint64_t n)
{
    uint64_t z = (n + SAMPLE_GOLDEN) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Xorshift, 64 bits; the state must not be 0. */
#define SAMPLE_SHIFTED_BEGIN UINT64_C(88172645463325252)
static inline uint64_t sample_shifted(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* The upper 31 bits of a linear congruential generator; any state. */
static inline uint32_t sample_linear(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*state >> 33);
}

/* A number in 0 .. limit - 1; 0 where limit is 0. */
static inline uint32_t sample_below(uint64_t *state, uint32_t limit)
{
    uint32_t any = sample_linear(state);
    return limit ? any % limit : 0;
}

#endif
