/* test_html.c - documents as HTML: whole without any other file, nothing in it runs or is
 * fetched, and what readers left is at its words. */
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
#include <unistd.h>

#include "../sample.h"
#include "html_tags.h"
#include "without_library.h"

static char path[] = "/tmp/lutetia-html-XXXXXX";

static struct reader_document *read_text(const char *markdown, size_t bytes)
{
    struct reader_document *d;
    if (reader_document_create(&d) != READER_OK ||
        reader_document_add(d, markdown, bytes) != READER_OK ||
        reader_document_refer(d) != READER_OK || reader_document_plain(d) != READER_OK)
        fail_msg("%s", reader_error());
    return d;
}

/* The caller frees it. */
static char *html_of(const struct reader_document *d, const struct reader_html_setup *setup)
{
    char *html = NULL;
    size_t bytes = 0;
    FILE *f = open_memstream(&html, &bytes);
    assert_non_null(f);
    if (reader_html_write(d, setup, f) != READER_OK)
        fail_msg("%s", reader_error());
    assert_int_equal(fclose(f), 0);
    const char *wrong = html_wrong(html);
    if (wrong)
        fail_msg("at byte %ld: %.120s", (long)(wrong - html), wrong);
    return html;
}

static char *html_plain(const char *markdown)
{
    struct reader_document *d = read_text(markdown, strlen(markdown));
    char *html = html_of(d, &(struct reader_html_setup){.theme = READER_HTML_BOTH});
    reader_document_destroy(d);
    return html;
}

static void has(const char *html, const char *what)
{
    if (!strstr(html, what))
        fail_msg("there is no %s in\n%s", what, strstr(html, "<body>"));
}

static void has_not(const char *html, const char *what)
{
    if (strstr(html, what))
        fail_msg("there is %s in\n%s", what, strstr(html, "<body>"));
}

/* ---- documents ---- */

static void blocks_have_their_tags(void **state)
{
    (void)state;
    char *html =
        html_plain("# The *marsh*\n\nReeds & `a<b`[^1].\n\nLines  \nthat<br>\nend.\n\n1. "
                   "one\n2. two\n   - in it\n\n"
                   "> said\n\n```c\nint a;\nint b;\n```\n\n| a | b |\n|---|--:|\n| 1 | 2 |\n\n"
                   "---\n\n[^1]: By night.\n");
    has(html, "<title>The marsh</title>");
    has(html, "<h1 id=\"b.0\">The <em>marsh</em></h1>");
    has(html,
        "Reeds &amp; <code>a&lt;b</code><sup><a href=\"#n.1\" id=\"c.1\">1</a></sup>.</p>");
    has(html, "Lines<br>\nthat<br>\nend.</p>");
    has(html, "<ol><li><p id=\"b.3\"><span class=\"marker\">1.</span>one</p>\n</li>\n<li>");
    has(html, "<ul><li><p id=\"b.5\"><span class=\"marker\">\xe2\x80\xa2</span>in "
              "it</p>\n</li></ul>\n"
              "</li></ol>\n<blockquote>\n<p id=\"b.6\">said</p>\n</blockquote>");
    has(html, "<pre id=\"b.7\"><code>int a;\nint b;</code></pre>");
    has(html, "<th style=\"text-align:right\">b</th></tr>\n<tr id=\"b.9\"><td>1</td>");
    has(html, "<hr id=\"b.10\">");
    has(html,
        "<aside class=\"note\" id=\"n.1\"><a href=\"#c.1\">1</a>\n<p>By night.</p>\n</aside>");
    free(html);
}

static void links_lead_where_they_may(void **state)
{
    (void)state;
    char *html = html_plain(
        "# Reeds\n\n[in](#reeds) [out](https://a.b/?x=\"1\"&y) [no](javascript:alert(1)) "
        "[file](file:///etc/passwd) [whole](/etc/passwd) [data](data:text/html,x) "
        "[beside](other.md#x) [twice](//a.b) [vb](VBScript:x) [tab](&#9;/etc/a) "
        "[line](&#10;//a.b) "
        "[bell](&#7;/etc/b) [next](&#x85;/etc/c) [blank](< /etc/d>) "
        "[within](&#9;java&#10;script:x) "
        "[mine](<my reeds.md>)\n");
    has(html, "<a href=\"#b.0\">in</a>");
    has(html, "<a href=\"https://a.b/?x=&quot;1&quot;&amp;y\">out</a>");
    has(html, "<a href=\"other.md#x\">beside</a>");
    has(html, "no file whole data");
    has_not(html, "javascript:");
    has_not(html, "file:");
    has_not(html, "href=\"/");
    has_not(html, "VBScript");
    has_not(html, "etc/");
    has_not(html, "href=\"\n");
    has_not(html, "script:x");
    has(html, "<a href=\"my reeds.md\">mine</a>");
    free(html);
}

