/* paint.c - see paint.h.
 *
 * What is kept: a glyph's edges by (face, axes, glyph, map), and with `places` its gray
 * pictures by that and the place between pixels. Both are entries of one table with one budget;
 * what was not used for longest goes first. */
#include "own.h"
#include "paint_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- a painter ---- */

struct font_painter_def font_painter_def_default(void)
{
    return (struct font_painter_def){.filter = "gaussian-fast", .budget_bytes = 16u << 20};
}

enum font_status font_painter_create(const struct font_painter_def *def,
                                     struct font_painter **out)
{
    *out = NULL;
    for (int i = 0; i < 3; i++)
        if (!(def->ink[i] >= 0 && def->ink[i] <= 1))
            return font_fail(FONT_BAD_ARGUMENT, "ink must be 0..1 (got %g)", def->ink[i]);
    if (!(def->gamma == 0 || (def->gamma >= 0.2 && def->gamma <= 5)))
        return font_fail(FONT_BAD_ARGUMENT, "gamma must be 0 or 0.2..5 (got %g)", def->gamma);
    if (!((def->darken_px >= 0 && def->darken_px <= 2) ||
          def->darken_px == FONT_DARKEN_BY_STEM))
        return font_fail(FONT_BAD_ARGUMENT, "stems can be darkened by 0..2 pixels (got %g)",
                         def->darken_px);
    if (def->places < 0 || def->places > 256)
        return font_fail(FONT_BAD_ARGUMENT, "a pixel has 0..256 places (got %d)", def->places);
    struct font_painter *p = calloc(1, sizeof *p);
    if (!p)
        return font_fail(FONT_NO_MEMORY, "no memory to paint type");
    p->def = *def;
    enum font_status status =
        font_filter_create_named(def->filter ? def->filter : "gaussian-fast", &p->filter);
    if (status != FONT_OK) {
        free(p);
        return status;
    }
    for (int i = 0; i < TO_LIGHT; i++)
        p->to_light[i] = (float)font_light(i / 255.0, def->gamma);
    for (int i = 0; i <= TO_NUMBER; i++) {
        /* The table is by the root of light: dark numbers are as close as light ones. */
        double root = (double)i / TO_NUMBER;
        p->to_number[i] = (uint8_t)lrint(255 * font_number(root * root, def->gamma));
    }
    *out = p;
    return FONT_OK;
}

static void entry_unlink(struct font_painter *p, struct entry *e)
{
    if (e->newer)
        e->newer->older = e->older;
    else
        p->newest = e->older;
    if (e->older)
        e->older->newer = e->newer;
    else
        p->oldest = e->newer;
    e->newer = e->older = NULL;
}

static void entry_use(struct font_painter *p, struct entry *e)
{
    e->older = p->newest;
    e->newer = NULL;
    if (p->newest)
        p->newest->newer = e;
    p->newest = e;
    if (!p->oldest)
        p->oldest = e;
}

static uint32_t bucket_of(const struct key *key)
{
    uint64_t words[sizeof *key / sizeof(uint64_t)], hash = 0;
    _Static_assert(sizeof words == sizeof *key, "a key is whole words");
    memcpy(words, key, sizeof words);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        hash = (hash ^ words[i]) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 29;
    }
    return (uint32_t)(hash >> 32) % BUCKETS;
}

static void entry_free(struct font_painter *p, struct entry *e)
{
    struct entry **at = &p->buckets[bucket_of(&e->key)];
    while (*at != e)
        at = &(*at)->next;
    *at = e->next;
    entry_unlink(p, e);
    p->stats.kept_bytes -= e->bytes;
    p->stats.kept_count--;
    font_edges_finish(&e->edges);
    font_gray_finish(&e->gray);
    free(e->picture.bgra);
    free(e);
}

void font_painter_destroy(struct font_painter *p)
{
    if (!p)
        return;
    while (p->oldest)
        entry_free(p, p->oldest);
    for (int i = 0; i < 3; i++)
        font_gray_finish(&p->scratch[i]);
    font_filter_destroy(p->filter);
    font_filter_destroy(p->area);
    free(p);
}

