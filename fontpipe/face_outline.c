/* face_outline.c - outlines out of font files, in doubles: see face.h.
 *
 * FreeType gives the points of an outline in whole units: those of a variable font are rounded,
 * and FT_Outline_Decompose() rounds each point that lies between two others, and is not written
 * in the file, down to a whole unit. At 400 pixels that is a third of a byte's range.
 * HarfBuzz's numbers are not rounded, so it reads TrueType's outlines and CFF's; FreeType reads
 * the others, and its points are taken apart here. */
#include "face_internal.h"

#include <hb-ot.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include FT_FONT_FORMATS_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H

/* ---- HarfBuzz ---- */

/* A font in the font's units, with the axes as they are set. */
static hb_font_t *font_here(struct font_face *face)
{
    if (!face->hb_font) {
        hb_face_t *hb = font_face_harfbuzz(face);
        face->hb_font = hb_font_create(hb);
        hb_ot_font_set_funcs(face->hb_font);
        hb_font_set_scale(face->hb_font, face->ft->units_per_EM, face->ft->units_per_EM);
    }
    if (face->hb_version != face->version) {
        font_face_harfbuzz_variations(face, face->hb_font);
        face->hb_version = face->version;
    }
    return face->hb_font;
}

struct take {
    struct font_outline *outline;
    enum font_status status;
};

static void draw_move(hb_draw_funcs_t *funcs, void *data, hb_draw_state_t *state, float x,
                      float y, void *user)
{
    struct take *t = data;
    (void)funcs, (void)state, (void)user;
    if (t->status == FONT_OK)
        t->status = font_outline_move(t->outline, (double)x, (double)y);
}

static void draw_line(hb_draw_funcs_t *funcs, void *data, hb_draw_state_t *state, float x,
                      float y, void *user)
{
    struct take *t = data;
    (void)funcs, (void)state, (void)user;
    if (t->status == FONT_OK)
        t->status = font_outline_line(t->outline, (double)x, (double)y);
}

static void draw_quad(hb_draw_funcs_t *funcs, void *data, hb_draw_state_t *state, float cx,
                      float cy, float x, float y, void *user)
{
    struct take *t = data;
    (void)funcs, (void)state, (void)user;
    if (t->status == FONT_OK)
        t->status = font_outline_quad(t->outline, (double)cx, (double)cy, (double)x, (double)y);
}

static void draw_cubic(hb_draw_funcs_t *funcs, void *data, hb_draw_state_t *state, float ax,
                       float ay, float bx, float by, float x, float y, void *user)
{
    struct take *t = data;
    (void)funcs, (void)state, (void)user;
    if (t->status == FONT_OK)
        t->status = font_outline_cubic(t->outline, (double)ax, (double)ay, (double)bx,
                                       (double)by, (double)x, (double)y);
}

static hb_draw_funcs_t *draw_funcs;

static void draw_funcs_make(void)
{
    draw_funcs = hb_draw_funcs_create();
    hb_draw_funcs_set_move_to_func(draw_funcs, draw_move, NULL, NULL);
    hb_draw_funcs_set_line_to_func(draw_funcs, draw_line, NULL, NULL);
    hb_draw_funcs_set_quadratic_to_func(draw_funcs, draw_quad, NULL, NULL);
    hb_draw_funcs_set_cubic_to_func(draw_funcs, draw_cubic, NULL, NULL);
    hb_draw_funcs_make_immutable(draw_funcs);
}

/* Empty where HarfBuzz finds nothing to draw. */
static enum font_status outline_draw(struct font_face *face, uint32_t glyph,
                                     struct font_outline *out)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    struct take take = {out, FONT_OK};
    hb_font_t *font = font_here(face);
    pthread_once(&once, draw_funcs_make);
#if HB_VERSION_ATLEAST(7, 0, 0)
    hb_font_draw_glyph(font, glyph, draw_funcs, &take);
#else
    hb_font_get_glyph_shape(font, glyph, draw_funcs, &take);
#endif
    if (take.status == FONT_OK)
        take.status = font_outline_close(out);
    out->advance = hb_font_get_glyph_h_advance(font, glyph);
    return take.status;
}

/* ---- FreeType ---- */

/* Loads the glyph into FreeType's slot, in the font's units. */
static enum font_status glyph_load(struct font_face *face, uint32_t glyph)
{
    if (glyph >= (uint32_t)face->ft->num_glyphs)
        return font_fail(FONT_NO_GLYPH, "%s has no glyph %u", face->path, (unsigned)glyph);
    FT_Error error = FT_Load_Glyph(face->ft, glyph,
                                   FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP |
                                       FT_LOAD_IGNORE_TRANSFORM);
    if (error)
        return font_face_fail(face, "a glyph cannot be read", error);
    return FONT_OK;
}

