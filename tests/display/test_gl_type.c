/* test_gl_type.c - compares type drawn by OpenGL, without a window, with the painter's, pixel
 * by pixel. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../skip.h"

#include <gl_offscreen.h>
#include <gl_type.h>

enum { WIDTH = 300, HEIGHT = 120 };

static const char text[] = "Wet Fonts, (x) & \"y\"\nQuay 9: jumping";
static const double ink[3] = {0.1, 0.2, 0.55}, paper[3] = {1, 0.9, 0.6};

struct stage {
    struct font_face *face;
    struct font_shaper *shaper;
    struct font_layout layout;
    struct gl_offscreen *screen;
    struct gl_type *type;
};

#define assert_display(call)                                                                   \
    do {                                                                                       \
        if ((call) != DISPLAY_OK)                                                              \
            fail_msg("%s: %s", #call, display_error());                                        \
    } while (0)

static void stage_open(struct stage *s, double size_px, const struct font_atlas_def *atlas)
{
    struct gl_type_def def = gl_type_def_default();
    def.function = gl_offscreen_function;
    if (atlas)
        def.atlas = *atlas;
    *s = (struct stage){0};
    assert_int_equal(font_face_open("DejaVuSans", 0, &s->face), FONT_OK);
    assert_int_equal(font_shaper_create(s->face, &s->shaper), FONT_OK);
    assert_int_equal(
        font_shaper_layout(s->shaper, text, strlen(text), size_px, NULL, &s->layout), FONT_OK);
    assert_display(gl_offscreen_create(WIDTH, HEIGHT, &s->screen));
    assert_display(gl_type_create(&def, &s->type));
    gl_offscreen_clear(s->screen, paper);
}

static void stage_close(struct stage *s)
{
    gl_type_destroy(s->type);
    gl_offscreen_destroy(s->screen);
    font_layout_finish(&s->layout);
    font_shaper_destroy(s->shaper);
    font_face_close(s->face);
}

/* The painter's picture of the text, with as many places between pixels. */
static struct display_image painted(const struct stage *s, const struct font_map *map, double x,
                                    double y, int places)
{
    struct display_image image = {.width_px = WIDTH, .height_px = HEIGHT, .channels = 3};
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    assert_display(display_image_create(&image));
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        image.pixels[i] = (uint8_t)(255 * paper[i % 3] + 0.5);
    memcpy(def.ink, ink, sizeof ink);
    def.places = places;
    assert_int_equal(font_painter_create(&def, &painter), FONT_OK);
    struct font_picture picture = {
        .rgb = image.pixels, .width_px = WIDTH, .height_px = HEIGHT, .pitch = 3 * WIDTH};
    assert_int_equal(font_painter_layout(painter, &s->layout, map, x, y, &picture), FONT_OK);
    font_painter_destroy(painter);
    return image;
}

/* Compares the pictures. Both mix light, so a byte may differ by rounding. Returns how many
 * pixels have ink. */
static int compare(const struct stage *s, struct display_image *wanted)
{
    struct display_image drawn;
    int inked = 0;
    assert_display(gl_offscreen_read(s->screen, &drawn));
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++) {
        int difference = abs(drawn.pixels[i] - wanted->pixels[i]);
        if (difference > 2)
            fail_msg("column %d, row %d, channel %d: %d, the painter has %d", i / 3 % WIDTH,
                     i / 3 / WIDTH, i % 3, drawn.pixels[i], wanted->pixels[i]);
        inked += i % 3 == 0 && wanted->pixels[i] < 200;
    }
    display_image_destroy(&drawn);
    display_image_destroy(wanted);
    return inked;
}

static void text_is_as_painted(void **state)
{
    (void)state;
    struct stage s;
    struct font_atlas_def atlas = font_atlas_def_default();
    atlas.places_x = atlas.places_y = 4;
    stage_open(&s, 21.5, &atlas);
    /* The second frame uses the first one's glyphs. */
    for (int frame = 0; frame < 2; frame++) {
        gl_offscreen_clear(s.screen, paper);
        gl_type_begin(s.type, WIDTH, HEIGHT);
        assert_display(gl_type_draw(s.type, &s.layout, NULL, 10.3, 40.6, ink));
    }
    struct font_atlas_stats stats;
    font_atlas_stats_get(gl_type_atlas(s.type), &stats);
    assert_true(stats.drawn > 10 && stats.hits >= stats.drawn);
    struct display_image wanted = painted(&s, NULL, 10.3, 40.6, 4);
    assert_true(compare(&s, &wanted) > 1000);
    stage_close(&s);
}

