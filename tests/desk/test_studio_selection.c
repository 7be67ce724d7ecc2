/* test_studio_selection.c - what is selected, and what stays inside: paint, water, fluid, salt
 * and varnish; that fluid which a hand has painted is what it was when nothing is selected any
 * more; that a selection is undone, saved and found again. The oracle of a selection is
 * masking fluid that this test puts around it by its own numbers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "studio_selecting.h"

enum { NUMBERS = 3 * FIBERS };
static uint16_t seen[NUMBERS], expected[NUMBERS];

static void look(struct studio_session *s, uint16_t *rgb)
{
    const struct paper_sheet_config config = scene_config();
    const struct paper_sheet_view view = paper_sheet_view_default(&config);
    good(paper_sheet_view(studio_session_sheet(s), &view, rgb));
}

static bool inside(int i)
{
    const int x = i % SCENE_WIDTH, y = i / SCENE_WIDTH;
    return x >= LEFT && x < RIGHT && y >= TOP && y < BOTTOM;
}

/* Something of it is inside, and nothing outside. */
static void is_inside(struct studio_session *s, enum paper_layer layer, int pigment)
{
    float *values = selecting_layer(s, layer, pigment);
    double sum = 0;
    for (int i = 0; i < FIBERS; i++) {
        if (!inside(i) && values[i] != 0)
            fail_msg("layer %d: %g at %d, %d", (int)layer, (double)values[i], i % SCENE_WIDTH,
                     i / SCENE_WIDTH);
        sum += (double)values[i];
    }
    assert_true(sum > 0);
    free(values);
}

/* ---- what stays inside ---- */

static void fluid_around(struct studio_session *s)
{
    static uint8_t gray[FIBERS];
    const struct paper_screen around = {
        .width_px = SCENE_WIDTH, .height_px = SCENE_HEIGHT, .gray = gray};
    for (int i = 0; i < FIBERS; i++)
        gray[i] = inside(i) ? 0 : 255;
    good(paper_sheet_resist(studio_session_sheet(s), &around, 0, 0, true));
}

/* All that puts paint, across the edge and with more water than the fibers hold. */
static void paint(struct studio_session *s)
{
    good(studio_session_set(s, STUDIO_WATER, 1.5));
    good(studio_session_set(s, STUDIO_TOOL, STUDIO_TOOL_BRUSH));
    good(scene_sweep(s, 30, 4, true));
    selecting_drag(s, STUDIO_TOOL_WASH, 4, 4, 60, 40);
    selecting_drag(s, STUDIO_TOOL_DROP, RIGHT - 1, 40, RIGHT - 1, 40);
    selecting_drag(s, STUDIO_TOOL_SPLATTER, 30, 30, 60, 40);
    good(studio_session_set(s, STUDIO_TYPE_SIZE, 30));
    good(studio_session_type(s, &(struct studio_type){"Ag", "DejaVuSans", "", 8.5, 56}));
    good(studio_session_steps(s, 25, NULL));
}

static void paint_stays_inside(void **state)
{
    (void)state;
    struct studio_session *s = selecting_begin(), *other = selecting_begin();
    assert_false(selecting_has(s));
    selecting_rectangle(s);
    assert_true(selecting_has(s));
    paint(s);
    is_inside(s, PAPER_LAYER_SURFACE_PIGMENT, 0);
    is_inside(s, PAPER_LAYER_INFUSED_PIGMENT, 0);
    is_inside(s, PAPER_LAYER_FIXED_PIGMENT, 0);
    is_inside(s, PAPER_LAYER_SURFACE_WATER, 0);
    is_inside(s, PAPER_LAYER_INFUSED_WATER, 0);
    fluid_around(other);
    paint(other);
    look(s, seen);
    look(other, expected);
    assert_memory_equal(seen, expected, sizeof seen);
    studio_session_destroy(other);
    /* and when nothing is selected, the rest takes paint again */
    good(studio_session_select_none(s));
    assert_false(selecting_has(s));
    selecting_drag(s, STUDIO_TOOL_DROP, 85, 60, 85, 60);
    float *values = selecting_layer(s, PAPER_LAYER_SURFACE_PIGMENT, 0);
    double out = 0;
    for (int i = 0; i < FIBERS; i++)
        out += inside(i) ? 0 : (double)values[i];
    assert_true(out > 0);
    free(values);
    studio_session_destroy(s);
}

