/* fuzz_fonts.c - draws or refuses a thousand damaged font files, ten thousand random outlines,
 * and random text, with the same seeds in every run. (security.md 7) */
#include "fuzz_face.h"
#include "fuzz_outline.h"
#include "support.h"

#include <text.h>

#include <stdlib.h>
#include <string.h>

enum { FILES = 1000, OUTLINES = 800, TEXTS = 400 };

static const char *const fonts[] = {"DejaVuSansMono", "EBGaramond12-Italic", TYPE_1_FONT};

/* Damages a file: changes bytes, blanks runs, copies pieces elsewhere, cuts off the end. Half
 * of the damage is in the first kilobyte, which lists the tables. */
static size_t damage(uint8_t *bytes, size_t count, uint32_t *seed)
{
    int kinds = 1 + (int)random_below(seed, 3);
    for (int k = 0; k < kinds; k++) {
        size_t region = random_below(seed, 2) && count > 1024 ? 1024 : count;
        size_t at = random_below(seed, region), length = 1 + random_below(seed, 64);
        length = length > count - at ? count - at : length;
        switch (random_below(seed, 6)) {
        case 0:
            for (int i = 0; i < 12; i++)
                bytes[random_below(seed, region)] = (uint8_t)random_next(seed);
            break;
        case 1:
            memset(bytes + at, random_below(seed, 2) ? 0xff : 0, length);
            break;
        case 2:
            memmove(bytes + at, bytes + random_below(seed, count - length), length);
            break;
        case 3:
            bytes[at] ^= (uint8_t)(1u << random_below(seed, 8));
            break;
        case 4: /* writes a large number, perhaps over a count or an offset */
            if (at + 4 <= count)
                memcpy(bytes + at, "\x7f\xff\xff\xff", 4);
            break;
        default:
            if (random_below(seed, 3) == 0)
                count = 1 + random_below(seed, count);
        }
    }
    return count;
}

static void damaged_fonts_are_drawn_or_refused(void **state)
{
    (void)state;
    uint32_t seed = 20260606;
    int drawn = 0;
    for (size_t f = 0; f < sizeof fonts / sizeof *fonts; f++) {
        struct font_face *face = face_open(fonts[f]);
        size_t whole;
        const uint8_t *bytes = font_face_bytes(face, &whole);
        uint8_t *copy = malloc(whole);
        assert_non_null(copy);
        for (int i = 0; i < (FILES + 2) / 3; i++) {
            memcpy(copy, bytes, whole);
            drawn += fuzz_face(copy, damage(copy, whole, &seed)) > 0;
        }
        free(copy);
        font_face_close(face);
    }
    print_message("of %d damaged fonts %d could be drawn with\n", FILES, drawn);
    assert_true(drawn > FILES / 20 && drawn < FILES);
}

static void random_outlines_are_drawn_or_refused(void **state)
{
    (void)state;
    uint32_t seed = 1990;
    int ink = 0;
    for (int i = 0; i < OUTLINES; i++) {
        uint8_t bytes[256];
        size_t count = 16 + random_below(&seed, sizeof bytes - 16);
        for (size_t k = 0; k < count; k++)
            bytes[k] = (uint8_t)(random_next(&seed) >> 11);
        ink += fuzz_outline(bytes, count);
    }
    print_message("%d of %d outlines had ink\n", ink, OUTLINES);
    assert_true(ink > OUTLINES / 4);
}

/* Inputs that libFuzzer has found: a long curve with few nodes and many pieces; a line that is
 * horizontal except for rounding. */
static void hard_outlines_are_drawn(void **state)
{
    (void)state;
    static const uint8_t long_curve[] = {
        0xb7, 0x01, 0x9b, 0xb5, 0x24, 0xff, 0x00, 0xd2, 0x00, 0x7f, 0x4a, 0xfb, 0x4a, 0xfb,
        0x23, 0x2b, 0x00, 0x41, 0x00, 0xaa, 0x00, 0x00, 0x23, 0x2b, 0x00, 0x41, 0x00, 0xaa,
        0x00, 0x00, 0x00, 0x1a, 0x00, 0xfe, 0x00, 0xfe, 0x64, 0x4a, 0x4a, 0x48, 0x4a};
    static const uint8_t level_line[] = {0x2b, 0xff, 0xff, 0x24, 0xff, 0x24, 0xff,
                                         0x2b, 0x00, 0x7f, 0x2b, 0x00, 0xa5, 0x01,
                                         0x00, 0xea, 0x00, 0x00, 0x0f, 0xf9, 0x00};
    assert_int_equal(fuzz_outline(long_curve, sizeof long_curve), 1);
    assert_int_equal(fuzz_outline(level_line, sizeof level_line), 1);
}

static void random_text_is_set(void **state)
{
    (void)state;
    static const char *const pieces[] = {"a",
                                         "fi",
                                         " ",
                                         "\n",
                                         "\xd7\x90",
                                         "\xd8\xa8",
                                         "\xcc\x81",
                                         "\xe2\x80\x8f",
                                         "\xe2\x80\xad",
                                         "\xff",
                                         "\xe2\x82",
                                         "\xf0\x9f",
                                         "(",
                                         "1",
                                         "\xe0\xa4\x95",
                                         "\xe0\xa5\x8d",
                                         "\t",
                                         "\r"};
    uint32_t seed = 7;
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *shaper;
    struct font_text_options alone = {.no_fallback = true};
    assert_font(font_shaper_create(face, &shaper));
    for (int i = 0; i < TEXTS; i++) {
        char text[400] = "";
        size_t count = 0;
        int parts = 1 + (int)random_below(&seed, 40);
        for (int k = 0; k < parts; k++) {
            const char *piece = pieces[random_below(&seed, sizeof pieces / sizeof *pieces)];
            memcpy(text + count, piece, strlen(piece));
            count += strlen(piece);
        }
        struct font_layout layout;
        alone.right_to_left = (int)random_below(&seed, 3) - 1;
        assert_font(font_shaper_layout(shaper, text, count, 12, &alone, &layout));
        assert_true(layout.lines_count >= 1);
        for (int g = 0; g < layout.glyphs_count; g++) {
            assert_true(layout.glyphs[g].cluster >= 0 && layout.glyphs[g].cluster < (int)count);
            assert_true(layout.glyphs[g].x_px > -1e4 && layout.glyphs[g].x_px < 1e4);
        }
        font_layout_finish(&layout);
    }
    font_shaper_destroy(shaper);
    font_face_close(face);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damaged_fonts_are_drawn_or_refused),
        cmocka_unit_test(random_outlines_are_drawn_or_refused),
        cmocka_unit_test(hard_outlines_are_drawn),
        cmocka_unit_test(random_text_is_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
