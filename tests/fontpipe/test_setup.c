/* test_setup.c - texts with few signs as paragraphs: what they say, which of it is slanted or
 * bold, and whatever ends their lines. */
#include "support.h"

#include <page.h>
#include <paint.h>
#include <setup.h>

#include <math.h>
#include <stdio.h>
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

static const char chapters[] =
    "# First chapter\n\nWater rises in the marsh and the sheets are laid on the felts, one by "
    "one.[^A note.] The rest of them wait.\n\n## A part with a longer name than others have, "
    "for it needs two lines\n\nThe press stood on oak beams that had been green when they were "
    "cut, and every spring the beams swelled.\n\nNobody knew.\n\n# Second chapter\n\nThe end "
    "of the book is here, and it takes a few lines of its own so that there is some more.";

static struct page_text *book_made(bool grid, const char *head, int columns)
{
    struct page_setup setup = page_setup_default();
    struct page_text *t;
    setup.width_px = 440;
    setup.height_px = 250;
    setup.margin_px = 40;
    setup.columns = columns;
    setup.folios = true;
    setup.head = head;
    setup.grid = grid;
    assert_font(page_setup_make(&setup, chapters, strlen(chapters), &t));
    return t;
}

/* Each page has its number below its text; a running head all but those that a chapter
 * begins. */
static void pages_have_numbers_and_heads(void **state)
{
    (void)state;
    struct page_text *t = book_made(false, "%h, %p 5%%", 1);
    int count, heads = 0;
    assert_font(page_count(t, &count));
    assert_true(count >= 3);
    for (int k = count - 1; k >= 0; k--) { /* in any order */
        struct font_layout l;
        struct page_said said;
        char number[16], head[64];
        assert_font(page_layout_said(t, k, &l, &said));
        snprintf(number, sizeof number, "\n%d\n", k + 1);
        assert_non_null(strstr(said.utf8, number));
        const struct font_passage *last = &said.passages[said.passages_count - 1];
        assert_true(last->role == FONT_ROLE_ARTIFACT && last->end == said.bytes);
        bool opens = k == 0 || memcmp(said.utf8, "Second chapter", 14) == 0;
        snprintf(head, sizeof head, "%s chapter, %d 5%%\n",
                 strstr(said.utf8, "book") ? "Second" : "First", k + 1);
        assert_int_equal(strstr(said.utf8, head) != NULL, !opens);
        heads += !opens;
        for (int i = 0; i < l.glyphs_count; i++) {
            const struct font_placed *g = &l.glyphs[i];
            bool margin = g->y_px < 40 || g->y_px > 210;
            const char *at = strstr(said.utf8, number);
            if (g->cluster > (int)(at - said.utf8) && g->y_px > 40)
                assert_true(g->y_px > 220 && g->x_px > 200 && g->x_px < 240);
            assert_true(margin == (g->cluster > (int)(at - said.utf8)));
        }
        font_layout_finish(&l);
        page_said_finish(&said);
    }
    assert_true(heads >= 1);
    page_text_destroy(t);
}

/* Baselines of the text's own letters are on the grid, behind headings and beside each
 * other. */
static void lines_beside_each_other_are_level(void **state)
{
    (void)state;
    for (int grid = 0; grid < 2; grid++) {
        struct page_text *t = book_made(grid, NULL, 2);
        struct font_layout l;
        double base = 0, off = 0, leading = 0;
        assert_font(page_layout(t, 0, &l));
        for (int i = 0; i < l.glyphs_count; i++) {
            const struct font_placed *g = &l.glyphs[i];
            if (g->size_px != 16)
                continue;
            if (base == 0)
                base = g->y_px;
            double far = g->y_px - base;
            if (leading == 0 && far > 1)
                leading = far;
            if (leading > 0)
                off = fmax(off, fabs(far / leading - round(far / leading)));
        }
        assert_true(grid ? off < 1e-3 : off > 0.05);
        font_layout_finish(&l);
        page_text_destroy(t);
    }
}

/* A heading of two lines has them about as long. */
static void headings_are_balanced(void **state)
{
    (void)state;
    static const char text[] = "# A heading of a page whose last word would stand alone there";
    struct page_text *t = made(text, strlen(text));
    struct font_layout l;
    double ends[4] = {0};
    assert_font(page_layout(t, 0, &l));
    for (int i = 0; i < l.glyphs_count; i++)
        if (l.glyphs[i].line < 4)
            ends[l.glyphs[i].line] = fmax(ends[l.glyphs[i].line], l.glyphs[i].x_px - 60);
    assert_true(ends[0] > 100 && ends[2] == 0);
    assert_true(ends[1] > 0.7 * ends[0] && ends[0] > 0.7 * ends[1]);
    font_layout_finish(&l);
    page_text_destroy(t);
}

enum { WIDE = 300, HIGH = 160 };

