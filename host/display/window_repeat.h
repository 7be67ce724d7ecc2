/* window_repeat.h - a window's picture on further screens: each has a window of its own that
 * fills it, and shares the first one's textures. They take no input.
 *
 * Threads. The main thread. */
#ifndef LUTETIA_WINDOW_REPEAT_H
#define LUTETIA_WINDOW_REPEAT_H

#include "screens.h"
#include "window_internal.h"

struct window_repeat;
/* On screens->same. Its context is current afterwards. NULL: a window could not be opened, or
 * memory is short. */
struct window_repeat *window_repeat_create(struct window *window,
                                           const struct screens *screens);
void window_repeat_destroy(struct window_repeat *repeat); /* NULL is fine */

/* Shows what has just been drawn in the window, before its buffers are swapped: as large as it
 * fits, in the middle. The window's context is current, before and after. */
void window_repeat_show(struct window_repeat *repeat);

#endif
