/* test_techniques.c - washes, splatter, salt, lifting, varnish, and colours separated into
 * pigments. */
#include <paper.h>
#include <separate.h>
#include <techniques.h>

#include "sample.h"
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
        sheet_of_curtis(WIDTH, HEIGHT, "quinacridone rose", "phthalo green");
    config.stock.color_variation = 0;
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    return sheet;
}

static double total(struct paper_sheet *sheet, int substance)
{
    double sum;
    check(paper_sheet_total(sheet, substance, &sum));
    return sum;
}

static void layer(struct paper_sheet *sheet, enum paper_layer which, int pigment, float *values)
{
    check(paper_sheet_layer_read(sheet, which, pigment, values));
}

static void steps(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++) {
        check(paper_sheet_step(sheet));
        check(paper_sheet_finish(sheet));
    }
}

/* ---- putting ---- */

static void a_graded_wash_is_even(void **state)
{
    (void)state;
    static float water[FIBERS], rose[FIBERS];
    struct paper_sheet *sheet = sheet_make();
    check(paper_sheet_wash(
        sheet, &(struct paper_wash){
                   .from = {8, 0}, .to = {40, 0}, .amount = {0.5, 0.2}, .end = {0.5, 1}}));
    layer(sheet, PAPER_LAYER_SURFACE_WATER, 0, water);
    layer(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose);
    for (int i = 0; i < FIBERS; i++) {
        double part = fmin(1, fmax(0, (i % WIDTH + 0.5 - 8) / 32));
        assert_true(fabs((double)water[i] - 0.5) < 1e-6);
        assert_true(fabs((double)rose[i] - (0.2 + 0.8 * part)) < 2e-6);
    }
    assert_int_equal(paper_sheet_wash(sheet, &(struct paper_wash){.amount = {-1}}),
                     PAPER_BAD_ARGUMENT);
    assert_int_equal(paper_sheet_wash(sheet, &(struct paper_wash){.to = {NAN, 0}}),
                     PAPER_BAD_ARGUMENT);
    paper_sheet_destroy(sheet);
}

static void a_print_is_what_was_given(void **state)
{
    (void)state;
    static float resist[FIBERS], green[FIBERS], rose[FIBERS];
    float amount[6] = {0.5f, 1, 2, 0.25f, 3, 4};
    struct paper_sheet *sheet = sheet_make();
    resist[11] = 1;
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_RESIST, 0, resist));
    struct paper_print print = {
        .x = 10, .y = -1, .width = 3, .height = 2, .amount = {[2] = amount}};
    check(paper_sheet_print(sheet, &print));
    layer(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose);
    layer(sheet, PAPER_LAYER_SURFACE_PIGMENT, 1, green);
    for (int i = 0; i < FIBERS; i++)
        assert_true(rose[i] == 0 && green[i] == (i == 10 ? 0.25f : i == 12 ? 4.0f : 0));
    amount[3] = NAN;
    assert_int_equal(paper_sheet_print(sheet, &print), PAPER_BAD_ARGUMENT);
    print.width = 0;
    assert_int_equal(paper_sheet_print(sheet, &print), PAPER_BAD_ARGUMENT);
    paper_sheet_destroy(sheet);
}

