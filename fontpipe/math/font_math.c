/* font_math.c - see font_math.h: the font's tables, and boxes as a layout. */
#include "formula_internal.h"

#include "edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const font_math_fonts[] = {"DejaVuMathTeXGyre",
                                       "latinmodern-math",
                                       "LatinModernMath-Regular",
                                       "texgyretermes-math",
                                       "STIXTwoMath-Regular",
                                       "XITSMath-Regular",
                                       NULL};

/* ---- the square that rules are ---- */

enum { SQUARE_EM = 1000, SQUARE_GLYPH = 1 };

static uint8_t *number_put(uint8_t *at, uint32_t value, int bytes)
{
    for (int i = bytes - 1; i >= 0; i--)
        *at++ = (uint8_t)(value >> (8 * i));
    return at;
}

struct square_table {
    const char *tag;
    const uint16_t *words;
    int count;
};

static uint32_t sum_of(const uint8_t *bytes, size_t count)
{
    uint32_t sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += (uint32_t)bytes[i] << (24 - 8 * (i & 3));
    return sum;
}

/* A TrueType font of two glyphs: nothing, and U+006C, a square as large as the em. Its stems
 * are as wide, so that none is made darker. */
static enum font_status square_open(struct font_face **out)
{
    enum { TABLES = 8, HEAD = 12, ROW = 16, ROOM = 1024 };
    static const uint16_t os2[48] = {4, 1000, 400, 5, [31] = 0x40, 0x6c, 0x6c, 1000, 0};
    static const uint16_t cmap[] = {0, 1, 3,    1,      0, 12,   4,      32,     0, 4, 4,
                                    1, 0, 0x6c, 0xffff, 0, 0x6c, 0xffff, 0xff95, 1, 0, 0};
    static const uint16_t glyf[] = {
        1,      0, 0,         SQUARE_EM, SQUARE_EM, 3,         0, 0x0101,
        0x0101, /* four points on the curve */
        0,      0, SQUARE_EM, 0,         0,         SQUARE_EM, 0, (uint16_t)-SQUARE_EM};
    static const uint16_t head[27] = {1,      0, 1,         0,        0, 0,         0x5f0f,
                                      0x3cf5, 0, SQUARE_EM, [18] = 0, 0, SQUARE_EM, SQUARE_EM,
                                      0,      8, 2,         0,        0};
    static const uint16_t hhea[18] = {1, 0, SQUARE_EM, 0, 0, SQUARE_EM, [17] = 2};
    static const uint16_t hmtx[] = {SQUARE_EM, 0, SQUARE_EM, 0};
    static const uint16_t loca[] = {0, 0, sizeof glyf / 2};
    static const uint16_t maxp[16] = {1, 0, 2, 4, 1, 0, 0, 1};
    const struct square_table tables[TABLES] = {{"OS/2", os2, 48},
                                                {"cmap", cmap, sizeof cmap / 2},
                                                {"glyf", glyf, sizeof glyf / 2},
                                                {"head", head, 27},
                                                {"hhea", hhea, 18},
                                                {"hmtx", hmtx, 4},
                                                {"loca", loca, 3},
                                                {"maxp", maxp, 16}};
    uint8_t file[ROOM] = {0};
    uint8_t *row = number_put(file, 0x10000, 4);
    row = number_put(row, TABLES, 2);
    row = number_put(row, 128, 2);
    row = number_put(row, 3, 2);
    row = number_put(row, 0, 2);
    size_t end = HEAD + ROW * TABLES;
    for (int i = 0; i < TABLES; i++) {
        size_t bytes = 2 * (size_t)tables[i].count;
        uint8_t *at = file + end;
        for (int k = 0; k < tables[i].count; k++)
            at = number_put(at, tables[i].words[k], 2);
        memcpy(row, tables[i].tag, 4);
        row = number_put(row + 4, sum_of(file + end, bytes), 4);
        row = number_put(row, (uint32_t)end, 4);
        row = number_put(row, (uint32_t)bytes, 4);
        end += (bytes + 3) & ~(size_t)3;
    }
    return font_face_open_memory(file, end, 0, out);
}

/* ---- the font's tables ---- */

/* The look-ups of the feature that makes letters of scripts of letters. */
static bool script_lookups_find(struct font_math *m, hb_face_t *face)
{
    static const hb_tag_t feature[] = {HB_TAG('s', 's', 't', 'y'), HB_TAG_NONE};
    hb_set_t *set = hb_set_create();
    hb_codepoint_t lookup = HB_SET_VALUE_INVALID;
    hb_ot_layout_collect_lookups(face, HB_OT_TAG_GSUB, NULL, NULL, feature, set);
    m->scripts = calloc((size_t)hb_set_get_population(set) + 1, sizeof *m->scripts);
    while (m->scripts && hb_set_next(set, &lookup))
        m->scripts[m->scripts_count++] = lookup;
    bool good = m->scripts && hb_set_allocation_successful(set);
    hb_set_destroy(set);
    return good;
}

