/* view_load.c - passages that are looked at become paragraphs of the text, and go again: see
 * view_internal.h. */
#include "view_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LOADED_MAX = 500, /* passages: more are dropped where they are far away */
    INSETS_MAX = 4000 /* formulas and pictures: then all is made anew */
};

/* ---- what there is ---- */

/* As high as its letters would be, were they all as wide as half their height. */
static double text_estimate(const struct reader_view *view, int passage)
{
    const struct view_passage *p = &view->passages[passage];
    const double size = view->setup.size_px, line = view->setup.leading * size,
                 column = fmax(size, pages_column(view->pages));
    double lines = 0;
    for (int i = p->first; i < p->first + p->blocks; i++)
        lines += 1 + floor(view->document->blocks[i].bytes * 0.45 * size / column);
    return ceil(lines * line);
}

void view_forget(struct reader_view *view)
{
    for (int i = 0; i < view->count; i++) {
        struct view_passage *p = &view->passages[i];
        p->known = false;
        p->before_px = p->after_px = 0;
        p->text_px = text_estimate(view, i);
    }
}

enum reader_status view_passages_make(struct reader_view *view)
{
    int capacity = 0;
    for (int i = 0; i < view->document->blocks_count;) {
        const int n = pages_passage_length(view->document, i);
        if (!array_reserve(&view->passages, &capacity, view->count + 1, sizeof *view->passages))
            return pages_no_memory();
        view->passages[view->count++] = (struct view_passage){.first = i, .blocks = n};
        i += n;
    }
    view_forget(view);
    return READER_OK;
}

double view_full_px(const struct reader_view *view, int passage)
{
    const struct view_passage *p = &view->passages[passage];
    return p->before_px + p->text_px + p->after_px;
}

/* ---- unloading ---- */

static void made_free(struct made_passage *made)
{
    for (int i = 0; i < made->count; i++)
        free(made->paragraphs[i].spans);
    free(made->paragraphs);
    *made = (struct made_passage){0};
}

/* How many paragraphs of the flow it is: notes in the margin are none. */
static int flow_count(const struct reader_view *view, const struct made_passage *made)
{
    int count = 0;
    for (int i = 0; i < made->count; i++)
        count += made->paragraphs[i].note < 0 || view->pages->setup.notes_px <= 0;
    return count;
}

static void made_drop(struct reader_view *view, struct made_passage *made)
{
    for (int i = made->count - 1; i >= 0; i--) {
        size_t bytes;
        if (made->paragraphs[i].note < 0 || view->pages->setup.notes_px <= 0)
            view->paragraphs--;
        /* A note in the margin has gone with its paragraph, or goes now. */
        if (page_paragraph_text(view->pages->text, made->paragraphs[i].id, &bytes))
            page_paragraph_remove(view->pages->text, made->paragraphs[i].id);
    }
    made_free(made);
}

static void end_drop(struct reader_view *view)
{
    made_drop(view, &view->loaded[--view->end - view->begin]);
}

static void begin_drop(struct reader_view *view)
{
    made_drop(view, &view->loaded[0]);
    view->begin++;
    memmove(view->loaded, view->loaded + 1,
            (size_t)(view->end - view->begin) * sizeof *view->loaded);
}

void view_unload(struct reader_view *view)
{
    while (view->end > view->begin)
        end_drop(view);
}

/* ---- loading ---- */

/* A passage's paragraphs, from that place of the flow on; nothing where it fails. */
static enum reader_status passage_make(struct reader_view *view, int passage, int at,
                                       struct made_passage *made)
{
    struct reader_pages *p = view->pages;
    const struct view_passage *to = &view->passages[passage];
    memset(p->noted, 0, (size_t)view->document->notes_count * sizeof *p->noted);
    p->at = at;
    p->opened = view->opened;
    p->stage_more = view->stage_more;
    p->passage = passage + 1;
    p->behind_head =
        !to->first || view->document->blocks[to->first - 1].kind != READER_PARAGRAPH;
    enum reader_status status = pages_passage_add(p, to->first, to->blocks);
    *made = view->making;
    view->making = (struct made_passage){0};
    if (status == READER_OK) {
        view->paragraphs += p->at - at;
        view->passages[passage].version = ++view->versions;
        view->set_count++;
        return READER_OK;
    }
    for (; p->at > at; p->at--)
        page_paragraph_remove(p->text, page_paragraph_at(p->text, 0, p->at - 1));
    made_free(made);
    return status;
}

