/* ink.h - what letters are filled with: a colour, a gradient, a picture; each may let what is
 * below shine through.
 *
 *     struct font_ink inks[] = {font_ink_plain(0.8, 0.1, 0.1, 0.5)};     // half of a red
 *     layout.inks = inks; ...                                            // see text.h
 *
 * Places are in pixels of the layout: (0, 0) is its origin. They are not turned with a map of
 * the text.
 *
 *     struct font_ink sky = {.kind = FONT_INK_LINEAR, .y1 = 100, .stops_count = 2,
 *                            .stops = {{0, {0.2, 0.4, 0.9, 1}}, {1, {1, 1, 1, 0}}}};
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: a picture's pixels are borrowed as long as the ink is used. Threads: any. */
#ifndef LUTETIA_FONT_INK_H
#define LUTETIA_FONT_INK_H

#include "status.h"

#include <stdbool.h>
#include <stdint.h>

enum font_ink_kind {
    FONT_INK_PLAIN,
    FONT_INK_LINEAR, /* from (x0, y0) to (x1, y1), the ends' colours beyond them */
    FONT_INK_RADIAL, /* from (x0, y0) outwards to a radius of x1 */
    FONT_INK_PICTURE /* its upper left at (x0, y0), repeated */
};
enum { FONT_INK_STOPS_MAX = 8 };

struct font_ink_stop {
    double at;      /* 0..1 of the way, not falling from stop to stop */
    double rgba[4]; /* sRGB numbers 0..1; the last is how much it covers of what is below */
};

struct font_ink {
    enum font_ink_kind kind;
    double rgba[4]; /* PLAIN; its last number holds for pictures, too */
    double x0, y0, x1, y1;
    struct font_ink_stop stops[FONT_INK_STOPS_MAX];
    int stops_count;
    const uint8_t *rgb; /* PICTURE: borrowed */
    int width_px, height_px, pitch;
    bool numbers; /* mixed with what is below as sRGB's numbers; else as light */
};

/* A colour, sRGB numbers 0..1, and how much it covers. */
struct font_ink font_ink_plain(double red, double green, double blue, double cover);
/* Errors: BAD_ARGUMENT for what cannot be drawn. */
enum font_status font_ink_check(const struct font_ink *ink);
/* At the centre of the pixel whose upper left is (x, y): sRGB numbers and cover. */
void font_ink_at(const struct font_ink *ink, double x, double y, float rgba[4]);

/* Light from sRGB numbers 0..1 and back, or a power. */
double font_light(double number, double gamma);
double font_number(double light, double gamma);

#endif
