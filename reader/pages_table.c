/* pages_table.c - tables: columns by tabs where they have room, else row by row. See
 * pages_internal.h. */
#include "pages_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The bytes of cell number c of a row; an empty range behind the last. */
static void cell_find(const struct reader_block *row, int c, int *begin, int *end)
{
    int at = 0;
    for (; c > 0 && at < row->bytes; at++)
        c -= row->text[at] == '\t';
    const char *tab = c ? NULL : memchr(row->text + at, '\t', (size_t)(row->bytes - at));
    *begin = at;
    *end = c ? at : tab ? (int)(tab - row->text) : row->bytes;
}

static unsigned row_look(const struct reader_block *row)
{
    return row->head ? READER_HEAVY : 0;
}

struct columns {
    double widths[READER_COLUMNS_MAX], gap, all;
    int count;
};

static enum reader_status columns_measure(struct reader_pages *p,
                                          const struct reader_block *rows, int count,
                                          struct columns *c)
{
    enum { CELL_BYTES = 8192 };
    enum reader_status status = READER_OK;
    *c = (struct columns){.gap = 1.2 * pages_size(p, CONTEXT_TABLE), .count = rows[0].columns};
    const double most = pages_column(p);
    if (c->count > READER_COLUMNS_MAX) {
        c->all = INFINITY;
        return READER_OK;
    }
    for (int i = 0; i < c->count && c->all <= most && status == READER_OK; i++) {
        for (int r = 0; r < count && status == READER_OK; r++) {
            struct paragraph_text t = {0};
            double width = 0;
            int begin, end;
            cell_find(&rows[r], i, &begin, &end);
            if (end - begin > CELL_BYTES) { /* wider than any column */
                c->all = INFINITY;
                return READER_OK;
            }
            status = pages_block_add(&t, &rows[r], begin, end, row_look(&rows[r]))
                         ? pages_width(p, &t, CONTEXT_TABLE, &width)
                         : pages_no_memory();
            c->widths[i] = fmax(c->widths[i], width);
            pages_text_finish(&t);
        }
        c->all += c->widths[i] + (i ? c->gap : 0);
    }
    return status;
}

/* One row, its cells at tabs. */
static enum reader_status row_tabbed(struct reader_pages *p, const struct reader_block *row,
                                     const struct columns *c, bool last)
{
    struct paragraph_text t = {0};
    struct page_manner manner = pages_manner(p, CONTEXT_TABLE);
    double x = 0, em = p->setup.size_px;
    bool good = true;
    manner.keep_with_next = row->head;
    manner.before_px = row->head ? 0.5 * em : 0;
    manner.after_px = last ? 0.6 * em : row->head ? 0.15 * em : 0;
    for (int i = 0; i < c->count && good; i++) {
        char align = row->aligns[i];
        int begin, end;
        cell_find(row, i, &begin, &end);
        if (i || align != 'l') {
            double at = align == 'r'   ? x + c->widths[i]
                        : align == 'c' ? x + c->widths[i] / 2
                                       : x;
            manner.tabs[manner.tabs_count++] =
                (struct page_tab){at, align == 'r'   ? PAGE_TAB_RIGHT
                                      : align == 'c' ? PAGE_TAB_CENTER
                                                     : PAGE_TAB_LEFT};
            good = pages_text_add(&t, "\t", 1, 0);
        }
        good = good && pages_block_add(&t, row, begin, end, row_look(row));
        x += c->widths[i] + c->gap;
    }
    enum reader_status status =
        good ? pages_paragraph_add(p, &t, CONTEXT_TABLE, &manner, false) : pages_no_memory();
    pages_text_finish(&t);
    return status;
}

/* The next cell from *at on, which goes behind it; an empty range behind the last. */
static void cell_next(const struct reader_block *row, int *at, int *begin, int *end)
{
    const char *from = row->text + *at;
    const char *tab = memchr(from, '\t', (size_t)(row->bytes - *at));
    *begin = *at;
    *end = tab ? (int)(tab - row->text) : row->bytes;
    *at = tab ? *end + 1 : row->bytes;
}

/* Not within a letter. */
static int letter_begin(const struct reader_block *row, int at, int begin)
{
    for (int k = 0; k < 3 && at > begin && at < row->bytes; k++)
        at -= ((unsigned char)row->text[at] & 0xc0) == 0x80;
    return at;
}

