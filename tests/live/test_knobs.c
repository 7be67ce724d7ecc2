/* test_knobs.c - knobs that are learnt and kept, scenes with and without a fade, a clock's
 * beat. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <exact.h>
#include <knobs.h>

#include "../display/scratch.h"
#include "knobs_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static struct midi_message message(int status, int first, int second)
{
    return midi_message_make(0, (uint8_t)status, (uint8_t)first, (uint8_t)second);
}

static void send(struct knobs *k, int status, int first, int second)
{
    const struct midi_message m = message(status, first, second);
    knobs_message(k, &m);
}

static const char *fresh(const char *name)
{
    const char *path = scratch_path(name);
    unlink(path);
    return path;
}

static struct knobs *opened(struct stage *stage, const char *path)
{
    struct knobs *k;
    if (knobs_open(stage, path, "dark", false, &k) != STAGE_OK)
        fail_msg("%s", stage_error());
    return k;
}

static char *text_of(const char *path)
{
    static char text[8000];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static void text_write(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void a_knob_is_learnt_by_turning_it(void **unused)
{
    (void)unused;
    const char *path = fresh("a.knobs");
    struct stage *stage = scene_stage();
    struct knobs *k = opened(stage, path);
    struct stage_panel_knob knob;
    const int height = scene_row(stage, "height");
    send(k, 0xb0, 74, 127); /* nobody waits for it */
    assert_true(scene_values[0] == 5);
    assert_false(knobs_of(k, height, &knob));
    knobs_learn(k, height);
    assert_true(knobs_of(k, height, &knob) && knob.waits);
    assert_string_equal(knobs_said(k), "turn a knob for height");
    send(k, 0xc0, 3, 0);   /* a program is no knob */
    send(k, 0xb0, 123, 0); /* nor is "all notes off" */
    assert_true(knobs_of(k, height, &knob) && knob.waits);
    send(k, 0xb2, 74, 127);
    assert_true(knobs_of(k, height, &knob) && !knob.waits);
    assert_string_equal(knob.text, "controller 74, ch 3");
    assert_true(knob.from == 0 && knob.to == 1 && scene_values[0] == 10);
    send(k, 0xb2, 74, 0);
    assert_true(scene_values[0] == 0);
    send(k, 0xb1, 74, 127); /* another channel */
    send(k, 0xb2, 75, 127); /* another controller */
    assert_true(scene_values[0] == 0);
    knobs_close(k);
    assert_string_equal(text_of(path),
                        "knobs 1\ntheme dark\nknob control 3 74 height 0 1\nend\n");
    stage_destroy(stage);
}

/* Seven bits, and then the lower seven: a pair, which goes in steps of a 16383rd. */
static void a_pair_is_learnt_by_its_lower_bits(void **unused)
{
    (void)unused;
    const char *path = fresh("fine.knobs");
    struct stage *stage = scene_stage();
    struct knobs *k = opened(stage, path);
    const int height = scene_row(stage, "height");
    knobs_learn(k, height);
    send(k, 0xb2, 7, 64);
    assert_string_equal(knobs_said(k), "controller 7, ch 3 moves height");
    send(k, 0xb2, 39, 3);
    assert_string_equal(knobs_said(k), "fine controller 7, ch 3 moves height");
    assert_true(fabs(scene_values[0] - 10 * (64 * 128 + 3) / 16383.0) < 1e-9);
    send(k, 0xb2, 7, 65); /* its lower bits will follow */
    assert_true(fabs(scene_values[0] - 10 * (64 * 128 + 3) / 16383.0) < 1e-9);
    send(k, 0xb2, 39, 127);
    assert_true(fabs(scene_values[0] - 10 * (65 * 128 + 127) / 16383.0) < 1e-9);
    send(k, 0xb2, 39, 126); /* lower bits alone */
    assert_true(fabs(scene_values[0] - 10 * (65 * 128 + 126) / 16383.0) < 1e-9);
    send(k, 0xb2, 7, 1);
    knobs_frame(k, 0.1, NULL); /* none have followed: they are 0 */
    assert_true(fabs(scene_values[0] - 10 * 128 / 16383.0) < 1e-9);
    send(k, 0xb1, 39, 5); /* another channel */
    send(k, 0xb2, 40, 5); /* another pair */
    knobs_frame(k, 0.2, NULL);
    assert_true(fabs(scene_values[0] - 10 * 128 / 16383.0) < 1e-9);
    knobs_close(k);
    assert_string_equal(text_of(path), "knobs 1\ntheme dark\nknob fine 3 7 height 0 1\nend\n");
    k = opened(stage, path);
    send(k, 0xb2, 7, 127);
    send(k, 0xb2, 39, 127);
    assert_true(scene_values[0] == 10);
    knobs_close(k);
    /* a knob of seven bits stays one where another controller follows much later */
    path = fresh("coarse.knobs");
    k = opened(stage, path);
    knobs_learn(k, height);
    send(k, 0xb2, 7, 64);
    knobs_frame(k, 2, NULL);
    send(k, 0xb2, 39, 3);
    assert_true(fabs(scene_values[0] - 10 * 64 / 127.0) < 1e-9);
    knobs_close(k);
    assert_string_equal(text_of(path),
                        "knobs 1\ntheme dark\nknob control 3 7 height 0 1\nend\n");
    stage_destroy(stage);
}

