/* test_studio_access.c - the studio as a screen reader, a keyboard and a hand find it: every
 * control has a name, each tool is reached by its key, and paint lies under the pointer at any
 * zoom, turned and mirrored. By AT-SPI and XTEST, on an Xvfb with a bus of its own. */
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
#include <sys/wait.h>
#include <unistd.h>

#include "accessible.h"
#include "clock.h"
#include "studio_settings.h"
#include "xtest.h"

enum { WAIT_S = 60 };
static pid_t studio;
static Window window;
static AtspiAccessible *frame;
static char events[] = "/tmp/lutetia-studio-XXXXXX";

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

static void studio_start(const char *view)
{
    FILE *file = fopen(events, "w");
    assert_non_null(file);
    fprintf(file, "0 set paused on\n0 set show colour\n0 set pace 50\n%s", view);
    fclose(file);
    studio = fork();
    if (studio == 0) {
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
static void sheet_wait(double zoom, int middle[2])
{
    const double until_s = clock_now_s() + WAIT_S, wanted = 128 * 96 * zoom * zoom;
    double sheet_px = 0;
    int box[4];
    while (clock_now_s() < until_s) {
        if (canvas_look(box, &sheet_px) && fabs(sheet_px - wanted) < 0.06 * wanted + 300) {
            middle[0] = (box[0] + box[2]) / 2;
            middle[1] = (box[1] + box[3]) / 2;
            return;
        }
        usleep(50000);
    }
    fail_msg("zoom %g: %g pixels of the sheet are seen, not %g", zoom, sheet_px, wanted);
}

static void paint_is_under_the_pointer(void **state)
{
    (void)state;
    static const struct {
        double zoom, degrees;
        bool mirrored;
    } views[] = {{2, 30, true}, {4, -100, false}};
    setenv("GTK_A11Y", "none", 1);
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        char view[300];
        int middle[2] = {0, 0};
        snprintf(view, sizeof view,
                 "0 set tool drop\n0 set size 3\n0 set water 0.05\n0 set pigment_1 1.5\n"
                 "0 view %g 64 48 %g %d\n",
                 views[i].zoom, views[i].degrees, views[i].mirrored);
        studio_start(view);
        sheet_wait(views[i].zoom, middle);
        drop_at(views[i].zoom, middle[0] + 17, middle[1] - 11);
        drop_at(views[i].zoom, middle[0] - 25, middle[1] + 23);
        studio_end();
    }
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
                 "0.4 action beside\n0.5 moment 1\n");
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
    studio_start("");
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
    if (!screen_start("1280x900x24"))
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
