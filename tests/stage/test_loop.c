/* test_loop.c - films that can be repeated: the pictures of a film, in another order, and its
 * end faded into its beginning. What light is, is computed here by itself. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stage_film.h>
#include <stage_loop.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../display/scratch.h"
#include "../sample.h"
#include "scene_springs.h"

enum { WIDTH = 160, HEIGHT = 120, FPS = 20, FADE = 6, COUNT = 17 };

static struct font_face *face;

static struct display_image picture_of(const char *folder, int frame)
{
    char path[600];
    struct display_image image = {0};
    snprintf(path, sizeof path, "%s/frame-%06d.png", folder, frame);
    if (display_png_read_rgb(path, &image) != DISPLAY_OK)
        fail_msg("%s", display_error());
    return image;
}

static void film_make_after(const char *folder, double settle_s, double seconds, double loop_s)
{
    struct stage *stage = scene_springs("wave", 1, face);
    struct stage_film_def def = stage_film_def_default();
    assert_int_equal(mkdir(folder, 0700), 0);
    def.frames = folder;
    def.width_px = WIDTH;
    def.height_px = HEIGHT;
    def.fps = FPS;
    def.seconds = seconds;
    def.loop_s = loop_s;
    def.settle_s = settle_s;
    if (stage_film(stage, &def) != STAGE_OK)
        fail_msg("%s", stage_error());
    stage_destroy(stage);
}

static void film_make(const char *folder, double seconds, double loop_s)
{
    film_make_after(folder, 0, seconds, loop_s);
}

static double light(double number)
{
    return number <= 0.04045 ? number / 12.92 : pow((number + 0.055) / 1.055, 2.4);
}

static double differs(const struct display_image *a, const struct display_image *b)
{
    double sum = 0;
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        sum += abs(a->pixels[i] - b->pixels[i]);
    return sum / (3 * WIDTH * HEIGHT);
}

static bool exists(const char *folder, int frame)
{
    char path[600];
    snprintf(path, sizeof path, "%s/frame-%06d.png", folder, frame);
    return access(path, F_OK) == 0;
}

/* The film without a loop is as long as the loop and its fade. */
static void ends_go_over_into_beginnings(void **state)
{
    (void)state;
    char whole[300], loop[300];
    snprintf(whole, sizeof whole, "%s", scratch_path("whole"));
    snprintf(loop, sizeof loop, "%s", scratch_path("loop"));
    film_make(whole, (double)(COUNT + FADE) / FPS, 0);
    film_make(loop, (double)COUNT / FPS, (double)FADE / FPS);
    assert_true(exists(loop, COUNT - 1));
    assert_false(exists(loop, COUNT));
    double most = 0;
    for (int i = 0; i < COUNT; i++) {
        struct display_image is = picture_of(loop, i), tail = picture_of(whole, i + FADE);
        if (i < COUNT - FADE) {
            assert_memory_equal(is.pixels, tail.pixels, 3 * WIDTH * HEIGHT);
        } else {
            const int at = i - (COUNT - FADE);
            struct display_image head = picture_of(whole, at);
            const double part = (at + 1.0) / (FADE + 1);
            for (int k = 0; k < 3 * WIDTH * HEIGHT; k++) {
                const double wanted = (1 - part) * light(tail.pixels[k] / 255.0) +
                                      part * light(head.pixels[k] / 255.0);
                const double step = light(fmin(255, is.pixels[k] + 1) / 255.0) -
                                    light(fmax(0, is.pixels[k] - 1) / 255.0);
                assert_true(fabs(light(is.pixels[k] / 255.0) - wanted) <= step);
            }
            display_image_destroy(&head);
        }
        if (i > 0) {
            struct display_image before = picture_of(loop, i - 1);
            most = fmax(most, differs(&before, &is));
            display_image_destroy(&before);
        }
        display_image_destroy(&is);
        display_image_destroy(&tail);
    }
    /* the step over the end is one as others */
    struct display_image first = picture_of(loop, 0), last = picture_of(loop, COUNT - 1);
    assert_true(most > 0.5);
    assert_true(differs(&last, &first) <= 1.5 * most);
    display_image_destroy(&first);
    display_image_destroy(&last);
}

/* What begins later is the film without what was before, view included. */
static void loops_begin_after_the_stage_has_settled(void **state)
{
    (void)state;
    enum { SETTLING = 7 };
    char whole[300], loop[300];
    snprintf(whole, sizeof whole, "%s", scratch_path("all"));
    snprintf(loop, sizeof loop, "%s", scratch_path("settled"));
    film_make(whole, (double)(SETTLING + COUNT + FADE) / FPS, 0);
    film_make_after(loop, (double)SETTLING / FPS, (double)COUNT / FPS, (double)FADE / FPS);
    assert_true(exists(loop, COUNT - 1));
    assert_false(exists(loop, COUNT));
    for (int i = 0; i < COUNT - FADE; i++) {
        struct display_image is = picture_of(loop, i),
                             wanted = picture_of(whole, i + SETTLING + FADE);
        assert_memory_equal(is.pixels, wanted.pixels, 3 * WIDTH * HEIGHT);
        display_image_destroy(&is);
        display_image_destroy(&wanted);
    }
}

/* With alpha colours count as much as they cover: what is clear has none. */
static void clear_pixels_have_no_colour(void **state)
{
    (void)state;
    uint8_t from[] = {255, 0, 0, 255, 10, 20, 30, 0, 200, 100, 50, 128};
    const uint8_t into[] = {0, 255, 0, 0, 90, 80, 70, 255, 200, 100, 50, 128};
    struct display_image a = {3, 1, 4, from}, b = {3, 1, 4, (uint8_t *)(uintptr_t)into};
    stage_loop_fade(&a, &b, 0.25);
    static const uint8_t faded[] = {255, 0, 0, 191, 90, 80, 70, 64, 200, 100, 50, 128};
    for (int i = 0; i < 12; i++)
        assert_in_range(from[i], faded[i] - (faded[i] > 0), faded[i] + (faded[i] < 255));
}

static void wrong_fades_are_refused(void **state)
{
    (void)state;
    static const double fades[] = {1, 2, 0.001};
    struct stage *stage = scene_springs("w", 1, face);
    struct stage_film_def def = stage_film_def_default();
    def.frames = scratch_dir;
    def.width_px = def.height_px = 16;
    def.seconds = 1;
    for (int i = 0; i < 3; i++) {
        def.loop_s = fades[i];
        assert_int_equal(stage_film(stage, &def), STAGE_BAD_ARGUMENT);
        assert_non_null(strstr(stage_error(), "shorter than the film"));
    }
    assert_int_equal(scratch_count(), 4); /* the folders of the tests above */
    stage_destroy(stage);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends_go_over_into_beginnings),
        cmocka_unit_test(loops_begin_after_the_stage_has_settled),
        cmocka_unit_test(clear_pixels_have_no_colour),
        cmocka_unit_test(wrong_fades_are_refused),
    };
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK)
        return 1;
    const int failed = cmocka_run_group_tests_name("stage_loop", tests, NULL, NULL);
    font_face_close(face);
    return failed;
}
