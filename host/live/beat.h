/* beat.h - a MIDI clock's beat and tempo.
 *
 *     struct beat beat = {0};
 *     // each message: those that are no clock's change nothing
 *     beat_take(&beat, &message);
 *     if (beat_now(&beat, midi_now_ns(), &phase, &tempo))
 *         ...
 *
 * A clock (f8) comes 24 times in a quarter note; start (fa) is a beat, continue (fb) goes on,
 * stop (fc) stands still. Between two clocks the beat goes on by the tempo that was measured
 * over the last quarter note.
 */
#ifndef LUTETIA_LIVE_BEAT_H
#define LUTETIA_LIVE_BEAT_H

#include <midi_message.h>

#include <stdbool.h>
#include <stdint.h>

enum { BEAT_CLOCKS = 24 };

struct beat {
    uint64_t times_ns[BEAT_CLOCKS]; /* of the last clocks: a ring, the newest at `last` */
    int last, count;
    int clocks; /* since the beat began, 0..23 */
    bool stopped;
};

void beat_take(struct beat *beat, const struct midi_message *m);

/* phase: the part of the quarter note that has gone, 0..1. per_minute: quarter notes in a
 * minute. now_ns: CLOCK_MONOTONIC. False: no clock runs: none came for a second, or it is
 * stopped. */
bool beat_now(const struct beat *beat, uint64_t now_ns, double *phase, double *per_minute);

#endif
