#include "prefix.h"

#include <string.h>

void prefix_sum(const uint32_t *in, uint32_t *out, size_t count)
{
    uint32_t sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += in[i];
        out[i] = sum;
    }
}

void prefix_sum_floats(const float *in, float *out, size_t count)
{
    float sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += in[i];
        out[i] = sum;
    }
}

void prefix_sum_segments(const uint32_t *in, const uint8_t *begins, uint32_t *out, size_t count)
{
    uint32_t sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum = begins[i] ? in[i] : sum + in[i];
        out[i] = sum;
    }
}

enum { PASSES = 3, BITS = 11, DIGITS = 1 << BITS };

void radix_ranks(const uint32_t *in, uint32_t *ranks, uint32_t *scratch, size_t count)
{
    static uint32_t places[PASSES][DIGITS];
    uint32_t *keys = scratch, *order = scratch + count;
    uint32_t *next_keys = scratch + 2 * count, *next_order = scratch + 3 * count;
    memset(places, 0, sizeof places);
    for (size_t i = 0; i < count; i++)
        for (int pass = 0; pass < PASSES; pass++)
            places[pass][in[i] >> pass * BITS & (DIGITS - 1)]++;
    for (int pass = 0; pass < PASSES; pass++) {
        uint32_t sum = 0;
        for (int digit = 0; digit < DIGITS; digit++) {
            uint32_t here = places[pass][digit];
            places[pass][digit] = sum;
            sum += here;
        }
    }
    for (size_t i = 0; i < count; i++) {
        uint32_t at = places[0][in[i] & (DIGITS - 1)]++;
        keys[at] = in[i];
        order[at] = (uint32_t)i;
    }
    for (size_t i = 0; i < count; i++) {
        uint32_t at = places[1][keys[i] >> BITS & (DIGITS - 1)]++;
        next_keys[at] = keys[i];
        next_order[at] = order[i];
    }
    for (size_t i = 0; i < count; i++)
        ranks[next_order[i]] = places[2][next_keys[i] >> 2 * BITS]++;
}
