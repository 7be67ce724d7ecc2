/* test_panel.c - the panel and the help at sizes and scales: all of it can be reached, and none
 * of it is outside of the picture. `test_panel FOLDER` writes pictures to look at. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <exact.h>
#include <help_sheet.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_springs.h"

static struct font_face *face;
static const char *folder;

static const struct {
    int width, height;
    double px;
} sizes[] = {{1280, 720, 1}, {2560, 1440, 2}, {640, 360, 1},
             {700, 500, 2},  {320, 240, 1},   {1000, 2000, 1}};
enum { SIZES = sizeof sizes / sizeof *sizes };

static void picture_write(const char *name, int i, struct stage *stage,
                          const struct stage_draw_list *list)
{
    char path[600];
    struct stage_exact *exact;
    struct display_image image = {sizes[i].width, sizes[i].height, 3, NULL};
    if (!folder)
        return;
    assert_int_equal(stage_exact_create("gaussian-fast", &exact), STAGE_OK);
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    assert_int_equal(stage_exact_draw(exact, list, stage_background(stage), &image), STAGE_OK);
    snprintf(path, sizeof path, "%s/%s-%dx%d.png", folder, name, sizes[i].width,
             sizes[i].height);
    assert_int_equal(display_png_write(path, &image), DISPLAY_OK);
    display_image_destroy(&image);
    stage_exact_destroy(exact);
}

static const struct help_row *rows_make(int *count)
{
    static struct help_row rows[24];
    static char names[24][24];
    for (int i = 0; i < 24; i++) {
        snprintf(names[i], sizeof names[i], i ? "Control %c" : "Shift, or press hard", 'A' + i);
        rows[i] = (struct help_row){names[i],
                                    i % 5 ? "stop, go on" : "as it was in the very beginning"};
    }
    *count = 24;
    return rows;
}

/* The glyphs that a list has from an item on, and whether they are all within a box. */
static int glyphs_in(const struct stage_draw_list *list, int from, struct font_box box,
                     bool *inside)
{
    int glyphs = 0;
    for (int i = from; i < list->count; i++)
        if (list->items[i].kind == STAGE_DRAW_GLYPH) {
            const struct stage_glyph *g = &list->items[i].glyph;
            glyphs++;
            *inside = *inside && g->x_px >= box.x0 && g->x_px + 0.6 * g->size_px <= box.x1 &&
                      g->y_px <= box.y1 && g->y_px - 0.8 * g->size_px >= box.y0;
        }
    return glyphs;
}

static void help_fits(void **state)
{
    (void)state;
    int count, most = 0;
    const struct help_row *rows = rows_make(&count);
    struct stage *stage = scene_springs("word", 1, face);
    struct stage_panel *panel;
    struct stage_draw_list list = {0};
    assert_int_equal(stage_panel_create("DejaVuSans", &panel), STAGE_OK);
    for (int i = 0; i < SIZES; i++) {
        const int width = sizes[i].width, height = sizes[i].height;
        struct help_sheet sheet = {.shown = true};
        struct input_event wheel = {.kind = INPUT_SCROLL, .scroll_y = -1};
        bool inside = true;
        int seen = 0, looks = 0;
        for (double at = -1; sheet.scrolled_px != at && looks < 100; looks++) {
            at = looks ? sheet.scrolled_px : -1;
            stage_draw_begin(&list, STAGE_VIEW_PIXELS);
            help_sheet_draw(&sheet, rows, count, panel, stage_theme(stage), width, height,
                            sizes[i].px, &list);
            seen += glyphs_in(&list, 0, sheet.box, &inside);
            if (!looks)
                picture_write("help", i, stage, &list);
            if (!help_sheet_input(&sheet, &wheel))
                fail_msg("the wheel does not scroll");
        }
        most = i == 0 ? seen / looks : most;
        const struct font_box *b = &sheet.box;
        if (!inside || b->x0 < 0 || b->y0 < 0 || b->x1 > width || b->y1 > height)
            fail_msg("%dx%d: outside: %g to %g, %g to %g", width, height, b->x0, b->x1, b->y0,
                     b->y1);
        if (seen < most || (sheet.most_px > 0) != (looks > 2))
            fail_msg("%dx%d: %d of %d glyphs in %d looks", width, height, seen, most, looks);
    }
    stage_draw_finish(&list);
    stage_panel_destroy(panel);
    stage_destroy(stage);
}

/* Each row can be shown, with what it does beside the panel, or over the stage where the panel
 * takes most of the picture. */
