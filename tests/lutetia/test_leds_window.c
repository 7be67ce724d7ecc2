/* test_leds_window.c - `lutetia leds` with a window: the screen shows the pictures of the PNG
 * files. Tests also what closes the window, the program, or both. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <fcntl.h>
#include <png.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/wait.h>

#include "clock.h"
#include "scratch.h"
#include "xvfb.h"

#include <X11/keysym.h>

static const char *lutetia, *latcher, *painter;

/* ---- commands that run beside the test ---- */

struct command {
    const char *arguments[16]; /* NULL ends them */
    const char *variables[4];  /* NAME=value, or NAME to remove it */

    pid_t pid;
    int said_from;   /* both outputs */
    char said[4096]; /* after command_end() */
};

static void command_start(struct command *command)
{
    int ends[2];
    assert_int_equal(pipe2(ends, O_CLOEXEC), 0);
    command->pid = fork();
    assert_true(command->pid >= 0);
    if (command->pid == 0) {
        dup2(ends[1], STDOUT_FILENO);
        dup2(ends[1], STDERR_FILENO);
        for (int i = 0; i < 4 && command->variables[i]; i++)
            putenv(strdup(command->variables[i]));
        char *arguments[17] = {NULL};
        for (int i = 0; i < 16 && command->arguments[i]; i++)
            arguments[i] = strdup(command->arguments[i]);
        execv(arguments[0], arguments);
        _exit(127);
    }
    close(ends[1]);
    command->said_from = ends[0];
}

/* Reads the outputs of the command and of all processes that it started to their ends, and
 * waits for the command. Returns its exit status, or 1000 plus the signal that ended it. */
static int command_end(struct command *command)
{
    size_t count = 0;
    ssize_t got;
    struct pollfd more = {.fd = command->said_from, .events = POLLIN};
    while (poll(&more, 1, 30000) > 0 && (got = read(command->said_from, command->said + count,
                                                    sizeof command->said - 1 - count)) > 0)
        count += (size_t)got;
    command->said[count] = '\0';
    close(command->said_from);
    if (!more.revents) /* half a minute without a word */
        kill(command->pid, SIGKILL);
    int status;
    while (waitpid(command->pid, &status, 0) != command->pid)
        ;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

static void ends_with(struct command *command, int wanted)
{
    int status = command_end(command);
    if (status != wanted)
        fail_msg("%s ended with %d for %d and said: %s", command->arguments[0], status, wanted,
                 command->said);
}

static void one_line(const struct command *command, const char *part)
{
    const char *end = strchr(command->said, '\n');
    if (!end || end[1] || !strstr(command->said, part))
        fail_msg("no single line with \"%s\": %s", part, command->said);
}

static Window window_of(const char *title)
{
    Window window = screen_window(title, 30);
    if (!window)
        fail_msg("there is no window \"%s\"", title);
    return window;
}

/* ---- pictures ---- */

static struct display_image png_take(const char *path)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&png, path))
        fail_msg("%s: %s", path, png.message);
    png.format = PNG_FORMAT_RGB;
    struct display_image image = {(int)png.width, (int)png.height, 3, NULL};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    assert_true(png_image_finish_read(&png, NULL, image.pixels, 0, NULL));
    assert_int_equal(unlink(path), 0);
    return image;
}

/* The picture that `lutetia leds -o` makes of this source; the last argument is NULL. */
static struct display_image picture_of(const char *size, const char *view, const char *source,
                                       const char *first, const char *second)
{
    const char *path = scratch_path("picture.png");
    struct command command = {.arguments = {lutetia, "leds", "--size", size, "--view", view,
                                            "-o", path, source, first, second}};
    command_start(&command);
    ends_with(&command, 0);
    return png_take(path);
}

static void shows(Window window, const struct display_image *image)
{
    if (!screen_shows(window, image, 20))
        fail_msg("it is not on the screen");
}

