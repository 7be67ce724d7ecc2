/* reader_colours.h - what documents are coloured with, on the screen and in HTML: two themes.
 *
 *     const struct reader_colours *colours = reader_colours_of(dark);
 *     fill(colours->paper); */
#ifndef LUTETIA_READER_COLOURS_H
#define LUTETIA_READER_COLOURS_H

#include <stdbool.h>

enum { READER_COLOURS = 9 };

/* sRGB, 0..1. */
struct reader_colours {
    double paper[3], ink[3], link[3], struck[3], selected[3], found[3], current[3], marked[3],
        noted[3];
};

/* Never NULL. Owns: nobody; valid for ever. */
const struct reader_colours *reader_colours_of(bool dark);

/* Their names, as templates have them, in the struct's order. */
extern const char *const reader_colour_names[READER_COLOURS];
/* The three numbers of a colour by its place among the names. Owns: `colours`. */
double *reader_colour_at(struct reader_colours *colours, int colour);
/* "#rrggbb". False: it is none, and rgb is as it was. */
bool reader_colour_read(const char *text, double rgb[3]);
void reader_colour_text(const double rgb[3], char text[8]);

/* How well letters of a colour are read on its ground, or letters on it, where it is a ground:
 * the ratio of contrast of WCAG 2.1, 1 to 21; small letters want 4.5. */
double reader_colour_contrast(const struct reader_colours *colours, int colour);
#define READER_CONTRAST_LEAST 4.5

#endif
