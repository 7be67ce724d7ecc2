/* test_drawing.c - what screens were drawn from: drawn again they are the same at their own
 * size, finer at another, and as they were read. */
#include <drawing.h>
#include <history.h>
#include <sheet.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sheet_calls.h"

enum { WIDTH = 90, HEIGHT = 60 };

static struct paper_line line_of(double size)
{
    return (struct paper_line){
        .text = "Rag", .font = "DejaVuSerif", .size_px = size, .anchor = 0.5, .angle_deg = 7};
}

/* Type whose origin is at 45.25, 40.5, times `scale`. */
static void type_set(double scale, struct paper_screen *screen, int *x, int *y)
{
    struct paper_line line = line_of(30 * scale);
    const double at_x = 45.25 * scale, at_y = 40.5 * scale;
    line.x_px = at_x - floor(at_x);
    line.y_px = at_y - floor(at_y);
    check(paper_line_screen(&line, screen, NULL));
    *x = (int)floor(at_x) - screen->origin_x_px;
    *y = (int)floor(at_y) - screen->baseline_y_px;
}

static void same(const struct paper_screen *a, const struct paper_screen *b)
{
    assert_int_equal(a->width_px, b->width_px);
    assert_int_equal(a->height_px, b->height_px);
    assert_memory_equal(a->gray, b->gray, (size_t)a->width_px * (size_t)a->height_px);
}

static void type_is_set_anew(void **state)
{
    (void)state;
    struct event_bytes b = {0};
    const struct paper_line line = line_of(30);
    assert_true(paper_drawing_line(&b, &line, 45.25, 40.5));
    for (int scale = 1; scale <= 3; scale++) {
        struct paper_screen set, drawn;
        int at[2], x, y;
        type_set(scale, &set, &at[0], &at[1]);
        check(paper_drawing_screen(&(struct paper_drawing){b.at, b.count, 1}, scale,
                                   WIDTH * scale, HEIGHT * scale, &drawn, &x, &y));
        same(&set, &drawn);
        assert_true(x == at[0] && y == at[1]);
        paper_screen_destroy(&set);
        paper_screen_destroy(&drawn);
    }
    struct paper_line file = line;
    file.font = "./a.ttf";
    assert_false(paper_drawing_line(&b, &file, 0, 0));
    free(b.at);
}

/* Half of what a square leaves of the sheet, without another square. */
static void joined_put(struct event_bytes *b)
{
    const double squares[2][8] = {{10, 10, 40, 10, 40, 40, 10, 40},
                                  {60, 20, 70, 20, 70, 30, 60, 30}};
    paper_drawing_polygon(b, squares[0], 4);
    paper_drawing_number(b, '-', 1, true);
    paper_drawing_number(b, '*', 0.5, false);
    paper_drawing_polygon(b, squares[1], 4);
    paper_drawing_join(b, '-');
}

static void shapes_are_joined(void **state)
{
    (void)state;
    struct event_bytes b = {0};
    joined_put(&b);
    struct paper_screen drawn;
    int x, y;
    check(paper_drawing_screen(&(struct paper_drawing){b.at, b.count, 1}, 2, 2 * WIDTH,
                               2 * HEIGHT, &drawn, &x, &y));
    assert_true(x == 0 && y == 0 && drawn.width_px == 2 * WIDTH &&
                drawn.height_px == 2 * HEIGHT);
    for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) {
        const int column = i % (2 * WIDTH), row = i / (2 * WIDTH);
        const bool first = column >= 20 && column < 80 && row >= 20 && row < 80,
                   second = column >= 120 && column < 140 && row >= 40 && row < 60;
        assert_int_equal(drawn.gray[i], first || second ? 0 : 128);
    }
    paper_screen_destroy(&drawn);
    free(b.at);
}

/* Bytes that were changed by chance, or cut off, are drawn or refused; nothing else is read or
 * written. */
static void damaged_bytes_are_refused(void **state)
{
    (void)state;
    struct event_bytes b = {0};
    joined_put(&b);
    const struct paper_line line = line_of(20);
    assert_true(paper_drawing_line(&b, &line, 45, 40));
    paper_drawing_join(&b, '+');
    uint32_t chance = 1;
    int refused = 0;
    for (int turn = 0; turn < 400; turn++) {
        uint8_t *bytes = malloc(b.count);
        assert_non_null(bytes);
        memcpy(bytes, b.at, b.count);
        chance = chance * 1664525 + 1013904223;
        const size_t at = (chance >> 8) % b.count;
        bytes[at] = (uint8_t)(bytes[at] ^ 1u << turn % 8);
        struct paper_screen drawn;
        int x, y;
        refused +=
            paper_drawing_screen(&(struct paper_drawing){bytes, turn % 5 ? b.count : at, 1}, 1,
                                 WIDTH, HEIGHT, &drawn, &x, &y) != PAPER_OK;
        paper_screen_destroy(&drawn);
        free(bytes);
    }
    assert_true(refused > 80);
    free(b.at);
}

