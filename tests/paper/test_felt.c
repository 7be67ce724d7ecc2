/* test_felt.c - measures felted paper. It has no preferred direction except a mould's lines,
 * clouds of many sizes, the same form at a finer resolution, and no seam on a torus. Light on
 * it shows relief of every direction, and rough paper rough. Measures also a brushed wash on
 * it. */
#include "model/felt.h"

#include <brush.h>
#include <paper.h>

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sheet_calls.h"

enum { SIDE = 512, FIBERS = SIDE * SIDE };
#define PI 3.141592653589793

static struct paper_sheet_config config_of(const char *stock, int side, uint64_t seed)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = config.height = side;
    config.seed = seed;
    config.stock = *paper_stock_find(stock);
    config.pigments_count = 1;
    config.pigments[0] = *paper_pigment_curtis("french ultramarine");
    return config;
}

/* ---- spectra ---- */

/* Fourier transform in place; count is a power of two, and the numbers are `step` apart. */
static void transform(double complex *values, int count, int step)
{
    static double complex row[SIDE],
        turns[SIDE / 2]; /* turns: that many parts of half a turn */
    for (int k = 0; k < SIDE / 2 && turns[0] == 0; k++)
        turns[SIDE / 2 - 1 - k] = cexp(-I * PI * (SIDE / 2 - 1 - k) / (SIDE / 2));
    for (int i = 0, j = 0; i < count; i++) {
        row[j] = values[(size_t)i * (size_t)step];
        for (int bit = count >> 1; (j ^= bit) < bit && bit > 0; bit >>= 1)
            ;
    }
    for (int half = 1; half < count; half *= 2)
        for (int k = 0; k < half; k++) {
            const double complex turn = turns[k * (SIDE / 2 / half)];
            for (int i = k; i < count; i += 2 * half) {
                double complex odd = turn * row[i + half];
                row[i + half] = row[i] - odd;
                row[i] += odd;
            }
        }
    for (int i = 0; i < count; i++)
        values[(size_t)i * (size_t)step] = row[i];
}

struct figures {
    double over_64; /* share of the variance at wavelengths of 64 and more */
    double axes;    /* mean power, axes / diagonals, wavelengths 4 to 32 */
    double slope;   /* of log power over log frequency, wavelengths 4 to 128 */
    double deviation;
};

/* The slope of power over frequency on a log-log scale, by least squares, for rings of whole
 * frequencies 4 to SIDE / 4. */
