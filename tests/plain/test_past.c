/* test_past.c - operations of the past that are taken out or replaced: the sheet is the one
 * that never had them, to the bit. */
#include "../paper/history_operations.h"

#include <journal.h>

#include <stdio.h>
#include <unistd.h>

enum { OPERATIONS = 10, SESSIONS = 60 };

/* Does again on `to` what `from` has done, but for one operation; in its place so many
 * steps. */
static void repeat(struct paper_sheet *to, const struct paper_sheet *from, int without,
                   long steps)
{
    struct paper_moment moment;
    for (int i = 0; i < paper_history_done(from); i++) {
        uint8_t *bytes;
        size_t count;
        assert_true(paper_history_moment(from, i, &moment));
        paper_history_mark(to);
        for (long j = i == without ? steps : 0; j > 0; j--)
            check(paper_sheet_step(to));
        if (i == without)
            continue;
        check(paper_history_operation(from, i, &bytes, &count));
        paper_history_mark(to);
        if (strcmp(moment.what, "step") == 0)
            for (long j = moment.steps; j > 0; j--)
                check(paper_sheet_step(to));
        else
            check(paper_sheet_again(to, bytes, count));
        free(bytes);
    }
}

static struct paper_sheet *sheet_painted(uint64_t seed, double budget)
{
    struct paper_sheet *sheet = sheet_new(budget);
    for (uint64_t i = 0; i < OPERATIONS; i++)
        operate(sheet, seed * OPERATIONS + i);
    return sheet;
}

/* Whether a dip or a stroke after it needs the brush that it made. */
static bool is_needed(const struct paper_sheet *sheet, int number)
{
    struct paper_moment moment;
    void *arguments;
    int made = -1;
    for (int i = number; i < paper_history_done(sheet); i++) {
        int uses = -1;
        assert_true(paper_history_moment(sheet, i, &moment));
        check(paper_history_arguments(sheet, i, &arguments));
        if (i == number)
            made = strcmp(moment.what, "brush") == 0
                       ? ((const struct paper_brush *)arguments)->number
                       : -1;
        if (strcmp(moment.what, "dip") == 0)
            uses = ((const struct paper_dip *)arguments)->number;
        if (strcmp(moment.what, "stroke") == 0)
            uses = ((const struct paper_stroke *)arguments)->number;
        const bool again = i > number && strcmp(moment.what, "brush") == 0 &&
                           ((const struct paper_brush *)arguments)->number == made;
        paper_history_arguments_free(moment.what, arguments);
        if (made < 0 || again)
            return false;
        if (uses == made)
            return true;
    }
    return false;
}

static bool made_before(const struct paper_sheet *sheet, int number)
{
    struct paper_moment moment;
    void *arguments;
    bool there = false;
    check(paper_history_arguments(sheet, number, &arguments));
    const int made = ((const struct paper_brush *)arguments)->number;
    paper_history_arguments_free("brush", arguments);
    for (int i = 0; i < number && !there; i++) {
        assert_true(paper_history_moment(sheet, i, &moment));
        if (strcmp(moment.what, "brush") != 0)
            continue;
        check(paper_history_arguments(sheet, i, &arguments));
        there = ((const struct paper_brush *)arguments)->number == made;
        paper_history_arguments_free("brush", arguments);
    }
    return there;
}

