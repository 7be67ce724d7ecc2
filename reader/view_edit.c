/* view_edit.c - carets, and passages that are edited: see reader_view.h. */
#include "view_internal.h"

#include <math.h>

/* ---- carets ---- */

/* The letter at a byte, or the end of the one before it. Returns how well it fits: 2 as asked,
 * 1 the other edge, 0 neither. */
static int place_fit(const struct made_passage *made, size_t byte, bool before,
                     struct page_place *place, bool *edge)
{
    int best = 0;
    for (int i = 0; i < made->count; i++)
        for (int k = 0; k < made->paragraphs[i].spans_count; k++) {
            const struct line_span *s = &made->paragraphs[i].spans[k];
            const long from = (long)byte - s->at, length = s->end - s->begin;
            if (s->at < 0 || from < 0 || from > length)
                continue;
            const bool behind = from<length, ahead = from> 0;
            const int fit = (before ? ahead : behind) ? 2 : 1;
            if (fit <= best)
                continue;
            best = fit;
            *edge = fit == 2 ? before : !before;
            *place = (struct page_place){made->paragraphs[i].id, s->begin + (int)from};
        }
    return best;
}

/* In a block that has no letters. */
static bool empty_caret(struct reader_view *view, const struct reader_shown *shown, size_t byte,
                        struct reader_box *out)
{
    const struct made_passage *made = &view->loaded[shown->passage - view->begin];
    struct page_caret caret;
    for (int i = 0; i < made->count; i++) {
        const struct reader_block *block = &view->document->blocks[made->paragraphs[i].block];
        if (made->paragraphs[i].note >= 0 || block->bytes || block->at != byte ||
            page_caret_get(view->pages->text, (struct page_place){made->paragraphs[i].id, 0},
                           false, &caret) != FONT_OK)
            continue;
        *out = (struct reader_box){shown->passage, caret.x0,
                                   caret.y0 + shown->y_px + shown->text_px, 0,
                                   caret.y1 - caret.y0};
        return true;
    }
    return false;
}

bool reader_view_caret(struct reader_view *view, size_t byte, bool before,
                       struct reader_box *out)
{
    struct page_place place;
    struct page_caret caret;
    bool edge = false;
    for (int i = 0; i < view->shown_count; i++) {
        const struct reader_shown *shown = &view->shown[i];
        const struct made_passage *made = &view->loaded[shown->passage - view->begin];
        if (!place_fit(made, byte, before, &place, &edge))
            continue;
        if (page_caret_get(view->pages->text, place, edge, &caret) != FONT_OK)
            return false;
        *out = (struct reader_box){shown->passage, caret.x0,
                                   caret.y0 + shown->y_px + shown->text_px, 0,
                                   caret.y1 - caret.y0};
        return true;
    }
    for (int i = 0; i < view->shown_count; i++) { /* nothing is written in it yet */
        const struct reader_shown *shown = &view->shown[i];
        if (empty_caret(view, shown, byte, out))
            return true;
    }
    return false;
}

bool reader_view_caret_at(struct reader_view *view, double x, double y, size_t *byte,
                          bool *before)
{
    const struct reader_shown *shown = NULL;
    struct page_place place;
    for (int i = 0; i < view->shown_count; i++) {
        shown = &view->shown[i];
        if (y < shown->y_px + shown->height_px)
            break;
    }
    if (!shown || page_hit(view->pages->text, shown->passage - view->begin, x,
                           y - shown->y_px - shown->text_px, &place, before) != FONT_OK)
        return false;
    const long found = view_byte_of(&view->loaded[shown->passage - view->begin], place);
    *byte = found >= 0 ? (size_t)found : shown->begin;
    return true;
}

/* ---- edits ---- */

static void bytes_move(struct reader_view *view, size_t at, size_t removed, size_t inserted)
{
    for (int i = 0; i < view->document->notes_count; i++)
        if (view->called[i] != SIZE_MAX && view->called[i] > at)
            view->called[i] = view->called[i] - removed + inserted;
    for (int i = 0; i < view->document->notes_count; i++)
        if (view->opened[i] && view->opened_at[i] > at)
            view->opened_at[i] = view->opened_at[i] - removed + inserted;
    if (view->kept && view->kept_byte > at)
        view->kept_byte =
            view->kept_byte > at + removed ? view->kept_byte - removed + inserted : at;
    for (int i = 0; i < view->end - view->begin; i++)
        for (int k = 0; k < view->loaded[i].count; k++)
            for (int s = 0; s < view->loaded[i].paragraphs[k].spans_count; s++) {
                struct line_span *span = &view->loaded[i].paragraphs[k].spans[s];
                if (span->at > (long)at)
                    span->at += (long)inserted - (long)removed;
            }
}

static bool has_note(const struct made_passage *made, int note)
{
    for (int i = 0; i < made->count; i++)
        if (made->paragraphs[i].note == note)
            return true;
    return false;
}

/* A note's text is other, wherever it is seen. */
static enum reader_status note_edited(struct reader_view *view, int note)
{
    enum reader_status status = READER_OK;
    for (int i = view->begin; i < view->end && status == READER_OK; i++)
        if (has_note(&view->loaded[i - view->begin], note))
            status = view_again(view, i);
    if (note >= 0 && view->opened[note])
        view->passages[view->opened[note] - 1].known = false;
    return status;
}

enum reader_status reader_view_edited(struct reader_view *view, int block, size_t at,
                                      size_t removed, size_t inserted)
{
    int passage = 0;
    bytes_move(view, at, removed, inserted);
    if (block >= view->document->blocks_count)
        return note_edited(view, view_note_of(view, block - view->document->blocks_count));
    while (passage + 1 < view->count && view->passages[passage + 1].first <= block)
        passage++;
    if (view->besides && view_passage_length(view, view->passages[passage].first) !=
                             view->passages[passage].blocks)
        return view_grouped(view);
    if (passage >= view->begin && passage < view->end)
        return view_again(view, passage);
    view->passages[passage].known = false;
    return READER_OK;
}

enum reader_status reader_view_as(struct reader_view *view, const struct reader_view *before)
{
    const int count = view->document->notes_count;
    if (count != before->document->notes_count)
        return READER_OK;
    for (int i = 0; i < count; i++) {
        if (!before->opened[i])
            continue;
        view->opened_at[i] = view->called[i];
        view->opened[i] =
            view->called[i] != SIZE_MAX ? view_passage_of(view, view->called[i]) + 1 : 0;
    }
    view_unload(view);
    return READER_OK;
}
