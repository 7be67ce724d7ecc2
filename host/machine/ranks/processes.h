/* processes.h - what ranks_count() and its like answer, once it is known. */
#ifndef LUTETIA_MACHINE_RANKS_PROCESSES_H
#define LUTETIA_MACHINE_RANKS_PROCESSES_H

#include "ranks/ranks.h"

void processes_are(int count, int mine, int on_node);

#endif
