/* test_flow.c - measures flowing water: backruns, drops, letters, drips, edges and type, all on
 * one paper in one air. Scripts choose water, pigment, gravity and time. */
#include <history.h>
#include <paper.h>
#include <sheet.h>
#include <techniques.h>

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

enum { SIDE = 256, FIBERS = SIDE * SIDE, RAYS = 360, SPECTRUM = 40, SHORTEST_FRONT = 1 };
#define MIDDLE (SIDE / 2.0)
#define TURN 6.283185307179586

static float first[FIBERS], second[FIBERS], layer[FIBERS];

static struct paper_sheet *sheet_of(uint64_t seed, const char *stock)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = config.height = SIDE;
    config.seed = seed;
    config.stock = *paper_stock_find(stock);
    config.pigments_count = 2;
    config.pigments[0] = *paper_pigment_curtis("french ultramarine");
    config.pigments[1] = *paper_pigment_curtis("quinacridone rose");
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    return sheet;
}

static struct paper_sheet *sheet_new(uint64_t seed)
{
    return sheet_of(seed, "cold press");
}

static void steps(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++)
        check(paper_sheet_step(sheet));
    check(paper_sheet_finish(sheet));
}

/* Reads a pigment's amounts, the sums of all layers. */
static void pigment_read(struct paper_sheet *sheet, int pigment, float *amounts)
{
    static const enum paper_layer layers[3] = {
        PAPER_LAYER_SURFACE_PIGMENT, PAPER_LAYER_INFUSED_PIGMENT, PAPER_LAYER_FIXED_PIGMENT};
    memset(amounts, 0, FIBERS * sizeof *amounts);
    for (int i = 0; i < 3; i++) {
        check(paper_sheet_layer_read(sheet, layers[i], pigment, layer));
        for (int j = 0; j < FIBERS; j++)
            amounts[j] += layer[j];
    }
}

static void box_put(struct paper_sheet *sheet, double x1, double y1, double x2, double y2,
                    const double *amount)
{
    polygon_put(sheet, SIDE, (double[]){x1, y1, x2, y1, x2, y2, x1, y2}, 4, amount);
}

static double value_at(const float *values, double x, double y)
{
    int column = (int)floor(x), row = (int)floor(y);
    if (column < 0 || row < 0 || column >= SIDE - 1 || row >= SIDE - 1)
        return 0;
    double u = x - column, v = y - row;
    const float *at = values + row * SIDE + column;
    return (1 - v) * ((1 - u) * (double)at[0] + u * (double)at[1]) +
           v * ((1 - u) * (double)at[SIDE] + u * (double)at[SIDE + 1]);
}

/* ---- a backrun: clean water put into a damp wash ---- */

/* Adds the spectrum of the front's radius over the angle, relative to the mean radius squared,
 * to `power`. Returns its sum without the first term. */
static double front_power(const float *wet, double power[SPECTRUM + 1])
{
    static double radius[RAYS];
    double mean = 0, sum = 0;
    for (int i = 0; i < RAYS; i++) {
        radius[i] = 0;
        for (double r = 1; r < MIDDLE - 4; r += 0.25)
            if (value_at(wet, MIDDLE + r * cos(TURN * i / RAYS),
                         MIDDLE + r * sin(TURN * i / RAYS)) > 0.5)
                radius[i] = r;
        mean += radius[i] / RAYS;
    }
    for (int n = 1; n <= SPECTRUM; n++) {
        double x = 0, y = 0;
        for (int i = 0; i < RAYS; i++) {
            x += radius[i] * cos(TURN * n * i / RAYS);
            y += radius[i] * sin(TURN * n * i / RAYS);
        }
        double part = 2 * (x * x + y * y) / RAYS / RAYS / mean / mean;
        power[n] += part;
        sum += n > 1 ? part : 0;
    }
    return sum;
}

/* The mean of `amounts` in the fibers of which a part is wet, at the front. */
static double front_darkness(const float *wet, const float *amounts)
{
    double sum = 0, count = 0;
    for (int y = 1; y < SIDE - 1; y++)
        for (int x = 1; x < SIDE - 1; x++) {
            const int i = y * SIDE + x;
            const float most =
                fmaxf(fmaxf(wet[i - 1], wet[i + 1]), fmaxf(wet[i - SIDE], wet[i + SIDE]));
            const bool at_front = wet[i] > 0.05f && wet[i] < 0.75f && most > 0.99f;
            sum += at_front ? (double)amounts[i] : 0;
            count += at_front;
        }
    return count > 0 ? sum / count : 0;
}