static void splatter_falls_where_it_is_thrown(void **state)
{
    (void)state;
    static float first[FIBERS], rose[FIBERS];
    struct paper_splatter s = {.x = 20,
                               .y = 24,
                               .radius = 10,
                               .drops = 40,
                               .size = {0.5, 2},
                               .seed = 5,
                               .amount = {0.5, 1}};
    for (int thrown = 0; thrown < 2; thrown++) {
        struct paper_sheet *sheet = sheet_make();
        s.thrown = thrown;
        check(paper_sheet_splatter(sheet, &s));
        layer(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose);
        double sum = 0, middle = 0, near = 0;
        for (int i = 0; i < FIBERS; i++) {
            sum += (double)rose[i];
            middle += (double)rose[i] * (i % WIDTH + 0.5);
            near +=
                hypot(i % WIDTH + 0.5 - 20, i / WIDTH + 0.5 - 24) < 15 ? (double)rose[i] : 0;
        }
        assert_true(sum > 20);
        if (thrown)
            assert_true(middle / sum > 22);
        else
            assert_true(near > 0.75 * sum && fabs(middle / sum - 20) < 4);
        if (!thrown) { /* the same again, and another seed */
            memcpy(first, rose, sizeof first);
            struct paper_sheet *again = sheet_make();
            check(paper_sheet_splatter(again, &s));
            layer(again, PAPER_LAYER_SURFACE_PIGMENT, 0, rose);
            assert_memory_equal(first, rose, sizeof first);
            s.seed++;
            check(paper_sheet_splatter(again, &s));
            layer(again, PAPER_LAYER_SURFACE_PIGMENT, 0, rose);
            assert_memory_not_equal(first, rose, sizeof first);
            paper_sheet_destroy(again);
        }
        paper_sheet_destroy(sheet);
    }
    struct paper_sheet *sheet = sheet_make();
    s.drops = 0;
    assert_int_equal(paper_sheet_splatter(sheet, &s), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(paper_error(), "drops must be 1..100000 (got 0)"));
    paper_sheet_destroy(sheet);
}

/* ---- salt ---- */

/* Mirrors the layers that steer flowing water; eddies turn the other way round in a mirror. */
static void flow_mirror(struct paper_sheet *sheet)
{
    static float values[FIBERS], turned[FIBERS];
    for (enum paper_layer which = PAPER_LAYER_SIZING; which <= PAPER_LAYER_CURRENT; which++) {
        layer(sheet, which, 0, values);
        for (int i = 0; i < FIBERS; i++)
            turned[i - i % WIDTH + (WIDTH - 1 - i % WIDTH)] =
                which == PAPER_LAYER_CURRENT ? -values[i] : values[i];
        check(paper_sheet_layer_write(sheet, which, 0, turned));
    }
}

static void salted(bool mirrored, float *rose, float *water)
{
    static float values[FIBERS], turned[FIBERS];
    struct paper_sheet *sheet = sheet_make();
    struct paper_air air = paper_air_default();
    air.humidity = 1e-4;
    check(paper_sheet_air(sheet, &air));
    check(paper_sheet_wash(
        sheet, &(struct paper_wash){.amount = {0.6, 0.5, 0.2}, .end = {0.6, 0.5, 0.2}}));
    struct paper_salt salt = {.x = 32,
                              .y = 24,
                              .grains = 1,
                              .size = {1.5, 1.5},
                              .strength = 1,
                              .reach = 8,
                              .seed = 1};
    check(paper_sheet_salt(sheet, &salt));
    salt.x = 20.5;
    salt.y = 9.25;
    salt.size[0] = salt.size[1] = 0.8;
    check(paper_sheet_salt(sheet, &salt));
    for (enum paper_layer which = PAPER_LAYER_HEIGHT; which <= PAPER_LAYER_SALT && mirrored;
         which++) {
        if (which > PAPER_LAYER_CAPACITY && which < PAPER_LAYER_SALT)
            continue;
        layer(sheet, which, 0, values);
        for (int i = 0; i < FIBERS; i++)
            turned[i - i % WIDTH + (WIDTH - 1 - i % WIDTH)] = values[i];
        check(paper_sheet_layer_write(sheet, which, 0, turned));
    }
    if (mirrored)
        flow_mirror(sheet);
    double before[3] = {total(sheet, 0) + total(sheet, -1), total(sheet, 1), total(sheet, 2)};
    steps(sheet, 60);
    double after[3] = {total(sheet, 0) + total(sheet, -1), total(sheet, 1), total(sheet, 2)};
    for (int i = 0; i < 3; i++)
        if (before[i] != after[i])
            fail_msg("substance %d: %.9g became %.9g", i, before[i], after[i]);
    memset(rose, 0, FIBERS * sizeof *rose);
    for (enum paper_layer which = PAPER_LAYER_SURFACE_PIGMENT;
         which <= PAPER_LAYER_FIXED_PIGMENT; which++) {
        layer(sheet, which, 0, values);
        for (int i = 0; i < FIBERS; i++)
            rose[i] += values[i];
    }
    layer(sheet, PAPER_LAYER_SURFACE_WATER, 0, water);
    check(paper_sheet_dry(sheet));
    layer(sheet, PAPER_LAYER_SALT, 0, values);
    for (int i = 0; i < FIBERS; i++)
        assert_true(values[i] == 0); /* brushed off */
    paper_sheet_destroy(sheet);
}

