/* test_pages.c - documents as pages: all that a document says stands on a page, notes at the
 * foot or in the margin, tables as columns or row by row; and documents that are made to be
 * hard. */
#include <reader_document.h>
#include <reader_pages.h>
#include <reader_template.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "without_library.h"

struct made {
    struct reader_document *document;
    struct reader_pages *pages;
    struct page_text *text;
    int count;
};

static struct made make(const char *markdown, const struct reader_pages_setup *setup)
{
    struct made m;
    assert_int_equal(reader_document_create(&m.document), READER_OK);
    if (reader_document_add(m.document, markdown, strlen(markdown)) != READER_OK ||
        reader_document_refer(m.document) != READER_OK ||
        reader_pages_make(m.document, setup, &m.pages) != READER_OK)
        fail_msg("%s", reader_error());
    m.text = reader_pages_text(m.pages);
    assert_int_equal(page_count(m.text, &m.count), FONT_OK);
    return m;
}

static void made_finish(struct made *m)
{
    reader_pages_destroy(m->pages);
    reader_document_destroy(m->document);
}

static struct reader_pages_setup plain_setup(void)
{
    struct reader_pages_setup setup = reader_pages_setup_default();
    setup.font = "DejaVuSerif";
    setup.size_px = 12;
    setup.running = false;
    return setup;
}

struct seen {
    struct font_layout layout;
    struct page_said said;
};

static struct seen look(struct made *m, int page)
{
    struct seen s;
    assert_int_equal(page_layout_said(m->text, page, &s.layout, &s.said), FONT_OK);
    return s;
}

static void seen_finish(struct seen *s)
{
    font_layout_finish(&s->layout);
    page_said_finish(&s->said);
}

/* The first glyph of a text that the page says. */
static const struct font_placed *glyph_of(const struct seen *s, const char *text)
{
    const char *at = strstr(s->said.utf8, text);
    if (!at)
        fail_msg("'%s' is not said in\n%s", text, s->said.utf8);
    for (int i = 0; at && i < s->layout.glyphs_count; i++)
        if (s->layout.glyphs[i].cluster == (int)(at - s->said.utf8))
            return &s->layout.glyphs[i];
    fail_msg("'%s' has no glyph", text);
    return NULL;
}

/* ---- tests ---- */

static void all_kinds_of_blocks_are_said(void **state)
{
    (void)state;
    const struct reader_pages_setup setup = plain_setup();
    struct made m =
        make("# One\n\nText *slanted* `code` $x^2$.\n\n- item\n\n> quote\n\n"
             "```\nfenced\n\tline\n```\n\n$$y_1$$\n\n***\n\n![caption](file.png)\n\n"
             "<video>html</video>\n\n<p align=right>told</p>\n\n| a | b |\n|---|--:|\n| c | d "
             "|\n\n- [x] done\n",
             &setup);
    static const char *const parts[] = {"One\n",
                                        "Text slanted code $x^2$.\n",
                                        "\xe2\x80\xa2\xe2\x80\x82item",
                                        "quote",
                                        "fenced\n    line",
                                        "y_1",
                                        "* * *",
                                        "caption [file.png]",
                                        "<video>html</video>",
                                        "\ntold\n",
                                        "a\tb\n",
                                        "c\td\n",
                                        "done"};
    struct seen s = look(&m, 0);
    assert_int_equal(m.count, 1);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (!strstr(s.said.utf8, parts[i]))
            fail_msg("'%s' is not said in\n%s", parts[i], s.said.utf8);
    /* Roles: a heading of level 1, an item, a quote. */
    unsigned roles = 0;
    for (int i = 0; i < s.said.passages_count; i++)
        roles |= 1u << s.said.passages[i].role;
    assert_int_equal(
        roles & (1u << FONT_ROLE_HEADING | 1u << FONT_ROLE_ITEM | 1u << FONT_ROLE_QUOTE),
        1u << FONT_ROLE_HEADING | 1u << FONT_ROLE_ITEM | 1u << FONT_ROLE_QUOTE);
    /* Looks: letters of other faces; what hangs, hangs. */
    const struct font_placed *text = glyph_of(&s, "Text"), *slanted = glyph_of(&s, "slanted"),
                             *code = glyph_of(&s, "code"), *item = glyph_of(&s, "item"),
                             *bullet = glyph_of(&s, "\xe2\x80\xa2");
    assert_true(text->face != slanted->face && slanted->face != code->face);
    assert_true(bullet->x_px < item->x_px && item->x_px > text->x_px);
    assert_true(fabs(item->x_px - 64 - 18) < 0.6); /* the margin and an indent */
    assert_int_equal(s.layout.missing_count, 0);
    seen_finish(&s);
    made_finish(&m);
}

