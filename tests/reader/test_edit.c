/* test_edit.c - documents that are edited where they are read: what one types is read, all
 * other bytes stay, what is read again in part is what would be read from the beginning, and
 * undo gives back every byte and every note's place. Random edits of documents that have all
 * that Markdown has.
 *     READER_TEST_EDITED=10000 test_reader_edit */
#include <reader_edit.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../sample.h"
#include "edited.h"
#include "without_library.h"

static char folder[] = "/tmp/lutetia-edit-XXXXXX";

/* ---- single edits ---- */

/* Puts letters in there; returns the source. */
static const char *edit_at(struct edited *e, const char *at, const char *type, int back)
{
    struct reader_edit_change change;
    size_t caret = caret_at(e, at);
    for (; back > 0; back--) {
        assert_int_equal(reader_edit_delete(e->edit, caret - 1, caret, &change), READER_OK);
        caret = change.caret;
        reader_edit_change_finish(&change);
    }
    for (; *type; type++) {
        enum reader_status status =
            *type == '\n' ? reader_edit_break(e->edit, caret, &change)
                          : reader_edit_insert(e->edit, caret, caret, type, 1, &change);
        if (status != READER_OK)
            fail_msg("'%c' in %s: %s", *type, e->files.texts[0].text, reader_error());
        caret = change.caret;
        reader_edit_change_finish(&change);
        as_from_scratch(e);
    }
    return e->files.texts[0].text;
}

