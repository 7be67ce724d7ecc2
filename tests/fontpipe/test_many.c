/* test_many.c - many glyphs drawn at once on the OpenCL device are the same as drawn one by
 * one. */
#include "support.h"

#include <many.h>
#include <master.h>

#include <math.h>
#include <stdlib.h>

enum { GLYPHS = 60, SIZES = 3, JOBS = GLYPHS * SIZES };

static void many_are_as_one(void **state)
{
    (void)state;
    static const char *const filters[] = {"gaussian-fast", "cone", "lanczos", "box"};
    static const double sizes[] = {12.25, 31, 150}; /* the last is drawn in bands */
    struct font_face *face = face_open("EBGaramond12-Italic");
    struct font_face_info info;
    font_face_describe(face, &info);
    for (size_t n = 0; n < sizeof filters / sizeof *filters; n++) {
        struct font_filter *filter = filter_make(filters[n]);
        struct font_many *many;
        struct font_edges edges[JOBS] = {{0}};
        struct font_many_job jobs[JOBS];
        struct font_gray mine = {0};
        const struct font_gray *grays;
        assert_font(font_many_create(NULL, filter, &many));
        for (int k = 0; k < JOBS; k++) {
            struct font_outline outline;
            uint32_t letter = 33 + (uint32_t)(k * 7 % 94);
            assert_font(font_face_outline(face, font_face_glyph(face, letter), &outline));
            struct font_map map = font_map_size(sizes[k % SIZES], info.units_per_em);
            if (k % 5 == 0)
                map = font_map_then(map, font_map_rotation(k));
            assert_font(font_edges_build_tabled(&edges[k], &outline, &map, filter));
            jobs[k] = (struct font_many_job){font_many_edges(many, &edges[k]),
                                             (float)(k % 16) / 16, (float)(k % 7) / 7};
            assert_int_equal(jobs[k].edges, k);
            font_outline_finish(&outline);
        }
        assert_font(font_many_draw(many, jobs, JOBS, &grays));
        int worst = 0;
        long differ = 0, pixels = 0;
        for (int k = 0; k < JOBS; k++) {
            assert_font(font_gray_draw(&mine, &edges[k], filter, (double)jobs[k].x_px,
                                       (double)jobs[k].y_px));
            assert_int_equal(mine.width_px, grays[k].width_px);
            assert_int_equal(mine.height_px, grays[k].height_px);
            assert_int_equal(mine.left_px, grays[k].left_px);
            assert_int_equal(mine.top_px, grays[k].top_px);
            for (int r = 0; r < mine.height_px; r++)
                for (int c = 0; c < mine.width_px; c++) {
                    int d = abs(mine.pixels[r * mine.pitch + c] -
                                grays[k].pixels[r * grays[k].pitch + c]);
                    worst = d > worst ? d : worst;
                    differ += d != 0;
                    pixels++;
                }
        }
        print_message("%s: %ld of %ld pixels are rounded otherwise\n", filters[n], differ,
                      pixels);
        assert_true(worst <= 1 && differ * 1000 < pixels);
        /* Draws fewer and other glyphs again. */
        font_many_edges_forget(many);
        jobs[0].edges = font_many_edges(many, &edges[3]);
        assert_int_equal(jobs[0].edges, 0);
        assert_font(font_many_draw(many, jobs, 1, &grays));
        assert_true(grays[0].width_px > 0 && grays[0].pixels);
        assert_font(font_many_draw(many, jobs, 0, &grays));
        jobs[0].edges = 1;
        assert_int_equal(font_many_draw(many, jobs, 1, &grays), FONT_BAD_ARGUMENT);
        font_many_destroy(many);
        font_gray_finish(&mine);
        for (int k = 0; k < JOBS; k++)
            font_edges_finish(&edges[k]);
        font_filter_destroy(filter);
    }
    font_face_close(face);
}

static void what_cannot_be_is_said(void **state)
{
    (void)state;
    struct font_filter *filter = filter_make("box");
    struct font_many *many;
    assert_int_equal(font_many_create("no such device", filter, &many), FONT_NO_DEVICE);
    assert_null(many);
    assert_font(font_many_create(NULL, filter, &many));
    struct font_edges edges = {0}, wide = {0};
    const struct font_gray *grays;
    struct font_many_job job = {font_many_edges(many, &edges), 0, 0};
    assert_font(font_many_draw(many, &job, 1, &grays)); /* no ink, no picture */
    assert_int_equal(grays[0].width_px, 0);
    struct font_rectangle beam = {0, 0, 3000, 1};
    assert_font(font_rectangles_edges(
        &(struct font_rectangles){.items = &beam, .count = 1, .em_px = 1}, 1, &wide));
    job.edges = font_many_edges(many, &wide);
    assert_int_equal(font_many_draw(many, &job, 1, &grays), FONT_TOO_LARGE);
    font_edges_finish(&wide);
    font_many_destroy(many);
    font_filter_destroy(filter);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_are_as_one),
        cmocka_unit_test(what_cannot_be_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