static void notes_stand_where_they_are_called(void **state)
{
    (void)state;
    struct reader_pages_setup setup = plain_setup();
    setup.notes_px = 150;
    struct made m = make("Word[^a] other[^margin:b] more[^a].\n\n[^a]: At the foot[^c].\n"
                         "[^margin:b]: Beside.\n[^c]: Behind it.\n",
                         &setup);
    struct seen s = look(&m, 0);
    const struct font_placed *word = glyph_of(&s, "Word"), *foot = glyph_of(&s, "At the"),
                             *beside = glyph_of(&s, "Beside"), *behind = glyph_of(&s, "Behind");
    assert_true(foot->y_px > 700 && behind->y_px > foot->y_px);
    assert_true(beside->x_px > 400 && fabs(beside->y_px - word->y_px) < 30);
    const char *first = strstr(s.said.utf8, "At the");
    assert_null(strstr(first + 1, "At the")); /* once, though it is called twice */
    seen_finish(&s);
    made_finish(&m);
}

static void tables_have_columns_or_are_told(void **state)
{
    (void)state;
    struct reader_pages_setup setup = plain_setup();
    const char *table = "| first | second | third |\n|---|:-:|--:|\n| a | bb | 1 |\n| a longer "
                        "cell | b | 222 |\n";
    struct made m = make(table, &setup);
    struct seen s = look(&m, 0);
    double one = glyph_of(&s, "1\n")->x_px, two = glyph_of(&s, "222")->x_px;
    assert_true(fabs(glyph_of(&s, "first")->x_px - glyph_of(&s, "a longer")->x_px) < 0.01);
    assert_true(one > two && one - two < 3 * setup.size_px); /* right */
    assert_true(glyph_of(&s, "second")->x_px > glyph_of(&s, "first")->x_px);
    assert_true(fabs(glyph_of(&s, "bb")->y_px - glyph_of(&s, "1\n")->y_px) < 0.01);
    seen_finish(&s);
    made_finish(&m);
    setup.width_px = 250; /* narrow: nothing is lost */
    m = make(table, &setup);
    s = look(&m, 0);
    assert_non_null(strstr(s.said.utf8, "first: a longer cell\nsecond: b\nthird: 222\n"));
    seen_finish(&s);
    made_finish(&m);
}

/* It is not taken for a part of the list before it, nor for a paragraph. */
static void quotes_stand_apart(void **state)
{
    (void)state;
    struct reader_pages_setup setup = plain_setup();
    struct made m =
        make("- one\n- two\n\n> three\n>\n> > four\n>\n> five\n\nsix\n\nseven\n", &setup);
    struct seen s = look(&m, 0);
    static const char *const words[] = {"one", "two", "three", "four", "five", "six", "seven"};
    double y[7], gap[6];
    for (int i = 0; i < 7; i++)
        y[i] = glyph_of(&s, words[i])->y_px;
    for (int i = 0; i < 6; i++)
        gap[i] = y[i + 1] - y[i];
    for (int i = 1; i < 5; i++)
        assert_true(gap[i] > fmax(gap[0], gap[5]) + 0.1 * setup.size_px);
    seen_finish(&s);
    made_finish(&m);
}

