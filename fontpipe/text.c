/* text.c - see text.h.
 *
 * A line is cut into runs: characters of one direction (FriBidi's levels), one script and one face. Each is shaped by
 * itself, in the order in which it is read; then runs are put in the order in which they are seen: from the highest
 * level down to the lowest odd one, what is on that level or above is turned around (rule L2 of the Unicode
 * bidirectional algorithm). */
#include "text.h"
#include "edges.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <fontconfig/fontconfig.h>
#include <fribidi.h>
#include <hb-ot.h>
#include <hb.h>

enum { FACES_MAX = 24, FEATURES_MAX = 32, CHARACTERS_MAX = 1000000 };

struct shaped_face {
    struct font_face *face;
    hb_font_t *hb;
    uint64_t version;
    bool owned;
    double units_per_em;
};

struct font_shaper {
    struct shaped_face faces[FACES_MAX];
    int faces_count;
    hb_buffer_t *buffer;
    FcFontSet *candidates; /* fontconfig's, best first; NULL until the first is needed */
};

/* ---- UTF-8 ---- */

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
        /* The second byte rules out what is spelled too long, surrogates, and what is beyond Unicode. */
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

/* ---- faces for HarfBuzz ---- */

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

/* Makes the HarfBuzz font, again if the face's axes were set since. */
static enum font_status hb_refresh(struct shaped_face *f)
{
    if (f->hb && f->version == font_face_version(f->face))
        return FONT_OK;
    hb_font_destroy(f->hb);
    size_t count;
    const void *bytes = font_face_bytes(f->face, &count);
    struct font_face_info info;
    font_face_describe(f->face, &info);
    hb_blob_t *blob =
        hb_blob_create(bytes, (unsigned)count, HB_MEMORY_MODE_READONLY, NULL, NULL);
    hb_face_t *face = hb_face_create(blob, (unsigned)info.index);
    hb_face_set_upem(face, (unsigned)info.units_per_em);
    f->hb = hb_font_create(face);
    hb_font_funcs_t *funcs = funcs_make();
    hb_font_set_funcs(f->hb, funcs, f->face, NULL);
    hb_font_set_scale(f->hb, (int)info.units_per_em, (int)info.units_per_em);
    hb_variation_t variations[64];
    int n = 0;
    struct font_axis axis;
    for (; n < info.axes_count && n < 64; n++) {
        if (font_face_axis(f->face, n, &axis) != FONT_OK)
            break;
        variations[n] = (hb_variation_t){hb_tag_from_string(axis.tag, 4), (float)axis.value};
    }
    if (n)
        hb_font_set_variations(f->hb, variations, (unsigned)n);
    hb_font_funcs_destroy(funcs);
    hb_face_destroy(face);
    hb_blob_destroy(blob);
    f->units_per_em = info.units_per_em;
    f->version = font_face_version(f->face);
    return FONT_OK;
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
    hb_refresh(&s->faces[0]);
    *out = s;
    return FONT_OK;
}

void font_shaper_destroy(struct font_shaper *s)
{
    if (!s)
        return;
    for (int i = 0; i < s->faces_count; i++) {
        hb_font_destroy(s->faces[i].hb);
        if (s->faces[i].owned)
            font_face_close(s->faces[i].face);
    }
    hb_buffer_destroy(s->buffer);
    if (s->candidates)
        FcFontSetDestroy(s->candidates);
    free(s);
}

/* ---- fallback ---- */

/* All fonts there are, those most like the first face first. */
static void candidates_find(struct font_shaper *s)
{
    struct font_face_info info;
    font_face_describe(s->faces[0].face, &info);
    FcPattern *pattern = FcInit() ? FcPatternCreate() : NULL;
    if (!pattern)
        return;
    FcResult result;
    FcPatternAddString(pattern, FC_FAMILY, (const FcChar8 *)info.family);
    FcPatternAddBool(pattern, FC_OUTLINE, FcTrue);
    FcConfigSubstitute(NULL, pattern, FcMatchPattern);
    FcDefaultSubstitute(pattern);
    s->candidates = FcFontSort(NULL, pattern, FcTrue, NULL, &result);
    FcPatternDestroy(pattern);
}

