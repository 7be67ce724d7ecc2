/* test_studio_window.c - the studio's window on an Xvfb, played recorded input in place of a
 * hand: what it saves is what the paper's own functions make of the same deeds, bit for bit;
 * and what it says when something is wrong. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <brush.h>
#include <display.h>
#include <history.h>
#include <state.h>

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "clock.h"
#include "studio_played.h"
#include "studio_scene.h"
#include "xvfb.h"

/* ---- what is painted ---- */

static void expected_write(const char *path)
{
    static uint16_t rgb[3 * SCENE_WIDTH * SCENE_HEIGHT];
    const struct paper_sheet_config config = scene_config();
    struct paper_sheet *sheet;
    struct paper_sheet_view view = paper_sheet_view_default(&config);
    view.show = PAPER_SHOW_WET;
    assert_int_equal(paper_sheet_create(&config, &sheet), PAPER_OK);
    assert_int_equal(paper_history_begin(sheet, 0), PAPER_OK);
    assert_int_equal(scene_paint(sheet), PAPER_OK);
    assert_int_equal(paper_sheet_view(sheet, &view, rgb), PAPER_OK);
    assert_int_equal(display_png_write_16(path, SCENE_WIDTH, SCENE_HEIGHT, 3, rgb), DISPLAY_OK);
    paper_sheet_destroy(sheet);
}

static void window_paints_what_calls_paint(void **state)
{
    (void)state;
    char *seen, *expected;
    FILE *events = played_begin();
    scene_write(events, 4);
    fprintf(
        events,
        "4 picture %s\n4 script %s\n4 set show colour\n4 picture %s\n4 script %s\n4 close\n",
        played_path("seen.png"), played_path("scene.lua"), played_path("colour.png"),
        played_path("bare.lua"));
    fclose(events);
    played_run(NULL);
    if (played.status != 0)
        print_message("%s", played.errors);
    assert_int_equal(played.status, 0);
    expected_write(played_path("expected.png"));
    const size_t count = played_file(played_path("seen.png"), &seen),
                 wanted = played_file(played_path("expected.png"), &expected);
    assert_int_equal(count, wanted);
    assert_memory_equal(seen, expected, count);
    free(seen);
    free(expected);
}

static void script_makes_the_same(void **state)
{
    (void)state;
    played_script_is("scene.lua", "made/scene.png", "seen.png");
    played_script_is("bare.lua", "made/bare.png", "colour.png");
}

/* How many operations of that name the saved sheet has. */
static int saved_count(const char *name, const char *what)
{
    struct paper_state *file;
    struct paper_sheet *sheet;
    struct paper_moment moment;
    int count = 0;
    assert_int_equal(paper_state_open(played_path(name), &file), PAPER_OK);
    assert_int_equal(paper_state_load(file, 0, false, 0, &sheet), PAPER_OK);
    for (int i = 0; paper_history_moment(sheet, i, &moment); i++)
        count += strcmp(moment.what, what) == 0;
    paper_sheet_destroy(sheet);
    paper_state_close(file);
    return count;
}

/* A pen that is held the other way round is another tool, for as long as it is. */
static void eraser_is_another_tool(void **state)
{
    (void)state;
    FILE *events = played_begin();
    fprintf(events, "0 set paused on\n0 set tool brush\n0.1 down -20 0 0.5\n0.15 up 20 0 0.5\n"
                    "0.2 eraser-move -20 9 0\n0.25 eraser-down -20 10 0.5\n"
                    "0.3 eraser-move 0 10 0.5\n0.35 eraser-up 20 10 0.5\n"
                    "0.4 down -20 20 0.5\n0.45 up 20 20 0.5\n0.5 set eraser water\n"
                    "0.5 set shape line\n0.55 eraser-down -20 30 0.5\n"
                    "0.6 eraser-up 20 30 0.5\n0.65 set tool wash\n0.65 set eraser unmask\n"
                    "0.7 eraser-down -20 30 0.5\n0.75 eraser-up 20 30 0.5\n"
                    "0.8 down -20 -20 0.5\n0.85 up 20 20 0.5\n");
    fprintf(events, "0.9 save %s\n1 close\n", played_path("erased.h5"));
    fclose(events);
    played_run(NULL);
    assert_int_equal(played.status, 0);
    assert_int_equal(saved_count("erased.h5", "stroke"), 3);
    assert_int_equal(saved_count("erased.h5", "lift"), 1);
    assert_int_equal(saved_count("erased.h5", "resist"), 1);
    assert_int_equal(saved_count("erased.h5", "wash"), 1);
}

