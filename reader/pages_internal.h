/* pages_internal.h - what makes pages of documents: styles and paragraphs (pages_style.c),
 * tables (pages_table.c), code (pages_code.c), the rest (pages.c). */
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

/* What a passage has become: paragraphs of the text, and which bytes of the document their
 * letters are. */
struct made_paragraph {
    int id, note; /* note: of the document's, or -1 */
    int block;    /* the document's that it is of */
    bool beside;  /* it stands in a margin, or beside lines: not in the flow */
    bool figure;  /* beside lines */
    struct line_span *spans;
    int spans_count;
};
struct made_passage {
    struct made_paragraph *paragraphs;
    int count, capacity;
    double before_px, after_px; /* what is to be left blank around it */
    int first;                  /* paragraph of the flow; notes may stand before it here */
    struct page_manner manner;  /* of it */
};

/* A picture at the size that it has on pages, as a style that shows it. */
struct pictured {
    int source, style, width, height;
    char *target;
    double most_px, high_px; /* that it had room in */
    struct reader_asked asked;
    uint8_t *pixels, *alpha; /* alpha: NULL: all of it is opaque */
};

enum {
    PAGES_WAITING_MAX = 8,
    LOOKS = 128,
    FACES = 8
}; /* slanted, heavy, code, link, struck, raised, lowered; the first three choose the face */
/* Code is set smaller by so many steps at most, of so much of its size. */
enum { PAGES_CODE_STEPS = 8, PAGES_CODE_PERCENT = 5 };

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
    int code_styles[PAGES_CODE_STEPS + 1][LOOKS];  /* of smaller code */
    int code_steps; /* by how many the code that is set now is smaller; 0: it is not */
    int insets;     /* formulas and pictures that were ever set: each is a style */
    int unknown_count;
    char unknown[48];
    const struct reader_document *document;
    struct pictured *pictures; /* that were found */
    int pictures_count, pictures_capacity;
    const struct reader_block *waiting[PAGES_WAITING_MAX]; /* figures beside what follows */
    int waiting_count;
    /* What comes beside a paragraph of the text that was just put there (pages_beside.c). */
    enum reader_status (*placed)(struct reader_pages *p, int id);
    bool below;                        /* what is set stands below figures */
    int obstacled;                     /* the block whose obstacles are there */
    struct reader_obstacle *obstacles; /* that were found for pages */
    bool *noted;                       /* notes that stand on a page already */
    bool behind_head;
    /* A column that is scrolled: passages are made one by one. */
    struct made_passage *made; /* NULL: pages */
    int at;                    /* of the flow's paragraphs, the next one */
    const double *stage_more;  /* of each block: room under its picture; NULL: none */
    const int *opened; /* notes that are seen: those with the passage's number, from 1 */
    int passage;       /* that number */
    int block;         /* that paragraphs are of */
    /* On a grid: where passages of a kind stand, and by which template; -1: as text. */
    int wide, wide_templates[READER_WIDES], templates_count;
    /* Pages with what readers left (pages_remarks.c). */
    struct made_passage kept; /* all paragraphs */
    struct pages_left *left;  /* NULL: nothing is asked for */
};

