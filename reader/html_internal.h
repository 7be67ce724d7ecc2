/* html_internal.h - what writes HTML: blocks and lists (html.c), letters (html_text.c,
 * html_letters.c), what readers left (html_remarks.c), formulas and pictures
 * (html_picture.c). */
#ifndef LUTETIA_READER_HTML_INTERNAL_H
#define LUTETIA_READER_HTML_INTERNAL_H

#include "reader_around.h"
#include "reader_html.h"
#include "reader_internal.h"

#include <font_math.h>

/* What begins or ends at a byte of the plain text. */
enum html_event_kind { HTML_INK, HTML_MARK, HTML_TYPED, HTML_MARK_END, HTML_TYPED_END };
struct html_event {
    size_t at;
    enum html_event_kind kind;
    int remark;
    int marks, typed; /* how many highlights and typed notes are open behind it */
};

struct html {
    const struct reader_document *document;
    const struct reader_html_setup *setup;
    FILE *f;
    enum reader_status status;
    /* what readers left */
    struct html_event *events; /* in the order of the text */
    int events_count, event;   /* event: the next one */
    int marks, typed;          /* that are open */
    int *waiting;              /* typed notes whose asides come behind this block */
    int waiting_count, waiting_capacity;
    struct reader_obstacle *obstacles; /* ink that text flows around */
    int obstacles_count;
    /* notes of the document */
    bool *noted; /* those that stand in the margin already */
    bool *called;
    struct html_nest { /* lists and quotes that are open */
        bool numbered[READER_DEPTH_MAX + 1];
        int count, quotes;
    } nest;
    /* formulas */
    struct font_face *math_face;
    struct font_math *math;
    bool math_missing;
    size_t pictured_bytes; /* of formulas */
};

/* html_letters.c */
/* Letters, as HTML has them: nothing in them is a tag. */
void html_put(struct html *h, const char *text, size_t bytes);
void html_puts(struct html *h, const char *text);

/* html_text.c */
/* Bytes from..to of a block, as they look, with what readers left there. */
void html_block_text(struct html *h, const struct reader_block *block, int from, int to);

/* html_remarks.c */
enum reader_status html_remarks_begin(struct html *h);
/* Goes to what is of this block: behind the end of the one before it in the plain text. */
void html_events_begin(struct html *h, const struct reader_block *block);
/* What comes up to a byte of the block, as far as it has not been written yet. */
void html_events_put(struct html *h, const struct reader_block *block, int to);
/* Where the next begins within the block, at most `most`. */
int html_event_next(const struct html *h, const struct reader_block *block, int most);
/* The asides of notes that wait. */
void html_asides_put(struct html *h);
/* What hangs on words that are gone. */
void html_orphans_put(struct html *h);

/* A stroke's drawing, from the place of what it is in. */
void html_ink_put(struct html *h, const struct reader_remark *r);

/* html_around.c: ink that text flows around. Errors: NO_MEMORY. */
enum reader_status html_around_begin(struct html *h);
/* That of a paragraph, before its first letter. */
void html_around_put(struct html *h, const struct reader_block *block);

/* html_picture.c */
/* A formula, dollars and all; false: it stands as it is written. */
bool html_formula_put(struct html *h, const char *tex, int bytes, bool display);
bool html_picture_put(struct html *h, const struct reader_block *block);
/* A picture among letters; false: it is not found. */
bool html_image_put(struct html *h, const struct reader_block *block,
                    const struct reader_span *span);
/* A figure's tag but for its end, if text flows around it. False: nothing was written. */
bool html_beside_put(struct html *h, const struct reader_block *block);

/* Such figures: picture and caption are two boxes, so that lines follow the picture's shape. In
 * a narrow window they have the column. */
#define HTML_BESIDE_STYLE                                                                      \
    "figure.left,figure.right{display:contents}\n"                                             \
    ".left>img,.left>figcaption{float:left;clear:left;margin:.3em 1em .3em 0}\n"               \
    ".right>img,.right>figcaption{float:right;clear:right;margin:.3em 0 .3em 1em}\n"           \
    "figure.left>img,figure.right>img{max-width:var(--w)}\n"                                   \
    ".left>figcaption,.right>figcaption{width:var(--w);text-align:center}\n"                   \
    ".left~:is(h1,h2,pre,table,hr,.math),.left~figure:not(.left,.right){clear:left}\n"         \
    ".right~:is(h1,h2,pre,table,hr,.math),.right~figure:not(.left,.right){clear:both}\n"       \
    "@media(max-width:28rem){.left>*,.right>*{float:none!important;display:block;"             \
    "margin:.3em auto!important;max-width:100%!important;width:auto!important;"                \
    "shape-outside:none!important}}\n"
void html_picture_finish(struct html *h);

#endif
