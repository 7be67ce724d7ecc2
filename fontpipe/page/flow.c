/* flow.c - paragraphs onto pages: see page_internal.h.
 *
 * A page is filled from where the one before it ended, frame after frame. A paragraph is broken
 * for the widths of the slots that it is going to stand in; then it is seen how many of its
 * lines may stand in the frame (its keeps, the notes that its lines bring along), and where
 * fewer stand here than fit, it is broken again for the slots that it gets. */
#include "page_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EMPTY_PAGES_MAX = 2 };

static const struct page_template *template_numbered(const struct page_text *t, int number)
{
    return t->templates_count
               ? &t->templates[number < t->templates_count ? number : t->templates_count - 1]
               : NULL;
}

const struct page_template *flow_template(const struct page_text *t, int page)
{
    const int asked = page < t->pages_count ? t->pages[page].template : 0;
    return template_numbered(t, asked ? asked - 1 : page);
}

/* ---- slots to come ---- */

struct walk {
    const struct page_text *t;
    const struct page_template *template;
    int flow, page, frame, part;
    double v, v_end, depth_px; /* depth_px: of this page's frames at most; 0: as they are */
    int empty_pages;
};

static int frame_next(const struct page_template *t, int flow, int frame)
{
    for (frame++; frame < t->frames_count; frame++)
        if (t->frames[frame].flow == flow)
            return frame;
    return -1;
}

static double depth_within(const struct page_frame *frame, double most)
{
    const double depth = frame_depth(frame);
    return most > 0 && most < depth ? most : depth;
}

/* On to the flow's next frame; false: there are none any more. */
static bool walk_on(struct walk *w)
{
    w->frame = frame_next(w->template, w->flow, w->frame);
    while (w->frame < 0) {
        if (++w->empty_pages > EMPTY_PAGES_MAX)
            return false;
        w->template = template_numbered(w->t, ++w->page);
        w->depth_px = 0;
        w->frame = frame_next(w->template, w->flow, -1);
    }
    w->v = 0;
    w->part = 0;
    w->v_end = depth_within(&w->template->frames[w->frame], w->depth_px);
    return true;
}

static bool walk_next(struct walk *w, double height, struct slot *slot)
{
    while (!slots_next(w->template, w->frame, &w->v, &w->part, w->v_end, height, slot))
        if (!walk_on(w))
            return false;
    w->empty_pages = 0;
    return true;
}

/* ---- filling a frame ---- */

struct filling {
    struct page_text *t;
    struct page *page;
    const struct page_template *template;
    int number, flow, frame;
    double v, foot_px, margin_v;
    double depth_px; /* of the frame */
    bool top;        /* nothing stands in the frame yet */
    bool first;      /* the frame is its flow's first on the page */
    struct paragraph **notes;
    int notes_count, notes_capacity;
    double *widths;
    int widths_capacity;
    struct slot *slots;
    int slots_capacity;
};

static double paragraph_measure(const struct paragraph *p, const struct slot *s, bool first)
{
    return s->u1 - s->u0 - p->manner.left_px - p->manner.right_px -
           (first ? p->manner.indent_px : 0);
}

bool flow_uniform(const struct page_text *t, int flow, double *width)
{
    *width = 0;
    for (int k = 0; k < t->templates_count; k++) {
        if (t->templates[k].shapes_count)
            return false;
        for (int i = 0; i < t->templates[k].frames_count; i++) {
            const struct page_frame *f = &t->templates[k].frames[i];
            if (f->flow != flow)
                continue;
            if (*width > 0 && *width != frame_measure(f))
                return false;
            *width = frame_measure(f);
        }
    }
    return true;
}

/* Whether the lines from `from` on are of these widths already. */
static bool rest_fits(const struct paragraph *p, int from, const double *widths, int count)
{
    for (int i = from; i < p->lines_count; i++)
        if (p->lines[i].width_px != widths[i - from < count ? i - from : count - 1])
            return false;
    return true;
}

/* Breaks the paragraph, from line `from` on, for the slots from here on, of which at most
 * `limit` are in this frame. *here: of how many slots in this frame that knew; -1: all slots
 * are alike. What goes on behind another frame's lines is broken anew only where notes or keeps
 * have left it other slots than were foreseen there. */
