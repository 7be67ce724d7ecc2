/* test_miniatures.c - pages small: each has its own letters, filtered at their size; marks are
 * at their words; places lead to pages and back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <reader_document.h>
#include <reader_miniatures.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "without_library.h"

enum { WIDTH = 100, PARAGRAPHS = 200 };

struct book {
    struct reader_document *document;
    struct reader_miniatures *small;
    uint8_t *rgb;
    int width, height;
};

static void document_make(struct book *b)
{
    char *text = NULL;
    size_t bytes = 0;
    FILE *out = open_memstream(&text, &bytes);
    for (int i = 0; i < PARAGRAPHS; i++)
        fprintf(out,
                "%sParagraph number%d has words that are long enough for some lines of a page, "
                "and goes on with more of them[^n%d].\n\n[^n%d]: A note of %d.\n\n",
                i % 20 ? "" : "# A heading\n\n", i, i, i, i);
    fclose(out);
    assert_int_equal(reader_document_create(&b->document), READER_OK);
    assert_int_equal(reader_document_add(b->document, text, bytes), READER_OK);
    assert_int_equal(reader_document_refer(b->document), READER_OK);
    assert_int_equal(reader_document_plain(b->document), READER_OK);
    free(text);
}

static struct book book_make(bool dark)
{
    struct book b = {0};
    const struct reader_pages_setup setup = reader_pages_setup_default();
    const struct reader_miniatures_def def = {.setup = &setup, .width_px = WIDTH, .dark = dark};
    document_make(&b);
    assert_int_equal(reader_miniatures_make(b.document, &def, &b.small), READER_OK);
    reader_miniatures_size(b.small, &b.width, &b.height);
    b.rgb = malloc(3 * (size_t)b.width * (size_t)b.height);
    assert_non_null(b.rgb);
    return b;
}

static void book_end(struct book *b)
{
    reader_miniatures_destroy(b->small);
    reader_document_destroy(b->document);
    free(b->rgb);
}

static size_t place(const struct book *b, const char *words, size_t *end)
{
    size_t begin;
    assert_true(reader_document_search(b->document, words, 0, true, &begin, end));
    return begin;
}

/* The part of a page that is not its paper. */
static double inked(struct book *b, int page)
{
    int count = 0;
    assert_int_equal(reader_miniatures_paint(b->small, page, b->rgb, 3 * (size_t)b->width),
                     READER_OK);
    for (int i = 1; i < b->width * b->height; i++)
        count += memcmp(b->rgb, b->rgb + 3 * i, 3) != 0;
    return (double)count / (b->width * b->height);
}

static void pages_have_letters(void **state)
{
    (void)state;
    for (int dark = 0; dark < 2; dark++) {
        struct book b = book_make(dark);
        const int count = reader_miniatures_count(b.small);
        assert_true(count > 10);
        assert_int_equal(b.width, WIDTH);
        assert_int_equal(b.height, 140); /* as 600 to 840 */
        for (int i = 0; i < count; i++) {
            const double part = inked(&b, i);
            assert_true(part > 0.01 && part < 0.8);
        }
        assert_true(dark ? b.rgb[0] < 60 : b.rgb[0] > 200);
        book_end(&b);
    }
}

/* Filtered at its size: what a page has of ink is as much as it has at other sizes. */
static void sizes_have_the_same_ink(void **state)
{
    double means[3];
    const int widths[] = {60, 120, 600};
    (void)state;
    struct book b = book_make(false);
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        assert_int_equal(reader_miniatures_resize(b.small, widths[k]), READER_OK);
        reader_miniatures_size(b.small, &b.width, &b.height);
        b.rgb = realloc(b.rgb, 3 * (size_t)b.width * (size_t)b.height);
        assert_int_equal(reader_miniatures_paint(b.small, 3, b.rgb, 3 * (size_t)b.width),
                         READER_OK);
        for (int i = 0; i < b.width * b.height; i++)
            sum += (b.rgb[0] - b.rgb[3 * i]) / (double)b.rgb[0];
        means[k] = sum / (b.width * b.height);
    }
    /* light is mixed, so gray is brighter than its mean of numbers */
    assert_true(means[0] > 0.3 * means[2] && means[0] < 1.2 * means[2]);
    assert_true(means[1] > 0.3 * means[2] && means[1] < 1.2 * means[2]);
    book_end(&b);
}

