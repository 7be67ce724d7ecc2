/* glyphs.cl - edges to gray for many glyphs at once: fontpipe/gray_kernel.h in OpenCL C; see
 * there for what it does.
 *
 * A work-item draws a glyph, its sums in local memory, of as many rows at a time as fit there.
 * TAPS, TERMS and SUMS (floats of sums) are defined when it is compiled. Tables are laid out as
 * fontpipe/filter_internal.h says. */
#pragma OPENCL FP_CONTRACT OFF

#define PHASES 32
#define X_ROW 32
#define H_ROW 48
#define Y_ROW 16
#define TERM_FLOATS (PHASES * 2 * (X_ROW + H_ROW + Y_ROW))
#define ROWS (TAPS + 1)
#define MARGIN 16 /* rows above and below a band */
#define BATCH 16

#if TAPS <= 5
#define WITHIN 3 /* the taps lie in one of the blocks of 8 that begin at multiples of 4 */
#define SHORT 1
#else
#define WITHIN 7
#define SHORT 0
#endif

struct job {
    int node_first, node_count, line_first, line_count;
    float ax, ay;
    int width, height, pitch;
    uint pixels; /* where its pixels begin */
};

/* Eight columns of each of the rows. */
void block_add(__local float *sums, int stride, float8 columns, const float *weights)
{
#pragma unroll
    for (int r = 0; r < ROWS; r++) {
        __local float8 *at = (__local float8 *)(sums + r * stride);
        *at = fma(columns, (float8)(weights[r]), *at);
    }
}

void rows_weigh(float *out, __global const float *y, float t, float weight)
{
    float8 low = fma(vload8(0, y + Y_ROW), (float8)t, vload8(0, y)) * weight;
    vstore8(low, 0, out);
#if TAPS >= 8
    float8 high = fma(vload8(0, y + Y_ROW + 8), (float8)t, vload8(0, y + 8)) * weight;
    vstore8(high, 0, out + 8);
#endif
}

void nodes_add(__global const float *table, __global const float *node_x,
               __global const float *node_y, __global const float *node_weight, int count,
               float ax, float ay, int first_row, int rows, int banded, __local float *sums,
               int stride, int odd)
{
    __global const float *xs = table, *ys = table + PHASES * 2 * (X_ROW + H_ROW);
    int column[BATCH], row_at[BATCH], row[BATCH], at[BATCH];
    float column_t[BATCH], row_t[BATCH], weights[BATCH * 16];
    for (int first = 0; first < count; first += BATCH) {
        int n = min(count - first, BATCH);
        for (int k = 0; k < BATCH; k += 8) { /* arrays go on past the last */
            float8 x = vload8(0, node_x + first + k) + ax;
            float8 y = vload8(0, node_y + first + k) + ay;
            int8 ix = convert_int8_rtz(x), iy = convert_int8_rtz(y);
            float8 px = (x - convert_float8(ix)) * (float)PHASES;
            float8 py = (y - convert_float8(iy)) * (float)PHASES;
            int8 qx = convert_int8_rtz(px), qy = convert_int8_rtz(py);
            int8 within = ix & WITHIN, block = ix - within;
            if (SHORT)
                block += (block >> 2 & 1) * (odd + 4);
            iy -= first_row;
            vstore8(qx * (2 * X_ROW) + 16 - within, 0, column + k);
            vstore8(qy * (2 * Y_ROW), 0, row_at + k);
            vstore8(iy, 0, row + k);
            vstore8((iy + MARGIN) * stride + block, 0, at + k);
            vstore8(px - convert_float8(qx), 0, column_t + k);
            vstore8(py - convert_float8(qy), 0, row_t + k);
        }
        for (int k = 0; k < n; k++)
            rows_weigh(weights + 16 * k, ys + row_at[k], row_t[k], node_weight[first + k]);
        for (int k = 0; k < n; k++) {
            if (banded && (row[k] <= -MARGIN || row[k] >= rows))
                continue;
            __global const float *x = xs + column[k];
            float8 t = column_t[k];
            block_add(sums + at[k], stride, fma(vload8(0, x + X_ROW), t, vload8(0, x)),
                      weights + 16 * k);
            if (!SHORT)
                block_add(sums + at[k] + 8, stride,
                          fma(vload8(0, x + X_ROW + 8), t, vload8(0, x + 8)), weights + 16 * k);
        }
    }
}

