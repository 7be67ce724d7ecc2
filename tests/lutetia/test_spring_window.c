/* test_spring_window.c - `lutetia spring` in a window on an Xvfb: it saves what the pointer
 * did. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <clamps.h>
#include <errno.h>
#include <network_file.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../display/scratch.h"
#include "clock.h"
#include "xtest.h"

#include <X11/keysym.h>

static const char *lutetia;

static pid_t start(const char *const *arguments)
{
    pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        signal(SIGHUP, SIG_DFL); /* nohup may have started this */
        char *all[24] = {strdup(lutetia), strdup("spring")};
        for (int i = 0; arguments[i]; i++)
            all[2 + i] = strdup(arguments[i]);
        execv(lutetia, all);
        _exit(127);
    }
    return pid;
}

static void ends_with(pid_t pid, int wanted)
{
    int status = -1;
    for (double until_s = clock_now_s() + 20; clock_now_s() < until_s; usleep(5000))
        if (waitpid(pid, &status, WNOHANG) == pid) {
            assert_true(WIFEXITED(status));
            assert_int_equal(WEXITSTATUS(status), wanted);
            return;
        }
    kill(pid, SIGKILL);
    fail_msg("it does not end");
}

/* Waits until a file exists. */
static void file_wait(const char *path)
{
    for (double until_s = clock_now_s() + 20; access(path, R_OK) != 0; usleep(5000))
        if (clock_now_s() > until_s)
            fail_msg("there is no %s", path);
}

/* The window shows 10 ems by 6.25 of the world, with an em of 60 pixels and the floor half an
 * em above the lower edge. */
static const char *const scene[] = {"--size", "600x375", "--view", "-2,-0.5,8,5.75", NULL};

static void at(Window window, double x, double y)
{
    xtest_move(window, (int)(60 * (x + 2)), (int)(375 - 60 * (y + 0.5)));
}

/* Waits for the window to show the light theme's paper. */
static Window window_of(void)
{
    Window window = screen_window("springs", 20);
    int seen = 0;
    if (!window)
        fail_msg("there is no window");
    for (double until_s = clock_now_s() + 20; seen != 0xf6 && clock_now_s() < until_s;) {
        struct display_image image;
        usleep(10000);
        screen_read(window, &image);
        seen = image.pixels ? image.pixels[3 * 10] : 0;
        display_image_destroy(&image);
    }
    if (seen != 0xf6)
        fail_msg("there is no picture in the window");
    return window;
}

/* The pointer moves the first letter's upper left mass up and tacks it; the command saves this
 * as a script, and the masses. */
static void hands_are_saved_as_scripts(void **state)
{
    (void)state;
    const char *saved = scratch_path("word.springs"),
               *script = scratch_path("word.springs.clamps");
    const char *arguments[20] = {"wo",    "--at",           "0,2",    "--set", "gravity=0",
                                 "--set", "record_hand=on", "--save", saved};
    memcpy(arguments + 9, scene, sizeof scene);
    struct dyn_network *network = NULL;
    struct dyn_clamps *clamps = NULL;
    pid_t pid = start(arguments);
    Window window = window_of();
    double top = 2.729; /* DejaVu's capital M is so high */
    xtest_key(XK_Shift_L, true);
    at(window, 0.06, top); /* where a w begins: its margin */
    xtest_button(1, true);
    for (int i = 0; i <= 20; i++) {
        at(window, 0.05 * i, top + 0.1 * i);
        usleep(20000);
    }
    xtest_button(1, false);
    xtest_key(XK_Shift_L, false);
    usleep(50000);
    xtest_key(XK_Control_L, true);
    xtest_type(XK_s);
    xtest_key(XK_Control_L, false);
    file_wait(saved);
    file_wait(script);
    xtest_type(XK_Escape);
    ends_with(pid, 0);

    if (dyn_network_read(saved, &network) != DYN_OK ||
        dyn_clamps_read(script, &clamps) != DYN_OK)
        fail_msg("%s", dyn_error());
    int stuck = -1;
    for (int i = 0; i < dyn_masses_count(network); i++)
        if (dyn_mass_get(network, i).hold & DYN_STUCK)
            stuck = i;
    assert_int_equal(stuck, 3); /* order: lower left, lower right, upper right, upper left */
    struct dyn_mass mass = dyn_mass_get(network, stuck);
    assert_true(mass.x > 0.98 && mass.x < 1.02 && mass.y > top + 1.97 && mass.y < top + 2.03);
    double x, y;
    assert_in_range(dyn_clamps_count(clamps), 4, 1000);
    assert_true(dyn_clamps_at(clamps, stuck, 1e6, &x, &y));
    assert_true(x > 0.98 && x < 1.02 && y > top + 1.97 && y < top + 2.03);
    dyn_clamps_destroy(clamps);
    dyn_network_destroy(network);
}