static const struct {
    const char *source, *at, *type;
    int back;
    const char *becomes;
} typing[] = {
    {"A word.\n", "A |word", "b", 0, "A bword.\n"},
    {"A word.\n", "word.|", " more", 0, "A word. more\n"},
    {"A **word**.\n", "word|", "s", 0, "A **words**.\n"},
    {"A **word**.\n", "A |word", "s", 0, "A s**word**.\n"},
    {"A [word](x.md).\n", "word|", "s", 0, "A [word](x.md)s.\n"},
    {"A [word](x.md).\n", "wor|d", "s", 0, "A [worsd](x.md).\n"},
    {"A *b.\n", "*b|", "*", 0, "A *b\\*.\n"},
    {"Word\n", "|Word", "# ", 0, "#&#32;Word\n"},
    {"Word\n", "|Word", "-", 0, "-Word\n"},
    {"1 a\n", "1| a", ".", 0, "1\\. a\n"},
    {"a b\nc d\n", "b |c", "x", 0, "a b\nxc d\n"},
    {"> a b\n> c d\n", "b |c", "x", 0, "> a b\n> xc d\n"},
    {"a &amp; b\n", "&| b", "x", 0, "a &amp;x b\n"},
    {"a \\* b\n", "*| b", "x", 0, "a \\*x b\n"},
    {"a `b` c\n", "b|", "x", 0, "a `bx` c\n"},
    {"a[^1] b\n\n[^1]: note\n", "no|te", "x", 0, "a[^1] b\n\n[^1]: noxte\n"},
    {"| a | b |\n|---|---|\n| c | d |\n", "|c\td", "x", 0,
     "| a | b |\n|---|---|\n| xc | d |\n"},
    {"| a | b |\n|---|---|\n| c | d |\n", "c|\td", "|", 0,
     "| a | b |\n|---|---|\n| c\\| | d |\n"},
    {"# Head\n\nText\n", "Hea|d", "x", 0, "# Heaxd\n\nText\n"},
    {"```c\nint a;\n```\n", "int |a", "*", 0, "```c\nint *a;\n```\n"},
    {"- x\n\n  ```c\n  int a;\n  ```\n", "a;|", "\nb", 0,
     "- x\n\n  ```c\n  int a;\n  b\n  ```\n"},
    {"one two\n", "one| two", "\n", 0, "one\n\ntwo\n"},
    {"one\n\ntwo\n", "one|", "\nx", 0, "one\n\nx\n\ntwo\n"},
    {"- one\n- two\n", "one|", "\nx", 0, "- one\n- x\n- two\n"},
    {"- one\n- two\n", "two|", "\n\nx", 0, "- one\n- two\n\nx\n"},
    {"1. one\n", "one|", "\nx", 0, "1. one\n2. x\n"},
    {"- [x] one\n", "one|", "\ny", 0, "- [x] one\n- [ ] y\n"},
    {"> one two\n", "one| two", "\n", 0, "> one\n>\n> two\n"},
    {"A **word** b\n", "word| b", "", 4, "A  b\n"},
    {"A word b\n", "word|", "", 4, "A  b\n"},
    {"A word\n", "word|", "", 4, "A\n"},
    {"A word\n", "word|", "b", 4, "A b\n"},
    {"A<br>\nword\n", "|word", "b", 0, "A<br>\nbword\n"},
    {"A<br>\nword\n", "A|", "b", 0, "Ab<br>\nword\n"},
    {"A <br/> *word*\n", "|word", "", 1, "A *word*\n"},
    {"* [ ]  text\n", "|text", "b", 0, "* [ ]  btext\n"},
    {"- [x] \ttext\n", "text|", "\ny", 0, "- [x] \ttext\n- [ ] y\n"},
    {"A [word][] b\n\n[word]: c.md\n", "wo|rd", "x", 0, "A [woxrd][word] b\n\n[word]: c.md\n"},
    {"A [word] b\n\n[word]: c.md\n", "wor|d", "", 2, "A [wd][word] b\n\n[word]: c.md\n"},
    {"A [word] b\n\n[word]: c.md\n", "wor|d", "*", 0, "A [wor*d][word] b\n\n[word]: c.md\n"},
    {"A [word][w] b\n\n[w]: c.md\n", "wor|d", "x", 0, "A [worxd][w] b\n\n[w]: c.md\n"},
    {"A [*word* b]\n\n[*word* b]: c.md\n", "wor|d", "x", 0,
     "A [*worxd* b][*word* b]\n\n[*word* b]: c.md\n"},
    {"A word\n", "A|", "<br>", 0, "A<br\\> word\n"},
    {"H<sub>2</sub>O is <kbd>wet</kbd> b\n", "we|t", "x", 0,
     "H<sub>2</sub>O is <kbd>wext</kbd> b\n"},
    {"A <img src=\"b.png\" alt=\"cd\"> word\n", "wo|rd", "x", 0,
     "A <img src=\"b.png\" alt=\"cd\"> woxrd\n"},
    {"A ![](b/c.png) word ![d](e.png) f\n", "|f", "x", 0,
     "A ![](b/c.png) word ![d](e.png) xf\n"},
    {"<p align=\"center\">\n  One <b>two</b>\n</p>\n", "tw|o", "x", 0,
     "<p align=\"center\">\n  One <b>twxo</b>\n</p>\n"},
    {"<h1 align=center>A &amp; b</h1>\n\nc\n", "|b", "x", 0,
     "<h1 align=center>A &amp; xb</h1>\n\nc\n"},
    {"<div align=center>\n\none two\n\n</div>\n\nb\n", "one| two", "\n", 0,
     "<div align=center>\n\none\n\ntwo\n\n</div>\n\nb\n"},
};

static void typed_letters_are_written(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof typing / sizeof *typing; i++) {
        struct edited e;
        edited_begin(&e, typing[i].source, NULL);
        const char *now = edit_at(&e, typing[i].at, typing[i].type, typing[i].back);
        if (strcmp(now, typing[i].becomes) != 0)
            print_message("case %zu: %s", i, typing[i].source);
        assert_string_equal(now, typing[i].becomes);
        struct reader_edit_change change;
        while (reader_edit_can(e.edit, false)) {
            assert_int_equal(reader_edit_undo(e.edit, false, &change), READER_OK);
            reader_edit_change_finish(&change);
        }
        assert_string_equal(e.files.texts[0].text, typing[i].source);
        as_from_scratch(&e);
        edited_end(&e);
    }
}

