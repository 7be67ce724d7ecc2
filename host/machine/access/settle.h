/* settle.h - first thing wherever a field or flag is looked at or stored into. */
#ifndef LUTETIA_MACHINE_SETTLE_H
#define LUTETIA_MACHINE_SETTLE_H

#include "base/parts.h"
#include "run/notes.h"

/* What is noted of calls is performed. */
static inline void settle(struct machine *m)
{
    if (m->run->calls_noted)
        notes_perform(m);
}

#endif
