/* word_internal.h - shared by the files of springy words. */
#ifndef LUTETIA_DYN_WORD_INTERNAL_H
#define LUTETIA_DYN_WORD_INTERNAL_H

#include "word.h"

#include <internal.h>

struct dyn_word {
    struct dyn_letter *letters; /* and then marks */
    int letters_count, marks_count, letters_capacity, lines_count;
    struct dyn_word_style style;
    struct dyn_word_range range;
    uint8_t *part; /* the kind of each spring */
    int parts_capacity;
};

static inline int dyn_glyphs(const struct dyn_word *word)
{
    return word->letters_count + word->marks_count;
}

/* letters.c: makes the letters of the text, with their boxes, without masses, and the marks.
 * place: each letter's origin, in units from the beginning of the first baseline, y upwards;
 * the caller frees it. A mark's mass[0] is the number of its letter until dyn_marks_stand()
 * gives it the letter's masses. */
struct dyn_place {
    double x, y;
};
enum dyn_status dyn_letters_make(struct dyn_word *word, const struct dyn_word_def *def,
                                 struct dyn_place **places);
void dyn_marks_stand(struct dyn_word *word);

/* path.c: a point along a path: x from its beginning, y to its left. Errors: BAD_ARGUMENT: a
 * path without length, or a point that is not finite. */
struct dyn_path {
    const double (*points)[2];
    double *at; /* the distance of each point along the path */
    int count;
};
enum dyn_status dyn_path_make(struct dyn_path *path, const double (*points)[2], int count);
void dyn_path_finish(struct dyn_path *path);
struct dyn_place dyn_path_place(const struct dyn_path *path, double x, double y);

#endif
