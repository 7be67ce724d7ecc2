/* test_lines.c - text in columns: the places of line breaks and of lines, and random text. */
#include "support.h"

#include <text.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char marsh[] =
    "The water of a marsh carries pigment through the fibers of a sheet; what it leaves "
    "at its rim dries dark.";

struct fixture {
    struct font_face *face;
    struct font_shaper *shaper;
    struct font_layout layout;
};

static void begin(struct fixture *f, const char *font)
{
    *f = (struct fixture){.face = face_open(font)};
    f->shaper = shaper_make(f->face);
}

static const struct font_layout *set(struct fixture *f, const char *text,
                                     const struct font_text_options *options)
{
    font_layout_finish(&f->layout);
    assert_font(font_shaper_layout(f->shaper, text, strlen(text), 20, options, &f->layout));
    return &f->layout;
}

static void end(struct fixture *f)
{
    font_layout_finish(&f->layout);
    font_shaper_destroy(f->shaper);
    font_face_close(f->face);
}

/* The first and the last byte of a line's letters. */
static void line_bytes(const struct font_layout *l, int line, int *first, int *last)
{
    *first = 1 << 30;
    *last = -1;
    for (int i = 0; i < l->lines[line].glyphs_count; i++) {
        int at = l->glyphs[l->lines[line].glyphs_begin + i].cluster;
        *first = at < *first ? at : *first;
        *last = at > *last ? at : *last;
    }
}

static void lines_are_broken_at_spaces(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, "DejaVuSans");
    for (double width = 120; width < 900; width += 61) {
        struct font_text_options options = {.width_px = width};
        const struct font_layout *l = set(&f, marsh, &options);
        assert_true(l->lines_count > 1 || width > 800);
        int expected = 0;
        for (int i = 0; i < l->lines_count; i++) {
            int first, last;
            line_bytes(l, i, &first, &last);
            if (first != expected || l->lines[i].width_px > width)
                fail_msg("%g: line %d begins at %d for %d and is %g wide", width, i, first,
                         expected, l->lines[i].width_px);
            assert_true(l->lines[i].ends_paragraph == (i == l->lines_count - 1));
            if (i < l->lines_count - 1) {
                assert_true(marsh[last] != ' ' && marsh[last + 1] == ' ');
                /* The next word would not have fitted into the line. */
                size_t word = strcspn(marsh + last + 2, " ");
                struct font_layout longer;
                assert_font(font_shaper_layout(f.shaper, marsh + first,
                                               (size_t)(last + 2 - first) + word, 20, NULL,
                                               &longer));
                assert_true(longer.width_px > width);
                font_layout_finish(&longer);
            }
            expected = last + 2;
        }
    }
    end(&f);
}

static void a_wide_column_changes_nothing(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, "EBGaramond12-Regular");
    struct font_layout plain;
    assert_font(font_shaper_layout(f.shaper, marsh, strlen(marsh), 20, NULL, &plain));
    struct font_text_options options = {.width_px = plain.width_px};
    const struct font_layout *l = set(&f, marsh, &options);
    assert_int_equal(l->lines_count, 1);
    assert_int_equal(l->glyphs_count, plain.glyphs_count);
    for (int i = 0; i < plain.glyphs_count; i++)
        assert_true(l->glyphs[i].glyph == plain.glyphs[i].glyph &&
                    fabs(l->glyphs[i].x_px - plain.glyphs[i].x_px) < 1e-9);
    font_layout_finish(&plain);
    end(&f);
}

static void lines_stand_on_their_side(void **state)
{
    (void)state;
    enum { WIDTH = 230 };
    struct fixture f;
    begin(&f, "DejaVuSans");
    static const double parts[] = {0, 0, 1, 0.5, 0};
    for (int align = FONT_ALIGN_START; align <= FONT_ALIGN_JUSTIFY; align++) {
        struct font_text_options options = {.width_px = WIDTH, .align = (enum font_align)align};
        const struct font_layout *l = set(&f, marsh, &options);
        assert_true(l->width_px == WIDTH && l->lines_count > 3);
        for (int i = 0; i < l->lines_count; i++) {
            const struct font_line *line = &l->lines[i];
            bool fills = align == FONT_ALIGN_JUSTIFY && !line->ends_paragraph;
            assert_true(fills ? line->width_px == WIDTH : line->width_px < WIDTH);
            assert_true(fabs(line->x_px - parts[align] * (WIDTH - line->width_px)) < 1e-9);
            assert_true(fabs(l->glyphs[line->glyphs_begin].x_px - line->x_px) < 1e-6);
            /* The last glyph's advance ends at the line's end. */
            const struct font_placed *last =
                &l->glyphs[line->glyphs_begin + line->glyphs_count - 1];
            double advance;
            assert_font(font_face_advance(last->face, last->glyph, &advance));
            assert_true(fabs(last->x_px + advance * 20 / 2048 - line->x_px - line->width_px) <
                        1e-6);
        }
    }
    /* Without a column width, lines are aligned within the longest line. */
    struct font_text_options right = {.align = FONT_ALIGN_RIGHT};
    const struct font_layout *l = set(&f, "long line\nI", &right);
    assert_true(l->lines[0].x_px == 0);
    assert_true(fabs(l->lines[1].x_px + l->lines[1].width_px - l->width_px) < 1e-9);
    end(&f);
}

