/* test_inset.c - boxes in lines: where they stand, what lines do with them, what pages say of
 * them. */
#include "support.h"

#include <edges.h>
#include <page.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PAGE_WIDTH = 400, LEFT = 50 };
static const double size = 20;

struct setting {
    struct page_text *text;
    struct font_face *face; /* of what the inset shows */
    int plain, inset;
    struct font_placed shown[2];
    struct font_map map;
};

/* A text with a plain style, and an inset of two glyphs 60 pixels wide. */
static struct setting setting_make(double ascent, double descent)
{
    struct setting s = {.face = face_open("DejaVuSans")};
    struct page_style style = page_style_default();
    const struct page_template template = {
        .width_px = PAGE_WIDTH + 2 * LEFT,
        .height_px = 900,
        .frames_count = 1,
        .frames = {{.x = LEFT, .y = 0, .width = PAGE_WIDTH, .height = 900}}};
    style.size_px = size;
    s.map = (struct font_map){FONT_AFFINE, {2, 0, 0, 0, 3, 0}};
    for (int i = 0; i < 2; i++)
        s.shown[i] = (struct font_placed){.face = s.face,
                                          .glyph = 40 + (uint32_t)i,
                                          .x_px = 30.0 * i,
                                          .y_px = -5.0 * i,
                                          .size_px = 11,
                                          .map = i};
    struct font_layout shown = {.glyphs = s.shown,
                                .glyphs_count = 2,
                                .maps = &s.map,
                                .maps_count = 1,
                                .size_px = 11,
                                .width_px = 60,
                                .ascent_px = ascent,
                                .descent_px = descent};
    assert_font(page_text_create(&s.text));
    assert_font(page_style_add(s.text, &style, &s.plain));
    assert_font(page_inset_add(s.text, &style, &shown, &s.inset));
    memset(s.shown, 0, sizeof s.shown); /* it was copied */
    assert_font(page_templates_set(s.text, &template, 1));
    return s;
}

static void setting_finish(struct setting *s)
{
    page_text_destroy(s->text);
    font_face_close(s->face);
}

static int add(struct setting *s, const char *text, const char *inset, double leading)
{
    int id;
    struct page_manner manner = page_manner_default();
    manner.leading_px = leading;
    assert_font(page_paragraph_add(s->text, 0, -1, text, strlen(text), s->plain, &manner, &id));
    for (const char *at = text; (at = strstr(at, inset)) != NULL; at += strlen(inset)) {
        int begin = (int)(at - text);
        assert_font(
            page_paragraph_style(s->text, id, begin, begin + (int)strlen(inset), s->inset));
    }
    return id;
}

/* Its glyphs stand where its letters would; what follows stands behind its width. */
static void inset_stands_in_the_place_of_its_letters(void **state)
{
    (void)state;
    struct setting s = setting_make(10, 4), plain = setting_make(10, 4);
    add(&s, "ab$x + y$c", "$x + y$", 0);
    add(&plain, "abc", "$", 0);
    struct font_layout l, p;
    assert_font(page_layout(s.text, 0, &l));
    assert_font(page_layout(plain.text, 0, &p));
    assert_int_equal(l.glyphs_count, 5);
    const struct font_placed *a = &l.glyphs[2], *b = &l.glyphs[3], *c = &l.glyphs[4];
    double end = glyph_end(&l.glyphs[1]);
    assert_true(a->face == s.face && a->glyph == 40 && b->glyph == 41);
    assert_true(fabs(a->x_px - end) < 0.01 && fabs(b->x_px - end - 30) < 0.01);
    assert_true(fabs(a->y_px - l.glyphs[0].y_px) < 0.01);
    assert_true(fabs(b->y_px - a->y_px + 5) < 0.01);
    assert_true(a->size_px == 11 && a->cluster == 2 && b->cluster == 2 && c->cluster == 9);
    assert_int_equal(a->map, 0);
    assert_true(b->map > 0 && l.maps[b->map - 1].m[0] == 2 && l.maps[b->map - 1].m[4] == 3);
    assert_true(fabs(c->x_px - p.glyphs[2].x_px - 60) < 0.5); /* but for kerning */
    assert_true(fabs(c->y_px - p.glyphs[2].y_px) < 0.01);
    assert_int_equal(l.missing_count, 0);
    font_layout_finish(&l);
    font_layout_finish(&p);
    setting_finish(&s);
    setting_finish(&plain);
}

