/* text.c - UTF-8, faces for HarfBuzz, and faces for what the first has not: see text.h.
 * text_lines.c sets the lines. */
#include "colour.h"
#include "internal.h"
#include "text_internal.h"

#include <word_list.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <hb-ot.h>

bool font_align_named(const char *word, enum font_align *out)
{
    const int found = word_list_find("left right center justify", word);
    if (found >= 0)
        *out = (enum font_align)(FONT_ALIGN_LEFT + found);
    return found >= 0;
}

/* ---- UTF-8 ---- */

int font_utf8_put(uint32_t character, char to[FONT_UTF8_BYTES])
{
    if (character < 0x80) {
        to[0] = (char)character;
        return 1;
    }
    const int bytes = character < 0x800 ? 2 : character < 0x10000 ? 3 : 4;
    for (int i = bytes - 1; i > 0; i--, character >>= 6)
        to[i] = (char)(0x80 | (character & 0x3f));
    to[0] = (char)((0xf00 >> bytes & 0xf0) | (int)character);
    return bytes;
}

bool font_utf8_next(const char **text, const char *end, uint32_t *character)
{
    const unsigned char *s = (const unsigned char *)*text;
    size_t left = (size_t)(end - *text);
    uint32_t c = s[0];
    int more = c < 0x80                ? 0
               : c >= 0xc2 && c < 0xe0 ? 1
               : (c & 0xf0) == 0xe0    ? 2
               : c >= 0xf0 && c < 0xf5 ? 3
                                       : -1;
    *character = 0xfffd;
    if (more < 0) {
        *text += 1;
        return false;
    }
    if (more)
        c &= 0x3fu >> more;
    int taken = 1;
    for (; taken <= more && (size_t)taken < left && (s[taken] & 0xc0) == 0x80; taken++) {
        /* The second byte rules out what is spelled too long, surrogates, and what is beyond
         * Unicode. */
        if (taken == 1 && ((s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] >= 0xa0) ||
                           (s[0] == 0xf0 && s[1] < 0x90) || (s[0] == 0xf4 && s[1] >= 0x90)))
            break;
        c = c << 6 | (s[taken] & 0x3fu);
    }
    *text += taken;
    if (taken <= more)
        return false;
    *character = c;
    return true;
}

int font_utf8_damaged(const char *text, size_t bytes)
{
    int damaged = 0;
    uint32_t c;
    for (const char *at = text, *end = text + bytes; at < end;)
        damaged += !font_utf8_next(&at, end, &c);
    return damaged;
}

enum font_status font_utf8_mend(const char *text, size_t bytes, char **out, size_t *out_bytes)
{
    static const char instead[3] = {'\xef', '\xbf', '\xbd'}; /* U+FFFD */
    char *to = *out =
        malloc(bytes + sizeof instead * (size_t)font_utf8_damaged(text, bytes) + 1);
    if (!to)
        return font_fail(FONT_NO_MEMORY, "no memory for a text");
    for (const char *at = text, *end = text + bytes; at < end;) {
        const char *from = at;
        uint32_t c;
        bool good = font_utf8_next(&at, end, &c);
        size_t count = good ? (size_t)(at - from) : sizeof instead;
        memcpy(to, good ? from : instead, count);
        to += count;
    }
    *to = '\0';
    *out_bytes = (size_t)(to - *out);
    return FONT_OK;
}

/* ---- faces for HarfBuzz ----
 *
 * HarfBuzz reads OpenType's tables itself: characters, advances, kerning and extents take no
 * outline. Type 1 fonts have no such tables; FreeType answers for them. */

static hb_bool_t glyph_nominal(hb_font_t *font, void *data, hb_codepoint_t character,
                               hb_codepoint_t *glyph, void *user)
{
    (void)font;
    (void)user;
    *glyph = font_face_glyph(data, character);
    return *glyph != 0;
}

static hb_position_t glyph_advance(hb_font_t *font, void *data, hb_codepoint_t glyph,
                                   void *user)
{
    (void)font;
    (void)user;
    double advance;
    font_face_advance(data, glyph, &advance);
    return (hb_position_t)lrint(advance);
}

static hb_bool_t glyph_extents(hb_font_t *font, void *data, hb_codepoint_t glyph,
                               hb_glyph_extents_t *extents, void *user)
{
    (void)font;
    (void)user;
    struct font_outline outline;
    if (font_face_outline_raw(data, glyph, &outline) != FONT_OK)
        return 0;
    struct font_box box = font_outline_box(&outline);
    font_outline_finish(&outline);
    extents->x_bearing = (hb_position_t)floor(box.x0);
    extents->y_bearing = (hb_position_t)ceil(box.y1);
    extents->width = (hb_position_t)ceil(box.x1 - box.x0);
    extents->height = (hb_position_t)floor(box.y0 - box.y1);
    return 1;
}

