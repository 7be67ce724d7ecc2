/* collide.h - letters that push each other apart: an option, applied between steps.
 *
 *     for (int i = 0; i < 4; i++) {
 *         dyn_network_step(network, 1.0 / 240, 1);
 *         dyn_words_collide(network, words, 2, &contacts);
 *     }
 *
 * Two letters whose boxes overlap touch at the side through which the way out is shortest (separating axes), with the corner that is
 * deepest behind it. The corner and the side's two ends are moved apart, as their masses and the corner's place along the
 * side say, by half of the depth; and where they still approach each other their speeds are changed as in a bounce, with the world's restitution and
 * friction. All
 * that is done four times, while any touch. Momentum is kept. Letters that are linked to each other are left alone while a link of theirs holds if
 * their boxes are of ink, for kerned ink overlaps at rest. A box that is not strictly convex touches nothing.
 *
 * Source: Erin Catto, Fast and simple physics using sequential impulses, 2006, for the bounce. */
#ifndef LUTETIA_DYN_COLLIDE_H
#define LUTETIA_DYN_COLLIDE_H

#include "word.h"

/* contacts: how many pairs touched; NULL is fine. Errors: NO_MEMORY; nothing moved. */
enum dyn_status dyn_words_collide(struct dyn_network *n, const struct dyn_word *const *words,
                                  int words_count, int *contacts);

#endif