static void salt_and_varnish_stay_inside(void **state)
{
    (void)state;
    struct studio_session *s = selecting_begin();
    selecting_rectangle(s);
    good(studio_session_set(s, STUDIO_WIDTH, 14));
    selecting_drag(s, STUDIO_TOOL_VARNISH, 2, 2, 94, 70);
    selecting_drag(s, STUDIO_TOOL_VARNISH, 2, TOP, 94, TOP);
    is_inside(s, PAPER_LAYER_VARNISH, 0);
    selecting_drag(s, STUDIO_TOOL_SALT, 40, 30, 40, 30);
    float *salt = selecting_layer(s, PAPER_LAYER_SALT, 0);
    double most = 0;
    for (int i = 0; i < FIBERS; i++) { /* a grain reaches less than 3 fibers from its middle */
        const int x = i % SCENE_WIDTH, y = i / SCENE_WIDTH;
        if (x < LEFT - 3 || x >= RIGHT + 3 || y < TOP - 3 || y >= BOTTOM + 3)
            assert_true(salt[i] == 0);
        most = fmax(most, (double)salt[i]);
    }
    assert_true(most > 0);
    free(salt);
    studio_session_destroy(s);
}

/* ---- fluid of the hand ---- */

static void fluid_sweep(struct studio_session *s, enum studio_tool_number tool, double y)
{
    good(studio_session_set(s, STUDIO_TOOL, tool));
    /* what is rubbed off is wider: no soft edge is left */
    good(studio_session_set(s, STUDIO_WIDTH, tool == STUDIO_TOOL_MASK ? 9 : 13));
    good(scene_sweep(s, y, 1, true));
}

/* How far inside of the ellipse a fiber is, as a part of its way from the middle: below 1. */
static double ellipse_part(int i)
{
    return hypot((i % SCENE_WIDTH + 0.5 - 46) / 24, (i / SCENE_WIDTH + 0.5 - 34) / 22);
}

/* Painted on before; inside of the selection one is rubbed off and another one painted on. When
 * nothing is selected, that is all that has changed. */
static void fluid_of_the_hand_stays(void **state)
{
    (void)state;
    struct studio_session *s = selecting_begin(), *first = selecting_begin(),
                          *second = selecting_begin();
    fluid_sweep(s, STUDIO_TOOL_MASK, 26);
    good(studio_session_set(s, STUDIO_OUTLINE, STUDIO_OUTLINE_ELLIPSE));
    selecting_drag(s, STUDIO_TOOL_SELECT, 46 - 24, 34 - 22, 46 + 24, 34 + 22);
    fluid_sweep(s, STUDIO_TOOL_UNMASK, 26);
    fluid_sweep(s, STUDIO_TOOL_MASK, 42);
    assert_true(selecting_has(s));
    good(studio_session_select_none(s));
    assert_false(selecting_has(s));
    fluid_sweep(first, STUDIO_TOOL_MASK, 26);
    fluid_sweep(second, STUDIO_TOOL_MASK, 42);
    float *fluid = selecting_layer(s, PAPER_LAYER_RESIST, 0),
          *before = selecting_layer(first, PAPER_LAYER_RESIST, 0),
          *within = selecting_layer(second, PAPER_LAYER_RESIST, 0);
    int kept = 0, rubbed = 0, painted = 0, left = 0;
    for (int i = 0; i < FIBERS; i++) {
        const double part = ellipse_part(i);
        const float wanted = part > 1.1 ? before[i] : within[i];
        if (part > 0.9 && part < 1.1) /* its soft edge */
            continue;
        assert_true(fabs((double)(fluid[i] - wanted)) < 1e-6);
        kept += part > 1 && before[i] > 0;
        left += part > 1 && within[i] > 0;
        rubbed += part < 1 && before[i] > 0;
        painted += part < 1 && within[i] > 0;
    }
    assert_true(kept > 20 && rubbed > 20 && painted > 20 && left > 20);
    free(fluid);
    free(before);
    free(within);
    studio_session_destroy(first);
    studio_session_destroy(second);
    studio_session_destroy(s);
}

