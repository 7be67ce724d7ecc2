/* test_edits_low.c - edits below the rectangles, filter tables and gray at a size, and edits
 * for one setting of a variable font's axes.
 *
 * Gray must come back byte for byte from the picture that was edited; a filter of edits must
 * draw what a painter with that filter draws of the font as it is. */
#include "edits_support.h"
#include <atlas.h>
#include <display.h>
#include <levels.h>
#include <own.h>
#include <paint.h>

#include <stdlib.h>
#include <string.h>

enum { WIDE = 120, HIGH = 48 };

/* A text at a size and place. */
static void drawn(struct font_face *face, const char *text, double size_px, double x,
                  const char *filter, uint8_t *gray)
{
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    struct font_shaper *shaper = shaper_make(face);
    struct font_layout layout;
    struct font_cover cover = {WIDE, HIGH, WIDE, gray};
    def.filter = filter;
    memset(gray, 0, (size_t)WIDE * HIGH);
    assert_font(font_painter_create(&def, &painter));
    assert_font(font_shaper_layout(shaper, text, strlen(text), size_px, NULL, &layout));
    assert_font(font_painter_cover(painter, &layout, NULL, x, 36, &cover));
    font_layout_finish(&layout);
    font_painter_destroy(painter);
    font_shaper_destroy(shaper);
}

static bool same(const uint8_t *a, const uint8_t *b)
{
    return memcmp(a, b, (size_t)WIDE * HIGH) == 0;
}

static struct font_face *edited_open(const char *folder)
{
    struct font_face *face;
    assert_font(font_edits_open(folder, 0, false, &face));
    assert_null(font_edits_said());
    return face;
}

static uint8_t own[WIDE * HIGH], edited[WIDE * HIGH], wanted[WIDE * HIGH];

/* What the picture of a folder's gray has, put where its row says. */
static void gray_put(const char *folder, const char *file, int left, int top, int x,
                     uint8_t *gray)
{
    char path[600];
    struct display_image image;
    snprintf(path, sizeof path, "%s/%s", folder, file);
    assert_int_equal(display_png_read_gray(path, &image), DISPLAY_OK);
    memset(gray, 0, (size_t)WIDE * HIGH);
    for (int r = 0; r < image.height_px; r++)
        for (int c = 0; c < image.width_px; c++)
            gray[(36 + top + r) * WIDE + x + left + c] =
                (uint8_t)(255 - image.pixels[r * image.width_px + c]);
    display_image_destroy(&image);
}

static void retouch(const char *folder, const char *file)
{
    char path[600];
    struct display_image image;
    snprintf(path, sizeof path, "%s/%s", folder, file);
    assert_int_equal(display_png_read_gray(path, &image), DISPLAY_OK);
    for (int r = 4; r < 9; r++)
        for (int c = 3; c < 6; c++)
            image.pixels[r * image.width_px + c] = (uint8_t)(17 * r + 31 * c);
    assert_int_equal(display_png_write(path, &image), DISPLAY_OK);
    display_image_destroy(&image);
}

