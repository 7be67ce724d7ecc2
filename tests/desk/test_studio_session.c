/* test_studio_session.c - a hand's deeds against the paper's own functions, bit for bit; undo
 * and redo, in mid-stroke too; files. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "studio_scene.h"

enum { NUMBERS = 3 * SCENE_WIDTH * SCENE_HEIGHT };
static uint16_t seen[NUMBERS], expected[NUMBERS];
static char folder[] = "/tmp/lutetia-studio-XXXXXX";

#define good(call) assert_int_equal(call, PAPER_OK)

static void look(struct paper_sheet *sheet, uint16_t *rgb)
{
    const struct paper_sheet_config config = scene_config();
    struct paper_sheet_view view = paper_sheet_view_default(&config);
    view.show = PAPER_SHOW_WET;
    good(paper_sheet_view(sheet, &view, rgb));
}

static struct studio_session *begin(void)
{
    const struct paper_sheet_config config = scene_config();
    struct studio_session *s;
    good(studio_session_create(&config, 64e6, &s));
    return s;
}

/* ---- deeds ---- */

static void hand_paints_what_calls_paint(void **state)
{
    (void)state;
    const struct paper_sheet_config config = scene_config();
    struct paper_sheet *sheet;
    struct studio_session *s = begin();
    good(scene_play(s));
    look(studio_session_sheet(s), seen);
    studio_session_destroy(s);
    good(paper_sheet_create(&config, &sheet));
    good(paper_history_begin(sheet, 0));
    good(scene_paint(sheet));
    look(sheet, expected);
    paper_sheet_destroy(sheet);
    assert_memory_equal(seen, expected, sizeof seen);
}

/* ---- undo ---- */

static void stroke_is_one_undo(void **state)
{
    (void)state;
    static uint16_t once[NUMBERS], twice[NUMBERS];
    struct studio_session *s = begin();
    int done;
    assert_false(studio_session_can_undo(s));
    assert_false(studio_session_undo(s));
    good(scene_sweep(s, 20, 0, true));
    good(studio_session_steps(s, 5, &done));
    assert_int_equal(done, 5);
    look(studio_session_sheet(s), once);
    good(studio_session_set(s, STUDIO_WIDTH, 12));
    good(scene_sweep(s, 50, 0, true));
    good(studio_session_steps(s, 7, NULL));
    look(studio_session_sheet(s), twice);
    const int operations = paper_history_done(studio_session_sheet(s));

    assert_true(studio_session_undo(s));
    look(studio_session_sheet(s), seen);
    assert_memory_equal(seen, once, sizeof seen);
    assert_true(studio_session_held(s) && studio_session_can_redo(s));
    good(studio_session_steps(s, 3,
                              &done)); /* time stands still: else there were nothing to redo */
    assert_int_equal(done, 0);
    assert_true(studio_session_redo(s));
    look(studio_session_sheet(s), seen);
    assert_memory_equal(seen, twice, sizeof seen);
    assert_int_equal(paper_history_done(studio_session_sheet(s)), operations);
    assert_false(studio_session_redo(s));

    assert_true(studio_session_undo(s));
    assert_true(studio_session_undo(s));
    assert_int_equal(paper_history_done(studio_session_sheet(s)), 0);
    assert_false(studio_session_can_undo(s));
    assert_true(studio_session_redo(s));
    look(studio_session_sheet(s), seen);
    assert_memory_equal(seen, once, sizeof seen);
    studio_session_go_on(s); /* what was undone is gone with the next step */
    good(studio_session_steps(s, 2, &done));
    assert_int_equal(done, 2);
    assert_false(studio_session_can_redo(s));
    studio_session_destroy(s);
}

static void mid_stroke_undo_drops_it_alone(void **state)
{
    (void)state;
    struct studio_session *s = begin();
    good(scene_sweep(s, 20, 0, true));
    look(studio_session_sheet(s), expected);
    const int operations = paper_history_done(studio_session_sheet(s));
    good(scene_sweep(s, 40, 0, false));
    assert_true(studio_session_busy(s));
    assert_true(studio_session_undo(s));
    assert_false(studio_session_busy(s));
    /* what still comes of that hand is of no stroke */
    good(studio_session_point(
        s, &(struct studio_point){.kind = STUDIO_POINT_MOVE, .time_s = 6, .x = 5, .y = 5}));
    good(studio_session_point(
        s, &(struct studio_point){.kind = STUDIO_POINT_UP, .time_s = 6, .x = 5, .y = 5}));
    look(studio_session_sheet(s), seen);
    assert_memory_equal(seen, expected, sizeof seen);
    assert_int_equal(paper_history_done(studio_session_sheet(s)), operations);
    good(scene_sweep(s, 60, 0, false));
    good(studio_session_point(s, &(struct studio_point){.kind = STUDIO_POINT_DROP}));
    assert_int_equal(paper_history_done(studio_session_sheet(s)), operations);
    assert_true(studio_session_undo(s)); /* the first one */
    assert_int_equal(paper_history_done(studio_session_sheet(s)), 0);
    studio_session_destroy(s);
}

