/* remarks_rows.c - rows of a file of remarks, as they are read, and checked, and written: see
 * remarks_file_internal.h. */
#include "remarks_file_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum reader_status remarks_foreign(const struct remarks_file *file, const char *why)
{
    return reader_fail(READER_FAILED,
                       "%s: %s: it is left as it is, and notes are not kept until it is moved "
                       "away",
                       file->path, why);
}

/* ---- reading ---- */

enum column {
    ID,
    KIND,
    MADE,
    GONE,
    ANCHOR,
    TEXT,
    RGBA,
    WIDTH,
    X,
    Y,
    POINTS,
    LAYER,
    SCALE_X,
    SCALE_Y,
    HANGS,
    GROUPED,
    AROUND
};

/* By the version: what all have, and what is behind it. */
static const char *const selects[] = {
    [REMARKS_PLAIN] =
        "SELECT id, kind, made, gone, anchor, text, rgba, width, x, y, points, 0, 1, 1, "
        "id, 0, 0 FROM remark ORDER BY id",
    [REMARKS_LAYERED] =
        "SELECT id, kind, made, gone, anchor, text, rgba, width, x, y, points, "
        "coalesce((SELECT layer FROM in_layer WHERE remark = remark.id), 0), 1, 1, id, "
        "0, 0 FROM remark ORDER BY id",
    [REMARKS_ARRANGED] =
        "SELECT id, kind, made, gone, anchor, text, rgba, width, x, y, points, "
        "coalesce((SELECT layer FROM in_layer WHERE remark = remark.id), 0), "
        "coalesce(scale_x, 1), coalesce(scale_y, 1), coalesce(hangs, id), "
        "coalesce(grouped, 0), 0 FROM remark LEFT JOIN arranged ON arranged.remark = "
        "remark.id ORDER BY id",
    [REMARKS_AROUND] =
        "SELECT id, kind, made, gone, anchor, text, rgba, width, x, y, points, "
        "coalesce((SELECT layer FROM in_layer WHERE remark = remark.id), 0), "
        "coalesce(scale_x, 1), coalesce(scale_y, 1), coalesce(hangs, id), "
        "coalesce(grouped, 0), coalesce((SELECT side FROM around WHERE remark = remark.id), "
        "0) FROM remark LEFT JOIN arranged ON arranged.remark = remark.id ORDER BY id"};

static bool number_read(sqlite3_stmt *s, enum column column, double least, double most,
                        double *out)
{
    *out = sqlite3_column_double(s, (int)column);
    return *out >= least && *out <= most;
}

static bool points_read(sqlite3_stmt *s, struct reader_remark *remark)
{
    const size_t bytes = (size_t)sqlite3_column_bytes(s, POINTS),
                 count = bytes / sizeof *remark->points;
    const void *from = sqlite3_column_blob(s, POINTS);
    if (bytes % sizeof *remark->points || count > READER_INK_POINTS_MAX ||
        (count == 0) != (remark->kind != READER_REMARK_INK))
        return false;
    remark->points = malloc(bytes + 1);
    if (!remark->points)
        return false;
    if (bytes)
        memcpy(remark->points, from, bytes);
    remark->points_count = (int)count;
    float before = 0;
    for (size_t i = 0; i < count; i++) {
        const struct reader_ink_point *p = &remark->points[i];
        if (!(fabsf(p->x) < 1e6f && fabsf(p->y) < 1e6f && p->pressure >= 0 &&
              p->pressure <= 1 && p->time_s >= before && p->time_s < 1e6f))
            return false;
        before = p->time_s;
    }
    return true;
}

