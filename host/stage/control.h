/* control.h - what can be adjusted of an actor, as a table: the one place that names, units, ranges and usual values come
 * from, for the command line, scripts, sliders and the reference.
 *
 *     static const struct stage_control rows[] = {
 *         {.name = "gravity", .unit = "em/s2", .least = -100, .most = 100, .usual = 9.81,
 *          .does = "pulls masses down", .read = gravity_read, .write = gravity_write, .index = 0},
 *     };
 *     const struct stage_control *row = stage_control_find(rows, 1, "gravity");
 *     stage_control_set(row, actor, "3.7");
 *
 * Nothing is adjustable that is not in a table. */
#ifndef LUTETIA_STAGE_CONTROL_H
#define LUTETIA_STAGE_CONTROL_H

#include "stage_status.h"

#include <stddef.h>

/* How a slider goes along the range. SWITCH: 0 or 1. CHOICE: the number of one of the choices. */
enum stage_curve { STAGE_LINEAR, STAGE_LOGARITHMIC, STAGE_SWITCH, STAGE_CHOICE };

struct stage_control {
    const char *name, *unit; /* unit: "" for a pure number */
    double least, most, usual;
    enum stage_curve curve;
    const char *choices; /* of a CHOICE: names by blanks */
    const char *does;    /* half a sentence */
    double (*read)(void *actor, int index);
    enum stage_status (*write)(void *actor, int index, double value);
    int index; /* handed to both */
};

/* NULL: there is none of that name, and stage_error() tells which there are. */
const struct stage_control *stage_control_find(const struct stage_control *rows, int count,
                                               const char *name);

double stage_control_read(const struct stage_control *row, void *actor);
/* Errors: BAD_ARGUMENT outside of the range (a switch: 0 and 1, a choice: whole), and what the actor says; nothing changes. */
enum stage_status stage_control_write(const struct stage_control *row, void *actor,
                                      double value);

/* The value of a text: a number, "on" and "off" of a switch, a choice by its name. Errors: BAD_ARGUMENT. */
enum stage_status stage_control_parse(const struct stage_control *row, const char *text,
                                      double *value);
/* The text of a value, without its unit; at most room - 1 characters. */
void stage_control_text(const struct stage_control *row, double value, char *text, size_t room);

/* Along a slider, 0..1, and back: by the curve. A range that begins at 0 or below cannot be logarithmic all along: there
 * the first hundredth of the most is linear. */
double stage_control_along(const struct stage_control *row, double value);
double stage_control_at(const struct stage_control *row, double along);

#endif
