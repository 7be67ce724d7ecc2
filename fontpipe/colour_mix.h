/* colour_mix.h - one colour over another, in the ways that fonts' paints name. Numbers are
 * sRGB's times cover. */
#ifndef LUTETIA_FONT_COLOUR_MIX_H
#define LUTETIA_FONT_COLOUR_MIX_H

/* In OpenType's order. */
enum font_mix {
    FONT_MIX_CLEAR,
    FONT_MIX_SOURCE,
    FONT_MIX_BELOW,
    FONT_MIX_SOURCE_OVER,
    FONT_MIX_BELOW_OVER,
    FONT_MIX_SOURCE_IN,
    FONT_MIX_BELOW_IN,
    FONT_MIX_SOURCE_OUT,
    FONT_MIX_BELOW_OUT,
    FONT_MIX_SOURCE_ATOP,
    FONT_MIX_BELOW_ATOP,
    FONT_MIX_XOR,
    FONT_MIX_PLUS,
    FONT_MIX_SCREEN,
    FONT_MIX_OVERLAY,
    FONT_MIX_DARKEN,
    FONT_MIX_LIGHTEN,
    FONT_MIX_DODGE,
    FONT_MIX_BURN,
    FONT_MIX_HARD_LIGHT,
    FONT_MIX_SOFT_LIGHT,
    FONT_MIX_DIFFERENCE,
    FONT_MIX_EXCLUSION,
    FONT_MIX_MULTIPLY,
    FONT_MIX_HUE,
    FONT_MIX_SATURATION,
    FONT_MIX_COLOUR,
    FONT_MIX_LUMINOSITY,
    FONT_MIX_COUNT
};

/* What of `source` mixed with `below` is left, into out, which may be either. */
void font_mix(enum font_mix how, const float source[4], const float below[4], float out[4]);

#endif
