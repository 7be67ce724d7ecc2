/* reader_html.h - a document as one file of HTML, which needs no other: pictures and formulas
 * are within it; what readers left, too.
 *
 *     struct reader_html_setup setup = {.title = "The marsh", .theme = READER_HTML_BOTH,
 *                                       .remarks = remarks};
 *     if (reader_html_write(document, &setup, file) != READER_OK)
 *         die(reader_error());
 *
 * Highlights are marks, typed notes are asides behind the block that has their words, in the
 * margin where the window is wide, and ink is drawn over the word that it hangs on, as SVG.
 * What is erased is left out. What hangs on words that are gone stands at the end, with its
 * quotation. Remarks must have been found in the document's plain text.
 *
 * Nothing in it is run, and nothing is fetched: the file says so itself, by its
 * Content-Security-Policy. Links lead to places of the document, to https:, http: and mailto:,
 * and to files by their names as they are written.
 *
 * Errors: functions that can fail return a status and leave one line in reader_error(). That
 * the file cannot be written is the caller's to see (ferror()).
 *
 * Ownership: all is borrowed for the call. Threads: as documents. */
#ifndef LUTETIA_READER_HTML_H
#define LUTETIA_READER_HTML_H

#include "reader_document.h"
#include "reader_files.h"
#include "reader_remarks.h"
#include "reader_template.h"

#include <stdio.h>
#include <text.h>

enum reader_html_theme { READER_HTML_LIGHT, READER_HTML_DARK, READER_HTML_BOTH };

/* What formulas lacked. Letters of the text itself are the browser's to find. */
struct reader_html_lacks {
    bool math;                  /* no font for formulas: they stand as they are written */
    int unknown_count;          /* commands that are not known */
    char unknown[48];           /* the first of them */
    struct font_layout letters; /* its `missing` are the characters that no font has */
};

struct reader_html_setup {
    const char *title;            /* NULL: the first heading */
    const char *language;         /* NULL: not told */
    enum reader_html_theme theme; /* both: as the reader's browser is */
    double size_px;               /* of the em; 0: the browser's */
    const char *font,
        *math; /* font: a family's name; math: as font_face_open() has it; NULL: the
                              * usual ones */
    /* Its colours, its sizes of letters, how wide its first column of text is at most, and
     * where figures stand that do not say so themselves; NULL: the usual ones. */
    const struct reader_template *template;
    const struct reader_files *files;     /* the document's, for links among them; NULL: none */
    const struct reader_remarks *remarks; /* NULL: none */
    /* Writes the bytes of the PNG that source number `source` names; false: it is told by its
     * caption and its file. NULL: none is found. */
    bool (*picture)(void *user, int source, const char *target, FILE *to);
    void *picture_user;
    struct reader_html_lacks *lacks; /* it is filled; NULL: nobody asks */
};

/* The document's plain text must be there (reader_document_plain()). Errors: BAD_ARGUMENT (it
 * is not), FAILED (a font that there is not), NO_MEMORY. */
enum reader_status reader_html_write(const struct reader_document *document,
                                     const struct reader_html_setup *setup, FILE *file);

#endif
