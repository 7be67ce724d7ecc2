/* test_journal.c - journals: cut at every byte what is whole of them is there again; they go on
 * where they were cut, and a disk that is full loses nothing. */
#include <brush.h>
#include <journal.h>

#include "state_sample.h"

#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

enum { FIBERS = SAMPLE_WIDTH * SAMPLE_HEIGHT, ENTRIES_MAX = 64 };

static char folder[] = "/tmp/lutetia-journal-XXXXXX", path[64], cut_path[64], state_path[64];

static int folder_make(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/a.journal", folder);
    snprintf(cut_path, sizeof cut_path, "%s/cut.journal", folder);
    snprintf(state_path, sizeof state_path, "%s/a.h5", folder);
    return 0;
}

static int folder_remove(void **state)
{
    (void)state;
    unlink(path);
    unlink(cut_path);
    unlink(state_path);
    return rmdir(folder);
}

/* What can be told of a sheet without computing it. */
struct place {
    long long bytes; /* of the journal */
    int done, undone;
    long steps;
};

static struct place place_of(const struct paper_sheet *sheet)
{
    struct stat status = {0};
    assert_int_equal(stat(path, &status), 0);
    return (struct place){(long long)status.st_size, paper_history_done(sheet),
                          paper_history_undone(sheet), paper_sheet_steps(sheet)};
}

static void same_planes(struct paper_sheet *a, struct paper_sheet *b)
{
    static uint32_t words[2][FIBERS];
    struct paper_plane planes[PAPER_PLANES_MAX];
    for (int i = paper_sheet_planes(a, planes) - 1; i >= 0; i--) {
        sample_check(paper_sheet_plane_read(a, i, words[0]));
        sample_check(paper_sheet_plane_read(b, i, words[1]));
        assert_memory_equal(words[0], words[1], sizeof words[0]);
    }
}

static void steps(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++)
        sample_check(paper_sheet_step(sheet));
}

static void stroke(struct paper_sheet *sheet)
{
    sample_check(paper_sheet_stroke_begin(sheet, 0, 60));
    for (int i = 0; i < 5; i++)
        sample_check(paper_sheet_stroke_add(
            sheet,
            &(struct paper_stroke_sample){
                .time_s = 0.02 * i, .x = 3 + 2 * i, .y = 6, .pressure = 0.7},
            1, NULL));
    sample_check(paper_sheet_stroke_end(sheet, NULL));
}

/* The n-th thing that is done, an entry or more each; false: there is no more. */
static bool something_do(struct paper_sheet *sheet, int n)
{
    struct paper_brush brush = paper_brush_default();
    brush.bristles = 9;
    brush.width = brush.depth = 4;
    switch (n) {
    case 0:
    case 6:
        sample_turn(sheet, n / 3, 3);
        return true;
    case 1:
        sample_check(paper_sheet_brush(sheet, &brush));
        return true;
    case 2:
        sample_check(paper_sheet_dip(
            sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {1, 0.4, 0.2}}));
        return true;
    case 3:
    case 9:
        stroke(sheet);
        return true;
    case 4:
    case 10:
        steps(sheet, 4);
        return true;
    case 5:
        assert_int_equal(paper_history_undo(sheet, 2), 2);
        return true;
    case 7:
        sample_check(paper_history_insert_begin(sheet, 1));
        steps(sheet, 1);
        return true;
    case 8:
        sample_check(paper_sheet_blot(sheet, NULL, 0, 0, 0.5, 0));
        sample_check(paper_history_insert_end(sheet, true));
        return true;
    case 11:
        steps(sheet, 2); /* joined to those before */
        return true;
    case 12:
        paper_history_mark(sheet);
        steps(sheet, 2);
        return true;
    case 13:
        sample_check(paper_history_seek(sheet, 6));
        return true;
    case 14:
        assert_int_equal(paper_history_redo(sheet, 1), 1);
        return true;
    default:
        return false;
    }
}