static void gray_at_a_size_is_drawn_as_it_was_edited(void **state)
{
    (void)state;
    const char *folder = scratch_path("gray");
    struct font_face *plain = face_open("DejaVuSans"), *face;
    struct font_edits_out what = {.glyph = font_face_glyph(plain, '&'),
                                  .level = FONT_EDITS_GRAY};
    char file[FONT_EDITS_FILE_BYTES], list[1024];
    int left, top;
    level_out(folder, plain, &what, 64, 21.5, "mitchell", file);
    assert_string_equal(file, "ampersand-21.5.png");
    assert_int_equal(sscanf(strstr(text_of(folder, "edits.txt", list, sizeof list), file),
                            "ampersand-21.5.png %*s 21.5 %d %d", &left, &top),
                     2);
    /* As it was written it is no edit, but it is what the levels have. */
    face = edited_open(folder);
    drawn(face, "&", 21.5, 20, "mitchell", edited);
    drawn(plain, "&", 21.5, 20, "mitchell", own);
    gray_put(folder, file, left, top, 20, wanted);
    assert_true(same(edited, own) && same(own, wanted) && !font_own_any(face));
    font_face_close(face);
    retouch(folder, file);
    face = edited_open(folder);
    /* At that size whatever the filter; its origin at the nearest whole pixel. */
    static const double places[] = {20, 20.3, 19.6, 20.4999};
    gray_put(folder, file, left, top, 20, wanted);
    assert_false(same(wanted, own));
    for (int i = 0; i < 4; i++) {
        drawn(face, "&", 21.5, places[i], i % 2 ? "box" : "cone", edited);
        assert_true(same(edited, wanted));
    }
    static const double others[] = {21.4, 21.51, 43};
    for (int i = 0; i < 3; i++) {
        drawn(face, "&", others[i], 20.3, "box", edited);
        drawn(plain, "&", others[i], 20.3, "box", own);
        assert_true(same(edited, own));
    }
    drawn(face, "ABC", 21.5, 20.3, "box", edited);
    drawn(plain, "ABC", 21.5, 20.3, "box", own);
    assert_true(same(edited, own));
    /* An atlas has the same pixels. */
    struct font_atlas_def def = font_atlas_def_default();
    struct font_atlas *atlas;
    struct font_atlas_slot slot;
    assert_font(font_atlas_create(&def, &atlas));
    assert_font(font_atlas_get(atlas, face, what.glyph, 21.5, NULL, 20.3, 36, &slot));
    assert_int_equal(slot.left_px, 20 + left);
    assert_int_equal(slot.top_px, 36 + top);
    for (int r = 0; r < slot.height_px; r++)
        assert_memory_equal(
            font_atlas_pixels(atlas, slot.page) + (slot.y + r) * def.width_px + slot.x,
            wanted + (slot.top_px + r) * WIDE + slot.left_px, (size_t)slot.width_px);
    font_atlas_destroy(atlas);
    font_face_close(face);
    font_face_close(plain);
}

/* A turned or sheared letter, and one that is drawn twice as large by a map, has its outline's
 * gray. */
static void gray_is_used_for_upright_letters_of_its_size(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    uint8_t pixels[6] = {1, 2, 3, 4, 5, 6};
    struct font_gray gray;
    const struct font_gray *got;
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    uint32_t glyph = font_face_glyph(face, 'a');
    assert_font(font_gray_put(&gray, &(struct font_gray_frame){-1, -2, 3, 2}, pixels, 3));
    uint64_t before = font_face_version(face);
    assert_font(font_own_gray_set(face, glyph, 24, &gray, false));
    assert_true(font_face_version(face) != before);
    assert_font(font_painter_create(&def, &painter));
    const struct font_map twice = {FONT_AFFINE, {2, 0, 0, 0, 2, 0}},
                          turned = font_map_rotation(0.1),
                          wide = {FONT_AFFINE, {1.01, 0, 0, 0, 1, 0}};
    assert_font(font_painter_glyph(painter, face, glyph, 24, NULL, 0.6, 0.2, &got));
    assert_true(got->width_px == 3 && got->left_px == 0 && got->top_px == -2 &&
                memcmp(got->pixels + got->pitch, pixels + 3, 3) == 0);
    assert_font(font_painter_glyph(painter, face, glyph, 12, &twice, 0, 0, &got));
    assert_true(got->width_px == 3 && got->left_px == -1);
    assert_font(font_painter_glyph(painter, face, glyph, 24, &twice, 0, 0, &got));
    assert_true(got->width_px > 20);
    assert_font(font_painter_glyph(painter, face, glyph, 24, &turned, 0, 0, &got));
    assert_true(got->width_px > 10);
    assert_font(font_painter_glyph(painter, face, glyph, 24, &wide, 0, 0, &got));
    assert_true(got->width_px > 10);
    /* Again it takes the former's place; no such glyph, no such size. */
    pixels[3] = 99;
    font_gray_finish(&gray);
    assert_font(font_gray_put(&gray, &(struct font_gray_frame){-1, -2, 3, 2}, pixels, 3));
    assert_font(font_own_gray_set(face, glyph, 24, &gray, false));
    assert_int_equal(font_own_gray(face, glyph, 24)->pixels[gray.pitch], 99);
    assert_int_equal(font_own_gray_set(face, 1u << 20, 24, &gray, false), FONT_NO_GLYPH);
    assert_int_equal(font_own_gray_set(face, glyph, 0, &gray, false), FONT_BAD_ARGUMENT);
    font_gray_finish(&gray);
    font_painter_destroy(painter);
    font_face_close(face);
}

