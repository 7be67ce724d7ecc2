/* theme.h - all colours and widths of the stage, from one text file.
 *
 *     struct stage_theme theme;
 *     if (stage_theme_open("dark", &theme) != STAGE_OK)      // light, dark, or a file
 *         die(stage_error());
 *
 * A theme's file has a line for each name, `name = value`; what follows a # that begins a
 * line is a comment. A colour is #rrggbb, or #rrggbbaa with an opacity (sRGB). A size is a
 * number of pixels of a screen of 96 dpi. Names that are missing have the light theme's
 * values. themes/light.theme and themes/dark.theme contain and explain all names.
 */
#ifndef LUTETIA_STAGE_THEME_H
#define LUTETIA_STAGE_THEME_H

#include "stage_status.h"

#include <stddef.h>

#define STAGE_THEME_COLORS(X)                                                                  \
    X(BACKGROUND, background)                                                                  \
    X(GRID, grid)                                                                              \
    X(FLOOR, floor)                                                                            \
    X(LETTER, letter)                                                                          \
    X(SHADOW, shadow)                                                                          \
    X(SKIN, skin)                                                                              \
    X(SPRING, spring)                                                                          \
    X(SPRING_STRETCHED, spring_stretched)                                                      \
    X(SPRING_SQUEEZED, spring_squeezed)                                                        \
    X(MASS, mass)                                                                              \
    X(MASS_STUCK, mass_stuck)                                                                  \
    X(MASS_HELD, mass_held)                                                                    \
    X(HAND, hand)                                                                              \
    X(CUT, cut)                                                                                \
    X(PANEL, panel)                                                                            \
    X(PANEL_EDGE, panel_edge)                                                                  \
    X(PANEL_TEXT, panel_text)                                                                  \
    X(PANEL_VALUE, panel_value)                                                                \
    X(SLIDER, slider)                                                                          \
    X(SLIDER_KNOB, slider_knob)                                                                \
    X(RECORDING, recording)

#define STAGE_THEME_SIZES(X)                                                                   \
    X(GRID_WIDTH, grid_width)                                                                  \
    X(FLOOR_WIDTH, floor_width)                                                                \
    X(SPRING_WIDTH, spring_width)                                                              \
    X(MASS_RADIUS, mass_radius)                                                                \
    X(HAND_WIDTH, hand_width)                                                                  \
    X(CUT_WIDTH, cut_width)                                                                    \
    X(SHADOW_X, shadow_x)                                                                      \
    X(SHADOW_Y, shadow_y)                                                                      \
    X(PANEL_TEXT_SIZE, panel_text_size)                                                        \
    X(PANEL_WIDTH, panel_width)

#define STAGE_THEME_COLOR(upper, lower) STAGE_COLOR_##upper,
enum stage_theme_color { STAGE_THEME_COLORS(STAGE_THEME_COLOR) STAGE_COLORS_COUNT };
#undef STAGE_THEME_COLOR
#define STAGE_THEME_SIZE(upper, lower) STAGE_SIZE_##upper,
enum stage_theme_size { STAGE_THEME_SIZES(STAGE_THEME_SIZE) STAGE_SIZES_COUNT };
#undef STAGE_THEME_SIZE

struct stage_color {
    float r, g, b, a; /* sRGB numbers 0..1; a: opacity */
};

struct stage_theme {
    struct stage_color colors[STAGE_COLORS_COUNT];
    double sizes[STAGE_SIZES_COUNT];
};

/* "light", "dark", or a file's path. Errors: BAD_FILE, with the file's name and the line. */
enum stage_status stage_theme_open(const char *name, struct stage_theme *theme);

/* Reads a theme's text over what *theme holds. name: for messages. Errors: BAD_FILE; *theme
 * is unchanged. */
enum stage_status stage_theme_read(const char *text, size_t bytes, const char *name,
                                   struct stage_theme *theme);

/* A mix of two colours as light: that part, 0..1, of the one, the rest of the other. */
struct stage_color stage_color_mix(struct stage_color from, struct stage_color to, double part);
/* The same colour with its opacity multiplied. */
struct stage_color stage_color_fade(struct stage_color color, double part);

#endif
