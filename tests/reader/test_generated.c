/* test_generated.c - documents made by chance of all that Markdown has: lists, quotes, tables,
 * code, notes, links, formulas, one within the other. Each word in them is one of a kind, so it
 * is known which must be read, in which order: none is lost, said twice or moved. At widths by
 * chance, in templates that are built in or made by chance, each word has its place in the
 * window, none stands on another, and none is beyond the edges.
 *
 *     READER_TEST_GENERATED=1000 test_reader_generated
 */
#include <reader_document.h>
#include <reader_template.h>
#include <reader_view.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../sample.h"
#include "without_library.h"

enum { WORD = 8, WORDS_MAX = 4000, DEPTH = 3, INDENT_MAX = 64 };

/* A document that is being made, and the words that must be read in it. */
struct made {
    FILE *out;
    uint64_t state;
    char words[WORDS_MAX][WORD + 1], notes[WORDS_MAX][WORD + 1];
    int count, notes_count, number, links, noted;
    char indent[INDENT_MAX]; /* before each line */
};

static int chance(struct made *m, int below)
{
    return (int)(sample_word(&m->state) % (unsigned)below);
}

/* The next word; it is read in the text, or in a note. */
static const char *word_new(struct made *m, bool noted)
{
    char *word = noted ? m->notes[m->notes_count++] : m->words[m->count++];
    int n = ++m->number;
    for (int i = WORD - 1; i > 0; i--, n /= 20)
        word[i] = "bcdfghjklmnpqrstvwxz"[n % 20];
    word[0] = 'q';
    word[WORD] = '\0';
    return word;
}

static const char *word(struct made *m)
{
    return word_new(m, false);
}

/* ---- lines ---- */

static void link_make(struct made *m)
{
    static const char *const targets[] = {"https://a.b/c", "d.md#e", "<f g>", "#h \"title\"",
                                          ""};
    fprintf(m->out, "[%s](%s)", word(m), targets[chance(m, 5)]);
}

static void inline_make(struct made *m)
{
    switch (chance(m, 16)) {
    case 0:
        fprintf(m->out, "*%s*", word(m));
        return;
    case 1:
        fprintf(m->out, "**%s**", word(m));
        return;
    case 2:
        fprintf(m->out, "~~%s~~", word(m));
        return;
    case 3:
        fprintf(m->out, "`%s`", word(m));
        return;
    case 4:
        link_make(m);
        return;
    case 5:
        fprintf(m->out, "***%s** ", word(m));
        fprintf(m->out, "%s*", word(m));
        return;
    case 6:
        fprintf(m->out, "<https://a.b/%s>", word(m));
        return;
    case 7:
        fprintf(m->out,
                chance(m, 2) ? "![%s](pictures/none.png)"
                             : "<img src='pictures/none.png' alt='%s'>",
                word(m));
        return;
    case 8:
        fprintf(m->out, "$\\mathrm{%s}^2$", word(m));
        return;
    case 9:
        fprintf(m->out, "%s&amp;\\*&copy;", word(m));
        return;
    case 10:
        fprintf(m->out, "[%s][r%d]", word(m), m->links++);
        return;
    case 11:
        fprintf(m->out, "%s[^n%d]", word(m), m->noted++);
        return;
    default:
        fputs(word(m), m->out);
    }
}

static void line_make(struct made *m, int words)
{
    for (int i = 0; i < words; i++) {
        if (i)
            fputc(' ', m->out);
        inline_make(m);
    }
}

static void line_begin(struct made *m)
{
    fputs(m->indent, m->out);
}

/* A blank line, of a quote too. */
static void line_blank(struct made *m)
{
    size_t n = strlen(m->indent);
    while (n && m->indent[n - 1] == ' ')
        n--;
    fprintf(m->out, "%.*s\n", (int)n, m->indent);
}

/* ---- blocks ---- */

static void blocks_make(struct made *m, int depth, int count);

static void paragraph(struct made *m)
{
    line_begin(m);
    line_make(m, 1 + chance(m, 12));
    fputc('\n', m->out);
    for (int more = chance(m, 3); more > 0; more--) {
        line_begin(m);
        fputs(word(m), m->out); /* so that it begins nothing else */
        fputc(' ', m->out);
        line_make(m, 1 + chance(m, 12));
        fputs(chance(m, 4) ? "\n" : "\\\n", m->out);
    }
    if (chance(m, 4) == 0) {
        line_begin(m);
        fprintf(m->out, "%s\n", word(m));
    }
}

