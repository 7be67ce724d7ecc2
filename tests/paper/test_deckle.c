/* test_deckle.c - sheets with the edges of handmade paper: what the edge is like, that nothing
 * gets over it, and that all that holds of other sheets holds of them. */
#include <brush.h>
#include <history.h>
#include <paper.h>
#include <techniques.h>

#include "sheet_calls.h"
#include "sheets.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 512, FIBERS = SIDE * SIDE, SMALL = 112, FEW = SMALL * SMALL };
#define PI 3.141592653589793

static struct paper_sheet_config config_of(int side, const char *stock, uint64_t seed)
{
    struct paper_sheet_config config =
        sheet_of_two(side, side, "quinacridone rose", "french ultramarine");
    config.stock = *paper_stock_find(stock);
    config.seed = seed;
    config.deckled = true;
    return config;
}

static struct paper_sheet *sheet_of(const struct paper_sheet_config *config)
{
    struct paper_sheet *sheet;
    check(paper_sheet_create(config, &sheet));
    return sheet;
}

static struct paper_sheet *sheet_small(void)
{
    struct paper_sheet_config config = config_of(SMALL, "cold press", 4);
    config.deckle.margin = 14;
    config.deckle.thin = 10;
    return sheet_of(&config);
}

/* ---- the edge ---- */

/* How far the sheet ends from a side of the picture, for each row or column of it: the first
 * fiber that is clearly there. */
static void edge_find(const float *thickness, int side, double edge[SIDE])
{
    for (int i = 0; i < SIDE; i++) {
        int far = 0;
        for (; far < SIDE / 4; far++) {
            const int x = side == 0   ? far
                          : side == 1 ? SIDE - 1 - far
                                      : i,
                      y = side == 2   ? far
                          : side == 3 ? SIDE - 1 - far
                                      : i;
            if (thickness[y * SIDE + x] > 0.2f)
                break;
        }
        edge[i] = far;
    }
}

enum { FROM = 64, ALONG = 384, SEEDS = 6 };

/* Adds the power of an edge's middle part, under a bell, to each frequency of it. */
static void power_add(const double edge[SIDE], double power[ALONG / 2])
{
    for (int f = 1; f < ALONG / 2; f++) {
        double complex sum = 0;
        double mean = 0;
        for (int i = 0; i < ALONG; i++)
            mean += edge[FROM + i] / ALONG;
        for (int i = 0; i < ALONG; i++)
            sum += (edge[FROM + i] - mean) * (0.5 - 0.5 * cos(2 * PI * i / ALONG)) *
                   cexp(-2 * PI * I * f * i / ALONG);
        power[f] += creal(sum * conj(sum));
    }
}

static double slope_of(const double *power, int first, int last)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int f = first; f <= last; f++) {
        const double u = log(f), v = log(power[f]);
        n++, x += u, y += v, xx += u * u, xy += u * v;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

/* Long waves and short ones, and no length before another: a sawn edge would have one. */
static void the_edge_wanders_without_a_period(void **state)
{
    (void)state;
    static float thickness[FIBERS];
    double power[ALONG / 2] = {0}, squares = 0, steep = 0;
    struct paper_deckle deckle = paper_deckle_default();
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        struct paper_sheet_config config = config_of(SIDE, "cold press", seed);
        struct paper_sheet *sheet = sheet_of(&config);
        check(paper_sheet_layer_read(sheet, PAPER_LAYER_THICKNESS, 0, thickness));
        paper_sheet_destroy(sheet);
        for (int side = 0; side < 4; side++) {
            double edge[SIDE], mean = 0;
            edge_find(thickness, side, edge);
            power_add(edge, power);
            for (int i = FROM; i < FROM + ALONG; i++)
                mean += edge[i] / ALONG;
            assert_true(fabs(mean - deckle.margin) < 5);
            for (int i = FROM; i < FROM + ALONG; i++) {
                squares += (edge[i] - mean) * (edge[i] - mean);
                steep += (edge[i] - edge[i - 1]) * (edge[i] - edge[i - 1]);
            }
        }
    }
    const double rms = sqrt(squares / (4 * SEEDS * ALONG)),
                 step = sqrt(steep / (4 * SEEDS * ALONG)), slope = slope_of(power, 3, 48);
    printf("edge: rms %.2f fibers, from fiber to fiber %.2f, slope of its spectrum %.2f\n", rms,
           step, slope);
    assert_true(rms > 0.7 * deckle.waves && rms < 1.5 * deckle.waves);
    assert_true(step > 0.25 && step < 2);
    assert_true(slope > -2.6 && slope < -1.2);
    double peak = 0;
    for (int f = 6; f < ALONG / 2 - 4; f++) {
        const double around = (power[f - 4] + power[f - 3] + power[f + 3] + power[f + 4]) / 4;
        peak = fmax(peak, power[f] / around);
        if (power[f] > 3.5 * around)
            fail_msg("edges have a period of %.1f fibers: %.1f times its neighbours",
                     (double)ALONG / f, power[f] / around);
    }
    printf("edge: a frequency has at most %.1f times the power around it\n", peak);
}

