/* test_looks.c - the look of a sheet: compares its colours with Kubelka-Munk by hand, and
 * measures each of watercolour's effects. */
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

enum { SIDE = 96, FIBERS = SIDE * SIDE, MIDDLE = SIDE / 2 };

/* A light pigment that hardly granulates, and a heavy one that does. All tests use both
 * pigments and no 0 in the air's numbers, so that they have the same kernels. */
enum { LIGHT, HEAVY };
#define NONE 1e-7 /* less than a grain */

static struct paper_air air_make(void)
{
    struct paper_air air = paper_air_default();
    for (int axis = 0; axis < 2; axis++)
        air.gravity[axis] = air.seep[axis] = 1e-12; /* moves no grain */
    return air;
}

static struct paper_sheet *sheet_make(const char *stock, const struct paper_air *air)
{
    struct paper_sheet_config config =
        sheet_of_curtis(SIDE, SIDE, "phthalo green", "burnt umber");
    config.stock = *paper_stock_find(stock);
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    check(paper_sheet_air(sheet, air));
    return sheet;
}

static void steps(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++) {
        check(paper_sheet_step(sheet));
        check(paper_sheet_finish(sheet));
    }
}

/* A pigment's amount in all layers. */
static void pigment_read(struct paper_sheet *sheet, int pigment, float *sum)
{
    static float layer[FIBERS];
    memset(sum, 0, FIBERS * sizeof *sum);
    for (int i = 0; i < 3; i++) {
        check(paper_sheet_layer_read(sheet, PAPER_LAYER_SURFACE_PIGMENT + (enum paper_layer)i,
                                     pigment, layer));
        for (int j = 0; j < FIBERS; j++)
            sum[j] += layer[j];
    }
}

/* Mean over the fibers whose centres lie at distances from..to of the middle. */
static double ring_mean(const float *values, double from, double to)
{
    double sum = 0;
    int count = 0;
    for (int i = 0; i < FIBERS; i++) {
        double r = hypot(i % SIDE + 0.5 - MIDDLE, i / SIDE + 0.5 - MIDDLE);
        if (r >= from && r < to) {
            sum += (double)values[i];
            count++;
        }
    }
    return sum / count;
}

/* ---- colours ---- */

/* The reflectance of a layer of thickness 1 over a ground, by the textbook's formulas. */
static double layer_by_hand(double k, double s, double below)
{
    if (s < 1e-12)
        return below * exp(-2 * k);
    double a = 1 + k / s, b = sqrt(a * a - 1);
    double c = a * sinh(b * s) + b * cosh(b * s);
    double r = sinh(b * s) / c, t = b / c;
    return r + t * t * below / (1 - r * below);
}

