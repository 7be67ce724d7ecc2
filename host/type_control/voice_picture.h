/* voice_picture.h - pictures of letters played by a voice: a moment, the poster, the envelope.
 *
 * Letters are drawn through the font pipeline's filter at exactly their size, and mixed in
 * light.
 */
#ifndef LUTETIA_VOICE_PICTURE_H
#define LUTETIA_VOICE_PICTURE_H

#include "voice_letters.h"

#include <paint.h>

struct voice_type_def {
    const char *filter;
    double size_px[2]; /* of the em: smallest and largest */
    double rise_em;    /* the highest rise of the baseline, in largest sizes */
    double slant;      /* the largest slant, by shearing: pixels to the right for each pixel
                        * up */
    double paper[3];   /* sRGB, 0..1 */
    double inks[3][3]; /* the first is the ink if none is mapped; for vowels: [a], [i], [u] */
    double silence;    /* relative envelope below which nothing is set along a line */
    struct voice_mapping mapping;
};
struct voice_type_def voice_type_def_default(void);

struct voice_type;

/* face: borrowed; must outlive *out. Errors: BAD_ARGUMENT (weight or slant is mapped, and
 * the font lacks the axis), NO_MEMORY; those of shapers and painters. Owns: the caller
 * destroys *out. */
enum font_status voice_type_create(const struct voice_type_def *def, struct font_face *face,
                                   const struct voice_words *words,
                                   const struct voice_score *score, struct voice_type **out);
void voice_type_destroy(struct voice_type *type); /* NULL is fine */

/* Draws the moment's words in the middle of the picture, on its paper. */
enum font_status voice_type_moment(struct voice_type *type, double time_s,
                                   struct font_picture *picture);
/* The letters' size at that moment, in pixels. */
double voice_type_size(const struct voice_type *type, double time_s);

/* The line on which time runs, `second_px` pixels for a second and more where there are many letters, from `margin_px` on, its
 * baseline at baseline_px; and how long it gets. */
enum font_status voice_type_line_width(struct voice_type *type, double second_px,
                                       double *width_px);
enum font_status voice_type_line(struct voice_type *type, double second_px, double margin_px,
                                 double baseline_px, struct font_picture *picture);

/* The envelope as a black shape on its paper, with a mark below where each sound begins; within the margin. */
void voice_type_envelope(const struct voice_type *type, double margin_px,
                         struct font_picture *picture);

#endif
