/* keys_picture_internal.h - how a letter is drawn, for moments and for posters. */
#ifndef LUTETIA_KEYS_PICTURE_INTERNAL_H
#define LUTETIA_KEYS_PICTURE_INTERNAL_H

#include "keys_picture.h"

struct keys_type {
    struct keys_type_def def;
    const struct keys_score *score;
    const struct keys_letters *letters;
    struct font_shaper *shaper;
    struct font_painter *painters[KEYS_INKS];
};

/* The size of a letter's em at a level, 0..1. */
double keys_type_size(const struct keys_type *type, double level);

/* Shapes a key's letter; a key without one has an empty layout. Owns: the caller finishes *out.
 * Errors: those of shapers. */
enum font_status keys_type_shape(struct keys_type *type, int key, double size_px,
                                 struct font_layout *out);

#endif