static void parameters_without_a_number_are_learnt(void **unused)
{
    (void)unused;
    const char *path = fresh("nrpn.knobs");
    struct stage *stage = scene_stage();
    struct knobs *k = opened(stage, path);
    const int height = scene_row(stage, "height");
    knobs_learn(k, height);
    send(k, 0xb0, 99, 7); /* chooses, and is not learnt */
    send(k, 0xb0, 98, 104);
    send(k, 0xb0, 6, 100);
    send(k, 0xb0, 38, 20);
    assert_string_equal(knobs_said(k), "NRPN 1000, ch 1 moves height");
    const double there = 10 * (100 * 128 + 20) / 16383.0;
    assert_true(fabs(scene_values[0] - there) < 1e-9);
    send(k, 0xb0, 98, 105); /* another parameter */
    send(k, 0xb0, 6, 1);
    send(k, 0xb0, 38, 1);
    knobs_frame(k, 0.1, NULL);
    assert_true(fabs(scene_values[0] - there) < 1e-9);
    send(k, 0xb0, 101, 0); /* a registered one, and then none */
    send(k, 0xb0, 100, 0);
    send(k, 0xb0, 6, 1);
    knobs_frame(k, 0.2, NULL);
    assert_true(fabs(scene_values[0] - there) < 1e-9);
    send(k, 0xb0, 99, 7);
    send(k, 0xb0, 98, 104);
    send(k, 0xb0, 6, 127);
    knobs_frame(k, 0.3, NULL);
    assert_true(fabs(scene_values[0] - 10 * (127 * 128) / 16383.0) < 1e-9);
    knobs_close(k);
    assert_string_equal(text_of(path),
                        "knobs 1\ntheme dark\nknob nrpn 1 1000 height 0 1\nend\n");
    static const char *const wrong[] = {"knob fine 1 32 height 0 1",
                                        "knob nrpn 1 16384 height 0 1",
                                        "knob nrpn 1 height 0 1", "knob fine 17 1 height 0 1"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[100];
        snprintf(text, sizeof text, "knobs 1\n%s\nend\n", wrong[i]);
        text_write(path, text);
        assert_int_equal(knobs_open(stage, path, "dark", false, &k), STAGE_BAD_FILE);
    }
    stage_destroy(stage);
}

