/* shown_window.h - what a program shows in a window, as it changes.
 *
 * The caller says whether there is something new (stale) and draws it (draw). It calls
 * shown_window_turn() regularly, which shows the newest. The window draws at most so many
 * pictures a second, and rests after each as long as drawing took. So it takes at most half a
 * processor from the watched program.
 *
 * The pictures of a recording wait for their times on a clock: Space stops and restarts the
 * clock, a full stop goes to the next picture, - and + (or =) halve and double the rate.
 * Several windows may have one clock. */
#ifndef LUTETIA_SHOWN_WINDOW_H
#define LUTETIA_SHOWN_WINDOW_H

#include <display_recording.h>
#include <frame_clock.h>
#include <window.h>

#include <stdbool.h>

/* All zeros: not begun. */
struct shown_clock {
    struct frame_clock clock; /* for pictures with known times, after the first wait */
    bool began, next_wanted;
};

/* Seconds until a time of the clock; 0: it has passed. The clock begins at 0 with the first
 * call. While it stands still the result is infinity; each turn of a window may change it. */
double shown_clock_wait_s(struct shown_clock *clock, double time_s);

struct shown_window {
    bool (*stale)(void *context);
    /* No pixels: what is seen stays. */
    enum display_status (*draw)(void *context, struct display_image *image);
    /* NULL, or draws into the window's room (window_room_begin()). False: it could not. */
    bool (*paint)(void *context, struct window *window);
    void *context;
    struct shown_clock *clock; /* NULL: keys change none */

    struct window *window;
    struct display_image image;
    struct frame_pace pace; /* of pictures */
};

/* title: copied. fps: pictures a second at most. The functions are set before. Errors: those of
 * window_create(). Owns: the caller closes it. */
enum display_status shown_window_open(struct shown_window *window, const char *title,
                                      int width_px, int height_px, double fps);
/* NULL, and one that was not opened, are fine. */
void shown_window_close(struct shown_window *window);

void shown_window_title(struct shown_window *window, const char *title);

/* Draws now. Errors: those of draw() and window_show(). */
enum display_status shown_window_draw(struct shown_window *window);

/* Seconds until there is something to be drawn: 0, now; infinity: there is nothing new. */
double shown_window_due_s(const struct shown_window *window);

/* Takes events for wait_s seconds, and draws if a picture is due. *open becomes false when
 * the window was closed or Esc pressed. Errors: those of shown_window_draw(). */
enum display_status shown_window_turn(struct shown_window *window, double wait_s, bool *open);

/* Paints a screen where the window has its pixels; those of the room that is shared with the
 * program are shown from there. False: there is no such place, draw it. Call window_settle()
 * before, without the reader's lock: here nothing is waited for. */
bool shown_window_paint(struct window *window, struct display_reader *reader, int number);

#endif
