/* xvfb.h - a display for one test program: reads its screen and types on it.
 *
 *     if (!screen_start("800x600"))
 *         return 77; // there is no Xvfb
 *     ... a program opens a window titled "page" ...
 *     Window window = screen_window("page", 10);
 *     screen_read(window, &image);
 *     screen_key(window, XK_Escape);
 *
 * Xvfb takes a free display number and ends with this program; DISPLAY is set to it. */
#ifndef LUTETIA_TEST_XVFB_H
#define LUTETIA_TEST_XVFB_H

#include <X11/Xlib.h>
#include <display.h>
#include <stdbool.h>

/* WIDTHxHEIGHT, of 24 bits, or WIDTHxHEIGHTxBITS. Returns false with a message where Xvfb is
 * not installed. */
bool screen_start(const char *size);
/* Sets the resolution that desktops tell programs; 0: none. */
void screen_dpi(int dots_per_inch);
void screen_end(void); /* and DISPLAY is unset */

/* Waits for a visible window whose title contains this text; 0: none came. */
Window screen_window(const char *title, double wait_s);
/* Waits until the window is gone. */
bool screen_window_gone(Window window, double wait_s);

/* Reads a window's pixels from the screen, three channels of 8 bits, whatever the screen has;
 * the caller destroys the image. */
void screen_read(Window window, struct display_image *image);
/* Waits until the window shows this image. False, with the first pixel that differs printed: it
 * does not. */
bool screen_shows(Window window, const struct display_image *image, double wait_s);

void screen_resize(Window window, int width_px, int height_px);
void screen_key(Window window, KeySym key); /* pressed and released */
Display *screen_display(void);              /* this program's connection */
void screen_close(Window window);           /* as a click on its cross does */

#endif