const struct font_filter *font_painter_filter(const struct font_painter *p)
{
    return p->filter;
}

void font_painter_stats_get(const struct font_painter *p, struct font_painter_stats *out)
{
    *out = p->stats;
}

struct entry *font_painter_entry_find(struct font_painter *p, const struct key *key)
{
    for (struct entry *e = p->buckets[bucket_of(key)]; e; e = e->next)
        if (memcmp(&e->key, key, sizeof *key) == 0) {
            entry_unlink(p, e);
            entry_use(p, e);
            return e;
        }
    return NULL;
}

/* A new entry, of no bytes yet. */
struct entry *font_painter_entry_make(struct font_painter *p, const struct key *key)
{
    struct entry *e = calloc(1, sizeof *e);
    if (!e)
        return NULL;
    e->key = *key;
    struct entry **bucket = &p->buckets[bucket_of(key)];
    e->next = *bucket;
    *bucket = e;
    entry_use(p, e);
    p->stats.kept_count++;
    return e;
}

/* Counts the entry's bytes and drops others while there are too many; the newest always
 * stays. */
void font_painter_entry_weigh(struct font_painter *p, struct entry *e, size_t bytes)
{
    p->stats.kept_bytes += bytes - e->bytes;
    e->bytes = bytes;
    while (p->stats.kept_bytes > p->def.budget_bytes && p->oldest != p->newest) {
        entry_free(p, p->oldest);
        p->stats.evicted++;
    }
}

/* ---- glyphs ---- */

/* How much wider stems get that are so wide, both in pixels: between these points on straight
 * lines. */
static double darkening_of_stem(double stem_px)
{
    static const double stems[] = {0.5, 1, 1.667, 2.333}, more[] = {0.4, 0.275, 0.275, 0};
    enum { POINTS = 4 };
    if (stem_px <= stems[0])
        return more[0];
    for (int i = 1; i < POINTS; i++)
        if (stem_px < stems[i])
            return more[i] +
                   (more[i - 1] - more[i]) * (stems[i] - stem_px) / (stems[i] - stems[i - 1]);
    return 0;
}

/* How much wider the face's stems get, in pixels. */
static double darkening(struct font_painter *p, struct font_face *face, double size_px)
{
    if (p->def.darken_px >= 0)
        return p->def.darken_px * fmin(1, fmax(0, (36 - size_px) / 24));
    if (p->stem_of != font_face_version(face)) {
        p->stem_of = font_face_version(face);
        p->stem = font_face_stem(face);
    }
    return darkening_of_stem(p->stem * size_px);
}

/* How large an em is in the picture where a map puts the glyph's origin. */
static double size_shown(const struct font_face *face, const struct font_map *whole)
{
    static const struct font_point origin = {0, 0};
    struct font_face_info info;
    struct font_point at;
    double j[4];
    font_face_describe(face, &info);
    return font_map_point(whole, origin, &at, j)
               ? sqrt(fabs(j[0] * j[3] - j[1] * j[2])) * info.units_per_em
               : 0;
}

/* The filter of a glyph: the face's own, or the painter's. */
static const struct font_filter *filter_of(const struct font_painter *p,
                                           const struct font_face *face, uint32_t glyph,
                                           const struct font_map *whole)
{
    const struct font_filter *own = font_own_any(face) && !p->def.without_own
                                        ? font_own_filter(face, glyph, size_shown(face, whole))
                                        : NULL;
    return own ? own : p->filter;
}

/* The gray that a glyph has of its own where it is upright; NULL: it has none. */
static const struct font_gray *gray_of(const struct font_painter *p,
                                       const struct font_face *face, uint32_t glyph,
                                       const struct font_map *whole)
{
    const double *m = whole->m, near = 1e-6 * fabs(m[0]);
    if (!font_own_any(face) || p->def.without_own || whole->kind != FONT_AFFINE ||
        !(m[0] > 0) || fabs(m[1]) > near || fabs(m[3]) > near || fabs(m[4] + m[0]) > near)
        return NULL;
    return font_own_gray(face, glyph, size_shown(face, whole));
}