/* How wide a letter of the code in a quote's item is whose line has so many; *lines: of the
 * page's lines the code's line has so many. */
static double code_letter(const struct reader_pages_setup *setup, int letters, int *lines)
{
    char markdown[600] = "> - ```\n>   a\n>   ";
    for (int i = 0; i < letters; i++)
        strcat(markdown, "x");
    strcat(markdown, "   \n>   \xe4\xb8\xad\n>   ```\n\nafter\n");
    struct made m = make(markdown, setup);
    struct seen s = look(&m, 0);
    const struct font_placed *first = glyph_of(&s, "xx"), *wide = glyph_of(&s, "\xe4\xb8\xad");
    const double letter = first[1].x_px - first->x_px,
                 right = setup->width_px - setup->margin_px;
    *lines = 1;
    for (int i = 1; i < letters; i++) {
        assert_true(first[i].x_px + letter <= right - 1.5 * setup->size_px + 0.01);
        *lines += first[i].y_px > first[i - 1].y_px;
    }
    assert_true(wide->y_px > first[letters - 1].y_px);
    seen_finish(&s);
    made_finish(&m);
    return letter;
}

/* All of a block of code is as much smaller as its widest line needs; where that would be too
 * small to be read it is as large as other code, and broken. */
static void wide_code_is_made_smaller(void **state)
{
    enum { FITS = 30, MOST = 120 };
    const double step = 0.05, least = 0.6;
    struct reader_pages_setup setup = plain_setup();
    int lines, fewest = 0, broken = 0;
    (void)state;
    const double usual = code_letter(&setup, FITS, &lines);
    assert_int_equal(lines, 1);
    const double room = setup.width_px - 2 * setup.margin_px - (3 * 1.5 + 1) * 12;
    for (int letters = FITS; letters < MOST && broken < 3; letters++) {
        const double letter = code_letter(&setup, letters, &lines);
        if (lines > 1) {
            assert_true(fabs(letter - usual) < 0.001);
            assert_true(usual * least * letters > room);
            broken++;
            continue;
        }
        assert_int_equal(broken, 0);
        assert_true(letter > least * usual - 0.001);
        if (letter > usual - 0.001)
            continue;
        assert_true((letter + step * usual) * letters > room - 0.01); /* no smaller */
        fewest = fewest ? fewest : letters;
    }
    assert_true(fewest > FITS && broken == 3);
    setup.width_px *= 2; /* there it has room */
    assert_true(fabs(code_letter(&setup, fewest, &lines) - usual) < 0.001);
}

/* A formula on its own line that is too wide is set smaller, and stays in its column. */
static void wide_formulas_are_made_smaller(void **state)
{
    (void)state;
    struct reader_pages_setup setup = plain_setup();
    char markdown[1200] = "$$a";
    for (int i = 0; i < 40; i++)
        strcat(markdown, " + \\frac{b_1}{c}");
    strcat(markdown, "$$\n\n$$\\frac{b_1}{c}$$\n\n$\\foo$\n");
    struct made m = make(markdown, &setup);
    struct seen s = look(&m, 0);
    float least = INFINITY, most = 0;
    int unknown;
    for (int i = 0; i < s.layout.glyphs_count; i++) {
        const struct font_placed *g = &s.layout.glyphs[i];
        assert_true(g->x_px >= 63 && g->x_px <= 600 - 63);
        if (g->map) /* a bar */
            continue;
        least = g->size_px < least ? g->size_px : least;
        most = g->size_px > most ? g->size_px : most;
    }
    assert_true(least < 0.6F * most);
    assert_string_equal(reader_pages_unknown(m.pages, &unknown), "\\foo");
    assert_int_equal(unknown, 1);
    seen_finish(&s);
    made_finish(&m);
}

