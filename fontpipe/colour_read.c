/* colour_read.c - see colour_read.h. */
#include "colour_read.h"

#include <math.h>
#include <string.h>

enum { HEADER = 34, BASES = 14, LAYERS = 18, CLIPS = 22, BASE = 6, CLIP = 7 };
static const uint32_t NOTHING_VARIES = 0xffffffff;

bool font_colr_good(const struct font_colr *c)
{
    uint64_t bases = font_colr_u(c, BASES, 4), layers = font_colr_u(c, LAYERS, 4);
    return c->count >= HEADER && font_colr_u(c, 0, 2) == 1 && bases >= HEADER &&
           bases + 4 + (uint64_t)font_colr_u(c, bases, 4) * BASE <= c->count &&
           (!layers || layers + 4 + 4 * (uint64_t)font_colr_u(c, layers, 4) <= c->count);
}

uint32_t font_colr_base(const struct font_colr *c, uint32_t glyph)
{
    uint32_t list = font_colr_u(c, BASES, 4), first = 0, end = font_colr_u(c, list, 4);
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        uint64_t at = (uint64_t)list + 4 + (uint64_t)middle * BASE;
        uint32_t found = font_colr_u(c, at, 2);
        if (found == glyph) {
            uint64_t paint = (uint64_t)list + font_colr_u(c, at + 2, 4);
            return paint < c->count ? (uint32_t)paint : 0;
        }
        if (found < glyph)
            first = middle + 1;
        else
            end = middle;
    }
    return 0;
}

uint32_t font_colr_layer(const struct font_colr *c, uint32_t i)
{
    uint32_t list = font_colr_u(c, LAYERS, 4);
    if (!list || i >= font_colr_u(c, list, 4))
        return 0;
    uint64_t paint = (uint64_t)list + font_colr_u(c, (uint64_t)list + 4 + 4 * (uint64_t)i, 4);
    return paint < c->count ? (uint32_t)paint : 0;
}

bool font_colr_plain_layer(const struct font_colr *c, uint32_t glyph, uint32_t i,
                           uint32_t *layer, uint32_t *colour)
{
    enum { LAYER = 4 };
    uint32_t first = 0, end = font_colr_u(c, 2, 2);
    uint64_t bases = font_colr_u(c, 4, 4), layers = font_colr_u(c, 8, 4);
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        uint64_t at = bases + (uint64_t)middle * BASE;
        uint32_t found = font_colr_u(c, at, 2);
        if (found == glyph) {
            uint64_t own = (uint64_t)font_colr_u(c, at + 2, 2) + i,
                     place = layers + own * LAYER;
            *layer = font_colr_u(c, place, 2);
            *colour = font_colr_u(c, place + 2, 2);
            return i < font_colr_u(c, at + 4, 2) && own < font_colr_u(c, 12, 2) &&
                   place + LAYER <= c->count;
        }
        if (found < glyph)
            first = middle + 1;
        else
            end = middle;
    }
    return false;
}

/* ---- numbers ---- */

/* A paint's numbers one after the other, those that vary counted. */
struct numbers {
    const struct font_colr *c;
    uint64_t at;
    uint32_t base, n;
};

static double next(struct numbers *r, int bytes)
{
    double value = font_colr_s(r->c, r->at, bytes) + font_colr_delta(r->c, r->base, r->n++);
    r->at += (unsigned)bytes;
    return value;
}

static double units(struct numbers *r)
{
    return next(r, 2);
}

static double part(struct numbers *r)
{
    return next(r, 2) / 16384;
}

/* From behind a paint's child on, `bytes` of numbers; with what varies behind them. */
static struct numbers numbers_of(const struct font_colr *c, uint32_t paint, unsigned behind,
                                 unsigned bytes, bool varies)
{
    struct numbers r = {c, (uint64_t)paint + behind, NOTHING_VARIES, 0};
    if (varies)
        r.base = font_colr_u(c, r.at + bytes, 4);
    return r;
}

static uint32_t child(const struct font_colr *c, uint32_t paint, unsigned at)
{
    uint32_t offset = font_colr_u(c, (uint64_t)paint + at, 3);
    uint64_t to = (uint64_t)paint + offset;
    return offset && to < c->count ? (uint32_t)to : 0;
}