static void words_too_long_are_broken_between_letters(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, "DejaVuSans");
    struct font_text_options options = {.width_px = 1};
    /* In a column too narrow for a letter each letter gets a line; an accent stays with its
     * letter. */
    const struct font_layout *l = set(&f, "oe\xcc\x81v", &options);
    assert_int_equal(l->lines_count, 3);
    options.width_px = 60;
    l = set(&f, "mmmmmmmmmmmmmm", &options);
    assert_int_equal(l->lines_count, 5); /* 19.5 pixels each */
    /* A soft hyphen is drawn only where a line ends at it. */
    l = set(&f, "extra\xc2\xadordinary", &options);
    assert_int_equal(l->lines_count, 3);
    const struct font_placed *last = &l->glyphs[l->lines[0].glyphs_count - 1];
    assert_int_equal(last->glyph, font_face_glyph(f.face, 0x2010));
    assert_int_equal(last->cluster, 5);
    options.width_px = 300;
    struct font_layout plain;
    assert_font(font_shaper_layout(f.shaper, "extraordinary", 13, 20, NULL, &plain));
    l = set(&f, "extra\xc2\xadordinary", &options);
    assert_true(l->lines_count == 1 && fabs(l->lines[0].width_px - plain.width_px) < 0.5);
    font_layout_finish(&plain);
    end(&f);
}

static void lines_to_the_left_begin_at_the_right(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, "DejaVuSans");
    static const char hebrew[] =
        "\xd7\x90\xd7\x91\xd7\x92 \xd7\x93\xd7\x94\xd7\x95 abc \xd7\x96\xd7\x97\xd7\x98 def "
        "\xd7\x99\xd7\x9b\xd7\x9c";
    struct font_text_options options = {.width_px = 100};
    const struct font_layout *l = set(&f, hebrew, &options);
    assert_true(l->lines_count >= 2);
    int before = -1;
    for (int i = 0; i < l->lines_count; i++) {
        int first, last;
        line_bytes(l, i, &first, &last);
        assert_true(first > before && l->lines[i].to_left);
        assert_true(fabs(l->lines[i].x_px + l->lines[i].width_px - 100) < 1e-9);
        before = last;
    }
    /* In a right-to-left line the first letter is at the right end. */
    assert_int_equal(l->glyphs[l->lines[0].glyphs_count - 1].cluster, 0);
    end(&f);
}

static void a_width_that_cannot_be_is_refused(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, "DejaVuSans");
    static const double widths[] = {-1, NAN, INFINITY};
    for (int i = 0; i < 3; i++) {
        struct font_text_options options = {.width_px = widths[i]};
        assert_int_equal(font_shaper_layout(f.shaper, "a", 1, 20, &options, &f.layout),
                         FONT_BAD_ARGUMENT);
    }
    end(&f);
}

/* Random letters of many scripts, marks, joiners, controls and damaged UTF-8, in columns of all
 * widths. Every line fits or holds one letter, every glyph belongs to a line, and lines follow
 * the text's order. */
static void random_text_is_set(void **state)
{
    (void)state;
    static const uint32_t from[] = {0x20,   0x21,   0x61,   0xad,   0xa0,   0x300,  0x5d0,
                                    0x628,  0x64b,  0x915,  0x94d,  0xe01,  0x200b, 0x200d,
                                    0x202b, 0x2028, 0x2066, 0x3042, 0x4e00, 0xfe0f, 0x1f600};
    struct fixture f;
    begin(&f, "DejaVuSans");
    uint32_t seed = 14;
    for (int n = 0; n < 600; n++) {
        char text[256];
        size_t count = 0;
        while (count < sizeof text - 8 && random_unit(&seed) > 0.01) {
            uint32_t c = from[(size_t)(random_unit(&seed) * 21)] +
                         (uint32_t)(random_unit(&seed) * random_unit(&seed) * 12);
            if (random_unit(&seed) < 0.02)
                text[count++] = (char)(0x80 + (int)(random_unit(&seed) * 127));
            if (c < 0x80)
                text[count++] = (char)c;
            else if (c < 0x800)
                count += (size_t)sprintf(text + count, "%c%c", 0xc0 | c >> 6, 0x80 | (c & 63));
            else if (c < 0x10000)
                count += (size_t)sprintf(text + count, "%c%c%c", 0xe0 | c >> 12,
                                         0x80 | (c >> 6 & 63), 0x80 | (c & 63));
            else
                count += (size_t)sprintf(text + count, "%c%c%c%c", 0xf0 | c >> 18,
                                         0x80 | (c >> 12 & 63), 0x80 | (c >> 6 & 63),
                                         0x80 | (c & 63));
        }
        struct font_text_options options = {
            .width_px = random_unit(&seed) < 0.2 ? 0 : 3 + 200 * random_unit(&seed),
            .align = (enum font_align)(random_unit(&seed) * 5),
            .letter_spacing_px = random_unit(&seed) < 0.3 ? 4 * random_unit(&seed) - 2 : 0,
            .no_fallback = true};
        font_layout_finish(&f.layout);
        assert_font(font_shaper_layout(f.shaper, text, count, 20, &options, &f.layout));
        const struct font_layout *l = &f.layout;
        int glyphs = 0, before = -1;
        for (int i = 0; i < l->lines_count; i++) {
            const struct font_line *line = &l->lines[i];
            int first, last;
            assert_int_equal(line->glyphs_begin, glyphs);
            glyphs += line->glyphs_count;
            line_bytes(l, i, &first, &last);
            if (line->glyphs_count)
                assert_true(first > before);
            before = last > before ? last : before;
            if (options.width_px > 0 && line->width_px > options.width_px + 1e-6 &&
                first < last)
                fail_msg("text %d: line %d is %g wide in %g", n, i, line->width_px,
                         options.width_px);
        }
        assert_int_equal(glyphs, l->glyphs_count);
    }
    end(&f);
}

