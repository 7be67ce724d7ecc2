/* test_history.c - undo, redo, seek and insertion: the sheet at a given moment is the same to
 * the bit, however one gets there. */
#include <brush.h>
#include <history.h>
#include <paper.h>
#include <sheet.h>
#include <techniques.h>

#include "history_operations.h"
#include "sample.h"
#include "sheets.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void going_back_and_forth_gives_the_same_bits(void **state)
{
    (void)state;
    enum { OPERATIONS = 80, MOVES = 40 };
    static const double budgets[] = {-1, 0, 60e3, 400e3, 1e9};
    static uint64_t hashes[OPERATIONS + 1];
    static long times[OPERATIONS + 1];
    for (size_t budget = 0; budget < sizeof budgets / sizeof *budgets; budget++) {
        struct paper_sheet *sheet = sheet_new(budgets[budget]);
        int done[OPERATIONS + 1], compared = 0; /* some count as several */
        for (int i = 0; i <= OPERATIONS; i++) {
            if (budget == 0) {
                hashes[i] = state_hash(sheet);
                times[i] = paper_sheet_steps(sheet);
            } else {
                assert_int_equal(paper_sheet_steps(sheet), times[i]);
            }
            done[i] = paper_history_done(sheet);
            if (i < OPERATIONS)
                operate(sheet, (uint64_t)i);
        }
        assert_true(state_hash(sheet) == hashes[OPERATIONS]);
        assert_int_equal(paper_history_has(sheet), budget > 0);
        uint64_t moves = 99;
        int at = done[OPERATIONS];
        for (int i = 0; i < MOVES && budget > 0; i++) {
            int by = 1 + (int)(sample_word(&moves) % 50);
            if (sample_word(&moves) % 2)
                at -= paper_history_undo(sheet, by);
            else
                at += paper_history_redo(sheet, by);
            assert_int_equal(paper_history_done(sheet), at);
            assert_int_equal(paper_history_undone(sheet), done[OPERATIONS] - at);
            for (int j = 0; j <= OPERATIONS; j++) {
                if (done[j] != at)
                    continue;
                assert_int_equal(paper_sheet_steps(sheet), times[j]);
                if (state_hash(sheet) != hashes[j])
                    fail_msg("budget %g: operation %d is not as it was", budgets[budget], j);
                compared++;
            }
        }
        assert_true(budget == 0 || compared > MOVES / 2);
        if (budget > 0)
            assert_true(paper_history_bytes(sheet) < budgets[budget] + 60e3);
        assert_int_equal(paper_history_undo(sheet, 1000), budget > 0 ? at : 0);
        if (budget > 0)
            assert_true(state_hash(sheet) == hashes[0]);
        paper_sheet_destroy(sheet);
    }
}

static void moments_are_found_while_paint_flows(void **state)
{
    (void)state;
    enum { STEPS = 30 };
    static uint64_t hashes[STEPS + 1];
    struct paper_sheet *sheet = sheet_new(100e3);
    box_put(sheet, 4, 4, 9, (double[]){1, 0.5, 0.2});
    for (int i = 0; i < STEPS; i++) {
        hashes[i] = state_hash(sheet);
        step(sheet);
    }
    hashes[STEPS] = state_hash(sheet);
    assert_int_equal(paper_history_done(sheet), 2); /* steps in a row are one operation */
    struct paper_moment moment;
    assert_true(paper_history_moment(sheet, 1, &moment));
    assert_string_equal(moment.what, "step");
    assert_int_equal(moment.time, 0);
    assert_int_equal(moment.steps, STEPS);
    assert_false(paper_history_moment(sheet, 2, &moment));
    static const int times[] = {17, 3, 29, 0, 30, 12};
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        check(paper_history_seek(sheet, times[i]));
        assert_int_equal(paper_sheet_steps(sheet), times[i]);
        assert_true(state_hash(sheet) == hashes[times[i]]);
    }
    assert_int_equal(paper_history_seek(sheet, 31), PAPER_BAD_ARGUMENT);
    assert_int_equal(paper_history_seek(sheet, -1), PAPER_BAD_ARGUMENT);
    /* a new operation replaces the undone ones */
    check(paper_sheet_dry(sheet));
    assert_int_equal(paper_history_undone(sheet), 0);
    assert_int_equal(paper_history_done(sheet), 3);
    paper_history_undo(sheet, 1);
    assert_true(state_hash(sheet) == hashes[12]);
    paper_sheet_destroy(sheet);
}

