/* test_last_lines.c - last lines of paragraphs: seldom short, and no rests of words. */
#include "support.h"

#include <page.h>

#include <string.h>

enum { SIZE = 14 };

static const char marsh[] =
    "The water of a marsh carries pigment through the fibers of a sheet; what it leaves at its "
    "rim dries "
    "dark, and extraordinary hyphenation demonstrates itself wherever a representative of "
    "communication "
    "finds no satisfactory arrangement within the measurement of a newspaper's column.";

/* A paragraph's last line as a word's rest (the line before it ends in a hyphen that is behind
 * the text), or as a short one. */
static void last_line_see(const struct font_layout *l, const char *text, int *rests,
                          int *shorts)
{
    int n = l->glyphs_count, last = l->glyphs[n - 1].line, first = n;
    while (first > 0 && l->glyphs[first - 1].line == last)
        first--;
    bool divided = first > 0 && l->glyphs[first - 1].cluster >= (int)strlen(text);
    *rests += divided && !strchr(text + l->glyphs[first].cluster, ' ');
    *shorts += last > 0 && glyph_end(&l->glyphs[n - 1]) - l->glyphs[first].x_px < 2.5 * SIZE;
}

static void paragraph_see(const char *text, double width, int *rests, int *shorts)
{
    struct page_template page = {.width_px = 500, .height_px = 500, .frames_count = 1};
    struct page_style style = page_style_default();
    struct page_manner m = page_manner_default();
    struct page_text *t;
    struct font_layout l;
    int id;
    page.frames[0] = (struct page_frame){.x = 30, .y = 40, .width = width, .height = 420};
    style.size_px = SIZE;
    style.language = "en";
    m.align = FONT_ALIGN_JUSTIFY;
    m.hyphenate = true;
    assert_font(page_text_create(&t));
    assert_font(page_style_add(t, &style, &id));
    assert_font(page_templates_set(t, &page, 1));
    assert_font(page_paragraph_add(t, 0, -1, text, strlen(text), id, &m, &id));
    assert_font(page_layout(t, 0, &l));
    last_line_see(&l, text, rests, shorts);
    font_layout_finish(&l);
    page_text_destroy(t);
}

/* Of paragraphs of ever more words in columns of ever more pixels few last lines are short, or
 * the rest of a word. (Without the rules it is 28 and 22 of 300.) */
static void last_lines_are_seldom_short(void **state)
{
    (void)state;
    int rests = 0, shorts = 0, tried = 0;
    for (int wider = 0; wider < 100; wider += 10)
        for (int cut = 60; cut < (int)sizeof marsh - 1; cut++) {
            char text[sizeof marsh];
            if (marsh[cut] != ' ')
                continue;
            memcpy(text, marsh, (size_t)cut);
            text[cut] = '\0';
            paragraph_see(text, 190 + wider, &rests, &shorts);
            tried++;
        }
    print_message("of %d last lines %d are short and %d a word's rest\n", tried, shorts, rests);
    assert_int_equal(tried, 300);
    assert_true(shorts <= 20 && rests <= 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(last_lines_are_seldom_short)};
    return cmocka_run_group_tests_name("last lines", tests, NULL, NULL);
}
