/* test_outline.c - outlines: curves, areas covered twice, emboldening, fonts of each kind. */
#include "outline_area.h"
#include "support.h"

#include <gray.h>
#include <outline.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void square(struct font_outline *o, double x, double y, double side, bool clockwise)
{
    assert_font(font_outline_move(o, x, y));
    assert_font(font_outline_line(o, clockwise ? x : x + side, clockwise ? y + side : y));
    assert_font(font_outline_line(o, x + side, y + side));
    assert_font(font_outline_line(o, clockwise ? x + side : x, clockwise ? y : y + side));
    assert_font(font_outline_close(o));
}

/* Whether the segments form closed contours: each point must be the end of as many segments as
 * it is the beginning of. */
static bool closed(const struct font_outline *o)
{
    double x = 0, y = 0, xx = 0, yy = 0;
    for (int i = 0; i < o->segments_count; i++) {
        const struct font_segment *s = &o->segments[i];
        struct font_point a = s->p[0], b = s->p[s->degree];
        x += b.x - a.x;
        y += b.y - a.y;
        xx += b.x * b.x - a.x * a.x;
        yy += b.y * b.y * b.x - a.y * a.y * a.x;
    }
    return fabs(x) < 1e-6 && fabs(y) < 1e-6 && fabs(xx) < 1e-2 && fabs(yy) < 10;
}

static void simple_shapes_stay_as_they_are(void **state)
{
    (void)state;
    for (int clockwise = 0; clockwise < 2; clockwise++) {
        struct font_outline o = {0};
        square(&o, 0, 0, 100, clockwise);
        square(&o, 20, 20, 30, !clockwise);
        assert_font(font_outline_prepare(&o, FONT_NONZERO));
        assert_false(o.rebuilt);
        assert_int_equal(o.turn, clockwise ? 1 : -1);
        assert_true(fabs(outline_area(&o) - 9100) < 1e-6);
        font_outline_finish(&o);
    }
}

static void overlaps_are_covered_once(void **state)
{
    (void)state;
    /* Two squares of side 100, in either direction, overlap by 50 by 50. Their area is 17500 by
     * the nonzero rule and 15000 by the even-odd rule. */
    for (int turns = 0; turns < 4; turns++)
        for (int rule = 0; rule < 2; rule++) {
            struct font_outline o = {0};
            square(&o, 0, 0, 100, turns & 1);
            square(&o, 50, 50, 100, turns & 2);
            assert_font(font_outline_prepare(&o, (enum font_fill)rule));
            bool apart = rule == FONT_NONZERO && (turns == 1 || turns == 2);
            assert_true(o.rebuilt);
            assert_true(closed(&o));
            /* By the nonzero rule the overlap of squares of opposite directions is a hole. */
            double expected = rule == FONT_EVEN_ODD || apart ? 15000 : 17500;
            if (fabs(outline_area(&o) - expected) > 1e-6)
                fail_msg("turns %d, rule %d: %g, not %g", turns, rule, outline_area(&o),
                         expected);
            font_outline_finish(&o);
        }
}

static void nested_contours_of_one_turn_are_one(void **state)
{
    (void)state;
    struct font_outline o = {0};
    square(&o, 0, 0, 100, true);
    square(&o, 10, 10, 50, true);
    square(&o, 0, 0, 100, true); /* and the same again */
    assert_font(font_outline_prepare(&o, FONT_NONZERO));
    assert_true(o.rebuilt);
    assert_true(fabs(outline_area(&o) - 10000) <
                1e-2); /* coinciding points are moved by some 10^-8 */
    font_outline_finish(&o);
}

static void crossing_curves_stay_curves(void **state)
{
    (void)state;
    /* A figure eight of curves, which crosses itself. */
    struct font_outline o = {0};
    assert_font(font_outline_move(&o, 0, 0));
    assert_font(font_outline_cubic(&o, 300, 300, -200, 300, 100, 0));
    assert_font(font_outline_quad(&o, 50, -100, 0, 0));
    square(&o, 20, 60, 40, true);
    assert_font(font_outline_prepare(&o, FONT_NONZERO));
    assert_true(o.rebuilt && closed(&o));
    int curves = 0;
    for (int i = 0; i < o.segments_count; i++)
        curves += o.segments[i].degree > 1;
    assert_true(curves >= 3 && o.segments_count < 40);
    font_outline_finish(&o);
}