static void ends_turn_a_knob_round(void **unused)
{
    (void)unused;
    const char *path = fresh("b.knobs");
    struct stage *stage = scene_stage();
    struct knobs *k = opened(stage, path);
    struct stage_panel_knob knob;
    const int weight = scene_row(stage, "weight");
    knobs_end(k, weight, 0.5); /* no knob yet */
    knobs_learn(k, weight);
    send(k, 0xe0, 0x7f, 0x7f);
    assert_true(scene_values[1] == 10000);
    knobs_end(k, weight, 0.75);
    knobs_end(k, weight, 0.25);
    assert_true(knobs_of(k, weight, &knob) && knob.from == 0.25 && knob.to == 0.75);
    int count;
    const struct control *row = &stage_controls(stage, &count)[weight];
    send(k, 0xe0, 0, 0);
    assert_true(fabs(scene_values[1] - control_at(row, 0.25)) < 1e-9);
    send(k, 0xe0, 0, 0x40); /* 8192 of 16383 */
    assert_true(fabs(control_along(row, scene_values[1]) - 0.5) < 1e-4);
    knobs_close(k);
    k = opened(stage, path); /* what was learnt is there again */
    send(k, 0xe0, 0x7f, 0x7f);
    assert_true(fabs(scene_values[1] - control_at(row, 0.75)) < 1e-6);
    knobs_forget(k, weight);
    send(k, 0xe0, 0, 0);
    assert_true(fabs(scene_values[1] - control_at(row, 0.75)) < 1e-6);
    knobs_close(k);
    assert_string_equal(text_of(path), "knobs 1\ntheme dark\nend\n");
    stage_destroy(stage);
}

static void all_kinds_of_knobs_move(void **unused)
{
    (void)unused;
    const char *path = fresh("c.knobs");
    struct stage *stage = scene_stage();
    static const int statuses[4][3] = {
        {0xb5, 1, 127}, {0xe5, 127, 127}, {0xd5, 127, 0}, {0x95, 36, 127}};
    for (int i = 0; i < 4; i++) {
        struct knobs *k = opened(stage, path);
        knobs_learn(k, scene_row(stage, "height"));
        send(k, statuses[i][0], statuses[i][1], statuses[i][2]);
        scene_values[0] = 5;
        send(k, 0x85, 36, 0); /* no key that goes up moves anything */
        send(k, 0x95, 36, 0);
        assert_true(scene_values[0] == 5);
        send(k, statuses[i][0], statuses[i][1], statuses[i][2]);
        assert_true(scene_values[0] == 10);
        knobs_close(k);
    }
    text_write(path, "knobs 1\nknob control * 7 lit 0 1\nknob control * 7 way 0 1\nend\n");
    struct knobs *k = opened(stage, path);
    send(k, 0xb9, 7, 127); /* one knob, two controls, any channel */
    assert_true(scene_values[2] == 1 && scene_values[3] == 2);
    send(k, 0xb0, 7, 60);
    assert_true(scene_values[2] == 0 && scene_values[3] == 1);
    knobs_close(k);
    stage_destroy(stage);
}

static void scenes_come_by_programs(void **unused)
{
    (void)unused;
    const char *path = fresh("d.knobs");
    struct stage *stage = scene_stage();
    struct knobs *k = opened(stage, path);
    scene_values[0] = 1, scene_values[1] = 0.1 + 1, scene_values[2] = 1, scene_values[3] = 2;
    assert_int_equal(knobs_scene_keep(k, 1), STAGE_OK);
    scene_values[0] = 9, scene_values[1] = 9000, scene_values[2] = 0, scene_values[3] = 0;
    assert_int_equal(knobs_scene_keep(k, 2), STAGE_OK);
    assert_int_equal(knobs_scene_keep(k, 2), STAGE_OK); /* again: in its place */
    assert_int_equal(knobs_scene_keep(k, 0), STAGE_BAD_ARGUMENT);
    assert_int_equal(knobs_scene_keep(k, 129), STAGE_BAD_ARGUMENT);
    assert_int_equal(knobs_scene_play(k, 3), STAGE_BAD_ARGUMENT);
    send(k, 0xc4, 0, 0);
    assert_true(scene_values[0] == 1 && scene_values[1] == 0.1 + 1 && scene_values[2] == 1 &&
                scene_values[3] == 2);
    knobs_close(k);
    assert_int_equal(knobs_open(stage, fresh("none.knobs"), NULL, true, &k), STAGE_BAD_FILE);
    assert_null(strstr(strstr(text_of(path), "scene 2 height") + 1, "scene 2 height"));
    k = opened(stage, path);
    send(k, 0xc0, 1, 0);
    assert_true(scene_values[0] == 9 && scene_values[1] == 9000 && scene_values[2] == 0);
    assert_string_equal(knobs_said(k), "scene 2");
    send(k, 0xc0, 77, 0);
    assert_non_null(strstr(knobs_said(k), "no scene 78"));
    assert_true(scene_values[0] == 9);
    knobs_close(k);
    stage_destroy(stage);
}

