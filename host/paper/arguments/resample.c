/* resample.c - see resample.h. */
#include "arguments/resample.h"

#include <members.h>

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* Weights of the sources of one place along a row: a tent two sources wide, or two new
 * places wide where there are fewer new places. */
struct tent {
    int first, count;
    double weights[512];
};

static void tent_make(struct tent *tent, int place, double scale)
{
    double center = (place + 0.5) / scale - 0.5, reach = scale < 1 ? 1 / scale : 1;
    reach = reach < 250 ? reach : 250;
    tent->first = (int)floor(center - reach) + 1;
    tent->count = 0;
    double sum = 0;
    for (int i = tent->first; i < center + reach && tent->count < 512; i++) {
        double weight = 1 - fabs(i - center) / reach;
        tent->weights[tent->count++] = weight;
        sum += weight;
    }
    for (int i = 0; i < tent->count; i++)
        tent->weights[i] /= sum;
}

/* Computes one number from a line of `count` numbers, `stride` apart, whose first is at
 * `first` of the old sheet. */
static float tent_sum(const struct tent *tent, const float *line, size_t stride, int first,
                      int count, bool edge_goes_on)
{
    double sum = 0;
    for (int i = 0; i < tent->count; i++) {
        int at = tent->first + i - first, last = count - 1;
        if (edge_goes_on)
            at = at < 0 ? 0 : at > last ? last : at;
        if (at >= 0 && at <= last)
            sum += tent->weights[i] * (double)line[(size_t)at * stride];
    }
    return (float)sum;
}

bool paper_resample(const struct paper_resampling *r, const float *old, float *new)
{
    size_t width = (size_t)r->width, old_width = (size_t)r->old_width;
    float *rows = calloc(width * (size_t)r->old_height, sizeof *rows);
    struct tent *tent = malloc(sizeof *tent);
    bool done = rows && tent;
    for (int x = 0; done && x < r->width; x++) {
        tent_make(tent, x + r->x0, r->scale);
        for (int y = 0; y < r->old_height; y++)
            rows[(size_t)y * width + (size_t)x] = tent_sum(
                tent, old + (size_t)y * old_width, 1, r->old_x, r->old_width, r->edge_goes_on);
    }
    for (int y = 0; done && y < r->height; y++) {
        tent_make(tent, y + r->y0, r->scale);
        for (int x = 0; x < r->width; x++)
            new[(size_t)y * width + (size_t)x] =
                tent_sum(tent, rows + x, width, r->old_y, r->old_height, r->edge_goes_on);
    }
    free(rows);
    free(tent);
    return done;
}

bool paper_array_resample(const struct paper_resampling *r, const float **values)
{
    float *new = malloc((size_t)r->width * (size_t)r->height * sizeof *new);
    bool done = new &&paper_resample(r, *values, new);
    free(done ? members_owned(*values) : new);
    if (done)
        *values = new;
    return done;
}