static void backrun_has_lobes(void **state)
{
    (void)state;
    enum { SEEDS = 3 };
    double power[SPECTRUM + 1] = {0}, varies = 0, inside = 0, rim = 0, beyond = 0, line = 0;
    for (int seed = 0; seed < SEEDS; seed++) {
        struct paper_sheet *sheet = sheet_new((uint64_t)seed + 1);
        check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){0.3, 0.4, 0}));
        steps(sheet, 300);
        disc_put(sheet, SIDE, MIDDLE, MIDDLE, 14, (double[]){4, 0, 0});
        steps(sheet, 500);
        check(paper_sheet_layer_read(sheet, PAPER_LAYER_WET_PART, 0, second));
        varies += sqrt(front_power(second, power)) / SEEDS;
        pigment_read(sheet, 0, first);
        double most = 0;
        for (int i = 0; i < FIBERS; i++)
            most = fmax(most, (double)first[i]);
        rim += most / SEEDS;
        line += front_darkness(second, first) / SEEDS;
        inside += value_at(first, MIDDLE, MIDDLE) / SEEDS;
        beyond += value_at(first, MIDDLE + 70, MIDDLE + 70) / SEEDS;
        paper_sheet_destroy(sheet);
    }
    double four = power[4] / ((power[2] + power[3] + power[5] + power[6]) / 4),
           eight = power[8] / ((power[6] + power[7] + power[9] + power[10]) / 4);
    print_message(
        "backrun: radius varies by %.1f%%, at 4 %.2f and at 8 %.2f of the neighbours; "
        "inside %.2f, most %.2f, beyond %.2f\n",
        100 * varies, four, eight, inside, rim, beyond);
    print_message("backrun: its front's last fibers are %.2f as dark as the wash\n",
                  line / beyond);
    assert_true(line > 0.9 * beyond);
    assert_true(varies >= 0.08);
    assert_true(four < 3 && eight < 3);
    assert_true(inside < 0.85 * beyond && rim > 1.3 * beyond);
}

/* How far `amounts` differ from the best fitting disc about their own middle, whose profile is
 * an error function. */
static double unlike_a_disc(const float *amounts)
{
    double mass = 0, x_sum = 0, y_sum = 0, squares = 0, best = INFINITY;
    for (int i = 0; i < FIBERS; i++) {
        mass += (double)amounts[i];
        x_sum += (double)amounts[i] * (i % SIDE);
        y_sum += (double)amounts[i] * (i / SIDE);
    }
    for (int i = 0; i < FIBERS; i++)
        if (i % SIDE % 2 == 0 && i / SIDE % 2 == 0)
            squares += (double)amounts[i] * (double)amounts[i];
    for (double radius = 4; radius < 100; radius *= 1.1)
        for (double width = 1; width < 60; width *= 1.3) {
            double both = 0, own = 0;
            for (int y = 0; y < SIDE; y += 2)
                for (int x = 0; x < SIDE; x += 2) {
                    double r = hypot(x - x_sum / mass, y - y_sum / mass);
                    double disc = 0.5 * erfc((r - radius) / width);
                    both += disc * (double)amounts[y * SIDE + x];
                    own += disc * disc;
                }
            best = fmin(best, squares - both * both / own);
        }
    return sqrt(fmax(0, best) / squares);
}

/* Of twenty seeds that were measured those that are most like a disc, and the first. */
static void drop_in_water_is_no_disc(void **state)
{
    (void)state;
    static const uint64_t seeds[] = {1, 4, 9, 11};
    for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
        struct paper_sheet *sheet = sheet_new(seeds[i]);
        check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){0.3, 0, 0}));
        disc_put(sheet, SIDE, MIDDLE, MIDDLE, 20, (double[]){2, 0.8, 0});
        steps(sheet, 300);
        pigment_read(sheet, 0, first);
        double unlike = unlike_a_disc(first);
        print_message("drop %d: %.1f%% is unlike any disc\n", (int)seeds[i], 100 * unlike);
        assert_true(unlike >= 0.2);
        paper_sheet_destroy(sheet);
    }
}