static void heading(struct made *m)
{
    line_begin(m);
    fprintf(m->out, "%.*s ", 1 + chance(m, 6), "######");
    line_make(m, 1 + chance(m, 3));
    fputc('\n', m->out);
}

static void code(struct made *m)
{
    static const char *const infos[] = {"", "c", "lua live 300x80", "lua live", "c paris"};
    line_begin(m);
    fprintf(m->out, "```%s\n", infos[chance(m, 5)]);
    for (int lines = chance(m, 4); lines > 0; lines--) {
        line_begin(m);
        fprintf(m->out, "  %s = ", word(m));
        fprintf(m->out, "*%s*;\n", word(m));
    }
    line_begin(m);
    fputs("```\n", m->out);
}

static void table(struct made *m)
{
    const int columns = 1 + chance(m, 4);
    for (int row = -2, rows = 1 + chance(m, 4); row < rows; row++) {
        line_begin(m);
        for (int i = 0; i < columns; i++) {
            fputs("| ", m->out);
            if (row == -1)
                fputs(i % 2 ? "--:" : "---", m->out);
            else
                fputs(word(m), m->out);
            fputc(' ', m->out);
        }
        fputs("|\n", m->out);
    }
}

static void formula(struct made *m)
{
    line_begin(m);
    fprintf(m->out, "$$\\frac{\\mathrm{%s}}{x}$$\n", word(m));
}

/* What is in it stands behind its sign. */
static void nested(struct made *m, int depth, const char *first, const char *others)
{
    const size_t before = strlen(m->indent);
    line_begin(m);
    fputs(first, m->out);
    line_make(m, 1 + chance(m, 4));
    fputc('\n', m->out);
    strcat(m->indent, others);
    if (chance(m, 3) == 0) {
        line_blank(m);
        blocks_make(m, depth + 1, 1 + chance(m, 3));
    }
    m->indent[before] = '\0';
}

static void list(struct made *m, int depth)
{
    static const struct {
        const char *first, *others;
    } signs[] = {{"- ", "  "}, {"1. ", "   "}, {"- [x] ", "  "}, {"* ", "  "}};
    const int sign = chance(m, 4);
    for (int items = 1 + chance(m, 4); items > 0; items--)
        nested(m, depth, signs[sign].first, signs[sign].others);
}

static void block_make(struct made *m, int depth)
{
    switch (chance(m, 11)) {
    case 0:
        heading(m);
        return;
    case 1:
        code(m);
        return;
    case 2:
        table(m);
        return;
    case 3:
        formula(m);
        return;
    case 4:
        line_begin(m);
        fputs("---\n", m->out);
        return;
    case 5:
    case 6:
        if (depth < DEPTH) {
            list(m, depth);
            return;
        }
        break;
    case 7:
        if (depth < DEPTH) {
            nested(m, depth, "> ", "> ");
            return;
        }
        break;
    default:
        break;
    }
    paragraph(m);
}

static void blocks_make(struct made *m, int depth, int count)
{
    for (int i = 0; i < count; i++) {
        block_make(m, depth);
        line_blank(m);
        if (depth == 0 && chance(m, 3) == 0) /* lists that follow each other are two */
            fputs("<!-- nobody reads this -->\n\n", m->out);
    }
}

/* Links' targets and notes stand last. Owns: the caller frees it. */
static char *document_make(struct made *m, uint64_t seed)
{
    char *text = NULL;
    size_t bytes = 0;
    *m = (struct made){.state = seed, .out = open_memstream(&text, &bytes)};
    blocks_make(m, 0, 3 + chance(m, 15));
    for (int i = 0; i < m->links; i++)
        fprintf(m->out, "[r%d]: https://x.y/%d\n", i, i);
    for (int i = 0; i < m->noted; i++) {
        fprintf(m->out, "\n[^n%d]: %s ", i, word_new(m, true));
        fprintf(m->out, "*%s*\n", word_new(m, true));
    }
    fclose(m->out);
    return text;
}

/* ---- what must hold ---- */

static const char *source; /* to be shown where something is wrong */
static unsigned long long seed_now;

static void word_is_once(const struct reader_document *d, const char *word, const char *from,
                         const char **found)
{
    const char *first = strstr(d->plain, word);
    if (!first || strstr(first + 1, word) || first < from)
        fail_msg("seed %llu: '%s' is %s\n%s", seed_now, word,
                 !first         ? "lost"
                 : first < from ? "before those that stand before it"
                                : "said twice",
                 source);
    *found = first;
}

