/* test_text.c - text: UTF-8, shaping, order, fallback, lines, painting, kept glyphs. */
#include "support.h"

#include <paint.h>
#include <text.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct font_layout layout_make(struct font_shaper *s, const char *text,
                                      const struct font_text_options *options)
{
    struct font_layout layout;
    assert_font(font_shaper_layout(s, text, strlen(text), 20, options, &layout));
    return layout;
}

static void utf8_is_read_or_replaced(void **state)
{
    (void)state;
    static const struct {
        const char *bytes;
        int characters, damaged;
        uint32_t first;
    } cases[] = {{"A", 1, 0, 'A'},
                 {"\xc3\xa9", 1, 0, 0xe9},
                 {"\xe2\x82\xac", 1, 0, 0x20ac},
                 {"\xf0\x9f\x98\x80", 1, 0, 0x1f600},
                 {"\x80", 1, 1, 0xfffd},     /* a tail alone */
                 {"\xc0\xaf", 2, 2, 0xfffd}, /* too long a spelling */
                 {"\xe0\x80\x80", 3, 3, 0xfffd},
                 {"\xed\xa0\x80", 3, 3, 0xfffd},     /* a surrogate */
                 {"\xf4\x90\x80\x80", 4, 4, 0xfffd}, /* beyond Unicode */
                 {"\xe2\x82", 1, 1, 0xfffd},         /* cut off */
                 {"\xe2\x82x", 2, 1, 0xfffd},
                 {"\xff\xfe", 2, 2, 0xfffd}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *at = cases[i].bytes, *end = at + strlen(at);
        int characters = 0, damaged = 0;
        uint32_t first = 0, c;
        while (at < end) {
            damaged += !font_utf8_next(&at, end, &c);
            first = characters++ ? first : c;
        }
        if (characters != cases[i].characters || damaged != cases[i].damaged ||
            first != cases[i].first)
            fail_msg("case %zu: %d characters, %d damaged, first U+%04X", i, characters,
                     damaged, (unsigned)first);
    }
}

/* As the reader of UTF-8 has them, which takes no longer form than the shortest. */
static void characters_are_written_as_they_are_read(void **state)
{
    (void)state;
    for (uint32_t c = 1; c < 0x110000; c++) {
        char bytes[FONT_UTF8_BYTES];
        const char *at = bytes;
        uint32_t read;
        if (c >= 0xd800 && c < 0xe000) /* halves of pairs are no characters */
            continue;
        const int count = font_utf8_put(c, bytes);
        assert_true(font_utf8_next(&at, bytes + count, &read));
        assert_int_equal(read, c);
        assert_ptr_equal(at, bytes + count);
    }
}

static void letters_kern_and_join(void **state)
{
    (void)state;
    struct font_face *face = face_open("EBGaramond12-Regular");
    struct font_shaper *s = shaper_make(face);
    struct font_text_options plain = {.features = "kern=0,liga=0"};
    struct font_layout kerned = layout_make(s, "AVAT", NULL);
    struct font_layout unkerned = layout_make(s, "AVAT", &plain);
    assert_int_equal(kerned.glyphs_count, 4);
    assert_true(kerned.width_px < unkerned.width_px - 1);
    struct font_face *sans = face_open("DejaVuSans");
    struct font_shaper *joiner = shaper_make(sans);
    struct font_layout joined = layout_make(joiner, "fi", NULL);
    struct font_layout apart = layout_make(joiner, "fi", &plain);
    assert_int_equal(joined.glyphs_count, 1);
    assert_int_equal(apart.glyphs_count, 2);
    font_shaper_destroy(joiner);
    font_face_close(sans);
    /* A combining accent is placed on its letter and adds no width. */
    struct font_layout letter = layout_make(s, "e", NULL),
                       accent = layout_make(s, "e\xcc\x81", NULL);
    assert_true(fabs(letter.width_px - accent.width_px) < 1e-6);
    /* Advances are not rounded. */
    double rounded = 0;
    for (int i = 1; i < kerned.glyphs_count; i++)
        rounded += fabs(kerned.glyphs[i].x_px - round(kerned.glyphs[i].x_px));
    assert_true(rounded > 0.01);
    font_layout_finish(&kerned);
    font_layout_finish(&unkerned);
    font_layout_finish(&joined);
    font_layout_finish(&apart);
    font_layout_finish(&letter);
    font_layout_finish(&accent);
    font_shaper_destroy(s);
    font_face_close(face);
}

