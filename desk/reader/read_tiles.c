/* read_tiles.c - the page's pictures: each passage in tiles of some hundred rows, painted once
 * by fontpipe and kept as textures, so that scrolling moves what stays and paints what comes
 * in. */
#include "read_desk.h"

#include <math.h>
#include <paint.h>
#include <string.h>

enum { ROWS = 256, KEPT = 192, KEPT_BYTES = 96 << 20 };

struct tile {
    int passage, row, width, scale;
    unsigned long version;
    guint marks; /* a hash of the marks in its passage */
    guint64 used;
    GdkTexture *texture; /* NULL: there is no tile */
};

struct read_tiles {
    struct tile tiles[KEPT];
    struct font_painter *painter;
    guint64 turn;
    long painted;
};

struct read_tiles *read_tiles_create(void)
{
    return g_new0(struct read_tiles, 1);
}

void read_tiles_forget(struct read_tiles *tiles)
{
    for (int i = 0; i < KEPT; i++)
        g_clear_object(&tiles->tiles[i].texture);
    font_painter_destroy(tiles->painter);
    tiles->painter = NULL;
}

void read_tiles_destroy(struct read_tiles *tiles)
{
    if (tiles)
        read_tiles_forget(tiles);
    g_free(tiles);
}

long read_tiles_painted(const struct read_tiles *tiles)
{
    return tiles->painted;
}

/* ---- painting ---- */

static void box_fill(uint8_t *pixels, int width, int height, double x0, double y0, double x1,
                     double y1, const double rgb[3])
{
    const int left = (int)fmax(0, floor(x0)), right = (int)fmin(width, ceil(x1)),
              top = (int)fmax(0, round(y0)), bottom = (int)fmin(height, round(y1));
    uint8_t colour[3];
    for (int c = 0; c < 3; c++)
        colour[c] = (uint8_t)lrint(255 * rgb[c]);
    for (int y = top; y < bottom; y++)
        for (int x = left; x < right; x++)
            memcpy(pixels + 3 * ((size_t)y * (size_t)width + (size_t)x), colour, 3);
}

static bool painter_make(struct read_desk *d)
{
    struct font_painter_def def = font_painter_def_default();
    memcpy(def.ink, d->colours->ink, sizeof def.ink);
    def.darken_px =
        d->dark ? 0 : FONT_DARKEN_BY_STEM; /* light letters look heavy as they are */
    return d->tiles->painter || font_painter_create(&def, &d->tiles->painter) == FONT_OK;
}

/* What is to be painted: rows from_px on of the passage, in pixels of the screen. */
struct work {
    const struct reader_shown *shown;
    const struct read_mark *marks;
    int marks_count, width, height, from, scale;
};

static void marks_fill(const struct work *w, uint8_t *pixels)
{
    for (int i = 0; i < w->marks_count; i++) {
        const struct reader_box *b = &w->marks[i].box;
        const double y = b->y - w->shown->y_px;
        if (b->passage == w->shown->passage)
            box_fill(pixels, w->width, w->height, w->scale * b->x, w->scale * y - w->from,
                     w->scale * (b->x + b->width), w->scale * (y + b->height) - w->from,
                     w->marks[i].rgb);
    }
}

static GdkTexture *tile_paint(struct read_desk *d, const struct work *w)
{
    const size_t bytes = 3 * (size_t)w->width * (size_t)w->height;
    uint8_t *pixels = g_malloc(bytes);
    struct font_picture picture = {w->width, w->height, 3 * w->width, pixels};
    const double s = w->scale;
    const struct font_map map = {FONT_AFFINE, {s, 0, 0, 0, s, 0}};
    struct font_layout layout;
    box_fill(pixels, w->width, w->height, 0, 0, w->width, w->height, d->colours->paper);
    marks_fill(w, pixels);
    if (reader_view_layout(d->view, w->shown->passage, &layout) == READER_OK &&
        painter_make(d) &&
        font_painter_layout(d->tiles->painter, &layout, w->scale > 1 ? &map : NULL, 0,
                            s * w->shown->text_px - w->from, &picture) != FONT_OK)
        d->say(d, font_error());
    font_layout_finish(&layout);
    GBytes *all = g_bytes_new_take(pixels, bytes);
    GdkTexture *texture = gdk_memory_texture_new(w->width, w->height, GDK_MEMORY_R8G8B8, all,
                                                 3 * (gsize)w->width);
    g_bytes_unref(all);
    d->tiles->painted++;
    return texture;
}

