/* test_line.c - lines of type: the places of letters, and refused input. */
#include <face.h>
#include <paper.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define FONT "DejaVuSerif"               /* kerned by its kern table */
#define FONT_GPOS "EBGaramond12-Regular" /* kerned by GPOS only */

static struct paper_screen line_make(const char *text, const char *font, double size_px)
{
    struct paper_line line = {.text = text, .font = font, .size_px = size_px};
    struct paper_screen screen;
    if (paper_line_screen(&line, &screen, NULL) != PAPER_OK)
        fail_msg("\"%s\" in %s: %s", text, font, paper_error());
    return screen;
}

static double advance_of(const char *text, const char *font)
{
    struct paper_screen screen = line_make(text, font, 500);
    double advance = screen.advance_px;
    paper_screen_destroy(&screen);
    return advance;
}

/* A screen's outermost rows and columns hold ink: it is no larger than its type. */
static void screen_fits_its_ink(void **state)
{
    (void)state;
    struct paper_screen s = line_make("Hamburgefonts", FONT, 60);
    size_t width = (size_t)s.width_px, height = (size_t)s.height_px;
    int top = 0, bottom = 0, left = 0, right = 0, full = 0;
    for (size_t x = 0; x < width; x++) {
        top += s.gray[x] > 0;
        bottom += s.gray[(height - 1) * width + x] > 0;
    }
    for (size_t y = 0; y < height; y++) {
        left += s.gray[y * width] > 0;
        right += s.gray[y * width + width - 1] > 0;
        for (size_t x = 0; x < width; x++)
            full += s.gray[y * width + x] == 255;
    }
    assert_true(top > 0 && bottom > 0 && left > 0 && right > 0 && full > 100);
    assert_true(s.baseline_y_px > 0 && s.baseline_y_px < s.height_px);
    assert_true(fabs(s.advance_px - s.width_px) < 10);
    paper_screen_destroy(&s);
}

static void kerning_pulls_letters_together(void **state)
{
    (void)state;
    static const char *const fonts[] = {FONT, FONT_GPOS};
    for (size_t i = 0; i < sizeof fonts / sizeof *fonts; i++) {
        double apart = advance_of("A", fonts[i]) + advance_of("V", fonts[i]);
        double pair = advance_of("AV", fonts[i]);
        if (!(pair < apart - 10 && pair > apart * 0.7))
            fail_msg("%s: A and V are %g and together %g", fonts[i], apart, pair);
        assert_true(fabs(advance_of("HH", fonts[i]) - 2 * advance_of("H", fonts[i])) < 0.1);
    }
}

static void size_and_tracking_scale(void **state)
{
    (void)state;
    struct paper_screen small = line_make("Paris", FONT, 50),
                        large = line_make("Paris", FONT, 200);
    assert_true(fabs(large.advance_px / small.advance_px - 4) < 0.02);
    struct paper_line line = {.text = "Paris", .font = FONT, .size_px = 50, .tracking_em = 0.1};
    struct paper_screen tracked;
    assert_int_equal(paper_line_screen(&line, &tracked, NULL), PAPER_OK);
    assert_true(fabs(tracked.advance_px - small.advance_px - 4 * 5) < 0.1);
    paper_screen_destroy(&small);
    paper_screen_destroy(&large);
    paper_screen_destroy(&tracked);
}

static void utf8_is_read_and_checked(void **state)
{
    (void)state;
    struct paper_screen s = line_make("\xc3\x89t\xc3\xa9 \xe2\x80\x94 \xce\xa9", FONT, 40);
    paper_screen_destroy(&s);
    static const char *const wrong[] = {
        "\xff", "a\xc3",       "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80",
        "\x80", "\xe2\x28\xa1"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct paper_line line = {.text = wrong[i], .font = FONT, .size_px = 40};
        assert_int_equal(paper_line_screen(&line, &s, NULL), PAPER_BAD_TEXT);
        assert_null(s.gray);
    }
}

