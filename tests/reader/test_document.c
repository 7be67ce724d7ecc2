/* test_document.c - Markdown as blocks, beside what is expected of each; and over the project's
 * own pages: no word is lost, and each block's lines are those of the source. */
#include <reader_document.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "said.h"
#include "without_library.h"

/* ---- tests ---- */

/* A script or a program that lives has a stage: as large as its fence says, where that can
 * be. */
static void live_scripts_have_stages(void **state)
{
    static const struct {
        const char *info;
        int width, height;
    } fences[] = {{"lua live", 600, 240},
                  {"lua live 320x200", 320, 200},
                  {"lua 320x200 live", 320, 200},
                  {"lua\tlive  16x1600 7x7", 16, 1600},
                  {"lua live 15x200", 600, 240},
                  {"lua live 320x1601", 600, 240},
                  {"lua live 320x200px", 600, 240},
                  {"lua live -320x200", 600, 240},
                  {"lua live 99999999999x200", 600, 240},
                  {"lua alive", 0, 0},
                  {"lua", 0, 0},
                  {"lualive live", 0, 0},
                  {"c paris", 320, 320},
                  {"c paris 320x200", 320, 200},
                  {"c paris 8x8", 320, 320},
                  {"cc paris", 0, 0},
                  {"", 0, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof fences / sizeof *fences; i++) {
        char text[100];
        snprintf(text, sizeof text, "```%s\nx = 1\n```\n", fences[i].info);
        struct reader_document *d = read_all(text, strlen(text));
        assert_int_equal(d->blocks_count, 1);
        assert_int_equal(d->blocks[0].stage_width, fences[i].width);
        assert_int_equal(d->blocks[0].stage_height, fences[i].height);
        if (fences[i].width)
            assert_int_equal(d->blocks[0].kind, READER_LIVE);
        assert_int_equal(d->blocks[0].stage_program,
                         strncmp(fences[i].info, "c paris", 7) == 0);
        reader_document_destroy(d);
    }
}

static void blocks_are_those_of_markdown(void **state)
{
    (void)state;
    blocks_are("# A *b* `c`\n\nText\nover lines.  \nAfter.\n",
               "h1 A *b* `c`\np Text over lines.\nAfter.\n");
    blocks_are("**a *b***  ~~c~~ [d](e \"f\") <http://x.y>",
               "p !a !*!b!* ~c~ [d](e) [http://x.y](http://x.y)\n");
    blocks_are("- a\n- b\n  1. c\n\n     d\n  2. e\n- [x] f\n- [ ] g\n",
               "p- \xe2\x80\xa2 a\np- \xe2\x80\xa2 b\np-- 1. c\np-- d\np-- 2. e\n"
               "p- \xe2\x98\x91 f\np- \xe2\x98\x90 g\n");
    blocks_are("7) a\n8) b\n", "p- 7) a\np- 8) b\n");
    blocks_are("- - a\n-\n", "p- \xe2\x80\xa2 \np-- \xe2\x80\xa2 a\np- \xe2\x80\xa2 \n");
    blocks_are("> a\nlazy\n> > b\n", "p> a lazy\np>> b\n");
    blocks_are("```c\nint a;\n\n\tb\n```\n    x\n", "code (c) `int a;\n\n\tb`\ncode `x`\n");
    blocks_are("```lua live\nx = 1\n```\n\n```c paris\ny\n```\n```lua\nz\n```\n",
               "live (lua live) `x = 1`\nlive (c paris) `y`\ncode (lua) `z`\n");
    blocks_are("a\n\n***\n\n<div>x</div>\n\n<!-- gone -->\n", "p a\nrule \np x\n");
    blocks_are("<!-- gone -->*b*\n\n<!-- a --> <!-- b -->\n\n<!-->\n\n<!-- never\n\nends\n",
               "p *b*\n");
    blocks_are("![A *b*](c.png \"d\")\n", "picture <c.png> *A b*\n");
    blocks_are("Not ![A](c.png) alone.\n", "p Not *[<|A|>]*(c.png) alone.\n");
    blocks_are("| a | b |\n|--:|:-:|\n| 1 \\| 2 | *c* |\n| d |\n",
               "row a\tb\nrow 1 | 2\t*c*\nrow d\t\n");
    blocks_are("\\*a\\* &amp; &copy; `b\nc` \\\nd", "p *a* & \xc2\xa9 `b c` \nd\n");
    blocks_are("", "");
    blocks_are("\xff", "p \xef\xbf\xbd\n");
}

static void notes_have_numbers_names_and_classes(void **state)
{
    (void)state;
    blocks_are(
        "A[^b] b[^c:x] c[^b].\n\n[^c:x]: *One*.\n[^b]: Two[^d].\n\n    More.\n[^d]: Three.\n"
        "[^e]: never called\n",
        "p A^1^ b^2^ c^1^.\nnote :b\np Two^3^.\np More.\nnote c:x\np *One*.\nnote :d\n"
        "p Three.\n");
    blocks_are("A[^none].\n", "p A[^none].\n");
    /* Each source has its own names, and numbers go on. */
    struct reader_document *d = read_all("a[^1]\n\n[^1]: One.\n", 19);
    assert_int_equal(reader_document_add(d, "b[^1]\n\n[^1]: Two.\n", 19), READER_OK);
    assert_int_equal(d->notes_count, 2);
    assert_int_equal(d->blocks[1].spans[1].note, 1);
    assert_string_equal(d->note_blocks[1].text, "Two.");
    assert_int_equal(d->blocks[0].source, 0);
    assert_int_equal(d->blocks[1].source, 1);
    reader_document_destroy(d);
}

/* Lines of YAML at the head are for other programs. */
static void head_of_a_file_is_not_shown(void **state)
{
    (void)state;
    blocks_are("---\ntitle: A $b\ntags:\n  - c\n\n---\n\n# H\n", "h1 H\n");
    blocks_are("---\r\na_b: `c\r\n...\r\nd `e` f\r\n", "p d `e` f\n");
    blocks_are("---\nlayout: x\n", "rule \np layout: x\n"); /* it never ends */
    blocks_are("p\n\n---\na: b\n---\n", "p p\nrule \nh2 a: b\n");
}

static void formulas_are_kept_from_markdown(void **state)
{
    (void)state;
    blocks_are("It is $a_1*b*c_2$ and $\\alpha$.", "p It is {$a_1*b*c_2$} and {$\\alpha$}.\n");
    blocks_are("$5 or $6, a$b$c, \\$x$, $ x$, $x $.", "p $5 or $6, a$b$c, $x$, $ x$, $x $.\n");
    blocks_are("\u4f4d\u7f6e$q$\u3002\u91cf $p$\uff0c$\\omega$\u4f1a $x$\ub294 \u201c$y$\u201d",
               "p \u4f4d\u7f6e{$q$}\u3002\u91cf {$p$}\uff0c{$\\omega$}\u4f1a {$x$}\ub294 "
               "\u201c{$y$}\u201d\n");
    blocks_are("\u00e9$x$, $x$\u00e9, \u0434$x$ $x$\u0434, \u0905$x$ $x$\u0964.",
               "p \u00e9$x$, $x$\u00e9, \u0434$x$ $x$\u0434, \u0905$x$ {$x$}\u0964.\n");
    blocks_are("*$a$* **b $c$** [$d$](e)", "p *{$a$}* !b !!{$c$}! {$d$}\n");
    blocks_are("`$a$` ``b ` $c$`` $d$", "p `$a$` `b ` $c$` {$d$}\n");
    blocks_are("    $a$\n\n```\n$b$\n```\n\n$c$\n", "code `$a$`\ncode `$b$`\np {$c$}\n");
    blocks_are("One $a +\nb$ two.", "p One {$a + b$} two.\n");
    blocks_are("> One $a +\n> b$ two.", "p> One {$a + > b$} two.\n");
    blocks_are("$$\na_1\n+ b_2\n$$\n", "math {\na_1\n+ b_2\n}\n");
    blocks_are("Before $$a*b*c$$ after *d*.\n", "p Before\nmath {a*b*c}\np after *d*.\n");
    blocks_are("```math\na_1\n```\n", "math (math) {a_1}\n");
    blocks_are("# $a_b$\n\n| $c_d$ | e |\n|---|---|\n| f | $g_h$ |\n",
               "h1 {$a_b$}\nrow {$c_d$}\te\nrow f\t{$g_h$}\n");
    blocks_are("[x](y$a$z) $b$ [p]($c$) $d$\n", "p [x](y$a$z) {$b$} [p]($c$) {$d$}\n");
    blocks_are("a[^n] $b$\n\n[^n]: $c_d$ e.\n", "p a^1^ {$b$}\nnote :n\np {$c_d$} e.\n");
    blocks_are("a \xc2\x91 b $c$\n", "p a \xc2\x92 b {$c$}\n");
    blocks_are("$$ never ends\n\n$$x$$\n", "p $$ never ends\nmath {x}\n");
}

/* A label is of what it stands in, or before. Nobody reads its tags. */
static void labels_are_found(void **state)
{
    (void)state;
    static const char text[] =
        "# One\n\n<a id=\"a\"></a>\n![A](a.png)\n\n<a name='b'></a>\n\n- <a id=c></a>item\n\n"
        "Words <a id=\"d\">in</a> it.\n\n<a id=\"e\"></a>\n<a id=\"f\"></a> $$x$$\n\n"
        "## Two &amp; *three* `4`\n\n## <a id=\"g\"></a>One\n\n### \xc3\x84rger, "
        "\xe6\xb0\xb4!\n\n"
        "<a id=\"h\"></a>\n```lua\nx\n```\n\n"
        "## Ebb <a id=\"k\"></a>\n\nA tail <a id=\"m\"></a>\n\nLast.\n\n<a id=\"end\"></a>\n";
    static const struct {
        const char *label, *says;
    } labels[] = {{"a", "Figure 1: A"},
                  {"b", "item"},
                  {"c", "item"},
                  {"d", "Words in it."},
                  {"e", "x"},
                  {"f", "x"},
                  {"one", "One"},
                  {"two--three-4", "Two & three 4"},
                  {"g", "One"},
                  {"one-1", "One"},
                  {"\xc3\xa4rger-\xe6\xb0\xb4", "\xc3\x84rger, \xe6\xb0\xb4!"},
                  {"h", "x"},
                  {"ebb", "Ebb"},
                  {"k", "Ebb"},
                  {"m", "A tail"},
                  {"end", "Last."}};
    struct reader_document *d = read_all(text, strlen(text));
    assert_null(reader_document_label(d, "a", 0)); /* not before they are made */
    assert_int_equal(reader_document_refer(d), READER_OK);
    for (size_t i = 0; i < sizeof labels / sizeof *labels; i++) {
        const struct reader_block *block = reader_document_label(d, labels[i].label, -1);
        if (!block)
            fail_msg("there is no '%s'", labels[i].label);
        assert_string_equal(block->text, labels[i].says);
        assert_ptr_equal(reader_document_label(d, labels[i].label, 0), block);
        assert_null(reader_document_label(d, labels[i].label, 1));
    }
    assert_null(reader_document_label(d, "", -1));
    assert_null(reader_document_label(d, "none", -1));
    assert_int_equal(reader_document_add(d, "a", 1), READER_BAD_ARGUMENT);
    reader_document_destroy(d);
    /* what is no label is none */
    blocks_are(
        "a <a id=\"x\" href=\"y\">b</a> <a id=\"\">c</a> <a id=\"q r\">d</a> <a>e</a> [#](#x)",
        "p a [b](y) c d e [x](#x)\n");
    blocks_are("a[^n]\n\n[^n]: <a id=\"x\"></a>b\n", "p a^1^\nnote :n\np b\n");
    blocks_are("<a id=\"x\"></a>\n", "");
}

static void references_have_names(void **state)
{
    (void)state;
    blocks_are("# A *b* $c$\n\nSee [#](#a-b-c), *[#](#a-b-c)*.\n",
               "h1 A *b* {$c$}\np See [A ](#a-b-c)*[b]*(#a-b-c)[ ](#a-b-c){$c$}, "
               "*[A ]*(#a-b-c)*[b]*(#a-b-c)*[ ]*(#a-b-c)*{$c$}*.\n");
    blocks_are(
        "<a id=\"m\"></a>\n![The marsh](m.png)\n\n![No label](n.png)\n\n"
        "<a id=\"o\"></a>\n![](o.png)\n\n<a id=\"p\"></a>\n![Abb. #: Das Moor](p.png)\n\n"
        "[#](#m), [#](#o), [Abbildung #](#p), [figures #-](#m)[#](#o).\n",
        "picture <m.png> #1 *Figure 1: **The marsh*\npicture <n.png> *No label*\n"
        "picture <o.png> #2 *Figure 2*\npicture <p.png> #3 *Abb. **3**: Das Moor*\n"
        "p [Figure 1](#m), [Figure 2](#o), [Abbildung ](#p)[3](#p), [figures "
        "](#m)[1](#m)[-](#m)"
        "[Figure 2](#o).\n");
    blocks_are("<a id=\"e\"></a> $$x$$\n\n$$y$$\n\n<a id=\"f\"></a>\n\n```math\nz\n```\n\n"
               "By [#](#e) and [law #](#f)[^n].\n\n[^n]: As [#](#f).\n",
               "math #1 {x}\nmath {y}\nmath (math) #2 {z}\n"
               "p By [(1)](#e) and [law ](#f)[2](#f)^1^.\nnote :n\np As [(2)](#f).\n");
    /* an item has its number */
    blocks_are(
        "After [[#](#b)].\n\n4. <a id=\"a\"></a>One\n5. <a id=\"b\"></a>Two: [#](#a)\n\n"
        "- <a id=\"c\"></a>None: [#](#c)\n",
        "p After [[5](#b)].\np- 4. One\np- 5. Two: [4](#a)\np- \xe2\x80\xa2 None: [c](#c)\n");
    /* a place has the name of the heading that it stands under */
    blocks_are(
        "<a id=\"x\"></a>Before. [#](#x)\n\n# One\n\nA <a id=\"y\"></a>place. [#](#y)\n\n"
        "| [#](#y) | b |\n|---|---|\n| c | d |\n",
        "p Before. [x](#x)\nh1 One\np A place. [One](#y)\nrow [One](#y)\tb\nrow c\td\n");
    /* no references: other words, other links, code, titles */
    blocks_are("# One [#](#one)\n\n[C#](#one-) [##](#one-) [a](#one-) [#](b.md#one) [#](#) "
               "`[#](#one-)` "
               "[`#`](#one-)\n",
               "h1 One [#](#one)\np [C#](#one-) [##](#one-) [a](#one-) [#](b.md#one) [#](#) "
               "`[#](#one-)` `[#]`\n");
}

/* What leads nowhere stands as it is written, and is listed. */
/* Tables that have labels are numbered, and notes may have labels, too. */
static void tables_and_notes_have_names(void **state)
{
    (void)state;
    blocks_are("[#](#a), [tables # and](#b) [#](#c), [#](#d)[^1].\n\n<a id=\"a\"></a>\n\n"
               "| x |\n|---|\n| <a id=\"d\"></a>y |\n\n"
               "<a id=\"b\"></a>Table #: More\n\n| z |\n|---|\n\n| no label |\n|---|\n\n"
               "Tabelle #\n\n| <a id=\"c\"></a>w |\n|---|\n\n[^1]: n\n",
               "p [Table 1](#a), [tables ](#b)[2](#b)[ and](#b) [Table 3](#c), [d](#d)^1^.\n"
               "row #1 x\nrow y\np #2 Table 2: More\nrow z\nrow no label\n"
               "p #3 Tabelle 3\nrow w\nnote :1\np n\n");
    blocks_are(
        "# H\n\n[#](#x), [see # above](#y), [#](#z)[^a][^b].\n\n[^a]: <a id=\"x\"></a>One\n"
        "[^b]: Two [#](#x)\n\n    <a id=\"y\"></a>and more\n",
        "h1 H\np [Note 1](#x), [see ](#y)[2](#y)[ above](#y), [#](#z)^1^^2^.\n"
        "note :a\np One\nnote :b\np Two [Note 1](#x)\np and more\n");
}

static void lost_references_are_listed(void **state)
{
    (void)state;
    static const char first[] = "A.\n\n[Figure #](#none) and [#](#there).\n",
                      second[] = "# There\n\n- [#](#n\xc3\xb6)\n";
    struct reader_document *d = read_all(first, strlen(first));
    assert_int_equal(reader_document_add(d, second, strlen(second)), READER_OK);
    assert_int_equal(reader_document_refer(d), READER_OK);
    assert_int_equal(reader_document_refer(d), READER_OK); /* once is enough */
    assert_string_equal(d->blocks[1].text, "[Figure #](#none) and There.");
    assert_int_equal(d->lost_count, 2);
    assert_int_equal(d->lost_all, 2);
    assert_string_equal(d->lost[0].label, "none");
    assert_string_equal(d->lost[1].label, "n\xc3\xb6");
    assert_true(d->lost[0].source == 0 && d->lost[0].line == 3);
    assert_true(d->lost[1].source == 1 && d->lost[1].line == 3);
    reader_document_destroy(d);
    /* each file's own label is before that of another */
    static const char one[] =
        "# Twice\n\nOne. [#](#same)\n\n## First\n\n<a id=\"same\"></a>x\n",
                      two[] = "## Second\n\n<a id=\"same\"></a>y [#](#same) [#](#twice)\n";
    d = read_all(one, strlen(one));
    assert_int_equal(reader_document_add(d, two, strlen(two)), READER_OK);
    assert_int_equal(reader_document_refer(d), READER_OK);
    assert_string_equal(d->blocks[1].text, "One. First");
    assert_string_equal(d->blocks[5].text, "y Second Twice");
    reader_document_destroy(d);
}

/* References without end neither make a document much larger nor take long. */
/* Entries are sorted and numbered, keep what is in them, and say where they are cited. */
static void bibliographies_are_sorted(void **state)
{
    (void)state;
    blocks_are("# One\n\nAs [[#](#zola)] and [[#](#small)][^n].\n\nAgain [[#](#small), "
               "[Zola](#zola)].\n\n"
               "<a id=\"bibliography\"></a>\n\n- <a id=\"zola\"></a>*Zola*, \xc3\x89.: "
               "Paris\n- <a id=\"small\"></a>Small, "
               "D.: Water\n\n  More of it.\n- <a id=\"eo\"></a>\xc3\x89o, see [#](#small)\n- "
               "Eel\n\nBehind.\n\n"
               "[^n]: And [#](#eo), [#](#small).\n",
               "h1 One\np As [[4](#zola)] and [[3](#small)]^1^.\np Again [[3](#small), "
               "[Zola](#zola)].\n"
               "p- 1. Eel\np- 2. \xc3\x89o, see [3](#small) [\xe2\x86\x91](#cited 1)\np- 3. "
               "Small, D.: Water\n"
               "p- More of it. [\xe2\x86\x91\x31](#cited 1) [\xe2\x86\x91\x32](#cited 2) "
               "[\xe2\x86\x91\x33](#cited 4)\n"
               "p- 4. *Zola*, \xc3\x89.: Paris [\xe2\x86\x91\x31](#cited 1) "
               "[\xe2\x86\x91\x32](#cited 2)\np Behind.\n"
               "note :n\np And [2](#eo), [3](#small).\n");
    /* under a heading that has the label, and only the first list; no other is touched */
    blocks_are("- b\n- a\n\n<a id=\"bibliography\"></a>\n## Books\n\nThese:\n\n7. <a "
               "id=\"y\"></a>Y\n8. X\n   - "
               "in\n   - an\n\nand\n\n- d\n- c\n",
               "p- \xe2\x80\xa2 b\np- \xe2\x80\xa2 a\nh2 Books\np These:\np- 1. X\np-- "
               "\xe2\x80\xa2 in\n"
               "p-- \xe2\x80\xa2 an\np- 2. Y\np and\np- \xe2\x80\xa2 d\np- \xe2\x80\xa2 c\n");
    /* a heading's own name is no such label, and without a list there is nothing to be done */
    blocks_are("# Bibliography\n\n- b\n- a\n",
               "h1 Bibliography\np- \xe2\x80\xa2 b\np- \xe2\x80\xa2 a\n");
    blocks_are("<a id=\"bibliography\"></a>A\n\n# B\n\n- b\n- a\n",
               "p A\nh1 B\np- \xe2\x80\xa2 b\np- \xe2\x80\xa2 a\n");
}

static void references_are_bounded(void **state)
{
    (void)state;
    enum { TIMES = 200000 };
    static const char heading[] = "# ", reference[] = "[#](#a) ", label[] = "<a id=\"a\"></a>";
    char *text = malloc(TIMES * 40 + 100000), *at = text;
    assert_non_null(text);
    at = stpcpy(at, heading);
    for (int i = 0; i < 5000; i++)
        at = stpcpy(at, "\xc3\xa9 *x*");
    at = stpcpy(at, "\n\n");
    for (int i = 0; i < 30000; i++) /* more than there may be */
        at = stpcpy(at, label);
    for (int i = 0; i < TIMES; i++)
        at = stpcpy(at, i % 25 ? reference : "\n\n[#](#none) ");
    struct reader_document *d = read_all(text, (size_t)(at - text));
    assert_int_equal(reader_document_refer(d), READER_OK);
    size_t bytes = 0;
    for (int i = 0; i < d->blocks_count; i++) {
        assert_true(d->blocks[i].bytes <= 3 * READER_PASSAGE_BYTES);
        bytes += (size_t)d->blocks[i].bytes;
    }
    assert_true(bytes < (size_t)(at - text) + (20u << 20));
    assert_int_equal(d->lost_count, READER_LOST_MAX);
    assert_true(d->lost_all > READER_LOST_MAX && d->labels_count <= READER_LABELS_MAX + 1);
    reader_document_destroy(d);
    free(text);
}

/* ---- the project's own pages ---- */

static bool is_letter(unsigned char c)
{
    return isalnum(c) || c >= 0x80;
}

/* All that the document says, in one text. */
static char *text_of(const struct reader_document *d)
{
    size_t bytes = 1, used = 0;
    for (int pass = 0; pass < 2; pass++) {
        char *all = pass ? malloc(bytes) : NULL;
        for (int i = 0; i < d->blocks_count + d->note_blocks_count; i++) {
            const struct reader_block *b =
                i < d->blocks_count ? &d->blocks[i] : &d->note_blocks[i - d->blocks_count];
            const char *parts[3] = {b->text, b->info ? b->info : "",
                                    b->target ? b->target : ""};
            for (int k = 0; k < 3; k++) {
                size_t n = strlen(parts[k]);
                bytes += pass ? 0 : n + 1;
                if (!pass)
                    continue;
                memcpy(all + used, parts[k], n);
                used += n;
                all[used++] = ' ';
            }
            for (int k = 0; k < b->spans_count; k++) {
                const char *target = b->spans[k].target ? b->spans[k].target : "";
                size_t n = strlen(target);
                bytes += pass ? 0 : n + 1;
                if (!pass)
                    continue;
                memcpy(all + used, target, n);
                used += n;
                all[used++] = ' ';
            }
        }
        if (pass) {
            all[used] = '\0';
            return all;
        }
    }
    return NULL;
}

static char *file_read(const char *path, size_t *bytes)
{
    FILE *in = fopen(path, "rb");
    if (!in)
        fail_msg("%s cannot be read", path);
    fseek(in, 0, SEEK_END);
    *bytes = (size_t)ftell(in);
    rewind(in);
    char *text = malloc(*bytes + 1);
    assert_int_equal(fread(text, 1, *bytes, in), *bytes);
    text[*bytes] = '\0';
    fclose(in);
    return text;
}

/* The first letters of a block that are in its source as they are stand in one of the block's
 * lines. */
static void lines_are_right(const char *name, const char *source, const struct reader_block *b)
{
    const char *at = b->text;
    while (*at && !isalpha((unsigned char)*at))
        at++;
    size_t n = 0;
    while (isalpha((unsigned char)at[n]))
        n++;
    if (n < 4)
        return;
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)n, at);
    int line = 1;
    const char *from = source;
    for (; line < b->first_line && from; line++)
        from = strchr(from, '\n') ? strchr(from, '\n') + 1 : NULL;
    const char *to = from;
    for (; line <= b->last_line && to; line++)
        to = strchr(to, '\n') ? strchr(to, '\n') + 1 : NULL;
    const char *found = from ? strstr(from, word) : NULL;
    if (!found || (to && found >= to))
        fail_msg("%s: '%s' is not in lines %d to %d", name, word, b->first_line, b->last_line);
}

