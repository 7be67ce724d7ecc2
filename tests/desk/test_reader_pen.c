/* test_reader_pen.c - a pen of Xorg's input driver "inputtest" over the reader's page: every
 * report of a stroke is in the notes' file in its place, with its time and its own pressure, a
 * mouse that is moved or clicked meanwhile changes nothing, a pen that hovers does not draw,
 * one without pressure does, its other end erases, and the stroke is played back as it was
 * drawn. It skips where there is no Xorg with that driver, or it may not be started. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <reader_remarks.h>

#include "clock.h"
#include "inputtest.h"
#include "xorg.h"

enum { WAIT_S = 60, SIZE_PX = 17 };
enum { PEN, FLAT, ERASER, MOUSE, DEVICES };
static const struct inputtest_kind devices[DEVICES] = {{"pen", true, true},
                                                       {"flat", true, false},
                                                       {"pen eraser", true, true},
                                                       {"mouse", false, false}};

static char folder[] = "/tmp/lutetia-read-pen-XXXXXX";
static pid_t reader = -1;
static Display *display;

static const char *path_of(const char *name)
{
    static char paths[8][64];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static void key_type(KeySym key)
{
    const KeyCode code = XKeysymToKeycode(display, key);
    XTestFakeKeyEvent(display, code, True, CurrentTime);
    XTestFakeKeyEvent(display, code, False, CurrentTime);
    XSync(display, False);
    usleep(300000);
}

/* ---- the reader ---- */

static Window reader_window(void)
{
    Window root, parent, *children = NULL, found = 0;
    unsigned count = 0;
    XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
    for (unsigned i = 0; i < count; i++) {
        XWindowAttributes attributes;
        if (XGetWindowAttributes(display, children[i], &attributes) &&
            attributes.map_state == IsViewable && attributes.width > 600)
            found = children[i];
    }
    if (children)
        XFree(children);
    return found;
}

enum { LEFT = 200, TOP = 250, WIDTH = 600, HEIGHT = 300 }; /* where strokes are */

/* Pixels of the text, or of the ink, there. */
static int pixels_of(bool ink)
{
    const Window window = reader_window();
    int count = 0;
    XImage *image =
        window ? XGetImage(display, window, LEFT, TOP, WIDTH, HEIGHT, AllPlanes, ZPixmap)
               : NULL;
    for (int i = 0; image && i < WIDTH * HEIGHT; i++) {
        const unsigned long pixel = XGetPixel(image, i % WIDTH, i / WIDTH);
        const int red = (int)(pixel >> 16 & 255), blue = (int)(pixel & 255);
        count += ink ? blue > red + 90 : red < 140 && blue < 140;
    }
    if (image)
        XDestroyImage(image);
    return count;
}

/* Text on paper. A window that has not been drawn yet is black: it may be seen, or not. */
static bool reader_seen(void)
{
    const int dark = pixels_of(false);
    return dark > 1000 && dark < WIDTH * HEIGHT / 2;
}

static int reader_start(void **state)
{
    (void)state;
    const double until_s = clock_now_s() + WAIT_S;
    FILE *file = fopen(path_of("one.md"), "w");
    assert_non_null(file);
    for (int i = 0; i < 30; i++)
        fputs("Words that go on over a line or two, so that ink has something to hang on, and "
              "there is a line under every place that a pen may come to in this window.\n\n",
              file);
    fclose(file);
    reader = fork();
    if (reader == 0) {
        setenv("GTK_A11Y", "none", 1);
        setenv("XDG_DATA_HOME", folder, 1);
        execl(getenv("LUTETIA"), "lutetia", "read", path_of("one.md"), "--theme", "light",
              NULL);
        _exit(127);
    }
    while (!reader_seen()) {
        assert_true(clock_now_s() < until_s);
        usleep(50000);
    }
    XSetInputFocus(display, reader_window(), RevertToParent, CurrentTime);
    XSync(display, False);
    usleep(500000);
    key_type(XK_d);
    return 0;
}

static int reader_end(void **state)
{
    int status;
    (void)state;
    kill(reader, SIGKILL);
    waitpid(reader, &status, 0);
    remove(path_of("one.md.notes-wal"));
    remove(path_of("one.md.notes-shm"));
    return remove(path_of("one.md.notes"));
}

/* What the notes' file has, when it has so many strokes that are there, and so many that are
 * erased. Owns: the caller closes it. */
