/* reader.c - `lutetia bench reader`: documents of 20,000 and 200,000 words as the reader's
 * window has them: read and opened, seen in the middle, scrolled, at another width, size and
 * font, and all of it; beside Pango, which sets the same paragraphs. One thread, its processor
 * time, and the memory that it has from malloc(). */
#include "bench.h"
#include "options.h"
#include "text_pango.h"

#include <paint.h>
#include <reader_document.h>
#include <reader_edit.h>
#include <reader_miniatures.h>
#include <reader_view.h>

#include <malloc.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    PARAGRAPH_WORDS = 90,
    CHAPTER_PARAGRAPHS = 12,
    SCROLLED_LINES = 200,
    MINIATURE_PX = 100
};

#define SIZE_PX 17.0
#define FONT "DejaVuSerif"
#define FAMILY "DejaVu Serif"
#define OTHER_FONT "DejaVuSans"
#define OTHER_FAMILY "DejaVu Sans"
#define WIDTH_PX 578.0 /* of the column */

static const char *const words[] = {
    "the",     "of",      "and",         "a",     "to",     "in",      "that",     "water",
    "*paper*", "ink",     "slowly",      "every", "river",  "marsh",   "heron",    "between",
    "which",   "light",   "stone",       "over",  "window", "walked",  "house",    "always",
    "because", "through", "**evening**", "reed",  "`code`", "without", "thousand", "difficult"};

struct book {
    char *markdown;
    size_t bytes;
    struct reader_document *document;
    struct reader_view *view;
    struct reader_pages_setup setup;
    struct peer_pango *pango;
    size_t middle;
    /* while it is edited */
    struct reader_files files;
    struct reader_edit *edit;
    size_t caret;
};

static bool reader_wrong(void)
{
    return bench_fail("%s", reader_error());
}

/* What stands in the middle besides words: to be edited. */
static const char pieces[] =
    "A formula $x_1^2 + \\frac{a}{b}$ in a paragraph[^n] that calls a note.\n\n"
    "```c\nint main(void)\n{\n    return 0;\n}\n```\n\n"
    "- An item.\n\n  ```c\n  int twice(int a);\n  ```\n\n"
    "A [reference] leads to a page<br>\nelsewhere.\n\n"
    "[^n]: What the note *says*.\n\n[reference]: https://example.org \"a title\"\n\n";

static bool book_write(struct book *b, int count)
{
    FILE *out = open_memstream(&b->markdown, &b->bytes);
    uint32_t random = 1;
    if (!out)
        return bench_fail("no memory");
    for (int i = 0; i < count; i++) {
        if (i % (PARAGRAPH_WORDS * CHAPTER_PARAGRAPHS) == 0)
            fprintf(out, "## Chapter %d\n\n", i);
        if (i == count / 2 / PARAGRAPH_WORDS * PARAGRAPH_WORDS)
            fputs(pieces, out);
        random = random * 1664525u + 1013904223u;
        fprintf(out, "%s%s", words[(random >> 16) % (sizeof words / sizeof *words)],
                i % PARAGRAPH_WORDS == PARAGRAPH_WORDS - 1 ? ".\n\n" : " ");
    }
    return fclose(out) == 0 || bench_fail("no memory");
}

/* What is in the window, with its glyphs in their places. */
static bool look(struct book *b)
{
    const struct reader_shown *shown;
    int count;
    if (reader_view_look(b->view, &shown, &count) != READER_OK)
        return reader_wrong();
    for (int i = 0; i < count; i++) {
        struct font_layout layout;
        if (reader_view_layout(b->view, shown[i].passage, &layout) != READER_OK)
            return reader_wrong();
        font_layout_finish(&layout);
    }
    return true;
}

static void book_close(struct book *b)
{
    reader_view_destroy(b->view);
    reader_document_destroy(b->document);
    reader_edit_destroy(b->edit);
    reader_files_finish(&b->files);
    b->view = NULL;
    b->document = NULL;
    b->edit = NULL;
}

/* ---- what is measured ---- */

static bool opened(struct book *b)
{
    book_close(b);
    if (reader_document_create(&b->document) != READER_OK ||
        reader_document_add(b->document, b->markdown, b->bytes) != READER_OK ||
        reader_document_refer(b->document) != READER_OK ||
        reader_document_plain(b->document) != READER_OK ||
        reader_view_create(b->document, &b->setup, &b->view) != READER_OK)
        return reader_wrong();
    b->middle = b->document->blocks[b->document->blocks_count / 2].at;
    return look(b);
}

