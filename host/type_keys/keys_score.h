/* keys_score.h - a song as letters: which key has which letter, and how large it is at any moment.
 *
 *     size
 *      |    ______            velocity: how large
 *      |   /      \_          aftertouch: larger still, up to `pressure` of what is left
 *      |  /         \___      release: how fast it goes; slowly let go, it goes slowly
 *      +-/--------------\---- time
 *       attack
 *
 * A sustain pedal keeps what is let go. What one key plays several times is one letter; the largest counts.
 *
 * Source of the idea: Small 1990, 3.2: a key's velocity and aftertouch are the size of a letter. */
#ifndef LUTETIA_KEYS_SCORE_H
#define LUTETIA_KEYS_SCORE_H

#include <midi_song.h>

struct keys_def {
    double attack_s;  /* until it is as large as its velocity; 0.03 */
    double release_s; /* to a third after it is let go at the middle velocity; 0.25 */
    double
        pressure; /* of what a velocity leaves to the most, full aftertouch adds so much; 0..1; 1 */
};
struct keys_def keys_def_default(void);

struct keys_note {
    int note, channel;
    double begin_s, end_s;
    double velocity, release; /* 0..1 */
};

struct keys_pressure {
    double time_s, value; /* 0..1 */
    int note, channel;    /* note -1: all of the channel */
};

struct keys_score {
    struct keys_def def;
    struct keys_note *notes; /* by their beginnings */
    struct keys_pressure *pressures;
    int notes_count, pressures_count;
    int keys[MIDI_NOTES], keys_count; /* those that are played, from the lowest */
    int rank[MIDI_NOTES];             /* where a key is among them; -1: it is not played */
    double seconds;
    struct keys_hands *hands; /* what is down, as messages go by */
};

/* False: no memory (*empty false), or no note is in the song (*empty true). Owns: the caller finishes *out. */
bool keys_score_make(const struct keys_def *def, struct midi_song *song, struct keys_score *out,
                     bool *empty);
void keys_score_finish(struct keys_score *score);

/* ---- as it is played ---- */

/* No note yet, and no key. False: no memory. Owns: the caller finishes *out, also then. */
bool keys_score_begin(const struct keys_def *def, struct keys_score *out);
/* These keys are those that are played. */
void keys_score_range(struct keys_score *score, int lowest, int highest);
/* A message with its status byte; times never go back. False: no memory. */
bool keys_score_take(struct keys_score *score, double time_s, const uint8_t *bytes);
/* Notes that have ended and faded are forgotten: what is played for hours takes no more memory than its loudest minute. */
void keys_score_forget(struct keys_score *score, double time_s);

/* ---- how large ---- */

/* 0..1. */
double keys_note_level(const struct keys_score *score, int index, double time_s);
/* The largest of the key's notes; *index: which, if it is not NULL; -1 where none sounds. */
double keys_key_level(const struct keys_score *score, int key, double time_s, int *index);
/* The largest that a note gets, once its attack is over. */
double keys_note_most(const struct keys_score *score, int index);

#endif