static void to_lab(const double linear[3], double lab[3])
{
    static const double m[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    static const double white[3] = {0.9505, 1, 1.0890};
    double f[3];
    for (int i = 0; i < 3; i++) {
        double v = 0;
        for (int j = 0; j < 3; j++)
            v += m[i][j] * linear[j];
        v /= white[i];
        f[i] = v > 0.008856 ? cbrt(v) : 7.787 * v + 16.0 / 116;
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

static double difference(const double a[3], const uint16_t *shown)
{
    double b[3], x[3], y[3];
    for (int i = 0; i < 3; i++)
        b[i] = paper_light_linear(shown[i] / 65535.0);
    to_lab(a, x);
    to_lab(b, y);
    return sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) +
                (x[2] - y[2]) * (x[2] - y[2]));
}

/* Puts two pigments into the fibers of one sheet that has all pigments, so that all pairs share
 * one kernel. Writes every layer, so that the machine knows of none that it is 0. */
static void glaze_put(struct paper_sheet *sheet, int count, int one, int two)
{
    static float amounts[FIBERS];
    for (int pigment = 0; pigment < count; pigment++) {
        for (int i = 0; i < FIBERS; i++)
            amounts[i] = pigment == one   ? (float)(i % SIDE * 2.0 / SIDE)
                         : pigment == two ? (float)(i / SIDE * 2.0 / SIDE)
                                          : 0.0f;
        check(paper_sheet_layer_write(sheet, PAPER_LAYER_INFUSED_PIGMENT, pigment, amounts));
    }
}

static void glazes_are_kubelka_munk_by_hand(void **state)
{
    (void)state;
    static float paper[3][FIBERS];
    static uint16_t rgb[3 * FIBERS], sealed[3 * FIBERS];
    static double below[3][FIBERS];
    const struct paper_sheet_view color = {.show = PAPER_SHOW_COLOR};
    double worst = 0;
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = config.height = SIDE;
    config.parts = PAPER_PART_INFUSED;
    static const char *const names[] = {"quinacridone rose",
                                        "indian red",
                                        "cadmium yellow",
                                        "hooker's green",
                                        "cerulean blue",
                                        "burnt umber",
                                        "cadmium red",
                                        "brilliant orange",
                                        "hansa yellow",
                                        "phthalo green",
                                        "french ultramarine",
                                        "interference lilac",
                                        "cyan",
                                        "magenta",
                                        "yellow"}; /* known by three channels */
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        config.pigments[config.pigments_count++] = *paper_pigment_curtis(names[i]);
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    for (int i = 0; i < 3; i++)
        check(
            paper_sheet_layer_read(sheet, PAPER_LAYER_RED + (enum paper_layer)i, 0, paper[i]));
    for (int first = 0; first < config.pigments_count; first += 2) {
        int second = (first + 1) % config.pigments_count;
        const struct paper_pigment *one = &config.pigments[first],
                                   *two = &config.pigments[second];
        for (int i = 0; i < 3; i++) {
            check(paper_sheet_layer_write(sheet, PAPER_LAYER_RED + (enum paper_layer)i, 0,
                                          paper[i]));
            for (int j = 0; j < FIBERS; j++)
                below[i][j] = (double)paper[i][j];
        }
        for (int glaze = 0; glaze < 2; glaze++) {
            glaze_put(sheet, config.pigments_count, first, second);
            check(paper_sheet_view(sheet, &color, rgb));
            for (int i = 0; i < FIBERS; i++) {
                double p = floor(i % SIDE * 2.0 / SIDE * PAPER_GRAINS) / PAPER_GRAINS;
                double q = floor(i / SIDE * 2.0 / SIDE * PAPER_GRAINS) / PAPER_GRAINS, hand[3];
                for (int j = 0; j < 3; j++)
                    hand[j] = below[j][i] =
                        layer_by_hand(p * one->k[j] + q * two->k[j],
                                      p * one->s[j] + q * two->s[j], below[j][i]);
                worst = fmax(worst, difference(hand, rgb + 3 * i));
            }
            check(paper_sheet_seal(sheet));
            check(paper_sheet_view(sheet, &color, sealed));
            for (int i = 0; i < 3 * FIBERS; i++) /* not exact: Q is kept above 0 */
                if (abs(rgb[i] - sealed[i]) > 4)
                    fail_msg("%s: sealing changed %d to %d", one->name, rgb[i], sealed[i]);
        }
    }
    paper_sheet_destroy(sheet);
    if (worst > 0.1)
        fail_msg("colours are off by %g", worst);
}

static void pigments_from_colours_look_so(void **state)
{
    (void)state;
    struct paper_pigment spot = *paper_pigment_number(0);
    for (int i = 0; i < 1000; i++) {
        double black[3], white[3];
        for (int j = 0; j < 3; j++) {
            black[j] = 0.01 + 0.6 * ((i * 7 + j * 3) % 100) / 100;
            white[j] = black[j] + (0.97 - black[j]) * (1 + (i * 13 + j * 29) % 97) / 99;
        }
        enum paper_status status = paper_pigment_colors(&spot, white, black);
        check(status);
        for (int j = 0; j < 3; j++) {
            double w = layer_by_hand(spot.k[j], spot.s[j], 1);
            double b = layer_by_hand(spot.k[j], spot.s[j], 0);
            assert_true(fabs(w - white[j]) < 1e-9 && fabs(b - black[j]) < 1e-9);
        }
    }
    static const double bad[][2] = {{0, 0.5}, {0.5, 0.5}, {0.6, 0.5}, {0.5, 1}, {NAN, 0.5}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        double b[3] = {bad[i][0], 0.1, 0.1}, w[3] = {bad[i][1], 0.5, 0.5};
        assert_int_equal(paper_pigment_colors(&spot, w, b), PAPER_BAD_ARGUMENT);
    }
}

/* ---- effects ---- */

enum { RINGS = 40 };

/* The mean amount in each ring, a fiber wide: the profile across a disc's edge. */
static void profile_read(struct paper_sheet *sheet, int pigment, double profile[RINGS])
{
    static float values[FIBERS];
    pigment_read(sheet, pigment, values);
    for (int i = 0; i < RINGS; i++)
        profile[i] = ring_mean(values, i, i + 1);
}

/* A dried wash is even in the middle, has a dark band as wide as asked (8) at the edge of the
 * wet area, and nothing beyond. */
static void edges_darken(void **state)
{
    (void)state;
    enum { RADIUS = 30 };
    double profile[2][RINGS], middle[2] = {0, 0};
    int peak[2] = {0, 0};
    for (int with = 0; with < 2; with++) {
        struct paper_air air = air_make();
        air.edge = with ? 15 : 0.001;
        air.humidity = 0.0008;
        struct paper_sheet *sheet = sheet_make("cold press", &air);
        disc_put(sheet, SIDE, MIDDLE, MIDDLE, RADIUS, (double[]){0.7, 0.4, NONE});
        steps(sheet, 800);
        check(paper_sheet_dry(sheet));
        profile_read(sheet, LIGHT, profile[with]);
        for (int i = 0; i < RADIUS / 2; i++)
            middle[with] += profile[with][i] * (2 * i + 1) / (RADIUS / 2 * (RADIUS / 2));
        for (int i = 0; i < RINGS; i++)
            peak[with] = profile[with][i] > profile[with][peak[with]] ? i : peak[with];
        paper_sheet_destroy(sheet);
    }
    const double *p = profile[1];
    int width = 0; /* width of the line at half its height above the middle */
    for (int i = 0; i < RINGS; i++)
        width += p[i] > (p[peak[1]] + middle[1]) / 2;
    double edge = (p[27] + p[28] + p[29]) / 3, pale = profile[0][27] + profile[0][28];
    if (!(edge > 1.2 * middle[1] && pale + profile[0][29] < 3 * 1.1 * middle[0]))
        fail_msg("edge to middle: %g, without %g", edge / middle[1],
                 (pale + profile[0][29]) / 3 / middle[0]);
    if (!(p[peak[1]] > 1.4 * middle[1] && peak[1] >= RADIUS - 4 && peak[1] <= RADIUS + 1 &&
          width >= 6 && width <= 9 && p[RADIUS + 3] < 0.1 * middle[1]))
        fail_msg("a line %g times as dark as the middle, at %d, %d wide; beyond it %g",
                 p[peak[1]] / middle[1], peak[1], width, p[RADIUS + 3] / middle[1]);
}

static void backruns_push_pigment_away(void **state)
{
    (void)state;
    static float before[FIBERS], after[FIBERS];
    struct paper_air air = air_make();
    air.humidity = 0.0002;
    struct paper_sheet *sheet = sheet_make("cold press", &air);
    disc_put(sheet, SIDE, MIDDLE, MIDDLE, 40, (double[]){0.25, 0.4, NONE});
    steps(sheet, 30);
    pigment_read(sheet, LIGHT, before);
    disc_put(sheet, SIDE, MIDDLE, MIDDLE, 8,
             (double[]){2, NONE, NONE}); /* clear water into the damp wash */
    steps(sheet, 400);
    pigment_read(sheet, LIGHT, after);
    double inside = ring_mean(after, 0, 6) / ring_mean(before, 0, 6);
    double rim = ring_mean(after, 13, 18) / ring_mean(before, 13, 18);
    if (!(inside < 0.9 && rim > 1.02))
        fail_msg("inside %g, rim %g of what was there", inside, rim);
    paper_sheet_destroy(sheet);
}

static double correlation(const float *a, const float *b)
{
    double sa = 0, sb = 0, aa = 0, bb = 0, ab = 0;
    int count = 0;
    for (int i = 0; i < FIBERS; i++) {
        if (hypot(i % SIDE - MIDDLE, i / SIDE - MIDDLE) > 22)
            continue;
        double x = (double)a[i], y = (double)b[i];
        sa += x;
        sb += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
        count++;
    }
    return (ab - sa * sb / count) / sqrt((aa - sa * sa / count) * (bb - sb * sb / count));
}

static void granulating_pigments_settle_in_hollows(void **state)
{
    (void)state;
    static float height[FIBERS], coarse[FIBERS], fine[FIBERS];
    struct paper_air air = air_make();
    struct paper_sheet *sheet = sheet_make("cold press", &air);
    disc_put(sheet, SIDE, MIDDLE, MIDDLE, 35, (double[]){0.8, 0.4, 0.4});
    steps(sheet, 60);
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_HEIGHT, 0, height));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_FIXED_PIGMENT, HEAVY, coarse));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_FIXED_PIGMENT, LIGHT, fine));
    double deviation[2];
    const float *layers[2] = {coarse, fine};
    for (int i = 0; i < 2; i++) {
        double mean = ring_mean(layers[i], 0, 22), sum = 0;
        int count = 0;
        for (int j = 0; j < FIBERS; j++)
            if (hypot(j % SIDE - MIDDLE, j / SIDE - MIDDLE) <= 22) {
                sum += ((double)layers[i][j] / mean - 1) * ((double)layers[i][j] / mean - 1);
                count++;
            }
        deviation[i] = sqrt(sum / count);
    }
    if (!(correlation(height, coarse) < -0.7 && deviation[0] > 3 * deviation[1]))
        fail_msg("correlation %g, deviations %g and %g", correlation(height, coarse),
                 deviation[0], deviation[1]);
    paper_sheet_destroy(sheet);
}

