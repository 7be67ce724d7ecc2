/* letters.c - a text's letters and their boxes: see word.h. */
#include "word_internal.h"

#include <array.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LAYOUT_PX = 100 }; /* the size of the layout; positions are not rounded to pixels */
#define SIDE_LEAST 0.06   /* of a box, of an em */
#define MARGIN_MOST 0.25  /* as a part of the advance, on each side */

/* The capital M: its height, and the white space at its sides, in ems. */
struct capital {
    double y0, y1, margin;
};

static struct capital capital_of(struct font_face *face)
{
    struct capital m = {0, 0.7, 0.08}; /* a font without one */
    struct font_outline outline;
    uint32_t glyph = font_face_glyph(face, 'M');
    if (!glyph || font_face_outline(face, glyph, &outline) != FONT_OK)
        return m;
    double em = outline.units_per_em;
    if (outline.segments_count && em > 0)
        m = (struct capital){outline.box.y0 / em, outline.box.y1 / em,
                             fmax(outline.box.x0 + outline.advance - outline.box.x1, 0) /
                                 (2 * em)};
    font_outline_finish(&outline);
    return m;
}

static void at_least(double *from, double *to, double least)
{
    if (*to - *from >= least)
        return;
    double middle = (*from + *to) / 2;
    *from = middle - least / 2;
    *to = middle + least / 2;
}

static void box_make(struct dyn_letter *letter, const struct font_outline *outline,
                     const struct dyn_word_def *def)
{
    double s = def->size / outline->units_per_em;
    struct capital m = capital_of(letter->face);
    double advance = outline->advance * s;
    if ((int)def->style.box == DYN_BOX_EM && advance > 0) {
        double margin = fmin(m.margin * def->size, MARGIN_MOST * advance);
        letter->x0 = margin;
        letter->x1 = advance - margin;
        letter->y0 = m.y0 * def->size;
        letter->y1 = m.y1 * def->size;
    } else {
        letter->x0 = outline->box.x0 * s;
        letter->x1 = outline->box.x1 * s;
        letter->y0 = outline->box.y0 * s;
        letter->y1 = outline->box.y1 * s;
    }
    at_least(&letter->x0, &letter->x1, SIDE_LEAST * def->size);
    at_least(&letter->y0, &letter->y1, SIDE_LEAST * def->size);
}

/* A glyph without ink, such as a space, is no letter and no mark. */
static enum dyn_status glyph_add(struct dyn_word *word, const struct dyn_word_def *def,
                                 const struct font_placed *placed, bool is_mark,
                                 struct dyn_place *places)
{
    struct font_outline outline;
    if (font_face_outline(placed->face, placed->glyph, &outline) != FONT_OK)
        return dyn_fail(DYN_BAD_ARGUMENT, "%s", font_error());
    if (outline.segments_count) {
        int index = dyn_glyphs(word);
        struct dyn_letter *letter = &word->letters[index];
        *letter = (struct dyn_letter){.face = placed->face,
                                      .glyph = placed->glyph,
                                      .size = def->size,
                                      .link = {-1, -1},
                                      .cluster = placed->cluster,
                                      .line = placed->line};
        box_make(letter, &outline, def);
        double scale = def->size / LAYOUT_PX;
        places[index] = (struct dyn_place){placed->x_px * scale, -placed->y_px * scale};
        word->letters_count += !is_mark;
        word->marks_count += is_mark;
    }
    font_outline_finish(&outline);
    return DYN_OK;
}

/* ---- marks ---- */

static struct dyn_place middle_of(const struct dyn_word *word, const struct dyn_place *places,
                                  int i)
{
    const struct dyn_letter *l = &word->letters[i];
    return (struct dyn_place){places[i].x + (l->x0 + l->x1) / 2,
                              places[i].y + (l->y0 + l->y1) / 2};
}

/* The letter of the mark's cluster; or the nearest, for an accent may be of another face than
 * its letter. */
