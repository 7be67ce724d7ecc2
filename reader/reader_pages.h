/* reader_pages.h - a document as pages of type: headings, lists, notes at the foot or in the
 * margin, code, tables, formulas.
 *
 *     struct reader_pages_setup setup = reader_pages_setup_default();
 *     struct reader_pages *pages;
 *     if (reader_pages_make(document, &setup, &pages) != READER_OK)
 *         die(reader_error());
 *     page_layout(reader_pages_text(pages), 0, &layout);       // as page.h has it
 *     reader_pages_destroy(pages);
 *
 * Formulas and code are set in fonts of their own, as large as makes their small letters as
 * high as the text's. A formula on a line of its own that is wider than its column is set
 * smaller. A table whose columns have no room beside each other is set row by row, each cell
 * behind its column's name. Pictures that are found are shown no wider than the column, and
 * their captions under them; others, and all where the font of code has no full block (U+2588),
 * are told by their captions and files. Text flows around a picture that says so, or that the
 * setup says it of, where a line beside it has room for a few words; what is no text, and
 * headings of the first two levels, stand below it. A script that lives is set as its code, and
 * over it is room for its picture where somebody will draw it (stage_strip_px).
 *
 * Errors: functions that can fail return a status and leave one line in reader_error().
 *
 * Ownership: documents and setups are borrowed for the call. Threads: pages belong to one
 * thread at a time. */
#ifndef LUTETIA_READER_PAGES_H
#define LUTETIA_READER_PAGES_H

#include "reader_around.h"

#include <drawing.h>
#include <page.h>

#include <stdint.h>

struct reader_pages;

/* A picture's pixels: red, green, blue, rows without gaps. */
struct reader_picture {
    int width_px, height_px;
    uint8_t *rgb;   /* from malloc() */
    uint8_t *alpha; /* how opaque each is, from malloc(); NULL: all are */
};

/* Where things go in a column that is scrolled: in the window's pixels. */
enum { READER_TEXTS_MAX = 4, READER_GRID_COLUMNS_MAX = 16 };
enum reader_wide {
    READER_WIDE_HEADINGS, /* of the first two levels */
    READER_WIDE_FIGURES,
    READER_WIDE_DEMONSTRATIONS,
    READER_WIDE_TABLES,
    READER_WIDES
};
struct reader_region {
    double x, width;
    double notes_x, notes_width; /* of the margin for its notes; width 0: they stand in place */
};
struct reader_grid {
    int texts; /* columns of text beside each other; 0: no grid, margins say where text is */
    struct reader_region text[READER_TEXTS_MAX], wide[READER_WIDES];
    /* the columns that are seen, to be shown and dragged */
    struct reader_grid_column {
        int number; /* of the template's, from 0 */
        double x, width;
    } columns[READER_GRID_COLUMNS_MAX];
    int columns_count;
};

/* Sizes of letters that are not the text's. */
enum reader_size {
    READER_SIZE_HEADING_1,
    READER_SIZE_HEADING_2,
    READER_SIZE_HEADING_3,
    READER_SIZE_NOTE,
    READER_SIZE_CODE,
    READER_SIZE_TABLE,
    READER_SIZES
};

/* Of the text's, where nobody has asked for another one. */
double reader_size_usual(enum reader_size size);

struct reader_pages_setup {
    const char *font, *mono; /* names as font_face_open() has them */
    const char *math;        /* NULL: the first of font_math_fonts that there is */
    const char *language;    /* NULL: English */
    double size_px;
    double leading; /* of the size */
    double width_px, height_px, margin_px, gap_px;
    /* the width of a margin for notes of the class `margin`; 0: they stand at the foot */
    double notes_px;
    int columns;
    /* of a column that is scrolled, in place of those above; of pages, their columns of text
     * and where their notes stand, margin_px above and below them */
    struct reader_grid grid;
    double sizes[READER_SIZES];  /* of size_px; 0: as usual */
    struct reader_beside beside; /* of figures that do not say where they stand; usual: no */
    enum font_align align;
    bool hyphenate;
    /* more than 0: over scripts that live there is room for their pictures, and so much under
     * each of them */
    double stage_strip_px;
    bool running; /* page numbers, and the chapter over each page */
    double ink_link[3],
        ink_struck[3]; /* sRGB, 0..1: of links and notes' signs, and of what is struck out */
    /* Finds the picture that stands alone in a paragraph of source number `source` as `target`;
     * false: it is told by its caption and its file. NULL: none is found. The pages own what it
     * gives. */
    bool (*picture)(void *user, int source, const char *target, struct reader_picture *out);
    void *picture_user;
    /* What readers left, found in the document's plain text; pages only. Typed notes are notes
     * of the page that has their words, at the foot, or in the margin that notes_px makes;
     * those whose words are on no page, or in a note, stand behind all else. It must outlive
     * the pages. NULL: none. */
    const struct reader_remarks *remarks;
    /* What text flows around besides. Pages with remarks find their own, a view is told by
     * reader_view_around(). */
    const struct reader_obstacle *obstacles;
    int obstacles_count;
    bool places; /* pages only: reader_pages_find() and reader_pages_byte() are asked */
};
/* EB Garamond (DejaVu Serif without it) of 17 pixels, justified, on a page of 600 x 840. */
struct reader_pages_setup reader_pages_setup_default(void);

/* Errors: BAD_ARGUMENT, FAILED (a font that there is not), TOO_LARGE, NO_MEMORY. Owns: the
 * caller destroys *out, which is NULL on failure. */
enum reader_status reader_pages_make(const struct reader_document *document,
                                     const struct reader_pages_setup *setup,
                                     struct reader_pages **out);
void reader_pages_destroy(struct reader_pages *pages); /* NULL is fine */
/* The text that has the pages; never NULL. Owns: `pages`. */
struct page_text *reader_pages_text(struct reader_pages *pages);
/* What readers left on a page, as a drawing has it beside the letters: boxes behind words, and
 * ink. Owns: `pages`, until it is called again. Errors: FAILED, NO_MEMORY. */
enum reader_status reader_pages_left(struct reader_pages *pages, int page,
                                     struct font_drawing *drawing);
/* Where bytes begin..end of the document's plain text stand, each line's part a box of a page.
 * What is on no page has none. Errors: FAILED. */
enum reader_status
reader_pages_find(struct reader_pages *pages, size_t begin, size_t end,
                  void (*found)(void *user, int page, const struct page_box *box), void *user);
/* The byte that is nearest to a point of a page; false: there is none. */
bool reader_pages_byte(struct reader_pages *pages, int page, double x, double y, size_t *byte);
/* There are formulas, and no font to set them in: they stand as they are written. */
bool reader_pages_lacks_math(const struct reader_pages *pages);
/* How many commands in formulas are not known, and the first of them ("" for none). Owns:
 * `pages`. */
const char *reader_pages_unknown(const struct reader_pages *pages, int *count);

#endif