static void what_is_whole_is_there_again(void **state)
{
    struct place places[ENTRIES_MAX];
    int count = 1;
    struct paper_journal *journal;
    struct paper_sheet *sheet = sample_sheet(3);
    (void)state;
    sample_check(paper_journal_begin(sheet, path, NULL, &journal));
    places[0] = place_of(sheet);
    for (int i = 0; something_do(sheet, i); i++) {
        sample_check(paper_journal_sync(journal));
        places[count++] = place_of(sheet);
    }
    sample_check(paper_journal_close(journal));
    size_t bytes_count;
    uint8_t *bytes = sample_file_read(path, &bytes_count);
    int compared = 0;
    for (size_t n = 0; n <= bytes_count; n++) {
        struct paper_journal_found found;
        struct paper_sheet *again;
        sample_file_write(cut_path, bytes, n);
        const enum paper_status status =
            paper_journal_open(cut_path, NULL, 1e6, &found, &again);
        if ((long long)n < places[0].bytes) {
            assert_int_equal(status, PAPER_BAD_FILE);
            assert_null(again);
            continue;
        }
        sample_check(status);
        assert_true(found.continues && found.bytes == (long long)n);
        assert_true(found.whole <= (long long)n);
        assert_int_equal(found.why[0] == 0, found.whole == (long long)n);
        for (int i = 0; i < count; i++)
            if (places[i].bytes == found.whole && !found.inserting) {
                assert_int_equal(paper_history_done(again), places[i].done);
                assert_int_equal(paper_history_undone(again), places[i].undone);
                assert_int_equal(paper_sheet_steps(again), places[i].steps);
                compared++;
            }
        if (n == bytes_count)
            same_planes(sheet, again);
        paper_sheet_destroy(again);
    }
    assert_true(compared > 100 && count == 16);
    free(bytes);
    paper_sheet_destroy(sheet);
}

static void it_continues_its_state_and_no_other(void **state)
{
    struct paper_journal *journal;
    struct paper_journal_found found;
    struct paper_sheet *sheet = sample_sheet(3), *again;
    (void)state;
    for (int i = 0; i < 4; i++)
        something_do(sheet, i);
    sample_check(paper_state_save(state_path, &(struct paper_state_sheet){1, sheet}, 1));
    sample_check(paper_journal_begin(sheet, path, state_path, &journal));
    assert_int_equal(
        paper_journal_begin(sheet, cut_path, state_path, &(struct paper_journal *){0}),
        PAPER_BAD_ARGUMENT);
    for (int i = 4; i < 9; i++)
        something_do(sheet, i);
    sample_check(paper_journal_close(journal));
    sample_check(paper_journal_open(path, state_path, 1e6, &found, &again));
    assert_true(found.continues && found.why[0] == 0);
    same_planes(sheet, again);
    paper_sheet_destroy(again);

    sample_check(paper_state_save(state_path, &(struct paper_state_sheet){1, sheet}, 1));
    sample_check(paper_journal_open(path, state_path, 1e6, &found, &again));
    assert_false(found.continues);
    assert_non_null(strstr(found.why, "another state"));
    same_planes(sheet, again);
    paper_sheet_destroy(again);
    unlink(path);
    sample_check(paper_journal_open(path, state_path, 1e6, &found, &again));
    assert_true(!found.continues && found.bytes == 0);
    paper_sheet_destroy(again);
    assert_int_equal(paper_journal_open(path, NULL, 1e6, &found, &again), PAPER_BAD_ARGUMENT);
    paper_sheet_destroy(sheet);
}

