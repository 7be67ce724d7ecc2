/* test_brush.c - brushes: nothing is lost between bristles and fibers, a mirrored stroke gives
 * a mirrored picture, and dry brushes touch only the paper's hills. */
#include <brush.h>
#include <paper.h>
#include <picture.h>

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

enum { WIDTH = 96, HEIGHT = 64, FIBERS = WIDTH * HEIGHT };

/* Every sheet has two pigments, so that all tests have the same kernels. */
static struct paper_sheet *sheet_make(void)
{
    struct paper_sheet_config config =
        sheet_of_two(WIDTH, HEIGHT, "quinacridone rose", "phthalo green");
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    return sheet;
}

static struct paper_brush brush_small(void)
{
    struct paper_brush brush = paper_brush_default();
    brush.width = 12;
    brush.depth = 9;
    brush.bristles = 70;
    brush.reach = 120;
    return brush;
}

/* A substance's total: on the sheet, dried, and in the brush. */
static double everything(struct paper_sheet *sheet, int substance)
{
    double sum, part;
    check(paper_sheet_total(sheet, substance, &sum));
    check(paper_sheet_brush_total(sheet, 0, substance, &part));
    sum += part;
    if (substance == 0) {
        check(paper_sheet_total(sheet, -1, &part));
        sum += part;
    }
    return sum;
}

static double on_sheet(struct paper_sheet *sheet, int substance)
{
    double sum;
    check(paper_sheet_total(sheet, substance, &sum));
    return sum;
}

static double in_brush(struct paper_sheet *sheet, int substance)
{
    double sum;
    check(paper_sheet_brush_total(sheet, 0, substance, &sum));
    return sum;
}

static void dip(struct paper_sheet *sheet, double water, double rose, double green)
{
    check(paper_sheet_dip(
        sheet,
        &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {water, rose, green}}));
}

static const struct paper_stroke_sample wave[] = {
    {.time_s = 0, .x = 10, .y = 30, .pressure = 0.2},
    {.time_s = 0.25, .x = 40, .y = 14.5, .pressure = 0.9, .tilt_x = 0.3},
    {.time_s = 0.4, .x = 60, .y = 45, .pressure = 0.6, .tilt_y = -0.4},
    {.time_s = 0.6, .x = 88, .y = 30.25, .pressure = 0},
};
enum { WAVE = sizeof wave / sizeof *wave };

static void stroke(struct paper_sheet *sheet, const struct paper_stroke_sample *samples,
                   int count, double pace)
{
    check(paper_sheet_stroke(
        sheet, &(struct paper_stroke){.pace = pace, .samples_count = count, .samples = samples},
        NULL));
}

/* ---- matter ---- */

static void what_leaves_the_brush_arrives(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_make();
    struct paper_brush brush = brush_small();
    check(paper_sheet_brush(sheet, &brush));
    for (int i = 0; i < 3; i++) {
        /* the second brush is clean and nearly dry, so it takes up paint; the third is full of
         * thick paint */
        dip(sheet, i == 1 ? 0.02 : 1, i == 1 ? 0 : 0.5, i == 2 ? 4 : 0);
        double before[3], held[3], laid[3];
        for (int j = 0; j < 3; j++) {
            before[j] = everything(sheet, j);
            held[j] = in_brush(sheet, j);
            laid[j] = on_sheet(sheet, j);
        }
        stroke(sheet, wave, WAVE, i == 0 ? 30 : 60);
        for (int j = 0; j < 3; j++)
            if (before[j] != everything(sheet, j))
                fail_msg("stroke %d, substance %d: %.9g became %.9g", i, j, before[j],
                         everything(sheet, j));
        if (i == 1) {
            assert_true(in_brush(sheet, 1) > held[1]);
            assert_true(on_sheet(sheet, 1) < laid[1]);
        } else {
            assert_true(in_brush(sheet, 0) < held[0]);
            assert_true(on_sheet(sheet, 1 + i / 2) > laid[1 + i / 2] + 1);
        }
    }
    paper_sheet_destroy(sheet);
}

