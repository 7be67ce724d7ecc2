/* grids_openmp.c - Life and heat in C with OpenMP, one step at a time; see grids.h.
 *
 * There are two copies of the grid; each thread has a band of rows. Rows have margins, which
 * hold the cells beyond the ends. If both copies do not fit the last-level cache, a row is
 * computed in a buffer and written by stores that bypass the caches.
 */
#include "grids.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include "harness.h"

enum { MARGIN_BYTES = 64, PAGE_BYTES = 4096 };

struct grid_openmp {
    int width, height;        /* cells */
    size_t row_bytes;         /* of the cells, without margins */
    size_t pitch;             /* bytes from row to row */
    bool past;                /* the caches */
    unsigned char *memory[2]; /* [0] is the grid */
};

static struct grid_openmp *grid_create(int width, int height, size_t row_bytes)
{
    struct grid_openmp *g = calloc(1, sizeof *g);
    if (!g) {
        bench_fail("no memory");
        return NULL;
    }
    *g = (struct grid_openmp){.width = width, .height = height, .row_bytes = row_bytes};
    g->pitch = (row_bytes + 2 * MARGIN_BYTES + 63) / 64 * 64;
    if (g->pitch % PAGE_BYTES == 0)
        g->pitch += 64;
    size_t bytes = (g->pitch * (size_t)height + PAGE_BYTES - 1) / PAGE_BYTES * PAGE_BYTES;
    long cache_bytes = sysconf(_SC_LEVEL3_CACHE_SIZE);
    g->past = 2 * (double)bytes > 0.75 * (double)cache_bytes;
    for (int i = 0; i < 2; i++)
        if (!(g->memory[i] = aligned_alloc(PAGE_BYTES, bytes))) {
            bench_fail("no memory for a grid of %dx%d", width, height);
            grid_openmp_destroy(g);
            return NULL;
        } else {
            memset(g->memory[i], 0, bytes);
        }
    return g;
}

void grid_openmp_destroy(struct grid_openmp *g)
{
    if (g) {
        free(g->memory[0]);
        free(g->memory[1]);
    }
    free(g);
}

static void *row_of(const struct grid_openmp *g, int copy, int y)
{
    return g->memory[copy] + (size_t)y * g->pitch + MARGIN_BYTES;
}

/* Row y of the sheet on a torus. */
static const void *row_round(const struct grid_openmp *g, int y)
{
    return row_of(g, 0, y < 0 ? g->height - 1 : y == g->height ? 0 : y);
}

static void copies_swap(struct grid_openmp *g)
{
    unsigned char *swap = g->memory[0];
    g->memory[0] = g->memory[1];
    g->memory[1] = swap;
}

/* From a buffer to a row of the other copy, margins and all. */
static void row_write(const struct grid_openmp *g, int y, const void *row)
{
    void *to = row_of(g, 1, y);
    size_t bytes = (g->row_bytes + 63) / 64 * 64;
#ifdef __AVX512F__
    for (size_t i = 0; g->past && i < bytes; i += 64)
        _mm512_stream_si512((__m512i *)((char *)to + i),
                            _mm512_load_si512((const char *)row + i));
    if (g->past)
        return;
#endif
    memcpy(to, row, bytes);
}

static void writes_settle(void)
{
#ifdef __AVX512F__
    _mm_sfence();
#endif
}

static void *row_buffer(const struct grid_openmp *g)
{
    void *buffer = aligned_alloc(64, g->pitch);
    if (!buffer)
        abort();
    memset(buffer, 0, g->pitch);
    return buffer;
}

/* ---- Life, a byte a cell ---- */

struct grid_openmp *life_openmp_create(int width, int height, const uint8_t *start)
{
    struct grid_openmp *g = grid_create(width, height, (size_t)width);
    for (int y = 0; g && y < height; y++)
        memcpy(row_of(g, 0, y), start + (size_t)y * (size_t)width, (size_t)width);
    return g;
}

void life_openmp_read(const struct grid_openmp *g, uint8_t *out)
{
    for (int y = 0; y < g->height; y++)
        memcpy(out + (size_t)y * (size_t)g->width, row_of(g, 0, y), (size_t)g->width);
}