static bool middle_seen(struct book *b)
{
    return (reader_view_go(b->view, b->middle, 0) == READER_OK || reader_wrong()) && look(b);
}

static bool changed(struct book *b)
{
    return (reader_view_set(b->view, &b->setup) == READER_OK || reader_wrong()) && look(b);
}

static bool other_width(struct book *b)
{
    b->setup.width_px = b->setup.width_px > 800 ? 700 : 900;
    return changed(b);
}

static bool other_size(struct book *b)
{
    b->setup.size_px = b->setup.size_px > SIZE_PX ? SIZE_PX : SIZE_PX + 3;
    return changed(b);
}

static bool other_font(struct book *b)
{
    b->setup.font = strcmp(b->setup.font, FONT) == 0 ? OTHER_FONT : FONT;
    return changed(b);
}

/* Line after line; the time is that of all of them. */
static bool scrolled(struct book *b)
{
    bool good = true;
    for (int i = 0; good && i < SCROLLED_LINES; i++) {
        reader_view_scroll(b->view, round(b->setup.leading * b->setup.size_px));
        good = look(b);
    }
    return good;
}

/* From the beginning to the end, window after window. */
static bool all_seen(struct book *b)
{
    double before = -1, above = 0, all;
    reader_view_go_part(b->view, 0);
    for (bool good = look(b); above > before; good = look(b)) {
        if (!good)
            return false;
        before = above;
        reader_view_scroll(b->view, b->setup.height_px);
        if (!look(b))
            return false;
        reader_view_extent(b->view, &above, &all);
    }
    return true;
}

/* All of it again, after a change. */
static bool all_other_width(struct book *b)
{
    return other_width(b) && all_seen(b);
}

static bool all_other_size(struct book *b)
{
    return other_size(b) && all_seen(b);
}

static bool all_other_font(struct book *b)
{
    return other_font(b) && all_seen(b);
}

static bool all_opened(struct book *b)
{
    return opened(b) && all_seen(b);
}

/* ---- editing ---- */

/* Opened to be edited, and seen in the middle: the caret is at these words. */
static bool edit_opened(struct book *b, const char *at)
{
    book_close(b);
    b->files = (struct reader_files){.keep = true};
    if (reader_document_create(&b->document) != READER_OK ||
        reader_files_add(&b->files, b->document, "-", b->markdown, b->bytes) != READER_OK ||
        reader_document_refer(b->document) != READER_OK ||
        reader_document_plain(b->document) != READER_OK ||
        reader_view_create(b->document, &b->setup, &b->view) != READER_OK ||
        reader_edit_create(&b->document, &b->files, NULL, &b->edit) != READER_OK)
        return reader_wrong();
    const char *found = strstr(b->document->plain, at);
    if (!found)
        return bench_fail("'%s' is not there", at);
    b->middle = b->caret = (size_t)(found - b->document->plain);
    return middle_seen(b);
}

/* A paragraph or a heading before the middle. */
static bool kind_opened(struct book *b, enum reader_kind kind)
{
    if (!edit_opened(b, "A formula"))
        return false;
    const struct reader_block *block = reader_document_block(b->document, b->middle);
    do
        block--;
    while (block > b->document->blocks && block->kind != kind);
    b->middle = block->at;
    b->caret = b->middle + 5;
    return middle_seen(b);
}

static bool paragraph_opened(struct book *b)
{
    return kind_opened(b, READER_PARAGRAPH);
}

static bool heading_opened(struct book *b)
{
    return kind_opened(b, READER_HEADING);
}

static bool code_opened(struct book *b)
{
    return edit_opened(b, "return 0");
}

static bool listed_opened(struct book *b)
{
    return edit_opened(b, "twice");
}

static bool link_opened(struct book *b)
{
    return edit_opened(b, "leads to");
}

static bool formula_opened(struct book *b)
{
    return edit_opened(b, "+ \\frac");
}

static bool caller_opened(struct book *b)
{
    return edit_opened(b, "in a paragraph");
}

/* A note that is open where it is called. */
static bool note_opened(struct book *b)
{
    if (!edit_opened(b, "the note says"))
        return false;
    b->middle = (size_t)(strstr(b->document->plain, "A formula") - b->document->plain);
    return (reader_view_note(b->view, 0, b->middle) == READER_OK || reader_wrong()) &&
           middle_seen(b);
}