static hb_position_t glyph_kerning(hb_font_t *font, void *data, hb_codepoint_t left,
                                   hb_codepoint_t right, void *user)
{
    (void)font;
    (void)user;
    return (hb_position_t)lrint(font_face_kerning(data, left, right));
}

/* HarfBuzz's own, but of glyphs that were replaced. */
static hb_position_t glyph_advance_now(hb_font_t *font, void *data, hb_codepoint_t glyph,
                                       void *user)
{
    (void)user;
    double advance;
    if (font_face_is_replaced(data, glyph) &&
        font_face_advance(data, glyph, &advance) == FONT_OK)
        return (hb_position_t)lrint(advance);
    return hb_font_get_glyph_h_advance(hb_font_get_parent(font), glyph);
}

/* The font as the face is now. */
static hb_font_t *font_now(hb_font_t *own, struct font_face *face)
{
    if (!font_face_replaced_count(face))
        return hb_font_reference(own);
    hb_font_t *now = hb_font_create_sub_font(own);
    hb_font_funcs_t *funcs = hb_font_funcs_create();
    hb_font_funcs_set_glyph_h_advance_func(funcs, glyph_advance_now, NULL, NULL);
    hb_font_set_funcs(now, funcs, face, NULL);
    hb_font_funcs_destroy(funcs);
    return now;
}

static hb_font_funcs_t *funcs_make(void)
{
    hb_font_funcs_t *funcs = hb_font_funcs_create();
    hb_font_funcs_set_nominal_glyph_func(funcs, glyph_nominal, NULL, NULL);
    hb_font_funcs_set_glyph_h_advance_func(funcs, glyph_advance, NULL, NULL);
    hb_font_funcs_set_glyph_extents_func(funcs, glyph_extents, NULL, NULL);
    hb_font_funcs_set_glyph_h_kerning_func(funcs, glyph_kerning, NULL, NULL);
    hb_font_funcs_make_immutable(funcs);
    return funcs;
}

/* Whether the file has OpenType's tables of characters and advances. */
static bool has_tables(hb_face_t *face)
{
    const hb_tag_t tags[] = {HB_TAG('c', 'm', 'a', 'p'), HB_TAG('h', 'm', 't', 'x'),
                             HB_TAG('h', 'h', 'e', 'a')};
    bool has = true;
    for (int i = 0; i < 3; i++) {
        hb_blob_t *blob = hb_face_reference_table(face, tags[i]);
        has = has && hb_blob_get_length(blob) > 0;
        hb_blob_destroy(blob);
    }
    return has;
}

static void shaped_make(struct font_shaped_face *f, const struct font_face_info *info)
{
    hb_face_t *face = font_face_harfbuzz(f->face);
    f->own = hb_font_create(face);
    if (has_tables(face)) {
        hb_ot_font_set_funcs(f->own);
    } else {
        hb_font_funcs_t *funcs = funcs_make();
        hb_font_set_funcs(f->own, funcs, f->face, NULL);
        hb_font_funcs_destroy(funcs);
    }
    hb_font_set_scale(f->own, (int)info->units_per_em, (int)info->units_per_em);
    f->units_per_em = info->units_per_em;
}

/* Makes the HarfBuzz font; if the face's axes were set or its glyphs replaced since, makes it
 * follow: what HarfBuzz keeps of the tables stays. */
void font_shaped_refresh(struct font_shaped_face *f)
{
    if (f->hb && f->version == font_face_version(f->face))
        return;
    struct font_face_info info;
    font_face_describe(f->face, &info);
    if (!f->own)
        shaped_make(f, &info);
    hb_font_destroy(f->hb);
    font_face_harfbuzz_variations(f->face, f->own);
    f->hb = font_now(f->own, f->face);
    f->version = font_face_version(f->face);
}

enum font_status font_shaper_create(struct font_face *face, struct font_shaper **out)
{
    *out = NULL;
    struct font_shaper *s = calloc(1, sizeof *s);
    if (!s)
        return font_fail(FONT_NO_MEMORY, "no memory to shape text");
    s->faces[0].face = face;
    s->faces_count = 1;
    s->buffer = hb_buffer_create();
    font_shaped_refresh(&s->faces[0]);
    *out = s;
    return FONT_OK;
}

void font_shaper_colour(struct font_shaper *s)
{
    s->colour = true;
}

void font_shaper_destroy(struct font_shaper *s)
{
    if (!s)
        return;
    for (int i = 0; i < s->faces_count; i++) {
        hb_font_destroy(s->faces[i].hb);
        hb_font_destroy(s->faces[i].own);
        if (s->faces[i].owned)
            font_face_close(s->faces[i].face);
    }
    font_face_close(s->spare);
    hb_buffer_destroy(s->buffer);
    if (s->candidates)
        FcFontSetDestroy(s->candidates);
    free(s);
}

/* ---- fallback ---- */