static void a_fade_goes_along_the_slider(void **unused)
{
    (void)unused;
    const char *path = fresh("e.knobs");
    struct stage *stage = scene_stage();
    text_write(path, "knobs 1\nfade 2 4\nscene 2 weight 10000\nscene 2 lit on\nend\n");
    struct knobs *k = opened(stage, path);
    int count;
    const struct control *row = &stage_controls(stage, &count)[scene_row(stage, "weight")];
    knobs_frame(k, 10, NULL);
    assert_int_equal(knobs_scene_play(k, 2), STAGE_OK);
    double last = 100;
    for (double t = 10; t < 14; t += 0.25) {
        knobs_frame(k, t, NULL);
        assert_true(fabs(control_along(row, scene_values[1]) - (0.5 + (t - 10) / 8)) < 1e-9);
        assert_true(scene_values[1] >= last && scene_values[2] == 0 && scene_values[0] == 5);
        last = scene_values[1];
    }
    knobs_frame(k, 14, NULL);
    assert_true(scene_values[1] == 10000 && scene_values[2] == 1);
    scene_values[1] = 3; /* it is over: hands are free */
    knobs_frame(k, 15, NULL);
    assert_true(scene_values[1] == 3);
    knobs_close(k);
    stage_destroy(stage);
}

static void wrong_files_are_refused_in_one_line(void **unused)
{
    (void)unused;
    static const struct {
        const char *text, *says;
    } wrong[] = {
        {"knob 1\nend\n", ":1: must be `knobs 1`"},
        {"knobs 1\n", "cut short"},
        {"knobs 1\nknob control 17 1 height 0 1\nend\n", ":2: must be `knob KIND"},
        {"knobs 1\nknob control 1 128 height 0 1\nend\n", "`knob KIND"},
        {"knobs 1\nknob bend 1 height 0 1.5\nend\n", "`knob KIND"},
        {"knobs 1\nknob bend 1 height 0 nan\nend\n", "`knob KIND"},
        {"knobs 1\nknob wheel 1 height 0 1\nend\n", "control, fine, nrpn, bend, pressure"},
        {"knobs 1\nknob bend 1 hight 0 1\nend\n", "no control 'hight'; there are"},
        {"knobs 1\nscene 1 height 11\nend\n", "height must be 0..10"},
        {"knobs 1\nscene 1 way up\nend\n", "left right round"},
        {"knobs 1\nscene 129 height 1\nend\n", "NUMBER 1 to 128"},
        {"knobs 1\nfade 1 -1\nend\n", "SECONDS at most 600"},
        {"knobs 1\nturn\nend\n", "knob, scene, fade, theme or end"}};
    struct stage *stage = scene_stage();
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const char *path = scratch_path("wrong.knobs");
        struct knobs *k;
        text_write(path, wrong[i].text);
        assert_int_equal(knobs_open(stage, path, NULL, false, &k), STAGE_BAD_FILE);
        assert_null(k);
        if (!strstr(stage_error(), wrong[i].says) || !strstr(stage_error(), "wrong.knobs") ||
            strchr(stage_error(), '\n'))
            fail_msg("%s: '%s'", wrong[i].text, stage_error());
        assert_string_equal(text_of(path), wrong[i].text); /* it is as it was */
    }
    stage_destroy(stage);
}

static void a_file_that_cannot_be_written_is_said(void **unused)
{
    (void)unused;
    struct stage *stage = scene_stage();
    struct knobs *k = opened(stage, "/no/where/a.knobs");
    knobs_frame(k, 1, NULL);
    assert_int_equal(knobs_scene_keep(k, 1), STAGE_OK);
    knobs_said(k);
    knobs_frame(k, 1.5, NULL);
    assert_null(knobs_said(k));
    knobs_frame(k, 2.5, NULL);
    assert_non_null(strstr(knobs_said(k), "/no/where/a.knobs: cannot be written"));
    knobs_close(k);
    stage_destroy(stage);
}

/* ---- the panel ---- */

static struct knobs *of_panel;

static bool panel_of(void *context, int row, struct stage_panel_knob *out)
{
    (void)context;
    return knobs_of(of_panel, row, out);
}

static void panel_learn(void *context, int row)
{
    (void)context;
    knobs_learn(of_panel, row);
}