/* Columns of black and white, one pixel wide; the right half red. */
static bool stripes(void *user, int source, const char *target, struct reader_picture *out)
{
    int *asked = user;
    assert_int_equal(source, 0);
    ++*asked;
    if (strcmp(target, "there.png") != 0)
        return false;
    *out = (struct reader_picture){.width_px = 2400, .height_px = 1200};
    out->rgb = malloc((size_t)3 * 2400 * 1200);
    assert_non_null(out->rgb);
    for (size_t i = 0; i < (size_t)2400 * 1200; i++) {
        bool right = i % 2400 >= 1200;
        out->rgb[3 * i] = right || i % 2 ? 255 : 0;
        out->rgb[3 * i + 1] = out->rgb[3 * i + 2] = !right && i % 2 ? 255 : 0;
    }
    return true;
}

/* As wide as the column, its light kept, its caption under it; one that is not found is
 * told. */
static void pictures_are_shown(void **state)
{
    (void)state;
    struct reader_pages_setup setup = plain_setup();
    int asked = 0;
    setup.picture = stripes;
    setup.picture_user = &asked;
    setup.width_px = 428; /* a column of 300: eight columns of the picture become one */
    struct made m = make("Before.\n\n![The caption](there.png)\n\n![Not](found.png)\n", &setup);
    struct seen s = look(&m, 0);
    const struct font_placed *picture = glyph_of(&s, "there.png"),
                             *caption = glyph_of(&s, "The caption"),
                             *before = glyph_of(&s, "Before");
    assert_int_equal(asked, 2);
    assert_true(picture->ink > 0 && picture->map > 0);
    const struct font_ink *ink = &s.layout.inks[picture->ink - 1];
    assert_int_equal(ink->kind, FONT_INK_PICTURE);
    assert_int_equal(ink->width_px, 300);
    assert_int_equal(ink->height_px, 150);
    assert_true(fabs(ink->x0 - 64) < 0.01); /* the ink is where the box is */
    assert_true(ink->y0 > before->y_px && fabs(ink->y0 + 150 - picture->y_px) < 60);
    assert_true(caption->y_px > ink->y0 + 150 && caption->y_px < ink->y0 + 190);
    assert_in_range(ink->rgb[0], 186, 190); /* half the light, not half the number */
    assert_int_equal(ink->rgb[3 * 299], 255);
    assert_int_equal(ink->rgb[3 * 299 + 1], 0);
    assert_null(strstr(s.said.utf8, "caption [there.png]"));
    assert_non_null(strstr(s.said.utf8, "Not [found.png]"));
    seen_finish(&s);
    made_finish(&m);
}

/* The picture that a text's letters are. */
static const struct font_ink *picture_of(const struct seen *s, const char *text)
{
    const struct font_placed *glyph = glyph_of(s, text);
    assert_true(glyph->ink > 0);
    assert_int_equal(s->layout.inks[glyph->ink - 1].kind, FONT_INK_PICTURE);
    return &s->layout.inks[glyph->ink - 1];
}

/* In lists and quotes they stand within what these are moved in by; in lines and notes, too; as
 * large as a tag asks. */
