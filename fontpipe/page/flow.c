/* flow.c - paragraphs onto pages: see flow_internal.h.
 *
 * A page is filled from where the one before it ended, frame after frame. A paragraph is broken
 * for the widths of the slots that it is going to stand in; then it is seen how many of its
 * lines may stand in the frame (its keeps, the notes that its lines bring along), and where
 * fewer stand here than fit, it is broken again for the slots that it gets. */
#include "flow_internal.h"

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
    const struct covers *covers; /* of the frame; NULL: none */
    double blank_px;
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
    w->covers = NULL;
    w->v_end = depth_within(&w->template->frames[w->frame], w->depth_px);
    return true;
}

static bool walk_next(struct walk *w, double height, struct slot *slot)
{
    while (!slots_next(w->template, w->frame, w->covers, w->blank_px, &w->v, &w->part, w->v_end,
                       height, slot))
        if (!walk_on(w))
            return false;
    w->empty_pages = 0;
    return true;
}

/* ---- filling a frame ---- */

bool flow_uniform(const struct page_text *t, int flow, double *width)
{
    *width = 0;
    for (int k = 0; k < t->templates_count; k++) {
        if (t->templates[k].shapes_count || t->besides_count)
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
        double widths[2] = {fmax(narrow, flow_measure(p, &slot, true)),
                            fmax(narrow, flow_measure(p, &slot, false))};
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
                         .depth_px = f->page->depth_px,
                         .covers = &f->covers,
                         .blank_px = p->manner.left_px + p->manner.right_px};
        int count = 0;
        if (!array_reserve(&f->widths, &f->widths_capacity, wanted, sizeof *f->widths))
            return font_fail(FONT_NO_MEMORY, "no memory for a page");
        bool more = limit != 0 || walk_on(&w);
        *here = 0;
        while (more && count < wanted && (more = walk_next(&w, p->leading_px, &slot))) {
            f->widths[count] = fmax(narrow, flow_measure(p, &slot, from + count == 0));
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

/* How many lines from `from` on fit into the frame; their slots are in f->slots. */
static enum font_status lines_fit(struct filling *f, const struct paragraph *p, int from,
                                  int *fit)
{
    const struct page_frame *frame = &f->template->frames[f->frame];
    const double blank = p->manner.left_px + p->manner.right_px;
    double v = f->v, foot = f->foot_px, own;
    int part = 0;
    *fit = 0;
    for (int i = from; i < p->lines_count; i++) {
        struct slot slot;
        enum font_status status = flow_line_notes(f, p, &p->lines[i], &own);
        if (status != FONT_OK)
            return status;
        double after = foot + own + (own > 0 && foot == 0 ? frame->foot_gap_px : 0);
        bool room = slots_next(f->template, f->frame, &f->covers, blank, &v, &part,
                               f->depth_px - after, p->leading_px, &slot);
        if (own > 0 && covers_end(&f->covers) > f->depth_px - after + 1e-6)
            room = false; /* what stands beside lines stands on no note */
        /* A note that is too high for any column stands over its edge. */
        if (!room && f->top && *fit == 0 && own > 0)
            room = slots_next(f->template, f->frame, &f->covers, blank, &v, &part, f->depth_px,
                              p->leading_px, &slot);
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
        enum font_status status = flow_note_height(f, q, width, &own);
        if (status != FONT_OK)
            return status;
        if (q->manner.keep_with_next) {
            *height += own;
            continue;
        }
        int lines = q->manner.keep_together || q->lines_count < q->manner.orphans
                        ? q->lines_count
                        : q->manner.orphans;
        status = flow_besides_height(f, q, &own);
        if (status != FONT_OK)
            return status;
        *height += q->manner.before_px + fmax(own, lines * q->leading_px);
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

/* Where the paragraph begins, and what stands beside it there. *full: that has no room. */
static enum font_status paragraph_begin(struct filling *f, struct paragraph *p, bool *full)
{
    bool room = true;
    if (p->manner.below)
        f->v = fmax(f->v, covers_end(&f->covers));
    if (!f->top)
        f->v += p->manner.before_px;
    f->v = grid_next(&f->template->frames[f->frame], p, f->v);
    p->begins_frame = f->frame;
    p->begins_v = f->v;
    enum font_status status = flow_besides_place(f, p, &room);
    *full = !room;
    return status;
}

/* As many lines of the paragraph, from the cursor's on, as may stand in the frame; what stands
 * beside it is there. */
static enum font_status lines_place(struct filling *f, struct paragraph *p, int from,
                                    int *stand)
{
    int fit = 0, limit = -1, here = 0;
    for (;;) { /* until as many stand here as it was broken for: ever fewer */
        enum font_status status = break_here(f, p, from, limit, &here);
        if (status == FONT_OK)
            status = lines_fit(f, p, from, &fit);
        if (status == FONT_OK)
            status = lines_keep(f, p, from, limit >= 0 && limit < fit ? limit : fit, stand);
        if (status != FONT_OK || *stand == p->lines_count - from || *stand >= here)
            return status;
        limit = *stand;
    }
}

/* The same, with what stands beside it. *full: the rest goes on. */
static enum font_status paragraph_place(struct filling *f, struct paragraph *p,
                                        struct cursor *cursor, bool *full)
{
    const int from = cursor->line, pieces = f->page->pieces_count, slots = f->page->slots_count,
              covers = f->covers.count;
    int stand = 0;
    enum font_status status = FONT_OK;
    *full = !from && ((p->manner.begins_column && !f->top) ||
                      (p->manner.begins_page && !(f->top && f->first)));
    if (*full)
        return FONT_OK;
    status = set_analyse(f->t, p);
    if (status == FONT_OK && !from)
        status = paragraph_begin(f, p, full);
    const bool room = !*full;
    if (status == FONT_OK && room)
        status = lines_place(f, p, from, &stand);
    if (status != FONT_OK)
        return status;
    *full = !room || stand < p->lines_count - from;
    if (!from)
        p->first_page = f->number;
    if (!stand) { /* what stands beside it goes with it */
        f->page->pieces_count = pieces;
        f->page->slots_count = slots;
        f->covers.count = covers;
        return FONT_OK;
    }
    double end = f->slots[stand - 1].v + p->leading_px;
    if (!flow_piece_add(f->page, p, from, from + stand, f->frame, f->slots))
        return font_fail(FONT_NO_MEMORY, "no memory for a page");
    status = flow_notes_take(f, p, from, from + stand);
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
    f->covers.count = 0;
    f->depth_px = depth_within(&f->template->frames[f->frame], f->page->depth_px);
    f->first = frame_next(f->template, f->flow, -1) == f->frame;
    f->top = true;
    for (bool full = false; status == FONT_OK && !full && cursor->at < flow->count;) {
        status = paragraph_place(f, flow->paragraphs[cursor->at], cursor, &full);
        if (!full && status == FONT_OK)
            *cursor = (struct cursor){.at = cursor->at + 1};
    }
    return status == FONT_OK ? flow_feet_place(f) : status;
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
    free(f.covers.items);
    return status;
}
