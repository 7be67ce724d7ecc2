/* reader_document.h - Markdown as a list of blocks: CommonMark and GitHub's extensions, notes,
 * formulas, fences that live. Knows nothing of type.
 *
 *     static const char text[] = "# In the marsh\n\nThe *water* is $x^2$ deep[^1].\n\n[^1]: By night.";
 *     struct reader_document *document;
 *     if (reader_document_create(&document) != READER_OK || reader_document_add(document, text, strlen(text)) != READER_OK)
 *         die(reader_error());
 *     for (int i = 0; i < document->blocks_count; i++)
 *         show(&document->blocks[i]);
 *     reader_document_destroy(document);
 *
 * cmark-gfm reads the Markdown. Beside it are known:
 *     $x^2$, $$x^2$$, ```math     formulas in TeX's notation: within a line, on lines of their
 *                                 own
 *     [^name], [^margin:name]     notes; what stands before a colon is the note's class
 *     ```lua live, ```c paris     fences that live: a script on a stage, and a program, which
 *                                 for now is shown
 *     ![Reeds](a.png "left 40%")  a picture that text flows around (struct reader_beside)
 *     <p align="center">, <img>   tags of HTML that mean what can be shown (tag.h); others are
 *                                 shown as they are written
 *     <a id="marsh"></a>          a label of what follows, or of the block that it is in
 *     [Reeds](reeds.md "include") alone in a paragraph: another file (reader_files.h)
 *     <a id="bibliography"></a>   that label: what follows is a bibliography
 *     [#](#marsh)                 a reference: a link to a label or a heading, whose sign # is
 *                                 replaced by a number or a title
 * A dollar begins a formula where no blank follows, and no letter, digit or backslash stands
 * before it; it ends one where no blank stands before it and no letter or digit follows, within
 * the same paragraph. In code there are none.
 *
 * A block knows the lines of the source that it comes from. Its bytes are the source's own,
 * never written by this library.
 *
 * Errors: functions that can fail return a status and leave one line in reader_error(). No text
 * is an error, but for one that is too large.
 *
 * Ownership: texts are copied. Threads: documents are independent of each other; messages
 * belong to the thread that failed. */
#ifndef LUTETIA_READER_DOCUMENT_H
#define LUTETIA_READER_DOCUMENT_H

#include <stdbool.h>
#include <stddef.h>

enum reader_status {
    READER_OK = 0,
    READER_BAD_ARGUMENT,
    READER_TOO_LARGE,
    READER_NO_LIBRARY, /* there is no cmark-gfm */
    READER_FAILED,     /* pages: what fontpipe says */
    READER_NO_MEMORY
};

/* Detail of this thread's last failure, one line, never NULL. Owns: the library; valid until
 * this thread's next failure. */
const char *reader_error(void);

enum {
    READER_BYTES_MAX = 32 << 20,
    READER_NOTES_MAX = 20000,
    READER_FORMULAS_MAX = 20000,
    READER_TARGETS_BYTES = 64 << 20, /* of its links' addresses, for each span again */
    READER_NOTE_BYTES = 128 << 10,
    READER_FORMULA_BYTES = 8192,  /* what is longer is no formula: it stands as it is written */
    READER_PASSAGE_BYTES = 32768, /* a longer paragraph is several, which go on */
    READER_LABELS_MAX = 20000,
    READER_LABEL_BYTES = 100,
    READER_LOST_MAX = 100, /* references that lead nowhere: how many are listed */
    READER_DEPTH_MAX = 12, /* deeper items and quotes are shown as deep as this */
    /* a stage's sides in pixels: usual ones, and the bounds of those that are said */
    READER_STAGE_WIDTH = 600,
    READER_STAGE_HEIGHT = 240,
    READER_STAGE_PROGRAM = 320, /* both sides of a program's */
    READER_STAGE_LEAST = 16,
    READER_STAGE_MOST = 1600
};

