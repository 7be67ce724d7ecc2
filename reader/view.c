/* view.c - the place in a scrolled column, and what stays when it is set otherwise: see
 * reader_view.h. */
#include "view_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- making ---- */

/* Obstacles are the view's own. */
static struct reader_pages_setup column_setup(const struct reader_view *view,
                                              const struct reader_pages_setup *setup)
{
    struct reader_pages_setup own = *setup;
    own.columns = 1;
    own.running = false;
    own.obstacles = view->obstacles;
    own.obstacles_count = view->setup.obstacles_count;
    return own;
}

/* Where each note is called first. */
static void called_find(const struct reader_view *view, const struct reader_block *blocks,
                        int count)
{
    for (int i = 0; i < count; i++)
        for (int k = 0; k < blocks[i].spans_count; k++) {
            const struct reader_span *s = &blocks[i].spans[k];
            if ((s->look & READER_NOTE) && s->note >= 0 &&
                s->note < view->document->notes_count && view->called[s->note] == SIZE_MAX)
                view->called[s->note] = blocks[i].at + (size_t)s->begin;
        }
}

static enum reader_status notes_begin(struct reader_view *view)
{
    const struct reader_document *d = view->document;
    view->opened = calloc((size_t)d->notes_count + 1, sizeof *view->opened);
    view->opened_at = calloc((size_t)d->notes_count + 1, sizeof *view->opened_at);
    view->called = malloc(((size_t)d->notes_count + 1) * sizeof *view->called);
    view->stage_more = calloc((size_t)d->blocks_count + 1, sizeof *view->stage_more);
    if (!view->opened || !view->opened_at || !view->called || !view->stage_more)
        return pages_no_memory();
    for (int i = 0; i < d->notes_count; i++)
        view->called[i] = SIZE_MAX;
    called_find(view, d->blocks, d->blocks_count);
    called_find(view, d->note_blocks, d->note_blocks_count);
    return READER_OK;
}

enum reader_status reader_view_create(const struct reader_document *document,
                                      const struct reader_pages_setup *setup,
                                      struct reader_view **out)
{
    struct reader_view *view = calloc(1, sizeof *view);
    *out = NULL;
    if (!view)
        return pages_no_memory();
    view->document = document;
    view->setup = column_setup(view, setup);
    enum reader_status status = notes_begin(view);
    if (status == READER_OK)
        status =
            pages_begin(document, &view->setup, VIEW_FRAME_PX, &view->making, &view->pages);
    if (status == READER_OK)
        status = view_passages_make(view);
    if (status == READER_OK)
        *out = view;
    else
        reader_view_destroy(view);
    return status;
}

void reader_view_destroy(struct reader_view *view)
{
    if (!view)
        return;
    if (view->pages)
        view_unload(view);
    reader_pages_destroy(view->pages);
    free(view->passages);
    free(view->loaded);
    free(view->opened);
    free(view->opened_at);
    free(view->called);
    free(view->stage_more);
    free(view->shown);
    free(view->obstacles);
    free(view);
}

/* ---- the place ---- */

/* The passages around the window's top are loaded; the top is within its passage. */
static enum reader_status top_settle(struct reader_view *view)
{
    enum reader_status status = view_load(view, view->at, view->at + 1);
    while (status == READER_OK && view->at_px < 0 && view->at > 0) {
        view->at--;
        status = view_load(view, view->at, view->at + 1);
        view->at_px += view_full_px(view, view->at);
    }
    while (status == READER_OK && view->at + 1 < view->count &&
           view->at_px >= view_full_px(view, view->at)) {
        view->at_px -= view_full_px(view, view->at);
        view->at++;
        status = view_load(view, view->at, view->at + 1);
    }
    if (view->at == 0 && view->at_px < 0)
        view->at_px = 0;
    return status;
}