/* The passage beside those that are loaded. */
static enum reader_status passage_load(struct reader_view *view, int passage)
{
    struct made_passage made;
    const bool front = passage < view->begin;
    if (!array_reserve(&view->loaded, &view->loaded_capacity, view->end - view->begin + 1,
                       sizeof *view->loaded))
        return pages_no_memory();
    enum reader_status status =
        passage_make(view, passage, front ? 0 : view->paragraphs, &made);
    if (status != READER_OK)
        return status;
    if (front) {
        memmove(view->loaded + 1, view->loaded,
                (size_t)(view->end - view->begin) * sizeof *view->loaded);
        view->loaded[0] = made;
        view->begin--;
    } else {
        view->loaded[view->end++ - view->begin] = made;
    }
    return READER_OK;
}

/* How high its lines are, and what is left blank around them: the ends of the text have the
 * margin. */
static enum reader_status passage_measure(struct reader_view *view, int passage)
{
    struct view_passage *p = &view->passages[passage];
    const struct made_passage *made = &view->loaded[passage - view->begin];
    double high = 0;
    for (int i = 0; i < made->count; i++) {
        struct page_caret caret;
        size_t bytes;
        page_paragraph_text(view->pages->text, made->paragraphs[i].id, &bytes);
        const struct page_place end = {made->paragraphs[i].id, (int)bytes};
        if (page_caret_get(view->pages->text, end, true, &caret) != FONT_OK)
            return pages_failed();
        high = fmax(high, caret.y1);
    }
    p->text_px = ceil(high);
    const double blank = fmin(view->setup.margin_px, 2 * view->setup.size_px);
    p->before_px = round(passage ? made->before_px : blank);
    p->after_px = round(passage + 1 < view->count ? made->after_px : blank);
    p->known = true;
    return READER_OK;
}

/* Everything anew: what was set before takes too much room. */
static enum reader_status pages_anew(struct reader_view *view)
{
    struct reader_pages *pages;
    enum reader_status status =
        pages_begin(view->document, &view->setup, VIEW_FRAME_PX, &view->making, &pages);
    if (status != READER_OK)
        return status;
    view_unload(view);
    reader_pages_destroy(view->pages);
    view->pages = pages;
    return READER_OK;
}

/* Those far from from..to go, many at a time: each time pages behind them are counted anew. */
static void far_drop(struct reader_view *view, int from, int to)
{
    if (view->end - view->begin <= LOADED_MAX)
        return;
    while (from - view->begin > LOADED_MAX / 4)
        begin_drop(view);
    while (view->end - to > LOADED_MAX / 4)
        end_drop(view);
}

enum reader_status view_load(struct reader_view *view, int from, int to)
{
    enum {
        AHEAD = 6
    }; /* those before are loaded so many at a time: pages behind them are counted anew */
    enum reader_status status = READER_OK;
    if (from >= view->begin && to <= view->end)
        return READER_OK;
    if (view->pages->insets > INSETS_MAX)
        status = pages_anew(view);
    if (view->end == view->begin || to < view->begin || from > view->end) {
        view_unload(view);
        view->begin = view->end = from;
    }
    const int least = from < view->begin ? (from > AHEAD ? from - AHEAD : 0) : view->begin;
    const int loaded_begin = view->begin, loaded_end = view->end;
    while (status == READER_OK && view->begin > least)
        status = passage_load(view, view->begin - 1);
    while (status == READER_OK && view->end < to)
        status = passage_load(view, view->end);
    for (int i = view->begin; i < view->end && status == READER_OK; i++)
        if (i < loaded_begin || i >= loaded_end)
            status = passage_measure(view, i);
    if (status == READER_OK)
        far_drop(view, from, to);
    return status;
}

enum reader_status view_again(struct reader_view *view, int passage)
{
    struct made_passage *own = &view->loaded[passage - view->begin], made;
    int at = 0;
    for (int i = view->begin; i < passage; i++)
        at += flow_count(view, &view->loaded[i - view->begin]);
    made_drop(view, own);
    enum reader_status status = passage_make(view, passage, at, &made);
    if (status != READER_OK) {
        view_unload(view);
        return status;
    }
    *own = made;
    return passage_measure(view, passage);
}
