/* works_plain.c - programs of works.h in plain C. */
#include "works.h"

#include <stdlib.h>
#include <string.h>

enum { SUBLISTS = 64 };

struct work_plain *work_plain_create(enum work w, int n, int threads)
{
    struct work_plain *p = calloc(1, sizeof *p);
    size_t words = (size_t)n * (w == WORK_CODE ? 2 * WORK_CELLS : 1);
    if (!p)
        return NULL;
    *p = (struct work_plain){.work = w, .n = n, .threads = threads};
    while (p->side * p->side < n)
        p->side++;
    p->in = malloc(words * sizeof *p->in);
    p->out = malloc(words * sizeof *p->out);
    p->limbs = malloc((w == WORK_WIDE ? 2 * WORK_LIMBS : 4) * (size_t)n * sizeof *p->limbs);
    if (!p->in || !p->out || !p->limbs) {
        work_plain_destroy(p);
        return NULL;
    }
    for (size_t i = 0; i < words; i++)
        p->in[i] = work_word((uint32_t)i);
    for (size_t i = 0; w == WORK_CODE && i < words; i++) /* a processor's words are together */
        p->in[i] =
            work_word((uint32_t)(i % (2 * WORK_CELLS) * (size_t)n + i / (2 * WORK_CELLS)));
    for (int k = 0; w == WORK_WIDE && k < 2 * WORK_LIMBS; k++)
        for (int i = 0; i < n; i++)
            p->limbs[(size_t)k * (size_t)n + (size_t)i] =
                (uint32_t)i * (0x9e3779b1u + 2 * (uint32_t)k);
    if (w == WORK_RANKING)
        p->first = work_list(p->in, n);
    return p;
}

void work_plain_destroy(struct work_plain *p)
{
    if (!p)
        return;
    free(p->in);
    free(p->out);
    free(p->limbs);
    free(p);
}

static uint32_t histogram(struct work_plain *p, uint32_t turn)
{
    uint32_t result = 0;
    for (int k = 0; k < WORK_HISTOGRAMS; k++) {
        uint32_t bins[WORK_BINS] = {0};
        int shift = 3 * k, n = p->n;
        const uint32_t *in = p->in;
#pragma omp parallel for reduction(+ : bins[:WORK_BINS]) num_threads(p->threads)
        for (int i = 0; i < n; i++)
            bins[(in[i] + turn) >> shift & (WORK_BINS - 1)]++;
        result = result * 31 + work_weighed(bins, WORK_BINS, 1);
    }
    return result;
}

static uint32_t from_gray(uint32_t code)
{
    for (int shift = 1; shift < 32; shift *= 2)
        code ^= code >> shift;
    return code;
}

static uint32_t transposition(struct work_plain *p, uint32_t turn)
{
    int side = p->side;
    const uint32_t *in = p->in;
    uint32_t *out = p->out;
#pragma omp parallel for num_threads(p->threads)
    for (int row = 0; row < side; row++) {
        uint32_t column = (uint32_t)row ^ (uint32_t)row >> 1;
        for (int i = 0; i < side; i++)
            out[from_gray((uint32_t)i) * (uint32_t)side + column] = in[row * side + i] + turn;
    }
    return work_weighed(out, p->n, p->threads);
}

