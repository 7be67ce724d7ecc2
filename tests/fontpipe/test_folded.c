/* test_folded.c - glyphs through maps that fold: outlines mapped as short lines equal those
 * mapped as curves, and a region that is covered from both sides counts once. */
#include "support.h"

#include <gray.h>
#include <paint.h>

#include <math.h>
#include <stdlib.h>

static const struct font_map same = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}};

static double sum_of(const struct font_gray *gray)
{
    double sum = 0;
    for (int y = 0; y < gray->height_px; y++)
        for (int x = 0; x < gray->width_px; x++)
            sum += gray->pixels[y * gray->pitch + x] / 255.0;
    return sum;
}

static int pixel(const struct font_gray *gray, int x, int y)
{
    x -= gray->left_px;
    y -= gray->top_px;
    return x < 0 || y < 0 || x >= gray->width_px || y >= gray->height_px
               ? 0
               : gray->pixels[y * gray->pitch + x];
}

/* Draws the outline mapped as short lines. */
static void mapped_draw(struct font_gray *gray, const struct font_outline *outline,
                        const struct font_map *map, const struct font_filter *filter)
{
    struct font_outline mapped;
    struct font_edges edges = {0};
    assert_font(font_outline_mapped(outline, map, &mapped));
    assert_font(font_outline_prepare(&mapped, FONT_NONZERO));
    assert_font(font_edges_build(&edges, &mapped, &same, filter));
    assert_font(font_gray_draw(gray, &edges, filter, 0, 0));
    font_edges_finish(&edges);
    font_outline_finish(&mapped);
}

/* Maps that do not fold give the same picture both ways. */
static void lines_are_the_curves(void **state)
{
    (void)state;
    static const enum font_map_kind kinds[] = {FONT_PROJECTIVE, FONT_BILINEAR, FONT_SMOOTH};
    struct font_face *face = face_open("DejaVuSans");
    struct font_filter *filter = filter_make("gaussian-fast");
    uint32_t chance = 7;
    int worst = 0;
    for (int k = 0; k < 60; k++) {
        struct font_outline raw, outline;
        struct font_map map;
        struct font_point q[4] = {{20, 20}, {90, 20}, {90, 110}, {20, 110}};
        uint32_t glyph = font_face_glyph(face, (uint32_t) "Sg&@QRa8%m"[k % 10]);
        for (int i = 0; i < 4; i++) {
            q[i].x += 24 * random_unit(&chance) - 12;
            q[i].y += 24 * random_unit(&chance) - 12;
        }
        struct font_map size = font_map_size(100, 2048);
        assert_font(font_map_corners(kinds[k % 3], 0, -90, 90, 30, q, &map));
        assert_font(font_map_compose(&size, &map, &map));
        assert_font(font_face_outline(face, glyph, &outline));
        assert_font(font_face_outline_raw(face, glyph, &raw));
        struct font_edges edges = {0};
        struct font_gray one = {0}, two = {0};
        assert_font(font_edges_build(&edges, &outline, &map, filter));
        assert_font(font_gray_draw(&one, &edges, filter, 0, 0));
        mapped_draw(&two, &raw, &map, filter);
        for (int y = 0; y < 140; y++)
            for (int x = 0; x < 140; x++)
                worst = (int)fmax(worst, abs(pixel(&one, x, y) - pixel(&two, x, y)));
        font_gray_finish(&one);
        font_gray_finish(&two);
        font_edges_finish(&edges);
        font_outline_finish(&outline);
        font_outline_finish(&raw);
    }
    if (worst > 4)
        fail_msg("a pixel differs by %d of 255", worst);
    font_filter_destroy(filter);
    font_face_close(face);
}

/* A square whose sides cross covers two triangles. A square with a dent, or with a corner
 * folded over, covers the inside of its boundary. */
static void folded_squares_cover_once(void **state)
{
    (void)state;
    static const struct {
        struct font_point q[4];
        double area;
    } cases[] = {
        {{{10, 10}, {90, 10}, {10, 90}, {90, 90}}, 80 * 80 / 2.0}, /* two sides crossed */
        {{{10, 10}, {10, 90}, {90, 10}, {90, 90}}, 80 * 80 / 2.0}, /* the other two */
        {{{10, 10}, {90, 10}, {30, 30}, {10, 90}}, 80 * 20},       /* a dent */
        {{{10, 10}, {90, 10}, {90, 90}, {10, 90}}, 80 * 80},       /* none of it */
    };
    struct font_filter *filter = filter_make("gaussian-fast");
    struct font_outline square = {.units_per_em = 1};
    assert_font(font_outline_move(&square, 0, 0));
    assert_font(font_outline_line(&square, 1, 0));
    assert_font(font_outline_line(&square, 1, 1));
    assert_font(font_outline_line(&square, 0, 1));
    assert_font(font_outline_close(&square));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct font_map map;
        struct font_gray gray = {0};
        assert_font(font_map_corners(FONT_SMOOTH, 0, 0, 1, 1, cases[i].q, &map));
        mapped_draw(&gray, &square, &map, filter);
        if (fabs(sum_of(&gray) / cases[i].area - 1) > 0.004)
            fail_msg("case %zu: %.1f for %.1f", i, sum_of(&gray), cases[i].area);
        font_gray_finish(&gray);
    }
    font_outline_finish(&square);
    font_filter_destroy(filter);
}

/* With any corners a painter draws the glyph or reports that it cannot, and never draws beyond
 * the corners' reach. */
static void painters_draw_through_any_corners(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    assert_font(font_painter_create(&def, &painter));
    uint32_t chance = 3;
    int drawn = 0, cases = 600;
    for (int k = 0; k < cases; k++) {
        struct font_point q[4];
        struct font_map map;
        const struct font_gray *gray;
        for (int i = 0; i < 4; i++)
            q[i] = (struct font_point){120 * random_unit(&chance), 120 * random_unit(&chance)};
        if (k % 7 == 0)
            q[3] = q[k / 7 % 3]; /* two in one place */
        assert_font(font_map_corners(FONT_SMOOTH, 0, -90, 80, 30, q, &map));
        enum font_status status = font_painter_glyph(
            painter, face, font_face_glyph(face, (uint32_t) "breakdown"[k % 9]), 100, &map, 0,
            0, &gray);
        assert_true(status == FONT_OK || status == FONT_BAD_ARGUMENT ||
                    status == FONT_TOO_LARGE);
        drawn += status == FONT_OK && sum_of(gray) > 0;
    }
    if (drawn < cases * 95 / 100)
        fail_msg("only %d of %d", drawn, cases);
    font_painter_destroy(painter);
    font_face_close(face);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_are_the_curves),
        cmocka_unit_test(folded_squares_cover_once),
        cmocka_unit_test(painters_draw_through_any_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
