/* test_screens.c - windows on several screens: over some of them, and the same picture on
 * others, on an Xorg with the dummy driver, which has as many as one likes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <window.h>

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "xorg.h"

static const char config_text[] = "Section \"Device\"\n Identifier \"d\"\n Driver \"dummy\"\n"
                                  " VideoRam 65536\nEndSection\n"
                                  "Section \"Monitor\"\n Identifier \"m\"\n"
                                  " HorizSync 5-1000\n VertRefresh 5-200\nEndSection\n"
                                  "Section \"Screen\"\n Identifier \"s\"\n Device \"d\"\n"
                                  " Monitor \"m\"\n DefaultDepth 24\n SubSection \"Display\"\n"
                                  "  Depth 24\n  Virtual 2080 600\n EndSubSection\n"
                                  "EndSection\n";

/* The screens: from left to right. */
static const struct {
    int x, width, height;
} places[] = {{0, 640, 480}, {640, 800, 600}, {1440, 640, 480}};

static char folder[] = "/tmp/lutetia-screens-XXXXXX";
static Display *display;

/* False: there is no such server here. */
static bool server_start(void)
{
    char path[80];
    if (!mkdtemp(folder))
        return false;
    snprintf(path, sizeof path, "%s/conf", folder);
    FILE *file = fopen(path, "w");
    if (!file)
        return false;
    fputs(config_text, file);
    fclose(file);
    if (!xorg_start(folder))
        return false;
    display = xorg_display();
    return system("exec 2>/dev/null; xrandr --addmode DUMMY1 800x600 && "
                  "xrandr --addmode DUMMY2 640x480 && "
                  "xrandr --output DUMMY0 --mode 640x480 --pos 0x0 "
                  "--output DUMMY1 --mode 800x600 --pos 640x0 "
                  "--output DUMMY2 --mode 640x480 --pos 1440x0 && "
                  "xrandr >/dev/null") == 0; /* at last it is looked who is there */
}

/* A picture whose pixels tell where they are. */
static struct display_image picture_make(int width, int height)
{
    struct display_image image = {width, height, 3, NULL};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            uint8_t *p = image.pixels + 3 * ((size_t)y * (size_t)width + (size_t)x);
            p[0] = (uint8_t)(x * 255 / width);
            p[1] = (uint8_t)(y * 255 / height);
            p[2] = (uint8_t)(x + y < 100 ? 255 : 40);
        }
    return image;
}

/* How many pixels of a screen's rectangle are not the picture's, scaled to that rectangle, or,
 * around it, black. off: how far a number may be off. */
static long wrong_pixels(int x0, int width, int height, const struct display_image *image,
                         int off)
{
    XImage *seen = XGetImage(display, DefaultRootWindow(display), x0, 0, (unsigned)width,
                             (unsigned)height, AllPlanes, ZPixmap);
    assert_non_null(seen);
    const double scale = (double)width / image->width_px < (double)height / image->height_px
                             ? (double)width / image->width_px
                             : (double)height / image->height_px;
    const int left = (int)((width - scale * image->width_px) / 2),
              top = (int)((height - scale * image->height_px) / 2);
    long wrong = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const unsigned long is = XGetPixel(seen, x, y);
            const int u = (int)((x - left + 0.5) / scale), v = (int)((y - top + 0.5) / scale);
            const bool inside =
                x >= left && y >= top && u < image->width_px && v < image->height_px;
            const uint8_t *p =
                image->pixels + 3 * ((size_t)v * (size_t)image->width_px + (size_t)u);
            for (int c = 0; c < 3; c++) {
                const int want = inside ? p[c] : 0, got = (int)(is >> (16 - 8 * c) & 255);
                wrong += got > want + off || got < want - off;
            }
        }
    XDestroyImage(seen);
    return wrong;
}

