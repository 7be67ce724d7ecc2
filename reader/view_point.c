/* view_point.c - which letter is where in a scrolled column, and where a letter is: see
 * reader_view.h. */
#include "view_internal.h"

#include <math.h>

/* ---- bytes of the document and of paragraphs ---- */

/* The document's byte that is a paragraph's, or the next one that it has; -1: it has none. */
static long byte_of(const struct made_paragraph *p, int byte)
{
    long last = -1;
    for (int i = 0; i < p->spans_count; i++) {
        const struct line_span *s = &p->spans[i];
        if (s->at < 0)
            continue;
        if (byte < s->end)
            return s->at + (byte > s->begin ? byte - s->begin : 0);
        last = s->at + s->end - s->begin;
    }
    return last;
}

static const struct made_paragraph *paragraph_of(const struct made_passage *made, int id)
{
    for (int i = 0; i < made->count; i++)
        if (made->paragraphs[i].id == id)
            return &made->paragraphs[i];
    return NULL;
}

long view_byte_of(const struct made_passage *made, struct page_place place)
{
    const struct made_paragraph *paragraph = paragraph_of(made, place.paragraph);
    return paragraph ? byte_of(paragraph, place.byte) : -1;
}

int view_paragraph_of(const struct made_passage *made, int block)
{
    for (int i = 0; i < made->count; i++) {
        const struct made_paragraph *own = &made->paragraphs[i];
        if (own->block == block && own->note < 0 && !own->beside)
            return own->id;
    }
    return -1;
}

bool reader_view_begins(struct reader_view *view, int block, enum reader_around side, double *x,
                        double *y)
{
    for (int i = 0; i < view->shown_count; i++) {
        const struct reader_shown *shown = &view->shown[i];
        const struct view_passage *p = &view->passages[shown->passage];
        int page;
        if (block < p->first || block >= p->first + p->blocks)
            continue;
        const int id = view_paragraph_of(&view->loaded[shown->passage - view->begin], block);
        if (id < 0 || page_paragraph_begins(view->pages->text, id, &page, x, y) != FONT_OK)
            return false;
        *x += pages_around_x(view->pages, side);
        *y += shown->y_px + shown->text_px;
        return true;
    }
    return false;
}

/* Where a byte of the document stands; false: not in this passage. */
static bool place_of(const struct made_passage *made, size_t byte, struct page_place *place)
{
    for (int i = 0; i < made->count; i++)
        for (int k = 0; k < made->paragraphs[i].spans_count; k++) {
            const struct line_span *s = &made->paragraphs[i].spans[k];
            const long from = (long)byte - s->at;
            if (s->at < 0 || from < 0 || from >= s->end - s->begin)
                continue;
            *place = (struct page_place){made->paragraphs[i].id, s->begin + (int)from};
            return true;
        }
    return false;
}

int view_note_of(const struct reader_view *view, int block)
{
    const struct reader_document *d = view->document;
    for (int i = 0; i < d->notes_count; i++)
        if (block >= d->notes[i].first_block &&
            block < d->notes[i].first_block + d->notes[i].blocks_count)
            return i;
    return -1;
}

static int passage_of_block(const struct reader_view *view, int block)
{
    int low = 0, high = view->count;
    while (high - low > 1) {
        int half = (low + high) / 2;
        if (view->passages[half].first <= block)
            low = half;
        else
            high = half;
    }
    return low;
}

int view_passage_of(const struct reader_view *view, size_t byte)
{
    const struct reader_document *d = view->document;
    /* a note within a note is where the outer one is called */
    for (int depth = 0; depth < READER_DEPTH_MAX; depth++) {
        const struct reader_block *block = reader_document_block(d, byte);
        if (!block)
            return 0;
        if (block >= d->blocks && block < d->blocks + d->blocks_count)
            return passage_of_block(view, (int)(block - d->blocks));
        const int note = view_note_of(view, (int)(block - d->note_blocks));
        if (note >= 0 && view->opened[note])
            return view->opened[note] - 1;
        if (note < 0 || view->called[note] == SIZE_MAX)
            return 0;
        byte = view->called[note];
    }
    return 0;
}

/* ---- lines ---- */

enum reader_status view_line_of(struct reader_view *view, int passage, size_t byte,
                                double *y0_px, double *y1_px)
{
    const struct view_passage *p = &view->passages[passage];
    const struct made_passage *made = &view->loaded[passage - view->begin];
    struct page_place place;
    struct page_caret caret;
    *y0_px = p->before_px;
    *y1_px = p->before_px + p->text_px;
    if (!place_of(made, byte, &place))
        return READER_OK; /* a rule, a picture, the end of a paragraph: all of it */
    if (page_caret_get(view->pages->text, place, false, &caret) != FONT_OK)
        return pages_failed();
    *y0_px = p->before_px + caret.y0;
    *y1_px = p->before_px + caret.y1;
    return READER_OK;
}

