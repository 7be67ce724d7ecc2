/* test_running.c - water that runs down a sheet that leans: few spots stay dry in its way, it
 * comes together to rivulets, and these end in beads, darker than what they come from. */
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

enum { SIDE = 280, FIBERS = SIDE * SIDE, SEEDS = 4 };
enum { MIDDLE_Y = 90, HALF_X = 70, HALF_Y = 60 };
enum { ISLAND = 10 }; /* fibers, of those that count */
#define PAINTED 0.03  /* units of both pigments */
#define TURN 6.283185307179586

static float amounts[2][FIBERS], layer[FIBERS];
static uint8_t painted[FIBERS];

static void pigments_read(struct paper_sheet *sheet)
{
    static const enum paper_layer layers[3] = {
        PAPER_LAYER_SURFACE_PIGMENT, PAPER_LAYER_INFUSED_PIGMENT, PAPER_LAYER_FIXED_PIGMENT};
    memset(amounts, 0, sizeof amounts);
    for (int pigment = 0; pigment < 2; pigment++)
        for (int i = 0; i < 3; i++) {
            check(paper_sheet_layer_read(sheet, layers[i], pigment, layer));
            for (int j = 0; j < FIBERS; j++)
                amounts[pigment][j] += layer[j];
        }
    for (int j = 0; j < FIBERS; j++)
        painted[j] = (double)(amounts[0][j] + amounts[1][j]) > PAINTED;
}

/* A puddle in two paints runs 900 steps on a sheet of the stock that leans by 17 degrees. */
static void puddle_run(const char *stock, uint64_t seed)
{
    struct paper_sheet_config config =
        sheet_of_curtis(SIDE, SIDE, "quinacridone rose", "french ultramarine");
    config.stock = *paper_stock_find(stock);
    config.seed = seed;
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    struct paper_air air = paper_air_default();
    air.gravity[1] = 0.3;
    check(paper_sheet_air(sheet, &air));
    enum { CORNERS = 64 };
    double corners[2 * CORNERS];
    for (int i = 0; i < CORNERS; i++) {
        corners[2 * i] = SIDE / 2.0 + HALF_X * cos(TURN * i / CORNERS);
        corners[2 * i + 1] = MIDDLE_Y + HALF_Y * sin(TURN * i / CORNERS);
    }
    polygon_put(sheet, SIDE, corners, CORNERS, (double[]){2, 0.5, 0.4});
    for (int i = 0; i < 900; i++)
        check(paper_sheet_step(sheet));
    check(paper_sheet_dry(sheet));
    pigments_read(sheet);
    paper_sheet_destroy(sheet);
}

/* The fibers of the bare place that i is in, which are marked; *open: it is at the sheet's
 * edge. */
static int bare_fill(int i, bool *open)
{
    static int todo[FIBERS];
    int count = 0, left = 0;
    todo[left++] = i;
    painted[i] = 2;
    while (left) {
        const int at = todo[--left], x = at % SIDE, y = at / SIDE;
        count++;
        *open = *open || x == 0 || y == 0 || x == SIDE - 1 || y == SIDE - 1;
        static const int steps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
        for (int k = 0; k < 4; k++) {
            const int u = x + steps[k][0], v = y + steps[k][1];
            if (u >= 0 && v >= 0 && u < SIDE && v < SIDE && !painted[v * SIDE + u]) {
                painted[v * SIDE + u] = 2;
                todo[left++] = v * SIDE + u;
            }
        }
    }
    return count;
}

static int islands_count(void)
{
    int islands = 0;
    for (int i = 0; i < FIBERS; i++) {
        bool open = false;
        if (!painted[i] && bare_fill(i, &open) >= ISLAND && !open)
            islands++;
    }
    return islands;
}

struct ends {
    double dark, /* paint in the last fibers of what ran, to that of the puddle */
        rose;    /* ... the part of it that is rose, to the puddle's */
};

/* Columns whose paint ends well below the puddle. */
static struct ends ends_measure(void)
{
    enum { LAST = 12, FROM = MIDDLE_Y + HALF_Y + 12 };
    double sum[2] = {0}, puddle[2] = {0}, count = 0, inside = 0;
    for (int x = 2; x < SIDE - 2; x++) {
        int low = 0;
        for (int y = 0; y < SIDE - 3; y++)
            low = painted[y * SIDE + x] == 1 ? y : low;
        for (int y = low - LAST + 1; low > FROM && y <= low; y++, count++)
            for (int k = 0; k < 2; k++)
                sum[k] += (double)amounts[k][y * SIDE + x];
    }
    for (int y = MIDDLE_Y - HALF_Y / 2; y < MIDDLE_Y; y++)
        for (int x = SIDE / 2 - HALF_X / 2; x < SIDE / 2 + HALF_X / 2; x++, inside++)
            for (int k = 0; k < 2; k++)
                puddle[k] += (double)amounts[k][y * SIDE + x];
    const double all = sum[0] + sum[1], there = puddle[0] + puddle[1];
    if (count == 0)
        return (struct ends){1, 1};
    return (struct ends){all / count / (there / inside), sum[0] / all / (puddle[0] / there)};
}

static void running_water_keeps_together(void **state)
{
    (void)state;
    /* not those without size: they drink, and islands stay */
    static const char *const stocks[] = {"cold press", "rough", "hot press", "laid", "glass"};
    const bool all = all_sheets_wanted();
    for (size_t i = 0; i < (all ? sizeof stocks / sizeof *stocks : 1); i++) {
        const int seeds = SEEDS;
        double islands = 0, dark = 0, rose = 0;
        int most = 0;
        for (int seed = 1; seed <= seeds; seed++) {
            puddle_run(stocks[i], (uint64_t)seed);
            const struct ends ends = ends_measure();
            const int here = islands_count();
            islands += (double)here / seeds;
            most = here > most ? here : most;
            dark += ends.dark / seeds;
            rose += ends.rose / seeds;
        }
        print_message("%-10s %d sheets: %.1f islands of %d fibers or more, at most %d; ends "
                      "%.2f as dark as the puddle, rose %.2f of its part\n",
                      stocks[i], seeds, islands, ISLAND, most, dark, rose);
        assert_true(islands <= 2);
        assert_true(dark >= 1.5);
        assert_true(rose >= 0.85);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(running_water_keeps_together)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