/* Not inline: otherwise clang carries values over to later code, or from one iteration of
 * the loop to the next, and does not vectorise. */
#define APART static __attribute__((noinline))

/* Sums three cells above each other. */
APART void columns_add(const uint8_t *restrict above, const uint8_t *restrict here,
                       const uint8_t *restrict below, uint8_t *restrict columns, int width)
{
#pragma omp simd
    for (int x = 0; x < width; x++)
        columns[x] = (uint8_t)(above[x] + here[x] + below[x]);
}

APART void bytes_row(const uint8_t *left, const uint8_t *middle, const uint8_t *right,
                     const uint8_t *here, uint8_t *restrict made, int width)
{
#pragma omp simd
    for (int x = 0; x < width; x++) {
        uint8_t sum = (uint8_t)(left[x] + middle[x] + right[x]);
        made[x] = (uint8_t)((sum == 3) | ((sum == 4) & here[x]));
    }
}

void life_openmp_steps(struct grid_openmp *g, int steps_count)
{
    const int width = g->width;
#pragma omp parallel
    {
        uint8_t *columns = (uint8_t *)row_buffer(g) + MARGIN_BYTES, *made = row_buffer(g);
        for (int step = 0; step < steps_count; step++) {
#pragma omp for schedule(static)
            for (int y = 0; y < g->height; y++) {
                const uint8_t *above = row_round(g, y - 1), *here = row_of(g, 0, y),
                              *below = row_round(g, y + 1);
                columns_add(above, here, below, columns, width);
                columns[-1] = columns[width - 1];
                columns[width] = columns[0];
                bytes_row(columns - 1, columns, columns + 1, here, made, width);
                row_write(g, y, made);
            }
            writes_settle();
#pragma omp barrier
#pragma omp single
            copies_swap(g);
        }
        free(columns - MARGIN_BYTES);
        free(made);
    }
}

/* ---- Life, a bit a cell ---- */

enum { WORD = 64 };

struct grid_openmp *life_bits_create(int width, int height, const uint8_t *start)
{
    if (width % WORD) {
        bench_fail("the width must be a multiple of %d (got %d)", WORD, width);
        return NULL;
    }
    struct grid_openmp *g = grid_create(width, height, (size_t)width / 8);
    for (int y = 0; g && y < height; y++) {
        uint64_t *row = row_of(g, 0, y);
        for (int x = 0; x < width; x++)
            row[x / WORD] |= (uint64_t)(start[(size_t)y * (size_t)width + (size_t)x] & 1)
                             << x % WORD;
    }
    return g;
}

void life_bits_read(const struct grid_openmp *g, uint8_t *out)
{
    for (int y = 0; y < g->height; y++) {
        const uint64_t *row = row_of(g, 0, y);
        for (int x = 0; x < g->width; x++)
            out[(size_t)y * (size_t)g->width + (size_t)x] = row[x / WORD] >> x % WORD & 1;
    }
}

APART void columns_add_bits(const uint64_t *restrict above, const uint64_t *restrict here,
                            const uint64_t *restrict below, uint64_t *restrict low,
                            uint64_t *restrict high, int words)
{
#pragma omp simd
    for (int i = 0; i < words; i++) {
        uint64_t a = above[i], b = here[i], c = below[i];
        low[i] = a ^ b ^ c;
        high[i] = (a & b) | (c & (a ^ b));
    }
}

/* low and high: the bits of the sum of three cells above each other, with a word beyond each
 * end. Adds three such sums side by side, bit by bit. */
static void bits_row(const uint64_t *restrict here, const uint64_t *restrict low,
                     const uint64_t *restrict high, uint64_t *restrict made, int words)
{
#pragma omp simd
    for (int i = 0; i < words; i++) {
        uint64_t l0 = low[i] << 1 | low[i - 1] >> (WORD - 1), l1 = low[i],
                 l2 = low[i] >> 1 | low[i + 1] << (WORD - 1);
        uint64_t h0 = high[i] << 1 | high[i - 1] >> (WORD - 1), h1 = high[i],
                 h2 = high[i] >> 1 | high[i + 1] << (WORD - 1);
        uint64_t ones = l0 ^ l1 ^ l2, carry = (l0 & l1) | (l2 & (l0 ^ l1));
        uint64_t twos = h0 ^ h1 ^ h2, fours = (h0 & h1) | (h2 & (h0 ^ h1));
        uint64_t carry2 = twos & carry;
        twos ^= carry;
        /* The sum is ones + 2 twos + 4 (fours + carry2); 3: 1 1 0, 4: 0 0 1. */
        uint64_t three = ones & twos & ~(fours | carry2);
        uint64_t four = ~ones & ~twos & (fours ^ carry2);
        made[i] = three | (four & here[i]);
    }
}

