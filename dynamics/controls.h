/* controls.h - what can be adjusted of a whole network, as a table: the one place that names, units, ranges and what is
 * usual come from, for options, scripts, sliders and the reference.
 *
 *     struct dyn_world world = dyn_world_usual();
 *     const struct dyn_control *c = dyn_control_find("gravity");
 *     if (c && dyn_control_write(c, &world, 3.7) == DYN_OK)
 *         dyn_network_world_set(network, &world); */
#ifndef LUTETIA_DYN_CONTROLS_H
#define LUTETIA_DYN_CONTROLS_H

#include "status.h"

#include <stddef.h>

/* How a slider goes along the range. SWITCH: 0 or 1. CHOICE: the number of one of the choices. */
enum dyn_curve { DYN_LINEAR, DYN_LOGARITHMIC, DYN_SWITCH, DYN_CHOICE };

struct dyn_control {
    const char *name, *unit; /* unit: "" for a pure number */
    double least, most, usual;
    enum dyn_curve curve;
    const char *choices; /* by blanks; NULL where there are none */
    const char *does;
    size_t at; /* of the double in the struct that the table is about */
};

/* SYMPLECTIC: semi-implicit Euler in as many parts of a step as stability asks for. VERLET: velocity Verlet, likewise.
 * THESIS: the thesis's own step (step.h). */
enum dyn_integrator { DYN_SYMPLECTIC, DYN_VERLET, DYN_THESIS };

/* Doubles all, for the table's sake. */
struct dyn_world {
    double gravity, wind_x, wind_y, drag;
    double stiffness, damping, rest, mass, breaking;
    double restitution, friction;
    double floor_on, floor, ceiling_on, ceiling, left_on, left, right_on, right;
    double speed_limit, clank_speed, safety, integrator;
};

struct dyn_world dyn_world_usual(void);

extern const struct dyn_control dyn_controls[]; /* the rows of struct dyn_world */
extern const int dyn_controls_count;

/* NULL: there is none of that name, and dyn_error() tells which there are. */
const struct dyn_control *dyn_control_find(const char *name);

/* Within the range, and where it must be, whole. Errors: BAD_ARGUMENT, with the control's name and range. */
enum dyn_status dyn_control_check(const struct dyn_control *control, double value);

/* Of the struct that the control's table is about. */
double dyn_control_read(const struct dyn_control *control, const void *of);
/* Errors: BAD_ARGUMENT; nothing is written. */
enum dyn_status dyn_control_write(const struct dyn_control *control, void *of, double value);

/* A choice by its name, a switch by "on" and "off", else a number. Errors: BAD_ARGUMENT. */
enum dyn_status dyn_control_parse(const struct dyn_control *control, const char *text,
                                  double *value);

/* All of a struct at once. Errors: BAD_ARGUMENT for the first that is wrong. */
enum dyn_status dyn_controls_check(const struct dyn_control *controls, int count,
                                   const void *of);

#endif