/* Text that is turned and partly beyond the picture's edges. */
static void text_turns(void **state)
{
    (void)state;
    struct stage s;
    struct font_atlas_def atlas = font_atlas_def_default();
    atlas.places_x = atlas.places_y = 8;
    stage_open(&s, 30, &atlas);
    struct font_map map = {.kind = FONT_AFFINE, .m = {0.94, 0.34, 0, -0.34, 0.94, 0, 0, 0, 1}};
    gl_type_begin(s.type, WIDTH, HEIGHT);
    assert_display(gl_type_draw(s.type, &s.layout, &map, -12.2, 80.1, ink));
    struct display_image wanted = painted(&s, &map, -12.2, 80.1, 8);
    assert_true(compare(&s, &wanted) > 1000);
    stage_close(&s);
}

/* Pictures between letters, whole and turned, and half of one. */
static void pictures_are_as_painted(void **state)
{
    (void)state;
    static const char frogs[] = "Wet \xf0\x9f\x90\xb8\xf0\x9f\x92\xa7 type";
    struct stage s;
    struct font_atlas_def atlas = font_atlas_def_default();
    atlas.places_x = atlas.places_y = 8;
    stage_open(&s, 30, &atlas);
    font_layout_finish(&s.layout);
    font_shaper_colour(s.shaper);
    assert_int_equal(font_shaper_layout(s.shaper, frogs, strlen(frogs), 40, NULL, &s.layout),
                     FONT_OK);
    if (s.layout.missing_count) {
        stage_close(&s);
        skip_because("there is no font of pictures in colours (fonts-noto-color-emoji)");
    }
    const struct font_ink half = font_ink_plain(0.2, 0.4, 0, 0.5);
    s.layout.glyphs[5].ink = font_layout_ink_add(&s.layout, &half);
    struct font_map maps[] = {font_map_rotation(0), font_map_rotation(20)};
    for (int m = 0; m < 2; m++) {
        gl_offscreen_clear(s.screen, paper);
        gl_type_begin(s.type, WIDTH, HEIGHT);
        assert_display(gl_type_draw(s.type, &s.layout, &maps[m], 20.3, 90.6, ink));
        struct display_image wanted = painted(&s, &maps[m], 20.3, 90.6, 8);
        assert_true(compare(&s, &wanted) > 1000);
    }
    stage_close(&s);
}

/* Each glyph has its own map, of every kind, and translucent ink; then the whole text is
 * turned. */
static void glyphs_have_maps_and_inks(void **state)
{
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        struct stage s;
        struct font_atlas_def atlas = font_atlas_def_default();
        atlas.places_x = atlas.places_y = 16;
        stage_open(&s, 34, &atlas);
        static const enum font_map_kind kinds[] = {FONT_PROJECTIVE, FONT_BILINEAR, FONT_SMOOTH};
        for (int i = 0; i < s.layout.glyphs_count; i++) {
            double a = (i * 37 % 11 - 5) * 0.9, b = (i * 53 % 13 - 6) * 0.9;
            const struct font_point to[4] = {
                {a, -30 + b}, {24 - b, -32 + a}, {25 + a, 4 - b}, {-2 + b, 3 + a}};
            struct font_map map = font_map_rotation(i * 17);
            if (i % 4)
                assert_int_equal(font_map_corners(kinds[i % 4 - 1], 0, -30, 24, 4, to, &map),
                                 FONT_OK);
            const struct font_ink own =
                font_ink_plain(i % 3 / 2.0, i % 5 / 4.0, i % 7 / 6.0, 0.3 + i % 2 * 0.5);
            s.layout.glyphs[i].map = i % 6 ? font_layout_map_add(&s.layout, &map) : 0;
            s.layout.glyphs[i].ink = i % 5 ? font_layout_ink_add(&s.layout, &own) : 0;
            s.layout.glyphs[i].size_px = i % 3 ? 0 : 27.5f;
        }
        struct font_map all = font_map_rotation(9);
        gl_type_begin(s.type, WIDTH, HEIGHT);
        assert_display(gl_type_draw(s.type, &s.layout, turned ? &all : NULL, 8, 50, ink));
        /* Distorted glyphs are drawn at their exact places, so the painter may round only the
         * whole text's translation. */
        struct display_image wanted = painted(&s, turned ? &all : NULL, 8, 50, 16);
        assert_true(compare(&s, &wanted) > 1000);
        stage_close(&s);
    }
}

/* Gradients and pictures as ink, translucent, mixed as light and as numbers, side by side with
 * plain ones; then turned. */
