/* pages_remarks.c - what readers left, on pages: boxes behind words, ink over them, typed notes
 * as notes of the page: see reader_pages.h.
 *
 * The document's bytes are found on pages by pieces, in their order: so many bytes from one on
 * are so many of a paragraph. */
#include "pages_internal.h"

#include "reader_colours.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { QUOTED_BYTES = 200, TYPED_BYTES = 16384, LINES_MAX = 64 };

struct piece {
    size_t at;
    int length, paragraph, begin, block;
    bool in_note;
};
struct left_box {
    int page;
    struct font_drawing_box box;
};
struct left_stroke {
    int page;
    struct font_drawing_stroke stroke;
    struct font_drawing_point *points;
};

struct pages_left {
    struct piece *pieces;
    int pieces_count;
    bool found; /* boxes and strokes are */
    struct left_box *boxes;
    int boxes_count, boxes_capacity;
    struct left_stroke *strokes;
    int strokes_count, strokes_capacity;
    struct font_drawing_box *page_boxes; /* of the page that was asked for last */
    struct font_drawing_stroke *page_strokes;
};

void pages_left_destroy(struct pages_left *left)
{
    if (!left)
        return;
    for (int i = 0; i < left->strokes_count; i++)
        free(left->strokes[i].points);
    free(left->pieces);
    free(left->boxes);
    free(left->strokes);
    free(left->page_boxes);
    free(left->page_strokes);
    free(left);
}

/* ---- where bytes are ---- */

static int by_at(const void *a, const void *b)
{
    const struct piece *x = a, *y = b;
    return (x->at > y->at) - (x->at < y->at);
}

static enum reader_status pieces_make(struct reader_pages *p)
{
    struct pages_left *left = p->left;
    int count = 0;
    for (int i = 0; i < p->kept.count; i++)
        count += p->kept.paragraphs[i].spans_count;
    left->pieces = calloc((size_t)count + 1, sizeof *left->pieces);
    if (!left->pieces)
        return pages_no_memory();
    for (int i = 0; i < p->kept.count; i++) {
        const struct made_paragraph *m = &p->kept.paragraphs[i];
        for (int k = 0; k < m->spans_count; k++)
            if (m->spans[k].at >= 0)
                left->pieces[left->pieces_count++] =
                    (struct piece){(size_t)m->spans[k].at,
                                   m->spans[k].end - m->spans[k].begin,
                                   m->id,
                                   m->spans[k].begin,
                                   m->block,
                                   m->note >= 0};
    }
    if (left->pieces_count)
        qsort(left->pieces, (size_t)left->pieces_count, sizeof *left->pieces, by_at);
    return READER_OK;
}

/* The first piece that ends behind a byte. */
static int piece_behind(const struct pages_left *left, size_t byte)
{
    int low = 0, high = left->pieces_count;
    while (low < high) {
        const int half = (low + high) / 2;
        if (left->pieces[half].at + (size_t)left->pieces[half].length <= byte)
            low = half + 1;
        else
            high = half;
    }
    return low;
}

/* What a file says may begin within a letter: it begins behind it. */
static struct page_place place_of(const struct reader_pages *p, int paragraph, int byte)
{
    size_t bytes = 0;
    const char *text = page_paragraph_text(p->text, paragraph, &bytes);
    while (text && (size_t)byte < bytes && ((unsigned char)text[byte] & 0xc0) == 0x80)
        byte++;
    return (struct page_place){paragraph, byte};
}

/* ---- typed notes ---- */

/* Letters from a file that anybody may have written, as a paragraph may have them. */
static bool words_add(struct paragraph_text *t, const char *text, size_t bytes, unsigned look)
{
    char *mended = NULL;
    size_t count = 0;
    if (font_utf8_mend(text, bytes, &mended, &count) != FONT_OK)
        return false;
    for (size_t i = 0; i < count; i++)
        if (((unsigned char)mended[i] < 0x20 && mended[i] != '\n') || mended[i] == 0x7f)
            mended[i] = ' ';
    const bool good = pages_text_add(t, mended, (int)count, look);
    free(mended);
    return good;
}

