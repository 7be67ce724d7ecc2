/* test_window.c - windows on an Xvfb: the screen shows the image that a window was given. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <window.h>

#include <stdlib.h>
#include <string.h>

#include "xvfb.h"

#include <X11/keysym.h>

static uint64_t random_state = 5;

static uint8_t random_byte(void)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint8_t)(random_state >> 40);
}

static struct window *window_open(const char *title, int width, int height)
{
    struct window_config config = window_config_default();
    struct window *window;
    config.title = title;
    config.width_px = width;
    config.height_px = height;
    if (window_create(&config, &window) != DISPLAY_OK)
        fail_msg("%s", display_error());
    return window;
}

static Window on_screen(const char *title)
{
    Window found = screen_window(title, 10);
    assert_true(found != 0);
    return found;
}

/* An image of noise; its memory ends with the last pixel. */
static struct display_image noise(int width, int height, int channels)
{
    size_t bytes = (size_t)width * (size_t)height * (size_t)channels;
    struct display_image image = {width, height, channels, malloc(bytes)};
    assert_non_null(image.pixels);
    for (size_t i = 0; i < bytes; i++)
        image.pixels[i] = random_byte();
    return image;
}

/* The image as the screen shows it in three channels, on black where alpha is below 1. */
static struct display_image as_seen(const struct display_image *image)
{
    struct display_image seen = {image->width_px, image->height_px, 3, NULL};
    assert_int_equal(display_image_create(&seen), DISPLAY_OK);
    for (int i = 0; i < image->width_px * image->height_px; i++)
        for (int c = 0; c < 3; c++) {
            const uint8_t *pixel = image->pixels + i * image->channels;
            seen.pixels[3 * i + c] = pixel[image->channels == 1 ? 0 : c];
        }
    return seen;
}

static void no_display_is_said(void **state)
{
    (void)state;
    struct window_config config = window_config_default();
    struct window *window = (struct window *)&config;
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    assert_false(window_possible());
    assert_int_equal(window_create(&config, &window), DISPLAY_NO_WINDOW);
    assert_null(window);
    assert_non_null(strstr(display_error(), "DISPLAY"));
    setenv("DISPLAY", ":4095", 1);
    assert_true(window_possible());
    assert_int_equal(window_create(&config, &window), DISPLAY_NO_WINDOW);
    assert_non_null(strstr(display_error(), ":4095"));
    assert_null(strchr(display_error(), '\n'));
    window_destroy(NULL);
}

static void images_are_shown_pixel_for_pixel(void **state)
{
    (void)state;
    static const struct {
        int width, height, channels;
    } cases[] = {{301, 203, 3}, {301, 203, 3}, {301, 203, 1}, {301, 203, 4}};
    struct window *window = window_open("pixels", 301, 203);
    Window there = on_screen("pixels");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct display_image image = noise(cases[i].width, cases[i].height, cases[i].channels);
        for (int k = 3; image.channels == 4 && k < 4 * 301 * 203; k += 4)
            image.pixels[k] = 255;
        struct display_image seen = as_seen(&image);
        assert_int_equal(window_show(window, &image), DISPLAY_OK);
        if (!screen_shows(there, &seen, 5))
            fail_msg("case %zu", i);
        display_image_destroy(&seen);
        display_image_destroy(&image);
    }
    /* The same pixels, painted where the window has them; there is no such place on a graphics
     * card, and none of another size. */
    struct display_image image = noise(301, 203, 3);
    struct display_room room;
    assert_false(window_room_begin(window, 300, 203, &room));
    if (window_room_begin(window, 301, 203, &room)) {
        for (size_t y = 0; y < 203; y++)
            for (size_t x = 0; x < 301; x++) {
                const uint8_t *pixel = image.pixels + 3 * (301 * y + x);
                room.pixels[y * room.stride + x] = UINT32_C(0xff000000) |
                                                   (uint32_t)pixel[0] << 16 |
                                                   (uint32_t)pixel[1] << 8 | pixel[2];
            }
        window_room_show(window);
        assert_true(screen_shows(there, &image, 5));
    }
    display_image_destroy(&image);
    window_destroy(window);
    assert_true(screen_window_gone(there, 5));
}

