/* test_display.c - the thesis's listings joined to a display: type is screened on paper, water
 * and ink flow, and after each step the page's colour goes to the frame buffer. What is seen
 * there is what the fields say.
 *
 * With LUTETIA_DISPLAY set (`lutetia display test_listings_display`) it paints for who looks
 * on, and checks nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include <display_recording.h>

#include "../display/scratch.h"
#include "page.h"
#include <cm/cmfb.h>

enum { WIDTH = 120, HEIGHT = 64, STEPS = 12 };

int disperse_pigment_and_water(struct FiberStruct *page);
int Read_image_from_disk_and_screen_ink_on_paper(struct FiberStruct *Page, char *filename,
                                                 int width, int height, int x_off, int y_off,
                                                 double cyan, double magenta, double yellow,
                                                 double water);

/* Draws two letters, W and F, of bars. */
static void letters_draw(uint8_t *gray)
{
    static const int bars[][4] = {/* x at the top, x at the bottom, y from, y to */
                                  {8, 16, 8, 56},
                                  {24, 16, 8, 56},
                                  {24, 32, 8, 56},
                                  {40, 32, 8, 56},
                                  {64, 64, 8, 56}};
    memset(gray, 0, WIDTH * HEIGHT);
    for (size_t b = 0; b < sizeof bars / sizeof *bars; b++)
        for (int y = bars[b][2]; y < bars[b][3]; y++)
            for (int k = 0; k < 6; k++)
                gray[y * WIDTH + k + bars[b][0] +
                     (bars[b][1] - bars[b][0]) * (y - bars[b][2]) / 48] = 255;
    for (int k = 64; k < 100; k++)
        for (int y = 0; y < 6; y++) {
            gray[(8 + y) * WIDTH + k] = 255;
            gray[(28 + y) * WIDTH + (k < 90 ? k : 64)] = 255;
        }
}

/* channel = 255 (1 - ink), rounded: white paper. */
static void channel_make(struct FiberStruct *page, CM_field_id_t channel, CM_field_id_t ink)
{
    CM_f_move_constant_1L(page->temp1, 1.0, 23, 8);
    CM_f_subtract_2_1L(page->temp1, ink, 23, 8);
    CM_f_multiply_constant_2_1L(page->temp1, 255.0, 23, 8);
    CM_u_f_round_2_2L(channel, page->temp1, CHANNEL_SIZE, 23, 8);
}

static void page_show(struct FiberStruct *page, CMFB_display_id_t display)
{
    CM_set_context();
    channel_make(page, page->image_field, page->cyan);
    channel_make(page, page->image_field + 8, page->magenta);
    channel_make(page, page->image_field + 16, page->yellow);
    CMFB_write_news_always(display, 0, page->image_field, 0, 0);
}

static void page_begin(struct FiberStruct *page, const char *letters)
{
    static unsigned int words[WIDTH * HEIGHT];
    static uint8_t gray[WIDTH * HEIGHT];
    char path[512];
    letters_draw(gray);
    FILE *file = fopen(letters, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(gray, 1, sizeof gray, file), sizeof gray);
    assert_int_equal(fclose(file), 0);
    page_create(page, WIDTH, HEIGHT);
    CM_set_context();
    CM_f_move_constant_1L(page->absorbency, 0.45, 23, 8);
    memset(words, 0, sizeof words);
    for (enum page_field f = PAGE_WATER; f <= PAGE_YELLOW; f++)
        if (f != PAGE_ABSORBENCY)
            page_write(page, f, words);
    snprintf(path, sizeof path, "%s", letters);
    Read_image_from_disk_and_screen_ink_on_paper(page, path, WIDTH, HEIGHT, 0, 0, 0.9, 0.45,
                                                 0.1, 1.0);
}

static float float_of(unsigned int word)
{
    float x;
    memcpy(&x, &word, sizeof x);
    return x;
}

static int change_take(void *context, const struct display_change *change)
{
    *(int *)context += change->seen;
    return 1;
}

static void recording_read(const char *path, struct display_reader *reader)
{
    static uint8_t bytes[1 << 16];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    for (size_t count; (count = fread(bytes, 1, sizeof bytes, file)) > 0;)
        assert_int_equal(display_reader_feed(reader, bytes, count), DISPLAY_OK);
    fclose(file);
    assert_int_equal(display_reader_end(reader), DISPLAY_OK);
}

static void listings_paint_on_a_display(void **state)
{
    (void)state;
    static unsigned int inks[3][WIDTH * HEIGHT];
    struct FiberStruct page;
    const bool looked_at = getenv("LUTETIA_DISPLAY") != NULL;
    const char *recording = scratch_path("display");
    if (!looked_at)
        setenv("LUTETIA_DISPLAY", recording, 1);
    page_begin(&page, scratch_path("letters"));
    CMFB_display_id_t display = CMFB_attach_display("wet type");
    CMFB_initialize_display(display, 24, WIDTH, HEIGHT);
    for (int step = 0; step < STEPS; step++) {
        page_show(&page, display);
        disperse_pigment_and_water(&page);
    }
    page_show(&page, display);
    if (looked_at)
        return;
    int pictures = 0;
    struct display_reader reader = {.take = change_take, .context = &pictures};
    struct display_image image = {0};
    recording_read(recording, &reader);
    assert_int_equal(pictures, STEPS + 1);
    assert_int_equal(display_screen_picture(&reader.screens[0], &image), DISPLAY_OK);
    for (int c = 0; c < 3; c++)
        page_read(&page, PAGE_CYAN + (enum page_field)c, inks[c]);
    int tinted = 0;
    for (int k = 0; k < WIDTH * HEIGHT; k++)
        for (int c = 0; c < 3; c++) {
            const float light = (1.0f - float_of(inks[c][k])) * 255.0f;
            assert_in_range(image.pixels[3 * k + c], (int)(light - 0.51f),
                            (int)(light + 0.51f));
            tinted += image.pixels[3 * k + c] < 250 && image.pixels[3 * k + c] > 40;
        }
    assert_in_range(tinted, 500, 3 * WIDTH * HEIGHT - 500); /* letters, and paper */
    display_image_destroy(&image);
    display_reader_finish(&reader);
    page_destroy(&page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(listings_paint_on_a_display)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
