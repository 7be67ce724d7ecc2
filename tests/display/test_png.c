/* test_png.c - a PNG file is written whole or not at all, and reading it gives the same
 * picture. */
#include <display.h>

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "scratch.h"

static struct display_image image_make(int width, int height, int channels)
{
    struct display_image image = {.width_px = width, .height_px = height, .channels = channels};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    size_t bytes = (size_t)width * (size_t)height * (size_t)channels;
    uint32_t state = 1;
    for (size_t i = 0; i < bytes; i++) {
        state = state * 1664525u + 1013904223u;
        image.pixels[i] = (uint8_t)(state >> 24);
    }
    return image;
}

static void gray_comes_back(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {7, 3}, {640, 2}, {3, 511}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct display_image out = image_make(sizes[i][0], sizes[i][1], 1), in;
        const char *path = scratch_path("gray.png");
        assert_int_equal(display_png_write(path, &out), DISPLAY_OK);
        assert_int_equal(display_png_read_gray(path, &in), DISPLAY_OK);
        assert_int_equal(in.width_px, out.width_px);
        assert_int_equal(in.height_px, out.height_px);
        assert_memory_equal(in.pixels, out.pixels,
                            (size_t)out.width_px * (size_t)out.height_px);
        display_image_destroy(&out);
        display_image_destroy(&in);
    }
}

static void color_reads_as_luminance(void **state)
{
    (void)state;
    struct display_image out = image_make(3, 1, 3), in;
    static const uint8_t pixels[9] = {255, 0, 0, 0, 255, 0, 200, 200, 200};
    memcpy(out.pixels, pixels, sizeof pixels);
    assert_int_equal(display_png_write(scratch_path("color.png"), &out), DISPLAY_OK);
    assert_int_equal(display_png_read_gray(scratch_path("color.png"), &in), DISPLAY_OK);
    assert_int_equal(in.pixels[0], 54);
    assert_int_equal(in.pixels[1], 182);
    assert_int_equal(in.pixels[2], 200);
    display_image_destroy(&in);
    assert_int_equal(display_png_read_rgb(scratch_path("color.png"), &in), DISPLAY_OK);
    assert_int_equal(in.channels, 3);
    assert_memory_equal(in.pixels, pixels, sizeof pixels);
    display_image_destroy(&in);
    display_image_destroy(&out);
    out = image_make(2, 2, 1); /* gray has equal channels */
    for (int i = 0; i < 4; i++)
        out.pixels[i] = (uint8_t)(80 * i);
    assert_int_equal(display_png_write(scratch_path("color.png"), &out), DISPLAY_OK);
    assert_int_equal(display_png_read_rgb(scratch_path("color.png"), &in), DISPLAY_OK);
    for (int i = 0; i < 12; i++)
        assert_int_equal(in.pixels[i], 80 * (i / 3));
    display_image_destroy(&out);
    display_image_destroy(&in);
}

/* The memory that a picture takes is known by its header; a text has none, whatever its bytes
 * would say. */
static void memory_is_told_of_pictures_alone(void **state)
{
    (void)state;
    const char *path = scratch_path("memory.png");
    struct display_image out = image_make(64, 10, 1);
    assert_int_equal(display_png_write(path, &out), DISPLAY_OK);
    display_image_destroy(&out);
    assert_true(display_png_bytes(path, 3) >= 64 * 10 * 3 &&
                display_png_bytes(path, 3) < 64 * 100 * 3);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("this is no picture, though it has the name of one", file);
    fclose(file);
    assert_true(display_png_bytes(path, 3) == 0);
}

static void write_leaves_nothing_beside(void **state)
{
    (void)state;
    struct display_image image = image_make(64, 64, 3);
    int before = scratch_count();
    assert_int_equal(display_png_write(scratch_path("one.png"), &image), DISPLAY_OK);
    assert_int_equal(display_png_write(scratch_path("one.png"), &image), DISPLAY_OK);
    assert_int_equal(scratch_count(), before + 1);
    display_image_destroy(&image);
}

