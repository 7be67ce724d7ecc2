/* spring_controls.h - the parameters of a network, as a table: the only source of names,
 * units, ranges and usual values, for options, scripts, sliders and the reference.
 *
 *     struct dyn_world world = dyn_world_usual();
 *     const struct control *c = dyn_control_find("gravity");
 *     if (c && dyn_control_write(c, &world, 3.7) == DYN_OK)
 *         dyn_network_world_set(network, &world);
 *
 * Errors: functions that can fail return a status, or NULL, and leave one line in dyn_error().
 *
 * Ownership: tables and their texts are the library's, and constant. Threads: any.
 */
#ifndef LUTETIA_DYN_SPRING_CONTROLS_H
#define LUTETIA_DYN_SPRING_CONTROLS_H

#include "status.h"

#include <control.h>

/* SYMPLECTIC: semi-implicit Euler, in as many parts of a step as stability requires. VERLET:
 * velocity Verlet, likewise. THESIS: the thesis's own step (step.h). */
enum dyn_integrator { DYN_SYMPLECTIC, DYN_VERLET, DYN_THESIS };

/* All members are doubles, so that the table can describe them. */
struct dyn_world {
    double gravity, wind_x, wind_y, drag;
    double stiffness, damping, rest, mass, breaking;
    double restitution, friction;
    double floor_on, floor, ceiling_on, ceiling, left_on, left, right_on, right;
    double speed_limit, clank_speed, safety, integrator;
};

/* Each control at its usual value. */
struct dyn_world dyn_world_usual(void);

extern const struct control dyn_controls[]; /* the rows of struct dyn_world */
extern const int dyn_controls_count;

/* NULL: there is no control of that name, and dyn_error() lists the names. A row of the table,
 * valid for ever. */
const struct control *dyn_control_find(const char *name);

/* Checks that the value is in the range, and whole where required. Errors: BAD_ARGUMENT,
 * with the control's name and range. */
enum dyn_status dyn_control_check(const struct control *control, double value);

/* Errors: BAD_ARGUMENT; nothing is written. */
enum dyn_status dyn_control_write(const struct control *control, void *of, double value);

/* A choice is given by its name, a switch by "on" or "off", others by a number. Errors:
 * BAD_ARGUMENT. */
enum dyn_status dyn_control_parse(const struct control *control, const char *text,
                                  double *value);

/* Checks all members of a struct. Errors: BAD_ARGUMENT for the first wrong one. */
enum dyn_status dyn_controls_check(const struct control *controls, int count, const void *of);

#endif
