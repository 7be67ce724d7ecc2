/* test_studio_past.c - time under the hand: what is inserted, taken out or changed earlier
 * makes the sheet that was painted so from the beginning, to the bit, by a session that never
 * looked back; and nothing else goes. */
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

#define good(call) assert_int_equal(call, PAPER_OK)

static void look(struct studio_session *s, uint16_t *rgb)
{
    const struct paper_sheet_config config = scene_config();
    struct paper_sheet_view view = paper_sheet_view_default(&config);
    view.show = PAPER_SHOW_WET;
    good(paper_sheet_view(studio_session_sheet(s), &view, rgb));
}

static struct studio_session *begin(void)
{
    const struct paper_sheet_config config = scene_config();
    struct studio_session *s;
    good(studio_session_create(&config, 64e6, &s));
    return s;
}

/* A way of the hand, with this tool. */
struct hand {
    enum studio_tool_number tool;
    double width, y, rises, pigment;
};

static void paint(struct studio_session *s, const struct hand *h)
{
    good(studio_session_set(s, STUDIO_TOOL, h->tool));
    good(studio_session_set(s, STUDIO_WIDTH, h->width));
    good(studio_session_set(s, STUDIO_PIGMENT, h->pigment));
    good(scene_sweep(s, h->y, h->rises, true));
}

static const struct hand blue = {STUDIO_TOOL_BRUSH, 14, 20, 3, 0.7},
                         wide = {STUDIO_TOOL_BRUSH, 22, 36, -2, 0.5},
                         wet = {STUDIO_TOOL_WATER, 10, 28, 1, 0},
                         thin = {STUDIO_TOOL_BRUSH, 6, 50, 4, 1},
                         cloth = {STUDIO_TOOL_BLOT, 12, 24, 2, 0},
                         drop = {STUDIO_TOOL_DROP, 12, 30, 2, 0.8},
                         wash = {STUDIO_TOOL_WASH, 12, 4, 12, 0.4};

/* Steps go on only in the present. */
static void paint_all(struct studio_session *s, const struct hand *const *hands,
                      const int *steps)
{
    for (int i = 0; hands[i]; i++) {
        paint(s, hands[i]);
        good(studio_session_steps(s, steps[i], NULL));
    }
}

static struct studio_session *painted(const struct hand *const *hands, const int *steps)
{
    struct studio_session *s = begin();
    good(studio_session_set(s, STUDIO_PAUSED, 1)); /* strokes take no time */
    paint_all(s, hands, steps);
    return s;
}

/* The sheet of the session is that of these deeds. */
static void is_sheet(struct studio_session *s, const struct hand *const *hands,
                     const int *steps, int line)
{
    struct studio_session *other = painted(hands, steps);
    look(s, seen);
    look(other, expected);
    if (memcmp(seen, expected, sizeof seen) != 0)
        fail_msg("line %d: it is another sheet", line);
    assert_int_equal(paper_sheet_steps(studio_session_sheet(s)),
                     paper_sheet_steps(studio_session_sheet(other)));
    studio_session_destroy(other);
}

#define is_sheet_of(s, hands, steps) is_sheet(s, hands, steps, __LINE__)

static const struct hand *const four[] = {&wash, &blue, &wide, &thin, NULL};
static const int four_steps[] = {5, 4, 6, 3};

