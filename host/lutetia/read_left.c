/* read_left.c - see read_left.h. */
#include "read_left.h"

#include "lutetia.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

int read_left_open(const char *of, const struct reader_document *document,
                   struct reader_remarks **remarks)
{
    if (strcmp(of, "-") == 0)
        return fail("read", "what is piped in has no notes: name its file%s", "");
    char *path = remarks_path(of);
    int status = EXIT_SUCCESS;
    if (!path)
        return fail("read", "it is not known where notes are kept: set HOME%s", "");
    if (access(path, F_OK) != 0)
        status = fail("read", "there is no %s: nobody has left notes in this document", path);
    else if (reader_remarks_read(path, remarks) != READER_OK ||
             reader_remarks_find(*remarks, document->plain, document->plain_bytes) != READER_OK)
        status = fail("read", "%s", reader_error());
    free(path);
    return status;
}