static enum font_status break_here(struct filling *f, struct paragraph *p, int from, int limit,
                                   int *here)
{
    struct slot slot;
    double width;
    const double narrow =
        1; /* slots are no narrower than that, whatever the paragraph leaves blank */
    enum font_status status = set_analyse(f->t, p);
    *here = -1;
    if (status != FONT_OK)
        return status;
    if (flow_uniform(f->t, f->flow, &width)) {
        if (from)
            return FONT_OK;
        slot = (struct slot){.u1 = width};
        double widths[2] = {fmax(narrow, paragraph_measure(p, &slot, true)),
                            fmax(narrow, paragraph_measure(p, &slot, false))};
        return lines_break(f->t, p, widths, widths[0] == widths[1] ? 1 : 2);
    }
    for (int wanted = 16;; wanted *= 4) {
        const struct page_template *template = f->template;
        struct walk w = {.t = f->t,
                         .template = f->template,
                         .flow = f->flow,
                         .page = f->number,
                         .frame = f->frame,
                         .v = f->v,
                         .v_end = f->depth_px - f->foot_px,
                         .depth_px = f->page->depth_px};
        int count = 0;
        if (!array_reserve(&f->widths, &f->widths_capacity, wanted, sizeof *f->widths))
            return font_fail(FONT_NO_MEMORY, "no memory for a page");
        bool more = limit != 0 || walk_on(&w);
        *here = 0;
        while (more && count < wanted && (more = walk_next(&w, p->leading_px, &slot))) {
            f->widths[count] = fmax(narrow, paragraph_measure(p, &slot, from + count == 0));
            *here += w.page == f->number && w.frame == f->frame;
            if (++count == limit)
                more = walk_on(&w);
        }
        if (!count)
            f->widths[count++] = fmax(narrow, frame_measure(&template->frames[f->frame]));
        int told = count; /* the last one is that of all behind it: the fewest that say so */
        while (told > 1 && f->widths[told - 1] == f->widths[told - 2])
            told--;
        if (!from)
            status = lines_break(f->t, p, f->widths, told);
        else if (more && p->lines_count - from > count)
            continue;
        else if (!rest_fits(p, from, f->widths, count))
            status = lines_break_rest(f->t, p, from, f->widths, count);
        if (status != FONT_OK || p->lines_count - from <= count || !more)
            return status;
    }
}

/* How high a note is, set as wide as the frame. */
static enum font_status note_height(struct filling *f, struct paragraph *p, double width_px,
                                    double *height)
{
    struct slot slot = {.u1 = width_px};
    enum font_status status = set_analyse(f->t, p);
    double widths[2] = {fmax(1, paragraph_measure(p, &slot, true)),
                        fmax(1, paragraph_measure(p, &slot, false))};
    if (status == FONT_OK)
        status = lines_break(f->t, p, widths, 2);
    *height = p->lines_count * p->leading_px + p->manner.before_px + p->manner.after_px;
    return status;
}

/* Which of the paragraph's notes, which are in the order of their places, are a line's. */
static void notes_of(const struct paragraph *p, const struct line *line, int *from, int *to)
{
    *from = *to = 0;
    if (!p->notes_count)
        return;
    const int end = line->end < p->count ? p->letters[line->end].byte : p->bytes + 1;
    const int begin = line->begin < p->count ? p->letters[line->begin].byte : 0;
    int low = 0, high = p->notes_count; /* by halves */
    while (low < high) {
        int half = low + (high - low) / 2;
        if (p->notes[half].byte <= (begin ? begin : -1))
            low = half + 1;
        else
            high = half;
    }
    for (*from = *to = low; *to < p->notes_count && p->notes[*to].byte <= end;)
        ++*to;
}

/* What a line's notes take at the foot. */
static enum font_status line_notes(struct filling *f, const struct paragraph *p,
                                   const struct line *line, double *height)
{
    const struct page_frame *frame = &f->template->frames[f->frame];
    int from, to;
    *height = 0;
    notes_of(p, line, &from, &to);
    for (int i = from; i < to; i++) {
        const struct note *n = &p->notes[i];
        if (n->kind != PAGE_NOTE_FOOT)
            continue;
        double own;
        enum font_status status = note_height(f, n->paragraph, frame_measure(frame), &own);
        if (status != FONT_OK)
            return status;
        *height += own;
    }
    return FONT_OK;
}

