/* test_sheet.c - sheets with pigments: nothing is lost, mirrored sheets give mirrored bits, and
 * each effect can be measured. */
#include <history.h>
#include <paper.h>
#include <paris_internal.h>
#include <sheet.h>

#include "sample.h"
#include "sheet_calls.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE_MOST = 160, FIBERS_MOST = SIDE_MOST * SIDE_MOST };

static uint64_t chance = 5;

static double uniform(double low, double high)
{
    return low + (high - low) * (double)(sample_word(&chance) >> 11) * 0x1p-53;
}

static struct paper_sheet_config config_small(int width, int height, int pigments)
{
    static const char *const names[] = {"quinacridone rose", "french ultramarine",
                                        "burnt umber",       "phthalo green",
                                        "hansa yellow",      "cadmium red"};
    struct paper_sheet_config config = paper_sheet_config_default();
    config.torus = true;
    config.width = width;
    config.height = height;
    config.pigments_count = pigments;
    for (int i = 0; i < pigments; i++)
        config.pigments[i] = *paper_pigment_find(names[i]);
    return config;
}

static struct paper_sheet *sheet_make(const struct paper_sheet_config *config)
{
    struct paper_sheet *sheet;
    check(paper_sheet_create(config, &sheet));
    return sheet;
}

static void steps(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++) {
        check(paper_sheet_step(sheet));
        check(paper_sheet_finish(sheet));
    }
}

static void box_put(struct paper_sheet *sheet, double x1, double y1, double x2, double y2,
                    const double *amount)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    double corners[8] = {x1, y1, x2, y1, x2, y2, x1, y2};
    struct paper_screen screen;
    int x, y;
    check(paper_polygon_screen(corners, 4, config->width, config->height, &screen, &x, &y));
    check(paper_sheet_put(sheet, &screen, x, y, amount));
    paper_screen_destroy(&screen);
}

static double total(struct paper_sheet *sheet, int substance)
{
    double sum;
    check(paper_sheet_total(sheet, substance, &sum));
    return sum;
}

static double total_water(struct paper_sheet *sheet)
{
    return total(sheet, 0) + total(sheet, -1);
}

/* ---- the thesis's model ---- */

static void without_parts_it_is_the_thesis(void **state)
{
    (void)state;
    enum { SIDE = 64 };
    static float absorbency[SIDE * SIDE], ours[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++)
        absorbency[i] = 0.18f;
    struct paper_config old = paper_config_default();
    old.width = old.height = SIDE;
    old.absorbency_variation = 0;
    struct paper *page;
    check(paper_create(&old, &page));
    check(paper_rectangle(page, 10, 12, 30, 20,
                          &(struct paper_ink){.cyan = 0.5, .magenta = 0.25, .water = 0.75}));

    struct paper_sheet_config config = config_small(SIDE, SIDE, 0);
    config.parts = 0;
    config.rule = PAPER_RULE_SUBTRACT;
    struct paper_weather weather = paper_weather_default();
    weather.gravity_y = 1.5;
    static const char *const names[3] = {"cyan", "magenta", "yellow"};
    for (int i = 0; i < 3; i++) {
        config.pigments[i] = *paper_pigment_find(names[i]);
        config.pigments[i].weight[0] = weather.molecular_weight[i];
    }
    config.pigments_count = 3;
    struct paper_sheet *sheet = sheet_make(&config);
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_ABSORBENCY, 0, absorbency));
    box_put(sheet, 10, 12, 40, 32, (double[]){0.75, 0.5, 0.25, 0});
    struct paper_air air = paper_air_default();
    air.thesis = weather;
    check(paper_sheet_air(sheet, &air));
    for (int i = 0; i < 20; i++) {
        check(paper_disperse(page, &weather));
        check(paper_finish(page));
    }
    steps(sheet, 20);
    for (int i = 0; i < 4; i++) {
        double theirs, sum;
        check(paper_total(page, PAPER_WATER + (enum paper_amount)i, &theirs));
        sum = total(sheet, i);
        assert_true(fabs(theirs - sum) <= 1e-3 * sum + 1e-9);
    }
    /* fiber by fiber: the thesis's picture of pigments is computed from the sheet's layers */
    static uint8_t rgb[3 * SIDE * SIDE];
    check(paper_view_read(page, PAPER_VIEW_WATER, rgb));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_INFUSED_WATER, 0, ours));
    for (int i = 0; i < SIDE * SIDE; i++)
        assert_int_equal(rgb[3 * i], (int)rintf(ours[i] * 255.0f));
    paper_destroy(page);
    paper_sheet_destroy(sheet);
}

