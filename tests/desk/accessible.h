/* accessible.h - a window of ours as a screen reader finds it, by AT-SPI: for tests of the
 * desk's windows, on a bus of their own. */
#ifndef LUTETIA_TEST_ACCESSIBLE_H
#define LUTETIA_TEST_ACCESSIBLE_H

#include <atspi/atspi.h>

typedef void accessible_each(AtspiAccessible *a, void *context);
/* Calls for each of the accessible objects from there on; a composed control's inside is its
 * own business. */
void accessible_walk(AtspiAccessible *a, accessible_each *each, void *context);
/* The only program's window, once it is there. NULL: not within that time. */
AtspiAccessible *accessible_frame_wait(double seconds);

#endif
