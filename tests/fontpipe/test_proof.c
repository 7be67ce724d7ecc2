/* test_proof.c - what a word keeps by a filter, counted again from its pixels; and what a font
 * has to choose from, read again from its tables. */
#include "support.h"

#include "made_font.h"

#include <own.h>
#include <paint.h>
#include <proof.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct font_proof proof_of(const struct font_layout *layout, const char *filter,
                                  enum font_display display, double x_height_px)
{
    struct font_proof proof;
    const struct font_proof_def def = {
        .layout = layout, .filter = filter, .display = display, .x_height_px = x_height_px};
    assert_font(font_proof_make(&def, &proof));
    return proof;
}

enum { WIDE = 200, HIGH = 60 };

static void word_cover(const struct font_layout *layout, const char *filter, uint8_t *gray)
{
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    struct font_box box;
    struct font_cover cover = {WIDE, HIGH, WIDE, gray};
    def.filter = filter;
    memset(gray, 0, (size_t)WIDE * HIGH);
    assert_font(font_painter_create(&def, &painter));
    assert_font(font_painter_measure(painter, layout, NULL, 0, 0, &box));
    assert_font(font_painter_cover(painter, layout, NULL, 20, 40, &cover)); /* whole pixels */
    font_painter_destroy(painter);
}

static void contrast_and_error_are_counted(void **state)
{
    (void)state;
    static const char *const filters[] = {"box", "cone", "gaussian-slow", "lanczos"};
    static uint8_t gray[WIDE * HIGH], exact[WIDE * HIGH];
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *shaper = shaper_make(face);
    struct font_layout layout;
    assert_font(font_shaper_layout(shaper, "Seine", 5, 14.6, NULL, &layout));
    word_cover(&layout, "box", exact);
    for (int f = 0; f < 4; f++) {
        double ink = 0, square = 0, error = 0;
        int count = 0;
        struct font_proof proof = proof_of(&layout, filters[f], FONT_DISPLAY_LCD, 8);
        word_cover(&layout, filters[f], gray);
        for (int i = 0; i < WIDE * HIGH; i++) {
            ink += gray[i];
            square += gray[i] * gray[i] / 255.0;
            error += (gray[i] - exact[i]) * (gray[i] - exact[i]);
            count += gray[i] || exact[i];
        }
        assert_true(fabs(proof.contrast - square / ink) < 1e-4);
        assert_true(fabs(proof.error - sqrt(error / count)) < 0.01);
        assert_true((proof.error == 0) == (f == 0));
    }
    font_layout_finish(&layout);
    font_shaper_destroy(shaper);
    font_face_close(face);
}

static void edges_are_as_wide_as_the_filter_says(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *shaper = shaper_make(face);
    struct font_layout layout;
    assert_font(font_shaper_layout(shaper, "n", 1, 20, NULL, &layout));
    /* 80 of 100 of a pixel; a Gaussian's tenth is 1.2816 sigma from its middle. */
    assert_true(fabs(proof_of(&layout, "box", FONT_DISPLAY_LCD, 10).edge_px - 0.8) < 1e-3);
    assert_true(fabs(proof_of(&layout, "gaussian:0.6,3", FONT_DISPLAY_LCD, 10).edge_px -
                     2 * 1.2816 * 0.6) < 2e-3);
    font_layout_finish(&layout);
    font_shaper_destroy(shaper);
    font_face_close(face);
}

static void softer_filters_are_read_from_nearer(void **state)
{
    (void)state;
    static const char *const filters[] = {"gaussian:0.3,2", "gaussian:0.6,3", "gaussian:0.9,4"};
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *shaper = shaper_make(face);
    for (int display = FONT_DISPLAY_LCD; display <= FONT_DISPLAY_PRINT; display++) {
        double before_size = 0;
        const bool lcd = display == FONT_DISPLAY_LCD;
        for (double size = lcd ? 10 : 20; size < (lcd ? 41 : 21); size *= 2) {
            struct font_layout layout;
            double before = 2;
            assert_font(font_shaper_layout(shaper, "wet", 3, size, NULL, &layout));
            for (int f = 0; f < (size > 30 ? 2 : 3); f++) {
                double reach =
                    proof_of(&layout, filters[f], (enum font_display)display, 0.547 * size)
                        .reach;
                assert_true(reach < before);
                before = reach;
                if (f == 1) { /* the larger, the nearer to type without pixels */
                    assert_true(reach > before_size && reach < 1);
                    before_size = reach;
                }
            }
            font_layout_finish(&layout);
        }
        assert_true(before_size > 0.85);
    }
    /* What cannot be measured. */
    struct font_layout layout;
    struct font_proof proof;
    assert_font(font_shaper_layout(shaper, " ", 1, 20, NULL, &layout));
    struct font_proof_def def = {.layout = &layout, .filter = "box", .x_height_px = 10};
    assert_int_equal(font_proof_make(&def, &proof), FONT_BAD_ARGUMENT);
    def.filter = "bax";
    assert_int_equal(font_proof_make(&def, &proof), FONT_BAD_ARGUMENT);
    def.x_height_px = NAN;
    assert_int_equal(font_proof_make(&def, &proof), FONT_BAD_ARGUMENT);
    font_layout_finish(&layout);
    font_shaper_destroy(shaper);
    font_face_close(face);
}

