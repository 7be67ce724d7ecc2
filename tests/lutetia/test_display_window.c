/* `lutetia display` in a window, on screens of 24 and of 16 bits: each pixel is the nearest
 * colour that the screen has, by the display's map, zoom and pan, also when the window gets
 * another size and its first one again. */
#include <display_recording.h>

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "../display/display_pieces.h"
#include "clock.h"
#include "sample.h"
#include "xvfb.h"

enum { WIDTH = 61, HEIGHT = 37, DEEP_WIDTH = 40, DEEP_HEIGHT = 30 };

static uint64_t random_state = 21;
static struct pieces pieces;
static int screen_bits;

struct scene {
    const char *what;
    int pixel_bytes, zoom[2], pan[2];
    bool map_given;
};

static const struct scene scenes[] = {{"gray", 1, {1, 1}, {0, 0}, false},
                                      {"colours", 1, {1, 1}, {0, 0}, true},
                                      {"zoomed", 1, {3, 2}, {5, -4}, true},
                                      {"deep", 4, {1, 1}, {0, 0}, false},
                                      {"deep by a map", 4, {2, 5}, {-3, 6}, true}};

static uint8_t pixels[4 * WIDTH * HEIGHT], map[256][3];

/* The recording, and what must be seen. */
static void scene_make(const struct scene *s, struct display_image *wanted)
{
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] =
            (uint8_t)(s->pixel_bytes == 4 && i % 4 == 3 ? 0 : sample_word(&random_state));
    for (int i = 0; i < 256; i++)
        for (int c = 0; c < 3; c++)
            map[i][c] = (uint8_t)(s->map_given ? sample_word(&random_state) : (uint64_t)i);
    pieces.count = 0;
    pieces_line(&pieces);
    pieces_size(&pieces, 1, s->pixel_bytes, WIDTH, HEIGHT, 0);
    pieces_map(&pieces, 1, map, 1);
    pieces_pixels(&pieces, 1, 1, s->pixel_bytes, WIDTH, HEIGHT, 0, 0, pixels, 2);
    pieces_view(&pieces, 1, 1, s->zoom[0], s->zoom[1], s->pan[0], s->pan[1], 3);
    *wanted = (struct display_image){.width_px = WIDTH, .height_px = HEIGHT, .channels = 3};
    assert_int_equal(display_image_create(wanted), DISPLAY_OK);
    for (int Y = 0; Y < HEIGHT; Y++)
        for (int X = 0; X < WIDTH; X++) {
            const int x = s->pan[0] + X / s->zoom[0], y = s->pan[1] + Y / s->zoom[1];
            const bool beyond = x < 0 || y < 0 || x >= WIDTH || y >= HEIGHT;
            for (int c = 0; c < 3 && !beyond; c++)
                wanted->pixels[3 * (Y * WIDTH + X) + c] =
                    map[s->pixel_bytes == 1 ? pixels[y * WIDTH + x]
                                            : pixels[4 * (y * WIDTH + x) + c]][c];
            for (int c = 0; c < 3 && beyond; c++)
                wanted->pixels[3 * (Y * WIDTH + X) + c] = 0;
        }
}

/* argument: NULL is fine. */
static pid_t shown(const char *what, const char *argument)
{
    const pid_t child = fork();
    if (child == 0) {
        execl(getenv("LUTETIA"), "lutetia", "display", "--window", what, argument,
              (char *)NULL);
        _exit(127);
    }
    return child;
}

/* Half a step, and what channel_of() cuts off. */
static int error_most(int channel)
{
    const int bits = screen_bits == 24 ? 8 : channel == 1 ? 6 : 5;
    return bits == 8 ? 0 : 255 / ((1 << bits) - 1) / 2 + 1;
}

