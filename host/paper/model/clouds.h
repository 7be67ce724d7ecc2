/* clouds.h - random clouds of many sizes on the front end, the same bits everywhere: sums,
 * products, quotients and square roots only. */
#ifndef LUTETIA_PAPER_CLOUDS_H
#define LUTETIA_PAPER_CLOUDS_H

#include <stdbool.h>
#include <stdint.h>

/* Sizes from `coarsest` down to at least `finest`, each half of the one before it. */
struct clouds {
    double finest, coarsest; /* fibers between the random numbers, 1.. */
    double step;             /* amplitude of each size, to that of the next coarser */
    uint64_t seed;
    /* each size by an angle of its own, but on a torus: nothing in them lies along the axes */
    bool turned;
    /* turned ones are made only so far from the sheet's sides, and are 0 farther in; 0:
     * everywhere */
    int border;
};

/* Shape: out holds height * width numbers, rows from the top; mean about 0, deviation about 1,
 * over a large sheet. Sizes may be any numbers, so a sheet at another resolution with sizes in
 * proportion gets the same clouds, drawn finer. A torus has no seam. False: no memory. */
bool clouds_make(float *out, int width, int height, bool torus, const struct clouds *of);

/* 64 bits by chance, from a number and its seed. */
static inline uint64_t clouds_word(uint64_t seed, uint64_t number)
{
    uint64_t z = seed * UINT64_C(0x9e3779b97f4a7c15) + number * UINT64_C(0xd1342543de82ef95) +
                 UINT64_C(0x2545f4914f6cdd1d);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* 0..1, below 1. */
static inline double clouds_chance(uint64_t seed, uint64_t number)
{
    return (double)(clouds_word(seed, number) >> 11) * 0x1p-53;
}

#endif
