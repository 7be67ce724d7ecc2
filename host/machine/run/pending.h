/* pending.h - how many values may be pending before they are evaluated: see evaluate.c. */
#ifndef LUTETIA_MACHINE_PENDING_H
#define LUTETIA_MACHINE_PENDING_H

#include "run/run.h"

enum {
    PENDING_MANY =
        384, /* LUTETIA_FLUSH_AFTER sets another number; past a first loop five times as many */
    PENDING_PART = 8,    /* a turn of a loop is evaluated from a so many-th of it on ... */
    PENDING_TRAFFIC = 4, /* ... or so many times it, where turns wait for memory */
    PENDING_MOST = 4096, /* also in a loop whose turns are being collected */
    PENDING_LOOP = 16384 /* also while a loop over slices is not at its end */
};
_Static_assert(5 * PENDING_MANY < PENDING_MOST, "loops may wait longer than straight code");

/* So many pending values are worth an evaluation at the end of a loop's turn. */
static inline uint64_t pending_least(const struct machine *m)
{
    uint64_t usual = m->settings.flush_after / PENDING_PART;
    return m->run->wait_for > usual ? m->run->wait_for : usual;
}

#endif
