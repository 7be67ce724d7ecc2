/* screens.h - the screens of a display, as GLFW tells of them: windows that fill one, or all.
 *
 * Threads. The main thread, once GLFW is there. */
#ifndef LUTETIA_SCREENS_H
#define LUTETIA_SCREENS_H

#include "glfw_library.h"

#include <stddef.h>

enum { SCREENS_MAX = 16 };

/* Screens, from 0. */
struct screens {
    int over[SCREENS_MAX], over_count; /* the window lies over them */
    int same[SCREENS_MAX], same_count; /* each of them shows the same picture, besides */
};

/* Reads "1", "1,2" (the window lies over both), "1=3" (each shows the same), "1,2=3=4", "all"
 * (over all). False: there are no such screens; `why` has one line, with those that there
 * are. */
bool screens_read(const char *words, struct screens *out, char *why, size_t room);

/* The screen, from 0, that has a point of the desktop; else the first. */
int screens_at(int x, int y);

/* Lets a window fill a screen as it is. False: there is none. */
bool screens_fill(GLFWwindow *window, int screen);
/* Lays a window over screens, and what lies between them. */
void screens_cover(GLFWwindow *window, const int *screens, int count);

#endif
