/* remarks_file.c - remarks in a file of SQLite: see remarks_internal.h.
 *
 * What is in such a file may have been written by anybody. So nothing in it is run (no
 * triggers, no views, a schema that is exactly ours), and each row is checked as it is read. */
#include "remarks_internal.h"

#include <math.h>
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    APPLICATION = 0x4c55524d, /* of the file's head, so that it is known what it is */
    PLAIN = 1,                /* version without layers */
    VERSION = 2,
    LENGTH_MOST = 16 << 20, /* bytes of a value */
    BUSY_MS = 2000
};

static const char schema[] = "CREATE TABLE remark(id INTEGER PRIMARY KEY AUTOINCREMENT, kind "
                             "INTEGER NOT NULL, made REAL "
                             "NOT NULL, gone REAL NOT NULL, anchor BLOB NOT NULL, quotation "
                             "TEXT NOT NULL, text TEXT NOT "
                             "NULL, rgba INTEGER NOT NULL, width REAL NOT NULL, x REAL NOT "
                             "NULL, y REAL NOT NULL, points "
                             "BLOB NOT NULL)";

/* A layer's number, from 1, and its name; and of remarks that are not in the first, the number
 * of theirs. */
static const char layer_schema[] = "CREATE TABLE layer(id INTEGER PRIMARY KEY, name TEXT NOT "
                                   "NULL)",
                  in_layer_schema[] = "CREATE TABLE in_layer(remark INTEGER PRIMARY KEY, layer "
                                      "INTEGER NOT NULL)";

struct remarks_file {
    char *path;
    sqlite3 *db;             /* NULL: there is no file yet */
    bool read_only, layered; /* layered: of the version that has layers */
};

static enum reader_status file_fail(const struct remarks_file *file)
{
    return reader_fail(READER_FAILED, "%s: %s", file->path,
                       file->db ? sqlite3_errmsg(file->db) : "it cannot be opened");
}

static enum reader_status foreign(const struct remarks_file *file, const char *why)
{
    return reader_fail(READER_FAILED,
                       "%s: %s: it is left as it is, and notes are not kept until it is moved "
                       "away",
                       file->path, why);
}

/* ---- opening ---- */

/* The number that a statement gives; -1: none. */
static long long number_of(struct remarks_file *file, const char *sql)
{
    sqlite3_stmt *statement = NULL;
    long long number = -1;
    if (sqlite3_prepare_v2(file->db, sql, -1, &statement, NULL) == SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW)
        number = sqlite3_column_int64(statement, 0);
    sqlite3_finalize(statement);
    return number;
}

static bool text_is(struct remarks_file *file, const char *sql, const char *text)
{
    sqlite3_stmt *statement = NULL;
    bool is = sqlite3_prepare_v2(file->db, sql, -1, &statement, NULL) == SQLITE_OK &&
              sqlite3_step(statement) == SQLITE_ROW;
    const char *found = is ? (const char *)sqlite3_column_text(statement, 0) : NULL;
    is = found && strcmp(found, text) == 0;
    sqlite3_finalize(statement);
    return is;
}

static bool run(struct remarks_file *file, const char *sql)
{
    return sqlite3_exec(file->db, sql, NULL, NULL, NULL) == SQLITE_OK;
}