static void shapes_that_touch_run_into_each_other(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_new(1);
    box_put(sheet, 8, 68, MIDDLE, 188, (double[]){0.5, 0.5, 0});
    box_put(sheet, MIDDLE, 68, SIDE - 8, 188, (double[]){0.5, 0, 0.5});
    steps(sheet, 300);
    pigment_read(sheet, 0, first);
    pigment_read(sheet, 1, second);
    int from = 0, to = SIDE;
    for (int x = 40; x < SIDE - 40; x++) {
        double left = 0, right = 0;
        for (int y = 88; y < 168; y++) {
            left += (double)first[y * SIDE + x];
            right += (double)second[y * SIDE + x];
        }
        if (right < 0.1 * (left + right))
            from = x;
        if (right > 0.9 * (left + right) && to == SIDE)
            to = x;
    }
    print_message("two shapes: mixed from 10%% to 90%% over %d fibers\n", to - from);
    assert_true(to - from >= 20 && to < SIDE);
    paper_sheet_destroy(sheet);
}

/* The length of the contour line of `amounts` at level `at`, relative to the circumference of a
 * circle of the same area. */
static double front_ratio(const float *amounts, float at)
{
    static const int corners[5] = {0, 1, SIDE + 1, SIDE, 0};
    static const double x_of[5] = {0, 1, 1, 0, 0}, y_of[5] = {0, 0, 1, 1, 0};
    double length = 0, area = 0;
    for (int i = 0; i < FIBERS - SIDE - 1; i++) {
        double x[4], y[4];
        int count = 0;
        area += amounts[i] > at;
        for (int side = 0; side < 4; side++) {
            float a = amounts[i + corners[side]] - at, b = amounts[i + corners[side + 1]] - at;
            if ((a > 0) == (b > 0))
                continue;
            double t = (double)(a / (a - b));
            x[count] = x_of[side] + t * (x_of[side + 1] - x_of[side]);
            y[count++] = y_of[side] + t * (y_of[side + 1] - y_of[side]);
        }
        for (int j = 0; j + 1 < count; j += 2)
            length += hypot(x[j] - x[j + 1], y[j] - y[j + 1]);
    }
    return length / sqrt(2 * TURN * area);
}

static double ink_front(uint64_t seed, const char *stock)
{
    struct paper_sheet *sheet = sheet_of(seed, stock);
    struct paper_air air = paper_air_default();
    air.humidity = 0.0001;
    check(paper_sheet_air(sheet, &air));
    disc_put(sheet, SIDE, MIDDLE, MIDDLE, 10, (double[]){4, 1.5, 0});
    steps(sheet, 2400);
    pigment_read(sheet, 0, first);
    paper_sheet_destroy(sheet);
    return front_ratio(first, 0.04f);
}

/* The sheet with the shortest front of twenty; with PAPER_TEST_FULL=1 all twenty, and blotting
 * paper. */
static void ink_runs_along_fibers(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        if (seed != SHORTEST_FRONT && !all_sheets_wanted())
            continue;
        const double ratio = ink_front(seed, "xuan");
        print_message("ink on xuan %d: its front is %.2f times as long as a smooth one\n",
                      (int)seed, ratio);
        assert_true(ratio >= 3);
    }
    if (all_sheets_wanted())
        assert_true(ink_front(1, "blotting") >= 3);
}

static double variation(const double *values, int count)
{
    double mean = 0, squares = 0;
    for (int i = 0; i < count; i++)
        mean += values[i] / count;
    for (int i = 0; i < count; i++)
        squares += (values[i] - mean) * (values[i] - mean) / count;
    return sqrt(squares) / mean;
}

