/* gray_kernel.h - edges to gray, included by gray_plain.c, gray_avx2.c and gray_avx512.c with
 *     LANES    floats in a vector: 4, 8 or 16
 *     KERNEL   the function's name
 *
 * Sums are kept as differences between a row and the one above it, so that a bit of edge
 * touches only the rows within the filter's reach and all the ink below it costs nothing:
 *
 *                taps ->                 a node adds an outer product:
 *          . . . x x x x . . . .         taps of its column, times its weight,
 *     rows . . . x x x x . . . .         times rows: taps + 1 of them
 *      |   . . . x x x x . . . .
 *      v   . . . x x x x . . . .         a horizontal line the same with wider taps
 *          . . . x x x x . . . .
 *
 * At the end one pass down the columns adds the rows up.
 *
 * Nodes that follow each other mostly add to the same block of 8 columns, which begins at a
 * multiple of 4 (of 2 or 1 if there are more than 5 taps), of the same rows: they are added up
 * in registers, and then once to the sums.
 *
 * In a small picture they seldom are, and what one node stores the next loads at once, of
 * columns that overlap. A processor hands what was just stored to the next load without waiting
 * only if the load is of the same bytes; so there sums of up to five taps are touched in whole
 * blocks alone. Of a picture of up to 16 columns a row of sums is two rows of such blocks, each
 * aligned, added up at the end:
 *
 *     even   |0       |8       |
 *     odd    |   4    |   12   |
 *
 * The tables are padded, so that a block's values are one load whatever column the taps begin
 * at. */
#include "gray_internal.h"
#include "lanes.h"

#include <string.h>

enum { ROW = 16, HALF_LANES = LANES > 8 ? 8 : LANES };

typedef float half_vector __attribute__((vector_size(HALF_LANES * 4)));
typedef float half_loose __attribute__((vector_size(HALF_LANES * 4), aligned(4), may_alias));

#define APART __attribute__((noinline))

enum { PARTS = ROW / LANES, HALF_PARTS = ROW / HALF_LANES };

INLINE half_vector half_load(const float *at)
{
    return *(const half_loose *)at;
}

/* What vectors wrote is read again one by one: a processor broadcasts from memory for
 * nothing. */
#define IN_MEMORY() __asm__ volatile("" ::: "memory")

#define SHORT(taps) ((taps) <= 5) /* they lie in a block that begins at a multiple of 4 */
#define STEP(taps) (SHORT(taps) ? 4 : (taps) <= 7 ? 2 : 1)
#define WEIGHTS(taps) ((taps) < 8 ? 8 : ROW) /* floats for taps + 1 */

/* What rows get: the taps down, times the weight. */
INLINE void rows_weigh(half_vector *out, const float *y, float t, float weight, int taps)
{
    for (int p = 0; p < WEIGHTS(taps) / HALF_LANES; p++)
        out[p] =
            (half_load(y + p * HALF_LANES) + half_load(y + FONT_Y_ROW + p * HALF_LANES) * t) *
            weight;
}

/* One of them in all lanes: from a register, which takes no load. */
INLINE half_vector spread(const half_vector *weights, int row)
{
#if LANES > 4
    return (half_vector)_mm256_permutevar8x32_ps((__m256)weights[row / 8],
                                                 _mm256_set1_epi32(row % 8));
#else
    return weights[row / HALF_LANES][row % HALF_LANES] - (half_vector){0};
#endif
}

/* The row that y reaches first, and its phase. */
INLINE void row_weigh(half_vector *out, const float *table, float a, int *row, int taps)
{
    int i = (int)a;
    float at = (a - (float)i) * FONT_PHASES;
    int phase = (int)at;
    *row = i;
    rows_weigh(out, table + phase * 2 * FONT_Y_ROW, at - (float)phase, 1, taps);
}

INLINE bool row_in_band(const struct font_gray_job *job, int row)
{
    return row > -FONT_MARGIN_ROWS && row < job->rows;
}

/* ---- nodes, a batch at a time ---- */

enum { BATCH = 64 };

/* For each node: where its column's and its rows' values begin in the tables, how far it is to
 * the next phase, and where its sums are. */
struct batch {
    int column[BATCH], rows[BATCH], row[BATCH], sums[BATCH];
    float column_t[BATCH], rows_t[BATCH];
};

