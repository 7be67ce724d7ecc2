/* test_edges.c - edges of paint: they stay gray as they were put, however dark a line gathers
 * there; what part of a fiber is stained. */
#include <brush.h>
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

/* A bar as wide as the sheet, at 10 degrees: its upper edge at x, and how many fibers wide it
 * is. */
enum { WIDTH = 240, HEIGHT = 128, FIBERS = WIDTH * HEIGHT, FROM = 24, BAR = 34 };
#define SLOPE 0.177

static double edge_at(double x, double top)
{
    return top + SLOPE * x;
}

static struct paper_sheet *sheet_make(const char *stock)
{
    struct paper_sheet_config config =
        sheet_of_curtis(WIDTH, HEIGHT, "phthalo green", "burnt umber");
    config.stock = *paper_stock_find(stock);
    config.seed = 5;
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    return sheet;
}

/* Also wide enough that the bar's ends do not count. */
static void bar_put(struct paper_sheet *sheet, double top)
{
    const double left = 12, right = WIDTH - 12;
    const double corners[] = {
        left,  edge_at(left, top),        right, edge_at(right, top),
        right, edge_at(right, top) + BAR, left,  edge_at(left, top) + BAR};
    struct paper_screen screen;
    int x, y;
    check(paper_polygon_screen(corners, 4, WIDTH, HEIGHT, &screen, &x, &y));
    check(paper_sheet_put(sheet, &screen, x, y, (double[]){0.4, 0.6, 0}));
    paper_screen_destroy(&screen);
}

static void stroke_paint(struct paper_sheet *sheet, double x1, double y1, double x2, double y2,
                         double width)
{
    struct paper_brush brush = paper_brush_default();
    brush.flat = brush.follows = true;
    brush.width = width;
    brush.depth = 0.22 * width;
    brush.bristles = (int)fmin(PAPER_BRISTLES_MAX, 7 * width);
    brush.thickness = fmax(1.2, 0.06 * width);
    brush.reach = 5000;
    check(paper_sheet_brush(sheet, &brush));
    check(paper_sheet_dip(
        sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {0.8, 0.6}}));
    const struct paper_stroke_sample samples[2] = {
        {.time_s = 0, .x = x1, .y = y1, .pressure = 0.7},
        {.time_s = 0.4, .x = x2, .y = y2, .pressure = 0.7}};
    check(paper_sheet_stroke(
        sheet, &(struct paper_stroke){.pace = 30, .samples_count = 2, .samples = samples},
        NULL));
}

static void steps(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++)
        check(paper_sheet_step(sheet));
}

/* In which part of the columns the upper edge has a gray fiber, by the density of red, which
 * the green absorbs most. */
static double gray_part(struct paper_sheet *sheet, double top)
{
    static uint16_t rgb[3 * FIBERS];
    static double density[FIBERS];
    int gray = 0, count = 0;
    check(paper_sheet_view(sheet, &(struct paper_sheet_view){.high = 1, .scale = 1}, rgb));
    for (int i = 0; i < FIBERS; i++)
        density[i] = -log10(fmax(1e-3, paper_light_linear(rgb[3 * i] / 65535.0)));
    for (int x = FROM; x < WIDTH - FROM; x++) {
        const int y = (int)edge_at(x + 0.5, top);
        double outside = 0, inside = 0;
        for (int i = 0; i < 5; i++) {
            outside += density[(y - 12 + i) * WIDTH + x] / 5;
            inside += density[(y + 8 + i) * WIDTH + x] / 5;
        }
        bool found = false;
        for (int i = -4; i <= 4 && inside > outside; i++) {
            const double part = (density[(y + i) * WIDTH + x] - outside) / (inside - outside);
            if (part >= 0.88)
                break;
            found = found || part > 0.12;
        }
        gray += found;
        count++;
    }
    return (double)gray / count;
}

static void edges_stay_gray(void **state)
{
    (void)state;
    static const char *const stocks[] = {"hot press", "cold press", "rough", "glass"};
    const bool all = all_sheets_wanted();
    for (size_t i = 0; i < (all ? sizeof stocks / sizeof *stocks : 1); i++) {
        struct paper_sheet *sheet = sheet_make(stocks[i]);
        bar_put(sheet, 30);
        const double fresh = gray_part(sheet, 30);
        steps(sheet, all ? 600 : 300);
        const double old = gray_part(sheet, 30);
        check(paper_sheet_dry(sheet));
        const double dry = gray_part(sheet, 30);
        printf("%-10s gray in %.0f%% of the columns, later %.0f%%, dry %.0f%%\n", stocks[i],
               100 * fresh, 100 * old, 100 * dry);
        if (!(old >= 0.5 && dry >= 0.5))
            fail_msg("%s: gray in %g, then in %g and %g of the columns", stocks[i], fresh, old,
                     dry);
        paper_sheet_destroy(sheet);
    }
}

