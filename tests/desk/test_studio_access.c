/* test_studio_access.c - the studio as a screen reader, a keyboard and a hand find it: every
 * control has a name, each tool is reached by its key, and paint lies under the pointer at any
 * zoom, turned and mirrored, where a unit of the window is one pixel of the screen or two. By
 * AT-SPI and XTEST, on an Xvfb with a bus of its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <X11/keysym.h>
#include <atspi/atspi.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <brush.h>

#include "accessible.h"
#include "clock.h"
#include "studio_scene.h"
#include "xtest.h"

enum { WAIT_S = 60 };
static pid_t studio;
static Window window;
static AtspiAccessible *frame;
static char events[] = "/tmp/lutetia-studio-XXXXXX";
enum { SHEET_WIDTH = 128, SHEET_HEIGHT = 96 };

/* ---- the tree ---- */

static char *name_of(AtspiAccessible *a)
{
    char *name = atspi_accessible_get_name(a, NULL);
    return name ? name : g_strdup("");
}

struct wanted {
    const char *name;
    AtspiAccessible *found; /* the first that is no label */
};

static void name_compare(AtspiAccessible *a, void *context)
{
    struct wanted *wanted = context;
    char *name = name_of(a);
    if (!wanted->found && strcmp(name, wanted->name) == 0 &&
        atspi_accessible_get_role(a, NULL) != ATSPI_ROLE_LABEL)
        wanted->found = g_object_ref(a);
    g_free(name);
}

static AtspiAccessible *find(const char *name)
{
    struct wanted wanted = {name, NULL};
    atspi_accessible_clear_cache(frame);
    accessible_walk(frame, name_compare, &wanted);
    return wanted.found;
}

static bool state_has(AtspiAccessible *a, AtspiStateType state)
{
    AtspiStateSet *states = atspi_accessible_get_state_set(a);
    const bool has = atspi_state_set_contains(states, state);
    g_object_unref(states);
    return has;
}

/* ---- the window ---- */

/* sheet: a file; NULL: a new one. */
static void studio_start(const char *view, const char *sheet)
{
    FILE *file = fopen(events, "w");
    assert_non_null(file);
    fprintf(file, "0 set paused on\n0 set show colour\n0 set pace 50\n%s", view);
    fclose(file);
    studio = fork();
    if (studio == 0) {
        if (sheet)
            execl(getenv("LUTETIA"), "lutetia", "studio", sheet, "--play", events, NULL);
        else
            execl(getenv("LUTETIA"), "lutetia", "studio", "--paper", "128x96", "--stock",
                  "hot press", "--pigment", "french ultramarine", "--play", events, NULL);
        _exit(127);
    }
    window = screen_window("Studio", WAIT_S);
    assert_true(window != 0);
    XSetInputFocus(screen_display(), window, RevertToParent, CurrentTime);
    XSync(screen_display(), False);
}

static void studio_end(void)
{
    int status;
    kill(studio, SIGTERM);
    waitpid(studio, &status, 0);
    g_clear_object(&frame);
}

/* ---- names ---- */

struct names {
    int named, nameless;
};

static void name_check(AtspiAccessible *a, void *context)
{
    struct names *names = context;
    const AtspiRole role = atspi_accessible_get_role(a, NULL);
    const bool control = role == ATSPI_ROLE_PUSH_BUTTON || role == ATSPI_ROLE_TOGGLE_BUTTON ||
                         role == ATSPI_ROLE_SLIDER || role == ATSPI_ROLE_SPIN_BUTTON ||
                         role == ATSPI_ROLE_COMBO_BOX || role == ATSPI_ROLE_CHECK_BOX ||
                         role == ATSPI_ROLE_SCROLL_BAR || role == ATSPI_ROLE_TEXT ||
                         role == ATSPI_ROLE_ENTRY;
    char *name = name_of(a);
    if (control && name[0])
        names->named++;
    else if (control) {
        char *text = atspi_accessible_get_role_name(a, NULL);
        print_message("a %s without a name\n", text);
        g_free(text);
        names->nameless++;
    }
    g_free(name);
}

