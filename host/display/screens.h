/* screens.h - the screens of a display, as GLFW tells of them: windows that fill one, or all.
 *
 * Threads. The main thread, once GLFW is there. */
#ifndef LUTETIA_SCREENS_H
#define LUTETIA_SCREENS_H

#include "glfw_library.h"

#include <stddef.h>

/* Whether a screen's name is "all". */
bool screens_all(const char *name);

/* Whether there is that screen: "1", "2", ... or "all". False: `why` has one line, with those
 * that there are. */
bool screens_check(const char *name, char *why, size_t room);

/* The screen, from 0, that has a point of the desktop; else the first. */
int screens_at(int x, int y);

/* Lets a window fill a screen as it is. False: there is none. */
bool screens_fill(GLFWwindow *window, int screen);
/* Lays a window over all screens. */
void screens_cover(GLFWwindow *window);

#endif
