/* colour_paints.c - glyphs as graphs of paints (COLR 1) drawn into a picture.
 *
 * A paint fills all that there is; a glyph's outline clips what is painted below it. So a
 * canvas of colours goes down the graph with a map from the paint's plane to the canvas's
 * pixels and a clip: what is left of each pixel within a rectangle. A composite has two
 * canvases of its own. Damaged fonts have graphs that go in circles, or are as large as one
 * likes: depth, paints and pixels are bounded. */
#include "colour_internal.h"
#include "colour_mix.h"
#include "gray.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_COLOR_H
#include FT_MULTIPLE_MASTERS_H

enum {
    DEPTH_MAX = 32,
    PAINTS_MAX = 4000,
    COMPOSITES_MAX = 6,  /* one within the other */
    GRAY_MAX = 16 << 20, /* pixels of all outlines */
    PALETTE_MAX = 512
};

/* Of each pixel within the rectangle, rows without gaps, what is left; NULL: all. */
struct clip {
    int x0, y0, x1, y1;
    uint8_t *left;
};

struct canvas {
    int width, height;
    float *rgba; /* sRGB numbers times cover */
};

struct graph {
    struct font_face *face;
    FT_Face ft;
    struct font_colr colr;
    hb_blob_t *blob;
    uint8_t palette[PALETTE_MAX][4];
    const struct font_filter *area;
    struct font_box *box; /* only this is wanted: around all outlines */
    int depth, composites, paints_left, gray_left;
    bool no_memory;
};

/* ---- filling ---- */

static void pixel_fill(float *below, const float rgba[4], float left)
{
    for (int c = 0; c < 4; c++)
        below[c] = below[c] * (1 - rgba[3] * left) + rgba[c] * left;
}

static float clip_left(const struct clip *clip, int x, int y)
{
    if (!clip->left)
        return 1;
    size_t at = (size_t)(y - clip->y0) * (size_t)(clip->x1 - clip->x0) + (size_t)(x - clip->x0);
    return (float)clip->left[at] * (1 / 255.0f);
}

/* All of the clip with a colour or a gradient. */
static void fill(struct canvas *to, const struct clip *clip, const struct font_map *map,
                 const float plain[4], const struct font_gradient *gradient)
{
    const double *m = map->m;
    double det = m[0] * m[4] - m[1] * m[3];
    if (gradient && !(fabs(det) > 1e-12))
        return;
    for (int y = clip->y0; y < clip->y1; y++)
        for (int x = clip->x0; x < clip->x1; x++) {
            float *below = to->rgba + 4 * ((size_t)y * (size_t)to->width + (size_t)x);
            float left = clip_left(clip, x, y), rgba[4];
            double dx = x + 0.5 - m[2], dy = y + 0.5 - m[5];
            if (left <= 0)
                continue;
            if (!gradient)
                pixel_fill(below, plain, left);
            else if (font_gradient_at(gradient, (dx * m[4] - dy * m[1]) / det,
                                      (dy * m[0] - dx * m[3]) / det, rgba))
                pixel_fill(below, rgba, left);
        }
}

/* ---- clips ---- */