static void other_deeds_are_undone_too(void **state)
{
    (void)state;
    struct studio_session *s = begin();
    good(scene_sweep(s, 30, 0, true));
    look(studio_session_sheet(s), expected);
    good(studio_session_set(s, STUDIO_TYPE_SIZE, 30));
    good(studio_session_type(s, &(struct studio_type){"Ag", "DejaVuSans", "", 10.25, 50}));
    look(studio_session_sheet(s), seen);
    assert_true(memcmp(seen, expected, sizeof seen) != 0);
    assert_true(studio_session_undo(s));
    look(studio_session_sheet(s), seen);
    assert_memory_equal(seen, expected, sizeof seen);
    good(studio_session_set(s, STUDIO_TILT_Y,
                            0.5)); /* air is no deed; it goes with the next one */
    good(studio_session_dry(s));
    good(studio_session_seal(s));
    assert_true(studio_session_undo(s) && studio_session_undo(s));
    look(studio_session_sheet(s), seen);
    assert_memory_equal(seen, expected, sizeof seen);
    studio_session_destroy(s);
}

static void wrong_is_told(void **state)
{
    (void)state;
    struct studio_session *s = begin();
    assert_int_equal(studio_session_set(s, STUDIO_WIDTH, 1e9), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(studio_session_error(), "width"));
    studio_session_error_forget();
    assert_int_equal(
        studio_session_type(s, &(struct studio_type){"a", "no such font at all", "", 1, 1}),
        PAPER_BAD_FONT);
    assert_non_null(strstr(studio_session_error(), "no such font"));
    good(scene_sweep(s, 20, 0, false));
    assert_int_equal(studio_session_dry(s), PAPER_BAD_ARGUMENT); /* the brush is on the paper */
    studio_session_destroy(s);
}

/* ---- files ---- */

static void opened_again_with_its_past(void **state)
{
    (void)state;
    char path[64], picture[64];
    struct studio_session *s = begin(), *again;
    snprintf(path, sizeof path, "%s/sheet.h5", folder);
    snprintf(picture, sizeof picture, "%s/sheet.png", folder);
    good(scene_sweep(s, 20, 0, true));
    good(studio_session_steps(s, 4, NULL));
    look(studio_session_sheet(s), expected);
    good(studio_session_set(s, STUDIO_TILT_X, 0.25));
    good(scene_sweep(s, 50, 0, true));
    good(studio_session_save(s, path));
    good(studio_session_picture(s, picture, 1));
    assert_int_equal(access(picture, R_OK), 0);
    look(studio_session_sheet(s), seen);
    studio_session_destroy(s);

    static uint16_t opened[NUMBERS];
    good(studio_session_open(path, 64e6, &again));
    look(studio_session_sheet(again), opened);
    assert_memory_equal(opened, seen, sizeof seen);
    assert_true(studio_session_settings(again)->value[STUDIO_TILT_X] == 0.25);
    assert_true(studio_session_undo(again)); /* the second stroke */
    look(studio_session_sheet(again), opened);
    assert_memory_equal(opened, expected, sizeof opened);
    studio_session_destroy(again);

    studio_session_error_forget();
    assert_int_equal(studio_session_open("/no/such.h5", 0, &again), PAPER_BAD_ARGUMENT);
    assert_null(again);
    assert_non_null(strstr(studio_session_error(), "/no/such.h5"));
    unlink(path);
    unlink(picture);
}

static int folder_make(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int folder_remove(void **state)
{
    (void)state;
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hand_paints_what_calls_paint),
        cmocka_unit_test(stroke_is_one_undo),
        cmocka_unit_test(mid_stroke_undo_drops_it_alone),
        cmocka_unit_test(other_deeds_are_undone_too),
        cmocka_unit_test(wrong_is_told),
        cmocka_unit_test(opened_again_with_its_past),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