static void drips_differ(void **state)
{
    (void)state;
    enum { BOTTOM = 70, DRIPS_MOST = SIDE, NEAR = 6 };
    static double spacing[DRIPS_MOST], length[DRIPS_MOST], bend[DRIPS_MOST];
    int low[SIDE], count = 0, spaces = 0;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        struct paper_sheet *sheet = sheet_new(seed);
        struct paper_air air = paper_air_default();
        air.gravity[1] = 0.2;
        check(paper_sheet_air(sheet, &air));
        box_put(sheet, 20, 20, SIDE - 20, BOTTOM, (double[]){1.5, 0.6, 0});
        steps(sheet, 900);
        pigment_read(sheet, 0, first);
        paper_sheet_destroy(sheet);
        for (int x = 0; x < SIDE; x++) {
            low[x] = BOTTOM;
            for (int y = BOTTOM; y < SIDE - 3 && y < low[x] + 8; y++)
                low[x] = first[y * SIDE + x] > 0.05f ? y : low[x];
        }
        int before = -1;
        for (int x = 24; x < SIDE - 24; x++) {
            bool lowest = low[x] > BOTTOM + 10;
            for (int i = -NEAR; i <= NEAR; i++)
                lowest = lowest && low[x + i] <= low[x] && !(i < 0 && low[x + i] == low[x]);
            if (!lowest)
                continue;
            /* how far the drip's middle has moved sideways at half its height */
            int half = (BOTTOM + low[x]) / 2, left = x, right = x;
            while (left > 0 && first[half * SIDE + left - 1] > 0.05f && x - left < 20)
                left--;
            while (right < SIDE - 1 && first[half * SIDE + right + 1] > 0.05f && right - x < 20)
                right++;
            bend[count] = 1 + fabs((left + right) / 2.0 - x);
            length[count++] = low[x] - BOTTOM;
            if (before >= 0)
                spacing[spaces++] = x - before;
            before = x;
        }
    }
    double of_spacing = variation(spacing, spaces), of_length = variation(length, count),
           of_bend = variation(bend, count);
    print_message("drips: %d; variation of spacing %.2f, length %.2f, bend %.2f\n", count,
                  of_spacing, of_length, of_bend);
    assert_true(count >= 9);
    assert_true(of_spacing > 0.3 && of_length > 0.3 && of_bend > 0.3);
}

/* The width, in fibers, of the band at a disc's edge that is darker than its inside; *contrast:
 * how much darker at most. */
static double band_width(const float *amounts, double radius, double *contrast)
{
    static double profile[SIDE], counts[SIDE];
    double inside = 0, samples = 0, most = 0, width = 0;
    memset(profile, 0, sizeof profile);
    memset(counts, 0, sizeof counts);
    for (int i = 0; i < FIBERS; i++) {
        int r = (int)lround(hypot(i % SIDE + 0.5 - MIDDLE, i / SIDE + 0.5 - MIDDLE));
        profile[r] += (double)amounts[i];
        counts[r]++;
    }
    for (int r = 0; r < SIDE / 2; r++) {
        inside += r < radius / 2 ? profile[r] : 0;
        samples += r < radius / 2 ? counts[r] : 0;
    }
    inside /= samples;
    for (int r = (int)radius / 2; r < SIDE / 2; r++)
        most = fmax(most, profile[r] / counts[r]);
    for (int r = (int)radius / 2; r < SIDE / 2; r++)
        width += profile[r] / counts[r] > inside + 0.25 * (most - inside);
    *contrast = most / inside;
    return width;
}

/* The narrowest and the widest; with PAPER_TEST_FULL=1 those between, too. */
static void edges_are_as_wide_as_asked(void **state)
{
    (void)state;
    static const double widths[4] = {4, 8, 16, 32};
    for (int i = 0; i < 4; i++) {
        if (i % 3 && !all_sheets_wanted())
            continue;
        struct paper_sheet *sheet = sheet_new(1);
        struct paper_air air = paper_air_default();
        air.edge_width = widths[i];
        check(paper_sheet_air(sheet, &air));
        disc_put(sheet, SIDE, MIDDLE, MIDDLE, 80, (double[]){0.6, 0.4, 0});
        steps(sheet, 1000);
        pigment_read(sheet, 0, first);
        double contrast, band = band_width(first, 80, &contrast);
        paper_sheet_destroy(sheet);
        print_message("edges of %.0f are %.1f wide, contrast %.2f\n", widths[i], band,
                      contrast);
        assert_true(contrast > 1.15);
        assert_true(band >= 0.65 * widths[i] && band <= 1.3 * widths[i]);
    }
}