static void moments_are_visited(void **state)
{
    (void)state;
    struct studio_session *s = painted(four, four_steps);
    struct studio_deed *deeds;
    int count, done;
    good(studio_session_deeds(s, &deeds, &count));
    assert_int_equal(count, 4);
    assert_string_equal(deeds[0].what, "wash");
    assert_int_equal(deeds[2].time, 9);
    assert_int_equal(deeds[2].steps, 6);
    free(deeds);
    for (int k = 0; k <= 4; k++) { /* each is the sheet that had got so far */
        const struct hand *some[5] = {four[0], four[1], four[2], four[3]};
        good(studio_session_visit(s, k));
        some[k] = NULL;
        is_sheet_of(s, some, four_steps);
        assert_int_equal(studio_session_deeds_done(s), k);
        assert_int_equal(studio_session_visits(s), k < 4);
        assert_true(k == 4 || studio_session_held(s));
    }
    good(studio_session_visit(s, 2));
    good(studio_session_steps(s, 3, &done)); /* time stands still there */
    assert_int_equal(done, 0);
    good(studio_session_visit(s, 1));
    good(studio_session_present(s));
    assert_false(studio_session_visits(s));
    is_sheet_of(s, four, four_steps);
    assert_int_equal(studio_session_visit(s, 5), PAPER_BAD_ARGUMENT);
    assert_int_equal(studio_session_visit(s, -1), PAPER_BAD_ARGUMENT);
    studio_session_destroy(s);
}

/* Other brushes, other tools, at the beginning too; what follows finds its brushes as they
 * were. */
static void deeds_are_inserted(void **state)
{
    (void)state;
    static const struct hand *const between[] = {&wash, &blue, &drop, &wet, &wide, &thin, NULL},
                                    *const first[] = {&cloth, &thin, &wash, &blue, &drop,
                                                      &wet,   &wide, &thin, NULL};
    static const int between_steps[] = {5, 4, 0, 0, 6, 3},
                     first_steps[] = {0, 0, 5, 4, 0, 0, 6, 3};
    struct studio_session *s = painted(four, four_steps);
    good(studio_session_visit(s, 2));
    assert_false(studio_session_inserts(s));
    good(scene_sweep(s, 60, 1, false)); /* given up: nothing is inserted */
    assert_true(studio_session_undo(s));
    good(studio_session_present(s));
    is_sheet_of(s, four, four_steps);
    good(studio_session_visit(s, 2));
    paint(s, &thin);
    assert_true(studio_session_inserts(s));
    assert_true(studio_session_undo(s)); /* among what is inserted, as ever */
    assert_false(studio_session_undo(s));
    paint(s, &drop);
    paint(s, &wet);
    assert_int_equal(studio_session_remove(s), PAPER_BAD_ARGUMENT);
    good(studio_session_present(s));
    is_sheet_of(s, between, between_steps);
    good(studio_session_visit(s, 0));
    paint(s, &cloth);
    paint(s, &thin);
    good(studio_session_present(s));
    assert_true(studio_session_undo(s)); /* takes out all that was inserted */
    is_sheet_of(s, between, between_steps);
    good(studio_session_visit(s, 0));
    paint(s, &cloth);
    paint(s, &thin);
    good(studio_session_visit(s, 3)); /* which ends the insertion, too */
    good(studio_session_present(s));
    is_sheet_of(s, first, first_steps);
    studio_session_destroy(s);
}

static void deeds_are_taken_out(void **state)
{
    (void)state;
    static const struct hand *const without[] = {&wash, &wide, &thin, NULL};
    static const int steps[] = {9, 6, 3};
    struct studio_session *s = painted(four, four_steps);
    good(studio_session_visit(s, 2));
    good(studio_session_remove(s));
    assert_false(studio_session_visits(s));
    assert_int_equal(studio_session_deeds_done(s), 3);
    is_sheet_of(s, without, steps);
    good(studio_session_visit(s, 0));
    assert_int_equal(studio_session_remove(s), PAPER_BAD_ARGUMENT);
    studio_session_destroy(s);
}