INLINE void batch_fill(struct batch *b, const struct font_gray_job *job, int first, int count,
                       int stride, int taps, bool odd)
{
    for (int k = 0; k < count; k += LANES) { /* the arrays are longer than the count */
        vector ax = load(job->node_x + first + k) + job->ax;
        vector ay = load(job->node_y + first + k) + job->ay;
        ints ix = __builtin_convertvector(ax, ints), iy = __builtin_convertvector(ay, ints);
        vector px = (ax - __builtin_convertvector(ix, vector)) * FONT_PHASES;
        vector py = (ay - __builtin_convertvector(iy, vector)) * FONT_PHASES;
        ints qx = __builtin_convertvector(px, ints), qy = __builtin_convertvector(py, ints);
        ints row = iy - job->row;
        ints within = ix & (STEP(taps) - 1), block = ix - within;
        if (odd) /* odd blocks have a row of their own, 4 columns to the right */
            block += (block >> 2 & 1) * (FONT_NARROW_ODD + 4);
        *(ints_loose *)(b->column + k) = qx * (2 * FONT_X_ROW) + 16 - within;
        *(ints_loose *)(b->rows + k) = qy * (2 * FONT_Y_ROW);
        *(ints_loose *)(b->row + k) = row;
        *(ints_loose *)(b->sums + k) = (row + FONT_MARGIN_ROWS) * stride + block;
        *(vector_loose *)(b->column_t + k) = px - __builtin_convertvector(qx, vector);
        *(vector_loose *)(b->rows_t + k) = py - __builtin_convertvector(qy, vector);
    }
    IN_MEMORY();
}

/* What a node's columns get, and its rows. */
INLINE void node_weigh(half_vector *columns, half_vector *weights, const struct batch *b, int k,
                       const float *xs, const float *ys, float weight, int taps)
{
    const float *x = xs + b->column[k];
    for (int p = 0; p < 8 / HALF_LANES; p++)
        columns[p] = half_load(x + p * HALF_LANES) +
                     half_load(x + FONT_X_ROW + p * HALF_LANES) * b->column_t[k];
    rows_weigh(weights, ys + b->rows[k], b->rows_t[k], weight, taps);
}

/* What the compiler knows of a pointer it forgets: it then counts from it, and does not compute
 * each row's address. */
#define OPAQUE(pointer) __asm__("" : "+r"(pointer))

INLINE void block_add(float *sums, int stride, const half_vector *columns,
                      const half_vector *weights, int taps)
{
    OPAQUE(sums);
    for (int r = 0; r <= taps; r++) {
        half_vector weight = spread(weights, r);
        for (int p = 0; p < 8 / HALF_LANES; p++)
            *(half_vector *)(sums + r * stride + p * HALF_LANES) += columns[p] * weight;
    }
}

/* A block of sums in registers. */
enum { RUN_ROWS_MAX = 9 };
struct run {
    half_vector rows[RUN_ROWS_MAX][HALF_PARTS];
};

INLINE void run_row_clear(struct run *run, int row, int parts)
{
    for (int p = 0; p < parts; p++)
        run->rows[row][p] = (half_vector){0};
}

INLINE void run_row_add(const struct run *run, int row, float *sums, int parts)
{
    for (int p = 0; p < parts; p++)
        *(half_loose *)(sums + p * HALF_LANES) += run->rows[row][p];
}

INLINE void run_row_copy(struct run *run, int row, int from, int parts)
{
    for (int p = 0; p < parts; p++)
        run->rows[row][p] = run->rows[from][p];
}

/* From sums to sums + way. Where that is one row further down or up, one row is added to the
 * sums and the others stay; of few rows in few registers that is slower than to add them
 * all. */
INLINE void run_move(struct run *run, float *sums, int way, int stride, int last, int parts)
{
    const bool slides = LANES == 16 || !SHORT(last);
    if (slides && way == stride) {
        run_row_add(run, 0, sums, parts);
        for (int r = 0; r < last; r++)
            run_row_copy(run, r, r + 1, parts);
        run_row_clear(run, last, parts);
    } else if (slides && way == -stride) {
        run_row_add(run, last, sums + last * stride, parts);
        for (int r = last; r > 0; r--)
            run_row_copy(run, r, r - 1, parts);
        run_row_clear(run, 0, parts);
    } else {
        for (int r = 0; r <= last; r++, sums += stride) {
            /* else the rows' offsets take the registers that the loop around this needs */
            OPAQUE(sums);
            run_row_add(run, r, sums, parts);
            run_row_clear(run, r, parts);
        }
    }
}

