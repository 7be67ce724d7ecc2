/* test_ink.c - a drop of ink on paper without size: water runs ahead of it, and both come to
 * branches some fibers wide. */
#include <paper.h>
#include <sheet.h>

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

enum { SIDE = 208, FIBERS = SIDE * SIDE, RADIUS = 40, STEPS = 1000, SEEDS = 20 };
enum { PER_FIBER = 4, PLACES_MOST = PER_FIBER * 4 * SIDE };

/* What is wet, or inked, as seen on circles around the drop's middle. */
struct front {
    double reach;  /* the largest circle of which a tenth is, in radii of the drop */
    double length; /* of branches: from the largest circle of which nine tenths are to that */
    double width;  /* the median of what the circle crosses of which a quarter is */
};

static int circle_of(const float *amount, double from, double radius, bool places[PLACES_MOST])
{
    const int count = (int)(2 * M_PI * radius * PER_FIBER);
    for (int i = 0; i < count; i++) {
        const double angle = 2 * M_PI * i / count;
        const int x = (int)(SIDE / 2 + radius * cos(angle)),
                  y = (int)(SIDE / 2 + radius * sin(angle));
        places[i] = (double)amount[y * SIDE + x] > from;
    }
    return count;
}

static double share_of(const bool *places, int count)
{
    int of = 0;
    for (int i = 0; i < count; i++)
        of += places[i];
    return (double)of / count;
}

/* The largest circle of which so much is. */
static double circle_find(const float *amount, double from, double share)
{
    static bool places[PLACES_MOST];
    double found = 0;
    for (double radius = RADIUS / 2.0; radius < SIDE / 2 - 2; radius++)
        if (share_of(places, circle_of(amount, from, radius, places)) >= share)
            found = radius;
    return found;
}

static int ascending(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

static double width_median(const float *amount, double from, double radius)
{
    static bool places[PLACES_MOST];
    static int runs[PLACES_MOST];
    const int count = circle_of(amount, from, radius, places);
    int first = 0, found = 0;
    while (first < count && places[first])
        first++;
    for (int i = 0; i < count;) {
        int run = 0;
        while (i + run < count && places[(first + i + run) % count])
            run++;
        if (run >= PER_FIBER) /* else it crosses the corner of a fiber */
            runs[found++] = run;
        i += run + 1;
    }
    assert_true(found > 0);
    qsort(runs, (size_t)found, sizeof *runs, ascending);
    return (double)runs[found / 2] / PER_FIBER;
}

static struct front front_of(const float *amount, double from)
{
    const double outer = circle_find(amount, from, 0.1);
    return (struct front){
        .reach = outer / RADIUS,
        .length = outer - circle_find(amount, from, 0.9),
        .width = width_median(amount, from, circle_find(amount, from, 0.25)),
    };
}

static void fronts_find(const char *stock, uint64_t seed, struct front *water,
                        struct front *ink)
{
    static float amount[FIBERS], layer[FIBERS];
    static const enum paper_layer layers[] = {
        PAPER_LAYER_SURFACE_PIGMENT, PAPER_LAYER_INFUSED_PIGMENT, PAPER_LAYER_FIXED_PIGMENT};
    struct paper_sheet_config config = sheet_of_two(SIDE, SIDE, "lamp black", "burnt umber");
    struct paper_sheet *sheet;
    config.stock = *paper_stock_find(stock);
    config.seed = seed;
    config.pigments[0].weight[0] = config.pigments[0].weight[1] = 0.5;
    check(paper_sheet_create(&config, &sheet));
    disc_put(sheet, SIDE, SIDE / 2.0, SIDE / 2.0, RADIUS, (double[]){2, 0.6, 0});
    for (int i = 0; i < STEPS; i++)
        check(paper_sheet_step(sheet));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_INFUSED_WATER, 0, amount));
    *water = front_of(amount, 0.02);
    memset(amount, 0, sizeof amount);
    for (size_t j = 0; j < sizeof layers / sizeof *layers; j++) {
        check(paper_sheet_layer_read(sheet, layers[j], 0, layer));
        for (int i = 0; i < FIBERS; i++)
            amount[i] += layer[i];
    }
    *ink = front_of(amount, 0.03);
    paper_sheet_destroy(sheet);
}

/* One sheet; with PAPER_TEST_FULL=1 twenty. */
static void ink_branches(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= (all_sheets_wanted() ? SEEDS : 1); seed++) {
        struct front water, ink;
        fronts_find("xuan", seed, &water, &ink);
        print_message("xuan %d: water comes to %.2f r, ink to %.2f r; its branches are %.0f "
                      "fibers long and %.1f wide, those of water %.0f and %.1f\n",
                      (int)seed, water.reach, ink.reach, ink.length, ink.width, water.length,
                      water.width);
        assert_true(water.reach >= 1.5);
        assert_true(ink.reach >= 1.3 && ink.reach < water.reach - 0.1);
        assert_true(ink.length >= 10 && ink.length <= 40);
        assert_true(ink.width >= 2 && ink.width <= 5);
    }
}

/* Sized paper keeps a drop where it was put. */
static void sized_paper_holds_ink(void **state)
{
    (void)state;
    struct front water, ink;
    fronts_find("hot press", 1, &water, &ink);
    print_message(
        "hot press: water comes to %.2f r, ink to %.2f r, its edge is %.0f fibers deep\n",
        water.reach, ink.reach, ink.length);
    assert_true(water.reach < 1.3 && ink.reach < 1.3 && ink.length < 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ink_branches),
        cmocka_unit_test(sized_paper_holds_ink),
    };
    return cmocka_run_group_tests_name("ink", tests, NULL, NULL);
}
