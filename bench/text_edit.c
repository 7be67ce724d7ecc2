/* text_edit.c - `lutetia bench text`, second part: a text of 200,000 words in pages, and one
 * paragraph of 900 kB. A letter is inserted and removed in the middle, and the visible page is
 * set anew each time. */
#include "text_edit.h"
#include "harness.h"

#include <page.h>

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS = 200000, PARAGRAPH_WORDS = 110, EDITS = 101, LONG_BYTES = 900000 };

static int words_least(void)
{
    return bench_many(WORDS, 2200);
}

static int edits(void)
{
    return bench_many(EDITS, 3);
}

struct book {
    struct page_text *text;
    int middle, pages; /* the paragraph in the middle */
    int byte;          /* of it, where letters are put in */
    double whole_s;
};

static bool font_wrong(void)
{
    return bench_fail("%s", font_error());
}

static bool paragraphs_add(struct book *b, const char *const *words, uint32_t words_count,
                           int style)
{
    struct page_manner manner = page_manner_default();
    uint32_t random = 7;
    char text[PARAGRAPH_WORDS * 24];
    manner.align = FONT_ALIGN_JUSTIFY;
    manner.hyphenate = true;
    manner.indent_px = 14;
    for (int p = 0; p < words_least() / PARAGRAPH_WORDS; p++) {
        size_t bytes = 0;
        int id;
        for (int w = 0; w < PARAGRAPH_WORDS; w++) {
            random = random * 1664525u + 1013904223u;
            const char *word = words[(random >> 16) % words_count];
            memcpy(text + bytes, word, strlen(word));
            bytes += strlen(word);
            text[bytes++] = ' ';
        }
        if (page_paragraph_add(b->text, 0, -1, text, bytes - 1, style, &manner, &id) != FONT_OK)
            return font_wrong();
        if (p == words_least() / PARAGRAPH_WORDS / 2)
            b->middle = id;
    }
    b->byte = 200;
    return true;
}

static bool paragraph_add(struct book *b, const char *const *words, uint32_t words_count,
                          int style)
{
    const size_t least = (size_t)bench_many(LONG_BYTES, 9000);
    struct page_manner manner = page_manner_default();
    uint32_t random = 7;
    char *text = malloc(least + 64);
    size_t bytes = 0;
    manner.align = FONT_ALIGN_JUSTIFY;
    manner.hyphenate = true;
    while (text && bytes < least) {
        random = random * 1664525u + 1013904223u;
        const char *word = words[(random >> 16) % words_count];
        memcpy(text + bytes, word, strlen(word));
        bytes += strlen(word);
        text[bytes++] = ' ';
        b->byte = bytes <= least / 2 ? (int)bytes : b->byte;
    }
    const bool ok = text && page_paragraph_add(b->text, 0, -1, text, bytes, style, &manner,
                                               &b->middle) == FONT_OK;
    free(text);
    return ok || font_wrong();
}

static bool book_make(struct book *b, const char *const *words, uint32_t words_count,
                      bool (*add)(struct book *, const char *const *, uint32_t, int))
{
    struct page_template page = {.width_px = 600, .height_px = 800, .frames_count = 1};
    struct page_style style = page_style_default();
    int id;
    page.frames[0] = (struct page_frame){.x = 60, .y = 60, .width = 480, .height = 680};
    style.font = "DejaVuSans";
    style.size_px = 12;
    style.language = "en";
    if (page_text_create(&b->text) != FONT_OK ||
        page_templates_set(b->text, &page, 1) != FONT_OK ||
        page_style_add(b->text, &style, &id) != FONT_OK)
        return font_wrong();
    double began_s = bench_thread_s();
    if (!add(b, words, words_count, id))
        return false;
    if (page_count(b->text, &b->pages) != FONT_OK)
        return font_wrong();
    b->whole_s = bench_thread_s() - began_s;
    return true;
}

/* Inserts or removes a letter, and sets the visible page; *seconds of the thread. */
static bool edit(struct book *b, int turn, int page, double *seconds)
{
    struct font_layout seen;
    double began_s = bench_thread_s();
    enum font_status status = page_text_replace(b->text, b->middle, b->byte, turn % 2,
                                                turn % 2 ? "" : "x", turn % 2 ? 0 : 1);
    if (status == FONT_OK)
        status = page_layout(b->text, page, &seen);
    *seconds = bench_thread_s() - began_s;
    if (status != FONT_OK)
        return font_wrong();
    font_layout_finish(&seen);
    return true;
}

static bool long_run(struct bench_report *report, const char *const *words,
                     uint32_t words_count)
{
    static const char of_case[] = "one paragraph, 900 kB";
    struct book b = {0};
    double seconds[EDITS];
    int page = 0;
    bool ok = book_make(&b, words, words_count, paragraph_add);
    if (ok && page_find(b.text, (struct page_place){b.middle, b.byte}, &page) != FONT_OK)
        ok = font_wrong();
    for (int i = -1; ok && i < edits() - 1; i++) /* -1 warms up */
        ok = edit(&b, i + 2, page, &seconds[i + 1]);
    if (ok) {
        bench_report_add(report, "edit, page seen", of_case, bench_sample_of(seconds, edits()),
                         1e6, "us");
        bench_report_add(report, "from scratch", of_case,
                         (struct bench_sample){b.whole_s, b.whole_s}, 1e3, "ms");
    }
    page_text_destroy(b.text);
    return ok;
}

bool bench_text_edit(struct bench_report *report, const char *const *words,
                     uint32_t words_count)
{
    struct book b = {0};
    double seconds[EDITS], line_s[EDITS];
    int page = 0, pages = 0;
    bool ok = book_make(&b, words, words_count, paragraphs_add);
    if (ok && page_find(b.text, (struct page_place){b.middle, 200}, &page) != FONT_OK)
        ok = font_wrong();
    for (int i = -1; ok && i < edits() - 1; i++) /* -1 warms up */
        ok = edit(&b, i + 2, page, &seconds[i + 1]);
    /* Inserts and removes a long word: the number of lines changes, and all later pages are
     * filled again. */
    for (int i = 0; ok && i < edits(); i++) {
        static const char longer[] =
            "a line that is put in and taken out again so that all pages that are "
            "behind it move by a line, each of them anew ";
        double began_s = bench_thread_s();
        int bytes = (int)sizeof longer - 1;
        ok = page_text_replace(b.text, b.middle, 200, i % 2 ? bytes : 0, longer,
                               i % 2 ? 0 : (size_t)bytes) == FONT_OK &&
             page_count(b.text, &pages) == FONT_OK;
        line_s[i] = bench_thread_s() - began_s;
        if (!ok)
            font_wrong();
    }
    if (ok) {
        struct page_stats stats;
        page_stats_get(b.text, &stats);
        bench_report_add(report, "edit, page seen", "200,000 words",
                         bench_sample_of(seconds, edits()), 1e6, "us");
        bench_report_add(report, "edit, all pages", "200,000 words",
                         bench_sample_of(line_s, edits()), 1e6, "us");
        bench_report_add(report, "from scratch", "200,000 words",
                         (struct bench_sample){b.whole_s, b.whole_s}, 1e3, "ms");
        double bytes = (double)stats.bytes;
        bench_report_add(report, "memory", "200,000 words", (struct bench_sample){bytes, bytes},
                         1e-6, "MB");
    }
    page_text_destroy(b.text);
    return ok && long_run(report, words, words_count);
}
