/* test_studio_pen.c - a pen of Xorg's input driver "inputtest", which reports by XInput 2 as
 * a tablet's driver does: every report comes into the stroke with its own pressure, a mouse
 * that is moved or clicked meanwhile changes nothing, a pen that hovers does not paint, and one
 * that has no pressure does. It skips where there is no Xorg with that driver, or it may not
 * be started. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <X11/Xlib.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <brush.h>
#include <studio_settings.h>

#include "clock.h"
#include "inputtest.h"
#include "studio_scene.h"
#include "xorg.h"

enum { WAIT_S = 90, ZOOM = 4 };
enum { PEN, FLAT, MOUSE, DEVICES };
static const struct inputtest_kind devices[DEVICES] = {
    {"pen", true, true}, {"flat", true, false}, {"mouse", false, false}};

static char folder[] = "/tmp/lutetia-pen-XXXXXX";
static pid_t studio = -1;
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
}

/* ---- the studio ---- */

static Window studio_window(void)
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

static void exists_wait(const char *path, ino_t other_than)
{
    const double until_s = clock_now_s() + WAIT_S;
    struct stat now;
    while (stat(path, &now) != 0 || now.st_ino == other_than) {
        assert_true(clock_now_s() < until_s);
        usleep(20000);
    }
}

static int studio_start(void **state)
{
    (void)state;
    struct paper_sheet_config config = scene_config();
    struct studio_session *s;
    FILE *events = fopen(path_of("events"), "w");
    assert_non_null(events);
    fprintf(events, "0 set paused on\n0 set curve 1\n0 set steady 0\n0.1 view %d %d %d 0 0\n",
            ZOOM, config.width / 2, config.height / 2);
    fprintf(events, "0.5 picture %s\n", path_of("ready.png"));
    fclose(events);
    assert_int_equal(studio_session_create(&config, 64e6, &s), PAPER_OK);
    assert_int_equal(studio_session_save(s, path_of("sheet.h5")), PAPER_OK);
    studio_session_destroy(s);
    studio = fork();
    if (studio == 0) {
        setenv("GTK_A11Y", "none", 1);
        setenv("XDG_DATA_HOME", folder, 1);
        execl(getenv("LUTETIA"), "lutetia", "studio", path_of("sheet.h5"), "--play",
              path_of("events"), NULL);
        _exit(127);
    }
    exists_wait(path_of("ready.png"), 0);
    XSetInputFocus(display, studio_window(), RevertToParent, CurrentTime);
    XSync(display, False);
    usleep(500000);
    return 0;
}

static int studio_end(void **state)
{
    int status;
    (void)state;
    kill(studio, SIGKILL);
    waitpid(studio, &status, 0);
    remove(path_of("sheet.h5.journal"));
    return remove(path_of("ready.png"));
}

/* The strokes of the sheet, saved by its key; how many there are. The caller frees each by
 * paper_history_arguments_free(). */
static int strokes_read(struct paper_stroke *strokes[], int most)
{
    struct studio_session *s;
    struct paper_moment moment;
    struct stat before;
    int count = 0;
    assert_int_equal(stat(path_of("sheet.h5"), &before), 0);
    XTestFakeKeyEvent(display, XKeysymToKeycode(display, XK_Control_L), True, CurrentTime);
    key_type(XK_s);
    XTestFakeKeyEvent(display, XKeysymToKeycode(display, XK_Control_L), False, CurrentTime);
    XSync(display, False);
    exists_wait(path_of("sheet.h5"), before.st_ino);
    assert_int_equal(studio_session_open(path_of("sheet.h5"), 64e6, &s), PAPER_OK);
    for (int i = 0; paper_history_moment(studio_session_sheet(s), i, &moment); i++) {
        void *arguments;
        if (strcmp(moment.what, "stroke") != 0)
            continue;
        assert_true(count < most);
        assert_int_equal(paper_history_arguments(studio_session_sheet(s), i, &arguments),
                         PAPER_OK);
        strokes[count++] = arguments;
    }
    studio_session_destroy(s);
    return count;
}

/* ---- what a pen does ---- */

