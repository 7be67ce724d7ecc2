/* document.h - layouts as the pages of one PDF: fonts embedded as fonts, text that can be
 * looked for, copied and read aloud.
 *
 *     struct font_document_def def = {.title = "In the marsh", .language = "en"};
 *     struct font_document *book;
 *     font_document_create(&def, &book);
 *     font_document_page(book, &drawing, &layout, NULL, 0, 0); // as often as there are pages
 *     font_document_write(book, file);
 *     font_document_destroy(book);
 *
 * Each face is embedded once, with the glyphs that are used: TrueType and CFF cut down by
 * HarfBuzz's subsetter, others (Type 1, variable CFF) as CFF made of their outlines. Glyphs
 * that are pictures in colours are pictures. Text is tagged: headings, paragraphs, items,
 * quotes and notes, as a drawing's passages tell them; headings are the document's outline,
 * too.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(): as
 * drawing.h says.
 *
 * Ownership: drawings and layouts are borrowed for the call; their faces must stay open, their
 * axes as they are, until the document is written. Threads: a document and the faces in it
 * belong to one thread at a time. */
#ifndef LUTETIA_FONT_DOCUMENT_H
#define LUTETIA_FONT_DOCUMENT_H

#include "drawing.h"

struct font_document;

struct font_document_def {
    const char *title;    /* NULL: none */
    const char *language; /* "fr", "pt-BR": of its text; NULL: not told */
};

/* Without pages. def: copied. Errors: NO_MEMORY. Owns: the caller destroys *out. */
enum font_status font_document_create(const struct font_document_def *def,
                                      struct font_document **out);
void font_document_destroy(struct font_document *document); /* NULL is fine */
/* Another page: the layout, its origin at (x, y), through `map` (NULL: as it is). Errors:
 * BAD_ARGUMENT, TOO_LARGE, NO_MEMORY; the document cannot be written then. */
enum font_status font_document_page(struct font_document *document,
                                    const struct font_drawing *drawing,
                                    const struct font_layout *layout,
                                    const struct font_map *map, double x_px, double y_px);
/* The whole of a file, once, with the pages that there are; the caller closes the file. Errors:
 * BAD_ARGUMENT (no page, or written before), BAD_FILE, NO_MEMORY. */
enum font_status font_document_write(struct font_document *document, FILE *file);

#endif