static void a_brush_runs_dry(void **state)
{
    (void)state;
    static float rose[FIBERS];
    struct paper_sheet *sheet = sheet_make();
    struct paper_brush brush = brush_small();
    brush.reach = 50;
    check(paper_sheet_brush(sheet, &brush));
    dip(sheet, 1, 0.6, 0);
    const struct paper_stroke_sample line[2] = {
        {.x = 4, .y = 32, .pressure = 0.7}, {.time_s = 0.8, .x = 92, .y = 32, .pressure = 0.7}};
    stroke(sheet, line, 2, 0);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose));
    double part[2] = {0};
    for (int i = 0; i < FIBERS; i++)
        part[i % WIDTH >= WIDTH / 2] += (double)rose[i];
    assert_true(part[0] > 100 && part[1] < 0.6 * part[0] && part[1] > 0);
    /* a stroke with more pressure is wider */
    int rows[2] = {0};
    for (int hard = 0; hard < 2; hard++) {
        const struct paper_stroke_sample again[2] = {
            {.x = 4, .y = 32, .pressure = hard ? 1 : 0.15},
            {.time_s = 0.4, .x = 92, .y = 32, .pressure = hard ? 1 : 0.15}};
        check(paper_sheet_dry(sheet));
        check(paper_sheet_seal(sheet));
        dip(sheet, 1, 0.6, 0);
        stroke(sheet, again, 2, 0);
        check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose));
        for (int y = 0; y < HEIGHT; y++) {
            double sum = 0;
            for (int x = 20; x < 76; x++)
                sum += (double)rose[y * WIDTH + x];
            rows[hard] += sum > 1;
        }
    }
    assert_true(rows[0] >= 1 && rows[1] >= 2 * rows[0]);
    paper_sheet_destroy(sheet);
}

/* How far a fiber stands above the mean around it, with weights 7 - |i| along both axes. */
static double above_around(const float *height, int fiber)
{
    enum { AROUND = 6, SIDE = AROUND + 1 };
    double sum = 0;
    for (int j = -AROUND; j <= AROUND; j++)
        for (int i = -AROUND; i <= AROUND; i++) {
            const int x = fiber % WIDTH + i, y = fiber / WIDTH + j;
            assert_true(x >= 0 && y >= 0 && x < WIDTH && y < HEIGHT);
            sum += (double)height[y * WIDTH + x] * (SIDE - abs(i)) * (SIDE - abs(j));
        }
    return (double)height[fiber] - sum / (SIDE * SIDE * SIDE * SIDE);
}

/* On a slope from one side to the other, as high as heights go, too: a tuft gives way. */
static void a_dry_brush_touches_the_tooth_only(void **state)
{
    (void)state;
    static float height[FIBERS], rose[FIBERS];
    struct paper_sheet *sheet = sheet_make();
    struct paper_brush brush = brush_small();
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_HEIGHT, 0, height));
    for (int i = 0; i < FIBERS; i++)
        height[i] = 0.7f * height[i] + 0.3f * (float)(i % WIDTH) / WIDTH;
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_HEIGHT, 0, height));
    check(paper_sheet_brush(sheet, &brush));
    dip(sheet, 0.03, 1, 0);
    const struct paper_stroke_sample line[2] = {
        {.x = 10, .y = 32, .pressure = 0.9},
        {.time_s = 0.3, .x = 90, .y = 32, .pressure = 0.9}};
    stroke(sheet, line, 2, 0);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose));
    int touched[2] = {0}, below = 0;
    for (int i = 0; i < FIBERS; i++) {
        if (abs(i / WIDTH - 32) > 2 || i % WIDTH < 14 || i % WIDTH >= 86)
            continue;
        const double above = above_around(height, i);
        below += above < -0.07;
        touched[i % WIDTH >= 50] += rose[i] > 0;
        if (rose[i] > 0 && above < -0.07)
            fail_msg("fiber %d is %g above what is around it and was touched", i, above);
    }
    assert_true(below > 20 && touched[0] > 50 && touched[1] < 2 * touched[0]);
    paper_sheet_destroy(sheet);
}

