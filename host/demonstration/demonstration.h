/* demonstration.h - a live script, or a program in C/Paris, in a process of its own, and what
 * it draws.
 *
 *     struct demonstration_def def = demonstration_def_default(text, bytes, 600, 240);
 *     struct demonstration *d;
 *     if (!demonstration_start(&def, &d))
 *         say(demonstration_error());
 *     ... for each picture of the window:
 *     demonstration_frame(d, 1.0 / 60);           // and again, whenever there is time
 *     if (demonstration_take(d))
 *         show(demonstration_picture(d));
 *     if (demonstration_ended(d))
 *         say(demonstration_ended(d));            // why, one line; it does not run again
 *     demonstration_stop(d);
 *
 * The script is that of script_live.h. Its process, lutetia-demonstration, has the sandbox and
 * the limits of `lutetia run`, no folder, and nothing open but a socket and its pictures. It
 * ends with this one. It computes only when it is asked for a picture: who asks for none pauses
 * it. What it sends is checked; nothing that it does can make these functions wait, but for the
 * moment in which a process that has closed its socket ends.
 *
 * A program is compiled and runs in jails of its own (paris/keeper.h); its lights or its
 * display are its picture, and it hears nothing. It needs a system that has Landlock.
 *
 * Threads: a demonstration belongs to the one that has started it. */
#ifndef LUTETIA_DEMONSTRATION_H
#define LUTETIA_DEMONSTRATION_H

#include "demonstration_wire.h"

enum { DEMONSTRATION_SCRIPT_MAX = 1 << 20, DEMONSTRATION_LINES = 8 };

struct demonstration_def {
    const char *text; /* the script, or the program; copied */
    size_t bytes;
    int width_px, height_px; /* DEMONSTRATION_SIDE_MIN.._MAX */
    bool program;            /* in C/Paris */
    int memory_mb;
    double answer_s;   /* that a call of the script may compute; of a program four times as long
                        * to be compiled, and six times without anything new */
    double patience_s; /* without an answer the process is ended */
};
/* 512 MB; 5 s of computing, 120 s of waiting. */
struct demonstration_def demonstration_def_default(const char *text, size_t bytes, int width_px,
                                                   int height_px);

struct demonstration;
/* False: demonstration_error() says why. Owns: the caller stops *out. */
bool demonstration_start(const struct demonstration_def *def, struct demonstration **out);
/* This thread's last reason. */
const char *demonstration_error(void);
/* Ends the process. NULL is fine. */
void demonstration_stop(struct demonstration *d);

/* Asks for the next picture, so many seconds later, behind all that was heard since; while one
 * is asked for, the seconds are added to the next one's. A script is told of a tenth of a
 * second at most, and steps only where time has passed. */
void demonstration_frame(struct demonstration *d, double seconds);
/* Heard before the next picture. Of more than the process has time for the last moves count. */
void demonstration_pointer(struct demonstration *d, enum demonstration_pointer what, double x,
                           double y, double pressure);
void demonstration_key(struct demonstration *d, bool down, const char *name);
/* Sets one of its controls, from 0. */
void demonstration_set(struct demonstration *d, int control, double value);

/* Takes what has come. True: there is another picture. */
bool demonstration_take(struct demonstration *d);
/* A picture is asked for and not there yet. */
bool demonstration_waits(const struct demonstration *d);
/* The last picture: rows of red, green, blue without gaps; NULL: none yet. Owns: the
 * demonstration; until the next one is taken. */
const uint8_t *demonstration_picture(const struct demonstration *d);
/* How many pictures have come. */
long demonstration_pictures(const struct demonstration *d);
/* A control that the script has declared, from 0, once that was taken: all of them have come
 * before the first picture. What it is set to is in it, too. NULL: there is none. Owns: the
 * demonstration. */
const struct demonstration_control *demonstration_control(const struct demonstration *d,
                                                          int control);
/* The last line that the script has printed; of a program, that it is compiled; "": none. */
const char *demonstration_said(const struct demonstration *d);
/* A line that a program has printed, of the last DEMONSTRATION_LINES, the oldest first; NULL:
 * there is none. Of one that was not compiled: what is wrong with it. */
const char *demonstration_line(const struct demonstration *d, int line);
/* How many lines have come. */
long demonstration_lines(const struct demonstration *d);
/* Why it has ended; NULL: it runs. */
const char *demonstration_ended(const struct demonstration *d);

#endif
