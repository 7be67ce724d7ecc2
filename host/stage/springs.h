/* springs.h - masses, springs and letters on them as an actor.
 *
 *     struct stage_springs_def def = stage_springs_def_default();
 *     def.network = network;                                 // the actor's now
 *     def.letters = letters, def.letters_count = count;      // copied
 *     struct stage_actor actor;
 *     if (stage_springs_create(&def, &actor) != STAGE_OK)
 *         die(stage_error());
 *
 * A letter's box is spread between four masses. Its controls are those of the network's world (dynamics/controls.h), those of the
 * word's style, and how it is shown.
 *
 * Hands. A mass near the pointer is pulled by a spring of the hand's own, and let go. With Shift, or a pen pressed hard, it is where
 * the pointer is, and stays there, tacked, with a click; a tacked one that is taken without Shift is moved and stays tacked, and
 * with Shift and no movement the tack is taken out. A letter that is taken between its masses is pulled as a whole. The right
 * button cuts the springs that its stroke crosses. */
#ifndef LUTETIA_STAGE_SPRINGS_H
#define LUTETIA_STAGE_SPRINGS_H

#include <clamps.h>
#include <network.h>
#include <word.h>

#include "actor.h"

struct stage_springs_letter {
    struct stage_letter letter;
    int masses
        [4]; /* of the box's corners (x0, y0), (x1, y0), (x1, y1), (x0, y1), y0 being the top */
};

struct stage_springs_def {
    struct dyn_network *network;
    const struct stage_springs_letter *letters; /* their faces must outlive the actor */
    int letters_count;
    struct dyn_word *
        word; /* the actor's; its letters come besides, and its style is adjustable; NULL: none */
    struct dyn_word_style style;    /* that of the word */
    struct dyn_clamps *clamps;      /* the actor's; lead masses; NULL: nobody does */
    bool show_masses, show_springs; /* true */
    /* The world that is seen: x0 < x1 and y0 < y1; else that around what there is. */
    struct font_box extent;
};
struct stage_springs_def stage_springs_def_default(void);

/* Owns: the network, the word and the clamps, also on failure. Errors: BAD_ARGUMENT (a letter on a mass that is not there), NO_MEMORY. */
enum stage_status stage_springs_create(const struct stage_springs_def *def,
                                       struct stage_actor *out);

/* The network of an actor that is one of these. */
struct dyn_network *stage_springs_network(const struct stage_actor *actor);

#endif