static void page_is_whole(const char *folder, const char *name, long *words)
{
    char path[4096];
    size_t bytes;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *source = file_read(path, &bytes);
    struct reader_document *d = read_all(source, bytes);
    char *all = text_of(d);
    for (const char *at = source; *at;) {
        const char *comment = strncmp(at, "<!--", 4) == 0 ? strstr(at, "-->") : NULL;
        if (comment) { /* HTML's: nobody reads it */
            at = comment + 3;
            continue;
        }
        size_t n = 0;
        while (is_letter((unsigned char)at[n]))
            n++;
        char word[256];
        snprintf(word, sizeof word, "%.*s", (int)n, at);
        if (n >= 3 && n < sizeof word) {
            ++*words;
            if (!strstr(all, word) && !strstr("quot amp copy nbsp", word))
                fail_msg("%s: the word '%s' is lost", name, word);
        }
        at += n ? n : 1;
    }
    for (int i = 0; i < d->blocks_count; i++)
        lines_are_right(name, source, &d->blocks[i]);
    free(all);
    free(source);
    reader_document_destroy(d);
}

static void pages_of_ours_lose_no_word(void **state)
{
    (void)state;
    DIR *folder = opendir(DOCS);
    long words = 0;
    int pages = 0;
    assert_non_null(folder);
    for (struct dirent *e; (e = readdir(folder)) != NULL;) {
        size_t n = strlen(e->d_name);
        if (n < 4 || strcmp(e->d_name + n - 3, ".md") != 0 ||
            strstr(e->d_name, "reference")) /* a megabyte of the same */
            continue;
        page_is_whole(DOCS, e->d_name, &words);
        pages++;
    }
    closedir(folder);
    assert_true(pages > 20 && words > 10000);
}

