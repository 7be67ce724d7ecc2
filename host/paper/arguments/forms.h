/* forms.h - members of arguments that are no plain numbers: how they are kept as bytes, brought to another resolution and freed. Streams'
 * context is the struct paper_sheet_config of the sheet, scalings' the struct paper_sizes. */
#ifndef LUTETIA_PAPER_FORMS_H
#define LUTETIA_PAPER_FORMS_H

#include <members.h>

struct paper_sizes {
    int width, height;         /* of the sheet that the arguments were for */
    int new_width, new_height; /* and of the one that they are for now */
};

extern const struct member_form
    place_form, /* struct paper_place; what of its screen lies outside of the sheet is left out */
    plane_form,   /* const float *: one for each fiber */
    samples_form, /* samples and their count in struct paper_stroke */
    amounts_form; /* the rectangle and the arrays of struct paper_print */

#endif