static struct font_point point_at(const FT_Outline *o, int i)
{
    return (struct font_point){(double)o->points[i].x, (double)o->points[i].y};
}

static struct font_point middle(struct font_point a, struct font_point b)
{
    return (struct font_point){(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/* A contour: points first..last, of which those that curves lean to are told by their tags. */
static enum font_status contour_take(const FT_Outline *o, int first, int last,
                                     struct font_outline *out)
{
    int count = last - first + 1, from = 0;
    while (from < count && FT_CURVE_TAG(o->tags[first + from]) != FT_CURVE_TAG_ON)
        from++;
    bool none_on = from == count;
    if (none_on && FT_CURVE_TAG(o->tags[first]) == FT_CURVE_TAG_CUBIC)
        return font_fail(FONT_BAD_FILE, "a glyph's outline is damaged");
    struct font_point start =
        none_on ? middle(point_at(o, last), point_at(o, first)) : point_at(o, first + from);
    enum font_status status = font_outline_move(out, start.x, start.y);
    struct font_point held[2];
    int holds = 0; /* points that the next curve leans to */
    if (none_on)
        from = -1;
    for (int k = 1; status == FONT_OK && k <= count + none_on; k++) {
        bool closes = k == count + none_on;
        int i = first + (from + k) % count;
        struct font_point p = closes ? start : point_at(o, i);
        int tag = closes ? FT_CURVE_TAG_ON : FT_CURVE_TAG(o->tags[i]);
        if (tag == FT_CURVE_TAG_CUBIC) {
            if (holds == 2)
                return font_fail(FONT_BAD_FILE, "a glyph's outline is damaged");
            held[holds++] = p;
        } else if (tag == FT_CURVE_TAG_CONIC) {
            if (holds) {
                struct font_point to = middle(held[0], p);
                status = font_outline_quad(out, held[0].x, held[0].y, to.x, to.y);
            }
            held[0] = p;
            holds = 1;
        } else {
            bool cubic = holds == 2;
            if (cubic)
                status = font_outline_cubic(out, held[0].x, held[0].y, held[1].x, held[1].y,
                                            p.x, p.y);
            else if (holds)
                status = font_outline_quad(out, held[0].x, held[0].y, p.x, p.y);
            else if (!closes || p.x != out->last.x || p.y != out->last.y)
                status = font_outline_line(out, p.x, p.y);
            holds = 0;
        }
    }
    return status;
}

static enum font_status outline_take(struct font_face *face, uint32_t glyph,
                                     struct font_outline *out, enum font_fill *rule)
{
    enum font_status status = glyph_load(face, glyph);
    if (status != FONT_OK)
        return status;
    FT_GlyphSlot slot = face->ft->glyph;
    const FT_Outline *o = &slot->outline;
    if (slot->format != FT_GLYPH_FORMAT_OUTLINE)
        return font_fail(FONT_NO_GLYPH, "%s: glyph %u has no outline", face->path,
                         (unsigned)glyph);
    for (int c = 0, first = 0; status == FONT_OK && c < o->n_contours; c++) {
        int last = o->contours[c];
        if (last >= o->n_points)
            status = font_fail(FONT_BAD_FILE, "%s: a glyph's outline is damaged", face->path);
        else if (last >= first)
            status = contour_take(o, first, last, out);
        first = last + 1;
    }
    if (status == FONT_OK)
        status = font_outline_close(out);
    out->advance = (double)slot->advance.x;
    *rule = o->flags & FT_OUTLINE_EVEN_ODD_FILL ? FONT_EVEN_ODD : FONT_NONZERO;
    return status;
}

/* ---- which of them ---- */

static bool has_table(struct font_face *face, hb_tag_t tag)
{
    hb_blob_t *blob = hb_face_reference_table(font_face_harfbuzz(face), tag);
    bool has = hb_blob_get_length(blob) > 0;
    hb_blob_destroy(blob);
    return has;
}

/* CFF's numbers may be of another em than the font's, by a matrix that HarfBuzz does not read:
 * then the boxes of what both read differ. */
static bool boxes_agree(const struct font_outline *a, const struct font_outline *b)
{
    enum { UNITS = 4 };
    struct font_box p = font_outline_box(a), q = font_outline_box(b);
    return fabs(p.x0 - q.x0) <= UNITS && fabs(p.y0 - q.y0) <= UNITS &&
           fabs(p.x1 - q.x1) <= UNITS && fabs(p.y1 - q.y1) <= UNITS;
}

static enum font_reader reader_of(struct font_face *face, uint32_t glyph,
                                  const struct font_outline *drawn)
{
    const char *format = FT_Get_Font_Format(face->ft);
    if (!format || strcmp(format, "CFF") != 0)
        return FONT_READER_HARFBUZZ;
    struct font_outline taken = {0};
    enum font_fill rule;
    bool agree =
        outline_take(face, glyph, &taken, &rule) == FONT_OK && boxes_agree(drawn, &taken);
    font_outline_finish(&taken);
    return agree ? FONT_READER_HARFBUZZ : FONT_READER_FREETYPE;
}

/* raw: for whoever works on it further. */
static enum font_status outline_read(struct font_face *face, uint32_t glyph, bool raw,
                                     struct font_outline *out, enum font_fill *rule)
{
    enum font_status status = FONT_OK;
    const struct font_replaced *instead = font_face_replaced(face, glyph);
    *out = (struct font_outline){0};
    *rule = FONT_NONZERO;
    if (instead)
        return font_outline_copy(raw ? &instead->rough : &instead->outline, out);
    if (face->reader == FONT_READER_UNKNOWN && !has_table(face, HB_TAG('g', 'l', 'y', 'f')) &&
        !has_table(face, HB_TAG('C', 'F', 'F', ' ')) &&
        !has_table(face, HB_TAG('C', 'F', 'F', '2')))
        face->reader = FONT_READER_FREETYPE;
    if (face->reader != FONT_READER_FREETYPE && glyph < (uint32_t)face->ft->num_glyphs) {
        status = outline_draw(face, glyph, out);
        if (status == FONT_OK && out->segments_count && face->reader == FONT_READER_UNKNOWN)
            face->reader = reader_of(face, glyph, out);
        if (status != FONT_OK ||
            (out->segments_count && face->reader == FONT_READER_HARFBUZZ)) {
            out->units_per_em = face->ft->units_per_EM;
            return status;
        }
    }
    /* What has nothing to draw has an advance, is damaged, or is nothing that HarfBuzz
     * reads. */
    font_outline_finish(out);
    status = outline_take(face, glyph, out, rule);
    out->units_per_em = face->ft->units_per_EM;
    return status;
}

enum font_status font_face_outline_raw(struct font_face *face, uint32_t glyph,
                                       struct font_outline *out)
{
    enum font_fill rule;
    enum font_status status = outline_read(face, glyph, true, out, &rule);
    if (status != FONT_OK)
        font_outline_finish(out);
    return status;
}

enum font_status font_face_outline(struct font_face *face, uint32_t glyph,
                                   struct font_outline *out)
{
    enum font_fill rule;
    enum font_status status = outline_read(face, glyph, false, out, &rule);
    if (status == FONT_OK)
        status = font_outline_prepare(out, rule);
    if (status != FONT_OK)
        font_outline_finish(out);
    return status;
}

enum font_status font_face_outline_or_none(struct font_face *face, uint32_t glyph,
                                           bool prepared, struct font_outline *out)
{
    enum font_status status = prepared ? font_face_outline(face, glyph, out)
                                       : font_face_outline_raw(face, glyph, out);
    if (status != FONT_BAD_FILE && status != FONT_TOO_LARGE)
        return status;
    char name[FONT_GLYPH_NAME_BYTES];
    font_left_out_add(face->path, font_face_glyph_name(face, glyph, name));
    *out = (struct font_outline){.units_per_em = face->ft->units_per_EM};
    return prepared ? font_outline_prepare(out, FONT_NONZERO) : FONT_OK;
}

enum font_status font_face_advance(struct font_face *face, uint32_t glyph, double *advance)
{
    const struct font_replaced *instead = font_face_replaced(face, glyph);
    *advance = instead ? instead->outline.advance : 0;
    if (instead)
        return FONT_OK;
    enum font_status status = glyph_load(face, glyph);
    if (status == FONT_OK)
        *advance = (double)face->ft->glyph->advance.x;
    return status;
}

double font_face_stem(struct font_face *face)
{
    static const uint32_t letters[] = {'l', 'I', 'i', 'o'};
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++) {
        struct font_outline outline;
        uint32_t glyph = font_face_glyph(face, letters[i]);
        if (!glyph || font_face_outline_raw(face, glyph, &outline) != FONT_OK)
            continue;
        struct font_box box = font_outline_box(&outline);
        double area = 0, height = box.y1 - box.y0, units = outline.units_per_em;
        for (int k = 0; k < outline.segments_count; k++)
            for (int n = 0; n < outline.segments[k].degree; n++)
                area += 0.5 * (outline.segments[k].p[n].x * outline.segments[k].p[n + 1].y -
                               outline.segments[k].p[n + 1].x * outline.segments[k].p[n].y);
        font_outline_finish(&outline);
        if (height > 0 && units > 0)
            return fabs(area) / height / units;
    }
    return 1.0 / 12;
}