/* A selection by the window's tool, what is painted across it, and nothing selected any more:
 * its script makes the same. */
static void selection_is_in_the_script(void **state)
{
    (void)state;
    FILE *events = played_begin();
    fprintf(events, "0 set paused on\n0 view 4 48 36 0 0\n0 set tool select\n"
                    "0 set outline ellipse\n0.1 down -80 -60 0.5\n0.2 up 80 60 0.5\n"
                    "0.21 shift-down 60 40 0.5\n0.22 up 150 120 0.5\n"
                    "0.23 set outline rectangle\n0.23 alt-down -40 -40 0.5\n"
                    "0.24 up 10 60 0.5\n0.25 action select-invert\n"
                    "0.26 action select-invert\n"
                    "0.3 set tool brush\n0.3 down -170 0 0.5\n0.35 move 0 20 0.8\n"
                    "0.4 up 170 0 0.5\n0.5 step 12\n0.6 action select-none\n"
                    "0.7 down -170 100 0.5\n0.8 up 170 100 0.5\n0.9 step 3\n");
    fprintf(events, "1 picture %s\n1 script %s\n1 save %s\n1.1 close\n",
            played_path("part.png"), played_path("part.lua"), played_path("part.h5"));
    fclose(events);
    played_run(NULL);
    assert_int_equal(played.status, 0);
    assert_int_equal(saved_count("part.h5", "resist"), 10); /* 1, four pairs, 1 */
    played_script_is("part.lua", "made/part.png", "part.png");
}

/* Pictures of all four kinds, put by clicks: the script makes the same. */
static void stamps_are_in_the_script(void **state)
{
    (void)state;
    static const char *const kinds[] = {"fluid", "water", "paint", "colours"};
    struct display_image image = {.width_px = 20, .height_px = 12, .channels = 3};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    for (int i = 0; i < 3 * 20 * 12; i++)
        image.pixels[i] = (uint8_t)(i * 37 % 256);
    assert_int_equal(display_png_write(played_path("leaf.png"), &image), DISPLAY_OK);
    display_image_destroy(&image);
    FILE *events = played_begin();
    fprintf(events,
            "0 set paused on\n0 view 4 48 36 0 0\n0 stamp %s\n0 set stamp_size 30\n"
            "0 set stamp_angle 25\n",
            played_path("leaf.png"));
    for (int i = 0; i < 4; i++)
        fprintf(events, "0.%d set stamp_as %s\n0.%d down %d %d\n0.%d up 0 0\n0.%d step 3\n",
                1 + i, kinds[i], 1 + i, -80 + 50 * i, 20 * i - 30, 1 + i, 1 + i);
    fprintf(events, "1 picture %s\n1 script %s\n1.1 save %s\n1.2 close\n",
            played_path("stamped.png"), played_path("stamped.lua"), played_path("stamped.h5"));
    fclose(events);
    played_run(NULL);
    assert_int_equal(played.status, 0);
    assert_int_equal(saved_count("stamped.h5", "put"), 2);
    assert_int_equal(saved_count("stamped.h5", "print"), 1);
    assert_int_equal(saved_count("stamped.h5", "resist"), 1);
    played_script_is("stamped.lua", "made/stamped.png", "stamped.png");
}

/* Springy type is taken by a letter, thrown, and let into the paper when it rests: one deed,
 * which the script has. A click beside it, and the setting of another tool, print nothing. */
