/* xorg.h - an Xorg of a test's own, with the driver of no screen ("dummy"), for what Xvfb does
 * not have: several screens, input devices.
 *
 *     static char folder[] = "/tmp/lutetia-screens-XXXXXX";
 *     if (mkdtemp(folder) && config_write() && xorg_start(folder))   // FOLDER/conf
 *         test(xorg_display());
 *     xorg_end(folder);
 */
#ifndef LUTETIA_TEST_XORG_H
#define LUTETIA_TEST_XORG_H

#include <X11/Xlib.h>
#include <stdbool.h>

/* Starts it with the folder's file `conf`; DISPLAY names it from then on. False: there is no
 * such server here, or it may not be started. */
bool xorg_start(const char *folder);
/* The test's connection to it; NULL: there is none. */
Display *xorg_display(void);
/* Ends it, and removes the folder. */
void xorg_end(const char *folder);

#endif
