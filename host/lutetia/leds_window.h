/* leds_window.h - the machine's lights in a window, as they change.
 *
 * Lights are given to it as often as they change, and at its turns it shows the newest of them: at
 * most so many pictures a second, and it rests as long as a picture took to draw, so that it never
 * takes more than half a processor from the program that is watched.
 *
 * What happens at known times, a recording, waits for them on the window's clock: Space stops the clock and lets it go on,
 * a full stop goes to what happens next, - and + (or =) halve and double its rate. */
#ifndef LUTETIA_LEDS_WINDOW_H
#define LUTETIA_LEDS_WINDOW_H

#include <frame_clock.h>
#include <front_panel.h>
#include <window.h>

#include <stdbool.h>

struct leds_window {
    struct window *window;
    struct front_panel *panel;
    struct display_image image;
    uint8_t lights[FRONT_PANEL_BYTES], drawn[FRONT_PANEL_BYTES];
    struct frame_pace pace; /* of pictures */
    struct frame_clock
        clock; /* of what happens at known times, once leds_window_wait_s() was called */
    bool clock_began, next_wanted;
};

/* title: copied. fps: pictures a second at most. Errors: those of window_create(). Owns: the caller closes it. */
enum display_status leds_window_open(const char *title, int width_px, int height_px, double fps,
                                     struct leds_window *window);
void leds_window_close(struct leds_window *window); /* NULL is fine */

void leds_window_title(struct leds_window *window, const char *title);

/* From now on it is this front that is shown, without lights at first; before, nothing is. panel: borrowed until the
 * window is closed. Errors: as leds_window_turn(). */
enum display_status leds_window_panel(struct leds_window *window, struct front_panel *panel);

/* The lights are now these. */
void leds_window_light(struct leds_window *window, const uint8_t lights[FRONT_PANEL_BYTES]);

/* Takes events for wait_s seconds, and draws what is due then. *open: it has not been closed, nor Esc pressed.
 * Errors: those of front_panel_draw() and window_show(). */
enum display_status leds_window_turn(struct leds_window *window, double wait_s, bool *open);

/* How many seconds from now a moment of the window's clock is; 0: it has come. The clock begins at 0 with the first
 * call. While the clock stands still the answer is infinity; it may change with each turn. */
double leds_window_wait_s(struct leds_window *window, double time_s);

#endif
