/* test_setup.c - texts with few signs as paragraphs: what they say, which of it is slanted or bold, and whatever ends their lines. */
#include "support.h"

#include <page.h>
#include <setup.h>

#include <string.h>

static struct page_text *made(const char *text, size_t bytes)
{
    struct page_setup setup = page_setup_default();
    struct page_text *t;
    assert_font(page_setup_make(&setup, text, bytes, &t));
    return t;
}

static void says(struct page_text *t, int at, const char *want)
{
    size_t bytes;
    int id = page_paragraph_at(t, 0, at);
    if (!want) {
        assert_int_equal(id, -1);
        return;
    }
    assert_true(id >= 0);
    const char *text = page_paragraph_text(t, id, &bytes);
    if (bytes != strlen(want) || memcmp(text, want, bytes) != 0)
        fail_msg("paragraph %d says '%.*s', not '%s'", at, (int)bytes, text, want);
}

static void signs_are_taken_or_letters(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
    } cases[] = {
        {"5 * 3 * 2 = 30", "5 * 3 * 2 = 30"},
        {"a *slanted* word", "a slanted word"},
        {"a **bold** and ***both***", "a bold and both"},
        {"_slanted_ but snake_case_name", "slanted but snake_case_name"},
        {"Last *unclosed italic", "Last *unclosed italic"},
        {"f(*p) is a pointer", "f(*p) is a pointer"},
        {"**bold *and slanted* too**", "bold and slanted too"},
        {"an \\*escaped\\* star", "an *escaped* star"},
        {"a* b *c", "a* b *c"},
        {"#hashtag", "#hashtag"},
        {"***", "* * *"},
        {"       *       *       *", "* * *"},
        {"> a quote\n> of two lines", "a quote of two lines"},
        {"- item", "\xe2\x80\xa2\xe2\x80\x82item"},
        {"12. twelfth", "12. twelfth"},
        {"a - b\nc", "a - b c"},
        {"", NULL},
        {"*", "*"},
        {"**", "**"},
        {"****", "* * *"},
        {"_", "_"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct page_text *t = made(cases[i].text, strlen(cases[i].text));
        says(t, 0, cases[i].says);
        says(t, 1, NULL);
        page_text_destroy(t);
    }
}

static void lines_end_in_any_way(void **state)
{
    (void)state;
    static const char *const ends[] = {"\n", "\r", "\r\n"};
    for (int i = 0; i < 3; i++) {
        char text[200];
        int n = snprintf(text, sizeof text,
                         "\xef\xbb\xbf# Title%s%sfirst line%ssecond%s%snext%s- one%s- two",
                         ends[i], ends[i], ends[i], ends[i], ends[i], ends[i], ends[i]);
        struct page_text *t = made(text, (size_t)n);
        says(t, 0, "Title");
        says(t, 1, "first line second");
        says(t, 2, "next");
        says(t, 3, "\xe2\x80\xa2\xe2\x80\x82one");
        says(t, 4, "\xe2\x80\xa2\xe2\x80\x82two");
        says(t, 5, NULL);
        page_text_destroy(t);
    }
}

/* What is between the signs is in another face, and nothing else. */
static void slanted_words_are_slanted(void **state)
{
    (void)state;
    static const char text[] = "ab *cd* ef";
    struct page_text *t = made(text, strlen(text));
    struct font_layout l;
    assert_font(page_layout(t, 0, &l));
    assert_int_equal(l.glyphs_count, 8);
    for (int i = 0; i < l.glyphs_count; i++)
        assert_int_equal(l.glyphs[i].face != l.glyphs[0].face,
                         l.glyphs[i].cluster == 3 || l.glyphs[i].cluster == 4);
    font_layout_finish(&l);
    page_text_destroy(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(signs_are_taken_or_letters),
        cmocka_unit_test(lines_end_in_any_way),
        cmocka_unit_test(slanted_words_are_slanted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
