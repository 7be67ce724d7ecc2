/* beside.c - what stands beside a paragraph, and what of a frame's lines it takes: see page.h
 * and page_internal.h. */
#include "page_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

/* ---- kept with a paragraph ---- */

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

static bool within(double value, double least, double most)
{
    return value >= least && value <= most;
}

static enum font_status rows_check(const struct page_row *rows, int count, double gap,
                                   double least)
{
    if (count < 0 || count > PAGE_ROWS_MAX || (count && !rows))
        return font_fail(FONT_BAD_ARGUMENT, "what stands beside text has 0..%d rows (got %d)",
                         PAGE_ROWS_MAX, count);
    for (int i = 0; i < count; i++)
        if (!within(rows[i].from_px, -1e6, 1e6) || !within(rows[i].to_px, -1e6, 1e6))
            return font_fail(FONT_BAD_ARGUMENT, "row %d is within 1e6 pixels (got %g..%g)",
                             i + 1, rows[i].from_px, rows[i].to_px);
    if (!within(gap, 0, 1e5) || !within(least, 0, 1e6))
        return font_fail(FONT_BAD_ARGUMENT,
                         "lines keep 0..1e5 pixels away and are 0..1e6 long at least (got %g, "
                         "%g)",
                         gap, least);
    return FONT_OK;
}

/* *out NULL: none, or no memory. */
static bool rows_copy(const struct page_row *rows, int count, const struct page_row **out)
{
    struct page_row *copy = count ? malloc((size_t)count * sizeof *copy) : NULL;
    if (copy)
        memcpy(copy, rows, (size_t)count * sizeof *copy);
    *out = copy;
    return copy || !count;
}

enum font_status page_beside_add(struct page_text *t, int id, const struct page_beside *beside,
                                 const char *utf8, size_t bytes, int style,
                                 const struct page_manner *manner, int *beside_id)
{
    *beside_id = -1;
    enum font_status status =
        rows_check(beside->rows, beside->rows_count, beside->gap_px, beside->least_px);
    if (status == FONT_OK && !within(beside->width_px, 1, 1e6))
        status = font_fail(FONT_BAD_ARGUMENT,
                           "what stands beside text is 1..1e6 pixels wide (got %g)",
                           beside->width_px);
    if (status != FONT_OK)
        return status;
    struct page_beside *own = malloc(sizeof *own);
    if (own)
        *own = *beside;
    if (!own || !rows_copy(beside->rows, beside->rows_count, &own->rows)) {
        free(own);
        return font_fail(FONT_NO_MEMORY, "no memory for a text");
    }
    const struct note note = {.byte = -1, .beside = own};
    return story_note_add(t, id, &note, utf8, bytes, style, manner, beside_id);
}

static enum font_status obstacles_check(const struct page_obstacle *obstacles, int count)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < count && status == FONT_OK; i++) {
        const struct page_obstacle *o = &obstacles[i];
        status = rows_check(o->rows, o->rows_count, o->gap_px, o->least_px);
        if (status == FONT_OK &&
            (o->rows_count < 1 || !within(o->x_px, -1e6, 1e6) || !within(o->y_px, -1e6, 1e6) ||
             !within(o->height_px, 1e-3, 1e6)))
            status = font_fail(FONT_BAD_ARGUMENT,
                               "an obstacle has rows and is 0..1e6 pixels high (got %d, %g)",
                               o->rows_count, o->height_px);
    }
    return status;
}

enum font_status page_obstacles_set(struct page_text *t, int id,
                                    const struct page_obstacle *obstacles, int count)
{
    struct paragraph *p = story_paragraph(t, id);
    if (!p || p->flow < 0)
        return font_fail(FONT_BAD_ARGUMENT, "there is no paragraph %d of a flow", id);
    enum font_status status = obstacles_check(obstacles, count);
    if (status != FONT_OK)
        return status;
    struct page_obstacle *own = count > 0 ? calloc((size_t)count, sizeof *own) : NULL;
    bool good = own || count <= 0;
    int copied = 0;
    for (; good && copied < count; copied++) {
        own[copied] = obstacles[copied];
        good =
            rows_copy(obstacles[copied].rows, obstacles[copied].rows_count, &own[copied].rows);
    }
    if (!good) {
        for (int i = 0; own && i < copied; i++)
            free((void *)(uintptr_t)own[i].rows);
        free(own);
        return font_fail(FONT_NO_MEMORY, "no memory for a text");
    }
    t->besides_count += copied - p->obstacles_count;
    obstacles_free(p);
    p->obstacles = own;
    p->obstacles_count = copied;
    flow_changed(t, p);
    return FONT_OK;
}

enum font_status page_paragraph_begins(struct page_text *t, int id, int *page, double *x,
                                       double *y)
{
    const struct paragraph *p = story_paragraph(t, id);
    *page = -1;
    *x = *y = 0;
    if (!p || p->flow < 0)
        return font_fail(FONT_BAD_ARGUMENT, "there is no paragraph %d of a flow", id);
    enum font_status status = page_find(t, (struct page_place){id, 0}, page);
    if (status != FONT_OK)
        return status;
    const struct slot slot = {.frame = p->begins_frame};
    slot_point(flow_template(t, *page), &slot, 0, p->begins_v, x, y);
    return FONT_OK;
}
