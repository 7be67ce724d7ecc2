/* test_pictures.c - draws one list in each way: exactly, by EGL, by OSMesa and in a window. The
 * pictures agree in structural similarity and in their amounts of ink. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <exact.h>
#include <face.h>
#include <renderer.h>
#include <srgb.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "likeness.h"
#include "xvfb.h"

enum { WIDTH = 420, HEIGHT = 330 };

static struct font_face *face;
static struct font_shaper *shaper;
static struct stage_exact *exact;
static struct stage_color paper = {0.96f, 0.95f, 0.93f, 1}, ink = {0.09f, 0.09f, 0.11f, 1};
static const uint8_t paper_bytes[3] = {245, 242, 237};

static uint64_t chance_state = 11;

static double chance(double least, double most)
{
    chance_state = chance_state * 6364136223846793005u + 1442695040888963407u;
    return least + (most - least) * (double)(chance_state >> 40) / (1 << 24);
}

static void letter_add(struct stage_draw_list *list, uint32_t character, double x, double y,
                       double size, double turn, double distortion, struct stage_color color)
{
    struct stage_letter letter = {.face = face,
                                  .glyph = font_face_glyph(face, character),
                                  .size = 100,
                                  .x0 = 0,
                                  .y0 = -80,
                                  .x1 = 80,
                                  .y1 = 20};
    static const double square[4][2] = {{-.4, .5}, {.4, .5}, {.4, -.5}, {-.4, -.5}};
    struct font_point corners[4];
    for (int i = 0; i < 4; i++) {
        double px = square[i][0] * size, py = square[i][1] * size;
        corners[i].x = x + cos(turn) * px - sin(turn) * py + chance(-distortion, distortion);
        corners[i].y = y + sin(turn) * px + cos(turn) * py + chance(-distortion, distortion);
    }
    stage_draw_letter(list, &letter, corners, color);
}

/* Makes a list with some of everything, at many places between pixels: letters distorted and
 * turned (also by 90 degrees), thin and thick lines, discs, rings, boxes, translucency. */
static void scene_make(struct stage_draw_list *list)
{
    chance_state = 11;
    stage_draw_begin(list, (struct stage_view){30, 10, 320});
    for (int i = 0; i < 14; i++)
        stage_draw_line(list, i, -1, i, 11, 1, (struct stage_color){.2f, .3f, .5f, .2f});
    stage_draw_line(list, -50, 0.3, 500, 0.3, 2.3, ink);
    stage_draw_line(list, 1, 1, 9, 4.1, 0.4, ink);
    stage_draw_line(list, 1, 1.5, 9, 4.6, 6.7, (struct stage_color){.8f, .2f, .1f, .6f});
    for (int i = 0; i < 24; i++)
        letter_add(list, (uint32_t) "breakdowninsprings MQ&g"[i % 23], 1.4 + 1.55 * (i % 8),
                   9 - 2.2 * (i / 8), 1.9, i == 5 ? M_PI / 2 : chance(-.7, .7), 0.28,
                   i % 5 == 3 ? (struct stage_color){.1f, .3f, .8f, .5f} : ink);
    for (int i = 0; i < 12; i++) {
        stage_draw_disc(list, 1 + i + chance(0, .1), 1 + chance(0, .1), 1 + 0.7 * i, ink);
        stage_draw_ring(list, 1 + i, 2.6, 2 + 0.8 * i, 0.7 + 0.1 * i,
                        (struct stage_color){.1f, .5f, .2f, .8f});
    }
    stage_draw_view(list, STAGE_VIEW_PIXELS);
    stage_draw_box(list, 300.3, 250.2, 410.6, 322.1, 7, 0, (struct stage_color){1, 1, 1, .8f});
    stage_draw_box(list, 300.3, 250.2, 410.6, 322.1, 7, 1.2, ink);
    struct font_layout layout;
    assert_int_equal(font_shaper_layout(shaper, "gravity 9.81", 12, 13, NULL, &layout),
                     FONT_OK);
    stage_draw_text(list, &layout, 310, 275.25, ink);
    stage_draw_text(list, &layout, 310.5, 300, ink);
    font_layout_finish(&layout);
    assert_false(list->incomplete);
}

static struct display_image exact_picture(const struct stage_draw_list *list)
{
    struct display_image image = {WIDTH, HEIGHT, 3, NULL};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    if (stage_exact_draw(exact, list, paper, &image) != STAGE_OK)
        fail_msg("%s", stage_error());
    assert_int_equal(stage_exact_left_out(exact), 0);
    return image;
}