/* Whatever a document says (security.md 38). */
static void nothing_runs_in_it(void **state)
{
    (void)state;
    char *html =
        html_plain("# </title><script>a()</script>\n\n<script>b()</script>\n\n"
                   "a <img src=x onerror=c()> `</code><script>`\n\n"
                   "```lua live\nwhile true do end </pre>\n```\n\n![\"><script>](x\"y.png)\n\n"
                   "$\\text{</alt>\"}$\n");
    has(html, "Content-Security-Policy\" content=\"default-src 'none'; img-src data:; ");
    has_not(html, "<script");
    has_not(html, "<img src=x");
    free(html);
    struct reader_document *d = read_text("a\n", 2);
    html = html_of(d, &(struct reader_html_setup){.title = "</title><script>",
                                                  .language = "\"><script>",
                                                  .font = "a'</style><script>\\"});
    has_not(html, "<script");
    free(html);
    reader_document_destroy(d);
}

static bool picture_give(void *user, int source, const char *target, FILE *to)
{
    (void)user;
    (void)source;
    return strcmp(target, "a.png") == 0 && fputs("Man", to) >= 0;
}

static void pictures_and_formulas_are_within(void **state)
{
    (void)state;
    struct reader_document *d =
        read_text("![A](a.png)\n\n![B](b.png)\n\nSo $x^2$.\n\n$$\\frac12$$\n", 49);
    char *html = html_of(d, &(struct reader_html_setup){.picture = picture_give});
    has(html, "<img alt=\"A\" "
              "src=\"data:image/png;base64,TWFu\"><figcaption><em>A</em></figcaption>");
    has(html, "<figcaption><em>B</em> <code>[b.png]</code></figcaption>");
    if (strstr(html, "class=\"formula\"")) { /* there is a font for them */
        has(html, "alt=\"x^2\" src=\"data:image/svg+xml;base64,PHN2Zy");
        has(html, "alt=\"\\frac12\"");
    } else {
        has(html, "So $x^2$.");
    }
    free(html);
    reader_document_destroy(d);
}

/* Each says its side and its share; in lists and quotes it has its place for itself. */
static void figures_stand_beside_text(void **state)
{
    (void)state;
    static const char text[] =
        "![A](a.png \"left round 30%\")\n\n![](a.png \"right shape\")\n\n"
        "![C](a.png \"a title\")\n\nText.\n\n> ![D](a.png \"left\")\n";
    static const char own[] = "columns 30\ntext 1\nbeside right 25%\n";
    struct reader_template template;
    struct reader_document *d = read_text(text, sizeof text - 1);
    assert_int_equal(reader_template_parse(own, sizeof own - 1, "own", &template), READER_OK);
    char *html = html_of(d, &(struct reader_html_setup){.picture = picture_give}),
         *usual = html_of(
             d, &(struct reader_html_setup){.picture = picture_give, .template = &template});
    has(html, "<figure class=\"left\" style=\"--w:30%\"><img "
              "style=\"shape-outside:ellipse(50% 50%);shape-margin:1em\" alt=\"A\"");
    has(html, "<figure class=\"right\" style=\"--w:40%\"><img style=\"shape-margin:1em;"
              "shape-outside:url(data:image/png;base64,TWFu)\"");
    has(html, "<figure id=\"b.2\"><img alt=\"C\"");
    has(html, "<blockquote>\n<figure id=\"b.4\"><img alt=\"D\"");
    has(usual, "<figure class=\"right\" style=\"--w:25%\"><img alt=\"C\"");
    has(usual, "<blockquote>\n<figure id=\"b.4\"><img alt=\"D\"");
    free(html);
    free(usual);
    reader_document_destroy(d);
}

/* Its colours, sizes and column; without one, none of its rules is there. */
static void templates_are_followed(void **state)
{
    (void)state;
    static const char own[] = "columns 26..30 8\ntext 1\nsize heading-1 2.5\nsize code 0.7\n"
                              "colour paper #102030 #405060\n";
    struct reader_template template;
    struct reader_document *d = read_text("# A\n\n`b`\n", 9);
    assert_int_equal(reader_template_parse(own, sizeof own - 1, "own", &template), READER_OK);
    char *with = html_of(
             d, &(struct reader_html_setup){.theme = READER_HTML_BOTH, .template = &template}),
         *without = html_of(d, &(struct reader_html_setup){.theme = READER_HTML_BOTH});
    has(with, "--paper:#102030;");
    has(with, "--paper:#405060;");
    has(with, "body{max-width:30rem}");
    has(with, "h1{font-size:2.5em}\npre,code{font-size:0.7em}\npre code{font-size:1em}\n");
    assert_null(strstr(with, "table{font-size"));
    has(without, "--paper:#fefcf8;");
    assert_null(strstr(without, "body{max-width:30rem}"));
    free(with);
    free(without);
    reader_document_destroy(d);
}

