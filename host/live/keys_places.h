/* keys_places.h - which keys have places along a picture, and which letters. */
#ifndef LUTETIA_KEYS_PLACES_H
#define LUTETIA_KEYS_PLACES_H

#include "keys_actor.h"

/* Gives an empty score its keys and each key its letter. Errors: BAD_ARGUMENT (no letter in the
 * text, a range of less than an octave). */
enum stage_status keys_places_make(const struct keys_actor_def *def, struct keys_score *score,
                                   struct keys_letters *letters);
/* The letters of these words for the keys of the score. Errors: BAD_ARGUMENT (no letter in
 * them); *out is unchanged then. */
enum stage_status keys_places_text(const struct keys_score *score, const char *words,
                                   struct keys_letters *out);

/* The key itself, or the nearest octave of it that has a place. */
int keys_places_near(const struct keys_score *score, int key);

#endif