static double slope_of(const double *power, const int *counts)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int ring = 4; ring < SIDE / 4; ring++) {
        double u = log(ring), v = log(power[ring] / counts[ring]);
        n++, x += u, y += v, xx += u * u, xy += u * v;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

/* The Fourier transform of what the values are off their mean, faded out towards the sides.
 * Returns their variance. */
static double spectrum_make(const float *values, double complex *plane)
{
    double sum = 0, squares = 0;
    for (int i = 0; i < FIBERS; i++)
        sum += (double)values[i];
    double mean = sum / FIBERS;
    for (int i = 0; i < FIBERS; i++) {
        double off = (double)values[i] - mean;
        squares += off * off;
        plane[i] = off * (0.5 - 0.5 * cos(2 * PI * (i % SIDE) / (SIDE - 1))) *
                   (0.5 - 0.5 * cos(2 * PI * (i / SIDE) / (SIDE - 1)));
    }
    for (int i = 0; i < SIDE; i++)
        transform(plane + (size_t)i * SIDE, SIDE, 1);
    for (int i = 0; i < SIDE; i++)
        transform(plane + i, SIDE, SIDE);
    return squares / FIBERS;
}

/* The frequency, wave and power at number i of a plane. */
static double power_at(const double complex *plane, int i, int *x, int *y, double *wave)
{
    *x = i % SIDE - (i % SIDE >= SIDE / 2 ? SIDE : 0);
    *y = i / SIDE - (i / SIDE >= SIDE / 2 ? SIDE : 0);
    *wave = SIDE / hypot(*x, *y);
    return creal(plane[i]) * creal(plane[i]) + cimag(plane[i]) * cimag(plane[i]);
}

static struct figures figures_of(const float *values)
{
    static double complex plane[FIBERS];
    static double ring_power[SIDE];
    static int ring_count[SIDE];
    double total = 0, coarse = 0, power[2] = {0}, count[2] = {0};
    memset(ring_power, 0, sizeof ring_power);
    memset(ring_count, 0, sizeof ring_count);
    const double variance = spectrum_make(values, plane);
    for (int i = 1; i < FIBERS; i++) {
        int x, y;
        double wave;
        const double here = power_at(plane, i, &x, &y, &wave);
        double turned = fmod(atan2(y, x) * 180 / PI + 360, 90);
        total += here;
        coarse += wave >= 64 ? here : 0;
        bool axis = turned < 10 || turned > 80, diagonal = turned > 35 && turned < 55;
        if (wave > 4 && wave < 32 && (axis || diagonal)) {
            power[axis ? 0 : 1] += here;
            count[axis ? 0 : 1]++;
        }
        int ring = (int)(hypot(x, y) + 0.5);
        if (ring < SIDE) {
            ring_power[ring] += here;
            ring_count[ring]++;
        }
    }
    return (struct figures){coarse / total, power[0] / count[0] / (power[1] / count[1]),
                            slope_of(ring_power, ring_count), sqrt(variance)};
}

static void figures_know_a_line_and_a_noise(void **state)
{
    (void)state;
    static float values[FIBERS];
    for (int i = 0; i < FIBERS; i++)
        values[i] = (float)sin(2 * PI * (i % SIDE) / 8);
    struct figures lines = figures_of(values);
    assert_true(lines.axes > 1000 && lines.over_64 < 0.01);
    uint32_t word = 1;
    for (int i = 0; i < FIBERS; i++) {
        word = word * 1664525u + 1013904223u;
        values[i] = (float)(word >> 8) * 0x1p-24f;
    }
    struct figures noise = figures_of(values);
    assert_true(fabs(noise.axes - 1) < 0.05 && fabs(noise.slope) < 0.1 && noise.over_64 < 0.01);
}

/* ---- the felt ---- */

static void felts_have_clouds_and_no_weave(void **state)
{
    (void)state;
    for (int i = 0; paper_stock_number(i); i++) {
        const char *name = paper_stock_number(i)->name;
        if (strcmp(name, "glass") == 0)
            continue; /* has no fibers */
        struct paper_sheet_config config = config_of(name, SIDE, 40 + (uint64_t)i);
        struct felt felt, again;
        check(felt_make(&config, &felt));
        check(felt_make(&config, &again));
        assert_memory_equal(felt.relief, again.relief, FIBERS * sizeof *felt.relief);
        assert_memory_equal(felt.mass, again.mass, FIBERS * sizeof *felt.mass);
        assert_memory_equal(felt.sizing, again.sizing, FIBERS * sizeof *felt.sizing);
        struct figures relief = figures_of(felt.relief), mass = figures_of(felt.mass);
        bool laid = strcmp(name, "laid") == 0 || strcmp(name, "xuan") == 0;
        printf("%-10s relief: axes %.2f, mass: axes %.2f, over 64 %.2f\n", name, relief.axes,
               mass.axes, mass.over_64);
        if (strcmp(name, "laid") == 0 ? relief.axes < 1.5 : !laid && relief.axes > 1.2)
            fail_msg("%s: relief favours the axes %g times", name, relief.axes);
        if (mass.axes > 1.2 || mass.axes < 0.8 || mass.over_64 < 0.1)
            fail_msg("%s: mass favours the axes %g times, clouds have %g", name, mass.axes,
                     mass.over_64);
        felt_free(&felt);
        felt_free(&again);
    }
}

static void a_felt_at_twice_the_resolution_is_the_same_finer(void **state)
{
    (void)state;
    enum { SMALL = 128 };
    static const char *const names[] = {"cold press", "laid", "xuan"};
    for (int n = 0; n < 3; n++) {
        struct paper_sheet_config config = config_of(names[n], SMALL, 9);
        struct felt small, large;
        check(felt_make(&config, &small));
        config.width = config.height = 2 * SMALL;
        config.stock.grain_px *= 2;
        config.stock.fiber_length[0] *= 2;
        config.stock.fiber_length[1] *= 2;
        check(felt_make(&config, &large));
        double products = 0, squares[2] = {0};
        for (int i = 0; i < SMALL * SMALL; i++) {
            size_t at = (size_t)(i / SMALL * 2) * 2 * SMALL + (size_t)(i % SMALL * 2);
            double a = (double)small.mass[i],
                   b = (double)(large.mass[at] + large.mass[at + 1] +
                                large.mass[at + (size_t)2 * SMALL] +
                                large.mass[at + (size_t)2 * SMALL + 1]) /
                       4;
            products += a * b;
            squares[0] += a * a;
            squares[1] += b * b;
        }
        double alike = products / sqrt(squares[0] * squares[1]);
        printf("%-10s twice as fine: correlation %.3f\n", names[n], alike);
        if (!(alike > 0.85))
            fail_msg("%s: correlation %g", names[n], alike);
        felt_free(&small);
        felt_free(&large);
    }
}

static void a_torus_has_no_seam(void **state)
{
    (void)state;
    enum { WIDE = 200, HIGH = 136 };
    struct paper_sheet_config config = config_of("cold press", WIDE, 3);
    config.height = HIGH;
    config.torus = true;
    struct felt felt;
    check(felt_make(&config, &felt));
    double seam = 0, inside = 0;
    for (int y = 0; y < HIGH; y++) {
        const float *row = felt.relief + (size_t)y * WIDE;
        double over = (double)(row[0] - row[WIDE - 1]);
        seam += over * over / HIGH;
        for (int x = 1; x < WIDE; x++)
            inside += (double)(row[x] - row[x - 1]) * (double)(row[x] - row[x - 1]) /
                      (HIGH * (WIDE - 1));
    }
    if (!(seam < 1.6 * inside))
        fail_msg("over the seam %g, inside %g", seam, inside);
    felt_free(&felt);
}

/* ---- light ---- */

/* The most power of four directions to the least, at waves of `low` to 2 * low fibers. */
static double direction_of(const double complex *plane, double low)
{
    double power[4] = {0}, most = 0, least = INFINITY;
    int count[4] = {0};
    for (int i = 1; i < FIBERS; i++) {
        int x, y;
        double wave;
        const double here = power_at(plane, i, &x, &y, &wave);
        if (wave < low || wave >= 2 * low)
            continue;
        const int sector = (int)floor(atan2(y, x) / (PI / 4) + 8.5) % 4;
        power[sector] += here;
        count[sector]++;
    }
    for (int i = 0; i < 4; i++) {
        most = fmax(most, power[i] / count[i]);
        least = fmin(least, power[i] / count[i]);
    }
    return most / least;
}

/* The light that bare paper sends back, green. */
static void bare_view(const struct paper_sheet_config *config, float *light)
{
    struct paper_sheet *sheet;
    uint16_t *rgb = malloc(sizeof *rgb * 3 * FIBERS);
    assert_non_null(rgb);
    check(paper_sheet_create(config, &sheet));
    const struct paper_sheet_view view = paper_sheet_view_default(config);
    check(paper_sheet_view(sheet, &view, rgb));
    for (size_t i = 0; i < FIBERS; i++)
        light[i] = (float)paper_light_linear(rgb[3 * i + 1] / 65535.0);
    free(rgb);
    paper_sheet_destroy(sheet);
}

/* The deviation of the light from its mean over 7x7 fibers, as a part of that. */
static double contrast_of(const float *light)
{
    enum { REACH = 3 };
    double squares = 0;
    int count = 0;
    for (int y = REACH; y < SIDE - REACH; y += 2)
        for (int x = REACH; x < SIDE - REACH; x += 2) {
            double sum = 0;
            for (int v = -REACH; v <= REACH; v++)
                for (int u = -REACH; u <= REACH; u++)
                    sum += (double)light[(y + v) * SIDE + x + u];
            const double off = (double)light[y * SIDE + x] * 49 / sum - 1;
            squares += off * off;
            count++;
        }
    return sqrt(squares / count);
}

/* The wires of a mould are a direction of the paper's own. */
static void light_has_no_direction_and_rough_is_rough(void **state)
{
    (void)state;
    static float light[FIBERS];
    static double complex plane[FIBERS];
    double rough = 0, hot = 0, glass = 0;
    const int seeds = all_sheets_wanted() ? 20 : 1;
    for (int i = 0; paper_stock_number(i); i++)
        for (int seed = 0; seed < seeds; seed++) {
            const char *name = paper_stock_number(i)->name;
            if (seeds == 1 &&
                (strcmp(name, "cold press") == 0 || strcmp(name, "blotting") == 0))
                continue; /* they are like those beside them */
            const struct paper_sheet_config config = config_of(name, SIDE, 70 + (uint64_t)seed);
            bare_view(&config, light);
            spectrum_make(light, plane);
            const double contrast = contrast_of(light), fine = direction_of(plane, 2),
                         middle = direction_of(plane, 4), coarse = direction_of(plane, 8);
            printf("%-10s lit: contrast %.4f, directions %.1f %.1f %.1f\n", name, contrast,
                   fine, middle, coarse);
            const double most = strcmp(name, "laid") == 0 ? 20 : 5;
            if (!(fine <= most && middle <= most && coarse <= most))
                fail_msg("%s: directions differ %g, %g and %g times", name, fine, middle,
                         coarse);
            rough += strcmp(name, "rough") == 0 ? contrast : 0;
            hot += strcmp(name, "hot press") == 0 ? contrast : 0;
            glass += strcmp(name, "glass") == 0 ? contrast : 0;
        }
    if (!(rough >= 2.5 * hot && rough <= 5 * hot && glass <= 0.25 * hot))
        fail_msg("contrast: rough %g, hot press %g, glass %g", rough / seeds, hot / seeds,
                 glass / seeds);
}

/* ---- a brushed wash ---- */

/* Paints nine wavering strokes of a wide flat brush and dries them after 200 steps. density:
 * the optical density for red, which ultramarine absorbs most. */
static void wash_brush(const char *stock, float *density)
{
    enum { WIDE = 640, EDGE = (WIDE - SIDE) / 2, STROKES = 9 };
    struct paper_sheet_config config = config_of(stock, WIDE, 7);
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    struct paper_brush brush = paper_brush_default();
    brush.flat = brush.follows = true;
    brush.width = 110;
    brush.depth = 24;
    brush.bristles = PAPER_BRISTLES_MAX;
    brush.thickness = 6.6;
    brush.reach = 2420;
    brush.point = 0.1;
    brush.uneven = 0.3;
    brush.splay = 0.15;
    brush.bend = 0.2;
    check(paper_sheet_brush(sheet, &brush));
    for (int i = 0; i < STROKES; i++) {
        double y = 20 + 78 * i;
        struct paper_stroke_sample samples[5];
        for (int j = 0; j < 5; j++)
            samples[j] = (struct paper_stroke_sample){.time_s = 0.12 * j,
                                                      .x = -20 + 170 * j,
                                                      .y = y + 9 * sin(i * 2.5 + j * 3),
                                                      .pressure = 0.8};
        check(paper_sheet_dip(
            sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {1, 0.5}}));
        check(paper_sheet_stroke(
            sheet, &(struct paper_stroke){.pace = 30, .samples_count = 5, .samples = samples},
            NULL));
    }
    for (int i = 0; i < 200; i++)
        check(paper_sheet_step(sheet));
    check(paper_sheet_dry(sheet));
    uint16_t *rgb = malloc(sizeof *rgb * 3 * WIDE * WIDE);
    assert_non_null(rgb);
    check(paper_sheet_view(sheet, &(struct paper_sheet_view){.high = 1, .light = 1.6}, rgb));
    for (int i = 0; i < FIBERS; i++) {
        size_t at = (size_t)(i / SIDE + EDGE) * WIDE + (size_t)(i % SIDE + EDGE);
        density[i] = (float)-log10(fmax(1e-3, paper_light_linear(rgb[3 * at] / 65535.0)));
    }
    free(rgb);
    paper_sheet_destroy(sheet);
}