static void themes_are_the_window_s(void **state)
{
    (void)state;
    struct reader_document *d = read_text("a\n", 2);
    char *light = html_of(d, &(struct reader_html_setup){.theme = READER_HTML_LIGHT}),
         *dark = html_of(d, &(struct reader_html_setup){.theme = READER_HTML_DARK,
                                                        .font = "Caf\xc3\xa9 & Co"}),
         *both =
             html_of(d, &(struct reader_html_setup){.theme = READER_HTML_BOTH, .size_px = 19});
    has(light, "--paper:#fefcf8");
    has_not(light, "#1c1c1e");
    has(dark, ":root{--paper:#1c1c1e");
    has(dark, "font-family:'Caf\xc3\xa9 & Co',");
    has(both, "prefers-color-scheme:dark){:root{--paper:#1c1c1e");
    has(both, ";font-size:19px");
    free(light);
    free(dark);
    free(both);
    reader_document_destroy(d);
}

/* ---- what readers left ---- */

static const char marsh[] =
    "# The marsh\n\nBefore it was a *town it was* a marsh.\n\n- The river "
    "ran slowly.\n\n| reeds | eels |\n|---|---|\n| many | few |\n\nGone soon.\n";

static void add_at(struct reader_remarks *remarks, const struct reader_document *d,
                   struct reader_remark what, const char *quotation)
{
    static struct reader_ink_point points[] = {{0, 0, 0, 0}, {1, 1, 1, 0.1f}, {2, 1, 1, 0.2f}};
    const char *at = strstr(d->plain, quotation);
    int index;
    assert_non_null(at);
    if (what.kind == READER_REMARK_INK) {
        what.points = points;
        what.points_count = 3;
        what.width = 0.2;
        what.rgba = 0x2060c080;
    }
    if (reader_remarks_add(remarks, &what, d->plain, d->plain_bytes, (size_t)(at - d->plain),
                           (size_t)(at - d->plain) + strlen(quotation), &index) != READER_OK)
        fail_msg("%s", reader_error());
}

static struct reader_remarks *marsh_remarks(const struct reader_document *d)
{
    struct reader_remarks *remarks;
    char words[] = "Which <town>?\nThis & that.", again[] = "few?", gone[] = "soon gone";
    unlink(path);
    assert_int_equal(reader_remarks_open(path, &remarks), READER_OK);
    add_at(remarks, d, (struct reader_remark){.kind = READER_REMARK_HIGHLIGHT}, "was a town");
    add_at(remarks, d, (struct reader_remark){.kind = READER_REMARK_TYPED, .text = words},
           "town it");
    add_at(remarks, d, (struct reader_remark){.kind = READER_REMARK_INK}, "river");
    add_at(remarks, d, (struct reader_remark){.kind = READER_REMARK_TYPED, .text = again},
           "few");
    add_at(remarks, d, (struct reader_remark){.kind = READER_REMARK_TYPED, .text = gone},
           "Gone soon");
    add_at(remarks, d, (struct reader_remark){.kind = READER_REMARK_INK}, "Gone soon");
    add_at(remarks, d, (struct reader_remark){.kind = READER_REMARK_TYPED, .text = gone},
           "slowly");
    assert_int_equal(reader_remarks_erase(remarks, 6, true), READER_OK);
    return remarks;
}

