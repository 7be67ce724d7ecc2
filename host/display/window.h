/* window.h - a window that shows images, with its input events (input.h).
 *
 *     struct window_config config = window_config_default();
 *     struct window *window;
 *     struct input_event event;
 *     config.title = "page";
 *     if (window_create(&config, &window) != DISPLAY_OK ||
 *         window_show(window, &page) != DISPLAY_OK)
 *         die(display_error());
 *     while (!window_closing(window))
 *         if (window_input_take(window, 0.1, &event) && event.key == INPUT_KEY_ESCAPE)
 *             window_close(window);
 *     window_destroy(window);
 *
 * An image is scaled to fit, with the ratio of its sides kept; the rest of the window is black.
 * An image as large as the window is shown pixel for pixel. The window redraws its image when
 * it is uncovered or resized, as long as events are taken.
 *
 * Units. A window's size is given in pixels of a screen of 96 dpi; on a finer screen the
 * window has proportionally more pixels. Sizes in events are pixels. Errors. As in
 * display.h. Threads. All calls from the main thread. Each makes its window's GL context the
 * current one.
 */
#ifndef LUTETIA_WINDOW_H
#define LUTETIA_WINDOW_H

#include "display.h"
#include "input.h"

#include <picture_room.h>
#include <stdbool.h>

enum { WINDOW_SIDE_MIN = 16, WINDOW_SIDE_MAX = 16384 };

struct window_config {
    const char *title; /* UTF-8, copied; "lutetia" */
    int width_px,
        height_px;        /* WINDOW_SIDE_MIN..MAX; 960x960. Made smaller where the screen is */
    bool vsync;           /* wait for the screen's refresh before showing a picture; true */
    bool drawn_by_caller; /* the caller draws instead of calling window_show(), see below;
                           * false */
    const char *screen;   /* "1", "2", ...: the window fills that screen, without edges; "1,2":
                           * it lies over both; "1=2": both show the same; "all": it lies over
                           * all; NULL: a usual window */
};
struct window_config window_config_default(void);

struct window;

/* Whether there may be a display: DISPLAY or WAYLAND_DISPLAY is set, and this build has
 * windows. */
bool window_possible(void);

/* Errors: NO_WINDOW where there is no display, or none that can draw, or the build has no
 * windows; BAD_ARGUMENT (also: no such screen; the line lists them), NO_MEMORY; *out is
 * then NULL. Owns: the caller destroys *out. */
enum display_status window_create(const struct window_config *config, struct window **out);
void window_destroy(struct window *window); /* NULL is fine */

void window_title_set(struct window *window, const char *title);

/* Shows an image: one channel is gray, three are red, green, blue, and a fourth is how much
 * of the black behind is covered. The image is copied. Errors: BAD_ARGUMENT where it has no
 * pixels, or more on a side than the graphics card supports; the image shown before stays. */
enum display_status window_show(struct window *window, const struct display_image *image);

/* Memory for the next picture, where one of exactly the window's size is shown as it is: a
 * picture that is painted there costs no copy more. False: take window_show(). What is painted
 * is seen after window_room_show(), and until then nothing else is shown. */
bool window_room_begin(struct window *window, int width_px, int height_px,
                       struct display_room *room);
void window_room_show(struct window *window);
/* Shows a picture of exactly the window's size that lies in the room as it is: each pixel blue,
 * green, red and a byte without meaning. It must stay there until another is shown. False: take
 * one of the others. */
bool window_shared_show(struct window *window, const struct picture_room *room,
                        const uint8_t *pixels, int width_px, int height_px);
/* Waits until what was shown last has been read. */
void window_settle(struct window *window);

/* The size of the area to draw on, in pixels. */
void window_size(const struct window *window, int *width_px, int *height_px);

/* True after the user closed the window, or window_close() was called. The window exists
 * until it is destroyed. */
bool window_closing(const struct window *window);
void window_close(struct window *window);

/* Where the display goes away (X11), the program ends. Before that lost() is called, once, and
 * may use no window: it saves what would be lost. NULL: nothing is called. */
void window_lost_set(void (*lost)(void *context), void *context);

/* Waits wait_s seconds at most for something to happen to any of the windows, of which there is
 * one, or for window_wake(), which any thread may call; without a window that does nothing. */
void window_wait(double wait_s);
void window_wake(void);

/* Takes the window's next event (input.h), waiting wait_s seconds at most (0: not at all).
 * False if there is none; *event is then NONE. */
bool window_input_take(struct window *window, double wait_s, struct input_event *event);
/* The same, but it waits no longer once the descriptor is readable. -1, or a window that is not
 * X11's: it waits for events only. */
bool window_input_take_or(struct window *window, double wait_s, int descriptor,
                          struct input_event *event);

/* ---- windows that another draws in: config.drawn_by_caller ----
 *
 *     window_frame_begin(window);   // the window's GL context is the current one
 *     ...draw, with the functions that window_functions() finds...
 *     window_frame_end(window);     // and it is seen
 */

/* The function that finds OpenGL's functions by name while a window's context is current. */
void (*(*window_functions(void))(const char *name))(void);
void window_frame_begin(struct window *window);
void window_frame_end(struct window *window);

/* How many pixels correspond to one of a 96 dpi screen; line widths are multiplied by it. 1
 * on screens that are not fine. */
double window_scale(const struct window *window);

/* Fills the screen on which the window's middle is, or restores the window's place and size. */
void window_fullscreen_set(struct window *window, bool full);
bool window_fullscreen(const struct window *window);

#endif
