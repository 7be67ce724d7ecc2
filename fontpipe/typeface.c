/* typeface.c - see typeface.h. */
#include "typeface.h"

#include "internal.h"
#include "many.h"
#include "own.h"
#include "paint.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H

enum { PIECE = 512 /* glyphs on the device at once */, GAP = 1 /* blank, in pixels */ };

struct work {
    struct font_face *face;
    const struct font_typeface_def *def;
    struct font_typeface *out;
    struct font_filter *filter;
    struct font_painter *painter;
    struct font_many *many; /* NULL: the face has its own below the outlines */
    struct font_map map;
    struct font_edges edges;
    double area;      /* of all glyphs so far, in pixels */
    uint8_t **covers; /* by glyph: its pixels until all have places, rows of width_px bytes */
};

/* ---- glyphs ---- */

/* Whether the glyphs so far, and a picture of so many pixels, have room. */
static enum font_status room_check(const struct work *w, double picture_bytes)
{
    const double most = w->def->pixels_bytes_max, bytes = w->area + picture_bytes;
    if (most > 0 && bytes > most)
        return font_fail(FONT_NO_MEMORY,
                         "not enough memory: a typeface at this size takes more than %.0f MB",
                         most * 1e-6);
    return FONT_OK;
}

static enum font_status cover_keep(struct work *w, int glyph, const struct font_gray *gray)
{
    struct font_typeface_glyph *g = &w->out->glyphs[glyph];
    if (!gray->width_px || !gray->height_px)
        return FONT_OK;
    const size_t width = (size_t)gray->width_px, height = (size_t)gray->height_px;
    w->area += (double)width * (double)height;
    if (w->area > (double)FONT_TYPEFACE_SIDE_MAX * FONT_TYPEFACE_SIDE_MAX)
        return font_fail(FONT_TOO_LARGE,
                         "a typeface is a picture of %d pixels a side at most: glyph %d is too "
                         "much at this size",
                         FONT_TYPEFACE_SIDE_MAX, glyph);
    const enum font_status room = room_check(w, w->area);
    if (room != FONT_OK)
        return room;
    uint8_t *pixels = malloc(width * height);
    if (!pixels)
        return font_fail(FONT_NO_MEMORY, "no memory for glyph %d of %zux%zu pixels", glyph,
                         width, height);
    for (size_t row = 0; row < height; row++)
        memcpy(pixels + row * width, gray->pixels + row * (size_t)gray->pitch, width);
    w->covers[glyph] = pixels;
    g->width_px = gray->width_px;
    g->height_px = gray->height_px;
    g->left_px = gray->left_px;
    g->top_px = gray->top_px;
    w->out->inked_count++;
    return FONT_OK;
}

static enum font_status glyph_paint(struct work *w, int glyph)
{
    const struct font_gray *gray;
    const enum font_status status = font_painter_glyph(w->painter, w->face, (uint32_t)glyph,
                                                       w->def->size_px, NULL, 0, 0, &gray);
    return status == FONT_OK ? cover_keep(w, glyph, gray) : status;
}

/* The glyph's edges, for the device; *edges is -1 where it cannot draw them. */
static enum font_status edges_keep(struct work *w, int glyph, int *edges)
{
    struct font_outline outline;
    *edges = -1;
    enum font_status status =
        font_face_outline_or_none(w->face, (uint32_t)glyph, true, &outline);
    if (status == FONT_OK)
        status = font_edges_build_tabled(&w->edges, &outline, &w->map, w->filter);
    font_outline_finish(&outline);
    if (status == FONT_OK && !w->edges.arcs_count) {
        *edges = font_many_edges(w->many, &w->edges);
        status = *edges < 0 ? FONT_NO_MEMORY : FONT_OK;
    }
    return status;
}

/* On the device, one by one, where some of a piece are too wide for it. */
static enum font_status jobs_draw_apart(struct work *w, const int *glyphs,
                                        const struct font_many_job *jobs, int count)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < count && status == FONT_OK; i++) {
        const struct font_gray *gray;
        status = font_many_draw(w->many, &jobs[i], 1, &gray);
        if (status == FONT_TOO_LARGE) {
            status = glyph_paint(w, glyphs[i]);
        } else if (status == FONT_OK) {
            status = cover_keep(w, glyphs[i], gray);
            w->out->on_device_count += gray->width_px != 0;
        }
    }
    return status;
}

