/* text.c - `lutetia bench text`: a book of justified lines, beside Pango in the same run, on
 * one thread. The words are random, but the same each time. Both set the whole book in each
 * run, and the time is the thread's processor time. */
#include "bench.h"
#include "options.h"
#include "text_edit.h"
#include "text_pango.h"

#include <face.h>
#include <text.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINES = 5000, PARAGRAPH_WORDS = 110, BYTES_MAX = 900000 };

#define SIZE_PX 12.0
#define WIDTH_PX 400.0

static const char *const latin[] = {
    "the",     "of",       "and",     "a",        "to",        "in",      "that",    "water",
    "paper",   "letter",   "brush",   "ink",      "slowly",    "every",   "river",   "between",
    "morning", "which",    "light",   "stone",    "over",      "window",  "garden",  "walked",
    "house",   "remember", "never",   "always",   "because",   "through", "evening", "mountain",
    "another", "without",  "printer", "thousand", "difficult", "Affairs", "waffle",  "AVATAR"};
static const char *const arabic[] = {"الماء",  "كتاب", "من",  "إلى",     "الورق", "في",
                                     "الصباح", "حرف",  "قلم", "المدينة", "و",     "بيت",
                                     "الجبل",  "ضوء",  "على", "النهر"};

static int lines_least(void)
{
    return bench_many(LINES, 50);
}

static const struct book {
    const char *name, *font, *family;
    const char *const *words;
    uint32_t words_count;
} books[] = {
    {"TrueType", "DejaVuSans", "DejaVu Sans", latin, sizeof latin / sizeof *latin},
    {"CFF", "NimbusSans-Regular.otf", "Nimbus Sans", latin, sizeof latin / sizeof *latin},
    {"Arabic", "DejaVuSans", "DejaVu Sans", arabic, sizeof arabic / sizeof *arabic},
};
enum { BOOKS = sizeof books / sizeof *books };

struct reading {
    struct font_face *face;
    struct font_shaper *shaper;
    struct peer_pango *pango;
    char *text;
    size_t bytes;
    int lines, pango_lines;
};

static bool font_wrong(void)
{
    return bench_fail("%s", font_error());
}

/* Adds paragraphs of words, with some commas. */
static void paragraphs_add(struct reading *r, const struct book *b, int count, uint32_t *random)
{
    for (int p = 0; p < count; p++)
        for (int w = 0; w < PARAGRAPH_WORDS && r->bytes + 64 < BYTES_MAX; w++) {
            *random = *random * 1664525u + 1013904223u;
            const char *word = b->words[(*random >> 16) % b->words_count];
            size_t length = strlen(word);
            memcpy(r->text + r->bytes, word, length);
            r->bytes += length;
            if ((*random >> 8) % 11 == 0)
                r->text[r->bytes++] = ',';
            r->text[r->bytes++] = w + 1 == PARAGRAPH_WORDS ? '\n' : ' ';
        }
}

static bool ours(struct reading *r)
{
    static const struct font_text_options options = {.width_px = WIDTH_PX,
                                                     .align = FONT_ALIGN_JUSTIFY};
    struct font_layout layout;
    if (font_shaper_layout(r->shaper, r->text, r->bytes, SIZE_PX, &options, &layout) != FONT_OK)
        return font_wrong();
    r->lines = layout.lines_count;
    font_layout_finish(&layout);
    return true;
}

static bool pangos(struct reading *r)
{
    r->pango_lines = peer_pango_layout(r->pango, r->text, r->bytes);
    return r->pango_lines > 0 || bench_fail("Pango failed");
}

/* Makes as many paragraphs as give LINES lines. */
static bool reading_begin(struct reading *r, const struct book *b)
{
    uint32_t random = 1;
    if (font_face_open(b->font, 0, &r->face) != FONT_OK ||
        font_shaper_create(r->face, &r->shaper) != FONT_OK)
        return font_wrong();
    r->pango = peer_pango_create(b->family, SIZE_PX, WIDTH_PX);
    r->text = malloc(BYTES_MAX);
    if (!r->text)
        return bench_fail("no memory");
    while (r->lines < lines_least()) {
        size_t before = r->bytes;
        paragraphs_add(
            r, b, r->lines ? 1 + (lines_least() - r->lines) / 12 : bench_many(100, 1), &random);
        if (r->bytes == before)
            return bench_fail("%d lines do not fit", lines_least());
        if (!ours(r))
            return false;
    }
    return true;
}

static void reading_finish(struct reading *r)
{
    peer_pango_destroy(r->pango);
    font_shaper_destroy(r->shaper);
    font_face_close(r->face);
    free(r->text);
}

static bool book_run(const struct book *b, int turns, struct bench_report *report)
{
    struct reading r = {.lines = 0};
    double *seconds = calloc((size_t)turns, 2 * sizeof *seconds);
    if (!seconds)
        return bench_fail("no memory");
    bool ok = reading_begin(&r, b);
    for (int i = -1; ok && i < turns; i++) /* -1 warms up */
        for (int who = 0; ok && who < (r.pango ? 2 : 1); who++) {
            double began_s = bench_thread_s();
            ok = who ? pangos(&r) : ours(&r);
            if (i >= 0)
                seconds[who * turns + i] = bench_thread_s() - began_s;
        }
    for (int who = 0; ok && who < (r.pango ? 2 : 1); who++) {
        struct bench_sample s = bench_sample_of(&seconds[who * turns], turns);
        double lines = who ? r.pango_lines : r.lines;
        bench_report_add(report, who ? "pango" : "lutetia", b->name,
                         (struct bench_sample){lines / s.median, lines / s.min}, 1, "lines/s");
    }
    reading_finish(&r);
    free(seconds);
    return ok;
}

int bench_text_main(int argc, char **argv)
{
    struct bench_options o = {.name = "text", .repeat_least = 1, .repeat_count = 7};
    static struct bench_report report;
    const int status = bench_options_parse(&o, argc, argv);
    if (status >= 0)
        return status;
    bench_report_init(&report, o.name, 1, "one thread");
    bool ok = true;
    for (int i = 0; ok && i < BOOKS; i++)
        ok = book_run(&books[i], o.repeat_count, &report);
    ok = ok && bench_text_edit(&report, latin, sizeof latin / sizeof *latin);
    return bench_options_finish(&o, &report, "pango", ok);
}