static void springy_type_is_printed_where_it_lands(void **state)
{
    (void)state;
    FILE *events = played_begin();
    fprintf(events,
            "0 set paused on\n0 view 4 48 36 0 0\n0 set tool type\n0 set springs jelly\n"
            "0 set type_size 30\n0 set slide 0.3\n0.1 type 20 50 Wa\n"
            "0.2 down -104 16\n0.25 move -80 0\n0.3 move -60 -10\n0.35 up -60 -10\n"
            "0.36 down 180 120\n0.37 up 180 120\n"
            "6 step 3\n6.1 set tool brush\n6.1 type 20 50 never\n6.1 down -104 16\n"
            "6.2 set tool brush\n6.3 picture %s\n6.3 script %s\n6.4 save %s\n6.5 close\n",
            played_path("thrown.png"), played_path("thrown.lua"), played_path("thrown.h5"));
    fclose(events);
    played_run(NULL);
    assert_int_equal(played.status, 0);
    assert_int_equal(saved_count("thrown.h5", "put"), 1);
    played_script_is("thrown.lua", "made/thrown.png", "thrown.png");
}

/* ---- shapes and steadying ---- */

/* The strokes of a saved sheet, in their order; the caller frees each with its moment's
 * name. */
static int strokes_read(const char *name, struct paper_stroke *strokes[], int most)
{
    struct paper_state *file;
    struct paper_sheet *sheet;
    struct paper_moment moment;
    int count = 0;
    assert_int_equal(paper_state_open(played_path(name), &file), PAPER_OK);
    assert_int_equal(paper_state_load(file, 0, false, 0, &sheet), PAPER_OK);
    for (int i = 0; paper_history_moment(sheet, i, &moment); i++) {
        void *arguments;
        if (strcmp(moment.what, "stroke") != 0)
            continue;
        assert_true(count < most);
        assert_int_equal(paper_history_arguments(sheet, i, &arguments), PAPER_OK);
        strokes[count++] = arguments;
    }
    paper_sheet_destroy(sheet);
    paper_state_close(file);
    return count;
}

#define VIEW_ZOOM 2.5
#define VIEW_DEGREES 30.0

/* The sheet's place under a place of the canvas, from its middle: turned, mirrored. */
static void place_of(double u, double v, double place[2])
{
    const double turn = VIEW_DEGREES * 3.14159265358979 / 180;
    place[0] = SCENE_WIDTH / 2.0 - (cos(turn) * u + sin(turn) * v) / VIEW_ZOOM;
    place[1] = SCENE_HEIGHT / 2.0 + (cos(turn) * v - sin(turn) * u) / VIEW_ZOOM;
}

static bool at_place(const struct paper_stroke_sample *sample, const double place[2])
{
    return fabs(sample->x - place[0]) < 1e-6 && fabs(sample->y - place[1]) < 1e-6;
}

static void line_is_straight(const struct paper_stroke *line)
{
    const struct paper_stroke_sample *first = line->samples,
                                     *last = first + line->samples_count - 1;
    const double along[2] = {last->x - first->x, last->y - first->y};
    double ends[2][2], before = -1;
    place_of(-70, -20, ends[0]);
    place_of(60, 45, ends[1]);
    assert_true(line->samples_count > 8 && at_place(first, ends[0]) && at_place(last, ends[1]));
    for (int i = 0; i < line->samples_count; i++) {
        const double x = first[i].x - first->x, y = first[i].y - first->y,
                     at = x * along[0] + y * along[1];
        assert_true(fabs(x * along[1] - y * along[0]) < 1e-6 && at > before);
        before = at;
    }
}

/* Between the places where the hand came down and was lifted, upright on the sheet, closed. */
static void ellipse_is_one(const struct paper_stroke *ellipse)
{
    double a[2], b[2], left = 1e9, right = -1e9;
    place_of(-40, -40, a);
    place_of(50, 30, b);
    for (int i = 0; i < ellipse->samples_count; i++) {
        const struct paper_stroke_sample *at = &ellipse->samples[i];
        const double x = (2 * at->x - a[0] - b[0]) / (b[0] - a[0]),
                     y = (2 * at->y - a[1] - b[1]) / (b[1] - a[1]);
        assert_true(fabs(x * x + y * y - 1) < 1e-6);
        left = fmin(left, x);
        right = fmax(right, x);
    }
    const double ends[2] = {ellipse->samples[0].x, ellipse->samples[0].y};
    assert_true(at_place(&ellipse->samples[ellipse->samples_count - 1], ends));
    assert_true(left < -0.98 && right > 0.98);
}