/* ---- matter ---- */

/* An air without a 0, so that all tests have the same kernels. */
static struct paper_air air_with_all(void)
{
    struct paper_air air = paper_air_default();
    air.gravity[0] = 0.01;
    air.gravity[1] = 0.02;
    air.seep[0] = -0.03;
    air.seep[1] = 0.02;
    return air;
}

static void nothing_is_lost_in_many_steps(void **state)
{
    (void)state;
    struct paper_sheet_config config = config_small(24, 20, 2);
    struct paper_sheet *sheet = sheet_make(&config);
    struct paper_air air = air_with_all();
    air.humidity = 2e-5; /* wet to the end */
    check(paper_sheet_air(sheet, &air));
    box_put(sheet, 4, 4, 20, 15, (double[]){1.5, 0.6, 0.3});
    double before[3] = {total_water(sheet), total(sheet, 1), total(sheet, 2)};
    assert_true(before[0] > 100 && before[1] > 50);
    steps(sheet, 10000);
    double after[3] = {total_water(sheet), total(sheet, 1), total(sheet, 2)};
    for (int i = 0; i < 3; i++)
        if (after[i] != before[i])
            fail_msg("substance %d drifted by %g of %g", i, after[i] - before[i], before[i]);
    assert_true(total(sheet, -1) > 0.01 * before[0]);
    struct machine_stats stats;
    machine_stats_get(paris_machine(), &stats);
    assert_true(stats.calls_foreseen > 1000000); /* the steps were recognised */
    paper_sheet_destroy(sheet);
}

static struct paper_air air_by_chance(void)
{
    struct paper_air air = paper_air_default();
    /* numbers near an end of their range differ from it a little: equal numbers would give
     * another graph and other kernels to compile */
#define CHOOSE(member, low, high)                                                              \
    air.member = sample_word(&chance) % 3   ? uniform(low, high)                               \
                 : sample_word(&chance) % 2 ? (low) + uniform(0, 1e-6) * ((high) - (low))      \
                                            : (high)-uniform(0, 1e-6) * ((high) - (low))
    for (int i = 0; i < 2; i++) {
        CHOOSE(gravity[i], -1, 1);
        CHOOSE(seep[i], -1, 1);
    }
    CHOOSE(spread, 0, 1);
    CHOOSE(relief, 0, 1);
    CHOOSE(film, 0.001, 1);
    CHOOSE(pinning, 0.001, 2); /* 0 is another kernel */
    CHOOSE(absorption, 0, 4);
    CHOOSE(carry, 0, 1);
    CHOOSE(humidity, 1e-6, 1);
    CHOOSE(edge, 0.001, 200);
    CHOOSE(edge_width, 1, 32);
    CHOOSE(settling, 0, 10);
#undef CHOOSE
    for (int i = 0; i < 2; i++) {
        air.gravity[i] += air.gravity[i] == 0 ? 1e-3 : 0;
        air.seep[i] += air.seep[i] == 0 ? 1e-3 : 0;
    }
    return air;
}

static void layer_extremes(struct paper_sheet *sheet, enum paper_layer layer, int pigment)
{
    static float values[FIBERS_MOST];
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    check(paper_sheet_layer_read(sheet, layer, pigment, values));
    for (int i = 0; i < config->width * config->height; i++)
        if (!(values[i] >= 0 && values[i] <= 16.0f))
            fail_msg("layer %d of pigment %d is %g in fiber %d", (int)layer, pigment,
                     (double)values[i], i);
}

static void any_air_keeps_matter_and_numbers(void **state)
{
    (void)state;
    enum { AIRS = 60 };
    struct paper_sheet_config config = config_small(20, 18, 2);
    struct paper_sheet *sheet = sheet_make(&config);
    for (int i = 0; i < AIRS; i++) {
        struct paper_air air = air_by_chance();
        check(paper_sheet_air(sheet, &air));
        double x = uniform(0, 12), y = uniform(0, 10);
        box_put(sheet, x, y, x + uniform(1, 9), y + uniform(1, 9),
                (double[]){uniform(0, 4), uniform(0, 4), uniform(-4, 4)});
        double before[3] = {total_water(sheet), total(sheet, 1), total(sheet, 2)};
        steps(sheet, 6);
        double after[3] = {total_water(sheet), total(sheet, 1), total(sheet, 2)};
        for (int j = 0; j < 3; j++)
            if (after[j] != before[j])
                fail_msg("air %d, substance %d: %.9g became %.9g", i, j, before[j], after[j]);
        layer_extremes(sheet, PAPER_LAYER_SURFACE_WATER, 0);
        layer_extremes(sheet, PAPER_LAYER_INFUSED_WATER, 0);
        for (int pigment = 0; pigment < 2; pigment++) {
            layer_extremes(sheet, PAPER_LAYER_SURFACE_PIGMENT, pigment);
            layer_extremes(sheet, PAPER_LAYER_INFUSED_PIGMENT, pigment);
            layer_extremes(sheet, PAPER_LAYER_FIXED_PIGMENT, pigment);
        }
    }
    paper_sheet_destroy(sheet);
}