static void masking_fluid_is_not_painted(void **state)
{
    (void)state;
    static float resist[FIBERS], rose[FIBERS];
    for (int i = 0; i < FIBERS; i++)
        resist[i] = i % WIDTH >= 40 && i % WIDTH < 50 ? 1.0f : 0.0f;
    struct paper_sheet *sheet = sheet_make();
    struct paper_brush brush = brush_small();
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_RESIST, 0, resist));
    check(paper_sheet_brush(sheet, &brush));
    dip(sheet, 1, 1, 0);
    stroke(sheet, wave, WAVE, 60);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose));
    double painted = 0;
    for (int i = 0; i < FIBERS; i++) {
        painted += (double)rose[i];
        assert_true(resist[i] < 1 || rose[i] == 0);
    }
    assert_true(painted > 50);
    paper_sheet_destroy(sheet);
}

/* A quick stroke of little paint has streaks along it, and no rows of dots: neither where the
 * bristles touch, nor when it has dried. */
static void a_thin_stroke_has_no_dots(void **state)
{
    (void)state;
    static float layer[FIBERS], rose[FIBERS], ones[FIBERS];
    struct paper_sheet *sheet = sheet_make();
    struct paper_brush brush = brush_small();
    brush.width = 40;
    brush.depth = 9;
    brush.bristles = 280;
    brush.flat = brush.follows = true;
    brush.load = 0.2;
    brush.reach = 900;
    for (int i = 0; i < FIBERS; i++)
        ones[i] = 0.9f; /* bristles reach all fibers */
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_HEIGHT, 0, ones));
    check(paper_sheet_brush(sheet, &brush));
    dip(sheet, 0.4, 0.8, 0);
    const struct paper_stroke_sample line[2] = {
        {.x = 4, .y = 32, .pressure = 0.7}, {.time_s = 0.1, .x = 92, .y = 32, .pressure = 0.7}};
    stroke(sheet, line, 2, 60);
    for (int dried = 0; dried < 2; dried++) {
        for (int i = 0; i < 200 * dried; i++)
            check(paper_sheet_step(sheet));
        memset(rose, 0, sizeof rose);
        for (int k = 0; k < 3; k++) {
            check(paper_sheet_layer_read(
                sheet, PAPER_LAYER_SURFACE_PIGMENT + (enum paper_layer)k, 0, layer));
            for (int i = 0; i < FIBERS; i++)
                rose[i] += layer[i];
        }
        double dots = 0, sum = 0; /* along the stroke, fiber by fiber */
        for (int y = 20; y < 44; y++)
            for (int x = 24; x < 72; x++) {
                const float *at = rose + y * WIDTH + x;
                dots += fabs((double)(at[0] - (at[-1] + at[1]) / 2));
                sum += (double)at[0];
            }
        print_message("thin stroke%s: dots are %.1f%%\n", dried ? ", dry" : "",
                      100 * dots / sum);
        assert_true(sum > 0 && dots < 0.1 * sum);
    }
    paper_sheet_destroy(sheet);
}

/* ---- sameness ---- */

/* Mirrors a sheet by its layers, which hold all its properties. */
static void sheet_mirror(struct paper_sheet *sheet)
{
    static const enum paper_layer layers[] = {PAPER_LAYER_HEIGHT,   PAPER_LAYER_ABSORBENCY,
                                              PAPER_LAYER_CAPACITY, PAPER_LAYER_SIZING,
                                              PAPER_LAYER_CURRENT,  PAPER_LAYER_GRIP};
    static float values[FIBERS], turned[FIBERS];
    for (int k = 0; k < 6; k++) {
        check(paper_sheet_layer_read(sheet, layers[k], 0, values));
        for (int i = 0; i < FIBERS; i++)
            turned[i - i % WIDTH + (WIDTH - 1 - i % WIDTH)] =
                layers[k] == PAPER_LAYER_CURRENT ? -values[i] : values[i];
        check(paper_sheet_layer_write(sheet, layers[k], 0, turned));
    }
}