static void remarks_are_at_their_words(void **state)
{
    (void)state;
    struct reader_document *d = read_text(marsh, strlen(marsh));
    struct reader_remarks *remarks = marsh_remarks(d);
    char *html = html_of(d, &(struct reader_html_setup){.remarks = remarks});
    has(html,
        "Before it <mark>was a </mark><mark class=\"noted\"><em>town</em></mark><mark "
        "class=\"noted\"><em> it</em></mark><a class=\"sign\" id=\"w.2\" href=\"#r.2\" "
        "title=\"note\">\xe2\x9c\x8e</a><em> was</em> a marsh.</p>\n<aside class=\"remark\" "
        "id=\"r.2\"><a href=\"#w.2\">\xe2\x9c\x8e</a> <q>town it</q> <span "
        "class=\"typed\">Which "
        "&lt;town&gt;?\nThis &amp; that.</span></aside>");
    has(html,
        "The <span class=\"ink\"><svg viewBox=\"0 0 1 1\" role=\"img\" aria-label=\"ink\" "
        "style=\"left:0.000rem;top:0.000rem\"><g fill=\"none\" stroke=\"#2060c0\" "
        "opacity=\"0.502\"><path stroke-width=\"0.050\" d=\"M0.000 0.000L0.000 0.000 \"/>"
        "<path stroke-width=\"0.125\" d=\"M0.000 0.000L1.000 1.000 \"/><path "
        "stroke-width=\"0.200\" d=\"M1.000 1.000L2.000 1.000 \"/></g></svg></span>river");
    /* behind the whole table */
    has(html, "<mark class=\"noted\">few</mark><a class=\"sign\" id=\"w.4\"");
    has(html, "</table>\n<aside class=\"remark\" id=\"r.4\">");
    has_not(html, "r.7"); /* erased */
    has_not(html, "words that are gone");
    free(html);
    reader_remarks_close(remarks);
    reader_document_destroy(d);
}

/* A stroke that is scaled, and hangs on the words of another one. */
static void ink_is_scaled_and_grouped(void **state)
{
    (void)state;
    struct reader_document *d = read_text(marsh, strlen(marsh));
    struct reader_remarks *remarks = marsh_remarks(d);
    struct reader_arranged to = reader_remarks_arranged(remarks, 5);
    to.scale_x = 4;
    to.y = 3;
    to.hangs = to.group = 2;
    assert_int_equal(reader_remarks_arrange(remarks, &to, 1), READER_OK);
    char *html = html_of(d, &(struct reader_html_setup){.remarks = remarks});
    const char *left = strstr(html, "left:0.000rem;top:3.000rem\">");
    assert_non_null(left);
    assert_non_null(strstr(left,
                           "d=\"M0.000 0.000L4.000 1.000 \"/><path stroke-width=\"0.400\" "
                           "d=\"M4.000 1.000L8.000 1.000 \"/></g></svg></span>river"));
    free(html);
    reader_remarks_close(remarks);
    reader_document_destroy(d);
}

/* Ink that text flows around floats in its paragraph, and has its outline. */
static void text_flows_around_ink(void **state)
{
    (void)state;
    struct reader_document *d = read_text(marsh, strlen(marsh));
    struct reader_remarks *remarks = marsh_remarks(d);
    struct reader_arranged to = reader_remarks_arranged(remarks, 2);
    to.around = READER_AROUND_LEFT;
    to.x = 0.5;
    to.y = 0.25;
    assert_int_equal(reader_remarks_arrange(remarks, &to, 1), READER_OK);
    to = reader_remarks_arranged(remarks, 5);
    to.around = READER_AROUND_RIGHT;
    to.x = -3;
    assert_int_equal(reader_remarks_arrange(remarks, &to, 1), READER_OK);
    char *html = html_of(d, &(struct reader_html_setup){.remarks = remarks});
    /* 2 ems wide at 0.5, and half its own width more; 1.25 ems high */
    has(html, "<span class=\"marker\">");
    has(html, "<p id=\"b.2\"><span class=\"around l\" "
              "style=\"width:2.60rem;height:1.35rem;shape-outside:polygon(0.00rem 0,");
    has(html, ",0.00rem 1.35rem)\"><svg viewBox=\"0 0 1 1\" role=\"img\" aria-label=\"ink\" "
              "style=\"left:0.500rem;top:0.250rem\">");
    has(html, "<span class=\"around r\" style=\"width:3.0");
    has(html, "polygon(3.0");
    has_not(html, "class=\"ink\"");
    free(html);
    reader_remarks_close(remarks);
    reader_document_destroy(d);
}

static void remarks_without_words_stand_at_the_end(void **state)
{
    (void)state;
    struct reader_document *d = read_text(marsh, strlen(marsh));
    reader_remarks_close(marsh_remarks(d));
    struct reader_document *shorter = read_text(marsh, strlen(marsh) - strlen("Gone soon.\n"));
    struct reader_remarks *remarks;
    assert_int_equal(reader_remarks_read(path, &remarks), READER_OK);
    assert_true(reader_remarks_read_only(remarks));
    assert_int_equal(reader_remarks_find(remarks, shorter->plain, shorter->plain_bytes),
                     READER_OK);
    char *html = html_of(shorter, &(struct reader_html_setup){.remarks = remarks});
    has(html, "<section class=\"gone\">");
    has(html, "<aside id=\"r.5\">The marsh: <q>Gone soon</q> <span class=\"typed\">soon "
              "gone</span></aside>");
    has(html, "<aside id=\"r.6\">The marsh: <q>Gone soon</q> <span class=\"typed\"></span><svg "
              "class=\"alone\" role=\"img\"");
    free(html);
    reader_remarks_close(remarks);
    reader_document_destroy(shorter);
    reader_document_destroy(d);
}

