/* test_math.c - formulas: where letters and rules stand, beside numbers that are read out of
 * the font's MATH table here, and TeX's rules written down again; what is not known; what is
 * too large. */
#include "support.h"

#include <edges.h>
#include <font_math.h>
#include <outline.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct font_face *face;
static struct font_math *math;
static const double size = 100;
static double upem;

/* ---- the oracle: the MATH table's numbers, from the file ---- */

enum {
    SCRIPT_PERCENT,
    SCRIPT_SCRIPT_PERCENT,
    AXIS_HEIGHT = 5,
    SUBSCRIPT_SHIFT_DOWN = 8,
    SUBSCRIPT_TOP_MAX,
    SUBSCRIPT_BASELINE_DROP_MIN,
    SUPERSCRIPT_SHIFT_UP,
    SUPERSCRIPT_SHIFT_UP_CRAMPED,
    SUPERSCRIPT_BOTTOM_MIN,
    SUPERSCRIPT_BASELINE_DROP_MAX,
    SUB_SUPERSCRIPT_GAP_MIN,
    SUPERSCRIPT_BOTTOM_MAX_WITH_SUBSCRIPT,
    SPACE_AFTER_SCRIPT,
    UPPER_LIMIT_GAP_MIN,
    UPPER_LIMIT_BASELINE_RISE_MIN,
    FRACTION_NUMERATOR_SHIFT_UP = 32,
    FRACTION_NUMERATOR_DISPLAY_SHIFT_UP,
    FRACTION_DENOMINATOR_SHIFT_DOWN,
    FRACTION_DENOMINATOR_DISPLAY_SHIFT_DOWN,
    FRACTION_NUMERATOR_GAP_MIN,
    FRACTION_NUM_DISPLAY_GAP_MIN,
    FRACTION_RULE_THICKNESS,
    FRACTION_DENOMINATOR_GAP_MIN,
    FRACTION_DENOM_DISPLAY_GAP_MIN,
    RADICAL_VERTICAL_GAP = 49,
    RADICAL_DISPLAY_VERTICAL_GAP,
    RADICAL_RULE_THICKNESS
};

static int word_at(const uint8_t *at)
{
    return (int16_t)(at[0] << 8 | at[1]);
}

/* Number n of the table MathConstants: two percents, two heights, then values of four bytes
 * each. */
static double constant(int n)
{
    size_t count;
    const uint8_t *file = font_face_bytes(face, &count);
    int tables = word_at(file + 4);
    for (int i = 0; i < tables; i++) {
        const uint8_t *row = file + 12 + 16 * i;
        if (memcmp(row, "MATH", 4) != 0)
            continue;
        const uint8_t *table = file + (word_at(row + 8) * 65536L + (row[10] << 8 | row[11]));
        const uint8_t *constants = table + word_at(table + 4);
        return n < 4 ? word_at(constants + 2 * n) : word_at(constants + 8 + 4 * (n - 4));
    }
    fail_msg("the font has no table MATH");
    return 0;
}

static double px(int n)
{
    return constant(n) * size / upem;
}

/* A character's ink at a size, y downwards. */
static struct font_box ink(uint32_t glyph, double size_px)
{
    struct font_outline outline;
    assert_font(font_face_outline(face, glyph, &outline));
    struct font_box box = font_outline_box(&outline);
    double s = size_px / upem;
    font_outline_finish(&outline);
    return (struct font_box){box.x0 * s, -box.y1 * s, box.x1 * s, -box.y0 * s};
}

static double advance(uint32_t character)
{
    double units;
    assert_font(font_face_advance(face, font_face_glyph(face, character), &units));
    return units * size / upem;
}

/* ---- formulas ---- */

static struct font_layout set(const char *tex, bool display)
{
    struct font_layout layout;
    const struct font_math_options options = {.size_px = size, .display = display};
    assert_font(font_math_layout(math, tex, strlen(tex), &options, &layout));
    return layout;
}

