/* setup.h - a text with few signs in it as pages, by a handful of choices: what `lutetia set`
 * and scripts set.
 *
 *     struct page_setup setup = page_setup_default();
 *     setup.columns = 2;
 *     setup.hyphenate = true;
 *     page_setup_make(&setup, "# In the marsh\n\nThe *water* rises[^By night.].", 45, &text);
 *
 * A blank line ends a paragraph; other line ends are spaces, but for those behind a backslash.
 * `# ` begins a heading, `## ` a smaller one; `- ` and `1. ` an item of a list, `> ` a quote;
 * `* * *` alone on its line parts the text. *slanted* and _slanted_, **bold**: signs that
 * nothing closes are letters, and those with blanks on both sides. [^a note] is set at the foot
 * of the column, with a number, and [>a note] in the margin. A backslash before a sign makes it
 * a letter. Lines end in LF, CR or both.
 *
 * Errors: as page.h says. Ownership: what is passed is copied, but for shapes' points. Threads:
 * as page.h says. */
#ifndef LUTETIA_PAGE_SETUP_H
#define LUTETIA_PAGE_SETUP_H

#include "page.h"

#include <stddef.h>

/* Parts of a text that may have a filter of their own. */
enum page_part {
    PAGE_PART_TEXT,
    PAGE_PART_ITALIC,
    PAGE_PART_BOLD,
    PAGE_PART_HEAD,
    PAGE_PART_NOTE,
    PAGE_PARTS
};
/* "text", "italic", "bold", "head", "note"; never NULL, constants, valid for ever. */
const char *page_part_name(enum page_part part);

struct page_setup {
    const char *font, *italic, *bold; /* NULL: those of the font's family */
    const char *features, *language;
    double size_px;
    double leading; /* of the size; 0: the font's */
    double width_px, height_px, margin_px, gap_px;
    int columns;
    /* the width of a margin for notes, beside the text (under it where lines go down); 0: notes
     * in the margin are set at the foot */
    double notes_px;
    enum font_align align;
    double indent_em; /* of paragraphs that do not stand behind a heading */
    bool hyphenate, vertical;
    bool grid;   /* lines of columns beside each other are level */
    bool folios; /* page numbers in the lower margin */
    const char
        *head; /* a running head in the upper margin, as page_running has it; NULL: none */
    double protrude, expand, tolerance;
    const struct page_shape *shapes; /* in the page's pixels */
    int shapes_count;
    bool colour; /* as page_text_colour() */
    bool inked;
    struct font_ink ink;
    const char *filters[PAGE_PARTS]; /* as page_style has them; NULL: whoever draws says */
};
/* One justified column of DejaVu Serif on a page of 600 x 840. */
struct page_setup page_setup_default(void);

/* The numbers of a setup, with the ranges that users may choose in: a double each, or a whole
 * int. */
struct page_number {
    const char *name;
    double least, most;
    size_t at; /* in struct page_setup */
    bool whole;
};
extern const struct page_number page_numbers[];
extern const int page_numbers_count;

/* Sequences that are not UTF-8 become U+FFFD. Errors: those of page.h. Owns: the caller
 * destroys *out, which is NULL on failure. */
enum font_status page_setup_make(const struct page_setup *setup, const char *utf8, size_t bytes,
                                 struct page_text **out);

#endif
