/* The lights that the system shows when no program uses them. */
#include <string.h>

#include "paris_internal.h"

enum { SIDE = PARIS_LIGHTS_COLUMNS };

struct paris_pattern paris_pattern_begin(unsigned int mode)
{
    struct paris_pattern p = {.mode = mode, .shift = 0xace1u};
    return p;
}

/* A shift register of sixteen bits with taps 16, 14, 13, 11: all 65535 states but 0. */
static unsigned int bit_next(struct paris_pattern *p)
{
    uint16_t s = p->shift;
    unsigned int bit = (s ^ s >> 2 ^ s >> 3 ^ s >> 5) & 1u;
    p->shift = (uint16_t)(s >> 1 | bit << 15);
    return bit;
}

/* The AND of two bits: a quarter of the lights is on. */
static uint64_t light_next(struct paris_pattern *p)
{
    unsigned int a = bit_next(p), b = bit_next(p);
    return a & b;
}

void paris_pattern_step(struct paris_pattern *p, uint8_t lights[PARIS_LIGHTS_BYTES])
{
    memset(lights, 0, PARIS_LIGHTS_BYTES);
    for (int row = 0; row < SIDE; row++) {
        uint64_t bits = p->rows[row];
        int shifts = p->begun && p->mode != PARIS_PATTERN_NOISE ? 1 : SIDE;
        for (int i = 0; i < shifts && p->mode != PARIS_PATTERN_ON; i++)
            bits = row % 2 ? bits << 1 | light_next(p) : bits >> 1 | light_next(p) << 63;
        if (p->mode == PARIS_PATTERN_ON)
            bits = UINT64_MAX;
        p->rows[row] = bits;
        for (int column = 0; column < SIDE; column++) {
            int l = row * SIDE + column;
            lights[l / 8] |= (uint8_t)((bits >> (63 - column) & 1) << l % 8);
        }
    }
    p->begun = true;
}
