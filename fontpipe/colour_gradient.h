/* colour_gradient.h - the gradients of fonts' paints: a line of colours, and where on it a
 * place is. */
#ifndef LUTETIA_FONT_COLOUR_GRADIENT_H
#define LUTETIA_FONT_COLOUR_GRADIENT_H

#include "outline.h"

#include <stdbool.h>

enum { FONT_COLOURS_MAX = 64 };
enum font_extend { FONT_EXTEND_PAD, FONT_EXTEND_REPEAT, FONT_EXTEND_REFLECT };
enum font_gradient_kind { FONT_GRADIENT_LINEAR, FONT_GRADIENT_RADIAL, FONT_GRADIENT_SWEEP };

struct font_gradient {
    enum font_gradient_kind kind;
    enum font_extend extend;
    int count;
    float at[FONT_COLOURS_MAX];      /* not falling, once prepared */
    float rgba[FONT_COLOURS_MAX][4]; /* sRGB numbers times cover */
    /* LINEAR: from p[0] to p[1], the same along p[0] p[2]; RADIAL: centres of two circles;
     * SWEEP: a centre */
    struct font_point p[3];
    double r[2]; /* RADIAL: radii; SWEEP: angles from and to, in turns against the clock */
};

/* Orders the colours, straightens a line. False: there is nothing to paint. */
bool font_gradient_prepare(struct font_gradient *g);
/* The colour at a place; false: none. */
bool font_gradient_at(const struct font_gradient *g, double x, double y, float rgba[4]);

#endif
