/* code_pages.h - the machine's own code, fetched before it runs for the first time.
 *
 *     struct aside fetching = {0};
 *     code_pages_begin (&fetching);          while the driver makes its context
 *     ...
 *     aside_end (&fetching);
 *
 * The system maps a page of a program where it is first needed, and a processor gets each line of it from memory then. A program of a hundred calls
 * that computes for some 30 microseconds waits for its code as long again. A thread fetches all of it while the program goes on. */
#ifndef LUTETIA_MACHINE_CODE_PAGES_H
#define LUTETIA_MACHINE_CODE_PAGES_H

#include <stddef.h>

#include "base/aside.h"

struct code_pages {
    const char *begin, *end;
};

/* What of the segment with this very function in it is in memory: so much on each side of it, at most. {NULL, NULL}: it cannot be told. */
struct code_pages code_pages_find(size_t most_on_a_side);
/* Nothing begins where there is one processor. */
void code_pages_begin(struct aside *a);

#endif
