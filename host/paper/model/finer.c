/* finer.c - a picture with 2 or 4 pixels a fiber each way, from the picture with one.
 *
 *     coarse a -> fine f:   f = interpolated a (Catmull-Rom), then three times
 *                           f += interpolated (a - mean of the fiber's pixels),  within the
 *                                                                                neighbours'
 *                                                                                least and most
 *                           and at last the mean of each fiber's pixels is made a again
 *
 * The part of a fiber that paint covers is in its shade. The corrections put that part on the
 * side where the paint is, so a gray staircase becomes a smooth edge, sharper than
 * interpolation alone makes it. Limits keep halos away: no pixel is lighter or darker than the
 * lightest and darkest of the nine fibers around it. The mean of a fiber's pixels is the
 * fiber's shade, except for rounding, so a finer picture that is made smaller again is the
 * picture with one pixel a fiber.
 *
 * Sources: Irani and Peleg, CVGIP 53 (1991), iterative back-projection; Keys, IEEE Trans. ASSP
 * 29 (1981), the interpolation. */
#include "model/model.h"

#include <math.h>
#include <stdlib.h>

enum { ROUNDS = 3, TAPS = 4 };

/* One channel, coarse and fine. */
struct finer {
    int width, height, scale;
    bool torus;
    float *coarse, *error, *rows; /* rows: finer along x only */
    float *fine;
};

/* The weights of four fibers for each of a fiber's pixels; the first is two or one before
 * it. */
struct taps {
    int first[4];
    float weight[4][TAPS];
};

/* Keys's cubic with a = -1/2, or a tent. */
static double weight_of(double distance, bool cubic)
{
    const double d = fabs(distance);
    if (!cubic)
        return fmax(0, 1 - d);
    return d < 1 ? (1.5 * d - 2.5) * d * d + 1 : d < 2 ? ((-0.5 * d + 2.5) * d - 4) * d + 2 : 0;
}

static void taps_make(struct taps *taps, int scale, bool cubic)
{
    for (int i = 0; i < scale; i++) {
        const double middle = (i + 0.5) / scale - 0.5;
        taps->first[i] = (int)floor(middle) - 1;
        for (int j = 0; j < TAPS; j++)
            taps->weight[i][j] = (float)weight_of(taps->first[i] + j - middle, cubic);
    }
}

/* The place of fiber i of `count`: beyond the edges that of the last one, or on a torus of the
 * other side. */
static int place_of(int i, int count, bool torus)
{
    if (torus)
        return (i % count + count) % count;
    return i < 0 ? 0 : i < count ? i : count - 1;
}

/* fine += (or =) the interpolated values. */
static void interpolated(struct finer *f, const float *from, const struct taps *taps, bool add)
{
    const size_t wide = (size_t)f->width * (size_t)f->scale;
    for (int y = 0; y < f->height; y++) {
        const float *row = from + (size_t)y * (size_t)f->width;
        for (int x = 0; x < f->width; x++)
            for (int i = 0; i < f->scale; i++) {
                float sum = 0;
                for (int j = 0; j < TAPS; j++)
                    sum += taps->weight[i][j] *
                           row[place_of(x + taps->first[i] + j, f->width, f->torus)];
                f->rows[(size_t)y * wide + (size_t)(x * f->scale + i)] = sum;
            }
    }
    for (int y = 0; y < f->height; y++)
        for (int i = 0; i < f->scale; i++) {
            float *to = f->fine + (size_t)(y * f->scale + i) * wide;
            const float *rows[TAPS], *w = taps->weight[i];
            for (int j = 0; j < TAPS; j++)
                rows[j] = f->rows +
                          (size_t)place_of(y + taps->first[i] + j, f->height, f->torus) * wide;
            for (size_t x = 0; x < wide; x++) {
                const float sum = w[0] * rows[0][x] + w[1] * rows[1][x] + w[2] * rows[2][x] +
                                  w[3] * rows[3][x];
                to[x] = add ? to[x] + sum : sum;
            }
        }
}

