/* works_common.c - what the programs of works.h begin with and come to, in Paris and in plain
 * C. */
#include <math.h>
#include <stdlib.h>

#include "works.h"

const char *const work_names[WORKS_COUNT] = {
    "histogram",    "transposition", "sort",    "list ranking", "scans",
    "wide numbers", "byte code",     "product", "elimination",  "red and black",
    "Fourier",      "multigrid",     "vectors", "few of many"};

int work_size(enum work w, bool small)
{
    switch (w) {
    case WORK_SCANS:
        return small ? 7 * WORK_ROW : 1000 * WORK_ROW;
    case WORK_WIDE:
        return small ? 1000 : 500000;
    case WORK_PRODUCT:
        return small ? 40 * 40 : 600 * 600;
    case WORK_ELIMINATION:
        return small ? 30 * 30 : 500 * 500;
    case WORK_RED_BLACK:
        return small ? 12 * 9 * 6 : 200 * 197 * 100;
    case WORK_FOURIER:
        return small ? 16 * 16 : 512 * 512;
    case WORK_MULTIGRID:
        return small ? 32 * 32 : 512 * 512;
    case WORK_VECTORS:
        return small ? 1 << 10 : 1 << 17;
    case WORK_FEW:
        return small ? 1 << 12 : 1 << 16;
    case WORK_HISTOGRAM:
    case WORK_TRANSPOSITION:
    case WORK_SORT:
    case WORK_RANKING:
    case WORK_CODE:
    case WORKS_COUNT:
        break;
    }
    return small ? 1 << 12 : 1 << 20;
}

uint32_t work_list(uint32_t *next, int n)
{
    uint32_t *order = malloc((size_t)n * sizeof *order), first = 0;
    for (int i = 0; order && i < n; i++)
        order[i] = (uint32_t)i;
    for (int i = n - 1; order && i > 0; i--) {
        uint32_t k = work_word((uint32_t)i) % (uint32_t)(i + 1), kept = order[i];
        order[i] = order[k];
        order[k] = kept;
    }
    for (int i = 0; order && i < n; i++)
        next[order[i]] = order[i + 1 < n ? i + 1 : i];
    first = order ? order[0] : 0;
    free(order);
    return first;
}

void work_twiddle(int k, int n, float *re, float *im)
{
    const double angle = -2 * 3.14159265358979323846 * k / n;
    *re = (float)cos(angle);
    *im = (float)sin(angle);
}

uint32_t work_weighed(const uint32_t *x, int n, int threads)
{
    uint32_t sum = 0;
    (void)threads; /* unread without OpenMP */
#pragma omp parallel for reduction(+ : sum) num_threads(threads)
    for (int i = 0; i < n; i++)
        sum += x[i] * (2 * (uint32_t)i + 1);
    return sum;
}
