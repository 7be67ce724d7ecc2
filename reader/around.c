/* around.c - see reader_around.h. */
#include "reader_around.h"
#include "reader_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ROW_EM 0.2
/* Between places of a stroke that are looked at, where there are no more of them than that. */
#define STEP_EM 0.1
#define STEPS_MOST 20000.0
/* Ink that is larger, or farther from its paragraph, is no drawing in a text: a file of
 * remarks may say anything. */
#define SIDE_MOST_EM 200.0
#define AWAY_MOST_EM 1000.0

bool reader_around_has(const struct reader_block *block)
{
    return (block->kind == READER_PARAGRAPH ||
            (block->kind == READER_HEADING && block->level > 2)) &&
           block->bytes > 0;
}

int reader_around_block(const struct reader_document *d, const struct reader_remark *r)
{
    if (r->kind != READER_REMARK_INK || r->around == READER_AROUND_NOT || r->orphan ||
        !reader_remark_seen(r))
        return -1;
    const struct reader_block *block = reader_document_block(d, r->begin);
    return block && block >= d->blocks && block < d->blocks + d->blocks_count &&
                   reader_around_has(block)
               ? (int)(block - d->blocks)
               : -1;
}

/* ---- what a stroke covers ---- */

struct extent {
    double x0, y0, x1, y1;
};

static void extent_add(struct extent *e, double x, double y, double half)
{
    e->x0 = fmin(e->x0, x - half);
    e->y0 = fmin(e->y0, y - half);
    e->x1 = fmax(e->x1, x + half);
    e->y1 = fmax(e->y1, y + half);
}

static void stroke_extent(const struct reader_remark *r, struct extent *e)
{
    for (int i = 0; i < r->points_count; i++) {
        const struct reader_ink_place p = reader_ink_place(r, i);
        extent_add(e, r->x + p.x, r->y + p.y, p.width / 2);
    }
}

/* From one place on, a row has what is covered there. */
static void rows_cover(struct reader_obstacle *o, double x, double y, double half)
{
    const double row = o->height / o->rows_count;
    const int last = o->rows_count - 1,
              from = (int)fmin(last, fmax(0, floor((y - half - o->y) / row))),
              to = (int)fmin(last, fmax(0, floor((y + half - o->y) / row)));
    for (int i = from; i <= to; i++) {
        struct page_row *own = &o->rows[i];
        const bool empty = !(own->to_px > own->from_px);
        own->from_px = empty ? x - half - o->x : fmin(own->from_px, x - half - o->x);
        own->to_px = empty ? x + half - o->x : fmax(own->to_px, x + half - o->x);
    }
}

static double stroke_length(const struct reader_remark *r)
{
    double length = 0;
    for (int i = 1; i < r->points_count; i++) {
        const struct reader_ink_place a = reader_ink_place(r, i - 1),
                                      b = reader_ink_place(r, i);
        length += hypot(b.x - a.x, b.y - a.y);
    }
    return length;
}

static void stroke_cover(const struct reader_remark *r, struct reader_obstacle *o)
{
    const double step = fmax(STEP_EM, stroke_length(r) / STEPS_MOST);
    for (int i = 0; i < r->points_count; i++) {
        const struct reader_ink_place b = reader_ink_place(r, i),
                                      a = i ? reader_ink_place(r, i - 1) : b;
        const double way = hypot(b.x - a.x, b.y - a.y);
        const int steps = (int)fmin(STEPS_MOST, 1 + floor(way / step));
        for (int k = 1; k <= steps; k++)
            rows_cover(o, r->x + a.x + (b.x - a.x) * k / steps,
                       r->y + a.y + (b.y - a.y) * k / steps, fmax(b.width, 0.01) / 2);
    }
}

/* ---- obstacles ---- */

static bool is_with(const struct reader_document *d, const struct reader_remark *a,
                    const struct reader_remark *b)
{
    return a->group >= 0 && a->group == b->group && a->around == b->around &&
           reader_around_block(d, b) == reader_around_block(d, a);
}

/* Whether a stroke before it has made its group's. */
static bool is_made(const struct reader_remarks *remarks, const struct reader_document *d,
                    int index)
{
    const struct reader_remark *r = reader_remarks_get(remarks, index);
    for (int i = 0; r->group >= 0 && i < index; i++)
        if (is_with(d, r, reader_remarks_get(remarks, i)))
            return true;
    return false;
}

/* False: it is too large to be one. */
static bool obstacle_make(const struct reader_remarks *remarks, const struct reader_document *d,
                          int index, struct reader_obstacle *out)
{
    const struct reader_remark *first = reader_remarks_get(remarks, index);
    const int count = reader_remarks_count(remarks),
              end = first->group >= 0 ? count : index + 1;
    struct extent e = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int i = index; i < end; i++)
        if (i == index || is_with(d, first, reader_remarks_get(remarks, i)))
            stroke_extent(reader_remarks_get(remarks, i), &e);
    if (!(e.x1 - e.x0 <= SIDE_MOST_EM && e.y1 - e.y0 <= SIDE_MOST_EM &&
          fabs(e.x0) <= AWAY_MOST_EM && fabs(e.y0) <= AWAY_MOST_EM))
        return false;
    *out = (struct reader_obstacle){.block = reader_around_block(d, first),
                                    .side = first->around,
                                    .x = e.x0,
                                    .y = e.y0,
                                    .width = e.x1 - e.x0,
                                    .height = fmax(e.y1 - e.y0, 0.01)};
    out->rows_count = (int)fmin(READER_OBSTACLE_ROWS, ceil(out->height / ROW_EM));
    for (int i = index; i < end; i++)
        if (i == index || is_with(d, first, reader_remarks_get(remarks, i)))
            stroke_cover(reader_remarks_get(remarks, i), out);
    return true;
}

enum reader_status reader_around_find(const struct reader_remarks *remarks,
                                      const struct reader_document *d,
                                      struct reader_obstacle **out, int *count)
{
    const int all = remarks ? reader_remarks_count(remarks) : 0;
    int capacity = 0;
    *out = NULL;
    *count = 0;
    for (int i = 0; i < all && *count < READER_OBSTACLES_MAX; i++) {
        const struct reader_remark *r = reader_remarks_get(remarks, i);
        if (reader_around_block(d, r) < 0 || is_made(remarks, d, i))
            continue;
        if (!array_reserve(out, &capacity, *count + 1, sizeof **out)) {
            free(*out);
            *out = NULL;
            *count = 0;
            return reader_fail(READER_NO_MEMORY, "no memory for ink");
        }
        *count += obstacle_make(remarks, d, i, &(*out)[*count]);
    }
    return READER_OK;
}