/* No line ends within one, however many spaces its letters are; a caret stands before it and
 * behind. */
static void lines_are_not_broken_within(void **state)
{
    (void)state;
    struct setting s = setting_make(10, 4);
    char text[600] = "";
    for (int i = 0; i < 30; i++)
        strcat(text, "on $a b c$, ");
    int id = add(&s, text, "$a b c$", 0);
    struct font_layout l;
    assert_font(page_layout(s.text, 0, &l));
    int insets = 0, lines = 0;
    for (int i = 0; i < l.glyphs_count; i++) {
        const struct font_placed *g = &l.glyphs[i];
        lines = g->line + 1;
        if (g->face != s.face || g->glyph != 40)
            continue;
        insets++;
        assert_true(g->x_px + 60 <= LEFT + PAGE_WIDTH + 0.5);
        assert_int_equal(l.glyphs[i + 2].line, g->line); /* its comma */
    }
    assert_int_equal(insets, 30);
    assert_true(lines >= 8);
    font_layout_finish(&l);
    struct page_place place = {id, 3};
    assert_true(page_place_step(s.text, &place, true));
    assert_int_equal(place.byte, 10);
    assert_true(page_place_step(s.text, &place, false));
    assert_int_equal(place.byte, 3);
    setting_finish(&s);
}

/* A high one makes room for itself, whatever distance of lines was asked for; a low one
 * none. */
static void high_insets_have_room(void **state)
{
    (void)state;
    double firsts[2], leadings[2];
    for (int high = 0; high < 2; high++) {
        struct setting s = setting_make(high ? 70 : 5, high ? 30 : 2);
        struct font_layout l;
        add(&s, "a $x$ b\nc", "$x$", 24);
        assert_font(page_layout(s.text, 0, &l));
        firsts[high] = l.glyphs[0].y_px;
        leadings[high] = l.glyphs[l.glyphs_count - 1].y_px - firsts[high];
        font_layout_finish(&l);
        setting_finish(&s);
    }
    assert_true(fabs(leadings[0] - 24) < 0.01);
    assert_true(fabs(firsts[1] - 70) < 0.01 && fabs(leadings[1] - 100) < 0.01);
}

/* What a page says, and what is copied out of it, are the letters. */
static void pages_say_the_letters(void **state)
{
    (void)state;
    struct setting s = setting_make(10, 4);
    struct font_layout l;
    struct page_said said;
    add(&s, "ab$x + y$c", "$x + y$", 0);
    assert_font(page_layout_said(s.text, 0, &l, &said));
    assert_string_equal(said.utf8, "ab$x + y$c\n");
    font_layout_finish(&l);
    page_said_finish(&said);
    setting_finish(&s);
}

static void what_an_inset_lacks_is_told(void **state)
{
    (void)state;
    struct setting s = setting_make(10, 4);
    const struct page_style style = page_style_default();
    const struct font_layout shown = {
        .width_px = 9, .ascent_px = 9, .missing_count = 2, .missing = {0x4e2d, 0x6587}};
    struct font_layout l;
    assert_font(page_inset_add(s.text, &style, &shown, &s.inset));
    add(&s, "a FG b FG", "FG", 0);
    assert_font(page_layout(s.text, 0, &l));
    assert_int_equal(l.missing_count, 2);
    assert_int_equal(l.missing[0], 0x4e2d);
    assert_int_equal(l.missing[1], 0x6587);
    font_layout_finish(&l);
    setting_finish(&s);
}

static void wrong_insets_are_refused(void **state)
{
    (void)state;
    struct setting s = setting_make(10, 4);
    const struct page_style style = page_style_default();
    const struct font_layout wrong[] = {
        {.width_px = -1}, {.width_px = NAN}, {.ascent_px = INFINITY}, {.descent_px = 1e9}};
    int inset;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(page_inset_add(s.text, &style, &wrong[i], &inset), FONT_BAD_ARGUMENT);
    assert_int_equal(inset, -1);
    setting_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inset_stands_in_the_place_of_its_letters),
        cmocka_unit_test(lines_are_not_broken_within),
        cmocka_unit_test(high_insets_have_room),
        cmocka_unit_test(pages_say_the_letters),
        cmocka_unit_test(what_an_inset_lacks_is_told),
        cmocka_unit_test(wrong_insets_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
