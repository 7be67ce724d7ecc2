/* test_studio_outlines.c - outlines that are hardly a selection, reach beyond the sheet or have
 * many corners: what fluid lies around them then, and what is said where they cannot be. The
 * oracle is where a fiber's middle lies. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "studio_selecting.h"

/* Fluid lies on each fiber whose middle is outside of the box. */
static void is_box(struct studio_session *s, int left, int top, int right, int bottom)
{
    float *fluid = selecting_layer(s, PAPER_LAYER_RESIST, 0);
    for (int i = 0; i < FIBERS; i++) {
        const int x = i % SCENE_WIDTH, y = i / SCENE_WIDTH;
        if (fluid[i] != !(x >= left && x < right && y >= top && y < bottom))
            fail_msg("fluid %g at %d, %d", (double)fluid[i], x, y);
    }
    free(fluid);
}

static void is_nothing(struct studio_session *s)
{
    assert_false(selecting_has(s));
    is_box(s, 0, 0, SCENE_WIDTH, SCENE_HEIGHT);
}

static void is_first(struct studio_session *s)
{
    assert_true(selecting_has(s));
    is_box(s, LEFT, TOP, RIGHT, BOTTOM);
}

/* ---- ways of a hand that are hardly a selection ---- */

static void lasso(struct studio_session *s, const double (*way)[2], int count)
{
    good(studio_session_set(s, STUDIO_TOOL, STUDIO_TOOL_SELECT));
    good(studio_session_set(s, STUDIO_OUTLINE, STUDIO_OUTLINE_LASSO));
    for (int i = 0; i < count; i++)
        selecting_point(s, i == 0 ? STUDIO_POINT_DOWN : STUDIO_POINT_MOVE, 1 + 0.01 * i,
                        way[i][0], way[i][1]);
    selecting_point(s, STUDIO_POINT_UP, 2, way[count - 1][0], way[count - 1][1]);
    good(studio_session_set(s, STUDIO_OUTLINE, STUDIO_OUTLINE_RECTANGLE));
}

/* Without area: where nothing is selected that is no deed, and else nothing is, afterwards. */
static void empty_lassos_select_nothing(void **state)
{
    (void)state;
    static const double click[][2] = {{30, 30}}, line[][2] = {{20, 20}, {60, 45}},
                        back[][2] = {{20, 20}, {60, 45}, {40, 32.5}, {28, 25}},
                        trembles[][2] = {{30, 30}, {30.3, 30}, {30, 30.3}, {29.8, 30}};
    static const struct {
        const double (*way)[2];
        int count;
    } ways[] = {{click, 1}, {line, 2}, {back, 4}, {trembles, 4}};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        struct studio_session *s = selecting_begin();
        lasso(s, ways[i].way, ways[i].count);
        is_nothing(s);
        assert_false(studio_session_can_undo(s));
        selecting_rectangle(s);
        for (int join = STUDIO_JOIN_ADD; join <= STUDIO_JOIN_SUBTRACT; join++) {
            good(studio_session_set(s, STUDIO_JOIN, join));
            lasso(s, ways[i].way, ways[i].count);
            is_first(s);
            assert_int_equal(studio_session_deeds_done(s), 1);
        }
        good(studio_session_set(s, STUDIO_JOIN, STUDIO_JOIN_NEW));
        lasso(s, ways[i].way, ways[i].count);
        is_nothing(s);
        assert_true(studio_session_undo(s));
        is_first(s);
        studio_session_destroy(s);
    }
}

/* A way that crosses itself selects on both sides, though one is gone around the other way. */
static void crossed_lassos_select_both_sides(void **state)
{
    (void)state;
    static const double bow[][2] = {{20, 12}, {60, 52}, {60, 12}, {20, 52}};
    struct studio_session *s = selecting_begin();
    lasso(s, bow, 4);
    assert_true(selecting_has(s));
    float *fluid = selecting_layer(s, PAPER_LAYER_RESIST, 0);
    int sides[2] = {0, 0};
    for (int i = 0; i < FIBERS; i++) {
        const double x = i % SCENE_WIDTH + 0.5 - 40, y = i / SCENE_WIDTH + 0.5 - 32,
                     part = fabs(x) - fabs(y);
        if (fabs(part) < 1.5) /* its soft edge */
            continue;
        const bool within = part > 0 && fabs(x) < 20;
        assert_true(fluid[i] == !within);
        sides[x > 0] += within;
    }
    assert_true(sides[0] > 300 && sides[0] == sides[1]);
    free(fluid);
    studio_session_destroy(s);
}

