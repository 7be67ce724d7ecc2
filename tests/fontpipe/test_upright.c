/* test_upright.c - lines that go down: which letters stand and which lie, and digits beside
 * each other in one place; where carets may be; and how lines of Arabic are filled. */
#include "support.h"

#include <edges.h>
#include <page.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 30 };

static struct page_text *text_begin(bool vertical)
{
    struct page_template page = {.width_px = 400, .height_px = 900, .frames_count = 1};
    struct page_style style = page_style_default();
    struct page_text *text;
    int id;
    page.frames[0] = (struct page_frame){.x = 20, .y = 20, .width = 360, .height = 860};
    page.frames[0].vertical = vertical;
    assert_font(page_text_create(&text));
    style.font = "DejaVuSans";
    style.size_px = SIZE;
    assert_font(page_style_add(text, &style, &id));
    assert_font(page_templates_set(text, &page, 1));
    return text;
}

static void utf8_put(char *out, size_t *at, uint32_t c)
{
    unsigned char *to = (unsigned char *)out + *at;
    if (c < 0x80) {
        to[0] = (unsigned char)c;
        *at += 1;
    } else if (c < 0x800) {
        to[0] = (unsigned char)(0xc0 | c >> 6);
        to[1] = (unsigned char)(0x80 | (c & 63));
        *at += 2;
    } else if (c < 0x10000) {
        to[0] = (unsigned char)(0xe0 | c >> 12);
        to[1] = (unsigned char)(0x80 | (c >> 6 & 63));
        to[2] = (unsigned char)(0x80 | (c & 63));
        *at += 3;
    } else {
        to[0] = (unsigned char)(0xf0 | c >> 18);
        to[1] = (unsigned char)(0x80 | (c >> 12 & 63));
        to[2] = (unsigned char)(0x80 | (c >> 6 & 63));
        to[3] = (unsigned char)(0x80 | (c & 63));
        *at += 4;
    }
    out[*at] = '\0';
}

/* The glyph of the character at a byte, and whether it lies. */
static const struct font_placed *glyph_at(const struct font_layout *l, int byte, bool *lies)
{
    for (int i = 0; i < l->glyphs_count; i++) {
        const struct font_placed *g = &l->glyphs[i];
        if (g->cluster != byte)
            continue;
        assert_true(g->map > 0);
        *lies = fabs(l->maps[g->map - 1].m[1] + 1) < 1e-9;
        assert_true(*lies || fabs(l->maps[g->map - 1].m[0] - 1) < 1e-9);
        return g;
    }
    fail_msg("no glyph for byte %d", byte);
    return NULL;
}

/* Letters and signs by UTR 50's table: S they stand, L they lie; D digits in one place (the
 * font has no forms for brackets). */
static void letters_stand_or_lie(void **state)
{
    (void)state;
    static const uint32_t characters[] = {
        0x65e5, '1',    '2',    0x6708, '5',     0x65e5, 0x3002, 0xff08, '2',
        '0',    '2',    '6',    0xff09, 0x5e74,  'A',    '4',    0x7d19, 0xa9,
        0x300c, 0x304b, 0x300d, 0x2192, 0x1f4a7, 0xac00, 'x',    0x301,  0x6f22};
    static const char want[] = "SDDSDSSLLLLLLSLLSSLSLLSSLLS";
    enum { COUNT = sizeof characters / sizeof *characters };
    char text[200] = "";
    int bytes[COUNT];
    size_t at = 0;
    assert_int_equal(strlen(want), COUNT);
    for (int i = 0; i < COUNT; i++) {
        bytes[i] = (int)at;
        utf8_put(text, &at, characters[i]);
    }
    struct page_text *t = text_begin(true);
    struct page_manner manner = page_manner_default();
    struct font_layout l = {0};
    int id;
    assert_font(page_paragraph_add(t, 0, -1, text, at, 0, &manner, &id));
    assert_font(page_layout(t, 0, &l));
    for (int i = 0; i < COUNT; i++) {
        bool lies;
        if (characters[i] == 0x301) /* a mark: it goes with its letter */
            continue;
        glyph_at(&l, bytes[i], &lies);
        if (lies != (want[i] == 'L'))
            fail_msg("U+%04X %s", (unsigned)characters[i], lies ? "lies" : "stands");
    }
    /* 12 is one place: at one height, side by side, around the line's middle, and the next is
     * an em below the last. */
    bool lies;
    const struct font_placed *before = glyph_at(&l, bytes[0], &lies),
                             *one = glyph_at(&l, bytes[1], &lies),
                             *two = glyph_at(&l, bytes[2], &lies),
                             *month = glyph_at(&l, bytes[3], &lies),
                             *five = glyph_at(&l, bytes[4], &lies);
    double width = glyph_end(two) - one->x_px, middle = one->x_px + width / 2;
    assert_true(fabs(one->y_px - two->y_px) < 1e-3 && two->x_px > one->x_px + 0.4 * SIZE);
    assert_true(fabs(five->x_px + (glyph_end(five) - five->x_px) / 2 - middle) < 1e-2);
    assert_true(one->y_px > before->y_px && month->y_px > one->y_px);
    assert_true(width < 1.4 * SIZE);
    font_layout_finish(&l);
    page_text_destroy(t);
}

