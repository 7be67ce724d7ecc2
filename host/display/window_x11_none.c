/* window_x11_none.c - a build without X11's headers: pictures go through OpenGL. */
#include "window_x11.h"

struct window_x11 *window_x11_begin(unsigned long window)
{
    (void)window;
    return NULL;
}

void window_x11_end(struct window_x11 *x11)
{
    (void)x11;
}

bool window_x11_room(struct window_x11 *x11, int width_px, int height_px,
                     struct display_room *room)
{
    (void)x11, (void)width_px, (void)height_px, (void)room;
    return false;
}

bool window_x11_share(struct window_x11 *x11, int descriptor, const void *at)
{
    (void)x11, (void)descriptor, (void)at;
    return false;
}

bool window_x11_put_shared(struct window_x11 *x11, const uint8_t *pixels, int width_px,
                           int height_px)
{
    (void)x11, (void)pixels, (void)width_px, (void)height_px;
    return false;
}

void window_x11_settle(struct window_x11 *x11)
{
    (void)x11;
}

void window_x11_put(struct window_x11 *x11)
{
    (void)x11;
}

void window_x11_put_again(struct window_x11 *x11)
{
    (void)x11;
}

const uint8_t *window_x11_pixels(const struct window_x11 *x11, int *width_px, int *height_px)
{
    (void)x11;
    *width_px = *height_px = 0;
    return NULL;
}

void window_x11_lost_set(void (*lost)(void *context), void *context)
{
    (void)lost, (void)context;
}

bool window_x11_waits(void)
{
    return false;
}

void window_x11_wait(void *display, int descriptor, double wait_s)
{
    (void)display, (void)descriptor, (void)wait_s;
}
