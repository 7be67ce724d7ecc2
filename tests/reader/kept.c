/* kept.c - see kept.h. */
#include "kept.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/lutetia-remarks-XXXXXX";
char kept_path[100];
const char kept_text[] =
    "# The marsh\n\nBefore it was a town it was a marsh. The river ran slowly.\n\n"
    "# The town\n\nIt was a town before long. The river ran slowly, and the bridge held.\n\n";

struct reader_remarks *kept_open(const char *plain)
{
    struct reader_remarks *remarks;
    if (reader_remarks_open(kept_path, &remarks) != READER_OK ||
        reader_remarks_find(remarks, plain, strlen(plain)) != READER_OK)
        fail_msg("%s", reader_error());
    return remarks;
}

int kept_add(struct reader_remarks *remarks, const struct reader_remark *what,
             const char *quotation)
{
    const size_t begin = (size_t)(strstr(kept_text, quotation) - kept_text);
    int index;
    if (reader_remarks_add(remarks, what, kept_text, strlen(kept_text), begin,
                           begin + strlen(quotation), &index) != READER_OK)
        fail_msg("%s", reader_error());
    return index;
}

enum reader_status kept_move(struct reader_remarks *remarks, int i, double x, double y)
{
    struct reader_arranged to = reader_remarks_arranged(remarks, i);
    to.x = x;
    to.y = y;
    return reader_remarks_arrange(remarks, &to, 1);
}

void kept_quotation_is(const struct reader_remark *r, const char *quotation)
{
    size_t bytes;
    const char *quoted = reader_anchor_quotation(r->anchor, &bytes);
    assert_int_equal(bytes, strlen(quotation));
    assert_memory_equal(quoted, quotation, bytes);
}

char *kept_read(size_t *count)
{
    FILE *file = fopen(kept_path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *count = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*count + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *count, file), *count);
    fclose(file);
    return bytes;
}

void kept_write(const char *bytes, size_t count)
{
    FILE *file = fopen(kept_path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    fclose(file);
}

/* Refused with one line that has the kept_path and says that, and not changed. */
void kept_is_refused(const char *says)
{
    struct reader_remarks *remarks;
    size_t before_count, after_count;
    char *before = kept_read(&before_count);
    assert_int_equal(reader_remarks_open(kept_path, &remarks), READER_FAILED);
    assert_null(remarks);
    if (!strstr(reader_error(), kept_path) || !strstr(reader_error(), says) ||
        strchr(reader_error(), '\n'))
        fail_msg("it said: %s", reader_error());
    char *after = kept_read(&after_count);
    assert_int_equal(before_count, after_count);
    assert_memory_equal(before, after, before_count);
    free(before);
    free(after);
}

void kept_sql(const char *sql)
{
    sqlite3 *db;
    assert_int_equal(sqlite3_open(kept_path, &db), SQLITE_OK);
    if (sqlite3_exec(db, sql, NULL, NULL, NULL) != SQLITE_OK)
        fail_msg("%s: %s", sql, sqlite3_errmsg(db));
    sqlite3_close(db);
}

int kept_begin(void **state)
{
    (void)state;
    char other[120];
    unlink(kept_path);
    snprintf(other, sizeof other, "%s-wal", kept_path);
    unlink(other);
    snprintf(other, sizeof other, "%s-shm", kept_path);
    unlink(other);
    return 0;
}

int kept_group(const char *name, const struct CMUnitTest *tests, size_t count)
{
    if (!mkdtemp(folder))
        return 1;
    snprintf(kept_path, sizeof kept_path, "%s/marsh.md.notes", folder);
    const int status = _cmocka_run_group_tests(name, tests, count, NULL, NULL);
    kept_begin(NULL);
    rmdir(folder);
    return status;
}