/* The winding number of a point. In random tangles the rebuilt outline must cover the points
 * that the rule fills, each once. */
static int winding_at(const struct font_outline *o, double x, double y)
{
    int winding = 0;
    for (int i = 0; i < o->segments_count; i++) {
        struct font_point a = o->segments[i].p[0];
        for (int k = 1; k <= 400; k++) {
            struct font_point b = font_segment_at(&o->segments[i], k / 400.0, NULL);
            if ((a.y <= y) != (b.y <= y) && a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)) < x)
                winding += b.y > a.y ? 1 : -1;
            a = b;
        }
    }
    return winding;
}

static void tangles_fill_what_the_rule_says(void **state)
{
    (void)state;
    uint32_t seed = 1990;
    int points = 0, wrong = 0, rebuilt = 0;
    for (int n = 0; n < 40; n++) {
        struct font_outline o = {0}, raw;
        enum font_fill rule = n & 1 ? FONT_EVEN_ODD : FONT_NONZERO;
        for (int c = 0; c < 2 + n % 3; c++) {
            assert_font(
                font_outline_move(&o, 1000 * random_unit(&seed), 1000 * random_unit(&seed)));
            for (int k = 0; k < 4; k++) {
                double p[6];
                for (int i = 0; i < 6; i++) /* often whole numbers, so that points coincide */
                    p[i] = n % 4 < 2 ? floor(10 * random_unit(&seed)) * 100
                                     : 1000 * random_unit(&seed);
                int degree = 1 + (int)(3 * random_unit(&seed));
                assert_font(degree == 1 ? font_outline_line(&o, p[0], p[1])
                            : degree == 2
                                ? font_outline_quad(&o, p[0], p[1], p[2], p[3])
                                : font_outline_cubic(&o, p[0], p[1], p[2], p[3], p[4], p[5]));
            }
            assert_font(font_outline_close(&o));
        }
        assert_font(font_outline_copy(&o, &raw));
        assert_font(font_outline_prepare(&o, rule));
        rebuilt += o.rebuilt;
        for (int k = 0; k < 60; k++) {
            double x = 1000 * random_unit(&seed), y = 1000 * random_unit(&seed);
            int before = winding_at(&raw, x, y), after = winding_at(&o, x, y);
            bool inside = rule == FONT_EVEN_ODD ? before & 1 : before != 0;
            points++;
            wrong += after != (inside ? o.turn : 0);
        }
        font_outline_finish(&o);
        font_outline_finish(&raw);
    }
    print_message("%d of %d points differ, %d of 40 rebuilt\n", wrong, points, rebuilt);
    assert_true(rebuilt > 20);
    assert_true(wrong <= points / 200); /* points very near an edge may differ */
}

/* A rebuilt outline is right under a rotation too, where its horizontal parts count. */
static void rebuilt_outlines_can_be_turned(void **state)
{
    (void)state;
    struct font_filter *box = filter_make("box");
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    for (int angle = 0; angle < 360; angle += 15) {
        struct font_outline o = {.units_per_em = 100};
        square(&o, 0, 0, 100, true);
        square(&o, 50, 50, 100, true);
        assert_font(font_outline_prepare(&o, FONT_NONZERO));
        struct font_map map = font_map_then(font_map_size(10, 100), font_map_rotation(angle));
        assert_font(font_edges_build(&edges, &o, &map, box));
        assert_font(font_gray_draw_exact(&gray, &edges, box, 0.4, 0.7));
        double ink = 0;
        for (int r = 0; r < gray.height_px; r++)
            for (int c = 0; c < gray.width_px; c++) {
                float value = gray.exact[r * gray.pitch + c];
                assert_true(value > -0.002f && value < 1.002f);
                ink += (double)value;
            }
        assert_true(fabs(ink - 175) < 0.05);
        font_outline_finish(&o);
    }
    font_gray_finish(&gray);
    font_edges_finish(&edges);
    font_filter_destroy(box);
}

