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

/* face, words, timing and score: borrowed; must outlive *out. timing: when words are said;
 * NULL: the whole text is shown at any time, and there are no lines. Errors: BAD_ARGUMENT
 * (weight, width or slant is mapped, and the font lacks the axis), NO_MEMORY; those of shapers
 * and painters. Owns: the caller destroys *out. */
enum font_status voice_type_create(const struct voice_type_def *def, struct font_face *face,
                                   const struct voice_words *words,
                                   const struct voice_timing *timing,
                                   const struct voice_score *score, struct voice_type **out);
void voice_type_destroy(struct voice_type *type); /* NULL is fine */

/* Draws the word that is said at that moment in the middle of the picture, on its paper;
 * nothing in a silence. */
enum font_status voice_type_moment(struct voice_type *type, double time_s,
                                   struct font_picture *picture);
/* The letters' size at that moment, in pixels. */
double voice_type_size(const struct voice_type *type, double time_s);

/* Lines on which time runs, `second_px` pixels for a second and more where there are many
 * letters. Words whose letters join are set whole, as large as they get; in a text that runs to
 * the left, so does time. */
struct voice_line {
    int first_word, end_word;
    double width_px;
};
/* Divides the text into lines of at most `most_px`; a longer word has a line of its own. Owns:
 * the caller frees *lines. */
enum font_status voice_type_lines(struct voice_type *type, double second_px, double most_px,
                                  struct voice_line **lines, int *count);
/* Draws a line onto what is there, its baseline at baseline_px, from x_px on; in a text that
 * runs to the left up to x_px. */
enum font_status voice_type_line(struct voice_type *type, double second_px,
                                 const struct voice_line *line, double x_px, double baseline_px,
                                 struct font_picture *picture);
bool voice_type_to_left(const struct voice_type *type);
void voice_type_paper(const struct voice_type *type, struct font_picture *picture);

/* The envelope as a black shape on its paper, with a mark below where each sound begins; within
 * the margin. */
void voice_type_envelope(const struct voice_type *type, double margin_px,
                         struct font_picture *picture);

#endif
