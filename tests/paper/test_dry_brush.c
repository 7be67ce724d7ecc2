/* test_dry_brush.c - marks of tooth and hand: what a brush that runs dry leaves bare, flakes of
 * the paper's tooth, not of its clouds; gaps between its hairs that open and close; and where
 * a wet brush's strokes begin and end. */
#include <brush.h>
#include <paper.h>

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

enum { WIDTH = 256, HEIGHT = 128, FIBERS = WIDTH * HEIGHT };
/* Inside the stroke. */
enum { LEFT = 44, TOP = 42, WIDE = 176, HIGH = 44, INSIDE = WIDE * HIGH };

static struct paper_sheet *sheet_make(const char *stock, uint64_t seed)
{
    struct paper_sheet_config config =
        sheet_of_curtis(WIDTH, HEIGHT, "burnt umber", "phthalo green");
    const struct paper_stock *found = paper_stock_find(stock);
    assert_non_null(found);
    config.stock = *found;
    config.seed = seed;
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    return sheet;
}

/* paint = what a quick stroke of a wide flat brush leaves inside, with so much water in it, to
 * the mean of the fibers with any. */
static void stroke(struct paper_sheet *sheet, double water, uint64_t seed, float *paint)
{
    static float all[FIBERS];
    struct paper_brush brush = paper_brush_default();
    brush.width = 62;
    assert_true(paper_brush_of_kind(&brush, "flat"));
    brush.follows = true;
    brush.load = 0.2;
    brush.reach = 900;
    brush.seed = seed;
    check(paper_sheet_brush(sheet, &brush));
    check(paper_sheet_dip(
        sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {water, 0.9, 0}}));
    const struct paper_stroke_sample line[2] = {
        {.x = 16, .y = 64, .pressure = 0.6},
        {.time_s = 0.2, .x = WIDTH - 16, .y = 64, .pressure = 0.4}};
    check(paper_sheet_stroke(
        sheet, &(struct paper_stroke){.pace = 60, .samples_count = 2, .samples = line}, NULL));
    check(paper_sheet_dry(sheet));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_FIXED_PIGMENT, 0, all));
    double sum = 0, count = 0;
    for (int i = 0; i < INSIDE; i++) {
        paint[i] = all[(TOP + i / WIDE) * WIDTH + LEFT + i % WIDE];
        sum += (double)paint[i];
        count += paint[i] > 0;
    }
    for (int i = 0; i < INSIDE; i++)
        paint[i] = (float)((double)paint[i] * count / fmax(sum, 1e-9));
}

/* ---- flakes ---- */

static int larger_first(const void *a, const void *b)
{
    return *(const int *)b - *(const int *)a;
}

/* Takes the flake that fiber `at` is in from bare[]; returns its area. */
static int flake_take(uint8_t bare[INSIDE], int at)
{
    static int stack[INSIDE];
    int depth = 0, area = 0;
    stack[depth++] = at;
    bare[at] = 0;
    while (depth > 0) {
        const int here = stack[--depth], x = here % WIDE, y = here / WIDE;
        const int next[4] = {x > 0 ? here - 1 : here, x < WIDE - 1 ? here + 1 : here,
                             y > 0 ? here - WIDE : here, y < HIGH - 1 ? here + WIDE : here};
        area++;
        for (int k = 0; k < 4; k++)
            if (bare[next[k]]) {
                bare[next[k]] = 0;
                stack[depth++] = next[k];
            }
    }
    return area;
}

/* Half of the bare area lies in flakes of so many fibers or more; *part: how much is bare. */
static int flake_usual(const float *paint, double *part)
{
    static uint8_t bare[INSIDE];
    static int flakes[INSIDE];
    int count = 0, area = 0, sum = 0, i = 0;
    for (int at = 0; at < INSIDE; at++)
        bare[at] = paint[at] < 0.15f;
    for (int at = 0; at < INSIDE; at++)
        if (bare[at])
            area += flakes[count++] = flake_take(bare, at);
    *part = (double)area / INSIDE;
    qsort(flakes, (size_t)count, sizeof *flakes, larger_first);
    while (i < count && 2 * (sum + flakes[i]) < area)
        sum += flakes[i++];
    return count > 0 ? flakes[i] : 0;
}

/* Half of what is bare lies in flakes of up to FLAKE_MOST fibers, where so much to a third is
 * bare: less on smooth paper, which a brush as dry covers better. */
static const struct toothed {
    const char *stock;
    double bare;
} toothed[] = {{"rough", 0.1},      {"cold press", 0.1}, {"laid", 0.1},
               {"hot press", 0.05}, {"blotting", 0.05},  {"xuan", 0.05}};
#define FLAKE_MOST 60
enum { TOOTHED = sizeof toothed / sizeof *toothed, USUALLY = 4 };

static void flakes_are_of_the_tooth(void **state)
{
    (void)state;
    static float paint[INSIDE];
    const bool all = all_sheets_wanted();
    for (const struct toothed *on = toothed; on < toothed + (all ? TOOTHED : USUALLY); on++)
        for (uint64_t seed = 1; seed <= (all ? 20 : 1); seed++) {
            int seen = 0;
            for (int i = all ? 0 : 2; i < 4; i++) {
                struct paper_sheet *sheet = sheet_make(on->stock, seed);
                double part;
                stroke(sheet, 0.2 - 0.05 * i, seed, paint);
                const int flake = flake_usual(paint, &part);
                print_message("%s, sheet %d: %.0f%% bare, half of it in flakes of %d or more\n",
                              on->stock, (int)seed, 100 * part, flake);
                if (part > on->bare && part < 0.33) {
                    seen++;
                    assert_true(flake <= FLAKE_MOST);
                }
                paper_sheet_destroy(sheet);
            }
            assert_true(seen > 0);
        }
}

