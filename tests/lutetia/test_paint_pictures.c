/* test_paint_pictures.c - makes the README's sheet of paper again by the command given there,
 * and compares colours: fonts differ a little between versions. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <display.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../display/scratch.h"
#include "child.h"
#include "documented.h"

enum { SQUARE = 8, INK = 24 };
#define DIFFERENCE_MOST 4.0

static const char *lutetia, *source;

static struct display_image picture(const char *path)
{
    struct display_image image;
    if (display_png_read_rgb(path, &image) != DISPLAY_OK)
        fail_msg("%s", display_error());
    return image;
}

static void square_mean(const struct display_image *image, int x, int y, double mean[3])
{
    mean[0] = mean[1] = mean[2] = 0;
    for (int row = y; row < y + SQUARE; row++)
        for (int column = x; column < x + SQUARE; column++)
            for (int c = 0; c < 3; c++)
                mean[c] +=
                    image->pixels[3 * ((size_t)row * (size_t)image->width_px + (size_t)column) +
                                  (size_t)c] /
                    ((double)SQUARE * SQUARE);
}

/* The mean difference, of 255, of squares that have ink on one of two pictures. paper: what a
 * square without ink looks like. */
static double difference(const struct display_image *then, const struct display_image *now,
                         const double paper[3])
{
    double first[3], second[3], sum = 0;
    int count = 0;
    for (int y = 0; y + SQUARE <= then->height_px; y += SQUARE)
        for (int x = 0; x + SQUARE <= then->width_px; x += SQUARE) {
            square_mean(then, x, y, first);
            square_mean(now, x, y, second);
            double ink = 0, apart = 0;
            for (int c = 0; c < 3; c++) {
                ink = fmax(ink, fmax(fabs(first[c] - paper[c]), fabs(second[c] - paper[c])));
                apart += fabs(first[c] - second[c]) / 3;
            }
            sum += ink > INK ? apart : 0;
            count += ink > INK;
        }
    assert_true(count > 100);
    return sum / count;
}

static void the_readme_shows_what_its_command_paints(void **state)
{
    (void)state;
    static struct child child;
    const char *words[CHILD_ARGUMENTS_MAX], *out = scratch_path("sheet.png");
    char path[4096];
    double paper[3];
    const int count = documented_words(
        documented_command(source, "README.md", "lutetia paint ", "-o sheet.png"), words,
        CHILD_ARGUMENTS_MAX - 1);
    child = (struct child){0};
    for (int k = 0; k < count; k++)
        child.arguments[k] = strcmp(words[k], "sheet.png") == 0 ? out : words[k];
    child.arguments[0] = lutetia;
    child_run(&child);
    if (child.status != 0)
        fail_msg("%s", child.errors);
    snprintf(path, sizeof path, "%s/docs/images/sheet.png", source);
    struct display_image then = picture(path), now = picture(out);
    assert_true(then.width_px == now.width_px && then.height_px == now.height_px);
    square_mean(&then, then.width_px / 2, 48, paper);
    const double apart = difference(&then, &now, paper);
    if (apart > DIFFERENCE_MOST)
        fail_msg("%.2f from the README's picture", apart);
    display_image_destroy(&then);
    display_image_destroy(&now);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_readme_shows_what_its_command_paints)};
    lutetia = getenv("LUTETIA");
    source = getenv("PAINT_SOURCE");
    if (!lutetia || !source)
        return 77;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
