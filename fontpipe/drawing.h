/* drawing.h - a layout as a drawing in a file: SVG and PDF, with the letters' own outlines, and
 * the text that they show.
 *
 *     struct font_drawing d = {.width_px = 600, .height_px = 800, .ink = {0, 0, 0}};
 *     font_drawing_svg(&d, &layout, NULL, 0, 0, file);
 *
 * Outlines are the fonts': no filter, no pixels. In SVG each letter's outline is a path that is
 * there once and used wherever it stands, under its own map; what maps distort is a path of its
 * own. In PDF letters that are not distorted are glyphs of embedded fonts; others are paths,
 * with their text unseen over them. document.h has PDF of more pages than one. A pixel is 1/96
 * inch in SVG, and 0.75 points in PDF. Inks keep their translucency; gradients are gradients,
 * and pictures as ink are patterns. Who shows the file mixes numbers, not light.
 *
 * Ownership: what is passed stays the caller's. Threads: the layout's faces belong to one
 * thread at a time.
 *
 * Errors: functions return a status and leave one line in font_error(): BAD_ARGUMENT (an ink
 * that font_ink_check() refuses, a distortion that sends a letter beyond the horizon), BAD_FILE
 * where the file cannot be written, NO_MEMORY. */
#ifndef LUTETIA_FONT_DRAWING_H
#define LUTETIA_FONT_DRAWING_H

#include "edges.h"
#include "text.h"

#include <stdio.h>

/* A box under the letters. rgba: sRGB, and how much it covers. */
struct font_drawing_box {
    double x, y, width, height, rgba[4];
};

/* A stroke over the letters, its ends round. width_px: of the line to this point from the one
 * before. What lets something through does not let less through where it crosses itself. Parts
 * that are farther than 100,000 pixels from the page are drawn there. */
struct font_drawing_point {
    double x, y, width_px;
};
struct font_drawing_stroke {
    const struct font_drawing_point *points;
    int points_count;
    double rgba[4];
};

struct font_drawing {
    double width_px, height_px;
    double ink[3]; /* sRGB numbers, of letters that have none of the layout's */
    const char
        *text; /* that the layout's clusters are bytes of; NULL: none is written with it */
    size_t bytes;
    const struct font_passage
        *passages; /* by where they begin, of PDF; NULL: the text is one paragraph */
    int passages_count;
    /* beside the letters, in the page's pixels, through no map; in order */
    const struct font_drawing_box *boxes;
    int boxes_count;
    const struct font_drawing_stroke *strokes;
    int strokes_count;
    const char *title, *language; /* of a PDF of its own: as document.h has them */
};

/* The layout, its origin at (x, y), through `map` (NULL: as it is), as the whole of a file; the
 * caller closes the file. Errors: BAD_ARGUMENT, BAD_FILE, NO_MEMORY, TOO_LARGE. */
enum font_status font_drawing_svg(const struct font_drawing *drawing,
                                  const struct font_layout *layout, const struct font_map *map,
                                  double x_px, double y_px, FILE *file);
enum font_status font_drawing_pdf(const struct font_drawing *drawing,
                                  const struct font_layout *layout, const struct font_map *map,
                                  double x_px, double y_px, FILE *file);

#endif