static void agrees(const struct display_image *image, const struct display_image *with,
                   double least)
{
    double alike = likeness(image, with);
    double weight = ink_weight(image, paper_bytes) / ink_weight(with, paper_bytes);
    if (alike < least || fabs(weight - 1) > 0.02)
        fail_msg("likeness %.4f, weight %.4f", alike, weight);
}

/* Keeps the picture's file where LUTETIA_KEEP is set. */
static void keep(const char *name, const struct display_image *image)
{
    char path[4096];
    const char *folder = getenv("LUTETIA_KEEP");
    if (!folder)
        return;
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    assert_int_equal(display_png_write(path, image), DISPLAY_OK);
}

/* The exact picture's amount of ink is the shapes' area times their cover. */
static void exact_ink_is_area_times_cover(void **state)
{
    (void)state;
    struct stage_draw_list list = {0};
    const struct stage_color black = {0, 0, 0, 1}, white = {1, 1, 1, 1};
    const struct {
        double half_length, half_width, radius, ring, area;
    } bars[] = {{60, 30, 0, 0, 120 * 60},
                {40.3, 0.4, 0, 0, 80.6 * 0.8},
                {50, 12, 12, 0, 76 * 24 + M_PI * 144},
                {33.3, 33.3, 33.3, 0, M_PI * 33.3 * 33.3},
                {20.2, 20.2, 20.2, 1.5, 2 * M_PI * 20.2 * 1.5},
                {60, 30, 0, 2, 122 * 62 - 118 * 58}};
    struct display_image image = {WIDTH, HEIGHT, 3, NULL};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    for (size_t i = 0; i < sizeof bars / sizeof *bars; i++)
        for (int turn = 0; turn < 5; turn++) {
            stage_draw_begin(&list, STAGE_VIEW_PIXELS);
            stage_draw_box(&list, 0, 0, 1, 1, 0, 0, black);
            struct stage_bar *b = &list.items[0].bar;
            *b = (struct stage_bar){200.3 + turn,        150.7,
                                    cos(0.4 * turn),     sin(0.4 * turn),
                                    bars[i].half_length, bars[i].half_width,
                                    bars[i].radius,      bars[i].ring};
            list.items[0].color.a = turn == 4 ? 0.5f : 1;
            assert_int_equal(stage_exact_draw(exact, &list, white, &image), STAGE_OK);
            double weight = ink_weight(&image, (const uint8_t[]){255, 255, 255}) / 3;
            double wanted = bars[i].area * (turn == 4 ? 0.5 : 1);
            /* Pixels at the edges are rounded to eight bits. */
            if (fabs(weight / wanted - 1) > 0.012)
                fail_msg("bar %zu, turn %d: %.1f for %.1f", i, turn, weight, wanted);
        }
    display_image_destroy(&image);
    stage_draw_finish(&list);
}

static void by_opengl(enum stage_way way, const char *name)
{
    struct stage_draw_list list = {0};
    struct stage_renderer *renderer;
    struct display_image image = {0}, again = {0};
    scene_make(&list);
    struct display_image wanted = exact_picture(&list);
    if (stage_renderer_offscreen(way, WIDTH, HEIGHT, &renderer) != STAGE_OK)
        fail_msg("%s", stage_error());
    assert_int_equal(stage_renderer_draw(renderer, &list, paper), STAGE_OK);
    assert_int_equal(stage_renderer_read(renderer, &image), STAGE_OK);
    keep("exact", &wanted);
    keep(name, &image);
    agrees(&image, &wanted, 0.98);
    /* The second picture uses kept letters and is the same. */
    assert_int_equal(stage_renderer_draw(renderer, &list, paper), STAGE_OK);
    assert_int_equal(stage_renderer_read(renderer, &again), STAGE_OK);
    assert_memory_equal(image.pixels, again.pixels, 3 * WIDTH * HEIGHT);
    stage_renderer_destroy(renderer);
    display_image_destroy(&image);
    display_image_destroy(&again);
    display_image_destroy(&wanted);
    stage_draw_finish(&list);
}

/* Images of a few sizes in boxes that begin and end between pixels, partly off the picture: the
 * same numbers as the exact picture's. */
