/* remarks_internal.h - the file of remarks (remarks_file.c), and what is done with remarks
 * (remarks.c). */
#ifndef LUTETIA_READER_REMARKS_INTERNAL_H
#define LUTETIA_READER_REMARKS_INTERNAL_H

#include "reader_internal.h"
#include "reader_remarks.h"

#include <stdint.h>

#define REMARKS_TIME_MOST_S 1e12 /* since 1970 */

struct remarks_file;

/* Of one remark: its number in the file, the anchor that is its own, and where that is. */
struct remark_row {
    long long id;
    struct reader_remark remark;
    struct reader_anchor *anchor;
    struct reader_remark_place place;
    long long hangs_id, group_id; /* while it is read */
};

struct remark_rows {
    struct remark_row *rows;
    int count, capacity;
};

/* The names of layers; the first is "". */
struct remark_layers {
    char names[READER_LAYERS_MAX][READER_LAYER_BYTES];
    bool hidden[READER_LAYERS_MAX];
    int count, written;
};

/* Reads what there is; a file that there is not has no rows. reads: no row is ever written.
 * Errors: as reader_remarks_open(). */
enum reader_status remarks_file_open(const char *path, bool reads, struct remarks_file **out,
                                     struct remark_rows *rows, struct remark_layers *layers);
/* One more of that name behind all that the file has by now, which become known; or the one
 * that another program has made so. Errors: FAILED, TOO_LARGE. */
enum reader_status remarks_file_layer(struct remarks_file *file, const char *name,
                                      struct remark_layers *layers, int *layer);
/* Whether a layer can be called so. */
bool remark_layer_named(const char *name);
void remarks_file_close(struct remarks_file *file);
bool remarks_file_read_only(const struct remarks_file *file);
/* Writes a row; id 0: a new one, whose number becomes row->id. Makes the file where there is
 * none. Errors: FAILED, NO_MEMORY. */
enum reader_status remarks_file_write(struct remarks_file *file, struct remark_row *row);
/* How rows are to be arranged, all at once. Errors: FAILED. */
enum reader_status remarks_file_arrange(struct remarks_file *file,
                                        const struct remark_rows *rows,
                                        const struct reader_arranged *to, int count);
enum reader_status remarks_file_sync(struct remarks_file *file);
void remark_row_finish(struct remark_row *row);

#endif
