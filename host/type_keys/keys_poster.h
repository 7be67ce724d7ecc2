/* keys_poster.h - a song as a poster: lines along which time runs, as many as it needs.
 *
 *     first channel     C   E  G         a staff for each channel that plays: higher notes stand
 *                         D      A       higher, each as large as it gets
 *     second channel    CEG     FAC      a chord is read from its lowest note, like a word
 *
 *     first channel     ...              the next line: it begins with a note
 *
 * Each note is set once, where it begins. No letter covers another one of its staff where that
 * can be: chords and runs are as small as the time until what they would cover asks, but not
 * below a third of their size.
 */
#ifndef LUTETIA_KEYS_POSTER_H
#define LUTETIA_KEYS_POSTER_H

#include "keys_picture.h"

struct keys_poster;

/* The type is borrowed and must outlive *out. second_px: of a second. line_px: the most of a
 * line's width; lines are about equally long, and end before a rest where there is one near.
 * Owns: the caller destroys *out. Errors: those of shapers and painters; NO_MEMORY. */
enum font_status keys_poster_create(struct keys_type *type, double second_px, double line_px,
                                    struct keys_poster **out);
void keys_poster_destroy(struct keys_poster *poster); /* NULL is fine */

int keys_poster_lines(const struct keys_poster *poster);
double keys_poster_width(const struct keys_poster *poster);  /* of the longest line */
double keys_poster_height(const struct keys_poster *poster); /* of a line: all staves */

/* Draws a line with its upper left corner there. Errors: those of shapers and painters. */
enum font_status keys_poster_draw(struct keys_poster *poster, int line, double x_px,
                                  double y_px, struct font_picture *picture);

#endif
