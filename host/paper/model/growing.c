/* growing.c - a stroke that grows: its samples so far, and how far it has been painted.
 *
 *     samples      o     o   o      o       o     o     when they come
 *     settled      |----------------|                   a spline needs one sample beyond the next
 *     intervals    |---|---|---|---|                    of a step of the paper: done one by one, as those of a whole stroke
 *
 * So the bits are those of the whole stroke. Boxes have room for where it has been and for some
 * way ahead: they are cut seldom. */
#include "model/brush_internal.h"

#include <array.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { AHEAD_UNITS = 2 }; /* where it goes; half of them around where it begins */

struct sheet_growing {
    struct paper_stroke stroke;
    struct paper_stroke_sample *samples; /* the stroke's */
    int room;
    bool painted;
    struct sheet_going going;
    double low[2], high[2]; /* where boxes have room */
};

enum paper_status sheet_growing_begin(struct paper_sheet *p, int number, double pace,
                                      bool painted)
{
    struct sheet_growing *g = calloc(1, sizeof *g);
    if (!g)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a stroke");
    g->stroke = (struct paper_stroke){.number = number, .pace = pace};
    g->painted = painted;
    for (int axis = 0; axis < 2; axis++) {
        g->low[axis] = INFINITY;
        g->high[axis] = -INFINITY;
    }
    if (painted)
        sheet_going_begin(&g->going, p, &g->stroke);
    p->growing = g;
    return PAPER_OK;
}

const struct paper_stroke *sheet_growing(const struct paper_sheet *p)
{
    return p->growing ? &p->growing->stroke : NULL;
}

bool sheet_growing_painted(const struct paper_sheet *p)
{
    return p->growing && p->growing->going.interval > 0;
}

/* Boxes get room for the stroke's samples from `first` on. */
static enum paper_status expect(struct paper_sheet *p, struct sheet_growing *g, int first)
{
    const struct paper_brush *brush = &g->going.own->brush;
    const double around = sheet_stroke_around(p, brush), ahead = AHEAD_UNITS * p->boxes_unit,
                 most = p->page.grid.width + p->page.grid.height;
    bool more = false;
    for (int i = first; i < g->stroke.samples_count; i++) {
        const double at[2] = {g->samples[i].x, g->samples[i].y};
        for (int axis = 0; axis < 2; axis++) {
            const double far = i == 0 ? ahead / 2 : ahead;
            if (at[axis] - around < g->low[axis]) {
                g->low[axis] = fmax(-most, at[axis] - around - far);
                more = true;
            }
            if (at[axis] + around > g->high[axis]) {
                g->high[axis] = fmin(2 * most, at[axis] + around + far);
                more = true;
            }
        }
    }
    if (!more || !(g->stroke.pace > 0))
        return PAPER_OK;
    return sheet_boxes_expect(p, (int)fmin(2 * most, g->low[0]), (int)fmin(2 * most, g->low[1]),
                              (int)fmax(-most, g->high[0]), (int)fmax(-most, g->high[1]));
}

/* Whether the samples can follow those that are there. */
static enum paper_status samples_check(const struct paper_sheet *p,
                                       const struct sheet_growing *g,
                                       const struct paper_stroke_sample *samples, int count)
{
    const int had = g->stroke.samples_count;
    struct paper_stroke added = g->stroke;
    added.samples = samples;
    added.samples_count = count;
    if (count < 1 || count > PAPER_STROKE_SAMPLES_MAX - had)
        return paper_fail(PAPER_BAD_ARGUMENT, "a stroke has 1..%d samples (got %d and %d more)",
                          PAPER_STROKE_SAMPLES_MAX, had, count);
    enum paper_status status = sheet_stroke_check(p, &added);
    if (status != PAPER_OK || had == 0)
        return status;
    const struct paper_stroke_sample ends[2] = {g->samples[had - 1], samples[0]};
    added.samples = ends;
    added.samples_count = 2;
    status = paper_stroke_check(&added);
    if (status != PAPER_OK)
        return status;
    const struct paper_stroke_sample whole[2] = {g->samples[0], samples[count - 1]};
    added.samples = whole;
    return sheet_stroke_check(p, &added);
}

enum paper_status sheet_growing_add(struct paper_sheet *p,
                                    const struct paper_stroke_sample *samples, int count)
{
    struct sheet_growing *g = p->growing;
    const int had = g->stroke.samples_count;
    enum paper_status status = samples_check(p, g, samples, count);
    if (status != PAPER_OK)
        return status;
    if (!array_reserve(&g->samples, &g->room, had + count, sizeof *g->samples))
        return paper_fail(PAPER_NO_MEMORY, "no memory for a stroke of %d samples", had + count);
    memcpy(g->samples + had, samples, (size_t)count * sizeof *samples);
    g->stroke.samples = g->samples;
    g->stroke.samples_count = had + count;
    if (!g->painted)
        return PAPER_OK;
    status = expect(p, g, had);
    return status == PAPER_OK ? sheet_going_on(&g->going, sheet_going_settled(&g->stroke))
                              : status;
}

enum paper_status sheet_growing_finish(struct paper_sheet *p)
{
    struct sheet_growing *g = p->growing;
    return sheet_going_on(&g->going, sheet_going_intervals(&g->stroke));
}

void sheet_growing_end(struct paper_sheet *p, struct paper_stroke_sample **samples)
{
    struct sheet_growing *g = p->growing;
    if (!g)
        return;
    if (samples)
        *samples = g->samples;
    else
        free(g->samples);
    if (p->boxes)
        (void)sheet_boxes_expect(p, 0, 0, 0, 0); /* nothing any more: cannot fail */
    free(g);
    p->growing = NULL;
}