static void salt_pushes_pigment_away(void **state)
{
    (void)state;
    static float rose[2][FIBERS], water[2][FIBERS];
    salted(false, rose[0], water[0]);
    double mean[3] = {0}, wet[3] = {0}; /* at the grain, around it, far off */
    int count[3] = {0};
    for (int i = 0; i < FIBERS; i++) {
        double r = hypot(i % WIDTH + 0.5 - 32, i / WIDTH + 0.5 - 24);
        double other = hypot(i % WIDTH + 0.5 - 20.5, i / WIDTH + 0.5 - 9.25);
        int zone = r < 3 ? 0 : r < 12 && r > 5 ? 1 : r > 20 && other > 20 ? 2 : -1;
        if (zone < 0)
            continue;
        mean[zone] += (double)rose[0][i];
        wet[zone] += (double)water[0][i];
        count[zone]++;
    }
    for (int zone = 0; zone < 3; zone++) {
        mean[zone] /= count[zone];
        wet[zone] /= count[zone];
    }
    assert_true(mean[0] < 0.5 * mean[2]);  /* pale where it lies */
    assert_true(mean[1] > 1.02 * mean[2]); /* in a darker ring */
    assert_true(wet[0] > 1.05 * wet[2]);   /* and it draws water */
    salted(true, rose[1], water[1]);
    for (int i = 0; i < FIBERS; i++) {
        int j = i - i % WIDTH + (WIDTH - 1 - i % WIDTH);
        if (rose[0][i] != rose[1][j] || water[0][i] != water[1][j])
            fail_msg("fiber %d, %d is %.9g, mirrored %.9g", i % WIDTH, i / WIDTH,
                     (double)rose[0][i], (double)rose[1][j]);
    }
}

/* ---- taking, and gloss ---- */

static void lifting_takes_what_does_not_stain(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_make();
    check(paper_sheet_wash(
        sheet, &(struct paper_wash){.amount = {0.5, 0.5, 0.5}, .end = {0.5, 0.5, 0.5}}));
    check(paper_sheet_dry(sheet)); /* all fixed */
    double before[2] = {total(sheet, 1), total(sheet, 2)};
    uint8_t gray[WIDTH * 24];
    memset(gray, 255, sizeof gray); /* the upper half */
    struct paper_screen screen = {.width_px = WIDTH, .height_px = 24, .gray = gray};
    check(paper_sheet_lift(sheet, &(struct paper_lift){.place = {&screen, 0, 0}, .part = 0.8}));
    /* half of the sheet loses 0.8 of the pigment of stain 1, and 0.8 / 5.5 of that of stain
     * 5.5 */
    assert_true(fabs(total(sheet, 2) / before[1] - 0.6) < 1e-3);
    assert_true(fabs(total(sheet, 1) / before[0] - (1 - 0.4 / 5.5)) < 1e-3);
    assert_int_equal(paper_sheet_lift(sheet, &(struct paper_lift){.part = 2}),
                     PAPER_BAD_ARGUMENT);
    paper_sheet_destroy(sheet);
}

