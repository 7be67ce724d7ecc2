/* html_remarks.c - what readers left, as HTML: marks, asides, ink: see html_internal.h. */
#include "html_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct reader_remark *remark_of(const struct html *h, int i)
{
    return reader_remarks_get(h->setup->remarks, i);
}

/* ---- events ---- */

static int by_place(const void *a, const void *b)
{
    const struct html_event *x = a, *y = b;
    if (x->at != y->at)
        return x->at < y->at ? -1 : 1;
    return x->kind != y->kind ? (int)x->kind - (int)y->kind : x->remark - y->remark;
}

static void event_add(struct html *h, size_t at, enum html_event_kind kind, int remark)
{
    h->events[h->events_count++] =
        (struct html_event){.at = at, .kind = kind, .remark = remark};
}

enum reader_status html_remarks_begin(struct html *h)
{
    const int count = h->setup->remarks ? reader_remarks_count(h->setup->remarks) : 0;
    int marks = 0, typed = 0;
    h->events = calloc(2 * (size_t)count + 1, sizeof *h->events);
    if (!h->events)
        return reader_fail(READER_NO_MEMORY, "no memory for notes");
    for (int i = 0; i < count; i++) {
        const struct reader_remark *r = remark_of(h, i);
        if (r->orphan || !reader_remark_seen(r))
            continue;
        if (r->kind == READER_REMARK_INK) {
            if (reader_around_block(h->document, r) < 0) /* else it stands beside lines */
                event_add(h, r->begin, HTML_INK, i);
        } else {
            const bool is_typed = r->kind == READER_REMARK_TYPED;
            event_add(h, r->begin, is_typed ? HTML_TYPED : HTML_MARK, i);
            event_add(h, r->end, is_typed ? HTML_TYPED_END : HTML_MARK_END, i);
        }
    }
    if (h->events_count)
        qsort(h->events, (size_t)h->events_count, sizeof *h->events, by_place);
    for (int i = 0; i < h->events_count; i++) {
        struct html_event *e = &h->events[i];
        marks += (e->kind == HTML_MARK) - (e->kind == HTML_MARK_END);
        typed += (e->kind == HTML_TYPED) - (e->kind == HTML_TYPED_END);
        e->marks = marks;
        e->typed = typed;
    }
    return READER_OK;
}

/* ---- ink ---- */

static double width_of(const struct reader_remark *ink, int i)
{
    return reader_ink_place(ink, i).width;
}

/* A stroke as paths: as wide as it was pressed, points that are about as wide in one path. */
static void stroke_put(struct html *h, const struct reader_remark *r)
{
    fprintf(h->f, "<g fill=\"none\" stroke=\"#%06x\" opacity=\"%.3g\">",
            r->rgba >> 8 & 0xffffff, (r->rgba & 255) / 255.0);
    for (int i = 0; i < r->points_count;) {
        const double width = width_of(r, i);
        const struct reader_ink_place a = reader_ink_place(r, i > 0 ? i - 1 : 0);
        fprintf(h->f, "<path stroke-width=\"%.3f\" d=\"M%.3f %.3fL", width, a.x, a.y);
        do {
            const struct reader_ink_place b = reader_ink_place(r, i);
            fprintf(h->f, "%.3f %.3f ", b.x, b.y);
            i++;
        } while (i < r->points_count && fabs(width_of(r, i) - width) < 0.004);
        fputs("\"/>", h->f);
    }
    fputs("</g>", h->f);
}

void html_ink_put(struct html *h, const struct reader_remark *r)
{
    fprintf(h->f,
            "<svg viewBox=\"0 0 1 1\" role=\"img\" aria-label=\"ink\" "
            "style=\"left:%.3frem;top:%.3frem\">",
            r->x, r->y);
    stroke_put(h, r);
    fputs("</svg>", h->f);
}

static void ink_put(struct html *h, int remark)
{
    fputs("<span class=\"ink\">", h->f);
    html_ink_put(h, remark_of(h, remark));
    fputs("</span>", h->f);
}

/* ---- at their words ---- */

static void event_put(struct html *h, const struct html_event *e)
{
    switch (e->kind) {
    case HTML_INK:
        ink_put(h, e->remark);
        break;
    case HTML_TYPED_END:
        fprintf(h->f,
                "<a class=\"sign\" id=\"w.%d\" href=\"#r.%d\" title=\"note\">\xe2\x9c\x8e</a>",
                e->remark + 1, e->remark + 1);
        if (array_reserve(&h->waiting, &h->waiting_capacity, h->waiting_count + 1,
                          sizeof *h->waiting))
            h->waiting[h->waiting_count++] = e->remark;
        else
            h->status = reader_fail(READER_NO_MEMORY, "no memory for notes");
        break;
    case HTML_MARK:
    case HTML_TYPED:
    case HTML_MARK_END:
        break;
    }
    h->marks = e->marks;
    h->typed = e->typed;
}

