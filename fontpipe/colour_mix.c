/* colour_mix.c - see colour_mix.h. Porter's and Duff's ways are two factors each; the others
 * are as W3C's Compositing and Blending defines them. */
#include "colour_mix.h"

#include <math.h>

/* Of source and of below: constant, and what is added of the other's cover. */
static const float factors[FONT_MIX_SCREEN][4] = {
    [FONT_MIX_CLEAR] = {0, 0, 0, 0},       [FONT_MIX_SOURCE] = {1, 0, 0, 0},
    [FONT_MIX_BELOW] = {0, 0, 1, 0},       [FONT_MIX_SOURCE_OVER] = {1, 0, 1, -1},
    [FONT_MIX_BELOW_OVER] = {1, -1, 1, 0}, [FONT_MIX_SOURCE_IN] = {0, 1, 0, 0},
    [FONT_MIX_BELOW_IN] = {0, 0, 0, 1},    [FONT_MIX_SOURCE_OUT] = {1, -1, 0, 0},
    [FONT_MIX_BELOW_OUT] = {0, 0, 1, -1},  [FONT_MIX_SOURCE_ATOP] = {0, 1, 1, -1},
    [FONT_MIX_BELOW_ATOP] = {1, -1, 0, 1}, [FONT_MIX_XOR] = {1, -1, 1, -1},
    [FONT_MIX_PLUS] = {1, 0, 1, 0},
};

static float soft(float s, float b)
{
    if (s <= 0.5f)
        return b - (1 - 2 * s) * b * (1 - b);
    float d = b <= 0.25f ? ((16 * b - 12) * b + 4) * b : sqrtf(b);
    return b + (2 * s - 1) * (d - b);
}

/* One number of a colour, neither of them times its cover. */
static float blended(enum font_mix how, float s, float b)
{
    switch ((int)how) {
    case FONT_MIX_SCREEN:
        return b + s - b * s;
    case FONT_MIX_OVERLAY:
        return blended(FONT_MIX_HARD_LIGHT, b, s);
    case FONT_MIX_DARKEN:
        return fminf(s, b);
    case FONT_MIX_LIGHTEN:
        return fmaxf(s, b);
    case FONT_MIX_DODGE:
        return b <= 0 ? 0 : s >= 1 ? 1 : fminf(1, b / (1 - s));
    case FONT_MIX_BURN:
        return b >= 1 ? 1 : s <= 0 ? 0 : 1 - fminf(1, (1 - b) / s);
    case FONT_MIX_HARD_LIGHT:
        return s <= 0.5f ? 2 * s * b : b + (2 * s - 1) - b * (2 * s - 1);
    case FONT_MIX_SOFT_LIGHT:
        return soft(s, b);
    case FONT_MIX_DIFFERENCE:
        return fabsf(s - b);
    case FONT_MIX_EXCLUSION:
        return b + s - 2 * b * s;
    default:
        return b * s;
    }
}

/* ---- hue, saturation, luminosity ---- */

static float luminosity(const float c[3])
{
    return 0.3f * c[0] + 0.59f * c[1] + 0.11f * c[2];
}

static float saturation(const float c[3])
{
    return fmaxf(c[0], fmaxf(c[1], c[2])) - fminf(c[0], fminf(c[1], c[2]));
}

/* The same hue and saturation at another luminosity, as far as there is such a colour. */
static void luminosity_set(float c[3], float to)
{
    float by = to - luminosity(c);
    for (int i = 0; i < 3; i++)
        c[i] += by;
    float least = fminf(c[0], fminf(c[1], c[2])), most = fmaxf(c[0], fmaxf(c[1], c[2]));
    for (int i = 0; i < 3; i++) {
        if (least < 0)
            c[i] = to + (c[i] - to) * to / (to - least);
        if (most > 1)
            c[i] = to + (c[i] - to) * (1 - to) / (most - to);
    }
}

static void saturation_set(float c[3], float to)
{
    float least = fminf(c[0], fminf(c[1], c[2])), span = saturation(c);
    for (int i = 0; i < 3; i++)
        c[i] = span > 0 ? (c[i] - least) * to / span : 0;
}

static void hued(enum font_mix how, const float s[3], const float b[3], float out[3])
{
    const float *first = how == FONT_MIX_HUE || how == FONT_MIX_COLOUR ? s : b;
    const float *light = how == FONT_MIX_LUMINOSITY ? s : b;
    float c[3] = {first[0], first[1], first[2]};
    if (how == FONT_MIX_HUE)
        saturation_set(c, saturation(b));
    else if (how == FONT_MIX_SATURATION)
        saturation_set(c, saturation(s));
    luminosity_set(c, luminosity(light));
    for (int i = 0; i < 3; i++)
        out[i] = c[i];
}

void font_mix(enum font_mix how, const float source[4], const float below[4], float out[4])
{
    float sa = source[3], ba = below[3];
    if (how < FONT_MIX_SCREEN) {
        const float *f = factors[how];
        for (int i = 0; i < 4; i++)
            out[i] = fminf(1, source[i] * (f[0] + f[1] * ba) + below[i] * (f[2] + f[3] * sa));
        return;
    }
    float s[3], b[3], mixed[3];
    for (int i = 0; i < 3; i++) {
        s[i] = sa > 0 ? source[i] / sa : 0;
        b[i] = ba > 0 ? below[i] / ba : 0;
        mixed[i] = how < FONT_MIX_HUE ? blended(how, s[i], b[i]) : 0;
    }
    if (how >= FONT_MIX_HUE)
        hued(how, s, b, mixed);
    for (int i = 0; i < 3; i++)
        out[i] = (1 - ba) * source[i] + (1 - sa) * below[i] + sa * ba * mixed[i];
    out[3] = sa + ba - sa * ba;
}
