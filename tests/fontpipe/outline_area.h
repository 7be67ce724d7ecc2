/* outline_area.h - an outline's area, computed without the code that fills it. */
#ifndef LUTETIA_TESTS_OUTLINE_AREA_H
#define LUTETIA_TESTS_OUTLINE_AREA_H

#include <outline.h>

#include <stddef.h>

/* The area of an outline in its own units: half the sum of its segments' cross products, with
 * curves in short parts. */
static inline double outline_area(const struct font_outline *o)
{
    double sum = 0;
    for (int i = 0; i < o->segments_count; i++) {
        struct font_point a = o->segments[i].p[0];
        for (int k = 1; k <= 64; k++) {
            struct font_point b = font_segment_at(&o->segments[i], k / 64.0, NULL);
            sum += a.x * b.y - b.x * a.y;
            a = b;
        }
    }
    return -0.5 * sum * o->turn;
}

#endif
