/* tiles.c - copies of a sheet's planes in tiles.
 *
 * A copy is a table of tiles, plane by plane. Copies share tiles; a tile of zeros is NULL. The
 * sheet knows which fibers may have changed since the last copy (unkept, areas.c). So the next
 * one takes over all other tiles from the last.
 */
#include "history/tiles.h"

#include "model/model.h"

#include <stdlib.h>
#include <string.h>

/* A sheet has some sixteen tiles along its longer side, as far as tiles may be so large. */
enum { TILE_LEAST = 8, TILE_MOST = 128, TILES_ALONG = 16 };

struct tile {
    int users;
    uint32_t words[]; /* side * side */
};

struct planes_copy {
    int users;
    int width, height; /* of a plane, in fibers */
    int side;          /* of a tile, in fibers */
    int across, down;  /* in tiles */
    int planes;
    struct tile *tiles[];
};

/* Tiles of a plane, from `left`, `top` on. */
struct run {
    int left, top, across, down;
};

static const uint32_t zeros[TILE_MOST * TILE_MOST];

static size_t tiles_of(const struct planes_copy *c)
{
    return (size_t)c->planes * (size_t)c->across * (size_t)c->down;
}

static double table_bytes(const struct planes_copy *c)
{
    return (double)(sizeof *c + tiles_of(c) * sizeof *c->tiles);
}

static size_t tile_words(const struct planes_copy *c)
{
    return (size_t)c->side * (size_t)c->side;
}

static size_t tile_bytes(int side)
{
    return sizeof(struct tile) + (size_t)side * (size_t)side * sizeof(uint32_t);
}

static int side_of(int width, int height)
{
    const int longer = width > height ? width : height;
    int side = TILE_MOST;
    while (side > TILE_LEAST && side * TILES_ALONG > longer)
        side /= 2;
    return side;
}

static int planes_count(const struct paper_sheet *p)
{
    struct paper_plane planes[PAPER_PLANES_MAX];
    return paper_sheet_planes(p, planes);
}

/* ---- a copy's life ---- */

struct planes_copy *planes_copy_new(const struct paper_sheet *p, double *held)
{
    const int width = p->page.grid.width, height = p->page.grid.height,
              side = side_of(width, height), across = (width + side - 1) / side,
              down = (height + side - 1) / side, planes = planes_count(p);
    struct planes_copy *c = calloc(1, sizeof *c + (size_t)planes * (size_t)across *
                                                      (size_t)down * sizeof *c->tiles);
    if (!c)
        return NULL;
    c->users = 1;
    c->width = width;
    c->height = height;
    c->side = side;
    c->across = across;
    c->down = down;
    c->planes = planes;
    *held += table_bytes(c);
    return c;
}

struct planes_copy *planes_copy_share(struct planes_copy *copy)
{
    if (copy)
        copy->users++;
    return copy;
}

void planes_copy_drop(struct planes_copy *copy, double *held)
{
    if (!copy || --copy->users > 0)
        return;
    for (size_t i = 0; i < tiles_of(copy); i++)
        if (copy->tiles[i] && --copy->tiles[i]->users == 0) {
            free(copy->tiles[i]);
            *held -= (double)tile_bytes(copy->side);
        }
    *held -= table_bytes(copy);
    free(copy);
}

static struct tile **tile_at(struct planes_copy *c, int plane, int x, int y)
{
    return &c->tiles[((size_t)plane * (size_t)c->down + (size_t)y) * (size_t)c->across +
                     (size_t)x];
}

static struct tile *tile_of(const struct planes_copy *c, int plane, int x, int y)
{
    return c
        ->tiles[((size_t)plane * (size_t)c->down + (size_t)y) * (size_t)c->across + (size_t)x];
}

static struct tile *tile_share(struct tile *tile)
{
    if (tile)
        tile->users++;
    return tile;
}

/* Where a run of tiles is on the sheet. */
static struct paper_area run_area(const struct planes_copy *c, const struct run *r)
{
    const int x = r->left * c->side, y = r->top * c->side,
              right = (r->left + r->across) * c->side, bottom = (r->top + r->down) * c->side;
    return (struct paper_area){x, y, (right < c->width ? right : c->width) - x,
                               (bottom < c->height ? bottom : c->height) - y};
}

/* ---- which tiles ---- */

/* Tiles in which fibers may have changed since the last copy; without one: all. Shape: the
 * copy's. How many. */
