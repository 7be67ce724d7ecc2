/* outline_map.c - outlines through maps that fold: see font_outline_mapped() in edges.h. */
#include "edges.h"
#include "internal.h"

#include <math.h>

/* A piece of L pixels is cut into 2.5 sqrt(L): where it turns by no more than it is long,
 * chords are a thirtieth of a pixel from the curve at most. */
static const double cuts_per_root = 2.5;
enum { CUTS_MAX = 256, SAMPLES = 8 };

/* How long the segment is in the picture, about. Below 0: a point has none there. */
static double length_of(const struct font_segment *s, const struct font_map *map)
{
    struct font_point before, at;
    double jacobian[4], length = 0;
    for (int i = 0; i <= SAMPLES; i++) {
        if (!font_map_point(map, font_segment_at(s, (double)i / SAMPLES, NULL), &at, jacobian))
            return -1;
        if (i)
            length += hypot(at.x - before.x, at.y - before.y);
        before = at;
    }
    return length;
}

static enum font_status beyond(void)
{
    return font_fail(FONT_BAD_ARGUMENT, "the distortion sends a glyph beyond the horizon");
}

static enum font_status segment_add(struct font_outline *out, const struct font_segment *s,
                                    const struct font_map *map)
{
    double length = length_of(s, map), jacobian[4];
    if (!(length >= 0))
        return beyond();
    int cuts = (int)fmin(CUTS_MAX, 1 + ceil(cuts_per_root * sqrt(length)));
    enum font_status status = FONT_OK;
    for (int i = 1; i <= cuts && status == FONT_OK; i++) {
        struct font_point at;
        if (!font_map_point(map, font_segment_at(s, (double)i / cuts, NULL), &at, jacobian))
            return beyond();
        status = font_outline_line(out, at.x, at.y);
    }
    return status;
}

enum font_status font_outline_mapped(const struct font_outline *outline,
                                     const struct font_map *map, struct font_outline *out)
{
    enum font_status status = FONT_OK;
    *out = (struct font_outline){0};
    if (outline->rebuilt || (outline->tangled && outline->rule == FONT_EVEN_ODD))
        return font_fail(FONT_BAD_ARGUMENT, "an outline is mapped before it is prepared");
    for (int i = 0; i < outline->segments_count && status == FONT_OK; i++) {
        const struct font_segment *s = &outline->segments[i];
        struct font_point at;
        double jacobian[4];
        if (i == 0 || s->contour != outline->segments[i - 1].contour) {
            if (!font_map_point(map, s->p[0], &at, jacobian))
                status = beyond();
            else
                status = font_outline_move(out, at.x, at.y);
        }
        if (status == FONT_OK)
            status = segment_add(out, s, map);
    }
    if (status == FONT_OK)
        status = font_outline_close(out);
    out->units_per_em = 1;
    if (status != FONT_OK)
        font_outline_finish(out);
    return status;
}