static void what_is_inserted_comes_before_what_followed(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_new(100e3), *other = sheet_new(-1);
    for (int i = 0; i < 2; i++) {
        struct paper_sheet *s = i ? other : sheet;
        box_put(s, 2, 2, 9, (double[]){1, 0.5, 0});
        for (int n = 0; n < 12; n++)
            step(s);
        if (i == 1) {
            box_put(s, 12, 3, 6, (double[]){0.4, 0, 0.7});
            step(s);
        }
        for (int n = 0; n < 8; n++)
            step(s);
        box_put(s, 10, 8, 5, (double[]){0.5, 0, 0.5});
        for (int n = 0; n < 6; n++)
            step(s);
    }
    uint64_t before = state_hash(sheet);
    assert_int_equal(paper_history_insert_begin(sheet, 27), PAPER_BAD_ARGUMENT);
    check(paper_history_insert_begin(sheet, 12)); /* abandoned at its end */
    box_put(sheet, 0, 0, 20, (double[]){2, 2, 2});
    check(paper_history_insert_end(sheet, false));
    assert_true(state_hash(sheet) == before);

    check(paper_history_insert_begin(sheet, 12));
    assert_int_equal(paper_sheet_steps(sheet), 12);
    assert_int_equal(paper_history_insert_begin(sheet, 3), PAPER_BAD_ARGUMENT);
    box_put(sheet, 12, 3, 6, (double[]){0.4, 0, 0.7});
    step(sheet);
    assert_int_equal(paper_history_undo(sheet, 99), 2); /* not what was before */
    box_put(sheet, 12, 3, 6, (double[]){0.4, 0, 0.7});
    step(sheet);
    check(paper_history_insert_end(sheet, true));
    assert_int_equal(paper_sheet_steps(sheet), 27);
    assert_true(state_hash(sheet) == state_hash(other));
    assert_true(state_hash(sheet) != before);
    paper_sheet_destroy(sheet);
    paper_sheet_destroy(other);
}

/* Undoes insertions at random times after random operations. The history and the sheet are then
 * as before the insertion, and further undos go on from there. */
static void undo_after_an_insertion_takes_it_back(void **state)
{
    (void)state;
    for (int turn = 0; turn < 12; turn++) {
        struct paper_sheet *sheet = sheet_new(turn % 2 ? 100e3 : 0);
        for (int i = 0; i < 8; i++) {
            box_put(sheet, below(12), below(10), 3 + below(8), (double[]){0.8, 0.4, 0.2});
            for (int n = below(6); n >= 0; n--)
                step(sheet);
        }
        const uint64_t before = state_hash(sheet);
        const int done = paper_history_done(sheet);
        const long steps = paper_sheet_steps(sheet);
        check(paper_history_insert_begin(sheet, below((int)steps + 1)));
        box_put(sheet, below(12), 3, 6, (double[]){0.4, 0, 0.7});
        for (int n = below(4); n > 0; n--)
            step(sheet);
        check(paper_history_insert_end(sheet, true));
        assert_true(state_hash(sheet) != before);
        assert_true(paper_history_done(sheet) > done);
        if (turn % 3 == 0) { /* undoes the last operation and the insertion */
            assert_int_equal(paper_history_undo(sheet, 2), 2);
            assert_int_equal(paper_history_done(sheet), done - 1);
            assert_int_equal(paper_history_redo(sheet, 9), 1);
        } else
            assert_int_equal(paper_history_undo(sheet, 1), 1);
        assert_int_equal(paper_history_done(sheet), done);
        assert_int_equal(paper_history_undone(sheet), 0);
        assert_int_equal(paper_sheet_steps(sheet), steps);
        assert_true(state_hash(sheet) == before);
        paper_sheet_destroy(sheet);
    }
    /* after a later operation, undo takes back that operation and not the insertion */
    struct paper_sheet *sheet = sheet_new(100e3);
    box_put(sheet, 2, 2, 9, (double[]){1, 0.5, 0});
    step(sheet);
    check(paper_history_insert_begin(sheet, 0));
    box_put(sheet, 9, 9, 4, (double[]){1, 0.5, 0});
    check(paper_history_insert_end(sheet, true));
    const uint64_t inserted = state_hash(sheet);
    check(paper_sheet_dry(sheet));
    assert_int_equal(paper_history_undo(sheet, 1), 1);
    assert_true(state_hash(sheet) == inserted);
    assert_int_equal(paper_history_done(sheet), 3);
    paper_sheet_destroy(sheet);
}