/* The page by a painter's filter, with filters of parts. */
static void page_cover(const char *filter, const char *const filters[PAGE_PARTS], uint8_t *gray)
{
    static const char text[] = "# Head\n\nab *cd*[^note]";
    struct page_setup setup = page_setup_default();
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    struct page_text *t;
    struct font_layout layout;
    struct font_cover cover = {WIDE, HIGH, WIDE, gray};
    setup.width_px = WIDE;
    setup.height_px = HIGH;
    setup.margin_px = 16;
    for (int i = 0; i < PAGE_PARTS; i++)
        setup.filters[i] = filters[i];
    def.filter = filter;
    memset(gray, 0, (size_t)WIDE * HIGH);
    assert_font(page_setup_make(&setup, text, sizeof text - 1, &t));
    assert_font(page_layout(t, 0, &layout));
    assert_font(font_painter_create(&def, &painter));
    assert_font(font_painter_cover(painter, &layout, NULL, 0, 0, &cover));
    font_painter_destroy(painter);
    font_layout_finish(&layout);
    page_text_destroy(t);
}

/* Pixels of a page that differ. */
static int differing(const uint8_t *a, const uint8_t *b)
{
    int count = 0;
    for (int i = 0; i < WIDE * HIGH; i++)
        count += a[i] != b[i];
    return count;
}

/* A part's filter is what a painter with that filter draws of it; all parts' together are the
 * whole page. */
static void parts_have_filters_of_their_own(void **state)
{
    (void)state;
    static uint8_t box[WIDE * HIGH], soft[WIDE * HIGH], one[WIDE * HIGH];
    const char *none[PAGE_PARTS] = {NULL}, *all[PAGE_PARTS];
    page_cover("box", none, box);
    page_cover("gaussian-slow", none, soft);
    for (int i = 0; i < PAGE_PARTS; i++)
        all[i] = "gaussian-slow";
    page_cover("box", all, one);
    assert_int_equal(differing(one, soft), 0);
    int sum = 0;
    for (int part = 0; part < PAGE_PARTS; part++) {
        const char *own[PAGE_PARTS] = {NULL};
        own[part] = "gaussian-slow";
        page_cover("box", own, one);
        for (int i = 0; i < WIDE * HIGH; i++)
            assert_true(one[i] == box[i] || one[i] == soft[i] || part == PAGE_PART_ITALIC ||
                        part == PAGE_PART_TEXT); /* their edges meet */
        assert_true((differing(one, box) > 0) == (part != PAGE_PART_BOLD));
        sum += differing(one, box);
    }
    assert_true(sum >= differing(soft, box));
    struct page_setup setup = page_setup_default();
    struct page_text *t;
    setup.filters[PAGE_PART_NOTE] = "bax";
    assert_int_equal(page_setup_make(&setup, "a", 1, &t), FONT_BAD_ARGUMENT);
}

/* A number needs a margin. */
static void numbers_without_a_margin_are_refused(void **state)
{
    (void)state;
    struct page_setup setup = page_setup_default();
    struct page_text *t;
    setup.folios = true;
    setup.margin_px = 4;
    assert_int_equal(page_setup_make(&setup, "a", 1, &t), FONT_BAD_ARGUMENT);
}

/* Each number is usually within its range, and no two are one. */
static void numbers_have_their_ranges(void **state)
{
    (void)state;
    const struct page_setup setup = page_setup_default();
    assert_true(page_numbers_count >= 12);
    for (int i = 0; i < page_numbers_count; i++) {
        const struct page_number *n = &page_numbers[i];
        const void *at = (const char *)&setup + n->at;
        const double usual = n->whole ? *(const int *)at : *(const double *)at;
        if (!(n->least < n->most && usual >= n->least && usual <= n->most))
            fail_msg("%s is %g of %g..%g", n->name, usual, n->least, n->most);
        for (int k = 0; k < i; k++)
            assert_true(strcmp(n->name, page_numbers[k].name) != 0 &&
                        n->at != page_numbers[k].at);
    }
}

static void alignments_have_names(void **state)
{
    (void)state;
    static const char *const names[] = {[FONT_ALIGN_LEFT] = "left",
                                        [FONT_ALIGN_RIGHT] = "right",
                                        [FONT_ALIGN_CENTER] = "center",
                                        [FONT_ALIGN_JUSTIFY] = "justify"};
    enum font_align align = FONT_ALIGN_START;
    assert_false(font_align_named("start", &align));
    assert_false(font_align_named("", &align));
    assert_false(font_align_named("left right", &align));
    assert_int_equal(align, FONT_ALIGN_START);
    for (int i = FONT_ALIGN_LEFT; i <= FONT_ALIGN_JUSTIFY; i++) {
        assert_true(font_align_named(names[i], &align));
        assert_int_equal(align, i);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(signs_are_taken_or_letters),
        cmocka_unit_test(lines_end_in_any_way),
        cmocka_unit_test(slanted_words_are_slanted),
        cmocka_unit_test(pages_have_numbers_and_heads),
        cmocka_unit_test(lines_beside_each_other_are_level),
        cmocka_unit_test(headings_are_balanced),
        cmocka_unit_test(parts_have_filters_of_their_own),
        cmocka_unit_test(numbers_without_a_margin_are_refused),
        cmocka_unit_test(numbers_have_their_ranges),
        cmocka_unit_test(alignments_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
