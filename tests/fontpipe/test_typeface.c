/* test_typeface.c - all glyphs of a face at a size: each is as a painter draws it, stands apart
 * from the others, and none is missing. */
#include "support.h"

#include <own.h>
#include <paint.h>
#include <patience.h>
#include <typeface.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Those of the picture that a glyph does not have are 0, and none has them twice: owners counts
 * each pixel with the blank ring around its glyph. */
static void glyph_stands_apart(const struct font_typeface *t,
                               const struct font_typeface_glyph *g, uint8_t *owners)
{
    for (int y = g->y - 1; y <= g->y + g->height_px; y++)
        for (int x = g->x - 1; x <= g->x + g->width_px; x++) {
            const bool inside =
                y >= g->y && y < g->y + g->height_px && x >= g->x && x < g->x + g->width_px;
            assert_true(x >= 0 && y >= 0 && x < t->width_px && y < t->height_px);
            const size_t at = (size_t)y * (size_t)t->width_px + (size_t)x;
            if (inside)
                assert_int_equal(owners[at]++, 0);
            else
                assert_int_equal(t->pixels[at], 0);
        }
}

/* A pixel of a picture whose origin is the glyph's; 0 outside. */
static int painted_at(const struct font_gray *gray, int x, int y)
{
    x -= gray->left_px;
    y -= gray->top_px;
    return x >= 0 && y >= 0 && x < gray->width_px && y < gray->height_px
               ? gray->pixels[y * gray->pitch + x]
               : 0;
}

static int packed_at(const struct font_typeface *t, const struct font_typeface_glyph *g, int x,
                     int y)
{
    x -= g->left_px;
    y -= g->top_px;
    return x >= 0 && y >= 0 && x < g->width_px && y < g->height_px
               ? t->pixels[(g->y + y) * t->width_px + g->x + x]
               : 0;
}

/* The edges of the device's curves may begin a pixel earlier, where next to nothing is
 * covered. */
static int glyph_differs(const struct font_typeface *t, const struct font_typeface_glyph *g,
                         const struct font_gray *gray)
{
    int worst = 0;
    for (int y = gray->top_px - 3; y < gray->top_px + gray->height_px + 3; y++)
        for (int x = gray->left_px - 3; x < gray->left_px + gray->width_px + 3; x++) {
            const int d = abs(packed_at(t, g, x, y) - painted_at(gray, x, y));
            worst = d > worst ? d : worst;
        }
    assert_true(abs(g->left_px - gray->left_px) <= 2 && abs(g->top_px - gray->top_px) <= 2 &&
                abs(g->width_px - gray->width_px) <= 3 &&
                abs(g->height_px - gray->height_px) <= 3);
    return worst;
}

static void typeface_is_the_painters(struct font_face *face, double size_px, const char *filter)
{
    const struct font_typeface_def def = {.size_px = size_px, .filter = filter};
    struct font_painter_def painter_def = font_painter_def_default();
    struct font_painter *painter;
    struct font_face_info info;
    struct font_typeface t;
    int inked = 0, worst = 0;
    painter_def.filter = filter;
    painter_def.darken_px = 0;
    font_face_describe(face, &info);
    assert_font(font_painter_create(&painter_def, &painter));
    assert_font(font_typeface_draw(face, &def, &t));
    assert_int_equal(t.glyphs_count, info.glyphs_count);
    uint8_t *owners = calloc((size_t)t.width_px, (size_t)t.height_px);
    assert_non_null(owners);
    for (int i = 0; i < t.glyphs_count; i++) {
        const struct font_typeface_glyph *g = &t.glyphs[i];
        const struct font_gray *gray;
        double advance;
        assert_int_equal(g->glyph, i);
        assert_font(font_face_advance(face, g->glyph, &advance));
        assert_true(fabs(g->advance_px - advance * size_px / info.units_per_em) < 1e-9);
        assert_font(font_painter_glyph(painter, face, g->glyph, size_px, NULL, 0, 0, &gray));
        assert_int_equal(g->width_px > 0, gray->width_px > 0);
        if (!g->width_px)
            continue;
        const int differs = glyph_differs(&t, g, gray);
        worst = differs > worst ? differs : worst;
        glyph_stands_apart(&t, g, owners);
        inked++;
    }
    print_message("%s, %s at %g: %d of %d on the device, %dx%d, worst %d of 255\n", info.family,
                  filter, size_px, t.on_device_count, t.inked_count, t.width_px, t.height_px,
                  worst);
    assert_int_equal(inked, t.inked_count);
    assert_true(worst <= 1);
    free(owners);
    font_typeface_finish(&t);
    font_painter_destroy(painter);
}

static void each_glyph_is_there(void **state)
{
    (void)state;
    struct font_face *italic = face_open("EBGaramond12-Italic"),
                     *mono = face_open("DejaVuSansMono");
    typeface_is_the_painters(italic, 12.25, "gaussian-fast");
    typeface_is_the_painters(italic, 8.5, "cone");
    typeface_is_the_painters(mono, 31, "mitchell");
    font_face_close(italic);
    font_face_close(mono);
}