static void paint(bool mirrored, float *rose, float *water)
{
    struct paper_sheet *sheet = sheet_make();
    if (mirrored)
        sheet_mirror(sheet);
    struct paper_brush brush = brush_small();
    brush.mirrored = mirrored;
    brush.follows = true;
    struct paper_stroke_sample samples[WAVE];
    memcpy(samples, wave, sizeof samples);
    for (int i = 0; i < WAVE && mirrored; i++) {
        samples[i].x = WIDTH - samples[i].x;
        samples[i].tilt_x = -samples[i].tilt_x;
    }
    check(paper_sheet_brush(sheet, &brush));
    dip(sheet, 0.9, 0.7, 0.2);
    stroke(sheet, samples, WAVE, 60);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_PIGMENT, 0, rose));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_WATER, 0, water));
    paper_sheet_destroy(sheet);
}

static void a_mirrored_stroke_gives_the_mirrored_picture(void **state)
{
    (void)state;
    static float rose[3][FIBERS], water[3][FIBERS];
    for (int i = 0; i < 3; i++)
        paint(i == 1, rose[i], water[i]);
    assert_memory_equal(rose[0], rose[2], sizeof rose[0]); /* the same again */
    assert_memory_equal(water[0], water[2], sizeof water[0]);
    double sum = 0, skew = 0;
    for (int i = 0; i < FIBERS; i++) {
        int j = i - i % WIDTH + (WIDTH - 1 - i % WIDTH);
        sum += (double)rose[0][i];
        skew += fabs((double)(rose[0][i] - rose[0][j]));
        if (rose[0][i] != rose[1][j] || water[0][i] != water[1][j])
            fail_msg("fiber %d, %d: %.9g, mirrored %.9g", i % WIDTH, i / WIDTH,
                     (double)rose[0][i], (double)rose[1][j]);
    }
    assert_true(sum > 100 && skew > 0.5 * sum); /* the picture is not its own mirror image */
}

static void one_side_can_be_loaded(void **state)
{
    (void)state;
    static float layer[FIBERS];
    struct paper_sheet *sheet = sheet_make();
    struct paper_brush brush = brush_small();
    brush.follows = true;
    check(paper_sheet_brush(sheet, &brush));
    check(paper_sheet_dip(
        sheet, &(struct paper_dip){.part = 1, .side = {-1, 0}, .amount = {1, 1, 0}}));
    check(paper_sheet_dip(sheet,
                          &(struct paper_dip){.part = 1, .side = {0, 1}, .amount = {1, 0, 1}}));
    const struct paper_stroke_sample line[2] = {
        {.x = 10, .y = 32, .pressure = 0.9},
        {.time_s = 0.3, .x = 90, .y = 32, .pressure = 0.9}};
    stroke(sheet, line, 2, 0);
    double upper[2], lower[2];
    for (int i = 0; i < 2; i++) {
        upper[i] = lower[i] = 0;
        check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_PIGMENT, i, layer));
        for (int j = 0; j < FIBERS; j++)
            *(j / WIDTH < 32 ? &upper[i] : &lower[i]) += (double)layer[j];
    }
    /* the stroke goes to the right, so its left side is above */
    assert_true(upper[0] > 3 * lower[0] && lower[1] > 3 * upper[1]);
    paper_sheet_destroy(sheet);
}

/* ---- what is wrong ---- */

/* The picture of a sheet, kept up to date by looking where it has changed. */
static void picture_follow(struct paper_sheet *sheet, const struct paper_sheet_view *view,
                           uint8_t *rgb)
{
    struct paper_area areas[PAPER_AREAS_MAX];
    for (int i = paper_sheet_changed(sheet, areas) - 1; i >= 0; i--)
        check(paper_sheet_view_area(sheet, view, &areas[i],
                                    rgb + 3 * ((size_t)areas[i].y * WIDTH + (size_t)areas[i].x),
                                    3 * (size_t)WIDTH));
}

