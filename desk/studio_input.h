/* studio_input.h - recorded input: what a hand did, as lines of text.
 *
 *     # seconds  what       where from the middle of the canvas, pressure and tilt
 *     0.000      set        width 30
 *     0.100      down       -120 40 0.5
 *     0.108      move       -118.5 41 0.52 0.1 -0.2
 *     0.900      up         60 80 0.3
 *     1.000      undo
 *
 * Words: set NAME VALUE (studio_settings.h); down, move, up X Y [PRESSURE [TILT_X TILT_Y]]
 * with the units of input.h, no pressure being a mouse; eraser-down, eraser-move, eraser-up,
 * the same by a pen's other end; shift-down and alt-down, with that key held; middle-down,
 * middle-up; leave; focus-lost; action NAME [WORD]; bookmark NAME (this moment); step N; view
 * ZOOM X Y DEGREES MIRRORED; moment N (after so many deeds); type X Y TEXT (in fibers; \n is a
 * new line; springy type waits to be thrown); undo, redo, dry, seal, save FILE, picture FILE,
 * script FILE, palette FILE, save-palette FILE, stamp FILE, film FILE, measure NAME
 * (desk_measure.c), close. Times do not go back. */
#ifndef LUTETIA_STUDIO_INPUT_H
#define LUTETIA_STUDIO_INPUT_H

#include <input.h>
#include <stdbool.h>
#include <stdio.h>

enum studio_input_kind {
    STUDIO_INPUT_EVENT,
    STUDIO_INPUT_SET,
    STUDIO_INPUT_ACTION,
    STUDIO_INPUT_STEP,
    STUDIO_INPUT_VIEW,
    STUDIO_INPUT_TYPE,
    STUDIO_INPUT_SAVE,
    STUDIO_INPUT_PICTURE,
    STUDIO_INPUT_SCRIPT,
    STUDIO_INPUT_PALETTE, /* opened */
    STUDIO_INPUT_PALETTE_SAVE,
    STUDIO_INPUT_FILM,
    STUDIO_INPUT_STAMP, /* the picture is chosen */
    STUDIO_INPUT_MEASURE,
    STUDIO_INPUT_MOMENT,
    STUDIO_INPUT_BOOKMARK
};

enum { STUDIO_INPUT_TEXT = 1024 };

struct studio_input {
    enum studio_input_kind kind;
    double time_s;
    struct input_event event;
    int setting;
    double value;               /* SET, STEP, MOMENT */
    double zoom, x, y, degrees; /* VIEW; x and y also of TYPE */
    bool mirrored;
    char name[64];                /* ACTION, MEASURE */
    char text[STUDIO_INPUT_TEXT]; /* ACTION: its word; TYPE, SAVE, PICTURE */
};

/* Reads a line without its end. 1: it is something; 0: empty or a comment; -1: `why` says in
 * some words what is wrong. */
int studio_input_parse(const char *line, struct studio_input *out, char *why, size_t room);

#endif
