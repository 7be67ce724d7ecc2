/* works_sets_plain.c - programs of works.h in plain C: those of works_sets_paris.c. */
#include "works.h"

#include <string.h>

/* ---- Fourier ---- */

enum { SIDE_MOST = 1024 };

/* (x, y) and (u, v), of one row of pairs: the sums; the differences times a factor, which is
 * the same for all, or one for each. */
static inline void pair(float *x, float *y, float *u, float *v, float re, float im)
{
    const float a = *x - *u, b = *y - *v;
    *x += *u;
    *y += *v;
    *u = a * re - b * im;
    *v = b * re + a * im;
}

static void row_transform(float *x, float *y, int n, const float *re, const float *im)
{
    for (int half = n / 2; half > 0; half /= 2)
        for (int first = 0; first < n; first += 2 * half)
            for (int k = 0; k < half; k++) {
                const int i = first + k, t = k * (n / 2 / half);
                pair(&x[i], &y[i], &x[i + half], &y[i + half], re[t], im[t]);
            }
}

static void columns_transform(float *x, float *y, int n, const float *re, const float *im,
                              int threads)
{
    (void)threads; /* unread without OpenMP */
    for (int half = n / 2; half > 0; half /= 2)
#pragma omp parallel for num_threads(threads)
        for (int i = 0; i < n / 2; i++) {
            const int k = i % half, row = i / half * 2 * half + k, t = k * (n / 2 / half);
            float *restrict x0 = x + row * n, *restrict y0 = y + row * n;
            float *restrict x1 = x0 + half * n, *restrict y1 = y0 + half * n;
            for (int c = 0; c < n; c++)
                pair(&x0[c], &y0[c], &x1[c], &y1[c], re[t], im[t]);
        }
}

uint32_t work_plain_fourier(struct work_plain *p, uint32_t turn)
{
    float re[SIDE_MOST], im[SIDE_MOST], *x = (float *)p->out, *y = (float *)p->limbs;
    const int n = p->side;
    for (int k = 0; k < n; k++)
        work_twiddle(k, n, &re[k], &im[k]);
    for (int i = 0; i < p->n; i++) {
        x[i] = work_part(p->in[i]) + (float)turn;
        y[i] = work_part(p->in[i] >> 12);
    }
#pragma omp parallel for num_threads(p->threads)
    for (int row = 0; row < n; row++)
        row_transform(x + row * n, y + row * n, n, re, im);
    columns_transform(x, y, n, re, im, p->threads);
    return work_weighed(p->out, p->n, p->threads) + work_weighed(p->limbs, p->n, p->threads);
}

/* ---- multigrid ---- */

struct grid {
    float *u, *f, *sum;
    int side;
};

/* What a place's neighbours and its f are in all. */
static inline float all_around(const float *f, const float *up, const float *u,
                               const float *down, int at, int left, int right)
{
    return f[at] + down[at] + up[at] + u[right] + u[left];
}

/* sum: how u changes, or (residual) what is left to solve for. */
static void around(const struct grid *g, bool residual, int threads)
{
    const int n = g->side;
    (void)threads; /* unread without OpenMP */
#pragma omp parallel for num_threads(threads)
    for (int i = 0; i < n; i++) {
        const float *u = g->u + i * n, *up = g->u + (i ? i - 1 : n - 1) * n,
                    *down = g->u + (i + 1 < n ? i + 1 : 0) * n, *f = g->f + i * n;
        float *restrict sum = g->sum + i * n;
        sum[0] = all_around(f, up, u, down, 0, n - 1, 1);
        for (int k = 1; k < n - 1; k++)
            sum[k] = all_around(f, up, u, down, k, k - 1, k + 1);
        sum[n - 1] = all_around(f, up, u, down, n - 1, n - 2, 0);
        for (int k = 0; k < n; k++)
            sum[k] = residual ? sum[k] - u[k] * 4 : (sum[k] * 0.25f - u[k]) * 0.75f;
    }
}

static void smooth(const struct grid *g, int times, int threads)
{
    for (int t = 0; t < times; t++) {
        around(g, false, threads);
        const int count = g->side * g->side;
#pragma omp parallel for num_threads(threads)
        for (int i = 0; i < count; i++)
            g->u[i] += g->sum[i];
    }
}

static void restrict_from(const struct grid *g, int threads)
{
    const int n = g->side, half = n / 2;
    around(g, true, threads);
#pragma omp parallel for num_threads(threads)
    for (int i = 0; i < half; i++)
        for (int k = 0; k < half; k++) {
            const float *a = g->sum + 2 * i * n + 2 * k, *b = a + n;
            g[1].f[i * half + k] = (a[0] + b[0]) + (a[1] + b[1]);
            g[1].u[i * half + k] = 0;
        }
}

