/* test_studio_found.c - journals that were left behind and cannot be gone on with: of another
 * sheet, or damaged. The sheet opens all the same, a line says what is wrong, and the journal's
 * bytes stay under another name. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <linux/capability.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "../clock.h"
#include "studio_paper.h"
#include "studio_scene.h"

enum { WAIT_S = 100, BYTES_MOST = 1 << 22 };
static char folder[] = "/tmp/lutetia-found-XXXXXX";

static void wake(void *context)
{
    (void)context;
}

static const char *named(const char *name)
{
    static char paths[4][200];
    static int turn;
    char *path = paths[turn++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static struct studio_paper *begin(const char *path, const char *found)
{
    const struct paper_sheet_config config = scene_config();
    struct studio_paper *paper = studio_paper_start(
        &(struct studio_paper_def){&config, path, found, folder, 64e6, wake, NULL});
    assert_non_null(paper);
    return paper;
}

/* What is reported once there is a sheet, or will be none. */
static struct studio_report opened(struct studio_paper *paper)
{
    struct studio_report report = {0};
    const double until_s = clock_now_s() + WAIT_S;
    while (!report.ready && !report.failed && clock_now_s() < until_s) {
        usleep(2000);
        studio_paper_report(paper, &report);
    }
    return report;
}

static size_t file_get(const char *path, char *bytes)
{
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    const size_t count = fread(bytes, 1, BYTES_MOST, in);
    fclose(in);
    return count;
}

static void file_put(const char *path, const char *bytes, size_t count)
{
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, count, out), count);
    assert_int_equal(fclose(out), 0);
}

/* A sheet in a file, dried after it was saved; as if the studio had been killed then. */
static void sheet_leave(const char *path, bool dried_before)
{
    struct studio_paper *paper = begin(NULL, NULL);
    if (dried_before)
        studio_paper_send(paper, (struct studio_message){.kind = STUDIO_MESSAGE_DRY});
    studio_paper_send(
        paper, (struct studio_message){.kind = STUDIO_MESSAGE_SAVE, .text = strdup(path)});
    studio_paper_send(paper, (struct studio_message){.kind = STUDIO_MESSAGE_DRY});
    struct studio_report last;
    studio_paper_end(paper, false, &last);
    assert_string_equal(last.error, "");
    assert_true(last.changed);
}

/* The sheet is there, and the journal has another name. */
static void is_kept(struct studio_paper *paper, const char *kept, const char *bytes,
                    size_t count)
{
    static char now[BYTES_MOST];
    struct studio_report report = opened(paper);
    assert_true(report.ready);
    assert_false(report.failed);
    assert_false(report.found_again);
    assert_non_null(strstr(report.error, "is kept: "));
    assert_non_null(strstr(report.error, kept));
    studio_paper_end(paper, true, NULL);
    assert_int_equal(file_get(kept, now), count);
    assert_memory_equal(now, bytes, count);
}

static void journals_of_others_are_kept(void **state)
{
    (void)state;
    static char journal[BYTES_MOST];
    sheet_leave(named("one.h5"), false);
    sheet_leave(named("other.h5"), true);
    /* each goes on in its own */
    struct studio_paper *paper = begin(named("other.h5"), NULL);
    struct studio_report report = opened(paper);
    assert_true(report.ready && report.found_again);
    assert_string_equal(report.error, "");
    assert_int_equal(report.operations, 2);
    studio_paper_end(paper, false, NULL);
    const size_t count = file_get(named("other.h5.journal"), journal);
    for (int again = 0; again < 2; again++) {
        file_put(named("one.h5.journal"), journal, count);
        is_kept(begin(named("one.h5"), NULL),
                named(again ? "one.h5.journal.kept-2" : "one.h5.journal.kept"), journal, count);
    }
    /* its end is missing: what is whole is there again */
    file_put(named("other.h5.journal"), journal, count - 1);
    paper = begin(named("other.h5"), NULL);
    report = opened(paper);
    assert_true(report.ready);
    assert_int_equal(report.operations, 1);
    assert_non_null(strstr(report.error, "but for its end"));
    studio_paper_end(paper, true, NULL);
}

/* Two studios and one file: the second one is told, opens nothing and writes nothing there;
 * what the first one has done stays. */
static void one_studio_a_file(void **state)
{
    (void)state;
    static char journal[BYTES_MOST], now[BYTES_MOST];
    sheet_leave(named("held.h5"), false);
    const size_t count = file_get(named("held.h5.journal"), journal);
    FILE *first = fopen(named("held.h5.journal"), "r");
    assert_non_null(first);
    assert_int_equal(flock(fileno(first), LOCK_EX | LOCK_NB), 0);
    struct studio_paper *paper = begin(named("held.h5"), NULL);
    struct studio_report report = opened(paper);
    assert_true(report.failed && !report.ready);
    assert_non_null(strstr(report.error, "held.h5: another studio has it open"));
    studio_paper_end(paper, true, NULL);
    paper = begin(NULL, NULL); /* nor is it written to */
    studio_paper_send(paper, (struct studio_message){.kind = STUDIO_MESSAGE_SAVE,
                                                     .text = strdup(named("held.h5"))});
    studio_paper_end(paper, true, &report);
    assert_non_null(strstr(report.error, "another studio has it open"));
    assert_int_equal(file_get(named("held.h5.journal"), now), count);
    assert_memory_equal(now, journal, count);
    fclose(first);
    paper = begin(named("held.h5"), NULL); /* it has been closed there */
    report = opened(paper);
    assert_true(report.ready && report.found_again);
    first = fopen(named("held.h5.journal"), "r");
    assert_non_null(first);
    assert_int_equal(flock(fileno(first), LOCK_EX | LOCK_NB), -1); /* this one holds it now */
    fclose(first);
    studio_paper_send(paper, (struct studio_message){.kind = STUDIO_MESSAGE_SAVE,
                                                     .text = strdup(named("held.h5"))});
    studio_paper_end(paper, true, &report); /* its own file it may write */
    assert_string_equal(report.error, "");
    assert_false(report.changed);
}