/* A face of the shaper that has the character, opened if need be; -1 if there is none. */
static int face_for(struct font_shaper *s, uint32_t character)
{
    for (int i = 0; i < s->faces_count; i++)
        if (font_face_glyph(s->faces[i].face, character))
            return i;
    if (!s->candidates)
        candidates_find(s);
    for (int i = 0; s->candidates && i < s->candidates->nfont && s->faces_count < FACES_MAX;
         i++) {
        FcCharSet *set;
        FcChar8 *file;
        int index = 0;
        FcPattern *font = s->candidates->fonts[i];
        if (FcPatternGetCharSet(font, FC_CHARSET, 0, &set) != FcResultMatch ||
            !FcCharSetHasChar(set, character) ||
            FcPatternGetString(font, FC_FILE, 0, &file) != FcResultMatch)
            continue;
        FcPatternGetInteger(font, FC_INDEX, 0, &index);
        struct font_face *face;
        if (font_face_open((const char *)file, index & 0xffff, &face) != FONT_OK)
            continue;
        if (!font_face_glyph(face, character)) {
            font_face_close(face);
            continue;
        }
        s->faces[s->faces_count] = (struct shaped_face){.face = face, .owned = true};
        hb_refresh(&s->faces[s->faces_count]);
        return s->faces_count++;
    }
    return -1;
}

/* ---- characters and runs ---- */

struct letter {
    uint32_t character;
    int byte, face;
    hb_script_t script;
};

struct run {
    int begin, end, level;
};

struct paragraph {
    struct letter *letters;
    FriBidiChar *characters;
    FriBidiCharType *types;
    FriBidiBracketType *brackets;
    FriBidiLevel *levels;
    struct run *runs;
    int count, runs_count;
    bool to_left;
};

/* Nothing is drawn for it, so no font need have it. */
static bool invisible(hb_unicode_funcs_t *unicode, uint32_t c)
{
    hb_unicode_general_category_t category = hb_unicode_general_category(unicode, c);
    return category == HB_UNICODE_GENERAL_CATEGORY_CONTROL ||
           category == HB_UNICODE_GENERAL_CATEGORY_FORMAT || (c >= 0xfe00 && c <= 0xfe0f) ||
           c == 0x34f;
}

static void missing_add(struct font_layout *out, uint32_t c)
{
    for (int i = 0; i < out->missing_count && i < FONT_MISSING_MAX; i++)
        if (out->missing[i] == c)
            return;
    if (out->missing_count < FONT_MISSING_MAX)
        out->missing[out->missing_count] = c;
    out->missing_count++;
}

static void faces_choose(struct font_shaper *s, struct paragraph *p, bool fallback,
                         struct font_layout *out)
{
    hb_unicode_funcs_t *unicode = hb_unicode_funcs_get_default();
    for (int i = 0; i < p->count; i++) {
        struct letter *l = &p->letters[i];
        int before = i ? p->letters[i - 1].face : 0;
        l->face = before;
        if (invisible(unicode, l->character))
            continue;
        hb_unicode_general_category_t category =
            hb_unicode_general_category(unicode, l->character);
        bool mark = category == HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK ||
                    category == HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK ||
                    category == HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK;
        if (mark && font_face_glyph(s->faces[before].face, l->character))
            continue; /* with its letter */
        int face = font_face_glyph(s->faces[0].face, l->character) ? 0
                   : fallback                                      ? face_for(s, l->character)
                                                                   : -1;
        if (face < 0)
            missing_add(out, l->character);
        else if (face > 0)
            out->fallback_count++;
        l->face = face < 0 ? 0 : face;
    }
}

/* Common and inherited characters go with those before them, at the beginning with those behind. */
static void scripts_choose(struct paragraph *p)
{
    hb_unicode_funcs_t *unicode = hb_unicode_funcs_get_default();
    hb_script_t known = HB_SCRIPT_INVALID;
    for (int i = 0; i < p->count; i++) {
        hb_script_t script = hb_unicode_script(unicode, p->letters[i].character);
        bool shared = script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED;
        if (!shared && known == HB_SCRIPT_INVALID)
            for (int k = 0; k < i; k++)
                p->letters[k].script = script;
        known = shared ? known : script;
        p->letters[i].script = shared && known != HB_SCRIPT_INVALID ? known : script;
    }
}