static void marks_are_at_their_words(void **state)
{
    (void)state;
    struct book b = book_make(false);
    struct reader_mark mark = {.rgb = {0, 1, 0}};
    mark.begin = place(&b, "number137", &mark.end);
    const int page = reader_miniatures_page(b.small, mark.begin);
    assert_true(page > 3 && page < reader_miniatures_count(b.small));
    assert_int_equal(reader_miniatures_mark(b.small, &mark, 1), READER_OK);
    long x = 0, y = 0, pixels = 0;
    for (int i = 0; i < reader_miniatures_count(b.small); i++) {
        assert_int_equal(reader_miniatures_marks(b.small, i), i == page);
        inked(&b, i);
        for (int p = 0; p < b.width * b.height; p++)
            if (b.rgb[3 * p] < 40 && b.rgb[3 * p + 1] > 240 && b.rgb[3 * p + 2] < 40) {
                assert_int_equal(i, page);
                x += p % b.width;
                y += p / b.width;
                pixels++;
            }
    }
    assert_true(pixels >= 8); /* it can be seen */
    size_t byte = 0;
    assert_true(reader_miniatures_byte(b.small, page, (double)x / (double)pixels,
                                       (double)y / (double)pixels, &byte));
    assert_true(byte + 12 >= mark.begin && byte <= mark.end + 12);
    /* in a note, and in nothing */
    mark.begin = place(&b, "A note of 99", &mark.end);
    assert_int_equal(reader_miniatures_mark(b.small, &mark, 1), READER_OK);
    const int noted = reader_miniatures_page(b.small, mark.begin);
    assert_int_equal(reader_miniatures_marks(b.small, noted), 1);
    assert_int_equal(reader_miniatures_mark(b.small, NULL, 0), READER_OK);
    assert_int_equal(reader_miniatures_marks(b.small, noted), 0);
    mark = (struct reader_mark){.begin = 1u << 30, .end = (1u << 30) + 5};
    assert_int_equal(reader_miniatures_mark(b.small, &mark, 1), READER_OK);
    book_end(&b);
}

static void pages_are_in_order(void **state)
{
    (void)state;
    struct book b = book_make(false);
    int before = 0;
    for (int i = 0; i < PARAGRAPHS; i++) {
        char words[40];
        size_t end;
        snprintf(words, sizeof words, "number%d has", i);
        const int page = reader_miniatures_page(b.small, place(&b, words, &end));
        assert_true(page == before || page == before + 1);
        before = page;
    }
    assert_true(before >= reader_miniatures_count(b.small) - 2);
    assert_int_equal(reader_miniatures_page(b.small, 1u << 30), -1);
    book_end(&b);
}

static void what_is_wrong_is_refused(void **state)
{
    (void)state;
    struct book b = book_make(false);
    size_t byte;
    assert_int_equal(reader_miniatures_resize(b.small, 15), READER_BAD_ARGUMENT);
    assert_int_equal(reader_miniatures_resize(b.small, 1001), READER_BAD_ARGUMENT);
    assert_int_equal(reader_miniatures_paint(b.small, -1, b.rgb, 300), READER_BAD_ARGUMENT);
    assert_int_equal(reader_miniatures_paint(b.small, 10000, b.rgb, 300), READER_BAD_ARGUMENT);
    assert_false(reader_miniatures_byte(b.small, -1, 0, 0, &byte));
    assert_false(reader_miniatures_byte(b.small, 10000, 0, 0, &byte));
    book_end(&b);
    /* a document of nothing has a page */
    const struct reader_pages_setup setup = reader_pages_setup_default();
    const struct reader_miniatures_def def = {.setup = &setup, .width_px = 16};
    assert_int_equal(reader_document_create(&b.document), READER_OK);
    assert_int_equal(reader_document_add(b.document, "", 0), READER_OK);
    assert_int_equal(reader_document_plain(b.document), READER_OK);
    assert_int_equal(reader_miniatures_make(b.document, &def, &b.small), READER_OK);
    uint8_t rgb[3 * 16 * 30];
    for (int i = 0; i < reader_miniatures_count(b.small); i++)
        assert_int_equal(reader_miniatures_paint(b.small, i, rgb, 48), READER_OK);
    assert_int_equal(reader_miniatures_page(b.small, 0), -1);
    reader_miniatures_destroy(b.small);
    reader_document_destroy(b.document);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pages_have_letters),       cmocka_unit_test(sizes_have_the_same_ink),
        cmocka_unit_test(marks_are_at_their_words), cmocka_unit_test(pages_are_in_order),
        cmocka_unit_test(what_is_wrong_is_refused),
    };
    if (without_library())
        return 77;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
