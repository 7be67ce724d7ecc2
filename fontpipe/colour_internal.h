/* colour_internal.h - what colour.c, colour_paints.c, colour_svg.c and colour_table.c share. */
#ifndef LUTETIA_FONT_COLOUR_INTERNAL_H
#define LUTETIA_FONT_COLOUR_INTERNAL_H

#include "colour.h"
#include "colour_read.h"
#include "internal.h"

#include <hb.h>

enum { FONT_COLOUR_SIDE_MAX = 4096 };
/* The picture's place and size around a box in its pixels, y downwards; nothing for an empty
 * one. False: too large. */
bool font_colour_pixels_set(const struct font_box *box, int em_px,
                            struct font_colour_picture *out);

/* A table of the face's file, empty if it has none. Owns: the caller destroys it. */
hb_blob_t *font_colour_table(struct font_face *face, const char tag[5]);
struct font_colr font_colour_colr(hb_blob_t *table);

bool font_colour_has_paints(struct font_face *face, uint32_t glyph);
/* em_px: at most; less where the picture would be too large. As font_colour_picture_draw()
 * otherwise. */
enum font_status font_colour_paints(struct font_face *face, uint32_t glyph, int em_px,
                                    const double ink[3], const struct font_filter *area,
                                    struct font_colour_picture *out);

/* Whether the font has an SVG document for it. */
bool font_colour_has_svg(struct font_face *face, uint32_t glyph);
/* Whether there is a library that draws them. */
bool font_colour_svg_drawn(void);
enum font_status font_colour_svg(struct font_face *face, uint32_t glyph, int em_px,
                                 const double ink[3], struct font_colour_picture *out);

#endif