static void words_are_read(const struct reader_document *d, const struct made *m)
{
    const char *at = d->plain, *notes = d->plain;
    for (int i = 0; i < m->count; i++)
        word_is_once(d, m->words[i], at, &at);
    for (int i = 0; i < m->notes_count; i++)
        word_is_once(d, m->notes[i], notes, &notes);
}

/* Its boxes, where the view has been led to it; within the window's width. */
static int word_boxes(struct reader_view *view, size_t byte, double width,
                      struct reader_box boxes[8])
{
    const int count = reader_view_boxes(view, byte, byte + WORD, boxes, 8);
    for (int i = 0; i < count && i < 8; i++)
        if (boxes[i].x < -1 || boxes[i].x + boxes[i].width > width + 1)
            fail_msg("seed %llu: '%.8s' stands at %g to %g in a window %g wide\n%s", seed_now,
                     source, boxes[i].x, boxes[i].x + boxes[i].width, width, source);
    return count < 8 ? count : 8;
}

/* A template by chance: most are as one would make them. */
static void template_make(struct made *m, struct reader_template *t)
{
    char text[600];
    const int kind = chance(m, 5);
    if (kind < 3) {
        assert_int_equal(reader_template_named(reader_template_names[kind], t), READER_OK);
        return;
    }
    const int a = 1 + chance(m, 20), b = 4 + chance(m, 30), c = 4 + chance(m, 40);
    const int notes = chance(m, 3);
    snprintf(text, sizeof text,
             "columns %d..%d %d %d 1* %d\ngutter 1.%d\ntext 2 3\n%sheadings %d-%d\n"
             "figures %d\ndemonstrations 1-%d\ntables 2-%d\n",
             a, a + chance(m, 9), b, c, 1 + chance(m, 14), chance(m, 9),
             notes == 0   ? ""
             : notes == 1 ? "notes 1 5\n"
                          : "notes 5 1\n",
             1 + chance(m, 2), 2 + chance(m, 4), 2 + chance(m, 4), 1 + chance(m, 5),
             2 + chance(m, 4));
    assert_int_equal(reader_template_parse(text, strlen(text), "chance", t), READER_OK);
}

/* Neither's middle is on the other. */
static bool apart(const struct reader_box *a, const struct reader_box *b)
{
    const double x = a->x + a->width / 2, y = a->y + a->height / 2;
    return x < b->x || x > b->x + b->width || y < b->y || y > b->y + b->height;
}

struct placed {
    const char *word;
    struct reader_box box;
};

/* All words that are seen, of text and of notes, are apart. */
static void window_apart(const struct reader_document *d, const struct made *m,
                         struct reader_view *view, double width)
{
    enum { MOST = 1500 };
    static struct placed seen[MOST];
    int count = 0;
    for (int kind = 0; kind < 2; kind++)
        for (int i = 0; i < (kind ? m->notes_count : m->count) && count + 8 < MOST; i++) {
            struct reader_box boxes[8];
            const char *word = kind ? m->notes[i] : m->words[i];
            const char *at = strstr(d->plain, word);
            const int n = at ? word_boxes(view, (size_t)(at - d->plain), width, boxes) : 0;
            for (int k = 0; k < n; k++)
                seen[count++] = (struct placed){word, boxes[k]};
        }
    for (int a = 0; a < count; a++)
        for (int b = 0; b < a; b++)
            if (strcmp(seen[a].word, seen[b].word) != 0 &&
                (!apart(&seen[a].box, &seen[b].box) || !apart(&seen[b].box, &seen[a].box)))
                fail_msg("seed %llu: '%s' and '%s' stand on each other in a window %g wide\n%s",
                         seed_now, seen[a].word, seen[b].word, width, source);
}

/* Half of the notes are opened where they are called. */
static void notes_open(const struct reader_document *d, struct made *m,
                       struct reader_view *view)
{
    for (int i = 0; i < d->blocks_count; i++)
        for (int k = 0; k < d->blocks[i].spans_count; k++) {
            const struct reader_span *s = &d->blocks[i].spans[k];
            if ((s->look & READER_NOTE) && s->note >= 0 && chance(m, 2))
                assert_int_equal(
                    reader_view_note(view, s->note, d->blocks[i].at + (size_t)s->begin),
                    READER_OK);
        }
}

