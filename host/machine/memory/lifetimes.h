/* lifetimes.h - see lifetimes.c. */
#ifndef LUTETIA_MACHINE_LIFETIMES_H
#define LUTETIA_MACHINE_LIFETIMES_H

#include "memory/memory.h"

/* In the call that is being performed. */
void lifetimes_accessed(struct machine *m, struct slot *slot, bool overwrites);

#endif
