/* test_frame_rate.c - measures the frame rate of a line of 40 letters in a window of 1280x1024
 * on an Xvfb, whose OpenGL is software, and that of an empty window. Prints rates by the wall
 * clock and processor time per picture. Asserts only that the simulation keeps real time at
 * that rate. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stage_window.h>

#include "clock.h"
#include "scene_springs.h"
#include "xvfb.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

#define LINE "all of forty letters fall onto the floor and play"

static struct font_face *face;

static double processor_s(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* Measures pictures per second of wall clock time, and processor time for each picture in
 * ms. */
static void measure(struct stage *stage, const char *title, double *rate_hz, double *cost_ms)
{
    enum { WARM = 10 };
    struct stage_window_def def = stage_window_def_default();
    struct stage_window *window;
    def.title = title;
    def.width_px = 1280;
    def.height_px = 1024;
    def.fps = 1000; /* as often as can be */
    if (stage_window_create(stage, &def, &window) != STAGE_OK)
        fail_msg("%s", stage_error());
    for (int i = 0; i < WARM; i++)
        assert_int_equal(stage_window_turn(window), STAGE_OK);
    const double began_s = clock_now_s(), began_processor_s = processor_s();
    const double simulated_s = frame_clock_time_s(stage_clock(stage));
    int count = 0;
    for (; clock_now_s() < began_s + 2; count++)
        assert_int_equal(stage_window_turn(window), STAGE_OK);
    const double took_s = clock_now_s() - began_s;
    *rate_hz = count / took_s;
    *cost_ms = 1e3 * (processor_s() - began_processor_s) / count;
    /* the simulation keeps real time, except where a picture took longer than the clock's
     * longest frame */
    const double went_s = frame_clock_time_s(stage_clock(stage)) - simulated_s;
    assert_true(went_s > 0.2 * took_s && went_s < 1.1 * took_s);
    stage_window_destroy(window);
}

static void forty_letters(void **unused)
{
    (void)unused;
    double rate_hz[2], cost_ms[2];
    for (int empty = 0; empty < 2; empty++) {
        struct stage *stage = scene_springs(empty ? "i" : LINE, 0.5, face);
        if (empty) {
            stage_set(stage, "show_letters=off");
            stage_set(stage, "show_springs=off");
            stage_set(stage, "show_masses=off");
        }
        measure(stage, empty ? "nothing" : "forty", &rate_hz[empty], &cost_ms[empty]);
        stage_destroy(stage);
    }
    printf("40 letters at 1280x1024: %.0f pictures a second, %.1f ms of processor time each; "
           "nothing: %.0f "
           "pictures a second, %.1f ms\n",
           rate_hz[0], cost_ms[0], rate_hz[1], cost_ms[1]);
    assert_true(rate_hz[0] > 1 && rate_hz[1] > 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(forty_letters)};
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK)
        return 1;
    if (!screen_start("1400x1100"))
        return 77;
    const int failed = cmocka_run_group_tests_name("frame rate", tests, NULL, NULL);
    screen_end();
    font_face_close(face);
    return failed;
}
