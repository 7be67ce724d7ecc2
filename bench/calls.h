/* calls.h - a loop of plain C/Paris calls, for measuring the front end's time for a call.
 *
 *     struct calls c;
 *     calls_init(&c, 256, 256);
 *     for (int turn = 0; turn < 100; turn++)
 *         calls_turn(&c, turn);                 // CALLS_IN_TURN calls each
 */
#ifndef LUTETIA_BENCH_CALLS_H
#define LUTETIA_BENCH_CALLS_H

#include <stddef.h>

#include <cm/paris.h>

enum { CALLS_IN_TURN = 40 };

struct calls {
    CM_field_id_t count, limit, small; /* 32, 32 and 8 bits */
    CM_field_id_t heat;                /* a float */
    CM_field_id_t mark;                /* 1 bit */
};

/* Makes a VP set of height by width, selects it, and allocates and fills the fields. */
void calls_init(struct calls *c, int width, int height);
/* CALLS_IN_TURN calls: adds, comparisons, context changes, moves, NEWS, and fields that come
 * from the stack and go back there. The numbers in them depend on the turn. Fields stay bounded
 * whatever the number of turns. */
void calls_turn(const struct calls *c, int turn);
/* Memory of this process that is in use; 0 where the system does not say. */
size_t calls_resident_bytes(void);

#endif
