/* test_sound_said.c - the window of `lutetia spring` says where a sound server comes and goes:
 * PulseAudio of the test's own. Skips where there is none, or no FluidSynth. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../clock.h"
#include "../display/scratch.h"
#include "../midi/sound_server.h"
#include "../skip.h"
#include "xvfb.h"

#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char socket_path[300], errors_path[300];

static pid_t server_begin(void)
{
    const pid_t server = sound_server_begin(socket_path);
    return sound_server_wait(server, socket_path) ? server : -1;
}

static bool same(const struct display_image *a, const struct display_image *b)
{
    return a->pixels && b->pixels && a->width_px == b->width_px &&
           a->height_px == b->height_px &&
           memcmp(a->pixels, b->pixels,
                  (size_t)a->width_px * (size_t)a->height_px * (size_t)a->channels) == 0;
}

/* Waits until the window's picture is, or is no longer, that of the word alone. */
static void picture_wait(Window window, const struct display_image *alone, bool is_alone)
{
    const double until_s = clock_now_s() + 25;
    bool found = false;
    while (!found && clock_now_s() < until_s) {
        struct display_image now = {0};
        screen_read(window, &now);
        found = now.pixels && same(alone, &now) == is_alone;
        display_image_destroy(&now);
        poll(NULL, 0, 50);
    }
    if (!found)
        fail_msg("the window %s", is_alone ? "still says something" : "says nothing");
}

/* A word that does not move: the picture changes where the window says something. */
static void comings_and_goings_are_said(void **state)
{
    (void)state;
    char address[320], line[400] = "";
    snprintf(socket_path, sizeof socket_path, "%s", scratch_path("said.socket"));
    snprintf(errors_path, sizeof errors_path, "%s", scratch_path("said.errors"));
    snprintf(address, sizeof address, "unix:%s", socket_path);
    setenv("PULSE_SERVER", address, 1);
    setenv("JACK_DEFAULT_SERVER", "lutetia-none", 1);
    setenv("HOME", scratch_path("."), 1);
    unsetenv("XDG_RUNTIME_DIR");
    pid_t server = server_begin();
    if (server < 0)
        skip_because("no pulseaudio runs here");
    program_end(server);
    unlink(socket_path);
    char *const words[] = {getenv("LUTETIA"), "spring",    "a",     "--size",   "400x300",
                           "--set",           "gravity=0", "--set", "grid=off", NULL};
    const pid_t spring = program_begin(words, "/dev/null", errors_path);
    const Window window = screen_window("spring", 15);
    assert_true(window != 0);
    poll(NULL, 0, 8000); /* what it says at first has gone */
    FILE *errors = fopen(errors_path, "r");
    (void)!fgets(line, sizeof line, errors);
    fclose(errors);
    if (!strstr(line, "it is looked for")) {
        program_end(spring);
        skip_because("no sound is made here: %s", line);
    }
    struct display_image alone = {0};
    screen_read(window, &alone);
    assert_non_null(alone.pixels);
    picture_wait(window, &alone, true);
    for (int times = 0; times < 2; times++) {
        server = server_begin();
        assert_true(server > 0);
        picture_wait(window, &alone, false);
        picture_wait(window, &alone, true);
        program_end(server);
        unlink(socket_path);
        picture_wait(window, &alone, false);
        picture_wait(window, &alone, true);
    }
    display_image_destroy(&alone);
    kill(spring, SIGINT);
    int status;
    assert_int_equal(waitpid(spring, &status, 0), spring);
    assert_true(WIFEXITED(status));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(comings_and_goings_are_said)};
    if (!getenv("LUTETIA") || !screen_start("800x600"))
        return 77;
    const int failed = cmocka_run_group_tests_name("sound said", tests, NULL, NULL);
    screen_end();
    return failed;
}
