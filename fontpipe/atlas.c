/* atlas.c - see atlas.h. Time is counted in calls; what was asked for at or after frame_start
 * is in use. */
#include "atlas.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BUCKETS = 2048, PAGES_MAX = 64, GAP = 1, STEP = 4 };

/* Compared whole: no padding, all of it set. */
struct key {
    uint64_t version;
    double size_px, map[FONT_MAP_NUMBERS];
    uint32_t glyph;
    int32_t place_x, place_y, kind;
};

struct entry {
    struct key key;
    struct font_atlas_slot slot; /* left_px, top_px: from the glyph's own pixel */
    struct entry *next;          /* of the bucket */
    struct entry *on_shelf;
};

struct shelf {
    int page, y, height_px, end_x;
    uint64_t used; /* when */
    struct entry *entries;
};

struct page {
    uint8_t *pixels;
    int end_y;
    struct font_atlas_box dirty; /* width 0: nothing */
};

struct font_atlas {
    struct font_atlas_def def;
    struct font_painter *painter;
    struct page pages[PAGES_MAX];
    int pages_count;
    struct shelf *shelves;
    int shelves_count, shelves_capacity;
    struct entry *buckets[BUCKETS];
    uint64_t now, frame_start;
    struct font_atlas_stats stats;
};

struct font_atlas_def font_atlas_def_default(void)
{
    return (struct font_atlas_def){.filter = "gaussian-fast",
                                   .width_px = 1024,
                                   .height_px = 1024,
                                   .pages_max = 4,
                                   .places_x = 4,
                                   .places_y = 1,
                                   .edges_budget_bytes = 4u << 20};
}

enum font_status font_atlas_create(const struct font_atlas_def *def, struct font_atlas **out)
{
    enum { SIDE_MIN = 64, SIDE_MAX = 16384, PLACES_MAX = 256 };
    *out = NULL;
    if (def->width_px < SIDE_MIN || def->width_px > SIDE_MAX || def->height_px < SIDE_MIN ||
        def->height_px > SIDE_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "an atlas has pages of %d..%d pixels (got %dx%d)",
                         SIDE_MIN, SIDE_MAX, def->width_px, def->height_px);
    if (def->pages_max < 1 || def->pages_max > PAGES_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "an atlas has 1..%d pages (got %d)", PAGES_MAX,
                         def->pages_max);
    if (def->places_x < 1 || def->places_x > PLACES_MAX || def->places_y < 1 ||
        def->places_y > PLACES_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "a pixel of an atlas has 1..%d places (got %d, %d)",
                         PLACES_MAX, def->places_x, def->places_y);
    struct font_atlas *a = calloc(1, sizeof *a);
    if (!a)
        return font_fail(FONT_NO_MEMORY, "no memory for an atlas");
    a->def = *def;
    struct font_painter_def painter = font_painter_def_default();
    painter.filter = def->filter;
    painter.darken_px = def->darken_px;
    painter.budget_bytes = def->edges_budget_bytes;
    enum font_status status = font_painter_create(&painter, &a->painter);
    if (status != FONT_OK) {
        free(a);
        return status;
    }
    a->def.filter = NULL; /* the painter's now */
    font_atlas_begin(a);
    *out = a;
    return FONT_OK;
}

static uint32_t bucket_of(const struct key *key)
{
    return font_hash(key, sizeof *key) % BUCKETS;
}

static void shelf_empty(struct font_atlas *a, struct shelf *s)
{
    while (s->entries) {
        struct entry *e = s->entries, **at = &a->buckets[bucket_of(&e->key)];
        s->entries = e->on_shelf;
        while (*at != e)
            at = &(*at)->next;
        *at = e->next;
        free(e);
        a->stats.glyphs_count--;
    }
    s->end_x = 0;
}

void font_atlas_destroy(struct font_atlas *a)
{
    if (!a)
        return;
    for (int i = 0; i < a->shelves_count; i++)
        shelf_empty(a, &a->shelves[i]);
    for (int i = 0; i < a->pages_count; i++)
        free(a->pages[i].pixels);
    free(a->shelves);
    font_painter_destroy(a->painter);
    free(a);
}

void font_atlas_begin(struct font_atlas *a)
{
    a->frame_start = ++a->now;
}

int font_atlas_pages(const struct font_atlas *a)
{
    return a->pages_count;
}

const uint8_t *font_atlas_pixels(const struct font_atlas *a, int page)
{
    return page >= 0 && page < a->pages_count ? a->pages[page].pixels : NULL;
}

bool font_atlas_dirty(struct font_atlas *a, int page, struct font_atlas_box *box)
{
    *box = (struct font_atlas_box){0};
    if (page < 0 || page >= a->pages_count || a->pages[page].dirty.width == 0)
        return false;
    *box = a->pages[page].dirty;
    a->pages[page].dirty = (struct font_atlas_box){0};
    return true;
}