/* What type put on a sheet leaves there, in a render at 2 and after saving, is what type set
 * twice as large leaves. */
static void renders_set_type_anew(void **state)
{
    (void)state;
    static float anew[4 * WIDTH * HEIGHT], wanted[4 * WIDTH * HEIGHT];
    struct paper_sheet *sheets[2], *render;
    struct event_bytes b = {0};
    const struct paper_line line = line_of(30);
    assert_true(paper_drawing_line(&b, &line, 45.25, 40.5));
    for (int i = 0; i < 2; i++) {
        struct paper_sheet_config config = paper_sheet_config_default();
        config.width = WIDTH << i;
        config.height = HEIGHT << i;
        config.pigments_count = 1;
        config.pigments[0] = *paper_pigment_find("french ultramarine");
        check(paper_sheet_create(&config, &sheets[i]));
        check(paper_history_begin(sheets[i], 0));
        struct paper_screen screen;
        int x, y;
        type_set(1 << i, &screen, &x, &y);
        struct paper_drawing drawing = {b.at, b.count, 1};
        screen.drawing = i ? NULL : &drawing;
        check(paper_sheet_put(sheets[i], &screen, x, y, (double[]){0.5, 0.75}));
        paper_screen_destroy(&screen);
    }
    check(paper_history_render(sheets[0], 2, 4, 0, &render));
    check(paper_sheet_layer_read(render, PAPER_LAYER_SURFACE_PIGMENT, 0, anew));
    check(paper_sheet_layer_read(sheets[1], PAPER_LAYER_SURFACE_PIGMENT, 0, wanted));
    assert_memory_equal(anew, wanted, sizeof wanted);
    paper_sheet_destroy(render);
    paper_sheet_destroy(sheets[0]);
    paper_sheet_destroy(sheets[1]);
    free(b.at);
}

/* All that lies around polygons is known by what it lies around, and nothing else is. */
static void what_lies_within(void **state)
{
    (void)state;
    const double points[] = {4, 4, 40, 4, 40, 30, 4, 30}, others[] = {20, 10, 60, 10, 60, 50};
    struct event_bytes b = {0};
    paper_drawing_polygon(&b, points, 4);
    assert_int_equal(paper_drawing_within(&(struct paper_drawing){b.at, b.count, 1}), 0);
    paper_drawing_polygon(&b, others, 3);
    assert_int_equal(paper_drawing_within(&(struct paper_drawing){b.at, b.count, 1}), 0);
    paper_drawing_join(&b, '-');
    const size_t within = b.count;
    paper_drawing_number(&b, '-', 1, true);
    const size_t around = b.count;
    assert_int_equal(paper_drawing_within(&(struct paper_drawing){b.at, around, 1}), within);
    for (size_t i = 0; i < around; i++) /* cut anywhere it is no drawing */
        assert_int_equal(paper_drawing_within(&(struct paper_drawing){b.at, i, 1}), 0);
    paper_drawing_number(&b, '-', 1, true); /* turned back: around that which is around */
    assert_int_equal(paper_drawing_within(&(struct paper_drawing){b.at, b.count, 1}), around);
    b.count = around;
    paper_drawing_number(&b, '-', 0.5, true);
    assert_int_equal(paper_drawing_within(&(struct paper_drawing){b.at, b.count, 1}), 0);
    b.count = within;
    paper_drawing_number(&b, '-', 1, false);
    assert_int_equal(paper_drawing_within(&(struct paper_drawing){b.at, b.count, 1}), 0);
    b.count = 0;
    const struct paper_line line = line_of(30);
    assert_true(paper_drawing_line(&b, &line, 45.25, 40.5));
    paper_drawing_number(&b, '-', 1,
                         true); /* type is no part of the sheet that is drawn around */
    assert_int_equal(paper_drawing_within(&(struct paper_drawing){b.at, b.count, 1}), 0);
    free(b.at);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_lies_within),      cmocka_unit_test(type_is_set_anew),
        cmocka_unit_test(shapes_are_joined),     cmocka_unit_test(damaged_bytes_are_refused),
        cmocka_unit_test(renders_set_type_anew),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
