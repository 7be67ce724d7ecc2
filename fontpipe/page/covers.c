/* covers.c - what of a frame's lines what stands beside them takes: see page_internal.h. */
#include "page_internal.h"

#include <math.h>
#include <stdlib.h>

/* ---- what lines keep away from ---- */

/* What rows cover between two heights, from their box's edge. */
static bool rows_cover(const struct cover *c, double v0, double v1, double *a, double *b)
{
    const double last = c->rows_count - 1, from = floor((v0 - c->rows_v) / c->row_v),
                 to = ceil((v1 - c->rows_v) / c->row_v) - 1;
    bool any = false;
    if (to < 0 || from > last)
        return false;
    for (int i = (int)fmax(0, from); i <= (int)fmin(last, to); i++) {
        const struct page_row *r = &c->rows[i];
        if (!(r->to_px > r->from_px))
            continue;
        *a = any ? fmin(*a, r->from_px) : r->from_px;
        *b = any ? fmax(*b, r->to_px) : r->to_px;
        any = true;
    }
    return any;
}

bool cover_takes(const struct cover *c, double v, double height, double *a, double *b)
{
    const double near = 1e-6;
    *a = 0;
    *b = c->width;
    if (c->rows_count ? !rows_cover(c, v - c->gap, v + height + c->gap, a, b)
                      : v >= c->v1 - near || v + height <= c->v0 + near)
        return false;
    *a += c->u - c->gap;
    *b += c->u + c->gap;
    return true;
}

double covers_end(const struct covers *c)
{
    double end = 0;
    for (int i = 0; i < c->count; i++)
        end = fmax(end, c->items[i].v1);
    return end;
}

double covers_side_end(const struct covers *c, enum page_side side)
{
    double end = 0;
    for (int i = 0; i < c->count; i++)
        if (c->items[i].side == (int)side)
            end = fmax(end, c->items[i].v1);
    return end;
}

double covers_room(const struct covers *c, enum page_side side, double v, double width,
                   double measure, double least)
{
    const enum page_side other = side == PAGE_SIDE_LEFT ? PAGE_SIDE_RIGHT : PAGE_SIDE_LEFT;
    v = fmax(v, covers_side_end(c, side));
    for (int i = 0; i < c->count; i++) {
        const struct cover *own = &c->items[i];
        const bool ends_above = own->v1 <= v;
        if (own->side == (int)side || ends_above)
            continue;
        /* an obstacle may be anywhere: it stands above */
        if (own->side != (int)other || own->width + width + 3 * own->gap + least > measure)
            v = own->v1;
    }
    return v;
}

static struct cover *cover_new(struct covers *c)
{
    return array_reserve(&c->items, &c->capacity, c->count + 1, sizeof *c->items)
               ? &c->items[c->count++]
               : NULL;
}

bool covers_beside_add(struct covers *c, const struct page_beside *b,
                       const struct page_manner *manner, double measure, double v,
                       double height)
{
    struct cover *own = cover_new(c);
    const double lines = height - manner->before_px - manner->after_px;
    if (!own)
        return false;
    *own = (struct cover){.u = b->side == PAGE_SIDE_LEFT ? 0 : measure - b->width_px,
                          .width = b->width_px,
                          .v0 = v,
                          .v1 = v + height,
                          .rows_v = v + manner->before_px,
                          .row_v = b->rows_count ? fmax(lines, 1e-3) / b->rows_count : 0,
                          .rows = b->rows,
                          .rows_count = b->rows_count,
                          .side = (int)b->side,
                          .gap = b->gap_px,
                          .least = b->least_px};
    return true;
}

bool covers_obstacles_add(struct covers *c, const struct paragraph *p, double v)
{
    for (int i = 0; i < p->obstacles_count; i++) {
        const struct page_obstacle *o = &p->obstacles[i];
        struct cover *own = cover_new(c);
        if (!own)
            return false;
        *own = (struct cover){.u = o->x_px,
                              .v0 = v + o->y_px,
                              .v1 = v + o->y_px + o->height_px,
                              .rows_v = v + o->y_px,
                              .row_v = o->height_px / o->rows_count,
                              .rows = o->rows,
                              .rows_count = o->rows_count,
                              .side = -1,
                              .gap = o->gap_px,
                              .least = o->least_px};
    }
    return true;
}

/* ---- as it is kept with a paragraph ---- */

void beside_free(struct page_beside *beside)
{
    if (beside)
        free((void *)(uintptr_t)beside->rows);
    free(beside);
}

void obstacles_free(struct paragraph *p)
{
    for (int i = 0; i < p->obstacles_count; i++)
        free((void *)(uintptr_t)p->obstacles[i].rows);
    free(p->obstacles);
    p->obstacles = NULL;
    p->obstacles_count = 0;
}