static void templates_have_places(const struct reader_document *d, struct made *m)
{
    struct reader_pages_setup setup = reader_pages_setup_default();
    struct reader_template t;
    struct reader_view *view;
    setup.font = "DejaVuSerif";
    setup.size_px = 10 + chance(m, 12);
    setup.stage_strip_px = 40;
    setup.height_px = 100 + chance(m, 900);
    setup.width_px = 20 + chance(m, 2500);
    template_make(m, &t);
    reader_template_grid(&t, setup.width_px, setup.size_px, true, &setup.grid);
    assert_int_equal(reader_view_create(d, &setup, &view), READER_OK);
    notes_open(d, m, view);
    for (int turn = 0; turn < 4; turn++) {
        for (int i = 0; i < m->count; i += 1 + chance(m, 30)) {
            const struct reader_shown *shown;
            struct reader_box boxes[8];
            int count;
            const size_t byte = (size_t)(strstr(d->plain, m->words[i]) - d->plain);
            /* in the narrowest windows some words are wider than they */
            const double width = setup.width_px < 15 * setup.size_px ? 1e4 : setup.width_px;
            if (reader_view_go(view, byte, 30) != READER_OK)
                fail_msg("seed %llu: %s", seed_now, reader_error());
            if (reader_view_look(view, &shown, &count) != READER_OK)
                fail_msg("seed %llu: %s", seed_now, reader_error());
            if (word_boxes(view, byte, width, boxes) < 1)
                fail_msg("seed %llu: '%s' has no place at a width of %g\n%s", seed_now,
                         m->words[i], setup.width_px, source);
            window_apart(d, m, view, width);
        }
        setup.width_px = 20 + chance(m, 2500);
        if (chance(m, 2))
            template_make(m, &t);
        reader_template_grid(&t, setup.width_px, setup.size_px, true, &setup.grid);
        size_t before, after;
        assert_int_equal(reader_view_top(view, &before), READER_OK);
        assert_int_equal(reader_view_set(view, &setup), READER_OK);
        assert_int_equal(reader_view_top(view, &after), READER_OK);
        assert_int_equal(before, after); /* the line that is read stays */
    }
    reader_view_destroy(view);
}

static void words_have_places(const struct reader_document *d, const struct made *m,
                              double width)
{
    struct reader_pages_setup setup = reader_pages_setup_default();
    struct reader_view *view;
    struct reader_box before[8], now[8];
    int before_count = 0;
    setup.font = "DejaVuSerif";
    setup.width_px = width;
    setup.height_px = 500;
    setup.margin_px = 10;
    setup.size_px = 14;
    setup.stage_strip_px = 40;
    assert_int_equal(reader_view_create(d, &setup, &view), READER_OK);
    for (int i = 0; i < m->count; i++) {
        const struct reader_shown *shown;
        int count;
        const size_t byte = (size_t)(strstr(d->plain, m->words[i]) - d->plain);
        assert_int_equal(reader_view_go(view, byte, 100), READER_OK);
        assert_int_equal(reader_view_look(view, &shown, &count), READER_OK);
        const int boxes = word_boxes(view, byte, width, now);
        if (boxes < 1)
            fail_msg("seed %llu: '%s' has no place at a width of %g\n%s", seed_now, m->words[i],
                     width, source);
        if (i) { /* the one before it, in the same window */
            const size_t other = (size_t)(strstr(d->plain, m->words[i - 1]) - d->plain);
            before_count = word_boxes(view, other, width, before);
        }
        for (int a = 0; a < before_count; a++)
            for (int b = 0; b < boxes; b++)
                if (!apart(&before[a], &now[b]) || !apart(&now[b], &before[a]))
                    fail_msg(
                        "seed %llu: '%s' and '%s' stand on each other at a width of %g\n%s",
                        seed_now, m->words[i - 1], m->words[i], width, source);
    }
    reader_view_destroy(view);
}

static void all_is_there(void **state)
{
    (void)state;
    static struct made made;
    const char *wanted = getenv("READER_TEST_GENERATED");
    const int documents = wanted ? atoi(wanted) : 60;
    for (int i = 1; i <= documents; i++) {
        struct reader_document *d;
        seed_now = (unsigned long long)i * 0x9e3779b97f4a7c15u;
        char *text = document_make(&made, seed_now);
        source = text;
        assert_int_equal(reader_document_create(&d), READER_OK);
        if (reader_document_add(d, text, strlen(text)) != READER_OK ||
            reader_document_plain(d) != READER_OK)
            fail_msg("%s", reader_error());
        words_are_read(d, &made);
        words_have_places(d, &made, 200 + (double)(sample_word(&made.state) % 1400));
        templates_have_places(d, &made);
        reader_document_destroy(d);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_is_there)};
    if (without_library())
        return 77;
    setlocale(LC_CTYPE, "C.UTF-8");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