static void varnish_deepens_and_shines(void **state)
{
    (void)state;
    static uint16_t plain[3 * FIBERS], glossy[3 * FIBERS];
    static uint8_t gray[20 * 20];
    struct paper_sheet *sheet = sheet_make();
    check(paper_sheet_wash(
        sheet, &(struct paper_wash){.amount = {0, 0.5, 0.2}, .end = {0, 0.5, 0.2}}));
    struct paper_sheet_view view = {.show = PAPER_SHOW_COLOR};
    check(paper_sheet_view(sheet, &view, plain));
    memset(gray, 255, sizeof gray);
    struct paper_screen screen = {.width_px = 20, .height_px = 20, .gray = gray};
    check(paper_sheet_varnish(
        sheet, &(struct paper_varnish){.place = {&screen, 10, 10}, .amount = 1}));
    check(paper_sheet_view(sheet, &view, glossy));
    for (int i = 0; i < FIBERS; i++) {
        int x = i % WIDTH, y = i / WIDTH;
        bool within = x > 10 && x < 29 && y > 10 && y < 29;
        bool beside = x < 9 || x > 30 || y < 9 || y > 30;
        for (int c = 0; c < 3; c++) {
            if (within)
                assert_true(glossy[3 * i + c] < plain[3 * i + c]);
            if (beside)
                assert_int_equal(glossy[3 * i + c], plain[3 * i + c]);
        }
    }
    int upper = 3 * (10 * WIDTH + 20), lower = 3 * (29 * WIDTH + 20);
    assert_true(glossy[upper] > plain[upper] && glossy[lower] < glossy[3 * (20 * WIDTH + 20)]);
    paper_sheet_destroy(sheet);
}

/* A picture with several pixels for each fiber, of a sheet with a disc and random amounts. The
 * mean of a fiber's pixels is the fiber's colour. Each pixel lies within the range of the nine
 * fibers around it. The disc's edge is nearer to a circle than the edge of its fibers. */
static void finer_pictures_have_the_same_means(void **state)
{
    (void)state;
    enum { SCALE_MAX = 4 };
    static uint16_t coarse[3 * FIBERS], fine[3 * FIBERS * SCALE_MAX * SCALE_MAX];
    static uint8_t gray[FIBERS];
    const double middle_x = 18.3, middle_y = 17.6, radius = 11.2;
    struct paper_sheet *sheet = sheet_make();
    for (int i = 0; i < FIBERS; i++) {
        int covered = 0;
        for (int j = 0; j < 64; j++)
            covered += hypot(i % WIDTH + (j % 8 + 0.5) / 8 - middle_x,
                             i / WIDTH + (j / 8 + 0.5) / 8 - middle_y) < radius;
        gray[i] = (uint8_t)(covered * 255 / 64);
    }
    struct paper_screen screen = {.width_px = WIDTH, .height_px = HEIGHT, .gray = gray};
    check(paper_sheet_put(sheet, &screen, 0, 0, (double[]){0, 1, 0.5}));
    struct paper_sheet_view view = {.show = PAPER_SHOW_COLOR, .scale = 3};
    assert_int_equal(paper_sheet_view(sheet, &view, fine), PAPER_BAD_ARGUMENT);
    view.scale = 1;
    check(paper_sheet_view(sheet, &view, coarse));
    for (int scale = 2; scale <= SCALE_MAX; scale += 2) {
        double off[2] = {0};
        int wide = WIDTH * scale;
        view.scale = scale;
        check(paper_sheet_view(sheet, &view, fine));
        const double dark = coarse[3 * (17 * WIDTH + 18)], light = coarse[0];
        for (int i = 0; i < FIBERS; i++) {
            int x = i % WIDTH, y = i / WIDTH, least = 65535, most = 0;
            for (int j = 0; j < 9; j++) {
                int ax = x + j % 3 - 1, ay = y + j / 3 - 1;
                if (ax < 0 || ay < 0 || ax >= WIDTH || ay >= HEIGHT)
                    continue;
                least = coarse[3 * (ay * WIDTH + ax)] < least ? coarse[3 * (ay * WIDTH + ax)]
                                                              : least;
                most =
                    coarse[3 * (ay * WIDTH + ax)] > most ? coarse[3 * (ay * WIDTH + ax)] : most;
            }
            double mean = 0;
            for (int j = 0; j < scale * scale; j++) {
                int px = x * scale + j % scale, py = y * scale + j / scale;
                int value = fine[3 * (py * wide + px)];
                assert_true(value >= least - 1 && value <= most + 1);
                mean += (double)value / (scale * scale);
                bool inside = hypot((px + 0.5) / scale - middle_x,
                                    (py + 0.5) / scale - middle_y) < radius;
                double true_value = inside ? dark : light;
                off[0] += fabs(value - true_value);
                off[1] += fabs(coarse[3 * i] - true_value);
            }
            assert_true(fabs(mean - coarse[3 * i]) <= 1);
        }
        print_message("%dx: %.2f of the blocks' error at a disc's edge is left\n", scale,
                      off[0] / off[1]);
        assert_true(off[0] < 0.8 * off[1]);
    }
    paper_sheet_destroy(sheet);
}

