/* formula_words.c - words in formulas: see formula_internal.h.
 *
 * Fonts for mathematics have few scripts: a formula of a Chinese text says "where" in letters
 * that they have not. Such words are set by a shaper, as any text is, which finds fonts that
 * have them. */
#include "formula_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- by other fonts ---- */

/* The height and depth of what stands there, out of its glyphs' boxes. */
static void extents_take(struct formula_box *box, const struct font_placed *g, double size)
{
    hb_face_t *face = font_face_harfbuzz(g->face);
    hb_font_t *font = face ? hb_font_create(face) : NULL;
    hb_glyph_extents_t e = {0};
    if (!font)
        return;
    const double scale = size / hb_face_get_upem(face);
    font_face_harfbuzz_variations(g->face, font);
    hb_font_get_glyph_extents(font, g->glyph, &e);
    box->height = fmax(box->height, e.y_bearing * scale - g->y_px);
    box->depth = fmax(box->depth, -(e.y_bearing + e.height) * scale + g->y_px);
    hb_font_destroy(font);
}

static struct formula_box layout_box(struct font_math *m, const struct font_layout *l,
                                     double size, int byte, bool is_source)
{
    struct formula_box box = formula_box_empty(m);
    for (int i = 0; i < l->glyphs_count; i++) {
        const struct font_placed *g = &l->glyphs[i];
        const double own = g->size_px > 0 ? (double)g->size_px : size;
        const struct formula_item item = {.face = g->face,
                                          .glyph = g->glyph,
                                          .byte = byte + (is_source ? g->cluster : 0),
                                          .x = g->x_px,
                                          .y = g->y_px,
                                          .size = own};
        formula_item_add(m, &item);
        extents_take(&box, g, own);
    }
    for (int i = 0; i < l->missing_count && i < FONT_MISSING_MAX; i++)
        font_layout_missing_add(m->out, l->missing[i]);
    box.width = l->width_px;
    box.end = m->items_count;
    return box;
}

static struct formula_box foreign_words(struct font_math *m, const char *text, int bytes,
                                        double size, int byte, bool is_source)
{
    struct formula_box box = formula_box_empty(m);
    struct font_layout layout = {0};
    char *line = malloc((size_t)bytes + 1); /* a newline is a blank in TeX */
    if (!line) {
        m->status = font_fail(FONT_NO_MEMORY, "no memory for a formula");
        return box;
    }
    for (int i = 0; i < bytes; i++)
        line[i] = text[i] >= '\0' && text[i] < ' ' ? ' ' : text[i];
    if (m->status == FONT_OK && !m->shaper)
        m->status = font_shaper_create(m->face, &m->shaper);
    if (m->status == FONT_OK)
        m->status = font_shaper_layout(m->shaper, line, (size_t)bytes, size, NULL, &layout);
    if (m->status == FONT_OK)
        box = layout_box(m, &layout, size, byte, is_source);
    font_layout_finish(&layout);
    free(line);
    return box;
}

struct formula_box formula_foreign(struct font_math *m, uint32_t character,
                                   struct formula_style style, int byte)
{
    char text[FONT_UTF8_BYTES];
    const int bytes = font_utf8_put(character, text);
    return foreign_words(m, text, bytes, formula_size(m, style), byte, false);
}

/* ---- by the font's own ---- */

/* Whether the font has all that was shaped. */
static bool shaped_wholly(const hb_glyph_info_t *infos, unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        if (!infos[i].codepoint)
            return false;
    return true;
}

/* Words, of which each glyph's byte is its own, or the first one's. */
static struct formula_box words_set(struct font_math *m, const char *text, int bytes,
                                    double size, int byte, bool is_source)
{
    const double scale = size / m->upem;
    struct formula_box box = formula_box_empty(m);
    unsigned count;
    hb_buffer_clear_contents(m->buffer);
    hb_buffer_add_utf8(m->buffer, text, bytes, 0, bytes);
    hb_buffer_guess_segment_properties(m->buffer);
    hb_shape(m->hb, m->buffer, NULL, 0);
    const hb_glyph_info_t *infos = hb_buffer_get_glyph_infos(m->buffer, &count);
    const hb_glyph_position_t *at = hb_buffer_get_glyph_positions(m->buffer, &count);
    if (!shaped_wholly(infos, count))
        return foreign_words(m, text, bytes, size, byte, is_source);
    for (unsigned i = 0; i < count; i++) {
        struct formula_box one = formula_glyph_box(
            m, infos[i].codepoint, size, byte + (is_source ? (int)infos[i].cluster : 0));
        formula_box_move(m, &one, box.width + at[i].x_offset * scale, -at[i].y_offset * scale);
        box.width += at[i].x_advance * scale;
        box.height = fmax(box.height, one.height);
        box.depth = fmax(box.depth, one.depth);
    }
    box.end = m->items_count;
    return box;
}

/* Words of an alphabet: each letter is one of Unicode's, where the font has it. */
static struct formula_box letters_set(struct font_math *m, const struct formula_node *node,
                                      enum formula_alphabet alphabet, double size)
{
    const char *at = node->text, *const end = at + node->text_bytes;
    char *letters = malloc((size_t)node->text_bytes * FONT_UTF8_BYTES + 1);
    int bytes = 0;
    if (!letters) {
        m->status = font_fail(FONT_NO_MEMORY, "no memory for a formula");
        return formula_box_empty(m);
    }
    while (at < end) {
        uint32_t c;
        font_utf8_next(&at, end, &c);
        const uint32_t own = formula_letter(c, alphabet);
        bytes += font_utf8_put(formula_has(m, own) ? own : c, letters + bytes);
    }
    const struct formula_box box = words_set(m, letters, bytes, size, node->byte, false);
    free(letters);
    return box;
}

struct formula_box formula_words(struct font_math *m, const struct formula_node *node,
                                 struct formula_style style)
{
    const double size = formula_size(m, style);
    if (node->style > 0)
        return letters_set(m, node, (enum formula_alphabet)(node->style - 1), size);
    return words_set(m, node->text, node->text_bytes, size, node->byte, node->is_source);
}