/* ---- beyond the sheet's edges ---- */

static void selections_reach_beyond_the_sheet(void **state)
{
    (void)state;
    struct studio_session *s = selecting_begin();
    good(studio_session_set(s, STUDIO_OUTLINE, STUDIO_OUTLINE_RECTANGLE));
    selecting_drag(s, STUDIO_TOOL_SELECT, -40, -3000, 30, 25);
    is_box(s, 0, 0, 30, 25);
    selecting_drag(s, STUDIO_TOOL_SELECT, SCENE_WIDTH + 900, 50, 70, SCENE_HEIGHT + 0.25);
    is_box(s, 70, 50, SCENE_WIDTH, SCENE_HEIGHT);
    const int deeds = studio_session_deeds_done(s);
    for (int join = STUDIO_JOIN_ADD; join <= STUDIO_JOIN_SUBTRACT; join++) {
        good(studio_session_set(s, STUDIO_JOIN, join)); /* nothing of the sheet: no deed */
        selecting_drag(s, STUDIO_TOOL_SELECT, -90, 10, -2, 60);
        selecting_drag(s, STUDIO_TOOL_SELECT, 10, SCENE_HEIGHT, 60, SCENE_HEIGHT + 40);
        assert_int_equal(studio_session_deeds_done(s), deeds);
    }
    is_box(s, 70, 50, SCENE_WIDTH, SCENE_HEIGHT);
    good(studio_session_set(s, STUDIO_JOIN, STUDIO_JOIN_ADD));
    selecting_drag(s, STUDIO_TOOL_SELECT, -5, 50, 75, SCENE_HEIGHT + 5);
    is_box(s, 0, 50, SCENE_WIDTH, SCENE_HEIGHT);
    good(studio_session_select_invert(s));
    is_box(s, 0, 0, SCENE_WIDTH, 50);
    int count, loops;
    const double *points = studio_session_selected(s, &count);
    studio_session_selected_loops(s, &loops);
    assert_int_equal(loops, 1); /* a line along the sheet's edges, which no corner leaves */
    for (int i = 0; i < count; i++)
        assert_true(points[2 * i] >= 0 && points[2 * i] <= SCENE_WIDTH &&
                    points[2 * i + 1] >= 0 && points[2 * i + 1] <= 50);
    selecting_drag(s, STUDIO_TOOL_DROP, 1, 48, 1, 48); /* at the edges of both */
    selecting_drag(s, STUDIO_TOOL_DROP, SCENE_WIDTH - 1, 2, SCENE_WIDTH - 1, 2);
    good(studio_session_steps(s, 10, NULL));
    float *water = selecting_layer(s, PAPER_LAYER_SURFACE_WATER, 0);
    double within = 0;
    for (int i = 0; i < FIBERS; i++) {
        within += i < 50 * SCENE_WIDTH ? (double)water[i] : 0;
        assert_true(i < 50 * SCENE_WIDTH || water[i] == 0);
    }
    assert_true(within > 0);
    free(water);
    studio_session_destroy(s);
}

/* So far away that numbers end: it says so, and all is as before. */
static void selections_too_far_away_are_told(void **state)
{
    (void)state;
    struct studio_session *s = selecting_begin();
    selecting_rectangle(s);
    const int operations = paper_history_done(studio_session_sheet(s));
    selecting_point(s, STUDIO_POINT_DOWN, 3, 10, 10);
    studio_session_error_forget();
    const struct studio_point far = {.kind = STUDIO_POINT_UP, .time_s = 4, .x = 2e7, .y = 50};
    assert_int_equal(studio_session_point(s, &far), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(studio_session_error(), "corners lie within"));
    assert_int_equal(paper_history_done(studio_session_sheet(s)), operations);
    is_first(s);
    studio_session_destroy(s);
}

/* ---- many corners ---- */

enum { SPIRAL_MOST = 18000 };

