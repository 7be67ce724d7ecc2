/* test_paints.c - graphs of paints (COLR 1) and SVG in fonts made here, beside what their
 * colours must be by their definitions. */
#include "../skip.h"
#include "support.h"

#include "made_font.h"

#include <colour.h>
#include <colour_mix.h>
#include <colour_read.h>
#include <edges.h>
#include <paint.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* An em of 2048 units is drawn at 128 pixels, so a pixel is 16 units; the origin is at pixel
 * (16, 112). */
enum { SIDE = 144, EM = 2048, SIZE = 128, LEFT = 16, BASE = 112, ONE = 0x4000 };
/* COLR's formats of paints. */
enum {
    LAYERS = 1,
    SOLID = 2,
    LINEAR = 4,
    RADIAL = 6,
    SWEEP = 8,
    GLYPH = 10,
    COLR_GLYPH = 11,
    TRANSFORM = 12,
    TRANSLATE = 14,
    SCALE_CENTRE = 18,
    ROTATE = 24,
    ROTATE_CENTRE = 26,
    SKEW = 28,
    COMPOSITE = 32
};
enum { RED, GREEN, HALF_BLUE, INK = 0xffff };
static const uint8_t palette[][4] = {{0, 0, 255, 255}, {0, 255, 0, 255}, {255, 0, 0, 128}};

static uint8_t page[2][SIDE * SIDE * 3];
static struct font_face *plain;
static unsigned block, letter, base; /* a full block, an R, and the painted glyph */

static int plain_open(void **state)
{
    (void)state;
    plain = face_open("DejaVuSans");
    block = font_face_glyph(plain, 0x2588);
    letter = font_face_glyph(plain, 'R');
    base = font_face_glyph(plain, 'A');
    return block && letter && base ? 0 : 1;
}

static int plain_close(void **state)
{
    (void)state;
    font_face_close(plain);
    return 0;
}

static struct font_face *face_make(const struct made_table *tables, int tables_count)
{
    size_t count, made_count;
    struct font_face *face;
    const uint8_t *bytes = font_face_bytes(plain, &count);
    uint8_t *made = made_font(bytes, count, tables, tables_count, &made_count);
    assert_font(font_face_open_memory(made, made_count, 0, &face));
    free(made);
    return face;
}

/* Opens the font with these paints, and frees them. */
static struct font_face *painted(struct made_paints *p)
{
    uint8_t cpal[64];
    size_t colr_count;
    uint8_t *colr = made_colr(p, &colr_count);
    const struct made_table tables[] = {{"COLR", colr, colr_count},
                                        {"CPAL", cpal, made_cpal(palette, 3, cpal)}};
    struct font_face *face = face_make(tables, 2);
    free(colr);
    free(p);
    assert_int_equal(font_colour_of(face, base), FONT_COLOUR_PAINTS);
    return face;
}

static void draw(int k, struct font_face *face, unsigned glyph, const struct font_map *map,
                 double gamma)
{
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    struct font_placed one = {.face = face, .glyph = glyph};
    const struct font_layout layout = {.glyphs = &one, .glyphs_count = 1, .size_px = SIZE};
    struct font_picture to = {
        .rgb = page[k], .width_px = SIDE, .height_px = SIDE, .pitch = 3 * SIDE};
    def.filter = "box";
    def.gamma = gamma;
    assert_font(font_painter_create(&def, &painter));
    memset(page[k], 255, sizeof page[k]);
    assert_font(font_painter_layout(painter, &layout, map, LEFT, BASE, &to));
    font_painter_destroy(painter);
}

/* The three numbers of the pixel at a place in the font's units. */
static const uint8_t *at(double x, double y)
{
    int column = (int)floor(LEFT + x * SIZE / EM), row = (int)floor(BASE - y * SIZE / EM);
    return page[0] + 3 * (row * SIDE + column);
}

/* Checks a pixel: this colour with this cover over white, mixed as numbers. */
static void near(double x, double y, double red, double green, double blue, double cover)
{
    const uint8_t *is = at(x, y);
    const double want[] = {red, green, blue};
    for (int c = 0; c < 3; c++)
        if (!(fabs(is[c] - 255 * (want[c] * cover + 1 - cover)) <= 3))
            fail_msg("at (%g, %g) there is %d %d %d, not %g %g %g by %g", x, y, is[0], is[1],
                     is[2], 255 * red, 255 * green, 255 * blue, cover);
}

