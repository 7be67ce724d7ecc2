/* script_live.h - a script that lives on a stage: it steps, draws, and hears a pointer and
 * keys, for as long as somebody looks at it.
 *
 *     local w = spring.word{text = "springs", preset = "jelly"}
 *     function step(seconds) w:step(1, seconds) end        -- before each picture
 *     function draw() return w:mask{scale = 90, x = 40, y = 180}, "#203060" end
 *     function pointer(what, x, y, pressure) ... end       -- "down", "move", "up"
 *     function key(name) ... end                           -- "a", "Left", "Return"
 *     function release(name) ... end                       -- the same key is up again
 *
 * It declares controls while its text runs, which whoever shows it makes sliders of:
 *
 *     local speed = control{name = "speed", unit = "1/s", least = 0, most = 4, usual = 1}
 *     control{name = "gravity", of = w}                    -- a row of the word's own table
 *     function draw() ... speed() ... end                  -- what it is now
 *     function changed(name, value) ... end                -- a slider was moved
 *
 * It has the whole library of scripts, and no folder: what would read or write a file is an
 * error. `stage.width` and `stage.height` are its picture's sides. Each call computes for a few
 * seconds at most; what fails, or takes longer, ends the script.
 *
 * What draw() returns is painted one over the other: papers and pictures from the upper left; a
 * mask in the colour behind it, or in dark ink; a colour by itself everywhere. A colour is
 * "#rrggbb" or {r, g, b}.
 *
 * The process is the script's own: its memory is watched as a whole. Threads: a live script
 * belongs to one. */
#ifndef LUTETIA_SCRIPT_LIVE_H
#define LUTETIA_SCRIPT_LIVE_H

#include "script.h"

#include <spring_controls.h>

enum {
    SCRIPT_LIVE_CONTROLS_MAX = 12,
    SCRIPT_LIVE_NAME_MAX = 40, /* bytes of a control's name, of its unit, of its other texts */
    SCRIPT_LIVE_UNIT_MAX = 20,
    SCRIPT_LIVE_TEXT_MAX = 200
};

struct script_live_def {
    const char *text; /* the script; borrowed while it is opened */
    size_t bytes;
    const char *name; /* for messages: "live:12: ..." */
    int width_px, height_px;
    double open_s, answer_s; /* that running the text, and each call, may compute */
    size_t memory_bytes;
    /* A line that the script prints, or why it has failed. */
    void (*print)(void *context, const char *text, size_t length);
    void (*error)(void *context, const char *text);
    /* As script_host's: the process should end. Called by another thread. */
    void (*overdue)(void *context);
    void (*overfull)(void *context);
    void *context;
};

struct script_live;
/* Runs the text, which must leave a function `draw`. Errors: FAILED, which has been told. Owns:
 * the caller closes *out. */
enum script_status script_live_open(const struct script_live_def *def,
                                    struct script_live **out);
void script_live_close(struct script_live *live); /* NULL is fine */

/* Each is false where the script failed, which has been told: it should be closed. Functions
 * that the script does not have are not called. */
bool script_live_step(struct script_live *live, double seconds);
bool script_live_pointer(struct script_live *live, const char *what, double x, double y,
                         double pressure);
bool script_live_key(struct script_live *live, bool down, const char *name);
/* A control as the script has declared it, from 0; NULL: there is none. What is usual is what
 * it was at first. Owns: the live script. */
struct script_live_control {
    struct control row; /* `at` has no meaning */
    double value;
};
const struct script_live_control *script_live_control(const struct script_live *live,
                                                      int control);
/* A value that is not in its range changes nothing. */
bool script_live_set(struct script_live *live, int control, double value);
/* Shape: rgb holds height * width * 3 bytes, rows from the top. */
bool script_live_draw(struct script_live *live, uint8_t *rgb);

#endif
