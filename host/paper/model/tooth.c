/* tooth.c - the paper's tooth as a tuft feels it: how far each fiber stands above the paper
 * around it.
 *
 *        .--^--^-.                     heights: tooth on clouds
 *    ^--'         '-^--^--^
 *    - - -.-----.- - - - - -           their mean over some 8 fibers: a tuft gives way that far
 *     ^   ^  ^    ^  ^  ^              tooth = height - mean: what a dry brush rides on
 *
 * With the height alone a dry brush left whole hollows bare, 20 to 30 fibers wide. The mean is
 * that of two boxes, one after the other. Heights are whole numbers here, so means are the same
 * bits in any order: of a sheet that is mirrored they are mirrored. The tooth is made when a
 * brush first touches, on the front end, and kept until the heights change. */
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HEIGHT_ONE = 32767, BOXES = 2 };
#define BOX_AROUND 3.0 /* fibers of the stock's own scale, on each side */
#define BOX_AROUND_MOST 100.0

struct box_mean {
    int width, height, around;
    bool torus;
    int32_t *values, *sums, *line; /* line: a row, and what is beyond its ends */
};

/* sums = those of 2 around + 1 values along x. */
static void sums_along_x(const struct box_mean *of)
{
    const int around = of->around, beyond = of->width + around;
    for (int y = 0; y < of->height; y++) {
        const int32_t *row = of->values + (size_t)y * (size_t)of->width;
        int32_t *out = of->sums + (size_t)y * (size_t)of->width, sum = 0;
        for (int x = -around; x <= beyond; x++)
            of->line[x + around] = row[sheet_place_beside(x, 0, of->width, of->torus)];
        for (int i = 0; i < 2 * around + 1; i++)
            sum += of->line[i];
        for (int x = 0; x < of->width; x++) {
            out[x] = sum;
            sum += of->line[x + 2 * around + 1] - of->line[x];
        }
    }
}

static const int32_t *sums_row(const struct box_mean *of, int y)
{
    return of->sums +
           (size_t)sheet_place_beside(y, 0, of->height, of->torus) * (size_t)of->width;
}

/* values = means of such sums along y: those of the box, rounded. */
static void means_along_y(const struct box_mean *of)
{
    const int around = of->around, side = 2 * around + 1, area = side * side;
    int32_t *sum = of->line;
    memset(sum, 0, (size_t)of->width * sizeof *sum);
    for (int y = -around; y <= around; y++)
        for (int x = 0; x < of->width; x++)
            sum[x] += sums_row(of, y)[x];
    for (int y = 0; y < of->height; y++) {
        const int32_t *next = sums_row(of, y + around + 1), *last = sums_row(of, y - around);
        int32_t *out = of->values + (size_t)y * (size_t)of->width;
        for (int x = 0; x < of->width; x++) {
            out[x] = (sum[x] + area / 2) / area;
            sum[x] += next[x] - last[x];
        }
    }
}

/* tooth holds heights, and then what they are above their means. Returns their deviation, on
 * the scale of heights; a sum of whole numbers is the same in any order. */
static double means_take(struct box_mean *of, int16_t *tooth)
{
    const size_t count = (size_t)of->width * (size_t)of->height;
    for (size_t i = 0; i < count; i++)
        of->values[i] = tooth[i];
    for (int box = 0; box < BOXES; box++) {
        sums_along_x(of);
        means_along_y(of);
    }
    int64_t squares = 0;
    for (size_t i = 0; i < count; i++) {
        tooth[i] = (int16_t)(tooth[i] - of->values[i]);
        squares += (int64_t)tooth[i] * tooth[i];
    }
    return sqrt((double)squares / (double)count) / HEIGHT_ONE;
}

enum paper_status sheet_tooth_make(struct paper_sheet *p)
{
    if (p->tooth)
        return PAPER_OK;
    struct box_mean of = {.width = p->page.grid.width,
                          .height = p->page.grid.height,
                          .around = (int)fmin(BOX_AROUND_MOST, round(BOX_AROUND * p->finer)),
                          .torus = p->config.torus};
    const size_t count = (size_t)of.width * (size_t)of.height;
    float *heights = malloc(count * sizeof *heights);
    of.values = malloc(count * sizeof *of.values);
    of.sums = malloc(count * sizeof *of.sums);
    of.line = malloc(((size_t)of.width + 2 * (size_t)of.around + 1) * sizeof *of.line);
    int16_t *tooth = malloc(count * sizeof *tooth);
    if (heights && of.values && of.sums && of.line && tooth) {
        kit_grid_f_read(&p->page.grid, heights, p->height);
        for (size_t i = 0; i < count; i++)
            tooth[i] = (int16_t)lrintf(heights[i] * (float)HEIGHT_ONE);
        p->tooth_deviation = means_take(&of, tooth);
        p->tooth = tooth;
        tooth = NULL;
    }
    free(heights);
    free(of.values);
    free(of.sums);
    free(of.line);
    free(tooth);
    return p->tooth ? PAPER_OK
                    : paper_fail(PAPER_NO_MEMORY, "no memory for the tooth of a sheet of %dx%d",
                                 of.width, of.height);
}

double sheet_tooth_at(const struct paper_sheet *p, int fiber)
{
    return (double)p->tooth[fiber] / HEIGHT_ONE;
}

void sheet_heights_changed(struct paper_sheet *p)
{
    p->relief_made = false;
    free(p->tooth);
    p->tooth = NULL;
}