static void parts_of_curves_are_on_the_curve(void **state)
{
    (void)state;
    struct font_segment s = {.degree = 3, .p = {{0, 0}, {10, 30}, {-20, 50}, {40, 60}}};
    struct font_segment part = font_segment_part(&s, 0.8, 0.3);
    for (int k = 0; k <= 10; k++) {
        struct font_point a = font_segment_at(&part, k / 10.0, NULL);
        struct font_point b = font_segment_at(&s, 0.8 - 0.05 * k, NULL);
        assert_true(fabs(a.x - b.x) < 1e-12 && fabs(a.y - b.y) < 1e-12);
    }
}

static void bold_is_bolder_by_as_much(void **state)
{
    (void)state;
    for (int clockwise = 0; clockwise < 2; clockwise++) {
        struct font_outline o = {0};
        square(&o, 0, 0, 100, clockwise);
        square(&o, 20, 20, 60, !clockwise);
        assert_font(font_outline_embolden(&o, 10, 4));
        assert_font(font_outline_prepare(&o, FONT_NONZERO));
        /* The outside is 110 by 104, the hole 50 by 56. */
        assert_true(fabs(outline_area(&o) - (110 * 104 - 50 * 56)) < 1e-6);
        font_outline_finish(&o);
    }
}

static void limits_are_said(void **state)
{
    (void)state;
    struct font_outline o = {0};
    assert_int_equal(font_outline_line(&o, 1, 1), FONT_BAD_ARGUMENT);
    assert_font(font_outline_move(&o, 0, 0));
    assert_int_equal(font_outline_line(&o, NAN, 1), FONT_BAD_ARGUMENT);
    assert_int_equal(font_outline_quad(&o, 1, 1, 1, 1e9), FONT_BAD_ARGUMENT);
    for (int i = 0; i < FONT_SEGMENTS_MAX; i++)
        assert_font(font_outline_line(&o, i % 100, 1 + i));
    assert_int_equal(font_outline_line(&o, -1, -1), FONT_TOO_LARGE);
    font_outline_finish(&o);
}

/* ---- faces ---- */

static void each_kind_of_font_is_read(void **state)
{
    (void)state;
    static const struct {
        const char *name, *format;
    } kinds[] = {
        {"DejaVuSans", "TrueType"}, {"EBGaramond12-Regular", "CFF"}, {TYPE_1_FONT, "Type 1"}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        struct font_face *face = face_open(kinds[i].name);
        struct font_face_info info;
        struct font_outline outline;
        font_face_describe(face, &info);
        assert_string_equal(info.format, kinds[i].format);
        assert_true(info.units_per_em >= 1000);
        assert_font(font_face_outline(face, font_face_glyph(face, 'O'), &outline));
        assert_true(outline.prepared && outline.advance > 0 && outline.segments_count >= 4);
        font_outline_finish(&outline);
        assert_int_equal(font_face_outline(face, 1u << 30, &outline), FONT_NO_GLYPH);
        font_face_close(face);
    }
}

static void what_is_no_font_is_said(void **state)
{
    (void)state;
    struct font_face *face;
    assert_int_equal(font_face_open("no such font at all", 0, &face), FONT_BAD_FILE);
    assert_non_null(strstr(font_error(), "no such font"));
    assert_int_equal(font_face_open("/", 0, &face), FONT_BAD_FILE);
    assert_int_equal(font_face_open("/nonexistent.ttf", 0, &face), FONT_BAD_FILE);
    assert_int_equal(font_face_open(NULL, 0, &face), FONT_BAD_ARGUMENT);
    assert_int_equal(font_face_open("DejaVuSans", 7, &face), FONT_BAD_ARGUMENT);
    assert_int_equal(font_face_open("DejaVuSans", -1, &face), FONT_BAD_ARGUMENT);
    assert_int_equal(font_face_open_memory("OTTO", 4, 0, &face), FONT_BAD_FILE);
    assert_int_equal(font_face_open_memory("", 0, 0, &face), FONT_BAD_FILE);
    assert_null(face);
}

/* ---- a collection and a variable font, made here because the fonts that tests install have
 * none ---- */

static void put16(uint8_t *at, unsigned value)
{
    at[0] = (uint8_t)(value >> 8);
    at[1] = (uint8_t)value;
}

static void put32(uint8_t *at, uint32_t value)
{
    put16(at, value >> 16);
    put16(at + 2, value & 0xffff);
}

static uint32_t get32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Puts two fonts into one file. Offsets of tables count from the file's beginning, so they
 * change. */
