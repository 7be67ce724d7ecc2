/* text_lines.c - text set in lines: see text.h.
 *
 * A paragraph is what stands between two ends of line in the text. It is cut into runs:
 * characters of one direction (FriBidi's levels), one script and one face. With a width given,
 * its runs are shaped once to learn how far each character moves the pen, and lines take as
 * much as fits up to a place where Unicode's rules allow a break (UAX 14); where there is none,
 * up to a letter. Then each line is shaped by itself, since letters may join or kern otherwise
 * at its ends, its runs are put in the order in which they are seen (from the highest level
 * down to the lowest odd one, what is on that level or above is turned around: rule L2 of the
 * Unicode bidirectional algorithm), and when all lines are known each is moved to its side of
 * the column. */
#include "internal.h"
#include "text_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <linebreak.h>

enum { FEATURES_MAX = 32, CHARACTERS_MAX = 1000000, TRIES = 16, SOFT_HYPHEN = 0xad };

/* ---- characters and runs ---- */

struct letter {
    uint32_t character;
    int byte, face;
    hb_script_t script;
};

struct paragraph {
    struct letter *letters;
    uint32_t *characters;
    hb_script_t *scripts;
    int8_t *levels;
    struct font_run *runs;
    /* of a character, where lines are to be broken: of a cluster, at its first; else 0 */
    double *advances;
    bool *clusters; /* one begins here */
    char *breaks;   /* libunibreak's signs, of the place behind a character */
    int count, runs_count, base;
};

void font_layout_missing_add(struct font_layout *out, uint32_t c)
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
    for (int i = 0; i < p->count; i++)
        p->characters[i] = p->letters[i].character;
    for (int i = 0; i < p->count; i++) {
        struct letter *l = &p->letters[i];
        int before = i ? p->letters[i - 1].face : 0;
        int picture = font_text_picture(p->characters + i, p->count - i), whole = -1;
        if (picture && fallback)
            whole = font_shaper_face_for_picture(s, p->characters + i, picture);
        if (whole >= 0) {
            out->fallback_count += whole > 0 ? picture : 0;
            for (int k = 0; k < picture; k++)
                l[k].face = whole;
            i += picture - 1;
            continue;
        }
        l->face = before;
        if (font_text_invisible(l->character))
            continue;
        bool mark = font_text_mark(l->character);
        if (mark && font_face_glyph(s->faces[before].face, l->character))
            continue; /* with its letter */
        int face = font_face_glyph(s->faces[0].face, l->character) ? 0
                   : fallback ? font_shaper_face_for(s, l->character)
                              : -1;
        if (face < 0)
            font_layout_missing_add(out, l->character);
        else if (face > 0)
            out->fallback_count++;
        l->face = face < 0 ? 0 : face;
    }
}

static void scripts_choose(struct paragraph *p)
{
    font_scripts_choose(p->characters, p->count, p->scripts);
    for (int i = 0; i < p->count; i++)
        p->letters[i].script = p->scripts[i];
}

/* The whole paragraph's levels. */
static bool levels_find(struct paragraph *p, int direction)
{
    return font_levels_find(p->characters, p->count, direction, p->levels, &p->base);
}

/* The runs of begin..end in the order of the text. White space at its end has the paragraph's
 * level (rule L1). */
static void runs_cut(struct paragraph *p, int begin, int end)
{
    int ink_end = end;
    while (ink_end > begin && font_text_white(p->letters[ink_end - 1].character))
        ink_end--;
    p->runs_count = 0;
    for (int i = begin; i < end; i++) {
        int level = i < ink_end ? p->levels[i] : p->base;
        struct font_run *last = p->runs_count ? &p->runs[p->runs_count - 1] : NULL;
        if (last && last->level == level && p->letters[i].face == p->letters[i - 1].face &&
            p->letters[i].script == p->letters[i - 1].script)
            last->end = i + 1;
        else
            p->runs[p->runs_count++] = (struct font_run){i, i + 1, level};
    }
}

static enum font_status paragraph_reserve(struct paragraph *p, size_t count)
{
    count++;
    p->letters = calloc(count, sizeof *p->letters);
    p->characters = calloc(count, sizeof *p->characters);
    p->scripts = calloc(count, sizeof *p->scripts);
    p->levels = calloc(count, sizeof *p->levels);
    p->runs = calloc(count, sizeof *p->runs);
    p->advances = calloc(count, sizeof *p->advances);
    p->clusters = calloc(count, sizeof *p->clusters);
    p->breaks = calloc(count, sizeof *p->breaks);
    return p->letters && p->characters && p->scripts && p->levels && p->runs && p->advances &&
                   p->clusters && p->breaks
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for text");
}

