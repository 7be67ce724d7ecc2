/* view_internal.h - what the files of a scrolled column share: loading passages (view_load.c),
 * where letters are (view_point.c), the rest (view.c). */
#ifndef LUTETIA_READER_VIEW_INTERNAL_H
#define LUTETIA_READER_VIEW_INTERNAL_H

#include "pages_internal.h"
#include "reader_view.h"

/* Loaded passages are paragraphs of one text, each passage a column of its own, so the text's
 * page k is passage begin + k. */
struct view_passage {
    int first, blocks;
    double before_px, text_px, after_px; /* as whole numbers; text_px: how high its lines are */
    bool known;                          /* else estimated */
    unsigned long version;
};

struct reader_view {
    const struct reader_document *document;
    struct reader_pages_setup setup;
    struct reader_pages *pages;
    struct view_passage *passages;
    int count;
    bool besides; /* figures stand beside text, or ink does */
    struct reader_obstacle *obstacles;
    struct made_passage making; /* what the next passage becomes */
    int begin, end;             /* passages that are loaded */
    struct made_passage *loaded;
    int loaded_capacity, paragraphs; /* paragraphs: of the text's flow */
    size_t *opened_at;               /* for each note: the byte where it was opened */
    int *opened;        /* for each note: the passage in which it is open, from 1; 0: closed */
    double *stage_more; /* for each block: room under its stage's picture */
    size_t *called;     /* for each note: the byte that calls it first; SIZE_MAX: none */
    /* The window's top. */
    int at;
    double at_px;
    /* What stays. */
    bool kept;
    size_t kept_byte;
    double kept_px;
    struct reader_shown *shown;
    int shown_count, shown_capacity;
    unsigned long versions;
    long set_count;
};

enum { VIEW_FRAME_PX = 1000000 };

/* view_load.c */
enum reader_status view_passages_make(struct reader_view *view);
/* How many blocks from this one on are a passage. */
int view_passage_length(const struct reader_view *view, int first);
static inline int view_wide_of(const struct reader_view *view, int block)
{
    return pages_wide_of(&view->setup, view->document, block);
}
/* Anew, where another grid puts others together: notes stay open. Nothing is loaded. */
enum reader_status view_passages_again(struct reader_view *view);
/* Whether passages depend on sizes and heights. */
bool view_bands(const struct reader_pages_setup *setup);
/* Passages from..to - 1 are loaded, and measured. What is not beside them may go. */
enum reader_status view_load(struct reader_view *view, int from, int to);
void view_unload(struct reader_view *view); /* all */
/* Heights are estimates again. */
void view_forget(struct reader_view *view);
/* A passage that is loaded is set anew, where it is. */
enum reader_status view_again(struct reader_view *view, int passage);
/* Other blocks stand beside figures than before: the line that is read stays. */
enum reader_status view_grouped(struct reader_view *view);
double view_full_px(const struct reader_view *view, int passage);

/* view_point.c */
/* The document's byte that is a paragraph's, or the next one that it has; -1: it has none. */
long view_byte_of(const struct made_passage *made, struct page_place place);
/* The first paragraph of a block; -1: it has none here. */
int view_paragraph_of(const struct made_passage *made, int block);
/* The note whose block, of the document's notes, it is; -1: none's. */
int view_note_of(const struct reader_view *view, int block);
/* The passage of a byte; of a closed note: where it is called. */
int view_passage_of(const struct reader_view *view, size_t byte);
/* From the passage's upper edge to the upper and the lower edge of the line that a byte is in.
 * The passage is loaded. */
enum reader_status view_line_of(struct reader_view *view, int passage, size_t byte,
                                double *y0_px, double *y1_px);
/* The first line of the passage whose upper edge is at or below y_px, and its first letter.
 * False: there is none. */
bool view_line_below(struct reader_view *view, int passage, double y_px, size_t *byte,
                     double *line_px);

#endif
