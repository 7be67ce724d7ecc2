/* formula_glyph.c - boxes of characters: as they are, larger, stretched: see
 * formula_internal.h. */
#include "formula_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VARIANTS_MAX = 32, PARTS_MAX = 16, PIECES_MAX = 4000 };

struct formula_box formula_box_empty(const struct font_math *m)
{
    return (struct formula_box){.begin = m->items_count, .end = m->items_count};
}

void formula_item_add(struct font_math *m, const struct formula_item *item)
{
    if (m->status != FONT_OK)
        return;
    if (m->items_count == FORMULA_ITEMS_MAX)
        m->status = font_fail(FONT_TOO_LARGE, "a formula has more than %d letters and rules",
                              FORMULA_ITEMS_MAX);
    else if (!array_reserve(&m->items, &m->items_capacity, m->items_count + 1,
                            sizeof *m->items))
        m->status = font_fail(FONT_NO_MEMORY, "no memory for a formula");
    else
        m->items[m->items_count++] = *item;
}

void formula_box_move(struct font_math *m, const struct formula_box *box, double x, double y)
{
    if (x == 0 && y == 0)
        return;
    for (int i = box->begin; i < box->end && i < m->items_count; i++) {
        m->items[i].x += x;
        m->items[i].y += y;
    }
}

struct formula_box formula_rule(struct font_math *m, double x, double y, double width,
                                double height, int byte)
{
    struct formula_box box = formula_box_empty(m);
    const struct formula_item item = {
        .byte = byte, .x = x, .y = y, .width = width, .height = height};
    if (width > 0 && height > 0)
        formula_item_add(m, &item);
    box.end = m->items_count;
    return box;
}

/* ---- glyphs ---- */

struct formula_box formula_glyph_box(struct font_math *m, uint32_t glyph, double size, int byte)
{
    hb_glyph_extents_t e = {0};
    const double scale = size / m->upem;
    struct formula_box box = formula_box_empty(m);
    hb_font_get_glyph_extents(m->hb, glyph, &e);
    box.width = hb_font_get_glyph_h_advance(m->hb, glyph) * scale;
    box.height = e.y_bearing * scale;
    box.depth = -(e.y_bearing + e.height) * scale;
    box.italic = hb_ot_math_get_glyph_italics_correction(m->hb, glyph) * scale;
    box.glyph = glyph;
    const struct formula_item item = {
        .face = m->face, .glyph = glyph, .byte = byte, .size = size};
    formula_item_add(m, &item);
    box.end = m->items_count;
    return box;
}

/* Of a glyph's forms for scripts the one for the style's level. */
static uint32_t script_form(const struct font_math *m, uint32_t glyph,
                            struct formula_style style)
{
    for (unsigned i = 0; i < m->scripts_count && style.level >= FORMULA_SCRIPT_STYLE; i++) {
        hb_codepoint_t forms[2];
        unsigned count = 2;
        unsigned all = hb_ot_layout_lookup_get_glyph_alternates(
            hb_font_get_face(m->hb), m->scripts[i], glyph, 0, &count, forms);
        if (all && count)
            return forms[style.level == FORMULA_SCRIPTSCRIPT && count > 1];
    }
    return glyph;
}

bool formula_has(const struct font_math *m, uint32_t character)
{
    hb_codepoint_t glyph;
    return hb_font_get_nominal_glyph(m->hb, character, &glyph) != 0;
}

uint32_t formula_glyph(struct font_math *m, uint32_t character, struct formula_style style)
{
    hb_codepoint_t glyph = 0;
    if (!hb_font_get_nominal_glyph(m->hb, character, &glyph)) {
        font_layout_missing_add(m->out, character);
        return 0;
    }
    return script_form(m, glyph, style);
}

/* ---- larger ones ---- */

struct assembly {
    hb_ot_math_glyph_part_t parts[PARTS_MAX];
    unsigned count;
    double scale, overlap; /* the least, in pixels */
};

static int repeats(const struct assembly *a, unsigned i, int each)
{
    return a->parts[i].flags & HB_OT_MATH_GLYPH_PART_FLAG_EXTENDER ? each : 1;
}

/* How long it is with the least overlap, and with how many pieces. */
static double assembly_length(const struct assembly *a, int each, int *pieces)
{
    double length = 0;
    *pieces = 0;
    for (unsigned i = 0; i < a->count; i++) {
        int n = repeats(a, i, each);
        length += n * a->parts[i].full_advance * a->scale;
        *pieces += n;
    }
    return length - (*pieces > 1 ? *pieces - 1 : 0) * a->overlap;
}