/* Eight columns from `first` on to the right of a line's end. */
float8 line_end(__global const float *table, float a, int first)
{
    int i = (int)a;
    float at = (a - (float)i) * PHASES;
    int phase = (int)at, offset = clamp(i - first, -16, 16);
    __global const float *h = table + phase * 2 * H_ROW + 16 - offset;
    return fma(vload8(0, h + H_ROW), (float8)(at - (float)phase), vload8(0, h));
}

void lines_add(__global const float *table, __global const float *line_x0,
               __global const float *line_x1, __global const float *line_y, int count, float ax,
               float ay, int first_row, int rows, int banded, __local float *sums, int stride)
{
    __global const float *hs = table + PHASES * 2 * X_ROW, *ys = hs + PHASES * 2 * H_ROW;
    float weights[16];
    for (int n = 0; n < count; n++) {
        float a0 = line_x0[n] + ax, a1 = line_x1[n] + ax, y = line_y[n] + ay;
        int iy = (int)y, row = iy - first_row;
        float at = (y - (float)iy) * PHASES;
        int phase = (int)at;
        if (banded && (row <= -MARGIN || row >= rows))
            continue;
        rows_weigh(weights, ys + phase * 2 * Y_ROW, at - (float)phase, 1);
        int first = (int)fmin(a0, a1) & ~7, last = (int)fmax(a0, a1) + TAPS;
        for (; first <= last; first += 8)
            block_add(sums + (row + MARGIN) * stride + first, stride,
                      line_end(hs, a0, first) - line_end(hs, a1, first), weights);
    }
}

__kernel void glyphs(__global const float *tables, __global const float *node_x,
                     __global const float *node_y, __global const float *node_weight,
                     __global const float *line_x0, __global const float *line_x1,
                     __global const float *line_y, __global const struct job *jobs,
                     int jobs_count, __global uchar *pixels, __global float *carries,
                     int carry_floats)
{
    __local float sums[SUMS] __attribute__((aligned(64)));
    __global float *carry = carries + (size_t)get_global_id(0) * (size_t)carry_floats;
    int workers = (int)get_global_size(0);
    for (int g = (int)get_global_id(0); g < jobs_count; g += workers) {
        struct job j = jobs[g];
        if (j.width == 0)
            continue;
        int odd = SHORT ? (j.pitch == 16 ? 16 : j.pitch + 16) : 0;
        int stride = SHORT ? (j.pitch == 16 ? 48 : 2 * j.pitch + 48) : j.pitch + 16;
        int most = SUMS / stride - 2 * MARGIN, banded = most < j.height;
        for (int c = 0; c < j.pitch; c += 8)
            vstore8((float8)0, 0, carry + c);
        for (int row = 0; row < j.height; row += most) {
            int rows = min(most, j.height - row);
            __local float8 *clear = (__local float8 *)(sums + (banded ? 0 : MARGIN * stride));
            int blocks = (rows + (banded ? 2 * MARGIN : 0)) * stride / 8;
            for (int c = 0; c < blocks; c++)
                clear[c] = (float8)0;
            for (int term = 0; term < TERMS; term++) {
                __global const float *table = tables + term * TERM_FLOATS;
                nodes_add(table, node_x + j.node_first, node_y + j.node_first,
                          node_weight + j.node_first, j.node_count, j.ax, j.ay, row, rows,
                          banded, sums, stride, odd);
                lines_add(table, line_x0 + j.line_first, line_x1 + j.line_first,
                          line_y + j.line_first, j.line_count, j.ax, j.ay, row, rows, banded,
                          sums, stride);
            }
            for (int c = 0; c < j.width; c += 8) {
                float8 sum = vload8(0, carry + c);
                __local const float *from = sums + MARGIN * stride + c;
                __global uchar *out = pixels + j.pixels + (size_t)row * j.pitch + c;
                for (int r = 0; r < rows; r++, from += stride, out += j.pitch) {
                    sum += vload8(0, from);
                    if (SHORT)
                        sum += vload8(0, from + odd + 4);
                    vstore8(convert_uchar8_sat(fma(sum, (float8)255, (float8)0.5f)), 0, out);
                }
                vstore8(sum, 0, carry + c);
            }
        }
    }
}
