/* read_html.h - `lutetia read -o FILE.html`: a document as one file that a browser shows. */
#ifndef LUTETIA_READ_HTML_H
#define LUTETIA_READ_HTML_H

#include <reader_html.h>

/* In place of a file's name: what readers left in the manual, which is among their own data. */
#define READ_HTML_MANUAL ""

/* Writes it; its pictures are found in the files' folders. remarks: the file that readers have
 * left theirs in; NULL: none are written. EXIT_SUCCESS, or says why not. */
int read_html_write(const char *path, struct reader_document *document,
                    const struct reader_html_setup *setup, const char *remarks);

#endif