enum { REPORTS = 60, LEFT_PX = 440, TOP_PX = 400 };

static void place_of(int i, double place[2])
{
    place[0] = LEFT_PX + 2.3 * i;
    place[1] = TOP_PX + 25 * sin(i / 6.0);
}

static double pressure_of(int i)
{
    return 0.1 + 0.8 * fabs(sin(i / 5.0));
}

/* Above the paper first, some with a pressure, as drivers tell it of a pen that is near; then a
 * stroke. bumped: a mouse is moved and clicked meanwhile. */
static void stroke_paint(int device, bool bumped)
{
    double place[2];
    for (int i = 0; i < REPORTS; i++) {
        place_of(i, place);
        inputtest_move(device, place[0], place[1] + 60, device == FLAT ? -1 : i % 3 ? 0 : 0.2);
    }
    place_of(0, place);
    inputtest_move(device, place[0], place[1], device == FLAT ? -1 : pressure_of(0));
    inputtest_press(device, true);
    for (int i = 1; i < REPORTS; i++) {
        place_of(i, place);
        if (bumped && i % 7 == 3)
            inputtest_push(MOUSE, 30, -20);
        if (bumped && i % 20 == 11) {
            inputtest_press(MOUSE, true);
            inputtest_press(MOUSE, false);
        }
        inputtest_move(device, place[0], place[1], device == FLAT ? -1 : pressure_of(i));
        usleep(3000);
    }
    inputtest_press(device, false);
    for (int i = 0; i < REPORTS; i++) {
        place_of(i, place);
        inputtest_move(device, place[0], place[1] + 80, device == FLAT ? -1 : 0);
    }
}

/* Samples are the reports: places in fibers from the first one on, and pressures. A press or a
 * release is a sample, too, at the place of the report before it. */
static void reports_are_there(const struct paper_stroke *stroke, bool pressures)
{
    double first[2], last[2] = {0, 0};
    int at = 0;
    place_of(0, first);
    for (int i = 0; i < REPORTS; i++) {
        double place[2], away = 1e9, pressure = -1;
        place_of(i, place);
        for (; at < stroke->samples_count; at++) {
            const struct paper_stroke_sample *s = &stroke->samples[at], *t = stroke->samples;
            away = hypot(s->x - t->x - (place[0] - first[0]) / ZOOM,
                         s->y - t->y - (place[1] - first[1]) / ZOOM);
            pressure = s->pressure;
            if (away < 0.05)
                break;
            if (hypot(s->x - t->x - last[0], s->y - t->y - last[1]) > 0.05)
                fail_msg("sample %d of %d is no report of the pen's: %g fibers from report %d",
                         at, stroke->samples_count, away, i);
        }
        if (at == stroke->samples_count)
            fail_msg("report %d has not come", i);
        last[0] = (place[0] - first[0]) / ZOOM;
        last[1] = (place[1] - first[1]) / ZOOM;
        if (pressures && !(fabs(pressure - pressure_of(i)) < 0.002))
            fail_msg("report %d came with pressure %g, not %g", i, pressure, pressure_of(i));
        if (!pressures)
            assert_true(pressure > 0.05);
    }
}

static void strokes_check(int device, bool bumped)
{
    struct paper_stroke *strokes[4];
    stroke_paint(device, bumped);
    const int count = strokes_read(strokes, 4);
    assert_int_equal(count, 1);
    reports_are_there(strokes[0], device == PEN);
    paper_history_arguments_free("stroke", strokes[0]);
}

static void reports_have_their_pressure(void **state)
{
    (void)state;
    strokes_check(PEN, false);
}

static void mouse_changes_nothing(void **state)
{
    (void)state;
    strokes_check(PEN, true);
}

static void pen_without_pressure_paints(void **state)
{
    (void)state;
    strokes_check(FLAT, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(reports_have_their_pressure, studio_start, studio_end),
        cmocka_unit_test_setup_teardown(mouse_changes_nothing, studio_start, studio_end),
        cmocka_unit_test_setup_teardown(pen_without_pressure_paints, studio_start, studio_end),
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