/* The clip and what an outline covers within it. False: nothing is left. */
static bool clip_by_outline(struct graph *g, const struct font_outline *o,
                            const struct font_map *map, const struct clip *clip,
                            struct clip *out)
{
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    bool good = font_edges_build(&edges, o, map, g->area) == FONT_OK &&
                font_gray_place(&gray, &edges, g->area, 0, 0) == FONT_OK &&
                (double)gray.width_px * gray.height_px <= g->gray_left &&
                font_gray_draw(&gray, &edges, g->area, 0, 0) == FONT_OK && gray.pixels;
    if (good) {
        g->gray_left -= gray.width_px * gray.height_px;
        out->x0 = gray.left_px > clip->x0 ? gray.left_px : clip->x0;
        out->y0 = gray.top_px > clip->y0 ? gray.top_px : clip->y0;
        out->x1 = gray.left_px + gray.width_px;
        out->y1 = gray.top_px + gray.height_px;
        out->x1 = out->x1 < clip->x1 ? out->x1 : clip->x1;
        out->y1 = out->y1 < clip->y1 ? out->y1 : clip->y1;
        good = out->x0 < out->x1 && out->y0 < out->y1;
    }
    size_t width = good ? (size_t)(out->x1 - out->x0) : 0;
    out->left = good ? malloc(width * (size_t)(out->y1 - out->y0)) : NULL;
    g->no_memory = g->no_memory || (good && !out->left);
    for (int y = out->y0; out->left && y < out->y1; y++) {
        const uint8_t *from =
            gray.pixels + (size_t)(y - gray.top_px) * (size_t)gray.pitch - gray.left_px;
        uint8_t *row = out->left + (size_t)(y - out->y0) * width;
        for (int x = out->x0; x < out->x1; x++)
            row[x - out->x0] = (uint8_t)lrintf((float)from[x] * clip_left(clip, x, y));
    }
    font_edges_finish(&edges);
    font_gray_finish(&gray);
    return out->left;
}

static struct font_box box_mapped(const struct font_box *b, const struct font_map *map)
{
    struct font_box out = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < 4; i++) {
        struct font_point p = {i & 1 ? b->x1 : b->x0, i & 2 ? b->y1 : b->y0};
        double jacobian[4];
        font_map_point(map, p, &p, jacobian);
        out.x0 = fmin(out.x0, p.x);
        out.y0 = fmin(out.y0, p.y);
        out.x1 = fmax(out.x1, p.x);
        out.y1 = fmax(out.y1, p.y);
    }
    return out;
}

static void box_join(struct font_box *to, const struct font_box *more)
{
    to->x0 = fmin(to->x0, more->x0);
    to->y0 = fmin(to->y0, more->y0);
    to->x1 = fmax(to->x1, more->x1);
    to->y1 = fmax(to->y1, more->y1);
}

/* ---- the graph ---- */

static void paint_draw(struct graph *g, uint32_t paint, const struct font_map *map,
                       const struct clip *clip, struct canvas *to);

static void glyph_clip(struct graph *g, const struct font_outline *o, uint32_t below,
                       const struct font_map *map, const struct clip *clip, struct canvas *to)
{
    struct clip inner;
    if (g->box) {
        struct font_box box = font_outline_box(o);
        if (o->segments_count) {
            box = box_mapped(&box, map);
            box_join(g->box, &box);
        }
    } else if (clip_by_outline(g, o, map, clip, &inner)) {
        paint_draw(g, below, map, &inner, to);
        free(inner.left);
    }
}

static void glyph_draw(struct graph *g, const struct font_paint *p, const struct font_map *map,
                       const struct clip *clip, struct canvas *to)
{
    struct font_outline o;
    if (font_face_outline(g->face, p->glyph, &o) == FONT_OK)
        glyph_clip(g, &o, p->child, map, clip, to);
    font_outline_finish(&o);
}

/* Another glyph's graph, within its box if it has one. */
static void graph_draw(struct graph *g, uint32_t glyph, const struct font_map *map,
                       const struct clip *clip, struct canvas *to)
{
    uint32_t root = font_colr_base(&g->colr, glyph);
    struct font_box box;
    if (!root)
        return;
    if (!font_colr_box(&g->colr, glyph, &box)) {
        paint_draw(g, root, map, clip, to);
        return;
    }
    struct font_outline o = {.units_per_em = g->ft->units_per_EM};
    if (font_outline_move(&o, box.x0, box.y0) == FONT_OK &&
        font_outline_line(&o, box.x1, box.y0) == FONT_OK &&
        font_outline_line(&o, box.x1, box.y1) == FONT_OK &&
        font_outline_line(&o, box.x0, box.y1) == FONT_OK && font_outline_close(&o) == FONT_OK &&
        font_outline_prepare(&o, FONT_NONZERO) == FONT_OK)
        glyph_clip(g, &o, root, map, clip, to);
    font_outline_finish(&o);
}

