/* test_examples.c - CommonMark's examples: what each says, and no more, is what the document
 * says, and what HTML of it says. They come with a Debian package. */
#include <reader_html.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <text.h>

#include "../skip.h"
#include "html_tags.h"
#include "without_library.h"

#define EXAMPLES "/usr/share/gocode/src/github.com/yuin/goldmark/_test/spec.json"

static unsigned hex_of(const char *at)
{
    char digits[5] = {0};
    memcpy(digits, at, 4);
    return (unsigned)strtoul(digits, NULL, 16);
}

/* The text behind "NAME": , without its escapes; *at goes behind it. The caller frees it. */
static char *field_read(const char **at, const char *name)
{
    char wanted[32];
    snprintf(wanted, sizeof wanted, "\"%s\": \"", name);
    const char *from = strstr(*at, wanted);
    char *out = malloc(100000), *to = out;
    assert_non_null(from);
    assert_non_null(out);
    for (from += strlen(wanted); *from != '"'; from++) {
        if (*from != '\\') {
            *to++ = *from;
            continue;
        }
        from++;
        if (*from == 'u') {
            to += font_utf8_put(hex_of(from + 1), to);
            from += 4;
        } else {
            *to++ = *from == 'n' ? '\n' : *from == 't' ? '\t' : *from == 'r' ? '\r' : *from;
        }
    }
    *to = '\0';
    *at = from;
    return out;
}

/* Behind the tag that a text begins with: what is in quotes does not end it. */
static const char *tag_behind(const char *html)
{
    char quote = '\0';
    for (const char *at = html; *at && html[1] != '?' && html[1] != '!'; at++) {
        if (quote ? *at == quote : *at == '"' || *at == '\'')
            quote = quote ? '\0' : *at;
        else if (!quote && *at == '>')
            return at + 1;
    }
    return strchr(html, '>') + 1;
}

/* Letters and signs of HTML, without tags and blanks. The caller frees it. */
static char *said(const char *html)
{
    static const struct {
        const char *name, *is;
    } names[] = {{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}};
    char *out = malloc(strlen(html) + 1), *to = out;
    assert_non_null(out);
    while (*html) {
        const char *const before = html;
        if (*html == '<' && strchr(html, '>')) {
            const char *const begin = html;
            html = tag_behind(html);
            const char *alt = strncmp(begin, "<img ", 5) == 0 ? strstr(begin, "alt=\"") : NULL;
            if (strncmp(begin, "<img ", 5) == 0 && (!alt || alt > html))
                alt = strstr(begin, "src=\""); /* what has no caption is told by its file */
            for (const char *at = alt && alt < html ? alt + 5 : html; at < html && *at != '"';
                 at++)
                to += *at != ' ' ? (*to = *at, 1) : 0;
            continue;
        }
        for (size_t i = 0; i < sizeof names / sizeof *names && html == before; i++)
            if (strncmp(html, names[i].name, strlen(names[i].name)) == 0) {
                *to++ = names[i].is[0];
                html += strlen(names[i].name);
            }
        if (html != before)
            continue;
        if (strncmp(html, "\xc2\xa0", 2) == 0)
            html += 2;
        else if (*html == ' ' || *html == '\n' || *html == '\t')
            html++;
        else
            *to++ = *html++;
    }
    *to = '\0';
    return out;
}

static void blank(char *html, const char *begin, const char *end)
{
    for (char *at = html; (at = strstr(at, begin));) {
        char *const stop = strstr(at, end);
        assert_non_null(stop);
        memset(at, ' ', (size_t)(stop - at) + strlen(end));
    }
}

/* Without tags that are said as they are written. */
static void tags_drop(char *text)
{
    char *to = text;
    for (const char *at = text; *at;) {
        const char *end = *at == '<' ? strchr(at, '>') : NULL;
        if (end)
            at = end + 1;
        else
            *to++ = *at++;
    }
    *to = '\0';
}

/* Our HTML's, without markers of items and names of pictures' files. */
static char *said_by(const char *markdown)
{
    struct reader_document *d;
    char *html = NULL;
    size_t bytes = 0;
    assert_int_equal(reader_document_create(&d), READER_OK);
    if (reader_document_add(d, markdown, strlen(markdown)) != READER_OK ||
        reader_document_refer(d) != READER_OK || reader_document_plain(d) != READER_OK)
        fail_msg("%s", reader_error());
    FILE *f = open_memstream(&html, &bytes);
    assert_non_null(f);
    assert_int_equal(reader_html_write(d, &(struct reader_html_setup){0}, f), READER_OK);
    assert_int_equal(fclose(f), 0);
    assert_null(html_wrong(html));
    blank(html, "<span class=\"marker\">", "</span>");
    blank(html, " <code>[", "]</code>");
    char *out = said(strstr(html, "<body>"));
    free(html);
    reader_document_destroy(d);
    return out;
}

/* Of a newer CommonMark than cmark-gfm reads: a number that is no letter's, a tag <textarea>;
 * since its version 0.31.2, signs of money at the end of what is emphasised. */
enum { OTHERS = 3 };
static bool is_other(const char *markdown)
{
    static const char *const others[OTHERS] = {"&#87654321;", "<textarea>",
                                               "*\xe2\x82\xac*charlie"};
    for (int i = 0; i < OTHERS; i++)
        if (strstr(markdown, others[i]))
            return true;
    return false;
}

static void examples_say_the_same(void **state)
{
    (void)state;
    FILE *f = fopen(EXAMPLES, "rb");
    if (!f)
        skip_because("golang-github-yuin-goldmark-dev is not installed");
    char *all = calloc(1, 1 << 20);
    assert_non_null(all);
    assert_true(fread(all, 1, (1 << 20) - 1, f) > 0);
    fclose(f);
    int tried = 0, same = 0;
    for (const char *at = all; strstr(at, "\"markdown\": \"");) {
        char *markdown = field_read(&at, "markdown"), *html = field_read(&at, "html");
        const char *number = strstr(at, "\"example\": ");
        char *wanted = said(html), *got = said_by(markdown);
        assert_non_null(number);
        tried++;
        if (strcmp(wanted, got) != 0 && strchr(got, '<')) {
            tags_drop(wanted);
            tags_drop(got);
        }
        if (strcmp(wanted, got) == 0)
            same++;
        else if (!is_other(markdown))
            fail_msg("example %d:\n%s\nsays %s, and here\n%s", atoi(number + 11), markdown,
                     wanted, got);
        free(markdown);
        free(html);
        free(wanted);
        free(got);
    }
    assert_true(tried > 600 && same >= tried - OTHERS);
    free(all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(examples_say_the_same)};
    return without_library() ? 77 : cmocka_run_group_tests(tests, NULL, NULL);
}
