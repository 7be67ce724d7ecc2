/* gray_kernel.h - edges to gray, included by gray_plain.c, gray_avx2.c and gray_avx512.c with
 *     LANES    floats in a vector: 4, 8 or 16
 *     KERNEL   the function's name
 *
 * Sums are kept as differences between a row and the one above it, so that a bit of edge touches only the rows within
 * the filter's reach and all the ink below it costs nothing:
 *
 *                taps ->                 a node adds an outer product:
 *          . . . x x x x . . . .         taps of its column, times its weight,
 *     rows . . . x x x x . . . .         times rows: taps + 1 of them
 *      |   . . . x x x x . . . .
 *      v   . . . x x x x . . . .         a horizontal line the same with wider taps
 *          . . . x x x x . . . .
 *
 * At the end one pass down the columns adds the rows up. A row is always 16 floats at an address that is a multiple of
 * 32 bytes, whatever column the taps begin at, because the tables are padded: what one node stores the
 * next loads with the same alignment, which processors forward without waiting. */
#include "gray_internal.h"

#include <string.h>
#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

enum { ROW = 16, HALF_LANES = LANES > 8 ? 8 : LANES };

typedef float vector __attribute__((vector_size(LANES * 4)));
typedef float vector_loose __attribute__((vector_size(LANES * 4), aligned(4), may_alias));
typedef float half_vector __attribute__((vector_size(HALF_LANES * 4)));
typedef float half_loose __attribute__((vector_size(HALF_LANES * 4), aligned(4), may_alias));

#define INLINE static inline __attribute__((always_inline))

enum { PARTS = ROW / LANES, HALF_PARTS = ROW / HALF_LANES };

INLINE vector load(const float *at)
{
    return *(const vector_loose *)at;
}

INLINE half_vector half_load(const float *at)
{
    return *(const half_loose *)at;
}

/* What rows get: the taps down, times the weight. */
INLINE void rows_weigh(float *out, const float *table, float a, float weight, int *row, int taps)
{
    int i = (int)a;
    float at = (a - (float)i) * FONT_PHASES;
    int phase = (int)at;
    float t = at - (float)phase;
    const float *y = table + phase * 2 * FONT_Y_ROW;
    *row = i;
    for (int k = 0; k < (taps < 8 ? 8 : ROW); k += HALF_LANES)
        *(half_loose *)(out + k) =
            (half_load(y + k) + half_load(y + FONT_Y_ROW + k) * t) * weight;
}

INLINE bool row_in_band(const struct font_gray_job *job, int *row)
{
    *row -= job->row;
    return *row > -FONT_MARGIN_ROWS && *row < job->rows;
}

/* ---- pictures of up to 16 columns ---- */

INLINE void narrow_add(float *sums, const vector *columns, const float *weights, int rows)
{
    for (int r = 0; r < rows; r++)
        for (int p = 0; p < PARTS; p++)
            *(vector *)(sums + r * ROW + p * LANES) += columns[p] * weights[r];
}

INLINE void narrow_nodes(const struct font_gray_job *job, int term, int taps)
{
    const float *xs = font_filter_x(job->filter, term), *ys = font_filter_y(job->filter, term);
    float weights[ROW] __attribute__((aligned(64)));
    for (int n = 0; n < job->nodes_count; n++) {
        float a = job->node_x[n] + job->ax;
        int i = (int)a, row;
        float at = (a - (float)i) * FONT_PHASES;
        int phase = (int)at;
        float t = at - (float)phase;
        const float *x = xs + phase * 2 * FONT_X_ROW + 16 - i;
        vector columns[PARTS];
        for (int p = 0; p < PARTS; p++)
            columns[p] = load(x + p * LANES) + load(x + FONT_X_ROW + p * LANES) * t;
        rows_weigh(weights, ys, job->node_y[n] + job->ay, job->node_weight[n], &row, taps);
        if (job->banded && !row_in_band(job, &row))
            continue;
        narrow_add(job->sums + (FONT_MARGIN_ROWS + row) * ROW, columns, weights, taps + 1);
    }
}

/* 16 columns, from `offset` columns left of a line's end: what is right of it. */
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

INLINE void narrow_lines(const struct font_gray_job *job, int term, int taps)
{
    const float *hs = font_filter_h(job->filter, term), *ys = font_filter_y(job->filter, term);
    float weights[ROW] __attribute__((aligned(64)));
    for (int n = 0; n < job->lines_count; n++) {
        float t0, t1;
        int row;
        const float *h0 = line_end(hs, job->line_x0[n] + job->ax, 0, &t0);
        const float *h1 = line_end(hs, job->line_x1[n] + job->ax, 0, &t1);
        vector columns[PARTS];
        for (int p = 0; p < PARTS; p++)
            columns[p] = (load(h0 + p * LANES) + load(h0 + FONT_H_ROW + p * LANES) * t0) -
                         (load(h1 + p * LANES) + load(h1 + FONT_H_ROW + p * LANES) * t1);
        rows_weigh(weights, ys, job->line_y[n] + job->ay, 1, &row, taps);
        if (job->banded && !row_in_band(job, &row))
            continue;
        narrow_add(job->sums + (FONT_MARGIN_ROWS + row) * ROW, columns, weights, taps + 1);
    }
}

/* ---- wider ones: 16 columns that begin at a multiple of 8 ---- */

