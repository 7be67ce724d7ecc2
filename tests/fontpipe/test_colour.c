/* test_colour.c - glyphs with their own colours: pictures (Noto Color Emoji, where it is
 * installed) and layers (a font made here), beside glyphs without. */
#include "../skip.h"
#include "pdf_unpack.h"
#include "support.h"

#include <drawing.h>
#include <edges.h>
#include <paint.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 160 };

static uint8_t page[2][SIDE * SIDE * 3];

static struct font_picture picture_of(int k)
{
    memset(page[k], 255, sizeof page[k]);
    return (struct font_picture){
        .rgb = page[k], .width_px = SIDE, .height_px = SIDE, .pitch = 3 * SIDE};
}

static struct font_painter *painter_make(void)
{
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    assert_font(font_painter_create(&def, &painter));
    return painter;
}

static const char frog[] = "\xf0\x9f\x90\xb8";

/* How much of the page is painted, and how green the paint is. */
static double painted(const uint8_t *rgb, double *green)
{
    double sum = 0;
    *green = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const uint8_t *p = rgb + 3 * i;
        sum += p[0] != 255 || p[1] != 255 || p[2] != 255;
        *green += (p[1] - 0.5 * (p[0] + p[2])) / 255;
    }
    return sum;
}

/* Lays out a frog, whose picture is in a fallback font. Skips the test where no such font is
 * installed. */
static void frog_lay(struct font_face *face, struct font_shaper **s, double size_px,
                     struct font_layout *l)
{
    *s = shaper_make(face);
    font_shaper_colour(*s);
    assert_font(font_shaper_layout(*s, frog, strlen(frog), size_px, NULL, l));
    if (l->missing_count) {
        font_layout_finish(l);
        font_shaper_destroy(*s);
        font_face_close(face);
        skip_because("there is no font of pictures in colours (fonts-noto-color-emoji)");
    }
}

static void pictures_are_drawn_in_their_colours(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *s;
    struct font_painter *painter = painter_make();
    double areas[2], greens[2];
    for (int k = 0; k < 2; k++) {
        struct font_layout l;
        struct font_box box;
        struct font_picture to = picture_of(k);
        frog_lay(face, &s, k ? 80 : 40, &l);
        assert_font(font_painter_layout(painter, &l, NULL, 20, 110, &to));
        assert_font(font_painter_measure(painter, &l, NULL, 20, 110, &box));
        for (int i = 0; i < SIDE * SIDE; i++)
            if (page[k][3 * i + 2] != 255)
                assert_true(i % SIDE + 1 > box.x0 && i % SIDE < box.x1 &&
                            i / SIDE + 1 > box.y0 && i / SIDE < box.y1);
        areas[k] = painted(page[k], &greens[k]);
        font_layout_finish(&l);
        font_shaper_destroy(s);
    }
    assert_true(areas[0] > 500 && fabs(areas[1] / areas[0] - 4) < 0.4);
    assert_true(greens[0] > 200 && fabs(greens[1] / greens[0] - 4) < 0.1);
    font_painter_destroy(painter);
    font_face_close(face);
}

/* A quarter turn of the text turns the picture pixel for pixel. */
static void pictures_are_turned_with_the_text(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *s;
    struct font_painter *painter = painter_make();
    struct font_layout l;
    struct font_map turned = font_map_rotation(90);
    frog_lay(face, &s, 60, &l);
    struct font_picture to = picture_of(0);
    assert_font(font_painter_layout(painter, &l, NULL, 40, 120, &to));
    to = picture_of(1);
    assert_font(font_painter_layout(painter, &l, &turned, 120, SIDE - 40, &to));
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            for (int c = 0; c < 3; c++) {
                int upright = page[0][3 * (y * SIDE + x) + c];
                int lies = page[1][3 * ((SIDE - 1 - x) * SIDE + y) + c];
                assert_true(abs(upright - lies) <= 2);
            }
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_painter_destroy(painter);
    font_face_close(face);
}

static void pictures_are_refused_where_nothing_draws_them(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans"), *pictures;
    struct font_shaper *s = shaper_make(face);
    struct font_layout l;
    assert_font(font_shaper_layout(s, frog, strlen(frog), 40, NULL, &l));
    char *path = font_face_find("NotoColorEmoji", NULL);
    if (path)
        assert_int_equal(font_face_open(path, 0, &pictures), FONT_BAD_FILE);
    free(path);
    for (int i = 0; i < l.glyphs_count; i++) {
        struct font_outline o;
        assert_font(font_face_outline(l.glyphs[i].face, l.glyphs[i].glyph, &o));
        font_outline_finish(&o);
    }
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(face);
}

/* ---- a font with layers ---- */

static uint8_t *put(uint8_t *at, uint32_t value, int bytes)
{
    for (int k = bytes - 1; k >= 0; k--)
        *at++ = (uint8_t)(value >> (8 * k));
    return at;
}

static uint32_t get32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Adds the tables COLR and CPAL to a font: glyph `base` gets the layers `below`, in a half
 * transparent red, and `above`, in the text's ink. */