static enum font_status piece_draw(struct work *w, int first, int end)
{
    struct font_many_job jobs[PIECE];
    int glyphs[PIECE], count = 0;
    const struct font_gray *grays;
    enum font_status status = FONT_OK;
    for (int glyph = first; glyph < end && status == FONT_OK; glyph++) {
        int edges = -1;
        status = font_patience_ask(glyph);
        if (status == FONT_OK && w->many)
            status = edges_keep(w, glyph, &edges);
        if (status == FONT_OK && edges < 0) {
            status = glyph_paint(w, glyph);
        } else if (status == FONT_OK) {
            glyphs[count] = glyph;
            jobs[count++] = (struct font_many_job){edges, 0, 0};
        }
    }
    if (status != FONT_OK || !count)
        return status;
    status = font_many_draw(w->many, jobs, count, &grays);
    for (int i = 0; i < count && status == FONT_OK; i++) {
        status = cover_keep(w, glyphs[i], &grays[i]);
        w->out->on_device_count += grays[i].width_px != 0;
    }
    if (status == FONT_TOO_LARGE)
        status = jobs_draw_apart(w, glyphs, jobs, count);
    font_many_edges_forget(w->many);
    return status;
}

static enum font_status glyphs_draw(struct work *w)
{
    const struct font_typeface_def *def = w->def;
    const int count = w->out->glyphs_count;
    enum font_status status = FONT_OK;
    for (int first = 0; first < count && status == FONT_OK; first += PIECE) {
        if (def->go_on && !def->go_on(def->context, first, count))
            return font_fail(FONT_NO_MEMORY, "stopped after %d of %d glyphs", first, count);
        status = piece_draw(w, first, first + PIECE < count ? first + PIECE : count);
    }
    return status;
}

/* ---- the picture ---- */

/* The higher one first, then the wider one, then by number. */
static int before(const void *a, const void *b, void *glyphs)
{
    const struct font_typeface_glyph *all = glyphs, *g = &all[*(const int *)a],
                                     *h = &all[*(const int *)b];
    if (g->height_px != h->height_px)
        return g->height_px > h->height_px ? -1 : 1;
    if (g->width_px != h->width_px)
        return g->width_px > h->width_px ? -1 : 1;
    return g->glyph < h->glyph ? -1 : g->glyph > h->glyph;
}

/* Puts those with ink side by side on shelves. A picture as wide as high, or a little wider. */
static enum font_status places_find(struct font_typeface *t, const int *order)
{
    double area = 0;
    int widest = 0, x = GAP, y = GAP, shelf = 0;
    for (int i = 0; i < t->inked_count; i++) {
        const struct font_typeface_glyph *g = &t->glyphs[order[i]];
        area += (double)(g->width_px + GAP) * (g->height_px + GAP);
        widest = g->width_px > widest ? g->width_px : widest;
    }
    const double side = fmax(ceil(sqrt(1.04 * area)), widest + 2 * GAP);
    if (!(side <= FONT_TYPEFACE_SIDE_MAX))
        return font_fail(FONT_TOO_LARGE, "a typeface is %d pixels wide at most (this %.0f)",
                         FONT_TYPEFACE_SIDE_MAX, side);
    t->width_px = ((int)side + 15) / 16 * 16;
    for (int i = 0; i < t->inked_count; i++) {
        struct font_typeface_glyph *g = &t->glyphs[order[i]];
        if (x + g->width_px + GAP > t->width_px) {
            x = GAP;
            y += shelf + GAP;
            shelf = 0;
        }
        g->x = x;
        g->y = y;
        x += g->width_px + GAP;
        shelf = g->height_px > shelf ? g->height_px : shelf;
    }
    t->height_px = y + shelf + GAP;
    return t->height_px <= FONT_TYPEFACE_SIDE_MAX
               ? FONT_OK
               : font_fail(FONT_TOO_LARGE, "a typeface is %d pixels high at most (this %d)",
                           FONT_TYPEFACE_SIDE_MAX, t->height_px);
}

static enum font_status picture_make(struct work *w)
{
    struct font_typeface *t = w->out;
    int *order = calloc((size_t)t->inked_count + 1, sizeof *order), count = 0;
    if (!order)
        return font_fail(FONT_NO_MEMORY, "no memory for %d glyphs", t->inked_count);
    for (int i = 0; i < t->glyphs_count; i++)
        if (t->glyphs[i].width_px)
            order[count++] = i;
    qsort_r(order, (size_t)count, sizeof *order, before, t->glyphs);
    enum font_status status = places_find(t, order);
    free(order);
    if (status == FONT_OK)
        status = room_check(w, (double)t->width_px * t->height_px);
    if (status != FONT_OK)
        return status;
    t->pixels = calloc((size_t)t->width_px, (size_t)t->height_px);
    if (!t->pixels)
        return font_fail(FONT_NO_MEMORY, "no memory for a typeface of %dx%d pixels",
                         t->width_px, t->height_px);
    for (int i = 0; i < t->glyphs_count; i++) {
        const struct font_typeface_glyph *g = &t->glyphs[i];
        const size_t width = (size_t)g->width_px;
        for (int row = 0; row < g->height_px; row++)
            memcpy(t->pixels + (size_t)(g->y + row) * (size_t)t->width_px + (size_t)g->x,
                   w->covers[i] + (size_t)row * width, width);
    }
    return FONT_OK;
}

