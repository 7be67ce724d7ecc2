/* colour_read.h - a COLR table, read with all its bounds checked: layers (version 0); paints,
 * their colours, boxes, and what a variable font's axes add to each number (version 1). What
 * lies beyond the table's end reads as 0. (FreeType reads it only where it was built to.) */
#ifndef LUTETIA_FONT_COLOUR_READ_H
#define LUTETIA_FONT_COLOUR_READ_H

#include "colour_gradient.h"
#include "edges.h"

#include <stddef.h>
#include <stdint.h>

enum { FONT_COLR_AXES_MAX = 64, FONT_COLR_INK = 0xffff };

struct font_colr {
    const uint8_t *bytes;
    size_t count;
    double axes[FONT_COLR_AXES_MAX]; /* -1..1 */
    int axes_count;
    const uint8_t (*palette)[4]; /* red, green, blue, cover */
    int palette_count;
    const double *ink; /* of what has the text's */
};

enum font_paint_kind {
    FONT_PAINT_NONE,
    FONT_PAINT_LAYERS,
    FONT_PAINT_SOLID,
    FONT_PAINT_GRADIENT,
    FONT_PAINT_GLYPH,
    FONT_PAINT_BASE, /* another glyph's paints */
    FONT_PAINT_MAPPED,
    FONT_PAINT_COMPOSITE
};

struct font_paint {
    enum font_paint_kind kind;
    uint32_t first, count; /* LAYERS */
    uint32_t glyph;        /* GLYPH, BASE */
    uint32_t child, below; /* places in the table; 0: none. COMPOSITE: child over below */
    int mode;              /* COMPOSITE */
    float rgba[4];         /* SOLID: sRGB numbers times cover */
    struct font_map map;   /* MAPPED: affine */
};

/* Layer i of a glyph that has layers (version 0), and its colour. */
bool font_colr_plain_layer(const struct font_colr *c, uint32_t glyph, uint32_t i,
                           uint32_t *layer, uint32_t *colour);

/* Whether the table is of version 1 and its lists lie within it. */
bool font_colr_good(const struct font_colr *c);
/* Where a glyph's paint is; 0: it has none. */
uint32_t font_colr_base(const struct font_colr *c, uint32_t glyph);
/* Where layer i's paint is; 0: there is none. */
uint32_t font_colr_layer(const struct font_colr *c, uint32_t i);
/* The box that a glyph is clipped to, in the font's units. */
bool font_colr_box(const struct font_colr *c, uint32_t glyph, struct font_box *out);
/* The paint at a place. gradient: filled for GRADIENT, prepared. */
void font_colr_paint(const struct font_colr *c, uint32_t at, struct font_paint *out,
                     struct font_gradient *gradient);

/* colour_vary.c: what the axes add to number n of those that vary from `base` on; 0xffffffff:
 * nothing. */
double font_colr_delta(const struct font_colr *c, uint32_t base, uint32_t n);
/* colour_table.c: a number of 1 to 4 bytes; with a sign. */
uint32_t font_colr_u(const struct font_colr *c, uint64_t at, int bytes);
int32_t font_colr_s(const struct font_colr *c, uint64_t at, int bytes);

#endif
