/* read_html.c - see read_html.h. */
#include "read_html.h"

#include "lutetia.h"

#include <beside.h>
#include <output_file.h>

#include <stdio.h>
#include <stdlib.h>

static int fail_reader(void)
{
    return fail("read", "%s", reader_error());
}

static bool picture_copy(void *user, int source, const char *target, FILE *to)
{
    const struct reader_files *files = user;
    return source < files->count && display_beside_copy(files->paths[source], target, to);
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

int read_html_write(const char *path, const struct reader_document *document,
                    const struct reader_html_setup *setup)
{
    struct reader_html_setup own = *setup;
    if (own.files) {
        own.picture = picture_copy;
        own.picture_user = (void *)(uintptr_t)own.files;
    }
    return file_write(path, document, &own);
}