bool font_colr_box(const struct font_colr *c, uint32_t glyph, struct font_box *out)
{
    uint32_t list = font_colr_u(c, CLIPS, 4), count = font_colr_u(c, (uint64_t)list + 1, 4);
    uint64_t at = (uint64_t)list + 5;
    if (!list || font_colr_u(c, list, 1) != 1)
        return false;
    for (uint32_t i = 0; i < count && at < c->count; i++, at += CLIP) {
        if (glyph < font_colr_u(c, at, 2) || glyph > font_colr_u(c, at + 2, 2))
            continue;
        uint64_t box = (uint64_t)list + font_colr_u(c, at + 4, 3);
        if (box >= c->count)
            return false;
        struct numbers r = numbers_of(c, (uint32_t)box, 1, 8, font_colr_u(c, box, 1) == 2);
        out->x0 = units(&r);
        out->y0 = units(&r);
        out->x1 = units(&r);
        out->y1 = units(&r);
        return out->x1 > out->x0 && out->y1 > out->y0;
    }
    return false;
}

/* ---- colours ---- */

static void colour_get(const struct font_colr *c, uint32_t index, double cover, float rgba[4])
{
    double rgb[3] = {c->ink[0], c->ink[1], c->ink[2]};
    if (index != FONT_COLR_INK && index < (uint32_t)c->palette_count) {
        for (int i = 0; i < 3; i++)
            rgb[i] = c->palette[index][i] / 255.0;
        cover *= c->palette[index][3] / 255.0;
    }
    cover = fmin(1, fmax(0, cover));
    for (int i = 0; i < 3; i++)
        rgba[i] = (float)(rgb[i] * cover);
    rgba[3] = (float)cover;
}

static void line_read(const struct font_colr *c, uint32_t line, bool varies,
                      struct font_gradient *out)
{
    uint32_t extend = font_colr_u(c, line, 1), count = font_colr_u(c, (uint64_t)line + 1, 2);
    unsigned stride = varies ? 10 : 6;
    out->extend = extend == 1   ? FONT_EXTEND_REPEAT
                  : extend == 2 ? FONT_EXTEND_REFLECT
                                : FONT_EXTEND_PAD;
    for (uint32_t i = 0; line && i < count && out->count < FONT_COLOURS_MAX; i++) {
        uint64_t at = (uint64_t)line + 3 + (uint64_t)i * stride;
        if (at + stride > c->count)
            break;
        struct numbers r = {c, at, varies ? font_colr_u(c, at + 6, 4) : NOTHING_VARIES, 0};
        out->at[out->count] = (float)part(&r);
        r.at += 2;
        colour_get(c, font_colr_u(c, at + 2, 2), part(&r), out->rgba[out->count++]);
    }
}

static struct font_point point(struct numbers *r)
{
    double x = units(r);
    return (struct font_point){x, units(r)};
}

/* A radius is never below 0: these bytes have no sign. */
static double radius(struct numbers *r)
{
    double value = font_colr_u(r->c, r->at, 2) + font_colr_delta(r->c, r->base, r->n++);
    r->at += 2;
    return fmax(0, value);
}

static bool gradient_read(const struct font_colr *c, uint32_t at, uint32_t format,
                          struct font_gradient *out)
{
    bool varies = format & 1;
    *out = (struct font_gradient){.kind = format < 6   ? FONT_GRADIENT_LINEAR
                                          : format < 8 ? FONT_GRADIENT_RADIAL
                                                       : FONT_GRADIENT_SWEEP};
    struct numbers r = numbers_of(c, at, 4, out->kind == FONT_GRADIENT_SWEEP ? 8 : 12, varies);
    line_read(c, child(c, at, 1), varies, out);
    out->p[0] = point(&r);
    switch (out->kind) {
    case FONT_GRADIENT_LINEAR:
        out->p[1] = point(&r);
        out->p[2] = point(&r);
        break;
    case FONT_GRADIENT_RADIAL:
        out->r[0] = radius(&r);
        out->p[1] = point(&r);
        out->r[1] = radius(&r);
        break;
    case FONT_GRADIENT_SWEEP:
        out->r[0] = (part(&r) + 1) / 2; /* halves of a turn, less one */
        out->r[1] = (part(&r) + 1) / 2;
        break;
    }
    return font_gradient_prepare(out);
}