/* ---- gaps ---- */

/* How alike the profiles across two parts of a stroke are that lie `apart` fibers along it: the
 * correlation of means over 12 fibers, less what is wider than 9 across. */
static double profiles_alike(const float *paint, int from, int apart)
{
    double profile[2][HIGH] = {{0}}, fine[2][HIGH], sum[5] = {0};
    for (int k = 0; k < 2; k++)
        for (int y = 0; y < HIGH; y++)
            for (int x = 0; x < 12; x++)
                profile[k][y] += (double)paint[y * WIDE + from + k * apart + x] / 12;
    const int first = 4, last = HIGH - 4;
    for (int k = 0; k < 2; k++)
        for (int y = first; y < last; y++) {
            fine[k][y] = profile[k][y];
            for (int j = -4; j <= 4; j++)
                fine[k][y] -= profile[k][y + j] / 9;
        }
    for (int y = first; y < last; y++) {
        const double a = fine[0][y], b = fine[1][y], terms[5] = {a, b, a * a, b * b, a * b};
        for (int i = 0; i < 5; i++)
            sum[i] += terms[i] / (last - first);
    }
    return (sum[4] - sum[0] * sum[1]) /
           sqrt((sum[2] - sum[0] * sum[0]) * (sum[3] - sum[1] * sum[1]));
}

/* Streaks go on for some way, and not all along a stroke: on a smooth film, where no tooth
 * parts them. */
static void gaps_open_and_close(void **state)
{
    (void)state;
    static float paint[INSIDE];
    double near = 0, far = 0, count = 0;
    for (uint64_t seed = 1; seed <= (all_sheets_wanted() ? 20 : 2); seed++) {
        struct paper_sheet *sheet = sheet_make("glass", seed);
        stroke(sheet, 0.5, seed, paint);
        for (int from = 0; from + 100 < WIDE - 12; from += 16, count++) {
            near += profiles_alike(paint, from, 12);
            far += profiles_alike(paint, from, 100);
        }
        paper_sheet_destroy(sheet);
    }
    print_message("profiles 12 fibers apart are alike by %.2f, 100 apart by %.2f\n",
                  near / count, far / count);
    assert_true(near / count > 0.5);
    assert_true(far / count < 0.5);
}

/* ---- ends ---- */

/* A wide wet mop's stroke along x, dried at once; in all: its paint. */
static void mop_stroke(struct paper_sheet *sheet, uint64_t seed, float all[FIBERS])
{
    struct paper_brush brush = paper_brush_default();
    brush.width = 70;
    assert_true(paper_brush_of_kind(&brush, "mop"));
    brush.seed = seed;
    check(paper_sheet_brush(sheet, &brush));
    check(paper_sheet_dip(
        sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {1, 0.8, 0}}));
    const struct paper_stroke_sample line[2] = {
        {.x = 80, .y = 64, .pressure = 0.8},
        {.time_s = 0.25, .x = WIDTH - 60, .y = 64, .pressure = 0.8}};
    check(paper_sheet_stroke(
        sheet, &(struct paper_stroke){.pace = 60, .samples_count = 2, .samples = line}, NULL));
    check(paper_sheet_dry(sheet));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_FIXED_PIGMENT, 0, all));
}

/* How far a stroke's end is off a smooth one, RMS: in each row the first fiber with paint, by
 * the mean of those 4 rows before and behind. The last fibers, if `last`. */
static double teeth(const float *all, bool last)
{
    enum { FIRST = 40, ROWS = 48, APART = 4 };
    double at[ROWS], sum = 0;
    for (int i = 0; i < ROWS; i++) {
        int x = 0;
        while (x < WIDTH - 1 &&
               !((double)all[(FIRST + i) * WIDTH + (last ? WIDTH - 1 - x : x)] > 0.02))
            x++;
        at[i] = x;
    }
    for (int i = APART; i < ROWS - APART; i++) {
        const double off = at[i] - (at[i - APART] + at[i + APART]) / 2;
        sum += off * off;
    }
    return sqrt(sum / (ROWS - 2 * APART));
}

/* Of a wet mop; with single hairs that are set down one by one they have teeth of 4 fibers or
 * more. */
static void wet_strokes_begin_and_end_in_no_combs(void **state)
{
    (void)state;
    static float all[FIBERS];
    static const char *const stocks[] = {"cold press", "hot press", "rough",   "laid",
                                         "glass",      "xuan",      "blotting"};
    const bool many = all_sheets_wanted();
    for (size_t i = 0; i < (many ? sizeof stocks / sizeof *stocks : 2); i++) {
        double begins = 0, ends = 0;
        const int seeds = many ? 20 : 2;
        for (int seed = 1; seed <= seeds; seed++) {
            struct paper_sheet *sheet = sheet_make(stocks[i], (uint64_t)seed);
            mop_stroke(sheet, (uint64_t)seed, all);
            begins += teeth(all, false) / seeds;
            ends += teeth(all, true) / seeds;
            paper_sheet_destroy(sheet);
        }
        print_message("%s: a mop's stroke begins with teeth of %.1f fibers, ends with %.1f\n",
                      stocks[i], begins, ends);
        assert_true(begins < 2);
        assert_true(ends < 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(flakes_are_of_the_tooth),
                                       cmocka_unit_test(gaps_open_and_close),
                                       cmocka_unit_test(wet_strokes_begin_and_end_in_no_combs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