/* A paragraph that is put together: letters, how they look, where notes are. */
struct line_span {
    int begin, end, note;
    unsigned look;
    /* byte of the document's plain text; -1: nothing of its own, as an item's number */
    long at;
    /* of a picture: its file, until its style is made, and whose */
    const char *image;
    struct reader_asked asked;
    int source;
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
/* The same of letters that look so. */
double pages_size_of(const struct reader_pages *p, enum context context, unsigned look);
/* Which of the faces they are of, and that it is open. */
unsigned pages_face_of(unsigned look);
enum reader_status pages_face(struct reader_pages *p, int face);
/* How high an x is, of the em; half an em where there is none. */
double pages_x_height(struct font_face *face);
double pages_code_scale(int steps); /* how large code is then, of its usual size */
/* Letters behind those that are there. spans: of the block that they are bytes begin..end of;
 * NULL: all look so. */
bool pages_text_add(struct paragraph_text *t, const char *text, int bytes, unsigned look);
bool pages_block_add(struct paragraph_text *t, const struct reader_block *block, int begin,
                     int end, unsigned look);
void pages_text_finish(struct paragraph_text *t);
/* pages_letters.c: how wide its letters are in a context. Errors: FAILED. */
enum reader_status pages_width(struct reader_pages *p, const struct paragraph_text *t,
                               enum context context, double *width);
/* The picture that a span is, where so much is free; *out NULL: its caption is shown. */
enum reader_status pages_image(struct reader_pages *p, const struct line_span *s,
                               enum context context, double most_px,
                               const struct pictured **out);
/* Its letters' styles, and its notes' signs; the notes themselves are the caller's. display:
 * formulas are as on lines of their own, no wider than most_px. */
enum reader_status pages_styles_apply(struct reader_pages *p, int id,
                                      const struct paragraph_text *t, enum context context,
                                      bool display, double most_px);
/* The style of letters that look so. */
enum reader_status pages_style(struct reader_pages *p, enum context context, unsigned look,
                               int *style);
struct page_manner pages_manner(const struct reader_pages *p, enum context context);
/* Its lines stand as the document says, if it does. */
void pages_align(const struct reader_block *block, struct page_manner *manner);
/* Lists and quotes are moved in. */
void pages_nest(const struct reader_pages *p, const struct reader_block *block,
                struct page_manner *manner);
double pages_column(const struct reader_pages *p); /* how wide a column is */
double pages_notes(const struct reader_pages *p);  /* and its margin for notes; 0: none */
/* pages_paragraph.c: a paragraph of the text as it is. Where passages are made, keep it by
 * pages_made_keep(). */
enum reader_status pages_paragraph_put(struct reader_pages *p, const char *text, size_t bytes,
                                       int style, const struct page_manner *manner, int *id);
/* Keeps which bytes of the document a paragraph's letters are, where passages are made; takes
 * the spans. */
enum reader_status pages_made_keep(struct reader_pages *p, int id, int note,
                                   struct paragraph_text *t);
/* A paragraph of its own for what is shown in place of the text's letters: a picture, a stage.
 * plain: the paragraph's style; style: what is shown, by page_inset_add(). */
enum reader_status pages_inset_put(struct reader_pages *p, const char *text, int plain,
                                   int style, const struct page_manner *manner);
/* A paragraph of the text, and its notes. Takes the spans where passages are made. */
enum reader_status pages_paragraph_add(struct reader_pages *p, struct paragraph_text *t,
                                       enum context context, const struct page_manner *manner,
                                       bool display);

/* pages.c: all but the blocks; the document is borrowed as long as there are passages to be
 * made. frame_px: how high a column is. made: of a column that is scrolled: what the next
 * passage becomes; NULL: pages. */
enum reader_status pages_begin(const struct reader_document *document,
                               const struct reader_pages_setup *setup, double frame_px,
                               struct made_passage *made, struct reader_pages **out);
/* Another width: the columns of paragraphs that there are, too. */
enum reader_status pages_template_set(struct reader_pages *p, double frame_px);
/* How many blocks from this one on are one passage: a table's rows, or one. */
int pages_passage_length(const struct reader_document *document, int first);
/* Where it stands on a grid: a reader_wide, or -1, as text. */
int pages_wide_of(const struct reader_pages_setup *setup,
                  const struct reader_document *document, int block);
/* Its paragraphs. p->behind_head is for the next one. */
enum reader_status pages_passage_add(struct reader_pages *p, int first, int count);

/* pages_notes.c. The notes that the letters call, at a byte of the paragraph; -1: each
 * behind its letters. */
enum reader_status pages_notes_add(struct reader_pages *p, int id,
                                   const struct paragraph_text *t, int byte);

/* pages_beside.c. The block whose text flows around a figure, and how wide the figure is at
 * most; -1: it has its column for itself. */
int pages_beside_host(const struct reader_pages_setup *setup,
                      const struct reader_document *document, int block, double *width_px);
/* How many blocks, from this one on, might stand beside a figure that it is: to be set
 * together. */
int pages_beside_length(const struct reader_pages_setup *setup,
                        const struct reader_document *document, int block);
/* The same of obstacles of a block that end so far below its upper edge. */
int pages_around_length(const struct reader_pages_setup *setup,
                        const struct reader_document *document, int block, double need_px);
/* Where obstacles of a block end, from its upper edge; 0: it has none. */
double pages_around_end(const struct reader_pages_setup *setup, int block);
/* From where ink is counted on its side: from the frame's left edge. */
double pages_around_x(const struct reader_pages *p, enum reader_around side);
/* A figure that text flows around waits for the paragraph; *waits: it does. */
enum reader_status pages_beside_wait(struct reader_pages *p, const struct reader_block *block,
                                     bool *waits);
/* Those that wait stand beside the paragraph, and its block's obstacles, if it is its first. */
enum reader_status pages_besides_put(struct reader_pages *p, int id);

/* pages_picture.c: a picture of that source at the size that it has where so much is free;
 * *out NULL: it is not found. Owns: the pages. */
enum reader_status pages_pictured(struct reader_pages *p, int source, const char *target,
                                  struct reader_asked asked, double most_px,
                                  const struct pictured **out);
void pages_pictures_free(struct reader_pages *p);
/* pages_figure.c: what a figure's caption says. shown: its picture is. False: no memory. */
bool pages_caption(struct paragraph_text *t, const struct reader_block *block, bool shown);
/* A picture that is found, as a box in a line of its own. *done: it was. */
enum reader_status pages_picture_add(struct reader_pages *p, const struct reader_block *block,
                                     const struct page_manner *manner, bool *done);

/* pages_code.c: lines of code, no wider than their column where they need not be much smaller
 * for that. */
enum reader_status pages_code_fits(struct reader_pages *p, const struct reader_block *block,
                                   double most_px, bool *fits); /* as large as it is */
enum reader_status pages_code_add(struct reader_pages *p, const struct reader_block *block);

/* pages_pieces.c: a text as paragraphs, parted where pictures in it are high. put: may take
 * the piece's spans. */
struct pages_piece_place {
    bool first, last, picture; /* picture: it is one */
};
typedef enum reader_status (*pages_piece_put)(struct reader_pages *p, void *user,
                                              struct paragraph_text *piece,
                                              const struct pages_piece_place *place);
enum reader_status pages_pieces(struct reader_pages *p, const struct paragraph_text *t,
                                enum context context, double most_px, pages_piece_put put,
                                void *user);

/* pages_stage.c: room for the picture of a script that lives, and for the strip under it. */
enum reader_status pages_stage_style(struct reader_pages *p, const struct reader_block *block,
                                     double most_px, int *style, double *width);
enum reader_status pages_stage_add(struct reader_pages *p, const struct reader_block *block,
                                   const struct page_manner *manner);

/* pages_remarks.c: the notes that readers typed, once all paragraphs are there. */
enum reader_status pages_left_make(struct reader_pages *p);
void pages_left_destroy(struct pages_left *left); /* NULL is fine */

/* pages_table.c: the rows of one table, blocks[0..count). */
enum reader_status pages_table_add(struct reader_pages *p, const struct reader_block *blocks,
                                   int count);

#endif
