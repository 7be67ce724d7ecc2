/* history_operations.h - sheets and random operations on them, for the tests of history. */
#ifndef LUTETIA_TESTS_HISTORY_OPERATIONS_H
#define LUTETIA_TESTS_HISTORY_OPERATIONS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <brush.h>
#include <history.h>
#include <paper.h>
#include <sheet.h>
#include <techniques.h>

#include "sample.h"
#include "sheet_calls.h"
#include "sheets.h"

enum { WIDTH = 24, HEIGHT = 20, FIBERS = WIDTH * HEIGHT };

static uint64_t chance = 7;

static double uniform(double low, double high)
{
    return low + (high - low) * (double)(sample_word(&chance) >> 11) * 0x1p-53;
}

static int below(int n)
{
    return (int)(sample_word(&chance) % (uint64_t)n);
}

static struct paper_sheet *sheet_new(double budget_bytes)
{
    struct paper_sheet_config config =
        sheet_of_two(WIDTH, HEIGHT, "quinacridone rose", "french ultramarine");
    config.torus = true;
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    if (budget_bytes >= 0)
        check(paper_history_begin(sheet, budget_bytes));
    return sheet;
}

/* A hash of all the sheet's planes. */
static uint64_t state_hash(struct paper_sheet *sheet)
{
    struct paper_plane planes[PAPER_PLANES_MAX];
    static uint32_t words[FIBERS];
    uint64_t hash = 0xcbf29ce484222325u;
    int count = paper_sheet_planes(sheet, planes);
    for (int i = 0; i < count; i++) {
        check(paper_sheet_plane_read(sheet, i, words));
        for (int j = 0; j < FIBERS; j++)
            hash = (hash ^ words[j]) * 0x100000001b3u;
    }
    const struct paper_air *air = paper_sheet_get_air(sheet);
    uint64_t bits[2];
    memcpy(&bits[0], &air->humidity, sizeof bits[0]);
    memcpy(&bits[1], &air->edge, sizeof bits[1]);
    return ((hash ^ bits[0]) * 0x100000001b3u ^ bits[1]) * 0x100000001b3u;
}

static void box_put(struct paper_sheet *sheet, double x, double y, double side,
                    const double *amount)
{
    double corners[8] = {x, y, x + side, y, x + side, y + side, x, y + side};
    struct paper_screen screen;
    int at_x, at_y;
    check(paper_polygon_screen(corners, 4, WIDTH, HEIGHT, &screen, &at_x, &at_y));
    if (screen.gray)
        check(paper_sheet_put(sheet, &screen, at_x, at_y, amount));
    paper_screen_destroy(&screen);
}

static void step(struct paper_sheet *sheet)
{
    check(paper_sheet_step(sheet));
    check(paper_sheet_finish(sheet));
}

/* Carries out a random operation; the same number always gives the same one. */
static void operate(struct paper_sheet *sheet, uint64_t number)
{
    chance = number * 77 + 5;
    paper_history_mark(sheet);
    int kind = below(18);
    struct paper_air air = *paper_sheet_get_air(sheet);
    float values[FIBERS];
    uint8_t gray[6] = {255, 128, 7, 0, 90, 255};
    struct paper_screen screen = {.width_px = 3, .height_px = 2, .gray = gray};
    switch (kind) {
    case 0:
    case 1:
    case 2:
        box_put(sheet, uniform(0, 18), uniform(0, 15), uniform(1, 8),
                (double[]){uniform(0.1, 1.5), uniform(0.1, 1), uniform(0.1, 1)});
        break;
    case 3:
        air.humidity = uniform(1e-4, 0.01);
        air.edge = uniform(1, 50);
        check(paper_sheet_air(sheet, &air));
        break;
    case 4:
        check(paper_sheet_blot(sheet, &screen, below(30) - 3, below(25) - 3, 0.5, 0.25));
        break;
    case 5:
        check(paper_sheet_bookmark(sheet, &(struct paper_bookmark){"wet"}));
        check(paper_sheet_resist(sheet, &screen, below(24), below(20), below(3) > 0));
        break;
    case 6:
        for (int i = 0; i < FIBERS; i++)
            values[i] = (float)uniform(0.3, 0.9);
        check(paper_sheet_layer_write(sheet, PAPER_LAYER_CAPACITY, 0, values));
        break;
    case 7: {
        struct paper_brush brush = paper_brush_default();
        brush.width = uniform(3, 8);
        brush.depth = 4;
        brush.bristles = 30;
        brush.number = below(2);
        brush.seed = number;
        check(paper_sheet_brush(sheet, &brush));
        check(paper_sheet_dip(
            sheet,
            &(struct paper_dip){brush.number, 1, {-1, 1}, {1, uniform(0, 1), uniform(0, 1)}}));
        break;
    }
    case 8:
    case 9:
    case 10: {
        struct paper_stroke_sample samples[3] = {
            {0, uniform(0, 20), uniform(0, 15), uniform(0, 1), 0, 0.2},
            {0.1, uniform(0, 20), uniform(0, 15), uniform(0, 1), 0.1, 0},
            {0.2, uniform(0, 20), uniform(0, 15), uniform(0, 1), 0, 0}};
        int which = below(2), steps = -1;
        struct paper_stroke stroke = {which, below(2) ? 20 : 0, 3, samples};
        if (!paper_history_brush(sheet, which))
            break;
        check(paper_sheet_stroke(sheet, &stroke, &steps));
        assert_int_equal(steps, stroke.pace > 0 ? 4 : 0);
        break;
    }
    case 11:
        check(paper_sheet_salt(sheet, &(struct paper_salt){{below(2) ? &screen : NULL, 5, 4},
                                                           12,
                                                           10,
                                                           8,
                                                           20,
                                                           {0.5, 1.5},
                                                           uniform(0, 2),
                                                           8,
                                                           number}));
        break;
    case 12:
        check(paper_sheet_wash(
            sheet, &(struct paper_wash){
                       {&screen, 2, 3}, {0, 0}, {20, 20}, {0.5, 0.1, 0.2}, {0.1, 0.4, 0}}));
        check(paper_sheet_lift(sheet, &(struct paper_lift){{NULL, 0, 0}, 0.3}));
        break;
    case 13:
        for (int i = 0; i < FIBERS; i++)
            values[i] = (float)uniform(0, 1);
        check(paper_sheet_print(
            sheet, &(struct paper_print){
                       .x = 3, .y = -2, .width = 9, .height = 7, .amount[1] = values}));
        check(paper_sheet_varnish(sheet, &(struct paper_varnish){{&screen, 8, 8}, 0.7}));
        check(paper_sheet_splatter(sheet, &(struct paper_splatter){.x = 9,
                                                                   .y = 9,
                                                                   .radius = 6,
                                                                   .drops = 9,
                                                                   .size = {0.5, 2},
                                                                   .seed = number,
                                                                   .amount = {0.5, 0.3}}));
        break;
    default:
        for (int steps = 1 + below(9); steps > 0; steps--)
            step(sheet);
    }
    check(paper_sheet_finish(sheet));
}

#endif