static void collections_have_faces(void **state)
{
    (void)state;
    static const char *const names[] = {"DejaVuSans", "DejaVuSans-Bold"};
    struct font_face *single[2];
    const uint8_t *bytes[2];
    size_t counts[2], at = 24;
    for (int i = 0; i < 2; i++) {
        single[i] = face_open(names[i]);
        bytes[i] = font_face_bytes(single[i], &counts[i]);
    }
    uint8_t *ttc = calloc(1, 32 + counts[0] + counts[1]);
    memcpy(ttc, "ttcf\0\1\0\0\0\0\0\2", 12);
    for (int i = 0; i < 2; i++) {
        put32(ttc + 12 + 4 * i, (uint32_t)at);
        memcpy(ttc + at, bytes[i], counts[i]);
        unsigned tables = (unsigned)(bytes[i][4] << 8 | bytes[i][5]);
        for (unsigned t = 0; t < tables; t++) {
            uint8_t *offset = ttc + at + 12 + 16 * t + 8;
            put32(offset, get32(offset) + (uint32_t)at);
        }
        at += (counts[i] + 3) / 4 * 4;
    }
    for (int i = 0; i < 2; i++) {
        struct font_face *face;
        struct font_face_info info;
        struct font_outline a, b;
        assert_font(font_face_open_memory(ttc, at, i, &face));
        font_face_describe(face, &info);
        assert_int_equal(info.faces_count, 2);
        assert_int_equal(info.index, i);
        assert_font(font_face_outline(face, font_face_glyph(face, 'g'), &a));
        assert_font(font_face_outline(single[i], font_face_glyph(single[i], 'g'), &b));
        assert_int_equal(a.segments_count, b.segments_count);
        assert_memory_equal(a.segments, b.segments,
                            (size_t)a.segments_count * sizeof *a.segments);
        font_outline_finish(&a);
        font_outline_finish(&b);
        font_face_close(face);
        font_face_close(single[i]);
    }
    free(ttc);
}

/* A point between two others that curves lean to is where it is, at half a unit, too. */
static void points_between_are_halfway(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    int halves = 0;
    for (uint32_t glyph = 0; glyph < 300; glyph++) {
        struct font_outline o;
        if (font_face_outline_raw(face, glyph, &o) != FONT_OK)
            continue;
        for (int i = 0; i + 1 < o.segments_count; i++) {
            const struct font_segment *a = &o.segments[i], *b = a + 1;
            if (a->degree != 2 || b->degree != 2 || a->contour != b->contour)
                continue;
            for (int axis = 0; axis < 2; axis++) {
                double p = axis ? a->p[2].y : a->p[2].x;
                double q = axis ? a->p[1].y + b->p[1].y : a->p[1].x + b->p[1].x;
                if (p == floor(p))
                    continue;
                assert_true(p == q / 2);
                halves++;
            }
        }
        font_outline_finish(&o);
    }
    assert_true(halves > 1000);
    font_face_close(face);
}

/* The table of one axis, `wght`. */
static void axis_make(uint8_t *fvar)
{
    put32(fvar, 0x00010000);
    put16(fvar + 4, 16);
    put16(fvar + 6, 2);
    put16(fvar + 8, 1);
    put16(fvar + 10, 20);
    put16(fvar + 12, 0);
    put16(fvar + 14, 8);
    memcpy(fvar + 16, "wght", 4);
    put32(fvar + 20, 100u << 16);
    put32(fvar + 24, 400u << 16);
    put32(fvar + 28, 900u << 16);
    put16(fvar + 34, 256);
}

/* Makes DejaVu Sans with an axis `wght` 100..900, default 400. Along it the advance grows, and
 * of all glyphs only `glyph` ('l') changes: at 900 its first four points are 100 units further
 * right. */