static void panel_forget(void *context, int row)
{
    (void)context;
    knobs_forget(of_panel, row);
}

static void panel_end(void *context, int row, double along)
{
    (void)context;
    knobs_end(of_panel, row, along);
}

static bool pointer(struct stage_panel *panel, struct stage *stage, enum input_kind kind,
                    int button, unsigned modifiers, double x, double y)
{
    const struct input_event e = {
        .kind = kind, .x_px = x, .y_px = y, .button = button, .modifiers = modifiers};
    return stage_panel_input(panel, stage, &e);
}

/* `test_knobs FOLDER` writes the panel to look at. */
static const char *folder;

static void picture_write(struct stage *stage, const struct stage_draw_list *list)
{
    char path[600];
    struct stage_exact *exact;
    struct display_image image = {1280, 720, 3, NULL};
    if (!folder)
        return;
    assert_int_equal(stage_exact_create("gaussian-fast", &exact), STAGE_OK);
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    assert_int_equal(stage_exact_draw(exact, list, stage_background(stage), &image), STAGE_OK);
    snprintf(path, sizeof path, "%s/knobs.png", folder);
    assert_int_equal(display_png_write(path, &image), DISPLAY_OK);
    display_image_destroy(&image);
    stage_exact_destroy(exact);
}

static void hands_on_the_panel_learn_and_forget(void **unused)
{
    (void)unused;
    struct stage *stage = scene_stage();
    struct stage_panel *panel;
    struct stage_draw_list list = {0};
    struct stage_panel_knob knob;
    struct font_box way, value;
    const int row = scene_row(stage, "height");
    of_panel = opened(stage, fresh("panel.knobs"));
    assert_int_equal(stage_panel_create("DejaVuSans", &panel), STAGE_OK);
    stage_panel_knobs_set(panel, &(struct stage_panel_knobs){panel_of, panel_learn,
                                                             panel_forget, panel_end, NULL});
    stage_panel_show(panel, true);
    stage_panel_reveal(panel, row);
    stage_draw_begin(&list, STAGE_VIEW_PIXELS);
    stage_panel_draw(panel, stage, 1280, 720, 1, &list);
    const int plain = list.count;
    assert_true(stage_panel_place(panel, row, &way, &value));
    const double y = (way.y0 + way.y1) / 2, width = way.x1 - way.x0;
    assert_true(
        pointer(panel, stage, INPUT_POINTER_DOWN, INPUT_BUTTON_RIGHT, 0, way.x0 + 3, y));
    assert_true(knobs_of(of_panel, row, &knob) && knob.waits);
    send(of_panel, 0xb0, 20, 64);
    /* Shift and a drag move the nearer end, and not the value */
    const double before = scene_values[0];
    pointer(panel, stage, INPUT_POINTER_DOWN, INPUT_BUTTON_LEFT, INPUT_SHIFT,
            way.x0 + 0.3 * width, y);
    pointer(panel, stage, INPUT_POINTER_MOVE, INPUT_BUTTON_LEFT, INPUT_SHIFT,
            way.x0 + 0.2 * width, y);
    pointer(panel, stage, INPUT_POINTER_UP, INPUT_BUTTON_LEFT, INPUT_SHIFT,
            way.x0 + 0.2 * width, y);
    assert_true(knobs_of(of_panel, row, &knob) && fabs(knob.from - 0.2) < 1e-9 && knob.to == 1);
    assert_true(scene_values[0] == before);
    scene_values[0] = 5; /* as it was drawn before */
    stage_draw_begin(&list, STAGE_VIEW_PIXELS);
    stage_panel_draw(panel, stage, 1280, 720, 1, &list);
    assert_int_equal(list.count, plain + 3); /* two ticks, and what is between them */
    if (folder) { /* with another control that waits, and what the first one does beside it */
        knobs_learn(of_panel, scene_row(stage, "weight"));
        pointer(panel, stage, INPUT_POINTER_MOVE, 0, 0, way.x0 + 3, y);
        stage_draw_begin(&list, STAGE_VIEW_PIXELS);
        stage_panel_draw(panel, stage, 1280, 720, 1, &list);
        picture_write(stage, &list);
    }
    pointer(panel, stage, INPUT_POINTER_DOWN, INPUT_BUTTON_RIGHT, INPUT_SHIFT, way.x0 + 3, y);
    assert_false(knobs_of(of_panel, row, &knob));
    pointer(panel, stage, INPUT_POINTER_DOWN, INPUT_BUTTON_LEFT, INPUT_SHIFT,
            way.x0 + 0.5 * width, y); /* no knob: Shift drags the value */
    assert_true(fabs(scene_values[0] - 5) < 1e-6);
    stage_draw_finish(&list);
    stage_panel_destroy(panel);
    knobs_close(of_panel);
    stage_destroy(stage);
}