/* ---- all kinds of documents ---- */

static char *file_read(const char *name, size_t *bytes)
{
    enum { ROOM = 1 << 20 };
    char *text = malloc(ROOM);
    FILE *f = fopen(name, "rb");
    if (!text || !f)
        fail_msg("%s cannot be read", name);
    *bytes = fread(text, 1, ROOM, f);
    fclose(f);
    return text;
}

/* Highlights, notes and ink anywhere, across blocks, too: the words are what they were. */
static void words_stay_under_remarks(void **state)
{
    (void)state;
    static const char *const files[] = {DOCS "/reader.md", DOCS "/fonts.md",
                                        DOCS "/measuring.md"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        size_t bytes;
        char *text = file_read(files[i], &bytes), note[] = "n";
        struct reader_document *d = read_text(text, bytes);
        struct reader_remarks *remarks;
        uint64_t seed = 42 + i;
        unlink(path);
        assert_int_equal(reader_remarks_open(path, &remarks), READER_OK);
        for (int k = 0; k < 300; k++) {
            const uint64_t chance = sample_word(&seed);
            const size_t begin = (size_t)(chance >> 20) % d->plain_bytes,
                         most = d->plain_bytes - begin,
                         length = (size_t)(chance >> 50) % (k % 10 ? 80 : 4000);
            struct reader_ink_point point = {0, 0, 0.5f, 0};
            const struct reader_remark what = {.kind = (enum reader_remark_kind)(k % 3),
                                               .text = note,
                                               .points = &point,
                                               .points_count = k % 3 == 2};
            int index;
            if (reader_remarks_add(remarks, &what, d->plain, d->plain_bytes, begin,
                                   begin + (length < most ? length : most),
                                   &index) != READER_OK)
                fail_msg("%s", reader_error());
        }
        char *with = html_of(d, &(struct reader_html_setup){.remarks = remarks}),
             *without = html_of(d, &(struct reader_html_setup){0});
        char *words = html_words(with), *plain = html_words(without);
        assert_string_equal(words, plain);
        int signs = 0, asides = 0;
        for (const char *at = with; (at = strstr(at, "<a class=\"sign\"")); at++)
            signs++;
        for (const char *at = with; (at = strstr(at, "<aside class=\"remark\"")); at++)
            asides++;
        assert_int_equal(signs, 100);
        assert_int_equal(asides, 100);
        free(words);
        free(plain);
        free(with);
        free(without);
        reader_remarks_close(remarks);
        reader_document_destroy(d);
        free(text);
    }
}

/* What formulas lack is told: unknown commands, letters that no font has, each once. */
static void what_formulas_lack_is_told(void **state)
{
    (void)state;
    static const char text[] = "$\\foo + \\baz$, $\\text{\U000F0000}$ and\n\n"
                               "$$\\text{\U000F0000\U000F0001}$$\n";
    struct reader_document *d = read_text(text, sizeof text - 1);
    struct reader_html_lacks lacks = {0};
    free(html_of(d, &(struct reader_html_setup){.lacks = &lacks}));
    if (!lacks.math) {
        assert_int_equal(lacks.unknown_count, 2);
        assert_string_equal(lacks.unknown, "\\foo");
        assert_int_equal(lacks.letters.missing_count, 2);
        assert_int_equal(lacks.letters.missing[0], 0xF0000);
        assert_int_equal(lacks.letters.missing[1], 0xF0001);
    }
    reader_document_destroy(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_have_their_tags),
        cmocka_unit_test(links_lead_where_they_may),
        cmocka_unit_test(nothing_runs_in_it),
        cmocka_unit_test(pictures_and_formulas_are_within),
        cmocka_unit_test(figures_stand_beside_text),
        cmocka_unit_test(templates_are_followed),
        cmocka_unit_test(themes_are_the_window_s),
        cmocka_unit_test(remarks_are_at_their_words),
        cmocka_unit_test(ink_is_scaled_and_grouped),
        cmocka_unit_test(text_flows_around_ink),
        cmocka_unit_test(remarks_without_words_stand_at_the_end),
        cmocka_unit_test(words_stay_under_remarks),
        cmocka_unit_test(what_formulas_lack_is_told),
    };
    const int file = mkstemp(path);
    if (without_library())
        return 77;
    if (file < 0 || close(file) != 0)
        return 1;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(path);
    return failed;
}
