/* keys_score.h - a song as letters: each key's letter, and its size at any moment.
 *
 *     size
 *      |    ______            velocity: how large
 *      |   /      \_          aftertouch: larger still, up to `pressure` of what is left
 *      |  /         \___      release: how fast it goes; slowly let go, it goes slowly
 *      +-/--------------\---- time
 *       attack
 *
 * A sustain pedal holds released notes. Simultaneous notes of one key are one letter; the
 * largest counts.
 *
 * Source of the idea: Small 1990, 3.2: a key's velocity and aftertouch are the size of a
 * letter.
 */
#ifndef LUTETIA_KEYS_SCORE_H
#define LUTETIA_KEYS_SCORE_H

#include <midi_song.h>

struct keys_def {
    double attack_s;  /* time until it is as large as its velocity; 0.03 */
    double release_s; /* time to shrink to a third, after a release at the middle velocity;
                       * 0.25 */
    double pressure;  /* the part of the remaining size that full aftertouch adds; 0..1; 1 */
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
    int keys[MIDI_NOTES], keys_count; /* the keys that are played, from the lowest */
    int rank[MIDI_NOTES];             /* index of a key among them; -1: not played */
    double seconds;
    struct keys_hands *hands; /* what is down, as messages go by */
};

/* False: no memory (*empty false), or the song has no notes (*empty true). Owns: the caller
 * finishes *out. */
bool keys_score_make(const struct keys_def *def, struct midi_song *song, struct keys_score *out,
                     bool *empty);
void keys_score_finish(struct keys_score *score);

/* ---- as it is played ---- */

/* An empty score. False: no memory. Owns: the caller finishes *out, also then. */
bool keys_score_begin(const struct keys_def *def, struct keys_score *out);
/* These keys are those that are played. */
void keys_score_range(struct keys_score *score, int lowest, int highest);
/* A message with its status byte; times never go back. False: no memory. */
bool keys_score_take(struct keys_score *score, double time_s, const uint8_t *bytes);
/* Forgets notes that have ended and faded: hours of playing take no more memory than the
 * busiest minute. */
void keys_score_forget(struct keys_score *score, double time_s);

/* ---- how large ---- */

/* 0..1. */
double keys_note_level(const struct keys_score *score, int index, double time_s);
/* The largest of the key's notes; *index: which, if it is not NULL; -1 where none sounds. */
double keys_key_level(const struct keys_score *score, int key, double time_s, int *index);
/* The aftertouch of a note, 0..1. */
double keys_note_pressure(const struct keys_score *score, int index, double time_s);
/* The largest that a note gets, once its attack is over. */
double keys_note_most(const struct keys_score *score, int index);

#endif