static void light_pigments_run_ahead(void **state)
{
    (void)state;
    static float light[FIBERS], heavy[FIBERS], wet[FIBERS];
    struct paper_air air = air_make();
    air.settling = 0.001;
    struct paper_sheet *sheet = sheet_make("blotting", &air);
    for (int i = 0; i < FIBERS; i++)
        wet[i] = 0.5f;
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_INFUSED_WATER, 0, wet));
    disc_put(sheet, SIDE, MIDDLE, MIDDLE, 15, (double[]){0.3, 0.5, 0.5});
    steps(sheet, 300);
    pigment_read(sheet, LIGHT, light);
    pigment_read(sheet, HEAVY, heavy);
    double ahead = ring_mean(light, 17, 22) / ring_mean(light, 0, 12);
    double behind = ring_mean(heavy, 17, 22) / ring_mean(heavy, 0, 12);
    if (!(ahead > 2 * behind && ahead > 0.001))
        fail_msg("beyond the edge: %g of the light one, %g of the heavy one", ahead, behind);
    paper_sheet_destroy(sheet);
}

/* Puts a drop on an upright sheet, and measures the length and width of its trace. */
static void drop_hang(const char *stock, int *length, int *width)
{
    enum { TOP = 12, SIZE = 8 };
    static float pigment[FIBERS];
    const double left = MIDDLE - SIZE / 2, right = left + SIZE;
    const double corners[] = {left, TOP, right, TOP, right, TOP + SIZE, left, TOP + SIZE};
    struct paper_air air = air_make();
    air.gravity[1] = 1;
    air.humidity = 0.0001;
    struct paper_sheet *sheet = sheet_make(stock, &air);
    struct paper_screen screen;
    int x, y;
    check(paper_polygon_screen(corners, 4, SIDE, SIDE, &screen, &x, &y));
    check(paper_sheet_put(sheet, &screen, x, y, (double[]){0.8, 1, NONE}));
    paper_screen_destroy(&screen);
    steps(sheet, 400);
    pigment_read(sheet, LIGHT, pigment);
    *length = *width = 0;
    for (int row = 0; row < SIDE; row++) {
        int wide = 0;
        for (int column = 0; column < SIDE; column++)
            wide += pigment[row * SIDE + column] > 0.005f;
        *length += wide > 0;
        *width = wide > *width ? wide : *width;
    }
    paper_sheet_destroy(sheet);
}