/* Paints the passage that has the caret, as the window does. */
static bool passage_paint(struct book *b)
{
    static uint8_t pixels[3 * 700 * 1024];
    struct font_painter_def def = font_painter_def_default();
    struct font_picture picture = {700, 1024, 3 * 700, pixels};
    struct font_painter *painter;
    struct font_layout layout;
    struct reader_box box;
    if (!reader_view_caret(b->view, b->caret, true, &box))
        return bench_fail("the caret is not seen");
    memset(pixels, 255, sizeof pixels);
    if (font_painter_create(&def, &painter) != FONT_OK)
        return bench_fail("%s", font_error());
    bool good = reader_view_layout(b->view, box.passage, &layout) == READER_OK &&
                font_painter_layout(painter, &layout, NULL, 0, 0, &picture) == FONT_OK;
    font_layout_finish(&layout);
    font_painter_destroy(painter);
    return good || bench_fail("%s", font_error());
}

/* A letter, from the key to the passage's picture. */
static bool letter_typed(struct book *b)
{
    struct reader_edit_change change;
    struct reader_view *view;
    bool good = reader_edit_insert(b->edit, b->caret, b->caret, "e", 1, &change) == READER_OK;
    if (good && change.before) {
        good = reader_view_create(b->document, &b->setup, &view) == READER_OK;
        if (good) {
            reader_view_as(view, b->view);
            reader_view_destroy(b->view);
            b->view = view;
            good = reader_view_go(view, b->middle, 0) == READER_OK;
        }
    } else if (good) {
        good =
            reader_view_edited(b->view, change.block, change.moves[0].at,
                               change.moves[0].removed, change.moves[0].inserted) == READER_OK;
    }
    b->caret = change.caret;
    reader_edit_change_finish(&change);
    return good ? look(b) && passage_paint(b) : reader_wrong();
}

/* As the setup is. Each paragraph is a layout of its own: a layout of all text takes far
 * longer. kept: room for as many as there are bytes in which they stay; NULL: none does. */
static bool pango_set(struct book *b, void **kept)
{
    const struct reader_pages_setup *s = &b->setup;
    const char *at = b->document->plain, *end = at + b->document->plain_bytes;
    int lines = 0;
    peer_pango_set(b->pango, strcmp(s->font, FONT) == 0 ? FAMILY : OTHER_FAMILY, s->size_px,
                   s->width_px - 2 * s->margin_px);
    while (at < end) {
        const char *stop = memchr(at, '\n', (size_t)(end - at));
        const size_t bytes = (size_t)((stop ? stop : end) - at);
        if (bytes && kept)
            lines += peer_pango_keep(b->pango, at, bytes, kept++);
        else if (bytes)
            lines += peer_pango_layout(b->pango, at, bytes);
        at += bytes + 1;
    }
    return lines > 0 || bench_fail("Pango failed");
}

static bool pango_all(struct book *b)
{
    return pango_set(b, NULL);
}

/* All pages are set and drawn small. */
static bool miniatures(struct book *b)
{
    struct reader_pages_setup setup = b->setup;
    const struct reader_miniatures_def def = {.setup = &setup, .width_px = MINIATURE_PX};
    struct reader_miniatures *small;
    int width, height;
    setup.height_px = round(setup.width_px * 1.4);
    if (reader_miniatures_make(b->document, &def, &small) != READER_OK)
        return reader_wrong();
    reader_miniatures_size(small, &width, &height);
    uint8_t *rgb = malloc(3 * (size_t)width * (size_t)height);
    bool good = rgb || bench_fail("no memory");
    for (int i = 0; good && i < reader_miniatures_count(small); i++)
        good = reader_miniatures_paint(small, i, rgb, 3 * (size_t)width) == READER_OK ||
               reader_wrong();
    free(rgb);
    reader_miniatures_destroy(small);
    return good;
}

static const struct row {
    const char *name;
    bool (*before)(struct book *b); /* not measured */
    bool (*does)(struct book *b);
    bool (*peer)(struct book *b);
} rows[] = {
    {"opened", NULL, opened, NULL},
    {"the middle", opened, middle_seen, NULL},
    {"200 lines down", middle_seen, scrolled, NULL},
    {"another width", middle_seen, other_width, NULL},
    {"another size", middle_seen, other_size, NULL},
    {"another font", middle_seen, other_font, NULL},
    {"a letter", paragraph_opened, letter_typed, NULL},
    {"in a heading", heading_opened, letter_typed, NULL},
    {"in code", code_opened, letter_typed, NULL},
    {"in a list's code", listed_opened, letter_typed, NULL},
    {"beside a link", link_opened, letter_typed, NULL},
    {"in a formula", formula_opened, letter_typed, NULL},
    {"beside a note", caller_opened, letter_typed, NULL},
    {"in a note", note_opened, letter_typed, NULL},
    {"everything", opened, all_seen, pango_all},
    {"all, new width", all_opened, all_other_width, pango_all},
    {"all, new size", all_opened, all_other_size, pango_all},
    {"all, new font", all_opened, all_other_font, pango_all},
    {"miniatures", opened, miniatures, pango_all},
};