/* All but narrow pictures of few taps. Of nodes that follow each other many are of the same
 * block of the same rows, or of rows that begin one further down or up: their sums stay in
 * registers. */
INLINE void runs_add(const struct font_gray_job *job, int term, int stride, int taps,
                     bool banded)
{
    const float *xs = font_filter_x(job->filter, term), *ys = font_filter_y(job->filter, term);
    const int parts = 8 / HALF_LANES, last = taps;
    struct batch b;
    struct run run = {0};
    int at = FONT_MARGIN_ROWS * stride; /* nothing yet, wherever it is */
    for (int first = 0; first < job->nodes_count; first += BATCH) {
        int count = job->nodes_count - first < BATCH ? job->nodes_count - first : BATCH;
        batch_fill(&b, job, first, count, stride, taps, false);
        for (int k = 0; k < count; k++) {
            if (banded && !row_in_band(job, b.row[k]))
                continue;
            if (b.sums[k] != at) {
                run_move(&run, job->sums + at, b.sums[k] - at, stride, last, parts);
                at = b.sums[k];
            }
            half_vector columns[HALF_PARTS], weights[HALF_PARTS];
            node_weigh(columns, weights, &b, k, xs, ys, job->node_weight[first + k], taps);
            for (int r = 0; r <= last; r++) {
                half_vector weight = spread(weights, r);
                for (int p = 0; p < parts; p++)
                    run.rows[r][p] += columns[p] * weight;
            }
        }
    }
    for (int r = 0; r <= last; r++)
        run_row_add(&run, r, job->sums + at + r * stride, parts);
}

INLINE void node_add(const struct font_gray_job *job, const struct batch *b, int first, int k,
                     const float *xs, const float *ys, int taps)
{
    half_vector columns[HALF_PARTS], weights[HALF_PARTS];
    node_weigh(columns, weights, b, k, xs, ys, job->node_weight[first + k], taps);
    block_add(job->sums + b->sums[k], FONT_NARROW_STRIDE, columns, weights, taps);
}

/* Narrow pictures of few taps. Neighbours on an edge add to the same rows and each waits for
 * what the one before has stored; so a batch is gone through from three places in turns. */
INLINE void narrow_add(const struct font_gray_job *job, int term, int taps)
{
    const float *xs = font_filter_x(job->filter, term), *ys = font_filter_y(job->filter, term);
    struct batch b;
    for (int first = 0; first < job->nodes_count; first += BATCH) {
        int count = job->nodes_count - first < BATCH ? job->nodes_count - first : BATCH;
        int third = count / 3;
        batch_fill(&b, job, first, count, FONT_NARROW_STRIDE, taps, true);
        for (int k = 0; k < third; k++) {
            node_add(job, &b, first, k, xs, ys, taps);
            node_add(job, &b, first, k + third, xs, ys, taps);
            node_add(job, &b, first, k + 2 * third, xs, ys, taps);
        }
        for (int k = 3 * third; k < count; k++)
            node_add(job, &b, first, k, xs, ys, taps);
    }
}

/* ---- lines ---- */

/* 8 columns from `first` on: what is right of a line's end. */
INLINE const float *line_end(const float *table, float a, int first, float *t)
{
    int i = (int)a;
    float at = (a - (float)i) * FONT_PHASES;
    int phase = (int)at;
    *t = at - (float)phase;
    int offset = i - first;
    offset = offset < -16 ? -16 : offset > 16 ? 16 : offset;
    return table + phase * 2 * FONT_H_ROW + 16 - offset;
}