/* ---- keeping ---- */

static guint marks_hash(const struct read_mark *marks, int count,
                        const struct reader_shown *shown)
{
    guint hash = 5381;
    for (int i = 0; i < count; i++) {
        const struct reader_box *b = &marks[i].box;
        if (b->passage != shown->passage)
            continue;
        const int numbers[] = {(int)(8 * b->x),
                               (int)(8 * (b->y - shown->y_px)),
                               (int)(8 * b->width),
                               (int)(8 * b->height),
                               (int)(255 * marks[i].rgb[0]),
                               (int)(255 * marks[i].rgb[2])};
        for (size_t k = 0; k < G_N_ELEMENTS(numbers); k++)
            hash = hash * 33 ^ (guint)numbers[k];
    }
    return hash;
}

static size_t tile_bytes(const struct tile *t)
{
    return t->texture ? 3 * (size_t)t->width * (size_t)gdk_texture_get_height(t->texture) : 0;
}

/* Those that were not drawn for longest go, until what is kept is within its bounds. */
static void tiles_thin(struct read_tiles *tiles)
{
    size_t bytes = 0;
    for (int i = 0; i < KEPT; i++)
        bytes += tile_bytes(&tiles->tiles[i]);
    while (bytes > KEPT_BYTES) {
        struct tile *oldest = NULL;
        for (int i = 0; i < KEPT; i++)
            if (tiles->tiles[i].texture && (!oldest || tiles->tiles[i].used < oldest->used))
                oldest = &tiles->tiles[i];
        if (!oldest || oldest->used == tiles->turn)
            return;
        bytes -= tile_bytes(oldest);
        g_clear_object(&oldest->texture);
    }
}

/* The tile, painted if it is not kept. */
static GdkTexture *tile_get(struct read_desk *d, const struct work *w, guint marks)
{
    struct tile *oldest = &d->tiles->tiles[0];
    const int row = w->from / ROWS;
    for (int i = 0; i < KEPT; i++) {
        struct tile *t = &d->tiles->tiles[i];
        if (t->texture && t->passage == w->shown->passage && t->row == row &&
            t->version == w->shown->version && t->width == w->width && t->scale == w->scale &&
            t->marks == marks && gdk_texture_get_height(t->texture) == w->height) {
            t->used = d->tiles->turn;
            return t->texture;
        }
        if (oldest->texture && (!t->texture || t->used < oldest->used))
            oldest = t;
    }
    g_clear_object(&oldest->texture);
    *oldest = (struct tile){.passage = w->shown->passage,
                            .row = row,
                            .width = w->width,
                            .scale = w->scale,
                            .version = w->shown->version,
                            .marks = marks,
                            .used = d->tiles->turn,
                            .texture = tile_paint(d, w)};
    return oldest->texture;
}

void read_tiles_draw(struct read_desk *d, GtkSnapshot *snapshot,
                     const struct reader_shown *shown, int count, const struct read_mark *marks,
                     int marks_count, int scale)
{
    const int width = scale * (int)d->setup.width_px;
    d->tiles->turn++;
    for (int i = 0; i < count; i++) {
        const struct reader_shown *s = &shown[i];
        const int high = scale * (int)s->height_px;
        const guint hash = marks_hash(marks, marks_count, s);
        for (int from = 0; from < high; from += ROWS) {
            const int rows = MIN(ROWS, high - from);
            const double y = s->y_px + (double)from / scale;
            if (y >= d->setup.height_px || y + (double)rows / scale <= 0)
                continue;
            const struct work work = {s, marks, marks_count, width, rows, from, scale};
            GdkTexture *texture = tile_get(d, &work, hash);
            gtk_snapshot_append_texture(snapshot, texture,
                                        &GRAPHENE_RECT_INIT(0, (float)y,
                                                            (float)width / (float)scale,
                                                            (float)rows / (float)scale));
        }
    }
    tiles_thin(d->tiles);
}