/* No letter is cut. */
static size_t cut(const char *text, size_t bytes, size_t most)
{
    if (bytes <= most)
        return bytes;
    while (most > 0 && ((unsigned char)text[most] & 0xc0) == 0x80)
        most--;
    return most ? most : bytes;
}

static bool quotation_add(struct paragraph_text *t, const struct reader_remark *r)
{
    size_t bytes;
    const char *text = reader_anchor_quotation(r->anchor, &bytes);
    const size_t shown = cut(text, bytes, QUOTED_BYTES);
    return (!*r->by || (words_add(t, r->by, strlen(r->by), READER_HEAVY) &&
                        pages_text_add(t, ": ", 2, 0))) &&
           pages_text_add(t, "\xe2\x80\x9c", 3, READER_SLANTED) &&
           words_add(t, text, shown, READER_SLANTED) &&
           (shown == bytes || pages_text_add(t, "\xe2\x80\xa6", 3, READER_SLANTED)) &&
           pages_text_add(t, "\xe2\x80\x9d ", 4, READER_SLANTED);
}

/* A piece of a note at its words, in the margin or at the foot. */
static enum reader_status note_set(struct reader_pages *p, const struct piece *piece, int byte,
                                   const struct paragraph_text *t)
{
    const bool margin = p->setup.notes_px > 0;
    struct page_manner manner = pages_manner(p, CONTEXT_NOTE);
    int style, id;
    if (margin)
        manner.align = FONT_ALIGN_START;
    enum reader_status status = pages_style(p, CONTEXT_NOTE, 0, &style);
    if (status == READER_OK &&
        page_note_add(p->text, piece->paragraph, place_of(p, piece->paragraph, byte).byte,
                      margin ? PAGE_NOTE_MARGIN : PAGE_NOTE_FOOT, t->text, (size_t)t->bytes,
                      style, &manner, &id) != FONT_OK)
        status = pages_failed();
    return status == READER_OK ? pages_styles_apply(p, id, t, CONTEXT_NOTE, false, 0) : status;
}

/* At its words (piece), or as paragraphs behind all others (NULL). */
static enum reader_status typed_add(struct reader_pages *p, const struct reader_remark *r,
                                    const struct piece *piece, int byte)
{
    const char *text = r->text, *const end = text + strlen(text);
    enum reader_status status = READER_OK;
    bool first = true;
    do {
        struct paragraph_text t = {0};
        const size_t n = cut(text, (size_t)(end - text), TYPED_BYTES);
        const char *headings = first && !piece ? reader_anchor_headings(r->anchor) : "";
        const bool ink = r->kind == READER_REMARK_INK;
        bool good = !*headings || (words_add(&t, headings, strlen(headings), 0) &&
                                   pages_text_add(&t, ": ", 2, 0));
        good = good && (!first || quotation_add(&t, r)) && words_add(&t, text, n, 0) &&
               (!ink || pages_text_add(&t, "[ink]", 5, 0));
        const struct page_manner manner = pages_manner(p, CONTEXT_TEXT);
        status = !good   ? pages_no_memory()
                 : piece ? note_set(p, piece, byte, &t)
                         : pages_paragraph_add(p, &t, CONTEXT_TEXT, &manner, false);
        pages_text_finish(&t);
        text += n;
        first = false;
    } while (text < end && status == READER_OK);
    return status;
}

/* Where a typed note's words end on a page; NULL: they are on none, or in a note. */
static const struct piece *words_end(const struct pages_left *left,
                                     const struct reader_remark *r, int *byte)
{
    if (r->orphan || r->end <= r->begin)
        return NULL;
    const int k = piece_behind(left, r->end - 1);
    if (k == left->pieces_count || left->pieces[k].at > r->end - 1 || left->pieces[k].in_note)
        return NULL;
    *byte = left->pieces[k].begin + (int)(r->end - left->pieces[k].at);
    return &left->pieces[k];
}