static void a_stroke_that_grows_is_the_whole_one(void **state)
{
    static uint8_t kept[3 * FIBERS];
    static uint16_t whole[3 * FIBERS];
    struct paper_brush brush = brush_small();
    struct paper_sheet *sheets[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        sheets[i] = sheet_make();
        check(paper_sheet_brush(sheets[i], &brush));
        dip(sheets[i], 1, 0.5, 0.1);
    }
    const struct paper_sheet_view view =
        paper_sheet_view_default(paper_sheet_get_config(sheets[0]));
    stroke(sheets[0], wave, WAVE, 60);
    check(paper_sheet_confine(sheets[1], 8));
    check(paper_sheet_stroke_begin(sheets[1], 0, 60));
    int steps = 0, more;
    for (int i = 0; i < WAVE; i++) {
        check(paper_sheet_stroke_add(sheets[1], &wave[i], 1, &more));
        steps += more;
        picture_follow(sheets[1], &view, kept);
    }
    assert_true(steps > 10); /* it is painted on its way */
    assert_true(paper_sheet_stroke_growing(sheets[1]));
    check(paper_sheet_stroke_end(sheets[1], &more));
    assert_int_equal(steps + more, 36);
    picture_follow(sheets[1], &view, kept);
    check(paper_sheet_view(sheets[0], &view, whole));
    for (int i = 0; i < 3 * FIBERS; i++)
        assert_int_equal(kept[i], whole[i] >> 8);
    for (int i = 0; i < 3; i++)
        assert_true(everything(sheets[0], i) == everything(sheets[1], i));
    for (int i = 0; i < 2; i++)
        paper_sheet_destroy(sheets[i]);
}

static void wrong_brushes_and_strokes_are_refused(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_make();
    struct paper_brush good = brush_small();
    struct paper_stroke_sample samples[2] = {{.x = 1, .pressure = 0.5},
                                             {.time_s = 1, .pressure = 0.5}};
    struct paper_stroke line = {.pace = 60, .samples_count = 2, .samples = samples};
    assert_int_equal(paper_sheet_stroke(sheet, &line, NULL), PAPER_BAD_ARGUMENT); /* no brush */
    assert_int_equal(paper_sheet_dip(sheet, &(struct paper_dip){.part = 1}),
                     PAPER_BAD_ARGUMENT);
#define REFUSED(member, value, words)                                                          \
    do {                                                                                       \
        struct paper_brush bad = good;                                                         \
        bad.member = value;                                                                    \
        assert_int_equal(paper_sheet_brush(sheet, &bad), PAPER_BAD_ARGUMENT);                  \
        assert_non_null(strstr(paper_error(), words));                                         \
    } while (0)
    REFUSED(number, 8, "0..7 (got 8)");
    REFUSED(bristles, 0, "1..512 (got 0)");
    REFUSED(width, NAN, "width");
    REFUSED(reach, INFINITY, "reach");
    REFUSED(load, -1, "load");
    check(paper_sheet_brush(sheet, &good));
    samples[1].time_s = 0;
    assert_int_equal(paper_sheet_stroke(sheet, &line, NULL), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(paper_error(), "ascend"));
    samples[1].time_s = 9999;
    assert_int_equal(paper_sheet_stroke(sheet, &line, NULL), PAPER_BAD_ARGUMENT);
    samples[1].time_s = 1;
    samples[1].pressure = 1.5;
    assert_int_equal(paper_sheet_stroke(sheet, &line, NULL), PAPER_BAD_ARGUMENT);
    samples[1].pressure = 0.5;
    samples[1].y = NAN;
    assert_int_equal(paper_sheet_stroke(sheet, &line, NULL), PAPER_BAD_ARGUMENT);
    line.samples_count = 0;
    assert_int_equal(paper_sheet_stroke(sheet, &line, NULL), PAPER_BAD_ARGUMENT);
    paper_sheet_destroy(sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_leaves_the_brush_arrives),
        cmocka_unit_test(a_brush_runs_dry),
        cmocka_unit_test(a_dry_brush_touches_the_tooth_only),
        cmocka_unit_test(masking_fluid_is_not_painted),
        cmocka_unit_test(a_thin_stroke_has_no_dots),
        cmocka_unit_test(a_mirrored_stroke_gives_the_mirrored_picture),
        cmocka_unit_test(one_side_can_be_loaded),
        cmocka_unit_test(a_stroke_that_grows_is_the_whole_one),
        cmocka_unit_test(wrong_brushes_and_strokes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