static bool seen_in(Window window, const struct display_image *wanted, bool say)
{
    struct display_image seen;
    screen_read(window, &seen);
    bool same =
        seen.pixels && seen.width_px == wanted->width_px && seen.height_px == wanted->height_px;
    for (int i = 0; same && i < 3 * wanted->width_px * wanted->height_px; i++) {
        same = abs(seen.pixels[i] - wanted->pixels[i]) <= error_most(i % 3);
        if (!same && say)
            fprintf(stderr, "at %d,%d channel %d: %d is seen for %d\n",
                    i / 3 % wanted->width_px, i / 3 / wanted->width_px, i % 3, seen.pixels[i],
                    wanted->pixels[i]);
    }
    display_image_destroy(&seen);
    return same;
}

static void must_be_seen(Window window, const struct display_image *wanted, const char *what)
{
    const double until_s = clock_now_s() + 10;
    while (!seen_in(window, wanted, false))
        if (clock_now_s() > until_s) {
            seen_in(window, wanted, true);
            fail_msg("%s, %d bits", what, screen_bits);
        } else {
            usleep(10000);
        }
}

static void scene_is_seen(const struct scene *s)
{
    char recording[] = "/tmp/lutetia-display-XXXXXX";
    struct display_image wanted;
    scene_make(s, &wanted);
    const int file = mkstemp(recording);
    assert_true(file >= 0);
    assert_int_equal(write(file, pieces.bytes, pieces.count), pieces.count);
    close(file);
    const pid_t child = shown(recording, NULL);
    const Window window = screen_window("tcit", 20);
    assert_true(window != 0);
    must_be_seen(window, &wanted, s->what);
    screen_resize(window, 2 * WIDTH, HEIGHT + 11);
    usleep(100000);
    screen_resize(window, WIDTH, HEIGHT);
    must_be_seen(window, &wanted, "the first size again");
    int status;
    screen_close(window);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    unlink(recording);
    display_image_destroy(&wanted);
}

/* What a program writes goes to the window in memory that both have, whole or in parts. */
static void programs_pixels_are_seen(void **unused)
{
    (void)unused;
    static const char *const ways[] = {"whole", "raw", "channels", "parts", "turned"};
    struct display_image wanted = {
        .width_px = DEEP_WIDTH, .height_px = DEEP_HEIGHT, .channels = 3};
    assert_int_equal(display_image_create(&wanted), DISPLAY_OK);
    for (int i = 0; i < DEEP_WIDTH * DEEP_HEIGHT; i++) {
        const int x = i % DEEP_WIDTH, y = i / DEEP_WIDTH;
        const uint8_t pixel[3] = {(uint8_t)(6 * x), (uint8_t)(8 * y), (uint8_t)(5 * x + y)};
        memcpy(wanted.pixels + 3 * i, pixel, sizeof pixel);
    }
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        const pid_t child = shown(getenv("DEEP_PAINTER"), ways[i]);
        const Window window = screen_window("deep", 20);
        int status;
        assert_true(window != 0);
        must_be_seen(window, &wanted, ways[i]);
        screen_resize(window, 2 * DEEP_WIDTH, DEEP_HEIGHT + 11);
        usleep(100000);
        screen_resize(window, DEEP_WIDTH, DEEP_HEIGHT);
        must_be_seen(window, &wanted, "the first size again");
        screen_close(window);
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(screen_window_gone(window, 5));
    }
    display_image_destroy(&wanted);
}

static void pixels_are_the_nearest_that_the_screen_has(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        scene_is_seen(&scenes[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_the_nearest_that_the_screen_has),
        cmocka_unit_test(programs_pixels_are_seen)};
    const char *const sizes[] = {"300x200", "300x200x16"};
    int failed = 0;
    for (int i = 0; i < 2; i++) {
        screen_bits = i ? 16 : 24;
        if (!getenv("LUTETIA") || !getenv("DEEP_PAINTER") || !screen_start(sizes[i]))
            return failed ? failed : 77;
        failed += cmocka_run_group_tests(tests, NULL, NULL);
        screen_end();
    }
    return failed;
}