void life_bits_steps(struct grid_openmp *g, int steps_count)
{
    const int words = g->width / WORD;
#pragma omp parallel
    {
        uint64_t *low = (uint64_t *)row_buffer(g) + MARGIN_BYTES / 8,
                 *high = (uint64_t *)row_buffer(g) + MARGIN_BYTES / 8, *made = row_buffer(g);
        for (int step = 0; step < steps_count; step++) {
#pragma omp for schedule(static)
            for (int y = 0; y < g->height; y++) {
                const uint64_t *above = row_round(g, y - 1), *here = row_of(g, 0, y),
                               *below = row_round(g, y + 1);
                columns_add_bits(above, here, below, low, high, words);
                low[-1] = low[words - 1];
                high[-1] = high[words - 1];
                low[words] = low[0];
                high[words] = high[0];
                bits_row(here, low, high, made, words);
                row_write(g, y, made);
            }
            writes_settle();
#pragma omp barrier
#pragma omp single
            copies_swap(g);
        }
        free(low - MARGIN_BYTES / 8);
        free(high - MARGIN_BYTES / 8);
        free(made);
    }
}

/* ---- heat ---- */

struct grid_openmp *heat_openmp_create(int width, int height, const float *start)
{
    struct grid_openmp *g = grid_create(width, height, (size_t)width * sizeof(float));
    for (int copy = 0; g && copy < 2; copy++)
        for (int y = 0; y < height; y++)
            memcpy(row_of(g, copy, y), start + (size_t)y * (size_t)width,
                   (size_t)width * sizeof(float));
    return g;
}

void heat_openmp_read(const struct grid_openmp *g, float *out)
{
    for (int y = 0; y < g->height; y++)
        memcpy(out + (size_t)y * (size_t)g->width, row_of(g, 0, y),
               (size_t)g->width * sizeof(float));
}

/* Each row is given three times: as seen from its left, from itself, and from its right. */
APART void heat_row(const float *const up[3], const float *const here[3],
                    const float *const down[3], float *restrict made, int begin, int end)
{
    const float *up_left = up[0], *up_middle = up[1], *up_right = up[2];
    const float *left = here[0], *middle = here[1], *right = here[2];
    const float *down_left = down[0], *down_middle = down[1], *down_right = down[2];
    const float rate = (float)HEAT_RATE;
#pragma omp simd
    for (int x = begin; x < end; x++) {
        float corners = up_right[x] + up_left[x] + down_right[x] + down_left[x];
        float t = up_middle[x] + down_middle[x] + right[x] + left[x];
        t = t * 4.0f + corners;
        t = t - middle[x] * 20.0f;
        made[x] = middle[x] + t * rate;
    }
}

void heat_openmp_steps(struct grid_openmp *g, int steps_count)
{
    const int width = g->width;
#pragma omp parallel
    {
        float *made = row_buffer(g);
        for (int step = 0; step < steps_count; step++) {
#pragma omp for schedule(static)
            for (int y = 1; y < g->height - 1; y++) {
                const float *up = row_of(g, 0, y + 1), *here = row_of(g, 0, y),
                            *down = row_of(g, 0, y - 1);
                const float *const ups[] = {up - 1, up, up + 1},
                                   *const heres[] = {here - 1, here, here + 1},
                                   *const downs[] = {down - 1, down, down + 1};
                heat_row(ups, heres, downs, made, 1, width - 1);
                made[0] = here[0];
                made[width - 1] = here[width - 1];
                row_write(g, y, made);
            }
            writes_settle();
#pragma omp barrier
#pragma omp single
            copies_swap(g);
        }
        free(made);
    }
}