static enum reader_status told_put(struct reader_pages *p, struct paragraph_text *t, bool last)
{
    struct page_manner manner = pages_manner(p, CONTEXT_TABLE);
    const double em = p->setup.size_px;
    manner.left_px = 1.6 * em;
    manner.indent_px = -0.8 * em;
    manner.after_px = last ? 0.35 * em : 0;
    enum reader_status status = pages_paragraph_add(p, t, CONTEXT_TABLE, &manner, false);
    pages_text_finish(t);
    return status;
}

/* A cell's letters; what is too long for one paragraph goes on in the next one. */
static enum reader_status cell_told(struct reader_pages *p, const struct reader_block *row,
                                    int begin, int end, struct paragraph_text *t)
{
    while (begin < end) {
        const int room = READER_PASSAGE_BYTES - t->bytes;
        const int stop =
            end - begin <= room ? end : letter_begin(row, begin + (room > 4 ? room : 4), begin);
        if (!pages_block_add(t, row, begin, stop, 0))
            return pages_no_memory();
        begin = stop;
        enum reader_status status = begin < end ? told_put(p, t, false) : READER_OK;
        if (status != READER_OK)
            return status;
    }
    return READER_OK;
}

/* A column's name before what is told of it, as far as a name is. */
static bool name_told(const struct reader_block *head, int begin, int end,
                      struct paragraph_text *t)
{
    enum { NAME_BYTES = 200 };
    const int stop =
        end - begin <= NAME_BYTES ? end : letter_begin(head, begin + NAME_BYTES, begin);
    return begin == end ||
           (pages_block_add(t, head, begin, stop, READER_HEAVY) &&
            (stop == end || pages_text_add(t, "\xe2\x80\xa6", 3, READER_HEAVY)) &&
            pages_text_add(t, ": ", 2, 0));
}

/* One row as a paragraph of its own: each cell on a line behind its column's name. */
static enum reader_status row_told(struct reader_pages *p, const struct reader_block *head,
                                   const struct reader_block *row)
{
    struct paragraph_text t = {0};
    enum reader_status status = READER_OK;
    for (int i = 0, at = 0, head_at = 0;
         i < row->columns && at < row->bytes && status == READER_OK; i++) {
        int begin, end, from = 0, to = 0;
        cell_next(row, &at, &begin, &end);
        if (head)
            cell_next(head, &head_at, &from, &to);
        if (begin == end)
            continue;
        if (t.bytes >= READER_PASSAGE_BYTES)
            status = told_put(p, &t, false);
        bool good = !t.bytes || pages_text_add(&t, "\n", 1, 0);
        good = good && (!head || name_told(head, from, to, &t));
        if (status == READER_OK)
            status = good ? cell_told(p, row, begin, end, &t) : pages_no_memory();
    }
    if (status == READER_OK)
        status = told_put(p, &t, true);
    pages_text_finish(&t);
    return status;
}

/* What a table without a caption is called, over it. */
static enum reader_status number_put(struct reader_pages *p, int number)
{
    struct paragraph_text t = {0};
    struct page_manner manner = pages_manner(p, CONTEXT_TABLE);
    char words[32];
    snprintf(words, sizeof words, "Table %d", number);
    manner.before_px = 0.5 * p->setup.size_px;
    manner.keep_with_next = true;
    enum reader_status status = pages_text_add(&t, words, (int)strlen(words), READER_SLANTED)
                                    ? pages_paragraph_add(p, &t, CONTEXT_TABLE, &manner, false)
                                    : pages_no_memory();
    pages_text_finish(&t);
    return status;
}

enum reader_status pages_table_add(struct reader_pages *p, const struct reader_block *rows,
                                   int count)
{
    struct columns c;
    enum reader_status status = rows[0].number ? number_put(p, rows[0].number) : READER_OK;
    if (status == READER_OK)
        status = columns_measure(p, rows, count, &c);
    const bool fits = status == READER_OK && c.all <= pages_column(p);
    const struct reader_block *head = rows[0].head && count > 1 ? &rows[0] : NULL;
    for (int r = 0; r < count && status == READER_OK; r++)
        if (fits)
            status = row_tabbed(p, &rows[r], &c, r + 1 == count);
        else if (&rows[r] != head)
            status = row_told(p, head, &rows[r]);
    return status;
}
