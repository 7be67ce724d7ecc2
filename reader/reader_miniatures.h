/* reader_miniatures.h - all pages of a document, small: each is drawn at its small size by
 * fontpipe's filters, and not shrunk.
 *
 *     struct reader_miniatures_def def = {.setup = &setup, .width_px = 100};
 *     struct reader_miniatures *small;
 *     if (reader_miniatures_make(document, &def, &small) != READER_OK)
 *         die(reader_error());
 *     reader_miniatures_mark(small, hits, hits_count);
 *     for (int i = 0; i < reader_miniatures_count(small); i++)
 *         reader_miniatures_paint(small, i, pixels, 3 * width);
 *     reader_miniatures_destroy(small);
 *
 * Marks are what is found, what readers left, where one reads: ranges of the document's plain
 * text (reader_document_plain(), which must be there), which have colours behind their words. A
 * mark that would be too small to be seen is made larger.
 *
 * Errors: functions that can fail return a status and leave one line in reader_error().
 * Ownership: the document is borrowed for the call. Threads: they belong to one at a time. */
#ifndef LUTETIA_READER_MINIATURES_H
#define LUTETIA_READER_MINIATURES_H

#include "reader_pages.h"

struct reader_miniatures_def {
    const struct reader_pages_setup *setup; /* of the pages as they are when they are large */
    int width_px;                           /* of a page's picture: READER_MINIATURE_LEAST.. */
    bool dark;
};
enum { READER_MINIATURE_LEAST = 16, READER_MINIATURE_MOST = 1000 };

struct reader_miniatures;
/* Sets all pages. Errors: as reader_pages_make(); BAD_ARGUMENT for a width out of its range.
 * Owns: the caller destroys *out. */
enum reader_status reader_miniatures_make(const struct reader_document *document,
                                          const struct reader_miniatures_def *def,
                                          struct reader_miniatures **out);
void reader_miniatures_destroy(struct reader_miniatures *small); /* NULL is fine */
/* Another width of the pictures: the pages stay. Errors: BAD_ARGUMENT. */
enum reader_status reader_miniatures_resize(struct reader_miniatures *small, int width_px);

int reader_miniatures_count(const struct reader_miniatures *small);
/* Of a page's picture. */
void reader_miniatures_size(const struct reader_miniatures *small, int *width_px,
                            int *height_px);

struct reader_mark {
    size_t begin, end;
    double rgb[3];
};
/* In place of those that there were; later ones lie over earlier ones. Errors: FAILED,
 * NO_MEMORY. */
enum reader_status reader_miniatures_mark(struct reader_miniatures *small,
                                          const struct reader_mark *marks, int count);
/* How many boxes of marks a page has. */
int reader_miniatures_marks(const struct reader_miniatures *small, int page);

/* Red, green, blue; rows are so many bytes apart. Errors: BAD_ARGUMENT (no such page),
 * FAILED. */
enum reader_status reader_miniatures_paint(struct reader_miniatures *small, int page,
                                           uint8_t *rgb, size_t row_bytes);

/* The byte that is nearest to a point of a page's picture; false: the page has none. */
bool reader_miniatures_byte(struct reader_miniatures *small, int page, double x, double y,
                            size_t *byte);
/* The page that has a byte; -1: none has. */
int reader_miniatures_page(struct reader_miniatures *small, size_t byte);

#endif