/* Shows the picture until the rectangle has it. */
static void shows(struct window *window, const struct display_image *image, int x0, int width,
                  int height, int off, long allowed)
{
    long wrong = -1;
    for (int i = 0; i < 100; i++) {
        struct input_event event;
        assert_int_equal(window_show(window, image), DISPLAY_OK);
        window_input_take(window, 0.02, &event);
        XSync(display, False);
        wrong = wrong_pixels(x0, width, height, image, off);
        if (wrong <= allowed)
            return;
    }
    fail_msg("at %d: %ld numbers of %d pixels are wrong", x0, wrong, width * height);
}

static struct window *window_on(const char *screen)
{
    struct window_config config = window_config_default();
    struct window *window;
    config.title = "screens";
    config.screen = screen;
    if (window_create(&config, &window) != DISPLAY_OK)
        fail_msg("%s: %s", screen, display_error());
    return window;
}

static void window_fills_each(void **unused)
{
    (void)unused;
    static const char *const names[] = {"1", "2", "3"};
    for (int i = 0; i < 3; i++) {
        struct display_image image = picture_make(places[i].width, places[i].height);
        struct window *window = window_on(names[i]);
        shows(window, &image, places[i].x, places[i].width, places[i].height, 0, 0);
        window_destroy(window);
        display_image_destroy(&image);
    }
}

static void window_lies_over_some(void **unused)
{
    (void)unused;
    static const struct {
        const char *screens;
        int x, width;
    } rows[] = {{"1,2", 0, 1440}, {"2,3", 640, 1440}, {"3,1", 0, 2080}, {"all", 0, 2080}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const int height = strcmp(rows[i].screens, "3,1") == 0 ? 480 : 600;
        struct display_image image = picture_make(rows[i].width, height);
        struct window *window = window_on(rows[i].screens);
        shows(window, &image, rows[i].x, rows[i].width, height, 0, 0);
        window_destroy(window);
        display_image_destroy(&image);
    }
}

/* The same, on one of the same size to the bit, on another in its middle. */
static void several_show_the_same(void **unused)
{
    (void)unused;
    struct display_image image = picture_make(640, 480), other = picture_make(320, 200);
    struct window *window = window_on("1=3=2");
    shows(window, &image, places[0].x, 640, 480, 0, 0);
    shows(window, &image, places[2].x, 640, 480, 0, 0);
    /* what is larger is between its pixels: the steep edge of the third channel may be off */
    shows(window, &image, places[1].x, 800, 600, 3, 1500);
    assert_true(wrong_pixels(places[1].x, 800, 600, &other, 3) > 10000);
    window_destroy(window);
    window = window_on("1,2=3"); /* wider than high: it has black above and below */
    struct display_image wide = picture_make(1440, 600);
    shows(window, &wide, 0, 1440, 600, 0, 0);
    shows(window, &wide, places[2].x, 640, 480, 6, 9000);
    window_destroy(window);
    display_image_destroy(&wide);
    display_image_destroy(&image);
    display_image_destroy(&other);
}

static void other_words_are_refused(void **unused)
{
    (void)unused;
    static const char *const wrong[] = {"0",   "4",     "1,", ",1",    "1,1",
                                        "1=1", "1=",    "=2", "1=2,3", "1=4",
                                        "1 2", "all,1", "+1", "1,-2",  "1==2"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct window_config config = window_config_default();
        struct window *window;
        config.screen = wrong[i];
        assert_int_equal(window_create(&config, &window), DISPLAY_BAD_ARGUMENT);
        assert_non_null(strstr(display_error(), "2 (DUMMY1, 800x600 at 640,0)"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(window_fills_each),
        cmocka_unit_test(window_lies_over_some),
        cmocka_unit_test(several_show_the_same),
        cmocka_unit_test(other_words_are_refused),
    };
    if (!server_start()) {
        xorg_end(folder);
        puts("[  SKIPPED ] screens: no Xorg with the dummy driver and xrandr");
        return 77;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    xorg_end(folder);
    return failed;
}
