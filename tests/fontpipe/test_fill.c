/* test_fill.c - two ways to find areas that are covered twice must agree: from the curves
 * (fill_quick.c) and by strips (fill.c). Tests all glyphs of several fonts, and random
 * tangles. */
#include "outline_area.h"
#include "support.h"

#include <fill_internal.h>
#include <outline.h>

#include <math.h>
#include <stdlib.h>

static void work_free(struct fill_work *w)
{
    free(w->portions);
    free(w->arcs);
    free(w->boxes);
    free(w->joints);
    free(w->meets);
    free(w->links);
}

/* Compares both ways on an outline that is not prepared, and finishes it. False: their areas
 * differ by more than tolerance. */
static bool alike(struct font_outline *o, enum font_fill rule, double tolerance, bool *seen,
                  bool *rebuilt)
{
    struct font_outline strips;
    struct fill_work w = {0};
    int least = 0, most = 0;
    assert_font(font_outline_copy(o, &strips));
    *seen = fill_quick(&w, o, rule, false, &least, &most) ||
            fill_quick(&w, o, rule, true, &least, &most);
    work_free(&w);
    assert_font(font_outline_prepare(o, rule));
    assert_font(font_outline_prepare_by_strips(&strips, rule));
    *rebuilt = o->rebuilt;
    assert_false(*seen && o->rebuilt != fill_twice(least, most));
    bool same = fabs(outline_area(o) - outline_area(&strips)) <= tolerance &&
                (o->rebuilt || o->turn == strips.turn);
    font_outline_finish(o);
    font_outline_finish(&strips);
    return same;
}

/* All glyphs of fonts with separate contours and of fonts with overlapping ones. */
static void glyphs_are_filled_as_by_strips(void **state)
{
    (void)state;
    static const char *const names[] = {"DejaVuSerif-Bold", "EBGaramond12-Italic",
                                        "C059-Roman.otf", TYPE_1_FONT};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct font_face *face = face_open(names[i]);
        struct font_face_info info;
        int glyphs = 0, seen_count = 0, rebuilt_count = 0;
        font_face_describe(face, &info);
        for (int g = 0; g < info.glyphs_count; g++) {
            struct font_outline o;
            bool seen, rebuilt;
            assert_font(font_face_outline_raw(face, (uint32_t)g, &o));
            if (!alike(&o, FONT_NONZERO, 2e-6 * info.units_per_em * info.units_per_em, &seen,
                       &rebuilt))
                fail_msg("%s, glyph %d: other ink than by strips", names[i], g);
            glyphs++;
            seen_count += seen;
            rebuilt_count += rebuilt;
        }
        print_message("%s: %d glyphs, %d from the curves, %d rebuilt\n", names[i], glyphs,
                      seen_count, rebuilt_count);
        assert_true(seen_count > 0.97 * glyphs);
        font_face_close(face);
    }
}

/* Random curves that cross each other often. Every fourth contour has corners on whole numbers,
 * so that many points coincide. */
static void random_tangles_are_filled_as_by_strips(void **state)
{
    (void)state;
    enum { TANGLES = 600 };
    uint32_t seed = 1987;
    int seen_count = 0, rebuilt_count = 0;
    for (int n = 0; n < TANGLES; n++) {
        struct font_outline o = {0};
        bool seen, rebuilt, whole = n % 4 == 3;
        for (int c = 0; c < 1 + n % 3; c++) {
            assert_font(font_outline_move(&o, 500, whole ? 500 : 1000 * random_unit(&seed)));
            for (int k = 0; k < 3 + n % 4; k++) {
                double p[6];
                for (int i = 0; i < 6; i++)
                    p[i] =
                        whole ? floor(8 * random_unit(&seed)) * 125 : 1000 * random_unit(&seed);
                int degree = 1 + (int)(3 * random_unit(&seed));
                assert_font(degree == 1 ? font_outline_line(&o, p[0], p[1])
                            : degree == 2
                                ? font_outline_quad(&o, p[0], p[1], p[2], p[3])
                                : font_outline_cubic(&o, p[0], p[1], p[2], p[3], p[4], p[5]));
            }
            assert_font(font_outline_close(&o));
        }
        /* Strips replace curves by chords, which miss the curve by a 32768th of the outline. */
        if (!alike(&o, n & 1 ? FONT_EVEN_ODD : FONT_NONZERO, 60, &seen, &rebuilt))
            fail_msg("tangle %d: other ink than by strips", n);
        if (!whole)
            seen_count += seen;
        rebuilt_count += rebuilt;
    }
    print_message("%d of %d from the curves, %d rebuilt\n", seen_count, TANGLES * 3 / 4,
                  rebuilt_count);
    assert_true(seen_count > 0.95 * TANGLES * 3 / 4);
    assert_true(rebuilt_count > TANGLES / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glyphs_are_filled_as_by_strips),
        cmocka_unit_test(random_tangles_are_filled_as_by_strips),
    };
    return cmocka_run_group_tests_name("fill", tests, NULL, NULL);
}
