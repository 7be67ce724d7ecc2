/* areas.c - where the picture of a sheet has changed since somebody asked, and where its planes
 * have since they were copied: a few rectangles. Where there would be more than there is room
 * for, those two become one that lose least by it. */
#include "model/model.h"

static struct paper_area joined(const struct paper_area *a, const struct paper_area *b)
{
    const int x = a->x < b->x ? a->x : b->x, y = a->y < b->y ? a->y : b->y,
              right = a->x + a->width > b->x + b->width ? a->x + a->width : b->x + b->width,
              bottom =
                  a->y + a->height > b->y + b->height ? a->y + a->height : b->y + b->height;
    return (struct paper_area){x, y, right - x, bottom - y};
}

static double size_of(const struct paper_area *a)
{
    return (double)a->width * a->height;
}

/* Whether b lies within a. */
static bool holds(const struct paper_area *a, const struct paper_area *b)
{
    return b->x >= a->x && b->y >= a->y && b->x + b->width <= a->x + a->width &&
           b->y + b->height <= a->y + a->height;
}

/* The one that grows least when the area is joined to it. */
static int nearest(const struct sheet_areas *all, const struct paper_area *area)
{
    int best = 0;
    double least = 0;
    for (int i = 0; i < all->count; i++) {
        const struct paper_area both = joined(&all->at[i], area);
        const double grown = size_of(&both) - size_of(&all->at[i]);
        if (i == 0 || grown < least) {
            best = i;
            least = grown;
        }
    }
    return best;
}

static void add(struct sheet_areas *all, struct paper_area area)
{
    for (int i = 0; i < all->count; i++)
        if (holds(&all->at[i], &area))
            return;
    if (all->count == PAPER_AREAS_MAX)
        area = joined(&all->at[nearest(all, &area)], &area);
    for (int i = all->count - 1; i >= 0; i--)
        if (holds(&area, &all->at[i]))
            all->at[i] = all->at[--all->count];
    all->at[all->count++] = area;
}

void sheet_area_mark_all(struct paper_sheet *p)
{
    p->changed = (struct sheet_areas){1, {{0, 0, p->page.grid.width, p->page.grid.height}}};
    p->unkept = p->changed;
}

/* A stretch of an axis of the torus, as one or two of the sheet; returns how many. */
static int stretches(int from, int length, int all, int out[2][2])
{
    if (length >= all) {
        out[0][0] = 0;
        out[0][1] = all;
        return 1;
    }
    from = (from % all + all) % all;
    out[0][0] = from;
    out[0][1] = from + length <= all ? length : all - from;
    out[1][0] = 0;
    out[1][1] = length - out[0][1];
    return out[1][1] > 0 ? 2 : 1;
}

/* Adds fibers of the torus. */
static void add_around(struct paper_sheet *p, struct sheet_areas *all, int x, int y, int width,
                       int height)
{
    int columns[2][2], rows[2][2];
    if (width < 1 || height < 1)
        return;
    const int across = stretches(x, width, p->page.grid.width, columns),
              down = stretches(y, height, p->page.grid.height, rows);
    for (int i = 0; i < down; i++)
        for (int j = 0; j < across; j++)
            add(all, (struct paper_area){columns[j][0], rows[i][0], columns[j][1], rows[i][1]});
}

void sheet_area_mark(struct paper_sheet *p, int x, int y, int width, int height)
{
    add_around(p, &p->changed, x, y, width, height);
}

void sheet_area_touch(struct paper_sheet *p, int x, int y, int width, int height)
{
    add_around(p, &p->unkept, x, y, width, height);
}

/* Cuts from..from + length - 1 to 0..all - 1. */
static void clip(int *from, int *length, int all)
{
    const int64_t end = (int64_t)*from + *length;
    *from = *from > 0 ? *from : 0;
    *length = (int)((end < all ? end : all) - *from);
}

void sheet_area_change(struct paper_sheet *p, int x, int y, int width, int height)
{
    clip(&x, &width, p->page.grid.width);
    clip(&y, &height, p->page.grid.height);
    if (width < 1 || height < 1)
        return;
    sheet_area_touch(p, x, y, width, height);
    sheet_area_mark(p, x - SHEET_LOOK_REACH, y - SHEET_LOOK_REACH, width + 2 * SHEET_LOOK_REACH,
                    height + 2 * SHEET_LOOK_REACH);
}
