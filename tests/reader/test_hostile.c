/* test_hostile.c - documents that are made to be hard: deep, long, wide, many, broken. Each
 * becomes pages, or is refused by one line that says where; and each is large enough that what
 * grows as the square of it would not end before the test's time. */
#include <reader_document.h>
#include <reader_pages.h>
#include <reader_view.h>

#include "without_library.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { NUMBER = 0x01 }; /* in a part: its number stands there */

struct text {
    char *bytes;
    size_t count, room;
};

static void bytes_add(struct text *t, const char *bytes, size_t count)
{
    if (t->count + count > t->room) {
        t->room = 2 * (t->count + count);
        t->bytes = realloc(t->bytes, t->room);
        assert_non_null(t->bytes);
    }
    memcpy(t->bytes + t->count, bytes, count);
    t->count += count;
}

static void part_add(struct text *t, const char *part, int number)
{
    char digits[16];
    for (; *part; part++) {
        if (*part != NUMBER) {
            bytes_add(t, part, 1);
            continue;
        }
        const int n = snprintf(digits, sizeof digits, "%d", number);
        bytes_add(t, digits, (size_t)n);
    }
}

/* A piece of a document: some text, `count` times. */
struct part {
    const char *text;
    int count;
};
enum { PARTS = 5 };
struct hostile {
    const char *name;
    struct part parts[PARTS];
    const char *refused; /* NULL: it becomes pages; else what the line says */
};

static struct text made(const struct hostile *h)
{
    struct text t = {0};
    for (int i = 0; i < PARTS && h->parts[i].text; i++)
        for (int k = 0; k < h->parts[i].count; k++)
            part_add(&t, h->parts[i].text, k);
    return t;
}

static const struct hostile rows[] = {
    {"quotes", {{">", 10000}, {" deep\n", 1}}, NULL},
    {"quotes with blanks", {{"> ", 100000}, {"deep\n", 1}}, NULL},
    {"lists", {{"- ", 10000}, {"deep\n", 1}}, NULL},
    {"numbered lists", {{"1. ", 10000}, {"deep\n", 1}}, NULL},
    {"quotes and lists", {{"> - ", 10000}, {"deep\n", 1}}, NULL},
    {"blank lines in deep lists", {{"- ", 50000}, {"a", 1}, {"\n", 200000}}, "line 26"},
    {"lazy lines behind deep quotes", {{"> ", 50000}, {"a", 1}, {"\nb", 200000}}, "line 26"},
    {"blank lines in deep notes", {{"[^1]:", 50000}, {"a", 1}, {"\n", 200000}}, "line 2"},
    {"one line", {{"word ", 200000}}, NULL},
    {"one word", {{"x", 300000}}, NULL},
    {"one word of code", {{"```\n", 1}, {"x", 300000}, {"\n```\n", 1}}, NULL},
    {"one heading", {{"# ", 1}, {"h ", 150000}}, NULL},
    {"one link", {{"[**", 1}, {"word ", 60000}, {"**](x)", 1}}, NULL},
    {"one span of code", {{"`", 1}, {"word ", 60000}, {"`", 1}}, NULL},
    {"a wide table", {{"a|", 5000}, {"\n", 1}, {"-|", 5000}, {"\n", 1}, {"b|", 5000}}, NULL},
    {"a wider table", {{"a|", 250000}, {"\n", 1}, {"-|", 250000}, {"\n", 1}}, "line 2: "},
    {"a long table", {{"|a|b|\n|-|-|\n", 1}, {"|b|c|\n", 20000}}, NULL},
    {"rows that lack cells",
     {{"a|", 3000}, {"\n", 1}, {"-|", 3000}, {"\n", 1}, {"|b|\n", 3000}},
     "line 1"},
    {"what may be a table", {{"|\n|-\n", 20000}}, "line "},
    {"a cell", {{"|a|b|\n|-|-|\n|", 1}, {"word ", 60000}, {"|c|\n", 1}}, NULL},
    {"a column's name",
     {{"|", 1}, {"a", 100000}, {"|b|\n|-|-|\n", 1}, {"|b|c|\n", 2000}},
     NULL},
    {"calls of a note", {{"[^1]", 200000}, {"\n\n[^1]: note\n", 1}}, NULL},
    {"calls of no note", {{"[^\1]", 100000}}, NULL},
    {"notes", {{"a[^\1] ", 21000}, {"\n\n", 1}, {"[^\1]: n\n", 21000}}, "20000 notes"},
    {"notes that call each other",
     {{"a[^1]\n\n[^1]: one[^2]\n\n[^2]: two[^1][^2]\n", 1}},
     NULL},
    {"a chain of notes", {{"a[^0]\n\n", 1}, {"[^\1]: n[^1\1]\n\n", 9000}}, NULL},
    {"a long note", {{"a[^1]\n\n[^1]: ", 1}, {"word ", 60000}}, "line 3: a note"},
    {"links to links", {{"[a][b]\n\n[b]: <c>\n[c]: <b>\n[a]: #a\n", 1}}, NULL},
    {"a definition used often",
     {{"[a]: <", 1}, {"u", 100000}, {">\n\n", 1}, {"[a] ", 50000}},
     "line 1: a link's definition"},
    {"an address for each word",
     {{"[", 1}, {"a *b* ", 2000}, {"](", 1}, {"u", 100000}, {")\n", 1}},
     "MB of addresses"},
    {"references", {{"# A title\n\n", 1}, {"[#](#a-title) ", 20000}}, NULL},
    {"references that lead nowhere", {{"[#](#\1) ", 20000}}, NULL},
    {"labels", {{"<a id=\"l\1\"></a>", 25000}, {"a\n", 1}}, NULL},
    {"headings of one name", {{"# a\n", 20000}}, NULL},
    {"mail", {{"a@", 300000}}, "line 1"},
    {"chained mail", {{"a@b.", 125000}}, "line 1"},
    {"HTML that never ends", {{"a <![CDATA[", 100000}}, "line 1"},
    {"brackets", {{"[", 100000}}, NULL},
    {"stars", {{"*", 300000}, {"a", 1}, {"*", 300000}}, NULL},
    {"pictures in pictures", {{"![", 20000}, {"a", 1}, {"](b)", 20000}}, NULL},
    {"a picture's name", {{"![c](", 1}, {"\xc3\xa9", 500000}, {".png)\n", 1}}, NULL},
    {"backticks", {{"`", 79}, {" ", 1}, {"```````` ` `` ", 20000}}, NULL},
    {"dollars", {{"$a ", 100000}}, NULL},
    {"formulas", {{"$x$ ", 21000}}, "line 1: a document has up to 20000 formulas"},
    {"a long formula", {{"$", 1}, {"x+", 100000}, {"x$", 1}}, NULL},
    {"a fence of mathematics", {{"```math\n", 1}, {"x+", 100000}, {"\n```\n", 1}}, NULL},
    {"deep braces", {{"$", 1}, {"{", 4000}, {"x", 1}, {"}", 4000}, {"$", 1}}, NULL},
    {"deep fractions", {{"$", 1}, {"\\frac{", 700}, {"x", 1}, {"}{y}", 700}, {"$", 1}}, NULL},
    {"scripts of scripts", {{"$", 1}, {"x_", 4000}, {"x$", 1}}, NULL},
    {"broken formulas",
     {{"$\\frac{a$ $\\left( x$ $}{$ $\\sqrt$ $^^$ $x^$ $\\begin{matrix} a & b$ $&$ $\\\\$\n",
       1}},
     NULL},
    {"directions", {{"a\xe2\x80\xae b \xe2\x81\xa6", 3000}, {"\xe2\x80\xaa", 5000}}, NULL},
    {"accents", {{"a", 1}, {"\xcc\x81", 20000}}, NULL},
    {"joiners", {{"a", 1}, {"\xe2\x80\x8d", 20000}}, NULL},
    {"letters that are none", {{"\xff\xfe\xc0\xaf\xed\xa0\x80\xf8", 5000}}, NULL},
    {"carriage returns", {{"# a\r\rb *c*\r\n| a |\r\n|---|\r\n\r\n", 200}}, NULL},
};