INLINE void wide_add(float *sums, int stride, const half_vector *columns, int parts,
                     const float *weights, int rows)
{
    for (int r = 0; r < rows; r++)
        for (int p = 0; p < parts; p++)
            *(half_vector *)(sums + r * stride + p * HALF_LANES) += columns[p] * weights[r];
}

INLINE void wide_nodes(const struct font_gray_job *job, int term, int taps)
{
    const float *xs = font_filter_x(job->filter, term), *ys = font_filter_y(job->filter, term);
    float weights[ROW] __attribute__((aligned(64)));
    int stride = job->stride;
    for (int n = 0; n < job->nodes_count; n++) {
        float a = job->node_x[n] + job->ax;
        int i = (int)a, row;
        float at = (a - (float)i) * FONT_PHASES;
        int phase = (int)at;
        float t = at - (float)phase;
        const float *x = xs + phase * 2 * FONT_X_ROW + 16 - (i & 7);
        half_vector columns[HALF_PARTS];
        for (int p = 0; p < HALF_PARTS; p++)
            columns[p] =
                half_load(x + p * HALF_LANES) + half_load(x + FONT_X_ROW + p * HALF_LANES) * t;
        rows_weigh(weights, ys, job->node_y[n] + job->ay, job->node_weight[n], &row, taps);
        if (job->banded && !row_in_band(job, &row))
            continue;
        wide_add(job->sums + (long)(FONT_MARGIN_ROWS + row) * stride + (i & ~7), stride, columns,
                 HALF_PARTS, weights, taps + 1);
    }
}

INLINE void wide_lines(const struct font_gray_job *job, int term, int taps)
{
    const float *hs = font_filter_h(job->filter, term), *ys = font_filter_y(job->filter, term);
    float weights[ROW] __attribute__((aligned(64)));
    int stride = job->stride;
    for (int n = 0; n < job->lines_count; n++) {
        float a0 = job->line_x0[n] + job->ax, a1 = job->line_x1[n] + job->ax;
        int row;
        rows_weigh(weights, ys, job->line_y[n] + job->ay, 1, &row, taps);
        if (job->banded && !row_in_band(job, &row))
            continue;
        int first = (int)(a0 < a1 ? a0 : a1) & ~7, last = (int)(a0 < a1 ? a1 : a0) + taps;
        float *sums = job->sums + (long)(FONT_MARGIN_ROWS + row) * stride;
        for (; first <= last; first += ROW) {
            float t0, t1;
            const float *h0 = line_end(hs, a0, first, &t0), *h1 = line_end(hs, a1, first, &t1);
            half_vector columns[HALF_PARTS];
            for (int p = 0; p < HALF_PARTS; p++) {
                int at = p * HALF_LANES;
                columns[p] = (half_load(h0 + at) + half_load(h0 + FONT_H_ROW + at) * t0) -
                             (half_load(h1 + at) + half_load(h1 + FONT_H_ROW + at) * t1);
            }
            wide_add(sums + first, stride, columns, HALF_PARTS, weights, taps + 1);
        }
    }
}

/* ---- rows added up, and rounded ---- */

INLINE void pixels_store(uint8_t *out, const vector *sum)
{
#if LANES == 16
    __m512 scaled = _mm512_add_ps(_mm512_mul_ps((__m512)sum[0], _mm512_set1_ps(255)),
                                  _mm512_set1_ps(0.5f));
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

INLINE void rows_add_up(const struct font_gray_job *job, int stride, bool exact)
{
    for (int column = 0; column < job->width; column += ROW) {
        vector sum[PARTS];
        const float *sums = job->sums + (long)FONT_MARGIN_ROWS * stride + column;
        for (int p = 0; p < PARTS; p++)
            sum[p] = load(job->carry + column + p * LANES);
        for (int r = 0; r < job->rows; r++, sums += stride) {
            for (int p = 0; p < PARTS; p++)
                sum[p] += load(sums + p * LANES);
            pixels_store(job->out + (long)r * job->pitch + column, sum);
            for (int p = 0; exact && p < PARTS; p++)
                *(vector_loose *)(job->exact + (long)r * job->pitch + column + p * LANES) =
                    sum[p];
        }
        for (int p = 0; p < PARTS; p++)
            *(vector_loose *)(job->carry + column + p * LANES) = sum[p];
    }
}

/* ---- by the number of taps: loops of a known length ---- */

INLINE void edges_add(const struct font_gray_job *job, int taps)
{
    for (int term = 0; term < job->filter->terms_count; term++) {
        if (job->stride == ROW) {
            narrow_nodes(job, term, taps);
            narrow_lines(job, term, taps);
        } else {
            wide_nodes(job, term, taps);
            wide_lines(job, term, taps);
        }
    }
}

void KERNEL(const struct font_gray_job *job)
{
    switch (job->filter->taps) {
    case 1:
        edges_add(job, 1);
        break;
    case 2:
        edges_add(job, 2);
        break;
    case 3:
        edges_add(job, 3);
        break;
    case 4:
        edges_add(job, 4);
        break;
    case 5:
        edges_add(job, 5);
        break;
    case 6:
        edges_add(job, 6);
        break;
    default:
        edges_add(job, job->filter->taps);
    }
    if (job->exact)
        rows_add_up(job, job->stride, true);
    else if (job->stride == ROW)
        rows_add_up(job, ROW, false);
    else
        rows_add_up(job, job->stride, false);
}