/* A row that is not as rows are is refused as a whole. */
static bool row_read(sqlite3_stmt *s, struct remark_row *row)
{
    struct reader_remark *r = &row->remark;
    const char *text = (const char *)sqlite3_column_text(s, TEXT);
    const int kind = sqlite3_column_int(s, KIND);
    row->id = sqlite3_column_int64(s, ID);
    row->hangs_id = sqlite3_column_int64(s, HANGS);
    row->group_id = sqlite3_column_int64(s, GROUPED);
    const sqlite3_int64 around = sqlite3_column_int64(s, AROUND);
    if (kind < READER_REMARK_HIGHLIGHT || kind > READER_REMARK_INK || !text ||
        sqlite3_column_bytes(s, TEXT) > READER_TYPED_MAX)
        return false;
    if (around < READER_AROUND_NOT || around > READER_AROUND_RIGHT ||
        (around && kind != READER_REMARK_INK))
        return false;
    r->around = (enum reader_around)around;
    r->kind = (enum reader_remark_kind)kind;
    r->rgba = (unsigned)sqlite3_column_int64(s, RGBA);
    r->text = strdup(text);
    const void *anchor = sqlite3_column_blob(s, ANCHOR);
    return r->text && number_read(s, MADE, 0, REMARKS_TIME_MOST_S, &r->made_s) &&
           number_read(s, GONE, 0, REMARKS_TIME_MOST_S, &r->gone_s) &&
           number_read(s, WIDTH, 0, 100, &r->width) &&
           number_read(s, X, -READER_MOVED_MOST, READER_MOVED_MOST, &r->x) &&
           number_read(s, Y, -READER_MOVED_MOST, READER_MOVED_MOST, &r->y) &&
           number_read(s, SCALE_X, READER_SCALE_LEAST, READER_SCALE_MOST, &r->scale_x) &&
           number_read(s, SCALE_Y, READER_SCALE_LEAST, READER_SCALE_MOST, &r->scale_y) &&
           points_read(s, r) && anchor &&
           reader_anchor_restore(anchor, (size_t)sqlite3_column_bytes(s, ANCHOR),
                                 &row->anchor) == READER_OK;
}

void remark_row_finish(struct remark_row *row)
{
    free(row->remark.text);
    free(row->remark.points);
    reader_anchor_destroy(row->anchor);
    *row = (struct remark_row){0};
}

bool remark_layer_named(const char *name)
{
    const size_t bytes = strlen(name);
    bool seen = bytes > 0 && bytes < READER_LAYER_BYTES;
    for (size_t i = 0; seen && i < bytes;) {
        const unsigned char first = (unsigned char)name[i];
        const size_t more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc2 ? 1 : 0;
        seen = (first >= 0x20 && first < 0x7f) || (first >= 0xc2 && first < 0xf5);
        if (first == 0xc2 && (unsigned char)name[i + 1] < 0xa0)
            seen = false;
        for (size_t k = 1; seen && k <= more; k++)
            seen = ((unsigned char)name[i + k] & 0xc0) == 0x80;
        i += more + 1;
    }
    return seen;
}

/* Their numbers are 1, 2, 3. */
enum reader_status remarks_layers_read(struct remarks_file *file, struct remark_layers *layers)
{
    sqlite3_stmt *s = NULL;
    bool good = sqlite3_prepare_v2(file->db, "SELECT id, name FROM layer ORDER BY id", -1, &s,
                                   NULL) == SQLITE_OK;
    while (good && sqlite3_step(s) == SQLITE_ROW) {
        const char *name = (const char *)sqlite3_column_text(s, 1);
        good = layers->count < READER_LAYERS_MAX &&
               sqlite3_column_int64(s, 0) == layers->count && name &&
               strlen(name) == (size_t)sqlite3_column_bytes(s, 1) && remark_layer_named(name);
        if (good)
            memcpy(layers->names[layers->count++], name, strlen(name) + 1);
    }
    sqlite3_finalize(s);
    return good ? READER_OK : remarks_foreign(file, "this file is damaged");
}

/* Of an id in the file, its row; -1: there is none. */
static int row_of_id(const struct remark_rows *rows, long long id)
{
    int low = 0, high = rows->count;
    while (low < high) {
        const int half = (low + high) / 2;
        if (rows->rows[half].id < id)
            low = half + 1;
        else
            high = half;
    }
    return low < rows->count && rows->rows[low].id == id ? low : -1;
}