static void name_collect(AtspiAccessible *a, void *context)
{
    if (atspi_accessible_get_role(a, NULL) != ATSPI_ROLE_LABEL)
        g_hash_table_add(context, name_of(a));
}

/* All names but labels' that there are now. */
static GHashTable *names_now(void)
{
    GHashTable *all = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    atspi_accessible_clear_cache(frame);
    accessible_walk(frame, name_collect, all);
    return all;
}

/* The control of a row of the table. */
static void setting_has_name(GHashTable *all, int setting)
{
    char label[64];
    snprintf(label, sizeof label, "%s", studio_controls[setting].name);
    label[0] = (char)(label[0] - 'a' + 'A');
    for (char *c = label; *c; c++)
        *c = *c == '_' ? ' ' : *c;
    if (!g_hash_table_contains(all, setting == STUDIO_PAUSED ? "Time stands still" : label))
        fail_msg("no control is named '%s'", label);
}

/* Every control has a name; those of the table have theirs, and so has each tool. */
static void controls_have_names(void **state)
{
    (void)state;
    struct names names = {0};
    GHashTable *all = names_now();
    for (int i = STUDIO_PAUSED; i <= STUDIO_WATER; i++)
        setting_has_name(all, i);
    for (int i = 0; i < STUDIO_TOOLS; i++)
        assert_true(g_hash_table_contains(all, studio_tools[i].name));
    g_hash_table_unref(all);
    accessible_walk(frame, name_check, &names);
    assert_int_equal(names.nameless, 0);
    assert_true(names.named > 60);
}

/* ---- keys ---- */

/* The button is looked for each time: the one that was seen may have been replaced. */
static bool tool_waits(int tool)
{
    const double until_s = clock_now_s() + WAIT_S;
    bool chosen = false;
    while (!chosen && clock_now_s() < until_s) {
        AtspiAccessible *button = find(studio_tools[tool].name);
        if (button)
            atspi_accessible_clear_cache(button);
        chosen = button && (state_has(button, ATSPI_STATE_PRESSED) ||
                            state_has(button, ATSPI_STATE_CHECKED));
        g_clear_object(&button);
        if (!chosen)
            usleep(50000);
    }
    return chosen;
}

static void tools_have_keys(void **state)
{
    (void)state;
    for (int i = STUDIO_TOOLS - 1; i >= 0; i--) {
        const char key[] = {studio_tools[i].key[0], '\0'};
        xtest_type(XStringToKeysym(key));
        if (!tool_waits(i))
            fail_msg("the key %s does not choose %s", key, studio_tools[i].name);
        GHashTable *all = names_now();
        for (int k = studio_tools[i].first; k <= studio_tools[i].last; k++)
            setting_has_name(all, k);
        g_hash_table_unref(all);
    }
}

/* ---- the place under the pointer ---- */

/* The middle of what is blue around a place of the window; false: nothing is. */
static bool blue_middle(int x, int y, int reach, double middle[2])
{
    struct display_image image = {0};
    double sum = 0;
    middle[0] = middle[1] = 0;
    screen_read(window, &image);
    for (int j = y - reach; j <= y + reach; j++)
        for (int i = x - reach; i <= x + reach; i++) {
            if (i < 0 || j < 0 || i >= image.width_px || j >= image.height_px)
                continue;
            const uint8_t *p = image.pixels + 3 * (j * image.width_px + i);
            const double blue = p[2] - p[0] - 30.0;
            if (blue <= 0)
                continue;
            sum += blue;
            middle[0] += blue * (i + 0.5);
            middle[1] += blue * (j + 0.5);
        }
    display_image_destroy(&image);
    middle[0] /= sum > 0 ? sum : 1;
    middle[1] /= sum > 0 ? sum : 1;
    return sum > 300;
}

