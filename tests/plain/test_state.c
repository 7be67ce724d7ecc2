/* test_state.c - a saved state loads bit for bit; a file is written whole or not at all;
 * damaged files are refused. */
#include "state_sample.h"

#include "../display/scratch.h"

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "sheet_calls.h"

static void sheets_same(struct paper_sheet *a, struct paper_sheet *b)
{
    static uint32_t ours[SAMPLE_WIDTH * SAMPLE_HEIGHT], theirs[SAMPLE_WIDTH * SAMPLE_HEIGHT];
    struct paper_plane planes[PAPER_PLANES_MAX];
    int count = paper_sheet_planes(a, planes);
    for (int i = 0; i < count; i++) {
        check(paper_sheet_plane_read(a, i, ours));
        check(paper_sheet_plane_read(b, i, theirs));
        if (memcmp(ours, theirs, sizeof ours) != 0)
            fail_msg("%s is not the same", planes[i].name);
    }
    assert_int_equal(paper_sheet_steps(a), paper_sheet_steps(b));
    assert_int_equal(paper_history_done(a), paper_history_done(b));
}

static void sheets_come_back_with_their_past(void **state)
{
    (void)state;
    char path[512];
    snprintf(path, sizeof path, "%s", scratch_path("two.h5"));
    struct paper_sheet *sheets[2] = {sample_sheet(7), sample_sheet(8)}, *back;
    sample_paint(sheets[0], 5);
    sample_paint(sheets[1], 2);
    paper_history_undo(sheets[0], 3); /* what can be redone is saved too */
    check(paper_state_save(path, (struct paper_state_sheet[]){{2, sheets[0]}, {5, sheets[1]}},
                           2));
    struct paper_state *saved;
    check(paper_state_open(path, &saved));
    assert_int_equal(paper_state_count(saved), 2);
    assert_int_equal(paper_state_number(saved, 0), 2);
    assert_int_equal(paper_state_number(saved, 1), 5);
    for (int i = 0; i < 2; i++) {
        struct paper_sheet_config config;
        check(paper_state_describe(saved, i, &config));
        assert_true(paper_sheet_config_same(&config, paper_sheet_get_config(sheets[i])));
        check(paper_state_load(saved, i, false, 1e6, &back));
        sheets_same(back, sheets[i]);
        if (i == 0) {
            assert_int_equal(paper_history_undone(back), 3);
            paper_history_redo(back, 3);
            paper_history_redo(sheets[0], 3);
            sheets_same(back, sheets[0]);
        }
        sample_paint(back, 2);
        sample_paint(sheets[i], 2);
        sheets_same(back, sheets[i]);
        paper_sheet_destroy(back);
        paper_sheet_destroy(sheets[i]);
    }
    paper_state_close(saved);
}

static void a_program_goes_on_where_it_was(void **state)
{
    (void)state;
    char path[512];
    snprintf(path, sizeof path, "%s", scratch_path("middle.h5"));
    struct paper_sheet *whole = sample_sheet(3), *half = sample_sheet(3), *back;
    sample_paint(whole, 6);
    sample_paint(half, 3);
    sample_turn(half, 3, 1); /* in the middle of three steps */
    check(paper_state_save(path, &(struct paper_state_sheet){1, half}, 1));
    struct paper_state *saved;
    check(paper_state_open(path, &saved));
    check(paper_state_load(saved, 0, true, 1e6, &back));
    sample_paint(back, 6);
    assert_false(paper_history_diverged(back));
    sheets_same(back, whole);
    paper_state_close(saved);
    paper_sheet_destroy(back);
    paper_sheet_destroy(half);
    paper_sheet_destroy(whole);
}