static void inks_are_as_painted(void **state)
{
    (void)state;
    enum { INKS = 8 };
    static uint8_t tile[7 * 32];
    for (int i = 0; i < (int)sizeof tile; i++)
        tile[i] = (uint8_t)(i * 97 % 251);
    const struct font_ink_stop stops[] = {{0.1, {0.9, 0.1, 0, 1}},
                                          {0.5, {0, 0.6, 0.2, 0.3}},
                                          {0.5, {0, 0, 1, 0.9}},
                                          {0.8, {1, 1, 0, 1}}};
    struct font_ink inks[INKS] = {
        {.kind = FONT_INK_LINEAR,
         .x0 = 10.3,
         .y0 = -20,
         .x1 = 61.7,
         .y1 = 7.1,
         .stops_count = 4},
        {.kind = FONT_INK_RADIAL, .x0 = 90.2, .y0 = 5.4, .x1 = 71.3, .stops_count = 4},
        {.kind = FONT_INK_PICTURE,
         .x0 = -3,
         .y0 = 2,
         .width_px = 9,
         .height_px = 7,
         .pitch = 32},
        {.kind = FONT_INK_LINEAR, .x1 = 0, .stops_count = 2},
        {.kind = FONT_INK_RADIAL, .x0 = 50, .x1 = 0, .stops_count = 3},
        {.kind = FONT_INK_LINEAR, .x1 = 200, .y1 = 30, .stops_count = 3, .numbers = true},
        {.kind = FONT_INK_PICTURE, .width_px = 8, .height_px = 4, .pitch = 24, .numbers = true},
        {.rgba = {0.8, 0.2, 0.1, 0.4}, .numbers = true},
    };
    for (int k = 0; k < INKS; k++) {
        memcpy(inks[k].stops, stops, sizeof stops);
        inks[k].rgb = inks[k].kind == FONT_INK_PICTURE ? tile : NULL;
        if (inks[k].rgb)
            inks[k].rgba[3] = 0.7;
    }
    for (int turned = 0; turned < 2; turned++) {
        struct stage s;
        struct font_atlas_def atlas = font_atlas_def_default();
        atlas.places_x = atlas.places_y = 16;
        stage_open(&s, 34, &atlas);
        for (int k = 0; k < INKS; k++)
            assert_int_equal(font_layout_ink_add(&s.layout, &inks[k]), k + 1);
        for (int i = 0; i < s.layout.glyphs_count; i++)
            s.layout.glyphs[i].ink = i / 2 % (INKS + 1);
        struct font_map all = font_map_rotation(9);
        gl_type_begin(s.type, WIDTH, HEIGHT);
        assert_display(gl_type_draw(s.type, &s.layout, turned ? &all : NULL, 8, 50, ink));
        struct display_image wanted = painted(&s, turned ? &all : NULL, 8, 50, 16);
        assert_true(compare(&s, &wanted) > 1000);
        stage_close(&s);
    }
}

/* The atlas's one page cannot hold all glyphs: drawn glyphs make room for others. */
static void small_atlases_do(void **state)
{
    (void)state;
    struct stage s;
    struct font_atlas_def atlas = font_atlas_def_default();
    atlas.places_x = atlas.places_y = 4;
    atlas.width_px = atlas.height_px = 64;
    atlas.pages_max = 1;
    stage_open(&s, 28, &atlas);
    gl_type_begin(s.type, WIDTH, HEIGHT);
    for (int i = 0; i < 4; i++) { /* the second finds it full */
        gl_offscreen_clear(s.screen, paper);
        assert_display(gl_type_draw(s.type, &s.layout, NULL, 5, 40, ink));
    }
    struct font_atlas_stats stats;
    font_atlas_stats_get(gl_type_atlas(s.type), &stats);
    assert_true(stats.shelves_emptied > 0);
    struct display_image wanted = painted(&s, NULL, 5, 40, 4);
    assert_true(compare(&s, &wanted) > 1000);
    stage_close(&s);
}

static void what_cannot_be_is_said(void **state)
{
    (void)state;
    struct stage s;
    struct font_atlas_def atlas = font_atlas_def_default();
    struct gl_offscreen *none;
    struct gl_type *no_type;
    atlas.width_px = atlas.height_px = 64;
    stage_open(&s, 200, &atlas);
    gl_type_begin(s.type, WIDTH, HEIGHT);
    assert_int_equal(gl_type_draw(s.type, &s.layout, NULL, 5, 40, ink), DISPLAY_BAD_ARGUMENT);
    assert_true(strlen(display_error()) > 0);
    struct font_map bent = {.kind = FONT_PROJECTIVE, .m = {1, 0, 0, 0, 1, 0, 1e-3, 0, 1}};
    assert_int_equal(gl_type_draw(s.type, &s.layout, &bent, 5, 40, ink), DISPLAY_BAD_ARGUMENT);
    stage_close(&s);
    assert_int_equal(gl_offscreen_create(0, 10, &none), DISPLAY_BAD_ARGUMENT);
    assert_int_equal(gl_offscreen_create(10, 100000, &none), DISPLAY_BAD_ARGUMENT);
    assert_null(none);
    struct gl_type_def def = gl_type_def_default();
    assert_int_equal(gl_type_create(&def, &no_type), DISPLAY_NO_WINDOW);
    assert_null(no_type);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_as_painted),      cmocka_unit_test(text_turns),
        cmocka_unit_test(pictures_are_as_painted), cmocka_unit_test(glyphs_have_maps_and_inks),
        cmocka_unit_test(inks_are_as_painted),     cmocka_unit_test(small_atlases_do),
        cmocka_unit_test(what_cannot_be_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