static enum reader_status others_head(struct reader_pages *p)
{
    static const char words[] = "Readers\xe2\x80\x99 other notes";
    struct paragraph_text t = {0};
    struct page_manner manner = pages_manner(p, CONTEXT_HEAD_2);
    manner.before_px = 1.3 * p->setup.size_px;
    manner.after_px = 0.5 * p->setup.size_px;
    manner.keep_with_next = true;
    manner.role = FONT_ROLE_HEADING;
    manner.level = 2;
    enum reader_status status = pages_text_add(&t, words, (int)strlen(words), 0)
                                    ? pages_paragraph_add(p, &t, CONTEXT_HEAD_2, &manner, false)
                                    : pages_no_memory();
    pages_text_finish(&t);
    return status;
}

enum reader_status pages_left_make(struct reader_pages *p)
{
    const struct reader_remarks *remarks = p->setup.remarks;
    const int count = remarks ? reader_remarks_count(remarks) : 0;
    bool others = false;
    p->left = calloc(1, sizeof *p->left);
    enum reader_status status = p->left ? pieces_make(p) : pages_no_memory();
    for (int turn = 0; turn < 2; turn++) /* those at their words, then the others */
        for (int i = 0; i < count && status == READER_OK; i++) {
            const struct reader_remark *r = reader_remarks_get(remarks, i);
            int byte = 0;
            const struct piece *piece = words_end(p->left, r, &byte);
            const bool listed = r->kind == READER_REMARK_TYPED ? !piece : r->orphan;
            if (!reader_remark_seen(r) || listed != (turn == 1) ||
                (!listed && r->kind != READER_REMARK_TYPED))
                continue;
            if (listed && !others)
                status = others_head(p);
            others = others || listed;
            if (status == READER_OK)
                status = typed_add(p, r, piece, byte);
        }
    return status;
}

/* ---- boxes ---- */

/* Those of a piece's bytes from..to. */
static enum reader_status piece_boxes(struct reader_pages *p, const struct piece *piece,
                                      int from, int to, const double rgb[3])
{
    struct pages_left *left = p->left;
    const struct page_place a = place_of(p, piece->paragraph, piece->begin + from),
                            b = place_of(p, piece->paragraph, piece->begin + to);
    int first, last;
    if (page_find(p->text, a, &first) != FONT_OK || page_find(p->text, b, &last) != FONT_OK)
        return pages_failed();
    for (int page = first; page <= last; page++) {
        struct page_box found[LINES_MAX];
        int count = 0;
        if (page_select(p->text, a, b, page, found, LINES_MAX, &count) != FONT_OK)
            return pages_failed();
        for (int i = 0; i < count && i < LINES_MAX; i++) {
            if (!array_reserve(&left->boxes, &left->boxes_capacity, left->boxes_count + 1,
                               sizeof *left->boxes))
                return pages_no_memory();
            left->boxes[left->boxes_count++] = (struct left_box){page,
                                                                 {found[i].x,
                                                                  found[i].y,
                                                                  found[i].width,
                                                                  found[i].height,
                                                                  {rgb[0], rgb[1], rgb[2], 1}}};
        }
    }
    return READER_OK;
}

static int by_begin(const void *a, const void *b)
{
    const struct reader_remark *x = *(const struct reader_remark *const *)a,
                               *y = *(const struct reader_remark *const *)b;
    return (x->begin > y->begin) - (x->begin < y->begin);
}

/* All that remarks of a kind cover, each byte once. */
static enum reader_status kind_boxes(struct reader_pages *p, enum reader_remark_kind kind,
                                     const double rgb[3])
{
    const struct reader_remarks *remarks = p->setup.remarks;
    const int count = reader_remarks_count(remarks);
    const struct reader_remark **sorted =
        calloc((size_t)count + 1, sizeof(struct reader_remark *));
    enum reader_status status = sorted ? READER_OK : pages_no_memory();
    int n = 0;
    size_t done = 0;
    for (int i = 0; i < count && sorted; i++) {
        const struct reader_remark *r = reader_remarks_get(remarks, i);
        if (r->kind == kind && reader_remark_seen(r) && !r->orphan)
            sorted[n++] = r;
    }
    if (n)
        qsort(sorted, (size_t)n, sizeof *sorted, by_begin);
    for (int i = 0; i < n && status == READER_OK; i++) {
        size_t at = sorted[i]->begin > done ? sorted[i]->begin : done;
        for (int k = piece_behind(p->left, at);
             k < p->left->pieces_count && status == READER_OK; k++) {
            const struct piece *piece = &p->left->pieces[k];
            if (piece->at >= sorted[i]->end)
                break;
            const int from = at > piece->at ? (int)(at - piece->at) : 0;
            const size_t length = sorted[i]->end - piece->at;
            const int to = length < (size_t)piece->length ? (int)length : piece->length;
            if (from < to)
                status = piece_boxes(p, piece, from, to, rgb);
        }
        done = sorted[i]->end > done ? sorted[i]->end : done;
    }
    free(sorted);
    return status;
}

