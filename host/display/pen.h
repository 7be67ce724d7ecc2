/* pen.h - a pen's pressure and tilt. GLFW does not report them; on X11 the valuators of XInput
 * 2 do.
 *
 * A separate connection to the X server receives the raw reports of all devices, for whichever
 * window. The device that last moved the pointer is taken as the source of a window's events.
 * Without XInput 2 (built without libxi-dev, no X11, no device that measures pressure) there is
 * no pen, and everything else works.
 *
 * Threads. As window.h.
 */
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
/* The devices' last reported state. pen may be NULL: no pen. */
struct pen_state pen_now(struct pen *pen);

/* ---- one device's reports ---- */

/* Which of a device's valuators measures what; number -1: none. */
struct pen_axis {
    int number;
    double least, most;
};
struct pen_axes {
    struct pen_axis pressure, tilt_x, tilt_y;
};

/* Takes a report: bit i of mask says that valuator i changed; values has the new values of
 * these valuators, in order. */
void pen_report(const struct pen_axes *axes, const unsigned char *mask, int mask_bytes,
                const double *values, struct pen_state *state);

#endif
