/* pen.h - how hard a pen is pressed and how it leans: GLFW does not say. On X11 the valuators of XInput 2 do.
 *
 * A connection of its own listens to what devices report, raw, whichever window it is for: the last device that moved the
 * pointer is the one that a window's events come from. Without XInput 2 (libxi-dev was not there, no X11, no device that
 * measures pressure) there is no pen, and everything else is the same.
 *
 * Threads. As window.h. */
#ifndef LUTETIA_PEN_H
#define LUTETIA_PEN_H

#include <stdbool.h>

struct pen_state {
    bool is_pen; /* the pointer was last moved by a device that measures pressure */
    double pressure, tilt_x, tilt_y; /* as input.h has them */
};

struct pen;
struct pen *pen_open(void); /* NULL: there is none */
void pen_close(struct pen *pen);
/* What the devices have reported until now. NULL is no pen. */
struct pen_state pen_now(struct pen *pen);

/* ---- one device's reports ---- */

/* Which of a device's valuators measures what; number -1: none does. */
struct pen_axis {
    int number;
    double least, most;
};
struct pen_axes {
    struct pen_axis pressure, tilt_x, tilt_y;
};

/* Takes a report: bit i of mask says that valuator i changed, values has the new values of those, in order. */
void pen_report(const struct pen_axes *axes, const unsigned char *mask, int mask_bytes,
                const double *values, struct pen_state *state);

#endif
