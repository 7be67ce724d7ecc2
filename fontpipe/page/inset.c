/* inset.c - boxes in lines: see page_inset_add() in page.h.
 *
 * For what finds scripts, directions and breaks, an inset's letters are signs that are alike
 * and that no line is broken between; all of them are one cluster, as wide as the box. */
#include "page_internal.h"

#include "../edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* An ink's places are those of its layout: they go with it. */
static int ink_put(const struct font_ink *from, double x, double y, struct font_layout *out)
{
    struct font_ink ink = *from;
    ink.x0 += x;
    ink.y0 += y;
    if (ink.kind == FONT_INK_LINEAR) { /* of a radial one x1 is a radius */
        ink.x1 += x;
        ink.y1 += y;
    }
    return font_layout_ink_add(out, &ink);
}

/* Who asks for the page is told what an inset lacks, too. */
static void missing_add(const struct font_layout *from, struct font_layout *to)
{
    for (int i = 0; i < from->missing_count && i < FONT_MISSING_MAX; i++)
        font_layout_missing_add(to, from->missing[i]);
}

/* A copy of what is drawn, without its lines. */
static bool shown_copy(const struct font_layout *from, struct font_layout *to)
{
    *to = (struct font_layout){.width_px = from->width_px,
                               .ascent_px = from->ascent_px,
                               .descent_px = from->descent_px,
                               .size_px = from->size_px};
    bool good = array_reserve(&to->glyphs, &to->glyphs_capacity, from->glyphs_count + 1,
                              sizeof *to->glyphs);
    for (int i = 0; good && i < from->glyphs_count; i++)
        to->glyphs[to->glyphs_count++] = from->glyphs[i];
    for (int i = 0; good && i < from->maps_count; i++)
        good = font_layout_map_add(to, &from->maps[i]) > 0;
    for (int i = 0; good && i < from->inks_count; i++)
        good = font_layout_ink_add(to, &from->inks[i]) > 0;
    missing_add(from, to);
    return good;
}

enum font_status page_inset_add(struct page_text *t, const struct page_style *look,
                                const struct font_layout *shown, int *out)
{
    const double most = 1e6;
    *out = -1;
    if (!(shown->width_px >= 0 && shown->width_px <= most && fabs(shown->ascent_px) <= most &&
          fabs(shown->descent_px) <= most))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a box in a line is 0..%g pixels wide, and as high (got %g, %g, %g)",
                         most, shown->width_px, shown->ascent_px, shown->descent_px);
    enum font_status status = page_style_add(t, look, out);
    if (status != FONT_OK)
        return status;
    struct style *style = t->styles[*out];
    style->is_inset = true;
    return shown_copy(shown, &style->shown)
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for a box in a line");
}

bool inset_put(const struct style *style, double x, double y, const struct font_placed *as,
               struct font_layout *out)
{
    const struct font_layout *shown = &style->shown;
    if (!array_reserve(&out->glyphs, &out->glyphs_capacity,
                       out->glyphs_count + shown->glyphs_count, sizeof *out->glyphs))
        return false;
    for (int i = 0; i < shown->glyphs_count; i++) {
        const struct font_placed *from = &shown->glyphs[i];
        struct font_placed *to = &out->glyphs[out->glyphs_count++];
        *to = *from;
        to->x_px += x;
        to->y_px += y;
        to->cluster = as->cluster;
        to->line = as->line;
        to->size_px = (float)font_placed_size(shown, from);
        to->ink = as->ink;
        if (from->map > 0)
            to->map = font_layout_map_add(out, &shown->maps[from->map - 1]);
        if (from->ink > 0)
            to->ink = ink_put(&shown->inks[from->ink - 1], x, y, out);
        if ((from->map > 0 && !to->map) || (from->ink > 0 && !to->ink))
            return false;
    }
    missing_add(shown, out);
    return true;
}
