/* leds_window.h - the machine's lights in a window, as they change.
 *
 * The caller passes the lights as often as they change, and calls leds_window_turn() regularly,
 * which shows the newest. The window draws at most so many pictures a second, and rests after
 * each as long as drawing took. So it takes at most half a processor from the watched program.
 *
 * The frames of a recording wait for their times on the window's clock: Space stops and
 * restarts the clock, a full stop goes to the next frame, - and + (or =) halve and double
 * the rate.
 */
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
        clock; /* for frames with known times, after the first leds_window_wait_s() */
    bool clock_began, next_wanted;
};

/* title: copied. fps: pictures a second at most. Errors: those of window_create(). Owns: the caller closes it. */
enum display_status leds_window_open(const char *title, int width_px, int height_px, double fps,
                                     struct leds_window *window);
void leds_window_close(struct leds_window *window); /* NULL is fine */

void leds_window_title(struct leds_window *window, const char *title);

/* Shows this front from now on, at first without lights; before the first call nothing is
 * shown. panel: borrowed until the window is closed. Errors: as leds_window_turn(). */
enum display_status leds_window_panel(struct leds_window *window, struct front_panel *panel);

/* Sets the present lights. */
void leds_window_light(struct leds_window *window, const uint8_t lights[FRONT_PANEL_BYTES]);

/* Takes events for wait_s seconds, and draws if a picture is due. *open becomes false when
 * the window was closed or Esc pressed. Errors: those of front_panel_draw() and
 * window_show(). */
enum display_status leds_window_turn(struct leds_window *window, double wait_s, bool *open);

/* Seconds until a time of the window's clock; 0: it has passed. The clock begins at 0 with
 * the first call. While the clock stands still the result is infinity; each turn may change
 * it. */
double leds_window_wait_s(struct leds_window *window, double time_s);

#endif
