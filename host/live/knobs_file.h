/* knobs_file.h - which knob of an instrument moves which control, and scenes, as a text file.
 *
 *     knobs 1
 *     theme dark                                the stage's colours; may be left out
 *     knob control 1 74 gravity 0 0.5           MIDI channel 1, controller 74: from one end of
 *                                               the way to the other
 *     knob fine 1 7 drag 0 1                    controllers 7 and 39 together: 14 bits
 *     knob nrpn 1 1000 mass 0 1                 a parameter without a registered number, 0..16383
 *     knob bend * stiffness 0.2 0.8             the pitch wheel of any channel
 *     knob pressure 1 rate 0 1                  the channel's aftertouch
 *     knob note 10 36 restitution 1 0           how hard a key is struck
 *     knob clock wind_x 0 1                     the beat of a MIDI clock: once along with each
 *                                               quarter note
 *     knob tempo rate 0 1                       its tempo: 0 is 40 a minute, 1 is 240
 *     fade 5 2.5                                scene 5 is reached in so many seconds
 *     scene 5 gravity 3.7                       program change 5 (programs count from 1) sets
 *                                               this
 *     end
 *
 * Ends are parts of a slider's way, 0..1. A control has one knob; a knob may move several
 * controls. A line that begins with # is a comment. What is written is read again as the same.
 * Whether there are controls of these names the reader of the file does not know.
 *
 * Threads: any, each with values of its own.
 */
#ifndef LUTETIA_LIVE_KNOBS_FILE_H
#define LUTETIA_LIVE_KNOBS_FILE_H

#include <stage_status.h>

#include <stddef.h>

enum {
    KNOBS_MAX = 128,
    KNOBS_SCENES = 128,
    KNOBS_SETS_MAX = 4096, /* lines of scenes */
    KNOBS_NAME_BYTES = 48,
    KNOBS_THEME_BYTES = 256
};

enum knob_kind {
    KNOB_CONTROL,
    KNOB_FINE,
    KNOB_NRPN,
    KNOB_BEND,
    KNOB_PRESSURE,
    KNOB_NOTE,
    KNOB_CLOCK,
    KNOB_TEMPO,
    KNOB_KINDS
};

struct knob {
    enum knob_kind kind;
    int channel; /* 0..15; -1: any, and for a clock */
    int number;  /* of a controller or a key, 0..127; a pair's first, 0..31; a parameter's,
                  * 0..16383; else 0 */
};

struct knobs_row {
    struct knob knob;
    char control[KNOBS_NAME_BYTES];
    double from, to;
};

struct knobs_set {
    int scene; /* 1..128 */
    char control[KNOBS_NAME_BYTES], value[KNOBS_NAME_BYTES];
};

struct knobs_text {
    char theme[KNOBS_THEME_BYTES]; /* "": none */
    struct knobs_row rows[KNOBS_MAX];
    int rows_count;
    double fade_s[KNOBS_SCENES + 1]; /* by scene */
    struct knobs_set *sets;          /* in the file's order */
    int sets_count, sets_capacity;
};

/* Owns: the caller calls knobs_text_finish(), also after a failure; NULL is fine there. Errors:
 * BAD_FILE (the file's name, the line and what it must be), NO_MEMORY. */
enum stage_status knobs_text_read(const char *text, size_t bytes, const char *name,
                                  struct knobs_text *out);
enum stage_status knobs_file_read(const char *path, struct knobs_text *out);
void knobs_text_finish(struct knobs_text *text);

/* Adds a line of a scene. Errors: NO_MEMORY, BAD_ARGUMENT (there are too many). */
enum stage_status knobs_set_add(struct knobs_text *text, const struct knobs_set *set);

/* Writes the file whole, or leaves the old one. Errors: BAD_FILE. */
enum stage_status knobs_file_write(const struct knobs_text *text, const char *path);

/* "controller 74", "bend", as a person reads it; with its channel where it has one. */
void knob_words(const struct knob *knob, char *text, size_t room);

#endif