static void control_type(KeySym key)
{
    xtest_key(XK_Control_L, true);
    xtest_type(key);
    xtest_key(XK_Control_L, false);
    usleep(200000);
}

/* What was saved is loaded after a drag. The recorded session does the same again, without a
 * window. */
static void sessions_in_which_files_are_loaded_are_replayed(void **state)
{
    (void)state;
    char saved[4096], session[4096], text[1 << 15] = "";
    snprintf(saved, sizeof saved, "%s", scratch_path("loaded.springs"));
    snprintf(session, sizeof session, "%s", scratch_path("loads.session"));
    const char *arguments[20] = {"wo",        "--at",  "0,2",    "--set", "gravity=0",
                                 "--session", session, "--save", saved};
    memcpy(arguments + 9, scene, sizeof scene);
    pid_t pid = start(arguments);
    Window window = window_of();
    control_type(XK_s);
    file_wait(saved);
    at(window, 0.06, 2.729);
    xtest_button(1, true);
    for (int i = 0; i <= 10; i++) {
        at(window, 0.05 * i, 2.729 + 0.1 * i);
        usleep(20000);
    }
    xtest_button(1, false);
    usleep(100000);
    control_type(XK_o);
    xtest_type(XK_Escape);
    ends_with(pid, 0);
    FILE *file = fopen(session, "r");
    assert_non_null(file);
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    if (!strstr(text, "begin ") || !strstr(text, " load ") ||
        !strstr(text, strrchr(saved, '/')))
        fail_msg("%s", text);
    const char *again[20] = {"wo",        "--at",      "0,2",
                             "--set",     "gravity=0", "--replay",
                             session,     "--still",   scratch_path("loads.png"),
                             "--seconds", "1",         NULL};
    ends_with(start(again), 0);
    file = fopen(saved, "a");
    assert_non_null(file);
    fputs("# changed\n", file);
    fclose(file);
    ends_with(start(again), 1);
}

/* On a screen with twice the resolution the window has twice as many pixels, and masses have
 * the same size in inches. */
static void fine_screens_have_larger_windows(void **state)
{
    (void)state;
    const char *const arguments[] = {
        "w",      "--set",           "gravity=0", "--size",       "300x187",
        "--view", "-2,-0.5,8,5.734", "--set",     "floor_on=off", NULL};
    for (int fine = 0; fine < 2; fine++) {
        struct display_image image;
        screen_dpi(fine ? 192 : 0);
        pid_t pid = start(arguments);
        Window window = window_of();
        screen_read(window, &image);
        assert_int_equal(image.width_px, fine ? 600 : 300);
        assert_int_equal(image.height_px, fine ? 374 : 187);
        /* A pixel up and left of the upper left mass's middle (0.098, 2.729). It is outside the
         * mass on a usual screen, and inside on a fine one. */
        int em = fine ? 60 : 30, x = (int)(em * 2.098) - 3;
        int y = image.height_px - (int)(em * 3.229) - 3;
        int seen = image.pixels[3 * (y * image.width_px + x)];
        if (fine ? seen > 0x60 : seen < 0xe0)
            fail_msg("%d is seen beside a mass, %s", seen, fine ? "fine" : "usual");
        display_image_destroy(&image);
        screen_close(window);
        ends_with(pid, 0);
    }
    screen_dpi(0);
}

