/* test_laying.c - what washes, prints, salt and varnish lay, and where: masking fluid, screens,
 * edges. */
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

enum { WIDTH = 64, HEIGHT = 48, FIBERS = WIDTH * HEIGHT };

/* Every sheet has two pigments, so that all tests have the same kernels. The first stains five
 * times as much as the second. */
static struct paper_sheet *sheet_make(void)
{
    struct paper_sheet_config config =
        sheet_of_two(WIDTH, HEIGHT, "quinacridone rose", "phthalo green");
    config.stock.color_variation = 0;
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    return sheet;
}

static void layer(struct paper_sheet *sheet, enum paper_layer which, int pigment, float *values)
{
    check(paper_sheet_layer_read(sheet, which, pigment, values));
}

/* Under masking fluid, the left half, nothing is put and nothing lifted. */
static void masking_fluid_keeps_techniques_off(void **state)
{
    (void)state;
    enum { HALF = WIDTH / 2 };
    static float resist[FIBERS], water[FIBERS], rose[FIBERS], before[FIBERS];
    static float amount[FIBERS];
    struct paper_sheet *sheet = sheet_make();
    for (int i = 0; i < FIBERS; i++) {
        resist[i] = i % WIDTH < HALF;
        amount[i] = 0.5f;
    }
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_RESIST, 0, resist));
    check(paper_sheet_wash(sheet,
                           &(struct paper_wash){.amount = {0.5, 0.25}, .end = {0.5, 0.25}}));
    check(paper_sheet_print(
        sheet,
        &(struct paper_print){.width = WIDTH, .height = HEIGHT, .amount = {[1] = amount}}));
    layer(sheet, PAPER_LAYER_SURFACE_WATER, 0, water);
    layer(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose);
    for (int i = 0; i < FIBERS; i++) {
        const bool masked = i % WIDTH < HALF;
        assert_true(fabs((double)water[i] - (masked ? 0 : 0.5)) < 1e-6);
        assert_true(fabs((double)rose[i] - (masked ? 0 : 0.75)) < 1e-6);
    }
    for (int i = 0; i < FIBERS; i++)
        resist[i] = 1 - resist[i];
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_RESIST, 0, resist));
    memcpy(before, rose, sizeof before);
    check(paper_sheet_lift(sheet, &(struct paper_lift){.part = 1}));
    layer(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose);
    assert_memory_equal(before, rose, sizeof before);
    paper_sheet_destroy(sheet);
}

/* A fiber is wet where a wash or a print brings water to it, though the wash begins dry, and
 * dry where they bring pigment alone. */
static void what_brings_water_wets(void **state)
{
    (void)state;
    static float wet[FIBERS], amount[FIBERS];
    for (int i = 0; i < FIBERS; i++)
        amount[i] = 0.5f;
    const struct paper_wash dry = {.amount = {0, 0.5}, .end = {0, 0.5}},
                            ends_wet = {.from = {0, 0}, .to = {0, HEIGHT}, .end = {1}};
    const struct paper_print print = {.width = WIDTH, .height = HEIGHT / 2, .amount = {amount}};
    for (int way = 0; way < 3; way++) {
        struct paper_sheet *sheet = sheet_make();
        check(way == 2 ? paper_sheet_print(sheet, &print)
                       : paper_sheet_wash(sheet, way == 1 ? &ends_wet : &dry));
        layer(sheet, PAPER_LAYER_WET_PART, 0, wet);
        for (int i = 0; i < FIBERS; i++) {
            const int y = i / WIDTH;
            if (way == 0 || (way == 2 && y >= HEIGHT / 2))
                assert_true(wet[i] == 0);
            else if (way == 2 || y > HEIGHT / 2)
                assert_true(wet[i] > 0.4f);
        }
        paper_sheet_destroy(sheet);
    }
}

/* The glossiest coat counts, and a coat has no edge where the sheet ends. */
static void varnish_goes_to_the_sheets_edge(void **state)
{
    (void)state;
    static uint16_t once[3 * FIBERS], twice[3 * FIBERS];
    struct paper_sheet *sheet = sheet_make();
    uint8_t gray[32 * HEIGHT];
    memset(gray, 255, sizeof gray); /* the left half */
    const struct paper_screen screen = {.width_px = 32, .height_px = HEIGHT, .gray = gray};
    struct paper_varnish coat = {.place = {&screen, 0, 0}, .amount = 1};
    const struct paper_sheet_view view = {.show = PAPER_SHOW_COLOR};
    check(paper_sheet_varnish(sheet, &coat));
    check(paper_sheet_view(sheet, &view, once));
    for (int i = 0; i < FIBERS; i++)
        if (i % WIDTH < 30)
            assert_int_equal(once[3 * i], once[3 * (20 * WIDTH + 10)]);
        else if (i % WIDTH > 33)
            assert_int_equal(once[3 * i], once[3 * (20 * WIDTH + 50)]);
    coat.amount = 0.25;
    check(paper_sheet_varnish(sheet, &coat));
    check(paper_sheet_view(sheet, &view, twice));
    assert_memory_equal(once, twice, sizeof once);
    paper_sheet_destroy(sheet);
}

/* Grains fall all over a disc, as far along y as along x, most of them small, and only where
 * the screen is. */
static void salt_falls_where_it_is_strewn(void **state)
{
    (void)state;
    static float salt[FIBERS];
    uint8_t gray[40 * 10];
    memset(gray, 255, sizeof gray);
    const struct paper_screen screen = {.width_px = 40, .height_px = 10, .gray = gray};
    struct paper_salt s = {.x = 32,
                           .y = 24,
                           .radius = 20,
                           .grains = 400,
                           .size = {0.5, 0.5},
                           .strength = 1,
                           .reach = 8,
                           .seed = 3};
    struct paper_sheet *sheet = sheet_make();
    check(paper_sheet_salt(sheet, &s));
    layer(sheet, PAPER_LAYER_SALT, 0, salt);
    double sum = 0, xx = 0, yy = 0, xy = 0;
    for (int i = 0; i < FIBERS; i++) {
        const double x = i % WIDTH + 0.5 - s.x, y = i / WIDTH + 0.5 - s.y, is = (double)salt[i];
        sum += is;
        xx += is * x * x;
        yy += is * y * y;
        xy += is * x * y;
    }
    /* of a disc: a quarter of the radius squared */
    assert_true(fabs(xx / sum - 100) < 15 && fabs(yy / sum - 100) < 15);
    assert_true(fabs(xy / sum) < 15);
    paper_sheet_destroy(sheet);
    sheet = sheet_make();
    s.place = (struct paper_place){&screen, 12, 30};
    check(paper_sheet_salt(sheet, &s));
    layer(sheet, PAPER_LAYER_SALT, 0, salt);
    double within = 0;
    for (int i = 0; i < FIBERS; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        if (x < 10 || x >= 54 || y < 28 || y >= 42)
            assert_true(salt[i] == 0);
        within += (double)salt[i];
    }
    assert_true(within > 20);
    paper_sheet_destroy(sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masking_fluid_keeps_techniques_off),
        cmocka_unit_test(what_brings_water_wets),
        cmocka_unit_test(varnish_goes_to_the_sheets_edge),
        cmocka_unit_test(salt_falls_where_it_is_strewn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