/* All fonts there are, those most like the first face first: a bold word's other letters are
 * bold, too. */
static void candidates_find(struct font_shaper *s)
{
    struct font_face_info info;
    font_face_describe(s->faces[0].face, &info);
    FcPattern *pattern = FcInit() ? FcPatternCreate() : NULL;
    if (!pattern)
        return;
    FcResult result;
    FcPatternAddString(pattern, FC_FAMILY, (const FcChar8 *)info.family);
    const struct font_manner manner = font_face_manner(s->faces[0].face);
    FcPatternAddDouble(pattern, FC_WEIGHT, manner.weight);
    FcPatternAddInteger(pattern, FC_SLANT, manner.slant);
    FcPatternAddInteger(pattern, FC_WIDTH, manner.width);
    FcPatternAddBool(pattern, FC_OUTLINE, FcTrue);
    FcConfigSubstitute(NULL, pattern, FcMatchPattern);
    FcDefaultSubstitute(pattern);
    s->candidates = FcFontSort(NULL, pattern, FcTrue, NULL, &result);
    FcPatternDestroy(pattern);
}

/* One of which something is seen. */
static bool has_glyph(const struct font_shaper *s, struct font_face *face, uint32_t character)
{
    uint32_t glyph = font_face_glyph(face, character);
    return glyph && !font_colour_lost(face, glyph, s->colour);
}

/* The shaper's face that is candidate i of fontconfig's, opened if need be; -1 if it cannot be,
 * or has not the character. */
static int candidate_open(struct font_shaper *s, int i, uint32_t character)
{
    FcCharSet *set;
    FcChar8 *file;
    int index = 0;
    FcPattern *font = s->candidates->fonts[i];
    if (FcPatternGetCharSet(font, FC_CHARSET, 0, &set) != FcResultMatch ||
        !FcCharSetHasChar(set, character) ||
        FcPatternGetString(font, FC_FILE, 0, &file) != FcResultMatch)
        return -1;
    for (int k = 1; k < s->faces_count; k++)
        if (s->faces[k].candidate == i)
            return has_glyph(s, s->faces[k].face, character) ? k : -1;
    if (s->faces_count == FONT_FACES_MAX)
        return -1;
    FcPatternGetInteger(font, FC_INDEX, 0, &index);
    struct font_face *face = s->spare;
    if (!face || s->spare_candidate != i) {
        if ((s->colour ? font_face_open_coloured
                       : font_face_open)((const char *)file, index & 0xffff, &face) != FONT_OK)
            return -1;
        font_face_close(s->spare);
    }
    s->spare = face;
    s->spare_candidate = i;
    if (!has_glyph(s, face, character))
        return -1; /* a text that has one such character has more of them */
    s->spare = NULL;
    s->faces[s->faces_count] =
        (struct font_shaped_face){.face = face, .owned = true, .candidate = i};
    font_shaped_refresh(&s->faces[s->faces_count]);
    return s->faces_count++;
}

/* Always in fontconfig's order: which face it is does not depend on the characters that were
 * looked for before. */
int font_shaper_face_for(struct font_shaper *s, uint32_t character)
{
    if (has_glyph(s, s->faces[0].face, character))
        return 0;
    if (!s->candidates)
        candidates_find(s);
    struct font_known *known = &s->known[character % FONT_KNOWN];
    if (known->character == character && known->face)
        return known->face;
    int face = -1;
    for (int i = 0; face < 0 && s->candidates && i < s->candidates->nfont; i++)
        face = candidate_open(s, i, character);
    *known = (struct font_known){character, face};
    return face;
}

/* Whether the face has colours, and all that is seen of a picture. */
static bool has_picture(const struct font_shaper *s, int face, const uint32_t *c, int count)
{
    struct font_face *of = s->faces[face].face;
    bool coloured = false;
    for (int i = 0; i < count; i++) {
        uint32_t glyph = font_face_glyph(of, c[i]);
        if (font_text_invisible(c[i])) /* what joins them */
            continue;
        if (!glyph)
            return false;
        coloured = coloured || font_colour_of(of, glyph) != FONT_COLOUR_NONE;
    }
    return coloured;
}

int font_shaper_face_for_picture(struct font_shaper *s, const uint32_t *characters, int count)
{
    if (!s->colour)
        return -1;
    if (has_picture(s, 0, characters, count))
        return 0;
    if (!s->candidates)
        candidates_find(s);
    for (int i = 0; s->candidates && i < s->candidates->nfont; i++) {
        FcBool coloured = FcFalse;
        if (FcPatternGetBool(s->candidates->fonts[i], FC_COLOR, 0, &coloured) !=
                FcResultMatch ||
            !coloured)
            continue;
        int face = candidate_open(s, i, characters[0]);
        if (face >= 0 && has_picture(s, face, characters, count))
            return face;
    }
    return -1;
}