static int most_apart(void)
{
    int most = 0;
    for (int i = 0; i < SIDE * SIDE * 3; i++)
        most = abs(page[0][i] - page[1][i]) > most ? abs(page[0][i] - page[1][i]) : most;
    return most;
}

/* A paint with the block's outline, which the next paint fills. */
static size_t in_block(struct made_paints *p, size_t of)
{
    return made_paint(p, of, GLYPH, "32", 0, block) + 1;
}

static void a_letter_in_one_colour_is_that_letter(void **state)
{
    (void)state;
    struct made_paints *p = made_paints_begin();
    size_t glyph = made_paint(p, made_base(p, base), GLYPH, "32", 0, letter);
    made_paint(p, glyph + 1, SOLID, "22", INK, ONE);
    struct font_face *face = painted(p);
    struct font_map maps[] = {font_map_rotation(0), font_map_rotation(25)};
    for (int m = 0; m < 2; m++) {
        draw(0, face, base, &maps[m], 1);
        draw(1, plain, letter, &maps[m], 1);
        int most = most_apart();
        if (most > 32)
            fail_msg("a letter drawn as a picture is %d of 255 off", most);
    }
    font_face_close(face);
}

static void layers_lie_over_each_other(void **state)
{
    (void)state;
    struct made_paints *p = made_paints_begin();
    size_t first = made_layer(p), second = made_layer(p);
    made_paint(p, made_base(p, base), LAYERS, "14", 2, 0);
    made_paint(p, in_block(p, first), SOLID, "22", RED, ONE);
    made_paint(p, in_block(p, second), SOLID, "22", HALF_BLUE, ONE / 2);
    struct font_face *face = painted(p);
    draw(0, face, base, NULL, 1);
    double blue = 128 / 255.0 / 2;
    near(500, 500, 1 - blue, 0, blue, 1);
    font_face_close(face);
}

/* Writes a colour line: red at a quarter, green at three quarters. */
static void line_put(struct made_paints *p, int extend)
{
    uint8_t *to = p->paints + p->paints_count;
    to = made_put(made_put(to, (uint32_t)extend, 1), 2, 2);
    to = made_put(made_put(made_put(to, ONE / 4, 2), RED, 2), ONE, 2);
    to = made_put(made_put(made_put(to, 3 * ONE / 4, 2), GREEN, 2), ONE, 2);
    p->paints_count = (size_t)(to - p->paints);
}

/* Writes a colour line right after its paint, and its offset into the paint. */
static void line_follows(struct made_paints *p, size_t paint, int extend)
{
    made_put(p->paints + paint + 1, (uint32_t)(p->paints_count - paint), 3);
    line_put(p, extend);
}

/* The share of green at a place along the colour line, by the kind of extension. */
static double green_at(double way, int extend)
{
    double part = (way - 0.25) / 0.5;
    if (extend == 1)
        part -= floor(part);
    else if (extend == 2)
        part = 1 - fabs(1 - (part - 2 * floor(part / 2)));
    return fmin(1, fmax(0, part));
}

static void gradients_are_what_they_are_defined_as(void **state)
{
    (void)state;
    static const double places[][2] = {{100, 100},  {300, 900},  {600, 400}, {900, 1200},
                                       {1200, 200}, {750, 1000}, {1000, 700}};
    for (int kind = 0; kind < 3; kind++)
        for (int extend = 0; extend < 3; extend++) {
            struct made_paints *p = made_paints_begin();
            size_t of = in_block(p, made_base(p, base));
            /* linear from (200, 100) to (1000, 100), slanted; radial around (600, 600); sweep
             * of half a turn from a quarter on */
            size_t paint =
                kind == 0
                    ? made_paint(p, of, LINEAR, "3222222", 0, 200, 100, 1000, 100, 400, 700)
                : kind == 1
                    ? made_paint(p, of, RADIAL, "3222222", 0, 600, 600, 100, 600, 600, 900)
                    : made_paint(p, of, SWEEP, "32222", 0, 600, 600, -ONE / 2, ONE / 2);
            line_follows(p, paint, extend);
            struct font_face *face = painted(p);
            draw(0, face, base, NULL, 1);
            for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
                double x = floor(places[i][0] / 16) * 16 + 8,
                       y = floor(places[i][1] / 16) * 16 + 8;
                double angle = atan2(y - 600, x - 600) / (2 * M_PI);
                angle += angle < 0 ? 1 : 0;
                /* A linear gradient is constant along the slant (200, 600). */
                double way = kind == 0   ? (x - 200 - (y - 100) / 3) / 800
                             : kind == 1 ? (hypot(x - 600, y - 600) - 100) / 800
                                         : (angle - 0.25) / 0.5;
                double g = green_at(way, extend), part = (way - 0.25) / 0.5;
                if (extend == 1 && fabs(part - round(part)) < 0.05)
                    continue; /* at the leap */
                const uint8_t *is = at(x, y);
                if (fabs(is[1] - 255 * g) > 8 || fabs(is[0] - 255 * (1 - g)) > 8)
                    fail_msg("kind %d, extension %d: at (%g, %g) green is %d, not %g", kind,
                             extend, x, y, is[1], 255 * g);
            }
            font_face_close(face);
        }
}