static void missing_glyphs_are_reported(void **state)
{
    (void)state;
    struct paper_line line = {.text = "a\xf0\x93\x80\x80z", .font = FONT, .size_px = 40};
    struct paper_screen s;
    uint32_t missing;
    assert_int_equal(paper_line_screen(&line, &s, &missing), PAPER_OK);
    assert_int_equal(missing, 0x13000);
    paper_screen_destroy(&s);
    line.text = "\xf0\x93\x80\x80";
    assert_int_equal(paper_line_screen(&line, &s, &missing), PAPER_BAD_TEXT);
    assert_non_null(strstr(paper_error(), "U+13000"));
    line.text = "abc";
    assert_int_equal(paper_line_screen(&line, &s, &missing), PAPER_OK);
    assert_int_equal(missing, 0);
    paper_screen_destroy(&s);
}

static void empty_text_leaves_no_mark(void **state)
{
    (void)state;
    static const char *const texts[] = {"", "   ", "\t\n"};
    for (size_t i = 0; i < 3; i++) {
        struct paper_line line = {.text = texts[i], .font = FONT, .size_px = 40};
        struct paper_screen s;
        assert_int_equal(paper_line_screen(&line, &s, NULL), PAPER_BAD_TEXT);
    }
}

static void wrong_fonts_are_named(void **state)
{
    (void)state;
    static const char *const fonts[] = {"NoSuchFontAnywhere", "/nowhere/font.otf", "/dev/null",
                                        "/tmp", ""};
    for (size_t i = 0; i < sizeof fonts / sizeof *fonts; i++) {
        struct paper_line line = {.text = "a", .font = fonts[i], .size_px = 40};
        struct paper_screen s;
        assert_int_equal(paper_line_screen(&line, &s, NULL), PAPER_BAD_FONT);
        assert_non_null(strstr(paper_error(), fonts[i]));
    }
}

static void wrong_sizes_are_refused(void **state)
{
    (void)state;
    const double sizes[] = {0, -1, 0.5, 1e9, NAN, INFINITY};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct paper_line line = {.text = "a", .font = FONT, .size_px = sizes[i]};
        struct paper_screen s;
        assert_int_equal(paper_line_screen(&line, &s, NULL), PAPER_BAD_ARGUMENT);
    }
    struct paper_line line = {.text = "a", .font = FONT, .size_px = 40, .tracking_em = NAN};
    struct paper_screen s;
    assert_int_equal(paper_line_screen(&line, &s, NULL), PAPER_BAD_ARGUMENT);
}

static double ink_of(const struct paper_screen *s)
{
    double ink = 0;
    for (size_t i = 0; i < (size_t)s->width_px * (size_t)s->height_px; i++)
        ink += s->gray[i];
    return ink / 255;
}

/* Type that is moved by parts of a fiber, turned, or drawn with another filter has the same
 * amount of ink. */