/* A stroke's edge is gray, and one elsewhere leaves edges as they were. */
static void strokes_have_gray_edges(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_make("hot press");
    const double top = 22, middle = top + 20;
    stroke_paint(sheet, -10, edge_at(-10, middle), WIDTH + 10, edge_at(WIDTH + 10, middle), 40);
    steps(sheet, 300);
    const double stroke = gray_part(sheet, top);
    paper_sheet_destroy(sheet);
    sheet = sheet_make("hot press");
    bar_put(sheet, 30);
    stroke_paint(sheet, 200, 10, 236, 10, 8);
    steps(sheet, 100);
    const double beside = gray_part(sheet, 30);
    printf("a stroke: gray in %.0f%% of the columns; a shape with a stroke beside it: %.0f%%\n",
           100 * stroke, 100 * beside);
    if (!(stroke >= 0.35 && beside >= 0.45))
        fail_msg("gray in %g of a stroke's columns, in %g with a stroke beside", stroke,
                 beside);
    paper_sheet_destroy(sheet);
}

/* What is stained is what was wet since there was paint: all of what clean water has covered, a
 * part at an edge. */
static void stained_parts_follow_the_paint(void **state)
{
    (void)state;
    static float stained[FIBERS], wet[FIBERS], paint[FIBERS];
    struct paper_sheet *sheet = sheet_make("hot press");
    bar_put(sheet, 30);
    steps(sheet, 20);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_STAINED_PART, 0, stained));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_WET_PART, 0, wet));
    int part = 0;
    for (int i = 0; i < FIBERS; i++) {
        part += stained[i] > 0.05f && stained[i] < 0.95f;
        if (!(stained[i] >= 0 && stained[i] <= 1 && stained[i] >= wet[i] - 1e-6f))
            fail_msg("%g of a fiber is stained where %g is wet", (double)stained[i],
                     (double)wet[i]);
    }
    assert_true(part > WIDTH);
    static uint16_t rgb[3 * FIBERS]; /* and a picture of the layer shows it */
    check(paper_sheet_view(
        sheet,
        &(struct paper_sheet_view){
            .show = PAPER_SHOW_LAYER, .layer = PAPER_LAYER_STAINED_PART, .high = 1, .scale = 1},
        rgb));
    for (int i = 0; i < FIBERS; i++)
        if (fabs(rgb[3 * i] / 65535.0 - (double)stained[i]) > 1e-4)
            fail_msg("%g of a fiber is stained, and its picture shows %g", (double)stained[i],
                     rgb[3 * i] / 65535.0);
    check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){0.5, 0, 0}));
    steps(sheet, 2);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_STAINED_PART, 0, stained));
    for (int i = 0; i < FIBERS; i++)
        if (!(stained[i] > 0.99f))
            fail_msg("%g of a fiber is stained under water", (double)stained[i]);
    check(paper_sheet_seal(sheet));
    steps(sheet, 1);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_STAINED_PART, 0, stained));
    for (int i = 0; i < FIBERS; i++)
        assert_true(stained[i] == 0);
    /* and what a program writes lies on all of each fiber */
    for (int i = 0; i < FIBERS; i++)
        paint[i] = i % 3 ? 0.5f : 0;
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_FIXED_PIGMENT, 0, paint));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_STAINED_PART, 0, stained));
    for (int i = 0; i < FIBERS; i++)
        assert_true(stained[i] == (i % 3 ? 1 : 0));
    assert_int_equal(paper_sheet_layer_write(sheet, PAPER_LAYER_STAINED_PART, 0, paint),
                     PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(paper_error(), "is not written"));
    paper_sheet_destroy(sheet);
}

int main(void)
{
    setvbuf(stdout, NULL, _IONBF, 0);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_stay_gray),
        cmocka_unit_test(strokes_have_gray_edges),
        cmocka_unit_test(stained_parts_follow_the_paint),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