/* ---- a clock ---- */

static void a_beat_follows_its_clock(void **unused)
{
    (void)unused;
    struct beat beat = {0};
    double phase, tempo;
    struct midi_message m = message(0xfa, 0, 0);
    assert_false(beat_now(&beat, 0, &phase, &tempo));
    beat_take(&beat, &m);
    const double second = 1e9, clock = 60.0 / 132 / 24; /* 132 a minute */
    for (int i = 0; i < 24 * 9; i++) {
        m = midi_message_make((uint64_t)(second * (5 + i * clock)), 0xf8, 0, 0);
        beat_take(&beat, &m);
        if (i < 2)
            continue;
        assert_true(beat_now(&beat, m.time_ns, &phase, &tempo));
        assert_true(fabs(tempo - 132) < 1e-3 && fabs(phase - i % 24 / 24.0) < 1e-9);
        assert_true(
            beat_now(&beat, m.time_ns + (uint64_t)(second * clock / 2), &phase, &tempo));
        assert_true(fabs(phase - (i % 24 + 0.5) / 24.0) < 1e-6);
    }
    assert_false(beat_now(&beat, m.time_ns + 2000000000u, &phase, &tempo)); /* it has gone */
    const uint64_t last = m.time_ns;
    m = message(0xfc, 0, 0);
    beat_take(&beat, &m);
    assert_false(beat_now(&beat, last, &phase, &tempo));
}

static void a_beat_moves_controls(void **unused)
{
    (void)unused;
    const char *path = fresh("f.knobs");
    struct stage *stage = scene_stage();
    text_write(path, "knobs 1\nknob clock height 0 1\nknob tempo weight 0 1\nend\n");
    struct knobs *k = opened(stage, path);
    struct beat beat = {0};
    struct midi_message m;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const double now_ns = 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
    for (int i = 0; i < 25;
         i++) { /* the last clock is now: it is a beat's first; 140 a minute */
        m = midi_message_make((uint64_t)(now_ns - (24 - i) * 1e9 * 60 / 140 / 24), 0xf8, 0, 0);
        beat_take(&beat, &m);
    }
    knobs_frame(k, 1, &beat);
    int count;
    const struct control *row = &stage_controls(stage, &count)[scene_row(stage, "weight")];
    assert_true(fabs(control_along(row, scene_values[1]) - 0.5) < 1e-3);
    assert_true(scene_values[0] >= 10.0 / 24 - 1e-6 && scene_values[0] <= 10 * 2.0 / 24 + 1e-6);
    knobs_close(k);
    stage_destroy(stage);
}

int main(int argc, char **argv)
{
    folder = argc > 1 ? argv[1] : NULL;
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_knob_is_learnt_by_turning_it),
                                       cmocka_unit_test(a_pair_is_learnt_by_its_lower_bits),
                                       cmocka_unit_test(parameters_without_a_number_are_learnt),
                                       cmocka_unit_test(ends_turn_a_knob_round),
                                       cmocka_unit_test(all_kinds_of_knobs_move),
                                       cmocka_unit_test(scenes_come_by_programs),
                                       cmocka_unit_test(a_fade_goes_along_the_slider),
                                       cmocka_unit_test(wrong_files_are_refused_in_one_line),
                                       cmocka_unit_test(a_file_that_cannot_be_written_is_said),
                                       cmocka_unit_test(hands_on_the_panel_learn_and_forget),
                                       cmocka_unit_test(a_beat_follows_its_clock),
                                       cmocka_unit_test(a_beat_moves_controls)};
    return cmocka_run_group_tests_name("knobs", tests, NULL, NULL);
}