/* ---- states ---- */

struct saved {
    uint8_t *bytes;
    size_t count;
    uint32_t words[PAPER_PLANES_MAX][FIBERS];
    int asked;
};

static enum paper_status saved_give(void *context, int number, void *words)
{
    struct saved *saved = context;
    memcpy(words, saved->words[number], sizeof saved->words[number]);
    saved->asked++;
    return PAPER_OK;
}

static void save(struct paper_sheet *sheet, struct saved *saved)
{
    struct paper_plane planes[PAPER_PLANES_MAX];
    free(saved->bytes);
    int count = paper_sheet_planes(sheet, planes);
    for (int i = 0; i < count; i++)
        check(paper_sheet_plane_read(sheet, i, saved->words[i]));
    check(paper_history_encode(sheet, &saved->bytes, &saved->count));
}

static void a_saved_run_goes_on(void **state)
{
    (void)state;
    enum { OPERATIONS = 24, SAVED = 15 };
    static struct saved saved;
    struct paper_sheet *whole = sheet_new(0), *sheet;
    int done[OPERATIONS + 1];
    for (int i = 0; i < OPERATIONS; i++) {
        if (i == SAVED)
            save(whole, &saved);
        done[i] = paper_history_done(whole);
        operate(whole, (uint64_t)i + 200);
    }
    done[OPERATIONS] = paper_history_done(whole);
    uint64_t end = state_hash(whole);
    paper_history_undo(whole, done[OPERATIONS] - done[SAVED]);
    uint64_t middle = state_hash(whole);

    /* loaded: the sheet has its history */
    check(
        paper_history_decode(saved.bytes, saved.count, false, 1e6, saved_give, &saved, &sheet));
    assert_true(state_hash(sheet) == middle);
    for (int i = SAVED; i < OPERATIONS; i++)
        operate(sheet, (uint64_t)i + 200);
    assert_true(state_hash(sheet) == end);
    paper_history_undo(sheet, done[OPERATIONS] - done[SAVED] + 3);
    paper_history_redo(sheet, 3);
    assert_true(state_hash(sheet) == middle);
    paper_sheet_destroy(sheet);

    /* follow: the same operations come again and are not computed; two of the ways read the
     * sheet in the middle */
    for (int way = 0; way < 4; way++) {
        double budget = way % 2 ? 1e6 : 0;
        check(paper_history_decode(saved.bytes, saved.count, true, budget, saved_give, &saved,
                                   &sheet));
        assert_int_equal(paper_history_done(sheet), 0);
        for (int i = 0; i < OPERATIONS; i++) {
            if (way >= 2 && i == 9)
                state_hash(sheet);
            operate(sheet, (uint64_t)i + 200);
            assert_int_equal(paper_history_following(sheet),
                             i < SAVED ? done[SAVED] - done[i + 1] : 0);
        }
        assert_false(paper_history_diverged(sheet));
        assert_true(state_hash(sheet) == end);
        paper_sheet_destroy(sheet);
    }
    check(
        paper_history_decode(saved.bytes, saved.count, true, 1e6, saved_give, &saved, &sheet));
    paper_history_undo(whole, done[SAVED] - done[9]);
    for (int i = 0; i < 9; i++)
        operate(sheet, (uint64_t)i + 200);
    operate(whole, 5);
    operate(sheet, 5);
    assert_true(paper_history_diverged(sheet));
    assert_int_equal(paper_history_following(sheet), 0);
    assert_true(state_hash(sheet) == state_hash(whole));
    paper_sheet_destroy(sheet);
    paper_sheet_destroy(whole);
    free(saved.bytes);
    saved.bytes = NULL;
}

