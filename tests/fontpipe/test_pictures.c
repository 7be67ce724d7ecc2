/* test_pictures.c - pictures of several characters (flags, keycaps, skins, families) are one
 * glyph of one face; letters that are apart have no forms of letters together. */
#include "support.h"

#include "../skip.h"

#include <text.h>

#include <string.h>

static int laid(const char *text, const struct font_text_options *options, bool colour,
                const char *font, struct font_layout *l, struct font_shaper **s,
                struct font_face **face)
{
    *face = face_open(font);
    *s = shaper_make(*face);
    if (colour)
        font_shaper_colour(*s);
    assert_font(font_shaper_layout(*s, text, strlen(text), 20, options, l));
    return l->glyphs_count;
}

static void done(struct font_layout *l, struct font_shaper *s, struct font_face *face)
{
    font_layout_finish(l);
    font_shaper_destroy(s);
    font_face_close(face);
}

static const struct {
    const char *text;
    int clusters;
    bool pictures; /* in colours */
} sequences[] = {
    {"1\xef\xb8\x8f\xe2\x83\xa3", 1, true},                            /* keycap */
    {"#\xef\xb8\x8f\xe2\x83\xa3", 1, true},                            /* keycap */
    {"\xe2\x9d\xa4\xef\xb8\x8f", 1, true},                             /* heart, coloured */
    {"\xe2\x9c\x88\xef\xb8\x8f", 1, true},                             /* aeroplane */
    {"\xe2\x9c\x88", 1, false},                                        /* as a letter */
    {"\xf0\x9f\x87\xab\xf0\x9f\x87\xb7", 1, true},                     /* France */
    {"\xf0\x9f\x91\x8d\xf0\x9f\x8f\xbd", 1, true},                     /* thumb, skin */
    {"\xf0\x9f\xa4\xb7\xe2\x80\x8d\xe2\x99\x82\xef\xb8\x8f", 1, true}, /* man shrugging */
    {"\xf0\x9f\x91\xa8\xe2\x80\x8d\xf0\x9f\x91\xa9\xe2\x80\x8d\xf0\x9f\x91\xa7", 1, true},
    {"\xf0\x9f\x91\xa9\xe2\x80\x8d\xe2\x9d\xa4\xef\xb8\x8f\xe2\x80\x8d\xf0\x9f\x91\xa9", 1,
     true},
    {"ab", 2, false},
    {"12", 2, false},
    {"1\xe2\x80\x8d"
     "2",
     2, false}, /* a joiner joins no digits */
};

/* What of the layout comes from different bytes. */
static int clusters_of(const struct font_layout *l)
{
    int n = 0;
    for (int i = 0; i < l->glyphs_count; i++)
        n += i == 0 || l->glyphs[i].cluster != l->glyphs[i - 1].cluster;
    return n;
}

static bool emoji_there(void)
{
    struct font_face *face;
    if (font_face_open_coloured("Noto Color Emoji", 0, &face) != FONT_OK)
        return false;
    struct font_face_info info;
    font_face_describe(face, &info);
    bool there = strstr(info.family, "Emoji") != NULL;
    font_face_close(face);
    return there;
}

static void pictures_are_whole(void **state)
{
    (void)state;
    if (!emoji_there())
        skip_because("there is no Noto Color Emoji");
    for (int around = 0; around < 2; around++) /* by themselves, and among letters */
        for (size_t n = 0; n < sizeof sequences / sizeof *sequences; n++) {
            struct font_layout l;
            struct font_shaper *s;
            struct font_face *face;
            char text[64];
            snprintf(text, sizeof text, around ? "x%sy" : "%s", sequences[n].text);
            laid(text, NULL, true, "DejaVuSans", &l, &s, &face);
            int clusters = clusters_of(&l) - 2 * around;
            if (clusters != sequences[n].clusters)
                fail_msg("%s: %d clusters", text, clusters);
            struct font_face_info info;
            font_face_describe(l.glyphs[around].face, &info);
            if ((strstr(info.family, "Emoji") != NULL) != sequences[n].pictures)
                fail_msg("%s: of %s", text, info.family);
            assert_int_equal(l.missing_count, 0);
            done(&l, s, face);
        }
}

static int glyphs_spaced(const char *text, double spacing, const char *features, double *width,
                         uint32_t *glyphs)
{
    struct font_text_options options = {.letter_spacing_px = spacing, .features = features};
    struct font_layout l;
    struct font_shaper *s;
    struct font_face *face;
    int n = laid(text, &options, false,
                 (unsigned char)*text < 0x80 ? "EBGaramond12-Regular" : "DejaVuSans", &l, &s,
                 &face);
    for (int i = 0; i < n && i < 64; i++)
        glyphs[i] = l.glyphs[i].glyph;
    *width = l.lines[0].width_px;
    done(&l, s, face);
    return n;
}

/* "office fjord": no dotless i and j where an f no longer leans over them; and where they are
 * asked for, they are there. */
static void letters_apart_have_their_own_forms(void **state)
{
    (void)state;
    uint32_t together[64], apart[64], off[64], asked[64];
    double width, wide;
    int n = glyphs_spaced("office fjord", 0, NULL, &width, together);
    int m = glyphs_spaced("office fjord", 0, "-liga,-clig,-dlig,-hlig", &width, off);
    int k = glyphs_spaced("office fjord", 3, NULL, &wide, apart);
    assert_int_equal(k, m);
    assert_memory_equal(apart, off, (size_t)k * sizeof *off);
    assert_true(n != m || memcmp(together, off, (size_t)m * sizeof *off) != 0);
    assert_true(wide > width + 11 * 3 - 0.01 && wide < width + 11 * 3 + 0.01);
    int a = glyphs_spaced("office fjord", 3, "liga", &wide, asked);
    assert_int_equal(a, n);
    assert_memory_equal(asked, together, (size_t)n * sizeof *asked);
}

/* Arabic letters join, so nothing parts them. */
static void joined_letters_stay_together(void **state)
{
    (void)state;
    static const char text[] =
        "\xd8\xb3\xd9\x84\xd8\xa7\xd9\x85"; /* salam, with its lam-alef */
    uint32_t plain[64], spaced[64];
    double width, wide;
    int n = glyphs_spaced(text, 0, NULL, &width, plain);
    int m = glyphs_spaced(text, 5, NULL, &wide, spaced);
    assert_int_equal(n, m);
    assert_memory_equal(plain, spaced, (size_t)n * sizeof *plain);
    assert_true(width == wide);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_whole),
        cmocka_unit_test(letters_apart_have_their_own_forms),
        cmocka_unit_test(joined_letters_stay_together),
    };
    return cmocka_run_group_tests_name("pictures", tests, NULL, NULL);
}
