/* window_x11.h - a window's picture put by the X server, from memory that both share.
 *
 * Where OpenGL is computed by the processors (llvmpipe), a picture of 1024x512 takes 7 ms of
 * them: it becomes a texture, which a rectangle samples, and is then handed to the server. Put
 * as it is, it costs a copy. */
#ifndef LUTETIA_WINDOW_X11_H
#define LUTETIA_WINDOW_X11_H

#include "display.h"

#include <stdbool.h>
#include <stdint.h>

struct window_x11;

/* NULL: not an X11 window, or a server that is elsewhere, or one with other pixels than 8 bits
 * of red, green and blue in 32. The window must outlive what is returned. Owns: the caller ends
 * it. */
struct window_x11 *window_x11_begin(unsigned long window);
void window_x11_end(struct window_x11 *x11); /* NULL is fine */

/* The memory of the picture that is put next, of that size; valid until the next call. What was
 * in it may be there still. False: there is no memory. */
bool window_x11_room(struct window_x11 *x11, int width_px, int height_px,
                     struct display_room *room);

/* The same server sees the file's memory, too, which is mapped at `at`. False: it does not;
 * then or later nothing else is tried. */
bool window_x11_share(struct window_x11 *x11, int descriptor, const void *at);
/* Puts a picture that lies in that memory, row by row as window_x11_pixels() says. It must
 * stay as it is until another is put. False: no memory is shared, or the window has other
 * pixels. */
bool window_x11_put_shared(struct window_x11 *x11, const uint8_t *pixels, int width_px,
                           int height_px);
/* Waits until the server has read what was put. */
void window_x11_settle(struct window_x11 *x11);

/* Puts the picture that is kept at the window's upper left corner. Does not wait for the
 * server: window_x11_room() does, which may find that it is done. */
void window_x11_put(struct window_x11 *x11);
/* Puts again what is seen. */
void window_x11_put_again(struct window_x11 *x11);

/* The pixels that are seen, row by row, each blue, green, red and a byte without meaning; NULL:
 * none are. */
const uint8_t *window_x11_pixels(const struct window_x11 *x11, int *width_px, int *height_px);

/* When the connection to a server is lost, X's library ends the program: lost() is called
 * before, once. It may use nothing of X's. NULL: nothing is. */
void window_x11_lost_set(void (*lost)(void *context), void *context);

/* Waits for an event of that display (GLFW's) or for bytes in the descriptor, so long at most.
 * waits(): X11's library is there for it. */
bool window_x11_waits(void);
void window_x11_wait(void *display, int descriptor, double wait_s);

#endif