/* The sheet gets thinner, lower, and holds and drinks less; in the middle it is the sheet
 * without a deckle, to the bit. */
static void the_sheet_is_thin_at_its_edge(void **state)
{
    (void)state;
    static const enum paper_layer layers[] = {PAPER_LAYER_HEIGHT,   PAPER_LAYER_ABSORBENCY,
                                              PAPER_LAYER_CAPACITY, PAPER_LAYER_SIZING,
                                              PAPER_LAYER_GRIP,     PAPER_LAYER_RED};
    static float thickness[FIBERS], with[FIBERS], without[FIBERS];
    for (const char *const *stock = (const char *const[]){"rough", "laid", "xuan", NULL};
         *stock; stock++) {
        struct paper_sheet_config config = config_of(SIDE, *stock, 9);
        struct paper_sheet *deckled = sheet_of(&config);
        config.deckled = false;
        struct paper_sheet *cut = sheet_of(&config);
        check(paper_sheet_layer_read(deckled, PAPER_LAYER_THICKNESS, 0, thickness));
        int whole = 0;
        for (int k = 0; k < 6; k++) {
            double thin[2] = {0}, count[2] = {0};
            check(paper_sheet_layer_read(deckled, layers[k], 0, with));
            check(paper_sheet_layer_read(cut, layers[k], 0, without));
            for (int i = 0; i < FIBERS; i++) {
                if (thickness[i] == 1 && with[i] != without[i])
                    fail_msg("%s, layer %d: fiber %d is %.9g, without a deckle %.9g", *stock,
                             (int)layers[k], i, (double)with[i], (double)without[i]);
                if (thickness[i] < 0.5f && thickness[i] > 0) {
                    thin[0] += (double)with[i];
                    thin[1] += (double)without[i];
                    count[0]++;
                }
                whole += thickness[i] == 1;
            }
            assert_true(count[0] > 4000); /* fibers of the edge */
            if (k < 3)
                assert_true(thin[0] < 0.8 * thin[1]);
            else
                assert_true(thin[0] == thin[1]);
        }
        assert_true(whole > 6 * 0.7 * FIBERS);
        paper_sheet_destroy(deckled);
        paper_sheet_destroy(cut);
    }
}

/* ---- water ---- */

static double totals[2][4];

static void totals_get(struct paper_sheet *sheet, double *of)
{
    for (int i = 0; i < 3; i++)
        check(paper_sheet_total(sheet, i, &of[i]));
    check(paper_sheet_total(sheet, -1, &of[3]));
}

/* Beyond the edge there is nothing, of anything. */
static void beyond_is_empty(struct paper_sheet *sheet)
{
    static float thickness[FEW], values[FEW];
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_THICKNESS, 0, thickness));
    for (int layer = PAPER_LAYER_SURFACE_WATER; layer <= PAPER_LAYER_FIXED_PIGMENT; layer++)
        for (int pigment = 0; pigment < 2; pigment++) {
            check(paper_sheet_layer_read(sheet, (enum paper_layer)layer, pigment, values));
            for (int i = 0; i < FEW; i++)
                if (thickness[i] == 0 && values[i] != 0)
                    fail_msg("layer %d has %.9g in fiber %d, %d, where there is no paper",
                             layer, (double)values[i], i % SMALL, i / SMALL);
        }
}

/* From the picture's left border to x = `to`. */
static void stroke_over_the_edge(struct paper_sheet *sheet, double to)
{
    struct paper_brush brush = paper_brush_default();
    brush.width = 8;
    brush.depth = 3;
    const struct paper_stroke_sample samples[2] = {
        {.x = 2, .y = 40, .pressure = 0.8}, {.time_s = 0.4, .x = to, .y = 60, .pressure = 0.8}};
    check(paper_sheet_brush(sheet, &brush));
    check(paper_sheet_dip(
        sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {1, 0.5, 0.5}}));
    check(paper_sheet_stroke(
        sheet, &(struct paper_stroke){.pace = 30, .samples_count = 2, .samples = samples},
        NULL));
}