static int compare(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static uint32_t sort(struct work_plain *p, uint32_t turn)
{
    int n = p->n, half = p->threads > 1 ? n / 2 : n;
    uint32_t *out = p->out, sum = 0;
    for (int i = 0; i < n; i++)
        out[i] = p->in[i] + turn;
    if (p->threads == 1) {
        qsort(out, (size_t)n, sizeof *out, compare);
        return work_weighed(out, n, 1);
    }
#pragma omp parallel for num_threads(2) schedule(static, 1)
    for (int k = 0; k < 2; k++)
        qsort(out + k * half, (size_t)(k ? n - half : half), sizeof *out, compare);
    for (int i = 0, a = 0, b = half; i < n; i++) {
        bool left = b >= n || (a < half && out[a] <= out[b]);
        sum += out[left ? a++ : b++] * (2 * (uint32_t)i + 1);
    }
    return sum;
}

/* Along a sublist from i on, up to the next head: what it weighs; with ranks: what is left,
 * from `left` on. */
static uint32_t walked(const struct work_plain *p, uint32_t turn, uint32_t i, uint32_t left,
                       uint32_t *ranks, uint32_t *after)
{
    uint32_t sum = 0, end = p->in[i];
    for (bool last = false; !last; i = end) {
        end = p->in[i];
        uint32_t weight = end == i ? 0 : (i & 15) + turn;
        if (ranks)
            ranks[i] = left - sum;
        sum += weight;
        last = end == i || p->out[end] < SUBLISTS;
        *after = end == i ? SUBLISTS : p->out[end];
    }
    return sum;
}

/* Helman and JaJa: sublists are walked at once, joined, and walked again. */
static uint32_t ranking(struct work_plain *p, uint32_t turn)
{
    uint32_t heads[SUBLISTS], after[SUBLISTS], sums[SUBLISTS], left[SUBLISTS];
    uint32_t count = 0, all = 0, lists = p->threads > 1 ? SUBLISTS : 1, n = (uint32_t)p->n;
    memset(p->out, 0xff, (size_t)n * sizeof *p->out); /* of a head: its number */
    for (uint32_t k = 0; k < lists; k++) {
        uint32_t head = k ? work_word(k) % n : p->first;
        if (p->out[head] == UINT32_MAX) {
            p->out[head] = count;
            heads[count++] = head;
        }
    }
#pragma omp parallel for num_threads(p->threads) schedule(dynamic, 1) reduction(+ : all)
    for (uint32_t k = 0; k < count; k++)
        all += sums[k] = walked(p, turn, heads[k], 0, NULL, &after[k]);
    for (uint32_t k = 0; k < SUBLISTS; k = after[k]) {
        left[k] = all;
        all -= sums[k];
    }
#pragma omp parallel for num_threads(p->threads) schedule(dynamic, 1)
    for (uint32_t k = 0; k < count; k++)
        walked(p, turn, heads[k], left[k], p->limbs, &after[k]);
    return work_weighed(p->limbs, p->n, p->threads);
}

static uint32_t scans(struct work_plain *p, uint32_t turn)
{
    int rows = p->n / WORK_ROW;
    memset(p->out, 0, (size_t)p->n * sizeof *p->out);
    for (int k = 0; k < WORK_SCANS_COUNT; k++) {
#pragma omp parallel for num_threads(p->threads)
        for (int row = 0; row < rows; row++) {
            const uint32_t *in = p->in + row * WORK_ROW;
            uint32_t *out = p->out + row * WORK_ROW, sum = 0, add = turn + (uint32_t)k;
            for (int i = 0; i < WORK_ROW; i++) {
                uint32_t x = in[i] + add;
                bool begins = in[i] % WORK_SEGMENT == 0 || i == 0;
                if (k % 3 == 2)
                    sum = begins || x > sum ? x : sum;
                else
                    sum = begins ? x : sum + x;
                out[i] ^= sum;
            }
        }
    }
    return work_weighed(p->out, p->n, p->threads);
}

static uint32_t wide(struct work_plain *p, uint32_t turn)
{
    size_t n = (size_t)p->n;
    uint32_t result = 0;
#pragma omp parallel for num_threads(p->threads) reduction(+ : result)
    for (size_t i = 0; i < n; i++) {
        uint64_t carry = turn, product = 0;
        uint32_t factor = 0, mixed = 0;
        for (size_t k = 0; k < WORK_LIMBS; k++) {
            carry += (uint64_t)p->limbs[k * n + i] + p->limbs[(k + WORK_LIMBS) * n + i];
            uint32_t limb = (uint32_t)carry;
            carry >>= 32;
            factor = k ? factor : limb;
            product += (uint64_t)limb * factor;
            mixed ^= (uint32_t)product + (uint32_t)k;
            product >>= 32;
        }
        result += mixed * (2 * (uint32_t)i + 1);
    }
    return result;
}

static uint32_t code(struct work_plain *p, uint32_t turn)
{
    size_t n = (size_t)p->n;
    uint32_t result = 0;
#pragma omp parallel for num_threads(p->threads) reduction(+ : result)
    for (size_t i = 0; i < n; i++) {
        uint32_t cells[WORK_CELLS], at = 0, sum = turn;
        for (size_t k = 0; k < WORK_CELLS; k++)
            cells[k] = p->in[i * 2 * WORK_CELLS + k];
        for (int step = 0; step < WORK_STEPS; step++) {
            uint32_t word = p->in[i * 2 * WORK_CELLS + WORK_CELLS + at] & 127, cell = word & 15;
            switch (word >> 4) {
            case 0:
            case 1:
                sum += cells[cell];
                break;
            case 2:
                sum ^= cells[cell];
                break;
            case 3:
            case 4:
                cells[cell] = sum;
                break;
            case 5:
                sum *= cells[cell];
                break;
            default:
                at += sum & 3;
            }
            at = (at + 1) & 15;
        }
        result += sum * (2 * (uint32_t)i + 1);
    }
    return result;
}

/* The limbs are floats: a matrix, and what is computed. */
static uint32_t product(struct work_plain *p, uint32_t turn)
{
    const int side = p->side;
    float *c = (float *)p->out;
    const uint32_t *words = p->in;
    float *b = (float *)p->limbs, *a = b + p->n;
    for (int i = 0; i < p->n; i++) {
        a[i] = work_part(words[i]);
        b[i] = work_part(words[i] >> 12);
    }
#pragma omp parallel for num_threads(p->threads)
    for (int i = 0; i < side; i++) {
        float *restrict row = c + i * side;
        for (int j = 0; j < side; j++)
            row[j] = (float)turn;
        for (int k = 0; k < side; k++) {
            const float x = a[i * side + k];
            const float *restrict other = b + k * side;
            for (int j = 0; j < side; j++)
                row[j] += x * other[j];
        }
    }
    return work_weighed(p->out, p->n, p->threads);
}

static uint32_t elimination(struct work_plain *p, uint32_t turn)
{
    const int side = p->side;
    double *a = (double *)p->limbs;
    uint32_t result = 0;
    for (int i = 0; i < p->n; i++)
        a[i] = (double)work_part(p->in[i]) + (i % (side + 1) ? 0.0 : side) + (double)turn;
    for (int k = 0; k < side - 1; k++)
#pragma omp parallel for num_threads(p->threads)
        for (int i = k + 1; i < side; i++) {
            double *restrict row = a + i * side;
            const double *restrict other = a + k * side;
            const double by = row[k] /= other[k];
            for (int j = k + 1; j < side; j++)
                row[j] -= by * other[j];
        }
    for (int i = 0; i < p->n; i++)
        result += (p->limbs[2 * i] + p->limbs[2 * i + 1]) * (2 * (uint32_t)i + 1);
    return result;
}

static void half_sweep(float *u, const float *f, const int d[3], int colour, int threads)
{
    const int y = d[2], x = d[1] * d[2];
    const float sixth = (float)(1.0 / 6);
    (void)threads; /* unread without OpenMP */
#pragma omp parallel for num_threads(threads)
    for (int i = 1; i < d[0] - 1; i++)
        for (int j = 1; j < d[1] - 1; j++)
            for (int k = 1 + (i + j + colour) % 2; k < d[2] - 1; k += 2) {
                const int at = (i * d[1] + j) * d[2] + k;
                float *q = u + at;
                *q = (f[at] + q[x] + q[-x] + q[y] + q[-y] + q[1] + q[-1]) * sixth;
            }
}

static uint32_t red_black(struct work_plain *p, uint32_t turn)
{
    float *u = (float *)p->out, *f = (float *)p->limbs;
    int d[3];
    work_box(p->n, d);
    for (int i = 0; i < p->n; i++) {
        u[i] = work_part(p->in[i]) + (float)turn;
        f[i] = work_part(p->in[i] >> 12);
    }
    for (int s = 0; s < 2 * WORK_SWEEPS; s++)
        half_sweep(u, f, d, s % 2, p->threads);
    return work_weighed(p->out, p->n, p->threads);
}

uint32_t work_plain_run(struct work_plain *p, uint32_t turn)
{
    uint32_t (*const runs[WORKS_COUNT])(struct work_plain *, uint32_t) = {histogram,
                                                                          transposition,
                                                                          sort,
                                                                          ranking,
                                                                          scans,
                                                                          wide,
                                                                          code,
                                                                          product,
                                                                          elimination,
                                                                          red_black,
                                                                          work_plain_fourier,
                                                                          work_plain_multigrid,
                                                                          work_plain_vectors,
                                                                          work_plain_few};
    return runs[p->work](p, turn);
}