static void prolong_to(const struct grid *g, int threads)
{
    const int n = g->side;
    (void)threads; /* unread without OpenMP */
#pragma omp parallel for num_threads(threads)
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++)
            g->u[i * n + k] += g[1].u[i / 2 * (n / 2) + k / 2];
}

static float *taken(float **words, int side)
{
    float *const grid = *words;
    *words += side * side;
    return grid;
}

uint32_t work_plain_multigrid(struct work_plain *p, uint32_t turn)
{
    struct grid grids[WORK_GRIDS];
    float *words = (float *)p->limbs; /* three times n are enough */
    for (int k = 0; k < WORK_GRIDS; k++) {
        const int side = p->side >> k;
        grids[k] = (struct grid){.u = k ? taken(&words, side) : (float *)p->out,
                                 .f = taken(&words, side),
                                 .sum = taken(&words, side),
                                 .side = side};
    }
    for (int i = 0; i < p->n; i++) {
        grids[0].u[i] = (float)turn;
        grids[0].f[i] = work_part(p->in[i]);
    }
    for (int cycle = 0; cycle < WORK_CYCLES; cycle++) {
        for (int k = 0; k + 1 < WORK_GRIDS; k++) {
            smooth(&grids[k], WORK_SMOOTHINGS, p->threads);
            restrict_from(&grids[k], p->threads);
        }
        smooth(&grids[WORK_GRIDS - 1], 4 * WORK_SMOOTHINGS, 1);
        for (int k = WORK_GRIDS - 2; k >= 0; k--) {
            prolong_to(&grids[k], p->threads);
            smooth(&grids[k], WORK_SMOOTHINGS, p->threads);
        }
    }
    return work_weighed(p->out, p->n, p->threads);
}

/* ---- vectors ---- */

/* One loop for each call, as a library of vectors for one processor has them. */
static uint32_t places_of(const uint32_t *marks, uint32_t wanted, uint32_t *places, int length,
                          uint32_t first)
{
    const uint32_t begin = first;
    for (int i = 0; i < length; i++) {
        places[i] = marks[i] == wanted ? first : places[i];
        first += marks[i] == wanted;
    }
    return first - begin;
}

uint32_t work_plain_vectors(struct work_plain *p, uint32_t turn)
{
    const int length = work_vector_length(p->n);
    uint32_t *x = p->out, *y = p->limbs, *places = y + p->n, *marks = places + p->n, result = 0;
    for (int i = 0; i < length; i++)
        x[i] = p->in[i] + turn;
    for (int round = 0; round < WORK_ROUNDS; round++) {
        const uint32_t pivot = x[length / WORK_ROUNDS * round];
        uint32_t sum = 0;
#pragma omp parallel for num_threads(p->threads)
        for (int i = 0; i < length; i++)
            marks[i] = x[i] < pivot;
        const uint32_t count = places_of(marks, 1, places, length, 0);
        places_of(marks, 0, places, length, count);
#pragma omp parallel for num_threads(p->threads)
        for (int i = 0; i < length; i++)
            y[places[i]] = x[i];
#pragma omp parallel for num_threads(p->threads)
        for (int i = 0; i < length; i++)
            x[i] = y[i] * 0x9e3779b1u;
#pragma omp parallel for num_threads(p->threads)
        for (int i = 0; i < length; i++)
            x[i] += pivot;
#pragma omp parallel for num_threads(p->threads) reduction(+ : sum)
        for (int i = 0; i < length; i++)
            sum += x[i];
        result = result * 31 + count + sum;
    }
    return result;
}

/* ---- few of many ---- */

uint32_t work_plain_few(struct work_plain *p, uint32_t turn)
{
    const int length = work_few_length(p->n);
    uint32_t *x = p->out, *y = p->limbs, *z = y + p->n, result = 0;
    for (int i = 0; i < length; i++) {
        x[i] = p->in[i] + turn;
        y[i] = p->in[i];
    }
    for (uint32_t k = 0; k < WORK_LOOKS; k++) {
        uint32_t sum = 0, all = 0;
        for (uint32_t c = 0; c < WORK_CALLS; c++)
            for (int i = 0; i < length; i++) {
                z[i] = x[i] * y[i];
                x[i] ^= z[i];
                y[i] = (x[i] > z[i] ? x[i] : z[i]) + k * WORK_CALLS + c;
            }
        for (int i = 0; i < length; i++) {
            x[i] ^= sum += y[i];
            all += x[i];
        }
        result = result * 31 + all;
    }
    return result;
}