/* ---- colours ---- */

/* Separates the colours of mixtures that a sheet has shown, and compares the colours of the
 * result. */
static void mixtures_are_separated_again(void **state)
{
    (void)state;
    static float amount[2][FIBERS], found[2][FIBERS];
    static uint16_t seen[3 * FIBERS], again[3 * FIBERS];
    static uint8_t bytes[3 * FIBERS];
    struct paper_sheet_view view = {.show = PAPER_SHOW_COLOR};
    struct paper_sheet *sheet = sheet_make();
    for (int i = 0; i < FIBERS; i++) {
        amount[0][i] = (float)(i % WIDTH) / WIDTH;
        amount[1][i] = (float)(i / WIDTH) / HEIGHT * 1.2f;
    }
    check(paper_sheet_print(
        sheet, &(struct paper_print){
                   .width = WIDTH, .height = HEIGHT, .amount = {NULL, amount[0], amount[1]}}));
    check(paper_sheet_view(sheet, &view, seen));
    for (int i = 0; i < 3 * FIBERS; i++)
        bytes[i] = (uint8_t)((seen[i] + 128) / 257);
    struct paper_separation s = paper_separation_of(paper_sheet_get_config(sheet));
    s.thrift = 0.01;
    check(paper_separate(&s, bytes, FIBERS, (float *[]){found[0], found[1]}));
    check(paper_sheet_seal(sheet));
    paper_sheet_destroy(sheet);
    sheet = sheet_make();
    check(paper_sheet_print(
        sheet, &(struct paper_print){
                   .width = WIDTH, .height = HEIGHT, .amount = {NULL, found[0], found[1]}}));
    check(paper_sheet_view(sheet, &view, again));
    paper_sheet_destroy(sheet);
    double worst = 0, mean = 0, off = 0;
    for (int i = 0; i < FIBERS; i++) {
        double lab[2][3], rgb[3], squares = 0;
        for (int j = 0; j < 2; j++) {
            for (int c = 0; c < 3; c++)
                rgb[c] = paper_light_linear((j ? again : seen)[3 * i + c] / 65535.0);
            paper_lab(rgb, lab[j]);
        }
        for (int c = 0; c < 3; c++)
            squares += (lab[0][c] - lab[1][c]) * (lab[0][c] - lab[1][c]);
        worst = fmax(worst, sqrt(squares));
        mean += sqrt(squares) / FIBERS;
        for (int j = 0; j < 2; j++)
            off += fabs((double)(amount[j][i] - found[j][i])) / (2 * FIBERS);
    }
    print_message("separated: Delta E mean %.2f, worst %.2f; amounts off by %.3f\n", mean,
                  worst, off);
    assert_true(mean < 0.6 && worst < 2.5 && off < 0.03);
}

/* The formula of this file and the sheet give the same colour. L*a*b* of some colours is
 * known. */