static void dirty_add(struct page *p, int x, int y, int width, int height)
{
    struct font_atlas_box *d = &p->dirty;
    if (d->width == 0) {
        *d = (struct font_atlas_box){x, y, width, height};
        return;
    }
    int x1 = d->x + d->width > x + width ? d->x + d->width : x + width;
    int y1 = d->y + d->height > y + height ? d->y + d->height : y + height;
    d->x = d->x < x ? d->x : x;
    d->y = d->y < y ? d->y : y;
    d->width = x1 - d->x;
    d->height = y1 - d->y;
}

/* ---- room ---- */

/* A shelf cut from what a page has left; -1 if there is no page with so much. *status: no
 * memory. */
static int shelf_cut(struct font_atlas *a, int height_px, enum font_status *status)
{
    int page = 0;
    while (page < a->pages_count && a->pages[page].end_y + height_px > a->def.height_px)
        page++;
    if (page == a->def.pages_max)
        return -1;
    if (!array_reserve(&a->shelves, &a->shelves_capacity, a->shelves_count + 1,
                       sizeof *a->shelves)) {
        *status = font_fail(FONT_NO_MEMORY, "no memory for an atlas");
        return -1;
    }
    if (page == a->pages_count) {
        size_t bytes = (size_t)a->def.width_px * (size_t)a->def.height_px;
        a->pages[page] = (struct page){.pixels = calloc(1, bytes)};
        if (!a->pages[page].pixels) {
            *status = font_fail(FONT_NO_MEMORY, "no memory for a page of %dx%d pixels",
                                a->def.width_px, a->def.height_px);
            return -1;
        }
        a->pages_count++;
        a->stats.bytes += bytes;
    }
    a->shelves[a->shelves_count] =
        (struct shelf){.page = page, .y = a->pages[page].end_y, .height_px = height_px};
    a->pages[page].end_y += height_px;
    return a->shelves_count++;
}

/* The lowest shelf with room that is at most half as high again as the picture. */
static int shelf_find(const struct font_atlas *a, int width_px, int height_px)
{
    int best = -1;
    for (int i = 0; i < a->shelves_count; i++) {
        const struct shelf *s = &a->shelves[i];
        if (s->height_px >= height_px && s->height_px <= height_px + height_px / 2 + STEP &&
            s->end_x + width_px <= a->def.width_px &&
            (best < 0 || s->height_px < a->shelves[best].height_px))
            best = i;
    }
    return best;
}

/* Shelves above each other, of a page, that are not in use and together high enough. */
struct run {
    int page, y, height_px;
    uint64_t used; /* the latest of them */
};

static int shelf_compare(const void *a, const void *b)
{
    const struct shelf *p = a, *q = b;
    return p->page != q->page ? (p->page > q->page) - (p->page < q->page)
                              : (p->y > q->y) - (p->y < q->y);
}

/* The run that was not used for longest, of those the lowest; false if there is none. Sorts the
 * shelves. */
static bool run_find(struct font_atlas *a, int height_px, struct run *best)
{
    bool found = false;
    qsort(a->shelves, (size_t)a->shelves_count, sizeof *a->shelves, shelf_compare);
    for (int i = 0; i < a->shelves_count; i++) {
        struct run run = {.page = a->shelves[i].page, .y = a->shelves[i].y};
        for (int k = i; k < a->shelves_count && a->shelves[k].page == run.page &&
                        a->shelves[k].used < a->frame_start && run.height_px < height_px;
             k++) {
            run.height_px += a->shelves[k].height_px;
            run.used = a->shelves[k].used > run.used ? a->shelves[k].used : run.used;
            if (run.y + run.height_px ==
                a->pages[run.page].end_y) /* and what was not cut yet */
                run.height_px = a->def.height_px - run.y;
        }
        if (run.height_px >= height_px &&
            (!found || run.used < best->used ||
             (run.used == best->used && run.height_px < best->height_px))) {
            *best = run;
            found = true;
        }
    }
    return found;
}

/* Empties the run's shelves and puts one of that height in their place, and another for the
 * rest. *status: no memory. */