static void filters_are_of_a_glyph_or_of_all_for_their_sizes(void **state)
{
    (void)state;
    const char *folder = scratch_path("filters");
    struct font_face *plain = face_open("DejaVuSans"), *face;
    char file[FONT_EDITS_FILE_BYTES], text[4096];
    const struct font_edits_out small = {.glyph = FONT_EVERY_GLYPH,
                                         .level = FONT_EDITS_FILTER,
                                         .to_px = 14},
                                of_a = {.glyph = font_face_glyph(plain, 'a'),
                                        .level = FONT_EDITS_FILTER};
    level_out(folder, plain, &small, 64, 12, "cone", file);
    assert_string_equal(file, "all-filter-0-14.txt");
    level_out(folder, plain, &of_a, 64, 12, "gaussian-slow", file);
    assert_string_equal(file, "a-filter.txt");
    /* The table is the filter, to what its 33 values leave out. */
    face = edited_open(folder);
    drawn(face, "HEad", 12, 20.3, "box", edited);
    drawn(plain, "HEad", 12, 20.3, "cone", own);
    int far = 0;
    for (int i = 0; i < 40 * HIGH; i++) { /* "HE" */
        int at = i / 40 * WIDE + i % 40, d = abs(edited[at] - own[at]);
        far = d > far ? d : far;
    }
    assert_true(far <= 1);
    font_face_close(face);
    put_text(folder, "a-filter.txt", "# for the bowl\ngaussian:\n0.8 2.5 # soft\n");
    face = edited_open(folder);
    static const struct {
        const char *text, *filter;
        double size;
    } rows[] = {{"a", "gaussian:0.8,2.5", 12}, {"a", "gaussian:0.8,2.5", 30}, {"b", "box", 14}};
    for (int i = 0; i < 3; i++) {
        drawn(face, rows[i].text, rows[i].size, 20.3, "box", edited);
        drawn(plain, rows[i].text, rows[i].size, 20.3, rows[i].filter, own);
        assert_true(same(edited, own));
    }
    /* The levels have the same filter. */
    struct font_edits *edits;
    struct font_levels *levels;
    struct font_filter_info info;
    assert_font(font_edits_read(folder, plain, &edits));
    assert_font(font_edits_levels(edits, plain, of_a.glyph, 64, 12, "box", &levels));
    font_filter_describe(font_levels_filter(levels), &info);
    assert_string_equal(info.name, "gaussian:0.8,2.5");
    font_levels_destroy(levels);
    font_edits_destroy(edits);
    font_face_close(face);
    /* A filter that is none. */
    put_text(folder, "a-filter.txt", "gaussian:,1\n");
    assert_int_equal(font_edits_open(folder, 0, false, &face), FONT_BAD_FILE);
    assert_non_null(strstr(font_error(), "a-filter.txt"));
    text_of(folder, "edits.txt", text, sizeof text);
    assert_non_null(strstr(text, "* filter all-filter-0-14.txt - 0 14\n"));
    font_face_close(plain);
}

static void a_font_has_few_filters_of_its_own(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    char words[40];
    for (int i = 0; i <= FONT_OWN_FILTERS_MAX; i++) {
        snprintf(words, sizeof words, "box:%g", 0.25 + i / 1024.0);
        for (int k = 0; k < 2; k++) /* the same again is no other */
            assert_int_equal(font_own_filter_set(face, (uint32_t)i, 0, 1e4, words, false),
                             i < FONT_OWN_FILTERS_MAX ? FONT_OK : FONT_TOO_LARGE);
    }
    assert_int_equal(font_own_filter_set(face, 5, 12, 12, "box", false), FONT_BAD_ARGUMENT);
    assert_null(font_own_filter(face, 100, 12));
    assert_non_null(font_own_filter(face, 5, 12));
    font_face_close(face);
}