static uint8_t *layered_make(const uint8_t *from, size_t count, uint32_t base, uint32_t below,
                             uint32_t above, size_t *made_count)
{
    enum { COLR = 14 + 6 + 8, CPAL = 14 + 8, MORE = 32 };
    unsigned tables = (unsigned)(from[4] << 8 | from[5]);
    size_t at = (count + MORE + 3) / 4 * 4;
    uint8_t *made = calloc(1, at + 128), *entry = made + 12;
    memcpy(made, from, 12);
    put(made + 4, tables + 2, 2);
    /* The new tables come first: tables are sorted by their tags, and these begin with
     * capitals. */
    memcpy(entry, "COLR", 4);
    put(put(entry + 8, (uint32_t)at, 4), COLR, 4);
    memcpy(entry + 16, "CPAL", 4);
    put(put(entry + 24, (uint32_t)at + 64, 4), CPAL, 4);
    memcpy(entry + MORE, from + 12, 16 * tables);
    for (unsigned t = 0; t < tables; t++)
        put(entry + MORE + 16 * t + 8, get32(from + 12 + 16 * t + 8) + MORE, 4);
    memcpy(made + 12 + 16 * tables + MORE, from + 12 + 16 * tables, count - 12 - 16 * tables);
    uint8_t *c = made + at;
    c = put(put(put(put(put(c, 0, 2), 1, 2), 14, 4), 20, 4), 2, 2);
    c = put(put(put(c, base, 2), 0, 2), 2, 2);
    put(put(put(put(c, below, 2), 1, 2), above, 2), 0xffff, 2);
    c = made + at + 64;
    c = put(put(put(put(put(put(c, 0, 2), 2, 2), 1, 2), 2, 2), 14, 4), 0, 2);
    put(put(c, 0x00ff00ff, 4), 0x0000ff80, 4); /* blue, green, red, cover */
    *made_count = at + 128;
    return made;
}

static void layers_are_drawn_one_above_the_other(void **state)
{
    (void)state;
    struct font_face *plain = face_open("DejaVuSans"), *face;
    size_t count, made_count;
    const uint8_t *bytes = font_face_bytes(plain, &count);
    uint32_t a = font_face_glyph(plain, 'A'), o = font_face_glyph(plain, 'O'),
             x = font_face_glyph(plain, 'x');
    uint8_t *made = layered_make(bytes, count, a, o, x, &made_count);
    assert_font(font_face_open_memory(made, made_count, 0, &face));
    struct font_painter *painter = painter_make();
    struct font_ink red = font_ink_plain(1, 0, 0, 128 / 255.0);
    struct font_placed one = {.face = face, .glyph = a};
    struct font_placed two[] = {{.face = plain, .glyph = o, .ink = 1},
                                {.face = plain, .glyph = x}};
    const struct font_layout layered = {.glyphs = &one, .glyphs_count = 1, .size_px = 70};
    const struct font_layout apart = {
        .glyphs = two, .glyphs_count = 2, .size_px = 70, .inks = &red, .inks_count = 1};
    struct font_picture to = picture_of(0);
    assert_font(font_painter_layout(painter, &layered, NULL, 30.3, 110.6, &to));
    to = picture_of(1);
    assert_font(font_painter_layout(painter, &apart, NULL, 30.3, 110.6, &to));
    assert_memory_equal(page[0], page[1], sizeof page[0]);
    double reddish = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        reddish += page[0][3 * i] - page[0][3 * i + 1] > 40;
    assert_true(reddish > 300);
    struct font_box boxes[2];
    assert_font(font_painter_measure(painter, &layered, NULL, 30.3, 110.6, &boxes[0]));
    assert_font(font_painter_measure(painter, &apart, NULL, 30.3, 110.6, &boxes[1]));
    assert_memory_equal(&boxes[0], &boxes[1], sizeof boxes[0]);
    font_painter_destroy(painter);
    font_face_close(face);
    font_face_close(plain);
    free(made);
}

/* Counts a word in a drawing of the layout. */
static int drawing_has(const struct font_layout *l, bool pdf, const char *word)
{
    struct font_drawing d = {.width_px = SIDE, .height_px = SIDE};
    char *bytes = NULL;
    size_t count;
    int found = 0;
    FILE *f = open_memstream(&bytes, &count);
    assert_non_null(f);
    assert_font((pdf ? font_drawing_pdf : font_drawing_svg)(&d, l, NULL, 20, 110, f));
    fclose(f);
    if (pdf) {
        char *text = pdf_unpacked(bytes, count);
        free(bytes);
        bytes = text;
        count = strlen(text);
    }
    for (const char *at = bytes;
         (at = memmem(at, count - (size_t)(at - bytes), word, strlen(word))); at++)
        found++;
    free(bytes);
    return found;
}

static void drawings_have_colours(void **state)
{
    (void)state;
    struct font_face *plain = face_open("DejaVuSans"), *face;
    size_t count, made_count;
    const uint8_t *bytes = font_face_bytes(plain, &count);
    uint32_t a = font_face_glyph(plain, 'A');
    uint8_t *made = layered_make(bytes, count, a, font_face_glyph(plain, 'O'),
                                 font_face_glyph(plain, 'x'), &made_count);
    assert_font(font_face_open_memory(made, made_count, 0, &face));
    struct font_placed one = {.face = face, .glyph = a};
    const struct font_layout layered = {.glyphs = &one, .glyphs_count = 1, .size_px = 70};
    assert_int_equal(drawing_has(&layered, false, "rgb(255,0,0)"), 1);
    assert_int_equal(drawing_has(&layered, false, "<use"), 2);
    assert_int_equal(drawing_has(&layered, true, "1 0 0 rg"), 1);
    font_face_close(face);
    free(made);
    struct font_shaper *s;
    struct font_layout l;
    frog_lay(plain, &s, 60, &l);
    assert_int_equal(drawing_has(&l, false, "<image"), 1);
    assert_int_equal(drawing_has(&l, true, "/SMask"), 1);
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_drawn_in_their_colours),
        cmocka_unit_test(pictures_are_turned_with_the_text),
        cmocka_unit_test(pictures_are_refused_where_nothing_draws_them),
        cmocka_unit_test(layers_are_drawn_one_above_the_other),
        cmocka_unit_test(drawings_have_colours),
    };
    return cmocka_run_group_tests_name("colour", tests, NULL, NULL);
}