INLINE void lines_add(const struct font_gray_job *job, int term, int stride, int taps)
{
    const float *hs = font_filter_h(job->filter, term), *ys = font_filter_y(job->filter, term);
    half_vector weights[HALF_PARTS];
    for (int n = 0; n < job->lines_count; n++) {
        float a0 = job->line_x0[n] + job->ax, a1 = job->line_x1[n] + job->ax;
        int row;
        row_weigh(weights, ys, job->line_y[n] + job->ay, &row, taps);
        row -= job->row;
        if (job->banded && !row_in_band(job, row))
            continue;
        /* Blocks of the even row; what lies beyond the ends' reach is 0. */
        int first = (int)(a0 < a1 ? a0 : a1) & ~7, end = (int)(a0 < a1 ? a1 : a0) + taps;
        float *sums = job->sums + (long)(FONT_MARGIN_ROWS + row) * stride;
        for (; first < end; first += 8) {
            float t0, t1;
            const float *h0 = line_end(hs, a0, first, &t0), *h1 = line_end(hs, a1, first, &t1);
            half_vector columns[8 / HALF_LANES];
            for (int p = 0; p < 8 / HALF_LANES; p++) {
                int at = p * HALF_LANES;
                columns[p] = (half_load(h0 + at) + half_load(h0 + FONT_H_ROW + at) * t0) -
                             (half_load(h1 + at) + half_load(h1 + FONT_H_ROW + at) * t1);
            }
            block_add(sums + first, stride, columns, weights, taps);
        }
    }
}

/* ---- rows added up, and rounded ---- */

INLINE void pixels_store(uint8_t *out, const vector *sum)
{
#if LANES == 16
    __m512 scaled =
        _mm512_add_ps(_mm512_mul_ps((__m512)sum[0], _mm512_set1_ps(255)), _mm512_set1_ps(0.5f));
    __m512i whole = _mm512_cvttps_epi32(_mm512_max_ps(scaled, _mm512_setzero_ps()));
    _mm_storeu_si128((__m128i_u *)out, _mm512_cvtusepi32_epi8(whole));
#elif LANES == 8
    __m256i whole[2];
    for (int p = 0; p < 2; p++)
        whole[p] = _mm256_cvttps_epi32(_mm256_add_ps(
            _mm256_mul_ps((__m256)sum[p], _mm256_set1_ps(255)), _mm256_set1_ps(0.5f)));
    __m256i words = _mm256_packs_epi32(whole[0], whole[1]); /* 0-3 8-11 4-7 12-15 */
    words = _mm256_permute4x64_epi64(words, 0xd8);
    __m128i bytes =
        _mm_packus_epi16(_mm256_castsi256_si128(words), _mm256_extracti128_si256(words, 1));
    _mm_storeu_si128((__m128i_u *)out, bytes);
#elif defined(__SSE2__)
    __m128i whole[4];
    for (int p = 0; p < 4; p++)
        whole[p] = _mm_cvttps_epi32(
            _mm_add_ps(_mm_mul_ps((__m128)sum[p], _mm_set1_ps(255)), _mm_set1_ps(0.5f)));
    _mm_storeu_si128((__m128i_u *)out, _mm_packus_epi16(_mm_packs_epi32(whole[0], whole[1]),
                                                        _mm_packs_epi32(whole[2], whole[3])));
#else
    for (int p = 0; p < PARTS; p++)
        for (int l = 0; l < LANES; l++) {
            float scaled = sum[p][l] * 255 + 0.5f;
            out[p * LANES + l] = (uint8_t)(scaled < 0 ? 0 : scaled > 255 ? 255 : scaled);
        }
#endif
}

/* Of a row of odd blocks, which begins at column 4. What is before it in a narrow picture is
 * another's. */
INLINE vector odd_load(const float *at, bool first)
{
    vector v = load(at);
    if (!first)
        return v;
#if LANES == 16
    return (vector)_mm512_maskz_mov_ps(0xfff0, (__m512)v);
#elif LANES == 8
    return (vector)_mm256_blend_ps(_mm256_setzero_ps(), (__m256)v, 0xf0);
#else
    return v * 0;
#endif
}

/* The rows that are added to. */
INLINE void rows_clear(const struct font_gray_job *job, int stride)
{
    float *from = job->sums + (job->banded ? 0 : FONT_MARGIN_ROWS * stride);
    long count = (long)stride * (job->rows + (job->banded ? 2 * FONT_MARGIN_ROWS : 0));
    for (long k = 0; k < count; k += LANES)
        *(vector *)(from + k) = (vector){0};
}

