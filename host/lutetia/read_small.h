/* read_small.h - `lutetia read --miniatures`: all pages of a document in one picture. */
#ifndef LUTETIA_READ_SMALL_H
#define LUTETIA_READ_SMALL_H

#include <reader_pages.h>

/* Rows of pages, each so many pixels wide. Returns an exit status; what was wrong has been
 * said. */
int read_small_write(const char *path, const struct reader_document *document,
                     const struct reader_pages_setup *setup, int width_px);

#endif