/* ---- symmetry ---- */

enum { BOARD = 28 };

enum motion { AS_IT_IS, MIRRORED_X, MIRRORED_Y, TRANSPOSED, SHIFTED, MOTIONS };

/* The fiber to which the motion takes fiber x, y of the board. */
static int moved(enum motion motion, int x, int y)
{
    switch (motion) {
    case MIRRORED_X:
        return y * BOARD + (BOARD - 1 - x);
    case MIRRORED_Y:
        return (BOARD - 1 - y) * BOARD + x;
    case TRANSPOSED:
        return x * BOARD + y;
    case SHIFTED:
        return (y + 5) % BOARD * BOARD + (x + 11) % BOARD;
    case AS_IT_IS:
    case MOTIONS:
    default:
        return y * BOARD + x;
    }
}

static const enum paper_layer board_layers[] = {
    PAPER_LAYER_HEIGHT,          PAPER_LAYER_ABSORBENCY,    PAPER_LAYER_CAPACITY,
    PAPER_LAYER_SURFACE_WATER,   PAPER_LAYER_INFUSED_WATER, PAPER_LAYER_SURFACE_PIGMENT,
    PAPER_LAYER_INFUSED_PIGMENT, PAPER_LAYER_FIXED_PIGMENT, PAPER_LAYER_SIZING,
    PAPER_LAYER_CURRENT};
enum { BOARD_LAYERS = sizeof board_layers / sizeof *board_layers, BOARD_AMOUNTS = 8 };

/* A layer's value after the motion: eddies turn the other way round in a mirror. */
static float seen_so(enum motion motion, enum paper_layer layer, float value)
{
    bool mirror = motion == MIRRORED_X || motion == MIRRORED_Y || motion == TRANSPOSED;
    return mirror && layer == PAPER_LAYER_CURRENT ? -value : value;
}

static void moved_sheets_give_moved_bits(void **state)
{
    (void)state;
    static float first[BOARD_LAYERS][BOARD * BOARD], start[BOARD_LAYERS][BOARD * BOARD],
        values[BOARD * BOARD];
    for (int layer = 0; layer < BOARD_LAYERS; layer++)
        for (int i = 0; i < BOARD * BOARD; i++) {
            bool there = layer < 3 || layer >= BOARD_AMOUNTS || uniform(0, 1) < 0.4;
            start[layer][i] = there ? (float)uniform(0, layer == 1 ? 0.25 : 1) : 0.0f;
        }
    for (enum motion motion = AS_IT_IS; motion < MOTIONS; motion++) {
        struct paper_sheet_config config = config_small(BOARD, BOARD, 2);
        struct paper_sheet *sheet = sheet_make(&config);
        struct paper_air air = air_with_all();
        air.gravity[0] = motion == MIRRORED_X ? -0.3 : motion == TRANSPOSED ? 0.1 : 0.3;
        air.gravity[1] = motion == MIRRORED_Y ? -0.1 : motion == TRANSPOSED ? 0.3 : 0.1;
        air.seep[0] = motion == MIRRORED_X ? 0.2 : motion == TRANSPOSED ? 0.05 : -0.2;
        air.seep[1] = motion == MIRRORED_Y ? -0.05 : motion == TRANSPOSED ? -0.2 : 0.05;
        check(paper_sheet_air(sheet, &air));
        for (int layer = 0; layer < BOARD_LAYERS; layer++) {
            for (int y = 0; y < BOARD; y++)
                for (int x = 0; x < BOARD; x++)
                    values[moved(motion, x, y)] =
                        seen_so(motion, board_layers[layer], start[layer][y * BOARD + x]);
            check(paper_sheet_layer_write(sheet, board_layers[layer], 0, values));
        }
        steps(sheet, 40);
        for (int layer = 3; layer < BOARD_AMOUNTS; layer++) {
            check(paper_sheet_layer_read(sheet, board_layers[layer], 0, values));
            for (int y = 0; y < BOARD; y++)
                for (int x = 0; x < BOARD; x++) {
                    float *was = &first[layer][y * BOARD + x],
                          now = values[moved(motion, x, y)];
                    if (motion == AS_IT_IS)
                        *was = now;
                    else if (memcmp(was, &now, sizeof now) != 0)
                        fail_msg("motion %d, layer %d at %d, %d: %.9g became %.9g", (int)motion,
                                 layer, x, y, (double)*was, (double)now);
                }
        }
        paper_sheet_destroy(sheet);
    }
}