/* All kinds of water are put over the edge, and pulled over it. */
static void all_put(struct paper_sheet *sheet)
{
    static float ones[FEW];
    for (int i = 0; i < FEW; i++)
        ones[i] = 0.3f;
    check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){1.5, 0.8, 0.4}));
    check(paper_sheet_wash(sheet, &(struct paper_wash){.from = {0, 0},
                                                       .to = {SMALL, SMALL},
                                                       .amount = {0.4, 0.5},
                                                       .end = {0.2, 0, 0.5}}));
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_INFUSED_WATER, 0, ones));
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_FIXED_PIGMENT, 1, ones));
    stroke_over_the_edge(sheet, SMALL - 2);
}

static void nothing_gets_over_the_edge(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_small();
    struct paper_air air = paper_air_default();
    air.gravity[0] = 0.4;
    air.seep[1] = 0.5;
    check(paper_sheet_air(sheet, &air));
    all_put(sheet);
    beyond_is_empty(sheet);
    totals_get(sheet, totals[0]);
    assert_true(totals[0][1] > 1000 && totals[0][2] > 1000);
    for (int i = 0; i < 150; i++)
        check(paper_sheet_step(sheet));
    totals_get(sheet, totals[1]);
    for (int i = 1; i < 3; i++)
        assert_true(totals[0][i] == totals[1][i]);
    assert_true(totals[0][0] + totals[0][3] == totals[1][0] + totals[1][3]);
    beyond_is_empty(sheet);
    check(paper_sheet_dry(sheet));
    beyond_is_empty(sheet);
    paper_sheet_destroy(sheet);
}

/* Where the paper is taken away what lay there stays, counted, and stands still. */
static void a_hole_holds_what_it_had(void **state)
{
    (void)state;
    static float thickness[FEW], before[FEW], after[FEW];
    struct paper_sheet *sheet = sheet_small();
    check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){1, 0.5, 0.5}));
    totals_get(sheet, totals[0]);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_THICKNESS, 0, thickness));
    for (int i = 0; i < FEW; i++)
        if (hypot(i % SMALL - SMALL / 2, i / SMALL - SMALL / 2) < 8)
            thickness[i] = 0;
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_THICKNESS, 0, thickness));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, before));
    for (int i = 0; i < 30; i++)
        check(paper_sheet_step(sheet));
    check(paper_sheet_dry(sheet));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_FIXED_PIGMENT, 0, after));
    const int middle = (SMALL / 2) * SMALL + SMALL / 2;
    assert_true(before[middle] > 0 && before[middle] == after[middle]);
    totals_get(sheet, totals[1]);
    for (int i = 1; i < 3; i++)
        assert_true(totals[0][i] == totals[1][i]);
    paper_sheet_destroy(sheet);
}

/* ---- sameness ---- */

static void planes_same(struct paper_sheet *a, struct paper_sheet *b, const char *what)
{
    static uint32_t words[2][FEW];
    struct paper_plane planes[PAPER_PLANES_MAX];
    const int count = paper_sheet_planes(a, planes);
    int thick = 0;
    for (int i = 0; i < count; i++) {
        thick += strcmp(planes[i].name, "thickness") == 0;
        check(paper_sheet_plane_read(a, i, words[0]));
        check(paper_sheet_plane_read(b, i, words[1]));
        if (memcmp(words[0], words[1], sizeof words[0]) != 0)
            fail_msg("%s: %s is not the same", what, planes[i].name);
    }
    assert_int_equal(thick, 1);
}

/* The sheet turned left for right, by its layers. */
static void sheet_mirror(struct paper_sheet *sheet)
{
    static const enum paper_layer layers[] = {
        PAPER_LAYER_HEIGHT,  PAPER_LAYER_ABSORBENCY, PAPER_LAYER_CAPACITY, PAPER_LAYER_SIZING,
        PAPER_LAYER_CURRENT, PAPER_LAYER_GRIP,       PAPER_LAYER_THICKNESS};
    static float values[FEW], turned[FEW];
    for (size_t k = 0; k < sizeof layers / sizeof *layers; k++) {
        check(paper_sheet_layer_read(sheet, layers[k], 0, values));
        for (int i = 0; i < FEW; i++)
            turned[i - i % SMALL + (SMALL - 1 - i % SMALL)] =
                layers[k] == PAPER_LAYER_CURRENT ? -values[i] : values[i];
        check(paper_sheet_layer_write(sheet, layers[k], 0, turned));
    }
}

