/* proof.h - what a word keeps by a filter at a size, in numbers.
 *
 *     struct font_proof_def def = {.layout = &layout, .filter = "cone", .display = FONT_DISPLAY_LCD, .x_height_px = 6.2};
 *     struct font_proof proof;
 *     if (font_proof_make(&def, &proof) != FONT_OK)
 *         die(font_error());
 *
 * Reach is a model of reading from afar, and no reader was asked. The word is what the display
 * shows, each pixel a spot of light. The eye's picture is blurred by a Gaussian whose sigma is
 * an arc minute, and what is wider than half the letters' height is left out, since a word's
 * gray bar tells no letter. The same word without pixels can just be read where its x-height is
 * five arc minutes (Snellen's letters), and has some contrast left there, the root of the mean
 * square. The word is read from as far as it has as much.
 *
 * Errors: functions that can fail return a status and leave one line in font_error().
 * Ownership: the layout is borrowed. Threads: as its faces. */
#ifndef LUTETIA_FONT_PROOF_H
#define LUTETIA_FONT_PROOF_H

#include "filter.h"
#include "text.h"

struct font_proof_def {
    const struct font_layout *layout;
    const char *filter;
    enum font_display display;
    double x_height_px;
    /* by what the faces have of their own (own.h), where they have; else by the filter alone */
    bool own;
};

struct font_proof {
    /* how much of a pixel is covered where there is ink, in the mean of all ink: 1 is all */
    double contrast;
    /* over which an upright edge goes from 10 to 90 % of its cover, by the filter */
    double edge_px;
    /* the root of the mean square between the word's pixels and their exact cover, over those
     * with ink, of 255 */
    double error;
    /* of the distance from which the word could be read without pixels; 0: from none */
    double reach;
};
/* Errors: BAD_ARGUMENT (no such filter, no x-height, no ink), TOO_LARGE (a word of more than a
 * million pixels), NO_MEMORY, those of outlines. */
enum font_status font_proof_make(const struct font_proof_def *def, struct font_proof *out);

#endif
