/* control_table.h - the controls of an actor, as a table: the only source of names, units,
 * ranges and usual values, for the command line, scripts, sliders and the reference.
 *
 *     static const struct stage_control rows[] = {
 *         {.name = "gravity", .unit = "em/s2", .least = -100, .most = 100, .usual = 9.81,
 *          .does = "pulls masses down", .read = gravity_read, .write = gravity_write, .index = 0},
 *     };
 *     const struct stage_control *row = stage_control_find(rows, 1, "gravity");
 *     stage_control_set(row, actor, "3.7");
 *
 * Everything adjustable is in such a table.
 */
#ifndef LUTETIA_STAGE_CONTROL_TABLE_H
#define LUTETIA_STAGE_CONTROL_TABLE_H

#include "stage_status.h"

#include <control_curve.h>

#include <stddef.h>

struct stage_control {
    const char *name, *unit; /* unit: "" for a pure number */
    double least, most, usual;
    enum control_curve curve;
    const char *choices; /* of a CHOICE: names, separated by blanks */
    const char *does;    /* half a sentence */
    double (*read)(void *actor, int index);
    enum stage_status (*write)(void *actor, int index, double value);
    int index; /* handed to both */
};

/* NULL: there is no control of that name, and stage_error() lists the names. */
const struct stage_control *stage_control_find(const struct stage_control *rows, int count,
                                               const char *name);

/* Errors: BAD_ARGUMENT outside of the range, or not whole where it must be. */
enum stage_status stage_control_check(const struct stage_control *row, double value);
double stage_control_read(const struct stage_control *row, void *actor);
/* Errors: BAD_ARGUMENT outside of the range (a switch: 0 or 1, a choice: whole), and the
 * actor's errors; nothing changes. */
enum stage_status stage_control_write(const struct stage_control *row, void *actor,
                                      double value);

/* Reads a value from text: a number, "on" or "off" for a switch, a name for a choice.
 * Errors: BAD_ARGUMENT. */
enum stage_status stage_control_parse(const struct stage_control *row, const char *text,
                                      double *value);
/* Writes a value as text, without its unit; at most room - 1 characters. */
void stage_control_text(const struct stage_control *row, double value, char *text, size_t room);
/* The same of a number that can be typed: with as few decimals as tell it apart from values
 * near it, at most 9, and never with an exponent. */
void stage_control_number(const struct stage_control *row, double value, char *text,
                          size_t room);

/* Converts a value to a slider's position, 0..1, and back, by the curve; for what MIDI plays,
 * too. A logarithmic range whose usual value is one of its ends has its geometric middle in the
 * middle. One that begins at 0 or below is linear there, below a thousandth of the middle's
 * value. */
double stage_control_along(const struct stage_control *row, double value);
double stage_control_at(const struct stage_control *row, double along);

#endif