/* How letters look; bits. */
enum reader_look {
    READER_SLANTED = 1,
    READER_HEAVY = 2,
    READER_CODE = 4,
    READER_LINK = 8,
    READER_STRUCK = 16,
    READER_NOTE = 32,    /* a note's number; target: which note, as a number */
    READER_FORMULA = 64, /* its letters are a formula with the signs around it */
    READER_RAISED = 128,
    READER_LOWERED = 256,
    READER_IMAGE = 512 /* its letters are a picture's caption; target: its file */
};

/* How large a picture is meant to be: it is never larger than it is. */
struct reader_asked {
    short width_px, percent, height_px; /* percent: of the column; 0: nothing is asked */
};
static inline bool reader_asked_same(const struct reader_asked *a, const struct reader_asked *b)
{
    return a->width_px == b->width_px && a->percent == b->percent &&
           a->height_px == b->height_px;
}

struct reader_span {
    int begin, end; /* bytes of the block's text; in order, without gaps */
    unsigned look;
    int note;                  /* with NOTE: of the document's notes; else -1 */
    char *target;              /* with LINK: where it leads to; else NULL */
    struct reader_asked asked; /* with IMAGE */
};

enum reader_kind {
    READER_PARAGRAPH,
    READER_HEADING,    /* level */
    READER_CODE_BLOCK, /* info */
    READER_LIVE,       /* the same, of a fence that lives */
    READER_MATH,       /* text: the formula alone */
    READER_RULE,
    READER_ROW,    /* of a table: cells are parted by tabs */
    READER_HTML,   /* as it is written */
    READER_PICTURE /* text: its caption; target: its file */
};

enum { READER_COLUMNS_MAX = 16 };

/* Where a figure stands that text flows around. */
enum reader_side {
    READER_SIDE_USUAL, /* as whoever sets it says */
    READER_SIDE_LEFT,
    READER_SIDE_RIGHT,
    READER_SIDE_NONE /* it has its column for itself */
};
struct reader_beside {
    enum reader_side side;
    int percent; /* of the column that it takes at most, 10..90; 0: as usual */
    bool round;  /* lines follow the ellipse in its box */
    bool shape;  /* lines follow the picture's opaque pixels */
};
/* From words: left or right, beside them a share as 40%, and round or shape; or full. False:
 * they say something else, and *out is zeros. */
bool reader_beside_read(const char *words, struct reader_beside *out);
bool reader_beside_same(const struct reader_beside *a, const struct reader_beside *b);

/* Where lines stand in their column, where the document says so. */
enum reader_align {
    READER_ALIGN_USUAL,
    READER_ALIGN_LEFT,
    READER_ALIGN_CENTER,
    READER_ALIGN_RIGHT
};

struct reader_block {
    enum reader_kind kind;
    enum reader_align align;
    int level;         /* of a heading, from 1 */
    int items, quotes; /* how many lists and quotes it is in */
    char *marker;      /* "1." or a bullet, of an item's first block; else NULL */
    bool continues;    /* it goes on with a paragraph that a formula, or its length, has cut */
    bool unspaced;     /* and there was no blank between its first letter and the last one */
    char *text;        /* UTF-8, without control characters but line ends and tabs */
    int bytes;
    struct reader_span *spans;
    int spans_count;
    int source;                /* of the document's, from 0 */
    int first_line, last_line; /* of that, from 1 */
    char *info, *target;       /* NULL: none */
    char *include; /* the file that is meant to be in its place (reader_files.h); NULL: none */
    int stage_width, stage_height; /* of a fence that lives, its picture's; else 0 */
    bool stage_program;            /* of such a fence: a program in C/Paris, not a script */
    struct reader_beside beside;   /* of a picture */
    struct reader_asked asked;     /* the same */
    int table;                     /* of a row: which table, from 0 */
    bool head;                     /* of a row: the table's first */
    int columns;
    char aligns[READER_COLUMNS_MAX]; /* of a row: l, c, r */
    int number; /* of a figure, a formula or a table (its first row) that has a label; else 0 */
    size_t at;  /* of its text in the document's plain text, once that has been made */
};

struct reader_note {
    char *name, *class;            /* class: "" without one */
    int first_block, blocks_count; /* of note_blocks */
};