static const struct {
    const char *source, *at;
    bool alone;
} lines[] = {
    {"Before\n\n# Head\n\nText\n", "Hea|d", true},
    {"Head\nof two\n===\n\nText\n", "two|", true},
    {"# Head\nText\n", "Tex|t", true},
    {"A\n\n- one\n- two\n    1. deep\n\n       more\n- three\n\nB\n", "mor|e", true},
    {"- one\n\n- two\n\n- three\n", "tw|o", true},
    {"3. one\n4. two\n", "tw|o", true},
    {"- [x] done\n- [ ] to do\n", "do|ne", true},
    {"> one\n> two\n>\n> - item\n", "ite|m", true},
    {"| a | b |\n|---|:-:|\n| c | d |\n", "c|", true},
    {"One\n\n| a |\n|---|\n\n| a |\n|---|\n| c |\n", "c|", true},
    {"- [one](one.md) and *two*\n- [three](#three)\n\n# Three\n", "tw|o", true},
    {"- [one](#head)\n\n# Head\n", "on|e", true},
    {"One\n\n# Head\n\n[r]: x.md\n", "Hea|d", true},
    {"- a [r]\n- b\n\n[r]: x.md\n", "|b", true},   /* brackets are defined */
    {"- a [r]\n- b\n\n [r]: x.md\n", "|b", false}, /* perhaps */
    {"- a [r]\n- b\n\n[r]: x.md\n\"more\"\n", "|b", false},
    {"- a [r]\n- b\n\n```\n\n[r]: x.md\n\n```\n", "|b", false},
    {"- a [r]\n- b\n\n<!--\n\n[r]: x.md\n\n-->\n", "|b", false},
    {"A <b>bold</b> word<br>\nand <https://a.b>\n", "wo|rd", true},
    {"<a id=\"b\"></a>A label, and [see](#b).\n\n# C\n", "lab|el", true},
    {"A <!-- no --> word\n", "wo|rd", false},
    {"A <img src=\"b.png\" width=20> word\n", "wo|rd", true},
    {"<div align=center>\n\nA word\n\n</div>\n", "wo|rd", false}, /* where it stands */
    {"<p align=center>A word</p>\n\nB\n", "wo|rd", false},
    {"# Head\n\n## B\n\nSee [#](#b).\n", "Hea|d", false},
    {"# Head\n\nSee [#](#head).\n", "Se|e", false},
    {"- <a id=\"bibliography\"></a>b\n- a\n", "a|", false},
    {"# Bibliography\n\n- zc\n- za\n", "za|", false},
    {"- one\n\n```\ncode\n```\n", "on|e", true},
    {"- one\n\n      code\n\ntext\n", "on|e", true},
    {"```\n- one\n\n- two\n```\n", "on|e", true},
    {"A\n\n```c\nint a;\n\n$b `c`\n```\nB\n", "int| a", true},
    {"```\none\ntwo\n```\n", "on|e\ntwo", true},
    {"A\n```\none\n```\n", "on|e", false}, /* formulas may go over its fences */
    {"- A\n\n  ```\n  one\n  ```\n", "on|e", true},
    {"- A\n\n  ```\n  one\n\n- B\n\nC\n", "|B", false}, /* formulas behind it are not */
    {"> ```\n> one\n> ```\n\nB\n", "on|e", true},
    {"- A\n\n ```\n one\n ```\n\nB\n", "|A", false}, /* it is in nothing */
    {"````\n```\none\n```\n````\n", "on|e", false},
    {"    ```\n\n```\n$one$\n```\n\n$a$\n", "on|e", false}, /* no fence to formulas */
    {"~~~ lua live\none()\n~~~\n", "on|e", true},
    {"```math\nx_1\n```\n", "x_|1", true},
    {"A $x^2$ b.\n", "A |$", true},
    {"A\n\n$$x^2$$\n\nB\n", "x|^2", true},
    {"A\n```\n$b\n```\n\nC $d$\n", "C |$", true},
    {"A[^n]\n\n[^n]: - one\n\n    - two\n", "tw|o", true},
    {"A[^n] b[^m].\n\n[^m]: One.\n[^n]: Two *three*,\nfour.\n\n    Five.\n", "Tw|o", true},
    {"A[^n] b[^m].\n\n[^m]: One.\n[^n]: Two *three*,\nfour.\n\n    Five.\n", "Fiv|e", true},
    {"A[^n] b[^m].\n\n[^m]: One.\n[^n]: Two.\n", "On|e", true},
    {"A[^n].\n\n[^n]: Two [three](a.md).\n", "Tw|o", true},
    {"A[^n].\n\n[^n]: Two [r].\n\n[r]: a.md\n", "Tw|o", true},
    {"A[^n].\n\n[^n]: Two[^margin:m].\n\n[^margin:m]: Three.\n", "Tw|o", true},
    {"A[^n].\n\nB[^m] c[^n].\n\n[^n]: N.\n[^m]: M.\n", "B|2", true},
    {"A[^n].\n\nB[^N].\n\n[^n]: N.\n", "B|1", false}, /* a name of other letters */
    {"A[^n].\n\n[^n]: costs $5\n[^m]: and $6\n", "co|sts", false},
    {"<!--\n\n- no\n\n-->\n\n- one\n", "on|e", true},
};

