/* markdown_none.c - in place of markdown.c where there is no cmark-gfm. */
#include "reader_internal.h"

enum reader_status reader_document_add(struct reader_document *document, const char *utf8,
                                       size_t bytes)
{
    (void)document;
    (void)utf8;
    (void)bytes;
    return reader_fail(
        READER_NO_LIBRARY,
        "Markdown is read by cmark-gfm, which was not there when this was built: "
        "install libcmark-gfm-dev and libcmark-gfm-extensions-dev, and build again");
}
