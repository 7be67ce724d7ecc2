/* window_none.c - replaces window.c in builds without GLFW: window_create() fails with a
 * message, and functions that take a window are never called. */
#include "display_internal.h"
#include "window.h"

#include <stdlib.h>

struct window_config window_config_default(void)
{
    return (struct window_config){
        .title = "lutetia", .width_px = 960, .height_px = 960, .vsync = true};
}

bool window_possible(void)
{
    return false;
}

enum display_status window_create(const struct window_config *config, struct window **out)
{
    (void)config;
    *out = NULL;
    return display_fail(DISPLAY_NO_WINDOW,
                        "this lutetia was built without windows (libglfw3-dev was not there)");
}

void window_destroy(struct window *window)
{
    if (window)
        abort();
}

void window_title_set(struct window *window, const char *title)
{
    (void)window;
    (void)title;
    abort();
}

enum display_status window_show(struct window *window, const struct display_image *image)
{
    (void)window;
    (void)image;
    abort();
}

bool window_room_begin(struct window *window, int width_px, int height_px,
                       struct display_room *room)
{
    (void)window, (void)width_px, (void)height_px, (void)room;
    abort();
}

void window_room_show(struct window *window)
{
    (void)window;
    abort();
}

bool window_shared_show(struct window *window, const struct picture_room *room,
                        const uint8_t *pixels, int width_px, int height_px)
{
    (void)window, (void)room, (void)pixels, (void)width_px, (void)height_px;
    abort();
}

void window_settle(struct window *window)
{
    (void)window;
    abort();
}

void window_lost_set(void (*lost)(void *context), void *context)
{
    (void)lost, (void)context;
}

void window_wait(double wait_s)
{
    (void)wait_s;
    abort();
}

void window_wake(void)
{
}

void window_size(const struct window *window, int *width_px, int *height_px)
{
    (void)window;
    (void)width_px;
    (void)height_px;
    abort();
}

bool window_closing(const struct window *window)
{
    (void)window;
    abort();
}

void window_close(struct window *window)
{
    (void)window;
    abort();
}

bool window_input_take(struct window *window, double wait_s, struct input_event *event)
{
    (void)window;
    (void)wait_s;
    (void)event;
    abort();
}

bool window_input_take_or(struct window *window, double wait_s, int descriptor,
                          struct input_event *event)
{
    (void)window;
    (void)wait_s;
    (void)descriptor;
    (void)event;
    abort();
}

void (*(*window_functions(void))(const char *))(void)
{
    abort();
}

void window_frame_begin(struct window *window)
{
    (void)window;
    abort();
}

void window_frame_end(struct window *window)
{
    (void)window;
    abort();
}

double window_scale(const struct window *window)
{
    (void)window;
    abort();
}

void window_fullscreen_set(struct window *window, bool full)
{
    (void)window;
    (void)full;
    abort();
}

bool window_fullscreen(const struct window *window)
{
    (void)window;
    abort();
}