/* The least and the most of the nine fibers around one. */
static void limits_of(const struct finer *f, int x, int y, float *least, float *most)
{
    *least = *most = f->coarse[(size_t)y * (size_t)f->width + (size_t)x];
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const int at_x = place_of(x + dx, f->width, f->torus);
            const int at_y = place_of(y + dy, f->height, f->torus);
            const float value = f->coarse[(size_t)at_y * (size_t)f->width + (size_t)at_x];
            *least = value < *least ? value : *least;
            *most = value > *most ? value : *most;
        }
}

/* Takes a fiber's pixels within the limits, and returns their mean. */
static float block_limit(const struct finer *f, int x, int y, float least, float most)
{
    const size_t wide = (size_t)f->width * (size_t)f->scale;
    float sum = 0;
    for (int i = 0; i < f->scale; i++) {
        float *p = f->fine + (size_t)(y * f->scale + i) * wide + (size_t)(x * f->scale);
        for (int j = 0; j < f->scale; j++) {
            p[j] = p[j] < least ? least : p[j] > most ? most : p[j];
            sum += p[j];
        }
    }
    return sum / (float)(f->scale * f->scale);
}

/* Moves a fiber's pixels towards the limit until their mean is `mean`: each by the same part of
 * its way. */
static void block_settle(const struct finer *f, int x, int y, float limit, float is, float mean)
{
    const size_t wide = (size_t)f->width * (size_t)f->scale;
    const float way = limit - is;
    const float part = way == 0 ? 0 : (mean - is) / way;
    for (int i = 0; i < f->scale; i++) {
        float *p = f->fine + (size_t)(y * f->scale + i) * wide + (size_t)(x * f->scale);
        for (int j = 0; j < f->scale; j++)
            p[j] += part * (limit - p[j]);
    }
}

static void channel_make(struct finer *f)
{
    struct taps cubic, tent;
    taps_make(&cubic, f->scale, true);
    taps_make(&tent, f->scale, false);
    interpolated(f, f->coarse, &cubic, false);
    for (int round = 0; round <= ROUNDS; round++) {
        for (int y = 0; y < f->height; y++)
            for (int x = 0; x < f->width; x++) {
                const size_t at = (size_t)y * (size_t)f->width + (size_t)x;
                float least, most;
                limits_of(f, x, y, &least, &most);
                const float mean = block_limit(f, x, y, least, most);
                f->error[at] = f->coarse[at] - mean;
                if (round == ROUNDS)
                    block_settle(f, x, y, f->error[at] > 0 ? most : least, mean, f->coarse[at]);
            }
        if (round < ROUNDS)
            interpolated(f, f->error, &tent, true);
    }
}

double paper_sheet_view_bytes(const struct paper_sheet_config *config, int scale)
{
    const double count = (double)config->width * config->height;
    const double squared = scale < 2 ? 1 : (double)scale * scale,
                 ground =
                     !config->deckled
                         ? 0
                         : count * (4 * sizeof(float) + 3 * sizeof(uint16_t) * (1 + squared));
    return scale < 2 ? ground
                     : ground + count * (3 * sizeof(uint16_t) +
                                         sizeof(float) * (2 + scale + squared));
}

enum paper_status sheet_finer(const uint16_t *coarse, int width, int height, bool torus,
                              int scale, uint16_t *rgb)
{
    const size_t count = (size_t)width * (size_t)height, times = (size_t)scale;
    const size_t fine = count * times * times;
    float *all = calloc(2 * count + times * count + fine, sizeof *all);
    if (!all)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a picture of %dx%d", width * scale,
                          height * scale);
    struct finer f = {.width = width, .height = height, .scale = scale, .torus = torus};
    f.coarse = all;
    f.error = all + count;
    f.rows = all + 2 * count;
    f.fine = f.rows + times * count;
    for (size_t channel = 0; channel < 3; channel++) {
        for (size_t i = 0; i < count; i++)
            f.coarse[i] = coarse[3 * i + channel];
        channel_make(&f);
        for (size_t i = 0; i < fine; i++)
            rgb[3 * i + channel] = (uint16_t)lrintf(fminf(fmaxf(f.fine[i], 0), 65535));
    }
    free(all);
    return PAPER_OK;
}