enum reader_status
reader_pages_find(struct reader_pages *p, size_t begin, size_t end,
                  void (*found)(void *user, int page, const struct page_box *box), void *user)
{
    const struct pages_left *left = p->left;
    for (int k = left ? piece_behind(left, begin) : 0; left && k < left->pieces_count; k++) {
        const struct piece *piece = &left->pieces[k];
        struct page_box boxes[LINES_MAX];
        int first, last, count = 0;
        if (piece->at >= end)
            break;
        const int from = begin > piece->at ? (int)(begin - piece->at) : 0;
        const size_t length = end - piece->at;
        const int to = length < (size_t)piece->length ? (int)length : piece->length;
        const struct page_place a = place_of(p, piece->paragraph, piece->begin + from),
                                b = place_of(p, piece->paragraph, piece->begin + to);
        if (from >= to)
            continue;
        if (page_find(p->text, a, &first) != FONT_OK || page_find(p->text, b, &last) != FONT_OK)
            return pages_failed();
        for (int page = first; page <= last; page++) {
            if (page_select(p->text, a, b, page, boxes, LINES_MAX, &count) != FONT_OK)
                return pages_failed();
            for (int i = 0; i < count && i < LINES_MAX; i++)
                found(user, page, &boxes[i]);
        }
    }
    return READER_OK;
}

bool reader_pages_byte(struct reader_pages *p, int page, double x, double y, size_t *byte)
{
    struct page_place place;
    bool before;
    if (page_hit(p->text, page, x, y, &place, &before) != FONT_OK)
        return false;
    const struct made_paragraph *m = NULL;
    for (int i = 0; i < p->kept.count && !m; i++)
        m = p->kept.paragraphs[i].id == place.paragraph ? &p->kept.paragraphs[i] : NULL;
    bool any = false;
    for (int i = 0; m && i < m->spans_count; i++) {
        const struct line_span *s = &m->spans[i];
        if (s->at < 0)
            continue;
        const int in = place.byte > s->begin ? place.byte - s->begin : 0,
                  most = s->end - s->begin;
        *byte = (size_t)s->at + (size_t)(in < most ? in : most > 0 ? most - 1 : 0);
        any = true;
        if (place.byte < s->end)
            break;
    }
    return any;
}

/* ---- ink ---- */

/* Whether text flows around ink that hangs on the piece: then it is counted from where its
 * paragraph begins. *page, *box: that. */
static enum reader_status around_find(struct reader_pages *p, const struct reader_remark *r,
                                      const struct piece *piece, int *page,
                                      struct page_box *box, bool *around)
{
    *around = false;
    for (int i = 0; i < p->setup.obstacles_count && r->around && !piece->in_note; i++)
        *around = *around || p->setup.obstacles[i].block == piece->block;
    if (!*around)
        return READER_OK;
    if (page_paragraph_begins(p->text, piece->paragraph, page, &box->x, &box->y) != FONT_OK)
        return pages_failed();
    box->x += pages_around_x(p, r->around);
    return READER_OK;
}