/* Writes a recording whose frames are apart_us microseconds apart. */
static const char *recording(const char *name, int frames, uint32_t apart_us)
{
    const char *path = scratch_path(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs("lutetia leds 1 4096\n", file);
    for (int i = 0; i < frames; i++) {
        uint8_t frame[520] = {0};
        for (int k = 0; k < 4; k++)
            frame[k] = (uint8_t)((uint32_t)i * apart_us >> 8 * k);
        memset(frame + 8, 0x35 + i, 512);
        fwrite(frame, 1, sizeof frame, file);
    }
    assert_int_equal(fclose(file), 0);
    return path;
}

static pid_t pid_in(const char *path)
{
    long pid = 0;
    for (int tries = 0; tries < 2000 && pid == 0; tries++) {
        FILE *file = fopen(path, "r");
        if (!file || fscanf(file, "%ld", &pid) != 1) {
            pid = 0;
            usleep(10000);
        }
        if (file)
            fclose(file);
    }
    assert_true(pid > 1);
    unlink(path);
    return (pid_t)pid;
}

/* ---- without a display ---- */

#define NO_DISPLAY "DISPLAY", "WAYLAND_DISPLAY"

static void no_display_is_said(void **state)
{
    (void)state;
    struct command wanted = {
        .arguments = {lutetia, "leds", "--window", "--size", "64x64", "--pattern", "on"},
        .variables = {NO_DISPLAY}};
    command_start(&wanted);
    ends_with(&wanted, 1);
    one_line(&wanted, "lutetia leds: --window: no display: neither DISPLAY nor");

    struct command refused = {
        .arguments = {lutetia, "leds", "--window", "--size", "64x64", "--pattern", "on"},
        .variables = {"DISPLAY=:4095", "WAYLAND_DISPLAY"}};
    command_start(&refused);
    ends_with(&refused, 1);
    one_line(&refused, ":4095");

    struct command program = {.arguments = {latcher, scratch_path("pid"), "end"},
                              .variables = {"LUTETIA_LEDS=window", NO_DISPLAY}};
    command_start(&program);
    ends_with(&program, 1);
    one_line(&program, "CM_latch_leds: LUTETIA_LEDS=window: no display");
}

/* Without a display, and without --window, the command writes a picture. */
static void no_display_gives_pictures(void **state)
{
    (void)state;
    struct display_image wanted = picture_of("64x64", "front", "--pattern", "on", NULL);
    const char *displays[] = {"DISPLAY", "DISPLAY=:4095"};
    for (int i = 0; i < 2; i++) {
        struct command command = {.arguments = {lutetia, "leds", "--size", "64x64", "--view",
                                                "front", "--pattern", "on"},
                                  .variables = {displays[i], "WAYLAND_DISPLAY"}};
        command_start(&command);
        ends_with(&command, 0);
        if (i == 0)
            assert_string_equal(command.said, "");
        else
            one_line(&command, "leds.png");
        struct display_image image = png_take("leds.png");
        assert_memory_equal(image.pixels, wanted.pixels, 3 * 64 * 64);
        display_image_destroy(&image);
    }
    display_image_destroy(&wanted);
}

/* ---- with one ---- */

static void programs_are_shown_and_the_last_picture_stays(void **state)
{
    (void)state;
    const char *pid = scratch_path("pid");
    struct display_image last = picture_of("200x200", "cube", latcher, pid, "end");
    struct command command = {
        .arguments = {lutetia, "leds", "--size", "200x200", latcher, pid, "end"}};
    command_start(&command);
    Window window = window_of("leds_latcher - lights");
    assert_true(window_of("(ended)") == window);
    shows(window, &last);
    assert_int_equal(kill(command.pid, 0), 0);
    screen_key(window, XK_Escape);
    ends_with(&command, 0);
    assert_string_equal(command.said, "both\n");
    assert_int_not_equal(access("leds.png", F_OK), 0);
    display_image_destroy(&last);
}

/* Frames wait for their time on the window's clock. The second frame is hours away; the key `.`
 * shows it at once. With --close the command then ends, and -o still writes the picture. */
static void recordings_wait_for_the_clock(void **state)
{
    (void)state;
    const char *one = recording("one", 1, 0), *both = recording("both", 2, 4000000000u);
    const char *out = scratch_path("out.png"), *soon = recording("soon", 2, 50000);
    struct display_image first = picture_of("120x100", "front", one, NULL, NULL);
    struct display_image second = picture_of("120x100", "front", both, NULL, NULL);
    struct command command = {.arguments = {lutetia, "leds", "--window", "--close", "--size",
                                            "120x100", "--view", "front", "-o", out, both}};
    assert_true(memcmp(first.pixels, second.pixels, 3 * 120 * 100) != 0);
    command_start(&command);
    Window window = window_of("both - lights");
    shows(window, &first);
    screen_key(window, XK_a); /* means nothing */
    screen_key(window, XK_period);
    ends_with(&command, 0);
    assert_string_equal(command.said, "");
    struct display_image written = png_take(out);
    assert_memory_equal(written.pixels, second.pixels, 3 * 120 * 100);
    display_image_destroy(&written);

    /* Without a key the second frame comes at its time and stays on the screen. */
    command.arguments[2] = "--window";
    command.arguments[3] = "--fps";
    command.arguments[4] = "1000";
    const char *rest[] = {"--size", "120x100", "--view", "front", soon, NULL};
    memcpy(command.arguments + 5, rest, sizeof rest);
    command_start(&command);
    window = window_of("soon - lights");
    shows(window, &second);
    screen_close(window);
    ends_with(&command, 0);
    display_image_destroy(&first);
    display_image_destroy(&second);
}

static void patterns_go_on_until_the_window_is_closed(void **state)
{
    (void)state;
    struct display_image third =
        picture_of("100x100", "door", "--pattern=random", "--count", "3");
    struct command some = {.arguments = {lutetia, "leds", "--size", "100x100", "--view", "door",
                                         "--fps", "50", "--count", "3", "--pattern", "random"}};
    command_start(&some);
    Window window = window_of("random - lights (ended)");
    shows(window, &third);
    screen_close(window);
    ends_with(&some, 0);

    struct command all = {.arguments = {lutetia, "leds", "--size", "100x100", "--view", "door",
                                        "--fps", "50", "--pattern", "random"}};
    command_start(&all);
    window = window_of("random - lights");
    struct display_image seen = third;
    int changes = 0;
    for (double until = clock_now_s() + 20; changes < 5 && clock_now_s() < until;) {
        struct display_image now;
        screen_read(window, &now);
        assert_non_null(now.pixels);
        changes += memcmp(now.pixels, seen.pixels, 3 * 100 * 100) != 0;
        display_image_destroy(&seen);
        seen = now;
        usleep(20000);
    }
    assert_int_equal(changes, 5);
    display_image_destroy(&seen);
    kill(all.pid, SIGINT);
    ends_with(&all, 130);
    one_line(&all, "interrupted");
}

static void closing_stops_the_program(void **state)
{
    (void)state;
    const char *path = scratch_path("pid");
    struct display_image last = picture_of("100x100", "cube", latcher, path, "end");
    unlink(path);
    struct command command = {
        .arguments = {lutetia, "leds", "--size", "100x100", latcher, path, "wait"}};
    command_start(&command);
    Window window = window_of("leds_latcher - lights");
    shows(window, &last);
    pid_t pid = pid_in(path);
    assert_int_equal(kill(pid, 0), 0);
    screen_close(window);
    ends_with(&command, 0);
    assert_true(kill(pid, 0) != 0 && errno == ESRCH);

    /* A program that ignores SIGINT. */
    struct command deaf = {.arguments = {lutetia, "leds", "--size", "100x100", "/bin/sh", "-c",
                                         "trap '' INT; exec \"$0\" \"$1\" wait", latcher,
                                         path}};
    command_start(&deaf);
    window = window_of("sh - lights");
    shows(window, &last);
    pid = pid_in(path);
    screen_key(window, XK_Escape);
    ends_with(&deaf, 0);
    assert_true(kill(pid, 0) != 0 && errno == ESRCH);
    display_image_destroy(&last);
}

/* LUTETIA_LEDS=window: the program ends and closes its output, but the window stays. On the
 * small screen its side is nine tenths of 260 pixels. */
static void programs_show_themselves(void **state)
{
    (void)state;
    const char *path = scratch_path("pid");
    struct display_image last = picture_of("234x234", "cube", latcher, path, "end");
    struct command command = {.arguments = {latcher, path, "end"},
                              .variables = {"LUTETIA_LEDS=window"}};
    unlink(path);
    command_start(&command);
    ends_with(&command, 0);
    assert_string_equal(command.said, "both\n");
    pid_in(path);
    Window window = window_of("leds_latcher - lights (ended)");
    shows(window, &last);
    screen_key(window, XK_Escape);
    assert_true(screen_window_gone(window, 20));

    /* Closing the window interrupts the running program. */
    command = (struct command){.arguments = {latcher, path, "wait"},
                               .variables = {"LUTETIA_LEDS=window"}};
    command_start(&command);
    window = window_of("leds_latcher - lights");
    shows(window, &last);
    screen_close(window);
    ends_with(&command, 1000 + SIGINT);
    assert_true(screen_window_gone(window, 20));
    pid_in(path);

    /* Without a display the viewer prints the reason, and the program that there is no
     * window. */
    command = (struct command){.arguments = {latcher, path, "end"},
                               .variables = {"LUTETIA_LEDS=window", "DISPLAY=:4095"}};
    command_start(&command);
    ends_with(&command, 1);
    assert_non_null(strstr(command.said, ":4095"));
    assert_non_null(strstr(command.said, "CM_latch_leds: LUTETIA_LEDS=window: `lutetia leds` "
                                         "opened no window"));
    display_image_destroy(&last);
}

/* On a screen with twice the resolution the window has twice as many pixels, and the picture is
 * drawn in that size. */
static void fine_screens_have_larger_windows(void **state)
{
    (void)state;
    struct display_image seen = {0};
    struct command command = {.arguments = {lutetia, "leds", "--size", "70x100", "--view",
                                            "front", "--pattern", "on"}};
    screen_dpi(192);
    command_start(&command);
    Window window = window_of("on - lights");
    screen_read(window, &seen);
    assert_int_equal(seen.width_px, 140);
    assert_int_equal(seen.height_px, 200);
    display_image_destroy(&seen);
    screen_dpi(0);
    screen_close(window);
    ends_with(&command, 0);
}

static void programs_without_lights_leave_no_window(void **state)
{
    (void)state;
    struct command command = {.arguments = {lutetia, "leds", "--size", "64x64", "/bin/true"}};
    command_start(&command);
    ends_with(&command, 1);
    one_line(&command, "CM_latch_leds");
    command =
        (struct command){.arguments = {lutetia, "leds", "--size", "64x64", "no-such-program"}};
    command_start(&command);
    ends_with(&command, 1);
    one_line(&command, "no-such-program: cannot run");
}

/* ---- the displays of the frame buffer ---- */

/* Whether a process has memory for pictures that it shares with a window. */
static bool shares_pictures(pid_t pid)
{
    char path[64], line[512];
    bool shares = false;
    snprintf(path, sizeof path, "/proc/%ld/maps", (long)pid);
    FILE *maps = fopen(path, "r");
    while (maps && fgets(line, sizeof line, maps))
        shares = shares || strstr(line, "memfd:pictures");
    if (maps)
        fclose(maps);
    return shares;
}

/* Each display has a window, which shows the newest picture and stays when the program has
 * ended. */
static void displays_are_shown(void **state)
{
    (void)state;
    const char *pid = scratch_path("pid"), *out = scratch_path("out.png");
    struct command files = {
        .arguments = {lutetia, "display", "-o", out, painter, pid, "end", "two"}};
    command_start(&files);
    ends_with(&files, 0);
    struct display_image first = png_take(out), second = png_take(scratch_path("out-2.png"));

    struct command command = {.arguments = {lutetia, "display", painter, pid, "end", "two"}};
    command_start(&command);
    assert_true(window_of("display_painter - display (ended)") != 0);
    Window two = window_of("second - display (ended)"); /* it lies over the first one */
    shows(two, &second);
    screen_key(two, XK_Escape);
    ends_with(&command, 0);
    assert_string_equal(command.said, "");

    /* LUTETIA_DISPLAY=window: the program shows itself, and closing the window interrupts
     * it. */
    unlink(pid);
    struct command alone = {.arguments = {painter, pid, "wait"},
                            .variables = {"LUTETIA_DISPLAY=window"}};
    command_start(&alone);
    Window one = window_of("display_painter - display");
    shows(one, &first);
    assert_true(shares_pictures(pid_in(pid)));
    screen_close(one);
    ends_with(&alone, 1000 + SIGINT);
    assert_true(screen_window_gone(one, 20));

    /* Displays that are gone before they were drawn. */
    for (int i = 0; i < 5; i++) {
        struct command leaves = {
            .arguments = {lutetia, "display", "--close", painter, pid, "leave"}};
        command_start(&leaves);
        ends_with(&leaves, 0);
        assert_string_equal(leaves.said, "");
    }
    display_image_destroy(&first);
    display_image_destroy(&second);
}

/* Sets the environment so that files go into the scratch folder and the built `lutetia` is on
 * the PATH. */
static void surroundings_make(void)
{
    char path[8192];
    const char *slash = strrchr(lutetia, '/'), *old = getenv("PATH");
    snprintf(path, sizeof path, "%.*s:%s", (int)(slash - lutetia), lutetia, old ? old : "");
    setenv("PATH", path, 1);
    unsetenv("LUTETIA_LEDS");
    scratch_path("");
    int status = chdir(scratch_dir);
    assert_int_equal(status, 0);
}

int main(void)
{
    const struct CMUnitTest without[] = {
        cmocka_unit_test(no_display_is_said),
        cmocka_unit_test(no_display_gives_pictures),
    };
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(programs_are_shown_and_the_last_picture_stays),
        cmocka_unit_test(recordings_wait_for_the_clock),
        cmocka_unit_test(patterns_go_on_until_the_window_is_closed),
        cmocka_unit_test(closing_stops_the_program),
        cmocka_unit_test(programs_show_themselves),
        cmocka_unit_test(fine_screens_have_larger_windows),
        cmocka_unit_test(programs_without_lights_leave_no_window),
        cmocka_unit_test(displays_are_shown),
    };
    lutetia = getenv("LUTETIA");
    latcher = getenv("LATCHER");
    painter = getenv("PAINTER");
    if (!lutetia || !latcher || !painter)
        return 77;
    surroundings_make();
    int failed = cmocka_run_group_tests(without, NULL, NULL);
    if (!screen_start("300x260"))
        return failed ? failed : 77;
    failed += cmocka_run_group_tests(tests, NULL, NULL);
    screen_end();
    return failed;
}