/* How many characters each cluster has, as UAX 29 has it since Unicode 15.1. */
static void carets_stand_between_clusters(void **state)
{
    (void)state;
    static const struct {
        const char *what;
        uint32_t characters[10];
        int clusters[10];
    } cases[] = {
        {"letters", {'a', 'b'}, {1, 1}},
        {"accent", {'e', 0x301, 'b'}, {2, 1}},
        {"ksha", {0x915, 0x94d, 0x937}, {3}},
        {"ksha, joined", {0x915, 0x94d, 0x200d, 0x937}, {4}},
        {"ksha, parted", {0x915, 0x94d, 0x200c, 0x937}, {3, 1}},
        {"namaste", {0x928, 0x92e, 0x938, 0x94d, 0x924, 0x947}, {1, 1, 4}},
        {"nukta", {0x915, 0x93c, 0x94d, 0x937}, {4}},
        {"virama alone", {0x915, 0x94d, 'a'}, {2, 1}},
        {"three", {0x938, 0x94d, 0x924, 0x94d, 0x930, 0x940}, {6}},
        {"Bengali", {0x995, 0x9cd, 0x9b7, 0x995}, {3, 1}},
        {"Malayalam", {0xd15, 0xd4d, 0xd37}, {3}},
        {"Telugu", {0xc15, 0xc4d, 0xc37}, {3}},
        {"Gujarati", {0xa95, 0xacd, 0xab7}, {3}},
        {"Oriya", {0xb15, 0xb4d, 0xb37}, {3}},
        {"Tamil, which has no such rule", {0xb95, 0xbcd, 0xbb7}, {2, 1}},
        {"SARA AM", {0xe19, 0xe49, 0xe33, 0xe01}, {3, 1}},
        {"Lao AM", {0xe99, 0xec9, 0xeb3, 0xe81}, {3, 1}},
        {"family", {0x1f468, 0x200d, 0x1f469, 'a'}, {3, 1}},
        {"flags", {0x1f1eb, 0x1f1f7, 0x1f1e9, 0x1f1ea}, {2, 2}},
        {"joiner between letters", {0x628, 0x200d, 0x627}, {2, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct page_text *t = text_begin(false);
        struct page_manner manner = page_manner_default();
        char text[64] = "";
        size_t at = 0, bytes[12] = {0};
        int id, count = 0;
        while (cases[i].characters[count]) {
            utf8_put(text, &at, cases[i].characters[count]);
            bytes[++count] = at;
        }
        assert_font(page_paragraph_add(t, 0, -1, text, at, 0, &manner, &id));
        struct page_place place = {id, 0};
        int passed = 0;
        for (int k = 0; passed < count; k++) {
            passed += cases[i].clusters[k];
            assert_true(cases[i].clusters[k] > 0);
            bool more = page_place_step(t, &place, true);
            if (!more || (size_t)place.byte != bytes[passed])
                fail_msg("%s: caret %d at byte %d, %zu wanted", cases[i].what, k,
                         (int)place.byte, bytes[passed]);
        }
        page_text_destroy(t);
    }
}

/* Where a glyph stands behind the one before it in its line, by the bytes of both; 0: they are
 * not beside each other. */
static double gap_of(const struct font_layout *l, int from, int to)
{
    for (int i = 0; i + 1 < l->glyphs_count; i++)
        if (l->glyphs[i].cluster == from && l->glyphs[i + 1].cluster == to)
            return l->glyphs[i + 1].line == l->glyphs[i].line
                       ? l->glyphs[i + 1].x_px - l->glyphs[i].x_px
                       : 0;
    return 0;
}

/* Arabic's letters join, so no line is filled between them, nor by longer joints (kashida):
 * spaces take all of it. */
static void arabic_is_justified_by_its_spaces_alone(void **state)
{
    (void)state;
    static const char text[] =
        "\xd8\xa7\xd9\x84\xd9\x85\xd8\xa7\xd8\xa1 \xd9\x81\xd9\x8a "
        "\xd8\xa7\xd9\x84\xd9\x88\xd8\xb1\xd9\x82 \xd9\x8a\xd8\xad\xd9\x85\xd9\x84 "
        "\xd8\xa7\xd9\x84\xd8\xad\xd8\xa8\xd8\xb1 \xd8\xa8\xd9\x8a\xd9\x86 "
        "\xd8\xa7\xd9\x84\xd8\xa3\xd9\x84\xd9\x8a\xd8\xa7\xd9\x81 "
        "\xd9\x88\xd9\x8a\xd8\xaa\xd8\xb1\xd9\x83\xd9\x87 "
        "\xd8\xb9\xd9\x86\xd8\xaf \xd8\xa7\xd9\x84\xd8\xad\xd8\xa7\xd9\x81\xd8\xa9 "
        "\xd8\xad\xd9\x8a\xd8\xab \xd9\x8a\xd8\xac\xd9\x81 "
        "\xd8\xa7\xd9\x84\xd9\x88\xd8\xb1\xd9\x82 "
        "\xd9\x88\xd9\x8a\xd8\xb5\xd9\x8a\xd8\xb1 \xd8\xa7\xd9\x84\xd9\x84\xd9\x88\xd9\x86 "
        "\xd8\xba\xd8\xa7\xd9\x85\xd9\x82\xd8\xa7 \xd9\x88\xd8\xa7\xd8\xb6\xd8\xad\xd8\xa7";
    struct font_layout layouts[2] = {0};
    struct page_text *texts[2];
    for (int i = 0; i < 2; i++) {
        struct page_text *lines = text_begin(false);
        struct page_manner manner = page_manner_default();
        int id;
        manner.align = i ? FONT_ALIGN_JUSTIFY : FONT_ALIGN_RIGHT;
        assert_font(page_paragraph_add(lines, 0, -1, text, sizeof text - 1, 0, &manner, &id));
        assert_font(page_layout(lines, 0, &layouts[i]));
        texts[i] = lines;
    }
    const struct font_layout *a = &layouts[0], *b = &layouts[1];
    int within = 0, wider = 0;
    for (int i = 0; i + 1 < b->glyphs_count; i++) {
        int from = b->glyphs[i].cluster, to = b->glyphs[i + 1].cluster;
        double was = gap_of(a, from, to), is = gap_of(b, from, to);
        assert_true(b->glyphs[i].glyph != font_face_glyph(b->glyphs[i].face, 0x640));
        if (was == 0 || is == 0)
            continue;
        if (text[from] == ' ' || text[to] == ' ') {
            wider += fabs(is - was) > 0.3;
        } else {
            within++;
            if (fabs(is - was) > 0.02)
                fail_msg("bytes %d and %d: %.2f apart, %.2f before", from, to, is, was);
        }
    }
    assert_true(within > 40 && wider > 4);
    for (int i = 0; i < 2; i++) {
        font_layout_finish(&layouts[i]);
        page_text_destroy(texts[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_stand_or_lie),
        cmocka_unit_test(carets_stand_between_clusters),
        cmocka_unit_test(arabic_is_justified_by_its_spaces_alone),
    };
    return cmocka_run_group_tests_name("upright", tests, NULL, NULL);
}