/* How far a way goes to both sides of the canvas's middle line, in its units. */
static double reach_of(const struct paper_stroke *stroke)
{
    const double turn = VIEW_DEGREES * 3.14159265358979 / 180;
    double most = 0;
    for (int i = 1; i + 1 < stroke->samples_count; i++) {
        const double x = SCENE_WIDTH / 2.0 - stroke->samples[i].x,
                     y = stroke->samples[i].y - SCENE_HEIGHT / 2.0;
        most = fmax(most, fabs(VIEW_ZOOM * (sin(turn) * x + cos(turn) * y)));
    }
    return most;
}

/* A line, an ellipse, a hand that trembles, and the same one steadied, seen turned and
 * mirrored. */
static void hand_is_helped(void **state)
{
    (void)state;
    struct paper_stroke *strokes[5];
    double end[2];
    FILE *events = played_begin();
    fprintf(events, "0 set paused on\n0 view %g %g %g %g 1\n", VIEW_ZOOM, SCENE_WIDTH / 2.0,
            SCENE_HEIGHT / 2.0, VIEW_DEGREES);
    fprintf(events, "0.1 set shape line\n0.1 down -70 -20 0.5\n0.15 move 10 -60 0.5\n"
                    "0.2 up 60 45 0.5\n0.3 set shape ellipse\n0.3 down -40 -40 0.5\n"
                    "0.4 up 50 30 0.5\n0.5 set shape free\n");
    for (int steady = 0; steady < 2; steady++) {
        fprintf(events, "%d set steady %d\n%d.0 down -60 0 0.5\n", 1 + steady, steady,
                1 + steady);
        for (int i = 1; i < 40; i++)
            fprintf(events, "%d.%03d move %d %d 0.5\n", 1 + steady, 10 * i, -60 + 3 * i,
                    i % 2 ? 12 : -12);
        fprintf(events, "%d.4 up 60 0 0.5\n", 1 + steady);
    }
    fprintf(events, "3 save %s\n3.1 close\n", played_path("helped.h5"));
    fclose(events);
    played_run(NULL);
    assert_int_equal(played.status, 0);
    assert_int_equal(strokes_read("helped.h5", strokes, 5), 4);
    line_is_straight(strokes[0]);
    ellipse_is_one(strokes[1]);
    place_of(60, 0, end);
    for (int i = 2; i < 4; i++)
        assert_true(at_place(&strokes[i]->samples[strokes[i]->samples_count - 1], end));
    assert_int_equal(strokes[2]->samples_count, 41);
    assert_true(fabs(reach_of(strokes[2]) - 12) < 1e-6 && reach_of(strokes[3]) < 3);
    for (int i = 0; i < 4; i++)
        paper_history_arguments_free("stroke", strokes[i]);
}

/* Saved, and closed, in mid-stroke; the focus lost in another one: each is one stroke, and none
 * is lost. */
static void closed_in_mid_stroke(void **state)
{
    (void)state;
    FILE *events = played_begin();
    fprintf(events,
            "0 set paused on\n0 down -20 0 0.5\n0.05 move 0 5 0.6\n0.1 move 20 0 0.6\n");
    fprintf(events, "0.2 focus-lost\n0.3 move 30 30 0.5\n0.3 up 30 30 0.5\n");
    fprintf(events, "0.4 down -20 20 0.5\n0.45 set tool blot\n0.5 move 0 25 0.6\n");
    fprintf(events, "0.5 save %s\n0.55 move 20 20 0.6\n0.6 close\n", played_path("mid.h5"));
    fclose(events);
    played_run(NULL);
    assert_int_equal(played.status, 0);
    assert_int_equal(saved_count("mid.h5", "stroke"), 2);
    assert_int_equal(saved_count("mid.h5", "blot"), 0);
}

/* ---- what is drawn again ---- */

enum { PART_LEFT = 240, PART_TOP = 120, PART_WIDTH = 560, PART_HEIGHT = 640, SHOWN_S = 60 };

/* The middle of the canvas, under the message that a picture was written. */
static void canvas_read(Window window, uint8_t *rgb)
{
    struct display_image image;
    screen_read(window, &image);
    assert_true(image.width_px >= PART_LEFT + PART_WIDTH &&
                image.height_px >= PART_TOP + PART_HEIGHT);
    for (int y = 0; y < PART_HEIGHT; y++)
        memcpy(rgb + 3 * (size_t)y * PART_WIDTH,
               image.pixels + 3 * ((size_t)(PART_TOP + y) * (size_t)image.width_px + PART_LEFT),
               3 * PART_WIDTH);
    display_image_destroy(&image);
}