/* What they hang on and are grouped by, as rows instead of ids. */
static bool rows_hang(struct remark_rows *rows)
{
    bool good = true;
    for (int i = 0; i < rows->count && good; i++) {
        struct remark_row *row = &rows->rows[i];
        struct reader_remark *r = &row->remark;
        r->hangs = row_of_id(rows, row->hangs_id);
        r->group = row->group_id ? row_of_id(rows, row->group_id) : -1;
        good = r->hangs >= 0 && (row->group_id == 0 || r->group >= 0);
    }
    return good;
}

enum reader_status remarks_rows_read(struct remarks_file *file, struct remark_rows *rows,
                                     const struct remark_layers *layers)
{
    sqlite3_stmt *s = NULL;
    enum reader_status status = READER_OK;
    int step = SQLITE_ERROR;
    if (sqlite3_prepare_v2(file->db, selects[file->version], -1, &s, NULL) == SQLITE_OK)
        step = SQLITE_ROW;
    while (status == READER_OK && step == SQLITE_ROW &&
           (step = sqlite3_step(s)) == SQLITE_ROW) {
        struct remark_row row = {0};
        const sqlite3_int64 layer = sqlite3_column_int64(s, LAYER);
        row.remark.layer = (int)layer;
        if (rows->count == READER_REMARKS_MAX || layer < 0 || layer >= layers->count ||
            !row_read(s, &row)) {
            remark_row_finish(&row);
            status = remarks_foreign(file, "this file is damaged");
        } else if (!array_reserve(&rows->rows, &rows->capacity, rows->count + 1,
                                  sizeof *rows->rows)) {
            remark_row_finish(&row);
            status = reader_fail(READER_NO_MEMORY, "no memory for notes");
        } else {
            rows->rows[rows->count++] = row;
        }
    }
    if (status == READER_OK && step != SQLITE_DONE)
        status = remarks_foreign(file, sqlite3_errmsg(file->db));
    if (status == READER_OK && !rows_hang(rows))
        status = remarks_foreign(file, "this file is damaged");
    sqlite3_finalize(s);
    return status;
}

/* ---- writing ---- */

bool remark_row_bind(sqlite3_stmt *s, const struct remark_row *row, const unsigned char *anchor,
                     size_t anchor_bytes)
{
    const struct reader_remark *r = &row->remark;
    size_t quoted;
    const char *quotation = reader_anchor_quotation(row->anchor, &quoted);
    bool good = row->id == 0 ? sqlite3_bind_null(s, 1) == SQLITE_OK
                             : sqlite3_bind_int64(s, 1, row->id) == SQLITE_OK;
    good =
        good && sqlite3_bind_int(s, 2, (int)r->kind) == SQLITE_OK &&
        sqlite3_bind_double(s, 3, r->made_s) == SQLITE_OK &&
        sqlite3_bind_double(s, 4, r->gone_s) == SQLITE_OK &&
        sqlite3_bind_blob64(s, 5, anchor, anchor_bytes, SQLITE_STATIC) == SQLITE_OK &&
        sqlite3_bind_text64(s, 6, quotation, quoted, SQLITE_STATIC, SQLITE_UTF8) == SQLITE_OK &&
        sqlite3_bind_text(s, 7, r->text, -1, SQLITE_STATIC) == SQLITE_OK &&
        sqlite3_bind_int64(s, 8, r->rgba) == SQLITE_OK &&
        sqlite3_bind_double(s, 9, r->width) == SQLITE_OK &&
        sqlite3_bind_double(s, 10, r->x) == SQLITE_OK &&
        sqlite3_bind_double(s, 11, r->y) == SQLITE_OK;
    return good && sqlite3_bind_blob64(s, 12, r->points ? (const void *)r->points : "",
                                       (size_t)r->points_count * sizeof *r->points,
                                       SQLITE_STATIC) == SQLITE_OK;
}
