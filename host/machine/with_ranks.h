/* with_ranks.h - the machine of the program that has the other ranks. */
#ifndef LUTETIA_MACHINE_WITH_RANKS_H
#define LUTETIA_MACHINE_WITH_RANKS_H

#include "base/parts.h"

/* The settings have been read: how many blocks there are. */
enum machine_status ranks_settings(struct machine *m, const struct machine_config *config);
/* Whether it is the machine that has them: the first that there is. */
bool ranks_are_of(const struct machine *m);
/* Each other rank makes its machine; what one has in memory at most, all have. Or all destroy
 * theirs. *near: all see their arrays, and can compute with them themselves. */
enum machine_status ranks_machines_make(struct machine *m, bool *near);
void ranks_machines_destroy(struct machine *m);
/* The machine has gone. */
void ranks_are_free(const struct machine *m);

#endif