static bool is_figure(const struct reader_view *view, int passage, struct page_place place)
{
    const struct made_paragraph *own =
        paragraph_of(&view->loaded[passage - view->begin], place.paragraph);
    return own && own->figure;
}

/* Where the place is a figure's, the line beside it, if there is one. */
static bool line_beside(struct reader_view *view, int passage, double y,
                        struct page_place *place, bool *before)
{
    enum { PARTS = 8 };
    const struct reader_grid *grid = &view->setup.grid;
    const double x0 = grid->texts ? grid->text[0].x : view->setup.margin_px,
                 width = grid->texts ? grid->text[0].width : pages_column(view->pages);
    if (!is_figure(view, passage, *place))
        return true;
    for (int i = 1; i < PARTS; i++) {
        struct page_place other;
        bool edge;
        struct page_caret caret;
        if (page_hit(view->pages->text, passage - view->begin, x0 + width * i / PARTS, y,
                     &other, &edge) != FONT_OK)
            return false;
        if (is_figure(view, passage, other) ||
            page_caret_get(view->pages->text, other, edge, &caret) != FONT_OK || caret.y0 > y ||
            caret.y1 < y)
            continue;
        *place = (struct page_place){other.paragraph, other.byte};
        *before = edge;
        /* from there to the line's first letter */
        while (page_place_step(view->pages->text, &other, false)) {
            struct page_caret next;
            if (page_caret_get(view->pages->text, other, false, &next) != FONT_OK ||
                next.y0 != caret.y0)
                break;
            *place = other;
            *before = false;
        }
        return true;
    }
    return true;
}

/* The first letter of the line at y of the passage's page, and the line's edges. False: there
 * is none. */
static bool line_at(struct reader_view *view, int passage, double y, struct page_place *place,
                    struct page_caret *caret)
{
    const double far = 1e5, near = 0.01;
    const struct reader_grid *grid = &view->setup.grid;
    const int wide = view_wide_of(view, view->passages[passage].first);
    const struct reader_region *region = wide < 0 ? &grid->text[0] : &grid->wide[wide];
    /* notes at the left are not the line */
    const bool noted = grid->texts && region->notes_width > 0 && region->notes_x < region->x;
    const double left = noted ? region->x + near : -far,
                 right = grid->texts ? region->x + region->width - near : far;
    struct page_text *text = view->pages->text;
    bool before;
    const int page = passage - view->begin;
    if (page_hit(text, page, left, y, place, &before) != FONT_OK)
        return false;
    if (before && page_hit(text, page, right, y, place, &before) != FONT_OK) /* to the left */
        return false;
    if (!line_beside(view, passage, y, place, &before))
        return false;
    return page_caret_get(text, *place, before, caret) == FONT_OK;
}

bool view_line_below(struct reader_view *view, int passage, double y_px, size_t *byte,
                     double *line_px)
{
    const double near = 0.01;
    const struct view_passage *p = &view->passages[passage];
    const struct made_passage *made = &view->loaded[passage - view->begin];
    struct page_place place;
    struct page_caret caret;
    for (double y = fmax(0, y_px - p->before_px); y < p->text_px;) {
        if (!line_at(view, passage, y + near, &place, &caret))
            return false;
        if (caret.y0 + p->before_px >= y_px - near) {
            const struct made_paragraph *paragraph = paragraph_of(made, place.paragraph);
            const long found = paragraph ? byte_of(paragraph, place.byte) : -1;
            *byte = found >= 0 ? (size_t)found : view->document->blocks[p->first].at;
            *line_px = caret.y0 + p->before_px;
            return true;
        }
        if (!(caret.y1 > y))
            return false;
        y = caret.y1;
    }
    return false;
}

/* ---- pointing ---- */

static const struct reader_shown *shown_at(const struct reader_view *view, double y)
{
    const struct reader_shown *nearest = NULL;
    for (int i = 0; i < view->shown_count; i++) {
        nearest = &view->shown[i];
        if (y < nearest->y_px + nearest->height_px)
            break;
    }
    return nearest;
}

