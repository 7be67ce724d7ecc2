/* works.h - the programs of `lutetia bench families`: what C/Paris was used for outside of stencils, each in Paris and in plain
 * C. All come to the same number: results are added as whole numbers, floats by their bits.
 *
 *     histogram      seven histograms of 1,024 bins, by sends that add
 *     transposition  of an array on the front end, rows and columns in Gray code: there, by a send, and back
 *     sort           bitonic, by gets; in plain C qsort()
 *     list ranking   weights to the end of a list, by pointer jumping; in plain C from sublist to sublist
 *     scans          24 segmented scans along rows of 1,000, sums and maxima
 *     wide numbers   numbers of 512 bits: a sum with carries, and its product with a word
 *     byte code      a program and an array for each processor
 *     product        of two matrices of single floats, by spreads: a column of one and a row of the other for each step
 *     elimination    of a matrix of doubles, by spreads, without looking for pivots
 *     red and black  sweeps of Gauss and Seidel in three dimensions, one colour after the other, by contexts; the walls are fixed */
#ifndef LUTETIA_BENCH_WORKS_H
#define LUTETIA_BENCH_WORKS_H

#include <stdbool.h>
#include <stdint.h>

enum work {
    WORK_HISTOGRAM,
    WORK_TRANSPOSITION,
    WORK_SORT,
    WORK_RANKING,
    WORK_SCANS,
    WORK_WIDE,
    WORK_CODE,
    WORK_PRODUCT,
    WORK_ELIMINATION,
    WORK_RED_BLACK,
    WORKS_COUNT
};

enum {
    WORK_BINS = 1024,
    WORK_HISTOGRAMS = 7,
    WORK_ROW = 1000, /* of scans */
    WORK_SCANS_COUNT = 24,
    WORK_SEGMENT = 37,
    WORK_LIMBS = 16,
    WORK_CELLS = 16, /* of a processor's array, and of its program */
    WORK_STEPS = 16,
    WORK_SWEEPS = 10
};

extern const char *const work_names[WORKS_COUNT];
/* Processors of a work; small: for tests. */
int work_size(enum work w, bool small);

/* What every implementation begins with. */
static inline uint32_t work_word(uint32_t i)
{
    uint32_t z = i * 0x9e3779b1u + 0x7f4a7c15u;
    z = (z ^ z >> 16) * 0x85ebca6bu;
    z = (z ^ z >> 13) * 0xc2b2ae35u;
    return z ^ z >> 16;
}

/* The sides of the box of red and black: 2 k, 2 k - 3 and k. */
static inline void work_box(int n, int sides[3])
{
    int k = 2;
    while (2 * k * (2 * k - 3) * k < n)
        k++;
    sides[0] = 2 * k;
    sides[1] = 2 * k - 3;
    sides[2] = k;
}
/* From 0 to 1, with few bits. */
static inline float work_part(uint32_t word)
{
    return (float)(word & 4095) / 4096;
}

/* A list of all n: who follows whom; the last one follows itself. Returns the first. */
uint32_t work_list(uint32_t *next, int n);
/* The sum of all, each times 2 place + 1. */
uint32_t work_weighed(const uint32_t *x, int n, int threads);

/* works_plain.c: in plain C, by one thread or two. NULL: no memory. */
struct work_plain;
struct work_plain *work_plain_create(enum work w, int n, int threads);
uint32_t work_plain_run(struct work_plain *p, uint32_t turn);
void work_plain_destroy(struct work_plain *p); /* takes NULL */

/* works_paris.c */
struct work_paris;
struct work_paris *work_paris_create(enum work w, int n); /* Errors: NULL */
uint32_t work_paris_run(struct work_paris *p, uint32_t turn);
void work_paris_destroy(struct work_paris *p); /* takes NULL */

/* works.c: they come to the same, for some turns; in bench_error() it says if not. */
bool works_same(enum work w, int n, int turns);

#endif