static unsigned get(const uint8_t *p, int bytes)
{
    unsigned n = 0;
    for (int i = 0; i < bytes; i++)
        n = n << 8 | p[i];
    return n;
}

static void put(uint8_t *p, size_t value)
{
    for (int i = 0; i < 4; i++)
        p[i] = (uint8_t)(value >> (24 - 8 * i));
}

/* The font as WOFF, its tables as they are (which WOFF allows). */
static uint8_t *woff_make(const uint8_t *font, size_t bytes, size_t *out_bytes)
{
    enum { HEAD = 44, ROW = 20, SFNT_HEAD = 12, SFNT_ROW = 16 };
    size_t tables = get(font + 4, 2), at = HEAD + ROW * tables, unpacked = SFNT_HEAD;
    uint8_t *out = calloc(1, 2 * bytes + at);
    assert_non_null(out);
    for (size_t i = 0; i < tables; i++) {
        const uint8_t *row = font + SFNT_HEAD + SFNT_ROW * i;
        uint8_t *to = out + HEAD + ROW * i;
        size_t count = get(row + 12, 4);
        memcpy(to, row, 4);
        put(to + 4, at);
        put(to + 8, count);
        put(to + 12, count);
        memcpy(to + 16, row + 4, 4);
        memcpy(out + at, font + get(row + 8, 4), count);
        at += (count + 3) / 4 * 4;
        unpacked += SFNT_ROW + (count + 3) / 4 * 4;
    }
    memcpy(out, "wOFF", 4);
    memcpy(out + 4, font, 4);
    put(out + 8, at);
    put(out + 12, tables << 16);
    put(out + 16, unpacked);
    *out_bytes = at;
    return out;
}

/* Packed fonts are shaped as others are: with kerning, ligatures and marks. */
static void packed_fonts_are_shaped(void **state)
{
    (void)state;
    static const char text[] = "AVATAR, office, e\xcc\x81l\xc3\xa8ve To. fjord";
    static const char *const names[] = {"DejaVuSans", "EBGaramond12-Regular"};
    for (int n = 0; n < 2; n++) {
        struct fixture plain, packed = {0};
        size_t bytes, woff_bytes;
        begin(&plain, names[n]);
        const uint8_t *font = font_face_bytes(plain.face, &bytes);
        uint8_t *woff = woff_make(font, bytes, &woff_bytes);
        assert_font(font_face_open_memory(woff, woff_bytes, 0, &packed.face));
        packed.shaper = shaper_make(packed.face);
        const struct font_layout *a = set(&plain, text, NULL), *b = set(&packed, text, NULL);
        assert_int_equal(a->glyphs_count, b->glyphs_count);
        assert_true(a->glyphs_count < (int)strlen(text)); /* something is joined */
        for (int i = 0; i < a->glyphs_count; i++) {
            struct font_outline p, q;
            assert_int_equal(a->glyphs[i].glyph, b->glyphs[i].glyph);
            assert_true(a->glyphs[i].x_px == b->glyphs[i].x_px);
            assert_font(font_face_outline(plain.face, a->glyphs[i].glyph, &p));
            assert_font(font_face_outline(packed.face, a->glyphs[i].glyph, &q));
            assert_int_equal(p.segments_count, q.segments_count);
            font_outline_finish(&p);
            font_outline_finish(&q);
        }
        free(woff);
        end(&plain);
        end(&packed);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_are_broken_at_spaces),
        cmocka_unit_test(a_wide_column_changes_nothing),
        cmocka_unit_test(lines_stand_on_their_side),
        cmocka_unit_test(words_too_long_are_broken_between_letters),
        cmocka_unit_test(lines_to_the_left_begin_at_the_right),
        cmocka_unit_test(a_width_that_cannot_be_is_refused),
        cmocka_unit_test(random_text_is_set),
        cmocka_unit_test(packed_fonts_are_shaped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
