/* reader_colours.h - what documents are coloured with, on the screen and in HTML: two themes.
 *
 *     const struct reader_colours *colours = reader_colours_of(dark);
 *     fill(colours->paper); */
#ifndef LUTETIA_READER_COLOURS_H
#define LUTETIA_READER_COLOURS_H

#include <stdbool.h>

/* sRGB, 0..1. */
struct reader_colours {
    double paper[3], ink[3], link[3], struck[3], selected[3], found[3], current[3], marked[3],
        noted[3];
};

/* Never NULL. Owns: nobody; valid for ever. */
const struct reader_colours *reader_colours_of(bool dark);

#endif
