/* keys_actor.h - letters that keys play, as an actor of a stage: each key has its place along
 * the picture and its letter, which is as large as the key sounds (keys_score.h).
 *
 *     struct keys_actor_def def = keys_actor_def_default();
 *     def.face = face;
 *     struct stage_actor actor;
 *     if (keys_actor_create(&def, &actor) != STAGE_OK)
 *         die(stage_error());
 *     keys_actor_play(&actor, message.bytes);               // between two steps: from then on
 *
 * Its controls: how large, how fast letters come and go, what aftertouch adds, slant; the axes
 * of a variable font, and how far a note's velocity, its aftertouch and its pitch lead each
 * (font_axes.h: weight_velocity, weight_pressure, weight_pitch). Other words (stage_text()) are
 * other letters for the keys; what sounds goes on with them. */
#ifndef LUTETIA_KEYS_ACTOR_H
#define LUTETIA_KEYS_ACTOR_H

#include <keys_letters.h>

#include "actor.h"

struct keys_actor_def {
    struct font_face *face; /* borrowed; its axes are the actor's to set */
    int range[2];           /* the lowest key and the highest, at least an octave */
    const struct keys_score
        *score;       /* keys that are played in it have places; NULL: the range */
    const char *text; /* its letters go to the keys; NULL: the notes' names */
    const struct keys_letters *letters; /* over that, where they have some; NULL: none */
    struct keys_def keys;
};
struct keys_actor_def keys_actor_def_default(void); /* c3 to c5 */

/* Copies all but the face. Errors: BAD_ARGUMENT (no letter in the text, a range of less than an
 * octave), NO_MEMORY. */
enum stage_status keys_actor_create(const struct keys_actor_def *def, struct stage_actor *out);

/* A channel message with its status byte; a key outside of the range is played by octaves in
 * it. Errors: NO_MEMORY. */
enum stage_status keys_actor_play(const struct stage_actor *actor, const uint8_t *bytes);

/* How large the largest of a key's notes is now, 0..1. */
double keys_actor_level(const struct stage_actor *actor, int key);

#endif