static void pictures_stand_where_they_are_said(void **state)
{
    (void)state;
    struct reader_pages_setup setup = plain_setup();
    int asked = 0;
    setup.picture = stripes;
    setup.picture_user = &asked;
    setup.height_px = 1600;
    const double left = setup.margin_px, em = setup.size_px,
                 width = setup.width_px - 2 * setup.margin_px;
    struct made m = make("- a\n  - b\n\n    ![c](there.png)\n\n> ![d](there.png)\n\n"
                         "<p align=right><img src=there.png width=60 alt=e></p>\n\n"
                         "Small <img src=there.png height=10 alt=f> behind. Tall "
                         "![g](there.png) after[^1].\n\n[^1]: h\n\n    ![i](there.png)\n",
                         &setup);
    struct seen s = look(&m, 0);
    const struct font_ink *list = NULL, *quote = NULL, *own = NULL;
    int pictures = 0;
    for (int i = 0; i < s.layout.glyphs_count; i++) {
        const struct font_placed *g = &s.layout.glyphs[i];
        const struct font_ink *ink = g->ink > 0 ? &s.layout.inks[g->ink - 1] : NULL;
        if (!ink || ink->kind != FONT_INK_PICTURE)
            continue;
        list = pictures == 0 ? ink : list;
        quote = pictures == 1 ? ink : quote;
        own = pictures == 2 ? ink : own;
        pictures++;
    }
    assert_int_equal(pictures, 6);
    assert_true(fabs(list->x0 - left - 3 * em) <= 1 && list->width_px <= width - 3 * em + 1);
    assert_true(list->width_px > width - 3 * em - 2);
    assert_true(fabs(quote->x0 - left - 1.5 * em) <= 1);
    assert_true(fabs(quote->x0 + quote->width_px - left - width + 1.5 * em) <= 2);
    assert_int_equal(own->width_px, 60);
    assert_true(fabs(own->x0 + 60 - left - width) <= 1);
    const struct font_ink *small = picture_of(&s, "f behind"),
                          *tall = picture_of(&s, "g\nafter");
    assert_int_equal(small->height_px, 10);
    assert_true(fabs(small->y0 + 10 - glyph_of(&s, "Small")->y_px) < 1);
    assert_int_equal(tall->width_px, (int)width);
    assert_true(tall->y0 > glyph_of(&s, "Tall")->y_px);
    assert_true(tall->y0 + tall->height_px < glyph_of(&s, "after")->y_px);
    const struct font_ink *note = picture_of(&s, "-\ni"); /* its caption below */
    assert_true(note->y0 > glyph_of(&s, "h\n")->y_px && note->height_px <= 10 * em);
    assert_true(note->y0 + note->height_px < glyph_of(&s, "i\n")->y_px);
    seen_finish(&s);
    made_finish(&m);
}

static char *repeated(const char *before, const char *part, int count, const char *after)
{
    size_t n = strlen(part);
    char *text = malloc(strlen(before) + n * (size_t)count + strlen(after) + 1);
    assert_non_null(text);
    char *at = stpcpy(text, before);
    for (int i = 0; i < count; i++)
        at = stpcpy(at, part);
    strcpy(at, after);
    return text;
}

/* Pages have the columns of a template's grid, and their notes beside them. */
static void columns_are_those_of_a_template(void **state)
{
    (void)state;
    struct reader_template t;
    struct reader_pages_setup setup = plain_setup();
    setup.width_px = 1200;
    setup.height_px = 300;
    assert_int_equal(reader_template_named("two-columns", &t), READER_OK);
    reader_template_grid(&t, setup.width_px, setup.size_px, true, &setup.grid);
    assert_int_equal(setup.grid.texts, 2);
    char *text =
        repeated("Begin[^margin:n] ", "reeds and water ", 200, "end.\n\n[^margin:n]: Noted.\n");
    struct made m = make(text, &setup);
    struct seen s = look(&m, 0);
    int inside[2] = {0};
    for (int i = 0; i < s.layout.glyphs_count; i++)
        for (int k = 0; k < 2; k++) {
            const struct reader_region *r = &setup.grid.text[k];
            inside[k] += s.layout.glyphs[i].x_px >= r->x - 6 &&
                         s.layout.glyphs[i].x_px <= r->x + r->width;
        }
    assert_true(inside[0] > 300 && inside[1] > 300);
    assert_true(inside[0] + inside[1] >= s.layout.glyphs_count - 10); /* and the note */
    const struct font_placed *note = glyph_of(&s, "Noted");
    const struct reader_region *r = &setup.grid.text[0];
    assert_true(note->x_px >= r->notes_x && note->x_px < r->notes_x + r->notes_width);
    seen_finish(&s);
    made_finish(&m);
    free(text);
}

