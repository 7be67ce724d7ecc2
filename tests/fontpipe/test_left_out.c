/* test_left_out.c - a glyph whose outline is damaged is left out by name, and the text around
 * it is set: by painters, in SVG and PDF. */
#include "support.h"

#include <document.h>
#include <drawing.h>
#include <paint.h>

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 200, HEIGHT = 60 };

static uint32_t number_at(const uint8_t *at, int bytes)
{
    uint32_t n = 0;
    for (int i = 0; i < bytes; i++)
        n = n << 8 | at[i];
    return n;
}

static uint8_t *table_of(uint8_t *font, const char *tag)
{
    int tables = (int)number_at(font + 4, 2);
    for (int i = 0; i < tables; i++)
        if (memcmp(font + 12 + 16 * i, tag, 4) == 0)
            return font + number_at(font + 12 + 16 * i + 8, 4);
    fail_msg("no table %s", tag);
    return NULL;
}

/* DejaVu Sans, whose glyphs of some letters say that they have 32,767 contours. */
static struct font_face *damaged_face(const char *letters)
{
    struct font_face *whole = face_open("DejaVuSans"), *out;
    size_t count;
    const void *bytes = font_face_bytes(whole, &count);
    uint8_t *copy = malloc(count);
    assert_non_null(copy);
    memcpy(copy, bytes, count);
    bool wide = number_at(table_of(copy, "head") + 50, 2) != 0;
    for (; *letters; letters++) {
        uint32_t glyph = font_face_glyph(whole, (uint32_t)*letters);
        uint8_t *loca = table_of(copy, "loca") + glyph * (wide ? 4u : 2u);
        uint8_t *at = table_of(copy, "glyf") + number_at(loca, wide ? 4 : 2) * (wide ? 1u : 2u);
        at[0] = 0x7f;
        at[1] = 0xff;
    }
    assert_font(font_face_open_memory(copy, count, 0, &out));
    free(copy);
    font_face_close(whole);
    return out;
}

static uint8_t *picture_of(const struct font_layout *layout)
{
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    uint8_t *pixels = malloc(3 * WIDTH * HEIGHT);
    struct font_picture picture = {WIDTH, HEIGHT, 3 * WIDTH, pixels};
    assert_non_null(pixels);
    memset(pixels, 255, 3 * WIDTH * HEIGHT);
    assert_font(font_painter_create(&def, &painter));
    assert_font(font_painter_layout(painter, layout, NULL, 10, 45, &picture));
    font_painter_destroy(painter);
    return pixels;
}

static void a_damaged_glyph_is_left_out_by_name(void **state)
{
    (void)state;
    struct font_face *face = damaged_face("AM");
    struct font_shaper *shaper = shaper_make(face);
    struct font_layout l;
    assert_null(font_left_out());
    assert_font(font_shaper_layout(shaper, "bAdMAd", 6, 36, NULL, &l));
    assert_int_equal(l.glyphs_count, 6);
    uint8_t *have = picture_of(&l);
    const char *said = font_left_out();
    assert_non_null(said);
    print_message("%s\n", said);
    assert_non_null(strstr(said, "glyph A of "));
    assert_non_null(strstr(said, "so are 1 more"));
    assert_null(font_left_out());
    /* The others, alone in the same places. */
    int kept = 0;
    for (int i = 0; i < 6; i++)
        if (i == 0 || i == 2 || i == 5)
            l.glyphs[kept++] = l.glyphs[i];
    l.glyphs_count = kept;
    uint8_t *want = picture_of(&l);
    assert_null(font_left_out());
    assert_memory_equal(have, want, 3 * WIDTH * HEIGHT);
    bool ink = false;
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        ink = ink || want[i] != 255;
    assert_true(ink);
    free(have);
    free(want);
    font_layout_finish(&l);
    font_shaper_destroy(shaper);
    font_face_close(face);
}

static void drawings_leave_it_out_too(void **state)
{
    (void)state;
    struct font_face *face = damaged_face("A");
    struct font_shaper *shaper = shaper_make(face);
    struct font_layout l;
    const struct font_drawing drawing = {
        .width_px = WIDTH, .height_px = HEIGHT, .text = "bAd", .bytes = 3, .title = "t"};
    char *text;
    size_t bytes;
    assert_font(font_shaper_layout(shaper, "bAd", 3, 36, NULL, &l));
    FILE *file = open_memstream(&text, &bytes);
    assert_non_null(file);
    assert_font(font_drawing_svg(&drawing, &l, NULL, 10, 45, file));
    fclose(file);
    assert_non_null(strstr(text, "bAd"));
    const char *said = font_left_out();
    assert_true(said && strstr(said, "glyph A of ") && !strstr(said, "more"));
    free(text);
    font_layout_finish(&l);
    font_shaper_destroy(shaper);
    font_face_close(face);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_damaged_glyph_is_left_out_by_name),
        cmocka_unit_test(drawings_leave_it_out_too),
    };
    return cmocka_run_group_tests_name("left out", tests, NULL, NULL);
}