static int letter_below(const struct dyn_word *word, const struct dyn_place *places, int mark)
{
    struct dyn_place at = middle_of(word, places, mark);
    double least = INFINITY;
    int nearest = 0;
    for (int i = 0; i < word->letters_count; i++) {
        if (word->letters[i].cluster == word->letters[mark].cluster)
            return i;
        struct dyn_place middle = middle_of(word, places, i);
        double far = hypot(middle.x - at.x, middle.y - at.y);
        if (far < least) {
            least = far;
            nearest = i;
        }
    }
    return nearest;
}

/* A mark's box is its letter's, seen from the mark's origin. */
static void mark_put(struct dyn_word *word, const struct dyn_place *places, int mark)
{
    int letter = letter_below(word, places, mark);
    struct dyn_letter *m = &word->letters[mark];
    const struct dyn_letter *l = &word->letters[letter];
    double dx = places[letter].x - places[mark].x, dy = places[letter].y - places[mark].y;
    m->x0 = l->x0 + dx;
    m->x1 = l->x1 + dx;
    m->y0 = l->y0 + dy;
    m->y1 = l->y1 + dy;
    m->mass[0] = letter;
}

void dyn_marks_stand(struct dyn_word *word)
{
    for (int i = word->letters_count; i < dyn_glyphs(word); i++) {
        const struct dyn_letter *letter = &word->letters[word->letters[i].mass[0]];
        memcpy(word->letters[i].mass, letter->mass, sizeof letter->mass);
    }
}

/* Letters, then marks. Where there are only marks they are letters. */
static enum dyn_status glyphs_add(struct dyn_word *word, const struct dyn_word_def *def,
                                  const struct font_layout *layout, struct dyn_place *places)
{
    enum dyn_status status = DYN_OK;
    for (int marks = 0; marks < 2; marks++) {
        bool stand = marks && word->letters_count;
        for (int i = 0; status == DYN_OK && i < layout->glyphs_count; i++)
            if (layout->glyphs[i].is_mark == marks)
                status = glyph_add(word, def, &layout->glyphs[i], stand, places);
    }
    for (int i = word->letters_count; status == DYN_OK && i < dyn_glyphs(word); i++)
        mark_put(word, places, i);
    return status;
}

static enum dyn_status look(const struct dyn_word_def *def)
{
    if (!def->text || !def->shaper)
        return dyn_fail(DYN_BAD_ARGUMENT, "a word has a text and a shaper");
    if (!(def->size >= 0.01 && def->size <= 1000))
        return dyn_fail(DYN_BAD_ARGUMENT, "a word's size must be 0.01..1000 units (got %g)",
                        def->size);
    if (!(fabs(def->x) <= 1e5 && fabs(def->y) <= 1e5))
        return dyn_fail(DYN_BAD_ARGUMENT, "a word cannot be at (%g, %g)", def->x, def->y);
    if (!(def->width >= 0 && def->width <= 1e5))
        return dyn_fail(DYN_BAD_ARGUMENT, "a column must be 0..1e5 units wide (got %g)",
                        def->width);
    return dyn_controls_check(dyn_word_controls, dyn_word_controls_count, &def->style);
}

enum dyn_status dyn_letters_make(struct dyn_word *word, const struct dyn_word_def *def,
                                 struct dyn_place **places)
{
    enum dyn_status status = look(def);
    struct font_layout layout = {0};
    *places = NULL;
    if (status != DYN_OK)
        return status;
    struct font_text_options options = {.features = def->features,
                                        .width_px = def->width / def->size * LAYOUT_PX,
                                        .align = def->align};
    if (font_shaper_layout(def->shaper, def->text, strlen(def->text), LAYOUT_PX, &options,
                           &layout) != FONT_OK)
        return dyn_fail(DYN_BAD_ARGUMENT, "%s", font_error());
    *places = malloc(((size_t)layout.glyphs_count + 1) * sizeof **places);
    if (!*places || !array_reserve(&word->letters, &word->letters_capacity,
                                   layout.glyphs_count + 1, sizeof *word->letters))
        status = dyn_fail(DYN_NO_MEMORY, "no memory for %d letters", layout.glyphs_count);
    if (status == DYN_OK)
        status = glyphs_add(word, def, &layout, *places);
    if (status == DYN_OK && !word->letters_count)
        status = dyn_fail(DYN_BAD_ARGUMENT, "nothing of '%.40s' has ink", def->text);
    font_layout_finish(&layout);
    return status;
}
