/* test_studio_stamp.c - pictures that are put on the sheet: each fiber's gray against the mean
 * of many more places of the picture, taken by other code; what each kind of them leaves. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <display.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "studio_scene.h"
#include "studio_stamp.h"

enum { FIBERS = SCENE_WIDTH * SCENE_HEIGHT, MANY = 24 };
static char picture[] = "/tmp/lutetia-stamp-XXXXXX.png";

#define good(call) assert_int_equal(call, PAPER_OK)

static void picture_write(int width, int height, void (*fill)(int x, int y, uint8_t rgb[3]))
{
    struct display_image image = {.width_px = width, .height_px = height, .channels = 3};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    for (int i = 0; i < width * height; i++)
        fill(i % width, i / width, image.pixels + 3 * i);
    assert_int_equal(display_png_write(picture, &image), DISPLAY_OK);
    display_image_destroy(&image);
}

/* ---- where it lies, and how dark it is there ---- */

static void noise(int x, int y, uint8_t rgb[3])
{
    const unsigned n = (unsigned)(x * 7919 + y * 104729 + 11);
    rgb[0] = (uint8_t)(n * 2654435761u >> 24);
    rgb[1] = (uint8_t)((n ^ 77) * 2246822519u >> 24);
    rgb[2] = (uint8_t)((n + 5) * 3266489917u >> 24);
}

static double linear(double display)
{
    return display <= 0.04045 ? display / 12.92 : pow((display + 0.055) / 1.055, 2.4);
}

static double noise_light(int width, int height, int x, int y)
{
    uint8_t rgb[3];
    noise(x < 0           ? 0
          : x > width - 1 ? width - 1
                          : x,
          y < 0            ? 0
          : y > height - 1 ? height - 1
                           : y,
          rgb);
    return 0.2126 * linear(rgb[0] / 255.0) + 0.7152 * linear(rgb[1] / 255.0) +
           0.0722 * linear(rgb[2] / 255.0);
}

/* What a fiber should have. */
static double gray_wanted(int width, int height, double size, double degrees, double x,
                          double y, int column, int row)
{
    const double turn = degrees * 3.14159265358979 / 180,
                 scale = size / (width > height ? width : height);
    double sum = 0;
    int hits = 0;
    for (int k = 0; k < MANY * MANY; k++) {
        const double dx = column + (k % MANY + 0.5) / MANY - x,
                     dy = row + (k / MANY + 0.5) / MANY - y;
        /* counterclockwise on the sheet, whose y goes down */
        const double u = (cos(turn) * dx - sin(turn) * dy) / scale + 0.5 * width,
                     v = (sin(turn) * dx + cos(turn) * dy) / scale + 0.5 * height;
        if (u < 0 || v < 0 || u >= width || v >= height)
            continue;
        const double left = floor(u - 0.5), top = floor(v - 0.5), a = u - 0.5 - left,
                     b = v - 0.5 - top;
        const int i = (int)left, j = (int)top;
        sum += (1 - a) * (1 - b) * noise_light(width, height, i, j) +
               a * (1 - b) * noise_light(width, height, i + 1, j) +
               (1 - a) * b * noise_light(width, height, i, j + 1) +
               a * b * noise_light(width, height, i + 1, j + 1);
        hits++;
    }
    if (hits == 0)
        return 0;
    const double light = sum / hits, shown = light <= 0.0031308
                                                 ? 12.92 * light
                                                 : 1.055 * pow(light, 1 / 2.4) - 0.055;
    return 255 * (1 - shown) * hits / (MANY * MANY);
}

static void fibers_are_means(void **state)
{
    (void)state;
    static const struct {
        int width, height;
        double size, degrees, x, y;
    } cases[] = {{13, 9, 37, 30, 40.25, 33.5},
                 {9, 13, 60, -135, 8, 66},
                 {90, 40, 30, 0, 48, 36},
                 {4, 4, 40, 90, 50, 30}};
    const struct paper_sheet_config config = scene_config();
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        struct studio_settings settings;
        struct studio_stamp stamp;
        struct studio_printed printed;
        double worst = 0, sum = 0;
        picture_write(cases[n].width, cases[n].height, noise);
        good(studio_stamp_read(picture, &stamp));
        studio_settings_usual(&settings);
        settings.value[STUDIO_STAMP_SIZE] = cases[n].size;
        settings.value[STUDIO_STAMP_ANGLE] = cases[n].degrees;
        good(studio_stamp_place(&stamp, &settings, cases[n].x, cases[n].y, &config, &printed));
        for (int i = 0; i < FIBERS; i++) {
            const int x = i % SCENE_WIDTH, y = i / SCENE_WIDTH, column = x - printed.x,
                      row = y - printed.y;
            const bool within = column >= 0 && row >= 0 && column < printed.screen.width_px &&
                                row < printed.screen.height_px;
            const double seen =
                within ? printed.screen.gray[row * printed.screen.width_px + column] : 0;
            const double wanted = gray_wanted(cases[n].width, cases[n].height, cases[n].size,
                                              cases[n].degrees, cases[n].x, cases[n].y, x, y);
            worst = fmax(worst, fabs(seen - wanted));
            sum += fabs(seen - wanted);
        }
        /* at the edge of a picture a few samples are a coarse count */
        if (worst > 66 || sum / FIBERS > 1.5)
            fail_msg("case %zu: %g at the most, %g in the mean", n, worst, sum / FIBERS);
        studio_printed_free(&printed);
        studio_stamp_free(&stamp);
    }
}