static struct reader_remarks *notes_read(int there, int erased)
{
    const double until_s = clock_now_s() + WAIT_S;
    for (;;) {
        struct reader_remarks *remarks;
        int found = 0, gone = 0;
        if (access(path_of("one.md.notes"), R_OK) == 0 &&
            reader_remarks_read(path_of("one.md.notes"), &remarks) == READER_OK) {
            for (int i = 0; i < reader_remarks_count(remarks); i++) {
                const struct reader_remark *r = reader_remarks_get(remarks, i);
                assert_int_equal(r->kind, READER_REMARK_INK);
                found += !(r->gone_s > 0);
                gone += r->gone_s > 0;
            }
            if (found == there && gone == erased)
                return remarks;
            reader_remarks_close(remarks);
        }
        if (!(clock_now_s() < until_s))
            fail_msg("%d strokes are there and %d erased, not %d and %d", found, gone, there,
                     erased);
        usleep(50000);
    }
}

/* ---- what a pen does ---- */

enum { REPORTS = 60, LEFT_PX = 440, TOP_PX = 400, STEP_US = 3000 };

/* Between which times a report was told. */
static double told_s[REPORTS][2];

static void place_of(int i, double place[2])
{
    place[0] = LEFT_PX + 2.3 * i;
    place[1] = TOP_PX + 25 * sin(i / 6.0);
}

static double pressure_of(int device, int i)
{
    return device == FLAT ? -1 : 0.1 + 0.8 * fabs(sin(i / 5.0));
}

static void report_tell(int device, int i)
{
    double place[2];
    place_of(i, place);
    told_s[i][0] = clock_now_s();
    inputtest_move(device, place[0], place[1], pressure_of(device, i));
    told_s[i][1] = clock_now_s();
}

/* Above the page first, some with a pressure, as drivers tell it of a pen that is near; then a
 * stroke. bumped: a mouse is moved and clicked meanwhile. */
static void stroke_draw(int device, bool bumped, unsigned step_us)
{
    double place[2];
    for (int i = 0; i < REPORTS; i++) {
        place_of(i, place);
        inputtest_move(device, place[0], place[1] + 60, device == FLAT ? -1 : i % 3 ? 0 : 0.2);
    }
    report_tell(device, 0);
    inputtest_press(device, true);
    for (int i = 1; i < REPORTS; i++) {
        if (bumped && i % 7 == 3)
            inputtest_push(MOUSE, 30, -20);
        if (bumped && i % 20 == 11) {
            inputtest_press(MOUSE, true);
            inputtest_press(MOUSE, false);
        }
        report_tell(device, i);
        usleep(step_us);
    }
    inputtest_press(device, false);
    for (int i = 0; i < REPORTS; i++) {
        place_of(i, place);
        inputtest_move(device, place[0], place[1] + 80, device == FLAT ? -1 : 0);
    }
}

/* The point of a report, from *at on: points between are of the place of the report before, as
 * a press and a release are. */
static const struct reader_ink_point *point_of(const struct reader_remark *r, int i, int *at)
{
    const struct reader_ink_point *first = &r->points[0];
    double begin[2], place[2], before[2];
    place_of(0, begin);
    place_of(i, place);
    place_of(i ? i - 1 : 0, before);
    for (; *at < r->points_count; ++*at) {
        const struct reader_ink_point *p = &r->points[*at];
        const double x = begin[0] + SIZE_PX * (double)(p->x - first->x),
                     y = begin[1] + SIZE_PX * (double)(p->y - first->y);
        if (hypot(x - place[0], y - place[1]) < 0.1)
            return p;
        if (hypot(x - before[0], y - before[1]) > 0.1)
            fail_msg("point %d of %d is no report of the pen's: %g, %g instead of %g, %g", *at,
                     r->points_count, x, y, place[0], place[1]);
    }
    fail_msg("report %d has not come", i);
    return NULL;
}

static void reports_are_there(const struct reader_remark *r, int device)
{
    const double close = 0.0015; /* times are whole milliseconds */
    int at = 0;
    for (int i = 0; i < REPORTS; i++) {
        const struct reader_ink_point *p = point_of(r, i, &at);
        const double pressure = (double)p->pressure, time_s = (double)p->time_s,
                     expected = pressure_of(device, i);
        if (device == FLAT)
            assert_true(pressure > 0.05);
        else if (!(fabs(pressure - expected) < 0.002))
            fail_msg("report %d came with pressure %g, not %g", i, pressure, expected);
        if (i && (time_s < told_s[i][0] - told_s[0][1] - close - 0.1 ||
                  time_s > told_s[i][1] - told_s[0][0] + close))
            fail_msg("report %d came at %g, and was told at %g", i, time_s,
                     told_s[i][0] - told_s[0][0]);
    }
    for (int i = 1; i < r->points_count; i++)
        assert_true(r->points[i].time_s >= r->points[i - 1].time_s);
}

