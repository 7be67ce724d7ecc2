/* verb_paint.h - `lutetia paint`: what its options say, and the two kinds of sheet that it
 * paints on. */
#ifndef LUTETIA_VERB_PAINT_H
#define LUTETIA_VERB_PAINT_H

#include "lutetia.h"
#include "options.h"

#include <sheet.h>

#include <stdlib.h>

struct paint {
    const char *text, *image_path, *font, *edits, *filter, *view, *frames_dir, *out_path;
    const char *model, *stock;
    struct option_texts pigments; /* NAME=AMOUNT */
    double angle_deg;
    double size_px; /* 0: the line is fitted to the paper */
    /* Options that were not given are NaN until the model's values are taken. */
    double ink[3], water, wet, gravity, gravity_x, humidity, weights[3], absorbency, light;
    double ground[3]; /* NaN: the usual one */
    bool deckled;
    int size[2], steps, every, seed;
    struct option_list pools;
    struct paper_screen screen;
    double letter_px; /* the size at which its type is set; 0: it is an image */
};

/* The sheet with layers that the options ask for, and the amounts of water and of its
 * pigments that the type is put with. EXIT_SUCCESS, or prints why not. */
int paint_sheet_config(const struct paint *paint, struct paper_sheet_config *config,
                       double amount[1 + PAPER_PIGMENTS_MAX]);

/* Each makes the machine, paints the picture and writes it. EXIT_SUCCESS, EXIT_INTERRUPTED, or
 * prints why not. */
int paint_thesis(const struct paint *paint);
int paint_sheet(const struct paint *paint);

/* The name of the picture of a step on the way. EXIT_SUCCESS, or prints why not. */
enum { PAINT_PATH_MAX = 4096 };
int paint_frames_path(const struct paint *paint, int step, char *path);

#endif