/* Closing the window, Ctrl-C, and a terminal that hangs up: what was done in the window is
 * saved each time. */
static void windows_end(void **state)
{
    (void)state;
    const char *arguments[8] = {"end"};
    memcpy(arguments + 1, scene, sizeof scene);
    pid_t pid = start(arguments);
    screen_close(window_of());
    ends_with(pid, 0);
    static const int signals[] = {SIGINT, SIGHUP};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) {
        const char *session = scratch_path("ended.session");
        const char *saving[10] = {"end", "--session", session};
        memcpy(saving + 3, scene, sizeof scene);
        unlink(session);
        pid = start(saving);
        window_of();
        kill(pid, signals[i]);
        ends_with(pid, 0);
        assert_int_equal(access(session, R_OK), 0);
    }
}

/* A letter is led about. */
static void drag(Window window)
{
    at(window, 0.06, 2.729);
    xtest_button(1, true);
    for (int i = 0; i <= 10; i++) {
        at(window, 0.05 * i, 2.729 + 0.1 * i);
        usleep(20000);
    }
    xtest_button(1, false);
    usleep(200000);
}

/* The session has the drag, and can be replayed. */
static void session_check(const char *session)
{
    char text[1 << 15] = "";
    FILE *file = fopen(session, "r");
    assert_non_null(file);
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    if (!strstr(text, " hand down ") || !strstr(text, " hand up ") || !strstr(text, "\nend "))
        fail_msg("%s", text);
    const char *again[20] = {"end",
                             "--set",
                             "gravity=0",
                             "--replay",
                             session,
                             "--still",
                             scratch_path("killed.png"),
                             "--seconds",
                             "1",
                             NULL};
    ends_with(start(again), 0);
}

/* Where the program is killed, the session is in its file all the same. */
static void sessions_are_written_as_they_happen(void **state)
{
    (void)state;
    const char *session = scratch_path("killed.session");
    const char *arguments[10] = {"end", "--set", "gravity=0", "--session", session};
    memcpy(arguments + 5, scene, sizeof scene);
    pid_t pid = start(arguments);
    drag(window_of());
    kill(pid, SIGKILL);
    waitpid(pid, NULL, 0);
    session_check(session);
}

/* Where the display goes away, the session and the film are whole. */
static void lost_displays_lose_nothing_else(void **state)
{
    (void)state;
    char film[4096], session[4096], head[10];
    snprintf(film, sizeof film, "%s", scratch_path("lost.y4m"));
    snprintf(session, sizeof session, "%s", scratch_path("lost.session"));
    const char *arguments[12] = {"end",   "--set",    "gravity=0", "--session",
                                 session, "--record", film};
    memcpy(arguments + 7, scene, sizeof scene);
    pid_t pid = start(arguments);
    Window window = window_of();
    xtest_type(XK_v);
    drag(window);
    screen_end();
    ends_with(pid, 1);
    session_check(session);
    FILE *file = fopen(film, "r");
    assert_non_null(file);
    assert_int_equal(fread(head, 1, sizeof head, file), sizeof head);
    assert_memory_equal(head, "YUV4MPEG2 ", sizeof head);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    const long frames = ftell(file) / (3 * 600 * 374);
    fclose(file);
    if (frames < 6)
        fail_msg("%ld pictures of half a second", frames);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hands_are_saved_as_scripts),
        cmocka_unit_test(sessions_in_which_files_are_loaded_are_replayed),
        cmocka_unit_test(fine_screens_have_larger_windows),
        cmocka_unit_test(windows_end),
        cmocka_unit_test(sessions_are_written_as_they_happen),
        cmocka_unit_test(lost_displays_lose_nothing_else), /* the last: it ends the display */
    };
    lutetia = getenv("LUTETIA");
    if (!lutetia || !screen_start("800x600"))
        return 77;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