static int marks_find(const struct paper_sheet *p, const struct planes_copy *known, int side,
                      int across, int down, bool *marks)
{
    int count = 0;
    memset(marks, !known, (size_t)across * (size_t)down);
    for (int i = 0; known && i < p->unkept.count; i++) {
        const struct paper_area *a = &p->unkept.at[i];
        const int left = a->x / side, right = (a->x + a->width - 1) / side;
        for (int y = a->y / side; y <= (a->y + a->height - 1) / side; y++)
            memset(marks + (size_t)y * (size_t)across + left, true, (size_t)(right - left + 1));
    }
    for (int i = 0; i < across * down; i++)
        count += marks[i];
    return count;
}

static bool row_marked(const bool *marks, const struct run *r, int across, int y)
{
    for (int x = r->left; x < r->left + r->across; x++)
        if (!marks[(size_t)y * (size_t)across + (size_t)x])
            return false;
    return true;
}

/* The first marked tiles that are a rectangle, whose marks are taken away. False: none is. */
static bool run_take(bool *marks, int across, int down, struct run *r)
{
    const bool *first = memchr(marks, true, (size_t)across * (size_t)down);
    if (!first)
        return false;
    *r = (struct run){(int)((first - marks) % across), (int)((first - marks) / across), 0, 1};
    while (r->left + r->across < across && first[r->across])
        r->across++;
    while (r->top + r->down < down && row_marked(marks, r, across, r->top + r->down))
        r->down++;
    for (int y = r->top; y < r->top + r->down; y++)
        memset(marks + (size_t)y * (size_t)across + r->left, false, (size_t)r->across);
    return true;
}

/* ---- taking ---- */

/* One tile's place in a run. */
struct spot {
    int left, top, width, height; /* in the run, in fibers */
};
static struct spot spot_of(const struct planes_copy *c, const struct paper_area *run, int x,
                           int y)
{
    const int left = x * c->side, top = y * c->side;
    return (struct spot){left, top, run->width - left < c->side ? run->width - left : c->side,
                         run->height - top < c->side ? run->height - top : c->side};
}

/* Copies the words of a run that are a tile's; what is off the sheet is 0. */
static void tile_fill(const struct planes_copy *c, struct tile *tile, const uint32_t *words,
                      const struct paper_area *run, const struct spot *at)
{
    if (at->width < c->side || at->height < c->side)
        memset(tile->words, 0, tile_words(c) * sizeof *tile->words);
    for (int y = 0; y < at->height; y++)
        memcpy(tile->words + (size_t)y * (size_t)c->side,
               words + (size_t)(at->top + y) * (size_t)run->width + at->left,
               (size_t)at->width * sizeof *words);
}

/* The tile that has these words: none for zeros, the known one, or the spare one itself. */
static struct tile *tile_choose(const struct planes_copy *c, struct tile *spare,
                                struct tile *known)
{
    const size_t bytes = tile_words(c) * sizeof *spare->words;
    if (memcmp(spare->words, zeros, bytes) == 0)
        return NULL;
    return tile_share(known && memcmp(spare->words, known->words, bytes) == 0 ? known : spare);
}

/* The tiles of a run from its words, which lie side by side. False: no memory. */
static bool run_put(struct planes_copy *c, const struct planes_copy *known, int plane,
                    const struct run *r, const uint32_t *words, double *held)
{
    const struct paper_area area = run_area(c, r);
    struct tile *spare = NULL;
    bool good = true;
    for (int i = 0; good && i < r->across * r->down; i++) {
        const int x = i % r->across, y = i / r->across;
        const struct spot at = spot_of(c, &area, x, y);
        if (!spare && !(spare = malloc(tile_bytes(c->side)))) {
            good = false;
            break;
        }
        spare->users = 0;
        tile_fill(c, spare, words, &area, &at);
        struct tile *before = known ? tile_of(known, plane, r->left + x, r->top + y) : NULL;
        struct tile *tile = tile_choose(c, spare, before);
        *tile_at(c, plane, r->left + x, r->top + y) = tile;
        if (tile == spare) {
            *held += (double)tile_bytes(c->side);
            spare = NULL;
        }
    }
    free(spare);
    return good;
}

bool planes_copy_put(struct planes_copy *copy, int plane, const uint32_t *words, double *held)
{
    const struct run all = {0, 0, copy->across, copy->down};
    return run_put(copy, NULL, plane, &all, words, held);
}

double planes_copy_bytes(const struct paper_sheet *p, const struct planes_copy *known)
{
    const int side = side_of(p->page.grid.width, p->page.grid.height),
              across = (p->page.grid.width + side - 1) / side,
              down = (p->page.grid.height + side - 1) / side, all = across * down;
    bool *marks = malloc((size_t)all);
    const int count = marks ? marks_find(p, known, side, across, down, marks) : all;
    free(marks);
    return planes_count(p) *
           (count * (double)tile_bytes(side) + all * (double)sizeof(struct tile *));
}

