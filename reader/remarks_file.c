/* remarks_file.c - remarks in a file of SQLite: see remarks_internal.h.
 *
 * What is in such a file may have been written by anybody. So nothing in it is run (no
 * triggers, no views, a schema that is exactly ours), and each row is checked as it is read. */
#include "remarks_file_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    APPLICATION = 0x4c55524d, /* of the file's head, so that it is known what it is */
    LENGTH_MOST = 16 << 20,   /* bytes of a value */
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

/* Of ink that is scaled, hangs on another's anchor, or is in a group; 0: in none. */
static const char arranged_schema[] =
    "CREATE TABLE arranged(remark INTEGER PRIMARY KEY, scale_x REAL NOT NULL, scale_y REAL NOT "
    "NULL, hangs INTEGER NOT NULL, grouped INTEGER NOT NULL)";

/* Of ink that text flows around: from which edge of its column it is counted; 0: no longer. */
static const char around_schema[] = "CREATE TABLE around(remark INTEGER PRIMARY KEY, side "
                                    "INTEGER NOT NULL)";

/* Every table that there is, and the version that it came with. */
static const struct {
    const char *name, *schema;
    int version;
} tables[] = {{"remark", schema, REMARKS_PLAIN},
              {"layer", layer_schema, REMARKS_LAYERED},
              {"in_layer", in_layer_schema, REMARKS_LAYERED},
              {"arranged", arranged_schema, REMARKS_ARRANGED},
              {"around", around_schema, REMARKS_AROUND}};
enum { TABLES = sizeof tables / sizeof *tables };