/* How much of the window stays empty below the text; the passages in it are loaded. */
static enum reader_status window_load(struct reader_view *view, int *end, double *empty)
{
    enum reader_status status = READER_OK;
    double y = -view->at_px;
    for (*end = view->at; y < view->setup.height_px && *end < view->count; ++*end) {
        status = view_load(view, view->at, *end + 1);
        if (status != READER_OK)
            return status;
        y += view_full_px(view, *end);
    }
    *empty = fmax(0, view->setup.height_px - y);
    return status;
}

enum reader_status reader_view_look(struct reader_view *view, const struct reader_shown **shown,
                                    int *count)
{
    int end = 0;
    double empty = 0;
    view->shown_count = *count = 0;
    if (!view->count)
        return READER_OK;
    enum reader_status status = top_settle(view);
    if (status == READER_OK)
        status = window_load(view, &end, &empty);
    if (status == READER_OK && empty > 0 && (view->at > 0 || view->at_px > 0)) {
        view->at_px -= empty; /* the text's end stands at the window's foot */
        status = top_settle(view);
        if (status == READER_OK)
            status = window_load(view, &end, &empty);
    }
    if (status == READER_OK && !array_reserve(&view->shown, &view->shown_capacity,
                                              end - view->at, sizeof *view->shown))
        status = pages_no_memory();
    double y = -view->at_px;
    for (int i = view->at; i < end && status == READER_OK; i++) {
        const struct view_passage *p = &view->passages[i];
        const double full = view_full_px(view, i);
        const struct reader_block *first = &view->document->blocks[p->first],
                                  *last = first + p->blocks - 1;
        view->shown[view->shown_count++] = (struct reader_shown){
            i, y, full, p->before_px, p->version, first->at, last->at + (size_t)last->bytes};
        y += full;
    }
    *shown = view->shown;
    *count = view->shown_count;
    return status;
}

enum reader_status reader_view_layout(struct reader_view *view, int passage,
                                      struct font_layout *out)
{
    *out = (struct font_layout){0};
    if (passage < view->begin || passage >= view->end)
        return reader_fail(READER_BAD_ARGUMENT, "passage %d is not seen", passage);
    return page_layout(view->pages->text, passage - view->begin, out) == FONT_OK
               ? READER_OK
               : pages_failed();
}

void reader_view_scroll(struct reader_view *view, double by_px)
{
    view->at_px += by_px;
    if (by_px != 0)
        view->kept = false;
}

enum reader_status reader_view_go(struct reader_view *view, size_t byte, double from_top_px)
{
    double y0, y1;
    if (!view->count)
        return READER_OK;
    const int passage = view_passage_of(view, byte);
    enum reader_status status = view_load(view, passage, passage + 1);
    if (status == READER_OK)
        status = view_line_of(view, passage, byte, &y0, &y1);
    if (status != READER_OK)
        return status;
    view->at = passage;
    view->at_px = floor(y0) - from_top_px;
    view->kept = false;
    return READER_OK;
}

void reader_view_extent(struct reader_view *view, double *above_px, double *all_px)
{
    *above_px = view->at_px;
    *all_px = 0;
    for (int i = 0; i < view->count; i++) {
        if (i == view->at)
            *above_px += *all_px;
        *all_px += view_full_px(view, i);
    }
}

void reader_view_go_part(struct reader_view *view, double part)
{
    double above, all, y = 0;
    reader_view_extent(view, &above, &all);
    const double to = fmin(fmax(part, 0), 1) * all;
    int i = 0;
    while (i + 1 < view->count && y + view_full_px(view, i) <= to)
        y += view_full_px(view, i++);
    view->at = i;
    view->at_px = floor(to - y);
    view->kept = false;
}

/* ---- the line that is being read ---- */