/* So many vectors of columns. */
INLINE void strip_add_up(const struct font_gray_job *job, int column, int vectors, int stride,
                         int odd, bool exact)
{
    vector sum[4 * PARTS];
    const float *sums = job->sums + (long)FONT_MARGIN_ROWS * stride + column;
    uint8_t *out = job->out + column;
    float *values = exact ? job->exact + column : NULL;
    for (int p = 0; p < vectors; p++)
        sum[p] = load(job->carry + column + p * LANES);
    for (int r = 0; r < job->rows; r++, sums += stride, out += job->pitch) {
        for (int p = 0; p < vectors; p++)
            sum[p] += load(sums + p * LANES);
        for (int p = 0; odd && p < vectors; p++)
            sum[p] += odd_load(sums + odd + 4 + p * LANES,
                               stride == FONT_NARROW_STRIDE && p * LANES < 4);
        for (int p = 0; p < vectors; p += PARTS)
            pixels_store(out + p * LANES, sum + p);
        for (int p = 0; exact && p < vectors; p++)
            *(vector_loose *)(values + (long)r * job->pitch + p * LANES) = sum[p];
    }
    for (int p = 0; p < vectors; p++)
        *(vector_loose *)(job->carry + column + p * LANES) = sum[p];
}

/* Four times as many columns at once where there are registers for it. */
INLINE void rows_add_up(const struct font_gray_job *job, int stride, int odd, bool exact)
{
    const int wide = LANES >= 8 ? 4 * ROW : ROW;
    int column = 0;
    for (; wide > ROW && column + wide <= job->pitch; column += wide)
        strip_add_up(job, column, wide / LANES, stride, odd, exact);
    for (; column < job->width; column += ROW)
        strip_add_up(job, column, PARTS, stride, odd, exact);
}

#include "gray_area.h"
#include "gray_disc.h"
#include "gray_patch.h"

/* ---- by the number of taps: loops of a known length ---- */

INLINE void edges_add(const struct font_gray_job *job, int stride, int taps, bool banded)
{
    rows_clear(job, stride);
    bool patches = job->filter->way == FONT_BY_PATCHES;
    if (patches)
        patches_add(job, stride, banded);
    for (int term = 0; term < job->filter->terms_count; term++) {
        if (!patches && SHORT(taps) && !banded && job->odd)
            narrow_add(job, term, taps);
        else if (!patches)
            runs_add(job, term, stride, taps, banded);
        lines_add(job, term, stride, taps);
    }
}

/* Apart: in one large function these loops would have to share the registers. */
#define EDGES_ADD(taps)                                                                        \
    static APART void edges_add_##taps(const struct font_gray_job *job)                        \
    {                                                                                          \
        edges_add(job, job->stride, taps, job->banded);                                        \
    }                                                                                          \
    static APART void edges_add_narrow_##taps(const struct font_gray_job *job)                 \
    {                                                                                          \
        edges_add(job, FONT_NARROW_STRIDE, taps, false);                                       \
    }
EDGES_ADD(1)
EDGES_ADD(2)
EDGES_ADD(3)
EDGES_ADD(4)
EDGES_ADD(5)
EDGES_ADD(6)

static APART void edges_add_more(const struct font_gray_job *job)
{
    edges_add(job, job->stride, job->filter->taps, job->banded);
}

void KERNEL(const struct font_gray_job *job)
{
    static void (*const by_taps[][2])(const struct font_gray_job *) = {
        [1] = {edges_add_1, edges_add_narrow_1}, [2] = {edges_add_2, edges_add_narrow_2},
        [3] = {edges_add_3, edges_add_narrow_3}, [4] = {edges_add_4, edges_add_narrow_4},
        [5] = {edges_add_5, edges_add_narrow_5}, [6] = {edges_add_6, edges_add_narrow_6}};
    if (job->arcs_count) {
        if (job->filter->way == FONT_BY_AREAS)
            areas_add(job);
        else
            discs_add(job);
        if (job->exact)
            rows_add_up(job, job->stride, 0, true);
        else
            rows_add_up(job, job->stride, 0, false);
        return;
    }
    int taps = job->filter->taps;
    bool narrow = job->stride == FONT_NARROW_STRIDE && !job->banded;
    if (taps < (int)(sizeof by_taps / sizeof *by_taps))
        by_taps[taps][narrow](job);
    else
        edges_add_more(job);
    if (job->exact)
        rows_add_up(job, job->stride, job->odd, true);
    else if (job->stride == FONT_NARROW_STRIDE && job->odd)
        rows_add_up(job, FONT_NARROW_STRIDE, FONT_NARROW_ODD, false);
    else
        rows_add_up(job, job->stride, 0, false);
}