static void check_error(const struct hostile *h, enum reader_status status)
{
    const char *error = reader_error();
    if (status != READER_TOO_LARGE || !h->refused || !strstr(error, h->refused) ||
        strchr(error, '\n'))
        fail_msg("%s: status %d: %s", h->name, status, error);
}

static struct reader_pages_setup plain_setup(void)
{
    struct reader_pages_setup setup = reader_pages_setup_default();
    setup.font = "DejaVuSans";
    return setup;
}

/* The first pages, and the last one. */
static void pages_look(const struct hostile *h, const struct reader_document *d)
{
    const struct reader_pages_setup setup = plain_setup();
    struct reader_pages *pages;
    if (reader_pages_make(d, &setup, &pages) != READER_OK)
        fail_msg("%s: %s", h->name, reader_error());
    for (int page = 0; page < 2; page++) {
        struct font_layout layout;
        struct page_said said;
        if (page_layout_said(reader_pages_text(pages), page, &layout, &said) != FONT_OK)
            break;
        font_layout_finish(&layout);
        page_said_finish(&said);
    }
    reader_pages_destroy(pages);
}

/* As a column: the beginning, the middle, the end. */
static void column_look(const struct hostile *h, struct reader_document *d)
{
    const struct reader_pages_setup setup = plain_setup();
    struct reader_view *view;
    assert_int_equal(reader_document_plain(d), READER_OK);
    if (reader_view_create(d, &setup, &view) != READER_OK)
        fail_msg("%s: %s", h->name, reader_error());
    for (int i = 0; i < 3; i++) {
        const struct reader_shown *shown;
        int count;
        reader_view_go_part(view, i / 2.0);
        if (reader_view_look(view, &shown, &count) != READER_OK)
            fail_msg("%s: %s", h->name, reader_error());
        for (int k = 0; k < count; k++) {
            struct font_layout layout;
            assert_int_equal(reader_view_layout(view, shown[k].passage, &layout), READER_OK);
            font_layout_finish(&layout);
        }
    }
    reader_view_destroy(view);
}