static void type_1_fonts_kern_too(void **state)
{
    (void)state;
    struct font_face *face = face_open(TYPE_1_FONT);
    struct font_shaper *s = shaper_make(face);
    struct font_layout l = layout_make(s, "Paris", NULL);
    assert_true(l.glyphs_count == 5 && l.width_px > 30 && l.missing_count == 0);
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(face);
}

/* HarfBuzz reads advances from OpenType tables, and asks FreeType for those of Type 1. Both
 * must agree. */
static void advances_are_the_glyphs(void **state)
{
    (void)state;
    static const char *const names[] = {"DejaVuSans", "DejaVuSansMono", "EBGaramond12-Italic",
                                        "C059-Roman.otf", TYPE_1_FONT};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        struct font_face *face = face_open(names[n]);
        struct font_face_info info;
        struct font_shaper *s = shaper_make(face);
        struct font_text_options alone = {.no_fallback = true};
        font_face_describe(face, &info);
        int seen = 0;
        for (uint32_t c = 0x21; c < 0x500; c++) {
            const char text[3] = {(char)(c < 0x80 ? c : 0xc0 | c >> 6),
                                  (char)(c < 0x80 ? 0 : 0x80 | (c & 0x3f)), 0};
            double advance;
            /* Skips marks, which have no advance after shaping. */
            if ((c >= 0x300 && c < 0x370) || (c >= 0x483 && c < 0x48a) || c == 0xad ||
                !font_face_glyph(face, c))
                continue;
            struct font_layout l = layout_make(s, text, &alone);
            assert_int_equal(l.glyphs_count, 1);
            assert_font(font_face_advance(face, l.glyphs[0].glyph, &advance));
            bool mark = l.lines[0].width_px == 0; /* the font says so of some letters */
            if (!mark && fabs(l.lines[0].width_px - advance * 20 / info.units_per_em) > 1e-6)
                fail_msg("%s, U+%04X: %g px, not %g units", names[n], (unsigned)c,
                         l.lines[0].width_px, advance);
            font_layout_finish(&l);
            seen += !mark;
        }
        assert_true(seen > 150);
        font_shaper_destroy(s);
        font_face_close(face);
    }
}

/* A Hebrew word between Latin ones is drawn from right to left, in its place. */
static void right_to_left_is_turned(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *s = shaper_make(face);
    struct font_layout l = layout_make(s, "a \xd7\x90\xd7\x91\xd7\x92 b", NULL);
    assert_int_equal(l.glyphs_count, 7);
    static const int clusters[] = {0, 1, 6, 4, 2, 8, 9};
    for (int i = 0; i < 7; i++) {
        assert_int_equal(l.glyphs[i].cluster, clusters[i]);
        assert_true(i == 0 || l.glyphs[i].x_px > l.glyphs[i - 1].x_px);
    }
    font_layout_finish(&l);
    /* Right-to-left lines end at the right end of the longest line. */
    l = layout_make(s, "\xd7\x90\xd7\x91\xd7\x92\xd7\x93\n\xd7\x90", NULL);
    assert_int_equal(l.lines_count, 2);
    assert_true(l.glyphs[4].line == 1 && l.glyphs[4].x_px > l.width_px / 2);
    assert_true(fabs(l.glyphs[4].y_px - l.line_height_px) < 1e-9);
    /* Arabic letters take their joined shapes, whose glyphs differ from those of single
     * letters. */
    struct font_layout joined = layout_make(s, "\xd8\xa8\xd8\xa8\xd8\xa8", NULL);
    assert_int_equal(joined.glyphs_count, 3);
    assert_true(joined.glyphs[0].glyph != joined.glyphs[1].glyph &&
                joined.glyphs[1].glyph != joined.glyphs[2].glyph);
    font_layout_finish(&joined);
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(face);
}