static enum reader_status stroke_add(struct reader_pages *p, const struct reader_remark *r)
{
    struct pages_left *left = p->left;
    const int k = piece_behind(left, r->begin);
    struct page_box box;
    int page, count = 0;
    if (k == left->pieces_count || left->pieces[k].at > r->begin)
        return READER_OK; /* its word is on no page */
    bool around;
    enum reader_status status = around_find(p, r, &left->pieces[k], &page, &box, &around);
    if (status != READER_OK)
        return status;
    const int byte = left->pieces[k].begin + (int)(r->begin - left->pieces[k].at);
    const struct page_place a = place_of(p, left->pieces[k].paragraph, byte),
                            b = place_of(p, left->pieces[k].paragraph, a.byte + 1);
    if (!around && (page_find(p->text, a, &page) != FONT_OK ||
                    page_select(p->text, a, b, page, &box, 1, &count) != FONT_OK))
        return pages_failed();
    if (!around && !count)
        return READER_OK;
    if (!array_reserve(&left->strokes, &left->strokes_capacity, left->strokes_count + 1,
                       sizeof *left->strokes))
        return pages_no_memory();
    struct font_drawing_point *points = calloc((size_t)r->points_count + 1, sizeof *points);
    if (!points)
        return pages_no_memory();
    const double em = p->setup.size_px;
    for (int i = 0; i < r->points_count; i++) {
        const struct reader_ink_place place = reader_ink_place(r, i);
        points[i] = (struct font_drawing_point){box.x + em * (r->x + place.x),
                                                box.y + em * (r->y + place.y),
                                                fmax(0.6, em * place.width)};
    }
    left->strokes[left->strokes_count++] =
        (struct left_stroke){page,
                             {points,
                              r->points_count,
                              {(r->rgba >> 24) / 255.0, (r->rgba >> 16 & 255) / 255.0,
                               (r->rgba >> 8 & 255) / 255.0, (r->rgba & 255) / 255.0}},
                             points};
    return READER_OK;
}

/* Those that were drawn later lie over the others. */
static enum reader_status strokes_find(struct reader_pages *p)
{
    const struct reader_remarks *remarks = p->setup.remarks;
    struct reader_played *played =
        calloc((size_t)reader_remarks_count(remarks) + 1, sizeof *played);
    int count = 0;
    enum reader_status status = played ? READER_OK : pages_no_memory();
    if (played)
        reader_remarks_play(remarks, false, played, &count);
    for (int i = 0; i < count && status == READER_OK; i++) {
        const struct reader_remark *r = reader_remarks_get(remarks, played[i].index);
        if (!r->orphan)
            status = stroke_add(p, r);
    }
    free(played);
    return status;
}

/* ---- pages ---- */

static enum reader_status left_find(struct reader_pages *p)
{
    struct pages_left *left = p->left;
    const struct reader_colours *colours = reader_colours_of(false);
    enum reader_status status = kind_boxes(p, READER_REMARK_HIGHLIGHT, colours->marked);
    if (status == READER_OK)
        status = kind_boxes(p, READER_REMARK_TYPED, colours->noted);
    if (status == READER_OK)
        status = strokes_find(p);
    left->page_boxes = calloc((size_t)left->boxes_count + 1, sizeof *left->page_boxes);
    left->page_strokes = calloc((size_t)left->strokes_count + 1, sizeof *left->page_strokes);
    if (status == READER_OK && (!left->page_boxes || !left->page_strokes))
        status = pages_no_memory();
    left->found = status == READER_OK;
    return status;
}

enum reader_status reader_pages_left(struct reader_pages *p, int page,
                                     struct font_drawing *drawing)
{
    struct pages_left *left = p->left;
    int boxes = 0, strokes = 0;
    if (!left || !p->setup.remarks)
        return READER_OK;
    enum reader_status status = left->found ? READER_OK : left_find(p);
    if (status != READER_OK)
        return status;
    for (int i = 0; i < left->boxes_count; i++)
        if (left->boxes[i].page == page)
            left->page_boxes[boxes++] = left->boxes[i].box;
    for (int i = 0; i < left->strokes_count; i++)
        if (left->strokes[i].page == page)
            left->page_strokes[strokes++] = left->strokes[i].stroke;
    drawing->boxes = left->page_boxes;
    drawing->boxes_count = boxes;
    drawing->strokes = left->page_strokes;
    drawing->strokes_count = strokes;
    return READER_OK;
}