static void hostile_documents_are_set_or_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct hostile *h = &rows[i];
        struct text t = made(h);
        struct reader_document *d;
        assert_int_equal(reader_document_create(&d), READER_OK);
        enum reader_status status = reader_document_add(d, t.bytes, t.count);
        if (status == READER_OK)
            status = reader_document_refer(d);
        if (status != READER_OK || h->refused) {
            check_error(h, status);
        } else {
            pages_look(h, d);
            column_look(h, d);
        }
        reader_document_destroy(d);
        free(t.bytes);
    }
}

/* What is parted says all that it said. */
static void long_passages_lose_no_letter(void **state)
{
    (void)state;
    struct text t = {0};
    struct reader_document *d;
    enum { WORDS = 40000 };
    size_t found = 0;
    for (int i = 0; i < WORDS; i++)
        part_add(&t, i % 100 == 7 ? "*w\1* " : i % 100 == 8 ? "$w\1$ " : "w\1 ", i);
    assert_int_equal(reader_document_create(&d), READER_OK);
    assert_int_equal(reader_document_add(d, t.bytes, t.count), READER_OK);
    assert_true(d->blocks_count > 6);
    for (int i = 0; i < d->blocks_count; i++) {
        const struct reader_block *b = &d->blocks[i];
        assert_int_equal(b->kind, READER_PARAGRAPH);
        assert_int_equal(b->continues, i > 0);
        assert_true(b->bytes < READER_PASSAGE_BYTES + 2048);
        for (const char *at = b->text; (at = strchr(at, 'w')) != NULL; at++)
            assert_int_equal(strtol(at + 1, NULL, 10), (long)found++);
    }
    assert_int_equal(found, WORDS);
    reader_document_destroy(d);
    free(t.bytes);
}

/* Every byte there is, and none: zeros, a byte order mark, all of Latin-1. */
static void any_bytes_are_a_document(void **state)
{
    (void)state;
    static const struct {
        const char *bytes;
        size_t count;
        int blocks;
        const char *first;
    } kinds[] = {{"", 0, 0, NULL},
                 {"\xef\xbb\xbf", 3, 0, NULL},
                 {"\xef\xbb\xbf# Head\n", 9, 1, "Head"},
                 {"a\0b", 3, 1, "a b"},
                 {"\0\0\0", 3, 0, NULL},
                 {"# Head\r\n\r\ntext\r\nmore\r\n", 22, 2, "Head"},
                 {"a\xff"
                  "b",
                  3, 1,
                  "a\xef\xbf\xbd"
                  "b"}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        struct reader_document *d;
        assert_int_equal(reader_document_create(&d), READER_OK);
        assert_int_equal(reader_document_add(d, kinds[i].bytes, kinds[i].count), READER_OK);
        assert_int_equal(d->blocks_count, kinds[i].blocks);
        if (kinds[i].first)
            assert_string_equal(d->blocks[0].text, kinds[i].first);
        const struct hostile h = {.name = "any bytes"};
        pages_look(&h, d);
        column_look(&h, d);
        reader_document_destroy(d);
    }
}

/* A bibliography among very many labels of that name, cited very often: its entries lead back
 * to places that are found, as many as there are at most; none cites itself. */
static void bibliographies_are_bounded(void **state)
{
    (void)state;
    enum { LABELS = 30000, TIMES = 100000 };
    static const char begin[] =
        "<a id=\"bibliography\"></a>\n\n1. <a id=\"b\"></a>B [#](#b)\n2. "
        "<a id=\"a\"></a>A\n\n";
    struct text text = {0};
    struct reader_document *d;
    part_add(&text, begin, 0);
    for (int i = 0; i < TIMES; i++)
        part_add(&text,
                 i < LABELS ? "<a id=\"bibliography\"></a>See [[#](#a)].\n\n"
                            : "See [#](#a).\n\n",
                 0);
    assert_int_equal(reader_document_create(&d), READER_OK);
    assert_int_equal(reader_document_add(d, text.bytes, text.count), READER_OK);
    assert_int_equal(reader_document_refer(d), READER_OK);
    assert_string_equal(d->blocks[1].text, "B 2");
    int back = 0;
    for (int i = 0; i < d->blocks[0].spans_count; i++) {
        const char *target = d->blocks[0].spans[i].target;
        if (!target)
            continue;
        const struct reader_block *place = reader_document_label(d, target + 1, 0);
        assert_non_null(place);
        assert_string_equal(place->text, "See [1].");
        assert_true(place == &d->blocks[2 + back]);
        back++;
    }
    assert_int_equal(back, 1000);
    reader_document_destroy(d);
    free(text.bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hostile_documents_are_set_or_refused),
        cmocka_unit_test(long_passages_lose_no_letter),
        cmocka_unit_test(any_bytes_are_a_document),
        cmocka_unit_test(bibliographies_are_bounded),
    };
    if (without_library())
        return 77;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
