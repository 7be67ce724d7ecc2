/* forms.h - members of arguments that are not plain numbers: how they are stored as bytes,
 * scaled and freed. The context of streams is the sheet's struct paper_sheet_config; that of
 * scalings is a struct paper_sizes. */
#ifndef LUTETIA_PAPER_FORMS_H
#define LUTETIA_PAPER_FORMS_H

#include <members.h>

#include "paper.h"

struct paper_drawing;

struct paper_sizes {
    int width, height;         /* of the sheet that the arguments were made for */
    int new_width, new_height; /* of the sheet that they are scaled to */
    /* Draws a screen anew (drawing.h); NULL: screens are interpolated. */
    enum paper_status (*draw)(const struct paper_drawing *d, double scale, int width,
                              int height, struct paper_screen *screen, int *x, int *y);
};

extern const struct member_form
    place_form, /* struct paper_place; the part of its screen outside of the sheet is dropped */
    plane_form, /* const float *: one for each fiber */
    samples_form, /* samples and their count in struct paper_stroke */
    amounts_form; /* the rectangle and the arrays of struct paper_print */

#endif
