/* code_pages.h - the machine's own code and constants, fetched before they are needed for the
 * first time.
 *
 *     struct aside fetching = {0};
 *     code_pages_begin (&fetching);          while the driver makes its context
 *     ...
 *     aside_end (&fetching);
 *     code_pages_near ();                    at the end, by the thread that makes the machine
 *
 * The system maps a page of a program where it is first needed, and a processor gets each line
 * of it from memory then. A program of a hundred calls that computes for some 30 microseconds
 * waits for its code as long again. A thread fetches all of it while the program goes on. */
#ifndef LUTETIA_MACHINE_CODE_PAGES_H
#define LUTETIA_MACHINE_CODE_PAGES_H

#include <stddef.h>

#include "base/aside.h"

enum { CODE_RANGES_MOST = 4 };

struct code_range {
    const char *begin, *end;
};

/* What is in memory of the program or library with this very function in it: its code, so much
 * on each side of the function at most; then its constants. How many there are; 0: it cannot be
 * told. */
int code_pages_find(size_t most_on_a_side, struct code_range out[CODE_RANGES_MOST]);
/* Nothing begins where there is one processor. */
void code_pages_begin(struct aside *a);
/* Brings the code of most calls into the caches of the caller's processor; what another thread
 * fetches comes no nearer than the cache that they share. */
void code_pages_near(void);

#endif