/* A letter in a heading, an item, a quote, a cell is read with the lines around it alone; where
 * other blocks have to do with it, all is read. */
static void touched_blocks_are_read_alone(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        struct edited e;
        struct reader_edit_change change;
        edited_begin(&e, lines[i].source, NULL);
        const size_t caret = caret_at(&e, lines[i].at);
        if (reader_edit_insert(e.edit, caret, caret, "x", 1, &change) != READER_OK)
            fail_msg("%s: %s", lines[i].source, reader_error());
        if ((change.block >= 0) != lines[i].alone)
            fail_msg("%s is%s read alone", lines[i].source, lines[i].alone ? " not" : "");
        reader_edit_change_finish(&change);
        as_from_scratch(&e);
        edited_end(&e);
    }
}

/* Blank lines that go behind a block move all lines that follow. */
static void blank_lines_are_counted(void **state)
{
    static const char *const sources[] = {"Text\n\n\n\nB\n", "# Head\n\n\n\nB\n",
                                          "- a\n- b\n\n\n\nB\n"};
    (void)state;
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++) {
        struct edited e;
        struct reader_edit_change change;
        edited_begin(&e, sources[i], NULL);
        const size_t at = strlen(sources[i]) - 5;
        assert_int_equal(reader_edit_source(e.edit, 0, at, at + 1, "", 0, &change), READER_OK);
        reader_edit_change_finish(&change);
        as_from_scratch(&e);
        edited_end(&e);
    }
}

/* ---- random edits ---- */

