/* flow_notes.c - lines as they are placed, and what is placed with them: notes at the foot of
 * the frame and in its margin, and what stands beside the paragraph. See flow_internal.h. */
#include "flow_internal.h"

#include <math.h>

/* ---- lines ---- */

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

bool flow_piece_add(struct page *page, struct paragraph *p, int begin, int end, int frame,
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

/* ---- notes ---- */

/* How high a note is, set as wide as the frame. */
enum font_status flow_note_height(struct filling *f, struct paragraph *p, double width_px,
                                  double *height)
{
    struct slot slot = {.u1 = width_px};
    enum font_status status = set_analyse(f->t, p);
    double widths[2] = {fmax(1, flow_measure(p, &slot, true)),
                        fmax(1, flow_measure(p, &slot, false))};
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
enum font_status flow_line_notes(struct filling *f, const struct paragraph *p,
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
        enum font_status status = flow_note_height(f, n->paragraph, frame_measure(frame), &own);
        if (status != FONT_OK)
            return status;
        *height += own;
    }
    return FONT_OK;
}

/* How high what stands beside a paragraph is, one below the other. */
enum font_status flow_besides_height(struct filling *f, const struct paragraph *p,
                                     double *height)
{
    enum font_status status = FONT_OK;
    double own;
    *height = 0;
    for (int i = 0; i < p->notes_count && p->notes[i].beside && status == FONT_OK; i++) {
        status = flow_note_height(f, p->notes[i].paragraph, p->notes[i].beside->width_px, &own);
        *height += own;
    }
    return status;
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
    return flow_piece_add(f->page, p, 0, p->lines_count, f->frame, f->slots)
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for a page");
}

/* The notes of lines that were just placed: those of the margin at once, those of the foot when
 * the frame is full. */
enum font_status flow_notes_take(struct filling *f, struct paragraph *p, int from, int end)
{
    const struct page_frame *frame = &f->template->frames[f->frame];
    int first_slot = f->page->slots_count - (end - from);
    for (int i = from; i < end; i++) {
        const struct line *line = &p->lines[i];
        double own;
        enum font_status status = flow_line_notes(f, p, line, &own);
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
                status = flow_note_height(f, n->paragraph, frame->margin_width, &height);
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

enum font_status flow_feet_place(struct filling *f)
{
    const struct page_frame *frame = &f->template->frames[f->frame];
    double v = f->depth_px - f->foot_px + frame->foot_gap_px, height;
    enum font_status status = FONT_OK;
    for (int i = 0; i < f->notes_count && status == FONT_OK; i++) {
        status = flow_note_height(f, f->notes[i], frame_measure(frame), &height);
        if (status == FONT_OK)
            status = note_place(f, f->notes[i], 0, frame_measure(frame), v);
        v += height;
    }
    f->notes_count = 0;
    return status;
}

/* What stands beside the paragraph, from f->v on. *room: it ends within the frame. */
enum font_status flow_besides_place(struct filling *f, struct paragraph *p, bool *room)
{
    const double measure = frame_measure(&f->template->frames[f->frame]),
                 end = f->depth_px - f->foot_px;
    enum font_status status = FONT_OK;
    *room = true;
    for (int i = 0; i < p->notes_count && p->notes[i].beside && *room; i++) {
        const struct page_beside *b = p->notes[i].beside;
        struct paragraph *own = p->notes[i].paragraph;
        double height,
            v = covers_room(&f->covers, b->side, f->v, b->width_px, measure, b->least_px);
        const double u = b->side == PAGE_SIDE_LEFT ? 0 : measure - b->width_px;
        status = flow_note_height(f, own, b->width_px, &height);
        *room = f->top || v + height <= end + 1e-6;
        if (status == FONT_OK && *room)
            status = note_place(f, own, u, u + b->width_px, v);
        if (status == FONT_OK && *room &&
            !covers_beside_add(&f->covers, b, &own->manner, measure, v, height))
            status = font_fail(FONT_NO_MEMORY, "no memory for a page");
        if (status != FONT_OK)
            return status;
    }
    return covers_obstacles_add(&f->covers, p, f->v)
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for a page");
}