/* Parts of a program with undos and redos, by number; some run before the sheet is saved and
 * some after. */
static void wander(struct paper_sheet *sheet, int part)
{
    struct paper_air air = *paper_sheet_get_air(sheet);
    switch (part) {
    case 0:
        air.gravity[0] = 0.02;
        check(paper_sheet_air(sheet, &air));
        box_put(sheet, 3, 3, 9, (double[]){1, 0.5, 0.2});
        for (int i = 0; i < 9; i++)
            step(sheet);
        break;
    case 1: /* the present air must be known without computing the sheet */
        air.humidity = 0.005;
        check(paper_sheet_air(sheet, &air));
        operate(sheet, 7);
        assert_int_equal(paper_history_undo(sheet, 2), 2);
        air = *paper_sheet_get_air(sheet);
        assert_true(air.gravity[0] == 0.02 && air.humidity != 0.005);
        for (int i = 0; i < 3; i++)
            step(sheet);
        break;
    case 2:
        box_put(sheet, 9, 6, 7, (double[]){0.6, 0, 0.4});
        for (int i = 0; i < 5; i++)
            step(sheet);
        check(paper_history_seek(sheet, 4));
        check(paper_history_seek(sheet, 15));
        break;
    case 3:
        check(paper_history_insert_begin(sheet, 6));
        box_put(sheet, 1, 9, 6, (double[]){0.7, 0.3, 0});
        step(sheet);
        assert_int_equal(paper_history_undo(sheet, 1), 1);
        step(sheet);
        check(paper_history_insert_end(sheet, true));
        break;
    case 4:
        check(paper_history_insert_begin(sheet, 2));
        check(paper_sheet_dry(sheet));
        check(paper_history_insert_end(sheet, false));
        for (int i = 0; i < 6; i++)
            step(sheet);
        break;
    default:
        assert_int_equal(paper_history_undo(sheet, 1), 1);
    }
}

static bool count_steps(void *context, long done, long total)
{
    (void)done, (void)total;
    ++*(long *)context;
    return true;
}

static void a_saved_run_goes_on_where_much_was_undone(void **state)
{
    (void)state;
    enum { PARTS = 6 };
    static struct saved saved;
    struct paper_sheet *whole, *sheet;
    for (int kept = 1; kept <= PARTS; kept++) {
        whole = sheet_new(0);
        for (int part = 0; part < kept; part++)
            wander(whole, part);
        save(whole, &saved);
        uint64_t middle = state_hash(whole);
        int redo = paper_history_undone(whole);
        for (int part = kept; part < PARTS; part++)
            wander(whole, part);
        uint64_t end = state_hash(whole);
        paper_sheet_destroy(whole);
        for (int way = 0; way < 4; way++) {
            long computed = 0;
            double budget = way & 1 ? 1e6 : 0;
            check(paper_history_decode(saved.bytes, saved.count, true, budget, saved_give,
                                       &saved, &sheet));
            paper_history_set_watch(sheet, count_steps, &computed);
            for (int part = 0; part < PARTS; part++) {
                if (part == kept) {
                    assert_int_equal(paper_history_following(sheet), 0);
                    assert_int_equal(paper_history_undone(sheet), redo);
                    if ((kept + way) % 3 == 0) { /* it is saved again there */
                        save(sheet, &saved);
                        assert_true(state_hash(sheet) == middle);
                    }
                    if (!(way & 2))
                        assert_int_equal(computed, 0);
                }
                if ((way & 2) && part == 1)
                    state_hash(sheet);
                wander(sheet, part);
            }
            assert_false(paper_history_diverged(sheet));
            if (state_hash(sheet) != end)
                fail_msg("saved after part %d, way %d: it ended otherwise", kept, way);
            paper_sheet_destroy(sheet);
        }
    }
    free(saved.bytes);
    saved.bytes = NULL;
}