/* A wide one of 1,100 pixels and more is not for the device, and there all the same. */
static void what_the_device_cannot_draw_is_painted(void **state)
{
    (void)state;
    enum { BEAM = 40 };
    struct font_face *face = face_open("DejaVuSansMono");
    struct font_outline beam = {.units_per_em = 2048, .advance = 1000};
    const struct font_typeface_def def = {.size_px = 12.25, .filter = "box"};
    struct font_typeface t;
    assert_font(font_outline_move(&beam, 0, 0));
    assert_font(font_outline_line(&beam, 0, 400));
    assert_font(font_outline_line(&beam, 200000, 400));
    assert_font(font_outline_line(&beam, 200000, 0));
    assert_font(font_outline_prepare(&beam, FONT_NONZERO));
    assert_font(font_face_outline_replace(face, BEAM, &beam, NULL, false));
    assert_font(font_typeface_draw(face, &def, &t));
    assert_true(t.glyphs[BEAM].width_px > 1100);
    assert_int_equal(t.on_device_count, t.inked_count - 1);
    font_typeface_finish(&t);
    font_outline_finish(&beam);
    typeface_is_the_painters(face, 12.25, "box");
    /* Filters of its own: all are painted. */
    assert_font(font_own_filter_set(face, 50, 0, 100, "cone", false));
    assert_font(font_typeface_draw(face, &def, &t));
    assert_int_equal(t.on_device_count, 0);
    font_typeface_finish(&t);
    typeface_is_the_painters(face, 12.25, "box");
    font_face_close(face);
}

/* As one finds who asks for the glyph of each character in turn. */
static void characters_are_those_of_glyphs(void **state)
{
    (void)state;
    static const char *const fonts[] = {"EBGaramond12-Italic", "DejaVuSansMono"};
    for (size_t k = 0; k < sizeof fonts / sizeof *fonts; k++) {
        struct font_face *face = face_open(fonts[k]);
        struct font_face_info info;
        font_face_describe(face, &info);
        const size_t count = (size_t)info.glyphs_count;
        uint32_t *first = calloc(count, sizeof *first);
        const struct font_typeface_def def = {.size_px = 1, .filter = "box"};
        struct font_typeface t;
        assert_non_null(first);
        for (uint32_t c = 1; c < 0x110000; c++) {
            const uint32_t glyph = c >= 0xd800 && c < 0xe000 ? 0 : font_face_glyph(face, c);
            if (glyph && !first[glyph])
                first[glyph] = c;
        }
        assert_font(font_typeface_draw(face, &def, &t));
        for (size_t i = 0; i < count; i++)
            assert_int_equal(t.glyphs[i].character, first[i]);
        font_typeface_finish(&t);
        free(first);
        font_face_close(face);
    }
}

static bool impatient(void *context)
{
    int *asked = context;
    return ++*asked > 3;
}

/* With less memory than its pixels take, and where it takes too long. */
static void it_has_its_limits(void **state)
{
    (void)state;
    int asked = 0;
    struct font_face *face = face_open("DejaVuSansMono");
    struct font_typeface t;
    struct font_typeface_def def = {.size_px = 12, .filter = "box"};
    assert_font(font_typeface_draw(face, &def, &t));
    double glyphs_bytes = 0, picture_bytes = (double)t.width_px * t.height_px;
    for (int i = 0; i < t.glyphs_count; i++)
        glyphs_bytes += (double)t.glyphs[i].width_px * t.glyphs[i].height_px;
    font_typeface_finish(&t);
    def.pixels_bytes_max = glyphs_bytes + picture_bytes;
    assert_font(font_typeface_draw(face, &def, &t));
    font_typeface_finish(&t);
    for (int i = 0; i < 2; i++) {
        def.pixels_bytes_max = i ? glyphs_bytes : glyphs_bytes + picture_bytes - 1;
        assert_int_equal(font_typeface_draw(face, &def, &t), FONT_NO_MEMORY);
        assert_non_null(strstr(font_error(), "not enough memory"));
        assert_null(t.pixels);
    }
    def.pixels_bytes_max = 0;
    const struct patience before = patience_set((struct patience){impatient, &asked});
    assert_int_equal(font_typeface_draw(face, &def, &t), FONT_NO_MEMORY);
    patience_set(before);
    assert_int_equal(asked, 4);
    assert_null(t.glyphs);
    font_face_close(face);
}

static bool stops(void *context, int done, int count)
{
    int *asked = context;
    assert_true(done < count);
    return ++*asked < 2;
}

static void it_can_be_stopped_and_refused(void **state)
{
    (void)state;
    int asked = 0;
    struct font_face *face = face_open("DejaVuSansMono");
    struct font_typeface t;
    struct font_typeface_def def = {
        .size_px = 12, .filter = "box", .go_on = stops, .context = &asked};
    assert_int_equal(font_typeface_draw(face, &def, &t), FONT_NO_MEMORY);
    assert_int_equal(asked, 2);
    assert_null(t.pixels);
    assert_null(t.glyphs);
    def = (struct font_typeface_def){.size_px = 0};
    assert_int_equal(font_typeface_draw(face, &def, &t), FONT_BAD_ARGUMENT);
    def = (struct font_typeface_def){.size_px = 12, .filter = "no such"};
    assert_int_equal(font_typeface_draw(face, &def, &t), FONT_BAD_ARGUMENT);
    def = (struct font_typeface_def){.size_px = 12, .device = "no such"};
    assert_int_equal(font_typeface_draw(face, &def, &t), FONT_NO_DEVICE);
    def = (struct font_typeface_def){.size_px = 3000, .filter = "box"};
    assert_int_equal(font_typeface_draw(face, &def, &t), FONT_TOO_LARGE);
    assert_null(t.pixels);
    font_face_close(face);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_glyph_is_there),
        cmocka_unit_test(what_the_device_cannot_draw_is_painted),
        cmocka_unit_test(characters_are_those_of_glyphs),
        cmocka_unit_test(it_has_its_limits),
        cmocka_unit_test(it_can_be_stopped_and_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
