/* pending.h - how many values may be pending before they are evaluated: see evaluate.c. */
#ifndef LUTETIA_MACHINE_PENDING_H
#define LUTETIA_MACHINE_PENDING_H

enum {
    PENDING_MANY =
        384, /* LUTETIA_FLUSH_AFTER sets another number; past a first loop five times as many */
    PENDING_MOST = 4096, /* also in a loop whose turns are being collected */
    PENDING_LOOP = 16384 /* also while a loop over slices is not at its end */
};
_Static_assert(5 * PENDING_MANY < PENDING_MOST, "loops may wait longer than straight code");

#endif
