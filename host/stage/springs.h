/* springs.h - masses, springs and letters on them as an actor.
 *
 *     struct stage_springs_def def = stage_springs_def_default();
 *     def.network = network;                                 // the actor's now
 *     def.letters = letters, def.letters_count = count;      // copied
 *     struct stage_actor actor;
 *     if (stage_springs_create(&def, &actor) != STAGE_OK)
 *         die(stage_error());
 *
 * A letter's box is mapped to four masses. Its controls are those of the network's world
 * (dynamics/spring_controls.h), those of the word's style, and how it is shown.
 *
 * Hands. Dragging a mass pulls it by a spring, until it is released. With Shift, or a pen
 * pressed hard, the mass is moved to the pointer, and stays there tacked, with a click. A
 * tacked mass that is dragged without Shift is moved and stays tacked; Shift and a click
 * without movement remove the tack. A letter that is dragged between its masses is pulled as
 * a whole. The right button cuts the springs that its stroke crosses.
 */
#ifndef LUTETIA_STAGE_SPRINGS_H
#define LUTETIA_STAGE_SPRINGS_H

#include <clamps.h>
#include <face.h>
#include <network.h>
#include <word.h>

#include "actor.h"

struct stage_springs_letter {
    struct stage_letter letter;
    int masses
        [4]; /* of the box's corners (x0, y0), (x1, y0), (x1, y1), (x0, y1), y0 being the top */
};

struct stage_springs_def;
/* Who makes the word anew when its text is changed (stage_text()): fills network, word, style
 * and extent of a def of usual values, which the actor owns then. make NULL: the text stays. */
struct stage_springs_maker {
    enum stage_status (*make)(void *context, const char *words, struct stage_springs_def *out);
    void *context;
};

struct stage_springs_def {
    struct dyn_network *network;
    const struct stage_springs_letter *letters; /* their faces must outlive the actor */
    int letters_count;
    struct dyn_word *word; /* owned by the actor, which shows its letters too, and its style is
               * adjustable; NULL: none */
    struct dyn_word_style style;    /* that of the word */
    struct dyn_clamps *clamps;      /* owned by the actor; keys of masses; NULL: none */
    bool show_masses, show_springs; /* true */
    /* The visible part of the world: x0 < x1 and y0 < y1; otherwise the actor's extent. */
    struct font_box extent;
    struct stage_springs_maker maker;
    /* A variable font whose axes are controls: weight, width, slant, or the axis's tag.
     * Borrowed, must outlive the actor; NULL: none. */
    struct font_face *face;
};
struct stage_springs_def stage_springs_def_default(void);

/* Owns: the network, the word and the clamps, also on failure. Errors: BAD_ARGUMENT (a
 * letter on a mass that does not exist), NO_MEMORY. */
enum stage_status stage_springs_create(const struct stage_springs_def *def,
                                       struct stage_actor *out);

/* The network of an actor made by stage_springs_create(). */
struct dyn_network *stage_springs_network(const struct stage_actor *actor);

#endif
