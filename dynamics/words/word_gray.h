/* word_gray.h - letters of springy words as gray.
 *
 *     const struct dyn_view view = {100, 60, 200};
 *     for (int i = 0; i < dyn_word_glyphs_count(word); i++) {
 *         struct font_point to[4];
 *         const struct font_gray *gray;
 *         dyn_word_corners(word, network, i, &view, to);
 *         if (dyn_word_gray(word, i, &view, to, painter, &gray) == FONT_OK)
 *             dyn_gray_over(gray, pixels, x, y, width, height);
 *     }
 *
 * A letter's box is mapped smoothly to the quad of its masses, and the letter is filtered
 * there. What two letters cover, each covers its part of what the other one leaves.
 *
 * Errors: fontpipe's. Ownership and threads: as word.h says; the painter is of the same
 * thread. */
#ifndef LUTETIA_DYN_WORD_GRAY_H
#define LUTETIA_DYN_WORD_GRAY_H

#include "word.h"

#include <paint.h>

/* From the world, y upwards, to pixels, y downwards. */
struct dyn_view {
    double scale, x, y; /* pixels a unit; the place of the world's origin */
};

/* The letter's corners as they are seen, from the upper left one clockwise. */
void dyn_word_corners(const struct dyn_word *word, const struct dyn_network *n, int index,
                      const struct dyn_view *view, struct font_point to[4]);

/* The letter between those corners; *gray is the painter's, until it draws again, and may be
 * without ink. Errors: of font_painter_glyph(); BAD_ARGUMENT: nothing can be mapped to these
 * corners. */
enum font_status dyn_word_gray(const struct dyn_word *word, int index,
                               const struct dyn_view *view, const struct font_point to[4],
                               struct font_painter *painter, const struct font_gray **gray);

/* Lays it over what the pixels have, which begin at (x, y); what is outside is left out. */
void dyn_gray_over(const struct font_gray *gray, uint8_t *pixels, int x, int y, int width,
                   int height);

#endif