static void washes_are_cloudy_as_real_ones(void **state)
{
    (void)state;
    static float density[FIBERS];
    static const char *const names[] = {"laid",      "rough", "glass",   "cold press",
                                        "hot press", "xuan",  "blotting"};
    enum { OFTEN = 2, ALL = sizeof names / sizeof *names };
    for (int i = 0; i < (all_sheets_wanted() ? ALL : OFTEN); i++) {
        bool laid = strcmp(names[i], "laid") == 0;
        wash_brush(names[i], density);
        struct figures f = figures_of(density);
        printf("%-10s wash: over 64 %.2f, axes %.2f, slope %.2f, deviation %.3f\n", names[i],
               f.over_64, f.axes, f.slope, f.deviation);
        if (!(f.over_64 >= 0.5 && f.over_64 <= 0.88 && f.axes <= (laid ? 1.9 : 1.2) &&
              f.slope > -2.2 && f.slope < -1.2))
            fail_msg("%s: %g over 64, axes %g, slope %g", names[i], f.over_64, f.axes, f.slope);
    }
}

int main(void)
{
    setvbuf(stdout, NULL, _IONBF, 0);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_know_a_line_and_a_noise),
        cmocka_unit_test(felts_have_clouds_and_no_weave),
        cmocka_unit_test(a_felt_at_twice_the_resolution_is_the_same_finer),
        cmocka_unit_test(a_torus_has_no_seam),
        cmocka_unit_test(light_has_no_direction_and_rough_is_rough),
        cmocka_unit_test(washes_are_cloudy_as_real_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
