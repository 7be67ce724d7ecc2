/* test_salt.c - the pale spots that salt leaves, on all stocks: how far their radius varies
 * around, whether they have corners along the axes, and whether dark lines as thin as a fiber
 * lie around them; large crystals last longer than small ones. */
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

/* Eight crystals lie in the middles of eight parts of a sheet. */
enum { PART_WIDE = 64, PART_HIGH = 48, WIDTH = 4 * PART_WIDE, HEIGHT = 2 * PART_HIGH };
enum { FIBERS = WIDTH * HEIGHT, PARTS = 8 };
enum { RAYS = 90, SPECTRUM = 9, STOCKS = 7, STOCKS_SIZED = 5, STEPS = 200, AROUND = 20 };
#define TURN 6.283185307179586
#define LINE 0.4 /* of the wash's paint, that a fiber in a line has more than others */
/* Of the fibers around a spot, more than far from it: on paper that is sized or smooth, and on
 * other paper. */
#define LINES_MOST 0.04
#define LINES_UNSIZED 0.08

static const char *const stocks[STOCKS] = {"cold press", "hot press", "rough",   "glass",
                                           "laid",       "xuan",      "blotting"};

static double middle_x(int part)
{
    return (part % 4 + 0.5) * PART_WIDE;
}

static double middle_y(int part)
{
    return (part / 4 + 0.5) * PART_HIGH;
}

static int part_of(int fiber)
{
    return fiber / WIDTH / PART_HIGH * 4 + fiber % WIDTH / PART_WIDE;
}

/* How far a fiber is from the crystal of its part. */
static double away_of(int fiber)
{
    const int part = part_of(fiber);
    return hypot(fiber % WIDTH + 0.5 - middle_x(part), fiber / WIDTH + 0.5 - middle_y(part));
}

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