bool reader_view_hit(struct reader_view *view, double x, double y, size_t *byte, bool *inside)
{
    const struct reader_shown *shown = shown_at(view, y);
    struct page_place place;
    bool before;
    *inside = false;
    if (!shown || page_hit(view->pages->text, shown->passage - view->begin, x,
                           y - shown->y_px - shown->text_px, &place, &before) != FONT_OK)
        return false;
    const struct made_passage *made = &view->loaded[shown->passage - view->begin];
    const struct made_paragraph *paragraph = paragraph_of(made, place.paragraph);
    long found = paragraph ? byte_of(paragraph, place.byte) : -1;
    if (found < 0)
        found = (long)view->document->blocks[view->passages[shown->passage].first].at;
    *byte = (size_t)found;
    /* the letter behind the caret, or the one before it */
    for (size_t from = *byte > 4 ? *byte - 4 : 0; from <= *byte && !*inside; from++) {
        struct reader_box boxes[4];
        const size_t end = from == *byte ? from + 1 : *byte;
        const int count = reader_view_boxes(view, from, end, boxes, 4);
        for (int i = 0; i < count && i < 4; i++)
            if (x >= boxes[i].x && x < boxes[i].x + boxes[i].width && y >= boxes[i].y &&
                y < boxes[i].y + boxes[i].height) {
                *inside = true;
                *byte = from;
            }
    }
    return true;
}

/* ---- stages ---- */

/* The paragraph that is the room of a block's stage; -1: there is none. */
static int stage_paragraph(const struct made_passage *made, int block, bool beside)
{
    for (int i = 0; i < made->count; i++)
        if (made->paragraphs[i].block == block && made->paragraphs[i].note < 0 &&
            made->paragraphs[i].figure == beside)
            return made->paragraphs[i].id;
    return -1;
}

bool reader_view_stage(struct reader_view *view, const struct reader_shown *shown, int which,
                       struct reader_stage *out)
{
    const struct view_passage *p = &view->passages[shown->passage];
    int number = p->first, count;
    struct page_box box;
    double most;
    if (view->setup.stage_strip_px <= 0 || shown->passage < view->begin ||
        shown->passage >= view->end)
        return false;
    for (;; number++) {
        if (number == p->first + p->blocks)
            return false;
        const struct reader_block *own = &view->document->blocks[number];
        if (own->kind == READER_LIVE && own->stage_width && which-- == 0)
            break;
    }
    const struct reader_block *block = &view->document->blocks[number];
    const bool beside = pages_beside_host(&view->setup, view->document, number, &most) >= 0;
    const int id = stage_paragraph(&view->loaded[shown->passage - view->begin], number, beside);
    if (id < 0 ||
        page_select(view->pages->text, (struct page_place){id, 0}, (struct page_place){id, 1},
                    shown->passage - view->begin, &box, 1, &count) != FONT_OK ||
        count < 1)
        return false;
    *out = (struct reader_stage){.block = number,
                                 .x = round(box.x),
                                 .y = round(box.y + shown->y_px + shown->text_px),
                                 .width = round(box.width)};
    const struct reader_grid *grid = &view->setup.grid;
    const struct reader_region *region = &grid->wide[READER_WIDE_DEMONSTRATIONS];
    out->right = grid->texts
                     ? region->x + region->width
                     : view->setup.width_px - view->setup.margin_px - view->setup.notes_px;
    if (beside) /* text stands behind it */
        out->right = out->x + out->width;
    out->height = round(block->stage_height * out->width / block->stage_width);
    return true;
}

/* ---- boxes ---- */

/* Those of one span's letters from..to, of the paragraph's bytes. */
static int span_boxes(struct reader_view *view, const struct reader_shown *shown, int id,
                      int from, int to, struct reader_box *boxes, int most)
{
    enum { LINES = 64 };
    struct page_box found[LINES];
    int count = 0;
    if (page_select(view->pages->text, (struct page_place){id, from},
                    (struct page_place){id, to}, shown->passage - view->begin, found, LINES,
                    &count) != FONT_OK)
        return 0;
    count = count < LINES ? count : LINES;
    for (int i = 0; i < count && i < most; i++)
        boxes[i] = (struct reader_box){shown->passage, found[i].x,
                                       found[i].y + shown->y_px + shown->text_px,
                                       found[i].width, found[i].height};
    return count;
}

int reader_view_boxes(struct reader_view *view, size_t begin, size_t end,
                      struct reader_box *boxes, int most)
{
    int count = 0;
    for (int i = 0; i < view->shown_count; i++) {
        const struct reader_shown *shown = &view->shown[i];
        const struct made_passage *made = &view->loaded[shown->passage - view->begin];
        for (int k = 0; k < made->count; k++)
            for (int s = 0; s < made->paragraphs[k].spans_count; s++) {
                const struct line_span *span = &made->paragraphs[k].spans[s];
                const long first = (long)begin - span->at, last = (long)end - span->at,
                           length = span->end - span->begin;
                if (span->at < 0 || last <= 0 || first >= length)
                    continue;
                const int room = most > count ? most - count : 0;
                count += span_boxes(view, shown, made->paragraphs[k].id,
                                    span->begin + (first > 0 ? (int)first : 0),
                                    span->begin + (int)(last < length ? last : length),
                                    boxes + (room ? count : 0), room);
            }
    }
    return count;
}
