/* beside.c - what stands beside a paragraph, as it is told and asked: see page.h. */
#include "page_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