static void canvas_play(void)
{
    FILE *events = played_begin();
    const char *turned = "3.7 47.3 35.1 20 1";
    fprintf(events, "0 set paused on\n0 set show colour\n0 set width 9\n0.1 view %s\n", turned);
    for (int stroke = 0; stroke < 2; stroke++) {
        const double at_s = 0.5 + stroke;
        fprintf(events, "%g down -120 %d 0.9\n", at_s, 90 * stroke - 60);
        for (int i = 1; i < 20; i++)
            fprintf(events, "%g move %d %d 0.9\n", at_s + 0.03 * i, -120 + 12 * i,
                    90 * stroke - 60 + i * i / 5);
        fprintf(events, "%g up 120 %d 0.9\n", at_s + 0.6, 90 * stroke);
    }
    fprintf(events, "3 set tool select\n3.1 down -80 -90\n3.3 move 10 0\n3.5 up 100 80\n"
                    "3.6 set tool brush\n3.7 set width 20\n");
    for (int i = 0; i < 20; i++)
        fprintf(events, "%g move %d %d\n", 4 + 0.03 * i, 150 - 11 * i, 13 * i - 100);
    fprintf(events, "4.7 picture %s\n", played_path("drawn.png"));
    fclose(events);
}

/* The canvas when nothing moves any more. expected NULL: whatever it is then; else until it is
 * this. */
static void canvas_end(const uint8_t *expected, uint8_t *rgb)
{
    const size_t bytes = 3 * (size_t)PART_WIDTH * PART_HEIGHT;
    uint8_t *before = calloc(bytes, 1);
    struct stat drawn;
    char journal[300];
    int status;
    const double until_s = clock_now_s() + SHOWN_S;
    assert_non_null(before);
    remove(played_path("drawn.png"));
    const pid_t studio = played_start();
    const Window window = screen_window("Studio", SHOWN_S);
    assert_true(window != 0);
    while (stat(played_path("drawn.png"), &drawn) != 0 && clock_now_s() < until_s)
        usleep(50000);
    for (bool still = false; !still && clock_now_s() < until_s;) {
        usleep(400000);
        canvas_read(window, rgb);
        still = memcmp(rgb, expected ? expected : before, bytes) == 0;
        memcpy(before, rgb, bytes);
    }
    kill(studio, SIGKILL);
    waitpid(studio, &status, 0);
    free(before);
    while (played_journal(journal, sizeof journal)) /* the next test has its own */
        assert_int_equal(remove(journal), 0);
    assert_true(screen_window_gone(window, SHOWN_S));
}

/* Where processors compute OpenGL, the canvas is drawn in parts; what is seen is what drawing
 * all of it shows: paint, the outline of a selection and the cursor over them, and nothing that
 * was there before. */
static void parts_are_the_whole(void **state)
{
    (void)state;
    const size_t bytes = 3 * (size_t)PART_WIDTH * PART_HEIGHT;
    uint8_t *parts = malloc(bytes), *whole = malloc(bytes);
    int colors = 0;
    assert_true(parts && whole);
    canvas_play();
    canvas_end(NULL, parts);
    setenv("GSK_RENDERER", "gl", 1);
    canvas_end(parts, whole);
    unsetenv("GSK_RENDERER");
    assert_memory_equal(parts, whole, bytes);
    for (size_t i = 3; i < bytes; i++)
        colors += parts[i] != parts[i - 3];
    assert_true(colors > 10000); /* there is something */
    free(parts);
    free(whole);
}

/* ---- what was not saved ---- */

/* Killed while nobody had saved: all that is older than a second is there again, and what the
 * journal has lost is lost alone. */
