/* read_left.h - what readers left in a document, for `lutetia read --remarks`. */
#ifndef LUTETIA_READ_LEFT_H
#define LUTETIA_READ_LEFT_H

#include <reader_remarks.h>

/* In place of a file's name: what readers left in the manual, which is among their own data. */
#define READ_LEFT_MANUAL ""

/* Those beside the file `of`, found in the document's plain text, to be read alone.
 * EXIT_SUCCESS, or says why not. The caller closes *remarks. */
int read_left_open(const char *of, const struct reader_document *document,
                   struct reader_remarks **remarks);

#endif
