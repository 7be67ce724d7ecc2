/* type_ink.c - see type_ink.h. */
#include "type_ink.h"
#include "lutetia.h"
#include "type_common.h"

#include <stdlib.h>
#include <string.h>

bool type_ink_given(const struct type_ink *t)
{
    return t->cover < 1 || t->gradient.count || t->radial.count || t->stops.count ||
           t->picture || t->numbers;
}

int type_ink_check(const char *verb, struct type_ink *t)
{
    int ways = t->gradient.count + t->radial.count;
    if (ways + (t->picture != NULL) > 1)
        return fail_usage(verb, "ink is one of --gradient, --radial and --texture, given once");
    if (ways && !t->stops.count)
        return fail_usage(verb, "a gradient's colours come with --stop AT,R,G,B,COVER");
    if (!ways && t->stops.count)
        return fail_usage(verb, "--stop is a colour of --gradient or --radial");
    if (t->stops.count > FONT_INK_STOPS_MAX)
        return fail_usage(verb, "a gradient has up to %d stops (got %d)", FONT_INK_STOPS_MAX,
                          t->stops.count);
    if (ways && t->cover < 1)
        return fail_usage(verb, "a gradient's cover is in its --stop, not in --cover");
    if (t->picture && display_png_read_rgb(t->picture, &t->image) != DISPLAY_OK)
        return fail(verb, "%s", display_error());
    return EXIT_SUCCESS;
}

int type_ink_apply(const char *verb, const struct type_ink *t, const double plain[3],
                   struct font_layout *layout)
{
    struct font_ink ink = font_ink_plain(plain[0], plain[1], plain[2], t->cover);
    ink.numbers = t->numbers;
    if (t->gradient.count || t->radial.count) {
        const double *way = t->gradient.count ? t->gradient.numbers[0] : t->radial.numbers[0];
        ink.kind = t->gradient.count ? FONT_INK_LINEAR : FONT_INK_RADIAL;
        ink.x0 = way[0];
        ink.y0 = way[1];
        ink.x1 = way[2];
        ink.y1 = t->gradient.count ? way[3] : 0;
        ink.stops_count = t->stops.count;
        for (int i = 0; i < t->stops.count; i++) {
            ink.stops[i].at = t->stops.numbers[i][0];
            memcpy(ink.stops[i].rgba, t->stops.numbers[i] + 1, sizeof ink.stops[i].rgba);
        }
    } else if (t->picture) {
        ink.kind = FONT_INK_PICTURE;
        ink.rgb = t->image.pixels;
        ink.width_px = t->image.width_px;
        ink.height_px = t->image.height_px;
        ink.pitch = 3 * t->image.width_px;
    }
    if (font_ink_check(&ink) != FONT_OK)
        return fail_font(verb);
    int number = font_layout_ink_add(layout, &ink);
    if (!number)
        return fail(verb, "no memory for an ink");
    for (int i = 0; i < layout->glyphs_count; i++)
        layout->glyphs[i].ink = number;
    return EXIT_SUCCESS;
}

void type_ink_finish(struct type_ink *t)
{
    display_image_destroy(&t->image);
}
