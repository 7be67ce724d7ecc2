/* pages_internal.h - what makes pages of documents: styles and paragraphs (pages_style.c), tables (pages_table.c), the rest (pages.c). */
#ifndef LUTETIA_READER_PAGES_INTERNAL_H
#define LUTETIA_READER_PAGES_INTERNAL_H

#include "reader_internal.h"
#include "reader_pages.h"

#include <font_math.h>

/* Where letters stand. */
enum context {
    CONTEXT_TEXT,
    CONTEXT_HEAD_1,
    CONTEXT_HEAD_2,
    CONTEXT_HEAD_3,
    CONTEXT_NOTE,
    CONTEXT_CODE,
    CONTEXT_TABLE,
    CONTEXTS
};

enum {
    LOOKS = 32,
    FACES = 8
}; /* slanted, heavy, code, link, struck; the first three choose the face */

struct reader_pages {
    struct reader_pages_setup setup;
    struct page_text *text;
    struct font_face *math_face;
    struct font_math *math; /* opened at the first formula */
    bool math_missing;
    double math_scale, mono_scale; /* so that small letters are as high as the text's */
    char *fonts[FACES];
    struct font_face *faces[FACES]; /* to measure by; opened when they are needed */
    struct font_shaper *shapers[FACES];
    int styles[CONTEXTS][LOOKS], raised[CONTEXTS]; /* from 1; 0: not made yet */
    int formulas;
    int unknown_count;
    char unknown[48];
    const struct reader_document *document;
    uint8_t **pixels; /* of pictures */
    int pixels_count, pixels_capacity;
    bool *noted; /* notes that stand on a page already */
    bool behind_head;
};

/* A paragraph that is put together: letters, how they look, where notes are. */
struct line_span {
    int begin, end, note;
    unsigned look;
};
struct paragraph_text {
    char *text;
    int bytes, capacity;
    struct line_span *spans;
    int spans_count, spans_capacity;
};

/* pages_style.c. Each of those that return a status leaves one line in reader_error(). */
enum reader_status pages_failed(void); /* FAILED, with what fontpipe says */
enum reader_status pages_no_memory(void);
enum reader_status pages_fonts_open(struct reader_pages *p);
void pages_fonts_close(struct reader_pages *p);
double pages_size(const struct reader_pages *p, enum context context);
/* Letters behind those that are there. spans: of the block that they are bytes begin..end of; NULL: all look so. */
bool pages_text_add(struct paragraph_text *t, const char *text, int bytes, unsigned look);
bool pages_block_add(struct paragraph_text *t, const struct reader_block *block, int begin,
                     int end, unsigned look);
void pages_text_finish(struct paragraph_text *t);
/* How wide its letters are in a context. Errors: FAILED. */
enum reader_status pages_width(struct reader_pages *p, const struct paragraph_text *t,
                               enum context context, double *width);
/* Its letters' styles, and its notes' signs; the notes themselves are the caller's. display: formulas are as on lines of their own, no
 * wider than most_px. */
enum reader_status pages_styles_apply(struct reader_pages *p, int id,
                                      const struct paragraph_text *t, enum context context,
                                      bool display, double most_px);
/* The style of letters that look so. */
enum reader_status pages_style(struct reader_pages *p, enum context context, unsigned look,
                               int *style);
struct page_manner pages_manner(const struct reader_pages *p, enum context context);
double pages_column(const struct reader_pages *p); /* how wide a column is */
/* A paragraph of the text. Its notes are added by pages_notes_add(). */
enum reader_status pages_paragraph_add(struct reader_pages *p, const struct paragraph_text *t,
                                       enum context context, const struct page_manner *manner,
                                       bool display);

/* pages_picture.c: a picture that is found, as a box in a line of its own. *done: it was. */
enum reader_status pages_picture_add(struct reader_pages *p, const struct reader_block *block,
                                     const struct page_manner *manner, bool *done);

/* pages_table.c: the rows of one table, blocks[0..count). */
enum reader_status pages_table_add(struct reader_pages *p, const struct reader_block *blocks,
                                   int count);

#endif
