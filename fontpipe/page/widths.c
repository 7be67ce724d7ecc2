/* widths.c - letters that are made wider or narrower, in fonts that have an axis for it: see
 * page_internal.h.
 *
 * A face is opened again for each hundredth that its width is varied by, when the first such
 * line is looked at, and kept as long as the text. What it does not do exactly (its steps, an
 * axis that ends) is left to a map, so that a line is as wide as it was set. */
#include "page_internal.h"

#include <edits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS_MAX = 5 };
static const double STEP = 0.01;

static bool axis_find(const struct font_face *face, struct font_axis *axis)
{
    struct font_face_info info;
    font_face_describe(face, &info);
    for (int i = 0; i < info.axes_count; i++)
        if (font_face_axis(face, i, axis) == FONT_OK && strcmp(axis->tag, "wdth") == 0)
            return true;
    return false;
}

/* The style's face so many steps wider; NULL: it has no such axis, or cannot be opened
 * again. */
static struct font_face *widened(struct page_text *t, const struct style *style, int steps)
{
    struct font_face *own = style->shaper->faces[0].face;
    struct font_axis axis;
    for (int i = 0; i < t->widths_count; i++)
        if (t->widths[i].of == own && t->widths[i].steps == steps)
            return t->widths[i].face;
    if (!axis_find(own, &axis) ||
        !array_reserve(&t->widths, &t->widths_capacity, t->widths_count + 1, sizeof *t->widths))
        return NULL;
    struct wide_face *w = &t->widths[t->widths_count++];
    *w = (struct wide_face){.of = own, .steps = steps};
    double value = axis.value * (1 + steps * STEP);
    if (font_edits_open(style->look.font, 0, false, &w->face) == FONT_OK &&
        (font_face_axes_set(w->face, style->look.axes) != FONT_OK ||
         font_face_axis_set(w->face, "wdth", value) != FONT_OK ||
         style_filter_set(&style->look, w->face) != FONT_OK)) {
        font_face_close(w->face);
        w->face = NULL;
    }
    return w->face;
}

struct font_face *widths_face(struct page_text *t, const struct style *style, uint32_t glyph,
                              float *scale)
{
    struct font_face *own = style->shaper->faces[0].face, *face;
    double part = (double)*scale, before, after;
    int steps = (int)lrint(fmin(STEPS_MAX, fmax(-STEPS_MAX, (part - 1) / STEP)));
    if (steps == 0 || !(face = widened(t, style, steps)))
        return own;
    if (font_face_advance(own, glyph, &before) != FONT_OK ||
        font_face_advance(face, glyph, &after) != FONT_OK || !(before > 0 && after > 0))
        return own;
    *scale = (float)(part * before / after);
    return face;
}

void widths_finish(struct page_text *t)
{
    for (int i = 0; i < t->widths_count; i++)
        font_face_close(t->widths[i].face);
    free(t->widths);
}
