/* patience.h - long work asks, every so often, whether it is still wanted.
 *
 *     const struct patience before = patience_set((struct patience){late, &deadline});
 *     // it asks patience_over() between its rows, and fails where that is true
 *     if (work() != FINE)
 *         ...
 *     patience_set(before);
 *
 * A script has a time limit and a memory limit. Libraries below it know nothing of scripts;
 * each of their loops that grows with what it is given asks here. A question takes less than a
 * microsecond.
 *
 * Threads: each thread has its own; a thread that has set nothing is patient for ever. */
#ifndef LUTETIA_PATIENCE_H
#define LUTETIA_PATIENCE_H

#include <stdbool.h>

struct patience {
    bool (*over)(void *context); /* NULL: never */
    void *context;
};

/* Returns the patience that was set before. */
struct patience patience_set(struct patience patience);

/* Whether work that goes on should fail now. */
bool patience_over(void);

#endif