static void composite_draw(struct graph *g, const struct font_paint *p,
                           const struct font_map *map, const struct clip *clip,
                           struct canvas *to)
{
    if (g->box) {
        paint_draw(g, p->below, map, clip, NULL);
        paint_draw(g, p->child, map, clip, NULL);
        return;
    }
    size_t count = (size_t)to->width * (size_t)to->height;
    if (g->composites == COMPOSITES_MAX)
        return;
    struct canvas below = *to, source = *to;
    const struct clip whole = {clip->x0, clip->y0, clip->x1, clip->y1, NULL};
    below.rgba = calloc(count, 4 * sizeof *below.rgba);
    source.rgba = calloc(count, 4 * sizeof *source.rgba);
    g->composites++;
    if (below.rgba && source.rgba) {
        enum font_mix how =
            p->mode < FONT_MIX_COUNT ? (enum font_mix)p->mode : FONT_MIX_SOURCE_OVER;
        paint_draw(g, p->below, map, &whole, &below);
        paint_draw(g, p->child, map, &whole, &source);
        for (int y = clip->y0; y < clip->y1; y++)
            for (int x = clip->x0; x < clip->x1; x++) {
                size_t at = 4 * ((size_t)y * (size_t)to->width + (size_t)x);
                float rgba[4];
                font_mix(how, source.rgba + at, below.rgba + at, rgba);
                pixel_fill(to->rgba + at, rgba, clip_left(clip, x, y));
            }
    } else {
        g->no_memory = true;
    }
    g->composites--;
    free(below.rgba);
    free(source.rgba);
}

static void paint_draw(struct graph *g, uint32_t at, const struct font_map *map,
                       const struct clip *clip, struct canvas *to)
{
    struct font_paint paint;
    struct font_gradient gradient;
    struct font_map own;
    if (!at || g->depth == DEPTH_MAX || g->paints_left <= 0)
        return;
    g->depth++;
    g->paints_left--;
    font_colr_paint(&g->colr, at, &paint, &gradient);
    switch (paint.kind) {
    case FONT_PAINT_NONE:
        break;
    case FONT_PAINT_LAYERS:
        for (uint32_t i = 0; i < paint.count && g->paints_left > 0; i++)
            paint_draw(g, font_colr_layer(&g->colr, paint.first + i), map, clip, to);
        break;
    case FONT_PAINT_SOLID:
        if (!g->box)
            fill(to, clip, map, paint.rgba, NULL);
        break;
    case FONT_PAINT_GRADIENT:
        if (!g->box)
            fill(to, clip, map, NULL, &gradient);
        break;
    case FONT_PAINT_GLYPH:
        glyph_draw(g, &paint, map, clip, to);
        break;
    case FONT_PAINT_BASE:
        graph_draw(g, paint.glyph, map, clip, to);
        break;
    case FONT_PAINT_MAPPED:
        own = font_map_then(paint.map, *map);
        paint_draw(g, paint.child, &own, clip, to);
        break;
    case FONT_PAINT_COMPOSITE:
        composite_draw(g, &paint, map, clip, to);
        break;
    }
    g->depth--;
}

/* ---- a picture ---- */

bool font_colour_has_paints(struct font_face *face, uint32_t glyph)
{
    hb_blob_t *blob = font_colour_table(face, "COLR");
    struct font_colr colr = font_colour_colr(blob);
    bool has = font_colr_good(&colr) && font_colr_base(&colr, glyph);
    hb_blob_destroy(blob);
    return has;
}

static void axes_take(struct graph *g)
{
    FT_Fixed values[FONT_COLR_AXES_MAX] = {0};
    if (!FT_HAS_MULTIPLE_MASTERS(g->ft) ||
        FT_Get_Var_Blend_Coordinates(g->ft, FONT_COLR_AXES_MAX, values))
        return;
    g->colr.axes_count = FONT_COLR_AXES_MAX;
    for (int i = 0; i < FONT_COLR_AXES_MAX; i++)
        g->colr.axes[i] = (double)values[i] / 65536;
}