/* ---- back and forth, files ---- */

static void selections_are_deeds(void **state)
{
    (void)state;
    char path[] = "/tmp/lutetia-selection-XXXXXX.h5";
    struct studio_session *s = selecting_begin();
    int count, file = mkstemps(path, 3);
    assert_true(file >= 0);
    close(file);
    good(studio_session_select_none(s)); /* nothing was selected: no deed */
    assert_false(studio_session_can_undo(s));
    selecting_rectangle(s);
    good(studio_session_set(s, STUDIO_TOOL, STUDIO_TOOL_BRUSH));
    good(scene_sweep(s, 30, 1, true));
    selecting_drag(s, STUDIO_TOOL_SELECT, 30, 30, 30, 30); /* a click */
    assert_false(selecting_has(s));
    assert_true(studio_session_undo(s));
    assert_true(selecting_has(s));
    good(studio_session_save(s, path));
    studio_session_destroy(s);
    good(studio_session_open(path, 64e6, &s));
    unlink(path);
    const double *points = studio_session_selected(s, &count);
    assert_int_equal(count, 4);
    assert_true(points[0] == LEFT && points[1] == TOP && points[4] == RIGHT &&
                points[5] == BOTTOM);
    assert_true(studio_session_undo(s) && studio_session_undo(s));
    assert_false(selecting_has(s));
    assert_true(studio_session_redo(s));
    assert_true(selecting_has(s));
    good(studio_session_visit(s, 0));
    assert_false(selecting_has(s));
    good(studio_session_present(s));
    assert_true(selecting_has(s));
    selecting_drag(s, STUDIO_TOOL_SELECT, -50, -50, -10, -10); /* off the sheet: nothing is */
    assert_false(selecting_has(s));
    studio_session_destroy(s);
}

/* A way around, drawn by hand; and at twice the resolution its edges are as sharp. */
static void lassos_are_drawn_anew(void **state)
{
    (void)state;
    struct studio_session *s = selecting_begin();
    struct paper_sheet *twice;
    static float fluid[4 * FIBERS];
    good(studio_session_set(s, STUDIO_TOOL, STUDIO_TOOL_SELECT));
    good(studio_session_set(s, STUDIO_OUTLINE, STUDIO_OUTLINE_LASSO));
    selecting_point(s, STUDIO_POINT_DOWN, 1, 20, 12);
    selecting_point(s, STUDIO_POINT_MOVE, 1.1, 70, 12);
    selecting_point(s, STUDIO_POINT_MOVE, 1.2, 70, 12.1); /* too near to be a corner */
    selecting_point(s, STUDIO_POINT_MOVE, 1.3, 70, 52);
    selecting_point(s, STUDIO_POINT_UP, 1.4, 20, 52);
    int count;
    assert_non_null(studio_session_selected(s, &count));
    assert_int_equal(count, 4);
    good(paper_history_render(studio_session_sheet(s), 2, 4, -1, &twice));
    good(paper_sheet_layer_read(twice, PAPER_LAYER_RESIST, 0, fluid));
    for (int i = 0; i < 4 * FIBERS; i++) {
        const int x = i % (2 * SCENE_WIDTH) / 2, y = i / (2 * SCENE_WIDTH) / 2;
        assert_true(fluid[i] == (inside(y * SCENE_WIDTH + x) ? 0 : 1));
    }
    paper_sheet_destroy(twice);
    studio_session_destroy(s);
}

/* ---- more and less of the sheet ---- */

enum { FROM = 40, TO = 84, UPPER = 30, LOWER = 66 }; /* another rectangle, across the first */

static bool other(int i)
{
    const int x = i % SCENE_WIDTH, y = i / SCENE_WIDTH;
    return x >= FROM && x < TO && y >= UPPER && y < LOWER;
}