static void deeds_are_changed(void **state)
{
    (void)state;
    static const struct hand pale = {STUDIO_TOOL_BRUSH, 14, 20, 3, 0.2},
                             other = {STUDIO_TOOL_BRUSH, 14, 44, -5, 0.2},
                             weak = {STUDIO_TOOL_WASH, 12, 4, 12, 0.2};
    static const struct hand *const dished[] = {&wash, &pale, &wide, &thin, NULL},
                                    *const led[] = {&wash, &other, &wide, &thin, NULL},
                                    *const both[] = {&weak, &other, &wide, &thin, NULL};
    struct studio_session *s = painted(four, four_steps);
    good(studio_session_visit(s, 2));
    good(studio_session_set(s, STUDIO_PIGMENT, 0.2));
    good(studio_session_dish(s));
    is_sheet_of(s, dished, four_steps);
    good(studio_session_visit(s, 2));
    good(studio_session_way(s));
    assert_true(studio_session_way_waits(s));
    good(scene_sweep(s, 44, -5, true));
    assert_false(studio_session_way_waits(s) || studio_session_visits(s));
    is_sheet_of(s, led, four_steps);
    good(studio_session_visit(s, 1));
    assert_int_equal(studio_session_way(s), PAPER_BAD_ARGUMENT); /* a wash has none */
    good(studio_session_dish(s));
    is_sheet_of(s, both, four_steps);
    good(studio_session_visit(s, 2));
    good(studio_session_way(s));
    good(scene_sweep(s, 10, 2, false));
    assert_true(studio_session_undo(s)); /* it keeps its way */
    good(studio_session_present(s));
    is_sheet_of(s, both, four_steps);
    studio_session_destroy(s);
}

/* Right after it, and after time has gone on: the undo of a removal, of another dish and of
 * another way is the sheet of before; the next undo takes the last deed. */
static void changes_are_undone(void **state)
{
    (void)state;
    static const struct hand *const three[] = {&wash, &blue, &wide, NULL};
    static const int later_steps[] = {5, 4, 6, 8};
    struct studio_session *s = painted(four, four_steps);
    for (int deed = 1; deed <= 4; deed++) { /* with time, without, the first, the last */
        good(studio_session_visit(s, deed));
        good(studio_session_remove(s));
        assert_true(studio_session_change_waits(s));
        assert_int_equal(studio_session_deeds_done(s), 3);
        assert_int_equal(studio_session_change_deed(s), deed - 1);
        assert_true(studio_session_undo(s));
        assert_false(studio_session_change_waits(s));
        is_sheet_of(s, four, four_steps);
    }
    good(studio_session_visit(s, 4));
    good(studio_session_remove(s));
    good(studio_session_steps(s, 5, NULL));
    assert_true(studio_session_undo(s));
    is_sheet_of(s, four, later_steps);
    good(studio_session_visit(s, 2));
    good(studio_session_set(s, STUDIO_PIGMENT, 0.2));
    good(studio_session_dish(s));
    assert_true(studio_session_undo(s));
    is_sheet_of(s, four, later_steps);
    good(studio_session_visit(s, 3));
    good(studio_session_way(s));
    good(scene_sweep(s, 12, 5, true));
    assert_true(studio_session_undo(s));
    is_sheet_of(s, four, later_steps);
    assert_true(studio_session_undo(s)); /* and then the last deed, as ever */
    is_sheet_of(s, three, later_steps);
    studio_session_go_on(s);
    good(studio_session_visit(s, 1));
    good(studio_session_remove(s));
    paint(s, &drop); /* from here on an undo is this deed's */
    assert_false(studio_session_change_waits(s));
    assert_true(studio_session_undo(s));
    assert_int_equal(studio_session_deeds_done(s), 2);
    studio_session_destroy(s);
}

/* What an undo has given back is taken out, or changed, again by a redo, as often as one likes,
 * until another deed. */
