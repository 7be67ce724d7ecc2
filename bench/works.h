/* works.h - the programs of `lutetia bench families`: what C/Paris was used for outside of
 * stencils, each in Paris and in plain C. All come to the same number: results are added as
 * whole numbers, floats by their bits.
 *
 *     histogram      seven histograms of 1,024 bins, by sends that add
 *     transposition  of an array on the front end, rows and columns in Gray code: there, by a
 *                    send, and back
 *     sort           bitonic, by gets; in plain C qsort()
 *     list ranking   weights to the end of a list, by pointer jumping; in plain C from sublist
 *                    to sublist
 *     scans          24 segmented scans along rows of 1,000, sums and maxima
 *     wide numbers   numbers of 512 bits: a sum with carries, and its product with a word
 *     byte code      a program and an array for each processor
 *     product        of two matrices of single floats, by spreads: a column of one and a row of
 *                    the other for each step
 *     elimination    of a matrix of doubles, by spreads, without looking for pivots
 *     red and black  sweeps of Gauss and Seidel in three dimensions, one colour after the
 *                    other, by contexts; the walls are fixed
 *     Fourier        a transform of complex floats along both axes, by gets; what comes out is
 *                    in the order of reversed bits
 *     multigrid      V-cycles of five VP sets, by gets from set to set, on a torus
 *     vectors        what a library of vectors does: a call, a look at a count or a sum, the
 *                    next call; in plain C a loop for each call
 *     few of many    numbers in a small part of a set, under a context; in plain C they
 *                    alone */
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
    WORK_FOURIER,
    WORK_MULTIGRID,
    WORK_VECTORS,
    WORK_FEW,
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
    WORK_SWEEPS = 10,
    WORK_GRIDS = 5, /* of the multigrid; a grid's side is half of that before */
    WORK_CYCLES = 3,
    WORK_SMOOTHINGS = 2, /* before and after; on the last grid four times as many */
    WORK_ROUNDS = 16,    /* of vectors */
    WORK_LOOKS = 6,      /* of few of many; so many calls of each kind lie between two */
    WORK_CALLS = 8
};

/* works_common.c, with work_list(), work_weighed() and work_twiddle() */
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
/* How many of n processors hold numbers of the vectors, and of the few. */
static inline int work_vector_length(int n)
{
    return n > 100000 ? 100000 : n / 4 * 3;
}
static inline int work_few_length(int n)
{
    return n / 64;
}
/* The factors of a transform of n numbers: exp (-2 pi i k / n). */
void work_twiddle(int k, int n, float *re, float *im);

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
struct work_plain {
    enum work work;
    int n, side, threads;
    uint32_t *in, *out, *limbs, first;
};
struct work_plain *work_plain_create(enum work w, int n, int threads);
uint32_t work_plain_run(struct work_plain *p, uint32_t turn);
void work_plain_destroy(struct work_plain *p); /* takes NULL */
/* works_sets_plain.c */
uint32_t work_plain_fourier(struct work_plain *p, uint32_t turn);
uint32_t work_plain_multigrid(struct work_plain *p, uint32_t turn);
uint32_t work_plain_vectors(struct work_plain *p, uint32_t turn);
uint32_t work_plain_few(struct work_plain *p, uint32_t turn);

/* works_paris.c */
struct work_paris;
struct work_paris *work_paris_create(enum work w, int n); /* Errors: NULL */
uint32_t work_paris_run(struct work_paris *p, uint32_t turn);
void work_paris_destroy(struct work_paris *p); /* takes NULL */

/* works.c: they come to the same, for some turns; in bench_error() it says if not. */
bool works_same(enum work w, int n, int turns);

#endif