/* Cut in the middle of an insertion, it goes on: what had been inserted stays. */
static void it_goes_on_where_it_was_cut(void **state)
{
    struct paper_journal *journal;
    struct paper_journal_found found;
    struct paper_sheet *sheet = sample_sheet(3), *again, *third;
    (void)state;
    sample_check(paper_journal_begin(sheet, path, NULL, &journal));
    for (int i = 0; i < 8; i++)
        something_do(sheet, i);
    sample_check(paper_journal_close(journal));
    paper_sheet_destroy(sheet);
    FILE *file = fopen(path, "ab");
    assert_true(file && fputs("half an entry", file) >= 0 && fclose(file) == 0);

    sample_check(paper_journal_open(path, NULL, 1e6, &found, &again));
    assert_true(found.inserting && found.bytes == found.whole + 13 && found.why[0]);
    sample_check(paper_journal_continue(again, path, &found, &journal));
    for (int i = 9; i < 13; i++)
        something_do(again, i);
    sample_check(paper_journal_close(journal));
    sample_check(paper_journal_open(path, NULL, 1e6, &found, &third));
    assert_true(!found.inserting && found.why[0] == 0);
    assert_int_equal(paper_history_done(again), paper_history_done(third));
    same_planes(again, third);
    paper_sheet_destroy(again);
    paper_sheet_destroy(third);
}

/* Another thread syncs as fast as it can. */
struct keeper {
    struct paper_journal *journal;
    atomic_bool stop;
    int failed;
};

static void *keep(void *context)
{
    struct keeper *k = context;
    while (!atomic_load(&k->stop))
        k->failed += paper_journal_sync(k->journal) != PAPER_OK;
    return NULL;
}

static void another_thread_syncs(void **state)
{
    struct keeper keeper = {0};
    struct paper_journal_found found;
    struct paper_sheet *sheet = sample_sheet(3), *again;
    pthread_t thread;
    (void)state;
    sample_check(paper_journal_begin(sheet, path, NULL, &keeper.journal));
    assert_int_equal(pthread_create(&thread, NULL, keep, &keeper), 0);
    for (int i = 0; something_do(sheet, i); i++)
        steps(sheet, i < 12 ? 3 : 0); /* none after a way back */
    atomic_store(&keeper.stop, true);
    pthread_join(thread, NULL);
    assert_int_equal(keeper.failed, 0);
    sample_check(paper_journal_close(keeper.journal));
    sample_check(paper_journal_open(path, NULL, 1e6, &found, &again));
    assert_int_equal(found.why[0], 0);
    assert_int_equal(paper_history_done(sheet), paper_history_done(again));
    same_planes(sheet, again);
    paper_sheet_destroy(again);
    paper_sheet_destroy(sheet);
}

static void a_full_disk_loses_nothing(void **state)
{
    struct paper_journal *journal;
    struct paper_journal_found found;
    struct paper_sheet *sheet = sample_sheet(3), *again;
    struct rlimit limit;
    (void)state;
    sample_check(paper_journal_begin(sheet, path, NULL, &journal));
    something_do(sheet, 0);
    sample_check(paper_journal_sync(journal));
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    struct rlimit less = limit;
    less.rlim_cur = (rlim_t)place_of(sheet).bytes + 20; /* less than the next entry */
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &less), 0);
    for (int i = 1; i < 7; i++) {
        something_do(sheet, i);
        assert_int_equal(paper_journal_sync(journal), PAPER_BAD_ARGUMENT);
    }
    sample_check(paper_journal_open(path, NULL, 1e6, &found, &again)); /* what was whole */
    assert_true(found.entries > 0 && found.why[0]);
    paper_sheet_destroy(again);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    sample_check(paper_journal_close(journal));
    sample_check(paper_journal_open(path, NULL, 1e6, &found, &again));
    assert_int_equal(found.why[0], 0);
    same_planes(sheet, again);
    paper_sheet_destroy(again);
    paper_sheet_destroy(sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_whole_is_there_again),
        cmocka_unit_test(it_continues_its_state_and_no_other),
        cmocka_unit_test(it_goes_on_where_it_was_cut),
        cmocka_unit_test(another_thread_syncs),
        cmocka_unit_test(a_full_disk_loses_nothing),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