/* A run of each plane, read and put into the copy. */
static bool run_copy(struct paper_sheet *p, struct planes_copy *c,
                     const struct planes_copy *known, const struct run *r, uint32_t *words,
                     double *held)
{
    const struct paper_area area = run_area(c, r);
    for (int i = 0; i < c->planes; i++)
        if (sheet_plane_part_fetch(p, i, &area, words) != PAPER_OK ||
            !run_put(c, known, i, r, words, held))
            return false;
    return true;
}

struct planes_copy *planes_copy_take(struct paper_sheet *p, const struct planes_copy *known,
                                     double *held)
{
    struct planes_copy *c = planes_copy_new(p, held);
    if (!c)
        return NULL;
    const size_t of_plane = (size_t)c->across * (size_t)c->down;
    bool *marks = malloc(of_plane), good = marks != NULL;
    uint32_t *words = NULL;
    struct run r;
    if (good)
        marks_find(p, known, c->side, c->across, c->down, marks);
    for (size_t i = 0; good && i < tiles_of(c); i++)
        if (!marks[i % of_plane])
            c->tiles[i] = tile_share(known->tiles[i]);
    while (good && run_take(marks, c->across, c->down, &r)) {
        const struct paper_area area = run_area(c, &r);
        free(words);
        words = malloc((size_t)area.width * (size_t)area.height * sizeof *words);
        good = words && run_copy(p, c, known, &r, words, held);
    }
    free(words);
    free(marks);
    if (good)
        p->unkept.count = 0;
    else
        planes_copy_drop(c, held);
    return good ? c : NULL;
}

/* ---- giving back ---- */

/* The words of a run of tiles, side by side. */
static void run_get(const struct planes_copy *c, int plane, const struct run *r,
                    uint32_t *words)
{
    const struct paper_area area = run_area(c, r);
    for (int i = 0; i < r->across * r->down; i++) {
        const int x = i % r->across, y = i / r->across;
        const struct tile *tile = tile_of(c, plane, r->left + x, r->top + y);
        const struct spot at = spot_of(c, &area, x, y);
        for (int row = 0; row < at.height; row++)
            memcpy(words + (size_t)(at.top + row) * (size_t)area.width + at.left,
                   (tile ? tile->words : zeros) + (size_t)row * (size_t)c->side,
                   (size_t)at.width * sizeof *words);
    }
}

/* Writes what differs of a plane. *written: whether something did. */
static enum paper_status plane_restore(struct paper_sheet *p, const struct planes_copy *c,
                                       int plane, bool *marks, bool *written)
{
    struct run r;
    *written = false;
    while (run_take(marks, c->across, c->down, &r)) {
        const struct paper_area area = run_area(c, &r);
        uint32_t *words = malloc((size_t)area.width * (size_t)area.height * sizeof *words);
        if (!words)
            return paper_fail(PAPER_NO_MEMORY, "no memory for %dx%d fibers of a sheet",
                              area.width, area.height);
        run_get(c, plane, &r, words);
        sheet_plane_part_write(p, plane, &area, words);
        sheet_area_change(p, area.x, area.y, area.width, area.height);
        free(words);
        *written = true;
    }
    return PAPER_OK;
}

enum paper_status planes_copy_restore(struct paper_sheet *p, const struct planes_copy *copy,
                                      const struct planes_copy *known)
{
    const size_t of_plane = (size_t)copy->across * (size_t)copy->down;
    bool *marks = malloc(2 * of_plane), *own = marks + of_plane, follows = false;
    if (!marks)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet of %dx%d", copy->width,
                          copy->height);
    enum paper_status status = PAPER_OK;
    marks_find(p, known, copy->side, copy->across, copy->down, marks);
    sheet_parts_forget(p);
    for (int i = 0; i < copy->planes && status == PAPER_OK; i++) {
        const size_t first = (size_t)i * of_plane;
        bool written;
        for (size_t k = 0; k < of_plane; k++)
            own[k] = marks[k] || (known && copy->tiles[first + k] != known->tiles[first + k]);
        status = plane_restore(p, copy, i, own, &written);
        follows |= written && sheet_plane_is_followed(p, i);
    }
    free(marks);
    if (status == PAPER_OK && follows)
        sheet_planes_written(p);
    if (follows)
        sheet_area_mark_all(p);
    const enum paper_status left = paper_leave(&p->page);
    status = status == PAPER_OK ? left : status;
    if (status == PAPER_OK)
        p->unkept.count = 0;
    else
        sheet_area_mark_all(p);
    return status;
}