/* zoom: pixels of the screen for a fiber. */
static void drop_at(double zoom, int x, int y)
{
    const double until_s = clock_now_s() + WAIT_S, most = fmax(1, zoom) / 2 + 0.5;
    const int reach = (int)(4 * zoom) + 6;
    double middle[2] = {0, 0};
    xtest_move(window, x, y);
    xtest_button(1, true);
    xtest_button(1, false);
    xtest_move(window, 4, 4); /* the cursor is out of the way */
    bool near = false;
    while (!near && clock_now_s() < until_s) {
        usleep(50000);
        near = blue_middle(x, y, reach, middle) && fabs(middle[0] - x) < most &&
               fabs(middle[1] - y) < most;
    }
    if (!near)
        fail_msg("zoom %g: a drop at %d, %d lies at %.2f, %.2f", zoom, x, y, middle[0],
                 middle[1]);
}

/* Where the canvas is: the box of all that has the desk's colour; and how many pixels in it
 * have another one. */
static bool canvas_look(int box[4], double *sheet_px)
{
    struct display_image image = {0};
    int desk_px = 0;
    box[0] = box[1] = 1 << 20;
    box[2] = box[3] = 0;
    screen_read(window, &image);
    for (int i = 0; i < image.width_px * image.height_px; i++) {
        const uint8_t *p = image.pixels + 3 * i;
        const int x = i % image.width_px, y = i / image.width_px;
        if (abs(p[0] - 77) > 1 || abs(p[1] - 74) > 1 || abs(p[2] - 71) > 1)
            continue;
        desk_px++;
        box[0] = x < box[0] ? x : box[0];
        box[1] = y < box[1] ? y : box[1];
        box[2] = x + 1 > box[2] ? x + 1 : box[2];
        box[3] = y + 1 > box[3] ? y + 1 : box[3];
    }
    display_image_destroy(&image);
    *sheet_px = (double)(box[2] - box[0]) * (box[3] - box[1]) - desk_px;
    return desk_px > 10000;
}

/* Waits until the sheet is seen at that zoom: its middle is the canvas's. */
static void sheet_wait(double zoom, double middle[2])
{
    const double until_s = clock_now_s() + WAIT_S,
                 wanted = SHEET_WIDTH * SHEET_HEIGHT * zoom * zoom;
    double sheet_px = 0;
    int box[4];
    while (clock_now_s() < until_s) {
        if (canvas_look(box, &sheet_px) && fabs(sheet_px - wanted) < 0.06 * wanted + 300) {
            middle[0] = (box[0] + box[2]) / 2.0;
            middle[1] = (box[1] + box[3]) / 2.0;
            return;
        }
        usleep(50000);
    }
    fail_msg("zoom %g: %g pixels of the sheet are seen, not %g", zoom, sheet_px, wanted);
}

/* ---- contact ---- */

enum { CONTACTS = 3 };

/* What is seen, and where a hand has touched it. The oracle of the view's numbers. */
struct seen {
    int scale; /* pixels of the screen for a unit of the window */
    double zoom, degrees;
    bool mirrored;
    double middle[2]; /* the canvas's, in pixels */
    double place[CONTACTS][2];
    int touched;
};

static void keys_type(KeySym key, int times)
{
    for (int i = 0; i < times; i++)
        xtest_type(key);
}

/* A stroke: from a place of the screen, about so many pixels from the middle of the canvas. */
static void touch(struct seen *seen, int right_px, int down_px)
{
    const double turn = seen->degrees * 3.14159265358979 / 180, c = cos(turn), s = sin(turn),
                 unit = 1 / (seen->scale * seen->zoom);
    const int x = (int)seen->middle[0] + right_px, y = (int)seen->middle[1] + down_px;
    const double right = unit * (x - seen->middle[0]), down = unit * (y - seen->middle[1]),
                 along = c * right + s * down;
    double *place = seen->place[seen->touched++];
    place[0] = SHEET_WIDTH / 2.0 + (seen->mirrored ? -along : along);
    place[1] = SHEET_HEIGHT / 2.0 + c * down - s * right;
    xtest_move(window, x, y);
    xtest_button(1, true);
    xtest_move(window, x + 3, y);
    xtest_button(1, false);
}