enum font_status font_math_create(struct font_face *face, struct font_math **out)
{
    struct font_face_info info;
    *out = NULL;
    font_face_describe(face, &info);
    hb_face_t *hb_face = font_face_harfbuzz(face);
    if (!hb_face)
        return font_fail(FONT_NO_MEMORY, "no memory for formulas");
    if (!hb_ot_math_has_data(hb_face) || !(info.units_per_em > 0))
        return font_fail(FONT_BAD_ARGUMENT,
                         "%s has no MATH table, which formulas are set by; take a font such as "
                         "%s",
                         info.path, font_math_fonts[0]);
    struct font_math *m = calloc(1, sizeof *m);
    if (!m)
        return font_fail(FONT_NO_MEMORY, "no memory for formulas");
    m->face = face;
    m->upem = info.units_per_em;
    m->hb = hb_font_create(hb_face);
    m->buffer = hb_buffer_create();
    hb_font_set_scale(m->hb, (int)m->upem, (int)m->upem);
    font_face_harfbuzz_variations(face, m->hb);
    enum font_status status = square_open(&m->square);
    if (status == FONT_OK && !script_lookups_find(m, hb_face))
        status = font_fail(FONT_NO_MEMORY, "no memory for formulas");
    if (status != FONT_OK)
        font_math_destroy(m);
    else
        *out = m;
    return status;
}

void font_math_destroy(struct font_math *m)
{
    if (!m)
        return;
    hb_font_destroy(m->hb);
    hb_buffer_destroy(m->buffer);
    font_face_close(m->square);
    font_shaper_destroy(m->shaper);
    formula_nodes_finish(&m->nodes);
    free(m->items);
    free(m->scripts);
    free(m);
}

/* ---- a layout ---- */

static bool item_place(const struct font_math *m, const struct formula_item *item,
                       struct font_layout *out)
{
    struct font_placed *g = &out->glyphs[out->glyphs_count++];
    *g = (struct font_placed){.face = item->face,
                              .glyph = item->glyph,
                              .x_px = item->x,
                              .y_px = item->y,
                              .cluster = item->byte,
                              .size_px = (float)item->size};
    if (item->face)
        return true;
    /* A square of 100 pixels: none so large is made darker, whatever is asked for. */
    const double side = 100;
    const struct font_map map = {FONT_AFFINE,
                                 {item->width / side, 0, 0, 0, item->height / side}};
    g->face = m->square;
    g->glyph = SQUARE_GLYPH;
    g->y_px = item->y + item->height;
    g->size_px = (float)side;
    g->map = font_layout_map_add(out, &map);
    return g->map > 0;
}

static enum font_status layout_make(struct font_math *m, const struct formula_box *box,
                                    struct font_layout *out)
{
    enum { LINES = 1 };
    if (!array_reserve(&out->glyphs, &out->glyphs_capacity, m->items_count + 1,
                       sizeof *out->glyphs) ||
        !array_reserve(&out->lines, &out->lines_capacity, LINES, sizeof *out->lines))
        return font_fail(FONT_NO_MEMORY, "no memory for a formula");
    for (int i = 0; i < m->items_count; i++)
        if (!item_place(m, &m->items[i], out))
            return font_fail(FONT_NO_MEMORY, "no memory for a formula");
    out->lines[0] = (struct font_line){
        .glyphs_count = out->glyphs_count, .width_px = box->width, .ends_paragraph = true};
    out->lines_count = LINES;
    out->width_px = box->width;
    out->ascent_px = box->height;
    out->descent_px = box->depth;
    out->line_height_px = box->height + box->depth;
    return FONT_OK;
}

enum font_status font_math_layout(struct font_math *m, const char *tex, size_t bytes,
                                  const struct font_math_options *options,
                                  struct font_layout *out)
{
    *out = (struct font_layout){.size_px = options->size_px};
    if (!(options->size_px >= 0.1 && options->size_px <= FONT_SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT, "a formula's size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, options->size_px);
    m->items_count = 0;
    m->size = options->size_px;
    m->out = out;
    m->status = formula_read(tex, bytes, &m->nodes, &m->read);
    if (m->status == FONT_OK) {
        const struct formula_style style = {options->display ? FORMULA_DISPLAY : FORMULA_TEXT,
                                            false};
        struct formula_box box = formula_set(m, m->read.first, style);
        out->damaged_count = font_utf8_damaged(tex, bytes);
        if (m->status == FONT_OK)
            m->status = layout_make(m, &box, out);
    }
    formula_nodes_finish(&m->nodes);
    m->out = NULL;
    if (m->status != FONT_OK) {
        font_layout_finish(out);
        *out = (struct font_layout){0};
    }
    return m->status;
}

const char *font_math_unknown(const struct font_math *m, int *count)
{
    *count = m->read.unknown_count;
    return m->read.unknown;
}
