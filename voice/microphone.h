/* microphone.h - sound as it comes in: from JACK, or from PulseAudio (and PipeWire, which
 * stands in for both).
 *
 *     struct microphone *microphone;
 *     char why[300];
 *     if (!microphone_open(NULL, &microphone, why, sizeof why))
 *         die(why);
 *     // what has come since the last call
 *     size_t count = microphone_take(microphone, samples, room);
 *     microphone_close(microphone);
 *
 * Libraries are loaded when a microphone is opened. Samples are -1..1, one channel. A thread of
 * JACK's, or one of ours for PulseAudio, puts them into a ring of some seconds and waits for
 * nobody; what finds no room is lost and counted.
 *
 * Threads: a microphone is taken from by one. */
#ifndef LUTETIA_VOICE_MICROPHONE_H
#define LUTETIA_VOICE_MICROPHONE_H

#include <stdbool.h>
#include <stddef.h>

struct microphone;

/* "jack", "pulse"; NULL: the first of both that works. Of JACK the first port that captures is
 * connected, if there is one. False: `why` has one line. Owns: the caller closes *out. */
bool microphone_open(const char *source, struct microphone **out, char *why, size_t room);
/* Whether there may be such a source: "jack", "pulse", NULL. */
bool microphone_known(const char *source);
void microphone_close(struct microphone *microphone); /* NULL is fine */

int microphone_rate_hz(const struct microphone *microphone);
/* Up to `room` samples that have come; waits for none. */
size_t microphone_take(struct microphone *microphone, float *samples, size_t room);
/* Samples that found no room. */
size_t microphone_lost(const struct microphone *microphone);
/* The server is gone: nothing comes any more. */
bool microphone_gone(const struct microphone *microphone);

#endif