/* Where the plain text's block before this one ends; 0: it is the first. */
static size_t before_end(const struct reader_document *d, const struct reader_block *block)
{
    if (block == d->note_blocks)
        block = d->blocks + d->blocks_count;
    return block == d->blocks ? 0 : block[-1].at + (size_t)block[-1].bytes + 1;
}

static bool is_last(const struct reader_document *d, const struct reader_block *block)
{
    return block + 1 == (d->note_blocks_count ? d->note_blocks + d->note_blocks_count
                                              : d->blocks + d->blocks_count);
}

void html_events_begin(struct html *h, const struct reader_block *block)
{
    const size_t from = before_end(h->document, block);
    int low = 0, high = h->events_count;
    while (low < high) {
        const int half = (low + high) / 2;
        if (h->events[half].at < from)
            low = half + 1;
        else
            high = half;
    }
    h->event = low;
    h->marks = low ? h->events[low - 1].marks : 0;
    h->typed = low ? h->events[low - 1].typed : 0;
}

void html_events_put(struct html *h, const struct reader_block *block, int to)
{
    const bool all = to == block->bytes && is_last(h->document, block);
    while (h->event < h->events_count &&
           (all || h->events[h->event].at <= block->at + (size_t)to))
        event_put(h, &h->events[h->event++]);
}

int html_event_next(const struct html *h, const struct reader_block *block, int most)
{
    if (h->event == h->events_count || h->events[h->event].at >= block->at + (size_t)most)
        return most;
    return (int)(h->events[h->event].at - block->at);
}

/* ---- typed notes ---- */

static void quotation_put(struct html *h, const struct reader_remark *r)
{
    enum { QUOTED_MOST = 200 };
    size_t bytes, shown;
    const char *text = reader_anchor_quotation(r->anchor, &bytes);
    shown = bytes < QUOTED_MOST ? bytes : QUOTED_MOST;
    while (shown < bytes && shown && ((unsigned char)text[shown] & 0xc0) == 0x80)
        shown--;
    if (*r->by) {
        fputs("<b>", h->f);
        html_puts(h, r->by);
        fputs("</b>: ", h->f);
    }
    fputs("<q>", h->f);
    html_put(h, text, shown);
    fputs(shown < bytes ? "\xe2\x80\xa6</q> " : "</q> ", h->f);
}

void html_asides_put(struct html *h)
{
    for (int i = 0; i < h->waiting_count; i++) {
        const int remark = h->waiting[i];
        const struct reader_remark *r = remark_of(h, remark);
        fprintf(h->f, "<aside class=\"remark\" id=\"r.%d\"><a href=\"#w.%d\">\xe2\x9c\x8e</a> ",
                remark + 1, remark + 1);
        quotation_put(h, r);
        fputs("<span class=\"typed\">", h->f);
        html_puts(h, r->text);
        fputs("</span></aside>\n", h->f);
    }
    h->waiting_count = 0;
}

/* ---- those whose words are gone ---- */

/* Its ink by itself, no larger than 30 ems. */
static void ink_alone_put(struct html *h, const struct reader_remark *r)
{
    const double most = 30;
    double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    for (int i = 0; i < r->points_count; i++) {
        const struct reader_ink_place p = reader_ink_place(r, i);
        x0 = fmin(x0, p.x - p.width / 2);
        y0 = fmin(y0, p.y - p.width / 2);
        x1 = fmax(x1, p.x + p.width / 2);
        y1 = fmax(y1, p.y + p.width / 2);
    }
    const double scale = fmin(1, most / fmax(x1 - x0, y1 - y0));
    fprintf(h->f,
            "<svg class=\"alone\" role=\"img\" aria-label=\"ink\" viewBox=\"%.3f %.3f %.3f "
            "%.3f\" style=\"width:%.3frem;height:%.3frem\">",
            x0, y0, x1 - x0, y1 - y0, scale * (x1 - x0), scale * (y1 - y0));
    stroke_put(h, r);
    fputs("</svg>", h->f);
}

void html_orphans_put(struct html *h)
{
    const int count = h->setup->remarks ? reader_remarks_count(h->setup->remarks) : 0;
    bool any = false;
    for (int i = 0; i < count; i++) {
        const struct reader_remark *r = remark_of(h, i);
        const char *headings = reader_anchor_headings(r->anchor);
        if (!r->orphan || !reader_remark_seen(r))
            continue;
        if (!any)
            fputs("<section class=\"gone\">\n<h2>Readers\xe2\x80\x99 notes to words that are "
                  "gone</h2>\n",
                  h->f);
        any = true;
        fprintf(h->f, "<aside id=\"r.%d\">", i + 1);
        if (*headings) {
            html_puts(h, headings);
            fputs(": ", h->f);
        }
        quotation_put(h, r);
        fputs("<span class=\"typed\">", h->f);
        html_puts(h, r->text);
        fputs("</span>", h->f);
        if (r->kind == READER_REMARK_INK)
            ink_alone_put(h, r);
        fputs("</aside>\n", h->f);
    }
    if (any)
        fputs("</section>\n", h->f);
}
