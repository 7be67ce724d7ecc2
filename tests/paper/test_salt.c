/* test_salt.c - the pale spots that salt leaves, on all stocks: how far their radius varies
 * around, and whether they have corners along the axes; large crystals last longer than small
 * ones. */
#include <paper.h>
#include <techniques.h>

#include "sheet_calls.h"
#include "sheets.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* As in test_techniques.c: the same kernels. A crystal lies in the middle. */
enum { WIDTH = 64, HEIGHT = 48, FIBERS = WIDTH * HEIGHT };
enum { RAYS = 90, SPECTRUM = 9, STOCKS = 7, STEPS = 250, AROUND = 20 };
#define TURN 6.283185307179586
#define MIDDLE_X (WIDTH / 2.0)
#define MIDDLE_Y (HEIGHT / 2.0)

static const char *const stocks[STOCKS] = {"cold press", "hot press", "rough",   "glass",
                                           "laid",       "xuan",      "blotting"};

static struct paper_sheet *sheet_make(const char *stock, uint64_t seed)
{
    struct paper_sheet_config config =
        sheet_of_curtis(WIDTH, HEIGHT, "quinacridone rose", "phthalo green");
    const struct paper_stock *found = paper_stock_find(stock);
    assert_non_null(found);
    config.stock = *found;
    config.seed = seed;
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    check(paper_sheet_wash(
        sheet, &(struct paper_wash){.amount = {0.7, 0.7, 0.1}, .end = {0.7, 0.7, 0.1}}));
    return sheet;
}

static void crystal(struct paper_sheet *sheet, uint64_t seed, double radius)
{
    check(paper_sheet_salt(sheet, &(struct paper_salt){.x = MIDDLE_X,
                                                       .y = MIDDLE_Y,
                                                       .grains = 1,
                                                       .size = {radius, radius},
                                                       .strength = 1,
                                                       .reach = 10,
                                                       .seed = seed}));
}

static void steps(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++)
        check(paper_sheet_step(sheet));
}

/* The paint of a wash with a crystal on it, when it has dried. */
static void spot(const char *stock, uint64_t seed, float *paint)
{
    struct paper_sheet *sheet = sheet_make(stock, seed);
    crystal(sheet, seed, 1.5);
    steps(sheet, STEPS);
    check(paper_sheet_dry(sheet));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_FIXED_PIGMENT, 0, paint));
    paper_sheet_destroy(sheet);
}

/* ---- a spot's rim ---- */

/* The mean of 3x3 fibers. */
static double paint_at(const float *paint, double x, double y)
{
    double sum = 0;
    for (int j = -1; j < 2; j++)
        for (int i = -1; i < 2; i++)
            sum += (double)paint[((int)floor(y) + j) * WIDTH + (int)floor(x) + i] / 9;
    return sum;
}

/* The mean of the wash far from the crystal. */
static double wash_around(const float *paint)
{
    double sum = 0, count = 0;
    for (int i = 0; i < FIBERS; i++) {
        const double away = hypot(i % WIDTH + 0.5 - MIDDLE_X, i / WIDTH + 0.5 - MIDDLE_Y);
        sum += away > AROUND ? (double)paint[i] : 0;
        count += away > AROUND;
    }
    return sum / count;
}

/* The middle of what has less than so much paint around the crystal. */
static void pale_middle(const float *paint, double less, double middle[2])
{
    double sum[3] = {0};
    for (int j = -AROUND; j < AROUND; j++)
        for (int i = -AROUND; i < AROUND; i++) {
            const double x = MIDDLE_X + i + 0.5, y = MIDDLE_Y + j + 0.5;
            if (hypot(i + 0.5, j + 0.5) > AROUND || paint_at(paint, x, y) >= less)
                continue;
            sum[0] += x;
            sum[1] += y;
            sum[2]++;
        }
    assert_true(sum[2] > 0);
    middle[0] = sum[0] / sum[2];
    middle[1] = sum[1] / sum[2];
}

