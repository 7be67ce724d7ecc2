/* tiles.h - copies of all of a sheet's planes, in square tiles. What did not change from one
 * copy to the next is there once: so a copy costs the time and the memory of what is wet. */
#ifndef LUTETIA_PAPER_TILES_H
#define LUTETIA_PAPER_TILES_H

#include "history.h"

struct planes_copy;

/* How many bytes a copy takes at most, beside `known`. */
double planes_copy_bytes(const struct paper_sheet *p, const struct planes_copy *known);
/* Copies the sheet as it is. known: what the sheet was at the last planes_copy_take() or
 * planes_copy_restore() of it (NULL: nobody knows); only fibers that were touched since are
 * read. *held: the bytes of all copies. NULL: no memory, or the machine failed. */
struct planes_copy *planes_copy_take(struct paper_sheet *p, const struct planes_copy *known,
                                     double *held);
/* The sheet is as it was copied, but for what is in no plane. known: as above; only what
 * differs is written. Errors: NO_MEMORY, MACHINE_FAILED. */
enum paper_status planes_copy_restore(struct paper_sheet *p, const struct planes_copy *copy,
                                      const struct planes_copy *known);

/* A copy without planes; each is put into it once. Shape of words: the sheet's. NULL, false: no
 * memory. */
struct planes_copy *planes_copy_new(const struct paper_sheet *p, double *held);
bool planes_copy_put(struct planes_copy *copy, int plane, const uint32_t *words, double *held);

/* One more, and one fewer, who has it. NULL is fine. */
struct planes_copy *planes_copy_share(struct planes_copy *copy);
void planes_copy_drop(struct planes_copy *copy, double *held);

#endif