static const char *const pieces[] = {
    "Some words that stand in a paragraph, and *more* of them, so that\nit has two lines.\n\n",
    "A **heavy** word, `code`, a [link](other.md \"title\"), an &amp; and \\*stars\\*.\n\n",
    "# A heading\n\n",
    "Under\nit\n---\n\n",
    "- one\n- two *slanted*\n  goes on\n    - deeper\n- three\n\n",
    "1. first\n2. second\n\n   of the second\n\n",
    "- [ ] to do\n- [x] done\n\n",
    "> A quote\n> that goes on\nlazily\n\n",
    "> - an item\n>\n>   in a quote\n\n",
    "```c\nint main(void)\n{\n    return 0;\n}\n```\n\n",
    "~~~sh\necho $HOME `date` ~\n\n- no\n~~~\nbehind\n\n",
    "```lua live\nfunction draw() return nil end\n```\n\n",
    "```math\n\\frac{a}{b}\n```\n\n",
    "1. in\n\n   ```\n   code\n   ```\n\n",
    "$$\nE = m c^2\n$$\n\n",
    "Again[^n], $z$, [^m] and [^o].\n\n[^o]: Third, $5, with `code`\nlazily.\n\n",
    "    indented code\n    goes on\n\n",
    "| a | b |\n|---|:-:|\n| c *d* | e |\n| f \\| g | |\n\n",
    "A note[^n] and [^m].\n\n[^n]: It *says* this.\n[^margin:m]: And that.\n\n    More of "
    "it.\n\n",
    "Water is $x^2$ deep, $$y_1$$\n\n",
    "<a id=\"pond\"></a> A label, and [#](#a-heading), [see](#pond).\n\n",
    "<div>\nHTML\n</div>\n\n",
    "---\n\n",
    "Hard  \nbreak and\\\nanother, www.example.org and <https://a.b/c>.\n\n",
    "\xc3\x9c"
    "ber Fl\xc3\xbc"
    "sse \xe6\xb0\xb4\xe5\xa2\xa8, e\xcc\x81 end   \n\n",
    "<!-- nothing -->\n\n",
    "- [ ]  two blanks\n- [x] \t three\n\n",
    "[Words]: a.md\n[w]: <b c>\n\nA [words][] and [words], ![words], [w] [*w*][W].\n\n",
    "Lines<br>\nthat *tags*<br/>end, `too`<BR >.<br>\n\n<br>\n\n> quoted<br>\n> and <br>\n\n",
    "| a<br>b | c |\n|---|---|\n| *d*<br/>e | <br>f |\n\n",
    "Line with\r\nits ends\r\n\r\n",
    "***both** one*, ~~struck~~, __a__ _b_ snake_case_word 2*3*4\n\n",
    "[r]: https://a.b \"c\"\n\nA [reference][r] and [r].\n\n",
};

static const char *const typed[] = {"a", "word",     " ", "two words", "*",    "_",  "#",
                                    "[", "]",        "`", "<",         "<br>", "&",  "&amp;",
                                    "$", "|",        "-", "1.",        ">",    "\\", "~",
                                    "!", "\xc3\xa9", ":", "(",         "=",    "+",  "x y"};

struct dice {
    uint64_t state;
};

static size_t below(struct dice *d, size_t n)
{
    return n ? sample_word(&d->state) % n : 0;
}

static char *pieces_write(struct dice *d)
{
    char *out = NULL;
    size_t bytes;
    FILE *to = open_memstream(&out, &bytes);
    for (size_t n = 1 + below(d, 9); n > 0; n--)
        fputs(pieces[below(d, sizeof pieces / sizeof *pieces)], to);
    fclose(to);
    return out;
}

/* A place between letters, most of them in text. */
static size_t place(struct dice *d, const struct reader_document *doc)
{
    size_t at = below(d, doc->plain_bytes + 1);
    while (at > 0 && ((unsigned char)doc->plain[at] & 0xc0) == 0x80)
        at--;
    const struct reader_block *b = reader_document_block(doc, at);
    if (b && at < b->at)
        at = b->at;
    if (b && at > b->at + (size_t)b->bytes)
        at = b->at + (size_t)b->bytes;
    return at;
}

/* Letters alone: neither blanks nor line ends, nor the signs of headings. */
static char *letters_of(const char *text, size_t bytes)
{
    char *out = malloc(bytes + 1);
    size_t n = 0;
    for (size_t i = 0; i < bytes; i++)
        if (!strchr(" \n\t#`0123456789", text[i]))
            out[n++] = text[i];
    out[n] = '\0';
    return out;
}

struct was {
    char *plain, *texts[2];
    size_t plain_bytes;
};

static void was_keep(const struct edited *e, struct was *was)
{
    was->plain = strdup(e->document->plain);
    was->plain_bytes = e->document->plain_bytes;
    for (int i = 0; i < 2; i++)
        was->texts[i] = strdup(e->files.texts[i].text);
}

static void was_free(struct was *was)
{
    free(was->plain);
    free(was->texts[0]);
    free(was->texts[1]);
}

