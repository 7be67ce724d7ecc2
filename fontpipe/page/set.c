/* set.c - a paragraph's text as letters and glyphs: see page_internal.h.
 *
 * All of the paragraph is shaped once, run by run. Lines are later cut out of that where
 * HarfBuzz says that glyphs on both sides of the cut are as they would be apart; else the
 * line's part of the run is shaped by itself. */
#include "page_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <linebreak.h>

void set_forget(struct paragraph *p)
{
    free(p->letters);
    free(p->characters);
    free(p->glyphs);
    free(p->runs);
    p->letters = NULL;
    p->characters = NULL;
    p->glyphs = NULL;
    p->runs = NULL;
    p->glyphs_count = p->glyphs_capacity = p->runs_count = p->runs_capacity = p->count = 0;
    p->letters_capacity = 0;
    lines_forget(p);
    p->analysed = p->hyphenated = p->broken = p->edited = p->counted = false;
}

/* Signs that are no letters of any run: tabs, and line ends within the paragraph. */
static bool is_control(uint32_t c)
{
    return c == '\t' || c == '\r' || font_text_ends_line(c);
}

/* What an inset's letters count as: a sign of no script that lines are not broken beside. */
static const uint32_t inset_sign = '=';

struct letter set_letter(const struct page_text *t, const struct paragraph *p, const char **at,
                         int *span)
{
    struct letter l = {.byte = (int32_t)(*at - p->text)};
    while (*span + 1 < p->spans_count && p->spans[*span + 1].begin <= l.byte)
        ++*span;
    l.style = (int16_t)p->spans[*span].style;
    font_utf8_next(at, p->text + p->bytes, &l.character);
    if (t->styles[l.style]->is_inset)
        l.character = inset_sign;
    return l;
}

static void letters_read(const struct page_text *t, struct paragraph *p)
{
    const char *at = p->text, *end = p->text + p->bytes;
    int span = 0;
    for (p->count = 0; at < end; p->count++) {
        p->letters[p->count] = set_letter(t, p, &at, &span);
        p->characters[p->count] = p->letters[p->count].character;
    }
}

/* The length of a picture of several characters, all of one style, that begins at letter i; 0:
 * there is none. */
static int picture_of(const struct paragraph *p, int i)
{
    int n = font_text_picture(p->characters + i, p->count - i);
    for (int k = 1; k < n; k++)
        if (p->letters[i + k].style != p->letters[i].style)
            return 0;
    return n;
}

void set_faces(struct page_text *t, struct paragraph *p, int begin, int end)
{
    for (int i = begin; i < end; i++) {
        struct letter *l = &p->letters[i];
        struct font_shaper *s = t->styles[l->style]->shaper;
        int before = i && p->letters[i - 1].style == l->style ? p->letters[i - 1].face : 0;
        int picture = picture_of(p, i);
        int whole = picture ? font_shaper_face_for_picture(s, p->characters + i, picture) : -1;
        if (whole >= 0) {
            for (int k = 0; k < picture; k++)
                l[k].face = (int16_t)whole;
            i += picture - 1;
            continue;
        }
        l->face = (int16_t)before;
        if (is_control(l->character) || font_text_invisible(l->character))
            continue;
        if (font_text_mark(l->character) &&
            font_face_glyph(s->faces[before].face, l->character))
            continue;
        int face = font_face_glyph(s->faces[0].face, l->character)
                       ? 0
                       : font_shaper_face_for(s, l->character);
        l->face = (int16_t)(face < 0 ? 0 : face);
    }
}

/* Scripts that have no spaces between words, or between all letters a place to break: a line is
 * filled there, too. */
static bool breathes(hb_script_t script)
{
    return upright_script(script) || script == HB_SCRIPT_THAI || script == HB_SCRIPT_LAO ||
           script == HB_SCRIPT_KHMER || script == HB_SCRIPT_MYANMAR;
}

static bool scripts_find(struct page_text *t, struct paragraph *p)
{
    hb_script_t *scripts = calloc((size_t)p->count + 1, sizeof *scripts);
    int8_t *levels = calloc((size_t)p->count + 1, sizeof *levels);
    char *breaks = calloc((size_t)p->count + 1, 1);
    bool good = scripts && levels && breaks;
    if (good) {
        font_scripts_choose(p->characters, p->count, scripts);
        good = font_levels_find(p->characters, p->count, p->manner.right_to_left, levels,
                                &p->base);
        const char *language = t->styles[p->style]->language;
        good = good && font_breaks_find(p->characters, p->count, language, breaks);
        for (int i = 0; i < p->count; i++) {
            struct letter *l = &p->letters[i];
            l->script = scripts[i];
            l->level = levels[i];
            l->brk = (uint8_t)breaks[i];
        }
    }
    if (good)
        carets_find(t, p, 0, p->count);
    if (good && p->vertical)
        upright_find(t, p);
    free(scripts);
    free(levels);
    free(breaks);
    return good;
}