static void the_formula_is_the_sheets(void **state)
{
    (void)state;
    static float amount[2][FIBERS];
    static uint16_t seen[3 * FIBERS];
    uint64_t chance = 3;
    struct paper_sheet *sheet = sheet_make();
    for (int i = 0; i < FIBERS; i++)
        for (int j = 0; j < 2; j++)
            amount[j][i] = (float)(sample_word(&chance) % 1000) / 300.0f;
    check(paper_sheet_print(
        sheet, &(struct paper_print){
                   .width = WIDTH, .height = HEIGHT, .amount = {NULL, amount[0], amount[1]}}));
    check(paper_sheet_view(sheet, &(struct paper_sheet_view){.show = PAPER_SHOW_COLOR}, seen));
    struct paper_separation s = paper_separation_of(paper_sheet_get_config(sheet));
    for (int i = 0; i < FIBERS; i++) {
        double rgb[3], both[2] = {(double)amount[0][i], (double)amount[1][i]};
        paper_mixture_color(&s, both, rgb);
        for (int c = 0; c < 3; c++)
            assert_true(fabs(paper_light_display(rgb[c]) - seen[3 * i + c] / 65535.0) < 1e-3);
    }
    paper_sheet_destroy(sheet);
    static const double known[][6] = {{1, 1, 1, 100, 0, 0},
                                      {0, 0, 0, 0, 0, 0},
                                      {1, 0, 0, 53.24, 80.09, 67.20},
                                      {0, 0, 1, 32.30, 79.19, -107.86}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        double lab[3];
        paper_lab(known[i], lab);
        for (int c = 0; c < 3; c++)
            assert_true(fabs(lab[c] - known[i][3 + c]) < 0.1);
    }
}

static void colours_out_of_reach_are_met_as_well_as_can_be(void **state)
{
    (void)state;
    struct paper_sheet_config config = paper_sheet_config_default();
    static const char *const names[] = {"quinacridone rose", "hansa yellow", "cerulean blue",
                                        "french ultramarine", "burnt umber"};
    config.pigments_count = 5;
    for (int i = 0; i < 5; i++)
        config.pigments[i] = *paper_pigment_find(names[i]);
    struct paper_separation s = paper_separation_of(&config);
    /* black, white, a gray, and a green brighter than any mixture of these pigments */
    static const uint8_t rgb[12] = {0, 0, 0, 255, 255, 255, 128, 128, 128, 0, 255, 0};
    float found[5][4];
    check(paper_separate(&s, rgb, 4,
                         (float *[]){found[0], found[1], found[2], found[3], found[4]}));
    double sums[4] = {0};
    for (int pixel = 0; pixel < 4; pixel++) {
        for (int i = 0; i < 5; i++) {
            assert_true(found[i][pixel] >= 0 && found[i][pixel] <= 2);
            sums[pixel] += (double)found[i][pixel];
        }
    }
    assert_true(sums[0] > 3 && sums[1] < 0.05);
    double both[5], seen[3];
    for (int i = 0; i < 5; i++)
        both[i] = (double)found[i][2];
    paper_mixture_color(&s, both, seen);
    for (int c = 0; c < 3; c++)
        assert_true(fabs(paper_light_display(seen[c]) - 128 / 255.0) < 0.015);
    assert_true(found[1][3] > 0.2f && found[0][3] < 0.02f); /* green has yellow and no rose */
    s.most = 9;
    assert_int_equal(paper_separate(&s, rgb, 1, (float *[]){found[0]}), PAPER_BAD_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_graded_wash_is_even),
        cmocka_unit_test(a_print_is_what_was_given),
        cmocka_unit_test(splatter_falls_where_it_is_thrown),
        cmocka_unit_test(salt_pushes_pigment_away),
        cmocka_unit_test(lifting_takes_what_does_not_stain),
        cmocka_unit_test(varnish_deepens_and_shines),
        cmocka_unit_test(finer_pictures_have_the_same_means),
        cmocka_unit_test(mixtures_are_separated_again),
        cmocka_unit_test(the_formula_is_the_sheets),
        cmocka_unit_test(colours_out_of_reach_are_met_as_well_as_can_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
