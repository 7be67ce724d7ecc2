/* window.h - a window that shows images, and what happens to it: keys, another size, closing.
 *
 *     struct window_config config = window_config_default();
 *     struct window *window;
 *     struct window_event event;
 *     config.title = "page";
 *     if (window_create(&config, &window) != DISPLAY_OK ||
 *         window_show(window, &page) != DISPLAY_OK)
 *         die(display_error());
 *     while (!window_closing(window))
 *         if (window_event_take(window, 0.1, &event) && event.key == WINDOW_KEY_ESCAPE)
 *             window_close(window);
 *     window_destroy(window);
 *
 * An image is as large as fits, its sides keep their ratio, and what is left is black. One as large
 * as the window is shown pixel for pixel. The window shows its image again by itself when it is
 * uncovered or resized, as long as events are taken.
 *
 * Units. A window's size is asked for in pixels of a screen of 96 dpi; where the screen is finer the
 * window has as many more pixels. Sizes in events are pixels.
 * Errors. As in display.h.
 * Threads. All calls from the main thread. Each makes its window's GL context the current one. */
#ifndef LUTETIA_WINDOW_H
#define LUTETIA_WINDOW_H

#include "display.h"

#include <stdbool.h>

enum { WINDOW_SIDE_MIN = 16, WINDOW_SIDE_MAX = 16384 };

struct window_config {
    const char *title; /* UTF-8, copied; "lutetia" */
    int width_px,
        height_px; /* WINDOW_SIDE_MIN..MAX; 960x960. Made smaller where the screen is */
    bool vsync;    /* a picture waits for the screen to be ready for it; true */
};
struct window_config window_config_default(void);

struct window;

/* A display there may be: DISPLAY or WAYLAND_DISPLAY is set and this build has windows. */
bool window_possible(void);

/* Errors: NO_WINDOW where there is no display, or none that can draw, or the build has no windows;
 * BAD_ARGUMENT, NO_MEMORY; *out is then NULL. Owns: the caller destroys *out. */
enum display_status window_create(const struct window_config *config, struct window **out);
void window_destroy(struct window *window); /* NULL is fine */

void window_title_set(struct window *window, const char *title);

/* Shows an image: one channel is gray, three are red, green, blue, and a fourth is how much of the
 * black behind is covered. The image is copied. Errors: BAD_ARGUMENT where it has no pixels, or more
 * on a side than the graphics card takes; what was shown stays. */
enum display_status window_show(struct window *window, const struct display_image *image);

/* Pixels there are to draw on. */
void window_size(const struct window *window, int *width_px, int *height_px);

/* Someone closed it, or window_close() did. The window is there until it is destroyed. */
bool window_closing(const struct window *window);
void window_close(struct window *window);

enum window_event_kind {
    WINDOW_EVENT_NONE,
    WINDOW_EVENT_CLOSE, /* window_closing() from now on */
    WINDOW_EVENT_KEY,   /* pressed, or repeated while it is held */
    WINDOW_EVENT_SIZE
};

/* Keys that write a character are that character, capital letters for letters: 'A', '1', ' '. */
enum {
    WINDOW_KEY_ESCAPE = 0x110000, /* above Unicode */
    WINDOW_KEY_ENTER,
    WINDOW_KEY_TAB,
    WINDOW_KEY_BACKSPACE,
    WINDOW_KEY_DELETE,
    WINDOW_KEY_LEFT,
    WINDOW_KEY_RIGHT,
    WINDOW_KEY_UP,
    WINDOW_KEY_DOWN,
    WINDOW_KEY_OTHER
};

struct window_event {
    enum window_event_kind kind;
    int key;                 /* KEY: a WINDOW_KEY_ or a character; else 0 */
    bool shift, control;     /* KEY: held with it */
    int width_px, height_px; /* SIZE: what window_size() says now; else 0 */
};

/* The next event, waiting for one wait_s seconds at most (0: not at all). False: there is none, and
 * *event is NONE. Keys are dropped where WINDOW_EVENTS_MAX are waiting; sizes become one, the last. */
bool window_event_take(struct window *window, double wait_s, struct window_event *event);
enum { WINDOW_EVENTS_MAX = 64 };

#endif