static bool is_rule(const struct font_placed *g)
{
    return g->face != face;
}

/* The box of rule number n. */
static struct font_box rule(const struct font_layout *l, int n)
{
    for (int i = 0; i < l->glyphs_count; i++) {
        const struct font_placed *g = &l->glyphs[i];
        if (!is_rule(g) || n--)
            continue;
        assert_true(g->map > 0);
        const double *m = l->maps[g->map - 1].m, side = font_placed_size(l, g);
        return (struct font_box){g->x_px, g->y_px - m[4] * side, g->x_px + m[0] * side,
                                 g->y_px};
    }
    fail_msg("there is no such rule");
    return (struct font_box){0};
}

/* The glyph that comes from a byte of the text. */
static const struct font_placed *from(const struct font_layout *l, int byte)
{
    for (int i = 0; i < l->glyphs_count; i++)
        if (l->glyphs[i].cluster == byte && !is_rule(&l->glyphs[i]))
            return &l->glyphs[i];
    fail_msg("no letter comes from byte %d", byte);
    return NULL;
}

#define near(a, b)                                                                             \
    do {                                                                                       \
        double a_ = (a), b_ = (b);                                                             \
        if (fabs(a_ - b_) > 0.02)                                                              \
            fail_msg("%s:%d: %s is %.4f, %s is %.4f", __FILE__, __LINE__, #a, a_, #b, b_);     \
    } while (0)

/* ---- tests ---- */

static void fraction_stands_on_the_axis(void **state)
{
    (void)state;
    for (int display = 0; display < 2; display++) {
        const char *tex = "\\frac{1}{2}";
        struct font_layout l = set(tex, display);
        const double part = display ? size : size * constant(SCRIPT_PERCENT) / 100;
        const struct font_placed *over = from(&l, 6), *under = from(&l, 9);
        struct font_box bar = rule(&l, 0), top = ink(over->glyph, part),
                        foot = ink(under->glyph, part);
        double thick = px(FRACTION_RULE_THICKNESS), axis = px(AXIS_HEIGHT);
        near(bar.y1 - bar.y0, thick);
        near((bar.y0 + bar.y1) / 2, -axis);
        near((double)over->size_px, part);
        near(-over->y_px,
             fmax(px(display ? FRACTION_NUMERATOR_DISPLAY_SHIFT_UP
                             : FRACTION_NUMERATOR_SHIFT_UP),
                  axis + thick / 2 + top.y1 +
                      px(display ? FRACTION_NUM_DISPLAY_GAP_MIN : FRACTION_NUMERATOR_GAP_MIN)));
        near(under->y_px, fmax(px(display ? FRACTION_DENOMINATOR_DISPLAY_SHIFT_DOWN
                                          : FRACTION_DENOMINATOR_SHIFT_DOWN),
                               thick / 2 - axis - foot.y0 +
                                   px(display ? FRACTION_DENOM_DISPLAY_GAP_MIN
                                              : FRACTION_DENOMINATOR_GAP_MIN)));
        near(l.ascent_px, -over->y_px - top.y0);
        near(l.descent_px, under->y_px + foot.y1);
        font_layout_finish(&l);
    }
}

static void scripts_are_raised_and_lowered(void **state)
{
    (void)state;
    struct font_layout l = set("x^2", false);
    const double small = size * constant(SCRIPT_PERCENT) / 100;
    const struct font_placed *two = from(&l, 2);
    near((double)two->size_px, small);
    near(-two->y_px, fmax(px(SUPERSCRIPT_SHIFT_UP),
                          px(SUPERSCRIPT_BOTTOM_MIN) + ink(two->glyph, small).y1));
    font_layout_finish(&l);

    l = set("\\sqrt{x^2}", false); /* cramped */
    two = from(&l, 8);
    near(-two->y_px, fmax(px(SUPERSCRIPT_SHIFT_UP_CRAMPED),
                          px(SUPERSCRIPT_BOTTOM_MIN) + ink(two->glyph, small).y1));
    font_layout_finish(&l);

    l = set("x_2", false);
    two = from(&l, 2);
    near(two->y_px,
         fmax(px(SUBSCRIPT_SHIFT_DOWN), -ink(two->glyph, small).y0 - px(SUBSCRIPT_TOP_MAX)));
    font_layout_finish(&l);

    l = set("x_2^3", false);
    const struct font_placed *sub = from(&l, 2), *sup = from(&l, 4);
    double gap =
        sub->y_px + ink(sub->glyph, small).y0 - (sup->y_px + ink(sup->glyph, small).y1);
    assert_true(gap >= px(SUB_SUPERSCRIPT_GAP_MIN) - 0.02);
    font_layout_finish(&l);

    /* The other order says the same, and primes are a superscript. */
    struct font_layout a = set("x^3_2", false), b = set("x_2^3", false);
    near(a.width_px, b.width_px);
    near(a.ascent_px, b.ascent_px);
    font_layout_finish(&a);
    font_layout_finish(&b);
    a = set("f''", false);
    b = set("f^{\\prime\\prime}", false);
    assert_int_equal(a.glyphs_count, 3);
    near(a.width_px, b.width_px);
    font_layout_finish(&a);
    font_layout_finish(&b);
    l = set("x^{a^b}", false);
    near((double)from(&l, 5)->size_px, size * constant(SCRIPT_SCRIPT_PERCENT) / 100);
    font_layout_finish(&l);
}

static void root_covers_what_is_in_it(void **state)
{
    (void)state;
    for (int display = 0; display < 2; display++) {
        struct font_layout l = set("\\sqrt{\\frac ab}+\\sqrt1", display);
        struct font_box bar = rule(&l, 1); /* the first is the fraction's */
        const struct font_placed *a = from(&l, 12);
        double top = a->y_px + ink(a->glyph, (double)a->size_px).y0;
        near(bar.y1 - bar.y0, px(RADICAL_RULE_THICKNESS));
        assert_true(top - bar.y1 >=
                    px(display ? RADICAL_DISPLAY_VERTICAL_GAP : RADICAL_VERTICAL_GAP) - 0.02);
        const struct font_placed *sign = from(&l, 0);
        near(ink(sign->glyph, (double)sign->size_px).y0 + sign->y_px, bar.y0);
        font_layout_finish(&l);
    }
}

/* Spaces between atoms, in eighteenths of an em: what stands between the glyphs beyond their
 * advances. */
static void spaces_are_tex_s(void **state)
{
    (void)state;
    static const struct {
        const char *tex;
        int left,
            /* bytes of two letters that follow each other; upright, so that nothing leans */
            right;
        int eighteenths;
    } rows[] = {
        {"1+2", 0, 1, 4},       {"1+2", 1, 2, 4},    {"1=2", 0, 1, 5},
        {"1=2", 1, 2, 5},       {"1,2", 0, 1, 0},    {"1,2", 1, 2, 3},
        {"-2", 0, 1, 0},        {"1=-2", 1, 2, 5},   {"1=-2", 2, 3, 0},
        {"(-2)", 1, 2, 0},      {"(1+2)", 1, 2, 4},  {"1(2)", 0, 1, 0},
        {"1\\cdot2", 0, 1, 4},  {"1{+}2", 0, 2, 0},  {"1\\!2", 0, 3, -3},
        {"1\\,2", 0, 3, 3},     {"1\\:2", 0, 3, 4},  {"1\\;2", 0, 3, 5},
        {"1\\quad2", 0, 6, 18}, {"1/2", 0, 1, 0},    {"1 2", 0, 2, 0},
        {"1\\ldots", 0, 1, 3},  {"1\\in2", 0, 1, 5}, {"1\\mathbin|2", 0, 9, 4},
        {"1;2", 1, 2, 3},       {"1!+2", 1, 2, 4},   {"1\\colon2", 0, 1, 0},
        {"\\{+2", 2, 3, 0},     {"1+", 0, 1, 0},     {"1<2", 0, 1, 5},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct font_layout l = set(rows[i].tex, false);
        const struct font_placed *a = from(&l, rows[i].left), *b = from(&l, rows[i].right);
        double units;
        assert_font(font_face_advance(face, a->glyph, &units));
        double space = (b->x_px - a->x_px - units * size / upem) / size * 18;
        if (fabs(space - rows[i].eighteenths) > 0.01)
            fail_msg("%s: %.3f eighteenths between bytes %d and %d, not %d", rows[i].tex, space,
                     rows[i].left, rows[i].right, rows[i].eighteenths);
        font_layout_finish(&l);
    }
    /* None of these in scripts. */
    struct font_layout l = set("x^{1+2}", false);
    const struct font_placed *one = from(&l, 3), *plus = from(&l, 4);
    double units;
    assert_font(font_face_advance(face, one->glyph, &units));
    near(plus->x_px - one->x_px, units * (double)one->size_px / upem);
    font_layout_finish(&l);
}

static void limits_stand_over_operators(void **state)
{
    (void)state;
    struct font_layout l = set("\\sum^2", true);
    const struct font_placed *sum = from(&l, 0), *two = from(&l, 5);
    struct font_box of = ink(sum->glyph, size), up = ink(two->glyph, (double)two->size_px);
    double top = sum->y_px + of.y0;
    near(top - two->y_px,
         fmax(px(UPPER_LIMIT_GAP_MIN) + up.y1, px(UPPER_LIMIT_BASELINE_RISE_MIN)));
    near((of.y0 + of.y1) / 2 + sum->y_px, -px(AXIS_HEIGHT));
    font_layout_finish(&l);
    static const struct {
        const char *tex;
        int byte;
        bool display, over;
    } rows[] = {{"\\sum^2", 5, false, false},        {"\\int^2", 5, true, false},
                {"\\int\\limits^2", 12, true, true}, {"\\sum\\nolimits^2", 14, true, false},
                {"\\lim^2", 5, true, true},          {"\\sin^2", 5, true, false},
                {"\\max^2", 5, false, false},        {"\\operatorname*{x}^2", 18, true, true},
                {"\\sum\\limits^2", 12, false, true}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        l = set(rows[i].tex, rows[i].display);
        const struct font_placed *g = from(&l, rows[i].byte);
        const struct font_placed *nucleus = &l.glyphs[0];
        double foot = g->y_px + ink(g->glyph, (double)g->size_px).y1;
        if ((foot <= nucleus->y_px + ink(nucleus->glyph, size).y0) != rows[i].over)
            fail_msg("%s: its 2 stands at %.1f of %.1f", rows[i].tex, g->x_px, l.width_px);
        font_layout_finish(&l);
    }
}

static void fences_grow_with_what_they_hold(void **state)
{
    (void)state;
    double before = 0;
    static const char *const inside[] = {
        "x", "\\frac ab", "\\frac{\\frac ab}{\\frac cd}",
        "\\begin{matrix}a\\\\b\\\\c\\\\d\\\\e\\\\f\\end{matrix}"};
    for (size_t i = 0; i < sizeof inside / sizeof *inside; i++) {
        char tex[128];
        snprintf(tex, sizeof tex, "\\left(%s\\right)", inside[i]);
        struct font_layout l = set(tex, true), in = set(inside[i], true);
        double axis = px(AXIS_HEIGHT);
        double half = fmax(in.ascent_px - axis, in.descent_px + axis);
        double least = fmax(2 * half * 0.901, 2 * half - size / 2);
        struct font_box paren = {0, INFINITY, 0, -INFINITY};
        for (int k = 0; k < l.glyphs_count; k++) { /* of all its pieces */
            const struct font_placed *g = &l.glyphs[k];
            if (g->cluster != 0 || is_rule(g))
                continue;
            struct font_box one = ink(g->glyph, size);
            paren.y0 = fmin(paren.y0, one.y0 + g->y_px);
            paren.y1 = fmax(paren.y1, one.y1 + g->y_px);
        }
        assert_true(paren.y1 - paren.y0 >= least - 1);
        near((paren.y0 + paren.y1) / 2, -axis);
        assert_true(paren.y1 - paren.y0 >= before - 0.02);
        before = paren.y1 - paren.y0;
        font_layout_finish(&l);
        font_layout_finish(&in);
    }
}

static void columns_are_aligned(void **state)
{
    (void)state;
    struct font_layout l = set("\\begin{array}{lr}1&2\\\\333&444\\end{array}", false);
    near(from(&l, 17)->x_px, from(&l, 22)->x_px); /* 1 over the first 3 */
    near(from(&l, 19)->x_px, from(&l, 28)->x_px); /* 2 over the last 4 */
    assert_true(from(&l, 22)->y_px - from(&l, 17)->y_px >= 1.2 * size - 0.02);
    font_layout_finish(&l);
    l = set("1&=2\\\\333&=4", true); /* without an environment around it */
    near(from(&l, 2)->x_px, from(&l, 10)->x_px);
    near(from(&l, 2)->x_px - from(&l, 0)->x_px - advance('1'), size * 5 / 18);
    font_layout_finish(&l);
}

static void letters_are_of_their_alphabet(void **state)
{
    (void)state;
    static const struct {
        const char *tex;
        int byte;
        uint32_t character;
    } rows[] = {{"x", 0, 0x1d465},
                {"h", 0, 0x210e},
                {"A", 0, 0x1d434},
                {"1", 0, '1'},
                {"\\alpha", 0, 0x1d6fc},
                {"\\Gamma", 0, 0x393},
                {"\\mathrm x", 8, 'x'},
                {"\\mathbf x", 8, 0x1d431},
                {"\\mathbb{R}", 8, 0x211d},
                {"\\mathcal L", 9, 0x2112},
                {"-", 0, 0x2212},
                {"\\not=", 0, 0x2260},
                {"\xe2\x89\xa4", 0, 0x2264},
                {"\\hat{\\imath}x", 12, 0x1d465}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct font_layout l = set(rows[i].tex, false);
        if (from(&l, rows[i].byte)->glyph != font_face_glyph(face, rows[i].character))
            fail_msg("%s is not U+%04X", rows[i].tex, (unsigned)rows[i].character);
        font_layout_finish(&l);
    }
}

static void unknown_commands_are_shown_as_written(void **state)
{
    (void)state;
    int unknown;
    struct font_layout l = set("a\\foo{b}\\bar c\\qux", false);
    assert_string_equal(font_math_unknown(math, &unknown), "\\foo");
    assert_int_equal(unknown, 2);
    for (int i = 0; i < 4; i++)
        assert_int_equal(from(&l, 1 + i)->glyph,
                         font_face_glyph(face, (uint32_t)(unsigned char)"\\foo"[i]));
    font_layout_finish(&l);
    l = set("\\frac12", false);
    assert_string_equal(font_math_unknown(math, &unknown), "");
    assert_int_equal(unknown, 0);
    font_layout_finish(&l);
}

/* DejaVu Math has no Cyrillic; other fonts of the distribution have. */
static void letters_that_the_font_lacks_are_of_other_fonts(void **state)
{
    (void)state;
    static const char *const texts[] = {"\\text{a \xd0\xb8 b}", "x = \xd0\xb8",
                                        "\\textbf{\xd0\xb8}"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct font_layout l = set(texts[i], false);
        int others = 0;
        for (int k = 0; k < l.glyphs_count; k++) {
            const struct font_placed *g = &l.glyphs[k];
            others += g->face != face && !g->map && g->glyph;
            if (g->x_px < 0 || g->x_px > l.width_px)
                fail_msg("%s: a letter stands outside", texts[i]);
        }
        if (others != 1 || l.missing_count)
            fail_msg("%s: %d letters of another font", texts[i], others);
        font_layout_finish(&l);
    }
    struct font_layout l = set("x \xf3\xb0\x80\x80", false); /* a private one: nobody's */
    assert_int_equal(l.missing_count, 1);
    assert_int_equal(l.missing[0], 0xf0000);
    assert_int_equal(l.glyphs_count, 2); /* the sign for that */
    font_layout_finish(&l);
}

static void frame_goes_around(void **state)
{
    (void)state;
    struct font_layout l = set("\\boxed{x}y", false), plain = set("xy", false);
    const double gap = 0.3 * size, thick = 0.04 * size;
    near(l.width_px, plain.width_px + 2 * (gap + thick));
    near(from(&l, 7)->x_px, gap + thick);
    const struct font_box top = rule(&l, 0), bottom = rule(&l, 1), left = rule(&l, 2);
    const struct font_box x = ink(from(&l, 7)->glyph, size);
    near(top.y1, x.y0 - gap);
    near(bottom.y0, x.y1 + gap);
    near(left.y0, top.y0);
    near(left.y1, bottom.y1);
    near(top.x1 - top.x0, from(&l, 9)->x_px);
    font_layout_finish(&l);
    font_layout_finish(&plain);
}

/* Two ways to write one thing: the same letters in the same places. */
static void formulas_are_the_same(const char *one, const char *other)
{
    struct font_layout a = set(one, true), b = set(other, true);
    if (a.glyphs_count != b.glyphs_count || fabs(a.width_px - b.width_px) > 0.01)
        fail_msg("%s is not %s: %d letters, %.2f wide, and %d, %.2f", one, other,
                 a.glyphs_count, a.width_px, b.glyphs_count, b.width_px);
    for (int i = 0; i < a.glyphs_count; i++)
        if (a.glyphs[i].glyph != b.glyphs[i].glyph ||
            fabs(a.glyphs[i].x_px - b.glyphs[i].x_px) > 0.01)
            fail_msg("%s is not %s: letter %d", one, other, i);
    font_layout_finish(&a);
    font_layout_finish(&b);
}

static void other_notations_are_the_same(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        {"x\\tag{1}", "x\\qquad(\\text{1})"},
        {"x\\tag*{A}", "x\\qquad\\text{A}"},
        {"a\\label{b}c", "ac"},
        {"\\textcolor{red}{x}+\\color{blue}y", "{x}+y"},
        {"{\\bf v}w", "\\mathbf{v}w"},
        {"{\\rm d}x", "\\mathrm{d}x"},
        {"\\left(\\cal A\\right)b", "\\left(\\mathcal{A}\\right)b"},
        {"\\textbf{ab}", "\\mathbf{ab}"},
        {"a\\hspace{1em}b", "a\\quad b"},
        {"a\\hskip 1em b", "a\\quad b"},
        {"a\\mkern18mu b", "a\\quad b"},
        {"a\\hspace*{-10pt}b", "a\\hspace{-1em}b"},
        {"a\\hspace{1e9em}b", "ab"},
        {"a\\lt b\\gt c", "a<b>c"},
        {"\\R\\Z", "\\mathbb{RZ}"},
        {"\\begin{alignedat}{2}a&=b\\end{alignedat}", "\\begin{aligned}a&=b\\end{aligned}"},
        {"\\begin{aligned}[t]a&=b\\end{aligned}", "\\begin{aligned}a&=b\\end{aligned}"},
        {"\\begin{multline}a\\\\b\\end{multline}", "\\begin{gathered}a\\\\b\\end{gathered}"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        formulas_are_the_same(pairs[i][0], pairs[i][1]);
}

static void wrong_notation_ends_where_it_must(void **state)
{
    (void)state;
    static const char *const texts[] = {"",
                                        "{",
                                        "}",
                                        "\\",
                                        "\\frac",
                                        "\\frac{",
                                        "x^",
                                        "_",
                                        "^2",
                                        "\\left(",
                                        "\\right)",
                                        "\\begin{matrix}",
                                        "\\begin",
                                        "\\begin{?}",
                                        "\\end{x}",
                                        "a&b\\\\",
                                        "\\sqrt[",
                                        "\\text{",
                                        "\\middle|",
                                        "\\limits",
                                        "a^b^c",
                                        "\\left.x",
                                        "\\not",
                                        "\\over",
                                        "a\\over b\\over c",
                                        "\\substack",
                                        "\\xrightarrow",
                                        "%",
                                        "\\hat",
                                        "\\begin{array}{|c|}x",
                                        "\xff\xfe",
                                        "\\\xc3",
                                        "$x$",
                                        "\\binom"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct font_layout l = set(texts[i], i & 1);
        assert_true(isfinite(l.width_px) && isfinite(l.ascent_px) && isfinite(l.descent_px));
        font_layout_finish(&l);
    }
}

static void what_is_too_large_is_refused(void **state)
{
    (void)state;
    enum { DEEP = 101, LONG = 70000 };
    const struct font_math_options options = {.size_px = size};
    char *tex = malloc(LONG);
    struct font_layout l;
    assert_non_null(tex);
    memset(tex, '{', DEEP);
    assert_int_equal(font_math_layout(math, tex, DEEP, &options, &l), FONT_TOO_LARGE);
    assert_non_null(strstr(font_error(), "100"));
    assert_int_equal(l.glyphs_count, 0);
    assert_font(font_math_layout(math, tex, DEEP - 1, &options, &l));
    font_layout_finish(&l);
    memset(tex, 'x', LONG);
    assert_int_equal(font_math_layout(math, tex, LONG, &options, &l), FONT_TOO_LARGE);
    assert_font(font_math_layout(math, tex, 1 << 16, &options, &l));
    assert_int_equal(l.glyphs_count, 1 << 16);
    font_layout_finish(&l);
    const struct font_math_options none = {.size_px = 0};
    assert_int_equal(font_math_layout(math, "x", 1, &none, &l), FONT_BAD_ARGUMENT);
    free(tex);

    struct font_face *other = face_open("DejaVuSansMono");
    struct font_math *of = NULL;
    assert_int_equal(font_math_create(other, &of), FONT_BAD_ARGUMENT);
    assert_non_null(strstr(font_error(), "MATH"));
    assert_null(of);
    font_face_close(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fraction_stands_on_the_axis),
        cmocka_unit_test(scripts_are_raised_and_lowered),
        cmocka_unit_test(root_covers_what_is_in_it),
        cmocka_unit_test(spaces_are_tex_s),
        cmocka_unit_test(limits_stand_over_operators),
        cmocka_unit_test(fences_grow_with_what_they_hold),
        cmocka_unit_test(columns_are_aligned),
        cmocka_unit_test(letters_are_of_their_alphabet),
        cmocka_unit_test(unknown_commands_are_shown_as_written),
        cmocka_unit_test(letters_that_the_font_lacks_are_of_other_fonts),
        cmocka_unit_test(frame_goes_around),
        cmocka_unit_test(other_notations_are_the_same),
        cmocka_unit_test(wrong_notation_ends_where_it_must),
        cmocka_unit_test(what_is_too_large_is_refused),
    };
    struct font_face_info info;
    const char *name = font_face_first(font_math_fonts);
    if (font_face_open(name, 0, &face) != FONT_OK) {
        printf("skipped: there is no font with a MATH table (package fonts-dejavu-extra)\n");
        return 77;
    }
    font_face_describe(face, &info);
    upem = info.units_per_em;
    assert_font(font_math_create(face, &math));
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    font_math_destroy(math);
    font_face_close(face);
    return failed;
}
