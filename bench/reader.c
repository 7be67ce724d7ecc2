/* reader.c - `lutetia bench reader`: documents of 20,000 and 200,000 words as the reader's
 * window has them: read and opened, seen in the middle, at another width, at another size, and
 * all of it; beside Pango, which sets the same text as a whole. One thread, its processor
 * time. */
#include "bench.h"
#include "harness.h"
#include "text_pango.h"
#include <visible_text.h>

#include <reader_document.h>
#include <reader_view.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_WRONG = 2, TURNS = 5, PARAGRAPH_WORDS = 90, CHAPTER_PARAGRAPHS = 12 };

#define SIZE_PX 17.0
#define FONT "DejaVuSerif"
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
};

static bool reader_wrong(void)
{
    return bench_fail("%s", reader_error());
}

static bool book_write(struct book *b, int count)
{
    FILE *out = open_memstream(&b->markdown, &b->bytes);
    uint32_t random = 1;
    if (!out)
        return bench_fail("no memory");
    for (int i = 0; i < count; i++) {
        if (i % (PARAGRAPH_WORDS * CHAPTER_PARAGRAPHS) == 0)
            fprintf(out, "## Chapter %d\n\n", i);
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
    b->view = NULL;
    b->document = NULL;
}

/* ---- what is measured ---- */

static bool opened(struct book *b)
{
    book_close(b);
    if (reader_document_create(&b->document) != READER_OK ||
        reader_document_add(b->document, b->markdown, b->bytes) != READER_OK ||
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

static bool pango_all(struct book *b)
{
    return peer_pango_layout(b->pango, b->document->plain, b->document->plain_bytes) > 0 ||
           bench_fail("Pango failed");
}

static const struct row {
    const char *name;
    bool (*before)(struct book *b); /* not measured */
    bool (*does)(struct book *b);
    bool (*peer)(struct book *b);
} rows[] = {
    {"opened", NULL, opened, NULL},
    {"the middle", opened, middle_seen, NULL},
    {"another width", middle_seen, other_width, NULL},
    {"another size", middle_seen, other_size, NULL},
    {"everything", opened, all_seen, pango_all},
};

static bool row_run(struct book *b, const struct row *row, int count,
                    struct bench_report *report)
{
    double seconds[2][TURNS];
    const int whos = row->peer && b->pango ? 2 : 1;
    char name[64];
    snprintf(name, sizeof name, "%s, %d words", row->name, count);
    for (int i = -1; i < TURNS; i++) /* -1 warms up */
        for (int who = 0; who < whos; who++) {
            if (row->before && !row->before(b))
                return false;
            const double began_s = bench_thread_s();
            if (!(who ? row->peer(b) : row->does(b)))
                return false;
            if (i >= 0)
                seconds[who][i] = bench_thread_s() - began_s;
        }
    for (int who = 0; who < whos; who++)
        bench_report_add(report, who ? "pango" : "lutetia", name,
                         bench_sample_of(seconds[who], TURNS), 1e3, "ms");
    return true;
}

static bool book_run(int count, struct bench_report *report)
{
    struct book b = {.setup = reader_pages_setup_default()};
    b.setup.font = FONT;
    b.setup.size_px = SIZE_PX;
    b.setup.width_px = 700;
    b.setup.height_px = 1024;
    b.setup.margin_px = (700 - WIDTH_PX) / 2;
    b.pango = peer_pango_create("DejaVu Serif", SIZE_PX, WIDTH_PX);
    bool ok = book_write(&b, count) && opened(&b);
    for (size_t i = 0; ok && i < sizeof rows / sizeof *rows; i++)
        ok = row_run(&b, &rows[i], count, report);
    book_close(&b);
    peer_pango_destroy(b.pango);
    free(b.markdown);
    return ok;
}

int bench_reader_main(int argc, char **argv)
{
    const char *json = NULL;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--json") == 0 && i + 1 < argc) {
            json = argv[++i];
            continue;
        }
        bool help = strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0;
        fputs("usage: lutetia bench reader [--json FILE]\n\n"
              "Documents of 20,000 and 200,000 words: from Markdown to the first window, the "
              "window in the middle, at another width, at another size, and all of it, beside "
              "Pango where it was there when this was built.\n",
              help ? stdout : stderr);
        return help ? EXIT_SUCCESS : EXIT_WRONG;
    }
    static struct bench_report report;
    bench_report_init(&report, "reader", 1, "one thread");
    bool ok = (!json || bench_can_write(json)) && book_run(bench_many(20000, 500), &report) &&
              book_run(bench_many(200000, 1000), &report);
    if (ok)
        bench_report_print(&report, "pango", stdout);
    if (!ok || (json && !bench_report_write(&report, json))) {
        visible_say("lutetia bench reader: %s", bench_error());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
