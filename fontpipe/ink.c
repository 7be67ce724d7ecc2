/* ink.c - see ink.h. */
#include "ink.h"
#include "internal.h"

#include <srgb.h>

#include <math.h>

struct font_ink font_ink_plain(double red, double green, double blue, double cover)
{
    return (struct font_ink){.rgba = {red, green, blue, cover}};
}

static bool colour_good(const double rgba[4])
{
    for (int i = 0; i < 4; i++)
        if (!(rgba[i] >= 0 && rgba[i] <= 1))
            return false;
    return true;
}

enum font_status font_ink_check(const struct font_ink *ink)
{
    const double places[] = {ink->x0, ink->y0, ink->x1, ink->y1};
    for (int i = 0; i < 4; i++)
        if (!(fabs(places[i]) <= 1e7))
            return font_fail(FONT_BAD_ARGUMENT, "an ink's place must be within 1e7 (got %g)",
                             places[i]);
    switch (ink->kind) {
    case FONT_INK_PLAIN:
        if (!colour_good(ink->rgba))
            return font_fail(FONT_BAD_ARGUMENT, "ink must be 0..1 (got %g, %g, %g, %g)",
                             ink->rgba[0], ink->rgba[1], ink->rgba[2], ink->rgba[3]);
        return FONT_OK;
    case FONT_INK_PICTURE:
        if (!ink->rgb || ink->width_px < 1 || ink->height_px < 1 || !colour_good(ink->rgba))
            return font_fail(FONT_BAD_ARGUMENT, "an ink's picture has pixels (got %dx%d)",
                             ink->width_px, ink->height_px);
        return FONT_OK;
    case FONT_INK_LINEAR:
    case FONT_INK_RADIAL:
        break;
    }
    if (ink->stops_count < 1 || ink->stops_count > FONT_INK_STOPS_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "a gradient has 1..%d stops (got %d)",
                         FONT_INK_STOPS_MAX, ink->stops_count);
    for (int i = 0; i < ink->stops_count; i++)
        if (!colour_good(ink->stops[i].rgba) ||
            !(ink->stops[i].at >= (i ? ink->stops[i - 1].at : 0) && ink->stops[i].at <= 1))
            return font_fail(FONT_BAD_ARGUMENT,
                             "stop %d of a gradient must lie between the one before and 1, its "
                             "colour in 0..1 (got %g)",
                             i + 1, ink->stops[i].at);
    return FONT_OK;
}

/* The colour at a part of a gradient's way. */
static void gradient_at(const struct font_ink *ink, double at, float rgba[4])
{
    const struct font_ink_stop *s = ink->stops;
    int last = ink->stops_count - 1, i = 0;
    while (i < last && s[i + 1].at <= at)
        i++;
    double span = i < last ? s[i + 1].at - s[i].at : 0;
    double part = span > 0 ? fmin(1, fmax(0, (at - s[i].at) / span)) : 0;
    for (int c = 0; c < 4; c++)
        rgba[c] =
            (float)(s[i].rgba[c] + (i < last ? part * (s[i + 1].rgba[c] - s[i].rgba[c]) : 0));
}

static int remainder_of(double value, int count)
{
    double part = fmod(floor(value), count);
    return (int)(part < 0 ? part + count : part);
}

void font_ink_at(const struct font_ink *ink, double x, double y, float rgba[4])
{
    double dx = ink->x1 - ink->x0, dy = ink->y1 - ink->y0;
    x += 0.5 - ink->x0;
    y += 0.5 - ink->y0;
    switch (ink->kind) {
    case FONT_INK_PLAIN:
        for (int c = 0; c < 4; c++)
            rgba[c] = (float)ink->rgba[c];
        return;
    case FONT_INK_LINEAR:
        gradient_at(ink, dx * dx + dy * dy > 0 ? (x * dx + y * dy) / (dx * dx + dy * dy) : 0,
                    rgba);
        return;
    case FONT_INK_RADIAL:
        gradient_at(ink, ink->x1 > 0 ? hypot(x, y) / ink->x1 : 1, rgba);
        return;
    case FONT_INK_PICTURE: {
        const uint8_t *from = ink->rgb +
                              (ptrdiff_t)remainder_of(y, ink->height_px) * ink->pitch +
                              3 * (ptrdiff_t)remainder_of(x, ink->width_px);
        for (int c = 0; c < 3; c++)
            rgba[c] = (float)from[c] / 255;
        rgba[3] = (float)ink->rgba[3];
        return;
    }
    }
}

double font_light(double number, double gamma)
{
    if (gamma > 0)
        return pow(number, gamma);
    return srgb_light(number);
}

double font_number(double light, double gamma)
{
    if (gamma > 0)
        return pow(light, 1 / gamma);
    return srgb_number(light);
}