static void killed_and_found_again(void **state)
{
    (void)state;
    char *seen, *expected, journal[300];
    struct stat now, before = {0};
    FILE *events = played_begin();
    scene_write(events, 2);
    fprintf(events, "4 picture %s\n", played_path("done.png"));
    fclose(events);
    const pid_t studio = played_start();
    /* until it has not grown for some seconds after the picture that follows the last deed */
    for (int still = 0, turns = 0; still < 50 && turns < 2000; turns++) {
        usleep(100000);
        const bool there = access(played_path("done.png"), R_OK) == 0 &&
                           played_journal(journal, sizeof journal) && stat(journal, &now) == 0;
        still = there && now.st_size == before.st_size ? still + 1 : 0;
        before = there ? now : before;
    }
    kill(studio, SIGKILL);
    waitpid(studio, NULL, 0);
    assert_true(played_journal(journal, sizeof journal));
    events = played_begin();
    fprintf(events, "0 picture %s\n0.1 save %s\n0.1 close\n", played_path("seen.png"),
            played_path("mid.h5"));
    fclose(events);
    memset(&played, 0, sizeof played);
    const char *const arguments[] = {getenv("LUTETIA"), "studio", "--play",
                                     played_path("hand.events")};
    memcpy(played.arguments, arguments, sizeof arguments);
    played.variables[0] = "GTK_A11Y=none";
    child_run(&played);
    assert_int_equal(played.status, 0);
    expected_write(played_path("expected.png"));
    const size_t count = played_file(played_path("seen.png"), &seen),
                 wanted = played_file(played_path("expected.png"), &expected);
    assert_int_equal(count, wanted);
    assert_memory_equal(seen, expected, count);
    free(seen);
    free(expected);
    assert_false(
        played_journal(journal, sizeof journal)); /* saved: it is not needed any more */
}

/* ---- what is wrong ---- */

/* One line that says so. */
static void says(int status, const char *what)
{
    if (played.status != status || !strstr(played.errors, what))
        print_message("%d: %s", played.status, played.errors);
    assert_int_equal(played.status, status);
    const char *line = strstr(played.errors, "lutetia studio: ");
    assert_non_null(line);
    assert_non_null(strstr(line, what));
    assert_null(strstr(line + 1, "lutetia studio: "));
}

static void wrong_is_one_line(void **state)
{
    (void)state;
    FILE *events = played_begin();
    fprintf(events, "0 down 0 0\n0.1 up 5 5\n0.2 save /proc/sheet.h5\n0.3 close\n");
    fclose(events);
    played_run(NULL);
    says(1, "/proc/sheet.h5");
    played_run("GDK_DEBUG=gl-disable");
    if (!strstr(played.errors, "OpenGL")) /* later ones name it otherwise */
        played_run("GDK_DISABLE=gl");
    says(1, "OpenGL");
    played_run("DISPLAY=:4711");
    says(1, "no display");
    events = played_begin();
    fprintf(events, "0 down 0 0\n0.1 jump\n");
    fclose(events);
    played_run(NULL);
    says(1, "hand.events:2: no such word: 'jump'");
}

static void wrong_files_are_told(void **state)
{
    (void)state;
    FILE *file = fopen(played_path("bad.h5"), "w");
    assert_non_null(file);
    fputs("this is no sheet", file);
    fclose(file);
    memset(&played, 0, sizeof played);
    played.arguments[0] = getenv("LUTETIA");
    played.arguments[1] = "studio";
    played.arguments[2] = played_path("bad.h5");
    played.variables[0] = "GTK_A11Y=none";
    child_run(&played);
    says(1, "bad.h5");
    played.arguments[2] = "/no/such.h5";
    child_run(&played);
    says(1, "/no/such.h5: cannot read");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(window_paints_what_calls_paint),
        cmocka_unit_test(script_makes_the_same),
        cmocka_unit_test(selection_is_in_the_script),
        cmocka_unit_test(eraser_is_another_tool),
        cmocka_unit_test(stamps_are_in_the_script),
        cmocka_unit_test(springy_type_is_printed_where_it_lands),
        cmocka_unit_test(hand_is_helped),
        cmocka_unit_test(closed_in_mid_stroke),
        cmocka_unit_test(parts_are_the_whole),
        cmocka_unit_test(killed_and_found_again),
        cmocka_unit_test(wrong_is_one_line),
        cmocka_unit_test(wrong_files_are_told),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, played_folder_make, played_folder_remove);
}