static uint8_t *variable_make(const uint8_t *font, size_t count, unsigned glyph,
                              unsigned glyphs_count, size_t *out_count)
{
    unsigned tables = (unsigned)(font[4] << 8 | font[5]);
    size_t gvar_bytes = 20 + 2 + 4 * ((size_t)glyphs_count + 1) + 64, fvar_bytes = 36;
    size_t head = 12 + 16 * ((size_t)tables + 2);
    uint8_t *out = calloc(1, head + count + fvar_bytes + gvar_bytes + 64);
    memcpy(out, font, 12);
    put16(out + 4, tables + 2);
    size_t at = head;
    uint8_t *entry = out + 12;
    for (unsigned t = 0; t < tables; t++, entry += 16) {
        const uint8_t *from = font + 12 + 16 * t;
        memcpy(entry, from, 16);
        put32(entry + 8, (uint32_t)at);
        memcpy(out + at, font + get32(from + 8), get32(from + 12));
        at += (get32(from + 12) + 3) / 4 * 4;
    }
    memcpy(entry, "fvar", 4);
    put32(entry + 8, (uint32_t)at);
    put32(entry + 12, (uint32_t)fvar_bytes);
    axis_make(out + at);
    at += fvar_bytes;
    entry += 16;
    memcpy(entry, "gvar", 4);
    put32(entry + 8, (uint32_t)at);
    uint8_t *gvar = out + at;
    size_t data = 20 + 4 * ((size_t)glyphs_count + 1) + 2;
    put32(gvar, 0x00010000);
    put16(gvar + 4, 1); /* axes */
    put16(gvar + 6, 1); /* shared tuples */
    put32(gvar + 8, (uint32_t)data - 2);
    put16(gvar + 12, glyphs_count);
    put16(gvar + 14, 1); /* long offsets */
    put32(gvar + 16, (uint32_t)data);
    put16(gvar + data - 2, 0x4000); /* the tuple: 1.0 */
    /* One glyph's data: a header, all points, deltas. */
    uint8_t *d = gvar + data;
    put16(d, 1);
    put16(d + 2, 8);      /* data begins */
    put16(d + 6, 0x2000); /* private point numbers, shared tuple 0 */
    uint8_t *p = d + 8;
    *p++ = 4; /* four points, 0, 1, 2, 3, as differences of one byte */
    *p++ = 3;
    *p++ = 0;
    *p++ = 1;
    *p++ = 1;
    *p++ = 1;
    *p++ = 3; /* x: four bytes */
    for (int i = 0; i < 4; i++)
        *p++ = 100;
    *p++ = 0x83; /* y: four zeros */
    put16(d + 4, (unsigned)(p - d - 8));
    size_t length = ((size_t)(p - d) + 3) / 4 * 4;
    for (unsigned g = 0; g <= glyphs_count; g++)
        put32(gvar + 20 + 4 * g, g > glyph ? (uint32_t)length : 0);
    put32(entry + 12, (uint32_t)(data + length));
    *out_count = at + data + length;
    return out;
}

static void axes_move_outlines(void **state)
{
    (void)state;
    struct font_face *plain = face_open("DejaVuSans"), *face;
    struct font_face_info info;
    struct font_axis axis;
    size_t count, variable_count;
    const uint8_t *bytes = font_face_bytes(plain, &count);
    font_face_describe(plain, &info);
    uint8_t *variable = variable_make(bytes, count, font_face_glyph(plain, 'l'),
                                      (unsigned)info.glyphs_count, &variable_count);
    assert_font(font_face_open_memory(variable, variable_count, 0, &face));
    font_face_describe(face, &info);
    assert_int_equal(info.axes_count, 1);
    assert_font(font_face_axis(face, 0, &axis));
    assert_string_equal(axis.tag, "wght");
    assert_true(axis.least == 100 && axis.usual == 400 && axis.most == 900);
    double left[3];
    static const double settings[] = {400, 650, 5000}; /* beyond the end is the end */
    uint64_t version = 0, first = font_face_version(face);
    for (int i = 0; i < 3; i++) {
        struct font_outline o;
        assert_font(font_face_axis_set(face, "wght", settings[i]));
        assert_true(font_face_version(face) != version);
        version = font_face_version(face);
        assert_font(font_face_outline(face, font_face_glyph(face, 'l'), &o));
        left[i] = o.box.x0;
        font_outline_finish(&o);
    }
    assert_true(left[1] - left[0] == 50 && left[2] - left[0] == 100);
    /* 2 of 500 are 66 of 16384, as the format has it; nothing is rounded to units. */
    struct font_outline fine;
    assert_font(font_face_axis_set(face, "wght", 402));
    assert_font(font_face_outline(face, font_face_glyph(face, 'l'), &fine));
    assert_true(fabs(fine.box.x0 - left[0] - 100 * 66 / 16384.0) < 1e-4);
    font_outline_finish(&fine);
    assert_font(font_face_axis_set(face, "wght", 400));
    assert_true(font_face_version(face) == first);
    /* Two hundred settings have different versions; the last ones get their old versions when
     * they are set again. */
    uint64_t versions[200];
    for (int i = 0; i < 200; i++) {
        assert_font(font_face_axis_set(face, "wght", 101 + i));
        versions[i] = font_face_version(face);
        for (int k = 0; k < i; k++)
            assert_true(versions[k] != versions[i]);
    }
    for (int i = 199; i > 140; i--) {
        assert_font(font_face_axis_set(face, "wght", 101 + i));
        assert_true(font_face_version(face) == versions[i]);
    }
    assert_int_equal(font_face_axis_set(face, "wdth", 1), FONT_BAD_ARGUMENT);
    assert_int_equal(font_face_axis_set(face, "wght", NAN), FONT_BAD_ARGUMENT);
    assert_int_equal(font_face_axis_set(plain, "wght", 1), FONT_BAD_ARGUMENT);
    font_face_close(face);
    font_face_close(plain);
    free(variable);
}