static double left_of(struct font_face *face, uint32_t glyph, double wide)
{
    struct font_outline o;
    assert_font(font_face_axis_set(face, "wdth", wide));
    assert_font(font_face_outline(face, glyph, &o));
    double left = o.box.x0;
    font_outline_finish(&o);
    return left;
}

static void edits_may_be_for_one_setting_of_axes(void **state)
{
    (void)state;
    const char *folder = scratch_path("settings");
    char file[FONT_EDITS_FILE_BYTES], list[2048];
    assert_int_equal(mkdir(folder, 0777), 0);
    struct font_face *plain = wide_face_open(folder), *face;
    uint32_t glyph = font_face_glyph(plain, 'H');
    struct font_edits_out what = {.glyph = glyph, .level = FONT_EDITS_OUTLINE, .here = true};
    assert_font(font_face_axis_set(plain, "wdth", 105));
    level_out(folder, plain, &what, 64, 12, "box", file);
    assert_string_equal(file, "H-wdth105.svg");
    assert_non_null(strstr(text_of(folder, "edits.txt", list, sizeof list), " @wdth=105\n"));
    what.here = false;
    assert_font(font_face_axis_set(plain, "wdth", 100));
    level_out(folder, plain, &what, 64, 12, "box", file);
    assert_string_equal(file, "H.svg");
    what = (struct font_edits_out){.glyph = glyph, .level = FONT_EDITS_GRAY, .here = true};
    level_out(folder, plain, &what, 64, 12, "box", file);
    assert_non_null(strstr(text_of(folder, "edits.txt", list, sizeof list), " @\n"));
    retouch(folder, file); /* of the usual setting alone */
    static const char square[] = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d 1'>"
                                 "<path d='M%d 0H900V-900H%dZ'/></svg>";
    char svg[200];
    snprintf(svg, sizeof svg, square, 1050, 777, 777);
    put_text(folder, "H-wdth105.svg", svg);
    face = edited_open(folder);
    double usual = left_of(plain, glyph, 100), wider = left_of(plain, glyph, 105),
           widest = left_of(plain, glyph, 110);
    assert_true(usual != wider && wider != widest);
    for (int turn = 0; turn < 2; turn++) { /* versions are found again */
        assert_true(left_of(face, glyph, 100) == usual);
        uint64_t version = font_face_version(face);
        assert_non_null(font_own_gray(face, glyph, 12));
        assert_true(left_of(face, glyph, 105) == 777);
        double advance;
        assert_font(font_face_advance(face, glyph, &advance));
        assert_true(advance == 1050 && font_face_is_replaced(face, glyph));
        assert_null(font_own_gray(face, glyph, 12));
        assert_true(left_of(face, glyph, 110) == widest && !font_face_is_replaced(face, glyph));
        assert_true(left_of(face, glyph, 100) == usual && font_face_version(face) == version);
    }
    /* What holds for any setting does not count where the setting has its own. */
    snprintf(svg, sizeof svg, square, 1000, 333, 333);
    put_text(folder, "H.svg", svg);
    font_face_close(face);
    face = edited_open(folder);
    assert_true(left_of(face, glyph, 100) == 333 && left_of(face, glyph, 110) == 333 &&
                left_of(face, glyph, 105) == 777);
    struct font_edits *edits;
    struct font_levels *levels;
    assert_font(font_edits_read(folder, plain, &edits));
    struct font_axis axis;
    assert_font(font_face_axis(plain, 0, &axis));
    assert_true(axis.value == 110); /* as it was */
    assert_font(font_face_axis_set(plain, "wdth", 105));
    assert_font(font_edits_levels(edits, plain, glyph, 64, 12, "box", &levels));
    assert_true(font_levels_outline(levels)->box.x0 == 777);
    font_levels_destroy(levels);
    font_edits_destroy(edits);
    font_face_close(face);
    font_face_close(plain);
}