static void graph_begin(struct graph *g, struct font_face *face, const double ink[3],
                        const struct font_filter *area)
{
    FT_Palette_Data palettes = {0};
    FT_Color *palette = NULL;
    *g = (struct graph){.face = face,
                        .ft = font_face_freetype(face),
                        .area = area,
                        .blob = font_colour_table(face, "COLR"),
                        .paints_left = PAINTS_MAX,
                        .gray_left = GRAY_MAX};
    g->colr = font_colour_colr(g->blob);
    g->colr.ink = ink;
    g->colr.palette = (const uint8_t(*)[4])g->palette;
    if (FT_Palette_Data_Get(g->ft, &palettes) == 0 &&
        FT_Palette_Select(g->ft, 0, &palette) == 0 && palette)
        g->colr.palette_count = palettes.num_palette_entries < PALETTE_MAX
                                    ? palettes.num_palette_entries
                                    : PALETTE_MAX;
    for (int i = 0; i < g->colr.palette_count; i++) {
        g->palette[i][0] = palette[i].red;
        g->palette[i][1] = palette[i].green;
        g->palette[i][2] = palette[i].blue;
        g->palette[i][3] = palette[i].alpha;
    }
    axes_take(g);
}

/* The pixels that a glyph's graph has where an em is em_px: its clip box, or what is around its
 * outlines. */
static bool pixels_of(struct font_face *face, uint32_t glyph, int em_px,
                      struct font_colour_picture *out)
{
    static const double black[3];
    struct graph g;
    graph_begin(&g, face, black, NULL);
    struct font_box box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    const struct font_map map = font_map_size(em_px, g.ft->units_per_EM);
    const struct clip none = {0};
    g.box = &box;
    graph_draw(&g, glyph, &map, &none, NULL);
    hb_blob_destroy(g.blob);
    return font_colour_pixels_set(&box, em_px, out);
}

enum font_status font_colour_paints(struct font_face *face, uint32_t glyph, int em_px,
                                    const double ink[3], const struct font_filter *area,
                                    struct font_colour_picture *out)
{
    struct graph g;
    *out = (struct font_colour_picture){0};
    while (!pixels_of(face, glyph, em_px, out)) {
        if (em_px == 1)
            return font_fail(FONT_BAD_FILE, "glyph %u has a drawing that is too large",
                             (unsigned)glyph);
        em_px = em_px / 2 > 0 ? em_px / 2 : 1;
    }
    if (!out->width_px)
        return FONT_OK;
    graph_begin(&g, face, ink, area);
    size_t count = (size_t)out->width_px * (size_t)out->height_px;
    struct canvas canvas = {out->width_px, out->height_px, calloc(count, 4 * sizeof(float))};
    struct font_map map = font_map_size(em_px, g.ft->units_per_EM);
    const struct clip whole = {0, 0, out->width_px, out->height_px, NULL};
    out->bgra = malloc(4 * count);
    if (canvas.rgba && out->bgra) {
        map.m[2] -= out->left_px;
        map.m[5] += out->top_px;
        graph_draw(&g, glyph, &map, &whole, &canvas);
        for (size_t i = 0; i < count; i++)
            for (int c = 0; c < 4; c++)
                out->bgra[4 * i + (size_t)(c < 3 ? 2 - c : 3)] =
                    (uint8_t)lrintf(255 * fminf(1, fmaxf(0, canvas.rgba[4 * i + (size_t)c])));
    }
    bool good = canvas.rgba && out->bgra && !g.no_memory;
    free(canvas.rgba);
    hb_blob_destroy(g.blob);
    if (good)
        return FONT_OK;
    free(out->bgra);
    *out = (struct font_colour_picture){0};
    return font_fail(FONT_NO_MEMORY, "no memory for a glyph's picture");
}