/* The share of the fibers with ink that are only partly full. */
static double gray_part(const float *amounts, double full)
{
    double ink = 0, gray = 0;
    for (int i = 0; i < FIBERS; i++) {
        ink += (double)amounts[i] > 0.05 * full;
        gray += (double)amounts[i] > 0.05 * full && (double)amounts[i] < 0.85 * full;
    }
    return gray / ink;
}

static void gray_edges_stay(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_new(2);
    /* strokes as wide as those of letters, 1.3 and 2.7 fibers, at all angles */
    for (int i = 0; i < 48; i++) {
        double x = 20 + 28 * (i % 8), y = 30 + 36 * (i / 8), angle = 0.13 * i,
               half = i % 2 ? 0.65 : 1.35, u = cos(angle), v = sin(angle);
        double corners[8] = {x - half * v,          y + half * u,
                             x + half * v,          y - half * u,
                             x + 20 * u + half * v, y + 20 * v - half * u,
                             x + 20 * u - half * v, y + 20 * v + half * u};
        struct paper_screen screen;
        int left, top;
        check(paper_polygon_screen(corners, 4, SIDE, SIDE, &screen, &left, &top));
        check(paper_sheet_put(sheet, &screen, left, top, (double[]){0.5, 0.6, 0}));
        paper_screen_destroy(&screen);
    }
    pigment_read(sheet, 0, first);
    double before = gray_part(first, 0.6), ink = 0, ink_after = 0;
    for (int i = 0; i < FIBERS; i++)
        ink += first[i] > 0.03f;
    steps(sheet, 200);
    pigment_read(sheet, 0, first);
    double after = gray_part(first, 0.6);
    for (int i = 0; i < FIBERS; i++)
        ink_after += first[i] > 0.03f;
    print_message(
        "type: gray part %.1f%%, after 200 steps %.1f%%, fibers with ink %.2f as many\n",
        100 * before, 100 * after, ink_after / ink);
    assert_true(after >= 0.8 * before);
    assert_true(ink_after < 1.25 * ink);
    paper_sheet_destroy(sheet);
}

/* A wash that fades, as a soft mask lays it: all of each fiber is wet, under less water. Where
 * only a part of each was, water closed over some fibers and drew in that of all around them:
 * clusters of them stood out. */
static void water_that_fades_stays_even(void **state)
{
    (void)state;
    static uint8_t gray[FIBERS];
    const struct paper_screen screen = {.width_px = SIDE, .height_px = SIDE, .gray = gray};
    struct paper_sheet *sheet = sheet_new(1);
    for (int i = 0; i < FIBERS; i++)
        gray[i] = (uint8_t)(255 - i % SIDE * 200 / SIDE);
    check(paper_sheet_put(sheet, &screen, 0, 0, (double[]){0.5, 0.5, 0}));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_WET_PART, 0, layer));
    double least = 1, rough = 0, depth = 0;
    for (int i = 0; i < FIBERS; i++)
        least = fmin(least, i % SIDE > 0 && i % SIDE < SIDE - 1 ? (double)layer[i] : 1);
    steps(sheet, 60);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_WATER, 0, layer));
    for (int y = 16; y < SIDE - 16; y++)
        for (int x = 16; x < SIDE - 16; x++) {
            const float *at = layer + y * SIDE + x;
            rough +=
                fabs((double)(at[0] - (at[-8] + at[8] + at[-8 * SIDE] + at[8 * SIDE]) / 4));
            depth += (double)at[0];
        }
    print_message(
        "water that fades: %.2f of each fiber is wet; its depth is uneven by %.1f%%\n", least,
        100 * rough / depth);
    assert_true(least > 0.95);
    assert_true(rough < 0.1 * depth);
    paper_sheet_destroy(sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(backrun_has_lobes),
        cmocka_unit_test(drop_in_water_is_no_disc),
        cmocka_unit_test(shapes_that_touch_run_into_each_other),
        cmocka_unit_test(ink_runs_along_fibers),
        cmocka_unit_test(drips_differ),
        cmocka_unit_test(edges_are_as_wide_as_asked),
        cmocka_unit_test(gray_edges_stay),
        cmocka_unit_test(water_that_fades_stays_even),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