static int run_take(struct font_atlas *a, const struct run *run, int height_px,
                    enum font_status *status)
{
    enum { REST_MIN = 8 };
    int rest = run->height_px - height_px, kept = 0;
    if (!array_reserve(&a->shelves, &a->shelves_capacity, a->shelves_count + 2,
                       sizeof *a->shelves)) {
        *status = font_fail(FONT_NO_MEMORY, "no memory for an atlas");
        return -1;
    }
    for (int i = 0; i < a->shelves_count; i++) {
        struct shelf *s = &a->shelves[i];
        if (s->page == run->page && s->y >= run->y && s->y < run->y + run->height_px) {
            shelf_empty(a, s);
            a->stats.shelves_emptied++;
        } else {
            a->shelves[kept++] = *s;
        }
    }
    if (rest < REST_MIN) {
        height_px = run->height_px;
        rest = 0;
    }
    if (rest)
        a->shelves[kept++] =
            (struct shelf){.page = run->page, .y = run->y + height_px, .height_px = rest};
    a->shelves[kept++] = (struct shelf){.page = run->page, .y = run->y, .height_px = height_px};
    a->shelves_count = kept;
    struct page *p = &a->pages[run->page];
    if (p->end_y < run->y + run->height_px)
        p->end_y = run->y + run->height_px;
    /* Where shelves begin and end has changed: what was there must not show in the gaps between
     * them. */
    memset(p->pixels + (size_t)run->y * (size_t)a->def.width_px, 0,
           (size_t)run->height_px * (size_t)a->def.width_px);
    dirty_add(p, 0, run->y, a->def.width_px, run->height_px);
    return kept - 1;
}

/* A shelf with room for so much; -1, and *status why. */
static int shelf_for(struct font_atlas *a, int width_px, int height_px,
                     enum font_status *status)
{
    int rounded = (height_px + STEP - 1) / STEP * STEP;
    if (rounded > a->def.height_px)
        rounded = height_px;
    *status = FONT_OK;
    if (width_px > a->def.width_px || height_px > a->def.height_px) {
        *status =
            font_fail(FONT_TOO_LARGE, "a glyph of %dx%d pixels does not fit a page of %dx%d",
                      width_px, height_px, a->def.width_px, a->def.height_px);
        return -1;
    }
    int shelf = shelf_find(a, width_px, height_px);
    if (shelf < 0)
        shelf = shelf_cut(a, rounded, status);
    struct run run = {0};
    if (shelf < 0 && *status == FONT_OK && run_find(a, rounded, &run))
        shelf = run_take(a, &run, rounded, status);
    if (shelf < 0 && *status == FONT_OK)
        *status = font_fail(FONT_FULL, "the atlas is full of glyphs in use; draw them first");
    return shelf;
}

/* ---- glyphs ---- */

/* The picture and the gap right of it and below; the rest of an emptied shelf may hold
 * anything. */
static void pixels_put(struct font_atlas *a, const struct font_gray *g, const struct shelf *s)
{
    struct page *p = &a->pages[s->page];
    size_t pitch = (size_t)a->def.width_px;
    int across = g->width_px + GAP, down = s->height_px;
    if (s->end_x + across > a->def.width_px)
        across = a->def.width_px - s->end_x;
    for (int r = 0; r < down; r++) {
        uint8_t *to = p->pixels + (size_t)(s->y + r) * pitch + s->end_x;
        memset(to, 0, (size_t)across);
        if (r < g->height_px)
            memcpy(to, g->pixels + (size_t)r * (size_t)g->pitch, (size_t)g->width_px);
    }
    dirty_add(p, s->end_x, s->y, across, down);
}

static struct entry *entry_find(const struct font_atlas *a, const struct key *key)
{
    for (struct entry *e = a->buckets[bucket_of(key)]; e; e = e->next)
        if (memcmp(&e->key, key, sizeof *key) == 0)
            return e;
    return NULL;
}

/* Draws a glyph that the atlas does not hold yet. *out: NULL if it has no ink and there is no
 * shelf to keep it on. */
static enum font_status entry_make(struct font_atlas *a, const struct key *key,
                                   const struct font_gray *gray, struct entry **out)
{
    enum font_status status = FONT_OK;
    *out = NULL;
    int shelf = a->shelves_count - 1; /* an empty one takes no room: it goes with that shelf */
    if (gray->width_px)
        shelf = shelf_for(a, gray->width_px + GAP, gray->height_px + GAP, &status);
    if (shelf < 0)
        return status;
    struct entry *e = calloc(1, sizeof *e);
    if (!e)
        return font_fail(FONT_NO_MEMORY, "no memory for a glyph");
    struct shelf *s = &a->shelves[shelf];
    e->key = *key;
    e->slot = (struct font_atlas_slot){
        s->page, s->end_x, s->y, gray->width_px, gray->height_px, gray->left_px, gray->top_px};
    e->on_shelf = s->entries;
    s->entries = e;
    struct entry **bucket = &a->buckets[bucket_of(key)];
    e->next = *bucket;
    *bucket = e;
    if (gray->width_px) {
        pixels_put(a, gray, s);
        s->end_x += gray->width_px + GAP;
    }
    s->used = a->now;
    a->stats.glyphs_count++;
    *out = e;
    return FONT_OK;
}

