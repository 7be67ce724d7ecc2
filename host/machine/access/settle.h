/* settle.h - called first wherever a field or flag is read or stored. */
#ifndef LUTETIA_MACHINE_SETTLE_H
#define LUTETIA_MACHINE_SETTLE_H

#include "base/parts.h"
#include "run/notes.h"

/* Performs the calls that are noted. */
static inline void settle(struct machine *m)
{
    if (m->run->calls_noted)
        notes_perform(m);
}

#endif
