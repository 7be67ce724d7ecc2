/* read_html.c - see read_html.h. */
#include "read_html.h"

#include "lutetia.h"

#include <beside.h>
#include <output_file.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int fail_reader(void)
{
    return fail("read", "%s", reader_error());
}

static bool picture_copy(void *user, int source, const char *target, FILE *to)
{
    const struct reader_files *files = user;
    return source < files->count && display_beside_copy(files->paths[source], target, to);
}

/* Where a document's remarks are. Owns: the caller frees it; NULL: no memory, no home. */
static char *remarks_path(const char *of)
{
    const char *data = getenv("XDG_DATA_HOME"), *home = getenv("HOME");
    char *path = NULL;
    int made = -1;
    if (*of)
        made = asprintf(&path, "%s.notes", of);
    else if (data && *data == '/')
        made = asprintf(&path, "%s/lutetia/manual.notes", data);
    else if (home)
        made = asprintf(&path, "%s/.local/share/lutetia/manual.notes", home);
    return made >= 0 ? path : NULL;
}

static int remarks_open(const char *of, const struct reader_document *document,
                        struct reader_remarks **remarks)
{
    char *path = remarks_path(of);
    int status = EXIT_SUCCESS;
    if (!path)
        return fail("read", "it is not known where notes are kept: set HOME%s", "");
    if (access(path, F_OK) != 0)
        status = fail("read", "there is no %s: nobody has left notes in this document", path);
    else if (reader_remarks_read(path, remarks) != READER_OK ||
             reader_remarks_find(*remarks, document->plain, document->plain_bytes) != READER_OK)
        status = fail_reader();
    free(path);
    return status;
}

static int file_write(const char *path, const struct reader_document *document,
                      const struct reader_html_setup *setup)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return fail("read", "%s: cannot write: %s", path, out.why);
    if (reader_html_write(document, setup, out.stream) != READER_OK) {
        output_file_abandon(&out);
        return fail_reader();
    }
    return output_file_commit(&out) ? EXIT_SUCCESS
                                    : fail("read", "%s: cannot write: %s", path, out.why);
}

int read_html_write(const char *path, struct reader_document *document,
                    const struct reader_html_setup *setup, const char *remarks)
{
    struct reader_html_setup own = *setup;
    struct reader_remarks *left = NULL;
    int status = reader_document_plain(document) == READER_OK ? EXIT_SUCCESS : fail_reader();
    if (status == EXIT_SUCCESS && remarks)
        status = remarks_open(remarks, document, &left);
    own.remarks = left;
    if (own.files) {
        own.picture = picture_copy;
        own.picture_user = (void *)(uintptr_t)own.files;
    }
    if (status == EXIT_SUCCESS)
        status = file_write(path, document, &own);
    reader_remarks_close(left);
    return status;
}