/* The server shows pixels from the memory of another program; no copy is made. */
static void shared_pixels_are_shown_from_where_they_lie(void **state)
{
    (void)state;
    struct picture_room room;
    struct window *window = window_open("shared", 301, 203);
    Window there = on_screen("shared");
    if (!picture_room_make(&room))
        skip();
    for (int slot = 3; slot >= 0; slot--) {
        struct display_image image = noise(301, 203, 3);
        uint8_t *pixels = picture_room_slot(&room, slot);
        for (int i = 0; i < 301 * 203; i++)
            for (int c = 0; c < 4; c++)
                pixels[4 * i + c] = c < 3 ? image.pixels[3 * i + 2 - c] : (uint8_t)i;
        assert_false(window_shared_show(window, &room, pixels, 203, 301));
        if (window_shared_show(window, &room, pixels, 301, 203)) {
            struct input_event event;
            assert_true(screen_shows(there, &image, 5));
            screen_resize(there, 602, 400);
            window_input_take(window, 0.2, &event);
            screen_resize(there, 301, 203);
            for (int i = 0; i < 20; i++)
                window_input_take(window, 0.02, &event);
            assert_true(screen_shows(there, &image, 5));
            window_settle(window);
        }
        display_image_destroy(&image);
    }
    window_destroy(window);
    picture_room_end(&room);
}

/* A half transparent colour on black. */
static void alpha_covers_black(void **state)
{
    (void)state;
    struct window *window = window_open("alpha", 64, 64);
    Window there = on_screen("alpha");
    struct display_image image = noise(64, 64, 4), seen;
    for (int i = 0; i < 64 * 64; i++)
        memcpy(image.pixels + 4 * i, (uint8_t[]){200, 100, 50, i % 64 < 32 ? 128 : 0}, 4);
    assert_int_equal(window_show(window, &image), DISPLAY_OK);
    display_image_destroy(&image);
    image = noise(64, 64, 3);
    for (int tries = 0; tries < 500; tries++) {
        screen_read(there, &seen);
        if (seen.pixels && seen.pixels[0])
            break;
        display_image_destroy(&seen);
    }
    assert_non_null(seen.pixels);
    for (int i = 0; i < 64 * 64; i++)
        for (int c = 0; c < 3; c++) {
            int wanted = i % 64 < 32 ? (200 >> c) * 128 / 255 : 0;
            assert_in_range(seen.pixels[3 * i + c] + 1, wanted, wanted + 2);
        }
    display_image_destroy(&seen);
    display_image_destroy(&image);
    window_destroy(window);
}

/* An image with quarters of four colours in a window of another ratio: bars at the edges are
 * black, and the middle of each quarter has its colour. */
static void ratios_are_kept(void **state)
{
    (void)state;
    static const uint8_t colours[4][3] = {
        {255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}};
    static const struct {
        int width, height, shown_width, shown_height;
    } cases[] = {{700, 200, 400, 200},
                 {200, 500, 200, 100},
                 {500, 250, 500, 250},
                 {30, 30, 30, 15},
                 {37, 401, 37, 19}};
    struct display_image image = noise(200, 100, 3);
    for (int y = 0; y < 100; y++)
        for (int x = 0; x < 200; x++)
            memcpy(image.pixels + 3 * (y * 200 + x), colours[2 * (y >= 50) + (x >= 100)], 3);
    struct window *window = window_open("ratio", 200, 100);
    Window there = on_screen("ratio");
    assert_int_equal(window_show(window, &image), DISPLAY_OK);
    assert_true(screen_shows(there, &image, 5));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int w = cases[i].width, h = cases[i].height, width, height;
        struct input_event event;
        screen_resize(there, w, h);
        while (window_input_take(window, 2, &event) && event.width_px != w)
            ;
        assert_int_equal(event.kind, INPUT_SIZE);
        assert_int_equal(event.height_px, h);
        window_size(window, &width, &height);
        assert_true(width == w && height == h);

        int left = (w - cases[i].shown_width) / 2, top = (h - cases[i].shown_height) / 2;
        int wrong = -1;
        for (int tries = 0; tries < 200 && wrong; tries++) {
            struct display_image seen;
            wrong = 0;
            screen_read(there, &seen);
            assert_non_null(seen.pixels);
            for (int y = 0; y < h; y++)
                for (int x = 0; x < w; x++) {
                    const uint8_t *pixel = seen.pixels + 3 * (y * w + x);
                    int u = x - left, v = y - top;
                    bool bar = u < 0 || v < 0 || u >= cases[i].shown_width ||
                               v >= cases[i].shown_height;
                    int right = 2 * u >= cases[i].shown_width,
                        below = 2 * v >= cases[i].shown_height;
                    bool edge = abs(2 * u + 1 - cases[i].shown_width) < 16 ||
                                abs(2 * v + 1 - cases[i].shown_height) < 16;
                    wrong += bar ? pixel[0] || pixel[1] || pixel[2]
                                 : !edge && memcmp(pixel, colours[2 * below + right], 3) != 0;
                }
            display_image_destroy(&seen);
            window_input_take(window, 0.01, &event);
        }
        if (wrong)
            fail_msg("case %zu: %d pixels are wrong", i, wrong);
    }
    display_image_destroy(&image);
    window_destroy(window);
}