/* Whether letter i goes with the one before it. */
static bool run_goes_on(const struct paragraph *p, int i)
{
    const struct letter *l = &p->letters[i], *b = i ? l - 1 : NULL;
    return b && b->style == l->style && b->face == l->face && b->script == l->script &&
           b->level == l->level && b->stands == l->stands && b->across == l->across &&
           !is_control(l->character) && !is_control(b->character);
}

bool set_runs_cut(const struct paragraph *p, int begin, int end, struct set_run **runs,
                  int *count, int *capacity)
{
    for (int i = begin; i < end; i++) {
        const struct letter *l = &p->letters[i];
        if (run_goes_on(p, i)) {
            (*runs)[*count - 1].end = i + 1;
            continue;
        }
        if (!array_reserve(runs, capacity, *count + 1, sizeof **runs))
            return false;
        (*runs)[(*count)++] = (struct set_run){.begin = i,
                                               .end = i + 1,
                                               .style = l->style,
                                               .face = l->face,
                                               .level = l->level,
                                               .upright = l->stands,
                                               .across = l->across};
    }
    return true;
}

/* Half of what the style's letters are more above the baseline than below: its middle is so far
 * above. */
static double middle(const struct style *s)
{
    return (s->ascent_px - s->descent_px) / 2;
}

/* The one glyph that stands for an inset, as wide as it is. */
static enum font_status inset_shape(const struct style *style, int begin, struct shaped **out,
                                    int *count, int *capacity)
{
    if (!array_reserve(out, capacity, *count + 1, sizeof **out))
        return font_fail(FONT_NO_MEMORY, "no memory for a paragraph");
    (*out)[(*count)++] =
        (struct shaped){.letter = begin, .advance_px = (float)style->shown.width_px};
    return FONT_OK;
}

enum font_status set_shape(struct page_text *t, const struct paragraph *p,
                           const struct set_run *run, int begin, int end, struct shaped **out,
                           int *count, int *capacity)
{
    struct style *style = t->styles[run->style];
    struct font_shaped_face *face = &style->shaper->faces[run->face];
    hb_buffer_t *buffer = t->buffer;
    if (is_control(p->characters[begin]))
        return FONT_OK;
    if (style->is_inset)
        return inset_shape(style, begin, out, count, capacity);
    font_shaped_refresh(face);
    hb_buffer_clear_contents(buffer);
    hb_buffer_add_utf32(buffer, p->characters, p->count, (unsigned)begin, end - begin);
    bool down = run->upright && !run->across;
    hb_buffer_set_direction(buffer, down             ? HB_DIRECTION_TTB
                                    : run->level & 1 ? HB_DIRECTION_RTL
                                                     : HB_DIRECTION_LTR);
    hb_buffer_set_script(buffer, p->letters[begin].script);
    hb_buffer_set_language(buffer, style->hb_language);
    bool apart = style->look.spacing_px != 0 && !font_text_joins(p->letters[begin].script);
    hb_feature_t features[sizeof style->hb_features / sizeof *style->hb_features + FONT_APART];
    unsigned features_count = style->features_count;
    memcpy(features, style->hb_features, sizeof style->hb_features);
    if (apart)
        font_features_apart(features, &features_count);
    hb_shape(face->hb, buffer, features, features_count);
    unsigned n;
    hb_glyph_info_t *infos = hb_buffer_get_glyph_infos(buffer, &n);
    hb_glyph_position_t *at = hb_buffer_get_glyph_positions(buffer, &n);
    if (!hb_buffer_allocation_successful(buffer) || n > 8u * LETTERS_MAX ||
        !array_reserve(out, capacity, *count + (int)n, sizeof **out))
        return font_fail(FONT_NO_MEMORY, "no memory for a paragraph");
    double scale = style->look.size_px / face->units_per_em;
    double centre = middle(t->styles[p->style]);
    double shift = style->look.raise_px + (p->vertical ? centre - middle(style) : 0);
    for (unsigned i = 0; i < n; i++) {
        struct shaped *g = &(*out)[*count + (int)i];
        bool last = i + 1 == n || infos[i + 1].cluster != infos[i].cluster;
        double spacing = last && apart ? style->look.spacing_px : 0;
        *g = (struct shaped){.glyph = infos[i].codepoint, .letter = (int32_t)infos[i].cluster};
        if (down) {
            g->advance_px = (float)(-at[i].y_advance * scale + spacing);
            g->x_px = (float)(-at[i].y_offset * scale);
            g->y_px = (float)(at[i].x_offset * scale + centre + style->look.raise_px);
        } else {
            g->advance_px = (float)(at[i].x_advance * scale + spacing);
            g->x_px = (float)(at[i].x_offset * scale);
            g->y_px = (float)(at[i].y_offset * scale + shift);
        }
    }
    if (run->across)
        upright_across(*out + *count, (int)n, face->hb, scale, style->look.size_px,
                       centre + style->look.raise_px);
    /* Where glyphs may be taken apart: told of a cluster's first, in the order of the text. */
    if (begin == run->begin && end == run->end)
        for (unsigned i = 0; i < n; i++)
            p->letters[infos[i].cluster].safe =
                !run->across &&
                !(hb_glyph_info_get_glyph_flags(&infos[i]) & HB_GLYPH_FLAG_UNSAFE_TO_BREAK);
    *count += (int)n;
    return FONT_OK;
}