/* ---- a typeface ---- */

double font_typeface_work_bytes(const struct font_face *face, double size_px)
{
    struct font_face_info info;
    font_face_describe(face, &info);
    const double at_once = info.glyphs_count < PIECE ? info.glyphs_count : PIECE,
                 side_px = 1.5 * size_px + 16;
    return 1.25 * at_once * side_px * side_px +
           (double)info.glyphs_count * (double)sizeof(struct font_typeface_glyph);
}

/* The first character of each glyph, by glyph number; 0: the glyph has none. */
static void characters_find(struct font_typeface *t, FT_Face face)
{
    const FT_ULong end = 0x110000; /* of Unicode */
    FT_ULong before = 0, character;
    FT_UInt glyph;
    for (character = FT_Get_First_Char(face, &glyph); glyph && character < end;
         character = FT_Get_Next_Char(face, character, &glyph)) {
        const bool surrogate = character >= 0xd800 && character < 0xe000;
        if (character < before) /* a damaged font's are not in order */
            break;
        before = character;
        if (character && !surrogate && glyph < (FT_UInt)t->glyphs_count &&
            !t->glyphs[glyph].character)
            t->glyphs[glyph].character = (uint32_t)character;
    }
}

static enum font_status glyphs_begin(struct work *w, const struct font_face_info *info)
{
    struct font_typeface *t = w->out;
    const size_t count = (size_t)info->glyphs_count;
    enum font_status status = FONT_OK;
    t->glyphs = calloc(count + 1, sizeof *t->glyphs);
    w->covers = calloc(count + 1, sizeof *w->covers);
    if (!t->glyphs || !w->covers)
        return font_fail(FONT_NO_MEMORY, "no memory for %zu glyphs", count);
    t->glyphs_count = info->glyphs_count;
    for (int i = 0; i < t->glyphs_count && status == FONT_OK; i++) {
        double advance = 0;
        status = font_face_advance(w->face, (uint32_t)i, &advance);
        if (status == FONT_BAD_FILE) /* a damaged glyph is left out, and moves nothing */
            status = FONT_OK;
        t->glyphs[i] = (struct font_typeface_glyph){
            .glyph = (uint32_t)i, .advance_px = advance * w->def->size_px / info->units_per_em};
    }
    characters_find(t, font_face_freetype(w->face));
    return status;
}

static enum font_status work_begin(struct work *w)
{
    struct font_face_info info;
    struct font_painter_def painter = font_painter_def_default();
    font_face_describe(w->face, &info);
    if (!(w->def->size_px >= 0.1 && w->def->size_px <= FONT_SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT, "a size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, w->def->size_px);
    w->map = font_map_size(w->def->size_px, info.units_per_em);
    const char *filter = w->def->filter ? w->def->filter : "gaussian-fast";
    painter.filter = filter;
    painter.darken_px = 0;
    enum font_status status = font_filter_create_named(filter, &w->filter);
    if (status == FONT_OK)
        status = font_painter_create(&painter, &w->painter);
    if (status == FONT_OK && !font_own_any(w->face))
        status = font_many_create(w->def->device, w->filter, &w->many);
    if (status == FONT_OK && w->many)
        snprintf(w->out->device, sizeof w->out->device, "%s", font_many_device(w->many));
    return status == FONT_OK ? glyphs_begin(w, &info) : status;
}

enum font_status font_typeface_draw(struct font_face *face, const struct font_typeface_def *def,
                                    struct font_typeface *out)
{
    struct work w = {.face = face, .def = def, .out = out};
    *out = (struct font_typeface){0};
    enum font_status status = work_begin(&w);
    if (status == FONT_OK)
        status = glyphs_draw(&w);
    if (status == FONT_OK && out->inked_count)
        status = picture_make(&w);
    for (int i = 0; w.covers && i < out->glyphs_count; i++)
        free(w.covers[i]);
    free(w.covers);
    font_edges_finish(&w.edges);
    font_many_destroy(w.many);
    font_painter_destroy(w.painter);
    font_filter_destroy(w.filter);
    if (status != FONT_OK)
        font_typeface_finish(out);
    return status;
}

void font_typeface_finish(struct font_typeface *t)
{
    free(t->pixels);
    free(t->glyphs);
    *t = (struct font_typeface){0};
}