/* Small squares of black and white become gray, and not one or the other. */
static void shrunk_images_are_means(void **state)
{
    (void)state;
    struct display_image image = noise(512, 512, 1), seen = {0};
    for (int i = 0; i < 512 * 512; i++)
        image.pixels[i] = (i ^ i / 512) & 1 ? 255 : 0;
    struct window *window = window_open("means", 100, 100);
    Window there = on_screen("means");
    assert_int_equal(window_show(window, &image), DISPLAY_OK);
    for (int tries = 0; tries < 500; tries++) {
        screen_read(there, &seen);
        if (seen.pixels && seen.pixels[0])
            break;
        display_image_destroy(&seen);
    }
    assert_non_null(seen.pixels);
    for (int i = 0; i < 3 * 100 * 100; i++)
        assert_in_range(seen.pixels[i], 120, 135);
    display_image_destroy(&seen);
    display_image_destroy(&image);
    window_destroy(window);
}

/* Takes the next event, which must be of this kind. Skips moves and changes of focus, because
 * they depend on the place of Xvfb's pointer. */
static void take_kind(struct window *window, enum input_kind kind, struct input_event *event)
{
    do {
        if (!window_input_take(window, 5, event))
            fail_msg("no event of kind %d came", kind);
    } while (event->kind != kind &&
             (event->kind == INPUT_POINTER_MOVE || event->kind == INPUT_POINTER_LEAVE ||
              event->kind == INPUT_FOCUS_LOST || event->kind == INPUT_SIZE));
    assert_int_equal(event->kind, kind);
}

static void keys_and_closing_are_events(void **state)
{
    (void)state;
    static const struct {
        KeySym sent;
        int key;
    } keys[] = {{XK_a, 'A'},
                {XK_7, '7'},
                {XK_space, ' '},
                {XK_Escape, INPUT_KEY_ESCAPE},
                {XK_Return, INPUT_KEY_ENTER},
                {XK_Left, INPUT_KEY_LEFT},
                {XK_Shift_L, INPUT_KEY_SHIFT},
                {XK_F5, INPUT_KEY_F1 + 4},
                {XK_Scroll_Lock, INPUT_KEY_OTHER}};
    struct window *window = window_open("events", 100, 100);
    Window there = on_screen("events");
    struct input_event event;
    double before_s = input_now_s();
    while (window_input_take(window, 0.05, &event))
        ;
    assert_int_equal(event.kind, INPUT_NONE);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        screen_key(there, keys[i].sent);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        const unsigned own = keys[i].key == INPUT_KEY_SHIFT ? INPUT_SHIFT : 0;
        take_kind(window, INPUT_KEY_DOWN, &event);
        if (event.key != keys[i].key)
            fail_msg("key %zu: %d for %d", i, event.key, keys[i].key);
        assert_int_equal(event.modifiers, own);
        assert_true(event.time_s >= before_s && event.time_s <= input_now_s());
        if (keys[i].key < 0x80) { /* it writes */
            take_kind(window, INPUT_TEXT, &event);
            assert_int_equal(event.character, keys[i].key == 'A' ? 'a' : keys[i].key);
        }
        take_kind(window, INPUT_KEY_UP, &event);
        assert_int_equal(event.key, keys[i].key);
    }
    /* Of too many keys at once the first ones are kept, and closing is never lost. */
    for (int i = 0; i < INPUT_EVENTS_MAX; i++)
        screen_key(there, i % 2 ? XK_a : XK_b);
    screen_close(there);
    int count = 0;
    while (window_input_take(window, 1, &event) && event.kind != INPUT_CLOSE)
        if (event.kind == INPUT_KEY_DOWN)
            assert_int_equal(event.key, count++ % 2 ? 'A' : 'B');
    assert_in_range(count, INPUT_EVENTS_MAX / 4, INPUT_EVENTS_MAX);
    assert_int_equal(event.kind, INPUT_CLOSE);
    assert_true(window_closing(window));
    window_close(window);
    assert_false(window_input_take(window, 0, &event)); /* said once */
    assert_int_equal(event.kind, INPUT_NONE);
    window_destroy(window);
}

/* Each window has its image, its name and its events. */
static void windows_are_apart(void **state)
{
    (void)state;
    struct window *one = window_open("first", 80, 60), *two = window_open("second", 50, 90);
    struct display_image image = noise(80, 60, 3), other = noise(50, 90, 3);
    Window there = on_screen("first"), beside = on_screen("second");
    assert_int_equal(window_show(one, &image), DISPLAY_OK);
    assert_int_equal(window_show(two, &other), DISPLAY_OK);
    assert_true(screen_shows(beside, &other, 5));
    window_title_set(one, "renamed");
    window_close(one);
    assert_true(window_closing(one));
    assert_false(window_closing(two));
    window_destroy(two);
    assert_true(screen_window_gone(beside, 5));
    assert_int_equal(window_show(one, &image), DISPLAY_OK);
    assert_true(screen_shows(there, &image, 5));
    assert_true(on_screen("renamed") == there);
    window_destroy(one);
    display_image_destroy(&image);
    display_image_destroy(&other);
}

