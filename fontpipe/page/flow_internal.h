/* flow_internal.h - what files that place paragraphs in a frame share: lines (flow.c), and what
 * comes with them (flow_notes.c). */
#ifndef LUTETIA_FLOW_INTERNAL_H
#define LUTETIA_FLOW_INTERNAL_H

#include "page_internal.h"

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
    struct covers covers; /* what stands beside lines of the frame */
};

static inline double flow_measure(const struct paragraph *p, const struct slot *s, bool first)
{
    return s->u1 - s->u0 - p->manner.left_px - p->manner.right_px -
           (first ? p->manner.indent_px : 0);
}

/* flow_notes.c: lines begin..end of a paragraph, each in its slot. False: no memory. */
bool flow_piece_add(struct page *page, struct paragraph *p, int begin, int end, int frame,
                    const struct slot *slots);

/* How high a note is, set so wide. */
enum font_status flow_note_height(struct filling *f, struct paragraph *p, double width_px,
                                  double *height);
/* What a line's notes take at the foot. */
enum font_status flow_line_notes(struct filling *f, const struct paragraph *p,
                                 const struct line *line, double *height);
/* The notes of lines that were just placed: those of the margin at once, those of the foot when
 * the frame is full. */
enum font_status flow_notes_take(struct filling *f, struct paragraph *p, int from, int end);
enum font_status flow_feet_place(struct filling *f);
/* How high what stands beside a paragraph is, one below the other. */
enum font_status flow_besides_height(struct filling *f, const struct paragraph *p,
                                     double *height);
/* What stands beside the paragraph, from f->v on. *room: it ends within the frame. */
enum font_status flow_besides_place(struct filling *f, struct paragraph *p, bool *room);

#endif