static void images_by_opengl(enum stage_way way)
{
    enum { IMAGE_WIDTH = 37, IMAGE_HEIGHT = 23 };
    static uint8_t rgb[3 * IMAGE_WIDTH * IMAGE_HEIGHT];
    static const double boxes[][4] = {{10.3, 20.6, 150.2, 90.9},
                                      {160, 30, 160 + IMAGE_WIDTH, 30 + IMAGE_HEIGHT},
                                      {-20.4, 120.4, 60.1, WIDTH},
                                      {210.7, 70.2, 219.1, 75.6}};
    struct stage_draw_list list = {0};
    struct stage_renderer *renderer;
    struct display_image image = {0};
    for (int i = 0; i < IMAGE_WIDTH * IMAGE_HEIGHT; i++)
        for (int c = 0; c < 3; c++)
            rgb[3 * i + c] = (uint8_t)(127 + 120 * sin(0.3 * (i % IMAGE_WIDTH) + c) *
                                                 cos(0.2 * (i / IMAGE_WIDTH)));
    stage_draw_begin(&list, STAGE_VIEW_PIXELS);
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++)
        stage_draw_image(&list, rgb, i == 3 ? 20 : IMAGE_WIDTH, i == 3 ? 10 : IMAGE_HEIGHT,
                         boxes[i][0], boxes[i][1], boxes[i][2], boxes[i][3]);
    struct display_image wanted = exact_picture(&list);
    if (stage_renderer_offscreen(way, WIDTH, HEIGHT, &renderer) != STAGE_OK)
        fail_msg("%s", stage_error());
    assert_int_equal(stage_renderer_draw(renderer, &list, paper), STAGE_OK);
    assert_int_equal(stage_renderer_read(renderer, &image), STAGE_OK);
    int most = 0;
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
        const int off = abs(image.pixels[i] - wanted.pixels[i]);
        most = off > most ? off : most;
    }
    if (most > 2)
        fail_msg("%d of 255 apart", most);
    stage_renderer_destroy(renderer);
    display_image_destroy(&image);
    display_image_destroy(&wanted);
    stage_draw_finish(&list);
}

/* Of a picture with alpha, that which is seen in front of the paper. */
static void put_on_paper(struct display_image *image)
{
    struct display_image flat = {image->width_px, image->height_px, 3, NULL};
    assert_int_equal(display_image_create(&flat), DISPLAY_OK);
    for (long i = 0; i < (long)flat.width_px * flat.height_px; i++) {
        const uint8_t *from = image->pixels + 4 * i;
        for (int c = 0; c < 3; c++) {
            const double a = from[3] / 255.0,
                         light = a * srgb_light(from[c] / 255.0) +
                                 (1 - a) * srgb_light(paper_bytes[c] / 255.0);
            flat.pixels[3 * i + c] = (uint8_t)lround(255 * srgb_number(light));
        }
    }
    display_image_destroy(image);
    *image = flat;
}

/* Apart: of another size than what is shown, scaled and moved, opaque or with alpha, as the
 * exact picture of the same list; the picture that is shown stays. */
static void apart_agrees(void **state)
{
    (void)state;
    struct stage_draw_list list = {0}, scaled = {0};
    struct stage_renderer *renderer;
    struct display_image shown = {0}, again = {0}, image = {0};
    scene_make(&list);
    stage_draw_begin(&scaled, STAGE_VIEW_PIXELS);
    stage_draw_scaled(&scaled, &list, 0.5, 30, 10);
    assert_int_equal(scaled.count, list.count);
    if (stage_renderer_offscreen(STAGE_BY_EGL, WIDTH, HEIGHT, &renderer) != STAGE_OK)
        fail_msg("%s", stage_error());
    assert_int_equal(stage_renderer_draw(renderer, &list, paper), STAGE_OK);
    assert_int_equal(stage_renderer_read(renderer, &shown), STAGE_OK);
    struct display_image wanted = {WIDTH, HEIGHT, 3, NULL};
    assert_int_equal(display_image_create(&wanted), DISPLAY_OK);
    assert_int_equal(stage_exact_draw(exact, &scaled, paper, &wanted), STAGE_OK);
    for (int alpha = 0; alpha < 2; alpha++) {
        struct stage_color background = paper;
        background.a = 0.25f;
        assert_int_equal(
            stage_renderer_apart(renderer, &scaled, background, WIDTH, HEIGHT, alpha, &image),
            STAGE_OK);
        assert_int_equal(image.channels, alpha ? 4 : 3);
        if (alpha) {
            assert_int_equal(image.pixels[3], 64);
            put_on_paper(&image);
        }
        keep(alpha ? "apart-alpha" : "apart", &image);
        agrees(&image, &wanted, 0.97);
    }
    display_image_destroy(&wanted);
    assert_int_equal(stage_renderer_read(renderer, &again), STAGE_OK);
    assert_memory_equal(again.pixels, shown.pixels, 3 * WIDTH * HEIGHT);
    display_image_destroy(&shown);
    display_image_destroy(&again);
    display_image_destroy(&image);
    stage_renderer_destroy(renderer);
    stage_draw_finish(&list);
    stage_draw_finish(&scaled);
}

