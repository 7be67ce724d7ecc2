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

static double column_of(const struct reader_view *view, int wide)
{
    const struct reader_grid *grid = &view->setup.grid;
    const double column = !grid->texts ? pages_column(view->pages)
                          : wide < 0   ? grid->text[0].width
                                       : grid->wide[wide].width;
    return fmax(view->setup.size_px, column);
}

/* As high as its letters would be, were they all as wide as half their height. */
static double block_estimate(const struct reader_view *view, int block)
{
    const struct reader_block *b = &view->document->blocks[block];
    const double size = view->setup.size_px;
    return view->setup.leading * size *
           (1 + floor(b->bytes * 0.45 * size / column_of(view, view_wide_of(view, block))));
}

static double text_estimate(const struct reader_view *view, int passage)
{
    const struct view_passage *p = &view->passages[passage];
    const int texts = view->setup.grid.texts;
    double all = 0;
    for (int i = p->first; i < p->first + p->blocks; i++)
        all += block_estimate(view, i);
    return ceil(texts > 1 && view_wide_of(view, p->first) < 0 ? all / texts : all);
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

bool view_bands(const struct reader_pages_setup *setup)
{
    return setup->grid.texts > 1;
}

/* How many blocks from this one on are a passage: where columns of text stand beside each
 * other, what goes through all of them before one goes on below: no higher than is seen at
 * once. */
static int band_length(const struct reader_view *view, int first)
{
    enum { BLOCKS_MAX = 48 };
    const struct reader_document *d = view->document;
    const double part = 0.75;
    int n = pages_passage_length(d, first);
    if (!view_bands(&view->setup) || view_wide_of(view, first) >= 0)
        return n;
    const double most = part * view->setup.height_px * view->setup.grid.texts;
    double all = block_estimate(view, first);
    for (; first + n < d->blocks_count && n < BLOCKS_MAX; n++) {
        all += block_estimate(view, first + n);
        if (view_wide_of(view, first + n) >= 0 || all > most)
            break;
    }
    while (n > 1 && d->blocks[first + n - 1].kind == READER_HEADING)
        n--; /* a heading goes with what follows */
    return n;
}

/* What stands beside figures is set with them; where one of them stands beside the last of what
 * another one has beside it, without an end, a passage ends before some figure. */
int view_passage_length(const struct reader_view *view, int first)
{
    enum { MANY = 24 };
    const struct reader_document *d = view->document;
    int n = band_length(view, first);
    double width;
    for (int i = 0; i < n; i++) {
        const bool figure = pages_beside_host(&view->setup, d, first + i, &width) >= 0;
        if (figure && i >= MANY &&
            pages_beside_host(&view->setup, d, first + i - 1, &width) < 0)
            return i;
        int length = figure ? pages_beside_length(&view->setup, d, first + i) : 1;
        const double end = pages_around_end(&view->setup, first + i);
        if (end > 0)
            length = pages_around_length(&view->setup, d, first + i, end);
        n = i + length > n ? i + length : n;
    }
    return n;
}

enum reader_status view_passages_make(struct reader_view *view)
{
    int capacity = 0;
    double width;
    view->besides = view->setup.obstacles_count > 0;
    for (int i = 0; i < view->document->blocks_count && !view->besides; i++)
        view->besides = pages_beside_host(&view->setup, view->document, i, &width) >= 0;
    for (int i = 0; i < view->document->blocks_count;) {
        const int n = view_passage_length(view, i);
        if (!array_reserve(&view->passages, &capacity, view->count + 1, sizeof *view->passages))
            return pages_no_memory();
        view->passages[view->count++] = (struct view_passage){.first = i, .blocks = n};
        i += n;
    }
    view_forget(view);
    return READER_OK;
}

enum reader_status view_passages_again(struct reader_view *view)
{
    struct view_passage *before = view->passages;
    const int count = view->count, notes = view->document->notes_count;
    view->passages = NULL;
    view->count = 0;
    enum reader_status status = view_passages_make(view);
    if (status != READER_OK) {
        free(view->passages);
        view->passages = before;
        view->count = count;
        return status;
    }
    free(before);
    bool any = count != view->count;
    for (int depth = 0; any && depth < READER_DEPTH_MAX; depth++) {
        any = false; /* a note within a note follows it */
        for (int i = 0; i < notes; i++) {
            if (!view->opened[i])
                continue;
            const int at = view_passage_of(view, view->opened_at[i]) + 1;
            any = any || at != view->opened[i];
            view->opened[i] = at;
        }
    }
    if (view->at >= view->count)
        view->at = view->count ? view->count - 1 : 0;
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
static int flow_count(const struct made_passage *made)
{
    int count = 0;
    for (int i = 0; i < made->count; i++)
        count += !made->paragraphs[i].beside;
    return count;
}

static void made_drop(struct reader_view *view, struct made_passage *made)
{
    for (int i = made->count - 1; i >= 0; i--) {
        size_t bytes;
        view->paragraphs -= !made->paragraphs[i].beside;
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

static enum reader_status end_get(struct reader_view *view, const struct made_paragraph *p,
                                  struct page_caret *caret)
{
    size_t bytes;
    page_paragraph_text(view->pages->text, p->id, &bytes);
    const struct page_place end = {p->id, (int)bytes};
    return page_caret_get(view->pages->text, end, true, caret) == FONT_OK ? READER_OK
                                                                          : pages_failed();
}

/* The lower edge of the lowest line that ends a paragraph; beside: of those in margins, too. */
static enum reader_status ends_measure(struct reader_view *view,
                                       const struct made_passage *made, bool beside,
                                       double *high)
{
    enum reader_status status = READER_OK;
    for (int i = 0; i < made->count && status == READER_OK; i++) {
        struct page_caret caret = {0};
        if (made->paragraphs[i].beside && !beside)
            continue;
        status = end_get(view, &made->paragraphs[i], &caret);
        if (made->paragraphs[i].figure) /* and what is blank below it */
            caret.y1 += 0.6 * view->setup.size_px;
        *high = fmax(*high, caret.y1);
    }
    return status;
}

/* Its columns are no deeper; *fits: all of it stands in them. */
static enum reader_status depth_try(struct reader_view *view, int passage, double depth_px,
                                    bool *fits)
{
    struct page_text *text = view->pages->text;
    const struct made_passage *made = &view->loaded[passage - view->begin];
    struct page_manner manner = made->manner;
    manner.page_depth_px = depth_px;
    *fits = true;
    if (page_paragraph_manner(text, made->first, &manner) != FONT_OK)
        return pages_failed();
    for (int i = made->count - 1; i >= 0 && *fits; i--) {
        int page;
        size_t bytes;
        page_paragraph_text(text, made->paragraphs[i].id, &bytes);
        const struct page_place end = {made->paragraphs[i].id, (int)bytes};
        /* one line may be higher than that: it stands nowhere */
        *fits = page_find(text, end, &page) == FONT_OK && page == passage - view->begin;
    }
    return READER_OK;
}

/* Columns beside each other are about as deep: the least depth that has room for all, line by
 * line from the one that would have if nothing had to stay together. *high: that depth; 0: all
 * of it stands in the first column. */
static enum reader_status band_balance(struct reader_view *view, int passage, double *high)
{
    enum { LINES = 12 };
    const struct made_passage *made = &view->loaded[passage - view->begin];
    const double line = view->setup.leading * view->setup.size_px;
    double all = 0, columns = 0;
    bool fits = false;
    *high = 0;
    if (!view_bands(&view->setup) || !made->count ||
        view_wide_of(view, view->passages[passage].first) >= 0)
        return READER_OK;
    enum reader_status status = ends_measure(view, made, false, &all);
    for (int i = 0; i < view->setup.grid.texts; i++)
        columns += view->setup.grid.text[i].width / view->setup.grid.text[0].width;
    double depth = fmax(line, all / columns);
    for (int i = 0; status == READER_OK && !fits && depth < all; i++) {
        status = depth_try(view, passage, depth, &fits);
        *high = depth;
        depth = i < LINES ? depth + line : 1.25 * depth;
    }
    if (status == READER_OK && !fits) {
        *high = 0;
        status = depth_try(view, passage, 0, &fits);
    }
    return status;
}

/* The lower edge of the lowest obstacle. */
static enum reader_status obstacles_measure(struct reader_view *view, int passage, double *high)
{
    const struct view_passage *p = &view->passages[passage];
    const struct made_passage *made = &view->loaded[passage - view->begin];
    for (int i = p->first; i < p->first + p->blocks && view->setup.obstacles_count; i++) {
        const double end = pages_around_end(&view->setup, i);
        const int id = end > 0 ? view_paragraph_of(made, i) : -1;
        double x, y;
        int page;
        if (id < 0)
            continue;
        if (page_paragraph_begins(view->pages->text, id, &page, &x, &y) != FONT_OK)
            return pages_failed();
        *high = fmax(*high, y + end);
    }
    return READER_OK;
}

/* How high its lines are, and what is left blank around them: the ends of the text have the
 * margin. */
static enum reader_status passage_measure(struct reader_view *view, int passage)
{
    struct view_passage *p = &view->passages[passage];
    const struct made_passage *made = &view->loaded[passage - view->begin];
    double high, ends = 0;
    enum reader_status status = band_balance(view, passage, &high);
    if (status == READER_OK)
        status = ends_measure(view, made, true, &ends);
    if (status == READER_OK)
        status = obstacles_measure(view, passage, &ends);
    if (status != READER_OK)
        return status;
    p->text_px = ceil(fmax(high, ends));
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
    const int ahead = view_bands(&view->setup) ? 1 : AHEAD; /* a band is a window's worth */
    const int least = from < view->begin ? (from > ahead ? from - ahead : 0) : view->begin;
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
        at += flow_count(&view->loaded[i - view->begin]);
    made_drop(view, own);
    enum reader_status status = passage_make(view, passage, at, &made);
    if (status != READER_OK) {
        view_unload(view);
        return status;
    }
    *own = made;
    return passage_measure(view, passage);
}