/* Two circles, mirror images at x = 600, cross there. The corner has the precision of doubles,
 * not that of the curves' pieces. */
static void corners_are_where_curves_cross(void **state)
{
    (void)state;
    const double k = 0.5523 * 1000, r = 1000;
    struct font_outline o = {0};
    for (int side = 0; side < 2; side++) {
        double x = side ? 1200 : 0, m = side ? -1 : 1; /* turned the same way */
        assert_font(font_outline_move(&o, x + m * r, 0));
        assert_font(font_outline_cubic(&o, x + m * r, k * m, x + m * k, r * m, x, r * m));
        assert_font(font_outline_cubic(&o, x - m * k, r * m, x - m * r, k * m, x - m * r, 0));
        assert_font(font_outline_cubic(&o, x - m * r, -k * m, x - m * k, -r * m, x, -r * m));
        assert_font(font_outline_cubic(&o, x + m * k, -r * m, x + m * r, -k * m, x + m * r, 0));
        assert_font(font_outline_close(&o));
    }
    o.units_per_em = 1000;
    assert_font(font_outline_prepare(&o, FONT_NONZERO));
    assert_true(o.rebuilt);
    /* Finds where the left circle's first quarter crosses x = 600. */
    const struct font_segment quarter = {3, 0, {{r, 0}, {r, k}, {k, r}, {0, r}}};
    double low = 0, high = 1, y;
    for (int n = 0; n < 60; n++) {
        double middle = 0.5 * (low + high);
        if (font_segment_at(&quarter, middle, NULL).x > 600)
            low = middle;
        else
            high = middle;
    }
    y = font_segment_at(&quarter, low, NULL).y;
    int corners = 0;
    for (int i = 0; i < o.segments_count; i++)
        for (int end = 0; end < 2; end++) {
            const struct font_segment *s = &o.segments[i];
            struct font_point at = s->p[end ? s->degree : 0];
            if (fabs(at.x - 600) > 1 || fabs(at.y) < 10)
                continue;
            assert_true(fabs(at.x - 600) < 1e-6 && fabs(fabs(at.y) - y) < 1e-6);
            corners++;
        }
    assert_true(corners >= 4);
    font_outline_finish(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_are_where_curves_cross),
        cmocka_unit_test(simple_shapes_stay_as_they_are),
        cmocka_unit_test(overlaps_are_covered_once),
        cmocka_unit_test(nested_contours_of_one_turn_are_one),
        cmocka_unit_test(crossing_curves_stay_curves),
        cmocka_unit_test(tangles_fill_what_the_rule_says),
        cmocka_unit_test(rebuilt_outlines_can_be_turned),
        cmocka_unit_test(parts_of_curves_are_on_the_curve),
        cmocka_unit_test(bold_is_bolder_by_as_much),
        cmocka_unit_test(limits_are_said),
        cmocka_unit_test(each_kind_of_font_is_read),
        cmocka_unit_test(what_is_no_font_is_said),
        cmocka_unit_test(collections_have_faces),
        cmocka_unit_test(points_between_are_halfway),
        cmocka_unit_test(axes_move_outlines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