static void devices_are_refused(void **state)
{
    (void)state;
    struct display_image image = image_make(256, 256, 3);
    assert_int_equal(display_png_write("/dev/full", &image), DISPLAY_IO_FAILED);
    assert_non_null(strstr(display_error(), "/dev/full"));
    assert_non_null(strstr(display_error(), "regular file"));
    display_image_destroy(&image);
}

/* A limit on the file's size stands for a full disk. */
static void full_disk_keeps_the_old_file(void **state)
{
    (void)state;
    struct display_image small = image_make(4, 4, 1), large = image_make(400, 400, 3), in;
    const char *path = scratch_path("kept.png");
    assert_int_equal(display_png_write(path, &small), DISPLAY_OK);
    int before = scratch_count();

    struct rlimit old, limit;
    getrlimit(RLIMIT_FSIZE, &old);
    limit = old;
    limit.rlim_cur = 10000;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    enum display_status status = display_png_write(path, &large);
    setrlimit(RLIMIT_FSIZE, &old);

    assert_int_equal(status, DISPLAY_IO_FAILED);
    assert_int_equal(scratch_count(), before);
    assert_int_equal(display_png_read_gray(path, &in), DISPLAY_OK);
    assert_int_equal(in.width_px, 4);
    display_image_destroy(&small);
    display_image_destroy(&large);
    display_image_destroy(&in);
}

static void missing_places_are_named(void **state)
{
    (void)state;
    struct display_image image = image_make(4, 4, 1), in;
    assert_int_equal(display_png_write("/nowhere/at/all.png", &image), DISPLAY_IO_FAILED);
    assert_non_null(strstr(display_error(), "/nowhere/at/all.png"));
    assert_int_equal(display_png_write("/proc/lutetia.png", &image), DISPLAY_IO_FAILED);
    assert_int_equal(display_png_write("/", &image), DISPLAY_IO_FAILED);
    assert_int_equal(display_png_read_gray("/nowhere/at/all.png", &in), DISPLAY_IO_FAILED);
    assert_null(in.pixels);
    assert_int_equal(display_png_read_gray("/", &in), DISPLAY_IO_FAILED);
    display_image_destroy(&image);
}

static void empty_images_are_refused(void **state)
{
    (void)state;
    struct display_image none = {0}, odd = {.width_px = 2, .height_px = 2, .channels = 2};
    assert_int_equal(display_png_write(scratch_path("none.png"), &none), DISPLAY_BAD_ARGUMENT);
    assert_int_equal(display_image_create(&none), DISPLAY_BAD_ARGUMENT);
    assert_int_equal(display_image_create(&odd), DISPLAY_BAD_ARGUMENT);
    assert_null(odd.pixels);
}

static void sixteen_bits_are_written_in_png_order(void **state)
{
    (void)state;
    static const uint16_t pixels[6] = {0, 0x0100, 0x00ff, 0x8000, 0xfeff, 0xffff};
    const char *path = scratch_path("sixteen.png");
    assert_int_equal(display_png_write_16(path, 3, 2, 1, pixels), DISPLAY_OK);
    struct display_image image;
    assert_int_equal(display_png_read_gray(path, &image), DISPLAY_OK);
    static const uint8_t rounded[6] = {0, 1, 1, 128, 254, 255};
    for (int i = 0; i < 6; i++)
        assert_int_equal(image.pixels[i], rounded[i]);
    display_image_destroy(&image);
    assert_int_equal(display_png_write_16(path, 3, 2, 1, NULL), DISPLAY_BAD_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sixteen_bits_are_written_in_png_order),
        cmocka_unit_test(gray_comes_back),
        cmocka_unit_test(color_reads_as_luminance),
        cmocka_unit_test(memory_is_told_of_pictures_alone),
        cmocka_unit_test(write_leaves_nothing_beside),
        cmocka_unit_test(devices_are_refused),
        cmocka_unit_test(full_disk_keeps_the_old_file),
        cmocka_unit_test(missing_places_are_named),
        cmocka_unit_test(empty_images_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