static void files_are_whole_or_as_they_were(void **state)
{
    (void)state;
    char path[512], command[700];
    snprintf(path, sizeof path, "%s", scratch_path("whole.h5"));
    struct paper_sheet *sheet = sample_sheet(4), *bare;
    struct paper_sheet_config config = *paper_sheet_get_config(sheet);
    check(paper_state_save(path, &(struct paper_state_sheet){1, sheet}, 1));
    sample_paint(sheet, 3);
    /* a full disk */
    struct rlimit full = {20000, RLIM_INFINITY}, before;
    getrlimit(RLIMIT_FSIZE, &before);
    full.rlim_max = before.rlim_max;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &full);
    enum paper_status status = paper_state_save(path, &(struct paper_state_sheet){1, sheet}, 1);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(status, PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(paper_error(), "cannot write"));
    assert_int_equal(sample_load_all(path), PAPER_OK);
    snprintf(command, sizeof command, "ls '%s'*.part >/dev/null 2>&1", path);
    assert_int_not_equal(system(command), 0);

    assert_int_equal(
        paper_state_save("/no/such/x.h5", &(struct paper_state_sheet){1, sheet}, 1),
        PAPER_BAD_ARGUMENT);
    check(paper_sheet_create(&config, &bare)); /* without history */
    assert_int_equal(paper_state_save(path, &(struct paper_state_sheet){1, bare}, 1),
                     PAPER_BAD_ARGUMENT);
    paper_sheet_destroy(bare);
    paper_sheet_destroy(sheet);
}

static void refused(const char *path, const char *says)
{
    struct paper_state *state;
    enum paper_status status = paper_state_open(path, &state);
    assert_null(state);
    assert_true(status == PAPER_BAD_FILE || status == PAPER_BAD_ARGUMENT);
    if (!strstr(paper_error(), says) || !strstr(paper_error(), path) ||
        strchr(paper_error(), '\n'))
        fail_msg("it said: %s", paper_error());
}

static void damage_is_told(void **state)
{
    (void)state;
    char path[512];
    size_t count;
    snprintf(path, sizeof path, "%s", scratch_path("damaged.h5"));
    struct paper_sheet *sheet = sample_sheet(5);
    sample_paint(sheet, 2);
    check(paper_state_save(path, &(struct paper_state_sheet){1, sheet}, 1));
    paper_sheet_destroy(sheet);
    uint8_t *good = sample_file_read(path, &count), *bytes = malloc(count);
    for (size_t at = 0; at < count; at += 97) {
        memcpy(bytes, good, count);
        bytes[at] ^= 0x10;
        sample_file_write(path, bytes, count);
        refused(path, "");
    }
    memcpy(bytes, good, count);
    for (size_t length = 0; length < count; length += 999) {
        sample_file_write(path, bytes, length);
        refused(path, length < SAMPLE_HEADER ? "not a saved state" : "should have");
    }
    bytes[600] ^= 1;
    sample_file_write(path, bytes, count);
    refused(path, "checksum");
    memcpy(bytes, good, count);
    bytes[22] = '9'; /* of the model's version */
    sample_file_write(path, bytes, count);
    refused(path, "model");
    memcpy(bytes, good, count);
    assert_int_equal(bytes[14], '2');
    bytes[14] = '1'; /* of sheets whose water was another */
    sample_file_write(path, bytes, count);
    char says[100];
    snprintf(says, sizeof says,
             "(format 1, model of paper %d); this one reads format 2, model %d",
             PAPER_MODEL_VERSION, PAPER_MODEL_VERSION);
    refused(path, says);
    sample_file_write(path, (const uint8_t *)"hello", 5);
    refused(path, "not a saved state");
    unlink(path);
    refused(path, "No such file");
    assert_int_equal(mkfifo(path, 0600), 0);
    refused(path, "");
    unlink(path);
    assert_int_equal(mkdir(path, 0700), 0);
    refused(path, "");
    rmdir(path);
    free(good);
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheets_come_back_with_their_past),
        cmocka_unit_test(a_program_goes_on_where_it_was),
        cmocka_unit_test(files_are_whole_or_as_they_were),
        cmocka_unit_test(damage_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