/* What is read is what was there, with these letters in place of begin..end. Headings' names
 * may have changed references: then only letters around are compared. */
static void reads_as_meant(const struct edited *e, const struct was *was, size_t begin,
                           size_t end, const char *text)
{
    char *meant = NULL;
    if (asprintf(&meant, "%.*s%s%s", (int)begin, was->plain, text, was->plain + end) < 0)
        fail();
    char *a = letters_of(meant, strlen(meant)),
         *b = letters_of(e->document->plain, e->document->plain_bytes);
    if (!strstr(was->texts[0], "[#]") && !strstr(was->texts[1], "[#]"))
        assert_string_equal(a, b);
    free(a);
    free(b);
    free(meant);
}

/* Bytes of the sources that are other are few: the rest is what it was, on both sides. */
static void others_stay(const struct edited *e, const struct was *was, int most)
{
    int other = 0;
    for (int i = 0; i < 2; i++) {
        const char *a = was->texts[i], *b = e->files.texts[i].text;
        size_t n = strlen(a), m = strlen(b), begin = 0, back = 0;
        other += strcmp(a, b) != 0;
        while (begin < n && begin < m && a[begin] == b[begin])
            begin++;
        while (back < n - begin && back < m - begin && a[n - 1 - back] == b[m - 1 - back])
            back++;
        if (most >= 0)
            assert_true(n - begin - back <= (size_t)most);
    }
    assert_true(other <= 1); /* one file */
}

static void all_stays(const struct edited *e, const struct was *was)
{
    assert_string_equal(e->document->plain, was->plain);
    for (int i = 0; i < 2; i++)
        assert_string_equal(e->files.texts[i].text, was->texts[i]);
}

enum { NAME_BYTES = 12 }; /* of a link's in the pieces, with its brackets */

struct counts {
    int typed, refused, in_place, deleted, deleted_refused;
};

static void insert_some(struct edited *e, struct dice *d, const struct was *was,
                        struct counts *n)
{
    struct reader_edit_change change;
    const char *text = typed[below(d, sizeof typed / sizeof *typed)];
    const size_t at = place(d, e->document);
    enum reader_status status =
        reader_edit_insert(e->edit, at, at, text, strlen(text), &change);
    n->typed++;
    n->refused += status != READER_OK;
    n->in_place += change.block >= 0;
    if (status == READER_OK && (change.before || change.block >= 0)) {
        /* a link [words][] gets its name between its brackets */
        const bool named = strstr(was->texts[0], "][]") || strstr(was->texts[1], "][]");
        reads_as_meant(e, was, at, at, text);
        others_stay(e, was, named ? NAME_BYTES : 0);
    } else {
        all_stays(e, was);
    }
    reader_edit_change_finish(&change);
}

static void delete_some(struct edited *e, struct dice *d, const struct was *was,
                        struct counts *n)
{
    struct reader_edit_change change;
    size_t begin = place(d, e->document), end = begin;
    for (size_t k = 1 + below(d, below(d, 4) ? 4 : 60); k > 0 && end < was->plain_bytes; k--)
        for (end++; ((unsigned char)was->plain[end] & 0xc0) == 0x80;)
            end++;
    const enum reader_status status = reader_edit_delete(e->edit, begin, end, &change);
    n->deleted++;
    n->deleted_refused += status != READER_OK;
    if (status == READER_OK && (change.before || change.block >= 0)) {
        reads_as_meant(e, was, begin, end, "");
        others_stay(e, was, -1);
    } else {
        all_stays(e, was);
    }
    reader_edit_change_finish(&change);
}

static void edit_some(struct edited *e, struct dice *d, struct counts *n)
{
    struct reader_edit_change change;
    struct was was;
    was_keep(e, &was);
    switch (below(d, 8)) {
    case 0:
        if (reader_edit_break(e->edit, place(d, e->document), &change) == READER_OK)
            others_stay(e, &was, 4);
        else
            all_stays(e, &was);
        reader_edit_change_finish(&change);
        break;
    case 1:
    case 2:
        delete_some(e, d, &was, n);
        break;
    case 3:
        if (reader_edit_can(e->edit, below(d, 2))) {
            reader_edit_undo(e->edit, reader_edit_can(e->edit, true) && below(d, 2), &change);
            reader_edit_change_finish(&change);
        }
        break;
    default:
        insert_some(e, d, &was, n);
    }
    was_free(&was);
    as_from_scratch(e);
}