static void an_operation_is_taken_out(void **state)
{
    int removed = 0, refused = 0, timed = 0;
    (void)state;
    for (uint64_t seed = 0; seed < SESSIONS; seed++) {
        struct paper_sheet *sheet = sheet_painted(seed, below(2) ? 1e6 : 0),
                           *without = sheet_new(0);
        struct paper_moment moment;
        int number = (int)(seed * 7 % (uint64_t)paper_history_done(sheet));
        const bool leave = seed % 2;
        for (int i = 0; leave && i < paper_history_done(sheet);
             i++) /* a stroke, if there is one */
            if (paper_history_moment(sheet, i, &moment) && strcmp(moment.what, "stroke") == 0 &&
                moment.steps > 0)
                number = i;
        assert_true(paper_history_moment(sheet, number, &moment));
        const bool brush = strcmp(moment.what, "brush") == 0,
                   steps = leave && strcmp(moment.what, "step") != 0 && moment.steps > 0;
        const bool needed = brush && is_needed(sheet, number) && !made_before(sheet, number);
        if (!needed)
            repeat(without, sheet, number, steps ? moment.steps : 0);
        const enum paper_status status = paper_history_remove(sheet, number, leave);
        assert_int_equal(status, needed ? PAPER_BAD_ARGUMENT : PAPER_OK);
        if (!needed)
            assert_true(state_hash(sheet) == state_hash(without));
        removed += !needed;
        refused += needed;
        timed += steps;
        paper_sheet_destroy(sheet);
        paper_sheet_destroy(without);
    }
    printf("%d taken out, %d left their time, %d refused\n", removed, timed, refused);
    assert_true(removed > 10 && timed > 0);
}

static void an_operation_is_replaced(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 6; seed++) {
        struct paper_sheet *sheet = sheet_new(1e6), *other = sheet_new(0);
        const double pale[3] = {0.5, 0.1, 0}, strong[3] = {1, 0.2, 0.7};
        operate(sheet, seed);
        operate(other, seed);
        const int number = paper_history_done(sheet);
        box_put(sheet, 4, 5, 7, pale);
        box_put(other, 4, 5, 7, strong);
        check(paper_sheet_step(other));
        for (uint64_t i = 1; i < 5; i++) {
            operate(sheet, seed * 5 + i);
            operate(other, seed * 5 + i);
        }
        const uint64_t before = state_hash(sheet);
        const int done = paper_history_done(sheet);
        check(paper_history_change_begin(sheet, number));
        box_put(sheet, 1, 1, 9, pale);
        check(paper_history_change_end(sheet, false)); /* nothing has been */
        assert_true(state_hash(sheet) == before && paper_history_done(sheet) == done);
        check(paper_history_change_begin(sheet, number));
        assert_int_equal(paper_history_remove(sheet, 0, false), PAPER_BAD_ARGUMENT);
        box_put(sheet, 1, 1, 9, pale);
        assert_int_equal(paper_history_undo(sheet, 5), 1);
        box_put(sheet, 4, 5, 7, strong);
        check(paper_sheet_step(sheet));
        check(paper_history_change_end(sheet, true));
        assert_true(state_hash(sheet) == state_hash(other));
        assert_int_equal(paper_history_done(sheet), paper_history_done(other));
        assert_int_equal(paper_history_remove(sheet, 1000, false), PAPER_BAD_ARGUMENT);
        paper_sheet_destroy(sheet);
        paper_sheet_destroy(other);
    }
}

/* Put in just before an operation, among others of its time: and out again by one undo. */
static void before_an_operation(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 12; seed++) {
        struct paper_sheet *sheet = sheet_painted(seed, seed % 2 ? 1e6 : 0),
                           *other = sheet_new(0);
        const int done = paper_history_done(sheet), number = (int)(seed * 5 % (uint64_t)done);
        const uint64_t before = state_hash(sheet);
        const double strong[3] = {1, 0.2, 0.7};
        struct paper_moment moment;
        for (int i = 0; i <= done; i++) {
            uint8_t *bytes;
            size_t count;
            if (i == number)
                box_put(other, 4, 5, 7, strong);
            if (i == done)
                break;
            assert_true(paper_history_moment(sheet, i, &moment));
            check(paper_history_operation(sheet, i, &bytes, &count));
            paper_history_mark(other);
            for (long k = strcmp(moment.what, "step") == 0 ? moment.steps : 1; k > 0; k--)
                check(paper_sheet_again(other, bytes, count));
            free(bytes);
        }
        assert_int_equal(paper_history_insert_before(sheet, done), PAPER_BAD_ARGUMENT);
        check(paper_history_insert_before(sheet, number));
        assert_int_equal(paper_history_insert_before(sheet, 0), PAPER_BAD_ARGUMENT);
        assert_int_equal(paper_history_undo(sheet, 1), 0);
        box_put(sheet, 4, 5, 7, strong);
        check(paper_history_insert_end(sheet, true));
        assert_int_equal(paper_history_done(sheet), done + 1);
        assert_true(state_hash(sheet) == state_hash(other));
        assert_int_equal(paper_history_undo(sheet, 1), 1);
        assert_int_equal(paper_history_done(sheet), done);
        assert_true(state_hash(sheet) == before);
        check(paper_history_insert_before(sheet, number));
        box_put(sheet, 4, 5, 7, strong);
        check(paper_history_insert_end(sheet, false));
        assert_true(state_hash(sheet) == before);
        paper_sheet_destroy(sheet);
        paper_sheet_destroy(other);
    }
}