static void changes_are_redone(void **state)
{
    (void)state;
    static const struct hand pale = {STUDIO_TOOL_BRUSH, 14, 20, 3, 0.2},
                             led = {STUDIO_TOOL_BRUSH, 22, 12, 5, 0.5};
    static const struct hand *const without[] = {&wash, &wide, &thin, NULL},
                                    *const dished[] = {&wash, &pale, &wide, &thin, NULL},
                                    *const another[] = {&wash, &blue, &led, &thin, NULL},
                                    *const three[] = {&wash, &blue, &wide, NULL};
    static const int without_steps[] = {9, 6, 3};
    struct studio_session *s = painted(four, four_steps);
    for (int i = 0; i < 3; i++) {
        good(studio_session_visit(s, i == 2 ? 3 : 2));
        if (i == 0)
            good(studio_session_remove(s));
        good(studio_session_set(s, STUDIO_PIGMENT, 0.2));
        if (i == 1)
            good(studio_session_dish(s));
        if (i == 2) {
            good(studio_session_way(s));
            good(scene_sweep(s, 12, 5, true));
        }
        for (int again = 0; again < (i == 0 ? 2 : 1); again++) {
            assert_false(studio_session_can_redo(s));
            assert_true(studio_session_undo(s));
            if (again == 1)
                is_sheet_of(s, four, four_steps);
            assert_true(studio_session_can_redo(s));
            assert_true(studio_session_redo(s));
            is_sheet_of(s,
                        i == 0   ? without
                        : i == 1 ? dished
                                 : another,
                        i == 0 ? without_steps : four_steps);
        }
        assert_true(studio_session_undo(s));
    }
    assert_true(studio_session_undo(s)); /* the last deed, and redo gives that back first */
    is_sheet_of(s, three, four_steps);
    assert_true(studio_session_redo(s));
    is_sheet_of(s, four, four_steps);
    assert_true(studio_session_redo(s));
    is_sheet_of(s, another, four_steps);
    assert_true(studio_session_undo(s));
    paint(s, &drop); /* another deed: nothing is redone any more */
    assert_false(studio_session_can_redo(s));
    assert_false(studio_session_redo(s));
    studio_session_destroy(s);
}

/* A bookmark has a name, gets another one, and keeps it through insertions, undo and files. */
static void bookmarks_have_names(void **state)
{
    (void)state;
    static const struct hand *const two[] = {&wash, &blue, NULL};
    static const int steps[] = {5, 4};
    char path[] = "/tmp/lutetia-bookmark-XXXXXX.h5", longest[PAPER_NAME_MAX + 1];
    struct studio_session *s = painted(two, steps);
    struct studio_deed *deeds;
    int count, file = mkstemps(path, 3);
    assert_true(file >= 0);
    close(file);
    memset(longest, 'x', sizeof longest);
    longest[PAPER_NAME_MAX] = '\0';
    assert_int_equal(studio_session_bookmark_name(s, longest), PAPER_BAD_ARGUMENT);
    longest[PAPER_NAME_MAX - 1] = '\0';
    good(studio_session_bookmark_name(s, longest));
    good(studio_session_bookmark_name(s, "wet sky")); /* the same one */
    good(studio_session_visit(s, 1));
    good(studio_session_bookmark(s)); /* which has none yet */
    good(studio_session_bookmark_name(s, "wash"));
    assert_true(studio_session_visits(s));
    good(studio_session_visit(s, 0));
    paint(s, &cloth);
    good(studio_session_present(s));
    good(studio_session_save(s, path));
    studio_session_destroy(s);
    good(studio_session_open(path, 64e6, &s));
    unlink(path);
    for (int again = 0; again < 2; again++) {
        good(studio_session_deeds(s, &deeds, &count));
        assert_int_equal(count, 3);
        assert_true(!deeds[0].marked && deeds[1].marked && deeds[2].marked);
        assert_string_equal(deeds[0].name, "");
        assert_string_equal(deeds[1].name, "wash");
        assert_string_equal(deeds[2].name, "wet sky");
        free(deeds);
        assert_true(studio_session_undo(s) && studio_session_redo(s));
    }
    good(studio_session_bookmark(s)); /* none there any more, and its name is gone */
    good(studio_session_deeds(s, &deeds, &count));
    assert_true(!deeds[2].marked && deeds[2].name[0] == '\0');
    free(deeds);
    studio_session_destroy(s);
}

