/* gray_area.h - arcs to the areas that they cover in pixels, exactly: part of gray_kernel.h.
 *
 * In a row of cells between two columns' borders and two rows', a part of an arc from (x0, y0)
 * to (x1, y1) has ink below it in a share u of the cell and in all of the cells below. As
 * differences between rows that is two numbers, with dx = x1 - x0 and the area u under the arc
 * within the row, measured from the row's top:
 *
 *     its row       dx - u        the rest of the ink below it
 *     the next row  u             so that from there on dx is full
 *
 * u is that of the chord and, of a curve, a lens: |c x b| h^3 / 6 of the part of length h in t.
 * So an arc is cut where it crosses borders, and each part is two additions. Mirrored so that x
 * and y grow, columns are crossed at t = 2 (k - x) / (c + sqrt(c^2 + 4 b (k - x))), as many at
 * once as a vector holds, and rows likewise; the two lists are merged as the parts are gone
 * through. */
#include "arcs.h"

enum { CROSSINGS = 16 }; /* of an arc with columns, or rows; FONT_ARC_SPAN_PX and the ends' */

struct crossings {
    float t[CROSSINGS + 1], other[CROSSINGS + 1]; /* the other coordinate there */
};

/* Whole numbers from `first` up that x + t (c + t b) passes. */
INLINE void crossings_find(struct crossings *out, int count, float first, float x, float c,
                           float b, float other, float other_c, float other_b)
{
    vector lane, none = {0};
    for (int k = 0; k < LANES; k++)
        lane[k] = (float)k;
    for (int k = 0; k < count; k += LANES) {
        vector d = lane + ((float)k + first - x);
        vector root = vector_root(vector_max(d * (4 * b) + c * c, none));
        vector t = vector_min(d * 2 / (root + (c + 1e-20f)), none + 1);
        *(vector_loose *)(out->t + k) = t;
        *(vector_loose *)(out->other + k) = (t * other_b + other_c) * t + other;
    }
    out->t[count] = 2; /* beyond the end */
}

/* Whole numbers between, of which `floor` is not above where it begins. */
INLINE int crossings_count(float floor, float to)
{
    int count = (int)__builtin_ceilf(to) - 1 - (int)floor;
    return count < 0 ? 0 : count > CROSSINGS ? CROSSINGS : count;
}

INLINE void arc_add(const struct font_gray_job *job, const struct font_arc *a)
{
    float x = a->x + job->ax, y = a->y + job->ay - (float)job->row;
    float right = a->cx + a->bx < 0 ? -1 : 1, down = a->cy + a->by < 0 ? -1 : 1;
    float top = down > 0 ? y : y + a->cy + a->by;
    if (job->banded && !(top > -1 - FONT_ARC_SPAN_PX && top < (float)job->rows))
        return;
    x *= right;
    y *= down;
    float cx = a->cx * right, bx = a->bx * right, cy = a->cy * down, by = a->by * down;
    float x_end = x + cx + bx, y_end = y + cy + by;
    float column = __builtin_floorf(x), row = __builtin_floorf(y);
    int columns = crossings_count(column, x_end), rows = crossings_count(row, y_end);
    struct crossings of_columns, of_rows;
    crossings_find(&of_columns, columns, column + 1, x, cx, bx, y, cy, by);
    crossings_find(&of_rows, rows, row + 1, y, cy, by, x, cx, bx);
    float lens = (cy * bx - cx * by) * (1 / 6.0f), t = 0;
    int column_step = right > 0 ? 1 : -1, row_step = down > 0 ? job->stride : -job->stride;
    int at_column = right > 0 ? (int)column : -(int)column - 1;
    int at_row = down > 0 ? (int)row : -(int)row; /* the row before, in the arc's direction */
    float *sums = job->sums + (long)(FONT_MARGIN_ROWS + at_row) * job->stride + at_column;
    const float *tx = of_columns.t, *ty = of_rows.t;
    const float *yx = of_columns.other, *xy = of_rows.other;
    for (int left = columns + rows;; left--) {
        bool ends = left == 0, crosses_column = *tx < *ty;
        float t1 = crosses_column ? *tx : *ty;
        float x1 = crosses_column ? column + 1 : *xy, y1 = crosses_column ? *yx : row + 1;
        if (ends) {
            t1 = 1;
            x1 = x_end;
            y1 = y_end;
        }
        float h = t1 - t, dx = x1 - x;
        float u = dx * (0.5f * (y + y1) - row) + lens * h * h * h;
        sums[0] += (dx - u) * right;
        sums[row_step] += u * right;
        if (ends)
            break;
        t = t1;
        x = x1;
        y = y1;
        column += crosses_column ? 1.0f : 0.0f;
        row += crosses_column ? 0.0f : 1.0f;
        sums += crosses_column ? column_step : row_step;
        tx += crosses_column;
        yx += crosses_column;
        ty += !crosses_column;
        xy += !crosses_column;
    }
}

INLINE void areas_add(const struct font_gray_job *job)
{
    rows_clear(job, job->stride);
    for (int i = 0; i < job->arcs_count; i++)
        arc_add(job, &job->arcs[i]);
}