static void rows_are_shown(void **state)
{
    (void)state;
    struct stage *stage = scene_springs("word", 1, face);
    struct stage_panel *panel;
    struct stage_draw_list list = {0};
    int count;
    const struct control *rows = stage_controls(stage, &count);
    assert_int_equal(stage_panel_create("DejaVuSans", &panel), STAGE_OK);
    stage_panel_show(panel, true);
    for (int i = 0; i < SIZES; i++) {
        const int width = sizes[i].width, height = sizes[i].height;
        const int beside = stage_panel_beside(panel, stage, width, sizes[i].px);
        const double panel_px = 300 * sizes[i].px;
        assert_int_equal(beside, panel_px <= 2.0 / 3 * width ? width - (int)panel_px : width);
        for (int row = 0; row < count; row++) {
            struct font_box slider, value;
            stage_panel_reveal(panel, row);
            for (int look = 0; look < 2; look++) {
                stage_picture(stage, beside, height, sizes[i].px, &list);
                stage_panel_draw(panel, stage, width, height, sizes[i].px, &list);
                if (!stage_panel_place(panel, row, &slider, &value))
                    fail_msg("%dx%d: %s is not shown", width, height, rows[row].name);
                const struct input_event move = {.kind = INPUT_POINTER_MOVE,
                                                 .x_px = slider.x0,
                                                 .y_px = (slider.y0 + slider.y1) / 2};
                stage_panel_input(panel, stage, &move);
            }
            int left = 0;
            for (int k = 0; k < list.count; k++) {
                const struct stage_glyph *g = &list.items[k].glyph;
                if (list.items[k].kind != STAGE_DRAW_GLYPH || g->size_px != 12 * sizes[i].px)
                    continue;
                left += g->x_px < width - panel_px;
                assert_true(g->x_px >= 0 || width < 1.3 * panel_px);
            }
            const int wanted = width - panel_px > 12 * 12 * sizes[i].px ? 4 : 0;
            if (left < wanted)
                fail_msg("%dx%d: %s is not explained", width, height, rows[row].name);
            if (row == 1 || row == count - 1 || strcmp(rows[row].name, "friction") == 0)
                picture_write(row == 1           ? "panel"
                              : row == count - 1 ? "panel-end"
                                                 : "panel-long",
                              i, stage, &list);
        }
    }
    stage_draw_finish(&list);
    stage_panel_destroy(panel);
    stage_destroy(stage);
}

/* What is explained is what the pointer is on, also where the rows have been scrolled under it
 * or a group has been folded above it. */
static void what_is_under_the_pointer_is_explained(void **state)
{
    (void)state;
    struct stage *stage = scene_springs("word", 1, face);
    struct stage_panel *panel;
    struct stage_draw_list list = {0};
    struct font_box slider, value, title;
    assert_int_equal(stage_panel_create("DejaVuSans", &panel), STAGE_OK);
    stage_panel_show(panel, true);
    stage_panel_draw(panel, stage, 900, 500, 1, &list);
    assert_int_equal(stage_panel_explained(panel), -1);
    assert_true(stage_panel_place(panel, 3, &slider, &value));
    const struct input_event move = {
        .kind = INPUT_POINTER_MOVE, .x_px = value.x0 + 2, .y_px = (value.y0 + value.y1) / 2};
    stage_panel_input(panel, stage, &move);
    stage_panel_draw(panel, stage, 900, 500, 1, &list);
    assert_int_equal(stage_panel_explained(panel), 3);
    for (int turns = 1; turns <= 3; turns++) {
        struct input_event wheel = {
            .kind = INPUT_SCROLL, .scroll_y = -1, .x_px = move.x_px, .y_px = move.y_px};
        assert_true(stage_panel_input(panel, stage, &wheel));
        stage_panel_draw(panel, stage, 900, 500, 1, &list);
        const int row = stage_panel_explained(panel);
        assert_true(row > 3 || turns == 3); /* a title may be there */
        assert_true(row < 0 || (stage_panel_place(panel, row, &slider, &value) &&
                                fabs((value.y0 + value.y1) / 2 - move.y_px) < 40));
    }
    struct input_event back = {
        .kind = INPUT_SCROLL, .scroll_y = 3, .x_px = move.x_px, .y_px = move.y_px};
    stage_panel_input(panel, stage, &back);
    stage_panel_draw(panel, stage, 900, 500, 1, &list);
    assert_int_equal(stage_panel_explained(panel), 3);
    assert_true(stage_panel_title(panel, 3, &title));
    const struct input_event fold = {.kind = INPUT_POINTER_DOWN,
                                     .button = INPUT_BUTTON_LEFT,
                                     .x_px = title.x0 + 5,
                                     .y_px = (title.y0 + title.y1) / 2};
    stage_panel_input(panel, stage, &fold);
    stage_panel_draw(panel, stage, 900, 500, 1, &list);
    assert_int_not_equal(stage_panel_explained(panel), 3);
    stage_draw_finish(&list);
    stage_panel_destroy(panel);
    stage_destroy(stage);
}

int main(int count, char **arguments)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(help_fits),
        cmocka_unit_test(rows_are_shown),
        cmocka_unit_test(what_is_under_the_pointer_is_explained),
    };
    folder = count > 1 ? arguments[1] : NULL;
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK) {
        print_message("%s\n", font_error());
        return 77;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    font_face_close(face);
    return failed;
}
