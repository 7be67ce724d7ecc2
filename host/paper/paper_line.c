/* paper_line.c - a line of type as a screen, by FreeType.
 *
 * The line is laid out unhinted in font units scaled to 1/64 pixel, so letters stand where the type designer
 * put them; each is rendered at its own fraction of a pixel.  Where letters overlap the darker wins. */
#include "paper_internal.h"
#include "paper_kerning.h"

#include FT_GLYPH_H
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LETTERS_MAX = 4096, SCREEN_SIDE_MAX = 32768 };

struct line_letter {
    FT_Glyph glyph; /* rendered: an FT_BitmapGlyph at its place, y upwards from the baseline */
};

struct line_setting {
    FT_Library library;
    FT_Face face;
    struct paper_kerning kerning;
    struct line_letter letters[LETTERS_MAX];
    int letters_count;
    FT_Pos pen;       /* 1/64 pixel */
    uint32_t missing; /* the first code point without a glyph, or 0 */
    int found_count;  /* code points other than spaces that have one */
};

/* The next code point of UTF-8, *text moved past it; UINT32_MAX where it is malformed. */
static uint32_t utf8_next(const char **text)
{
    const unsigned char *s = (const unsigned char *)*text;
    int more = s[0] < 0x80 ? 0 : (s[0] & 0xe0) == 0xc0 ? 1 : (s[0] & 0xf0) == 0xe0 ? 2 : 3;
    if (s[0] >= 0x80 && s[0] < 0xc2)
        return UINT32_MAX;
    if (s[0] > 0xf4)
        return UINT32_MAX;
    uint32_t code = more == 0 ? s[0] : s[0] & (0x3fu >> more);
    for (int i = 1; i <= more; i++) {
        if ((s[i] & 0xc0) != 0x80)
            return UINT32_MAX;
        code = code << 6 | (s[i] & 0x3fu);
    }
    static const uint32_t least[4] = {0, 0x80, 0x800, 0x10000};
    if (code < least[more] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000))
        return UINT32_MAX;
    *text += more + 1;
    return code;
}

static enum paper_status font_open(struct line_setting *set, const struct paper_line *line)
{
    if (FT_Init_FreeType(&set->library) != 0)
        return paper_fail(PAPER_NO_MEMORY, "FreeType does not start: no memory");
    char *path = paper_font_find(line->font);
    if (!path)
        return paper_fail(PAPER_BAD_FONT,
                          "there is no font '%s'; give a font file, or the name of one in "
                          "/usr/share/fonts",
                          line->font ? line->font : "");
    FT_Error error = FT_New_Face(set->library, path, 0, &set->face);
    enum paper_status status = PAPER_OK;
    if (error == FT_Err_Cannot_Open_Resource)
        status = paper_fail(PAPER_BAD_FONT, "%s: there is no such font file", path);
    else if (error)
        status = paper_fail(PAPER_BAD_FONT, "%s: not a font that FreeType can read", path);
    else if (!FT_IS_SCALABLE(set->face))
        status = paper_fail(PAPER_BAD_FONT, "%s: the font has no outlines; choose one that has",
                            path);
    else if (FT_Set_Char_Size(set->face, 0, (FT_F26Dot6)lround(line->size_px * 64), 72, 72) !=
             0)
        status =
            paper_fail(PAPER_BAD_FONT, "%s: cannot be set at %g pixels", path, line->size_px);
    free(path);
    return status;
}

static FT_Pos kerning_between(struct line_setting *set, unsigned left, unsigned right)
{
    FT_Vector kern = {0, 0};
    if (FT_HAS_KERNING(set->face)) {
        FT_Get_Kerning(set->face, left, right, FT_KERNING_UNFITTED, &kern);
        return kern.x;
    }
    return FT_MulFix(paper_kerning_between(&set->kerning, left, right),
                     set->face->size->metrics.x_scale);
}