static bool runs_find(struct paragraph *p, int direction)
{
    for (int i = 0; i < p->count; i++)
        p->characters[i] = p->letters[i].character;
    fribidi_get_bidi_types(p->characters, p->count, p->types);
    fribidi_get_bracket_types(p->characters, p->count, p->types, p->brackets);
    FriBidiParType base = direction > 0   ? FRIBIDI_PAR_RTL
                          : direction < 0 ? FRIBIDI_PAR_LTR
                                          : FRIBIDI_PAR_ON;
    if (!fribidi_get_par_embedding_levels_ex(p->types, p->brackets, p->count, &base, p->levels))
        return false;
    p->to_left = FRIBIDI_IS_RTL(base);
    p->runs_count = 0;
    for (int i = 0; i < p->count; i++) {
        struct run *last = p->runs_count ? &p->runs[p->runs_count - 1] : NULL;
        if (last && last->level == p->levels[i] &&
            p->letters[i].face == p->letters[i - 1].face &&
            p->letters[i].script == p->letters[i - 1].script)
            last->end = i + 1;
        else
            p->runs[p->runs_count++] = (struct run){i, i + 1, p->levels[i]};
    }
    /* The order in which they are seen. */
    int highest = 0, lowest = 127;
    for (int i = 0; i < p->runs_count; i++) {
        highest = p->runs[i].level > highest ? p->runs[i].level : highest;
        if (p->runs[i].level & 1)
            lowest = p->runs[i].level < lowest ? p->runs[i].level : lowest;
    }
    for (int level = highest; level >= lowest; level--)
        for (int i = 0; i < p->runs_count; i++) {
            int end = i;
            while (end < p->runs_count && p->runs[end].level >= level)
                end++;
            for (int a = i, b = end - 1; a < b; a++, b--) {
                struct run swap = p->runs[a];
                p->runs[a] = p->runs[b];
                p->runs[b] = swap;
            }
            i = end > i ? end : i;
        }
    return true;
}

static enum font_status paragraph_reserve(struct paragraph *p, size_t count)
{
    count++;
    p->letters = calloc(count, sizeof *p->letters);
    p->characters = calloc(count, sizeof *p->characters);
    p->types = calloc(count, sizeof *p->types);
    p->brackets = calloc(count, sizeof *p->brackets);
    p->levels = calloc(count, sizeof *p->levels);
    p->runs = calloc(count, sizeof *p->runs);
    return p->letters && p->characters && p->types && p->brackets && p->levels && p->runs
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for text");
}

static void paragraph_finish(struct paragraph *p)
{
    free(p->letters);
    free(p->characters);
    free(p->types);
    free(p->brackets);
    free(p->levels);
    free(p->runs);
}

/* ---- shaping ---- */

struct shaping {
    struct font_shaper *shaper;
    const struct font_text_options *options;
    hb_feature_t features[FEATURES_MAX];
    unsigned features_count;
    hb_language_t language;
    double size_px;
};

static enum font_status features_read(struct shaping *g)
{
    const char *at = g->options->features;
    while (at && *at) {
        const char *end = strchr(at, ',');
        int length = end ? (int)(end - at) : (int)strlen(at);
        if (g->features_count == FEATURES_MAX ||
            !hb_feature_from_string(at, length, &g->features[g->features_count++]))
            return font_fail(FONT_BAD_ARGUMENT,
                             "there is no feature '%.*s'; they are like kern=0, -liga, ss01",
                             length > 40 ? 40 : length, at);
        at = end ? end + 1 : NULL;
    }
    return FONT_OK;
}

