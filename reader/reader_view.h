/* reader_view.h - a document as one column that is scrolled: set where it is looked at,
 * whatever stands above.
 *
 *     struct reader_view *view;
 *     reader_view_create(document, &setup, 800, &view);
 *     reader_view_scroll(view, 120);
 *     const struct reader_shown *shown;
 *     int count;
 *     reader_view_look(view, &shown, &count);
 *     for (int i = 0; i < count; i++) {
 *         reader_view_layout(view, shown[i].passage, &layout);
 *         draw(&layout, shown[i].y_px);
 *         font_layout_finish(&layout);
 *     }
 *     reader_view_destroy(view);
 *
 * The column consists of passages: a paragraph, a heading, a table, a block of code. Each is
 * set by itself, so the middle of a long document is there as soon as its beginning. Heights of
 * passages that nobody has looked at are estimated from their letters; the view's place is a
 * passage and pixels below its top, which no estimate moves.
 *
 * What is being read is the first line that is seen whole. When the width, the size or the font
 * changes, that line, or the one that its first letter is in then, stays where it is; it is the
 * same letter however often they change, until the view is scrolled.
 *
 * Notes are closed until they are opened; then they stand behind the paragraph that calls them,
 * or in the margin where there is one. Notes of the class `margin` are always seen where there
 * is one.
 *
 * Places are bytes of the document's plain text (reader_document_plain()), which must be there.
 * Pixels are from the window's upper left.
 *
 * Errors: functions that can fail return a status and leave one line in reader_error().
 *
 * Ownership: the document is borrowed as long as the view. Threads: a view belongs to one
 * thread at a time. */
#ifndef LUTETIA_READER_VIEW_H
#define LUTETIA_READER_VIEW_H

#include "reader_pages.h"

struct reader_view;

/* setup: columns and page numbers are not looked at; its grid, if it has one, says where text,
 * notes and what is wide stand (reader_template.h). Where columns of text stand beside each
 * other, what goes through all of them is one passage, no higher than is seen at once;
 * width_px and height_px: of the window. Errors: as reader_pages_make(). Owns: the caller
 * destroys *out. */
enum reader_status reader_view_create(const struct reader_document *document,
                                      const struct reader_pages_setup *setup,
                                      struct reader_view **out);
void reader_view_destroy(struct reader_view *view); /* NULL is fine */
/* Another width, height, size, font or colour: the line that is being read stays. Errors: as
 * reader_view_create(); the view is then as it was. */
enum reader_status reader_view_set(struct reader_view *view,
                                   const struct reader_pages_setup *setup);

/* A passage in the window. */
struct reader_shown {
    int passage;
    double y_px,
        height_px;  /* of its upper edge; whole numbers where the view was scrolled by such */
    double text_px; /* from there to its layout's */
    unsigned long version; /* another one where it is set otherwise */
    size_t begin, end;     /* its bytes, without those of its notes */
};
/* What is seen, from above to below. Owns: the view; valid until it is called again. */
enum reader_status reader_view_look(struct reader_view *view, const struct reader_shown **shown,
                                    int *count);
/* A passage that is seen, as page_layout() has it. Owns: the caller finishes *out. */
enum reader_status reader_view_layout(struct reader_view *view, int passage,
                                      struct font_layout *out);

/* Down the text, or up: as far as it goes. */
void reader_view_scroll(struct reader_view *view, double by_px);
/* So that the line of a byte is so far below the window's top. A note's byte is that of the
 * place that calls it, unless the note is open. */
enum reader_status reader_view_go(struct reader_view *view, size_t byte, double from_top_px);
/* To a part of all, 0..1, by what is known of heights. */
void reader_view_go_part(struct reader_view *view, double part);
/* The height of what is above the window, and of all, partly estimated. */
void reader_view_extent(struct reader_view *view, double *above_px, double *all_px);
/* The first letter of the line that is being read. */
enum reader_status reader_view_top(struct reader_view *view, size_t *byte);

/* The letter nearest to a point of the window. *inside: the point is on it. False: nothing is
 * seen. */
bool reader_view_hit(struct reader_view *view, double x, double y, size_t *byte, bool *inside);
/* The boxes of bytes begin..end that are seen, and the passage of each; at most `most` are
 * written. Returns how many there are. */
struct reader_box {
    int passage;
    double x, y, width, height;
};
int reader_view_boxes(struct reader_view *view, size_t begin, size_t end,
                      struct reader_box *boxes, int most);

/* A script that lives: which of the document's blocks it is, and where its picture is. */
struct reader_stage {
    int block;
    double x, y, width, height;
    double right; /* where its column ends */
};
/* One of those of a passage that is seen, by its number from 0; false: it has no more, or the
 * setup has no room for them. */
bool reader_view_stage(struct reader_view *view, const struct reader_shown *shown, int which,
                       struct reader_stage *out);

/* So much room more under the picture of a block's stage, for its controls: the line that is
 * being read stays. Errors: BAD_ARGUMENT (no such block, less than nothing), NO_MEMORY. */
enum reader_status reader_view_stage_room(struct reader_view *view, int block, double more_px);

/* Text flows around these, in place of those before: the line that is being read stays. They
 * are copied. Errors: as reader_view_look(). */
enum reader_status reader_view_around(struct reader_view *view,
                                      const struct reader_obstacle *obstacles, int count);
/* From where obstacles of a block on a side are counted: a point of the window. False: the
 * block is not seen. */
bool reader_view_begins(struct reader_view *view, int block, enum reader_around side, double *x,
                        double *y);

/* Opens a note where the byte calls it, or closes it. Errors: BAD_ARGUMENT (no such note),
 * NO_MEMORY. */
enum reader_status reader_view_note(struct reader_view *view, int note, size_t byte);
bool reader_view_note_open(const struct reader_view *view, int note);
/* The passage in which it is open; -1: it is closed. */
int reader_view_note_passage(const struct reader_view *view, int note);

/* A caret before a byte, or behind the one before it: a line's height, no width. False: it is
 * not seen. */
bool reader_view_caret(struct reader_view *view, size_t byte, bool before,
                       struct reader_box *out);
/* The place for a caret that is nearest to a point. *before: as above. False: nothing is
 * seen. */
bool reader_view_caret_at(struct reader_view *view, double x, double y, size_t *byte,
                          bool *before);

/* One block of the document, or behind those one of its notes, has been changed in place: bytes
 * at..at + removed of the plain text have become `inserted` others. Its passage alone is set
 * anew, or those that show the note. Errors: as reader_view_look(). */
enum reader_status reader_view_edited(struct reader_view *view, int block, size_t at,
                                      size_t removed, size_t inserted);
/* Notes that are open in a view of a document that another one has come for are open, where as
 * many are called. */
enum reader_status reader_view_as(struct reader_view *view, const struct reader_view *before);

/* How often passages were set since it was made: what "only what is seen" costs. */
long reader_view_set_count(const struct reader_view *view);

#endif