static void damaged_journals_are_kept(void **state)
{
    (void)state;
    static const char damaged[] = "this is no journal";
    file_put(named("sheet-1-1.journal"), damaged, sizeof damaged);
    is_kept(begin(NULL, named("sheet-1-1.journal")), named("sheet-1-1.journal.kept"), damaged,
            sizeof damaged);
    file_put(named("one.h5.journal"), damaged, sizeof damaged);
    is_kept(begin(named("one.h5"), NULL), named("one.h5.journal.kept-3"), damaged,
            sizeof damaged);
}

/* ---- a folder in which nobody may write ---- */

/* Who may write everywhere does not for as long as it is closed; threads that are begun then
 * neither. */
static void folder_close(bool closed)
{
    struct __user_cap_header_struct header = {_LINUX_CAPABILITY_VERSION_3, 0};
    struct __user_cap_data_struct data[_LINUX_CAPABILITY_U32S_3];
    assert_int_equal(syscall(SYS_capget, &header, data), 0);
    if (closed)
        data[0].effective &= ~(1u << CAP_DAC_OVERRIDE);
    else
        data[0].effective |= data[0].permitted & (1u << CAP_DAC_OVERRIDE);
    assert_int_equal(syscall(SYS_capset, &header, data), 0);
    assert_int_equal(chmod(named("closed"), closed ? 0555 : 0755), 0);
    assert_int_equal(chmod(named("closed/one.h5.journal"), closed ? 0444 : 0644), 0);
}

static struct studio_report answered(struct studio_paper *paper, unsigned long number)
{
    struct studio_report report = {0};
    const double until_s = clock_now_s() + WAIT_S;
    while (report.answered < number && clock_now_s() < until_s) {
        usleep(2000);
        studio_paper_report(paper, &report);
    }
    assert_true(report.answered >= number);
    return report;
}

/* A sheet there opens, with what its journal tells; that nothing can be kept is said; what
 * is saved there is refused, the file and the journal stay, and elsewhere it is saved. */
static void closed_folder_loses_nothing(void **state)
{
    (void)state;
    static char sheet[BYTES_MOST], journal[BYTES_MOST], now[BYTES_MOST];
    assert_int_equal(mkdir(named("closed"), 0755), 0);
    sheet_leave(named("closed/one.h5"), false);
    const size_t count = file_get(named("closed/one.h5"), sheet),
                 told = file_get(named("closed/one.h5.journal"), journal);
    folder_close(true);
    struct studio_paper *paper = begin(named("closed/one.h5"), NULL);
    struct studio_report report = opened(paper);
    assert_true(report.ready && report.found_again);
    assert_int_equal(report.operations, 1);
    assert_non_null(strstr(report.error, "closed/one.h5.journal"));
    assert_non_null(strstr(report.error, "Permission denied"));
    studio_paper_send(paper, (struct studio_message){.kind = STUDIO_MESSAGE_DRY});
    report =
        answered(paper, studio_paper_send(paper, (struct studio_message){
                                                     .kind = STUDIO_MESSAGE_SAVE,
                                                     .text = strdup(named("closed/one.h5"))}));
    assert_non_null(strstr(report.error, "closed/one.h5: "));
    assert_true(report.changed && report.notes == 0);
    report = answered(paper, studio_paper_send(paper, (struct studio_message){
                                                          .kind = STUDIO_MESSAGE_SAVE,
                                                          .text = strdup(named("open.h5"))}));
    if (report.changed || report.notes != 1)
        fail_msg("%s", report.error);
    assert_string_equal(report.path, named("open.h5"));
    studio_paper_end(paper, true, NULL);
    folder_close(false);
    assert_int_equal(file_get(named("closed/one.h5"), now), count);
    assert_memory_equal(now, sheet, count);
    assert_int_equal(file_get(named("closed/one.h5.journal"), now), told);
    assert_memory_equal(now, journal, told);
    paper = begin(named("open.h5"), NULL);
    report = opened(paper);
    assert_true(report.ready);
    assert_int_equal(report.operations, 2);
    studio_paper_end(paper, true, NULL);
}

static int folder_make(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int folder_remove(void **state)
{
    (void)state;
    static const char *const files[] = {"closed/one.h5",
                                        "closed/one.h5.journal",
                                        "open.h5",
                                        "open.h5.journal",
                                        "one.h5",
                                        "other.h5",
                                        "held.h5",
                                        "one.h5.journal.kept",
                                        "one.h5.journal.kept-2",
                                        "one.h5.journal.kept-3",
                                        "sheet-1-1.journal.kept"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        unlink(named(files[i]));
    rmdir(named("closed"));
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(journals_of_others_are_kept),
        cmocka_unit_test(one_studio_a_file),
        cmocka_unit_test(damaged_journals_are_kept),
        cmocka_unit_test(closed_folder_loses_nothing),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
