/* control.h - a number that can be set: its name, unit, range, usual value, and how to read and
 * write it. Tables of them are the only source of all that for the command line, scripts,
 * sliders, MIDI, files and the reference.
 *
 *     static const struct control rows[] = {
 *         {"gravity", "units/s2", -100, 100, 9.81, CONTROL_CENTRED, NULL, "pulls masses down",
 *          .at = offsetof(struct world, gravity)},
 *     };
 *     const struct control *row = control_find(rows, 1, "gravity", names, sizeof names);
 *     if (row && control_parse(row, "3.7", &value, &why))
 *         control_put(row, &world, value);
 *
 * Modules that have such tables keep their errors in their own way: why is the text for them.
 * Ownership: tables and their texts are the caller's. Threads: any. */
#ifndef LUTETIA_CONTROL_H
#define LUTETIA_CONTROL_H

#include "error_text.h"

#include <stdbool.h>
#include <stddef.h>

/* How values lie along a slider. LOGARITHMIC and CENTRED: the usual value is in the middle, and
 * values near it have the most of the way. SWITCH: 0 or 1. CHOICE: the number of one of the
 * choices. */
enum control_curve {
    CONTROL_LINEAR,
    CONTROL_LOGARITHMIC,
    CONTROL_CENTRED,
    CONTROL_SWITCH,
    CONTROL_CHOICE
};
enum { CONTROL_CURVES = CONTROL_CHOICE + 1 };

struct control {
    const char *name, *unit; /* unit: "" for a pure number */
    double least, most, usual;
    enum control_curve curve;
    const char *choices; /* of a CHOICE: names, separated by blanks */
    const char *does;    /* half a sentence */
    /* The value is read and written by these two, which get `at`. write returns 0, or a
     * status of the module that has the table. NULL: the value is a double in a struct, and
     * `at` is its offset. */
    double (*read)(void *of, int at);
    unsigned (*write)(void *of, int at, double value);
    int at;
};

/* NULL: there is no row of that name, and names lists those that there are, as many as there is
 * room for. */
const struct control *control_find(const struct control *rows, int count, const char *name,
                                   char *names, size_t room);

/* False: the value is outside of the range, or not whole where it must be; why says so. */
bool control_check(const struct control *row, double value, struct error_text *why);

double control_read(const struct control *row, const void *of);
/* Writes without a check. Returns 0, or what the row's write returned. */
unsigned control_put(const struct control *row, void *of, double value);

/* Reads a value from text: a number, "on" or "off" for a switch, a name for a choice. False:
 * it is none, or control_check() refuses it; why says so. */
bool control_parse(const struct control *row, const char *text, double *value,
                   struct error_text *why);
/* Writes a value as text, without its unit; at most room - 1 characters. */
void control_text(const struct control *row, double value, char *text, size_t room);
/* The same of a number that can be typed: with as few decimals as tell it apart from values
 * near it, at most 9, and never with an exponent. */
void control_number(const struct control *row, double value, char *text, size_t room);

/* Converts a value to a slider's position, 0..1, and back, by the curve; for what MIDI plays,
 * too. A logarithmic range whose usual value is one of its ends has its geometric middle in the
 * middle. One that begins at 0 or below is linear there, below a thousandth of the middle's
 * value. */
double control_along(const struct control *row, double value);
double control_at(const struct control *row, double along);

#endif