/* The first whole line of the window, and how far below its top it is. */
static enum reader_status top_line(struct reader_view *view, size_t *byte, double *from_top_px)
{
    const struct reader_shown *shown;
    int count;
    enum reader_status status = reader_view_look(view, &shown, &count);
    *byte = 0;
    *from_top_px = 0;
    for (int i = 0; i < count && status == READER_OK; i++) {
        double line;
        if (!view_line_below(view, shown[i].passage, -shown[i].y_px, byte, &line))
            continue;
        *from_top_px = shown[i].y_px + line;
        return READER_OK;
    }
    if (status == READER_OK && count > 0) { /* nothing but a part of one line or picture */
        double y0 = 0, y1;
        *byte = shown[0].begin;
        status = view_line_of(view, shown[0].passage, *byte, &y0, &y1);
        *from_top_px = shown[0].y_px + y0;
    }
    return status;
}

enum reader_status reader_view_top(struct reader_view *view, size_t *byte)
{
    double from_top;
    if (view->kept) {
        *byte = view->kept_byte;
        return READER_OK;
    }
    return top_line(view, byte, &from_top);
}

static enum reader_status top_keep(struct reader_view *view)
{
    if (view->kept || !view->count)
        return READER_OK;
    enum reader_status status = top_line(view, &view->kept_byte, &view->kept_px);
    view->kept = status == READER_OK;
    return status;
}

/* Puts what is kept where it was, once all is set otherwise. */
static enum reader_status top_restore(struct reader_view *view)
{
    if (!view->kept)
        return READER_OK;
    enum reader_status status = reader_view_go(view, view->kept_byte, view->kept_px);
    view->kept = true;
    return status;
}

static bool same_fonts(const struct reader_pages_setup *a, const struct reader_pages_setup *b)
{
    return a->font == b->font && a->mono == b->mono && a->math == b->math &&
           a->language == b->language && a->size_px == b->size_px && a->leading == b->leading &&
           memcmp(a->sizes, b->sizes, sizeof a->sizes) == 0 &&
           memcmp(a->ink_link, b->ink_link, sizeof a->ink_link) == 0 &&
           memcmp(a->ink_struck, b->ink_struck, sizeof a->ink_struck) == 0;
}

static bool same_region(const struct reader_region *a, const struct reader_region *b)
{
    return a->x == b->x && a->width == b->width && a->notes_x == b->notes_x &&
           a->notes_width == b->notes_width;
}

static bool same_grid(const struct reader_grid *a, const struct reader_grid *b)
{
    bool same = a->texts == b->texts;
    for (int i = 0; i < a->texts && same; i++)
        same = same_region(&a->text[i], &b->text[i]);
    for (int i = 0; i < READER_WIDES && same; i++)
        same = same_region(&a->wide[i], &b->wide[i]);
    return same;
}

/* besides: figures stand beside text: how high they are depends on the window's height. */
static bool same_column(const struct reader_pages_setup *a, const struct reader_pages_setup *b,
                        bool besides)
{
    return a->width_px == b->width_px && a->margin_px == b->margin_px &&
           a->notes_px == b->notes_px && a->gap_px == b->gap_px && a->align == b->align &&
           a->hyphenate == b->hyphenate && a->stage_strip_px == b->stage_strip_px &&
           same_grid(&a->grid, &b->grid) && reader_beside_same(&a->beside, &b->beside) &&
           ((!view_bands(a) && !besides) || a->height_px == b->height_px);
}

/* The same fonts in another column: what was set goes. */
static enum reader_status column_change(struct reader_view *view,
                                        const struct reader_pages_setup *setup)
{
    const struct reader_pages_setup before = view->setup;
    view_unload(view);
    view->pages->setup = *setup;
    enum reader_status status = pages_template_set(view->pages, VIEW_FRAME_PX);
    if (status == READER_OK)
        view->setup = *setup;
    else
        view->pages->setup = before;
    return status;
}

enum reader_status reader_view_set(struct reader_view *view,
                                   const struct reader_pages_setup *setup)
{
    const struct reader_pages_setup to = column_setup(view, setup);
    struct reader_pages *pages = NULL;
    enum reader_status status = top_keep(view);
    if (status != READER_OK)
        return status;
    if (same_fonts(&to, &view->setup) && same_column(&to, &view->setup, view->besides)) {
        view->setup = to;
        return READER_OK;
    }
    if (same_fonts(&to, &view->setup)) {
        status = column_change(view, &to);
    } else {
        status = pages_begin(view->document, &to, VIEW_FRAME_PX, &view->making, &pages);
        if (status == READER_OK) {
            view_unload(view);
            reader_pages_destroy(view->pages);
            view->pages = pages;
            view->setup = to;
        }
    }
    if (status == READER_OK)
        status = view_passages_again(view);
    return status == READER_OK ? top_restore(view) : status;
}

