/* templates.c - what pages consist of: see page.h. */
#include "page_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void templates_finish(struct page_text *t)
{
    for (int i = 0; i < t->templates_count; i++)
        for (int k = 0; k < t->templates[i].shapes_count; k++)
            free(t->shape_points[i * PAGE_SHAPES_MAX + k]);
    free(t->templates);
    free(t->shape_points);
    t->templates = NULL;
    t->shape_points = NULL;
    t->templates_count = 0;
}

bool templates_vertical(const struct page_text *t, int flow)
{
    for (int i = 0; i < t->templates_count; i++)
        for (int k = 0; k < t->templates[i].frames_count; k++)
            if (t->templates[i].frames[k].flow == flow)
                return t->templates[i].frames[k].vertical;
    return false;
}

static bool within(double value, double least, double most)
{
    return value >= least && value <= most;
}

static enum font_status frame_check(const struct page_template *t, int i)
{
    const struct page_frame *f = &t->frames[i];
    if (f->flow < 0 || f->flow >= FLOWS_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "frame %d is of flow 0..%d (got %d)", i + 1,
                         FLOWS_MAX - 1, f->flow);
    if (!within(f->x, -1e6, 1e6) || !within(f->y, -1e6, 1e6) || !within(f->width, 1, 1e6) ||
        !within(f->height, 1, 1e6) || !within(f->margin_x, -1e6, 1e6) ||
        !within(f->margin_width, 0, 1e6) || !within(f->foot_gap_px, 0, 1e6))
        return font_fail(FONT_BAD_ARGUMENT,
                         "frame %d must be 1..1e6 pixels wide and high (got %gx%g at %g, %g)",
                         i + 1, f->width, f->height, f->x, f->y);
    return FONT_OK;
}

static enum font_status shape_check(const struct page_shape *s, int i)
{
    enum { POINTS_MAX = 4096 };
    if (s->points_count < 3 || s->points_count > POINTS_MAX || !s->points)
        return font_fail(FONT_BAD_ARGUMENT, "shape %d must have 3..%d corners (got %d)", i + 1,
                         POINTS_MAX, s->points_count);
    for (int k = 0; k < 2 * s->points_count; k++)
        if (!within(s->points[k], -1e6, 1e6))
            return font_fail(FONT_BAD_ARGUMENT, "a corner of shape %d is within 1e6 (got %g)",
                             i + 1, s->points[k]);
    if (!within(s->distance_px, 0, 1e5) || !within(s->least_px, 0, 1e5))
        return font_fail(FONT_BAD_ARGUMENT, "shape %d keeps text 0..1e5 pixels away (got %g)",
                         i + 1, s->distance_px);
    return FONT_OK;
}

static enum font_status template_check(const struct page_template *t)
{
    enum font_status status = FONT_OK;
    if (!within(t->width_px, 1, 1e6) || !within(t->height_px, 1, 1e6))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a page must be 1..1e6 pixels wide and high (got %gx%g)", t->width_px,
                         t->height_px);
    if (t->frames_count < 1 || t->frames_count > PAGE_FRAMES_MAX || t->shapes_count < 0 ||
        t->shapes_count > PAGE_SHAPES_MAX)
        return font_fail(FONT_BAD_ARGUMENT,
                         "a page has 1..%d frames and 0..%d shapes (got %d, %d)",
                         PAGE_FRAMES_MAX, PAGE_SHAPES_MAX, t->frames_count, t->shapes_count);
    for (int i = 0; i < t->frames_count && status == FONT_OK; i++)
        status = frame_check(t, i);
    for (int i = 0; i < t->shapes_count && status == FONT_OK; i++)
        status = shape_check(&t->shapes[i], i);
    return status;
}

enum font_status page_templates_set(struct page_text *t, const struct page_template *templates,
                                    int count)
{
    if (count < 1 || count > TEMPLATES_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "there are 1..%d templates (got %d)", TEMPLATES_MAX,
                         count);
    for (int i = 0; i < count; i++) {
        enum font_status status = template_check(&templates[i]);
        if (status != FONT_OK)
            return status;
    }
    struct page_template *copies = malloc((size_t)count * sizeof *copies);
    double **points = calloc((size_t)count * PAGE_SHAPES_MAX, sizeof *points);
    bool good = copies && points;
    for (int i = 0; good && i < count; i++) {
        copies[i] = templates[i];
        for (int k = 0; good && k < templates[i].shapes_count; k++) {
            size_t bytes = 2 * (size_t)templates[i].shapes[k].points_count * sizeof(double);
            double *copy = malloc(bytes);
            good = copy != NULL;
            if (good)
                memcpy(copy, templates[i].shapes[k].points, bytes);
            points[i * PAGE_SHAPES_MAX + k] = copy;
            copies[i].shapes[k].points = copy;
        }
    }
    if (!good) {
        for (int i = 0; points && i < count * PAGE_SHAPES_MAX; i++)
            free(points[i]);
        free(points);
        free(copies);
        return font_fail(FONT_NO_MEMORY, "no memory for templates");
    }
    templates_finish(t);
    t->templates = copies;
    t->shape_points = points;
    t->templates_count = count;
    for (int i = 0; i < t->ids_count; i++) {
        struct paragraph *p = t->by_id[i];
        const struct paragraph *owner = p && p->flow < 0 ? t->by_id[p->owner] : p;
        if (!owner || owner->flow < 0 || p->vertical == templates_vertical(t, owner->flow))
            continue;
        p->vertical = !p->vertical;
        set_forget(p);
    }
    flow_changed_all(t);
    return FONT_OK;
}