static void paragraph_finish(struct paragraph *p)
{
    free(p->letters);
    free(p->characters);
    free(p->scripts);
    free(p->levels);
    free(p->runs);
    free(p->advances);
    free(p->clusters);
    free(p->breaks);
}

/* ---- shaping ---- */

struct shaping {
    struct font_shaper *shaper;
    const struct font_text_options *options;
    hb_feature_t features[FEATURES_MAX];
    unsigned features_count;
    hb_language_t language;
    double size_px;
    bool trims;     /* white space at the end of a line is left out */
    double more_px; /* what lines so far are farther apart than the first face asks for */
};

bool font_feature_read(const char *text, int length, hb_feature_t *out)
{
    if (!hb_feature_from_string(text, length, out))
        return false;
    for (int byte = 0; byte < 4; byte++) { /* names that are shorter end in spaces */
        const char c = (char)(out->tag >> 8 * byte & 0xff);
        if (!(c >= '0' && c <= '9') && !(c >= 'A' && c <= 'Z') && !(c >= 'a' && c <= 'z') &&
            c != '_' && c != ' ')
            return false;
    }
    return true;
}

static enum font_status features_read(struct shaping *g)
{
    const char *at = g->options->features;
    while (at && *at) {
        const char *end = strchr(at, ',');
        int length = end ? (int)(end - at) : (int)strlen(at);
        if (g->features_count == FEATURES_MAX ||
            !font_feature_read(at, length, &g->features[g->features_count++]))
            return font_fail(FONT_BAD_ARGUMENT,
                             "there is no feature '%.*s'; they are like kern=0, -liga, ss01",
                             length > 40 ? 40 : length, at);
        at = end ? end + 1 : NULL;
    }
    return FONT_OK;
}

/* The distance between the run's letters; scripts whose letters join have none. */
static double spacing_of(const struct shaping *g, const struct paragraph *p,
                         const struct font_run *run)
{
    return font_text_joins(p->letters[run->begin].script) ? 0 : g->options->letter_spacing_px;
}

