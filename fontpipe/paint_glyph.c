/* paint_glyph.c - each glyph of a layout in the way that it is drawn: as an outline, as layers
 * of outlines, as a picture. */
#include "paint_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is drawn in the text's ink within a picture of colours. */
static void ink_of(const struct font_ink *ink, double rgb[3])
{
    bool stops =
        (ink->kind == FONT_INK_LINEAR || ink->kind == FONT_INK_RADIAL) && ink->stops_count > 0;
    for (int c = 0; c < 3; c++)
        rgb[c] = ink->kind == FONT_INK_PLAIN ? ink->rgba[c] : stops ? ink->stops[0].rgba[c] : 0;
}

/* How many pixels an em of a drawing has, so that it is not enlarged: a power of two. */
static int em_for(const struct font_map *pixels, double size_px)
{
    enum { EM_MIN = 32, EM_MAX = 1024 };
    const struct font_point origin = {0, 0};
    struct font_point at;
    double j[4];
    if (font_map_point(pixels, origin, &at, j))
        size_px *= fmax(hypot(j[0], j[2]), hypot(j[1], j[3]));
    int em = EM_MIN;
    while (em < EM_MAX && em < 2 * size_px)
        em *= 2;
    return em;
}

/* A glyph's own picture, kept, or read or drawn for a size. */
static enum font_status picture_get(struct font_painter *p, const struct font_placed *g,
                                    const struct font_ink *ink, const struct font_map *pixels,
                                    double size_px, const struct font_colour_picture **out)
{
    struct key key;
    double rgb[3] = {0};
    int em = 0;
    memset(&key, 0, sizeof key);
    key.version = font_face_version(g->face);
    key.glyph = g->glyph;
    key.place_x = key.place_y = -2;
    if (font_colour_of(g->face, g->glyph) != FONT_COLOUR_PICTURE) {
        ink_of(ink, rgb);
        memcpy(key.map, rgb, sizeof rgb);
        em = em_for(pixels, size_px);
        key.map[3] = em;
    }
    struct entry *e = font_painter_entry_find(p, &key);
    if (!e) {
        struct font_colour_picture picture;
        enum font_status status = p->area ? FONT_OK : font_filter_create_named("box", &p->area);
        if (status == FONT_OK)
            status = font_colour_picture_draw(g->face, g->glyph, em, rgb, p->area, &picture);
        if (status != FONT_OK)
            return status;
        e = font_painter_entry_make(p, &key);
        if (!e) {
            free(picture.bgra);
            return font_fail(FONT_NO_MEMORY, "no memory for a glyph");
        }
        e->picture = picture;
        font_painter_entry_weigh(
            p, e, sizeof *e + 4 * (size_t)picture.width_px * (size_t)picture.height_px);
    }
    *out = &e->picture;
    return FONT_OK;
}

/* A glyph's picture, and where it goes: `from` has no pixels where there is nothing. */
struct placed_picture {
    const struct font_colour_picture *from;
    struct font_map pixels;
    double x, y, size_px;
};

static enum font_status picture_place(struct font_painter *p, const struct font_layout *layout,
                                      int i, const struct font_map *map, double x_px,
                                      double y_px, const struct font_ink *ink,
                                      struct placed_picture *out)
{
    const struct font_placed *g = &layout->glyphs[i];
    out->size_px = font_placed_size(layout, g);
    enum font_status status =
        font_placed_map(layout, i, map, x_px, y_px, &out->pixels, &out->x, &out->y);
    return status == FONT_OK ? picture_get(p, g, ink, &out->pixels, out->size_px, &out->from)
                             : status;
}

/* A glyph's picture where it goes; with `box` (may be NULL) only the box around it, untouched
 * if there is none. */
static enum font_status picture_draw(struct font_painter *p, const struct font_layout *layout,
                                     int i, const struct font_map *map, double x_px,
                                     double y_px, const struct font_ink *ink,
                                     struct font_picture *to, struct font_box *box)
{
    struct placed_picture at;
    enum font_status status = picture_place(p, layout, i, map, x_px, y_px, ink, &at);
    if (status != FONT_OK || !at.from->bgra)
        return status;
    if (box)
        font_blend_picture_box(at.from, &at.pixels, at.size_px, at.x, at.y, box);
    else
        font_blend_picture(p, at.from, &at.pixels, at.size_px, at.x, at.y,
                           ink->kind == FONT_INK_PLAIN ? ink->rgba[3] : 1, to);
    return FONT_OK;
}

bool font_painter_is_picture(const struct font_placed *g)
{
    enum font_colour colour = font_colour_of(g->face, g->glyph);
    return colour != FONT_COLOUR_NONE && colour != FONT_COLOUR_LAYERS;
}

static const struct font_ink *glyph_ink(const struct font_layout *layout, int i,
                                        const struct font_ink *own)
{
    int number = layout->glyphs[i].ink;
    return number > 0 ? &layout->inks[number - 1] : own;
}

enum font_status font_painter_tile(struct font_painter *p, const struct font_layout *layout,
                                   int i, const struct font_map *map, double x_px, double y_px,
                                   const double ink[3], int width_px, int height_px,
                                   struct font_tile *out)
{
    struct placed_picture at;
    const struct font_ink plain = font_ink_plain(ink[0], ink[1], ink[2], 1);
    const struct font_ink *own = glyph_ink(layout, i, &plain);
    *out = (struct font_tile){0};
    if (!font_painter_is_picture(&layout->glyphs[i]))
        return font_fail(FONT_NO_GLYPH, "glyph %u has no picture",
                         (unsigned)layout->glyphs[i].glyph);
    enum font_status status = picture_place(p, layout, i, map, x_px, y_px, own, &at);
    if (status != FONT_OK || !at.from->bgra)
        return status;
    return font_tile_draw(p, at.from, &at.pixels, at.size_px, at.x, at.y,
                          own->kind == FONT_INK_PLAIN ? own->rgba[3] : 1, width_px, height_px,
                          out);
}