/* Nothing that the file says is run. */
static void guard(struct remarks_file *file)
{
    sqlite3_limit(file->db, SQLITE_LIMIT_LENGTH, LENGTH_MOST);
    sqlite3_busy_timeout(file->db, BUSY_MS);
    sqlite3_db_config(file->db, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    sqlite3_db_config(file->db, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
    sqlite3_db_config(file->db, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, NULL);
    sqlite3_db_config(file->db, SQLITE_DBCONFIG_ENABLE_VIEW, 0, NULL);
    run(file, "PRAGMA cell_size_check=ON");
}

/* That it is a file of ours, whole, and of a version that is known. */
static enum reader_status check(struct remarks_file *file)
{
    const long long application = number_of(file, "PRAGMA application_id"),
                    version = number_of(file, "PRAGMA user_version");
    if (application != APPLICATION)
        return foreign(file, application < 0 ? sqlite3_errmsg(file->db)
                                             : "this is another program's file");
    if (version > VERSION)
        return foreign(file, "this file is of a newer version");
    file->layered = version == VERSION;
    if (version < PLAIN ||
        number_of(file, "SELECT count(*) FROM sqlite_schema WHERE name NOT LIKE 'sqlite_%'") !=
            (file->layered ? 3 : 1) ||
        (file->layered &&
         (!text_is(file, "SELECT sql FROM sqlite_schema WHERE name='layer'", layer_schema) ||
          !text_is(file, "SELECT sql FROM sqlite_schema WHERE name='in_layer'",
                   in_layer_schema))) ||
        !text_is(file, "SELECT sql FROM sqlite_schema WHERE name='remark'", schema))
        return foreign(file, "this file is not as notes are");
    if (!text_is(file, "PRAGMA quick_check(1)", "ok"))
        return foreign(file, "this file is damaged");
    return READER_OK;
}

/* Its changes go into a journal of their own, which a killed program leaves behind whole; where
 * the folder cannot have that, SQLite keeps to its usual one. */
static void journal(struct remarks_file *file)
{
    if (!file->read_only) {
        run(file, "PRAGMA journal_mode=WAL");
        run(file, "PRAGMA synchronous=NORMAL");
    }
}

static enum reader_status make(struct remarks_file *file)
{
    char pragmas[120];
    if (sqlite3_open_v2(file->path, &file->db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE,
                        NULL) != SQLITE_OK) {
        enum reader_status status = file_fail(file);
        sqlite3_close(file->db);
        file->db = NULL;
        return status;
    }
    guard(file);
    journal(file);
    snprintf(pragmas, sizeof pragmas, "PRAGMA application_id=%d; PRAGMA user_version=%d",
             APPLICATION, PLAIN);
    const bool good = run(file, "BEGIN IMMEDIATE") &&
                      (number_of(file, "SELECT count(*) FROM sqlite_schema") > 0 ||
                       (run(file, schema) && run(file, pragmas))) &&
                      run(file, "COMMIT");
    enum reader_status status = good ? check(file) : file_fail(file);
    if (status != READER_OK) {
        sqlite3_close(file->db);
        file->db = NULL;
    }
    return status;
}

/* reads: nothing will be written. */
static enum reader_status open_there(struct remarks_file *file, bool reads)
{
    file->read_only = reads;
    if (access(file->path, F_OK) != 0)
        return READER_OK; /* made at the first remark */
    const bool closed = access(file->path, W_OK) != 0;
    file->read_only = reads || closed;
    if (sqlite3_open_v2(file->path, &file->db,
                        closed ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE,
                        NULL) != SQLITE_OK)
        return file_fail(file);
    guard(file);
    enum reader_status status = check(file);
    if (status == READER_OK)
        journal(file);
    return status;
}

/* ---- rows ---- */

enum column { ID, KIND, MADE, GONE, ANCHOR, TEXT, RGBA, WIDTH, X, Y, POINTS, LAYER };

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
    if (kind < READER_REMARK_HIGHLIGHT || kind > READER_REMARK_INK || !text ||
        sqlite3_column_bytes(s, TEXT) > READER_TYPED_MAX)
        return false;
    r->kind = (enum reader_remark_kind)kind;
    r->rgba = (unsigned)sqlite3_column_int64(s, RGBA);
    r->text = strdup(text);
    const void *anchor = sqlite3_column_blob(s, ANCHOR);
    return r->text && number_read(s, MADE, 0, REMARKS_TIME_MOST_S, &r->made_s) &&
           number_read(s, GONE, 0, REMARKS_TIME_MOST_S, &r->gone_s) &&
           number_read(s, WIDTH, 0, 100, &r->width) && number_read(s, X, -1e6, 1e6, &r->x) &&
           number_read(s, Y, -1e6, 1e6, &r->y) && points_read(s, r) && anchor &&
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
static enum reader_status layers_read(struct remarks_file *file, struct remark_layers *layers)
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
    return good ? READER_OK : foreign(file, "this file is damaged");
}

static enum reader_status rows_read(struct remarks_file *file, struct remark_rows *rows,
                                    const struct remark_layers *layers)
{
    sqlite3_stmt *s = NULL;
    enum reader_status status = READER_OK;
    int step = SQLITE_ERROR;
    if (sqlite3_prepare_v2(
            file->db,
            file->layered ? "SELECT id, kind, made, gone, anchor, text, rgba, width, x, y, "
                            "points, coalesce((SELECT layer FROM in_layer WHERE remark = "
                            "remark.id), 0) FROM remark ORDER BY id"
                          : "SELECT id, kind, made, gone, anchor, text, rgba, width, x, y, "
                            "points, 0 FROM remark ORDER BY id",
            -1, &s, NULL) == SQLITE_OK)
        step = SQLITE_ROW;
    while (status == READER_OK && step == SQLITE_ROW &&
           (step = sqlite3_step(s)) == SQLITE_ROW) {
        struct remark_row row = {0};
        const sqlite3_int64 layer = sqlite3_column_int64(s, LAYER);
        row.remark.layer = (int)layer;
        if (rows->count == READER_REMARKS_MAX || layer < 0 || layer >= layers->count ||
            !row_read(s, &row)) {
            remark_row_finish(&row);
            status = foreign(file, "this file is damaged");
        } else if (!array_reserve(&rows->rows, &rows->capacity, rows->count + 1,
                                  sizeof *rows->rows)) {
            remark_row_finish(&row);
            status = reader_fail(READER_NO_MEMORY, "no memory for notes");
        } else {
            rows->rows[rows->count++] = row;
        }
    }
    if (status == READER_OK && step != SQLITE_DONE)
        status = foreign(file, sqlite3_errmsg(file->db));
    sqlite3_finalize(s);
    return status;
}

enum reader_status remarks_file_open(const char *path, bool reads, struct remarks_file **out,
                                     struct remark_rows *rows, struct remark_layers *layers)
{
    struct remarks_file *file = calloc(1, sizeof *file);
    *out = NULL;
    if (!file || !(file->path = strdup(path))) {
        free(file);
        return reader_fail(READER_NO_MEMORY, "no memory for notes");
    }
    enum reader_status status = open_there(file, reads);
    *layers = (struct remark_layers){.count = 1};
    if (status == READER_OK && file->layered)
        status = layers_read(file, layers);
    if (status == READER_OK && file->db)
        status = rows_read(file, rows, layers);
    if (status == READER_OK)
        *out = file;
    else
        remarks_file_close(file);
    return status;
}

void remarks_file_close(struct remarks_file *file)
{
    if (!file)
        return;
    sqlite3_close(file->db);
    free(file->path);
    free(file);
}

bool remarks_file_read_only(const struct remarks_file *file)
{
    return file->read_only;
}

/* ---- writing ---- */

static bool row_bind(sqlite3_stmt *s, const struct remark_row *row, const unsigned char *anchor,
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

/* With the first one the file becomes one of the version that has them. */
enum reader_status remarks_file_layer(struct remarks_file *file, const char *name, int number)
{
    sqlite3_stmt *s = NULL;
    char version[60];
    if (file->read_only)
        return reader_fail(READER_FAILED, "%s can be read only", file->path);
    enum reader_status status = file->db ? READER_OK : make(file);
    if (status != READER_OK)
        return status;
    snprintf(version, sizeof version, "PRAGMA user_version=%d", VERSION);
    bool good = run(file, "BEGIN IMMEDIATE") &&
                (file->layered ||
                 (run(file, layer_schema) && run(file, in_layer_schema) && run(file, version)));
    good = good &&
           sqlite3_prepare_v2(file->db, "INSERT INTO layer VALUES(?,?)", -1, &s, NULL) ==
               SQLITE_OK &&
           sqlite3_bind_int(s, 1, number) == SQLITE_OK &&
           sqlite3_bind_text(s, 2, name, -1, SQLITE_STATIC) == SQLITE_OK &&
           sqlite3_step(s) == SQLITE_DONE;
    sqlite3_finalize(s);
    good = good && run(file, "COMMIT");
    if (!good) {
        status = file_fail(file);
        run(file, "ROLLBACK");
    }
    file->layered = file->layered || good;
    return status;
}

/* Which layer a new row is in. */
static bool layer_write(struct remarks_file *file, long long id, int layer)
{
    sqlite3_stmt *s = NULL;
    const bool good =
        sqlite3_prepare_v2(file->db, "INSERT OR REPLACE INTO in_layer VALUES(?,?)", -1, &s,
                           NULL) == SQLITE_OK &&
        sqlite3_bind_int64(s, 1, id) == SQLITE_OK &&
        sqlite3_bind_int(s, 2, layer) == SQLITE_OK && sqlite3_step(s) == SQLITE_DONE;
    sqlite3_finalize(s);
    return good;
}

enum reader_status remarks_file_write(struct remarks_file *file, struct remark_row *row)
{
    sqlite3_stmt *s = NULL;
    unsigned char *anchor = NULL;
    size_t bytes = 0;
    if (file->read_only)
        return reader_fail(READER_FAILED, "%s can be read only", file->path);
    enum reader_status status = file->db ? READER_OK : make(file);
    if (status == READER_OK)
        status = reader_anchor_keep(row->anchor, &anchor, &bytes);
    if (status != READER_OK)
        return status;
    const bool both = row->id == 0 && row->remark.layer > 0; /* both, or neither */
    bool good = (!both || run(file, "BEGIN IMMEDIATE")) &&
                sqlite3_prepare_v2(
                    file->db, "INSERT OR REPLACE INTO remark VALUES(?,?,?,?,?,?,?,?,?,?,?,?)",
                    -1, &s, NULL) == SQLITE_OK &&
                row_bind(s, row, anchor, bytes) && sqlite3_step(s) == SQLITE_DONE;
    const long long id = good ? sqlite3_last_insert_rowid(file->db) : 0;
    if (both)
        good = good && sqlite3_reset(s) == SQLITE_OK &&
               layer_write(file, id, row->remark.layer) && run(file, "COMMIT");
    if (!good)
        status = file_fail(file);
    else if (row->id == 0)
        row->id = id;
    sqlite3_finalize(s);
    if (both && !good)
        run(file, "ROLLBACK");
    free(anchor);
    return status;
}

enum reader_status remarks_file_sync(struct remarks_file *file)
{
    if (!file->db || file->read_only)
        return READER_OK;
    const int code =
        sqlite3_wal_checkpoint_v2(file->db, NULL, SQLITE_CHECKPOINT_PASSIVE, NULL, NULL);
    return code == SQLITE_OK || code == SQLITE_BUSY ? READER_OK : file_fail(file);
}