/* How often parts are repeated so that it is at least so long. */
static int assembly_repeats(const struct assembly *a, double want, int *pieces)
{
    double none = assembly_length(a, 0, pieces), once = assembly_length(a, 1, pieces);
    double more = once - none;
    if (!(more > 0) || none >= want)
        return 0;
    double each = ceil((want - none) / more - 1e-9);
    int repeated = 0;
    for (unsigned i = 0; i < a->count; i++)
        repeated += repeats(a, i, 2) - 1;
    return (int)fmin(fmax(each, 1), repeated ? PIECES_MAX / repeated : 1);
}

/* The pieces one after the other; what is too long is taken from where they overlap, as far as
 * the font allows. */
static struct formula_box assembly_make(struct font_math *m, const struct assembly *a,
                                        double want, bool down, double size, int byte)
{
    int pieces;
    int each = assembly_repeats(a, want, &pieces);
    double length = assembly_length(a, each, &pieces);
    double over = pieces > 1 ? fmax(0, length - want) / (pieces - 1) : 0, pen = 0;
    struct formula_box box = formula_box_empty(m);
    const hb_ot_math_glyph_part_t *before = NULL;
    for (unsigned i = 0; i < a->count; i++)
        for (int n = repeats(a, i, each); n > 0; n--) {
            const hb_ot_math_glyph_part_t *p = &a->parts[i];
            if (before) {
                double most =
                    fmin(before->end_connector_length, p->start_connector_length) * a->scale;
                pen -= fmin(a->overlap + over, fmax(most, a->overlap));
            }
            struct formula_box one = formula_glyph_box(m, p->glyph, size, byte);
            formula_box_move(m, &one, down ? 0 : pen, down ? -(pen + one.depth) : 0);
            if (down) {
                box.width = fmax(box.width, one.width);
            } else {
                box.height = fmax(box.height, one.height);
                box.depth = fmax(box.depth, one.depth);
            }
            pen += p->full_advance * a->scale;
            before = p;
        }
    *(down ? &box.height : &box.width) = pen;
    box.end = m->items_count;
    return box;
}

/* In a direction at least so long: the first variant that is, else parts, else the longest
 * variant. most: the last one that is not longer. */
static struct formula_box stretched_make(struct font_math *m, uint32_t character, double want,
                                         bool down, bool most, struct formula_style style,
                                         int byte)
{
    const double size = formula_size(m, style), scale = size / m->upem;
    const hb_direction_t direction = down ? HB_DIRECTION_BTT : HB_DIRECTION_LTR;
    uint32_t glyph = formula_glyph(m, character, style), best = glyph;
    hb_ot_math_glyph_variant_t variants[VARIANTS_MAX];
    unsigned count = VARIANTS_MAX;
    hb_ot_math_get_glyph_variants(m->hb, glyph, direction, 0, &count, variants);
    for (unsigned i = 0; i < count; i++) {
        if (most && i && variants[i].advance * scale > want)
            break;
        best = variants[i].glyph;
        if (!most && variants[i].advance * scale >= want)
            return formula_glyph_box(m, best, size, byte);
    }
    struct assembly a = {.count = PARTS_MAX, .scale = scale};
    hb_position_t italic;
    hb_ot_math_get_glyph_assembly(m->hb, glyph, direction, 0, &a.count, a.parts, &italic);
    if (most || !a.count)
        return formula_glyph_box(m, best, size, byte);
    a.overlap = hb_ot_math_get_min_connector_overlap(m->hb, direction) * scale;
    return assembly_make(m, &a, want, down, size, byte);
}

struct formula_box formula_tall(struct font_math *m, uint32_t character, double height,
                                struct formula_style style, int byte)
{
    return stretched_make(m, character, height, true, false, style, byte);
}

struct formula_box formula_wide(struct font_math *m, uint32_t character, double width,
                                bool most, struct formula_style style, int byte)
{
    return stretched_make(m, character, width, false, most, style, byte);
}

void formula_box_centre(struct font_math *m, struct formula_box *box,
                        struct formula_style style)
{
    double shift = (box->height - box->depth) / 2 - formula_axis(m, style);
    formula_box_move(m, box, 0, shift);
    box->height -= shift;
    box->depth += shift;
}

struct formula_box formula_fence(struct font_math *m, uint32_t character, double height,
                                 double depth, struct formula_style style, int byte)
{
    /* TeX's \delimiterfactor, \delimitershortfall and \nulldelimiterspace at ten points. */
    const double factor = 0.901, shortfall = 0.5, blank = 0.12;
    double axis = formula_axis(m, style), half = fmax(height - axis, depth + axis);
    struct formula_box box = formula_box_empty(m);
    if (!character) {
        box.width = blank * m->size;
        return box;
    }
    box = formula_tall(m, character, fmax(2 * half * factor, 2 * half - shortfall * m->size),
                       style, byte);
    formula_box_centre(m, &box, style);
    box.glyph = 0;
    return box;
}