/* How many lines from `from` on fit into the frame; their slots are in f->slots. */
static enum font_status lines_fit(struct filling *f, const struct paragraph *p, int from,
                                  int *fit)
{
    const struct page_frame *frame = &f->template->frames[f->frame];
    double v = f->v, foot = f->foot_px, own;
    int part = 0;
    *fit = 0;
    for (int i = from; i < p->lines_count; i++) {
        struct slot slot;
        enum font_status status = line_notes(f, p, &p->lines[i], &own);
        if (status != FONT_OK)
            return status;
        double after = foot + own + (own > 0 && foot == 0 ? frame->foot_gap_px : 0);
        bool room = slots_next(f->template, f->frame, &v, &part, f->depth_px - after,
                               p->leading_px, &slot);
        /* A note that is too high for any column stands over its edge. */
        if (!room && f->top && *fit == 0 && own > 0)
            room =
                slots_next(f->template, f->frame, &v, &part, f->depth_px, p->leading_px, &slot);
        if (!room)
            return FONT_OK;
        if (!array_reserve(&f->slots, &f->slots_capacity, *fit + 1, sizeof *f->slots))
            return font_fail(FONT_NO_MEMORY, "no memory for a page");
        f->slots[(*fit)++] = slot;
        foot = after;
    }
    return FONT_OK;
}

/* What paragraphs behind one that is kept with them need of the frame. */
static enum font_status chain_height(struct filling *f, const struct paragraph *p,
                                     double *height)
{
    const struct flow *flow = &f->t->flows[f->flow];
    double width = frame_measure(&f->template->frames[f->frame]);
    *height = p->manner.after_px;
    for (int i = p->at + 1; i < flow->count && i <= p->at + FLOW_CHAIN_MAX; i++) {
        struct paragraph *q = flow->paragraphs[i];
        double own;
        if (q->manner.begins_column || q->manner.begins_page)
            break;
        enum font_status status = note_height(f, q, width, &own);
        if (status != FONT_OK)
            return status;
        if (q->manner.keep_with_next) {
            *height += own;
            continue;
        }
        int lines = q->manner.keep_together || q->lines_count < q->manner.orphans
                        ? q->lines_count
                        : q->manner.orphans;
        *height += q->manner.before_px + lines * q->leading_px;
        break;
    }
    return FONT_OK;
}

/* How many of the lines that fit are to stand here. */
static enum font_status lines_keep(struct filling *f, const struct paragraph *p, int from,
                                   int fit, int *stand)
{
    const struct page_manner *m = &p->manner;
    int left = p->lines_count - from, orphans = from ? 0 : m->orphans;
    double depth = f->depth_px, behind;
    *stand = fit;
    if (fit < left) {
        if (m->keep_together && !from && left * p->leading_px <= depth)
            *stand = 0;
        if (left - *stand < m->widows)
            *stand = left - m->widows;
        if (*stand < orphans || *stand < 0)
            *stand = 0;
    } else if (m->keep_with_next && !from && p->at + 1 < f->t->flows[f->flow].count) {
        enum font_status status = chain_height(f, p, &behind);
        if (status != FONT_OK)
            return status;
        double end = fit ? f->slots[fit - 1].v + p->leading_px : f->v;
        behind += f->template->frames[f->frame].grid_px; /* up to its next place */
        if (end + behind > depth - f->foot_px + 1e-6)
            *stand = 0;
    }
    if (*stand == 0 && f->top) /* the next column has no more room than this one */
        *stand = fit;
    return FONT_OK;
}

static bool slot_add(struct page *page, struct slot slot)
{
    if (!array_reserve(&page->slots, &page->slots_capacity, page->slots_count + 1,
                       sizeof *page->slots))
        return false;
    page->slots[page->slots_count++] = slot;
    return true;
}

uint32_t flow_lines_hash(const struct paragraph *p, int begin, int end)
{
    uint32_t hash = 0;
    for (int i = begin; i < end; i++) {
        const struct line *l = &p->lines[i];
        const int seen[] = {(int)hash, l->begin, l->end, l->ink_end, l->hyphen, l->last};
        hash = font_hash(seen, sizeof seen);
    }
    return hash;
}