static void select_other(struct studio_session *s, enum studio_join join)
{
    good(studio_session_set(s, STUDIO_JOIN, join));
    selecting_drag(s, STUDIO_TOOL_SELECT, FROM, UPPER, TO, LOWER);
    good(studio_session_set(s, STUDIO_JOIN, STUDIO_JOIN_NEW));
}

enum { OF_FIRST = 1, OF_BOTH, OF_FIRST_ALONE, OF_OTHER, OF_NEITHER, OF_ALL };

static bool is_of(int i, int which)
{
    switch (which) {
    case OF_FIRST:
        return inside(i);
    case OF_BOTH:
        return inside(i) || other(i);
    case OF_FIRST_ALONE:
        return inside(i) && !other(i);
    case OF_OTHER:
        return other(i);
    case OF_NEITHER:
        return !inside(i) && !other(i);
    default:
        return true;
    }
}

/* Fluid lies on all that is not selected, and nowhere else; the outline's loops. */
static void is_selected(struct studio_session *s, int which, int loops, int line)
{
    float *fluid = selecting_layer(s, PAPER_LAYER_RESIST, 0);
    int count, now;
    const double *points = studio_session_selected(s, &count);
    studio_session_selected_loops(s, &now);
    if ((points != NULL) != (which != OF_ALL) || now != loops)
        fail_msg("line %d: %d loops, %s", line, now, points ? "selected" : "nothing");
    for (int i = 0; i < FIBERS; i++)
        if (fabs((double)fluid[i] - !is_of(i, which)) > 1e-6)
            fail_msg("line %d: fluid %g at %d, %d", line, (double)fluid[i], i % SCENE_WIDTH,
                     i / SCENE_WIDTH);
    free(fluid);
}
#define is_now(which, loops) is_selected(s, which, loops, __LINE__)

/* Each change is one deed: one undo, one redo, and taken out of the past as one. */
static void selections_are_changed(void **state)
{
    (void)state;
    char path[] = "/tmp/lutetia-selection-XXXXXX.h5";
    struct studio_session *s = selecting_begin();
    int deeds, file = mkstemps(path, 3);
    assert_true(file >= 0);
    close(file);
    good(studio_session_select_invert(s)); /* nothing was selected: no deed */
    assert_false(studio_session_can_undo(s));
    selecting_rectangle(s);
    is_now(OF_FIRST, 1);
    select_other(s, STUDIO_JOIN_NEW);
    is_now(OF_OTHER, 1);
    assert_int_equal(studio_session_deeds_done(s), 2);
    assert_true(studio_session_undo(s));
    is_now(OF_FIRST, 1);
    assert_true(studio_session_redo(s));
    is_now(OF_OTHER, 1);
    assert_true(studio_session_undo(s));
    select_other(s, STUDIO_JOIN_ADD);
    is_now(OF_BOTH, 1);
    good(studio_session_select_invert(s));
    is_now(OF_NEITHER, 2);
    good(studio_session_save(s, path));
    studio_session_destroy(s);
    good(studio_session_open(path, 64e6, &s));
    unlink(path);
    is_now(OF_NEITHER, 2);
    good(studio_session_select_invert(s));
    is_now(OF_BOTH, 1);
    assert_true(studio_session_undo(s) && studio_session_undo(s) && studio_session_undo(s));
    is_now(OF_FIRST, 1);
    select_other(s, STUDIO_JOIN_SUBTRACT);
    is_now(OF_FIRST_ALONE, 1);
    struct studio_deed *list;
    good(studio_session_deeds(s, &list, &deeds));
    assert_int_equal(deeds, studio_session_deeds_done(s));
    assert_string_equal(list[deeds - 1].what, "selection");
    free(list);
    select_other(s, STUDIO_JOIN_NEW);
    good(studio_session_remove(s)); /* both operations of it */
    is_now(OF_FIRST_ALONE, 1);
    assert_int_equal(studio_session_deeds_done(s), deeds);
    assert_true(studio_session_undo(s));
    is_now(OF_OTHER, 1);
    assert_true(studio_session_redo(s));
    is_now(OF_FIRST_ALONE, 1);
    selecting_drag(s, STUDIO_TOOL_SELECT, 30, 30, 30, 30); /* a click selects nothing, */
    is_now(OF_ALL, 0);
    select_other(s, STUDIO_JOIN_ADD); /* and then something is, as two deeds */
    is_now(OF_OTHER, 1);
    assert_int_equal(studio_session_deeds_done(s), deeds + 2);
    studio_session_destroy(s);
}