/* Compares a transformed letter with the same letter through the painter's map. */
static void transforms_are_the_maps_that_they_name(void **state)
{
    (void)state;
    for (int kind = 0; kind < 5; kind++) {
        struct made_paints *p = made_paints_begin();
        size_t of = made_base(p, base), child;
        struct font_map map = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}};
        double dx = 0, dy = 0; /* of the font's plane */
        if (kind == 0) {
            child = made_paint(p, of, TRANSLATE, "322", 0, 300, 200);
            dx = 300;
            dy = 200;
        } else if (kind == 1) {
            child =
                made_paint(p, of, SCALE_CENTRE, "32222", 0, ONE / 2, 3 * ONE / 4, 1000, 400);
            map = (struct font_map){FONT_AFFINE, {0.5, 0, 0, 0, 0.75, 0}};
            dx = 500;
            dy = 100;
        } else if (kind == 2) {
            child = made_paint(p, of, ROTATE, "32", 0, ONE / 6);
            map = font_map_rotation(30);
        } else if (kind == 3) {
            child = made_paint(p, of, SKEW, "322", 0, -ONE / 9, 0);
            map = font_map_shear(tan(M_PI / 9)); /* to the right */
        } else {
            child = made_paint(p, of, TRANSFORM, "33", 0, 0);
            made_put(p->paints + child + 4, 7, 3); /* its numbers are next */
            uint8_t *to = p->paints + p->paints_count;
            const int32_t m[] = {0x8000, 0x4000, -0x4000, 0xc000, 100 << 16, 50 << 16};
            for (int i = 0; i < 6; i++) /* xx, yx, xy, yy, dx, dy */
                to = made_put(to, (uint32_t)m[i], 4);
            p->paints_count = (size_t)(to - p->paints);
            map = (struct font_map){FONT_AFFINE, {0.5, 0.25, 0, -0.25, 0.75, 0}};
            dx = 100;
            dy = 50;
        }
        size_t glyph = made_paint(p, child + 1, GLYPH, "32", 0, letter);
        made_paint(p, glyph + 1, SOLID, "22", INK, ONE);
        struct font_face *face = painted(p);
        draw(0, face, base, NULL, 1);
        struct font_layout layout = {.size_px = SIZE, .glyphs_count = 1};
        struct font_placed one = {.face = plain, .glyph = letter};
        layout.glyphs = &one;
        struct font_painter_def def = font_painter_def_default();
        struct font_painter *painter;
        struct font_picture to = {
            .rgb = page[1], .width_px = SIDE, .height_px = SIDE, .pitch = 3 * SIDE};
        def.filter = "box";
        def.gamma = 1;
        assert_font(font_painter_create(&def, &painter));
        memset(page[1], 255, sizeof page[1]);
        assert_font(font_painter_layout(painter, &layout, &map, LEFT + dx * SIZE / EM,
                                        BASE - dy * SIZE / EM, &to));
        font_painter_destroy(painter);
        int most = most_apart();
        if (most > 32)
            fail_msg("transform %d is %d of 255 off", kind, most);
        font_face_close(face);
    }
}