/* What a block is called in links. */
struct reader_label {
    char *name;
    int source, block; /* block: of the document's */
    int first;         /* the first block of all that are called so */
    bool heading;      /* by its words */
};

/* The same of a note, which is called so from within. */
struct reader_note_label {
    char *name;
    int source, note;
};

/* A reference that leads nowhere. */
struct reader_lost {
    char label[READER_LABEL_BYTES + 1];
    int source, line;
};

struct reader_document {
    struct reader_block *blocks, *note_blocks;
    int blocks_count, note_blocks_count;
    struct reader_note *notes; /* in the order of their numbers, which begin at 1 */
    int notes_count;
    int sources_count, tables_count;
    struct reader_label *labels; /* by their names, once reader_document_refer() was called */
    int labels_count;
    struct reader_note_label *note_labels; /* likewise */
    int note_labels_count;
    struct reader_lost *lost; /* the first of them */
    int lost_count;
    long lost_all;
    bool referred;
    bool references; /* some blocks say what others are called */
    char *plain;     /* NULL: reader_document_plain() has not made it */
    size_t plain_bytes;
    /* What arrays have room for. */
    int blocks_capacity, note_blocks_capacity, notes_capacity, labels_capacity,
        note_labels_capacity;
};

/* Without blocks. Errors: NO_MEMORY. Owns: the caller destroys *out. */
enum reader_status reader_document_create(struct reader_document **out);
/* Adds what a source says behind what is there; notes' names are each source's own, their
 * numbers go on. Errors: BAD_ARGUMENT (references have their names already), TOO_LARGE (more
 * than READER_BYTES_MAX, _NOTES_MAX, _NOTE_BYTES, _FORMULAS_MAX or _TARGETS_BYTES; or what
 * cmark-gfm would take hours for), with the line; NO_LIBRARY, NO_MEMORY; the document may then
 * have a part of it. */
enum reader_status reader_document_add(struct reader_document *document, const char *utf8,
                                       size_t bytes);
void reader_document_destroy(struct reader_document *document); /* NULL is fine */

/* Figures, formulas and tables that have labels get their numbers, and references the names of
 * what they lead to: once all sources are there. Before that the bibliography of each source is
 * sorted by its entries' letters and numbered: the list that has the label "bibliography", or
 * is the first under a heading that has it. Entries that links lead to have links back. Of a
 * reference whose label is not there stands what is written, and it is among those that are
 * lost. Errors: NO_MEMORY; the document may then have a part of it. */
enum reader_status reader_document_refer(struct reader_document *document);
/* The block that has a label, or the heading of that name (small letters, digits, hyphens for
 * blanks), in a source of the document's (-1: in any); a note's first one, if the label is in
 * the note. NULL: there is none, or reader_document_refer() was not called. Owns: the
 * document. */
const struct reader_block *reader_document_label(const struct reader_document *document,
                                                 const char *label, int source);

/* Which note a block of notes is of; -1: it is none of the document's notes'. */
int reader_document_note(const struct reader_document *document,
                         const struct reader_block *block);

/* Makes its plain text: what is read, block after block, then its notes, without what only says
 * how it looks. Places in it are what is searched, selected and annotated: they stay what they
 * are when a word becomes bold. A heading has its signs before it, code stands between fences,
 * so that reader_anchor.h finds the headings that a place stands under. Errors: NO_MEMORY,
 * TOO_LARGE. */
enum reader_status reader_document_plain(struct reader_document *document);
/* The block that a byte of the plain text is in, or the one before it; NULL: the document is
 * empty. Owns: the document. */
const struct reader_block *reader_document_block(const struct reader_document *document,
                                                 size_t byte);
/* The span of that byte; NULL: it is in none. */
const struct reader_span *reader_document_span(const struct reader_document *document,
                                               size_t byte);

/* The next place at or behind `from` (forward) or before it where the plain text has these
 * letters, whatever their case, and where there is one blank there may be any. False: there is
 * none. An empty text is nowhere. */
bool reader_document_search(const struct reader_document *document, const char *utf8,
                            size_t from, bool forward, size_t *begin, size_t *end);

#endif
