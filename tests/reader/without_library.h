/* without_library.h - what the tests of documents are without cmark-gfm: skipped, by name. */
#ifndef WITHOUT_LIBRARY_H
#define WITHOUT_LIBRARY_H

#include <reader_document.h>

#include <stdio.h>

/* True: nothing can be read; a line has said so. */
static inline bool without_library(void)
{
    struct reader_document *d;
    const bool without = reader_document_create(&d) != READER_OK ||
                         reader_document_add(d, "", 0) == READER_NO_LIBRARY;
    if (without)
        printf("skipped: built without cmark-gfm\n");
    reader_document_destroy(d);
    return without;
}

#endif