static void remarks_write(struct edited *e, struct dice *d)
{
    char path[100];
    snprintf(path, sizeof path, "%s/edit.notes", folder);
    unlink(path);
    assert_int_equal(reader_remarks_open(path, &e->remarks), READER_OK);
    for (int i = 0; i < 6; i++) {
        int index;
        const size_t begin = place(d, e->document), end = begin + below(d, 12);
        const struct reader_remark what = {.kind = READER_REMARK_HIGHLIGHT};
        if (end <= e->document->plain_bytes)
            assert_int_equal(reader_remarks_add(e->remarks, &what, e->document->plain,
                                                e->document->plain_bytes, begin, end, &index),
                             READER_OK);
    }
    reader_edit_destroy(e->edit);
    assert_int_equal(reader_edit_create(&e->document, &e->files, e->remarks, &e->edit),
                     READER_OK);
}

/* Undo to the beginning, and all again. */
static void undo_gives_all_back(struct edited *e, const struct was *first,
                                const struct reader_remark *remarks)
{
    struct was last;
    struct reader_edit_change change;
    while (reader_edit_can(e->edit, true)) {
        assert_int_equal(reader_edit_undo(e->edit, true, &change), READER_OK);
        reader_edit_change_finish(&change);
    }
    was_keep(e, &last);
    for (int redo = 0; redo < 2; redo++) {
        while (reader_edit_can(e->edit, redo)) {
            assert_int_equal(reader_edit_undo(e->edit, redo, &change), READER_OK);
            reader_edit_change_finish(&change);
        }
        all_stays(e, redo ? &last : first);
        for (int i = 0; i < reader_remarks_count(e->remarks) && !redo; i++) {
            const struct reader_remark *r = reader_remarks_get(e->remarks, i);
            assert_false(r->orphan);
            assert_int_equal(r->begin, remarks[i].begin);
            assert_int_equal(r->end, remarks[i].end);
        }
        as_from_scratch(e);
    }
    was_free(&last);
}

static void random_edits(void **state)
{
    const char *wanted = getenv("READER_TEST_EDITED");
    const int documents = wanted ? atoi(wanted) : 40;
    struct counts n = {0};
    (void)state;
    for (int i = 1; i <= documents; i++) {
        struct dice d = {(uint64_t)i * SAMPLE_GOLDEN};
        char *one = pieces_write(&d), *two = pieces_write(&d);
        struct edited e;
        struct was first;
        struct reader_remark remarks[8];
        edited_begin(&e, one, two);
        was_keep(&e, &first);
        remarks_write(&e, &d);
        for (int k = 0; k < reader_remarks_count(e.remarks); k++)
            remarks[k] = *reader_remarks_get(e.remarks, k);
        for (int k = 0; k < 40; k++)
            edit_some(&e, &d, &n);
        undo_gives_all_back(&e, &first, remarks);
        was_free(&first);
        edited_end(&e);
        free(one);
        free(two);
    }
    print_message("%d typed, %d refused, %d in place; %d deleted, %d refused\n", n.typed,
                  n.refused, n.in_place, n.deleted, n.deleted_refused);
    assert_true(n.refused * 4 < n.typed);
    assert_true(n.in_place * 4 > n.typed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(typed_letters_are_written),
        cmocka_unit_test(touched_blocks_are_read_alone),
        cmocka_unit_test(blank_lines_are_counted),
        cmocka_unit_test(random_edits),
    };
    if (without_library())
        return 77;
    setlocale(LC_ALL, "C.UTF-8");
    if (!mkdtemp(folder))
        return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
