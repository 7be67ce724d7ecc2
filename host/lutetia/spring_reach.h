/* spring_reach.h - how far a word that hangs will move: it is let go, ahead, and watched.
 *
 *     struct font_box box;
 *     if (spring_reach(network, sets, sets_count, true, &box) == STAGE_OK)
 *         lift = margin - box.y0; */
#ifndef LUTETIA_SPRING_REACH_H
#define LUTETIA_SPRING_REACH_H

#include <network.h>
#include <stage.h>

/* The box around all places of masses, from now on until a pendulum as long as the network
 * would have been on its other side and back. The network does not change. sets: those that are
 * of the world count. floorless: as if there were no floor. A network of very many masses stays
 * where it is. Errors: NO_MEMORY, BAD_ARGUMENT (a value that cannot be). */
enum stage_status spring_reach(const struct dyn_network *network, const char *const *sets,
                               int sets_count, bool floorless, struct font_box *box);

#endif