/* Keys and buttons come in their order, so nothing is waited for. */
static void touch_at_zooms(struct seen *seen)
{
    keys_type(XK_b, 1);
    touch(seen, 23, -31);
    keys_type(XK_0, 1);
    keys_type(XK_plus, 9);
    seen->zoom = pow(1.25, 9); /* 7.5 */
    keys_type(XK_h, 1);
    seen->mirrored = !seen->mirrored;
    seen->degrees = -seen->degrees;
    keys_type(XK_semicolon, 2);
    seen->degrees += 30;
    touch(seen, -41, 13);
    keys_type(XK_minus, 19);
    seen->zoom *= pow(0.8, 19); /* 0.11 */
    touch(seen, 4, -3);
}

/* Its strokes begin where the hand has touched it. */
static void touches_are_saved(const struct seen *seen, const char *sheet)
{
    struct studio_session *s;
    struct paper_moment moment;
    int strokes = 0;
    assert_int_equal(studio_session_open(sheet, 64e6, &s), PAPER_OK);
    for (int i = 0; paper_history_moment(studio_session_sheet(s), i, &moment); i++) {
        void *arguments;
        if (strcmp(moment.what, "stroke") != 0)
            continue;
        assert_true(strokes < CONTACTS);
        assert_int_equal(paper_history_arguments(studio_session_sheet(s), i, &arguments),
                         PAPER_OK);
        const struct paper_stroke_sample first = ((struct paper_stroke *)arguments)->samples[0];
        const double *place = seen->place[strokes++];
        paper_history_arguments_free("stroke", arguments);
        if (!(hypot(first.x - place[0], first.y - place[1]) < 0.5))
            fail_msg("scale %d, stroke %d: at %.3f, %.3f, not %.3f, %.3f", seen->scale, strokes,
                     first.x, first.y, place[0], place[1]);
    }
    assert_int_equal(strokes, CONTACTS);
    studio_session_destroy(s);
}

static void sheet_make(const char *path)
{
    struct paper_sheet_config config = scene_config();
    struct studio_session *s;
    config.width = SHEET_WIDTH;
    config.height = SHEET_HEIGHT;
    assert_int_equal(studio_session_create(&config, 64e6, &s), PAPER_OK);
    assert_int_equal(studio_session_save(s, path), PAPER_OK);
    studio_session_destroy(s);
}

/* Saved by its key onto the file that it was opened from: another file has its name then. */
static void sheet_save(const char *path)
{
    const double until_s = clock_now_s() + WAIT_S;
    struct stat before, now;
    assert_int_equal(stat(path, &before), 0);
    xtest_key(XK_Control_L, true);
    xtest_type(XK_s);
    xtest_key(XK_Control_L, false);
    do {
        usleep(20000);
        assert_true(clock_now_s() < until_s);
    } while (stat(path, &now) != 0 || now.st_ino == before.st_ino);
}

/* A drop is seen around the pointer; and strokes begin within half a fiber of it. */
static void paint_is_under_the_pointer(void **state)
{
    (void)state;
    struct seen views[] = {{.scale = 1, .zoom = 2, .degrees = 30, .mirrored = true},
                           {.scale = 2, .zoom = 4, .degrees = -100}};
    char sheet[] = "/tmp/lutetia-contact-XXXXXX.h5", journal[64];
    const int made = mkstemps(sheet, 3);
    assert_true(made >= 0);
    close(made);
    snprintf(journal, sizeof journal, "%s.journal", sheet);
    setenv("GTK_A11Y", "none", 1);
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        struct seen *seen = &views[i];
        const double zoom_px = seen->scale * seen->zoom;
        char view[300];
        sheet_make(sheet);
        setenv("GDK_SCALE", seen->scale == 1 ? "1" : "2", 1);
        snprintf(view, sizeof view,
                 "0 set tool drop\n0 set size 3\n0 set water 0.05\n0 set pigment_1 1.5\n"
                 "0 view %g %g %g %g %d\n",
                 seen->zoom, SHEET_WIDTH / 2.0, SHEET_HEIGHT / 2.0, seen->degrees,
                 seen->mirrored);
        studio_start(view, sheet);
        sheet_wait(zoom_px, seen->middle);
        const int x = (int)seen->middle[0], y = (int)seen->middle[1];
        drop_at(zoom_px, x + 17 * seen->scale, y - 11 * seen->scale);
        drop_at(zoom_px, x - 25 * seen->scale, y + 23 * seen->scale);
        touch_at_zooms(seen);
        sheet_save(sheet);
        studio_end();
        unlink(journal);
        touches_are_saved(seen, sheet);
    }
    unsetenv("GDK_SCALE");
    unlink(sheet);
}

