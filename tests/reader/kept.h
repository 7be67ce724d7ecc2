/* kept.h - a document's text and a file of remarks to it, for tests.
 *
 *     struct reader_remarks *remarks = kept_open(kept_text);
 *     kept_add(remarks, &what, "bridge held"); */
#ifndef LUTETIA_TEST_KEPT_H
#define LUTETIA_TEST_KEPT_H

#include <reader_remarks.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <sqlite3.h>

extern char kept_path[100];
extern const char kept_text[];

/* Found in a text. */
struct reader_remarks *kept_open(const char *plain);
/* At the first place of what is quoted. */
int kept_add(struct reader_remarks *remarks, const struct reader_remark *what,
             const char *quotation);
enum reader_status kept_move(struct reader_remarks *remarks, int i, double x, double y);
void kept_quotation_is(const struct reader_remark *r, const char *quotation);
char *kept_read(size_t *count); /* the caller frees it */
void kept_write(const char *bytes, size_t count);
/* Refused with one line that has the path and says that, and not changed. */
void kept_is_refused(const char *says);
void kept_sql(const char *sql);
/* There is no file. */
int kept_begin(void **state);
/* Runs them in a folder that goes again. */
int kept_group(const char *name, const struct CMUnitTest *tests, size_t count);
#define kept_all(tests, count) kept_group(#tests, tests, count)

#endif
