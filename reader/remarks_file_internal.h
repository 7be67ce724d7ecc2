/* remarks_file_internal.h - the file of remarks (remarks_file.c), and its rows as they are read
 * and written (remarks_rows.c). */
#ifndef LUTETIA_READER_REMARKS_FILE_INTERNAL_H
#define LUTETIA_READER_REMARKS_FILE_INTERNAL_H

#include "remarks_internal.h"

#include <sqlite3.h>

/* Versions: with remarks alone, with layers, and with those and how ink lies. */
enum { REMARKS_PLAIN = 1, REMARKS_LAYERED = 2, REMARKS_ARRANGED = 3, REMARKS_AROUND = 4 };

struct remarks_file {
    char *path;
    sqlite3 *db; /* NULL: there is no file yet */
    bool read_only;
    int version;
};

/* ---- remarks_rows.c ---- */

/* Fails: the file is left as it is. */
enum reader_status remarks_foreign(const struct remarks_file *file, const char *why);
/* Those behind the first, whose numbers are 1, 2, 3. Errors: FAILED. */
enum reader_status remarks_layers_read(struct remarks_file *file, struct remark_layers *layers);
/* Errors: FAILED, NO_MEMORY. */
enum reader_status remarks_rows_read(struct remarks_file *file, struct remark_rows *rows,
                                     const struct remark_layers *layers);
bool remark_row_bind(sqlite3_stmt *s, const struct remark_row *row, const unsigned char *anchor,
                     size_t anchor_bytes);

#endif
