/* copies.h - how fast the device copies. */
#ifndef LUTETIA_MACHINE_COPIES_H
#define LUTETIA_MACHINE_COPIES_H

#include "watch/sums.h"

void copies_measure(struct machine *m, struct watch_sums *e);
void copies_ready(struct machine *m, struct watch_sums *e);

#endif
