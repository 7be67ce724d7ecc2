/* emphasis.h - which signs of a text set words apart: *slanted*, _slanted_, **bold**,
 * ***both***. Signs that nothing closes are letters, and those with blanks on both sides. Pure:
 * it knows nothing of type. */
#ifndef LUTETIA_PAGE_EMPHASIS_H
#define LUTETIA_PAGE_EMPHASIS_H

#include <stdbool.h>

struct emphasis {
    bool slanted, heavy;
};

/* How many of the same sign stand at `at`. */
int emphasis_run(const char *text, int at, int end);
/* Takes the run at `at` of the text from..end, which changes *e: how many of its signs did, 0
 * where all of the run are letters. */
int emphasis_take(const char *text, int from, int at, int end, struct emphasis *e);

#endif