/* A wet moment in the midst of a deed's time is found again, after what was inserted earlier,
 * and in the saved sheet; the sheet is what it was without bookmarks. */
static void wet_moments_are_marked(void **state)
{
    (void)state;
    static const struct hand *const two[] = {&wash, &blue, NULL}, *const more[] = {&cloth,
                                                                                   &wash, &blue,
                                                                                   NULL};
    static const int wet_steps[] = {5, 4}, two_steps[] = {5, 13}, more_steps[] = {0, 5, 4};
    char path[] = "/tmp/lutetia-bookmark-XXXXXX.h5";
    struct studio_session *s = begin();
    struct studio_deed *deeds;
    int count, file = mkstemps(path, 3);
    assert_true(file >= 0);
    close(file);
    assert_int_equal(studio_session_bookmark(s), PAPER_BAD_ARGUMENT); /* no deed yet */
    studio_session_destroy(s);
    s = painted(two, wet_steps);
    good(studio_session_bookmark(s));
    good(studio_session_steps(s, 9, NULL));
    is_sheet_of(s, two, two_steps);
    good(studio_session_deeds(s, &deeds, &count));
    assert_true(count == 2 && !deeds[0].marked && deeds[1].marked && deeds[1].steps == 13);
    free(deeds);
    good(studio_session_bookmark_visit(s, false));
    assert_true(studio_session_visits(s));
    is_sheet_of(s, two, wet_steps);
    assert_int_equal(studio_session_bookmark_visit(s, false), PAPER_BAD_ARGUMENT);
    good(studio_session_bookmark_visit(s, true)); /* there is no later one: the present */
    assert_false(studio_session_visits(s));
    good(studio_session_visit(s, 0));
    paint(s, &cloth);
    good(studio_session_present(s));
    good(studio_session_save(s, path));
    studio_session_destroy(s);
    good(studio_session_open(path, 64e6, &s));
    unlink(path);
    good(studio_session_bookmark_visit(s, false));
    is_sheet_of(s, more, more_steps);
    /* one at a visited moment, which stays visited; and none there any more */
    good(studio_session_visit(s, 2));
    good(studio_session_bookmark(s));
    assert_true(studio_session_visits(s));
    good(studio_session_bookmark_visit(s, true));
    is_sheet_of(s, more, more_steps);
    good(studio_session_bookmark_visit(s, false));
    good(studio_session_bookmark(s));
    assert_true(studio_session_visits(s));
    assert_int_equal(studio_session_bookmark_visit(s, false), PAPER_BAD_ARGUMENT);
    good(studio_session_present(s));
    assert_true(studio_session_undo(s)); /* with its deed the bookmark goes */
    assert_int_equal(studio_session_bookmark(s),
                     PAPER_BAD_ARGUMENT); /* what was undone stays */
    assert_true(studio_session_redo(s));
    good(studio_session_bookmark_visit(s, false));
    is_sheet_of(s, more, more_steps);
    studio_session_destroy(s);
}

static void another_present_begins(void **state)
{
    (void)state;
    static const struct hand *const anew[] = {&wash, &blue, &drop, NULL};
    static const int steps[] = {5, 4, 2};
    struct studio_session *s = painted(four, four_steps);
    good(studio_session_visit(s, 2));
    studio_session_from_here(s);
    assert_true(!studio_session_visits(s) && studio_session_can_redo(s));
    paint(s, &drop);
    good(studio_session_steps(s, 2, NULL));
    assert_int_equal(studio_session_deeds_done(s), 3);
    is_sheet_of(s, anew, steps);
    studio_session_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_are_visited),    cmocka_unit_test(deeds_are_inserted),
        cmocka_unit_test(deeds_are_taken_out),    cmocka_unit_test(deeds_are_changed),
        cmocka_unit_test(wet_moments_are_marked), cmocka_unit_test(changes_are_undone),
        cmocka_unit_test(another_present_begins), cmocka_unit_test(changes_are_redone),
        cmocka_unit_test(bookmarks_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