static void type_is_placed_turned_and_filtered(void **state)
{
    (void)state;
    struct paper_line line = {.text = "Paris", .font = FONT, .size_px = 31.5};
    struct paper_screen plain = line_make(line.text, FONT, line.size_px), s;
    double ink = ink_of(&plain);
    static const struct {
        double x_px, y_px, angle_deg, anchor;
        const char *filter;
    } cases[] = {{0.3, 0.7, 0, 0, NULL},
                 {0, 0, 30, 0, NULL},
                 {0, 0, 90, 0.5, NULL},
                 {0, 0, 0, 1, "gaussian-fast"},
                 {0.5, 0.5, 211, 0.25, "cone:2"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        line.x_px = cases[i].x_px;
        line.y_px = cases[i].y_px;
        line.angle_deg = cases[i].angle_deg;
        line.anchor = cases[i].anchor;
        line.filter = cases[i].filter;
        assert_int_equal(paper_line_screen(&line, &s, NULL), PAPER_OK);
        /* Where letters touch, some ink may count once. */
        if (fabs(ink_of(&s) / ink - 1) > 0.004)
            fail_msg("case %zu: ink %g for %g", i, ink_of(&s), ink);
        assert_true(fabs(s.advance_px - plain.advance_px) < 1e-9);
        if (cases[i].angle_deg == 90) { /* it reads upwards, centred at the origin */
            assert_true(s.height_px > 2 * s.width_px);
            assert_true(abs(s.baseline_y_px - s.height_px / 2) < 4);
        }
        if (cases[i].anchor == 1)
            assert_true(s.origin_x_px > s.advance_px - 3);
        paper_screen_destroy(&s);
    }
    paper_screen_destroy(&plain);
}

static void type_is_set_in_columns(void **state)
{
    (void)state;
    struct paper_line line = {.text = "a town in a marsh, in ink on wet paper",
                              .font = FONT,
                              .size_px = 20,
                              .width_px = 150,
                              .align = PAPER_ALIGN_JUSTIFY,
                              .leading = 1.5};
    struct paper_screen s;
    assert_int_equal(paper_line_screen(&line, &s, NULL), PAPER_OK);
    assert_true(s.lines_count >= 3 && s.line_height_px == 30 && s.advance_px == 150);
    assert_true(s.width_px > 140 && s.width_px < 155);
    assert_true(s.height_px > 30 * (s.lines_count - 1));
    paper_screen_destroy(&s);
    static const struct paper_line wrong[] = {
        {.width_px = -1},   {.width_px = NAN}, {.angle_deg = INFINITY},
        {.x_px = 3},        {.anchor = 2},     {.align = (enum paper_align)9},
        {.filter = "soft"}, {.features = "="}, {.pixels_max = 100}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        line = wrong[i];
        line.text = "Paris";
        line.font = FONT;
        line.size_px = 40;
        assert_int_equal(paper_line_screen(&line, &s, NULL), PAPER_BAD_ARGUMENT);
        assert_null(s.gray);
    }
}

/* A character that the font lacks is drawn with another font's glyph. */
static void what_a_font_lacks_comes_from_another(void **state)
{
    (void)state;
    struct paper_line line = {
        .text = "\xe2\x99\x9e", .font = "EBGaramond12-Italic", .size_px = 40}; /* a knight */
    struct paper_screen s;
    uint32_t missing = 1;
    assert_int_equal(paper_line_screen(&line, &s, &missing), PAPER_OK);
    assert_true(missing == 0 && ink_of(&s) > 100);
    paper_screen_destroy(&s);
}

/* A damaged font is refused or drawn in some way; it does no other harm. */
static void damaged_fonts_do_no_harm(void **state)
{
    (void)state;
    enum { MUTATIONS = 150 };
    char *path = font_face_find(FONT_GPOS, NULL), damaged[] = "/tmp/lutetia-font-XXXXXX";
    assert_non_null(path);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    static uint8_t bytes[1 << 20], copy[1 << 20];
    size_t count = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    free(path);
    int descriptor = mkstemp(damaged);
    assert_true(descriptor >= 0);
    uint32_t random = 7;
    for (int i = 0; i < MUTATIONS; i++) {
        memcpy(copy, bytes, count);
        for (int change = 0; change < 40; change++) {
            random = random * 1664525u + 1013904223u;
            size_t at = (random >> 8) % count;
            copy[at] = (uint8_t)(random >> 3);
        }
        size_t length = i % 10 == 9 ? count / 2 : count;
        assert_int_equal(pwrite(descriptor, copy, length, 0), length);
        assert_int_equal(ftruncate(descriptor, (off_t)length), 0);
        struct paper_line line = {.text = "AV To", .font = damaged, .size_px = 30};
        struct paper_screen s;
        paper_line_screen(&line, &s, NULL);
        paper_screen_destroy(&s);
    }
    close(descriptor);
    unlink(damaged);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(screen_fits_its_ink),
        cmocka_unit_test(kerning_pulls_letters_together),
        cmocka_unit_test(size_and_tracking_scale),
        cmocka_unit_test(utf8_is_read_and_checked),
        cmocka_unit_test(missing_glyphs_are_reported),
        cmocka_unit_test(empty_text_leaves_no_mark),
        cmocka_unit_test(wrong_fonts_are_named),
        cmocka_unit_test(wrong_sizes_are_refused),
        cmocka_unit_test(type_is_placed_turned_and_filtered),
        cmocka_unit_test(type_is_set_in_columns),
        cmocka_unit_test(what_a_font_lacks_comes_from_another),
        cmocka_unit_test(damaged_fonts_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