void set_spaces(const struct page_text *t, struct paragraph *p, int begin, int end)
{
    for (int i = begin; i < end; i++) {
        struct letter *l = &p->letters[i];
        uint32_t c = l->character;
        l->stretch_px = l->shrink_px = 0;
        if (c == ' ' || c == 0xa0) {
            l->stretch_px = l->advance_px / 2;
            l->shrink_px = l->advance_px / 3;
        } else if (l->brk == LINEBREAK_ALLOWBREAK && breathes(l->script)) {
            l->stretch_px = (float)(0.08 * t->styles[l->style]->look.size_px);
        }
    }
}

/* Along a run letters only grow, or only shrink: halves find the first glyph that is not on
 * the side of its beginning. */
static int glyph_from(const struct shaped *glyphs, int low, int high, int letter, bool falls)
{
    while (low < high) {
        int half = low + (high - low) / 2;
        if ((glyphs[half].letter < letter) != falls)
            low = half + 1;
        else
            high = half;
    }
    return low;
}

void set_glyphs_of(const struct shaped *glyphs, int from, int to, int begin, int end,
                   int *glyphs_begin, int *glyphs_end)
{
    bool falls = to > from && glyphs[from].letter > glyphs[to - 1].letter;
    *glyphs_begin = glyph_from(glyphs, from, to, falls ? end : begin, falls);
    *glyphs_end = glyph_from(glyphs, *glyphs_begin, to, falls ? begin : end, falls);
}

void set_clusters(struct paragraph *p, const struct shaped *glyphs, int count)
{
    for (int g = 0; g < count; g++) {
        struct letter *l = &p->letters[glyphs[g].letter];
        l->cluster = true;
        l->advance_px += glyphs[g].advance_px;
    }
}

static enum font_status runs_shape(struct page_text *t, struct paragraph *p)
{
    for (int r = 0; r < p->runs_count; r++) {
        struct set_run *run = &p->runs[r];
        run->glyphs_begin = p->glyphs_count;
        enum font_status status = font_patience_ask(r);
        if (status == FONT_OK)
            status = set_shape(t, p, run, run->begin, run->end, &p->glyphs, &p->glyphs_count,
                               &p->glyphs_capacity);
        if (status != FONT_OK)
            return status;
        run->glyphs_end = p->glyphs_count;
        p->letters[run->begin].cluster = p->letters[run->begin].safe = true;
        set_clusters(p, p->glyphs + run->glyphs_begin, run->glyphs_end - run->glyphs_begin);
    }
    return FONT_OK;
}

/* From line to line: what the paragraph asks for, letters' middles being in the middle of it;
 * else what its font's own leading is, or as much more as letters of other faces need above and
 * below the baseline. */
void set_leading(const struct page_text *t, struct paragraph *p)
{
    const struct style *first = t->styles[p->style];
    double asked = p->manner.leading_px, leading = asked > 0 ? asked : first->leading_px;
    double rise = leading / 2 + middle(first), above = rise, below = leading - rise;
    const struct set_run *last = NULL;
    for (int i = 0; i < p->runs_count && asked <= 0; i++) {
        const struct set_run *run = &p->runs[i];
        if (!run->face || (last && last->face == run->face && last->style == run->style))
            continue;
        const struct style *style = t->styles[run->style];
        struct font_room room =
            font_room_of(style->shaper->faces[run->face].face, style->look.size_px);
        last = run;
        above = fmax(above, room.above_px);
        below = fmax(below, room.below_px);
    }
    for (int i = 0; i < p->runs_count; i++) {
        const struct style *style = t->styles[p->runs[i].style];
        if (!style->is_inset)
            continue;
        above = fmax(above, style->shown.ascent_px);
        below = fmax(below, style->shown.descent_px);
    }
    p->leading_px = leading + (above - rise) + (below - (leading - rise));
    p->rise_px = p->vertical ? p->leading_px / 2 + middle(first) : above;
}

enum font_status set_all(struct page_text *t, struct paragraph *p)
{
    set_forget(p);
    int room = p->bytes + 1;
    p->letters = calloc((size_t)room, sizeof *p->letters);
    p->characters = calloc((size_t)room, sizeof *p->characters);
    if (!p->letters || !p->characters)
        return font_fail(FONT_NO_MEMORY, "no memory for a paragraph");
    p->letters_capacity = room;
    letters_read(t, p);
    p->base = p->manner.right_to_left > 0;
    enum font_status status = FONT_OK;
    set_faces(t, p, 0, p->count);
    if (p->count && (!scripts_find(t, p) || !set_runs_cut(p, 0, p->count, &p->runs,
                                                          &p->runs_count, &p->runs_capacity)))
        status = font_fail(FONT_NO_MEMORY, "no memory for a paragraph");
    set_leading(t, p);
    if (status == FONT_OK)
        status = runs_shape(t, p);
    if (status == FONT_OK) {
        words_thai(p);
        set_spaces(t, p, 0, p->count);
    }
    return status;
}