/* Appends the run's glyphs from *pen on. */
static enum font_status run_shape(struct shaping *g, const struct paragraph *p,
                                  const struct run *run, int line, double y, double *pen,
                                  struct font_layout *out)
{
    struct shaped_face *face = &g->shaper->faces[p->letters[run->begin].face];
    hb_buffer_t *buffer = g->shaper->buffer;
    hb_refresh(face);
    hb_buffer_clear_contents(buffer);
    /* The letters around are context: an Arabic letter joins across a change of face. */
    hb_buffer_add_utf32(buffer, p->characters, p->count, (unsigned)run->begin,
                        run->end - run->begin);
    hb_buffer_set_direction(buffer, run->level & 1 ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    hb_buffer_set_script(buffer, p->letters[run->begin].script);
    hb_buffer_set_language(buffer, g->language);
    hb_shape(face->hb, buffer, g->features_count ? g->features : NULL, g->features_count);
    if (!hb_buffer_allocation_successful(buffer))
        return font_fail(FONT_NO_MEMORY, "no memory for text");
    unsigned count;
    hb_glyph_info_t *infos = hb_buffer_get_glyph_infos(buffer, &count);
    hb_glyph_position_t *positions = hb_buffer_get_glyph_positions(buffer, &count);
    double scale = g->size_px / face->units_per_em;
    if (count > 8 * (unsigned)CHARACTERS_MAX ||
        !font_array_reserve((void **)&out->glyphs, &out->glyphs_capacity,
                            out->glyphs_count + (int)count, sizeof *out->glyphs))
        return font_fail(FONT_NO_MEMORY, "no memory for text");
    for (unsigned i = 0; i < count; i++) {
        const struct letter *letter = &p->letters[infos[i].cluster];
        out->glyphs[out->glyphs_count++] =
            (struct font_placed){.face = face->face,
                                 .glyph = infos[i].codepoint,
                                 .x_px = *pen + positions[i].x_offset * scale,
                                 .y_px = y - positions[i].y_offset * scale,
                                 .cluster = letter->byte,
                                 .line = line};
        *pen += positions[i].x_advance * scale;
        /* Between letters, not between the marks of one. */
        if (i + 1 == count || infos[i + 1].cluster != infos[i].cluster)
            *pen += g->options->letter_spacing_px;
    }
    return FONT_OK;
}

static enum font_status line_layout(struct shaping *g, struct paragraph *p, int line, double y,
                                    struct font_layout *out)
{
    double pen = 0;
    faces_choose(g->shaper, p, !g->options->no_fallback, out);
    scripts_choose(p);
    if (!runs_find(p, g->options->right_to_left))
        return font_fail(FONT_NO_MEMORY, "no memory for text");
    int first = out->glyphs_count;
    enum font_status status = FONT_OK;
    for (int i = 0; i < p->runs_count && status == FONT_OK; i++)
        status = run_shape(g, p, &p->runs[i], line, y, &pen, out);
    if (p->to_left) /* a paragraph to the left ends at the right; aligned when all lines are known */
        for (int i = first; i < out->glyphs_count; i++)
            out->glyphs[i].x_px -= pen;
    out->width_px = fmax(out->width_px, pen);
    return status;
}

void font_layout_finish(struct font_layout *layout)
{
    free(layout->glyphs);
    *layout = (struct font_layout){0};
}

enum font_status font_shaper_layout(struct font_shaper *s, const char *text, size_t bytes,
                                    double size_px, const struct font_text_options *options,
                                    struct font_layout *out)
{
    static const struct font_text_options usual;
    struct shaping g = {.shaper = s, .options = options ? options : &usual, .size_px = size_px};
    struct paragraph p = {0};
    struct font_face_info info;
    *out = (struct font_layout){.size_px = size_px};
    if (!(size_px >= 0.1 && size_px <= FONT_SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT, "a size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, size_px);
    if (bytes > CHARACTERS_MAX)
        return font_fail(FONT_TOO_LARGE, "text is at most %d bytes (got %zu)", CHARACTERS_MAX,
                         bytes);
    if (!isfinite(g.options->letter_spacing_px) || !isfinite(g.options->line_height))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a distance between letters or lines must be finite");
    enum font_status status = features_read(&g);
    if (status == FONT_OK)
        status = paragraph_reserve(&p, bytes);
    g.language = g.options->language ? hb_language_from_string(g.options->language, -1)
                                     : hb_language_get_default();
    font_face_describe(s->faces[0].face, &info);
    double scale = size_px / info.units_per_em;
    out->ascent_px = info.ascender * scale;
    out->descent_px = -info.descender * scale;
    out->line_height_px = g.options->line_height > 0 ? g.options->line_height * size_px
                                                     : info.line_height * scale;
    bool *to_left = NULL;
    int lines_capacity = 0;
    const char *at = text, *end = text + bytes;
    while (status == FONT_OK) {
        p.count = 0;
        bool ended = true;
        while (at < end) {
            struct letter *l = &p.letters[p.count];
            *l = (struct letter){.byte = (int)(at - text)};
            if (!font_utf8_next(&at, end, &l->character))
                out->damaged_count++;
            if (l->character == '\n') {
                ended = false;
                break;
            }
            if (l->character == '\t')
                l->character = ' ';
            p.count += l->character != '\r';
        }
        if (!font_array_reserve((void **)&to_left, &lines_capacity, out->lines_count + 1,
                                sizeof *to_left)) {
            status = font_fail(FONT_NO_MEMORY, "no memory for text");
            break;
        }
        p.to_left = g.options->right_to_left > 0;
        if (p.count)
            status = line_layout(&g, &p, out->lines_count,
                                 out->lines_count * out->line_height_px, out);
        to_left[out->lines_count++] = p.to_left;
        if (ended)
            break;
    }
    for (int i = 0; status == FONT_OK && i < out->glyphs_count; i++)
        if (to_left[out->glyphs[i].line])
            out->glyphs[i].x_px += out->width_px;
    free(to_left);
    paragraph_finish(&p);
    if (status != FONT_OK)
        font_layout_finish(out);
    return status;
}