static void composites_mix_as_they_are_named(void **state)
{
    (void)state;
    /* Half transparent blue is mixed with red; the result lies over white. */
    const double a = 128 / 255.0;
    const struct {
        int mode;
        double red, green, blue, cover;
    } modes[] = {{FONT_MIX_CLEAR, 0, 0, 0, 0},
                 {FONT_MIX_SOURCE, 0, 0, 1, a},
                 {FONT_MIX_SOURCE_OVER, 1 - a, 0, a, 1},
                 {FONT_MIX_BELOW_OUT, 1, 0, 0, 1 - a},
                 {FONT_MIX_SOURCE_IN, 0, 0, 1, a},
                 {FONT_MIX_XOR, 1, 0, 0, 1 - a},
                 {FONT_MIX_MULTIPLY, 1 - a, 0, 0, 1},
                 {FONT_MIX_SCREEN, 1, 0, a, 1},
                 {FONT_MIX_DIFFERENCE, 1, 0, a, 1},
                 {FONT_MIX_LUMINOSITY, 1 - a + a * 0.3667, 0, 0, 1}};
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        struct made_paints *p = made_paints_begin();
        size_t mix = made_paint(p, made_base(p, base), COMPOSITE, "313", 0, modes[i].mode, 0);
        made_paint(p, in_block(p, mix + 1), SOLID, "22", HALF_BLUE, ONE);
        made_paint(p, in_block(p, mix + 5), SOLID, "22", RED, ONE);
        struct font_face *face = painted(p);
        draw(0, face, base, NULL, 1);
        near(600, 600, modes[i].red, modes[i].green, modes[i].blue, modes[i].cover);
        font_face_close(face);
    }
}

static void mixtures_are_colours(void **state)
{
    (void)state;
    uint32_t seed = 5;
    for (int i = 0; i < 100000; i++) {
        float s[4], b[4], out[4];
        s[3] = (float)random_unit(&seed);
        b[3] = (float)random_unit(&seed);
        for (int c = 0; c < 3; c++) {
            s[c] = s[3] * (float)random_unit(&seed);
            b[c] = b[3] * (float)random_unit(&seed);
        }
        font_mix((enum font_mix)(i % FONT_MIX_COUNT), s, b, out);
        assert_true(out[3] >= 0 && out[3] <= 1 + 1e-5f);
        for (int c = 0; c < 3; c++)
            assert_true(out[c] >= -1e-5f && out[c] <= out[3] + 1e-5f);
    }
}

static void a_box_clips_and_measures(void **state)
{
    (void)state;
    struct made_paints *p = made_paints_begin();
    made_paint(p, made_base(p, base), SOLID, "22", GREEN, ONE); /* without end */
    made_clip(p, base, 160, 320, 800, 640);
    struct font_face *face = painted(p);
    draw(0, face, base, NULL, 1);
    near(200, 400, 0, 1, 0, 1);
    near(760, 600, 0, 1, 0, 1);
    near(100, 400, 0, 0, 0, 0);
    near(200, 700, 0, 0, 0, 0);
    near(860, 400, 0, 0, 0, 0);
    font_face_close(face);
}

/* Glyphs that contain themselves, and a paint without a shape. */
static void circles_end(void **state)
{
    (void)state;
    struct made_paints *p = made_paints_begin();
    size_t mix = made_paint(p, made_base(p, base), COMPOSITE, "313", 0, 3, 0);
    made_paint(p, mix + 1, COLR_GLYPH, "2", base);
    size_t glyph = made_paint(p, mix + 5, GLYPH, "32", 0, letter);
    made_paint(p, glyph + 1, COLR_GLYPH, "2", base);
    struct font_face *face = painted(p);
    draw(0, face, base, NULL, 1);
    font_face_close(face);
    p = made_paints_begin();
    made_paint(p, made_base(p, base), SOLID, "22", GREEN, ONE);
    face = painted(p);
    draw(0, face, base, NULL, 1); /* infinite, and without a clip box: nothing */
    near(500, 500, 0, 0, 0, 0);
    font_face_close(face);
}

static const char document[] =
    "<svg xmlns=\"http://www.w3.org/2000/svg\"><g id=\"glyph%u\">"
    "<rect x=\"160\" y=\"-640\" width=\"640\" height=\"320\" fill=\"#0f0\"/>"
    "<rect x=\"160\" y=\"-320\" width=\"640\" height=\"160\" fill=\"currentColor\"/>"
    "<image href=\"/etc/passwd\" width=\"9\" height=\"9\"/></g></svg>";