/* Stops at its n-th call; -1: never. */
struct stopper {
    int calls, at;
    long last, total;
};

static bool watch(void *context, long done, long total)
{
    struct stopper *s = context;
    assert_true(done >= s->last && done <= total);
    s->last = done;
    s->total = total;
    return s->calls++ != s->at;
}

static void what_flows_anew_can_be_stopped(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_painted(3, 0), *without = sheet_new(0);
    repeat(without, sheet, 1, 0);
    check(paper_history_remove(sheet, 1, false));
    int stops = 0;
    for (int at = 0;; at++) { /* one operation or step more each time */
        double total;
        struct stopper stopper = {.at = 0};
        paper_history_set_watch(sheet, watch, &stopper);
        const enum paper_status status = paper_sheet_total(sheet, 0, &total);
        if (status == PAPER_OK)
            break;
        assert_int_equal(status, PAPER_MACHINE_FAILED);
        assert_string_equal(paper_error(), "stopped");
        stops++;
    }
    assert_true(stops > 10);
    paper_history_set_watch(sheet, NULL, NULL);
    assert_true(state_hash(sheet) == state_hash(without));
    paper_sheet_destroy(sheet);
    paper_sheet_destroy(without);
}

static void a_journal_tells_of_it(void **state)
{
    char path[] = "/tmp/lutetia-past-XXXXXX";
    struct paper_journal *journal;
    struct paper_journal_found found;
    struct paper_sheet *sheet = sheet_new(1e6), *again;
    (void)state;
    const int file = mkstemp(path);
    assert_true(file >= 0 && close(file) == 0);
    check(paper_journal_begin(sheet, path, NULL, &journal));
    for (uint64_t i = 0; i < 6; i++)
        operate(sheet, 40 + i);
    check(paper_history_remove(sheet, 2, true));
    check(paper_history_change_begin(sheet, 1));
    box_put(sheet, 4, 5, 7, (double[]){1, 0.2, 0.7});
    check(paper_history_change_end(sheet, true));
    check(paper_history_insert_before(sheet, 2));
    box_put(sheet, 2, 2, 3, (double[]){0.7, 0, 0.4});
    check(paper_history_insert_end(sheet, true));
    operate(sheet, 50);
    check(paper_journal_close(journal));
    check(paper_journal_open(path, NULL, 1e6, &found, &again));
    assert_string_equal(found.why, "");
    assert_int_equal(paper_history_done(sheet), paper_history_done(again));
    assert_true(state_hash(sheet) == state_hash(again));
    unlink(path);
    paper_sheet_destroy(sheet);
    paper_sheet_destroy(again);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_operation_is_taken_out),
        cmocka_unit_test(an_operation_is_replaced),
        cmocka_unit_test(before_an_operation),
        cmocka_unit_test(what_flows_anew_can_be_stopped),
        cmocka_unit_test(a_journal_tells_of_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