/* A glyph's coloured layers, and a layout in which each in turn takes its place. */
struct layers {
    struct font_colour_layer of[FONT_COLOUR_LAYERS_MAX];
    int count;
    struct font_placed glyph;
    struct font_layout layout;
};

static void layers_take(struct layers *l, const struct font_layout *layout, int i)
{
    l->glyph = layout->glyphs[i];
    l->count = font_colour_layers(l->glyph.face, l->glyph.glyph, l->of);
    l->layout = *layout;
    l->layout.glyphs = &l->glyph;
    l->layout.glyphs_count = 1;
}

/* Its layers, the first below all, each a glyph in a colour of its own or in the ink. */
static enum font_status layers_draw(struct font_painter *p, const struct font_layout *layout,
                                    int i, const struct font_map *map, double x_px, double y_px,
                                    const struct font_ink *ink, struct font_picture *picture)
{
    struct layers l;
    enum font_status status = FONT_OK;
    layers_take(&l, layout, i);
    for (int k = 0; k < l.count && status == FONT_OK; k++) {
        const double *c = l.of[k].rgba;
        double left = ink->kind == FONT_INK_PLAIN ? ink->rgba[3] : 1;
        struct font_ink own = font_ink_plain(c[0], c[1], c[2], c[3] * left);
        l.glyph.glyph = l.of[k].glyph;
        status = font_painter_outline_draw(p, &l.layout, 0, map, x_px, y_px,
                                           l.of[k].own ? &own : ink, picture);
    }
    return status;
}

enum font_status font_painter_layout(struct font_painter *p, const struct font_layout *layout,
                                     const struct font_map *map, double x_px, double y_px,
                                     struct font_picture *picture)
{
    struct font_ink own = font_ink_plain(p->def.ink[0], p->def.ink[1], p->def.ink[2], 1);
    enum font_status status = FONT_OK;
    for (int i = 0; i < layout->glyphs_count && status == FONT_OK; i++) {
        const struct font_placed *g = &layout->glyphs[i];
        const struct font_ink *ink = glyph_ink(layout, i, &own);
        switch (font_colour_of(g->face, g->glyph)) {
        case FONT_COLOUR_PICTURE:
        case FONT_COLOUR_PAINTS:
        case FONT_COLOUR_SVG:
            status = picture_draw(p, layout, i, map, x_px, y_px, ink, picture, NULL);
            break;
        case FONT_COLOUR_LAYERS:
            status = layers_draw(p, layout, i, map, x_px, y_px, ink, picture);
            break;
        case FONT_COLOUR_NONE:
            status = font_painter_outline_draw(p, layout, i, map, x_px, y_px, ink, picture);
            break;
        }
    }
    return status;
}

static void box_add(struct font_box *box, const struct font_box *more)
{
    bool first = box->x1 < box->x0;
    box->x0 = first ? more->x0 : fmin(box->x0, more->x0);
    box->y0 = first ? more->y0 : fmin(box->y0, more->y0);
    box->x1 = first ? more->x1 : fmax(box->x1, more->x1);
    box->y1 = first ? more->y1 : fmax(box->y1, more->y1);
}

static enum font_status layers_measure(struct font_painter *p, const struct font_layout *layout,
                                       int i, const struct font_map *map, double x_px,
                                       double y_px, struct font_box *box)
{
    struct layers l;
    enum font_status status = FONT_OK;
    layers_take(&l, layout, i);
    for (int k = 0; k < l.count && status == FONT_OK; k++) {
        struct font_box more = {1, 1, -1, -1};
        l.glyph.glyph = l.of[k].glyph;
        status = font_painter_outline_measure(p, &l.layout, 0, map, x_px, y_px, &more);
        if (more.x0 <= more.x1)
            box_add(box, &more);
    }
    return status;
}

enum font_status font_painter_measure(struct font_painter *p, const struct font_layout *layout,
                                      const struct font_map *map, double x_px, double y_px,
                                      struct font_box *box)
{
    const struct font_ink own = font_ink_plain(p->def.ink[0], p->def.ink[1], p->def.ink[2], 1);
    *box = (struct font_box){1, 1, -1, -1};
    enum font_status status = FONT_OK;
    for (int i = 0; i < layout->glyphs_count && status == FONT_OK; i++) {
        const struct font_placed *g = &layout->glyphs[i];
        struct font_box more = {1, 1, -1, -1};
        enum font_colour colour = font_colour_of(g->face, g->glyph);
        status = font_patience_ask(i);
        if (status != FONT_OK)
            return status;
        if (colour != FONT_COLOUR_NONE && colour != FONT_COLOUR_LAYERS)
            status = picture_draw(p, layout, i, map, x_px, y_px, glyph_ink(layout, i, &own),
                                  NULL, &more);
        else if (colour == FONT_COLOUR_LAYERS)
            status = layers_measure(p, layout, i, map, x_px, y_px, &more);
        else
            status = font_painter_outline_measure(p, layout, i, map, x_px, y_px, &more);
        if (more.x0 <= more.x1)
            box_add(box, &more);
    }
    return status;
}