/* The whole pixel that is nearest to a place. */
static int whole_of(double place)
{
    return (int)floor(place + 0.5);
}

/* Of a glyph that its map folds over: what it covers from either side. */
static enum font_status edges_make_folded(struct font_painter *p, struct font_face *face,
                                          uint32_t glyph, const struct font_map *map,
                                          struct font_edges *edges)
{
    static const struct font_map same = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}};
    struct font_outline raw, mapped = {0};
    enum font_status status = font_face_outline_or_none(face, glyph, false, &raw);
    if (status == FONT_OK)
        status = font_outline_mapped(&raw, map, &mapped);
    if (status == FONT_OK)
        status = font_outline_prepare(&mapped, FONT_NONZERO);
    if (status == FONT_OK)
        status = font_edges_build(edges, &mapped, &same, filter_of(p, face, glyph, map));
    font_outline_finish(&raw);
    font_outline_finish(&mapped);
    return status;
}

static enum font_status edges_make(struct font_painter *p, struct font_face *face,
                                   uint32_t glyph, const struct font_map *map, double size_px,
                                   struct font_edges *edges)
{
    struct font_outline outline;
    double darken = darkening(p, face, size_px);
    enum font_status status;
    if (darken > 0) {
        status = font_face_outline_or_none(face, glyph, false, &outline);
        double units = darken * outline.units_per_em / size_px;
        if (status == FONT_OK)
            status = font_outline_embolden(&outline, units, units / 2); /* stems most */
        if (status == FONT_OK)
            status = font_outline_prepare(&outline, FONT_NONZERO);
    } else {
        status = font_face_outline_or_none(face, glyph, true, &outline);
    }
    if (status == FONT_OK)
        status = font_edges_build(edges, &outline, map, filter_of(p, face, glyph, map));
    font_outline_finish(&outline);
    if (status == FONT_BAD_ARGUMENT && (map->kind == FONT_BILINEAR || map->kind == FONT_SMOOTH))
        status = edges_make_folded(p, face, glyph, map, edges);
    return status;
}

/* A glyph's edges, kept or made. */
static enum font_status edges_get(struct font_painter *p, struct font_face *face,
                                  uint32_t glyph, const struct font_map *map, double size_px,
                                  struct key *key, struct font_edges **out)
{
    memset(key, 0, sizeof *key);
    key->version = font_face_version(face);
    key->glyph = glyph;
    key->kind = (int32_t)map->kind;
    memcpy(key->map, map->m, sizeof key->map);
    key->place_x = key->place_y = -1;
    struct entry *e = font_painter_entry_find(p, key);
    if (e) {
        p->stats.edges_hits++;
        *out = &e->edges;
        return FONT_OK;
    }
    e = font_painter_entry_make(p, key);
    if (!e)
        return font_fail(FONT_NO_MEMORY, "no memory for a glyph");
    enum font_status status = edges_make(p, face, glyph, map, size_px, &e->edges);
    if (status != FONT_OK) {
        entry_free(p, e);
        return status;
    }
    font_painter_entry_weigh(
        p, e, sizeof *e + 12 * (size_t)(e->edges.nodes_capacity + e->edges.lines_capacity));
    *out = &e->edges;
    return FONT_OK;
}

/* The glyph's map: its own units to pixels at its place in the text, then the text's map. What
 * is left over as a translation is the place; distortions have it in the map. */
static enum font_status placed_map(const struct font_layout *layout, int i,
                                   const struct font_map *map, double x_px, double y_px,
                                   struct font_map *out, double *x, double *y)
{
    struct font_face_info info;
    struct font_map pixels;
    const struct font_placed *g = &layout->glyphs[i];
    font_face_describe(g->face, &info);
    struct font_map own = font_map_size(font_placed_size(layout, g), info.units_per_em);
    enum font_status status = font_placed_map(layout, i, map, x_px, y_px, &pixels, x, y);
    return status == FONT_OK ? font_map_compose(&own, &pixels, out) : status;
}

/* ---- drawing ---- */

