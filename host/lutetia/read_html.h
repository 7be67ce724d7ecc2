/* read_html.h - `lutetia read -o FILE.html`: a document as one file that a browser shows. */
#ifndef LUTETIA_READ_HTML_H
#define LUTETIA_READ_HTML_H

#include <reader_html.h>

/* Writes it; its pictures are found in the files' folders. EXIT_SUCCESS, or says why not. */
int read_html_write(const char *path, const struct reader_document *document,
                    const struct reader_html_setup *setup);

#endif
