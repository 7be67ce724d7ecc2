/* test_type.c - the thesis's display of type, unchanged, gives the oracle's bits. It screens
 * inks and water by a gray image from a file, at two places, and clamps the amounts where both
 * overlap. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "oracle.h"
#include "page.h"

enum { IMAGE_WIDTH = 37, IMAGE_HEIGHT = 23 };

/* listing_type.c defines it in K&R style, so its floats are passed as doubles. */
int Read_image_from_disk_and_screen_ink_on_paper(struct FiberStruct *Page, char *filename,
                                                 int width, int height, int x_off, int y_off,
                                                 double cyan, double magenta, double yellow,
                                                 double water);

/* Draws a soft ring, so that every gray occurs. */
static void draw(uint8_t *gray)
{
    for (int y = 0; y < IMAGE_HEIGHT; y++)
        for (int x = 0; x < IMAGE_WIDTH; x++) {
            int dx = 2 * x - IMAGE_WIDTH, dy = 3 * y - IMAGE_HEIGHT * 3 / 2;
            int ring = abs(dx * dx + dy * dy - 700) / 3;

            gray[y * IMAGE_WIDTH + x] = (uint8_t)(ring > 255 ? 0 : 255 - ring);
        }
}

static void screen(int width, int height)
{
    static const struct {
        int x, y;
        double cyan, magenta, yellow, water;
    } places[] = {
        {3, 5, 0.9, 0.1, 0.0, 0.5}, {20, 14, 0.3, 0.8, -0.2, 0.75}, {0, 0, 0.0, 0.0, 1.0, 1.0}};
    char path[] = "/tmp/test_type_XXXXXX";
    uint8_t gray[IMAGE_WIDTH * IMAGE_HEIGHT];
    struct FiberStruct page;
    struct oracle o;
    int file = mkstemp(path);

    assert_true(file >= 0);
    draw(gray);
    assert_int_equal(write(file, gray, sizeof gray), sizeof gray);
    close(file);

    oracle_init(&o, width, height);
    page_create(&page, width, height);
    for (size_t k = 0; k < sizeof places / sizeof places[0]; k++) {
        Read_image_from_disk_and_screen_ink_on_paper(
            &page, path, IMAGE_WIDTH, IMAGE_HEIGHT, places[k].x, places[k].y, places[k].cyan,
            places[k].magenta, places[k].yellow, places[k].water);
        oracle_screen(&o, gray, IMAGE_WIDTH, IMAGE_HEIGHT, places[k].x, places[k].y,
                      (float)places[k].cyan, (float)places[k].magenta, (float)places[k].yellow,
                      (float)places[k].water);
        if (k % 2 == 0)
            page_compare(&page, &o, (int)k);
    }
    page_destroy(&page);
    oracle_finish(&o);
    unlink(path);
}

static void type_square_sheet_agrees(void **state)
{
    (void)state;
    screen(64, 64);
}

static void type_odd_sheet_agrees(void **state)
{
    (void)state;
    screen(131, 97);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(type_square_sheet_agrees),
        cmocka_unit_test(type_odd_sheet_agrees),
    };

    CM_init();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
