/* pages_pieces.c - a text that is parted where a picture in it is higher than its lines: all
 * lines of a paragraph are as high as the highest, so it has a line of its own. See
 * pages_internal.h. */
#include "pages_internal.h"

#include <string.h>

/* The first span from one on that is such a picture; the count of spans: none is. */
static enum reader_status tall_find(struct reader_pages *p, const struct paragraph_text *t,
                                    int from, enum context context, double most_px, int *found)
{
    const double high = 0.95 * p->setup.leading * pages_size(p, context);
    for (*found = from; *found < t->spans_count; ++*found) {
        const struct pictured *image;
        enum reader_status status = pages_image(p, &t->spans[*found], context, most_px, &image);
        if (status != READER_OK)
            return status;
        if (image && image->height > high)
            break;
    }
    return READER_OK;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\n';
}

/* Spans from..to without blanks around them. False: no memory. */
static bool piece_make(const struct paragraph_text *t, int from, int to,
                       struct paragraph_text *out)
{
    int begin = from < to ? t->spans[from].begin : 0,
        end = from < to ? t->spans[to - 1].end : 0;
    while (from > 0 && begin < end && is_blank(t->text[begin]))
        begin++;
    while (to < t->spans_count && begin < end && is_blank(t->text[end - 1]))
        end--;
    for (int i = from; i < to; i++) {
        const struct line_span *s = &t->spans[i];
        const int own = s->begin > begin ? s->begin : begin, stop = s->end < end ? s->end : end;
        if (own >= stop)
            continue;
        if (!pages_text_add(out, t->text + own, stop - own, s->look))
            return false;
        struct line_span *made = &out->spans[out->spans_count - 1];
        const int begins = made->begin, ends = made->end;
        *made = *s;
        made->begin = begins;
        made->end = ends;
        made->at += made->at >= 0 ? own - s->begin : 0;
    }
    return true;
}

enum reader_status pages_pieces(struct reader_pages *p, const struct paragraph_text *t,
                                enum context context, double most_px, pages_piece_put put,
                                void *user)
{
    struct pages_piece_place place = {.first = true};
    enum reader_status status = READER_OK;
    for (int from = 0, to; status == READER_OK && (from < t->spans_count || place.first);
         from = to) {
        struct paragraph_text piece = {0};
        status = tall_find(p, t, from, context, most_px, &to);
        place.picture = status == READER_OK && to == from && from < t->spans_count;
        to += place.picture;
        if (status == READER_OK)
            status = piece_make(t, from, to, &piece) ? READER_OK : pages_no_memory();
        place.last = to >= t->spans_count;
        if (status == READER_OK && (piece.bytes || (place.first && place.last))) {
            status = put(p, user, &piece, &place);
            place.first = false;
        }
        pages_text_finish(&piece);
    }
    return status;
}