/* erased: so many strokes that came before. */
static void strokes_check(int device, bool bumped, int erased)
{
    stroke_draw(device, bumped, STEP_US);
    struct reader_remarks *remarks = notes_read(1, erased);
    reports_are_there(reader_remarks_get(remarks, erased), device);
    reader_remarks_close(remarks);
}

static void reports_have_their_pressure(void **state)
{
    (void)state;
    strokes_check(PEN, false, 0);
}

static void mouse_changes_nothing(void **state)
{
    (void)state;
    strokes_check(PEN, true, 0);
}

static void pen_without_pressure_draws(void **state)
{
    (void)state;
    strokes_check(FLAT, false, 0);
}

/* Across the stroke, above the page and then on it. */
static void other_end_erases(void **state)
{
    double place[2];
    (void)state;
    strokes_check(PEN, false, 0);
    place_of(REPORTS / 2, place);
    for (int i = -10; i <= 10; i++)
        inputtest_move(ERASER, place[0], place[1] + 5 * i, 0);
    usleep(400000);
    reader_remarks_close(notes_read(1, 0));
    inputtest_move(ERASER, place[0], place[1] - 50, 0.5);
    inputtest_press(ERASER, true);
    for (int i = -10; i <= 10; i++) {
        inputtest_move(ERASER, place[0], place[1] + 5 * i, 0.5);
        usleep(STEP_US);
    }
    inputtest_press(ERASER, false);
    reader_remarks_close(notes_read(0, 1));
    strokes_check(PEN, false, 1); /* the pen draws again */
}

/* The key that ends drawing does so while the pen is down, too. */
static void stroke_ends_with_its_tool(void **state)
{
    (void)state;
    report_tell(PEN, 0);
    inputtest_press(PEN, true);
    for (int i = 1; i < REPORTS / 2; i++)
        report_tell(PEN, i);
    usleep(200000);
    key_type(XK_d);
    for (int i = REPORTS / 2; i < REPORTS; i++)
        report_tell(PEN, i);
    inputtest_press(PEN, false);
    struct reader_remarks *remarks = notes_read(1, 0);
    assert_in_range(reader_remarks_get(remarks, 0)->points_count, REPORTS / 2, REPORTS / 2 + 2);
    reader_remarks_close(remarks);
}

/* A stroke of some two seconds takes as long again, and is there when it ends. */
static void stroke_is_played_back(void **state)
{
    (void)state;
    stroke_draw(PEN, false, 30000);
    reader_remarks_close(notes_read(1, 0));
    const double lasts_s = told_s[REPORTS - 1][0] - told_s[0][0];
    usleep(500000);
    const int all = pixels_of(true);
    int seen[3] = {0}, least = all;
    double ended_s = 0;
    assert_true(all > 100);
    XTestFakeKeyEvent(display, XKeysymToKeycode(display, XK_r), True, CurrentTime);
    XTestFakeKeyEvent(display, XKeysymToKeycode(display, XK_r), False, CurrentTime);
    XSync(display, False);
    const double began_s = clock_now_s();
    while (clock_now_s() < began_s + lasts_s + WAIT_S) {
        const int now = pixels_of(true);
        const double part = (clock_now_s() - began_s) / lasts_s;
        least = now < least ? now : least;
        for (int i = 0; i < 3; i++)
            if (part < 0.25 * (i + 1))
                seen[i] = now; /* the last one before a quarter, a half, three quarters */
        ended_s = clock_now_s();
        if (least < all / 4 && now == all)
            break;
        usleep(20000);
    }
    print_message("%d %d %d of %d; %g s of %g\n", seen[0], seen[1], seen[2], all,
                  ended_s - began_s, lasts_s);
    assert_true(least < all / 4);
    assert_true(seen[0] < seen[1] && seen[1] < seen[2] && seen[2] < all);
    assert_true(ended_s - began_s > 0.8 * lasts_s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(reports_have_their_pressure, reader_start, reader_end),
        cmocka_unit_test_setup_teardown(mouse_changes_nothing, reader_start, reader_end),
        cmocka_unit_test_setup_teardown(pen_without_pressure_draws, reader_start, reader_end),
        cmocka_unit_test_setup_teardown(other_end_erases, reader_start, reader_end),
        cmocka_unit_test_setup_teardown(stroke_ends_with_its_tool, reader_start, reader_end),
        cmocka_unit_test_setup_teardown(stroke_is_played_back, reader_start, reader_end),
    };
    if (!mkdtemp(folder) || !inputtest_start(folder, devices, DEVICES)) {
        xorg_end(folder);
        puts("[  SKIPPED ] no Xorg with the drivers dummy and inputtest");
        return 77;
    }
    display = xorg_display();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    xorg_end(folder);
    return failed;
}