static void damaged_rows_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *row, *said;
    } bad[] = {{"* outline A.svg -\n", "A.svg"},
               {"* gray A.png - 12 0 0\n", "A.png"},
               {"A filter A.txt -\n", "edits.txt:5:"},
               {"A filter A.txt - 12\n", "edits.txt:5:"},
               {"A filter A.txt - 12 12\n", "edits.txt:5:"},
               {"A filter A.txt - nan 12\n", "edits.txt:5:"},
               {"A filter A.txt - 0 1e9\n", "edits.txt:5:"},
               {"A filter A.txt - 0 12 @wght=7\n", "has no axis 'wght'"},
               {"A filter A.txt - 0 12 @wght\n", "axes must be like"},
               {"A filter A.txt - 0 12 @ more\n", "edits.txt:5:"},
               {"A filter A.txt - 0 12\n* filter A.txt - 0 12\nA filter B.txt - 0 12\n",
                "two rows of its filter"},
               {"A gray A.png -\n", "edits.txt:5:"},
               {"A gray A.png - 0 0 0\n", "edits.txt:5:"},
               {"A gray A.png - 12 0 99999\n", "edits.txt:5:"},
               {"A gray A.txt - 12 0 0\n", "A.txt"}};
    char file[FONT_EDITS_FILE_BYTES], head[2048], text[4096];
    const char *folder = folder_with("damaged", "A", FONT_EDITS_FILTER, NULL, 64, file);
    text_of(folder, "edits.txt", head, sizeof head);
    *strstr(head, "A filter") = '\0';
    put_text(folder, "A.txt", "cone:1.5\n");
    put_text(folder, "B.txt", "cone:1.5\n");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct font_face *face;
        snprintf(text, sizeof text, "%s%s", head, bad[i].row);
        put_text(folder, "edits.txt", text);
        if (font_edits_open(folder, 0, false, &face) == FONT_OK ||
            !strstr(font_error(), bad[i].said))
            fail_msg("%s: %s", bad[i].row, font_error());
    }
}

static void levels_keep_gray_until_something_above_changes(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_outline o;
    struct font_levels *levels;
    const struct font_gray *got;
    const uint8_t pixels[2] = {200, 100};
    struct font_gray gray;
    assert_font(font_face_outline(face, font_face_glyph(face, 'a'), &o));
    assert_font(font_levels_create(&o, 64, 12, "box", &levels));
    assert_font(font_gray_put(&gray, &(struct font_gray_frame){3, -4, 2, 1}, pixels, 2));
    for (int change = 0; change < 4; change++) {
        assert_font(font_levels_gray_set(levels, &gray));
        assert_font(font_levels_gray(levels, 0.7, 0.4, &got));
        assert_true(got->left_px == 4 && got->top_px == -4 && got->width_px == 2 &&
                    got->pixels[1] == 100);
        if (change == 0)
            assert_font(font_levels_size_set(levels, 13));
        if (change == 1)
            assert_font(font_levels_filter_set(levels, "cone"));
        if (change == 2)
            assert_font(font_levels_master_fill(levels, 0, 0, 4, 4, true));
        if (change == 3)
            assert_font(font_levels_outline_set(levels, &o));
        assert_font(font_levels_gray(levels, 0.7, 0.4, &got));
        assert_true(got->width_px > 4);
    }
    font_gray_finish(&gray);
    font_levels_destroy(levels);
    font_outline_finish(&o);
    font_face_close(face);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gray_at_a_size_is_drawn_as_it_was_edited),
        cmocka_unit_test(gray_is_used_for_upright_letters_of_its_size),
        cmocka_unit_test(filters_are_of_a_glyph_or_of_all_for_their_sizes),
        cmocka_unit_test(a_font_has_few_filters_of_its_own),
        cmocka_unit_test(edits_may_be_for_one_setting_of_axes),
        cmocka_unit_test(damaged_rows_are_refused),
        cmocka_unit_test(levels_keep_gray_until_something_above_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