/* Radii around the spot's middle: where there is half of the wash's paint for the first time.
 * Returns their mean. */
static double rim(const float *paint, double radius[RAYS])
{
    const double half = wash_around(paint) / 2;
    double mean = 0, middle[2];
    pale_middle(paint, half, middle);
    for (int k = 0; k < RAYS; k++) {
        const double c = cos(TURN * k / RAYS), s = sin(TURN * k / RAYS);
        double far = 0;
        while (far < AROUND && fabs(middle[1] + far * s - MIDDLE_Y) < MIDDLE_Y - 2 &&
               paint_at(paint, middle[0] + far * c, middle[1] + far * s) < half)
            far += 0.125;
        radius[k] = far;
        mean += far / RAYS;
    }
    return mean;
}

/* Adds the spectrum of the radius around, relative to its mean squared; returns the radius's
 * deviation, relative to its mean. */
static double rim_power(const double radius[RAYS], double mean, double power[SPECTRUM])
{
    double squares = 0;
    for (int k = 0; k < RAYS; k++)
        squares += (radius[k] / mean - 1) * (radius[k] / mean - 1) / RAYS;
    for (int n = 1; n < SPECTRUM; n++) {
        double x = 0, y = 0;
        for (int k = 0; k < RAYS; k++) {
            x += radius[k] * cos(TURN * n * k / RAYS);
            y += radius[k] * sin(TURN * n * k / RAYS);
        }
        power[n] += 2 * (x * x + y * y) / RAYS / RAYS / mean / mean;
    }
    return sqrt(squares);
}

static void spots_are_ragged(void **state)
{
    (void)state;
    static float paint[FIBERS];
    const int seeds = all_sheets_wanted() ? 20 : 3;
    double power[SPECTRUM] = {0}, all = 0;
    for (int i = 0; i < STOCKS; i++) {
        double off = 0, wide = 0, radius[RAYS];
        for (int seed = 1; seed <= seeds; seed++) {
            spot(stocks[i], (uint64_t)(100 * i + seed), paint);
            const double mean = rim(paint, radius);
            assert_true(mean > 1);
            off += rim_power(radius, mean, power) / seeds;
            wide += mean / seeds;
        }
        print_message("%s: radius %.1f fibers, varies by %.0f%%\n", stocks[i], wide, 100 * off);
        assert_true(wide > 3);
        assert_true(off >= 0.14);
        all += off / STOCKS;
    }
    const double corners = power[4] / (power[3] + power[5]) * 2;
    print_message("all: %.0f%%; power at 4 around: %.2f of that at 3 and 5\n", 100 * all,
                  corners);
    assert_true(all >= 0.2);
    assert_true(corners < 1.5);
}

/* What is left of a crystal after some steps. */
static double left_of(double radius, uint64_t seed)
{
    static float salt[FIBERS];
    struct paper_sheet *sheet = sheet_make("cold press", 1);
    double sum[2] = {0};
    crystal(sheet, seed, radius);
    for (int later = 0; later < 2; later++) {
        steps(sheet, 200 * later);
        check(paper_sheet_layer_read(sheet, PAPER_LAYER_SALT, 0, salt));
        for (int i = 0; i < FIBERS; i++)
            sum[later] += (double)salt[i];
    }
    paper_sheet_destroy(sheet);
    return sum[1] / sum[0];
}

/* A crystal dissolves from its rim: a large one lasts longer than a small one. */
static void large_crystals_last_longer(void **state)
{
    (void)state;
    const double small = left_of(0.7, 1), large = left_of(3, 1);
    print_message("of a small crystal %.0f%% is left, of a large one %.0f%%\n", 100 * small,
                  100 * large);
    assert_true(large < 0.95 && small < 0.85 * large);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(spots_are_ragged),
                                       cmocka_unit_test(large_crystals_last_longer)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
