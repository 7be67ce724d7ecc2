/* test_stage_window.c - a word of springs in a window on an Xvfb. Pointer and keys change the
 * simulation and the screen. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stage_window.h>

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../display/scratch.h"
#include "clock.h"
#include "scene_springs.h"
#include "xtest.h"

#include <X11/keysym.h>

static struct font_face *face;
static struct stage *stage;
static struct stage_window *window;
static Window there;

static void turn(void)
{
    if (stage_window_turn(window) != STAGE_OK)
        fail_msg("%s", stage_error());
}

/* Runs turns of the window until the condition holds; fails after ten seconds. */
#define UNTIL(condition)                                                                       \
    do {                                                                                       \
        double until_s = clock_now_s() + 10;                                                   \
        do {                                                                                   \
            if (clock_now_s() > until_s)                                                       \
                fail_msg("not so in ten seconds: %s", #condition);                             \
            turn();                                                                            \
        } while (!(condition));                                                                \
    } while (0)

static int setup(void **state)
{
    (void)state;
    struct stage_window_def def = stage_window_def_default();
    def.title = "springs";
    def.width_px = 700;
    def.height_px = 500;
    def.record_path = scratch_path("film.y4m");
    stage = scene_springs("word", 0.5, face);
    if (stage_window_create(stage, &def, &window) != STAGE_OK) {
        print_error("%s\n", stage_error());
        return 1;
    }
    there = screen_window("springs", 10);
    xtest_move(there, 690, 490);
    turn();
    return there == 0;
}

static int teardown(void **state)
{
    (void)state;
    stage_window_destroy(window);
    stage_destroy(stage);
    return !screen_window_gone(there, 5);
}

static struct dyn_network *network(void)
{
    struct stage_actor actor = stage_actor(stage);
    return stage_springs_network(&actor);
}

static struct dyn_state mass(int i)
{
    return dyn_network_states(network())[i];
}

static void point_at(double x, double y)
{
    double x_px, y_px;
    stage_view_to_px(stage_view(stage), x, y, &x_px, &y_px);
    xtest_move(there, (int)lround(x_px), (int)lround(y_px));
}

static unsigned hold_of(int i)
{
    return dyn_mass_get(network(), i).hold;
}

static const struct control *control(const char *name, int *row)
{
    int count;
    const struct control *rows = stage_controls(stage, &count);
    const struct control *found = stage_control_find(rows, count, name);
    assert_non_null(found);
    *row = (int)(found - rows);
    return found;
}

static double value_of(const char *name)
{
    int row;
    return control_read(control(name, &row), stage);
}

/* Reads the window's pixel at a place of the world from the screen. */
static void seen_at(double x, double y, uint8_t rgb[3])
{
    struct display_image image;
    double x_px, y_px;
    stage_view_to_px(stage_view(stage), x, y, &x_px, &y_px);
    screen_read(there, &image);
    assert_non_null(image.pixels);
    int column = (int)x_px, row = (int)y_px;
    assert_true(column >= 0 && row >= 0 && column < image.width_px && row < image.height_px);
    memcpy(rgb, image.pixels + 3 * (row * image.width_px + column), 3);
    display_image_destroy(&image);
}

static void masses_are_dragged_and_let_go(void **state)
{
    (void)state;
    stage_set(stage, "gravity=0");
    struct dyn_state before = mass(0);
    point_at(before.x, before.y);
    xtest_button(1, true);
    turn();
    point_at(before.x - 0.6, before.y + 0.8);
    UNTIL(mass(0).y > before.y + 0.4 && mass(0).x < before.x - 0.2);
    xtest_button(1, false);
    UNTIL(hypot(mass(0).vx, mass(0).vy) < 0.3); /* it swings until it rests */
    assert_int_equal(hold_of(0), DYN_FREE);
    /* Undo puts it back. */
    xtest_type(XK_space);
    UNTIL(stage_clock(stage)->paused);
    xtest_key(XK_Control_L, true);
    xtest_type(XK_z);
    xtest_key(XK_Control_L, false);
    UNTIL(mass(0).x == before.x);
    assert_true(mass(0).y == before.y);
}

/* One turn brings a mass to the pointer, in the simulation and on the screen. */
static void tacks_are_where_the_pointer_is(void **state)
{
    (void)state;
    stage_set(stage, "show_springs=off");
    point_at(mass(1).x, mass(1).y);
    turn();
    xtest_key(XK_Shift_L, true);
    xtest_button(1, true);
    UNTIL(hold_of(1) & DYN_HELD);
    double x_px, y_px, x, y;
    stage_view_to_px(stage_view(stage), 0.4, 2.1, &x_px, &y_px);
    stage_view_to_world(stage_view(stage), round(x_px), round(y_px), &x, &y);
    xtest_move(there, (int)lround(x_px), (int)lround(y_px));
    turn();
    assert_true(fabs(mass(1).x - x) < 1e-9 && fabs(mass(1).y - y) < 1e-9);
    uint8_t seen[3];
    struct stage_color held = stage_theme(stage)->colors[STAGE_COLOR_MASS_HELD];
    seen_at(x, y, seen);
    assert_int_equal(seen[0], lroundf(255 * held.r));
    assert_int_equal(seen[1], lroundf(255 * held.g));
    xtest_button(1, false);
    xtest_key(XK_Shift_L, false);
    UNTIL(hold_of(1) == DYN_STUCK);
    struct stage_color stuck = stage_theme(stage)->colors[STAGE_COLOR_MASS_STUCK];
    seen_at(x, y, seen);
    assert_int_equal(seen[0], lroundf(255 * stuck.r));
    assert_int_equal(seen[2], lroundf(255 * stuck.b));
}

static void strokes_cut_springs(void **state)
{
    (void)state;
    int springs = dyn_springs_count(network()), broken = 0;
    double x = (mass(1).x + mass(4).x) / 2;
    xtest_type(XK_space);
    UNTIL(stage_clock(stage)->paused);
    point_at(x, 2.2);
    turn();
    xtest_button(3, true);
    turn();
    for (double y = 2.2; y > 0.2; y -= 0.25)
        point_at(x, y);
    xtest_button(3, false);
    turn();
    for (int i = 0; i < springs; i++)
        broken += dyn_spring_get(network(), i).broken;
    assert_int_equal(broken, 2);
}

static void letters_are_dragged(void **state)
{
    (void)state;
    stage_set(stage, "gravity=0");
    double x = mass(8).x + 0.5, y = mass(8).y - 0.6;
    double before[4];
    for (int k = 0; k < 4; k++)
        before[k] = mass(8 + k).y;
    point_at(x, y);
    turn();
    xtest_button(1, true);
    turn();
    point_at(x, y + 0.9);
    UNTIL(mass(8).y > before[0] + 0.4 && mass(9).y > before[1] + 0.4 &&
          mass(10).y > before[2] + 0.4 && mass(11).y > before[3] + 0.4);
    xtest_button(1, false);
    turn();
}

static void time_is_stopped_stepped_and_slowed(void **state)
{
    (void)state;
    struct frame_clock *clock = stage_clock(stage);
    UNTIL(mass(0).y < 1.6); /* it falls */
    xtest_type(XK_space);
    UNTIL(clock->paused);
    int64_t steps = clock->steps_count;
    struct dyn_state at = mass(0);
    for (int i = 0; i < 3; i++)
        turn();
    assert_int_equal(clock->steps_count, steps);
    xtest_type(XK_period);
    UNTIL(clock->steps_count != steps);
    assert_int_equal(clock->steps_count, steps + 1);
    assert_true(mass(0).y != at.y);
    xtest_type(XK_minus);
    UNTIL(clock->rate == 0.5);
    xtest_type(XK_minus);
    UNTIL(clock->rate == 0.25);
    assert_true(value_of("rate") == 0.25);
    xtest_type(XK_equal);
    UNTIL(clock->rate == 0.5);
    xtest_type(XK_r); /* the beginning, its rate included */
    UNTIL(mass(0).y == 1.7 && mass(0).vy == 0);
    assert_true(clock->rate == 1 && clock->paused);
    xtest_type(XK_u);
    UNTIL(mass(0).y != 1.7);
}

/* Where the middle of the actor is in the picture. */
static double middle_px(void)
{
    const struct stage_actor actor = stage_actor(stage);
    const struct font_box box = actor.kind->extent(actor.self);
    double x_px, y_px;
    stage_view_to_px(stage_view(stage), (box.x0 + box.x1) / 2, 0, &x_px, &y_px);
    return x_px;
}

/* A title's click folds its group, and unfolds it; a row that is wanted is shown; the stage is
 * beside the panel. */
static void groups_fold(void **state)
{
    (void)state;
    struct font_box title, slider, value;
    int row, first;
    const struct stage_panel *panel = stage_window_panel(window);
    control("rate", &first);
    control("shadow", &row);
    assert_false(stage_panel_title(panel, row, &title));
    xtest_type(XK_space);
    xtest_type(XK_Tab);
    UNTIL(stage_panel_shown(panel));
    turn();
    assert_true(fabs(middle_px() - 200) < 2); /* 300 of the 700 pixels are the panel's */
    assert_true(stage_panel_title(panel, row, &title));
    assert_true(stage_panel_place(panel, first, &slider, &value) && value.y0 >= title.y1 - 1);
    assert_true(stage_panel_place(panel, row, &slider, &value));
    xtest_move(there, (int)title.x0 + 30, (int)(title.y0 + title.y1) / 2);
    xtest_button(1, true);
    xtest_button(1, false);
    UNTIL(!stage_panel_place(panel, row, &slider, &value));
    stage_panel_reveal(stage_window_panel(window), row);
    turn();
    assert_true(stage_panel_place(panel, row, &slider, &value));
    int last;
    stage_controls(stage, &last);
    assert_false(stage_panel_place(panel, last - 1, &slider, &value)); /* far below */
    stage_panel_reveal(stage_window_panel(window), last - 1);
    turn();
    assert_true(stage_panel_place(panel, last - 1, &slider, &value));
    assert_false(stage_panel_title(panel, row, &title)); /* scrolled away */
    xtest_type(XK_Tab);
    UNTIL(!stage_panel_shown(panel));
    turn();
    assert_true(fabs(middle_px() - 350) < 2);
}

static void sliders_and_typed_values_set_controls(void **state)
{
    (void)state;
    struct font_box slider, value;
    int row;
    xtest_type(XK_space);
    xtest_type(XK_Tab);
    UNTIL(stage_panel_shown(stage_window_panel(window)));
    const struct control *gravity = control("gravity", &row);
    stage_panel_reveal(stage_window_panel(window), row);
    turn();
    assert_true(stage_panel_place(stage_window_panel(window), row, &slider, &value));
    int y = (int)((slider.y0 + slider.y1) / 2), width = (int)(slider.x1 - slider.x0);
    xtest_move(there, (int)slider.x0 + width / 4, y);
    xtest_button(1, true);
    UNTIL(fabs(value_of("gravity") - control_at(gravity, 0.25)) < 1.5);
    xtest_move(there, (int)slider.x0 + width * 3 / 4,
               y + 30); /* held, it may leave the slider */
    UNTIL(fabs(value_of("gravity") - control_at(gravity, 0.75)) < 1.5);
    xtest_button(1, false);
    turn();
    xtest_move(there, (int)slider.x0, y);
    turn();
    assert_true(value_of("gravity") > 40);

    /* Types "3.75" with a corrected mistake, and then a value that is refused. */
    xtest_move(there, (int)value.x1 - 5, (int)value.y0 + 5);
    xtest_button(1, true);
    xtest_button(1, false);
    static const KeySym keys[] = {XK_3, XK_period, XK_8, XK_BackSpace, XK_7, XK_5, XK_Return};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        xtest_type(keys[i]);
    UNTIL(value_of("gravity") == 3.75);
    xtest_button(1, true);
    xtest_button(1, false);
    for (int i = 0; i < 4; i++)
        xtest_type(XK_9);
    xtest_type(XK_Return);
    UNTIL(strstr(stage_window_message(window), "gravity must be -100..100"));
    assert_true(value_of("gravity") == 3.75);
    xtest_type(XK_u);
    UNTIL(value_of("gravity") > 40);

    /* A click changes a switch. */
    control("shadow", &row);
    stage_panel_reveal(stage_window_panel(window), row);
    turn();
    assert_true(stage_panel_place(stage_window_panel(window), row, &slider, &value));
    xtest_move(there, (int)value.x1 - 5, (int)value.y0 + 5);
    xtest_button(1, true);
    xtest_button(1, false);
    UNTIL(value_of("shadow") == 1);
    /* A click on the panel takes no mass of the stage. */
    assert_true(stage_undo(stage));
}

static void films_are_recorded(void **state)
{
    (void)state;
    struct stat about;
    xtest_type(XK_v);
    UNTIL(strstr(stage_window_message(window), "recording to"));
    for (double until_s = clock_now_s() + 0.3; clock_now_s() < until_s;)
        turn();
    xtest_type(XK_v);
    UNTIL(stage_window_recorded(window));
    assert_int_equal(stat(stage_window_recorded(window), &about), 0);
    assert_true(about.st_size > 8 * 700 * 500 * 3 / 2);
    assert_non_null(strstr(stage_window_message(window), "pictures in"));
}

/* A red disc in the window's corner. */
static bool recording_is_seen(void)
{
    struct display_image image = {0};
    bool red = false;
    assert_int_equal(stage_window_picture(window, &image), STAGE_OK);
    for (int y = 0; y < 40; y++)
        for (int x = 0; x < 40; x++) {
            const uint8_t *p =
                image.pixels + 3 * ((size_t)y * (size_t)image.width_px + (size_t)x);
            red = red || (p[0] > 150 && p[1] < 90 && p[2] < 90);
        }
    display_image_destroy(&image);
    return red;
}

/* An encoder that takes two seconds to end holds up neither the stage nor the disc's going. */
static void ending_a_film_holds_nothing_up(void **state)
{
    (void)state;
    const char *const path = scratch_path("slow/ffmpeg"), *const was = getenv("PATH");
    char slow[512], before[4096];
    snprintf(slow, sizeof slow, "%s", path);
    *strrchr(slow, '/') = '\0';
    snprintf(before, sizeof before, "%s", was ? was : "");
    assert_true(mkdir(slow, 0700) == 0 || errno == EEXIST);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("#!/bin/sh\n/bin/cat >/dev/null\n/bin/sleep 2\nexit 1\n", file);
    fclose(file);
    chmod(path, 0700);
    setenv("PATH", slow, 1);
    stage_window_destroy(window);
    assert_true(screen_window_gone(there, 5));
    struct stage_window_def def = stage_window_def_default();
    def.title = "springs";
    def.width_px = 700;
    def.height_px = 500;
    def.record_path = scratch_path("film.mp4");
    assert_int_equal(stage_window_create(stage, &def, &window), STAGE_OK);
    there = screen_window("springs", 10);
    turn();
    assert_false(recording_is_seen());
    xtest_type(XK_v);
    UNTIL(strstr(stage_window_message(window), "recording to"));
    UNTIL(recording_is_seen());
    xtest_type(XK_v);
    UNTIL(!recording_is_seen());
    const double began_s = clock_now_s();
    assert_non_null(strstr(stage_window_message(window), "is being ended"));
    for (int i = 0; i < 10; i++)
        turn();
    assert_true(clock_now_s() - began_s < 1.5);
    assert_non_null(strstr(stage_window_message(window), "is being ended"));
    UNTIL(strstr(stage_window_message(window), "cannot write"));
    assert_null(stage_window_recorded(window));
    setenv("PATH", before, 1);
}

static void windows_have_other_sizes_and_fill_the_screen(void **state)
{
    (void)state;
    double scale = stage_view(stage).scale;
    screen_resize(there, 350, 250);
    UNTIL(fabs(stage_view(stage).scale - scale / 2) < 1e-6 * scale);
    xtest_type(XK_f);
    UNTIL(stage_view(stage).scale > 1.1 * scale);
    xtest_type(XK_f);
    UNTIL(fabs(stage_view(stage).scale - scale / 2) < 1e-6 * scale);
}

static void keys_are_listed(void **state)
{
    (void)state;
    struct display_image before, with;
    stage_set(stage, "rate=0.01");
    turn();
    screen_read(there, &before);
    xtest_key(XK_Shift_L, true);
    xtest_type(XK_slash);
    xtest_key(XK_Shift_L, false);
    const char *does;
    int rows = 0;
    while (stage_window_key(rows, &does)) {
        assert_true(does[0]);
        rows++;
    }
    assert_in_range(rows, 15, 40);
    /* The panel with the list of keys covers the upper left. */
    uint8_t panel = (uint8_t)lroundf(255 * stage_theme(stage)->colors[STAGE_COLOR_PANEL].r);
    int alike = 0;
    for (double until_s = clock_now_s() + 10; alike < 1000 && clock_now_s() < until_s;) {
        turn();
        screen_read(there, &with);
        alike = 0;
        for (int y = 30; y < 130; y++)
            for (int x = 30; x < 130; x++)
                alike += abs(with.pixels[3 * (y * with.width_px + x)] - panel) < 2;
        display_image_destroy(&with);
    }
    assert_true(alike >= 1000);
    display_image_destroy(&before);
    xtest_type(XK_Escape); /* closes the list, then the window */
    for (int i = 0; i < 3; i++)
        turn();
    assert_true(stage_window_open(window));
    xtest_type(XK_Escape);
    UNTIL(!stage_window_open(window));
}

/* ---- what is played meanwhile ---- */

static int played_pipe[2];

static int played_readable(void *context)
{
    (void)context;
    return played_pipe[0];
}

static enum stage_status played_take(void *context, struct stage *of, double now_s)
{
    char byte;
    (void)context;
    (void)of;
    (void)now_s;
    while (read(played_pipe[0], &byte, 1) == 1)
        ;
    return STAGE_OK;
}

/* Pictures are two seconds apart: the next one comes at once where something is played, and in
 * time where nothing is. */
static void a_picture_comes_when_it_is_played(void **state)
{
    (void)state;
    struct stage_window_def def = stage_window_def_default();
    def.fps = 0.5;
    def.before = played_take;
    def.readable = played_readable;
    assert_int_equal(pipe2(played_pipe, O_NONBLOCK), 0);
    stage = scene_springs("word", 0.5, face);
    assert_int_equal(stage_window_create(stage, &def, &window), STAGE_OK);
    turn();
    const double began_s = clock_now_s();
    assert_int_equal(write(played_pipe[1], "a", 1), 1);
    turn();
    const double played_s = clock_now_s();
    turn();
    const double ended_s = clock_now_s();
    assert_true(played_s - began_s < 1.5);
    assert_true(ended_s - played_s > 1.5);
    stage_window_destroy(window);
    stage_destroy(stage);
    close(played_pipe[0]);
    close(played_pipe[1]);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(masses_are_dragged_and_let_go),
        TEST(tacks_are_where_the_pointer_is),
        TEST(strokes_cut_springs),
        TEST(letters_are_dragged),
        TEST(time_is_stopped_stepped_and_slowed),
        TEST(groups_fold),
        TEST(sliders_and_typed_values_set_controls),
        TEST(films_are_recorded),
        TEST(ending_a_film_holds_nothing_up),
        TEST(windows_have_other_sizes_and_fill_the_screen),
        TEST(keys_are_listed),
        cmocka_unit_test(a_picture_comes_when_it_is_played),
    };
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK)
        return 1;
    if (!screen_start("1000x800"))
        return 77;
    scratch_path(""); /* before there are windows */
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    screen_end();
    font_face_close(face);
    return failed;
}
