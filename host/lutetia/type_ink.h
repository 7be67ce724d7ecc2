/* type_ink.h - `lutetia type`: ink that is more than a colour. */
#ifndef LUTETIA_TYPE_INK_H
#define LUTETIA_TYPE_INK_H

#include "options.h"

#include <display.h>
#include <text.h>

/* What the options say. All zeros but for cover, 1: the plain ink. */
struct type_ink {
    double cover;
    struct option_list gradient, radial, stops; /* X,Y,X,Y; X,Y,R; AT,R,G,B,COVER */
    const char *picture;
    bool numbers;
    struct display_image image; /* the picture's, once it is read */
};

/* Whether anything is asked for. */
bool type_ink_given(const struct type_ink *ink);
/* EXIT_SUCCESS, or prints what is wrong. Reads the picture. */
int type_ink_check(const char *verb, struct type_ink *ink);
/* Gives the ink to all of the layout's glyphs; plain: its colour if it is neither gradient nor
 * picture. */
int type_ink_apply(const char *verb, const struct type_ink *ink, const double plain[3],
                   struct font_layout *layout);
void type_ink_finish(struct type_ink *ink);

#endif