/* The sheet has one pigment and no surface, because the eager machine compiles a kernel for
 * each instruction. */
static void eager_is_fused(void **state)
{
    (void)state;
    static float fused[40 * 30], eager[40 * 30];
    for (int slow = 0; slow < 2; slow++) {
        struct machine_config machine = machine_config_default();
        machine.eager = slow;
        assert_true(paris_reset(&machine));
        struct paper_sheet_config config = config_small(40, 30, 1);
        config.parts = PAPER_PART_INFUSED;
        struct paper_sheet *sheet = sheet_make(&config);
        box_put(sheet, 5, 5, 30, 20, (double[]){1, 0.5});
        steps(sheet, 8);
        check(paper_sheet_layer_read(sheet, PAPER_LAYER_INFUSED_PIGMENT, 0,
                                     slow ? eager : fused));
        paper_sheet_destroy(sheet);
    }
    assert_true(paris_reset(NULL));
    assert_memory_equal(fused, eager, sizeof fused);
}

/* On the machine: sessions by chance are tests/plain/boxes_by_chance.c. */
static void boxes_give_the_same_bits(void **state)
{
    (void)state;
    enum { WIDE = 96, HIGH = 72, SPOT = 9 };
    static uint32_t words[2][WIDE * HIGH];
    static uint8_t gray[SPOT * SPOT];
    struct paper_sheet *sheets[2];
    double amount[1 + PAPER_PIGMENTS_MAX] = {0.8, 0.5}, share = 1;
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = WIDE;
    config.height = HIGH;
    config.pigments_count = 1;
    config.pigments[0] = *paper_pigment_number(0);
    memset(gray, 255, sizeof gray);
    const struct paper_screen screen = {.width_px = SPOT, .height_px = SPOT, .gray = gray};
    for (int k = 0; k < 2; k++) {
        assert_int_equal(paper_sheet_create(&config, &sheets[k]), PAPER_OK);
        assert_int_equal(paper_sheet_confine(sheets[k], k == 0 ? 8 : 0), PAPER_OK);
    }
    for (int turn = 0; turn < 4; turn++) {
        const int x = turn % 2 ? 60 : -4, y = turn < 2 ? 20 : HIGH - 5; /* over the edges */
        for (int k = 0; k < 2; k++) {
            assert_int_equal(paper_sheet_put(sheets[k], &screen, x, y, amount), PAPER_OK);
            for (int i = 0; i < 25; i++) {
                assert_int_equal(paper_sheet_step(sheets[k]), PAPER_OK);
                share = k == 0 ? fmin(share, paper_sheet_share(sheets[k])) : share;
            }
        }
        struct paper_plane planes[PAPER_PLANES_MAX];
        for (int i = paper_sheet_planes(sheets[0], planes) - 1; i >= 0; i--) {
            for (int k = 0; k < 2; k++)
                assert_int_equal(paper_sheet_plane_read(sheets[k], i, words[k]), PAPER_OK);
            if (memcmp(words[0], words[1], sizeof words[0]) != 0)
                fail_msg("%s differs in boxes, in turn %d", planes[i].name, turn);
        }
    }
    assert_true(share < 0.5);
    assert_int_equal(paper_sheet_confine(sheets[0], 3), PAPER_BAD_ARGUMENT);
    for (int k = 0; k < 2; k++)
        paper_sheet_destroy(sheets[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_parts_it_is_the_thesis),
        cmocka_unit_test(nothing_is_lost_in_many_steps),
        cmocka_unit_test(any_air_keeps_matter_and_numbers),
        cmocka_unit_test(moved_sheets_give_moved_bits),
        cmocka_unit_test(eager_is_fused),
        cmocka_unit_test(boxes_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