enum reader_status view_grouped(struct reader_view *view)
{
    const bool kept = view->kept;
    const struct reader_shown *shown;
    int count;
    enum reader_status status = top_keep(view);
    view_unload(view);
    if (status == READER_OK)
        status = view_passages_again(view);
    if (status == READER_OK)
        status = top_restore(view);
    if (status == READER_OK) /* what is seen is asked about at once */
        status = reader_view_look(view, &shown, &count);
    view->kept = kept && view->kept;
    return status;
}

/* ---- obstacles ---- */

static bool same_obstacles(const struct reader_view *view, const struct reader_obstacle *to,
                           int count)
{
    const struct reader_obstacle *own = view->obstacles;
    bool same = view->setup.obstacles_count == count;
    for (int i = 0; i < count && same; i++) {
        same = own[i].block == to[i].block && own[i].side == to[i].side &&
               own[i].x == to[i].x && own[i].y == to[i].y && own[i].height == to[i].height &&
               own[i].rows_count == to[i].rows_count;
        for (int k = 0; k < to[i].rows_count && same; k++)
            same = own[i].rows[k].from_px == to[i].rows[k].from_px &&
                   own[i].rows[k].to_px == to[i].rows[k].to_px;
    }
    return same;
}

enum reader_status reader_view_around(struct reader_view *view,
                                      const struct reader_obstacle *to, int count)
{
    struct reader_obstacle *own = NULL;
    if (same_obstacles(view, to, count))
        return READER_OK;
    enum reader_status status = top_keep(view);
    if (status == READER_OK && count) {
        own = malloc((size_t)count * sizeof *own);
        status = own ? READER_OK : pages_no_memory();
        if (own)
            memcpy(own, to, (size_t)count * sizeof *own);
    }
    if (status != READER_OK)
        return status;
    free(view->obstacles);
    view->obstacles = own;
    view->setup.obstacles = view->pages->setup.obstacles = own;
    view->setup.obstacles_count = view->pages->setup.obstacles_count = count;
    return view_grouped(view);
}

/* ---- stages ---- */

enum reader_status reader_view_stage_room(struct reader_view *view, int block, double more_px)
{
    if (block < 0 || block >= view->document->blocks_count || !(more_px >= 0))
        return reader_fail(READER_BAD_ARGUMENT, "there is no stage %d", block);
    if (view->stage_more[block] == more_px)
        return READER_OK;
    enum reader_status status = top_keep(view);
    if (status != READER_OK)
        return status;
    view->stage_more[block] = more_px;
    view_unload(view);
    return top_restore(view);
}

/* ---- notes ---- */

enum reader_status reader_view_note(struct reader_view *view, int note, size_t byte)
{
    if (note < 0 || note >= view->document->notes_count)
        return reader_fail(READER_BAD_ARGUMENT, "there is no note %d", note + 1);
    enum reader_status status = top_keep(view);
    if (status != READER_OK)
        return status;
    const int here = view_passage_of(view, byte) + 1, before = view->opened[note];
    view->opened[note] = before == here ? 0 : here;
    view->opened_at[note] = byte;
    view_unload(view);
    return top_restore(view);
}

int reader_view_note_passage(const struct reader_view *view, int note)
{
    return note >= 0 && note < view->document->notes_count ? view->opened[note] - 1 : -1;
}

bool reader_view_note_open(const struct reader_view *view, int note)
{
    return reader_view_note_passage(view, note) >= 0;
}

long reader_view_set_count(const struct reader_view *view)
{
    return view->set_count;
}