static void a_mirrored_sheet_gives_the_mirrored_picture(void **state)
{
    (void)state;
    static float seen[2][FEW];
    double skew = 0;
    for (int i = 0; i < 2; i++) {
        struct paper_sheet *sheet = sheet_small();
        struct paper_air air = paper_air_default();
        air.gravity[0] = i ? -0.2 : 0.2;
        check(paper_sheet_air(sheet, &air));
        if (i)
            sheet_mirror(sheet);
        check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){1.2, 0.5, 0.5}));
        for (int step = 0; step < 60; step++)
            check(paper_sheet_step(sheet));
        check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, seen[i]));
        paper_sheet_destroy(sheet);
    }
    for (int i = 0; i < FEW; i++) {
        const int j = i - i % SMALL + (SMALL - 1 - i % SMALL);
        skew += fabs((double)(seen[0][i] - seen[0][j]));
        if (seen[0][i] != seen[1][j])
            fail_msg("fiber %d, %d: %.9g, mirrored %.9g", i % SMALL, i / SMALL,
                     (double)seen[0][i], (double)seen[1][j]);
    }
    assert_true(skew > 100); /* the picture is not its own mirror image */
}

static void boxes_change_nothing(void **state)
{
    (void)state;
    struct paper_sheet *sheets[2] = {sheet_small(), sheet_small()};
    double least = 1;
    for (int k = 0; k < 2; k++) {
        uint8_t gray[14 * 14];
        memset(gray, 255, sizeof gray);
        check(paper_sheet_confine(sheets[k], k ? 0 : 8));
        stroke_over_the_edge(sheets[k], 24);
        assert_true(k == 1 || paper_sheet_share(sheets[k]) < 0.5);
        check(paper_sheet_put(
            sheets[k], &(struct paper_screen){.width_px = 14, .height_px = 14, .gray = gray}, 8,
            50, (double[]){2, 1, 0.3}));
        for (int i = 0; i < 60; i++) {
            check(paper_sheet_step(sheets[k]));
            least = fmin(least, paper_sheet_share(sheets[k]));
        }
    }
    assert_true(least < 0.5);
    planes_same(sheets[0], sheets[1], "boxes");
    paper_sheet_destroy(sheets[0]);
    paper_sheet_destroy(sheets[1]);
}

static void what_is_undone_and_done_again_is_the_same(void **state)
{
    (void)state;
    static float values[FEW];
    struct paper_sheet *sheet = sheet_small(), *plain = sheet_small(), *fresh = sheet_small();
    check(paper_history_begin(sheet, 1e6));
    for (int i = 0; i < FEW; i++)
        values[i] = i % SMALL < 40 ? 0 : 0.7f;
    all_put(sheet);
    all_put(plain);
    const int calls = paper_history_done(sheet);
    for (int i = 0; i < 20; i++) {
        check(paper_sheet_step(sheet));
        check(paper_sheet_step(plain));
    }
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_THICKNESS, 0, values));
    check(paper_sheet_step(sheet));
    assert_int_equal(paper_history_undo(sheet, 2), 2);
    planes_same(sheet, plain, "undone");
    paper_history_undo(sheet, calls + 1);
    planes_same(sheet, fresh, "all undone");
    paper_history_redo(sheet, calls + 1);
    planes_same(sheet, plain, "done again");
    paper_sheet_destroy(sheet);
    paper_sheet_destroy(plain);
    paper_sheet_destroy(fresh);
}

/* ---- pictures ---- */

static uint16_t fine[4][3 * 16 * FEW], alpha[16 * FEW];

static void the_picture_lies_on_its_ground(void **state)
{
    (void)state;
    static float thickness[FEW];
    struct paper_sheet *sheet = sheet_small();
    all_put(sheet);
    struct paper_sheet_view view = paper_sheet_view_default(paper_sheet_get_config(sheet));
    view.ground = (const double[]){0, 1, 0.5};
    check(paper_sheet_view(sheet, &view, fine[0]));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_THICKNESS, 0, thickness));
    assert_int_equal(fine[0][0], 0); /* the corner is the ground */
    assert_true(fine[0][1] > 65000 && abs(fine[0][2] - 32768) < 300);
    view.ground = NULL;
    check(paper_sheet_view(sheet, &view, fine[1]));
    view.alpha = alpha;
    check(paper_sheet_view(sheet, &view, fine[2]));
    double dark[2] = {0};
    for (int i = 0; i < FEW; i++) {
        if (thickness[i] == 1) { /* the sheet hides what is behind it */
            assert_int_equal(alpha[i], 65535);
            assert_memory_equal(fine[0] + 3 * i, fine[1] + 3 * i, 6);
        }
        if (thickness[i] == 0)
            dark[i % SMALL + i / SMALL > SMALL] += alpha[i];
    }
    assert_true(alpha[0] == 0);
    assert_true(dark[1] > 3 * dark[0]); /* its shadow falls to the lower right */
    view.light = 0;
    check(paper_sheet_view(sheet, &view, fine[2]));
    for (int i = 0; i < FEW; i++)
        assert_true(thickness[i] > 0 || alpha[i] == 0); /* even light throws none */
    paper_sheet_destroy(sheet);
}