static void egl_agrees(void **state)
{
    (void)state;
    by_opengl(STAGE_BY_EGL, "egl");
    images_by_opengl(STAGE_BY_EGL);
}

/* OSMesa needs no display, no EGL and no graphics card. */
static void osmesa_agrees(void **state)
{
    (void)state;
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    by_opengl(STAGE_BY_OSMESA, "osmesa");
    images_by_opengl(STAGE_BY_OSMESA);
}

static void wrong_sizes_are_refused(void **state)
{
    (void)state;
    struct stage_renderer *renderer = (struct stage_renderer *)&chance_state;
    assert_int_equal(stage_renderer_offscreen(STAGE_BY_EGL, 0, 10, &renderer),
                     STAGE_BAD_ARGUMENT);
    assert_null(renderer);
    assert_non_null(strstr(stage_error(), "got 0x10"));
    stage_renderer_destroy(NULL);
    stage_exact_destroy(NULL);
    struct stage_exact *none;
    assert_int_equal(stage_exact_create("no-such-filter", &none), STAGE_BAD_ARGUMENT);
}

/* Shapes that are far out, or whose numbers are NaN, draw nothing. A folded letter is left out
 * and counted. */
static void what_cannot_be_drawn_is_left_out(void **state)
{
    (void)state;
    struct stage_draw_list list = {0};
    struct stage_letter letter = {face, font_face_glyph(face, 'a'), 100, 0, -80, 60, 20, {0}};
    stage_draw_begin(&list, STAGE_VIEW_PIXELS);
    stage_draw_line(&list, NAN, 0, 3, 3, 1, ink);
    stage_draw_disc(&list, 1e300, 0, 3, ink);
    stage_draw_letter(&list, &letter,
                      (const struct font_point[]){{0, 0}, {1, 0}, {1, INFINITY}, {0, 1}}, ink);
    assert_int_equal(list.count, 0);
    stage_draw_line(&list, -900000, 100, 900000, 100, 3, ink);
    struct display_image image = {WIDTH, HEIGHT, 3, NULL};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    assert_int_equal(stage_exact_draw(exact, &list, (struct stage_color){1, 1, 1, 1}, &image),
                     STAGE_OK);
    assert_int_equal(stage_exact_left_out(exact), 0);
    assert_true(image.pixels[3 * (100 * WIDTH)] < 80); /* a line that goes on on both sides */
    assert_true(image.pixels[3 * (100 * WIDTH + WIDTH - 1)] < 80);
    assert_int_equal(image.pixels[3 * (90 * WIDTH)], 255);
    display_image_destroy(&image);
    stage_draw_finish(&list);
}

/* Shadows and traces of earlier frames draw a list again, moved and fainter. */
static void lists_are_drawn_again(void **state)
{
    (void)state;
    struct stage_draw_list list = {0}, again = {0}, moved = {0};
    scene_make(&list);
    stage_draw_begin(&again, STAGE_VIEW_PIXELS);
    stage_draw_again(&again, &list, 0, 0, NULL, 1, false);
    struct display_image one = exact_picture(&list), two = exact_picture(&again);
    assert_memory_equal(one.pixels, two.pixels, 3 * WIDTH * HEIGHT);
    stage_draw_begin(&moved, STAGE_VIEW_PIXELS);
    stage_draw_again(&moved, &list, 5, -3, NULL, 0.5, true);
    int letters = 0;
    for (int i = 0; i < list.count; i++)
        letters += list.items[i].kind == STAGE_DRAW_GLYPH;
    assert_int_equal(moved.count, letters);
    display_image_destroy(&two);
    two = exact_picture(&moved);
    keep("moved", &two);
    /* The letter's middle, drawn again at half strength, has half as much ink. */
    double before = 1, after = 1;
    stage_draw_begin(&again, STAGE_VIEW_PIXELS);
    stage_draw_again(&again, &list, 0, 0, NULL, 1, true);
    display_image_destroy(&one);
    one = exact_picture(&again);
    before = ink_weight(&one, paper_bytes);
    after = ink_weight(&two, paper_bytes);
    assert_true(after > 0.4 * before && after < 0.6 * before);
    display_image_destroy(&one);
    display_image_destroy(&two);
    stage_draw_finish(&list);
    stage_draw_finish(&again);
    stage_draw_finish(&moved);
}