/* A picture at a place, drawn or kept. *whole_x, *whole_y: the pixel that it counts from. */
static enum font_status gray_get(struct font_painter *p, const struct font_edges *edges,
                                 const struct font_filter *filter, struct key key, double x,
                                 double y, struct font_gray *scratch,
                                 const struct font_gray **out, int *whole_x, int *whole_y)
{
    *whole_x = (int)floor(x);
    *whole_y = (int)floor(y);
    double fx = x - *whole_x, fy = y - *whole_y;
    *out = scratch;
    if (!p->def.places) {
        p->stats.drawn++;
        return font_gray_draw(scratch, edges, filter, fx, fy);
    }
    key.place_x = (int32_t)floor(fx * p->def.places + 0.5);
    key.place_y = (int32_t)floor(fy * p->def.places + 0.5);
    struct entry *e = font_painter_entry_find(p, &key);
    if (e) {
        p->stats.kept_hits++;
        *out = &e->gray;
        return FONT_OK;
    }
    /* Drawn before the entry is made, which may drop the edges. */
    struct font_gray gray = {0};
    enum font_status status =
        font_gray_draw(&gray, edges, filter, (double)key.place_x / p->def.places,
                       (double)key.place_y / p->def.places);
    p->stats.drawn++;
    e = status == FONT_OK ? font_painter_entry_make(p, &key) : NULL;
    if (!e) {
        font_gray_finish(&gray);
        return status != FONT_OK ? status : font_fail(FONT_NO_MEMORY, "no memory for a glyph");
    }
    free(gray.work);
    gray.work = NULL;
    gray.work_bytes = 0;
    e->gray = gray;
    font_painter_entry_weigh(p, e, sizeof *e + gray.memory_bytes);
    *out = &e->gray;
    return FONT_OK;
}

/* Where glyph i of a layout goes: its map without its place, and the place. */
static enum font_status glyph_place(const struct font_layout *layout, int i,
                                    const struct font_map *map, double x_px, double y_px,
                                    struct font_map *whole, double *x, double *y)
{
    enum font_status status = placed_map(layout, i, map, x_px, y_px, whole, x, y);
    if (status == FONT_OK && !(fabs(*x) < 1e6 && fabs(*y) < 1e6))
        status = font_fail(FONT_BAD_ARGUMENT, "a glyph cannot be at (%g, %g)", *x, *y);
    return status;
}

/* Its picture, counted from a whole pixel. */
static enum font_status glyph_draw(struct font_painter *p, const struct font_layout *layout,
                                   int i, const struct font_map *whole, double x, double y,
                                   struct font_gray *scratch, const struct font_gray **gray,
                                   int *whole_x, int *whole_y)
{
    const struct font_placed *g = &layout->glyphs[i];
    struct font_edges *edges = NULL;
    struct key key;
    *gray = gray_of(p, g->face, g->glyph, whole);
    if (*gray) {
        *whole_x = whole_of(x);
        *whole_y = whole_of(y);
        return FONT_OK;
    }
    enum font_status status =
        edges_get(p, g->face, g->glyph, whole, font_placed_size(layout, g), &key, &edges);
    return status == FONT_OK ? gray_get(p, edges, filter_of(p, g->face, g->glyph, whole), key,
                                        x, y, scratch, gray, whole_x, whole_y)
                             : status;
}

/* Glyph i as its outline, in an ink. */
enum font_status font_painter_outline_draw(struct font_painter *p,
                                           const struct font_layout *layout, int i,
                                           const struct font_map *map, double x_px, double y_px,
                                           const struct font_ink *ink,
                                           struct font_picture *picture)
{
    const struct font_placed *g = &layout->glyphs[i];
    struct font_map whole;
    double x, y;
    enum font_status status = glyph_place(layout, i, map, x_px, y_px, &whole, &x, &y);
    for (int c = 0; c < (p->def.stripes ? 3 : 1) && status == FONT_OK; c++) {
        const struct font_gray *gray;
        int whole_x, whole_y;
        /* Red is left: the glyph is right of it. Gray of its own has no stripes. */
        double shift =
            p->def.stripes && !gray_of(p, g->face, g->glyph, &whole) ? (1 - c) / 3.0 : 0;
        status = glyph_draw(p, layout, i, &whole, x + shift, y, &p->scratch[c], &gray, &whole_x,
                            &whole_y);
        if (status == FONT_OK)
            font_blend(p, gray, whole_x, whole_y, p->def.stripes ? c : -1, ink, x_px, y_px,
                       picture);
    }
    return status;
}