static void what_a_face_has_of_its_own_is_left_out_or_used(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *shaper = shaper_make(face);
    struct font_layout layout;
    struct font_proof plain, own;
    assert_font(font_own_filter_set(face, FONT_EVERY_GLYPH, 0, 100, "gaussian-slow", false));
    assert_font(font_shaper_layout(shaper, "wet", 3, 14, NULL, &layout));
    struct font_proof_def def = {.layout = &layout, .filter = "box", .x_height_px = 7};
    assert_font(font_proof_make(&def, &plain));
    def.own = true;
    assert_font(font_proof_make(&def, &own));
    assert_true(plain.error == 0 && own.error > 5 && own.reach < plain.reach);
    font_layout_finish(&layout);
    font_shaper_destroy(shaper);
    font_face_close(face);
}

/* ---- what there is to choose from ---- */

static unsigned get(const uint8_t *at, int bytes)
{
    unsigned value = 0;
    while (bytes--)
        value = value << 8 | *at++;
    return value;
}

static const uint8_t *table_of(const uint8_t *font, const char *tag)
{
    for (unsigned i = 0; i < get(font + 4, 2); i++)
        if (memcmp(font + 12 + 16 * i, tag, 4) == 0)
            return font + get(font + 12 + 16 * i + 8, 4);
    return NULL;
}

/* Whether a list of a layout table (at 4: scripts, at 6: features) has the tag. */
static bool list_has(const uint8_t *table, int list, const char *tag)
{
    const uint8_t *at = table + get(table + list, 2);
    for (unsigned i = 0; i < get(at, 2); i++)
        if (memcmp(at + 2 + 6 * i, tag, 4) == 0)
            return true;
    return false;
}

static void scripts_and_features_are_those_of_the_tables(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    size_t count;
    const uint8_t *bytes = font_face_bytes(face, &count);
    const uint8_t *tables[] = {table_of(bytes, "GSUB"), table_of(bytes, "GPOS")};
    for (int list = 4; list <= 6; list += 2) {
        static char tags[512][5], few[2][5];
        int found = font_face_tags(face, list == 6, tags, 512);
        assert_true(found > 5 && found < 512);
        assert_int_equal(font_face_tags(face, list == 6, few, 2), found);
        assert_string_equal(few[1], tags[1]);
        for (int i = 0; i < found; i++) {
            assert_true(list_has(tables[0], list, tags[i]) ||
                        list_has(tables[1], list, tags[i]));
            assert_true(i == 0 || strcmp(tags[i - 1], tags[i]) < 0);
        }
        for (int t = 0; t < 2; t++) {
            const uint8_t *at = tables[t] + get(tables[t] + list, 2);
            for (unsigned i = 0; i < get(at, 2); i++) {
                bool there = false;
                for (int k = 0; k < found; k++)
                    there |= memcmp(tags[k], at + 2 + 6 * i, 4) == 0;
                assert_true(there);
            }
        }
    }
    font_face_close(face);
}

static void named_places_on_axes_are_listed(void **state)
{
    (void)state;
    /* An axis with two names of places: the name table's 2 ("Book"), and one that it has
     * not. */
    static const uint8_t fvar[] = {0, 1, 0,   0,    0,   16,   0,   2, 0,  1, 0,  20, 0,
                                   2, 0, 8,   'w',  'd', 't',  'h', 0, 90, 0, 0,  0,  100,
                                   0, 0, 0,   110,  0,   0,    0,   0, 1,  0, 0,  2,  0,
                                   0, 0, 107, 0x80, 0,   0x7f, 0,   0, 0,  0, 95, 0,  0};
    struct font_face *plain = face_open("DejaVuSans"), *face;
    struct font_instance named;
    size_t count, wide_count, made_count;
    const uint8_t *bytes = font_face_bytes(plain, &count);
    uint8_t *wide = made_wide(bytes, count, &wide_count);
    const struct made_table table = {"fvar", fvar, sizeof fvar};
    uint8_t *made = made_font(wide, wide_count, &table, 1, &made_count);
    assert_font(font_face_open_memory(made, made_count, 0, &face));
    assert_int_equal(font_face_instances_count(face), 2);
    assert_font(font_face_instance(face, 0, &named));
    assert_string_equal(named.name, "Book");
    assert_true(named.values[0] == 107.5);
    assert_font(font_face_instance(face, 1, &named));
    assert_true(named.name[0] == '\0' && named.values[0] == 95);
    assert_int_equal(font_face_instance(face, 2, &named), FONT_BAD_ARGUMENT);
    assert_int_equal(font_face_instances_count(plain), 0);
    font_face_close(face);
    font_face_close(plain);
    free(made);
    free(wide);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contrast_and_error_are_counted),
        cmocka_unit_test(edges_are_as_wide_as_the_filter_says),
        cmocka_unit_test(softer_filters_are_read_from_nearer),
        cmocka_unit_test(what_a_face_has_of_its_own_is_left_out_or_used),
        cmocka_unit_test(scripts_and_features_are_those_of_the_tables),
        cmocka_unit_test(named_places_on_axes_are_listed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