/* Shapes the run: what the shaper's buffer then holds. */
static enum font_status run_shape(struct shaping *g, const struct paragraph *p,
                                  const struct font_run *run, double *scale)
{
    struct font_shaped_face *face = &g->shaper->faces[p->letters[run->begin].face];
    hb_buffer_t *buffer = g->shaper->buffer;
    hb_feature_t features[FEATURES_MAX + FONT_APART];
    unsigned features_count = g->features_count;
    memcpy(features, g->features, sizeof g->features);
    if (spacing_of(g, p, run) != 0)
        font_features_apart(features, &features_count);
    font_shaped_refresh(face);
    hb_buffer_clear_contents(buffer);
    /* The letters around are context: an Arabic letter joins across a change of face. */
    hb_buffer_add_utf32(buffer, p->characters, p->count, (unsigned)run->begin,
                        run->end - run->begin);
    hb_buffer_set_direction(buffer, run->level & 1 ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    hb_buffer_set_script(buffer, p->letters[run->begin].script);
    hb_buffer_set_language(buffer, g->language);
    hb_shape(face->hb, buffer, features_count ? features : NULL, features_count);
    *scale = g->size_px / face->units_per_em;
    if (!hb_buffer_allocation_successful(buffer) ||
        hb_buffer_get_length(buffer) > 8 * (unsigned)CHARACTERS_MAX)
        return font_fail(FONT_NO_MEMORY, "no memory for text");
    return FONT_OK;
}

/* What a glyph moves the pen by. Space is added between letters, not between the marks of
 * one. */
static double pen_step(const hb_glyph_info_t *infos, const hb_glyph_position_t *positions,
                       unsigned i, unsigned count, double scale, double spacing)
{
    bool last = i + 1 == count || infos[i + 1].cluster != infos[i].cluster;
    return positions[i].x_advance * scale + (last ? spacing : 0);
}

/* Appends the run's glyphs from *pen on. */
static enum font_status run_set(struct shaping *g, const struct paragraph *p,
                                const struct font_run *run, int line, double y, double *pen,
                                struct font_layout *out)
{
    double scale;
    enum font_status status = run_shape(g, p, run, &scale);
    if (status != FONT_OK)
        return status;
    unsigned count;
    hb_glyph_info_t *infos = hb_buffer_get_glyph_infos(g->shaper->buffer, &count);
    hb_glyph_position_t *positions = hb_buffer_get_glyph_positions(g->shaper->buffer, &count);
    if (!array_reserve(&out->glyphs, &out->glyphs_capacity, out->glyphs_count + (int)count,
                       sizeof *out->glyphs))
        return font_fail(FONT_NO_MEMORY, "no memory for text");
    for (unsigned i = 0; i < count; i++) {
        out->glyphs[out->glyphs_count++] =
            (struct font_placed){.face = g->shaper->faces[p->letters[run->begin].face].face,
                                 .glyph = infos[i].codepoint,
                                 .x_px = *pen + positions[i].x_offset * scale,
                                 .y_px = y - positions[i].y_offset * scale,
                                 .cluster = p->letters[infos[i].cluster].byte,
                                 .line = line,
                                 .is_mark = positions[i].x_advance == 0};
        *pen += pen_step(infos, positions, i, count, scale, spacing_of(g, p, run));
    }
    return FONT_OK;
}

/* ---- lines ---- */

/* How far each character moves the pen if nothing is broken. */
static enum font_status advances_find(struct shaping *g, struct paragraph *p)
{
    memset(p->advances, 0, (size_t)p->count * sizeof *p->advances);
    memset(p->clusters, 0, (size_t)p->count * sizeof *p->clusters);
    runs_cut(p, 0, p->count);
    for (int r = 0; r < p->runs_count; r++) {
        double scale;
        enum font_status status = run_shape(g, p, &p->runs[r], &scale);
        if (status != FONT_OK)
            return status;
        unsigned count;
        hb_glyph_info_t *infos = hb_buffer_get_glyph_infos(g->shaper->buffer, &count);
        hb_glyph_position_t *positions =
            hb_buffer_get_glyph_positions(g->shaper->buffer, &count);
        for (unsigned i = 0; i < count; i++) {
            p->advances[infos[i].cluster] +=
                pen_step(infos, positions, i, count, scale, spacing_of(g, p, &p->runs[r]));
            p->clusters[infos[i].cluster] = true;
        }
    }
    return font_breaks_find(p->characters, p->count, g->options->language, p->breaks)
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for text");
}

/* The hyphen that is seen where a line ends at a soft one; 0 if the face has none. */
static uint32_t hyphen_for(const struct shaping *g, const struct letter *l, double *advance_px)
{
    const struct font_shaped_face *face = &g->shaper->faces[l->face];
    uint32_t hyphen = font_face_glyph(face->face, 0x2010) ? 0x2010 : '-';
    uint32_t glyph = font_face_glyph(face->face, hyphen);
    double advance = 0;
    if (glyph && font_face_advance(face->face, glyph, &advance) != FONT_OK)
        advance = 0;
    *advance_px = advance * g->size_px / face->units_per_em;
    return glyph ? hyphen : 0;
}

/* Where a line that begins at `begin` ends if no more than width_px fits: at least one letter
 * is in it. *hyphen: at a soft hyphen that is to be seen. */
static int line_break(const struct shaping *g, const struct paragraph *p, int begin,
                      double width_px, bool *hyphen)
{
    *hyphen = false;
    double pen = 0, hyphen_px;
    int allowed = begin, cluster = begin;
    for (int i = begin; i < p->count; i++) {
        uint32_t c = p->letters[i].character;
        if (p->clusters[i] && i > begin)
            cluster = i;
        pen += p->advances[i];
        /* White space may stand in the margin. */
        if (pen > width_px * (1 + 1e-9) && !font_text_white(c)) {
            if (allowed > begin) {
                *hyphen = p->letters[allowed - 1].character == SOFT_HYPHEN;
                return allowed;
            }
            if (cluster > begin)
                return cluster;
        }
        bool within_letter = i + 1 < p->count && !p->clusters[i + 1];
        if (p->breaks[i] != LINEBREAK_ALLOWBREAK || within_letter)
            continue;
        if (c == SOFT_HYPHEN &&
            (!hyphen_for(g, &p->letters[i], &hyphen_px) || pen + hyphen_px > width_px))
            continue;
        allowed = i + 1;
    }
    return p->count;
}

/* Sets begin..end from 0 on. */
static enum font_status line_set(struct shaping *g, struct paragraph *p, int begin, int end,
                                 bool hyphen, double y, struct font_layout *out,
                                 double *width_px)
{
    uint32_t kept = 0;
    double hyphen_px;
    *width_px = 0;
    if (hyphen) {
        kept = p->characters[end - 1];
        uint32_t seen = hyphen_for(g, &p->letters[end - 1], &hyphen_px);
        p->characters[end - 1] = seen ? seen : kept;
    }
    while (g->trims && end > begin && font_text_white(p->letters[end - 1].character))
        end--;
    runs_cut(p, begin, end);
    font_runs_order(p->runs, p->runs_count);
    enum font_status status = FONT_OK;
    for (int i = 0; i < p->runs_count && status == FONT_OK; i++)
        status = run_set(g, p, &p->runs[i], out->lines_count, y, width_px, out);
    if (p->runs_count) /* between letters: not behind the last */
        *width_px -= spacing_of(g, p, &p->runs[p->runs_count - 1]);
    if (hyphen)
        p->characters[end - 1] = kept;
    return status;
}

struct font_room font_room_of(const struct font_face *face, double size_px)
{
    enum { MOST = 4 }; /* ems: damaged files say anything */
    struct font_face_info info;
    font_face_describe(face, &info);
    double em = info.units_per_em, scale = size_px / em;
    double height = fmin(info.line_height, MOST * em);
    double middle = (info.ascender + info.descender) / 2;
    double above = fmin(fmax(height / 2 + middle, 0), MOST * em);
    return (struct font_room){scale * above, scale * fmax(height - above, 0)};
}

/* The line of glyphs from `first` on goes down by what its other faces need above more than the
 * first, and what they need below is kept for the next. */
static void line_room(struct shaping *g, struct font_layout *out, int first, double *below_px)
{
    const struct font_room own = font_room_of(g->shaper->faces[0].face, g->size_px);
    const struct font_face *last = g->shaper->faces[0].face;
    struct font_room most = own;
    *below_px = 0;
    if (g->options->line_height > 0)
        return;
    for (int i = first; i < out->glyphs_count; i++) {
        if (out->glyphs[i].face == last)
            continue;
        last = out->glyphs[i].face;
        struct font_room here = font_room_of(last, g->size_px);
        most.above_px = fmax(most.above_px, here.above_px);
        most.below_px = fmax(most.below_px, here.below_px);
    }
    double more = out->lines_count ? most.above_px - own.above_px : 0;
    for (int i = first; i < out->glyphs_count; i++)
        out->glyphs[i].y_px += more;
    g->more_px += more;
    *below_px = most.below_px - own.below_px;
}

static enum font_status line_add(struct shaping *g, struct font_layout *out, int first,
                                 double width_px, bool to_left, bool last)
{
    double below_px;
    line_room(g, out, first, &below_px);
    if (!array_reserve(&out->lines, &out->lines_capacity, out->lines_count + 1,
                       sizeof *out->lines))
        return font_fail(FONT_NO_MEMORY, "no memory for text");
    out->lines[out->lines_count] =
        (struct font_line){.glyphs_begin = first,
                           .glyphs_count = out->glyphs_count - first,
                           .y_px = out->lines_count * out->line_height_px + g->more_px,
                           .width_px = width_px,
                           .to_left = to_left,
                           .ends_paragraph = last};
    out->height_px = out->lines[out->lines_count++].y_px;
    g->more_px += below_px;
    return FONT_OK;
}

static enum font_status paragraph_set(struct shaping *g, struct paragraph *p,
                                      struct font_layout *out)
{
    double column = g->options->width_px, width = 0;
    p->base = g->options->right_to_left > 0;
    if (!p->count)
        return line_add(g, out, out->glyphs_count, 0, p->base, true);
    faces_choose(g->shaper, p, !g->options->no_fallback, out);
    scripts_choose(p);
    if (!levels_find(p, g->options->right_to_left))
        return font_fail(FONT_NO_MEMORY, "no memory for text");
    enum font_status status = column > 0 ? advances_find(g, p) : FONT_OK;
    for (int begin = 0; begin < p->count && status == FONT_OK;) {
        int first = out->glyphs_count, end = p->count;
        double room = column;
        status = font_patience_ask(0);
        for (int tries = 0; tries < TRIES && status == FONT_OK; tries++) {
            bool hyphen = false;
            end = column > 0 ? line_break(g, p, begin, room, &hyphen) : p->count;
            out->glyphs_count = first;
            status = line_set(g, p, begin, end, hyphen,
                              out->lines_count * out->line_height_px + g->more_px, out, &width);
            /* Set by itself it may be a little wider than within the whole. */
            if (column == 0 || width <= column + 1e-6)
                break;
            room = fmin(room - (width - column), 0.9 * room);
        }
        begin = end;
        while (g->trims && begin > 0 && begin < p->count &&
               font_text_white(p->letters[begin].character))
            begin++;
        if (status == FONT_OK)
            status = line_add(g, out, first, width, p->base, begin >= p->count);
    }
    return status;
}

/* ---- the column ---- */

/* Widens the white spaces within a line until it fills the column; false if there is none. */
static bool line_justify(const struct font_layout *out, const struct font_line *line,
                         const char *text, double more_px)
{
    int spaces = 0;
    for (int pass = 0; pass < 2; pass++) {
        double moved = 0;
        for (int i = 0; i < line->glyphs_count; i++) {
            struct font_placed *g = &out->glyphs[line->glyphs_begin + i];
            const char *at = text + g->cluster;
            bool space = at[0] == ' ' || at[0] == '\t' || (at[0] == '\xc2' && at[1] == '\xa0');
            if (pass)
                g->x_px += moved;
            if (pass && space)
                moved += more_px / spaces;
            spaces += !pass && space;
        }
        if (!spaces)
            return false;
    }
    return true;
}

static void lines_align(struct font_layout *out, const struct font_text_options *options,
                        const char *text)
{
    out->width_px = options->width_px;
    for (int i = 0; i < out->lines_count; i++)
        out->width_px = fmax(out->width_px, out->lines[i].width_px);
    /* A letter that is wider than the column sticks out. */
    double column = options->width_px > 0 ? options->width_px : out->width_px;
    for (int i = 0; i < out->lines_count; i++) {
        struct font_line *line = &out->lines[i];
        double left = column - line->width_px;
        double part = options->align == FONT_ALIGN_LEFT     ? 0
                      : options->align == FONT_ALIGN_RIGHT  ? 1
                      : options->align == FONT_ALIGN_CENTER ? 0.5
                                                            : line->to_left;
        if (options->align == FONT_ALIGN_JUSTIFY && !line->ends_paragraph && left > 0 &&
            line_justify(out, line, text, left)) {
            line->width_px = column;
            continue;
        }
        line->x_px = part * left;
        for (int k = 0; k < line->glyphs_count; k++)
            out->glyphs[line->glyphs_begin + k].x_px += line->x_px;
    }
}

void font_layout_finish(struct font_layout *layout)
{
    free(layout->glyphs);
    free(layout->lines);
    free(layout->inks);
    free(layout->maps);
    *layout = (struct font_layout){0};
}

/* The characters up to the next end of line; false if it was the text's. */
static bool paragraph_read(struct paragraph *p, const char *text, const char **at,
                           const char *end, struct font_layout *out)
{
    p->count = 0;
    while (*at < end) {
        struct letter *l = &p->letters[p->count];
        *l = (struct letter){.byte = (int)(*at - text)};
        if (!font_utf8_next(at, end, &l->character))
            out->damaged_count++;
        if (font_text_ends_line(l->character))
            return true;
        if (l->character == '\t')
            l->character = ' ';
        p->count += l->character != '\r';
    }
    return false;
}

static enum font_status options_check(struct shaping *g, size_t bytes)
{
    const struct font_text_options *o = g->options;
    if (!(g->size_px >= 0.1 && g->size_px <= FONT_SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT, "a size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, g->size_px);
    if (bytes > CHARACTERS_MAX)
        return font_fail(FONT_TOO_LARGE, "text is at most %d bytes (got %zu)", CHARACTERS_MAX,
                         bytes);
    if (!isfinite(o->letter_spacing_px) || !isfinite(o->line_height))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a distance between letters or lines must be finite");
    if (!(o->width_px >= 0 && o->width_px <= 1e9))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a column must be 0 (none) or up to 1e9 pixels wide "
                         "(got %g)",
                         o->width_px);
    return features_read(g);
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
    enum font_status status = options_check(&g, bytes);
    if (status != FONT_OK)
        return status;
    status = paragraph_reserve(&p, bytes);
    g.trims = g.options->width_px > 0 || g.options->align != FONT_ALIGN_START;
    g.language = g.options->language ? hb_language_from_string(g.options->language, -1)
                                     : hb_language_get_default();
    font_face_describe(s->faces[0].face, &info);
    double scale = size_px / info.units_per_em;
    out->ascent_px = info.ascender * scale;
    out->descent_px = -info.descender * scale;
    out->line_height_px = g.options->line_height > 0 ? g.options->line_height * size_px
                                                     : info.line_height * scale;
    const char *at = text, *end = text + bytes;
    for (bool more = true; more && status == FONT_OK;) {
        more = paragraph_read(&p, text, &at, end, out);
        status = font_patience_ask(out->lines_count);
        if (status == FONT_OK)
            status = paragraph_set(&g, &p, out);
    }
    if (status == FONT_OK)
        lines_align(out, g.options, text);
    paragraph_finish(&p);
    if (status != FONT_OK)
        font_layout_finish(out);
    return status;
}