/* ---- memory ---- */

/* Bytes that malloc() has given; 0 where nobody says. */
static double heap_bytes(void)
{
#ifdef __GLIBC__
    const struct mallinfo2 info = mallinfo2();
    return (double)info.uordblks + (double)info.hblkhd;
#else
    return 0;
#endif
}

static void memory_add(struct bench_report *report, const char *who, const char *what,
                       int count, double bytes)
{
    char name[64];
    snprintf(name, sizeof name, "%s, %d words", what, count);
    bench_report_add(report, who, name, bench_sample_of(&bytes, 1), 1e-6, "MB");
}

/* What a document takes that was opened, and was seen from its beginning to its end; what all
 * of Pango's layouts take, but for the text. */
static bool memory_run(struct book *b, int count, struct bench_report *report)
{
    book_close(b);
    const double before = heap_bytes();
    if (!opened(b))
        return false;
    memory_add(report, "lutetia", "memory, opened", count, heap_bytes() - before);
    if (!all_seen(b))
        return false;
    memory_add(report, "lutetia", "memory, all", count, heap_bytes() - before);
    const size_t room = b->document->plain_bytes;
    void **kept = b->pango ? calloc(room, sizeof *kept) : NULL;
    if (!b->pango || !kept)
        return !b->pango || bench_fail("no memory");
    const double empty = heap_bytes();
    const bool ok = pango_set(b, kept);
    if (ok)
        memory_add(report, "pango", "memory, all", count, heap_bytes() - empty);
    for (size_t i = 0; i < room && kept[i]; i++)
        peer_pango_release(kept[i]);
    free(kept);
    return ok;
}

static bool row_run(struct book *b, const struct row *row, int count, int turns,
                    struct bench_report *report)
{
    double *seconds = calloc((size_t)turns, 2 * sizeof *seconds);
    if (!seconds)
        return bench_fail("no memory");
    bool ok = true;
    const int whos = row->peer && b->pango ? 2 : 1;
    char name[64];
    snprintf(name, sizeof name, "%s, %d words", row->name, count);
    for (int i = -1; ok && i < turns; i++) /* -1 warms up */
        for (int who = 0; ok && who < whos; who++) {
            ok = !row->before || row->before(b);
            const double began_s = bench_thread_s();
            ok = ok && (who ? row->peer(b) : row->does(b));
            if (i >= 0)
                seconds[who * turns + i] = bench_thread_s() - began_s;
        }
    for (int who = 0; ok && who < whos; who++)
        bench_report_add(report, who ? "pango" : "lutetia", name,
                         bench_sample_of(&seconds[who * turns], turns), 1e3, "ms");
    free(seconds);
    return ok;
}

static bool book_run(int count, int turns, struct bench_report *report)
{
    struct book b = {.setup = reader_pages_setup_default()};
    b.setup.font = FONT;
    b.setup.size_px = SIZE_PX;
    b.setup.width_px = 700;
    b.setup.height_px = 1024;
    b.setup.margin_px = (700 - WIDTH_PX) / 2;
    b.pango = peer_pango_create(FAMILY, SIZE_PX, WIDTH_PX);
    bool ok = book_write(&b, count) && opened(&b);
    for (size_t i = 0; ok && i < sizeof rows / sizeof *rows; i++)
        ok = row_run(&b, &rows[i], count, turns, report);
    ok = ok && memory_run(&b, count, report);
    book_close(&b);
    peer_pango_destroy(b.pango);
    free(b.markdown);
    return ok;
}

int bench_reader_main(int argc, char **argv)
{
    struct bench_options o = {.name = "reader", .repeat_least = 1, .repeat_count = 5};
    static struct bench_report report;
    const int status = bench_options_parse(&o, argc, argv);
    if (status >= 0)
        return status;
    bench_report_init(&report, o.name, 1, "one thread");
    const bool ok = book_run(bench_many(20000, 500), o.repeat_count, &report) &&
                    book_run(bench_many(200000, 1000), o.repeat_count, &report);
    return bench_options_finish(&o, &report, "pango", ok);
}