/* ---- what it leaves ---- */

/* Black at the left, white in the middle, blue at the right. */
static void flag(int x, int y, uint8_t rgb[3])
{
    const uint8_t colours[3][3] = {{0, 0, 0}, {255, 255, 255}, {40, 60, 200}};
    (void)y;
    memcpy(rgb, colours[x / 10], 3);
}

static double layer_sum(struct studio_session *s, enum paper_layer layer, int pigment, int left,
                        int right)
{
    static float values[FIBERS];
    double sum = 0;
    good(paper_sheet_layer_read(studio_session_sheet(s), layer, pigment, values));
    for (int i = 0; i < FIBERS; i++)
        sum += i % SCENE_WIDTH >= left && i % SCENE_WIDTH < right ? (double)values[i] : 0;
    return sum;
}

/* The flag, 60 fibers wide, in the middle: thirds begin at 18, 38 and 58 and end at 78. */
static struct studio_session *stamped(enum studio_stamp_as as, bool negative)
{
    const struct paper_sheet_config config = scene_config();
    struct studio_session *s;
    struct studio_stamp stamp;
    good(studio_session_create(&config, 64e6, &s));
    good(studio_session_set(s, STUDIO_PAUSED, 1));
    good(studio_session_set(s, STUDIO_STAMP_AS, as));
    good(studio_session_set(s, STUDIO_STAMP_NEGATIVE, negative));
    good(studio_session_set(s, STUDIO_STAMP_SIZE, 60));
    good(studio_stamp_read(picture, &stamp));
    good(studio_session_stamp(s, &stamp, 48, 36));
    good(studio_session_stamp(s, &stamp, -500, 36)); /* off the sheet: no deed */
    studio_stamp_free(&stamp);
    assert_int_equal(studio_session_deeds_done(s), 1);
    return s;
}

static void each_kind_leaves_its_own(void **state)
{
    (void)state;
    const enum paper_layer swims = PAPER_LAYER_SURFACE_PIGMENT,
                           water = PAPER_LAYER_SURFACE_WATER, fluid = PAPER_LAYER_RESIST;
    picture_write(30, 10, flag);
    struct studio_session *s = stamped(STUDIO_STAMP_PAINT, false);
    const double blue = layer_sum(s, swims, 0, 20, 36); /* 16 by 20 fibers of 0.6 */
    assert_true(fabs(blue - 16 * 20 * 0.6) < 2);
    assert_true(layer_sum(s, swims, 0, 41, 55) == 0);
    assert_true(layer_sum(s, swims, 0, 80, 96) == 0 && layer_sum(s, fluid, 0, 0, 96) == 0);
    assert_true(studio_session_undo(s));
    assert_true(layer_sum(s, swims, 0, 0, 96) == 0);
    studio_session_destroy(s);

    s = stamped(STUDIO_STAMP_PAINT, true);
    assert_true(layer_sum(s, swims, 0, 20, 36) == 0);
    assert_true(fabs(layer_sum(s, swims, 0, 41, 55) - 14 * 20 * 0.6) < 2);
    studio_session_destroy(s);

    s = stamped(STUDIO_STAMP_WATER, false);
    assert_true(layer_sum(s, swims, 0, 0, 96) == 0);
    assert_true(fabs(layer_sum(s, water, 0, 20, 36) - 16 * 20 * 0.8) < 2);
    studio_session_destroy(s);

    s = stamped(STUDIO_STAMP_FLUID, false);
    assert_true(layer_sum(s, water, 0, 0, 96) == 0);
    assert_true(fabs(layer_sum(s, fluid, 0, 20, 36) - 16 * 20) < 2);
    assert_true(layer_sum(s, fluid, 0, 41, 55) == 0);
    studio_session_destroy(s);

    s = stamped(STUDIO_STAMP_COLOURS, false); /* black takes all of both, blue more of blue */
    assert_true(layer_sum(s, swims, 0, 20, 36) > 100 && layer_sum(s, swims, 1, 20, 36) > 100);
    assert_true(layer_sum(s, swims, 0, 60, 76) > 2 * layer_sum(s, swims, 1, 60, 76));
    assert_true(layer_sum(s, swims, 0, 41, 55) + layer_sum(s, swims, 1, 41, 55) < 5);
    assert_true(fabs(layer_sum(s, water, 0, 20, 76) - 56 * 20 * 0.8) < 10);
    studio_session_destroy(s);
}

static void wrong_pictures_are_told(void **state)
{
    (void)state;
    struct studio_stamp stamp;
    assert_int_equal(studio_stamp_read("/no/such.png", &stamp), PAPER_BAD_FILE);
    assert_null(stamp.rgb);
    assert_non_null(strstr(studio_session_error(), "/no/such.png"));
    FILE *file = fopen(picture, "w"); /* a text: its bytes are no size of a picture */
    assert_non_null(file);
    fputs("this is no picture, though it has the name of one", file);
    fclose(file);
    assert_int_equal(studio_stamp_read(picture, &stamp), PAPER_BAD_FILE);
    assert_non_null(strstr(studio_session_error(), picture));
    assert_non_null(strstr(studio_session_error(), "PNG"));
}

static int begin(void **state)
{
    (void)state;
    const int file = mkstemps(picture, 4);
    return file < 0 ? -1 : close(file);
}

static int end(void **state)
{
    (void)state;
    return unlink(picture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fibers_are_means),
        cmocka_unit_test(each_kind_leaves_its_own),
        cmocka_unit_test(wrong_pictures_are_told),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