/* ---- two moments ---- */

/* Pixels of paint and of bare paper in the left and the right half of the canvas. */
static bool halves_look(int paint_px[2], int bare_px[2])
{
    struct display_image image = {0};
    double sheet_px;
    int box[4];
    paint_px[0] = paint_px[1] = bare_px[0] = bare_px[1] = 0;
    if (!canvas_look(box, &sheet_px))
        return false;
    screen_read(window, &image);
    for (int y = box[1]; y < box[3]; y++)
        for (int x = box[0]; x < box[2]; x++) {
            const uint8_t *p = image.pixels + 3 * (y * image.width_px + x);
            const int half = x >= (box[0] + box[2]) / 2;
            paint_px[half] += p[2] - p[0] > 30;
            bare_px[half] += p[0] > 200 && p[1] > 200 && p[2] > 190;
        }
    display_image_destroy(&image);
    return true;
}

/* The empty sheet is kept beside; at its right is the wash, at the same zoom. */
static void moments_are_side_by_side(void **state)
{
    (void)state;
    const double until_s = clock_now_s() + WAIT_S;
    int paint_px[2] = {0, 0}, bare_px[2] = {0, 0};
    bool good = false;
    studio_start("0 set tool wash\n0 set fade 1\n0 set pigment_1 1.5\n0 view 2 64 48 0 0\n"
                 "0.1 down -100 -80 0.5\n0.2 up 100 80 0.5\n0.3 moment 0\n"
                 "0.4 action beside\n0.5 moment 1\n",
                 NULL);
    while (!good && clock_now_s() < until_s) {
        usleep(50000);
        good = halves_look(paint_px, bare_px) && paint_px[0] == 0 && bare_px[0] > 40000 &&
               paint_px[1] > 28000 && bare_px[1] < 20000;
    }
    if (!good)
        fail_msg("paint: %d and %d pixels, bare paper: %d and %d", paint_px[0], paint_px[1],
                 bare_px[0], bare_px[1]);
    studio_end();
}

static int start(void **state)
{
    (void)state;
    studio_start("", NULL);
    frame = accessible_frame_wait(WAIT_S);
    if (!frame)
        puts("no tree of the window's");
    else if (!tool_waits(STUDIO_TOOL_BRUSH))
        puts("the brush does not wait");
    else
        return 0;
    return -1;
}

static int end(void **state)
{
    (void)state;
    studio_end();
    return 0;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest one[] = {cmocka_unit_test(controls_have_names),
                                     cmocka_unit_test(tools_have_keys)};
    const struct CMUnitTest others[] = {cmocka_unit_test(paint_is_under_the_pointer),
                                        cmocka_unit_test(moments_are_side_by_side)};
    if (argc == 1) { /* with a bus of its own */
        execlp("dbus-run-session", "dbus-run-session", "--", argv[0], "with-bus", NULL);
        puts("[  SKIPPED ] dbus-run-session is not installed");
        return 77;
    }
    if (!screen_start("2600x1700x24"))
        return 77;
    const int made = mkstemp(events);
    if (made < 0)
        return 1;
    close(made);
    setenv("XDG_DATA_HOME", "/proc/none", 1); /* nothing is found again, and nothing kept */
    atspi_init();
    int failed = cmocka_run_group_tests(one, start, end);
    failed += cmocka_run_group_tests(others, NULL, NULL);
    unlink(events);
    return failed;
}