/* Letters larger than the picture are drawn within it; letters that are far too large draw
 * nothing. */
static void large_letters_agree(void **state)
{
    (void)state;
    struct stage_draw_list list = {0};
    struct stage_renderer *renderer;
    struct display_image image = {0};
    struct stage_letter letter = {face, font_face_glyph(face, 'm'), 100, 0, -80, 100, 20, {0}};
    const double far = STAGE_LETTER_MAX_PX * 1.1;
    stage_draw_begin(&list, STAGE_VIEW_PIXELS);
    stage_draw_letter(&list, &letter,
                      (const struct font_point[]){{0, 0}, {far, 0}, {far, 9}, {0, 9}}, ink);
    assert_int_equal(list.count, 0);
    stage_draw_letter(
        &list, &letter,
        (const struct font_point[]){{-700, -900}, {1100, -800}, {1000, 700}, {-600, 600}}, ink);
    assert_int_equal(list.count, 1);
    struct display_image wanted = exact_picture(&list);
    assert_int_equal(stage_renderer_offscreen(STAGE_BY_EGL, WIDTH, HEIGHT, &renderer),
                     STAGE_OK);
    assert_int_equal(stage_renderer_draw(renderer, &list, paper), STAGE_OK);
    assert_int_equal(stage_renderer_read(renderer, &image), STAGE_OK);
    assert_true(ink_weight(&wanted, paper_bytes) > 1000);
    agrees(&image, &wanted, 0.98);
    stage_renderer_destroy(renderer);
    display_image_destroy(&image);
    display_image_destroy(&wanted);
    stage_draw_finish(&list);
}

static void windows_agree(void **state)
{
    (void)state;
    struct window_config config = window_config_default();
    struct window *window;
    struct stage_renderer *renderer;
    struct stage_draw_list list = {0};
    struct display_image image = {0};
    config.title = "stage";
    config.width_px = WIDTH;
    config.height_px = HEIGHT;
    config.drawn_by_caller = true;
    if (window_create(&config, &window) != DISPLAY_OK)
        fail_msg("%s", display_error());
    if (stage_renderer_window(window, &renderer) != STAGE_OK)
        fail_msg("%s", stage_error());
    scene_make(&list);
    struct display_image wanted = exact_picture(&list);
    assert_int_equal(stage_renderer_draw(renderer, &list, paper), STAGE_OK);
    assert_int_equal(stage_renderer_read(renderer, &image), STAGE_OK);
    keep("window", &image);
    agrees(&image, &wanted, 0.98);
    /* The screen shows the same picture. */
    Window there = screen_window("stage", 10);
    assert_true(there != 0);
    assert_true(screen_shows(there, &image, 10));
    stage_renderer_destroy(renderer);
    window_destroy(window);
    display_image_destroy(&image);
    display_image_destroy(&wanted);
    stage_draw_finish(&list);
}

int main(void)
{
    const struct CMUnitTest without[] = {
        cmocka_unit_test(exact_ink_is_area_times_cover),
        cmocka_unit_test(osmesa_agrees),
        cmocka_unit_test(egl_agrees),
        cmocka_unit_test(apart_agrees),
        cmocka_unit_test(wrong_sizes_are_refused),
        cmocka_unit_test(what_cannot_be_drawn_is_left_out),
        cmocka_unit_test(lists_are_drawn_again),
        cmocka_unit_test(large_letters_agree),
    };
    const struct CMUnitTest tests[] = {cmocka_unit_test(windows_agree)};
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK ||
        font_shaper_create(face, &shaper) != FONT_OK ||
        stage_exact_create("gaussian-fast", &exact) != STAGE_OK)
        return 1;
    int failed = cmocka_run_group_tests(without, NULL, NULL);
    if (screen_start("800x600")) {
        failed += cmocka_run_group_tests(tests, NULL, NULL);
        screen_end();
    }
    stage_exact_destroy(exact);
    font_shaper_destroy(shaper);
    font_face_close(face);
    return failed;
}