/* Figures and formulas with labels stand with their numbers, and references say them. */
static void numbers_are_said(void **state)
{
    (void)state;
    const struct reader_pages_setup setup = plain_setup();
    struct made m = make("By [#](#law) and [#](#pond).\n\n<a id=\"law\"></a> $$x = y$$\n\n"
                         "$$z$$\n\n<a id=\"pond\"></a>\n![A pond](pond.png)\n",
                         &setup);
    struct seen s = look(&m, 0);
    const struct font_placed *number = glyph_of(&s, "(1)\n");
    assert_non_null(strstr(s.said.utf8, "By (1) and Figure 1.\n"));
    assert_non_null(strstr(s.said.utf8, "x = y\xe2\x80\x83(1)\n"));
    assert_non_null(strstr(s.said.utf8, "z\n"));
    assert_non_null(strstr(s.said.utf8, "Figure 1: A pond [pond.png]"));
    assert_true(fabs(number->y_px - glyph_of(&s, "x = y")->y_px) < 1); /* in the same line */
    assert_true(number->x_px > glyph_of(&s, "x = y")->x_px);
    seen_finish(&s);
    made_finish(&m);
}

/* Deep, long, wide and many: set, in little time and without a line over the edge of what there
 * is. */
static void hostile_documents_are_set(void **state)
{
    (void)state;
    struct reader_pages_setup setup = plain_setup();
    setup.hyphenate = false;
    static const struct {
        const char *before, *part;
        int count;
        const char *after;
    } rows[] = {{"", "> ", 1000, "deep\n"},      {"", "- ", 300, "deep\n"},
                {"", "*", 2000, "a\n"},          {"```\n", "xxxxxxxxxxxxxxxx", 3000, "\n```\n"},
                {"", "| a ", 100, "|\n|---|\n"}, {"word[^a]\n\n[^a]: x", "[^a]", 500, "\n"},
                {"", "$x$ ", 400, "\n"},         {"$$", "{", 200, "$$\n"},
                {"", "![a](b) ", 500, "\n"},     {"", "# h\n", 200, ""}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char *text = repeated(rows[i].before, rows[i].part, rows[i].count, rows[i].after);
        struct made m = make(text, &setup);
        assert_true(m.count >= 1);
        made_finish(&m);
        free(text);
    }
}

static void wrong_setups_are_refused(void **state)
{
    (void)state;
    struct reader_document *d;
    struct reader_pages *pages;
    assert_int_equal(reader_document_create(&d), READER_OK);
    struct reader_pages_setup setup = plain_setup();
    setup.margin_px = 400;
    assert_int_equal(reader_pages_make(d, &setup, &pages), READER_BAD_ARGUMENT);
    assert_null(pages);
    setup = plain_setup();
    setup.columns = 0;
    assert_int_equal(reader_pages_make(d, &setup, &pages), READER_BAD_ARGUMENT);
    setup = plain_setup();
    setup.font = "nobody's";
    assert_int_equal(reader_pages_make(d, &setup, &pages), READER_FAILED);
    assert_non_null(strstr(reader_error(), "nobody's"));
    setup = plain_setup(); /* a font for formulas that is none, once there is one */
    setup.math = "DejaVuSansMono";
    assert_int_equal(reader_pages_make(d, &setup, &pages), READER_OK);
    reader_pages_destroy(pages);
    assert_int_equal(reader_document_add(d, "$x$", 3), READER_OK);
    assert_int_equal(reader_pages_make(d, &setup, &pages), READER_FAILED);
    assert_non_null(strstr(reader_error(), "MATH"));
    reader_document_destroy(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_kinds_of_blocks_are_said),
        cmocka_unit_test(notes_stand_where_they_are_called),
        cmocka_unit_test(tables_have_columns_or_are_told),
        cmocka_unit_test(quotes_stand_apart),
        cmocka_unit_test(wide_code_is_made_smaller),
        cmocka_unit_test(wide_formulas_are_made_smaller),
        cmocka_unit_test(pictures_are_shown),
        cmocka_unit_test(columns_are_those_of_a_template),
        cmocka_unit_test(pictures_stand_where_they_are_said),
        cmocka_unit_test(numbers_are_said),
        cmocka_unit_test(hostile_documents_are_set),
        cmocka_unit_test(wrong_setups_are_refused),
    };
    if (without_library())
        return 77;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