enum font_status font_painter_cover(struct font_painter *p, const struct font_layout *layout,
                                    const struct font_map *map, double x_px, double y_px,
                                    struct font_cover *cover)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < layout->glyphs_count && status == FONT_OK; i++) {
        struct font_map whole;
        const struct font_gray *gray;
        double x, y;
        int whole_x, whole_y;
        status = font_patience_ask(i);
        if (status == FONT_OK)
            status = glyph_place(layout, i, map, x_px, y_px, &whole, &x, &y);
        if (status == FONT_OK)
            status = glyph_draw(p, layout, i, &whole, x, y, &p->scratch[0], &gray, &whole_x,
                                &whole_y);
        if (status == FONT_OK)
            font_blend_cover(gray, whole_x, whole_y, cover);
    }
    return status;
}

enum font_status font_painter_glyph(struct font_painter *p, struct font_face *face,
                                    uint32_t glyph, double size_px, const struct font_map *map,
                                    double x_px, double y_px, const struct font_gray **gray)
{
    struct font_placed one = {.face = face, .glyph = glyph};
    const struct font_layout layout = {.glyphs = &one, .glyphs_count = 1, .size_px = size_px};
    struct font_map whole;
    struct font_edges *edges;
    struct key key;
    double x, y;
    if (!(size_px >= 0.1 && size_px <= FONT_SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT, "a size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, size_px);
    enum font_status status = placed_map(&layout, 0, map, x_px, y_px, &whole, &x, &y);
    if (map && map->kind == FONT_AFFINE) { /* its linear part */
        x = x_px;
        y = y_px;
    }
    const struct font_gray *own = status == FONT_OK ? gray_of(p, face, glyph, &whole) : NULL;
    if (own) {
        p->own = *own; /* its pixels, at the nearest place */
        p->own.left_px += whole_of(x);
        p->own.top_px += whole_of(y);
        *gray = &p->own;
        return FONT_OK;
    }
    if (status == FONT_OK)
        status = edges_get(p, face, glyph, &whole, size_px, &key, &edges);
    if (status == FONT_OK)
        status = font_gray_draw(&p->scratch[0], edges, filter_of(p, face, glyph, &whole), x, y);
    p->stats.drawn++;
    *gray = &p->scratch[0];
    return status;
}

/* The box around glyph i's outline; untouched if it has no ink. */
enum font_status font_painter_outline_measure(struct font_painter *p,
                                              const struct font_layout *layout, int i,
                                              const struct font_map *map, double x_px,
                                              double y_px, struct font_box *box)
{
    const struct font_placed *g = &layout->glyphs[i];
    struct font_map whole;
    struct font_edges *edges;
    struct font_gray place;
    struct key key;
    double x, y;
    enum font_status status = placed_map(layout, i, map, x_px, y_px, &whole, &x, &y);
    const struct font_gray *own =
        status == FONT_OK ? gray_of(p, g->face, g->glyph, &whole) : NULL;
    if (own) {
        if (own->width_px)
            *box = (struct font_box){whole_of(x) + own->left_px, whole_of(y) + own->top_px,
                                     whole_of(x) + own->left_px + own->width_px,
                                     whole_of(y) + own->top_px + own->height_px};
        return FONT_OK;
    }
    if (status == FONT_OK)
        status =
            edges_get(p, g->face, g->glyph, &whole, font_placed_size(layout, g), &key, &edges);
    if (status == FONT_OK)
        status = font_gray_place(&place, edges, filter_of(p, g->face, g->glyph, &whole),
                                 x - floor(x), y - floor(y));
    if (status != FONT_OK || !place.width_px)
        return status;
    double x0 = floor(x) + place.left_px, y0 = floor(y) + place.top_px;
    *box = (struct font_box){x0, y0, x0 + place.width_px, y0 + place.height_px};
    return FONT_OK;
}
