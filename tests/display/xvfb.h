/* xvfb.h - a display for one test program, and what can be seen and done on it.
 *
 *     if (!screen_start("800x600"))
 *         return 77; // there is no Xvfb
 *     ... a program opens a window titled "page" ...
 *     Window window = screen_window("page", 10);
 *     screen_read(window, &image);
 *     screen_key(window, XK_Escape);
 *
 * Xvfb takes a free number, ends with this program, and DISPLAY names it. */
#ifndef LUTETIA_TEST_XVFB_H
#define LUTETIA_TEST_XVFB_H

#include <X11/Xlib.h>
#include <display.h>
#include <stdbool.h>

/* False: Xvfb is not installed; it said so. */
bool screen_start(const char *size);
/* What desktops say of a screen to programs that are started; 0: nothing. */
void screen_dpi(int dots_per_inch);
void screen_end(void); /* and DISPLAY is unset */

/* The window that is shown under a title that has this in it, waiting for it; 0: there is none. */
Window screen_window(const char *title, double wait_s);
/* Waits until that window is no more. */
bool screen_window_gone(Window window, double wait_s);

/* What is on the screen in a window, three channels; the caller destroys it. */
void screen_read(Window window, struct display_image *image);
/* Waits until that is this image; or it is compared with it pixel by pixel, and says where it differs. */
bool screen_shows(Window window, const struct display_image *image, double wait_s);

void screen_resize(Window window, int width_px, int height_px);
void screen_key(Window window, KeySym key); /* pressed and released */
Display *screen_display(void);              /* this program's connection */
void screen_close(Window window);           /* as a click on its cross does */

#endif