/* On paper that takes no water a drop runs down and hardly widens; blotting paper soaks it
 * up. */
static void drops_drip_on_glass(void **state)
{
    (void)state;
    int glass[2], blotting[2];
    drop_hang("glass", &glass[0], &glass[1]);
    drop_hang("blotting", &blotting[0], &blotting[1]);
    if (!(glass[0] > 4 * glass[1] && glass[1] <= 14 && blotting[0] < 3.5 * blotting[1] &&
          glass[0] > 1.5 * blotting[0]))
        fail_msg("on glass %d long and %d wide, on blotting paper %d and %d", glass[0],
                 glass[1], blotting[0], blotting[1]);
}

static void masking_fluid_keeps_clear(void **state)
{
    (void)state;
    static float values[FIBERS];
    static uint8_t on[20 * 20];
    memset(on, 255, sizeof on);
    struct paper_screen screen = {.width_px = 20, .height_px = 20, .gray = on};
    struct paper_air air = air_make();
    struct paper_sheet *sheet = sheet_make("blotting", &air);
    check(paper_sheet_resist(sheet, &screen, 38, 38, true));
    disc_put(sheet, SIDE, MIDDLE, MIDDLE, 35, (double[]){1, 1, NONE});
    steps(sheet, 100);
    pigment_read(sheet, 0, values);
    double inside = 0, outside = 0;
    for (int i = 0; i < FIBERS; i++) {
        bool under = i % SIDE >= 38 && i % SIDE < 58 && i / SIDE >= 38 && i / SIDE < 58;
        *(under ? &inside : &outside) += (double)values[i];
    }
    assert_true(inside == 0 && outside > 1000);
    check(paper_sheet_resist(sheet, &screen, 38, 38, false));
    steps(sheet, 100);
    pigment_read(sheet, 0, values);
    for (int i = 0; i < FIBERS; i++)
        if (i % SIDE >= 38 && i % SIDE < 58 && i / SIDE >= 38 && i / SIDE < 58)
            inside += (double)values[i];
    if (!(inside > 0)) /* and what is wet comes in again */
        fail_msg("inside %g", inside);
    paper_sheet_destroy(sheet);
}