/* The shelf that a slot stands on is in use. */
static void slot_use(struct font_atlas *a, const struct font_atlas_slot *slot)
{
    for (int i = 0; i < a->shelves_count; i++)
        if (a->shelves[i].page == slot->page && a->shelves[i].y == slot->y) {
            a->shelves[i].used = a->now;
            return;
        }
}

enum font_status font_atlas_get(struct font_atlas *a, struct font_face *face, uint32_t glyph,
                                double size_px, const struct font_map *map, double x_px,
                                double y_px, struct font_atlas_slot *out)
{
    *out = (struct font_atlas_slot){0};
    if (!(fabs(x_px) < 1e6 && fabs(y_px) < 1e6))
        return font_fail(FONT_BAD_ARGUMENT, "a glyph cannot be at (%g, %g)", x_px, y_px);
    bool affine = !map || map->kind == FONT_AFFINE;
    if (!affine && (x_px != 0 || y_px != 0))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a distorted glyph's place is in its map: it cannot be at (%g, %g)",
                         x_px, y_px);
    int step_x = (int)floor(x_px * a->def.places_x + 0.5);
    int step_y = (int)floor(y_px * a->def.places_y + 0.5);
    int whole_x = (int)floor((double)step_x / a->def.places_x);
    int whole_y = (int)floor((double)step_y / a->def.places_y);
    struct key key;
    memset(&key, 0, sizeof key);
    key.version = font_face_version(face);
    key.glyph = glyph;
    key.size_px = size_px;
    key.kind = map ? (int32_t)map->kind : FONT_AFFINE;
    if (!affine) {
        memcpy(key.map, map->m, sizeof key.map);
    } else { /* its place is not of the picture */
        key.map[0] = map ? map->m[0] : 1;
        key.map[1] = map ? map->m[1] : 0;
        key.map[2] = map ? map->m[3] : 0;
        key.map[3] = map ? map->m[4] : 1;
    }
    key.place_x = step_x - whole_x * a->def.places_x;
    key.place_y = step_y - whole_y * a->def.places_y;
    a->now++;
    struct entry *e = entry_find(a, &key), empty = {0};
    if (e) {
        a->stats.hits++;
        slot_use(a, &e->slot);
    } else {
        const struct font_gray *gray;
        enum font_status status = font_painter_glyph(
            a->painter, face, glyph, size_px, map, (double)key.place_x / a->def.places_x,
            (double)key.place_y / a->def.places_y, &gray);
        if (status == FONT_OK)
            status = entry_make(a, &key, gray, &e);
        if (status != FONT_OK)
            return status;
        a->stats.drawn++;
        e = e ? e : &empty;
    }
    *out = e->slot;
    out->left_px += whole_x;
    out->top_px += whole_y;
    return FONT_OK;
}

enum font_status font_atlas_layout(struct font_atlas *a, const struct font_layout *layout,
                                   const struct font_map *map, double x_px, double y_px,
                                   struct font_quad *quads, int quads_max, int *first,
                                   int *count)
{
    float u = 1 / (float)a->def.width_px, v = 1 / (float)a->def.height_px;
    *count = 0;
    for (; *first < layout->glyphs_count && *count < quads_max; ++*first) {
        const struct font_placed *g = &layout->glyphs[*first];
        struct font_atlas_slot slot;
        struct font_map whole;
        double x, y;
        enum font_status status =
            font_placed_map(layout, *first, map, x_px, y_px, &whole, &x, &y);
        if (status == FONT_OK && whole.kind != FONT_AFFINE) { /* the place goes into the map */
            struct font_map move = {FONT_AFFINE, {1, 0, x, 0, 1, y}};
            whole = font_map_then(whole, move);
            x = y = 0;
        }
        if (status == FONT_OK)
            status = font_atlas_get(a, g->face, g->glyph, font_placed_size(layout, g), &whole,
                                    x, y, &slot);
        if (status != FONT_OK)
            return status;
        if (!slot.width_px)
            continue;
        quads[(*count)++] = (struct font_quad){.x0 = (float)slot.left_px,
                                               .y0 = (float)slot.top_px,
                                               .x1 = (float)(slot.left_px + slot.width_px),
                                               .y1 = (float)(slot.top_px + slot.height_px),
                                               .u0 = (float)slot.x * u,
                                               .v0 = (float)slot.y * v,
                                               .u1 = (float)(slot.x + slot.width_px) * u,
                                               .v1 = (float)(slot.y + slot.height_px) * v,
                                               .page = slot.page,
                                               .ink = g->ink};
    }
    return FONT_OK;
}

void font_atlas_stats_get(const struct font_atlas *a, struct font_atlas_stats *out)
{
    *out = a->stats;
    out->shelves_count = a->shelves_count;
}