static void finer_pictures_are_the_same_on_the_mean(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_small();
    all_put(sheet);
    struct paper_sheet_view view = paper_sheet_view_default(paper_sheet_get_config(sheet));
    check(paper_sheet_view(sheet, &view, fine[0]));
    for (int scale = 2; scale <= 4; scale += 2) {
        view.scale = scale;
        check(paper_sheet_view(sheet, &view, fine[1]));
        double squares = 0, most = 0;
        for (int y = 0; y < SMALL; y++)
            for (int x = 0; x < SMALL; x++)
                for (int c = 0; c < 3; c++) {
                    double sum = 0;
                    for (int i = 0; i < scale * scale; i++) {
                        const int row = y * scale + i / scale, column = x * scale + i % scale;
                        sum += fine[1][3 * (row * SMALL * scale + column) + c];
                    }
                    const double off =
                        (sum / (scale * scale) - fine[0][3 * (y * SMALL + x) + c]) / 257;
                    squares += off * off;
                    most = fmax(most, fabs(off));
                }
        const double rms = sqrt(squares / (3.0 * FEW));
        printf("%d pixels a fiber: their means are off by %.2f of 255, at most %.1f\n", scale,
               rms, most);
        assert_true(rms < 1.5 && most < 40);
    }
    paper_sheet_destroy(sheet);
}

/* ---- what is wrong ---- */

static void wrong_deckles_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *stock, *says;
        unsigned parts;
        bool torus;
        struct paper_deckle deckle;
    } rows[] = {
        {"rough", "a deckle's margin must be 2..4096 (got 1)", 15, false, {1, 1, 1, 1}},
        {"rough", "a deckle's waves must be 0..256 (got -1)", 15, false, {9, -1, 1, 1}},
        {"rough", "a deckle's thin must be 1..1024 (got nan)", 15, false, {9, 1, NAN, 1}},
        {"rough", "a deckle's fringe must be 0..256 (got 300)", 15, false, {9, 1, 1, 300}},
        {"rough", "more than 112 wide and high", 15, false, {46, 1, 10, 1}},
        {"glass", "glass has no fibers", 15, false, {9, 1, 1, 1}},
        {"rough", "a torus has no edges", 15, true, {9, 1, 1, 1}},
        {"rough", "thesis's paper has no deckle", 0, false, {9, 1, 1, 1}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct paper_sheet_config config = config_of(SMALL, rows[i].stock, 1);
        struct paper_sheet *sheet;
        config.parts = rows[i].parts;
        config.torus = rows[i].torus;
        config.deckle = rows[i].deckle;
        assert_int_equal(paper_sheet_create(&config, &sheet), PAPER_BAD_ARGUMENT);
        if (!strstr(paper_error(), rows[i].says))
            fail_msg("said '%s', not '%s'", paper_error(), rows[i].says);
        assert_null(strchr(paper_error(), '\n'));
    }
    struct paper_sheet_config config = config_of(SMALL, "rough", 1);
    static float ones[FEW];
    config.deckled = false;
    struct paper_sheet *cut = sheet_of(&config);
    assert_int_equal(paper_sheet_layer_write(cut, PAPER_LAYER_THICKNESS, 0, ones),
                     PAPER_BAD_ARGUMENT);
    assert_true(paper_sheet_margin(&config) == 0);
    paper_sheet_destroy(cut);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_edge_wanders_without_a_period),
        cmocka_unit_test(the_sheet_is_thin_at_its_edge),
        cmocka_unit_test(nothing_gets_over_the_edge),
        cmocka_unit_test(a_hole_holds_what_it_had),
        cmocka_unit_test(a_mirrored_sheet_gives_the_mirrored_picture),
        cmocka_unit_test(boxes_change_nothing),
        cmocka_unit_test(what_is_undone_and_done_again_is_the_same),
        cmocka_unit_test(the_picture_lies_on_its_ground),
        cmocka_unit_test(finer_pictures_are_the_same_on_the_mean),
        cmocka_unit_test(wrong_deckles_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