/* ---- papers and shapes ---- */

static void stocks_are_what_they_say(void **state)
{
    (void)state;
    static float height[FIBERS], again[FIBERS];
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = config.height = SIDE;
    for (int i = 0; paper_stock_number(i); i++) {
        config.stock = *paper_stock_number(i);
        config.stock.roughness *= 0.5; /* so that little is cut off */
        struct paper_sheet *sheet;
        for (int turn = 0; turn < 2; turn++) {
            check(paper_sheet_create(&config, &sheet));
            check(paper_sheet_layer_read(sheet, PAPER_LAYER_HEIGHT, 0, turn ? again : height));
            paper_sheet_destroy(sheet);
        }
        assert_memory_equal(height, again, sizeof height);
        double mean = 0, squares = 0;
        for (int j = 0; j < FIBERS; j++)
            mean += (double)height[j] / FIBERS;
        for (int j = 0; j < FIBERS; j++)
            squares += ((double)height[j] - mean) * ((double)height[j] - mean) / FIBERS;
        /* glass has smears and dust, which are no part of its roughness */
        const bool glass = config.stock.roughness == 0;
        double wanted = glass ? 0.09 : config.stock.roughness;
        if (!(fabs(mean - 0.5) <= wanted / 2 + 1e-6 &&
              fabs(sqrt(squares) - wanted) <= wanted / 4 + 1e-6))
            fail_msg("%s: mean %g, deviation %g, not %g", config.stock.name, mean,
                     sqrt(squares), wanted);
    }
}

static void polygons_cover_their_area(void **state)
{
    (void)state;
    static const struct {
        double points[16];
        int count;
        double area;
    } rows[] = {{{10, 10, 20, 10, 20, 20, 10, 20}, 4, 100},
                {{10.25, 10.5, 20.75, 10.5, 20.75, 19, 10.25, 19}, 4, 10.5 * 8.5},
                {{5, 5, 45, 5, 5, 45}, 3, 800},
                {{-50, -50, 500, -50, 500, 500, -50, 500}, 4, 64.0 * 48},
                {{0, 0, 20, 20, 20, 0, 0, 20}, 4, 200}, /* crosses itself */
                {{100, 100, 120, 100, 120, 120}, 3, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct paper_screen screen;
        int x, y;
        check(paper_polygon_screen(rows[i].points, rows[i].count, 64, 48, &screen, &x, &y));
        double area = 0;
        for (int j = 0; j < screen.width_px * screen.height_px; j++)
            area += screen.gray[j] / 255.0;
        if (!(fabs(area - rows[i].area) <= 0.02 * rows[i].area))
            fail_msg("polygon %zu covers %g, not %g", i, area, rows[i].area);
        paper_screen_destroy(&screen);
    }
    struct paper_screen screen;
    int x, y;
    assert_int_equal(
        paper_polygon_screen((double[]){0, 0, NAN, 1, 2, 2}, 3, 9, 9, &screen, &x, &y),
        PAPER_BAD_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glazes_are_kubelka_munk_by_hand),
        cmocka_unit_test(pigments_from_colours_look_so),
        cmocka_unit_test(edges_darken),
        cmocka_unit_test(backruns_push_pigment_away),
        cmocka_unit_test(granulating_pigments_settle_in_hollows),
        cmocka_unit_test(light_pigments_run_ahead),
        cmocka_unit_test(drops_drip_on_glass),
        cmocka_unit_test(masking_fluid_keeps_clear),
        cmocka_unit_test(stocks_are_what_they_say),
        cmocka_unit_test(polygons_cover_their_area),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