/* ---- maps ---- */

/* Translations, scalings, rotations, slants, around a centre where they have one. */
static struct font_map map_read(const struct font_colr *c, uint32_t at, uint32_t format)
{
    static const unsigned bytes[] = {4, 4, 8, 2, 6, 2, 6, 4, 8};
    uint32_t kind = (format - 14) / 2;
    struct numbers r = numbers_of(c, at, 4, bytes[kind], format & 1);
    double m[4] = {1, 0, 0, 1};
    struct font_point move = {0, 0}, centre = {0, 0};
    double first = kind == 0 ? units(&r) : part(&r);
    double second = kind == 3 || kind == 4 || kind == 5 || kind == 6 ? first
                    : kind == 0                                      ? units(&r)
                                                                     : part(&r);
    if (kind == 2 || kind == 4 || kind == 6 || kind == 8)
        centre = point(&r);
    if (kind == 0) {
        move = (struct font_point){first, second};
    } else if (kind <= 4) {
        m[0] = first;
        m[3] = second;
    } else if (kind <= 6) { /* against the clock, y upwards */
        m[0] = m[3] = cos(first * M_PI);
        m[2] = sin(first * M_PI);
        m[1] = -m[2];
    } else {
        m[1] = -tan(first * M_PI);
        m[2] = tan(second * M_PI);
    }
    move.x += centre.x - m[0] * centre.x - m[1] * centre.y;
    move.y += centre.y - m[2] * centre.x - m[3] * centre.y;
    return (struct font_map){FONT_AFFINE, {m[0], m[1], move.x, m[2], m[3], move.y}};
}

static struct font_map affine_read(const struct font_colr *c, uint32_t at, bool varies)
{
    struct numbers r = numbers_of(c, at, 0, 24, varies);
    double n[6]; /* xx, yx, xy, yy, dx, dy */
    for (int i = 0; i < 6; i++)
        n[i] = at ? next(&r, 4) / 65536 : 0;
    return (struct font_map){FONT_AFFINE, {n[0], n[2], n[4], n[1], n[3], n[5]}};
}

void font_colr_paint(const struct font_colr *c, uint32_t at, struct font_paint *out,
                     struct font_gradient *gradient)
{
    uint32_t format = font_colr_u(c, at, 1);
    *out = (struct font_paint){.kind = FONT_PAINT_NONE};
    if (format == 1) {
        out->kind = FONT_PAINT_LAYERS;
        out->count = font_colr_u(c, (uint64_t)at + 1, 1);
        out->first = font_colr_u(c, (uint64_t)at + 2, 4);
    } else if (format == 2 || format == 3) {
        struct numbers r = numbers_of(c, at, 3, 2, format & 1);
        out->kind = FONT_PAINT_SOLID;
        colour_get(c, font_colr_u(c, (uint64_t)at + 1, 2), part(&r), out->rgba);
    } else if (format >= 4 && format <= 9) {
        out->kind =
            gradient_read(c, at, format, gradient) ? FONT_PAINT_GRADIENT : FONT_PAINT_NONE;
    } else if (format == 10) {
        out->kind = FONT_PAINT_GLYPH;
        out->child = child(c, at, 1);
        out->glyph = font_colr_u(c, (uint64_t)at + 4, 2);
    } else if (format == 11) {
        out->kind = FONT_PAINT_BASE;
        out->glyph = font_colr_u(c, (uint64_t)at + 1, 2);
    } else if (format >= 12 && format <= 31) {
        out->kind = FONT_PAINT_MAPPED;
        out->child = child(c, at, 1);
        out->map =
            format < 14 ? affine_read(c, child(c, at, 4), format & 1) : map_read(c, at, format);
    } else if (format == 32) {
        out->kind = FONT_PAINT_COMPOSITE;
        out->child = child(c, at, 1);
        out->mode = (int)font_colr_u(c, (uint64_t)at + 4, 1);
        out->below = child(c, at, 5);
    }
}