static enum reader_status file_fail(const struct remarks_file *file)
{
    const int code = file->db ? sqlite3_errcode(file->db) : SQLITE_OK;
    if (code == SQLITE_BUSY || code == SQLITE_LOCKED)
        return reader_fail(READER_FAILED,
                           "%s: another program has been writing it for %d seconds: try again",
                           file->path, BUSY_MS / 1000);
    return reader_fail(READER_FAILED, "%s: %s", file->path,
                       file->db ? sqlite3_errmsg(file->db) : "it cannot be opened");
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

/* It has the tables of its version, and nothing else. */
static bool tables_are(struct remarks_file *file)
{
    int count = 0;
    bool good = true;
    for (int i = 0; i < TABLES && good; i++)
        if (tables[i].version <= file->version) {
            char sql[80];
            snprintf(sql, sizeof sql, "SELECT sql FROM sqlite_schema WHERE name='%s'",
                     tables[i].name);
            good = text_is(file, sql, tables[i].schema);
            count++;
        }
    return good && number_of(file, "SELECT count(*) FROM sqlite_schema WHERE name NOT LIKE "
                                   "'sqlite_%'") == count;
}

/* Within a transaction: the file is of that version at least, whoever has made it so. */
static bool version_raise(struct remarks_file *file, int version)
{
    char pragma[60];
    const int now = (int)number_of(file, "PRAGMA user_version");
    bool good = now >= 0;
    for (int i = 0; i < TABLES && good; i++)
        if (tables[i].version > now && tables[i].version <= version)
            good = run(file, tables[i].schema);
    snprintf(pragma, sizeof pragma, "PRAGMA user_version=%d", version);
    return good && (now >= version || run(file, pragma));
}

/* That it is a file of ours, whole, and of a version that is known. */
static enum reader_status check(struct remarks_file *file)
{
    const long long application = number_of(file, "PRAGMA application_id"),
                    version = number_of(file, "PRAGMA user_version");
    if (application != APPLICATION)
        return remarks_foreign(file, application < 0 ? sqlite3_errmsg(file->db)
                                                     : "this is another program's file");
    if (version > REMARKS_AROUND)
        return remarks_foreign(file, "this file is of a newer version");
    file->version = (int)version;
    if (version < REMARKS_PLAIN || !tables_are(file))
        return remarks_foreign(file, "this file is not as notes are");
    if (!text_is(file, "PRAGMA quick_check(1)", "ok"))
        return remarks_foreign(file, "this file is damaged");
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
    char pragma[60];
    if (sqlite3_open_v2(file->path, &file->db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE,
                        NULL) != SQLITE_OK) {
        enum reader_status status = file_fail(file);
        sqlite3_close(file->db);
        file->db = NULL;
        return status;
    }
    guard(file);
    journal(file);
    snprintf(pragma, sizeof pragma, "PRAGMA application_id=%d", APPLICATION);
    const bool good = run(file, "BEGIN IMMEDIATE") &&
                      (number_of(file, "SELECT count(*) FROM sqlite_schema") > 0 ||
                       (run(file, pragma) && version_raise(file, REMARKS_PLAIN))) &&
                      run(file, "COMMIT");
    enum reader_status status = good ? check(file) : file_fail(file);
    if (status != READER_OK) {
        sqlite3_close(file->db);
        file->db = NULL;
    }
    return status;
}

/* Nothing was ever written to it. */
static bool is_empty(struct remarks_file *file)
{
    return number_of(file, "SELECT count(*) FROM sqlite_schema") == 0 &&
           number_of(file, "PRAGMA application_id") == 0 &&
           number_of(file, "PRAGMA user_version") == 0;
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
    if (is_empty(file)) { /* as one that another program is about to make */
        sqlite3_close(file->db);
        file->db = NULL;
        return READER_OK;
    }
    enum reader_status status = check(file);
    if (status == READER_OK)
        journal(file);
    return status;
}

/* ---- all of it ---- */

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
    if (status == READER_OK && file->version >= REMARKS_LAYERED)
        status = remarks_layers_read(file, layers);
    if (status == READER_OK && file->db)
        status = remarks_rows_read(file, rows, layers);
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

static bool layer_insert(struct remarks_file *file, int number, const char *name)
{
    sqlite3_stmt *s = NULL;
    const bool good = sqlite3_prepare_v2(file->db, "INSERT INTO layer VALUES(?,?)", -1, &s,
                                         NULL) == SQLITE_OK &&
                      sqlite3_bind_int(s, 1, number) == SQLITE_OK &&
                      sqlite3_bind_text(s, 2, name, -1, SQLITE_STATIC) == SQLITE_OK &&
                      sqlite3_step(s) == SQLITE_DONE;
    sqlite3_finalize(s);
    return good;
}

/* Within a transaction, so that no other program adds one meanwhile. */
static enum reader_status layer_make(struct remarks_file *file, const char *name,
                                     struct remark_layers *layers, int *layer)
{
    if (!version_raise(file, REMARKS_LAYERED))
        return file_fail(file);
    enum reader_status status = remarks_layers_read(file, layers);
    if (status != READER_OK)
        return status;
    for (*layer = 1; *layer < layers->count; ++*layer)
        if (strcmp(layers->names[*layer], name) == 0)
            return READER_OK; /* another program has made it */
    if (layers->count == READER_LAYERS_MAX)
        return reader_fail(READER_TOO_LARGE, "notes have up to %d layers", READER_LAYERS_MAX);
    if (!layer_insert(file, layers->count, name))
        return file_fail(file);
    memcpy(layers->names[layers->count++], name, strlen(name) + 1);
    return READER_OK;
}

/* Begins a change of a file that can be written. */
static enum reader_status change_begin(struct remarks_file *file)
{
    if (file->read_only)
        return reader_fail(READER_FAILED, "%s can be read only", file->path);
    enum reader_status status = file->db ? READER_OK : make(file);
    if (status == READER_OK && !run(file, "BEGIN IMMEDIATE"))
        status = file_fail(file);
    return status;
}

/* All of it is in the file, or nothing. */
static enum reader_status change_end(struct remarks_file *file, enum reader_status status)
{
    if (status == READER_OK && !run(file, "COMMIT"))
        status = file_fail(file);
    if (status != READER_OK)
        run(file, "ROLLBACK");
    else
        file->version = (int)number_of(file, "PRAGMA user_version");
    return status;
}

enum reader_status remarks_file_layer(struct remarks_file *file, const char *name,
                                      struct remark_layers *layers, int *layer)
{
    struct remark_layers now = *layers;
    enum reader_status status = change_begin(file);
    if (status != READER_OK)
        return status;
    now.count = 1;
    status = change_end(file, layer_make(file, name, &now, layer));
    if (status == READER_OK)
        *layers = now;
    return status;
}

/* ---- arranging ---- */

static bool moved_write(struct remarks_file *file, long long id,
                        const struct reader_arranged *to)
{
    sqlite3_stmt *s = NULL;
    const bool good = sqlite3_prepare_v2(file->db, "UPDATE remark SET x=?, y=? WHERE id=?", -1,
                                         &s, NULL) == SQLITE_OK &&
                      sqlite3_bind_double(s, 1, to->x) == SQLITE_OK &&
                      sqlite3_bind_double(s, 2, to->y) == SQLITE_OK &&
                      sqlite3_bind_int64(s, 3, id) == SQLITE_OK &&
                      sqlite3_step(s) == SQLITE_DONE;
    sqlite3_finalize(s);
    return good;
}

static bool arranged_write(struct remarks_file *file, const struct remark_rows *rows,
                           const struct reader_arranged *to)
{
    sqlite3_stmt *s = NULL;
    const bool good =
        sqlite3_prepare_v2(file->db, "INSERT OR REPLACE INTO arranged VALUES(?,?,?,?,?)", -1,
                           &s, NULL) == SQLITE_OK &&
        sqlite3_bind_int64(s, 1, rows->rows[to->index].id) == SQLITE_OK &&
        sqlite3_bind_double(s, 2, to->scale_x) == SQLITE_OK &&
        sqlite3_bind_double(s, 3, to->scale_y) == SQLITE_OK &&
        sqlite3_bind_int64(s, 4, rows->rows[to->hangs].id) == SQLITE_OK &&
        sqlite3_bind_int64(s, 5, to->group < 0 ? 0 : rows->rows[to->group].id) == SQLITE_OK &&
        sqlite3_step(s) == SQLITE_DONE;
    sqlite3_finalize(s);
    return good;
}

static bool around_write(struct remarks_file *file, long long id, enum reader_around around)
{
    sqlite3_stmt *s = NULL;
    const bool good = sqlite3_prepare_v2(file->db, "INSERT OR REPLACE INTO around VALUES(?,?)",
                                         -1, &s, NULL) == SQLITE_OK &&
                      sqlite3_bind_int64(s, 1, id) == SQLITE_OK &&
                      sqlite3_bind_int(s, 2, (int)around) == SQLITE_OK &&
                      sqlite3_step(s) == SQLITE_DONE;
    sqlite3_finalize(s);
    return good;
}

/* Where no ink was ever so, that it is not is not kept. */
static bool around_keep(struct remarks_file *file, const struct remark_rows *rows,
                        const struct reader_arranged *to)
{
    const bool kept = number_of(file, "PRAGMA user_version") >= REMARKS_AROUND;
    if (!kept && to->around == READER_AROUND_NOT)
        return true;
    return (kept || version_raise(file, REMARKS_AROUND)) &&
           around_write(file, rows->rows[to->index].id, to->around);
}

/* What is moved and nothing else needs no later version. */
static bool is_only_moved(const struct reader_arranged *to)
{
    return to->scale_x == 1 && to->scale_y == 1 && to->hangs == to->index && to->group < 0;
}

enum reader_status remarks_file_arrange(struct remarks_file *file,
                                        const struct remark_rows *rows,
                                        const struct reader_arranged *to, int count)
{
    enum reader_status status = change_begin(file);
    bool good = true;
    if (status != READER_OK)
        return status;
    for (int i = 0; i < count && good; i++) {
        const bool kept = number_of(file, "PRAGMA user_version") >= REMARKS_ARRANGED;
        good = moved_write(file, rows->rows[to[i].index].id, &to[i]) &&
               (kept || is_only_moved(&to[i]) || version_raise(file, REMARKS_ARRANGED)) &&
               ((!kept && is_only_moved(&to[i])) || arranged_write(file, rows, &to[i])) &&
               around_keep(file, rows, &to[i]);
    }
    return change_end(file, good ? READER_OK : file_fail(file));
}

/* ---- rows ---- */

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
                remark_row_bind(s, row, anchor, bytes) && sqlite3_step(s) == SQLITE_DONE;
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
