/* reader_files.h - a document's files: those that are named, and those that they include.
 *
 *     struct reader_files files = {0};
 *     if (reader_files_add(&files, document, "book.md", text, bytes) != READER_OK)
 *         die(reader_error());
 *     for (int i = 0; i < files.refused_count; i++)
 *         tell(files.refused[i]);
 *     show_pictures_beside(files.paths[block->source]);
 *     reader_files_finish(&files);
 *
 * A paragraph that is nothing but a link to Markdown with the title "include" is what that file
 * says. The file lies in the folder of the named file or below it, whatever links are followed
 * on the way: so a document from elsewhere shows no other files. One that cannot be included
 * stands as the link that it is, and a line says why.
 *
 * Ownership: texts are copied. Threads: one at a time. */
#ifndef LUTETIA_READER_FILES_H
#define LUTETIA_READER_FILES_H

#include "reader_document.h"

enum {
    READER_FILES_MAX = 1000,       /* of a document */
    READER_INCLUDES_DEPTH_MAX = 8, /* a file that is included by one that is included by ... */
    READER_REFUSED_MAX = 100
};

struct reader_bytes {
    char *text; /* with a zero behind it, which is not counted */
    size_t bytes;
};

struct reader_files {
    char **paths; /* of each of the document's sources */
    int count;
    char *refused[READER_REFUSED_MAX]; /* lines: which file, its line, why */
    int refused_count;
    long refused_all;
    /* What is included whence. */
    char **whole; /* the same paths from the root on, without links; NULL: there is no file */
    int *from;    /* the source that includes it; -1: it is named */
    int paths_capacity, whole_capacity, from_capacity, texts_capacity;
    double bytes;
    /* Who edits a document sets `keep`: then these are the bytes of each source. */
    bool keep;
    struct reader_bytes *texts;
    /* Files that are included are what they are there; NULL: as on the disk. Borrowed. */
    const struct reader_files *held;
};

/* Adds what a named file says behind what there is, and what it includes in its places. path:
 * as it is said in lines; "-": it is no file, and includes none. Errors: those of
 * reader_document_add(), TOO_LARGE with the path where an included file has it, NO_MEMORY; the
 * document may then have a part of it. */
enum reader_status reader_files_add(struct reader_files *files,
                                    struct reader_document *document, const char *path,
                                    const char *utf8, size_t bytes);
/* Which of the document's files a link of one of them means by that path; -1: none. */
int reader_files_source(const struct reader_files *files, int from, const char *path,
                        size_t bytes);
/* reader_document_refer(), and references lead to labels of the other files, too:
 * [#](other.md#label). */
enum reader_status reader_files_refer(const struct reader_files *files,
                                      struct reader_document *document);
void reader_files_finish(struct reader_files *files); /* all zeros are fine */

#endif