static void screens_are_not_exceeded(void **state)
{
    (void)state;
    struct window *window = window_open("large", 2000, 1000);
    int width, height;
    window_size(window, &width, &height);
    assert_int_equal(width, 720);
    assert_int_equal(height, 360);
    window_destroy(window);
}

/* A window that fills a screen, and one over all; a name of no screen is refused with those
 * that there are. */
static void windows_fill_a_screen_from_the_beginning(void **state)
{
    (void)state;
    static const char *const wrong[] = {"0", "2", "-1", "x", "1x", "", "99999999999999999999"};
    struct window_config config = window_config_default();
    struct window *window;
    int width, height;
    config.title = "filled";
    for (int i = 0; i < 2; i++) {
        config.screen = i ? "all" : "1";
        assert_int_equal(window_create(&config, &window), DISPLAY_OK);
        window_size(window, &width, &height);
        for (int k = 0; k < 100 && width != 800; k++) { /* the server tells by an event */
            struct input_event event;
            window_input_take(window, 0.05, &event);
            window_size(window, &width, &height);
        }
        assert_int_equal(width, 800);
        assert_int_equal(height, 600);
        Window there = on_screen("filled"), root, child;
        int x, y;
        unsigned wide, high, border, depth;
        assert_true(XGetGeometry(screen_display(), there, &root, &x, &y, &wide, &high, &border,
                                 &depth));
        assert_true(XTranslateCoordinates(screen_display(), there, root, 0, 0, &x, &y, &child));
        assert_true(x == 0 && y == 0 && wide == 800 && high == 600);
        window_destroy(window);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        config.screen = wrong[i];
        assert_int_equal(window_create(&config, &window), DISPLAY_BAD_ARGUMENT);
        assert_null(window);
        assert_non_null(strstr(display_error(), "there are 1 ("));
        assert_non_null(strstr(display_error(), "800x600 at 0,0"));
    }
}

static void wrong_arguments_are_refused(void **state)
{
    (void)state;
    static const struct {
        int width, height;
        const char *title;
    } configs[] = {{15, 100, "x"}, {100, -1, "x"}, {100, 20000, "x"}, {100, 100, NULL}};
    for (int i = 0; i < 4; i++) {
        struct window_config config = window_config_default();
        struct window *window;
        config.title = configs[i].title;
        config.width_px = configs[i].width;
        config.height_px = configs[i].height;
        assert_int_equal(window_create(&config, &window), DISPLAY_BAD_ARGUMENT);
        assert_null(window);
    }
    struct window *window = window_open("wrong", 64, 64);
    Window there = on_screen("wrong");
    struct display_image image = noise(64, 64, 3), wrong = image;
    assert_int_equal(window_show(window, &image), DISPLAY_OK);
    wrong.channels = 2;
    assert_int_equal(window_show(window, &wrong), DISPLAY_BAD_ARGUMENT);
    wrong = image;
    wrong.pixels = NULL;
    assert_int_equal(window_show(window, &wrong), DISPLAY_BAD_ARGUMENT);
    wrong = image;
    wrong.width_px = 1 << 20;
    assert_int_equal(window_show(window, &wrong), DISPLAY_BAD_ARGUMENT);
    assert_non_null(strstr(display_error(), "1048576x64"));
    assert_true(screen_shows(there, &image, 5)); /* it stays */
    display_image_destroy(&image);
    window_destroy(window);
}

int main(void)
{
    const struct CMUnitTest without[] = {cmocka_unit_test(no_display_is_said)};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(images_are_shown_pixel_for_pixel),
        cmocka_unit_test(shared_pixels_are_shown_from_where_they_lie),
        cmocka_unit_test(alpha_covers_black),
        cmocka_unit_test(ratios_are_kept),
        cmocka_unit_test(shrunk_images_are_means),
        cmocka_unit_test(keys_and_closing_are_events),
        cmocka_unit_test(windows_are_apart),
        cmocka_unit_test(screens_are_not_exceeded),
        cmocka_unit_test(windows_fill_a_screen_from_the_beginning),
        cmocka_unit_test(wrong_arguments_are_refused),
    };
    int failed = cmocka_run_group_tests(without, NULL, NULL);
    if (!screen_start("800x600"))
        return failed ? failed : 77;
    failed += cmocka_run_group_tests(tests, NULL, NULL);
    screen_end();
    return failed;
}