/* Damages saved runs: every byte at the beginning, many later bytes, and every length. */
static void damaged_runs_are_refused_or_harmless(void **state)
{
    (void)state;
    static struct saved saved;
    struct paper_sheet *sheet = sheet_new(0);
    for (int i = 0; i < 12; i++)
        operate(sheet, (uint64_t)i + 300);
    wander(sheet, 0);
    wander(sheet, 1); /* the run has notes, too */
    save(sheet, &saved);
    paper_sheet_destroy(sheet);
    uint8_t *copy = malloc(saved.count);
    uint64_t word = 4;
    int refused = 0, taken = 0;
    for (int i = 0; i < 700; i++) {
        size_t count = saved.count;
        memcpy(copy, saved.bytes, count);
        if (i % 8 == 0)
            count = (size_t)(sample_word(&word) % count);
        for (int j = (int)(sample_word(&word) % 3); j >= 0; j--) {
            size_t at = i < 300 ? (size_t)i * 2 : (size_t)(sample_word(&word) % saved.count);
            copy[at % saved.count] =
                (uint8_t)(sample_word(&word) % 3 ? sample_word(&word) : 255);
        }
        /* only the description is checked where the damage changed the size: another size would
         * need other kernels */
        struct paper_sheet_config config;
        if (paper_history_describe(copy, count, &config) != PAPER_OK || config.width != WIDTH ||
            config.height != HEIGHT || config.pigments_count != 2 ||
            config.parts != PAPER_PARTS_ALL || !config.torus) {
            refused++;
            continue;
        }
        enum paper_status status =
            paper_history_decode(copy, count, i % 2, 0, saved_give, &saved, &sheet);
        if (status == PAPER_OK) {
            taken++;
            paper_sheet_destroy(sheet);
        } else {
            refused++;
            assert_int_equal(status, PAPER_BAD_FILE);
            assert_null(sheet);
        }
    }
    if (refused < 100 || taken < 50)
        fail_msg("%d refused, %d taken", refused, taken);
    free(copy);
    free(saved.bytes);
    saved.bytes = NULL;
}

/* ---- another resolution ---- */