static bool piece_add(struct page *page, struct paragraph *p, int begin, int end, int frame,
                      const struct slot *slots)
{
    if (begin == end)
        return true;
    if (!array_reserve(&page->pieces, &page->pieces_capacity, page->pieces_count + 1,
                       sizeof *page->pieces))
        return false;
    page->pieces[page->pieces_count++] =
        (struct piece){.paragraph = p,
                       .begin = begin,
                       .end = end,
                       .slots_begin = page->slots_count,
                       .frame = frame,
                       .lines_hash = flow_lines_hash(p, begin, end),
                       .breakings = p->breakings};
    for (int i = 0; i < end - begin; i++) {
        struct slot s = slots[i];
        bool first = begin + i == 0;
        s.u0 += (p->base ? p->manner.right_px : p->manner.left_px) +
                (first && !p->base ? p->manner.indent_px : 0);
        s.u1 -= (p->base ? p->manner.left_px : p->manner.right_px) +
                (first && p->base ? p->manner.indent_px : 0);
        if (!slot_add(page, s))
            return false;
    }
    return true;
}

/* A note's lines, from v on, in a box of the frame's. */
static enum font_status note_place(struct filling *f, struct paragraph *p, double u0, double u1,
                                   double v)
{
    if (!array_reserve(&f->slots, &f->slots_capacity, p->lines_count, sizeof *f->slots))
        return font_fail(FONT_NO_MEMORY, "no memory for a page");
    for (int i = 0; i < p->lines_count; i++)
        f->slots[i] =
            (struct slot){u0, u1, v + p->manner.before_px + i * p->leading_px, f->frame};
    p->first_page = f->number;
    return piece_add(f->page, p, 0, p->lines_count, f->frame, f->slots)
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for a page");
}

/* The notes of lines that were just placed: those of the margin at once, those of the foot when
 * the frame is full. */
static enum font_status notes_take(struct filling *f, struct paragraph *p, int from, int end)
{
    const struct page_frame *frame = &f->template->frames[f->frame];
    int first_slot = f->page->slots_count - (end - from);
    for (int i = from; i < end; i++) {
        const struct line *line = &p->lines[i];
        double own;
        enum font_status status = line_notes(f, p, line, &own);
        if (status != FONT_OK)
            return status;
        if (own > 0)
            f->foot_px += own + (f->foot_px == 0 ? frame->foot_gap_px : 0);
        int first, behind;
        notes_of(p, line, &first, &behind);
        for (int k = first; k < behind; k++) {
            const struct note *n = &p->notes[k];
            if (n->kind == PAGE_NOTE_FOOT) {
                if (!array_reserve(&f->notes, &f->notes_capacity, f->notes_count + 1,
                                   sizeof *f->notes))
                    return font_fail(FONT_NO_MEMORY, "no memory for notes");
                f->notes[f->notes_count++] = n->paragraph;
            } else if (frame->margin_width > 0) {
                double beside = frame->margin_x - (frame->vertical ? frame->y : frame->x);
                double height, v = f->page->slots[first_slot + i - from].v;
                status = note_height(f, n->paragraph, frame->margin_width, &height);
                v = fmax(v, f->margin_v);
                if (status == FONT_OK)
                    status =
                        note_place(f, n->paragraph, beside, beside + frame->margin_width, v);
                if (status != FONT_OK)
                    return status;
                f->margin_v = v + height;
            }
        }
    }
    return FONT_OK;
}

static enum font_status feet_place(struct filling *f)
{
    const struct page_frame *frame = &f->template->frames[f->frame];
    double v = f->depth_px - f->foot_px + frame->foot_gap_px, height;
    enum font_status status = FONT_OK;
    for (int i = 0; i < f->notes_count && status == FONT_OK; i++) {
        status = note_height(f, f->notes[i], frame_measure(frame), &height);
        if (status == FONT_OK)
            status = note_place(f, f->notes[i], 0, frame_measure(frame), v);
        v += height;
    }
    f->notes_count = 0;
    return status;
}

