/* demo_scenery.c - masks and reflections for the demonstration page.
 *
 * Everything is a function of the place alone, by value noise: random numbers at the corners
 * of a lattice, smoothly interpolated, in octaves of halving sizes.
 */
#include "demo_scenery.h"

#include <math.h>
#include <stdlib.h>

enum { OCTAVES = 5 };

static uint32_t scramble(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ x >> 16;
}

/* The random number 0..1 at a corner of the lattice. */
static double corner(int x, int y, uint32_t seed)
{
    return scramble((uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u ^ seed) / 4294967296.0;
}

static double noise(double x, double y, uint32_t seed)
{
    int i = (int)floor(x), j = (int)floor(y);
    double u = x - i, v = y - j;
    u = u * u * (3 - 2 * u);
    v = v * v * (3 - 2 * v);
    double above = corner(i, j, seed) * (1 - u) + corner(i + 1, j, seed) * u;
    double below = corner(i, j + 1, seed) * (1 - u) + corner(i + 1, j + 1, seed) * u;
    return above * (1 - v) + below * v;
}

static double cloud(double x, double y, uint32_t seed)
{
    double sum = 0, weight = 0.5;
    for (uint32_t octave = 0; octave < OCTAVES; octave++) {
        sum += weight * noise(x, y, seed + octave);
        x *= 2.03;
        y *= 2.03;
        weight *= 0.5;
    }
    return sum;
}

/* 0 up to from, 1 beyond to, smooth between. */
static double ramp(double from, double to, double x)
{
    double t = fmin(1, fmax(0, (x - from) / (to - from)));
    return t * t * (3 - 2 * t);
}

/* Where the sheet is wet: below an uneven waterline, with soft shores at the other three
 * sides. */
static double wetness(const struct demo_mask *mask, double x, double y)
{
    double edge = mask->waterline_px + 1 + 22 * (cloud(x / 90, 3, 7) - 0.5);
    double left = ramp(30, 330, x + 240 * (cloud(y / 60, 1, 3) - 0.5));
    double right = ramp(30, 330, mask->width_px - x + 240 * (cloud(y / 60, 9, 5) - 0.5));
    double bottom = ramp(40, 330, mask->height_px - y + 200 * (cloud(x / 120, 5, 9) - 0.5));
    return ramp(edge - 2, edge + 7, y) * left * right * bottom;
}

static double mask_value(const struct demo_mask *mask, enum demo_mask_kind kind, double x,
                         double y)
{
    double wet = wetness(mask, x, y);
    double streak = cloud(x / 420, y / 26, 11);
    double deep = fmax(0, (y - mask->waterline_px) / 420);
    switch (kind) {
    case DEMO_WATER:
        return wet * (0.55 + 0.5 * streak);
    case DEMO_DEEP:
        return wet * exp(-1.1 * deep) * (1.3 * streak - 0.04);
    case DEMO_CLAY:
        return wet * ramp(0.40, 0.68, cloud(x / 420, y / 44, 57));
    case DEMO_REED:
        return wet * ramp(0.42, 0.70, cloud(x / 380, y / 50, 73));
    }
    return 0;
}

bool demo_mask_screen(const struct demo_mask *mask, enum demo_mask_kind kind,
                      struct paper_screen *out)
{
    *out = (struct paper_screen){.width_px = mask->width_px, .height_px = mask->height_px};
    size_t width = (size_t)mask->width_px;
    out->gray = calloc((size_t)mask->height_px, width);
    if (!out->gray)
        return false;
    for (int y = mask->waterline_px - 32; y < mask->height_px; y++)
        for (int x = 0; x < mask->width_px; x++) {
            double value = fmin(1, fmax(0, mask_value(mask, kind, x, y)));
            out->gray[(size_t)y * width + (size_t)x] = (uint8_t)lround(255 * value);
        }
    return true;
}

void demo_letter_blend(const struct demo_letter *letter, struct paper_screen *sheet)
{
    const struct paper_screen *screen = &letter->screen;
    for (int row = 0; row < screen->height_px; row++)
        for (int column = 0; column < screen->width_px; column++) {
            const int x = letter->x_px + column, y = letter->y_px + row;
            if (x < 0 || x >= sheet->width_px || y < 0 || y >= sheet->height_px)
                continue;
            uint8_t *to = &sheet->gray[(size_t)y * (size_t)sheet->width_px + (size_t)x];
            const uint8_t from =
                screen->gray[(size_t)row * (size_t)screen->width_px + (size_t)column];
            *to = from > *to ? from : *to;
        }
}

/* The share of a reflection at that depth in the band: bands overlap, and their shares add
 * up to 1. */
static double band_share(int band, double depth)
{
    const double step = (double)DEMO_REFLECTION_DEPTH_PX / DEMO_BANDS;
    double middle = step * (DEMO_BANDS - 1 - band);
    if ((band == DEMO_BANDS - 1 && depth < middle) || (band == 0 && depth > middle))
        return 1;
    return fmax(0, 1 - fabs(depth - middle) / step);
}

void demo_reflection_blend(const struct demo_letter *letter, int band,
                           struct paper_screen *sheet)
{
    enum { SWAY_MAX = 30 };
    const struct paper_screen *screen = &letter->screen;
    for (int depth = 0; depth < screen->height_px; depth++) {
        double share = band_share(band, depth);
        int y = letter->y_px + screen->height_px + depth;
        if (share <= 0 || y >= sheet->height_px)
            continue;
        double fade = fmax(0.15, 1 - depth / 680.0);
        const uint8_t *from =
            screen->gray + (size_t)(screen->height_px - 1 - depth) * (size_t)screen->width_px;
        uint8_t *to = sheet->gray + (size_t)y * (size_t)sheet->width_px;
        for (int i = -SWAY_MAX; i < screen->width_px + SWAY_MAX; i++) {
            int x = letter->x_px + i;
            if (x < 0 || x >= sheet->width_px)
                continue;
            double sway = (1 + 0.05 * depth) * (2 * noise(x / 300.0, y / 16.0, 21) - 1);
            int source = i + (int)lround(sway);
            if (source < 0 || source >= screen->width_px || from[source] == 0)
                continue;
            double glint = ramp(0.60, 0.78, noise(x / 140.0, y / 8.0, 91)) * ramp(0, 60, depth);
            double value = from[source] * fade * share * (1 - 0.85 * glint);
            to[x] = (uint8_t)fmax(to[x], round(value));
        }
    }
}