static void what_the_face_has_not_is_found_or_said(void **state)
{
    (void)state;
    struct font_face *face = face_open("EBGaramond12-Italic");
    struct font_shaper *s = shaper_make(face);
    const char *text = "a\xe2\x99\x9e\xf3\xb0\x80\x80"; /* a knight, and one of nobody's */
    struct font_layout l = layout_make(s, text, NULL);
    assert_int_equal(l.glyphs_count, 3);
    assert_true(l.glyphs[1].face != face && l.glyphs[1].glyph != 0);
    assert_true(l.glyphs[2].face == face && l.glyphs[2].glyph == 0);
    assert_int_equal(l.fallback_count, 1);
    assert_int_equal(l.missing_count, 1);
    assert_int_equal(l.missing[0], 0xf0000);
    font_layout_finish(&l);
    struct font_text_options alone = {.no_fallback = true};
    l = layout_make(s, text, &alone);
    assert_int_equal(l.missing_count, 2);
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(face);
}

/* A glyph that a bold or slanted face lacks comes from a face that is bold or slanted, too. */
static void fallback_keeps_weight_and_slant(void **state)
{
    (void)state;
    static const struct {
        const char *font;
        bool bold, slanted;
    } cases[] = {{"C059-Roman", false, false},
                 {"C059-Bold", true, false},
                 {TYPE_1_FOLDER "C059-Bold.t1", true, false},
                 {"NimbusSans-Italic", false, true},
                 {"NimbusSans-BoldItalic", true, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct font_face *face = face_open(cases[i].font);
        struct font_shaper *s = shaper_make(face);
        struct font_layout l = layout_make(s, "\xe2\x87\x9d", NULL); /* DejaVu has this arrow */
        assert_int_equal(l.fallback_count, 1);
        const struct font_manner manner = font_face_manner(l.glyphs[0].face);
        assert_int_equal(manner.weight > 150, cases[i].bold); /* fontconfig's: 80 is regular */
        assert_int_equal(manner.slant > 0, cases[i].slanted);
        font_layout_finish(&l);
        font_shaper_destroy(s);
        font_face_close(face);
    }
}

/* URW's faces are installed as Type 1 and as OpenType under the same name; the OpenType file is
 * chosen. */
static void names_are_of_opentype_files(void **state)
{
    (void)state;
    char *path = font_face_find("C059-Bold", NULL);
    assert_non_null(path);
    assert_string_equal(path + strlen(path) - 4, ".otf");
    free(path);
    path = font_face_find("C059-Bold.t1", NULL);
    assert_true(!path || strcmp(path + strlen(path) - 3, ".t1") == 0); /* no other file */
    free(path);
    assert_null(font_face_find("C059-Boldest.t1", NULL));
    assert_null(font_face_find("DejaVu Sans-Boldest", NULL)); /* which is no size */
}

/* Thin stems are darkened more than thick ones, and wide ones not at all. */
static void stems_say_how_dark(void **state)
{
    (void)state;
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painters[2];
    assert_font(font_painter_create(&def, &painters[0]));
    def.darken_px = FONT_DARKEN_BY_STEM;
    assert_font(font_painter_create(&def, &painters[1]));
    struct font_face *face = face_open("DejaVuSans");
    assert_true(fabs(font_face_stem(face) - 184.0 / 2048) <
                1e-9); /* of an l, as it was drawn */
    double before = 1e9;
    for (double size = 8; size < 40; size += 4) {
        double ink[2] = {0};
        for (int k = 0; k < 2; k++) {
            const struct font_gray *gray;
            assert_font(font_painter_glyph(painters[k], face, font_face_glyph(face, 'l'), size,
                                           NULL, 0.25, 0, &gray));
            for (int i = 0; i < gray->height_px; i++)
                for (int c = 0; c < gray->width_px; c++)
                    ink[k] += gray->pixels[i * gray->pitch + c];
        }
        double more = ink[1] / ink[0];
        assert_true(more <= before + 1e-3 && (more > 1.1 || size > 20));
        if (size >= 27)
            assert_true(more == 1);
        before = more;
    }
    font_face_close(face);
    font_painter_destroy(painters[0]);
    font_painter_destroy(painters[1]);
}

static void nonsense_is_refused(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *s = shaper_make(face);
    struct font_layout l;
    static const double sizes[] = {0, -1, NAN, INFINITY, 1e9};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        assert_int_equal(font_shaper_layout(s, "a", 1, sizes[i], NULL, &l), FONT_BAD_ARGUMENT);
    struct font_text_options wrong = {.features = "kern=0,,x==y"};
    assert_int_equal(font_shaper_layout(s, "a", 1, 12, &wrong, &l), FONT_BAD_ARGUMENT);
    wrong = (struct font_text_options){.letter_spacing_px = NAN};
    assert_int_equal(font_shaper_layout(s, "a", 1, 12, &wrong, &l), FONT_BAD_ARGUMENT);
    assert_font(font_shaper_layout(s, "", 0, 12, NULL, &l));
    assert_int_equal(l.glyphs_count, 0);
    font_layout_finish(&l);
    assert_font(font_shaper_layout(s, "\n\n\r\n", 4, 12, NULL, &l));
    assert_int_equal(l.lines_count, 4);
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(face);
}

/* ---- painting ---- */

enum { WIDTH = 160, HEIGHT = 40 };

struct paint_fixture {
    struct font_face *face;
    struct font_shaper *shaper;
    struct font_layout layout;
    uint8_t pixels[2][WIDTH * HEIGHT * 3];
    struct font_picture picture[2];
};

static void paint_begin(struct paint_fixture *f, const char *text)
{
    f->face = face_open("DejaVuSans");
    f->shaper = shaper_make(f->face);
    assert_font(font_shaper_layout(f->shaper, text, strlen(text), 14, NULL, &f->layout));
    for (int i = 0; i < 2; i++) {
        memset(f->pixels[i], 255, sizeof f->pixels[i]);
        f->picture[i] = (struct font_picture){WIDTH, HEIGHT, 3 * WIDTH, f->pixels[i]};
    }
}

static void paint_end(struct paint_fixture *f)
{
    font_layout_finish(&f->layout);
    font_shaper_destroy(f->shaper);
    font_face_close(f->face);
}

static void paint(struct paint_fixture *f, const struct font_painter_def *def, int picture,
                  double x, double y)
{
    struct font_painter *p;
    assert_font(font_painter_create(def, &p));
    assert_font(font_painter_layout(p, &f->layout, NULL, x, y, &f->picture[picture]));
    font_painter_destroy(p);
}

static double ink_of(const struct paint_fixture *f, int picture, double gamma)
{
    double ink = 0;
    for (size_t i = 0; i < sizeof f->pixels[0]; i++)
        ink += 1 - font_light(f->pixels[picture][i] / 255.0, gamma);
    return ink;
}

static void light_is_what_is_mixed(void **state)
{
    (void)state;
    static struct paint_fixture f;
    struct font_painter_def def = font_painter_def_default();
    paint_begin(&f, "Hamburg");
    /* Black text on white removes as much light as white text on black adds. */
    paint(&f, &def, 0, 5, 25);
    memset(f.pixels[1], 0, sizeof f.pixels[1]);
    def.ink[0] = def.ink[1] = def.ink[2] = 1;
    paint(&f, &def, 1, 5, 25);
    double black = ink_of(&f, 0, 0), white = sizeof f.pixels[0] - ink_of(&f, 1, 0);
    assert_true(fabs(black / white - 1) < 0.003);
    /* Without gamma correction black text removes more light. */
    struct font_painter_def numbers = font_painter_def_default();
    numbers.gamma = 1;
    memset(f.pixels[1], 255, sizeof f.pixels[1]);
    paint(&f, &numbers, 1, 5, 25);
    assert_true(ink_of(&f, 1, 0) > 1.1 * black);
    /* A number converted to light and back is unchanged. */
    for (int i = 0; i < 256; i++)
        assert_int_equal(lrint(255 * font_number(font_light(i / 255.0, 0), 0)), i);
    paint_end(&f);
}

static void stems_darken_when_small(void **state)
{
    (void)state;
    static struct paint_fixture f;
    struct font_painter_def def = font_painter_def_default();
    paint_begin(&f, "illicit");
    paint(&f, &def, 0, 5, 25);
    def.darken_px = 0.4;
    paint(&f, &def, 1, 5, 25);
    double more = ink_of(&f, 1, 0) / ink_of(&f, 0, 0);
    assert_true(more > 1.15 && more < 1.6);
    paint_end(&f);
}

static void stripes_are_thirds_of_pixels(void **state)
{
    (void)state;
    static struct paint_fixture f;
    struct font_painter_def def = font_painter_def_default();
    paint_begin(&f, "Vl");
    def.stripes = true;
    paint(&f, &def, 0, 5, 25);
    /* The red subpixels are the gray of text that is a third of a pixel further right. */
    def.stripes = false;
    paint(&f, &def, 1, 5 + 1.0 / 3, 25);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        assert_true(abs(f.pixels[0][3 * i] - f.pixels[1][3 * i]) <= 1);
    paint_end(&f);
}

static void glyphs_kept_are_glyphs_drawn(void **state)
{
    (void)state;
    static struct paint_fixture f;
    struct font_painter *p;
    struct font_painter_stats stats;
    paint_begin(&f, "kept and kept again");
    struct font_painter_def def = font_painter_def_default();
    def.places = 64;
    assert_font(font_painter_create(&def, &p));
    assert_font(font_painter_layout(p, &f.layout, NULL, 4.25, 25, &f.picture[0]));
    font_painter_stats_get(p, &stats);
    long drawn = stats.drawn;
    memset(f.pixels[0], 255, sizeof f.pixels[0]);
    assert_font(font_painter_layout(p, &f.layout, NULL, 4.25, 25, &f.picture[0]));
    font_painter_stats_get(p, &stats);
    assert_true(stats.drawn == drawn && stats.kept_hits >= f.layout.glyphs_count);
    assert_true(stats.evicted == 0 && stats.kept_bytes < def.budget_bytes);
    font_painter_destroy(p);
    /* Kept glyphs are those drawn at their exact place, to a 128th of a pixel. */
    def.places = 0;
    paint(&f, &def, 1, 4.25, 25);
    for (size_t i = 0; i < sizeof f.pixels[0]; i++)
        assert_true(abs(f.pixels[0][i] - f.pixels[1][i]) <= 6);
    /* With room for less than two glyphs the painter draws them again and again; the picture is
     * the same. */
    def.places = 64;
    def.budget_bytes = 4096;
    assert_font(font_painter_create(&def, &p));
    memset(f.pixels[1], 255, sizeof f.pixels[1]);
    assert_font(font_painter_layout(p, &f.layout, NULL, 4.25, 25, &f.picture[1]));
    font_painter_stats_get(p, &stats);
    assert_true(stats.evicted > 10);
    assert_memory_equal(f.pixels[0], f.pixels[1], sizeof f.pixels[0]);
    font_painter_destroy(p);
    paint_end(&f);
}

static void what_lies_outside_is_cut_off(void **state)
{
    (void)state;
    static struct paint_fixture f;
    struct font_painter_def def = font_painter_def_default();
    paint_begin(&f, "Wq");
    for (int k = 0; k < 60; k++)
        paint(&f, &def, 0, -20 + 3.3 * k, -10 + 1.1 * k);
    paint(&f, &def, 0, 900000, -900000);
    struct font_painter *p;
    assert_font(font_painter_create(&def, &p));
    assert_int_equal(font_painter_layout(p, &f.layout, NULL, 1e300, 0, &f.picture[0]),
                     FONT_BAD_ARGUMENT);
    font_painter_destroy(p);
    def.ink[1] = 2;
    assert_int_equal(font_painter_create(&def, &p), FONT_BAD_ARGUMENT);
    paint_end(&f);
}

/* What is no UTF-8 is mended once for all: then every byte of the text is a character's. */
static void damaged_text_is_mended(void **state)
{
    (void)state;
    static const char damaged[] = "a\xff\xc3(\xe2\x82 \xf0\x9f\x90\xb8\x80";
    char *mended;
    size_t bytes;
    assert_int_equal(font_utf8_damaged(damaged, strlen(damaged)), 4);
    assert_font(font_utf8_mend(damaged, strlen(damaged), &mended, &bytes));
    assert_string_equal(mended,
                        "a\xef\xbf\xbd\xef\xbf\xbd(\xef\xbf\xbd \xf0\x9f\x90\xb8\xef\xbf\xbd");
    assert_int_equal(bytes, strlen(mended));
    assert_int_equal(font_utf8_damaged(mended, bytes), 0);
    free(mended);
}

/* A map distorts a whole line, and the line stays within the map's four corners. */
static void lines_are_distorted_as_a_whole(void **state)
{
    (void)state;
    static struct paint_fixture f;
    paint_begin(&f, "IIIIIIII");
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *p;
    struct font_map map;
    struct font_box box;
    const struct font_point corners[4] = {{10, 4}, {150, 14}, {150, 26}, {10, 36}};
    assert_font(font_painter_create(&def, &p));
    for (int kind = FONT_PROJECTIVE; kind <= FONT_BILINEAR; kind++) {
        assert_font(font_map_corners((enum font_map_kind)kind, 0, -f.layout.ascent_px,
                                     f.layout.width_px, f.layout.descent_px, corners, &map));
        assert_font(font_painter_measure(p, &f.layout, &map, 0, 0, &box));
        assert_true(box.x0 > 7 && box.x1 < 153 && box.y0 > 1 && box.y1 < 39);
        assert_true(box.x1 - box.x0 > 120);
        assert_font(font_painter_layout(p, &f.layout, &map, 0, 0, &f.picture[0]));
    }
    font_painter_destroy(p);
    paint_end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(utf8_is_read_or_replaced),
        cmocka_unit_test(characters_are_written_as_they_are_read),
        cmocka_unit_test(letters_kern_and_join),
        cmocka_unit_test(type_1_fonts_kern_too),
        cmocka_unit_test(advances_are_the_glyphs),
        cmocka_unit_test(right_to_left_is_turned),
        cmocka_unit_test(what_the_face_has_not_is_found_or_said),
        cmocka_unit_test(fallback_keeps_weight_and_slant),
        cmocka_unit_test(names_are_of_opentype_files),
        cmocka_unit_test(stems_say_how_dark),
        cmocka_unit_test(nonsense_is_refused),
        cmocka_unit_test(light_is_what_is_mixed),
        cmocka_unit_test(stems_darken_when_small),
        cmocka_unit_test(stripes_are_thirds_of_pixels),
        cmocka_unit_test(glyphs_kept_are_glyphs_drawn),
        cmocka_unit_test(what_lies_outside_is_cut_off),
        cmocka_unit_test(lines_are_distorted_as_a_whole),
        cmocka_unit_test(damaged_text_is_mended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