/* Puts one glyph at the pen and moves the pen on. */
static enum paper_status letter_set(struct line_setting *set, unsigned glyph)
{
    if (set->letters_count == LETTERS_MAX)
        return paper_fail(PAPER_BAD_TEXT, "a line has at most %d letters", LETTERS_MAX);
    FT_Glyph *out = &set->letters[set->letters_count].glyph;
    if (FT_Load_Glyph(set->face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0 ||
        FT_Get_Glyph(set->face->glyph, out) != 0)
        return paper_fail(PAPER_BAD_FONT, "%s: glyph %u is damaged",
                          set->face->family_name ? set->face->family_name : "the font", glyph);
    set->letters_count++;
    FT_Vector origin = {set->pen, 0};
    FT_BBox box;
    FT_Glyph_Get_CBox(*out, FT_GLYPH_BBOX_PIXELS, &box);
    if (box.xMax - box.xMin > SCREEN_SIDE_MAX || box.yMax - box.yMin > SCREEN_SIDE_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "a letter is larger than %d pixels; set it smaller", SCREEN_SIDE_MAX);
    set->pen += set->face->glyph->linearHoriAdvance >> 10;
    if (FT_Glyph_To_Bitmap(out, FT_RENDER_MODE_NORMAL, &origin, 1) != 0)
        return paper_fail(PAPER_NO_MEMORY, "no memory to render a letter");
    return PAPER_OK;
}

static enum paper_status line_set(struct line_setting *set, const struct paper_line *line)
{
    unsigned previous = 0;
    FT_Pos tracking = (FT_Pos)lround(line->tracking_em * line->size_px * 64);
    for (const char *text = line->text; *text;) {
        uint32_t code = utf8_next(&text);
        if (code == UINT32_MAX)
            return paper_fail(PAPER_BAD_TEXT, "the text is not UTF-8 at its byte %zu",
                              (size_t)(text - line->text) + 1);
        if (code < 0x20) /* tabs and line ends: a line has neither */
            code = ' ';
        unsigned glyph = FT_Get_Char_Index(set->face, code);
        if (glyph == 0 && set->missing == 0)
            set->missing = code;
        set->found_count += glyph != 0 && code != ' ';
        if (previous)
            set->pen += kerning_between(set, previous, glyph) + tracking;
        enum paper_status status = letter_set(set, glyph);
        if (status != PAPER_OK)
            return status;
        if (labs(set->pen) > SCREEN_SIDE_MAX * 64l)
            return paper_fail(PAPER_BAD_ARGUMENT,
                              "the line is longer than %d pixels; set it smaller",
                              SCREEN_SIDE_MAX);
        previous = glyph;
    }
    if (set->missing && !set->found_count)
        return paper_fail(
            PAPER_BAD_TEXT,
            "%s has no glyphs for \"%.60s\" (U+%04X is the first it lacks); choose "
            "another font",
            set->face->family_name ? set->face->family_name : "the font", line->text,
            (unsigned)set->missing);
    return PAPER_OK;
}

static void letter_blend(struct paper_screen *screen, FT_BitmapGlyph letter)
{
    for (unsigned y = 0; y < letter->bitmap.rows; y++) {
        const uint8_t *from = letter->bitmap.buffer + (long)y * letter->bitmap.pitch;
        int row = screen->baseline_y_px - letter->top + (int)y;
        uint8_t *to = screen->gray + (size_t)row * (size_t)screen->width_px +
                      (screen->origin_x_px + letter->left);
        for (unsigned x = 0; x < letter->bitmap.width; x++)
            to[x] = from[x] > to[x] ? from[x] : to[x];
    }
}

static enum paper_status line_render(const struct line_setting *set,
                                     const struct paper_line *line, struct paper_screen *screen)
{
    int left = SCREEN_SIDE_MAX, right = -SCREEN_SIDE_MAX, top = right, bottom = left;
    for (int i = 0; i < set->letters_count; i++) {
        FT_BitmapGlyph letter = (FT_BitmapGlyph)set->letters[i].glyph;
        int width = (int)letter->bitmap.width, height = (int)letter->bitmap.rows;
        if (width == 0 || height == 0)
            continue;
        left = letter->left < left ? letter->left : left;
        right = letter->left + width > right ? letter->left + width : right;
        top = letter->top > top ? letter->top : top;
        bottom = letter->top - height < bottom ? letter->top - height : bottom;
    }
    if (left >= right)
        return paper_fail(PAPER_BAD_TEXT, "the text \"%.60s\" leaves no mark on the paper",
                          line->text);
    screen->width_px = right - left;
    screen->height_px = top - bottom;
    screen->origin_x_px = -left;
    screen->baseline_y_px = top;
    screen->advance_px = (double)set->pen / 64;
    screen->gray = calloc((size_t)screen->height_px, (size_t)screen->width_px);
    if (!screen->gray)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a line of %dx%d pixels", right - left,
                          top - bottom);
    for (int i = 0; i < set->letters_count; i++)
        letter_blend(screen, (FT_BitmapGlyph)set->letters[i].glyph);
    return PAPER_OK;
}

enum paper_status paper_line_screen(const struct paper_line *line, struct paper_screen *screen,
                                    uint32_t *missing)
{
    *screen = (struct paper_screen){0};
    if (missing)
        *missing = 0;
    if (!line->text || !(line->size_px >= 1 && line->size_px <= 8192) ||
        !(fabs(line->tracking_em) <= 16))
        return paper_fail(
            PAPER_BAD_ARGUMENT,
            "type is 1..8192 pixels large and tracked by at most 16 em (got %g, %g)",
            line->size_px, line->tracking_em);
    struct line_setting *set = calloc(1, sizeof *set);
    if (!set)
        return paper_fail(PAPER_NO_MEMORY, "no memory to set type");

    enum paper_status status = font_open(set, line);
    if (status == PAPER_OK) {
        paper_kerning_create(&set->kerning, set->face);
        status = line_set(set, line);
    }
    if (status == PAPER_OK)
        status = line_render(set, line, screen);
    if (status == PAPER_OK && missing)
        *missing = set->missing;
    if (status != PAPER_OK)
        paper_screen_destroy(screen);

    for (int i = 0; i < set->letters_count; i++)
        FT_Done_Glyph(set->letters[i].glyph);
    paper_kerning_destroy(&set->kerning);
    if (set->library)
        FT_Done_FreeType(set->library); /* takes the face with it */
    free(set);
    return status;
}

void paper_screen_destroy(struct paper_screen *screen)
{
    if (!screen)
        return;
    free(screen->gray);
    *screen = (struct paper_screen){0};
}