/* Of nothing is taken out what is drawn; what adds up to the sheet is no selection. */
static void selections_end(void **state)
{
    (void)state;
    struct studio_session *s = selecting_begin();
    int count, loops;
    select_other(s, STUDIO_JOIN_SUBTRACT);
    assert_non_null(studio_session_selected(s, &count));
    studio_session_selected_loops(s, &loops);
    assert_int_equal(loops, 2); /* along the sheet, and around the hole */
    float *fluid = selecting_layer(s, PAPER_LAYER_RESIST, 0);
    for (int i = 0; i < FIBERS; i++)
        assert_true(fluid[i] == other(i));
    free(fluid);
    select_other(s, STUDIO_JOIN_ADD);
    is_now(OF_ALL, 0);
    selecting_rectangle(s);
    good(studio_session_set(s, STUDIO_JOIN, STUDIO_JOIN_ADD));
    const int deeds = studio_session_deeds_done(s);
    selecting_drag(s, STUDIO_TOOL_SELECT, 30, 30, 30,
                   30); /* a click adds nothing, and is no deed */
    is_now(OF_FIRST, 1);
    assert_int_equal(studio_session_deeds_done(s), deeds);
    good(studio_session_set(s, STUDIO_JOIN, STUDIO_JOIN_SUBTRACT));
    selecting_drag(s, STUDIO_TOOL_SELECT, -5, -5, SCENE_WIDTH + 5, SCENE_HEIGHT + 5);
    is_now(OF_ALL, 0);
    studio_session_destroy(s);
}

/* Fluid that a hand has painted stays through other selections, and where it is selected then,
 * it is rubbed off. */
static void fluid_stays_through_others(void **state)
{
    (void)state;
    struct studio_session *s = selecting_begin(), *alone = selecting_begin();
    fluid_sweep(alone, STUDIO_TOOL_MASK, 44);
    fluid_sweep(s, STUDIO_TOOL_MASK, 44);
    selecting_rectangle(s);
    select_other(s, STUDIO_JOIN_NEW);
    float *now = selecting_layer(s, PAPER_LAYER_RESIST, 0),
          *hand = selecting_layer(alone, PAPER_LAYER_RESIST, 0);
    int both = 0;
    for (int i = 0; i < FIBERS; i++) {
        assert_true(fabs((double)now[i] - (other(i) ? (double)hand[i] : 1)) < 1e-6);
        both += other(i) && hand[i] > 0 && inside(i);
    }
    assert_true(both > 20);
    free(now);
    fluid_sweep(s, STUDIO_TOOL_UNMASK, 44); /* within what is selected */
    good(studio_session_select_none(s));
    now = selecting_layer(s, PAPER_LAYER_RESIST, 0);
    int kept = 0;
    for (int i = 0; i < FIBERS; i++) {
        assert_true(fabs((double)now[i] - (other(i) ? 0 : (double)hand[i])) < 1e-6);
        kept += now[i] > 0;
    }
    assert_true(kept > 20);
    free(now);
    free(hand);
    studio_session_destroy(alone);
    studio_session_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paint_stays_inside),
        cmocka_unit_test(salt_and_varnish_stay_inside),
        cmocka_unit_test(fluid_of_the_hand_stays),
        cmocka_unit_test(selections_are_deeds),
        cmocka_unit_test(lassos_are_drawn_anew),
        cmocka_unit_test(selections_are_changed),
        cmocka_unit_test(selections_end),
        cmocka_unit_test(fluid_stays_through_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