static void crystal(struct paper_sheet *sheet, int part, uint64_t seed, double radius)
{
    check(paper_sheet_salt(sheet, &(struct paper_salt){.x = middle_x(part),
                                                       .y = middle_y(part),
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

/* The paint of a wash with crystals on it, when it has dried. */
static void spots(const char *stock, uint64_t seed, float *paint)
{
    struct paper_sheet *sheet = sheet_make(stock, seed);
    for (int part = 0; part < PARTS; part++)
        crystal(sheet, part, PARTS * seed + (uint64_t)part, 1.5);
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
static double wash_around(const float *paint, int part)
{
    double sum = 0, count = 0;
    for (int i = 0; i < FIBERS; i++) {
        const bool far = part_of(i) == part && away_of(i) > AROUND;
        sum += far ? (double)paint[i] : 0;
        count += far;
    }
    return sum / count;
}

/* The middle of what has less than so much paint around the crystal. */
static void pale_middle(const float *paint, int part, double less, double middle[2])
{
    double sum[3] = {0};
    for (int j = -AROUND; j < AROUND; j++)
        for (int i = -AROUND; i < AROUND; i++) {
            const double x = middle_x(part) + i + 0.5, y = middle_y(part) + j + 0.5;
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
static double rim(const float *paint, int part, double radius[RAYS])
{
    const double half = wash_around(paint, part) / 2, most = PART_HIGH / 2 - 2;
    double mean = 0, middle[2];
    pale_middle(paint, part, half, middle);
    for (int k = 0; k < RAYS; k++) {
        const double c = cos(TURN * k / RAYS), s = sin(TURN * k / RAYS);
        double far = 0;
        while (far < AROUND && fabs(middle[1] + far * s - middle_y(part)) < most &&
               paint_at(paint, middle[0] + far * c, middle[1] + far * s) < half)
            far += 0.125;
        radius[k] = far;
        mean += far / RAYS;
    }
    return mean;
}

/* How much more a fiber has than both that are two away on a line through it, on the line where
 * that is most. */
static double ridge_at(const float *at)
{
    static const int beside[4] = {2, 2 * WIDTH, 2 * WIDTH + 2, 2 * WIDTH - 2};
    double most = -1;
    for (int k = 0; k < 4; k++)
        most = fmax(most, (double)(*at - fmaxf(at[beside[k]], at[-beside[k]])));
    return most;
}

/* The share of fibers, around the crystal or far from it, that stand out by LINE of the wash: a
 * line as thin as a fiber looks drawn. */
static double lines_share(const float *paint, int part, bool far)
{
    const double least = LINE * wash_around(paint, part);
    double dark = 0, count = 0;
    for (int i = 0; i < FIBERS; i++) {
        const double x = fabs(i % WIDTH + 0.5 - middle_x(part)),
                     y = fabs(i / WIDTH + 0.5 - middle_y(part));
        if (x > PART_WIDE / 2 - 2 || y > PART_HIGH / 2 - 2 || (hypot(x, y) > AROUND) != far)
            continue;
        dark += ridge_at(paint + i) > least;
        count++;
    }
    return dark / count;
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

static void spots_are_lobed_and_have_no_lines(void **state)
{
    (void)state;
    static float paint[FIBERS];
    const int sheets = all_sheets_wanted() ? 3 : 1;
    double power[SPECTRUM] = {0}, all = 0;
    for (int i = 0; i < STOCKS; i++) {
        double off = 0, wide = 0, lines[2] = {0}, radius[RAYS];
        for (int seed = 1; seed <= sheets; seed++) {
            spots(stocks[i], (uint64_t)(100 * i + seed), paint);
            for (int part = 0; part < PARTS; part++) {
                const double mean = rim(paint, part, radius);
                assert_true(mean > 1);
                off += rim_power(radius, mean, power) / PARTS / sheets;
                wide += mean / PARTS / sheets;
                for (int far = 0; far < 2; far++)
                    lines[far] += lines_share(paint, part, far) / PARTS / sheets;
            }
        }
        print_message("%s: radius %.1f fibers, varies by %.0f%%; %.2f%% of the fibers around "
                      "are in lines, far off %.2f%%\n",
                      stocks[i], wide, 100 * off, 100 * lines[0], 100 * lines[1]);
        assert_true(wide > 3);
        assert_true(off >= 0.14);
        assert_true(lines[0] < lines[1] + (i < STOCKS_SIZED ? LINES_MOST : LINES_UNSIZED));
        all += off / STOCKS;
    }
    const double corners = power[4] / (power[3] + power[5]) * 2;
    print_message("all: %.0f%%; power at 4 around: %.2f of that at 3 and 5\n", 100 * all,
                  corners);
    assert_true(all >= 0.19);
    assert_true(corners < 1.5);
}

/* A crystal dissolves from its rim: a large one lasts longer than a small one. */
static void large_crystals_last_longer(void **state)
{
    (void)state;
    static float salt[FIBERS];
    static const double radius[2] = {0.7, 3};
    double left[2][2] = {{0}};
    struct paper_sheet *sheet = sheet_make("cold press", 1);
    for (int large = 0; large < 2; large++)
        crystal(sheet, 7 * large, 1, radius[large]);
    for (int later = 0; later < 2; later++) {
        steps(sheet, 100 * later);
        check(paper_sheet_layer_read(sheet, PAPER_LAYER_SALT, 0, salt));
        for (int i = 0; i < FIBERS; i++)
            left[part_of(i) / 4][later] += (double)salt[i];
    }
    paper_sheet_destroy(sheet);
    const double small = left[0][1] / left[0][0], large = left[1][1] / left[1][0];
    print_message("of a small crystal %.0f%% is left, of a large one %.0f%%\n", 100 * small,
                  100 * large);
    assert_true(large < 0.95 && small < 0.85 * large);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(spots_are_lobed_and_have_no_lines),
                                       cmocka_unit_test(large_crystals_last_longer)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