/* The next place of a grid from v on, for paragraphs whose lines are as high as its
 * distances. */
static double grid_next(const struct page_frame *frame, const struct paragraph *p, double v)
{
    const double near = 1e-6;
    double lines = frame->grid_px > 0 ? p->leading_px / frame->grid_px : 0;
    if (!(lines > near) || fabs(lines - round(lines)) > near)
        return v;
    return ceil(v / frame->grid_px - near) * frame->grid_px;
}

/* As many lines of the paragraph, from the cursor's on, as may stand in the frame. *full: the
 * rest goes on. */
static enum font_status paragraph_place(struct filling *f, struct paragraph *p,
                                        struct cursor *cursor, bool *full)
{
    int from = cursor->line, fit = 0, stand = 0, limit = -1, here = 0;
    enum font_status status = FONT_OK;
    *full = !from && ((p->manner.begins_column && !f->top) ||
                      (p->manner.begins_page && !(f->top && f->first)));
    if (*full)
        return FONT_OK;
    status = set_analyse(f->t, p);
    if (status != FONT_OK)
        return status;
    if (!from && !f->top)
        f->v += p->manner.before_px;
    if (!from)
        f->v = grid_next(&f->template->frames[f->frame], p, f->v);
    for (;;) { /* until as many stand here as it was broken for: ever fewer */
        status = break_here(f, p, from, limit, &here);
        if (status == FONT_OK)
            status = lines_fit(f, p, from, &fit);
        if (status == FONT_OK)
            status = lines_keep(f, p, from, limit >= 0 && limit < fit ? limit : fit, &stand);
        if (status != FONT_OK)
            return status;
        if (stand == p->lines_count - from || stand >= here)
            break;
        limit = stand;
    }
    *full = stand < p->lines_count - from;
    if (!from)
        p->first_page = f->number;
    if (!stand)
        return FONT_OK;
    double end = f->slots[stand - 1].v + p->leading_px;
    if (!piece_add(f->page, p, from, from + stand, f->frame, f->slots))
        return font_fail(FONT_NO_MEMORY, "no memory for a page");
    status = notes_take(f, p, from, from + stand);
    f->v = end + (*full ? 0 : p->manner.after_px);
    f->top = false;
    cursor->line = from + stand;
    cursor->letter = *full ? p->lines[cursor->line].begin : 0;
    return status;
}

static enum font_status frame_fill(struct filling *f, struct cursor *cursor)
{
    const struct flow *flow = &f->t->flows[f->flow];
    enum font_status status = FONT_OK;
    f->v = f->foot_px = f->margin_v = 0;
    f->depth_px = depth_within(&f->template->frames[f->frame], f->page->depth_px);
    f->first = frame_next(f->template, f->flow, -1) == f->frame;
    f->top = true;
    for (bool full = false; status == FONT_OK && !full && cursor->at < flow->count;) {
        status = paragraph_place(f, flow->paragraphs[cursor->at], cursor, &full);
        if (!full && status == FONT_OK)
            *cursor = (struct cursor){.at = cursor->at + 1};
    }
    return status == FONT_OK ? feet_place(f) : status;
}

/* The template that the page's first paragraph asks for. */
static void page_ask(const struct page_text *t, struct page *page, const struct cursor *start)
{
    const struct flow *flow = &t->flows[0];
    const bool begins = start->at < flow->count && start->line == 0;
    const struct page_manner *m = begins ? &flow->paragraphs[start->at]->manner : NULL;
    page->template = m ? m->begins_page : 0;
    page->depth_px = m && m->begins_page ? m->page_depth_px : 0;
}

enum font_status flow_frames_fill(struct page_text *t, struct page *page, int number,
                                  struct cursor *ends)
{
    struct filling f = {.t = t, .page = page, .number = number};
    enum font_status status = FONT_OK;
    page_ask(t, page, &ends[0]);
    f.template = flow_template(t, number);
    page->pieces_count = page->slots_count = 0;
    for (int i = 0; i < f.template->frames_count && status == FONT_OK; i++) {
        f.frame = i;
        f.flow = f.template->frames[i].flow;
        status = frame_fill(&f, &ends[f.flow]);
    }
    free(f.notes);
    free(f.widths);
    free(f.slots);
    return status;
}
