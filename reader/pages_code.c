/* pages_code.c - lines of code: see pages_internal.h. A block that is wider than its column is
 * set smaller, all of it, so that its lines end where they end in the source; one that would
 * have to be too small is broken. */
#include "pages_internal.h"

#include <math.h>
#include <string.h>

/* Tabs go to every fourth column, and a line that is empty is a blank: so that it has its
 * height. */
static bool code_line_add(struct paragraph_text *t, const struct reader_block *block,
                          const char *line, int bytes)
{
    int column = 0;
    bool good = true;
    if (!bytes)
        return pages_text_add(t, " ", 1, READER_CODE);
    for (int at = 0; at < bytes && good;) {
        int run = 0;
        while (at + run < bytes && line[at + run] != '\t')
            run++;
        good = pages_text_add(t, line + at, run, READER_CODE);
        if (good && run)
            t->spans[t->spans_count - 1].at = (long)block->at + (line + at - block->text);
        column += run;
        at += run;
        if (at < bytes) {
            int blanks = 4 - column % 4;
            good = good && pages_text_add(t, "    ", blanks, READER_CODE);
            column += blanks;
            at++;
        }
    }
    return good;
}

/* How many letters it has, those that may be wide twice; blanks at its end are not seen. */
static int columns_of(const char *line, int bytes)
{
    enum { WIDE = 0xe3 }; /* first byte of Kana; Han, Hangul and pictures follow */
    int columns = 0;
    while (bytes > 0 && (line[bytes - 1] == ' ' || line[bytes - 1] == '\t'))
        bytes--;
    for (int i = 0; i < bytes; i++) {
        const unsigned char c = (unsigned char)line[i];
        if (c == '\t')
            columns += 4 - columns % 4;
        else if ((c & 0xc0) != 0x80)
            columns += c >= WIDE ? 2 : 1;
    }
    return columns;
}

static enum reader_status line_width(struct reader_pages *p, const struct reader_block *block,
                                     const char *line, int bytes, double *width)
{
    struct paragraph_text t = {0};
    while (bytes > 0 && (line[bytes - 1] == ' ' || line[bytes - 1] == '\t'))
        bytes--;
    enum reader_status status = code_line_add(&t, block, line, bytes)
                                    ? pages_width(p, &t, CONTEXT_CODE, width)
                                    : pages_no_memory();
    pages_text_finish(&t);
    return status;
}

/* How much smaller all of it is, so that its widest line has room: p->code_steps. Only lines
 * that may be too wide are measured. */
static enum reader_status steps_find(struct reader_pages *p, const struct reader_block *block,
                                     double most_px)
{
    const double widest = most_px / pages_code_scale(PAGES_CODE_STEPS);
    double letter, all = 0;
    p->code_steps = 0;
    enum reader_status status = line_width(p, block, "M", 1, &letter);
    for (int at = 0; at < block->bytes && status == READER_OK && all <= widest;) {
        const char *line = block->text + at,
                   *end = memchr(line, '\n', (size_t)(block->bytes - at));
        const int bytes = end ? (int)(end - line) : block->bytes - at;
        const double most = columns_of(line, bytes) * letter;
        double width = most; /* it is broken for sure, or measured */
        if (most > most_px && most <= 2 * widest)
            status = line_width(p, block, line, bytes, &width);
        all = fmax(all, width);
        at += bytes + 1;
    }
    if (status == READER_OK && all > most_px && all <= widest)
        p->code_steps = (int)ceil(100 * (1 - most_px / all) / PAGES_CODE_PERCENT - 1e-9);
    return status;
}

enum reader_status pages_code_fits(struct reader_pages *p, const struct reader_block *block,
                                   double most_px, bool *fits)
{
    double letter;
    int columns = 0;
    enum reader_status status = line_width(p, block, "M", 1, &letter);
    for (int at = 0; at < block->bytes;) {
        const char *line = block->text + at,
                   *end = memchr(line, '\n', (size_t)(block->bytes - at));
        const int bytes = end ? (int)(end - line) : block->bytes - at,
                  own = columns_of(line, bytes);
        columns = own > columns ? own : columns;
        at += bytes + 1;
    }
    *fits = status == READER_OK && columns * letter + p->setup.size_px <= most_px;
    return status;
}

/* In pieces, so that no paragraph is too long for who sets it. */
enum reader_status pages_code_add(struct reader_pages *p, const struct reader_block *block)
{
    enum { LINES_MAX = 60, BYTES_MAX = READER_PASSAGE_BYTES };
    const double em = p->setup.size_px;
    struct page_manner nested = {0};
    pages_nest(p, block, &nested);
    enum reader_status status =
        steps_find(p, block, pages_column(p) - nested.left_px - nested.right_px - em);
    for (int at = 0; at <= block->bytes && status == READER_OK;) {
        struct paragraph_text t = {0};
        struct page_manner manner = pages_manner(p, CONTEXT_CODE);
        bool good = true;
        pages_nest(p, block, &manner);
        manner.left_px += em;
        manner.role = FONT_ROLE_PARAGRAPH;
        manner.before_px = at == 0 ? 0.45 * em : 0;
        for (int n = 0; n < LINES_MAX && at <= block->bytes && t.bytes < BYTES_MAX && good;
             n++) {
            const char *line = block->text + at;
            const char *end = memchr(line, '\n', (size_t)(block->bytes - at));
            int bytes = end ? (int)(end - line) : block->bytes - at;
            bytes = bytes < BYTES_MAX ? bytes : BYTES_MAX;
            good = (n == 0 || pages_text_add(&t, "\n", 1, READER_CODE)) &&
                   code_line_add(&t, block, line, bytes);
            at += bytes + (end == line + bytes || at + bytes == block->bytes);
        }
        manner.after_px = at > block->bytes ? 0.6 * em : 0;
        status =
            good ? pages_paragraph_add(p, &t, CONTEXT_CODE, &manner, false) : pages_no_memory();
        pages_text_finish(&t);
    }
    p->code_steps = 0;
    return status;
}