static void what_is_too_large_is_refused(void **state)
{
    (void)state;
    struct reader_document *d;
    const size_t large = READER_BYTES_MAX + 1;
    char *text = malloc(large);
    assert_non_null(text);
    memset(text, 'a', large);
    assert_int_equal(reader_document_create(&d), READER_OK);
    assert_int_equal(reader_document_add(d, text, large), READER_TOO_LARGE);
    size_t used = 0; /* one formula too many */
    for (int i = 0; i <= READER_FORMULAS_MAX; i++)
        used += (size_t)snprintf(text + used, 16, "$x$\n");
    assert_int_equal(reader_document_add(d, text, used), READER_TOO_LARGE);
    assert_non_null(strstr(reader_error(), "formulas"));
    used = 0; /* deep */
    memset(text, '>', 20000);
    assert_int_equal(reader_document_add(d, text, 20000), READER_OK);
    memset(text, '[', 20000);
    assert_int_equal(reader_document_add(d, text, 20000), READER_OK);
    reader_document_destroy(d);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(live_scripts_have_stages),
        cmocka_unit_test(blocks_are_those_of_markdown),
        cmocka_unit_test(notes_have_numbers_names_and_classes),
        cmocka_unit_test(head_of_a_file_is_not_shown),
        cmocka_unit_test(formulas_are_kept_from_markdown),
        cmocka_unit_test(labels_are_found),
        cmocka_unit_test(references_have_names),
        cmocka_unit_test(tables_and_notes_have_names),
        cmocka_unit_test(lost_references_are_listed),
        cmocka_unit_test(bibliographies_are_sorted),
        cmocka_unit_test(references_are_bounded),
        cmocka_unit_test(pages_of_ours_lose_no_word),
        cmocka_unit_test(what_is_too_large_is_refused),
    };
    if (without_library())
        return 77;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
