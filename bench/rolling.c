/* rolling.c - where the fibers are and how the sheet is cut; see rolling.h. */
#include "rolling.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness.h"

enum {
    PAGE_FLOATS = 1024,
    PLANE_SKEW = 7 * 16, /* planes begin at different places of a page */
    STRIP_LEAST = 4,     /* vectors */
    TUNE_ROUNDS_LEAST = 2,
    TUNE_ROUNDS_MOST = 12
};
static const double TUNE_S = 0.7; /* no further round after this time */
/* A candidate that took so much longer than the fastest in its first round is dropped. */
static const double TUNE_HOPE = 1.3;

static size_t round_up(size_t n, size_t unit)
{
    return (n + unit - 1) / unit * unit;
}

/* Rows that begin at the same offset from a page would compete for the same cache sets. */
static size_t off_page(size_t row_floats)
{
    return row_floats % PAGE_FLOATS ? row_floats : row_floats + ROLLING_LANES;
}

bool rolling_layout_init(struct rolling_layout *l, const struct diffusion_scene *s,
                         int copies_count)
{
    if (s->x0 < 1 || s->y0 < 1)
        return bench_fail("rolling rows: the rectangle must leave out the first row and the "
                          "first column (it begins at column %d, row %d)",
                          s->x0, s->y0);
    l->width = s->x1 - s->x0;
    l->height = s->y1 - s->y0;
    l->columns = (int)round_up((size_t)l->width, ROLLING_LANES);
    l->pitch = off_page(ROLLING_LANES + (size_t)l->columns);
    l->origin = l->pitch + ROLLING_LANES;
    l->plane = round_up(l->pitch * ((size_t)l->height + 1), PAGE_FLOATS) + PLANE_SKEW;
    l->absorbency = copies_count * DIFFUSION_FIELDS_COUNT;
    l->count = l->plane * ((size_t)l->absorbency + 1);
    return true;
}

void rolling_fill(const struct rolling_layout *l, const struct diffusion_scene *s,
                  float *planes)
{
    memset(planes, 0, l->count * sizeof *planes);
    for (int y = -1; y < l->height; y++) {
        size_t from = (size_t)(y + s->y0) * (size_t)s->width + (size_t)s->x0 - 1;
        float *to = planes + (size_t)(y + 1) * l->pitch + ROLLING_LANES - 1;
        size_t bytes = ((size_t)l->width + 1) * sizeof *to;
        for (int i = 0; i < l->absorbency; i++)
            memcpy(to + (size_t)i * l->plane, s->field[i % DIFFUSION_FIELDS_COUNT] + from,
                   bytes);
        memcpy(to + (size_t)l->absorbency * l->plane, s->absorbency + from, bytes);
    }
}

void rolling_read(const struct rolling_layout *l, const struct diffusion_scene *s, int field,
                  const float *plane, float *out)
{
    memcpy(out, s->field[field], (size_t)s->width * (size_t)s->height * sizeof *out);
    for (int y = 0; y < l->height; y++)
        memcpy(out + (size_t)(y + s->y0) * (size_t)s->width + s->x0,
               plane + l->origin + (size_t)y * l->pitch, (size_t)l->width * sizeof *out);
}

/* ---- the cut ---- */

static size_t strip_columns(const struct rolling_layout *l, const struct rolling_tiling *t)
{
    size_t vectors = (size_t)l->columns / ROLLING_LANES, strips = (size_t)t->strips_count;
    return (vectors + strips - 1) / strips * ROLLING_LANES;
}

size_t rolling_row_floats(const struct rolling_layout *l, const struct rolling_tiling *t)
{
    return off_page(strip_columns(l, t) + 3 * ROLLING_LANES); /* the rims, and one before */
}

size_t rolling_tile_floats(const struct rolling_layout *l, const struct rolling_tiling *t)
{
    return round_up(rolling_row_floats(l, t) * ROLLING_ROWS_COUNT * (size_t)t->steps_count,
                    PAGE_FLOATS);
}

void rolling_tiling_clamp(struct rolling_tiling *t, const struct rolling_layout *l)
{
    int strips_most = l->columns / ROLLING_LANES / STRIP_LEAST;
    if (t->strips_count > strips_most)
        t->strips_count = strips_most;
    if (t->strips_count < 1)
        t->strips_count = 1;
    if (t->bands_count > l->height)
        t->bands_count = l->height;
    if (t->bands_count < 1)
        t->bands_count = 1;
    if (t->steps_count > ROLLING_STEPS_MAX)
        t->steps_count = ROLLING_STEPS_MAX;
    if (t->steps_count < 1)
        t->steps_count = 1;
}

/* Wide strips have proportionally small rims; data that the second-level cache does not hold
 * comes from the third-level. Few bands, for the same reason, but one for each thread at
 * least. */
static int candidates_list(const struct rolling_layout *l, int threads_count,
                           struct rolling_tiling *list, int list_max)
{
    static const int steps[] = {4, 8, 12, 15};
    long cache_bytes = sysconf(_SC_LEVEL2_CACHE_SIZE);
    int count = 0;
    if (cache_bytes <= 0)
        cache_bytes = 1 << 20;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        for (int strips = 1; count < list_max; strips *= 2) {
            struct rolling_tiling t = {steps[i], strips, (threads_count + strips - 1) / strips};
            if (l->height / t.bands_count >= 64 * steps[i])
                t.bands_count *= 2; /* more bands, for load balance */
            rolling_tiling_clamp(&t, l);
            if (t.strips_count != strips)
                break;
            double bytes = (double)rolling_tile_floats(l, &t) * sizeof(float);
            if (bytes <= 1.5 * (double)cache_bytes)
                list[count++] = t;
            if (bytes < 0.25 * (double)cache_bytes)
                break;
        }
    }
    return count;
}

bool rolling_tune(const struct rolling_layout *l, int threads_count,
                  bool (*run)(void *context, const struct rolling_tiling *t), void *context,
                  struct rolling_tiling *best)
{
    struct rolling_tiling list[32];
    double least[32], least_of_all = 0;
    int count = candidates_list(l, threads_count, list, 32);
    const double begun = bench_now_s();
    for (int round = 0; round < TUNE_ROUNDS_LEAST ||
                        (round < TUNE_ROUNDS_MOST && bench_now_s() - begun < TUNE_S);
         round++)
        for (int i = 0; i < count; i++) {
            if (round && least[i] > TUNE_HOPE * least_of_all)
                continue;
            double start = bench_now_s();
            if (!run(context, &list[i]))
                return false;
            double seconds = (bench_now_s() - start) / list[i].steps_count;
            if (!round || seconds < least[i])
                least[i] = seconds;
            if (least_of_all == 0 || seconds < least_of_all)
                least_of_all = seconds;
        }
    *best = (struct rolling_tiling){8, 1, threads_count};
    rolling_tiling_clamp(best, l);
    for (int i = 0, k = -1; i < count; i++)
        if (k < 0 || least[i] < least[k]) {
            *best = list[i];
            k = i;
        }
    return true;
}
