/* collide.h - letters that push each other apart: an option, applied between steps.
 *
 *     for (int i = 0; i < 4; i++) {
 *         dyn_network_step(network, 1.0 / 240, 1);
 *         dyn_words_collide(network, words, 2, &contacts);
 *     }
 *
 * Two letters whose boxes overlap are in contact at the side with the shortest way out
 * (separating axes), with the corner that is deepest behind it. The corner and the side's two
 * ends are moved apart by half of the depth, in proportions given by their masses and the
 * corner's place along the side. If they still approach each other, they bounce, with the
 * world's restitution and friction. This is repeated up to four times, while any letters touch.
 * Momentum is conserved. Linked letters with boxes of ink do not collide while a link holds,
 * because kerned ink overlaps at rest. A box that is not strictly convex does not collide.
 *
 * Source: Erin Catto, Fast and simple physics using sequential impulses, 2006, for the
 * bounce.
 *
 * Errors, ownership and threads: as word.h says.
 */
#ifndef LUTETIA_DYN_COLLIDE_H
#define LUTETIA_DYN_COLLIDE_H

#include "word.h"

/* contacts: how many pairs touched; NULL is fine. Errors: NO_MEMORY; nothing moved. */
enum dyn_status dyn_words_collide(struct dyn_network *n, const struct dyn_word *const *words,
                                  int words_count, int *contacts);

#endif