static void svg_is_drawn(void **state)
{
    (void)state;
    char text[600];
    uint8_t table[700];
    snprintf(text, sizeof text, document, base);
    const struct made_table tables[] = {{"SVG ", table, made_svg(text, base, base, table)}};
    struct font_face *face = face_make(tables, 1);
    if (font_colour_of(face, base) != FONT_COLOUR_SVG) {
        font_face_close(face);
        skip_because("there is no librsvg");
    }
    assert_int_equal(font_colour_of(face, letter), FONT_COLOUR_NONE);
    draw(0, face, base, NULL, 1);
    near(200, 400, 0, 1, 0, 1);
    near(760, 600, 0, 1, 0, 1);
    near(400, 200, 0, 0, 0, 1);
    near(100, 400, 0, 0, 0, 0);
    near(400, 700, 0, 0, 0, 0);
    font_face_close(face);
    uint8_t damaged[] = {0,    0,    0, 0, 0, 10, 0, 0, 0, 0, 0,   1,   0,   0,
                         0xff, 0xff, 0, 0, 0, 14, 0, 0, 0, 4, '<', 's', 'v', 'g'};
    const struct made_table wrong[] = {{"SVG ", damaged, sizeof damaged}};
    face = face_make(wrong, 1);
    struct font_colour_picture picture;
    static const double black[3];
    struct font_filter *area = filter_make("box");
    assert_int_equal(font_colour_picture_draw(face, base, 64, black, area, &picture),
                     FONT_BAD_FILE);
    font_filter_destroy(area);
    font_face_close(face);
}

/* Two rows of what two regions add: with the axis above its usual place 300 and -1000, below it
 * -7 and 5. */
static void axes_add_to_numbers(void **state)
{
    (void)state;
    enum { STORE = 34, REGIONS = 12, DATA = REGIONS + 4 + 12, MAP = 120 };
    uint8_t bytes[160] = {0, 1};
    made_put(bytes + 30, STORE, 4);
    uint8_t *at = made_put(made_put(bytes + STORE, 1, 2), REGIONS, 4);
    made_put(made_put(at, 1, 2), DATA, 4);
    at = made_put(made_put(bytes + STORE + REGIONS, 1, 2), 2, 2);
    at = made_put(made_put(made_put(at, 0, 2), ONE, 2), ONE, 2);
    made_put(made_put(made_put(at, 0xc000, 2), 0xc000, 2), 0, 2);
    at = made_put(made_put(made_put(bytes + STORE + DATA, 2, 2), 1, 2), 2, 2);
    at = made_put(made_put(at, 0, 2), 1, 2);
    at = made_put(made_put(at, 300, 2), 0xf9, 1);
    made_put(made_put(at, 0xfc18, 2), 5, 1);
    struct font_colr c = {.bytes = bytes, .count = sizeof bytes, .axes_count = 1};
    static const struct {
        double axis, first, second;
    } settings[] = {
        {0, 0, 0}, {0.5, 150, -500}, {1, 300, -1000}, {-1, -7, 5}, {-0.5, -3.5, 2.5}};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        c.axes[0] = settings[i].axis;
        assert_float_equal(font_colr_delta(&c, 0, 0), settings[i].first, 1e-9);
        assert_float_equal(font_colr_delta(&c, 0, 1), settings[i].second, 1e-9);
        assert_float_equal(font_colr_delta(&c, 0, 2), 0, 0);
        assert_float_equal(font_colr_delta(&c, 0xffffffff, 0), 0, 0);
    }
    /* By an index map: of its three entries the last holds for all behind it. */
    static const uint8_t map[] = {0, 0, 0, 3, 1, 0, 1};
    memcpy(bytes + MAP, map, sizeof map);
    made_put(bytes + 26, MAP, 4);
    c.axes[0] = 1;
    assert_float_equal(font_colr_delta(&c, 0, 0), -1000, 1e-9);
    assert_float_equal(font_colr_delta(&c, 0, 1), 300, 1e-9);
    assert_float_equal(font_colr_delta(&c, 7, 1), -1000, 1e-9);
    c.count = STORE + DATA; /* cut off: nothing */
    assert_float_equal(font_colr_delta(&c, 0, 0), 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_letter_in_one_colour_is_that_letter),
        cmocka_unit_test(layers_lie_over_each_other),
        cmocka_unit_test(gradients_are_what_they_are_defined_as),
        cmocka_unit_test(transforms_are_the_maps_that_they_name),
        cmocka_unit_test(composites_mix_as_they_are_named),
        cmocka_unit_test(mixtures_are_colours),
        cmocka_unit_test(a_box_clips_and_measures),
        cmocka_unit_test(circles_end),
        cmocka_unit_test(axes_add_to_numbers),
        cmocka_unit_test(svg_is_drawn),
    };
    return cmocka_run_group_tests_name("paints", tests, plain_open, plain_close);
}