/* Along a spiral from the middle of the sheet, a place each 0.6 fibers. */
static void spiral(double *places, int count)
{
    double angle = 0;
    for (int i = 0; i < count; i++) {
        const double radius = 3 + 0.06 * angle;
        places[2 * i] = SCENE_WIDTH / 2.0 + radius * cos(angle);
        places[2 * i + 1] = SCENE_HEIGHT / 2.0 + radius * sin(angle);
        angle += 0.6 / radius;
    }
}

/* Corners are left out evenly: each place of the hand is near one that stays. */
static void lassos_have_few_corners(void **state)
{
    (void)state;
    static double way[2 * SPIRAL_MOST], corners[2 * SPIRAL_MOST];
    static const int counts[] = {3, STUDIO_LASSO_CORNERS, STUDIO_LASSO_CORNERS + 1, 9000,
                                 SPIRAL_MOST};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        const int count = counts[k];
        spiral(way, count);
        memcpy(corners, way, 2 * (size_t)count * sizeof *way);
        const int left = studio_lasso_points(corners, count, corners); /* in its own place */
        assert_true(left <= STUDIO_LASSO_CORNERS && 2.5 * left > fmin(count, 4000));
        assert_true(count > STUDIO_LASSO_CORNERS || left == count);
        assert_memory_equal(corners, way, 2 * sizeof *way);
        for (int i = 0, at = 0; i < count; i++) {
            if (at + 1 < left && way[2 * i] == corners[2 * at + 2] &&
                way[2 * i + 1] == corners[2 * at + 3])
                at++;
            assert_true(
                hypot(way[2 * i] - corners[2 * at], way[2 * i + 1] - corners[2 * at + 1]) < 8);
        }
    }
}

static enum paper_status spiral_select(struct studio_session *s, enum studio_join join)
{
    enum { CORNERS = STUDIO_LASSO_CORNERS };
    static double way[2 * CORNERS];
    enum paper_status status = PAPER_OK;
    spiral(way, CORNERS);
    good(studio_session_set(s, STUDIO_TOOL, STUDIO_TOOL_SELECT));
    good(studio_session_set(s, STUDIO_OUTLINE, STUDIO_OUTLINE_LASSO));
    good(studio_session_set(s, STUDIO_JOIN, join));
    for (int i = 0; i < CORNERS && status == PAPER_OK; i++) {
        const struct studio_point at = {.kind = i == 0            ? STUDIO_POINT_DOWN
                                                : i < CORNERS - 1 ? STUDIO_POINT_MOVE
                                                                  : STUDIO_POINT_UP,
                                        .time_s = 10 + 0.001 * i,
                                        .x = way[2 * i],
                                        .y = way[2 * i + 1],
                                        .pressure = 0.5};
        status = studio_session_point(s, &at);
    }
    good(studio_session_set(s, STUDIO_JOIN, STUDIO_JOIN_NEW));
    good(studio_session_set(s, STUDIO_OUTLINE, STUDIO_OUTLINE_RECTANGLE));
    return status;
}

/* One lasso of as many corners as there can be is a selection; a second one beside it does not
 * fit what is kept: it says so, and all is as before. */
static void too_many_corners_are_told(void **state)
{
    (void)state;
    struct studio_session *s = selecting_begin();
    good(spiral_select(s, STUDIO_JOIN_NEW));
    assert_true(selecting_has(s));
    float *before = selecting_layer(s, PAPER_LAYER_RESIST, 0);
    const int operations = paper_history_done(studio_session_sheet(s));
    studio_session_error_forget();
    assert_int_equal(spiral_select(s, STUDIO_JOIN_ADD), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(studio_session_error(), "too many corners"));
    assert_int_equal(paper_history_done(studio_session_sheet(s)), operations);
    assert_true(selecting_has(s));
    float *now = selecting_layer(s, PAPER_LAYER_RESIST, 0);
    assert_memory_equal(now, before, FIBERS * sizeof *now);
    free(now);
    free(before);
    selecting_rectangle(s); /* fewer parts */
    is_first(s);
    assert_true(studio_session_undo(s) && studio_session_undo(s));
    is_nothing(s);
    studio_session_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(empty_lassos_select_nothing),
        cmocka_unit_test(crossed_lassos_select_both_sides),
        cmocka_unit_test(selections_reach_beyond_the_sheet),
        cmocka_unit_test(selections_too_far_away_are_told),
        cmocka_unit_test(lassos_have_few_corners),
        cmocka_unit_test(too_many_corners_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
