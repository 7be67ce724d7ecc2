/* read_text.c - the document's text: words, and what is selected. */
#include "read_desk.h"

char *read_text_of(const struct read_desk *d, struct read_range range)
{
    return g_strndup(d->document->plain + range.begin, range.end - range.begin);
}

/* A letter of a word; a note's number is none. */
static bool is_letter(const struct read_desk *d, const char *at, gunichar c)
{
    const struct reader_span *span =
        reader_document_span(d->document, (size_t)(at - d->document->plain));
    return (g_unichar_isalnum(c) || g_unichar_ismark(c) || c == '\'' || c == 0x2019) &&
           !(span && span->look & READER_NOTE);
}

struct read_range read_text_word(const struct read_desk *d, size_t byte)
{
    const char *plain = d->document->plain, *begin = plain + byte, *end;
    while (begin > plain && (*begin & 0xc0) == 0x80) /* to where a character begins */
        begin--;
    end = begin;
    for (const char *next = end; next < plain + d->document->plain_bytes; end = next) {
        uint32_t c;
        font_utf8_next(&next, plain + d->document->plain_bytes, &c);
        if (!is_letter(d, end, c))
            break;
    }
    for (const char *before; begin > plain; begin = before) {
        before = g_utf8_prev_char(begin);
        if (!is_letter(d, before, g_utf8_get_char(before)))
            break;
    }
    return (struct read_range){(size_t)(begin - plain), (size_t)(end - plain)};
}

bool read_text_origin(struct read_desk *d, const struct reader_remark *r, double *x, double *y)
{
    struct reader_box box;
    const int block = r->around ? reader_around_block(d->document, r) : -1;
    if (block >= 0 && reader_view_begins(d->view, block, r->around, x, y)) {
        *x += r->x * d->size_px;
        *y += r->y * d->size_px;
        return true;
    }
    if (block >= 0 || r->orphan ||
        reader_view_boxes(d->view, r->begin, r->begin + 1, &box, 1) < 1)
        return false;
    *x = box.x + r->x * d->size_px;
    *y = box.y + r->y * d->size_px;
    return true;
}

void read_text_around(struct read_desk *d)
{
    struct reader_obstacle *obstacles = NULL;
    int count = 0;
    if (!d->view || !d->document)
        return;
    enum reader_status status = reader_around_find(d->remarks, d->document, &obstacles, &count);
    if (status == READER_OK)
        status = reader_view_around(d->view, obstacles, count);
    if (status != READER_OK)
        d->say(d, reader_error());
    free(obstacles);
}