static void another_resolution_is_the_same_picture(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_new(0), *same, *twice;
    struct paper_air air = paper_air_default();
    air.humidity = 0.002;
    air.edge = 0.01;
    check(paper_sheet_air(sheet, &air));
    box_put(sheet, 5, 4, 10, (double[]){1, 0.6, 0.1});
    for (int i = 0; i < 20; i++)
        step(sheet);
    check(paper_history_render(sheet, 1, 1, 0, &same));
    assert_true(state_hash(same) == state_hash(sheet));
    paper_sheet_destroy(same);
    assert_int_equal(paper_history_render(sheet, 0, 1, 0, &same), PAPER_BAD_ARGUMENT);
    assert_int_equal(paper_history_render(sheet, 0.1, 1, 0, &same), PAPER_BAD_ARGUMENT);
    assert_int_equal(paper_history_render(sheet, 2, NAN, 0, &same), PAPER_BAD_ARGUMENT);

    check(paper_history_render(sheet, 2, 4, -1, &twice));
    const struct paper_sheet_config *config = paper_sheet_get_config(twice);
    assert_int_equal(config->width, 2 * WIDTH);
    assert_int_equal(config->height, 2 * HEIGHT);
    assert_int_equal(paper_sheet_steps(twice), 80);
    for (int substance = -1; substance <= 2; substance++) {
        double small, large;
        check(paper_sheet_total(sheet, substance, &small));
        check(paper_sheet_total(twice, substance, &large));
        /* pigment keeps its amount; water dries at about the same rate on both sheets */
        if (fabs(large / small - 4) > (substance > 0 ? 0.01 : 0.5))
            fail_msg("substance %d: %g became %g", substance, small, large);
    }
    /* the pigment's places, sums of all layers */
    static float coarse[FIBERS], fine[4 * FIBERS], part[4 * FIBERS];
    memset(coarse, 0, sizeof coarse);
    memset(fine, 0, sizeof fine);
    for (int i = 0; i < 3; i++) {
        enum paper_layer layer = (enum paper_layer)(PAPER_LAYER_SURFACE_PIGMENT + i);
        check(paper_sheet_layer_read(sheet, layer, 0, part));
        for (int j = 0; j < FIBERS; j++)
            coarse[j] += part[j];
        check(paper_sheet_layer_read(twice, layer, 0, part));
        for (int j = 0; j < 4 * FIBERS; j++)
            fine[j] += part[j];
    }
    double both = 0, first = 0, second = 0;
    for (int i = 0; i < FIBERS; i++) {
        int corner = i / WIDTH * 4 * WIDTH + i % WIDTH * 2;
        double mean =
            ((double)fine[corner] + (double)fine[corner + 1] +
             (double)fine[corner + 2 * WIDTH] + (double)fine[corner + 2 * WIDTH + 1]) /
            4;
        both += mean * (double)coarse[i];
        first += mean * mean;
        second += (double)coarse[i] * (double)coarse[i];
    }
    if (!(both / sqrt(first * second) > 0.97))
        fail_msg("the pictures agree by %g", both / sqrt(first * second));
    paper_sheet_destroy(twice);
    paper_sheet_destroy(sheet);
}

static bool stop_at(void *context, long done, long total)
{
    (void)total;
    return done < *(long *)context;
}

static void computing_again_can_be_stopped(void **state)
{
    (void)state;
    struct paper_sheet *sheet = sheet_new(0);
    box_put(sheet, 5, 4, 10, (double[]){1, 0.6, 0.1});
    for (int i = 0; i < 20; i++)
        step(sheet);
    uint64_t end = state_hash(sheet);
    check(paper_history_seek(sheet, 15));
    double total;
    long stop = 6;
    paper_history_set_watch(sheet, stop_at, &stop);
    assert_int_equal(paper_sheet_total(sheet, 0, &total), PAPER_MACHINE_FAILED);
    assert_string_equal(paper_error(), "stopped");
    stop = 1000;
    check(paper_sheet_total(sheet, 0, &total));
    assert_int_equal(paper_history_redo(sheet, 1), 1);
    assert_true(state_hash(sheet) == end);
    paper_sheet_destroy(sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(going_back_and_forth_gives_the_same_bits),
        cmocka_unit_test(moments_are_found_while_paint_flows),
        cmocka_unit_test(what_is_inserted_comes_before_what_followed),
        cmocka_unit_test(undo_after_an_insertion_takes_it_back),
        cmocka_unit_test(a_saved_run_goes_on),
        cmocka_unit_test(a_saved_run_goes_on_where_much_was_undone),
        cmocka_unit_test(damaged_runs_are_refused_or_harmless),
        cmocka_unit_test(another_resolution_is_the_same_picture),
        cmocka_unit_test(computing_again_can_be_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
