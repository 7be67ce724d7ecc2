/* test_drawing.c - text as drawings in SVG and PDF: all letters, their text, inks. */
#include "support.h"

#include <drawing.h>

#include <stdlib.h>
#include <string.h>

static const char marsh[] =
    "The water of a marsh carries pigment through the sheets; what it leaves dries dark";

static char *drawn(const struct font_layout *l, bool pdf, size_t *bytes)
{
    const struct font_drawing d = {
        .width_px = 500, .height_px = 500, .text = marsh, .bytes = strlen(marsh)};
    char *out = NULL;
    FILE *file = open_memstream(&out, bytes);
    assert_non_null(file);
    assert_font(pdf ? font_drawing_pdf(&d, l, NULL, 0, 0, file)
                    : font_drawing_svg(&d, l, NULL, 0, 0, file));
    fclose(file);
    return out;
}

static int count_of(const char *in, const char *what)
{
    int n = 0;
    for (const char *at = in; (at = strstr(at, what)); at += strlen(what))
        n++;
    return n;
}

static void drawings_have_all_letters(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSerif");
    struct font_shaper *s = shaper_make(face);
    struct font_text_options options = {
        .features = "-liga,-dlig", .width_px = 190, .align = FONT_ALIGN_JUSTIFY};
    struct font_layout layout, *l = &layout;
    size_t bytes;
    assert_font(font_shaper_layout(s, marsh, strlen(marsh), 14, &options, &layout));
    char *svg = drawn(l, false, &bytes);
    assert_int_equal(count_of(svg, "<use "), l->glyphs_count);
    assert_int_equal(count_of(svg, "<text "), l->glyphs_count); /* ligatures are off */
    assert_true(count_of(svg, "<path ") < 40);
    free(svg);
    char *pdf = drawn(l, true, &bytes);
    assert_memory_equal(pdf, "%PDF-1.5", 8);
    /* Each object begins at its offset in the xref table. */
    const char *table = strstr(pdf + atol(strstr(pdf, "startxref") + 10), "xref");
    assert_ptr_equal(table, pdf + atol(strstr(pdf, "startxref") + 10));
    const char *row = strstr(table, "65535 f \n") + 9;
    for (int i = 1; row[11] == '0' && row[17] == 'n'; i++, row += 20) {
        char wanted[32];
        snprintf(wanted, sizeof wanted, "%d 0 obj", i);
        assert_memory_equal(pdf + atol(row), wanted, strlen(wanted));
    }
    free(pdf);
    font_layout_finish(&layout);
    font_shaper_destroy(s);
    font_face_close(face);
}

/* Drawings define each gradient once, in the page's coordinates, and fill letters with it. */
static void drawings_have_gradients(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *s = shaper_make(face);
    struct font_layout l;
    const struct font_ink inks[] = {
        {.kind = FONT_INK_LINEAR,
         .x1 = 100,
         .stops_count = 3,
         .stops = {{0, {1, 0, 0, 1}}, {0.25, {0, 1, 0, 1}}, {1, {0, 0, 1, 1}}}},
        {.kind = FONT_INK_RADIAL,
         .x0 = 80,
         .x1 = 40,
         .stops_count = 2,
         .stops = {{0, {1, 1, 0, 1}}, {1, {0, 1, 1, 1}}}},
    };
    size_t bytes;
    assert_font(font_shaper_layout(s, "abcdef", 6, 30, NULL, &l));
    for (int i = 0; i < l.glyphs_count; i++) {
        if (i % 3 == 0)
            assert_true(font_layout_ink_add(&l, &inks[i / 3]) > 0);
        l.glyphs[i].ink = i / 3 + 1;
    }
    char *pdf = drawn(&l, true, &bytes);
    assert_int_equal(count_of(pdf, "/ShadingType 2 /Coords [0 0 100 0]"), 1);
    assert_int_equal(count_of(pdf, "/ShadingType 3 /Coords [80 0 0 80 0 40]"), 1);
    assert_int_equal(count_of(pdf, "/Bounds [ 0.0000010 0.2500000 0.9999990 ]"), 1);
    assert_int_equal(count_of(pdf, "/Pattern cs /P1 scn"), 1);
    assert_int_equal(count_of(pdf, "/Pattern cs /P2 scn"), 1);
    free(pdf);
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(face);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drawings_have_all_letters),
        cmocka_unit_test(drawings_have_gradients),
    };
    return cmocka_run_group_tests_name("drawings", tests, NULL, NULL);
}
